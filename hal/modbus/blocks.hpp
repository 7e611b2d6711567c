// SPDX-License-Identifier: Apache-2.0
// Points merged into the requests that carry them.
#pragma once

#include <string>
#include <vector>

#include "hal/modbus/map.hpp"

namespace nc::hal::modbus {

// What one request may carry. Modbus application protocol V1.1b3, 6.1 to 6.4, 6.11, 6.12.
constexpr unsigned kMaxReadRegisters = 125, kMaxReadBits = 2000;
constexpr unsigned kMaxWriteRegisters = 123, kMaxWriteBits = 1968;

struct Block {
  Table table = Table::kHolding;
  std::uint8_t unit = 1;
  bool write = false;
  bool holds = false;  // outputs that nothing is written to at the end, PointMap::holds()
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  std::vector<unsigned> maps;  // indices into the points of the link

  unsigned end() const { return first + count; }
};

// "holding 10..13 unit 1"
std::string place_text(const Block& block);

// Inputs, in the order of unit, table, address. A block reads at most `merge_gap` cells in a row that no
// point has; a 32-bit value is never split.
std::vector<Block> read_blocks(const std::vector<PointMap>& points, unsigned merge_gap);

// Outputs. Only neighbours share a block: a cell that is not configured is never written. Those that hold have blocks of their own.
std::vector<Block> write_blocks(const std::vector<PointMap>& points);

}  // namespace nc::hal::modbus
