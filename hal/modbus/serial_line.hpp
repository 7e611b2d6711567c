// SPDX-License-Identifier: Apache-2.0
// Rates of a serial line.
#pragma once

namespace nc::hal::modbus {

// The rates that libmodbus can set, bit/s; it takes 9600 for any other.
inline constexpr unsigned kRates[] = {1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600};

// Whether an open line goes at this rate in both directions. A driver that cannot may keep the one it had and say nothing.
bool has_rate(int fd, unsigned baud);

}  // namespace nc::hal::modbus
