// SPDX-License-Identifier: Apache-2.0
// The handle changes the length along the axis of the tool (M700 12.3, "changing the amount"): when it counts, where the new amount acts, and what ends it. The places are
// those of a second writing of the section.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr double kFirst = 50, kSecond = 20;

/// X Y Z A C; the tool lies in the plane of A = 90, C = 90, so that the vector is (L, 0, 0), or stands in Z.
class ToolLengthHandle : public testing::TestWithParam<bool> {
 protected:
  ToolLengthHandle() : machine_(NC_DIALECT_M700, "XYZac", {200, 200, 200, 360, 360}, GetParam(), 40) { machine_.bench.tool(1, kFirst).tool(2, kSecond); }

  void start(const std::string& text, bool single) {
    machine_.start("G90 G94 G1 F3000\n" + text);
    until_stop();
    in().single_block = single;
    if (!single) machine_.press();
  }
  nc_inputs& in() { return machine_.drive->in; }
  const nc_outputs& out() const { return machine_.drive->out; }
  double at(unsigned axis) const { return out().command.v[axis]; }
  double added() const { return out().tool_length_added; }
  /// Turns the handle for one cycle. True: it has counted.
  bool turn(double way) {
    in().tool_length_handle = way;
    machine_.step();
    in().tool_length_handle = 0;
    return !out().tool_length_dropped;
  }
  void until_stop() {
    machine_.step(5);
    for (unsigned n = 0; n < 60000 && out().state == NC_STATE_RUNNING; ++n) machine_.step();
    machine_.step(3);
  }
  void block() {
    machine_.press();
    until_stop();
  }
  void run_on(unsigned line) {
    for (unsigned n = 0; n < 60000 && (out().source.line != line || out().distance_zero); ++n) machine_.step();
  }
  void TearDown() override {
    EXPECT_EQ(machine_.drive->alarm(), "");
    EXPECT_LT(machine_.worst, 1.001) << "axis " << machine_.worst_axis << " line " << machine_.worst_line;
  }

  WatchedMachine machine_;
  double near_ = GetParam() ? 0.0101 : 1e-9;  ///< the optimal mode stops on the rounding of a corner, within the tolerance
};
INSTANTIATE_TEST_SUITE_P(BothLaws, ToolLengthHandle, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(ToolLengthHandle, InABlockStopItMovesNothingAndTheNextBlockHasTheNewAmount) {  // note 2
  start("G43.1 H1 Z0\nX10.\nX20.\nM30", true);
  block();
  EXPECT_NEAR(at(2), kFirst, near_);
  EXPECT_TRUE(turn(0.3));
  EXPECT_TRUE(turn(0.2));
  machine_.step(200);
  EXPECT_NEAR(at(2), kFirst, near_);
  EXPECT_NEAR(added(), 0.5, 1e-9);
  block();
  EXPECT_NEAR(at(0), 10, near_);
  EXPECT_NEAR(at(2), kFirst + 0.5, near_);
  EXPECT_TRUE(turn(-1));
  block();
  EXPECT_NEAR(at(2), kFirst - 0.5, near_);
  EXPECT_NEAR(added(), -0.5, near_);
}

// The block of M00 has its end behind the stop: it was read with the old amount.
TEST_P(ToolLengthHandle, InAStopOfM00Too) {
  start("G43.1 H1 Z0\nM0\nX10.\nX20.\nM30", false);
  until_stop();
  EXPECT_EQ(out().state, NC_STATE_STOPPED);
  EXPECT_TRUE(turn(0.5));
  machine_.press();
  for (unsigned n = 0; n < 60000 && out().state == NC_STATE_RUNNING; ++n) {
    machine_.step();
    if (out().source.line < 6) {
      EXPECT_EQ(added(), 0.5) << "line " << out().source.line;
    }
  }
  EXPECT_NEAR(at(2), kFirst + 0.5, near_);
}

TEST_P(ToolLengthHandle, WhileItCutsTheBlockGoesOnAndTheNextOneHasTheNewAmount) {
  start("G43.1 H1 Z0\nX10.\nX20.\nG4 X0.1\nM30", false);
  run_on(3);
  EXPECT_TRUE(turn(0.25));
  run_on(4);
  EXPECT_NEAR(at(2), kFirst, 0.02);  // the block that was cut has its old end
  until_stop();
  EXPECT_NEAR(at(0), 20, near_);
  EXPECT_NEAR(at(2), kFirst + 0.25, near_);
}

TEST_P(ToolLengthHandle, InAFeedHoldToo) {
  start("G43.1 H1 Z0\nX10.\nX20.\nM30", false);
  run_on(3);
  in().feed_hold = true;
  machine_.step(300);
  EXPECT_EQ(out().state, NC_STATE_HOLD);
  EXPECT_TRUE(turn(0.25));
  machine_.step(50);
  EXPECT_NEAR(at(2), kFirst, near_);
  in().feed_hold = false;
  machine_.press();
  run_on(4);
  EXPECT_NEAR(at(2), kFirst, 0.02);
  until_stop();
  EXPECT_NEAR(at(2), kFirst + 0.25, near_);
}

TEST_P(ToolLengthHandle, ItCountsOnlyWhereTheSectionSaysSo) {  // (1)
  start("X1.\nG43.1 H1 Z0\nG0 X100.\nG49\nX3.\nM30", true);
  EXPECT_FALSE(turn(0.1));  // before G43.1
  block();
  EXPECT_FALSE(turn(0.1));
  block();
  EXPECT_TRUE(turn(0.1));
  machine_.press();
  run_on(4);
  EXPECT_FALSE(turn(0.1));  // rapid traverse
  until_stop();
  EXPECT_NEAR(added(), 0.1, near_);
  block();
  EXPECT_NEAR(at(2), 0, near_);
  EXPECT_FALSE(turn(0.1));  // behind G49
  EXPECT_EQ(added(), 0);
}

TEST_P(ToolLengthHandle, AnotherNumberEndsTheChangeAndTheSameOneDoesNot) {  // (2), note 3
  start("G43.1 H1 Z0\nX10.\nH1 X11.\nG43.1 H1 X12.\nH2 X13.\nH1 X14.\nX15.\nG49 X16.\nG43.1 H1 X17.\nM30", true);
  block();
  EXPECT_TRUE(turn(1));
  for (int n = 0; n < 3; ++n) {
    block();
    EXPECT_NEAR(at(2), kFirst + 1, near_);
  }
  block();
  EXPECT_NEAR(at(2), kSecond, near_);
  block();
  EXPECT_NEAR(at(2), kFirst, near_);
  EXPECT_TRUE(turn(2));
  block();
  EXPECT_NEAR(at(2), kFirst + 2, near_);
  block();
  EXPECT_NEAR(at(2), 0, near_);
  block();
  EXPECT_NEAR(at(2), kFirst, near_);
}

TEST_P(ToolLengthHandle, WhatWasTurnedForANumberIsNoneOfTheNext) {
  start("G43.1 H1 Z0\nX10. H2\nX20.\nM30", false);
  run_on(3);
  EXPECT_TRUE(turn(1));
  until_stop();
  EXPECT_NEAR(at(0), 20, near_);
  EXPECT_NEAR(at(2), kSecond, near_);
}

TEST_P(ToolLengthHandle, AResetEndsItAndTheTableHasItsOldAmount) {  // note 3
  start("G43.1 H1 Z0\nX10.\nM30", true);
  block();
  EXPECT_TRUE(turn(1));
  block();
  EXPECT_NEAR(at(2), kFirst + 1, near_);
  in().reset = true;
  EXPECT_FALSE(turn(1));
  machine_.step(20);
  in().reset = false;
  machine_.step(20);
  EXPECT_EQ(added(), 0);
  EXPECT_FALSE(turn(1));
  double kept = 0;
  ASSERT_EQ(nc_tool_offset_get(machine_.bench.control(), 1, NC_TOOL_LENGTH, &kept), NC_OK);
  EXPECT_EQ(kept, kFirst);
  machine_.press();
  until_stop();
  block();
  EXPECT_NEAR(at(2), kFirst, near_);
}

TEST_P(ToolLengthHandle, ItGoesAlongTheAxisOfTheTool) {
  start("A30. C40.\nG43.1 H1 X0 Y0 Z0\nX10.\nM30", true);
  block();
  block();
  EXPECT_TRUE(turn(4));
  block();
  const double a = 30 * std::acos(-1.0) / 180, c = 40 * std::acos(-1.0) / 180, l = kFirst + 4;
  EXPECT_NEAR(at(0), 10 + l * std::sin(a) * std::sin(c), near_);
  EXPECT_NEAR(at(1), -l * std::sin(a) * std::cos(c), near_);
  EXPECT_NEAR(at(2), l * std::cos(a), near_);
}

// The ends of an arc with two amounts would lie on no circle (P70).
TEST_P(ToolLengthHandle, InFrontOfAnArcItGoesToTheNewVectorFirst) {
  start("A90. C90.\nG43.1 H1 X0 Y-10. Z0\nG3 X0 Y10. I0 J10.\nG1 X1.\nM30", true);
  block();
  block();
  EXPECT_NEAR(at(0), kFirst, near_);
  EXPECT_TRUE(turn(0.5));
  block();
  EXPECT_NEAR(at(0), kFirst + 0.5, near_);
  EXPECT_NEAR(at(1), 10, near_);
  block();
  EXPECT_NEAR(at(0), kFirst + 1.5, near_);
}

TEST_P(ToolLengthHandle, WhileItCutsTooInFrontOfAnArc) {
  start("A90. C90.\nG43.1 H1 X0 Y-30. Z0\nY-10.\nG3 X0 Y10. I0 J10.\nG4 X0.1\nM30", false);
  run_on(4);
  EXPECT_TRUE(turn(0.5));
  until_stop();
  EXPECT_NEAR(at(0), kFirst + 0.5, near_);
  EXPECT_NEAR(at(1), 10, near_);
}

TEST_P(ToolLengthHandle, AnAmountOutOfTheRangeOfAnOffsetAndNoNumberAreRefused) {
  start("G43.1 H1 Z0\nX10.\nX20.\nM30", true);
  block();
  EXPECT_FALSE(turn(std::numeric_limits<double>::quiet_NaN()) && (out().inputs_refused & NC_INPUT_TOOL_LENGTH) == 0);
  EXPECT_FALSE(turn(std::numeric_limits<double>::infinity()) && (out().inputs_refused & NC_INPUT_TOOL_LENGTH) == 0);
  EXPECT_FALSE(turn(2e6) && (out().inputs_refused & NC_INPUT_TOOL_LENGTH) == 0);
  EXPECT_EQ(added(), 0);
  EXPECT_TRUE(turn(999999));
  bool dropped = false;
  machine_.press();
  for (unsigned n = 0; n < 60000 && out().state == NC_STATE_RUNNING; ++n) {
    machine_.step();
    dropped = dropped || out().tool_length_dropped;
  }
  machine_.step(3);
  EXPECT_NEAR(at(2), kFirst, near_);
  EXPECT_EQ(added(), 0);
}

}  // namespace
}  // namespace nc::test
