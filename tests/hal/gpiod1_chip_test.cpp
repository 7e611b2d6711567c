// SPDX-License-Identifier: Apache-2.0
// The calls of libgpiod 1.6, tested with a stand-in for that library (gpiod_stand_in.hpp).
#include <gpiod.h>
#include <gtest/gtest.h>

#include "gpiod_stand_in.hpp"
#include "hal/gpio/line_chip.hpp"

namespace {

using nc::hal::gpio::Bias;
using nc::hal::gpio::Drive;
using nc::hal::gpio::LineChip;
using nc::hal::gpio::LineSetup;
using nc::hal::gpio::Opening;
using nc::test::stand_in;
using nc::test::StandIn;
using nc::test::StandInLine;

// Chips "gpiochip0" and "gpiochip1", each with 100 lines L0 to L99, of which L50 has no name.
class Gpiod1Chip : public testing::Test {
 protected:
  Gpiod1Chip() {
    stand_in() = StandIn{};
    for (const char* label : {"expander", "soc"}) stand_in().chips.push_back({"gpiochip" + std::to_string(stand_in().chips.size()), label, std::vector<StandInLine>(100), false});
    for (auto& each : stand_in().chips)
      for (unsigned i = 0; i < 100; ++i) each.lines[i].name = i == 50 ? "" : "L" + std::to_string(i);
  }
  ~Gpiod1Chip() override {
    chip.reset();
    EXPECT_EQ(stand_in().open, 0) << "a chip is left open";
    for (const auto& each : stand_in().chips)
      for (const StandInLine& line : each.lines) EXPECT_EQ(line.request, 0u) << "a line is left requested";
  }
  void input(const std::string& name) { lines.push_back({.name = name}); }
  void output(const std::string& name, std::uint8_t value) {
    lines.push_back({.name = name, .output = true});
    values.resize(lines.size() - 1);
    values.push_back(value);
  }
  Opening request(const std::string& name = "soc") {
    values.resize(lines.size());
    return chip->request(name, "mill", lines, values, &error);
  }
  StandInLine& line(unsigned i, unsigned of_chip = 1) { return stand_in().chips[of_chip].lines[i]; }

  std::unique_ptr<LineChip> chip = nc::hal::gpio::make_gpiod_chip();
  std::vector<LineSetup> lines;
  std::vector<std::uint8_t> values;
  std::string error;
};

TEST_F(Gpiod1Chip, AChipHasALabelANameAndAPath) {
  input("L3");
  for (const char* name : {"soc", "gpiochip1", "/dev/gpiochip1"}) {
    ASSERT_EQ(request(name), Opening::kOpen) << error;
    EXPECT_EQ(stand_in().open, 1) << name;
    EXPECT_EQ(line(3).consumer, "mill");
    EXPECT_EQ(line(3, 0).request, 0u);
    chip->release();
  }
}

TEST_F(Gpiod1Chip, SettingsBecomeFlagsAndLinesOfOneKindOneRequest) {
  lines = {{.name = "L1", .active_low = true, .bias = Bias::kPullUp},
           {.name = "L2"},
           {.name = "", .offset = 50},
           {.name = "L4", .active_low = true, .bias = Bias::kPullUp},
           {.name = "L5", .bias = Bias::kNone},
           {.name = "L6", .bias = Bias::kPullDown},
           {.name = "L7", .output = true},
           {.name = "L8", .output = true, .drive = Drive::kOpenDrain},
           {.name = "L9", .output = true, .drive = Drive::kOpenSource},
           {.name = "L10", .output = true}};
  values = {0, 0, 0, 0, 0, 0, 1, 0, 1, 0};
  ASSERT_EQ(request(), Opening::kOpen) << error;
  EXPECT_EQ(stand_in().requests, 7u);
  EXPECT_EQ(line(1).flags, GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP);
  EXPECT_EQ(line(4).request, line(1).request);
  EXPECT_EQ(line(2).flags, 0);
  EXPECT_EQ(line(50).request, line(2).request);
  EXPECT_EQ(line(5).flags, GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE);
  EXPECT_EQ(line(6).flags, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN);
  EXPECT_EQ(line(8).flags, GPIOD_LINE_REQUEST_FLAG_OPEN_DRAIN);
  EXPECT_EQ(line(9).flags, GPIOD_LINE_REQUEST_FLAG_OPEN_SOURCE);
  EXPECT_EQ(line(10).request, line(7).request);
  EXPECT_TRUE(line(7).output && !line(2).output);
  EXPECT_EQ(line(7).level, 1);
  EXPECT_EQ(line(8).level, 0);
  EXPECT_EQ(line(9).level, 1);
}

TEST_F(Gpiod1Chip, ValuesComeAndGoAtThePlacesOfTheirLines) {
  input("L1");
  output("L2", 0);
  input("L3");
  output("L4", 1);
  ASSERT_EQ(request(), Opening::kOpen) << error;
  line(3).level = 1;
  std::vector<std::uint8_t> read = {9, 9, 9, 9};
  ASSERT_TRUE(chip->read(&read, &error)) << error;
  EXPECT_EQ(read, (std::vector<std::uint8_t>{0, 9, 1, 9}));
  ASSERT_TRUE(chip->write(std::vector<std::uint8_t>{0, 1, 0, 0}, &error)) << error;
  EXPECT_EQ(line(2).level, 1);
  EXPECT_EQ(line(4).level, 0);
  EXPECT_EQ(stand_in().reads + stand_in().writes, 2u);
}

TEST_F(Gpiod1Chip, MoreThan64LinesAreTwoRequests) {
  for (unsigned i = 0; i < 100; ++i)
    if (i != 50) input("L" + std::to_string(i));
  ASSERT_EQ(request(), Opening::kOpen) << error;
  EXPECT_EQ(stand_in().requests, 2u);
  line(0).level = line(99).level = 1;
  std::vector<std::uint8_t> read(lines.size());
  ASSERT_TRUE(chip->read(&read, &error)) << error;
  EXPECT_EQ(read.front() + read.back(), 2);
  EXPECT_EQ(stand_in().reads, 2u);
}

TEST_F(Gpiod1Chip, ALineOfAnotherIsNamedWithItsOwnerAndNothingIsHeld) {
  output("L1", 1);
  input("L2");
  line(2).owner = "gpio-keys";
  EXPECT_EQ(request(), Opening::kTaken);
  EXPECT_EQ(error, "line L2 of chip \"soc\" is taken by \"gpio-keys\"");
  EXPECT_EQ(stand_in().requests, 0u);
}

TEST_F(Gpiod1Chip, ARequestThatFailsInTheMiddleGivesBackWhatItHad) {
  input("L1");
  output("L2", 0);
  stand_in().request_error = EINVAL;
  stand_in().requests_before = 1;
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(stand_in().requests, 1u);
  EXPECT_EQ(line(1).request, 0u);
  EXPECT_EQ(error, "line L2 of chip \"soc\" cannot be had with its direction, bias and drive: Invalid argument");
  stand_in().requests_before = 0;
  stand_in().request_error = EBUSY;
  EXPECT_EQ(request(), Opening::kTaken);
  EXPECT_EQ(error, "line L1 of chip \"soc\" is taken by another");
  EXPECT_EQ(stand_in().open, 0);
  stand_in().request_error = ENODEV;
  EXPECT_EQ(request(), Opening::kNoChip);
  stand_in().request_error = 0;
  EXPECT_EQ(request(), Opening::kOpen) << error;
}

TEST_F(Gpiod1Chip, WhatIsNotThereIsSaid) {
  input("L1");
  EXPECT_EQ(request("socket"), Opening::kNoChip);
  EXPECT_EQ(error, "there is no chip \"socket\"");
  stand_in().open_error = EACCES;
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "chip \"soc\" cannot be opened: Permission denied");
  stand_in().open_error = 0;
  lines = {{.name = "L100"}};
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "chip \"soc\" has no line L100 (it has 100 lines)");
  lines = {{.name = "", .offset = 100}};
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "chip \"soc\" has no line 100 (it has 100 lines)");
}

TEST_F(Gpiod1Chip, AChipIsFoundByItsLabelBesideOneThatThisUserMayNotOpen) {
  input("L1");
  stand_in().chips[0].open_error = EACCES;
  EXPECT_EQ(request(), Opening::kOpen) << error;
  chip->release();
  stand_in().chips[1].open_error = EACCES;
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "chip \"soc\" cannot be opened: Permission denied");
}

TEST_F(Gpiod1Chip, WhatIsThereTwiceIsRefused) {
  lines = {{.name = "L7"}, {.name = "", .offset = 7}};
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "lines L7 and 7 of chip \"soc\" are the same");
  lines = {{.name = "L7"}};
  line(8).name = "L7";
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "2 lines of chip \"soc\" have the name \"L7\": take the offset of one");
  line(8).name = "L8";
  stand_in().chips[0].label = "soc";
  EXPECT_EQ(request(), Opening::kRefused);
  EXPECT_EQ(error, "2 chips have the label \"soc\": take the path of one");
}

TEST_F(Gpiod1Chip, AChipThatIsPulledOutFailsInItsWords) {
  input("L1");
  output("L2", 0);
  ASSERT_EQ(request(), Opening::kOpen) << error;
  stand_in().chips[1].gone = true;
  std::vector<std::uint8_t> read(2);
  EXPECT_FALSE(chip->read(&read, &error));
  EXPECT_EQ(error, "chip \"soc\" cannot be read: No such device");
  EXPECT_FALSE(chip->write(read, &error));
  EXPECT_EQ(error, "chip \"soc\" cannot be written: No such device");
}

TEST_F(Gpiod1Chip, EdgesComeWithTheirLinesKindsAndTimes) {
  lines = {{.name = "L1"}, {.name = "L2", .edges = true}, {.name = "L3", .edges = true}};
  ASSERT_EQ(request(), Opening::kOpen) << error;
  EXPECT_EQ(stand_in().requests, 2u);
  EXPECT_TRUE(line(2).edges && line(3).edges && !line(1).edges);
  std::vector<nc::hal::gpio::LineEdge> edges;
  ASSERT_TRUE(chip->edges(&edges, &error)) << error;
  EXPECT_TRUE(edges.empty());
  line(3).kept = {{true, 5, 7}, {false, 6, 0}};
  ASSERT_TRUE(chip->edges(&edges, &error)) << error;
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[0].line, 2u);
  EXPECT_TRUE(edges[0].rising && !edges[1].rising);
  EXPECT_EQ(edges[0].time_ns, 5'000'000'007);
  EXPECT_EQ(edges[1].time_ns, 6'000'000'000);
  line(3).level = 1;
  std::vector<std::uint8_t> read(3);
  ASSERT_TRUE(chip->read(&read, &error)) << error;
  EXPECT_EQ(read[2], 1);
  stand_in().chips[1].gone = true;
  EXPECT_FALSE(chip->edges(&edges, &error));
  EXPECT_EQ(error, "chip \"soc\" cannot be asked for edges: No such device");
}

TEST_F(Gpiod1Chip, ALineWithoutAnInterruptIsRefusedForItsEdges) {
  lines = {{.name = "L2", .edges = true}};
  for (const int problem : {ENXIO, ENODEV}) {
    stand_in().request_error = problem;
    EXPECT_EQ(request(), Opening::kRefused);
    EXPECT_EQ(error.find("line L2 of chip \"soc\" gives no edges: "), 0u) << error;
  }
}

}  // namespace
