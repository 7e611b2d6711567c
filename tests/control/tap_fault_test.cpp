// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1) whose spindle fails: it runs on at the bottom, it does not turn back, its encoder jumps. In none of these may the axis
// leave its stroke, tear the tap out of its thread, or go on to the next hole.
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "online_helpers.hpp"

namespace nc::test {
namespace {

constexpr double kLead = 1.5, kCycle_s = 0.001, kLowest = -20, kAcceleration = 2000;

std::function<void(nc_config&)> tapping_machine(bool optimal) {
  return [optimal](nc_config& c) {
    c.cycle_s = kCycle_s;
    c.look_ahead = 256;
    for (unsigned i = 0; i < 3; ++i) {
      nc_axis_config& axis = c.system[0].axis[i];
      axis.rapid = axis.max_velocity = 250;
      axis.max_acceleration = kAcceleration;
      axis.max_jerk = optimal ? 100000 : 0;
    }
    c.system[0].axis[2].soft_limited = true;
    c.system[0].axis[2].soft_min = kLowest;
    c.system[0].axis[2].soft_max = 100;
    if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
  };
}

enum class Fault { none, runs_on, stands, jumps, jumps_by_one };

/// A spindle that does what it is told until it fails.
class FaultyTap : public testing::TestWithParam<bool> {
 protected:
  FaultyTap() : bench(NC_DIALECT_M700, tapping_machine(GetParam())) {
    bench.param("3005", "12000").param("3013", "3000").param("3017", "400").param("3037", "6000").param("3041", "500").param("3045", "1500").at(0, 0, 10);
    drive = std::make_unique<Drive>(bench, "G90 G94 G0 X0\nG84 X5. Z-8. R2. S600 F1.5 ,R1\nX10.\nG80\nM30");
  }
  /// One cycle. The fault comes when the spindle is to turn back, a jump in the middle of the hole.
  void step(Fault fault) {
    const nc_outputs& out = drive->out;
    const bool follows = (out.spindle_synchronous & 1) != 0;
    if (!follows) {
      taken = false;
      if (!failed) speed = 0;
    } else if (!taken) {
      taken = true;
      taken_at = turns - out.spindle_turns;
    }
    if (fault != Fault::none && follows && out.spindle_rev_min[0] < 0) failed = true;
    const bool jumps = fault == Fault::jumps || fault == Fault::jumps_by_one;
    if (jumps && !jumped && follows && z() < -3) {
      jumped = true;
      turns += fault == Fault::jumps ? 1e6 : 1;
      taken_at += fault == Fault::jumps ? 1e6 : 1;
    }
    if (follows && (!failed || jumps)) speed = (taken_at + out.spindle_turns - turns) / kCycle_s;
    if (failed && fault == Fault::runs_on) speed = 10;
    if (failed && fault == Fault::stands) speed = 0;
    turns += speed * kCycle_s;
    drive->in.spindle[0].rev_per_s = speed;
    drive->in.spindle[0].turns = shown.value_or(turns);
    drive->in.spindle[0].turns_valid = valid;
    shown.reset();
    valid = true;
    drive->press_start();
    drive->step(50);
    lowest = std::min(lowest, z());
    fastest = std::max(fastest, std::fabs(drive->out.velocity.v[2] - velocity) / kCycle_s);
    velocity = drive->out.velocity.v[2];
    farthest_x = std::max(farthest_x, drive->out.command.v[0]);
  }
  void run(Fault fault, unsigned cycles) {
    for (unsigned n = 0; n < cycles && !drive->ended; ++n) step(fault);
  }
  double z() const { return drive->out.command.v[2]; }

  Bench bench;
  std::unique_ptr<Drive> drive;
  double speed = 0, turns = 0.25, taken_at = 0, lowest = 10, fastest = 0, velocity = 0, farthest_x = 0;
  bool taken = false, failed = false, jumped = false, valid = true;
  std::optional<double> shown;  ///< by the encoder in the next cycle, in the place of the angle
};

INSTANTIATE_TEST_SUITE_P(BothLaws, FaultyTap, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(FaultyTap, ASoundSpindleMakesBothHoles) {
  run(Fault::none, 20000);
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_TRUE(drive->ended);
  EXPECT_NEAR(lowest, -8, 1e-4);
  EXPECT_NEAR(farthest_x, 10, 1e-9);
  EXPECT_LE(fastest, kAcceleration * 1.001) << "also where the spindle is let go";
}

TEST_P(FaultyTap, ASpindleThatRunsOnTakesTheAxisNoFartherThanItsStroke) {
  run(Fault::runs_on, 20000);
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  EXPECT_GE(lowest, kLowest - 1e-9);
  EXPECT_LT(lowest, -9) << "the axis goes along with the spindle, as far as that can run out";
  EXPECT_LE(fastest, kAcceleration * 1.001);
  EXPECT_NEAR(farthest_x, 5, 1e-9) << "no second hole";
  // Neither the signal of an alarm nor a reset changes that.
  drive->in.alarm = true;
  run(Fault::runs_on, 2000);
  drive->in.alarm = false;
  drive->in.reset = true;
  run(Fault::runs_on, 5000);
  drive->in.reset = false;
  run(Fault::runs_on, 5000);
  EXPECT_GE(lowest, kLowest - 1e-9);
  EXPECT_LE(fastest, kAcceleration * 1.001);
}

TEST_P(FaultyTap, ATapIsNotTornOutOfItsThread) {
  run(Fault::stands, 20000);
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  EXPECT_NEAR(z(), -8, 0.1) << "the axis stands, as its spindle does";
  EXPECT_NEAR(farthest_x, 5, 1e-9);
  drive->in.reset = true;
  run(Fault::stands, 200);
  drive->in.reset = false;
  run(Fault::stands, 200);
  EXPECT_NEAR(z(), -8, 0.1);
  ASSERT_TRUE(drive->out.tap_retract_possible);
  // The drive works again: the spindle turns the tap out along its thread.
  const double stood = turns, depth = z();
  taken_at = turns - drive->out.spindle_turns;
  failed = false;
  drive->in.tap_retract = true;
  double worst = 0;
  for (unsigned n = 0; n < 5000; ++n) {
    step(Fault::none);
    worst = std::max(worst, std::fabs(z() - depth + kLead * (turns - stood)));
  }
  EXPECT_NEAR(z(), 2, 1e-3);
  EXPECT_LT(worst, 0.05) << "mm beside the thread";
}

TEST_P(FaultyTap, AJumpOfTheEncoderDoesNotMoveTheAxis) {
  run(Fault::jumps, 20000);
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  EXPECT_GE(lowest, -8.01);
  EXPECT_LE(fastest, kAcceleration * 1.001);
  EXPECT_NEAR(farthest_x, 5, 1e-9);
  EXPECT_LT(z(), -2.5) << "it stands in its hole";
}

TEST_P(FaultyTap, NorDoesAJumpOfOneTurn) {
  run(Fault::jumps_by_one, 20000);
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  EXPECT_GE(lowest, -8.01);
  EXPECT_LE(fastest, kAcceleration * 1.001);
  EXPECT_NEAR(farthest_x, 5, 1e-9);
  EXPECT_LT(z(), -2.5) << "it stands in its hole";
  drive->in.reset = true;
  run(Fault::none, 200);
  drive->in.reset = false;
  run(Fault::none, 200);
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_TRUE(drive->out.tap_retract_possible);
  EXPECT_LT(z(), -2.5);
}

// The spindle does not turn as the tap is to be drawn out: the tap is in its hole, whatever the path says.
TEST_P(FaultyTap, ATapThatIsNotDrawnOutIsStillInItsHole) {
  for (unsigned n = 0; n < 20000 && !(drive->out.tapping && z() < -3); ++n) step(Fault::none);
  drive->in.reset = true;
  run(Fault::none, 500);
  drive->in.reset = false;
  run(Fault::none, 500);
  ASSERT_TRUE(drive->out.tap_retract_possible);
  const double stands = z();
  drive->in.tap_retract = true;
  failed = true;  // and stands
  for (unsigned n = 0; n < 3000; ++n) {
    step(Fault::stands);
    EXPECT_NEAR(z(), stands, 0.05);
  }
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  drive->in.tap_retract = false;
  drive->in.reset = true;
  run(Fault::stands, 200);
  drive->in.reset = false;
  run(Fault::stands, 200);
  EXPECT_TRUE(drive->out.tap_retract_possible);
  EXPECT_NEAR(z(), stands, 0.05);
}

// Whatever an encoder shows, the axis stays within its stroke, keeps its acceleration, and does not go to the next hole without an alarm.
TEST_P(FaultyTap, WhateverTheEncoderShows) {
  std::mt19937_64 random(GetParam() ? 1 : 2);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (unsigned n = 0; n < 6000; ++n) {
    step(Fault::none);
    switch (random() % 400) {
      case 0: turns += uniform(-1, 1); break;
      case 1: turns += uniform(-1e9, 1e9); break;
      case 2: shown = std::nan(""); break;
      case 3: shown = HUGE_VAL; break;
      case 4: drive->in.reset = true; break;
      case 5: drive->in.feed_hold = !drive->in.feed_hold; break;
      case 6: drive->in.interlock = !drive->in.interlock; break;
      case 7: taken_at += uniform(-5, 5); break;
      default: drive->in.reset = false;
    }
    valid = random() % 500 != 0;
    if (drive->out.state == NC_STATE_IDLE && drive->alarm().empty() && random() % 50 == 0) drive->in.tap_retract = !drive->in.tap_retract;
  }
  EXPECT_GE(lowest, kLowest - 1e-9);
  EXPECT_LE(fastest, kAcceleration * 1.001);
}

}  // namespace
}  // namespace nc::test
