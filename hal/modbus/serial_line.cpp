// SPDX-License-Identifier: Apache-2.0
// Rates of a serial line. See serial_line.hpp.
#include "hal/modbus/serial_line.hpp"

#include <termios.h>

#include <algorithm>
#include <iterator>

namespace nc::hal::modbus {
namespace {

constexpr speed_t kSpeeds[] = {B1200, B2400, B4800, B9600, B19200, B38400, B57600, B115200, B230400, B460800, B921600};
static_assert(std::size(kSpeeds) == std::size(kRates));

}  // namespace

bool has_rate(int fd, unsigned baud) {
  termios settings{};
  const auto* const rate = std::find(std::begin(kRates), std::end(kRates), baud);
  if (rate == std::end(kRates) || tcgetattr(fd, &settings) != 0) return false;
  const speed_t speed = kSpeeds[rate - std::begin(kRates)];
  return cfgetospeed(&settings) == speed && cfgetispeed(&settings) == speed;
}

}  // namespace nc::hal::modbus
