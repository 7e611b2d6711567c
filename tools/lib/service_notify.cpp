// SPDX-License-Identifier: Apache-2.0
// Datagrams to the service manager. See service_notify.hpp.
#include "tools/lib/service_notify.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace nc::tools {
namespace {

// A number from the environment; 0 when the variable is absent or is no number.
std::int64_t number_of(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr || *text < '0' || *text > '9') return 0;
  char* end = nullptr;
  const long long value = std::strtoll(text, &end, 10);
  return *end == 0 ? value : 0;
}

}  // namespace

ServiceNotify::ServiceNotify() {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  if (std::strlen(path) >= sizeof(sockaddr_un::sun_path)) return;
  address_ = path;
  if (address_[0] == '@') address_[0] = '\0';  // '@' stands for the NUL of an abstract socket
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::int64_t pid = number_of("WATCHDOG_PID"), interval_us = number_of("WATCHDOG_USEC");
  constexpr std::int64_t kLongestUs = std::int64_t{1} << 50;
  if ((pid == 0 || pid == getpid()) && interval_us < kLongestUs) watchdog_ns_ = interval_us * 1000;
}

ServiceNotify::~ServiceNotify() {
  if (socket_ >= 0) close(socket_);
}

bool ServiceNotify::send(const std::string& lines) {
  if (socket_ < 0) return false;
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::memcpy(to.sun_path, address_.data(), address_.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  const ssize_t sent = sendto(socket_, lines.data(), lines.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&to), length);
  return sent == static_cast<ssize_t>(lines.size());
}

}  // namespace nc::tools
