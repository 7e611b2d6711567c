// SPDX-License-Identifier: Apache-2.0
// Taps on a control that is driven cycle by cycle (M700 13.1.1, G84): with a floating holder, and with a spindle that the path turns.
#include <gtest/gtest.h>

#include "online_helpers.hpp"

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
      speed = std::max(0.0, speed - 50 * kCycle_s);
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

TEST_P(Tap, TheSpindleAcceleratesByItsStages) {
  bench.param("3005", "3000").param("3013", "600").param("3017", "500").param("3037", "1200").param("3041", "2000").param("3045", "60000");
  const auto steepest = [&](const char* words) {
    start(std::string("G84 Z-18. R2. F1.5 ,R1 ") + words);
    double most = 0, before = 0;
    EXPECT_TRUE(until([&] {
      const bool follows = (drive->out.spindle_synchronous & 1) != 0;
      const double now = follows ? drive->out.spindle_rev_min[0] / 60 : 0;
      if (follows) most = std::max(most, std::fabs(now - before) / kCycle_s);
      before = now;
      return drive->ended;
    }));
    return most;
  };
  EXPECT_NEAR(steepest("S600"), 20, 0.5) << "rev/s^2: 600 r/min in 0.5 s";
  EXPECT_NEAR(steepest("S1200"), 5, 0.2) << "600 r/min more in 2 s";
  EXPECT_NEAR(steepest("S1500"), 0.5, 0.05) << "1800 r/min more in 60 s";
}

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
