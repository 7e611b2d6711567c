// SPDX-License-Identifier: Apache-2.0
// Modbus: the description of a link and the places of its points in the tables of the partner, as plain data.
//
// Addresses are those on the wire: 0 to 65535 in each of the four tables. Manuals that count from 1
// ("register 40001") mean address 0 of the holding registers. docs/modbus.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nc::hal::modbus {

enum class Table : std::uint8_t { kCoil, kDiscrete, kInput, kHolding };

// The raw value of a point. kBit: a coil, a discrete input, or one bit of a register.
enum class Format : std::uint8_t { kBit, kU16, kS16, kU32, kS32, kF32 };

// Order of the four bytes of a 32-bit value in two registers, A the most significant one.
enum class WordOrder : std::uint8_t { kAbcd, kCdab, kBadc, kDcba };

// The value of an input while the partner does not answer.
enum class OnLoss : std::uint8_t { kOff, kHold, kValue };

// The value that is written to an output when the control ends properly. kHold: none is written, and the next control goes on with the value that it finds.
enum class OnStop : std::uint8_t { kInitial, kHold, kValue };

constexpr bool is_bit_table(Table table) {
  return table == Table::kCoil || table == Table::kDiscrete;
}
constexpr bool can_be_written(Table table) {
  return table == Table::kCoil || table == Table::kHolding;
}
constexpr const char* table_name(Table table) {
  constexpr const char* kNames[] = {"coil", "discrete", "input", "holding"};
  return kNames[static_cast<unsigned>(table)];
}

struct PointMap {
  unsigned point = 0;  // index in the PointTable
  bool output = false;
  Table table = Table::kHolding;
  std::uint8_t unit = 1;
  std::uint16_t address = 0;
  Format format = Format::kBit;
  std::uint8_t bit = 0;  // number of the bit in a register, for kBit
  WordOrder order = WordOrder::kAbcd;
  double scale = 1, offset = 0;  // point = raw * scale + offset
  OnLoss on_loss = OnLoss::kOff;
  std::uint32_t loss_value = 0;  // for OnLoss::kValue
  std::uint32_t initial = 0;     // initial value of the point, which is also the safe value of an output
  OnStop on_stop = OnStop::kInitial;
  std::uint32_t stop_value = 0;  // for OnStop::kValue

  bool holds() const { return output && on_stop == OnStop::kHold; }
  unsigned width() const { return format >= Format::kU32 ? 2 : 1; }  // coils or registers
  unsigned end() const { return address + width(); }
};

// Who switches an RS-485 transceiver: nobody (a line of its own, or an adapter that does it by itself), the driver of the kernel, or
// libmodbus by the line RTS, which is high or low while it sends.
enum class Rs485 : std::uint8_t { kNone, kDriver, kRtsHigh, kRtsLow };

// A serial line with Modbus RTU. The defaults are those of Modbus over serial line V1.02, 2.5.
struct SerialConfig {
  std::string device;  // "/dev/ttyS1"; empty: the link is TCP
  unsigned baud = 19200;
  char parity = 'E';  // 'N', 'E', 'O'
  unsigned stop_bits = 1;
  Rs485 rs485 = Rs485::kNone;
  unsigned rts_delay_us = 0;  // before and behind what is sent, where RTS switches

  unsigned bits_per_character() const { return 1 + 8 + (parity == 'N' ? 0 : 1) + stop_bits; }
};

struct LinkConfig {
  std::string name;
  SerialConfig serial;  // or
  std::string host;
  std::uint16_t port = 502;
  unsigned poll_ms = 20;               // period of the exchange
  unsigned response_timeout_ms = 500;  // limit for connecting, and from a request to the beginning of its answer
  unsigned byte_timeout_ms = 500;      // limit between two parts of an answer
  unsigned lost_after = 3;             // errors in a row after which the link is lost
  unsigned refresh_ms = 1000;          // outputs are written again after this time, even when they have not changed
  unsigned merge_gap = 0;              // at most so many cells without a point are read between two points
  unsigned backoff_min_ms = 100, backoff_max_ms = 5000;  // pause before the next attempt to connect
  unsigned ok_point = 0;                                 // the input point "<name>.ok"
  std::vector<PointMap> points;

  // "/dev/ttyS1", "localhost port 502"
  std::string partner() const { return serial.device.empty() ? host + " port " + std::to_string(port) : serial.device; }
};

}  // namespace nc::hal::modbus
