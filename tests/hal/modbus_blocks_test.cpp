// SPDX-License-Identifier: Apache-2.0
// The merging of Modbus points into requests, compared with a simple list of cells.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "hal/modbus/blocks.hpp"

namespace {

using namespace nc::hal::modbus;
using Cell = std::tuple<unsigned, Table, unsigned>;  // unit, table, address

PointMap at(unsigned address, Format format = Format::kU16, bool output = false) {
  PointMap map;
  map.address = static_cast<std::uint16_t>(address);
  map.format = format;
  map.output = output;
  return map;
}

TEST(ModbusBlocks, GapsAreBridgedOnlyWhenAllowed) {
  const std::vector<PointMap> points{at(10), at(13), at(11)};
  EXPECT_EQ(read_blocks(points, 0).size(), 2u);
  EXPECT_EQ(read_blocks(points, 1).size(), 1u);
  EXPECT_EQ(read_blocks(points, 1)[0].count, 4u);
}

TEST(ModbusBlocks, OutputsNeverCoverWhatIsNotTheirs) {
  const std::vector<PointMap> points{at(10, Format::kU16, true), at(12, Format::kU16, true),
                                     at(13, Format::kU32, true)};
  const auto blocks = write_blocks(points);
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[1].first, 12u);
  EXPECT_EQ(blocks[1].count, 3u);
}

TEST(ModbusBlocks, LimitsOfTheProtocol) {
  std::vector<PointMap> registers, coils;
  for (unsigned i = 0; i < 300; ++i) registers.push_back(at(i));
  for (unsigned i = 0; i < 4100; ++i) {
    coils.push_back(at(i, Format::kBit));
    coils.back().table = Table::kCoil;
  }
  EXPECT_EQ(read_blocks(registers, 0).size(), 3u);
  EXPECT_EQ(read_blocks(registers, 0)[0].count, kMaxReadRegisters);
  EXPECT_EQ(read_blocks(coils, 0).size(), 3u);
  for (PointMap& map : registers) map.output = true;
  for (PointMap& map : coils) map.output = true;
  EXPECT_EQ(write_blocks(registers)[0].count, kMaxWriteRegisters);
  EXPECT_EQ(write_blocks(coils)[0].count, kMaxWriteBits);
  EXPECT_TRUE(read_blocks(registers, 0).empty()) << "outputs are not read";
}

TEST(ModbusBlocks, AWideValueIsNotSplitAtTheLimit) {
  std::vector<PointMap> points;
  for (unsigned i = 0; i < 124; ++i) points.push_back(at(i));
  points.push_back(at(124, Format::kU32));
  const auto blocks = read_blocks(points, 0);
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].count, 124u);
  EXPECT_EQ(blocks[1].first, 124u);
  EXPECT_EQ(blocks[1].count, 2u);
}

TEST(ModbusBlocks, TheLastRegisterOfATable) {
  const auto blocks = read_blocks({at(65534, Format::kU32), at(65535)}, 5);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].end(), 65536u);
}

std::vector<PointMap> any_points() {
  const unsigned space = *rc::gen::element(40u, 400u, 65536u);  // dense, loose, far apart
  const unsigned count = *rc::gen::inRange(0u, 200u);
  std::vector<PointMap> points;
  for (unsigned i = 0; i < count; ++i) {
    PointMap map;
    map.output = *rc::gen::arbitrary<bool>();
    map.table = map.output
                    ? *rc::gen::element(Table::kCoil, Table::kHolding)
                    : *rc::gen::element(Table::kCoil, Table::kDiscrete, Table::kInput, Table::kHolding);
    map.unit = *rc::gen::element<std::uint8_t>(1, 2);
    map.format =
        is_bit_table(map.table) ? Format::kBit : *rc::gen::element(Format::kBit, Format::kU16, Format::kU32);
    map.address = static_cast<std::uint16_t>(*rc::gen::inRange(0u, space - (map.width() - 1)));
    points.push_back(map);
  }
  return points;
}

RC_GTEST_PROP(ModbusBlocks, CarryEveryPointOnceAndNoMoreThanAllowed, ()) {
  const std::vector<PointMap> points = any_points();
  const unsigned gap = *rc::gen::element(0u, 1u, 7u, 124u);
  std::set<Cell> wanted[2];
  for (const PointMap& map : points)
    for (unsigned a = map.address; a < map.end(); ++a) wanted[map.output].insert({map.unit, map.table, a});
  for (const bool write : {false, true}) {
    std::map<unsigned, unsigned> carried;
    for (const Block& block : write ? write_blocks(points) : read_blocks(points, gap)) {
      const unsigned limit = is_bit_table(block.table) ? (write ? 1968u : 2000u) : (write ? 123u : 125u);
      RC_ASSERT(block.write == write);
      RC_ASSERT(block.count >= 1u && block.count <= limit);
      RC_ASSERT(block.end() <= 65536u);
      unsigned strangers = 0;  // cells in succession that belong to no point
      for (unsigned a = block.first; a < block.end(); ++a) {
        strangers = wanted[write].contains({block.unit, block.table, a}) ? 0 : strangers + 1;
        RC_ASSERT(strangers <= (write ? 0 : gap));
      }
      RC_ASSERT(strangers == 0u);
      for (const unsigned i : block.maps) {
        ++carried[i];
        RC_ASSERT(points[i].output == write && points[i].unit == block.unit &&
                  points[i].table == block.table);
        RC_ASSERT(points[i].address >= block.first && points[i].end() <= block.end());
      }
    }
    for (unsigned i = 0; i < points.size(); ++i)
      RC_ASSERT(carried[i] == (points[i].output == write ? 1u : 0u));
  }
}

// There are no more requests than if the sorted cells are divided only where it is necessary.
RC_GTEST_PROP(ModbusBlocks, AreAsFewAsANaiveWalkMakes, ()) {
  std::vector<PointMap> points = any_points();
  for (PointMap& map : points) {
    map.output = false;
    map.table = Table::kInput;
    map.format = Format::kU16;
    map.unit = 1;
  }
  const unsigned gap = *rc::gen::element(0u, 3u);
  std::set<unsigned> cells;
  for (const PointMap& map : points) cells.insert(map.address);
  unsigned requests = 0, first = 0, last = 0;
  for (const unsigned cell : cells) {
    const bool joins = requests > 0 && cell - last <= gap + 1 && cell - first < kMaxReadRegisters;
    if (!joins) {
      ++requests;
      first = cell;
    }
    last = cell;
  }
  RC_ASSERT(read_blocks(points, gap).size() == requests);
}

}  // namespace
