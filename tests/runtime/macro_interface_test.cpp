// SPDX-License-Identifier: Apache-2.0
// The macro interface image: bits and words are one, outputs are written only when the NC gives them.
#include "runtime/macro_interface.hpp"

#include <gtest/gtest.h>

namespace {

using nc::hal::PointImage;

// Points: 0..31 bits of #1000.., 40 word #1034; 100..131 bits of #1100.., 140 word #1135.
nc::rt::MacroMap map_all() {
  nc::rt::MacroMap map;
  for (int bit = 0; bit < 32; ++bit) {
    map.input_bit[0][static_cast<unsigned>(bit)] = bit;
    map.output_bit[0][static_cast<unsigned>(bit)] = 100 + bit;
  }
  map.input_word[2] = 40;
  map.output_word[3] = 140;
  return map;
}

TEST(MacroInterface, InputsAreGatheredIntoWords) {
  const nc::rt::MacroInterface macro(map_all());
  PointImage points;
  points.value[0] = points.value[31] = points.value[7] = 1;
  points.value[40] = 0xDEADBEEF;
  std::uint32_t input[NC_WORDS] = {1, 2, 3, 4};
  macro.gather(points, input);
  EXPECT_EQ(input[0], 0x80000081u);
  EXPECT_EQ(input[1], 0u);
  EXPECT_EQ(input[2], 0xDEADBEEFu);
  EXPECT_EQ(input[3], 0u);
}

TEST(MacroInterface, OnlyChangedBitsAreWritten) {
  nc::rt::MacroInterface macro(map_all());
  PointImage points;
  points.value[101] = 1;  // set by someone else
  std::uint32_t output[NC_WORDS] = {1, 0, 0, 0};
  macro.distribute(0, output, &points);
  EXPECT_EQ(points.value[100], 1u);
  EXPECT_EQ(points.value[101], 1u) << "bit 1 was 0 before and after: not the program's to write";
  points.value[100] = 0;
  macro.distribute(0, output, &points);
  EXPECT_EQ(points.value[100], 0u) << "nothing changed, nothing written";
  output[0] = 2;
  output[3] = 0x12345678;
  macro.distribute(0, output, &points);
  EXPECT_EQ(points.value[101], 1u);
  EXPECT_EQ(points.value[140], 0x12345678u);
  EXPECT_EQ(macro.output()[0], 2u);
}

TEST(MacroInterface, PartSystemsShareOneImage) {
  nc::rt::MacroInterface macro(map_all());
  PointImage points;
  const std::uint32_t first[NC_WORDS] = {1, 0, 0, 0}, second[NC_WORDS] = {4, 0, 0, 0}, none[NC_WORDS] = {};
  macro.distribute(0, first, &points);
  macro.distribute(1, second, &points);
  EXPECT_EQ(macro.output()[0], 5u) << "system 2 writes its bit, it does not clear the other's";
  EXPECT_EQ(points.value[100], 1u);
  EXPECT_EQ(points.value[102], 1u);
  macro.distribute(0, none, &points);
  EXPECT_EQ(macro.output()[0], 4u);
}

}  // namespace
