// SPDX-License-Identifier: Apache-2.0
// File with two generations. See store.hpp.
//
//   8 bytes magic | u32 version | u32 CRC-32 of what follows | u64 generation | u64 length | payload
//
// Numbers are in the byte order of the machine: the file stays on it.
#include "runtime/retain/store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>

namespace nc::rt {
namespace {

constexpr char kMagic[8] = {'n', 'c', 'r', 'e', 't', 'a', 'i', 'n'};
constexpr std::uint32_t kVersion = 1;
struct Header {
  char magic[8];
  std::uint32_t version, check;
  std::uint64_t generation, length;
};
static_assert(sizeof(Header) == 32);
constexpr std::size_t kChecked = offsetof(Header, generation);
// A file with this generation is refused as damaged. No file is written so often, and the next generation would be 0 and count as the oldest.
constexpr std::uint64_t kNoGeneration = ~std::uint64_t{0};

// CRC-32 of IEEE 802.3, reflected.
std::uint32_t crc32(const char* data, std::size_t size) {
  static constexpr std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (unsigned bit = 0; bit < 8; ++bit) value = value >> 1 ^ ((value & 1) != 0 ? 0xEDB88320u : 0);
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < size; ++i) crc = crc >> 8 ^ kTable[(crc ^ static_cast<unsigned char>(data[i])) & 0xff];
  return ~crc;
}

std::string system_error(const std::string& path) {
  return path + ": " + std::strerror(errno);
}

// Reads a whole regular file of at most `limit` bytes. False with errno, or with errno 0 when it is not such a file.
bool read_all(const std::string& path, std::size_t limit, std::string* bytes) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  struct stat status {};
  bool good = fstat(file, &status) == 0;
  if (good && (!S_ISREG(status.st_mode) || static_cast<std::uint64_t>(status.st_size) > limit)) {
    errno = 0;
    good = false;
  }
  bytes->resize(good ? static_cast<std::size_t>(status.st_size) : 0);
  for (std::size_t at = 0; good && at < bytes->size();) {
    const ssize_t got = read(file, bytes->data() + at, bytes->size() - at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      bytes->resize(at);
      good = got == 0;
      break;
    }
    at += static_cast<std::size_t>(got);
  }
  const int problem = errno;
  close(file);
  errno = problem;
  return good;
}

bool write_all(int file, const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t put = write(file, bytes.data() + at, bytes.size() - at);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += static_cast<std::size_t>(put);
  }
  return true;
}

bool is_whole(const std::string& bytes, std::uint64_t* generation, std::string* payload) {
  Header header;
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.version != kVersion ||
      header.length != bytes.size() - sizeof header || header.generation == kNoGeneration ||
      header.check != crc32(bytes.data() + kChecked, bytes.size() - kChecked))
    return false;
  *generation = header.generation;
  *payload = bytes.substr(sizeof header);
  return true;
}

// What is wrong with a file that is not whole, as the rest of a sentence.
const char* trouble_of(const std::string& bytes) {
  Header header;
  if (bytes.size() < sizeof header) return " is damaged";
  std::memcpy(&header, bytes.data(), sizeof header);
  const bool other = std::memcmp(header.magic, kMagic, sizeof kMagic) == 0 && header.version != kVersion;
  return other ? " is damaged, or of another version of the control" : " is damaged";
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

// Brings the names in the folder of a file to the disk, so that a rename survives a power cut.
bool sync_folder(const std::string& path) {
  const int folder = open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return false;
  const bool good = fsync(folder) == 0 || errno == EINVAL;  // some file systems cannot sync a folder
  close(folder);
  return good;
}

}  // namespace

RetainStore::~RetainStore() {
  if (lock_ >= 0) close(lock_);
}

bool RetainStore::lock(std::string* error) {
  const std::string name = path_ + ".lock";
  lock_ = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0) return true;
  *error = lock_ >= 0 ? path_ + " belongs to another control that is running" : system_error(name);
  if (lock_ >= 0) close(lock_);
  lock_ = -1;
  return false;
}

RetainStore::Loaded RetainStore::load(std::string* payload, std::string* error) {
  bool found = false, last_is_whole = false, any = false;
  std::string damaged;
  for (const char* ending : {"", ".new", ".old"}) {  // of two files with the same generation the first one counts
    const std::string name = path_ + ending;
    std::string bytes, read;
    std::uint64_t generation = 0;
    const bool there = read_all(name, kMaxPayload + sizeof(Header), &bytes);
    if (!there && errno == ENOENT) continue;
    const bool whole = there && is_whole(bytes, &generation, &read);
    // A PATH.new that is not whole is no damage: it was being written when the power went.
    if (ending[0] == '\0' || ending[1] != 'n') any = true;
    if (ending[0] == '\0') last_is_whole = whole;
    if (!whole) {
      if (ending[0] == '\0' || ending[1] != 'n')
        damaged += (damaged.empty() ? "" : "; ") + (there || errno == 0 ? name + trouble_of(bytes) : system_error(name));
      continue;
    }
    if (found && generation <= generation_) continue;
    found = true;
    newest_is_new_ = ending[0] != '\0' && ending[1] == 'n';
    generation_ = generation;
    *payload = std::move(read);
  }
  // When only PATH.old is whole, the last generation is missing. When PATH.new is whole and newer, nothing is missing: the power went between the two
  // renames of put_in_place().
  if (found && damaged.empty() && !last_is_whole && !newest_is_new_) damaged = path_ + " is missing";
  *error = damaged;
  if (found) return last_is_whole || damaged.empty() ? Loaded::kWhole : Loaded::kOlder;
  return any ? Loaded::kDamaged : Loaded::kNothing;
}

void RetainStore::set_aside() {
  (void)rename(path_.c_str(), (path_ + ".damaged").c_str());  // a failure is ignored: PATH may not exist
}

bool RetainStore::put_in_place() {
  return (rename(path_.c_str(), (path_ + ".old").c_str()) == 0 || errno == ENOENT) &&
         rename((path_ + ".new").c_str(), path_.c_str()) == 0 && sync_folder(path_);
}

bool RetainStore::save(const std::string& payload, std::string* error) {
  if (payload.size() > kMaxPayload) {
    *error = path_ + ": more than " + std::to_string(kMaxPayload) + " bytes";
    return false;
  }
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.version = kVersion;
  header.generation = generation_ + 1;
  header.length = payload.size();
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  bytes += payload;
  header.check = crc32(bytes.data() + kChecked, bytes.size() - kChecked);
  std::memcpy(bytes.data(), &header, sizeof header);

  const std::string next = path_ + ".new";
  // PATH.new is about to be overwritten. When it holds the newest generation, it is first renamed to PATH.
  if (newest_is_new_ && !put_in_place()) {
    *error = system_error(path_);
    return false;
  }
  newest_is_new_ = false;
  const int file = open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  bool good = file >= 0 && write_all(file, bytes) && fsync(file) == 0;
  const int problem = errno;
  if (file >= 0 && close(file) != 0) good = false;
  // Half of a file would take room that others need.
  if (!good && file >= 0) (void)unlink(next.c_str());
  if (!good && problem != 0) errno = problem;
  // PATH becomes PATH.old only after the new file is on the disk.
  good = good && put_in_place();
  if (good) {
    ++generation_;
    return true;
  }
  *error = system_error(path_);
  return false;
}

}  // namespace nc::rt
