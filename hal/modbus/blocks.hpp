// SPDX-License-Identifier: Apache-2.0
// Merges points into blocks: neighbouring points are read or written by one request.
#pragma once

#include <string>
#include <vector>

#include "hal/modbus/map.hpp"

namespace nc::hal::modbus {

// Limits for one request. Modbus application protocol V1.1b3, 6.1 to 6.4, 6.11, 6.12.
constexpr unsigned kMaxReadRegisters = 125, kMaxReadBits = 2000;
constexpr unsigned kMaxWriteRegisters = 123, kMaxWriteBits = 1968;

struct Block {
  Table table = Table::kHolding;
  std::uint8_t unit = 1;
  bool write = false;
  bool holds = false;  // outputs that are not written at the end (PointMap::holds())
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  std::vector<unsigned> maps;  // indices of its points in LinkConfig::points

  unsigned end() const { return first + count; }
};

// The block as text, such as "holding 10..13 unit 1".
std::string place_text(const Block& block);

// The blocks of the inputs, in the order of unit, table, address. To join two points, a block reads at most `merge_gap` cells in a row that belong
// to no point; a 32-bit value is never split.
std::vector<Block> read_blocks(const std::vector<PointMap>& points, unsigned merge_gap);

// The blocks of the outputs. Only adjoining points share a block, because a cell that is not configured must never be written. Outputs that hold
// (PointMap::holds()) have blocks of their own.
std::vector<Block> write_blocks(const std::vector<PointMap>& points);

}  // namespace nc::hal::modbus
