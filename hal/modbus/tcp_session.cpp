// SPDX-License-Identifier: Apache-2.0
// One TCP connection to a Modbus server. See tcp_session.hpp.
#include "hal/modbus/tcp_session.hpp"

#include <modbus/modbus.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

namespace nc::hal::modbus {
namespace {

// Connects a socket that does not block, within a time. 0 or the error.
int connect_within(int fd, const addrinfo& address, unsigned timeout_ms) {
  if (::connect(fd, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout_ms);
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
    pollfd wait{fd, POLLOUT, 0};
    const int count = poll(&wait, 1, left > 0 ? static_cast<int>(left) : 0);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return ETIMEDOUT;
    int error = 0;
    socklen_t size = sizeof error;
    return getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
  }
}

}  // namespace

TcpSession::TcpSession(const LinkConfig& config) : Session(config) {
  set_up(modbus_new_tcp_pi(config.host.c_str(), std::to_string(config.port).c_str()));  // without memory there is none: connect() says so
}

TcpSession::~TcpSession() {
  TcpSession::close();
}

// The socket is made here and not by libmodbus: its connect() in 3.1.6 puts the descriptor into an fd_set
// before anyone could look at its number, and names a time-out wrongly.
Result TcpSession::connect() {
  close();
  if (context_ == nullptr) {
    error_ = "no memory for a connection";
    return Result::kFailed;
  }
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int problem = getaddrinfo(config_.host.c_str(), std::to_string(config_.port).c_str(), &hints, &found);
  if (problem != 0) {
    error_ = "host \"" + config_.host + "\": " + gai_strerror(problem);
    return Result::kFailed;
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
  Result result = Result::kFailed;
  error_ = "host \"" + config_.host + "\" has no address";
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next)
    if ((result = connect_to(*address)) == Result::kOk) break;
  return result;
}

Result TcpSession::connect_to(const addrinfo& address) {
  const int fd =
      socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, address.ai_protocol);
  int error = fd < 0 ? errno : 0;
  if (fd >= FD_SETSIZE) error = EMFILE;  // select() in libmodbus would write beyond its fd_set
  if (error == 0) error = connect_within(fd, address, config_.response_timeout_ms);
  if (error == 0) {
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);  // speed only: works without it
    if (adopt(fd)) {
      modbus_set_socket(context_.get(), fd);
      return Result::kOk;
    }
    error = ECANCELED;
  }
  if (fd >= 0) ::close(fd);
  error_ =
      "connect to " + config_.host + " port " + std::to_string(config_.port) + ": " + std::strerror(error);
  return error == ETIMEDOUT ? Result::kTimeout : Result::kFailed;
}

void TcpSession::close() {
  const std::lock_guard lock(mutex_);
  if (fd_ < 0) return;
  modbus_set_socket(context_.get(), -1);
  ::shutdown(fd_, SHUT_RDWR);
  ::close(fd_);
  fd_ = -1;
}

void TcpSession::abort() {
  const std::lock_guard lock(mutex_);
  aborted_ = true;
  if (fd_ >= 0) ::shutdown(fd_, SHUT_RDWR);
}

bool TcpSession::clear_to_send() {
  pollfd wait{fd_, POLLIN, 0};
  if (poll(&wait, 1, 0) == 0) return true;
  char byte = 0;
  const auto count = recv(fd_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  error_ = count > 0    ? "an answer that nobody asked for"
           : count == 0 ? "closed by the partner"
                        : std::string("connection: ") + std::strerror(errno);
  close();
  return false;
}

// 0 or the error. A partner that takes nothing is not waited for any longer than one that says nothing.
int TcpSession::send_all(const Frame& request) {
  for (std::size_t at = 0; at < request.size;) {
    const ssize_t sent = ::send(fd_, request.bytes.data() + at, request.size - at, MSG_NOSIGNAL);
    if (sent > 0) {
      at += static_cast<std::size_t>(sent);
      continue;
    }
    if (sent < 0 && errno == EINTR) continue;
    if (sent == 0 || (errno != EAGAIN && errno != EWOULDBLOCK)) return sent == 0 ? EPIPE : errno;
    pollfd wait{fd_, POLLOUT, 0};
    const int count = poll(&wait, 1, static_cast<int>(config_.response_timeout_ms));
    if (count == 0) return ETIMEDOUT;
    if (count < 0 && errno != EINTR) return errno;
  }
  return 0;
}

int TcpSession::receive(const Frame&, std::uint8_t* answer) {
  return modbus_receive_confirmation(context_.get(), answer);
}

void TcpSession::doubt(int) {
  close();
}

}  // namespace nc::hal::modbus
