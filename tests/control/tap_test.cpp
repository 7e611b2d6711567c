// SPDX-License-Identifier: Apache-2.0
// Taps on a control that is driven cycle by cycle (M700 13.1.1, G84): with a floating holder, and with a spindle that the path turns.
#include <gtest/gtest.h>

#include "online_helpers.hpp"
#include "real_spindle.hpp"

namespace nc::test {
namespace {

constexpr double kLead = 1.5, kCycle_s = 0.004;

std::function<void(nc_config&)> tapping_machine(bool optimal) {
  return [optimal](nc_config& c) {
    c.cycle_s = kCycle_s;
    c.look_ahead = 256;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = 200;
      c.system[0].axis[i].max_velocity = 100;
      c.system[0].axis[i].max_acceleration = 1000;
      c.system[0].axis[i].max_jerk = optimal ? 100000 : 0;
    }
    if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
  };
}

/// The spindle turns as it is told; one that is to follow the path comes to rest first.
class Tap : public testing::TestWithParam<bool> {
 protected:
  Tap() : bench(NC_DIALECT_M700, tapping_machine(GetParam())) {}

  void start(const std::string& block) {
    bench.at(0, 0, 10);
    drive = std::make_unique<Drive>(bench, "G0 X0\nS600\nM3\n" + block + "\nG80\nM30");
  }
  void step() {
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
  template <class Done>
  bool until(Done done, unsigned most = 20000) {
    for (unsigned n = 0; n < most; ++n) {
      if (done()) return true;
      step();
    }
    return false;
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
  double z() const { return drive->out.command.v[2]; }
  bool cuts() const { return drive->out.tapping && z() < 1.9 && z() > -7.9; }

  Bench bench;
  std::unique_ptr<Drive> drive;
  double speed = 10, turns = 0, taken_at = 0;
  bool taken = false;
};

INSTANTIATE_TEST_SUITE_P(BothLaws, Tap, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

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

// ---- the spindle as it really turns --------------------------------------------------------------------------------------------

class RealTap : public testing::TestWithParam<bool> {
 protected:
  static constexpr double kRamp = 25, kLag = 0.02;  // rev/s^2, s
  RealTap() : bench(NC_DIALECT_M700, tapping_machine(GetParam())) {
    // 600 r/min in 0.5 s: 20 rev/s^2, what the motor can do and a reserve.
    bench.param("3005", "3000").param("3013", "600").param("3017", "500").param("3037", "1200").param("3041", "500").param("3045", "1500");
  }
  void start(const std::string& block) {
    bench.at(0, 0, 10);
    drive = std::make_unique<Drive>(bench, "G0 X0\n" + block + "\nG80\nM30");
    read();
  }
  void read() { spindle.show(drive->in); }
  void step() {
    drive->press_start();
    drive->step(50);
    spindle.step(drive->out);
    read();
  }
  template <class Done>
  bool until(Done done, unsigned most = 20000) {
    for (unsigned n = 0; n < most; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  }
  double z() const { return drive->out.command.v[2]; }

  Bench bench;
  RealSpindle spindle{kRamp, kLag, kCycle_s};
  std::unique_ptr<Drive> drive;
};

INSTANTIATE_TEST_SUITE_P(BothLaws, RealTap, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

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

// ---- a tap that is left in its hole -----------------------------------------------------------------------------------------------

class Retract : public RealTap {
 protected:
  void into_the_hole(const std::string& before = "") {
    start(before + "G84 Z-8. R2. S600 F1.5 ,R1");
    ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
    drive->in.reset = true;
    ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_IDLE; }));
    drive->in.reset = false;
    rest();
    ASSERT_TRUE(drive->out.tap_retract_possible);
    ASSERT_LT(z(), -2);
  }
  void rest() {
    for (unsigned n = 0; n < 200; ++n) step();
  }
  double apart() const { return std::fabs(2 - z() - kLead * spindle.since_taken()); }
};
INSTANTIATE_TEST_SUITE_P(BothLaws, Retract, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(Retract, TheSignalDrawsItOut) {
  into_the_hole();
  drive->in.tap_retract = true;
  double worst = 0, fastest = 0;
  ASSERT_TRUE(until([&] {
    worst = std::max(worst, apart());
    fastest = std::max(fastest, drive->out.velocity.v[2]);
    return !drive->out.tap_retract_possible && drive->out.state == NC_STATE_IDLE;
  }));
  rest();
  EXPECT_NEAR(z(), 2, 1e-3) << "R";
  EXPECT_LT(worst, 1e-3 + kLead * kRamp * kLag * kCycle_s) << "the spindle has turned back with it";
  EXPECT_NEAR(fastest, 15, 1) << "S times the lead";
  EXPECT_FALSE(drive->out.tap_retract_possible);
  drive->in.tap_retract = false;
  rest();
  drive->in.tap_retract = true;
  rest();
  EXPECT_NEAR(z(), 2, 1e-3) << "there is nothing left to be drawn out";
}

TEST_P(Retract, ItStandsWhileTheSignalIsOff) {
  into_the_hole();
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > -6; }));
  drive->in.tap_retract = false;
  rest();
  const double stands = z();
  EXPECT_LT(stands, -3);
  rest();
  EXPECT_NEAR(z(), stands, 1e-3);
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > 1.99; }));
}

TEST_P(Retract, AFeedHoldGivesTheWayUp) {
  into_the_hole();
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > -6; }));
  drive->in.feed_hold = true;
  rest();
  const double stands = z();
  drive->in.feed_hold = false;
  rest();
  EXPECT_NEAR(z(), stands, 1e-3) << "the signal has to rise again";
  drive->in.tap_retract = false;
  rest();
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > 1.99; }));
}

TEST_P(Retract, AStartIsRefusedWhileTheTapStandsInItsHole) {
  into_the_hole();
  EXPECT_NE(drive->out.cause, NC_CAUSE_TAP_IN_HOLE) << "nobody has pressed start";
  const double stands = z();
  const auto press = [&] {
    drive->in.cycle_start = true;
    drive->step(50);
    spindle.step(drive->out);
    read();
    rest();
  };
  press();
  EXPECT_EQ(drive->out.state, NC_STATE_IDLE);
  EXPECT_EQ(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  EXPECT_NEAR(z(), stands, 1e-3);
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return !drive->out.tap_retract_possible && drive->out.state == NC_STATE_IDLE; }));
  drive->in.tap_retract = false;
  rest();
  EXPECT_EQ(drive->out.cause, NC_CAUSE_NONE) << "it is out";
  press();
  EXPECT_NE(drive->out.state, NC_STATE_IDLE) << "and the program begins";
  EXPECT_NE(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
}

// Out of its hole the tap lets its spindle go: rapid traverse of its axis, by hand or by a program, would turn it faster than it can.
TEST_P(Retract, OutOfItsHoleTheSpindleIsLetGo) {
  const auto out_by_signal = [&] {
    into_the_hole("G0 Z30.\n");
    drive->in.tap_retract = true;
    ASSERT_TRUE(until([&] { return !drive->out.tap_retract_possible && drive->out.state == NC_STATE_IDLE; }));
    drive->in.tap_retract = false;
    rest();
  };
  const auto out_by_hand = [&] {
    into_the_hole();
    drive->in.manual[2] = {NC_MANUAL_JOG, 5, 0};
    ASSERT_TRUE(until([&] { return z() > 2.05; }));
  };
  double angle = 0;
  const auto jog_fast = [&] {
    angle = spindle.turns();
    drive->in.manual[2] = {NC_MANUAL_JOG, 100, 0};
    EXPECT_TRUE(until([&] { return z() > 60; }));
    drive->in.manual[2] = {};
    rest();
  };
  const auto run_program = [&] {
    angle = spindle.turns();
    drive->in.cycle_start = true;
    drive->step(50);
    EXPECT_TRUE(until([&] { return z() < 0; })) << "the second time";
    drive->in.reset = true;
    rest();
    drive->in.reset = false;
  };
  out_by_signal();
  jog_fast();
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_EQ(drive->out.spindle_synchronous, 0);
  EXPECT_NEAR(spindle.turns(), angle, 0.1) << "it stands";
  out_by_hand();
  jog_fast();
  EXPECT_EQ(drive->alarm(), "") << "faster, without a stop at R";
  EXPECT_EQ(drive->out.spindle_synchronous, 0);
  out_by_signal();
  run_program();
  EXPECT_EQ(drive->alarm(), "") << "rapid traverse up to the initial level";
}

// Whatever asks for X or Y by hand would tear the tap sideways out of its hole. Its own axis goes, and the spindle with it.
TEST_P(Retract, OnlyItsOwnAxisIsMovedByHandWhileItStandsInItsHole) {
  into_the_hole();
  EXPECT_EQ(drive->out.tap_holds, 0b011u);
  const nc_manual wishes[] = {{NC_MANUAL_JOG, 20, 0}, {NC_MANUAL_STEP, 20, 5}, {NC_MANUAL_HANDLE, 0, 0.1}, {NC_MANUAL_REFERENCE, 0, 0}};
  const double x = drive->out.command.v[0], y = drive->out.command.v[1];
  uint64_t dropped = 0;
  for (const nc_manual& wish : wishes) {
    drive->in.manual[0] = drive->in.manual[1] = wish;
    for (unsigned n = 0; n < 50; ++n) step(), dropped |= drive->out.handle_dropped;
    drive->in.manual[0] = drive->in.manual[1] = {};
    rest();
  }
  EXPECT_EQ(drive->out.command.v[0], x);
  EXPECT_EQ(drive->out.command.v[1], y);
  EXPECT_EQ(dropped, 0b011u) << "the wheel is told";
  drive->in.manual[0] = {NC_MANUAL_JOG, 20, 0};  // stays pressed
  drive->in.manual[2] = {NC_MANUAL_JOG, 10, 0};
  ASSERT_TRUE(until([&] { return z() > 2.5; }));
  EXPECT_EQ(drive->out.tap_holds, 0u) << "it is out";
  drive->in.manual[2] = {};
  rest();
  EXPECT_EQ(drive->out.command.v[0], x) << "a button that was refused is let go first";
  drive->in.manual[0] = {};
  rest();
  drive->in.manual[0] = {NC_MANUAL_JOG, 20, 0};
  ASSERT_TRUE(until([&] { return drive->out.command.v[0] > x + 1; }));
}

// Behind a power cut an axis without its place cannot tell whether the tap is still in the hole.
TEST_P(Retract, AnAxisThatDoesNotKnowItsPlaceHoldsTheOthersUntilItDoes) {
  into_the_hole();
  drive->in.unlimited = 0b100;
  drive->in.manual[2] = {NC_MANUAL_JOG, 10, 0};
  ASSERT_TRUE(until([&] { return z() > 2.5; }));
  drive->in.manual[2] = {};
  rest();
  EXPECT_EQ(drive->out.tap_holds, 0b011u);
  drive->in.unlimited = 0;
  rest();
  EXPECT_EQ(drive->out.tap_holds, 0u);
}

TEST_P(Retract, ASpindleThatDoesNotTurnAnyMoreLocksNobodyOut) {
  into_the_hole();
  const double stands = spindle.turns();
  const auto cycle = [&](bool start) {  // the encoder answers, and shows a spindle that stands
    drive->in.spindle[0].rev_per_s = 0;
    drive->in.spindle[0].turns = stands;
    drive->in.spindle[0].turns_valid = true;
    drive->in.cycle_start = start;
    drive->step(50);
  };
  const auto wait = [&] {
    for (unsigned n = 0; n < 3000; ++n) cycle(false);
  };
  cycle(true);
  wait();
  EXPECT_EQ(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  drive->in.tap_retract = true;
  wait();
  drive->in.tap_retract = false;
  EXPECT_EQ(drive->out.state, NC_STATE_ALARM) << "NC-TAP";
  drive->in.reset = true;
  cycle(false);
  drive->in.reset = false;
  wait();
  EXPECT_EQ(drive->out.state, NC_STATE_IDLE);
  EXPECT_NE(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  ASSERT_TRUE(drive->out.tap_retract_possible);
  EXPECT_EQ(drive->out.tap_holds, 0u) << "it has to be freed by hand, and the machine moved for that";
  drive->in.tap_retract = true;  // another attempt has begun: what it finds counts, and meanwhile a start is refused again
  cycle(false);
  cycle(true);
  EXPECT_EQ(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  wait();
  drive->in.tap_retract = false;
  EXPECT_EQ(drive->out.state, NC_STATE_ALARM);
  drive->in.reset = true;
  cycle(false);
  drive->in.reset = false;
  wait();
  cycle(true);
  bool began = false;
  for (unsigned n = 0; n < 500; ++n) {
    began = began || drive->out.state == NC_STATE_RUNNING;
    cycle(false);
  }
  EXPECT_TRUE(began);
}

TEST_P(Retract, NothingIsDrawnOutWhereNoTapStands) {
  start("G1 Z-3. F3000");
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return drive->ended; }));
  EXPECT_FALSE(drive->out.tap_retract_possible);
  rest();
  EXPECT_NEAR(z(), -3, 1e-9);
}

// What nc_tap_get() has given is kept by the host; another control, as behind a power cut, draws the tap out with it.
TEST_P(Retract, BehindAPowerCutItIsDrawnOut) {
  start("G84 Z-8. R2. S600 F1.5 ,R1");
  ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
  nc_tap tap = NC_INIT(nc_tap);
  ASSERT_EQ(nc_tap_get(bench.control(), 0, &tap), NC_OK);
  EXPECT_EQ(tap.axis, 3);
  EXPECT_NEAR(tap.entry, 2, 1e-9);
  EXPECT_NEAR(tap.turns_per_mm, -1 / kLead, 1e-9);
  const double stands = -4.2;

  Bench after(NC_DIALECT_M700, tapping_machine(GetParam()));
  after.at(0, 0, stands);
  ASSERT_EQ(nc_tap_set(after.control(), 0, &tap), NC_OK);
  drive = std::make_unique<Drive>(after, "M30");
  spindle = RealSpindle{kRamp, kLag, kCycle_s};
  const double before = spindle.turns();
  const auto cycle = [&] {
    read();
    drive->step(50);
    spindle.step(drive->out);
  };
  for (unsigned n = 0; n < 100; ++n) cycle();
  EXPECT_TRUE(drive->out.tap_retract_possible);
  EXPECT_NEAR(spindle.turns(), before, 1e-9) << "nothing moves by itself";
  drive->in.tap_retract = true;
  double worst = 0;
  for (unsigned n = 0; n < 2000; ++n) {
    cycle();
    worst = std::max(worst, std::fabs(z() - stands + kLead * (spindle.turns() - before)));
  }
  EXPECT_NEAR(z(), 2, 1e-3);
  EXPECT_LT(worst, 1e-3 + kLead * kRamp * kLag * kCycle_s);
  EXPECT_FALSE(drive->out.tap_retract_possible);
}

// On the way to the next hole the tap is in none: neither the one that is made nor the one to come is kept.
TEST_P(Retract, BetweenTwoHolesThereIsNothingToBeDrawnOut) {
  start("G84 X5. Z-5. R5. F1. S500 ,R1\nX15. Z-8. R0. F2. ,R1");
  unsigned holes = 0;
  bool kept = false;
  ASSERT_TRUE(until([&] {
    nc_tap tap = NC_INIT(nc_tap);
    EXPECT_EQ(nc_tap_get(bench.control(), 0, &tap), NC_OK);
    const bool first = drive->out.source.line == 2, below = z() < (first ? 5 : 0) - 1e-6, strokes = (drive->out.spindle_synchronous & 1) != 0;
    if (below && strokes) {
      EXPECT_EQ(tap.axis, 3) << z();
      EXPECT_NEAR(tap.entry, first ? 5 : 0, 1e-9) << "that of the hole in hand";
    }
    if (!strokes) {
      EXPECT_EQ(tap.axis, 0) << "in the air, at Z" << z();
    }
    holes += tap.axis != 0 && !kept ? 1 : 0;
    kept = tap.axis != 0;
    return drive->ended;
  }));
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_EQ(holes, 2u);
}

TEST(TapData, OnlyATapThatCanBeIsTaken) {
  Bench bench(NC_DIALECT_M700, tapping_machine(false));
  nc_tap tap = NC_INIT(nc_tap);
  tap.axis = 3;
  tap.turns_per_mm = 0.5;
  tap.speed = -10;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_OK);
  for (double nc_tap::*number : {&nc_tap::turns_per_mm, &nc_tap::speed}) {
    nc_tap bad = tap;
    for (const double value : {0.0, 1e12, static_cast<double>(NAN)}) {
      bad.*number = value;
      EXPECT_EQ(nc_tap_set(bench.control(), 0, &bad), NC_E_ARGUMENT) << value;
    }
  }
  tap.axis = 4;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_E_ARGUMENT) << "there is no such axis";
  tap.axis = 0;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_OK) << "no tap";
  EXPECT_EQ(nc_tap_set(bench.control(), 7, &tap), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tap_get(bench.control(), 0, nullptr), NC_E_ARGUMENT);
  nc_inputs in;
  nc_inputs_init(&in);
  nc_outputs out;
  nc_outputs_init(&out);
  ASSERT_EQ(nc_cycle(bench.control(), &in, &out), NC_OK);
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_E_STATE) << "the scan runs";
}

// Series 8 G84 taps in the direction in which the spindle turns, also at the places of a pattern behind another direction.
TEST(TapDirection, IsThatOfTheSpindleAtTheHole) {
  Bench bench(NC_DIALECT_SERIES8, tapping_machine(false));
  bench.at(0, 0, 10);
  Drive drive(bench, "S600M03\nG84X0Y0Z-8R2K1.5\nM04\nG49X20Y0I10J10\nG80\nM30");
  unsigned holes[2][2] = {};  // [before, at the pattern][forward, reverse]
  bool in_hole = false;
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    drive.press_start();
    drive.in.spindle[0] = {};
    drive.in.spindle[0].turns_valid = true;
    drive.in.spindle[0].turns = drive.out.spindle_turns;
    drive.step(50);
    const bool deep = drive.out.command.v[2] < -2;
    if (deep && !in_hole) ++holes[drive.out.command.v[0] > 10 ? 1 : 0][drive.out.spindle_rev_min[0] < 0 ? 1 : 0];
    in_hole = deep;
  }
  EXPECT_TRUE(drive.ended);
  EXPECT_EQ(holes[0][0], 1U);
  EXPECT_EQ(holes[1][0], 0U);
  EXPECT_EQ(holes[1][1], 4U);
}

// ---- several spindles, and one that is an axis -------------------------------------------------------------------------------------

TEST(TapSpindles, EverySelectedSpindleTurnsWithTheTap) {  // 10.6
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    tapping_machine(false)(c);
    c.system[0].spindle_count = 3;
  });
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  double turns[3] = {}, deepest[3] = {};
  uint8_t seen = 0;
  drive.in.spindle_select = 6;
  for (nc_spindle_inputs& spindle : drive.in.spindle) spindle = {};
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    drive.press_start();
    for (unsigned i = 0; i < 3; ++i) {
      drive.in.spindle[i].turns_valid = true;
      drive.in.spindle[i].turns = turns[i];
    }
    drive.step(50);
    seen = static_cast<uint8_t>(seen | drive.out.spindle_synchronous);
    for (unsigned i = 0; i < 3; ++i)
      if ((drive.out.spindle_synchronous >> i & 1) != 0) deepest[i] = std::max(deepest[i], turns[i] = drive.out.spindle_turns);
  }
  ASSERT_TRUE(drive.ended) << drive.alarm() << unsigned{drive.out.cause};
  EXPECT_EQ(seen, 6);
  EXPECT_EQ(deepest[0], 0);
  EXPECT_NEAR(deepest[1], 10 / kLead, 0.01);
  EXPECT_NEAR(deepest[2], 10 / kLead, 0.01);
}

// What selects a spindle may begin anew with a reset. The one whose tap stands in the work goes on with its axis, and no other.
TEST(TapSpindles, ATapThatAResetHasLeftInItsHoleKeepsItsSpindle) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    tapping_machine(false)(c);
    c.system[0].spindle_count = 2;
  });
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  const double from[2] = {0.3, 0.7};
  double turns[2] = {from[0], from[1]}, worst = 0;
  drive.in.spindle_select = 2;
  const auto z = [&] { return drive.out.command.v[2]; };
  const auto step = [&] {
    drive.press_start();
    for (unsigned i = 0; i < 2; ++i) {
      drive.in.spindle[i] = {};
      drive.in.spindle[i].turns_valid = true;
      drive.in.spindle[i].turns = turns[i];
    }
    drive.step(50);
    for (unsigned i = 0; i < 2; ++i)
      if ((drive.out.spindle_synchronous >> i & 1) != 0) turns[i] = from[i] + drive.out.spindle_turns;
    if (drive.out.spindle_synchronous != 0) worst = std::max(worst, std::fabs(2 - z() - kLead * (turns[1] - from[1])));
  };
  const auto until = [&](auto done) {
    for (unsigned n = 0; n < 20000; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  };
  ASSERT_TRUE(until([&] { return drive.out.tapping && z() < -3; }));
  drive.in.reset = true;
  drive.in.spindle_select = 1;
  ASSERT_TRUE(until([&] { return drive.out.state == NC_STATE_IDLE; }));
  drive.in.reset = false;
  for (unsigned n = 0; n < 100; ++n) step();
  ASSERT_TRUE(drive.out.tap_retract_possible);
  EXPECT_EQ(drive.out.spindle_synchronous, 2);
  EXPECT_EQ(drive.out.spindle_encoder, 2);
  drive.in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > 2 - 1e-3; })) << z() << " " << drive.alarm();
  EXPECT_LT(worst, 0.1) << "mm beside the thread";
  EXPECT_EQ(turns[0], from[0]);
  drive.in.tap_retract = false;
  drive.in.manual[2] = {NC_MANUAL_JOG, 5, 0};
  ASSERT_TRUE(until([&] { return z() > 6; }));
  EXPECT_EQ(drive.out.spindle_selected, 1) << "out of the hole it is let go";
}

TEST(TapSpindles, ASpindleThatIsACAxisTurnsAsTheAxis) {  // 10.5
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    tapping_machine(false)(c);
    nc_system_config& system = c.system[0];
    system.axis_count = 4;
    system.axis[3] = system.axis[2];
    system.axis[3].name = 'C';
    system.axis[3].rotary = true;
    system.axis[3].spindle = 1;
    system.axis[3].rapid = system.axis[3].max_velocity = 36000;
    system.axis[3].max_acceleration = 360000;
  });
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  drive.in.servo_on = 8;
  drive.in.spindle[0] = {};
  drive.in.spindle[0].servo_ready = true;
  double worst = 0, most = 0, from = NAN;
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    drive.in.cycle_start = n == 5;
    drive.step(50);
    if (n == 4) from = drive.out.command.v[3];
    EXPECT_EQ(drive.out.spindle_synchronous, 0);
    const double z = drive.out.command.v[2];
    if (z < 2 && drive.out.tapping) {
      worst = std::max(worst, std::fabs(2 - z - kLead * (drive.out.command.v[3] - from) / 360));
      most = std::max(most, drive.out.command.v[3] - from);
    }
  }
  ASSERT_TRUE(drive.ended) << drive.alarm() << unsigned{drive.out.cause};
  EXPECT_LT(worst, 1e-6);
  EXPECT_NEAR(most, 360 * 10 / kLead, 5);
  EXPECT_NEAR(drive.out.command.v[3], from, 1e-9) << "it has turned back";
}

}  // namespace
}  // namespace nc::test
