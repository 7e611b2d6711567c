// SPDX-License-Identifier: Apache-2.0
// The input script of the simulated machine: what is accepted, what is refused, and when it acts.
#include "hal/sim/input_script.hpp"

#include <gtest/gtest.h>

namespace {

using nc::hal::InputChange;
using nc::hal::PointDirection;
using nc::hal::PointType;

nc::hal::PointTable make_table() {
  nc::hal::PointTable table;
  table.add({"door", PointType::kBit, PointDirection::kInput, 0});
  table.add({"pallet", PointType::kWord, PointDirection::kInput, 0});
  table.add({"lamp", PointType::kBit, PointDirection::kOutput, 0});
  return table;
}

InputChange parse(const std::string& text) {
  const nc::hal::PointTable table = make_table();
  InputChange change;
  std::string error;
  EXPECT_TRUE(nc::hal::parse_input_change(text, table, &change, &error)) << text << ": " << error;
  return change;
}

std::string refuse(const std::string& text) {
  const nc::hal::PointTable table = make_table();
  InputChange change;
  std::string error;
  EXPECT_FALSE(nc::hal::parse_input_change(text, table, &change, &error)) << text;
  return error;
}

TEST(InputScript, ReadsEveryForm) {
  InputChange change = parse("at scan 250: door = 1");
  EXPECT_EQ(change.when, InputChange::When::kScan);
  EXPECT_EQ(change.at, 250u);
  EXPECT_EQ(change.point, 0u);
  EXPECT_EQ(change.value, 1u);
  change = parse("  when line 12 #3: pallet = 4000000000 ");
  EXPECT_EQ(change.when, InputChange::When::kLine);
  EXPECT_EQ(change.count, 3u);
  EXPECT_EQ(change.value, 4000000000u);
  change = parse("when M 50:door=0");
  EXPECT_EQ(change.when, InputChange::When::kM);
  EXPECT_EQ(change.count, 1u);
}

TEST(InputScript, SaysWhatIsWrong) {
  EXPECT_NE(refuse("").find("begins with"), std::string::npos);
  EXPECT_NE(refuse("at line 3: door = 1").find("scan"), std::string::npos);
  EXPECT_NE(refuse("when line: door = 1").find("number"), std::string::npos);
  EXPECT_NE(refuse("when line 3 #0: door = 1").find("#"), std::string::npos);
  EXPECT_NE(refuse("when line 3 door = 1").find("':'"), std::string::npos);
  EXPECT_NE(refuse("when line 3: window = 1").find("window"), std::string::npos);
  EXPECT_NE(refuse("when line 3: lamp = 1").find("output"), std::string::npos);
  EXPECT_NE(refuse("when line 3: door = 2").find("bit"), std::string::npos);
  EXPECT_NE(refuse("when line 3: door = 1 2").find("unexpected"), std::string::npos);
  EXPECT_NE(refuse("when line 3: door = -1").find("value"), std::string::npos);
}

nc_source at_line(std::uint32_t line, std::uint8_t depth = 0) {
  nc_source source{};
  source.line = line;
  source.depth = depth;
  return source;
}

TEST(InputScript, ActsOnceAtItsScan) {
  nc::hal::InputScript script({parse("at scan 3: door = 1")});
  nc::hal::PointImage image;
  script.step(2, at_line(0), false, 0, &image);
  EXPECT_EQ(image.value[0], 0u);
  script.step(3, at_line(0), false, 0, &image);
  EXPECT_EQ(image.value[0], 1u);
  image.value[0] = 0;
  script.step(4, at_line(0), false, 0, &image);
  EXPECT_EQ(image.value[0], 0u);
}

TEST(InputScript, CountsLinesThatComeNotScansThatPass) {
  nc::hal::InputScript script({parse("when line 5 #2: door = 1")});
  nc::hal::PointImage image;
  for (const std::uint32_t line : {4u, 5u, 5u, 5u, 6u}) script.step(1, at_line(line), false, 0, &image);
  EXPECT_EQ(image.value[0], 0u);
  script.step(2, at_line(5), false, 0, &image);
  EXPECT_EQ(image.value[0], 1u);
}

TEST(InputScript, LinesOfSubProgramsAreNotLinesOfTheMainProgram) {
  nc::hal::InputScript script({parse("when line 7: door = 1")});
  nc::hal::PointImage image;
  script.step(1, at_line(7, 1), false, 0, &image);
  EXPECT_EQ(image.value[0], 0u);
  script.step(2, at_line(7), false, 0, &image);
  EXPECT_EQ(image.value[0], 1u);
}

TEST(InputScript, CountsStrobesOfAnMCode) {
  nc::hal::InputScript script({parse("when M 50 #2: pallet = 9")});
  nc::hal::PointImage image;
  script.step(1, at_line(1), true, 50, &image);
  script.step(2, at_line(1), true, 50, &image);  // still the same strobe
  script.step(3, at_line(1), false, 50, &image);
  script.step(4, at_line(1), true, 51, &image);  // another code
  script.step(5, at_line(1), false, 51, &image);
  EXPECT_EQ(image.value[1], 0u);
  script.step(6, at_line(1), true, 50, &image);
  EXPECT_EQ(image.value[1], 9u);
}

}  // namespace
