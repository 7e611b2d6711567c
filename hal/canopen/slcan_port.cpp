// SPDX-License-Identifier: Apache-2.0
// slcan. See slcan_port.hpp.
#include "hal/canopen/slcan_port.hpp"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace nc::hal::canopen {
namespace {

constexpr char kDigits[] = "0123456789ABCDEF";

int digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

struct Rate {
  unsigned bit_s;
  char letter;
};
constexpr Rate kRates[] = {{10'000, '0'}, {20'000, '1'}, {50'000, '2'}, {100'000, '3'}, {125'000, '4'}, {250'000, '5'}, {500'000, '6'}, {800'000, '7'}, {1'000'000, '8'}};

}  // namespace

std::size_t slcan_text(const CanFrame& frame, char* text) noexcept {
  std::size_t n = 0;
  text[n++] = 't';
  for (int shift = 8; shift >= 0; shift -= 4) text[n++] = kDigits[frame.id >> shift & 15];
  text[n++] = kDigits[frame.length & 15];
  for (unsigned i = 0; i < frame.length; ++i) {
    text[n++] = kDigits[frame.data[i] >> 4];
    text[n++] = kDigits[frame.data[i] & 15];
  }
  text[n++] = '\r';
  return n;
}

// Lines that are not a data frame with an identifier of 11 bits are skipped: answers of the adapter, other frames, garbage.
bool SlcanReader::take(char c, CanFrame* frame) noexcept {
  if (c != '\r' && c != '\a') {
    if (size_ < kLine) line_[size_++] = c;
    else too_long_ = true;
    return false;
  }
  const std::size_t size = size_;
  const bool bad = too_long_ || c == '\a';
  size_ = 0;
  too_long_ = false;
  if (bad || size < 5 || line_[0] != 't') return false;
  unsigned id = 0;
  for (unsigned i = 1; i < 4; ++i) {
    if (digit(line_[i]) < 0) return false;
    id = id << 4 | static_cast<unsigned>(digit(line_[i]));
  }
  const int length = digit(line_[4]);
  // An adapter may add a time stamp of four digits.
  if (id > 0x7FF || length < 0 || length > 8) return false;
  const std::size_t data = 5 + 2 * static_cast<std::size_t>(length);
  if (size != data && size != data + 4) return false;
  *frame = {};
  frame->id = static_cast<std::uint16_t>(id);
  frame->length = static_cast<std::uint8_t>(length);
  for (unsigned i = 0; i < frame->length; ++i) {
    const int high = digit(line_[5 + 2 * i]), low = digit(line_[6 + 2 * i]);
    if (high < 0 || low < 0) return false;
    frame->data[i] = static_cast<std::uint8_t>(high << 4 | low);
  }
  return true;
}

bool SlcanPort::open(std::string* error) {
  close();
  char letter = 0;
  for (const Rate& rate : kRates)
    if (rate.bit_s == bit_s_) letter = rate.letter;
  if (letter == 0) {
    *error = "slcan has no bit rate of " + std::to_string(bit_s_) + " bit/s";
    return false;
  }
  fd_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  termios line{};
  if (fd_ < 0 || tcgetattr(fd_, &line) != 0) {
    *error = device_ + ": " + std::strerror(errno);
    close();
    return false;
  }
  cfmakeraw(&line);
  cfsetspeed(&line, B115200);  // an adapter on USB ignores the speed
  tcsetattr(fd_, TCSANOW, &line);
  const char begin[] = {'C', '\r', 'S', letter, '\r', 'O', '\r'};
  if (write(fd_, begin, sizeof begin) != static_cast<ssize_t>(sizeof begin)) {
    *error = device_ + ": " + std::strerror(errno);
    close();
    return false;
  }
  return true;
}

void SlcanPort::close() noexcept {
  if (fd_ < 0) return;
  const char end[] = {'C', '\r'};
  if (write(fd_, end, sizeof end) < 0) {
    // An error is ignored: the adapter is gone, so there is no channel to close.
  }
  ::close(fd_);
  fd_ = -1;
  at_ = size_ = 0;
}

bool SlcanPort::send(const CanFrame& frame) noexcept {
  char text[32];
  const std::size_t size = slcan_text(frame, text);
  return write(fd_, text, size) == static_cast<ssize_t>(size);
}

bool SlcanPort::receive(CanFrame* frame) noexcept {
  for (;;) {
    while (at_ < size_)
      if (reader_.take(buffer_[at_++], frame)) return true;
    const ssize_t got = read(fd_, buffer_, sizeof buffer_);
    if (got <= 0) return false;
    at_ = 0;
    size_ = static_cast<std::size_t>(got);
  }
}

}  // namespace nc::hal::canopen
