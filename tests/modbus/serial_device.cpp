// SPDX-License-Identifier: Apache-2.0
// Modbus RTU devices on a pseudo-terminal. See serial_device.hpp.
#include "modbus/serial_device.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace nc::test {
namespace {

using std::chrono::steady_clock;

/// Bytes of a request by what is there of it, 0 = not to be told yet.
std::size_t request_size(const Bytes& bytes) {
  if (bytes.size() < 2) return 0;
  if (bytes[1] != 15 && bytes[1] != 16) return 8;
  return bytes.size() < 7 ? 0 : 9u + bytes[6];
}

}  // namespace

std::uint16_t crc_of(const std::uint8_t* bytes, std::size_t size) {
  unsigned crc = 0xFFFF;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (unsigned bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xA001u : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes rtu_frame(const Bytes& unit_and_pdu) {
  Bytes frame = unit_and_pdu;
  const std::uint16_t crc = crc_of(frame.data(), frame.size());
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

SerialDevice::SerialDevice() {
  far_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  char name[64] = "";
  if (far_ < 0 || ::grantpt(far_) != 0 || ::unlockpt(far_) != 0 || ::ptsname_r(far_, name, sizeof name) != 0) throw std::runtime_error("no pseudo-terminal");
  path_ = name;
  termios raw{};
  ::tcgetattr(far_, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(far_, TCSANOW, &raw);
  thread_ = std::thread([this] { serve(); });
}

SerialDevice::~SerialDevice() {
  stopping_ = true;
  thread_.join();
  if (far_ >= 0) ::close(far_);
}

void SerialDevice::vanish() {
  stopping_ = true;
  thread_.join();
  ::close(far_);
  far_ = -1;
  thread_ = std::thread([] {});
}

void SerialDevice::set_fault(Fault fault) {
  const std::lock_guard lock(mutex_);
  fault_ = std::move(fault);
}

void SerialDevice::set_silent(const std::set<unsigned>& units) {
  const std::lock_guard lock(mutex_);
  silent_ = units;
}

void SerialDevice::put(const Bytes& bytes) {
  send(bytes, 0);
}

void SerialDevice::send(const Bytes& bytes, unsigned drip_ms) {
  for (std::size_t at = 0; at < bytes.size() && !stopping_;) {
    const ssize_t count = ::write(far_, &bytes[at], drip_ms == 0 ? bytes.size() - at : 1);
    if (count <= 0) return;
    at += static_cast<std::size_t>(count);
    if (drip_ms != 0) std::this_thread::sleep_for(std::chrono::milliseconds(drip_ms));
  }
}

// A frame with a right check sum; false when the device shall end.
bool SerialDevice::take_request(Bytes* request) {
  request->clear();
  while (!stopping_) {
    pollfd wait{far_, POLLIN, 0};
    if (::poll(&wait, 1, 5) <= 0) continue;
    if ((wait.revents & POLLIN) == 0) {  // nobody has opened the line
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    std::uint8_t byte = 0;
    if (::read(far_, &byte, 1) != 1) continue;
    request->push_back(byte);
    const std::size_t size = request_size(*request);
    if (size == 0 || request->size() < size) continue;
    const std::uint16_t crc = crc_of(request->data(), size - 2);
    if ((*request)[size - 2] == (crc & 0xFF) && (*request)[size - 1] == crc >> 8) return true;
    ++damaged_;
    request->clear();
  }
  return false;
}

void SerialDevice::serve() {
  Bytes request;
  auto last = steady_clock::time_point{};
  while (take_request(&request)) {
    const auto now = steady_clock::now();
    if (last != steady_clock::time_point{}) shortest_gap_us_ = std::min(shortest_gap_us_.load(), std::chrono::duration<double, std::micro>(now - last).count());
    const unsigned unit = request[0];
    Answer answer;
    answer.bytes = tables_.serial_answer(request);
    {
      const std::lock_guard lock(mutex_);
      if (fault_) answer = fault_(request, answer);
      if (silent_.contains(unit)) answer.bytes.clear();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(answer.delay_ms));
    // The gap is counted from before the answer goes out: taken behind it, a thread that the kernel puts aside between the two would
    // make the gap seem shorter than the one that the other end has kept. Late either way, it seems longer and never shorter.
    last = steady_clock::now();
    send(answer.bytes, answer.drip_ms);
  }
}

}  // namespace nc::test
