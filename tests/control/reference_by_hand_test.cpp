// SPDX-License-Identifier: Apache-2.0
// A reference return by hand ends the compensation of a length: along the axis of the tool (M700 12.3, "compensation amount resetting" (1), "relation with manual reference
// position return"), and of an axis (12.2 (4) (a)). And blocks of MDI one behind the other, between which it may come.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr double kLength = 50;
const double kHalf = kLength * std::sqrt(0.5);  // of the vector at 45 degrees

enum Axis : unsigned { kX, kY, kZ, kB, kA, kC };

/// X Y Z B A C; A and C turn the tool.
class ReferenceByHand : public testing::TestWithParam<bool> {
 protected:
  explicit ReferenceByHand(nc_dialect dialect = NC_DIALECT_M700, const char* names = "XYZbac")
      : machine_(dialect, names, std::vector<double>(std::strlen(names), 300), GetParam(), 40) {
    machine_.bench.tool(1, kLength);
  }

  nc_inputs& in() { return machine_.drive->in; }
  const nc_outputs& out() const { return machine_.drive->out; }
  double at(unsigned axis) const { return out().command.v[axis]; }
  void until_stop() {
    machine_.step(5);
    for (unsigned n = 0; n < 60000 && out().state == NC_STATE_RUNNING; ++n) machine_.step();
    machine_.step(3);
  }
  void block() {
    machine_.press();
    until_stop();
  }
  /// Starts `text`, whose lines stop one by one, and executes `lines` of them.
  void start(const std::string& text, unsigned lines) {
    machine_.start(text);
    until_stop();
    while (--lines > 0) block();
  }
  void hand(unsigned axis, const nc_manual& wish, unsigned cycles = 20000) {
    in().manual[axis] = wish;
    machine_.step(2);
    for (unsigned n = 0; n < cycles && out().state == NC_STATE_MANUAL; ++n) machine_.step();
    in().manual[axis] = {};
    machine_.step(200);
  }
  void return_by_hand(unsigned axis) {
    hand(axis, {NC_MANUAL_REFERENCE, 0, 0});
    EXPECT_NEAR(at(axis), 0, 1e-9);
  }
  void mdi(const std::string& text) {
    ASSERT_EQ(nc_mdi_load(machine_.bench.control(), 0, text.data(), text.size()), NC_OK);
    in().single_block = false;
    machine_.press();
    until_stop();
    EXPECT_EQ(out().state, NC_STATE_IDLE);
  }
  void TearDown() override {
    EXPECT_EQ(machine_.drive->alarm(), "");
    EXPECT_LT(machine_.worst, 1.001) << "axis " << machine_.worst_axis << " line " << machine_.worst_line;
  }

  WatchedMachine machine_;
  double near_ = GetParam() ? 0.0101 : 1e-9;  ///< the optimal mode stops on the rounding of a corner, within the tolerance
};
INSTANTIATE_TEST_SUITE_P(BothLaws, ReferenceByHand, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

const char* const kProgram = "G90 G0 A45.\nG43.1 H1 X0 Y0 Z0\nG1 F3000 Y10.\nG0 Y5.\nZ3.\nM30";

TEST_P(ReferenceByHand, OfAnOrthogonalAxisTheNextMovesGoToUncompensatedPlaces) {  // (3) (a), N5, N6
  start(kProgram, 3);
  EXPECT_NEAR(at(kY), 10 - kHalf, near_);
  EXPECT_NEAR(at(kZ), kHalf, near_);
  return_by_hand(kY);
  const double z = at(kZ);
  block();
  EXPECT_NEAR(at(kY), 5, near_);
  EXPECT_NEAR(at(kZ), z, near_);
  block();
  EXPECT_NEAR(at(kZ), 3, near_);
  EXPECT_NEAR(at(kY), 5, near_);
}

TEST_P(ReferenceByHand, OfARotaryAxisToo) {  // (3) (b)
  start(kProgram, 3);
  return_by_hand(kA);
  block();
  EXPECT_NEAR(at(kY), 5, near_);
  EXPECT_NEAR(at(kZ), kHalf, near_);
  block();
  EXPECT_NEAR(at(kZ), 3, near_);
}

TEST_P(ReferenceByHand, AlsoWhereTheAxisStandsThereAlready) {
  start(kProgram, 3);
  EXPECT_NEAR(at(kX), 0, 1e-9);
  return_by_hand(kX);
  block();
  EXPECT_NEAR(at(kY), 5, near_);
  EXPECT_NEAR(at(kZ), kHalf, near_);
}

TEST_P(ReferenceByHand, AnAxisThatDoesNotTurnTheToolEndsNothing) {
  start("G0 B5.\n" + std::string(kProgram), 4);
  return_by_hand(kB);
  block();
  EXPECT_NEAR(at(kY), 5 - kHalf, near_);
  EXPECT_NEAR(at(kZ), kHalf, near_);
}

TEST_P(ReferenceByHand, AReturnThatIsNotCompletedAndAJogEndNothing) {
  start(kProgram, 3);
  in().manual[kY] = {NC_MANUAL_REFERENCE, 0, 0};
  machine_.step(30);
  EXPECT_NE(at(kY), 0);
  in().manual[kY] = {};
  machine_.step(300);
  hand(kY, {NC_MANUAL_STEP, 0, -at(kY)});
  EXPECT_NEAR(at(kY), 0, 1e-9);
  block();
  EXPECT_NEAR(at(kY), 5 - kHalf, near_);
  EXPECT_NEAR(at(kZ), kHalf, near_);
}

TEST_P(ReferenceByHand, WhatTheHandleHasAddedGoesToo) {
  start(kProgram, 3);
  in().tool_length_handle = 1;
  machine_.step();
  in().tool_length_handle = 0;
  EXPECT_EQ(out().tool_length_added, 1);
  return_by_hand(kZ);
  block();
  EXPECT_EQ(out().tool_length_added, 0);
  EXPECT_NEAR(at(kY), 5, near_);
  EXPECT_NEAR(at(kZ), 0, near_);
  in().tool_length_handle = 1;
  machine_.step();
  EXPECT_TRUE(out().tool_length_dropped);
}

TEST_P(ReferenceByHand, ALengthOfAnAxisEndsWithThatAxisAlone) {  // 12.2 (4) (a)
  for (const bool z : {true, false}) {
    start("G90 G0 G43 H1 Z10.\nX1.\nZ5.\nM30", 2);
    EXPECT_NEAR(at(kZ), 10 + kLength, near_);
    return_by_hand(z ? kZ : kX);
    block();
    EXPECT_NEAR(at(kZ), z ? 5 : 5 + kLength, near_);
    in().single_block = false;
    block();
  }
}

// M700 5.1: the modes of one text of MDI hold in the next, and so does the vector by which the axes stand beside it.
TEST_P(ReferenceByHand, MdiBehindMdiKeepsTheVectorAndTheReturnBetweenThemEndsIt) {
  start("M30", 1);
  mdi("G90 G0 A45. G43.1 H1 X0 Y0 Z0");
  EXPECT_NEAR(at(kZ), kHalf, near_);
  mdi("X10.");
  EXPECT_NEAR(at(kX), 10, near_);
  EXPECT_NEAR(at(kY), -kHalf, near_);
  EXPECT_NEAR(at(kZ), kHalf, near_);
  mdi("G91 Z1.");
  EXPECT_NEAR(at(kY), -kHalf, near_);
  EXPECT_NEAR(at(kZ), kHalf + 1, near_);
  return_by_hand(kY);
  mdi("X5.");
  EXPECT_NEAR(at(kY), 0, near_);
  EXPECT_NEAR(at(kZ), kHalf + 1, near_);
  mdi("G90 Z3. Y2.");
  EXPECT_NEAR(at(kY), 2, near_);
  EXPECT_NEAR(at(kZ), 3, near_);
}

TEST_P(ReferenceByHand, MdiBehindMdiKeepsWhatTheHandleHasAdded) {
  start("M30", 1);
  in().single_block = true;
  const std::string text = "G90 G0 G43.1 H1 X0 Y0 Z0\nX1.";
  ASSERT_EQ(nc_mdi_load(machine_.bench.control(), 0, text.data(), text.size()), NC_OK);
  block();
  in().tool_length_handle = 2;
  machine_.step();
  in().tool_length_handle = 0;
  in().single_block = false;
  block();
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  EXPECT_NEAR(at(kZ), kLength + 2, near_);
  EXPECT_EQ(out().tool_length_added, 2);
  mdi("X3.");
  EXPECT_NEAR(at(kZ), kLength + 2, near_);
  mdi("G49 Z0");
  EXPECT_EQ(out().tool_length_added, 0);
}

/// Another family: HX says nothing of a return by hand.
class ReferenceByHandElsewhere : public ReferenceByHand {
 protected:
  ReferenceByHandElsewhere() : ReferenceByHand(NC_DIALECT_HX, "XYZ") {}
};
INSTANTIATE_TEST_SUITE_P(BothLaws, ReferenceByHandElsewhere, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(ReferenceByHandElsewhere, KeepsItsLength) {
  start("G90 G43 H1 Z10.\nX1.\nZ5.\nM30", 2);
  EXPECT_NEAR(at(kZ), 10 + kLength, near_);
  return_by_hand(kZ);
  block();
  EXPECT_NEAR(at(kZ), 5 + kLength, near_);
}

}  // namespace
}  // namespace nc::test
