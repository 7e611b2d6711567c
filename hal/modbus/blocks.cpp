// SPDX-License-Identifier: Apache-2.0
// Merges points into requests. See blocks.hpp.
#include "hal/modbus/blocks.hpp"

#include <algorithm>
#include <tuple>

namespace nc::hal::modbus {
namespace {

unsigned largest(Table table, bool write) {
  if (is_bit_table(table)) return write ? kMaxWriteBits : kMaxReadBits;
  return write ? kMaxWriteRegisters : kMaxReadRegisters;
}

std::vector<Block> merge(const std::vector<PointMap>& points, bool write, unsigned gap) {
  std::vector<unsigned> order;
  for (unsigned i = 0; i < points.size(); ++i)
    if (points[i].output == write) order.push_back(i);
  const auto key = [&](unsigned i) {
    const PointMap& map = points[i];
    return std::tuple(map.unit, map.table, map.address, map.end(), i);
  };
  std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return key(a) < key(b); });
  std::vector<Block> blocks;
  for (const unsigned i : order) {
    const PointMap& map = points[i];
    Block* last = blocks.empty() ? nullptr : &blocks.back();
    const bool joins = last != nullptr && last->unit == map.unit && last->table == map.table && last->holds == map.holds() &&
                       map.address <= last->end() + gap &&
                       std::max(map.end(), last->end()) - last->first <= largest(map.table, write);
    if (!joins) {
      blocks.push_back({map.table, map.unit, write, map.holds(), map.address, 0, {}});
      last = &blocks.back();
    }
    last->count = static_cast<std::uint16_t>(std::max(map.end(), last->end()) - last->first);
    last->maps.push_back(i);
  }
  return blocks;
}

}  // namespace

std::string place_text(const Block& block) {
  std::string text = std::string(table_name(block.table)) + " " + std::to_string(block.first);
  if (block.count > 1) text += ".." + std::to_string(block.end() - 1);
  return text + " unit " + std::to_string(block.unit);
}

std::vector<Block> read_blocks(const std::vector<PointMap>& points, unsigned merge_gap) {
  return merge(points, false, merge_gap);
}

std::vector<Block> write_blocks(const std::vector<PointMap>& points) {
  return merge(points, true, 0);
}

}  // namespace nc::hal::modbus
