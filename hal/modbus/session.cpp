// SPDX-License-Identifier: Apache-2.0
// One TCP connection to a Modbus server. See session.hpp.
#include "hal/modbus/session.hpp"

#include <modbus/modbus.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

namespace nc::hal::modbus {
namespace {

// Function codes. Modbus application protocol V1.1b3, 6.1 to 6.6, 6.11, 6.12.
constexpr unsigned kReadFunction[] = {1, 2, 4, 3};  // by Table
constexpr unsigned kWriteOneCoil = 5, kWriteOneRegister = 6, kWriteCoils = 15, kWriteRegisters = 16;

std::string place(const Block& block, unsigned function) {
  return place_text(block) + ", function " + std::to_string(function);
}

bool is_exception(int error) {
  return error > MODBUS_ENOBASE && error < MODBUS_ENOBASE + MODBUS_EXCEPTION_MAX;
}

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

void Session::FreeContext::operator()(_modbus* context) const {
  modbus_free(context);
}

Session::Session(const LinkConfig& config)
    : config_(config), context_(modbus_new_tcp_pi(config.host.c_str(), std::to_string(config.port).c_str())) {
  if (context_ == nullptr) return;  // out of memory: connect() says so
  modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
  const auto seconds = [](unsigned ms) { return ms / 1000; };
  const auto micros = [](unsigned ms) { return ms % 1000 * 1000; };
  modbus_set_response_timeout(context_.get(), seconds(config.response_timeout_ms),
                              micros(config.response_timeout_ms));
  modbus_set_byte_timeout(context_.get(), seconds(config.byte_timeout_ms), micros(config.byte_timeout_ms));
}

Session::~Session() {
  close();
}

// The socket is made here and not by libmodbus: its connect() in 3.1.6 puts the descriptor into an fd_set
// before anyone could look at its number, and names a time-out wrongly.
Result Session::connect() {
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

Result Session::connect_to(const addrinfo& address) {
  const int fd =
      socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, address.ai_protocol);
  int error = fd < 0 ? errno : 0;
  if (fd >= FD_SETSIZE) error = EMFILE;  // select() in libmodbus would write beyond its fd_set
  if (error == 0) error = connect_within(fd, address, config_.response_timeout_ms);
  if (error == 0) {
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);  // speed only: works without it
    if (adopt(fd)) return Result::kOk;
    error = ECANCELED;
  }
  if (fd >= 0) ::close(fd);
  error_ =
      "connect to " + config_.host + " port " + std::to_string(config_.port) + ": " + std::strerror(error);
  return error == ETIMEDOUT ? Result::kTimeout : Result::kFailed;
}

bool Session::adopt(int fd) {
  const std::lock_guard lock(mutex_);
  if (aborted_) return false;
  fd_ = fd;
  modbus_set_socket(context_.get(), fd);
  return true;
}

void Session::close() {
  const std::lock_guard lock(mutex_);
  if (fd_ < 0) return;
  modbus_set_socket(context_.get(), -1);
  ::shutdown(fd_, SHUT_RDWR);
  ::close(fd_);
  fd_ = -1;
}

void Session::abort() {
  const std::lock_guard lock(mutex_);
  aborted_ = true;
  if (fd_ >= 0) ::shutdown(fd_, SHUT_RDWR);
}

// Before a request nothing may be there to read.
bool Session::ready(const Block& block) {
  error_.clear();
  if (fd_ < 0) {
    error_ = "not connected";
    return false;
  }
  if (modbus_set_slave(context_.get(), block.unit) != 0) {
    error_ = "unit " + std::to_string(block.unit) + " is not possible";
    close();
    return false;
  }
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

Result Session::finish(int count, const Block& block, unsigned function) {
  if (count == block.count) return Result::kOk;
  const int error = count < 0 ? errno : EMBBADDATA;
  error_ = place(block, function) + ": " +
           (error == EMBBADDATA ? "the answer does not belong to the request" : modbus_strerror(error));
  if (count < 0 && is_exception(error)) return Result::kException;
  close();
  return error == ETIMEDOUT ? Result::kTimeout : Result::kFailed;
}

Result Session::read(const Block& block, std::uint16_t* cells) {
  if (!ready(block)) return Result::kFailed;
  modbus_t* context = context_.get();
  int count = 0;
  if (is_bit_table(block.table)) {
    std::array<std::uint8_t, kMaxReadBits> bits{};
    const auto function = block.table == Table::kCoil ? modbus_read_bits : modbus_read_input_bits;
    count = function(context, block.first, block.count, bits.data());
    for (int i = 0; i < count && i < block.count; ++i) cells[i] = bits[static_cast<unsigned>(i)];
  } else {
    const auto function =
        block.table == Table::kHolding ? modbus_read_registers : modbus_read_input_registers;
    count = function(context, block.first, block.count, cells);
  }
  return finish(count, block, kReadFunction[static_cast<unsigned>(block.table)]);
}

// One cell goes out by functions 5 and 6, which every device has; more by 15 and 16.
Result Session::write(const Block& block, const std::uint16_t* cells) {
  if (!ready(block)) return Result::kFailed;
  modbus_t* context = context_.get();
  if (block.table == Table::kCoil) {
    if (block.count == 1)
      return finish(modbus_write_bit(context, block.first, cells[0]), block, kWriteOneCoil);
    std::array<std::uint8_t, kMaxWriteBits> bits{};
    for (unsigned i = 0; i < block.count; ++i) bits[i] = static_cast<std::uint8_t>(cells[i]);
    return finish(modbus_write_bits(context, block.first, block.count, bits.data()), block, kWriteCoils);
  }
  if (block.count == 1)
    return finish(modbus_write_register(context, block.first, cells[0]), block, kWriteOneRegister);
  return finish(modbus_write_registers(context, block.first, block.count, cells), block, kWriteRegisters);
}

}  // namespace nc::hal::modbus
