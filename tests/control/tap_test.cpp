// SPDX-License-Identifier: Apache-2.0
// Synchronous taps on a control that is driven cycle by cycle (M700 13.1.1, G84), with a spindle that turns as it is told.
#include <gtest/gtest.h>

#include "tap_helpers.hpp"

namespace nc::test {
namespace {

/// The spindle turns as it is told; one that is to follow the path comes to rest first.
class Tap : public TapTest {
 protected:
  void start(const std::string& block) {
    bench.at(0, 0, 10);
    drive = std::make_unique<Drive>(bench, "G0 X0\nS600\nM3\n" + block + "\nG80\nM30");
  }
  void step() override {
    const nc_outputs& out = drive->out;
    const bool follows = (out.spindle_synchronous & 1) != 0;
    if (!follows) {
      speed = out.spindle_rev_min[0] / 60;
      taken = false;
    } else if (!taken) {
      speed = speed > 50.5 * kCycle_s ? speed - 50 * kCycle_s : 0;
      taken = speed == 0;
      taken_at = turns - out.spindle_turns;
    } else {
      speed = (taken_at + out.spindle_turns - turns) / kCycle_s;
    }
    turns += speed * kCycle_s;
    drive->in.spindle[0].rev_per_s = speed;
    drive->in.spindle[0].turns = turns;
    drive->in.spindle[0].turns_valid = true;
    drive->press_start();
    drive->step(50);
  }
  /// Stopped by an interlock: `feed` is what the feeder does meanwhile.
  void stop_in_the_hole(unsigned feed) {
    bench.param("3005", "3000").param("3013", "600").param("3017", "500").param("3037", "1200").param("3041", "2000").param("3045", "60000");
    start("G84 Z-38. R2. F1.5 S600 ,R1");
    ASSERT_TRUE(until([&] { return z() < -15; }));
    drive->in.interlock = true;
    double most = 0, before = drive->out.spindle_rev_min[0] / 60;
    unsigned stands = 0;
    for (unsigned n = 0; n < 2000 && stands < 20; ++n) {
      drive->step(feed);
      const double now = drive->out.spindle_rev_min[0] / 60;
      most = std::max(most, std::fabs(now - before) / kCycle_s);
      before = now;
      stands = now == 0 ? stands + 1 : 0;
    }
    EXPECT_EQ(stands, 20U);
    EXPECT_LT(most, 20.5) << "rev/s^2: 600 r/min in 0.5 s";
    EXPECT_GT(z(), -20) << "before the bottom";
  }
  bool cuts() const { return drive->out.tapping && z() < 1.9 && z() > -7.9; }

  double speed = 10, turns = 0, taken_at = 0;
  bool taken = false;
};

INSTANTIATE_TEST_SUITE_P(BothLaws, Tap, testing::Bool(), name_of_law);

TEST_P(Tap, TheSpindleGoesWithTheAxis) {
  for (const bool left : {false, true}) {
    start(std::string(left ? "G74" : "G84") + " Z-8. R2. S600 F1.5 ,R1 ,S900");
    double worst = 0, deepest = 0, fastest_in = 0, fastest_out = 0;
    ASSERT_TRUE(until([&] {
      if ((drive->out.spindle_synchronous & 1) != 0) {
        const double hand = left ? -1 : 1;
        worst = std::max(worst, std::fabs(2 - z() - hand * kLead * drive->out.spindle_turns));
        deepest = std::max(deepest, hand * drive->out.spindle_turns);
        fastest_in = std::max(fastest_in, hand * drive->out.spindle_rev_min[0]);
        fastest_out = std::max(fastest_out, -hand * drive->out.spindle_rev_min[0]);
      }
      return drive->ended;
    }));
    EXPECT_EQ(drive->alarm(), "");
    EXPECT_LT(worst, 1e-6) << "mm, of the axis beside the angle";
    EXPECT_NEAR(deepest, 10 / kLead, 0.01) << "at the bottom the spindle has turned as far as the command";
    EXPECT_NEAR(fastest_in, 600, 1) << "S";
    EXPECT_NEAR(fastest_out, 900, 1) << ",S";
    EXPECT_EQ(drive->out.spindle_synchronous, 0);
    EXPECT_FALSE(drive->out.tapping);
  }
}

// A hold between two holes: the tap is out of its hole, so its axis moves by hand without its spindle, in the hold and behind a reset in it, also below R.
TEST_P(Tap, InAHoldBetweenHolesTheAxisMovesByHandWithoutTheSpindle) {
  for (const bool reset : {false, true}) {
    SCOPED_TRACE(reset ? "reset" : "return");
    start("G84 X20. Z-8. R2. F1.5 S600 ,R1\nX80.");
    ASSERT_TRUE(until([&] { return drive->out.command.v[0] > 40; }));
    drive->in.feed_hold = true;
    ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_HOLD && drive->out.manual_allowed; }));
    drive->in.feed_hold = false;
    const double stood = z(), turned = drive->out.spindle_turns;
    const auto turns_along = [&](const nc_manual& wish) {
      drive->in.manual[2] = wish;
      double most = 0;
      for (unsigned n = 0; n < 400; ++n) {
        step();
        most = std::max(most, std::fabs(drive->out.spindle_turns - turned));
      }
      drive->in.manual[2] = {};
      step();
      return most;
    };
    EXPECT_EQ(turns_along({NC_MANUAL_STEP, 0, -14}), 0);
    EXPECT_NEAR(z(), stood - 14, 1e-9) << "as deep as in a hole";
    if (reset) {
      drive->in.reset = true;
      ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_IDLE; }));
      drive->in.reset = false;
      step();
      EXPECT_FALSE(drive->out.tap_retract_possible);
      EXPECT_EQ(drive->out.tap_holds, 0u);
      EXPECT_EQ(drive->out.spindle_synchronous, 0);
      (void)turns_along({NC_MANUAL_STEP, 0, 5});
      EXPECT_EQ(drive->out.spindle_synchronous, 0);
      EXPECT_NEAR(z(), stood - 9, 1e-9);
    } else {
      EXPECT_EQ(turns_along({NC_MANUAL_RETURN, 0, 0}), 0);
      EXPECT_EQ(z(), stood);
      drive->in.cycle_start = true;
      drive->step(50);
      drive->in.cycle_start = false;
      ASSERT_TRUE(until([&] { return drive->ended; })) << drive->out.state << " " << drive->out.cause;
    }
    EXPECT_EQ(drive->alarm(), "");
  }
}

TEST_P(Tap, TheSpindleAcceleratesByItsStages) {
  bench.param("3005", "3000").param("3013", "600").param("3017", "500").param("3037", "1200").param("3041", "2000").param("3045", "7500");
  const auto steepest = [&](const char* words) {
    start(std::string("G84 Z-598. R2. F1.5 ,R1 ") + words);
    double most = 0, before = 0;
    EXPECT_TRUE(until([&] {
      const bool follows = (drive->out.spindle_synchronous & 1) != 0;
      const double now = follows ? drive->out.spindle_rev_min[0] / 60 : 0;
      if (follows) most = std::max(most, std::fabs(now - before) / kCycle_s);
      before = now;
      return drive->ended;
    }, 200000));
    return most;
  };
  EXPECT_NEAR(steepest("S600"), 20, 0.5) << "rev/s^2: 600 r/min in 0.5 s";
  EXPECT_NEAR(steepest("S1200"), 5, 0.2) << "600 r/min more in 2 s";
  EXPECT_NEAR(steepest("S1500"), 4, 0.1) << "1800 r/min more in 7.5 s";
  // Precaution (14): a changeover above the highest speed lies at it. Otherwise the second stage were steeper than the first and had its slope, by (13).
  bench.param("3005", "1200").param("3037", "5000");
  EXPECT_NEAR(steepest("S1000"), 5, 0.2) << "600 r/min more, up to the highest speed, in 2 s";
  bench.param("3005", "6000");
  EXPECT_NEAR(steepest("S1000"), 20, 0.5) << "(13)";
  // A stage that the machine does not have leaves the others as they are.
  bench.param("3005", "3000").param("3037", "0");
  EXPECT_NEAR(steepest("S1500"), 5.33, 0.1) << "2400 r/min more in 7.5 s";
}

// A hole that is too short for a speed is not made with the slope of the stage that has it: the higher speed would make it slower.
TEST_P(Tap, AHigherSpeedMakesNoHoleSlower) {
  bench.param("3005", "3000").param("3013", "600").param("3017", "500").param("3037", "1200").param("3041", "2000").param("3045", "60000");
  for (const char* bottom : {"-4.", "-18.", "-38.", "-98."}) {
    double before = HUGE_VAL;
    for (const char* s : {"S300", "S600", "S700", "S1200", "S1300", "S2900", "S600 ,S1200", "S600 ,S2900"}) {
      start(std::string("G84 Z") + bottom + " R2. F1.5 ,R1 " + s);
      double time = 0;
      ASSERT_TRUE(until([&] { return time += kCycle_s, drive->ended; }, 200000));
      EXPECT_LT(time, before + 0.003) << bottom << s;
      before = std::string(s) == "S2900" ? HUGE_VAL : time;  // the way back alone is another comparison
    }
  }
}

// Neither S, nor ,S, nor the return override turns the spindle faster than #3005 says that it can.
TEST_P(Tap, NoSpeedIsAboveTheHighestOne) {
  bench.param("3005", "700").param("3013", "600").param("3017", "50").param("3037", "1200").param("3041", "50").param("3045", "50").param("1172", "300");
  for (const char* words : {"S900", "S600 ,S900", "S600", "S700 ,S700"}) {
    start(std::string("G84 Z-30. R2. F1. ,R1 ") + words);
    double fastest = 0;
    EXPECT_TRUE(until([&] {
      if ((drive->out.spindle_synchronous & 1) != 0) fastest = std::max(fastest, std::fabs(drive->out.spindle_rev_min[0]));
      return drive->ended;
    }));
    EXPECT_NEAR(fastest, 700, 0.5) << words;
  }
}

// An interlock, a reset or an alarm stops a tap no faster than its spindle can, also where the feeder does not plan the stop.
TEST_P(Tap, AStopInTheHoleKeepsTheStagesOfTheSpindle) { stop_in_the_hole(50); }
TEST_P(Tap, AStopThatTheFeederDoesNotPlanKeepsThem) { stop_in_the_hole(0); }

TEST_P(Tap, HoldBetweenRAndRActsBehindTheWayBack) {
  for (const char* words : {"G84 Z-8. R2. F900. P100 ,R0", "G84 Z-8. R2. S600 F1.5 P100 ,R1"}) {
    start(words);
    ASSERT_TRUE(until([&] { return cuts() && z() < -3; }));
    drive->in.feed_hold = true;
    step();
    drive->in.feed_hold = false;  // a press is enough
    ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_HOLD; }));
    EXPECT_NEAR(z(), 2, 1e-6) << words;
    EXPECT_GE(drive->events.size(), 4U);
    for (unsigned n = 0; n < 50; ++n) step();
    EXPECT_NEAR(z(), 2, 1e-6) << "it stays";
    drive->in.cycle_start = true;
    drive->step(50);
    ASSERT_TRUE(until([&] { return drive->ended; }));
    EXPECT_NEAR(z(), 10, 1e-6);
  }
}

TEST_P(Tap, HoldBeforeRActsAtOnce) {
  start("G0 Z200.\nG84 Z-8. R2. F900. ,R0");
  ASSERT_TRUE(until([&] { return drive->out.source.line == 5 && z() < 150 && z() > 100; }));
  drive->in.feed_hold = true;
  ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_HOLD && drive->out.distance_zero; }));
  EXPECT_GT(z(), 2.1);
}

/// M700 13.12, type 1, stops at once; in a tap that would leave it in its thread, and the next block of the program would break it.
TEST_P(Tap, AMacroInterruptActsBehindTheWayBack) {
  bench.add("O1000", "G0 X7.\nM99\n");
  for (const char* words : {"G84 Z-8. R2. F900. P100 ,R0", "G84 Z-8. R2. S600 F1.5 P100 ,R1"}) {
    start(std::string("M96 P1000\n") + words);
    ASSERT_TRUE(until([&] { return cuts() && z() < -3; }));
    drive->in.macro_interrupt = true;
    step();
    drive->in.macro_interrupt = false;
    double lowest_aside = 100, farthest = 0;
    ASSERT_TRUE(until([&] {
      const double x = drive->out.command.v[0];
      if (x > 1e-6) lowest_aside = std::min(lowest_aside, z());
      farthest = std::max(farthest, x);
      return drive->ended;
    }));
    EXPECT_EQ(drive->alarm(), "") << words;
    EXPECT_NEAR(farthest, 7, 1e-6) << words << ": the interrupt program has run";
    EXPECT_GE(lowest_aside, 2 - 1e-6) << words << ": out of the hole";
  }
}

TEST_P(Tap, TheOverrideIsThatOfTheProgram) {
  const auto fastest = [&](double override_by) {
    start("G84 Z-8. R2. F900. ,R0");
    drive->in.feed_override = override_by;
    double most = 0;
    EXPECT_TRUE(until([&] {
      if (cuts()) most = std::max(most, std::fabs(drive->out.velocity.v[2]));
      return drive->ended;
    }));
    return most;
  };
  EXPECT_NEAR(fastest(0.5), 15, 0.01);
  EXPECT_NEAR(fastest(1.5), 15, 0.01);
}

TEST_P(Tap, BehindAResetInTheHoleTheSpindleGoesWithTheAxisByHand) {
  start("G84 Z-8. R2. S600 F1.5 ,R1");
  ASSERT_TRUE(until([&] { return cuts() && z() < -3; }));
  drive->in.reset = true;
  ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_IDLE; }));
  drive->in.reset = false;
  for (unsigned n = 0; n < 50; ++n) step();
  EXPECT_EQ(drive->out.spindle_synchronous, 1);
  EXPECT_EQ(drive->out.spindle_rev_min[0], 0);
  EXPECT_NEAR(2 - z(), kLead * drive->out.spindle_turns, 1e-6);
  // Drawn out by a jog button.
  drive->in.manual[2] = {NC_MANUAL_JOG, 5, 0};
  double worst = 0;
  ASSERT_TRUE(until([&] {
    worst = std::max(worst, std::fabs(2 - z() - kLead * drive->out.spindle_turns));
    return z() >= 2;
  }));
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(drive->out.spindle_rev_min[0], -150) << "it turns back: 5 mm/s";
  drive->in.manual[2] = {};
  for (unsigned n = 0; n < 50; ++n) step();
  drive = std::make_unique<Drive>(bench, "S100\nM30");  // the next code of the spindle ends it
  ASSERT_TRUE(until([&] { return drive->ended; }));
  EXPECT_EQ(drive->out.spindle_synchronous, 0);
}

TEST_P(Tap, WithoutAnEncoderItWaits) {  // appendix 1, P182
  start("G84 Z-8. R2. S600 F1.5 ,R1");
  drive->in.spindle[0].unmeasured = true;
  ASSERT_TRUE(until([&] { return drive->out.cause == NC_CAUSE_SPINDLE_UNMEASURED; }));
  EXPECT_NEAR(z(), 2, 1e-6);
}

}  // namespace
}  // namespace nc::test
