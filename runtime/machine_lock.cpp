// SPDX-License-Identifier: Apache-2.0
// One control for one machine. See machine_lock.hpp.
#include "runtime/machine_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "runtime/hal_factory.hpp"

namespace nc::rt {
namespace {

// ---- keys ----

void add_file(const std::string& path, const std::string& meaning, std::vector<MachineResource>* resources) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path, ignored);
  if (!whole.empty()) resources->push_back({"path " + whole.string(), meaning + " " + path});
}

// ---- names of sockets ----

// The name of a socket is limited in length and a key is not. So the name holds a hash of the key (FNV-1a, 64 bits).
std::string socket_name(const std::string& key) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char name[40];
  std::snprintf(name, sizeof name, "nc-machine-%016llx", static_cast<unsigned long long>(hash));
  return name;
}

socklen_t abstract_address(const std::string& name, sockaddr_un* address) {
  *address = {};
  address->sun_family = AF_UNIX;
  std::memcpy(address->sun_path + 1, name.data(), name.size());
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
}

// ---- the process that holds a lock ----

std::string process_text(long pid) {
  if (pid <= 0) return "another process";
  std::string name;
  std::ifstream("/proc/" + std::to_string(pid) + "/comm") >> name;
  return "process " + std::to_string(pid) + (name.empty() ? "" : " (" + name + ")");
}

// The process that listens on the socket of this name. 0 = there is one, but its number is not known (another process namespace); -1 = no process
// listens.
long listener_of(const sockaddr_un& address, socklen_t length) {
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return 0;
  long pid = 0;
  ucred owner{};
  socklen_t size = sizeof owner;
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), length) != 0)
    pid = errno == ECONNREFUSED ? -1 : 0;
  else if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &owner, &size) == 0)
    pid = owner.pid;
  close(fd);
  return pid;
}

// The process that holds a flock() on the file, from the kernel's list, whose lines are such as "1: FLOCK  ADVISORY  WRITE 1234 08:01:5678 0 EOF". 0 =
// not known.
long flock_holder(const struct stat& file) {
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    long pid = 0;
    unsigned major_number = 0, minor_number = 0;
    unsigned long long inode = 0;
    if (std::sscanf(line.c_str(), "%*s FLOCK %*s WRITE %ld %x:%x:%llu", &pid, &major_number, &minor_number, &inode) == 4 &&
        inode == file.st_ino && major_number == major(file.st_dev) && minor_number == minor(file.st_dev))
      return pid;
  }
  return 0;
}

std::string taken_text(const std::string& meaning, long pid) {
  return meaning + " is in use: " + process_text(pid) + " runs this machine";
}

// Takes one lock. Returns its descriptor, or -1 with a sentence in *error.
int take_one(const MachineResource& resource, std::string* error) {
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) {
    *error = std::string("no lock of the machine: ") + std::strerror(errno);
    return -1;
  }
  sockaddr_un address;
  const socklen_t length = abstract_address(socket_name(resource.key), &address);
  constexpr int kAttempts = 50;  // while no process listens: the holder is just ending, or has not called listen() yet
  for (int i = 0; i < kAttempts; ++i) {
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), length) == 0 && listen(fd, SOMAXCONN) == 0) return fd;
    const int problem = errno;
    const long pid = problem == EADDRINUSE ? listener_of(address, length) : 0;
    *error = problem == EADDRINUSE ? taken_text(resource.meaning, pid)
                                   : std::string("no lock of the machine: ") + std::strerror(problem);
    if (pid >= 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  close(fd);
  return -1;
}

}  // namespace

std::vector<MachineResource> machine_resources(const Config& config, bool retained) {
  std::vector<MachineResource> resources;
  const std::string meaning = "the configuration";
  add_file(config.file, meaning, &resources);
  struct stat status {};
  if (stat(config.file.c_str(), &status) == 0)
    resources.push_back({"file " + std::to_string(status.st_dev) + " " + std::to_string(status.st_ino), meaning + " " + config.file});
  if (config.machine_kind != nullptr && config.machine_kind->resources != nullptr) config.machine_kind->resources(config, &resources);
  for (const PointBusConfig& bus : config.buses)
    if (bus.kind->resources != nullptr) bus.kind->resources(config, bus, &resources);
  if (retained)
    for (const std::string& path : {config.retain_path(), config.variables_path(), config.offsets_path()})
      if (!path.empty()) add_file(path, "the file of retained data", &resources);
  // All controls take their locks in the same order: then of two that start at the same time and share several things, one gets all of these. Each
  // resource is listed once, even where two links lead to the same unit.
  const auto before = [](const MachineResource& a, const MachineResource& b) { return a.key < b.key; };
  const auto same = [](const MachineResource& a, const MachineResource& b) { return a.key == b.key; };
  std::stable_sort(resources.begin(), resources.end(), before);
  resources.erase(std::unique(resources.begin(), resources.end(), same), resources.end());
  return resources;
}

MachineLock::~MachineLock() {
  release();
}

void MachineLock::release() {
  for (const int fd : held_) close(fd);
  held_.clear();
}

bool MachineLock::take(const std::vector<MachineResource>& resources, std::string* error) {
  for (const MachineResource& resource : resources) {
    const int fd = take_one(resource, error);
    if (fd < 0) {
      release();
      return false;
    }
    held_.push_back(fd);
  }
  return true;
}

bool MachineLock::take_file(const std::string& path, std::string* error) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) {
    *error = path + ": " + std::strerror(errno);
    return false;
  }
  if (flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    struct stat status {};
    *error = taken_text("the configuration " + path, fstat(fd, &status) == 0 ? flock_holder(status) : 0);
    close(fd);
    return false;
  }
  held_.push_back(fd);
  return true;
}

bool MachineLock::take_machine(const Config& config, bool virtual_time, std::string* error) {
  if (virtual_time && config.buses.empty()) return true;
  return take(machine_resources(config, !virtual_time), error) && take_file(config.file, error);
}

}  // namespace nc::rt
