// SPDX-License-Identifier: Apache-2.0
// The bind() of the programs that use DDS. See loopback_bind.hpp.
#include "dds/loopback_bind.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstring>

namespace nc::dds {
namespace {

std::atomic<bool> g_loopback_only{false};

// Makes the system call directly, because the function of the C library is the one that is replaced.
int bind_now(int fd, const void* address, socklen_t size) {
  return static_cast<int>(syscall(SYS_bind, fd, address, size));
}

}  // namespace

void bind_to_loopback_only() {
  g_loopback_only = true;
}

}  // namespace nc::dds

// A symbol of the program is used instead of that of the C library, also by the libraries that the program is linked with.
extern "C" __attribute__((visibility("default"))) int bind(int fd, const sockaddr* address, socklen_t size) noexcept {
  using nc::dds::bind_now;
  if (!nc::dds::g_loopback_only || address == nullptr) return bind_now(fd, address, size);
  if (address->sa_family == AF_INET && size >= sizeof(sockaddr_in)) {
    sockaddr_in own{};
    std::memcpy(&own, address, sizeof own);
    if (own.sin_addr.s_addr == htonl(INADDR_ANY)) own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return bind_now(fd, &own, sizeof own);
  }
  if (address->sa_family == AF_INET6 && size >= sizeof(sockaddr_in6)) {
    sockaddr_in6 own{};
    std::memcpy(&own, address, sizeof own);
    if (IN6_IS_ADDR_UNSPECIFIED(&own.sin6_addr)) own.sin6_addr = in6addr_loopback;
    return bind_now(fd, &own, sizeof own);
  }
  return bind_now(fd, address, size);
}
