// SPDX-License-Identifier: Apache-2.0
// Descriptors over a socket. See door.hpp.
#include "runtime/share/door.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <vector>

#include "runtime/services/system_error.hpp"

namespace nc::rt::share {
namespace {

constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW;
constexpr int kWaiting = 16;                 // readers that may connect at the same time
constexpr timeval kPatience = {0, 500'000};  // time for which a reader waits for an owner that hangs

using services::system_error;

// Makes an address without a NUL at its end, so its length, which is returned, must be passed with it.
socklen_t address_of(const std::string& name, sockaddr_un* address) {
  *address = {};
  address->sun_family = AF_UNIX;
  const std::size_t length = std::min(name.size(), sizeof address->sun_path - 1);
  std::memcpy(address->sun_path + 1, name.data(), length);
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
}

bool is_member(gid_t group, gid_t primary, const std::vector<gid_t>& others) {
  return group == primary || std::find(others.begin(), others.end(), group) != others.end();
}

std::vector<gid_t> groups_of_peer(int socket) {
  std::vector<gid_t> groups(256);
  socklen_t size = static_cast<socklen_t>(groups.size() * sizeof(gid_t));
  // When the kernel does not know this option, or the peer has more groups than fit, only the peer's primary group counts.
  if (getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size) != 0) size = 0;
  groups.resize(size / sizeof(gid_t));
  return groups;
}

std::vector<gid_t> own_groups() {
  const int count = getgroups(0, nullptr);
  std::vector<gid_t> groups(count > 0 ? static_cast<std::size_t>(count) : 0);
  if (count > 0 && getgroups(count, groups.data()) < 0) groups.clear();
  return groups;
}

bool send_descriptor(int socket, int descriptor) {
  char byte = 1;
  iovec data{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptor)] = {};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof descriptor);
  std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
  return sendmsg(socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL) == 1;
}

// Receives a descriptor. -1 with errno, or with errno 0 when the other side has closed the connection without sending one.
int receive_descriptor(int socket) {
  char byte = 0;
  iovec data{&byte, 1};
  int descriptor = -1;
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptor)] = {};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t got = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  if (got <= 0) {
    if (got == 0) errno = 0;
    return -1;
  }
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header == nullptr || header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS ||
      header->cmsg_len != CMSG_LEN(sizeof descriptor)) {
    errno = EPROTO;
    return -1;
  }
  std::memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
  return descriptor;
}

// True when the owner of the memory is this user, root, or in a group of this user; root trusts every owner. Memory of anybody else is not mapped, because
// its owner could fake positions and answers to commands.
bool owner_is_trusted(int socket) {
  ucred owner{};
  socklen_t size = sizeof owner;
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &owner, &size) != 0) return false;
  return owner.uid == geteuid() || owner.uid == 0 || geteuid() == 0 ||
         is_member(owner.gid, getegid(), own_groups());
}

}  // namespace

int make_sealed_memory(const std::string& name, std::size_t size, std::string* error) {
  const int memory = memfd_create(name.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (memory >= 0 && fchmod(memory, 0600) == 0 && ftruncate(memory, static_cast<off_t>(size)) == 0 &&
      fcntl(memory, F_ADD_SEALS, kSeals | F_SEAL_SEAL) == 0)
    return memory;
  *error = system_error("shared memory " + name + " cannot be made");
  if (memory >= 0) ::close(memory);
  return -1;
}

bool Door::open(const std::string& name, int memory, bool group, bool* in_use, std::string* error) {
  close();
  *in_use = false;
  memory_ = memory;
  group_ = group;
  sockaddr_un address;
  const socklen_t length = address_of(name, &address);
  socket_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  stop_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  bool good = socket_ >= 0 && stop_ >= 0;
  if (good && bind(socket_, reinterpret_cast<const sockaddr*>(&address), length) != 0) {
    *in_use = errno == EADDRINUSE;
    good = false;
  }
  good = good && listen(socket_, kWaiting) == 0;
  if (!good) *error = system_error("the socket of shared memory " + name);
  else if (thread_.start([this] { serve(); }, error)) return true;
  close();
  return false;
}

void Door::close() {
  if (stop_ >= 0) {
    const std::uint64_t one = 1;
    while (write(stop_, &one, sizeof one) < 0 && errno == EINTR) continue;
    thread_.join();
    ::close(stop_);
  }
  if (socket_ >= 0) ::close(socket_);
  socket_ = stop_ = memory_ = -1;
}

bool Door::may_enter(int client) const {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (getsockopt(client, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  if (peer.uid == geteuid() || peer.uid == 0) return true;
  return group_ && is_member(getegid(), peer.gid, groups_of_peer(client));
}

// A reader that connects gets the descriptor or nothing, at once; the loop never waits for a single reader.
void Door::serve() {
  pollfd ready[2] = {{stop_, POLLIN, 0}, {socket_, POLLIN, 0}};
  for (;;) {
    if (poll(ready, 2, -1) < 0 && errno != EINTR) return;
    if ((ready[0].revents & POLLIN) != 0) return;
    const int client = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (client < 0) {
      // No descriptors are left: wait before the next try, instead of trying in a busy loop.
      if (errno == EMFILE || errno == ENFILE || errno == ENOMEM) poll(ready, 1, 100);
      continue;
    }
    if (may_enter(client)) (void)send_descriptor(client, memory_);  // an error is ignored: the reader has gone
    ::close(client);
  }
}

Knock fetch_memory(const std::string& name, int* memory, std::string* error) {
  sockaddr_un address;
  const socklen_t length = address_of(name, &address);
  const int client = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  const auto leave = [&](Knock result, const std::string& text) {
    if (client >= 0) ::close(client);
    *error = text;
    return result;
  };
  if (client < 0) return leave(Knock::kRefused, system_error("a socket"));
  (void)setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  (void)setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
  if (connect(client, reinterpret_cast<const sockaddr*>(&address), length) != 0)
    return leave(errno == ECONNREFUSED ? Knock::kNobody : Knock::kRefused, system_error("it cannot be reached"));
  if (!owner_is_trusted(client)) return leave(Knock::kRefused, "belongs to another user: it is not believed");
  const int given = receive_descriptor(client);
  if (given < 0) {
    return leave(Knock::kRefused, errno == 0 ? "is not for this user ([share] group opens it to the group)"
                                  : errno == EAGAIN ? "is not handed out: its control hangs"
                                                    : system_error("is not handed out"));
  }
  const int seals = fcntl(given, F_GET_SEALS);
  if (seals < 0 || (seals & kSeals) != kSeals) {
    ::close(given);
    return leave(Knock::kRefused, "is no sealed memory: someone could take it away");
  }
  *memory = given;
  return leave(Knock::kGiven, "");
}

}  // namespace nc::rt::share
