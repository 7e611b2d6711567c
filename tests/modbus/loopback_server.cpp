// SPDX-License-Identifier: Apache-2.0
// A Modbus TCP server for tests. See loopback_server.hpp. Modbus application protocol V1.1b3, Modbus
// messaging on TCP/IP V1.0b.
#include "modbus/loopback_server.hpp"

#include "modbus/serial_device.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace nc::test {
namespace {

constexpr std::size_t kHeader = 7;  // MBAP: transaction, protocol, length, unit
constexpr std::uint8_t kIllegalFunction = 1, kIllegalAddress = 2;

unsigned word_at(const Bytes& bytes, std::size_t place) {
  return static_cast<unsigned>(bytes.at(place) << 8 | bytes.at(place + 1));
}
void put_word(Bytes* bytes, unsigned word) {
  bytes->push_back(static_cast<std::uint8_t>(word >> 8));
  bytes->push_back(static_cast<std::uint8_t>(word));
}

// Exactly `size` bytes; false when the connection ends.
bool receive(int fd, std::size_t size, Bytes* bytes) {
  while (bytes->size() < size) {
    std::uint8_t buffer[300];
    const auto count = recv(fd, buffer, std::min(sizeof buffer, size - bytes->size()), 0);
    if (count <= 0) return false;
    bytes->insert(bytes->end(), buffer, buffer + count);
  }
  return true;
}

bool send_all(int fd, const std::uint8_t* bytes, std::size_t size) {
  return size == 0 || send(fd, bytes, size, MSG_NOSIGNAL) == static_cast<ssize_t>(size);
}

}  // namespace

LoopbackServer::LoopbackServer(std::uint16_t port) {
  listen_fd_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listen_fd_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  socklen_t size = sizeof address;
  if (bind(listen_fd_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listen_fd_, 16) != 0 ||
      getsockname(listen_fd_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("no loopback socket");
  port_ = ntohs(address.sin_port);
  acceptor_ = std::thread([this] { accept_all(); });
}

LoopbackServer::~LoopbackServer() {
  stop();
}

void LoopbackServer::stop() {
  if (stopping_.exchange(true)) return;
  acceptor_.join();
  close(listen_fd_);
  {
    const std::lock_guard lock(mutex_);
    for (const int fd : open_) shutdown(fd, SHUT_RDWR);
  }
  for (std::thread& thread : threads_) thread.join();
}

void LoopbackServer::accept_all() {
  while (!stopping_) {
    pollfd wait{listen_fd_, POLLIN, 0};
    if (poll(&wait, 1, 5) <= 0) continue;
    const int fd = accept4(listen_fd_, nullptr, nullptr, SOCK_CLOEXEC);
    if (fd < 0) continue;
    ++connections_;
    const std::lock_guard lock(mutex_);
    open_.push_back(fd);
    threads_.emplace_back([this, fd] { serve(fd); });
  }
}

void LoopbackServer::serve(int fd) {
  for (;;) {
    Bytes request;
    if (!receive(fd, kHeader, &request) || !receive(fd, 6 + word_at(request, 4), &request)) break;
    Answer answer = right_answer(request);
    std::this_thread::sleep_for(std::chrono::milliseconds(answer.delay_ms));
    bool sent = true;
    if (answer.drip_ms == 0) {
      sent = send_all(fd, answer.bytes.data(), answer.bytes.size());
    } else {
      for (std::size_t i = 0; i < answer.bytes.size() && sent && !stopping_; ++i) {
        sent = send_all(fd, &answer.bytes[i], 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(answer.drip_ms));
      }
    }
    if (!sent || answer.close) break;
  }
  const std::lock_guard lock(mutex_);
  std::erase(open_, fd);
  close(fd);
}

Answer LoopbackServer::right_answer(const Bytes& request) {
  const std::lock_guard lock(mutex_);
  functions_.push_back(request[7]);
  const Bytes pdu = reply_pdu(request);
  Answer right;
  right.bytes.assign(request.begin(), request.begin() + 4);
  put_word(&right.bytes, static_cast<unsigned>(pdu.size() + 1));
  right.bytes.push_back(request[6]);
  right.bytes.insert(right.bytes.end(), pdu.begin(), pdu.end());
  return fault_ ? fault_(request, right) : right;
}

Bytes LoopbackServer::reply_pdu(const Bytes& request) {
  const std::uint8_t function = request[7];
  const auto refuse = [&](std::uint8_t code) {
    return Bytes{static_cast<std::uint8_t>(function | 0x80), code};
  };
  Unit& unit = units_[request[6]];
  const unsigned first = word_at(request, 8);
  std::map<unsigned, std::uint16_t>* table = nullptr;
  if (function == 1 || function == 5 || function == 15) table = &unit.coil;
  if (function == 2) table = &unit.discrete;
  if (function == 3 || function == 6 || function == 16) table = &unit.holding;
  if (function == 4) table = &unit.input;
  if (table == nullptr) return refuse(kIllegalFunction);
  const unsigned count = function == 5 || function == 6 ? 1 : word_at(request, 10);
  for (unsigned i = 0; i < count; ++i)
    if (!table->contains(first + i)) return refuse(kIllegalAddress);
  Bytes reply{function};
  if (function <= 2) {
    reply.push_back(static_cast<std::uint8_t>((count + 7) / 8));
    reply.resize(2 + (count + 7) / 8);
    for (unsigned i = 0; i < count; ++i)
      if ((*table)[first + i] != 0) reply[2 + i / 8] |= static_cast<std::uint8_t>(1u << i % 8);
    return reply;
  }
  if (function <= 4) {
    reply.push_back(static_cast<std::uint8_t>(2 * count));
    for (unsigned i = 0; i < count; ++i) put_word(&reply, (*table)[first + i]);
    return reply;
  }
  for (unsigned i = 0; i < count; ++i) {
    if (function == 5) (*table)[first] = request[10] == 0xFF ? 1 : 0;
    if (function == 6) (*table)[first] = static_cast<std::uint16_t>(word_at(request, 10));
    if (function == 15) (*table)[first + i] = request.at(13 + i / 8) >> (i % 8) & 1;
    if (function == 16) (*table)[first + i] = static_cast<std::uint16_t>(word_at(request, 13 + 2 * i));
  }
  reply.insert(reply.end(), request.begin() + 8, request.begin() + 12);
  return reply;
}

Bytes LoopbackServer::serial_answer(const Bytes& request) {
  Bytes as_tcp(kHeader - 1, 0);
  as_tcp.insert(as_tcp.end(), request.begin(), request.end() - 2);
  const std::lock_guard lock(mutex_);
  functions_.push_back(request[1]);
  Bytes frame{request[0]};
  const Bytes pdu = reply_pdu(as_tcp);
  frame.insert(frame.end(), pdu.begin(), pdu.end());
  return rtu_frame(frame);
}

void LoopbackServer::set_fault(Fault fault) {
  const std::lock_guard lock(mutex_);
  fault_ = std::move(fault);
}

void LoopbackServer::with(const std::function<void(std::map<unsigned, Unit>&)>& use) {
  const std::lock_guard lock(mutex_);
  use(units_);
}

std::uint16_t LoopbackServer::holding(unsigned unit, unsigned address) {
  const std::lock_guard lock(mutex_);
  return units_[unit].holding[address];
}

std::uint16_t LoopbackServer::coil(unsigned unit, unsigned address) {
  const std::lock_guard lock(mutex_);
  return units_[unit].coil[address];
}

std::vector<std::uint8_t> LoopbackServer::functions() {
  const std::lock_guard lock(mutex_);
  return functions_;
}

}  // namespace nc::test
