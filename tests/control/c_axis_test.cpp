// SPDX-License-Identifier: Apache-2.0
// A spindle that is a C axis, too (M700 10.5), on a control that is driven cycle by cycle, with a drive that the test simulates.
#include "online_helpers.hpp"

#include <gtest/gtest.h>

namespace nc::test {
namespace {

constexpr unsigned kC = 3;
constexpr uint8_t kServoC = 1 << kC;

std::function<void(nc_config&)> turning_machine(bool optimal) {
  return [optimal](nc_config& c) {
    c.cycle_s = 0.004;
    c.look_ahead = 256;
    c.system[0].axis_count = 4;
    c.system[0].axis[kC].name = 'C';
    c.system[0].axis[kC].rotary = true;
    c.system[0].axis[kC].spindle = 1;
    for (unsigned i = 0; i < 4; ++i) {
      c.system[0].axis[i].rapid = 200;
      c.system[0].axis[i].max_velocity = 100;
      c.system[0].axis[i].max_acceleration = 1000;
      c.system[0].axis[i].max_jerk = optimal ? 100000 : 0;
    }
    if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
  };
}

/// A machine whose ladder switches the servo with M80 (on) and M81 (off), and waits for servo READY before it says FIN.
class CAxis : public testing::TestWithParam<bool> {
 protected:
  CAxis() : bench(NC_DIALECT_M700, turning_machine(GetParam())) { bench.param("PREREAD_STOP_M1", "80"); }

  void start(const std::string& text) {
    const nc_outputs before = drive != nullptr ? drive->out : nc_outputs{};
    drive = std::make_unique<Drive>(bench, text);
    drive->out = before;
  }
  void step() {
    nc_inputs& in = drive->in;
    const nc_outputs& out = drive->out;
    if ((out.strobe & 1) != 0 && out.m == 80) servo = true;
    if ((out.strobe & 1) != 0 && out.m == 81) servo = false;
    in.servo_on = servo ? kServoC : 0;
    in.recalculate = asks_again && (out.strobe & 1) != 0 && out.m == 80;
    turn_spindle(out);
    in.actual_valid = true;
    in.actual = out.command;
    if ((out.servo_ready & kServoC) == 0) in.actual.v[kC] = angle;
    in.spindle[0].rev_per_s = speed;
    in.spindle[0].turns = angle / 360;
    in.spindle[0].turns_valid = true;
    in.spindle[0].servo_ready = ready;
    in.spindle[0].zero_passed = passed;
    drive->fin_cycles = ready == servo ? 1 : 1000000;
    drive->press_start();
    drive->step(50);
  }
  /// The spindle follows its speed; with the servo on it slows down, turns on to `stands_at`, and is then ready.
  void turn_spindle(const nc_outputs& out) {
    if ((out.servo_on & kServoC) == 0) {
      speed = out.spindle_rev_min[0] / 60;
      angle = std::fmod(angle + 360 * speed * 0.004, 360);
      ready = passed = false;
      count = 0;
    } else if (!ready) {
      speed = 0;
      if (++count < 20) return;
      angle = stands_at;
      ready = true;
      passed = finds_zero;
    } else if ((out.servo_ready & kServoC) != 0) {
      angle = out.command.v[kC];
    }
  }
  template <class Done>
  bool until(Done done, unsigned most = 20000) {
    for (unsigned n = 0; n < most; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  }
  void acknowledge() {
    for (const bool pressed : {true, false}) {
      drive->in.reset = pressed;
      for (unsigned n = 0; n < 10; ++n) step();
    }
  }
  bool until_end() {
    return until([&] { return drive->ended; });
  }
  double c() const { return drive->out.command.v[kC]; }
  double x() const { return drive->out.command.v[0]; }

  Bench bench;
  std::unique_ptr<Drive> drive;
  bool asks_again = false;  // the ladder requests a recalculation with the M80
  bool servo = false, ready = false, passed = false, finds_zero = true;
  double speed = 0, angle = 30, stands_at = 0;
  unsigned count = 0;
};

INSTANTIATE_TEST_SUITE_P(BothLaws, CAxis, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(CAxis, ACommandWithoutTheServoIsP430) {  // precaution (2)
  for (const char* block : {"G0 C90.", "G1 X5. C90. F100", "G91 G28 C0", "G53 C0"}) {
    start(std::string("G0 X1.\n") + block + "\nM30");
    ASSERT_TRUE(until_end());
    EXPECT_EQ(drive->alarm(), "P430") << block;
    acknowledge();
  }
  start("G92 C10.\nG10 L2 P1 C5.\nG52 C0\nM30");  // no movement
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
}

TEST_P(CAxis, AnMCodeThatStopsReadingMakesItWork) {  // (2), *1
  stands_at = 12;
  start("S600\nG1 X5. F3000\nM80\nG0 C90.\nX10.\nM81\nG1 X20.\nM30");
  double before = 0;
  ASSERT_TRUE(until([&] {
    if (drive->out.source.line == 3 && (drive->out.servo_ready & kServoC) != 0 && before == 0) before = c();
    return drive->ended;
  }));
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(before, 12, 1e-9) << "the counter is updated for the way of the spindle";
  EXPECT_NEAR(c(), 90, 1e-9) << "and held during spindle control";
  EXPECT_NEAR(x(), 20, 1e-9);
}

TEST_P(CAxis, WithoutThatTheNextBlockIsP430) {  // (2), *2
  start("M180\nG0 C90.\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "P430");
  acknowledge();
  bench.param("PREREAD_STOP_M1", "0");
  start("M80\nG0 C90.\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "P430") << "checked at calculation, before the servo is on";
}

TEST_P(CAxis, ARecalculationRequestOfTheMCodeDoesTheSame) {  // (2), *1
  bench.param("PREREAD_STOP_M1", "0");
  asks_again = true;
  stands_at = 12;
  start("S600\nG1 X5. F3000\nM80\nG91 G0 C90.\nX10.\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(c(), 102, 1e-9);
  EXPECT_NEAR(x(), 15, 1e-9);
}

TEST_P(CAxis, WithoutItsReferenceItIsP430) {
  finds_zero = false;
  start("M80\nG0 C90.\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "P430");
  EXPECT_EQ(drive->out.referenced, 0);
  EXPECT_EQ(drive->out.servo_ready, kServoC);
}

TEST_P(CAxis, AnAxisWithoutAReferencePointNeedsNone) {  // precautions (1), (5): #2031 noref
  bench.param("2031", "1", 'C');
  finds_zero = false;
  stands_at = 100;
  start("M80\nG0 C90.\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(c(), 90, 1e-9);
}

TEST_P(CAxis, SpindleControlIsNotPossible) {  // (1)
  start("S600\nG4 P40\nM80\nS900\nG4 P80\nM81\nG4 P120\nM30");
  std::string seen;
  ASSERT_TRUE(until([&] {
    if (drive->out.cause == NC_CAUSE_DWELL) {
      const std::string now = std::to_string(drive->out.source.line) + ":" + brief(drive->out.spindle_rev_min[0]) + " ";
      if (seen.find(now) == std::string::npos) seen += now;
    }
    return drive->ended;
  }));
  EXPECT_EQ(seen, "2:600 5:0 7:900 ") << "an S code waits for the spindle";
}

TEST_P(CAxis, TheServoComesOnWhileTheSpindleTurns) {  // precaution (4)
  stands_at = 200;
  start("S3000\nG4 P200\nM80\n#100=#5044\nG91 G0 C10.\nM30");
  bool turned = false;
  ASSERT_TRUE(until([&] {
    turned = turned || speed > 40;
    return drive->ended;
  }));
  EXPECT_TRUE(turned);
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(c(), 210, 1e-9) << "incremental from where the spindle has come to rest";
  double value = 0;
  bool vacant = true;
  ASSERT_EQ(nc_variable_get(bench.control(), 0, 100, &value, &vacant), NC_OK);
  EXPECT_NEAR(value, 200, 1e-6);
}

// Precaution (3): the feed stops, the axis becomes a spindle, and the rest of the command is dropped at servo ON.
TEST_P(CAxis, TheServoGoesOffDuringACommand) {
  start("M80\nG1 X50. C360. F3000\nX60. F3000\nG0 C90.\nM30");
  ASSERT_TRUE(until([&] { return drive->out.source.line == 2 && x() > 20; }));
  servo = false;
  ASSERT_TRUE(until([&] { return drive->out.cause == NC_CAUSE_SERVO_OFF; }));
  const double stopped_at = x();
  EXPECT_LT(stopped_at, 30) << "braked";
  for (unsigned n = 0; n < 50; ++n) step();
  EXPECT_EQ(x(), stopped_at);
  EXPECT_EQ(drive->out.state, NC_STATE_RUNNING);
  stands_at = 300;
  servo = true;
  ASSERT_TRUE(until([&] { return drive->out.source.line == 3 && x() > stopped_at + 1; }));
  EXPECT_NEAR(c(), 300, 1e-9) << "the rest of C360. is dropped";
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(x(), 60, 1e-9);
  EXPECT_NEAR(c(), 90, 1e-9);
}

// A C command that was read while C was an axis, and is reached after C has been a spindle for a time, still goes to its place.
TEST_P(CAxis, WhatWasReadAheadIsReadAgain) {
  bench.param("PREREAD_STOP_M1", "0").param("2031", "1", 'C');
  servo = true;
  start("G4 P200\nG4 P200\nM30");
  ASSERT_TRUE(until_end());  // now C is an axis
  for (unsigned n = 0; n < 10; ++n) step();
  stands_at = 123;
  start("G0 C20.\nM81\nG1 X10. F3000\nM80\nX20.\nG0 C90.\nG91 C5.\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(c(), 95, 1e-9);
  EXPECT_NEAR(x(), 20, 1e-9);
}

TEST_P(CAxis, OnlyAsAnAxisItIsMovedByHand) {
  start("M30");
  for (unsigned n = 0; n < 10; ++n) step();
  nc_inputs& in = drive->in;
  in.manual[kC].kind = NC_MANUAL_JOG;
  in.manual[kC].velocity = 20;
  const double held = c();
  for (unsigned n = 0; n < 100; ++n) step();
  EXPECT_EQ(c(), held);
  in.manual[kC].kind = NC_MANUAL_NONE;
  servo = true;
  stands_at = 40;
  ASSERT_TRUE(until([&] { return (drive->out.servo_ready & kServoC) != 0; }));
  EXPECT_NEAR(c(), 40, 1e-9);
  in.manual[kC].kind = NC_MANUAL_JOG;
  for (unsigned n = 0; n < 100; ++n) step();
  EXPECT_GT(c(), 41);
}

// The position of C is converted through the coordinate systems and back with every move: rounding in its last digits must not be a command.
TEST_P(CAxis, OtherAxesMoveWhateverPlaceItWasLeftAt) {
  for (unsigned n = 0; n < 40; ++n) {
    nc_axes place{};
    place.v[kC] = 15.837791058604324 + 1.7 * n;
    bench.work_offset(1, {0, 0, 0, 0.7021 - 1.1 * n});
    ASSERT_EQ(nc_position_set(bench.control(), 0, &place), NC_OK);
    start("G53 G0 X5. Y5.\nG91 G1 X1. F3000\nG2 X2. R2.\nM30");
    ASSERT_TRUE(until([&] { return drive->ended; }, 2000)) << "C " << place.v[kC] << " cause " << int{drive->out.cause};
    EXPECT_EQ(drive->alarm(), "");
  }
}

/// Precaution (3) by hand: a motion that was requested before the servo went off, or while it was off, does not happen when it comes on.
TEST_P(CAxis, ByHandNothingIsLeftOverTheServo) {
  for (const nc_manual_kind kind : {NC_MANUAL_STEP, NC_MANUAL_HANDLE, NC_MANUAL_REFERENCE}) {
    servo = true;
    stands_at = 40;
    start("M30");
    ASSERT_TRUE(until_end());
    ASSERT_TRUE(until([&] { return (drive->out.servo_ready & kServoC) != 0 && drive->out.state == NC_STATE_IDLE; }));
    nc_manual& hand = drive->in.manual[kC];
    hand = {static_cast<uint8_t>(kind), 0, 60};
    step();
    if (kind != NC_MANUAL_REFERENCE) hand = {};
    ASSERT_TRUE(until([&] { return std::fabs(c() - 40) > 2; }));
    servo = false;
    for (unsigned n = 0; n < 5; ++n) step();
    hand = {NC_MANUAL_STEP, 0, 25};  // pressed while it is a spindle
    for (unsigned n = 0; n < 5; ++n) step();
    hand = {};
    stands_at = 200;
    servo = true;
    ASSERT_TRUE(until([&] { return (drive->out.servo_ready & kServoC) != 0; }));
    for (unsigned n = 0; n < 300; ++n) step();
    EXPECT_NEAR(c(), 200, 1e-9) << static_cast<int>(kind);
    servo = false;
    for (unsigned n = 0; n < 30; ++n) step();
  }
}

/// Precaution (3) is true for a skip move, too; the other axes have not reached its end then.
TEST_P(CAxis, TheServoGoesOffDuringASkipMove) {
  start("M80\nG31 X50. C360. F3000\n#100=#5061\nG90 G0 X60. C5.\nM30");
  ASSERT_TRUE(until([&] { return drive->out.source.line == 2 && x() > 20; }));
  servo = false;
  ASSERT_TRUE(until([&] { return drive->out.cause == NC_CAUSE_SERVO_OFF; }));
  const double stopped_at = x();
  EXPECT_LT(stopped_at, 30);
  stands_at = 300;
  servo = true;
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(x(), 60, 1e-9);
  EXPECT_NEAR(c(), 5, 1e-9);
  double value = 0;
  bool vacant = true;
  ASSERT_EQ(nc_variable_get(bench.control(), 0, 100, &value, &vacant), NC_OK);
  EXPECT_NEAR(value, stopped_at, 0.0005 + 1e-9);  // a position is read in whole units
}

TEST_P(CAxis, TheServoDoesNotComeOnInTheTappingMode) {  // 10.6.1, relation (4): operation error M01 1026
  start("S600\nG63 G1 Z-5. F300\nG4 P8\nZ-10.\nG64\nM30");
  ASSERT_TRUE(until([&] { return drive->out.tapping && drive->out.command.v[2] < -1; }));
  servo = true;
  ASSERT_TRUE(until([&] { return drive->out.cause == NC_CAUSE_TAP_SPINDLE; }));
  EXPECT_NEAR(drive->out.command.v[2], -5, 1e-9);
  EXPECT_EQ(drive->out.servo_on, 0) << "the tap is in the work";
  EXPECT_EQ(drive->out.spindle_rev_min[0], 600);
  servo = false;
  ASSERT_TRUE(until_end());
  EXPECT_NEAR(drive->out.command.v[2], -10, 1e-9);
}

}  // namespace
}  // namespace nc::test
