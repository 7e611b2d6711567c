// SPDX-License-Identifier: Apache-2.0
// A serial line with Modbus RTU partners. See rtu_session.hpp.
#include "hal/modbus/rtu_session.hpp"

#include <fcntl.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

#include "hal/modbus/serial_line.hpp"

namespace nc::hal::modbus {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kPollMs = 50;
constexpr std::size_t kCrc = 2;     // bytes behind the PDU
constexpr std::size_t kHeader = 6;  // of TCP, in front of the unit

// The device is gone: an adapter that was pulled out, a terminal whose other side has ended.
bool is_gone(int error) {
  constexpr int kGone[] = {EIO, EBADF, ENXIO, ENODEV, ECONNRESET, EPIPE, ENOTTY};
  return std::find(std::begin(kGone), std::end(kGone), error) != std::end(kGone);
}

}  // namespace

microseconds frame_gap(const SerialConfig& line) {
  constexpr microseconds kFast{1750};
  if (line.baud > 19200) return kFast;
  return microseconds(static_cast<long>(3.5e6 * line.bits_per_character() / line.baud) + 1);
}

RtuSession::RtuSession(const LinkConfig& config) : Session(config) {
  const SerialConfig& line = config.serial;
  set_up(modbus_new_rtu(line.device.c_str(), static_cast<int>(line.baud), line.parity, 8, static_cast<int>(line.stop_bits)));
}

RtuSession::~RtuSession() {
  RtuSession::close();
}

Result RtuSession::connect() {
  close();
  std::string why;
  if (context_ == nullptr) why = "no memory for it";
  if (context_ == nullptr || !open_line(&why)) {
    error_ = "serial line " + config_.serial.device + ": " + why;
    return Result::kFailed;
  }
  last_byte_ = steady_clock::now();  // whatever was on its way when it was opened is not for us
  silence_ = frame_gap(config_.serial);
  return Result::kOk;
}

bool RtuSession::open_line(std::string* why) {
  if (modbus_connect(context_.get()) != 0) {
    *why = std::strerror(errno);
    return false;
  }
  const int fd = modbus_get_socket(context_.get());
  if (fd >= FD_SETSIZE) {  // select() in libmodbus would write beyond its fd_set
    *why = std::strerror(EMFILE);
  } else if (!has_rate(fd, config_.serial.baud)) {
    *why = "it does not take " + std::to_string(config_.serial.baud) + " bit/s";
  } else if (set_direction(why)) {
    ioctl(fd, TIOCEXCL);  // nobody else opens it by mistake; works without
    if (adopt(fd)) return true;
    *why = std::strerror(ECANCELED);
  }
  modbus_close(context_.get());
  return false;
}

// Who switches an RS-485 transceiver between sending and listening.
bool RtuSession::set_direction(std::string* why) {
  modbus_t* const context = context_.get();
  int result = 0;
  switch (config_.serial.rs485) {
    case Rs485::kNone: break;
    case Rs485::kDriver: result = modbus_rtu_set_serial_mode(context, MODBUS_RTU_RS485); break;
    case Rs485::kRtsHigh: result = modbus_rtu_set_rts(context, MODBUS_RTU_RTS_UP); break;
    case Rs485::kRtsLow: result = modbus_rtu_set_rts(context, MODBUS_RTU_RTS_DOWN); break;
  }
  if (result == 0 && (config_.serial.rs485 == Rs485::kRtsHigh || config_.serial.rs485 == Rs485::kRtsLow))
    result = modbus_rtu_set_rts_delay(context, static_cast<int>(config_.serial.rts_delay_us));
  if (result != 0) *why = std::string("rs485: ") + std::strerror(errno);
  return result == 0;
}

void RtuSession::close() {
  const std::lock_guard lock(mutex_);
  if (fd_ < 0) return;
  modbus_close(context_.get());
  fd_ = -1;
}

// What takes its place ends every wait and every read at once; the read that waits for the next byte now ends with its time.
void RtuSession::abort() {
  const std::lock_guard lock(mutex_);
  aborted_ = true;
  if (fd_ < 0) return;
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing < 0) return;
  dup3(nothing, fd_, O_CLOEXEC);
  ::close(nothing);
}

bool RtuSession::fail(const std::string& why) {
  error_ = "serial line " + config_.serial.device + ": " + why;
  close();
  return false;
}

bool RtuSession::clear_to_send() {
  if (silence_.count() == 0) {
    pollfd wait{fd_, POLLIN, 0};
    if (poll(&wait, 1, 0) == 0) return take_silence(frame_gap(config_.serial));
    silence_ = frame_gap(config_.serial);
    std::array<std::uint8_t, kMaxFrame> bytes;
    const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
    if (count <= 0) return fail(count == 0 ? "the device is gone" : std::strerror(errno));
    last_byte_ = steady_clock::now();
    error_ = "serial line " + config_.serial.device + ": an answer that nobody asked for";
    return false;
  }
  if (!take_silence(silence_)) return false;
  silence_ = microseconds{0};
  return true;
}

// Waits until nothing has been on the line for so long, and throws away what comes. False where it does not become silent, or is gone.
bool RtuSession::take_silence(microseconds silence) {
  const Time end = steady_clock::now() + std::max<microseconds>(milliseconds(2 * (config_.response_timeout_ms + config_.byte_timeout_ms)), 2 * silence);
  for (;;) {
    const Time now = steady_clock::now();
    const auto left = std::chrono::duration_cast<microseconds>(last_byte_ + silence - now);
    if (left.count() <= 0) return true;
    if (now >= end) {
      error_ = "serial line " + config_.serial.device + ": it never is silent: another master, or another rate or parity";
      return false;
    }
    const timespec time{left.count() / 1000000, left.count() % 1000000 * 1000};
    pollfd wait{fd_, POLLIN, 0};
    if (ppoll(&wait, 1, &time, nullptr) <= 0) continue;
    std::array<std::uint8_t, kMaxFrame> bytes;
    const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) return fail(count == 0 ? "the device is gone" : std::strerror(errno));
    if (count > 0) last_byte_ = steady_clock::now();
  }
}

// libmodbus adds the check sum and switches the direction.
int RtuSession::send_all(const Frame& request) {
  std::array<std::uint8_t, kMaxFrame> frame;
  const std::size_t size = request.size - kHeader;
  std::copy_n(request.bytes.begin() + kHeader, size, frame.begin());
  const int sent = modbus_send_raw_request(context_.get(), frame.data(), static_cast<int>(size));
  last_byte_ = steady_clock::now();
  if (sent < 0) return errno;
  return static_cast<std::size_t>(sent) == size + kCrc ? 0 : EAGAIN;
}

// The beginning of an answer is waited for here, in slices, so that abort() is seen: nothing wakes libmodbus while it waits for a line.
int RtuSession::receive(const Frame& request, std::uint8_t* answer) {
  const Time end = steady_clock::now() + milliseconds(config_.response_timeout_ms);
  for (pollfd wait{fd_, POLLIN, 0}; poll(&wait, 1, kPollMs) <= 0;) {
    if (steady_clock::now() < end) continue;
    errno = ETIMEDOUT;
    return -1;
  }
  std::array<std::uint8_t, kMaxFrame> frame{};
  const int size = modbus_receive_confirmation(context_.get(), frame.data());
  last_byte_ = steady_clock::now();
  if (size <= 0) return size;
  if (static_cast<std::size_t>(size) <= kCrc) return 0;
  return static_cast<int>(answer_of_line(request, frame.data(), static_cast<std::size_t>(size) - kCrc, answer));
}

void RtuSession::doubt(int error) {
  if (is_gone(error)) {
    close();
    return;
  }
  const milliseconds late(config_.response_timeout_ms);
  last_byte_ = steady_clock::now();  // the silence begins now
  silence_ = error == ETIMEDOUT ? std::max<microseconds>(late, frame_gap(config_.serial)) : frame_gap(config_.serial);
}

}  // namespace nc::hal::modbus
