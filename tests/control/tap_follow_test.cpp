// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1) with a spindle as it really turns: the axis follows its angle.
#include <gtest/gtest.h>

#include "tap_helpers.hpp"

namespace nc::test {
namespace {

INSTANTIATE_TEST_SUITE_P(BothLaws, RealTap, testing::Bool(), name_of_law);

// The axis is where the spindle is, but for what the lag changes in one cycle, and at the bottom the spindle has turned as far as commanded to a quarter
// of a turn.
TEST_P(RealTap, TheAxisFollowsTheAngleThatTheSpindleHas) {
  for (const double hand : {1.0, -1.0}) {
    start(std::string(hand > 0 ? "G84" : "G74") + " Z-8. R2. S600 F1.5 P200 ,R1");
    double worst = 0, behind = 0, deepest = 0, lowest = 10;
    ASSERT_TRUE(until([&] {
      if ((drive->out.spindle_synchronous & 1) != 0 && drive->out.tapping) {
        worst = std::max(worst, std::fabs(2 - z() - hand * kLead * spindle.since_taken()));
        behind = std::max(behind, std::fabs(drive->out.spindle_turns - spindle.since_taken()));
        deepest = std::max(deepest, hand * spindle.since_taken());
        lowest = std::min(lowest, z());
      }
      return drive->ended;
    }));
    EXPECT_EQ(drive->alarm(), "");
    // The lag is kLag times the speed, so one cycle changes it by kLag times the acceleration: 1.5 mm x 25 x 0.02 s x 4 ms; and 1 um.
    EXPECT_LT(worst, 1e-3 + kLead * kRamp * kLag * kCycle_s) << "mm";
    EXPECT_GT(behind, 0.1) << "turns: the spindle is a real one";
    EXPECT_NEAR(deepest, 10 / kLead, 0.25) << "turns";
    EXPECT_NEAR(lowest, -8, 0.25 * kLead);
    EXPECT_NEAR(z(), 10, 1e-3) << "behind it the axis comes back to its path";
    for (double seconds = 0; seconds < 0.5; seconds += kCycle_s) step();
    EXPECT_NEAR(z(), 10, 1e-9);
  }
}

// In cuts that go back to R both are at their beginning again, but the thread goes on: the spindle that still turns there is not taken anew.
TEST_P(RealTap, CutsBackToRKeepOneThread) {
  bench.param("1272", "16");
  for (const double stopped_at : {9.0, 0.5, 1.0, 1.3, 1.5, 1.7, 1.9}) {  // on the way back, by an interlock that lasts
    start("G84 Z-4. R2. S600 F1.5 Q2. ,R1");
    double worst = 0;
    unsigned lasts = 0;
    ASSERT_TRUE(until([&] {
      if (drive->out.velocity.v[2] > 0 && drive->out.tapping && z() > stopped_at && z() < 2) ++lasts;
      drive->in.interlock = lasts > 0 && lasts++ < 100;
      if ((drive->out.spindle_synchronous & 1) != 0 && drive->out.tapping && z() < 2 - 1e-3) worst = std::max(worst, std::fabs(2 - z() - kLead * spindle.since_taken()));
      return drive->ended;
    }));
    EXPECT_EQ(drive->alarm(), "");
    EXPECT_LT(worst, 1e-3 + kLead * kRamp * kLag * kCycle_s) << "mm, stopped at " << stopped_at;
  }
}

TEST_P(RealTap, WithoutMeasuredTurnsTheAxisGoesByItsPath) {
  start("G84 Z-8. R2. S600 F1.5 P200 ,R1");
  double worst = 0;
  ASSERT_TRUE(until([&] {
    drive->in.spindle[0].turns_valid = false;
    if ((drive->out.spindle_synchronous & 1) != 0) worst = std::max(worst, std::fabs(2 - z() - kLead * drive->out.spindle_turns));
    return drive->ended;
  }));
  EXPECT_LT(worst, 1e-9);
}

TEST_P(RealTap, TheAxisKeepsItsLimitsAsItFollows) {
  start("G84 Z-8. R2. S600 F1.5 P200 ,R1");
  double last = 0, worst = 0;
  unsigned n = 0;
  ASSERT_TRUE(until([&] {
    const double now = drive->out.velocity.v[2];
    if (n++ > 2) worst = std::max(worst, std::fabs(now - last) / kCycle_s);
    last = now;
    return drive->ended;
  }));
  EXPECT_LE(worst, 1000 * 1.001);
}

// #1172 and ,S of the way back.
TEST_P(RealTap, TheWayBackGoesByTheReturnOverride) {
  const auto fastest_out = [&](const char* percent, const char* words) {
    bench.param("1172", percent);
    start(std::string("G84 Z-8. R2. S300 F1.5 ,R1") + words);
    double most = 0;
    EXPECT_TRUE(until([&] {
      if ((drive->out.spindle_synchronous & 1) != 0) most = std::max(most, -drive->out.spindle_rev_min[0]);
      return drive->ended;
    }));
    return most;
  };
  EXPECT_NEAR(fastest_out("0", ""), 300, 1) << "0 means 100 %";
  EXPECT_NEAR(fastest_out("150", ""), 450, 1);
  EXPECT_NEAR(fastest_out("50", ""), 150, 1);
  EXPECT_NEAR(fastest_out("150", " ,S400"), 400, 1) << "precaution (15): ,S switches it off";
  EXPECT_NEAR(fastest_out("50", " ,S200"), 300, 1) << "(12): not below S";
}

}  // namespace
}  // namespace nc::test
