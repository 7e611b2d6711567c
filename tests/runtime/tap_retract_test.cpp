// SPDX-License-Identifier: Apache-2.0
// A tap that stands in its hole is drawn out by hand: what keeps an axis from motion by hand keeps the tap, too, and it does not go on by itself when that has gone.
#include <gtest/gtest.h>

#include "ladder_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr const char* kTapping = "G90 G0 Z10.\nG84 X0 Y0 Z-8. R2. S600 F1.5 P100 ,R1\nG80\nM30\n";

class TapRetract : public nc::test::LadderMachine {
 protected:
  void SetUp() override {
    std::string text = nc::test::base_toml();
    const std::string z = "soft_limits = [-300.0, 300.0]\n";
    text.insert(text.find(z) + z.size(), "brake = { point = \"z_brake\", open_s = 0.1, close_s = 0.2 }\nlimit_switches = { plus = \"z_max\" }\n");
    const std::string ramp = "spindle_ramp_rpm_per_s = 100000.0";
    text.replace(text.find(ramp), ramp.size(), "spindle_ramp_rpm_per_s = 3000.0");
    text += "[parameters]\n\"3005\" = 3000\n\"3013\" = 600\n\"3017\" = 250\n[[point]]\nname = \"z_brake\"\ndirection = \"output\"\n";
    for (const char* name : {"out_of_hole", "servo_off", "z_free", "free", "go", "z_max", "contact"})
      text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\ninitial = " + (name[0] == 'o' || name[0] == 's' || name[0] == 'c' ? "0" : "1") + "\n";
    text += "[signals]\n\"plc.tap_retract\" = \"out_of_hole\"\n\"plc.servo_off.Z\" = \"servo_off\"\n\"plc.interlock_p_n.Z\" = \"z_free\"\n\"plc.interlock_n\" = \"free\"\n\"plc.feed_hold_n\" = \"go\"\n\"plc.alarm.1\" = \"contact\"\n";
    config = nc::test::parse_or_fail(text);
  }
  double z() const { return out().command.v[2]; }
  void in(const char* name, std::uint32_t value) { machine->set_input(static_cast<unsigned>(config.points.find(name)), value); }
  void steps(unsigned count) {
    while (count-- > 0) runtime->step();
  }
  void into_the_hole() {
    runtime.reset();
    build();
    steps(300);
    start(kTapping);
    ASSERT_GE(until([&] { return out().tapping && z() < -3; }), 0);
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE && out().tap_retract_possible && !runtime->snapshot().resetting; }), 0);
    steps(500);
    stood = z();
  }
  void manual_mode() { ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone); }
  Answer command(bool on) { return runtime->execute(CommandKind::kTapRetract, 0, on ? 1 : 0); }
  void ask(bool by_command, bool on) {
    if (by_command) (void)command(on);
    else in("out_of_hole", on);
  }
  void expect_still(unsigned scans, const char* what) {
    steps(scans);
    EXPECT_EQ(z(), stood) << what;
  }
  // Behind a new press it comes out.
  void expect_out(bool by_command) {
    ask(by_command, false);
    steps(5);
    ask(by_command, true);
    ASSERT_GE(until([&] { return !out().tap_retract_possible && out().state == NC_STATE_IDLE; }, 20000), 0);
    EXPECT_NEAR(z(), 2, 2e-3);
  }
  double stood = 0;
};

TEST_F(TapRetract, InAnotherModeThanManualNothingMoves) {
  into_the_hole();
  in("out_of_hole", 1);
  expect_still(500, "in the mode automatic");
  manual_mode();
  expect_still(500, "it was on before");
  expect_out(false);
}

// A reset makes it possible: the press that comes in just that scan counts no more than one before.
TEST_F(TapRetract, APressThatMeetsTheEndOfAResetMovesNothingInAnotherMode) {
  into_the_hole();
  for (unsigned later = 0; later < 40; ++later) {
    SCOPED_TRACE(later);
    in("contact", 1);
    steps(20);
    in("contact", 0);
    steps(3);
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    steps(later);
    in("out_of_hole", 1);
    steps(50);
    in("out_of_hole", 0);
    steps(100);
    ASSERT_EQ(z(), stood);
  }
}

TEST_F(TapRetract, WaitsForTheBrake) {
  for (const bool by_command : {false, true}) {
    SCOPED_TRACE(by_command);
    into_the_hole();
    manual_mode();
    in("servo_off", 1);
    ASSERT_GE(until([&] { return point("z_brake") == 0; }, 100), 0);
    steps(400);
    stood = z();
    ask(by_command, true);
    expect_still(200, "its drive is off");
    ask(by_command, false);
    in("servo_off", 0);
    ASSERT_GE(until([&] { return point("z_brake") != 0; }, 400), 0);
    ask(by_command, true);
    expect_still(60, "its brake opens yet");
    steps(200);
    expect_still(200, "it was refused, and does not begin by itself");
    expect_out(by_command);
  }
}

TEST_F(TapRetract, WhatStopsMotionByHandStopsIt) {
  for (const bool by_command : {false, true}) {
    for (const char* name : {"z_free", "free", "go", "contact", "z_max"}) {
      SCOPED_TRACE(std::string(name) + (by_command ? ", by a command" : ", by the signal"));
      const bool stops_with = std::string(name) == "contact";
      into_the_hole();
      manual_mode();
      ask(by_command, true);
      ASSERT_GE(until([&] { return z() > stood + 0.5; }, 5000), 0);
      in(name, stops_with ? 1 : 0);
      ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0);
      stood = z();
      ASSERT_LT(stood, 1);
      expect_still(300, "stopped");
      in(name, stops_with ? 0 : 1);
      if (runtime->snapshot().stopped_by_alarm()) {
        ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
        ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }), 0);
      }
      expect_still(500, "it does not go on by itself");
      expect_out(by_command);
    }
  }
}

// Given up anywhere in the hole, axis and spindle come to rest, and stay there.
TEST_F(TapRetract, InItsHoleTheTapRests) {
  build();
  steps(300);
  start(kTapping);
  for (unsigned n = 0; n < 60; ++n) {
    SCOPED_TRACE(n);
    ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kDone);
    if (n > 0) {
      ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    }
    ASSERT_GE(until([&] { return out().tapping && z() < 1; }), 0);
    steps(17 * n + n % 5);
    if (!out().tapping) break;
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE && !runtime->snapshot().resetting; }), 0);
    steps(700);
    stood = z();
    unsigned moved = 0;
    for (unsigned scan = 0; scan < 300; ++scan) {
      runtime->step();
      moved += !out().distance_zero;
    }
    EXPECT_EQ(moved, 0u);
    EXPECT_EQ(z(), stood);
    if (!out().tap_retract_possible) continue;
    manual_mode();
    ASSERT_EQ(command(true), Answer::kDone);
    ASSERT_GE(until([&] { return !out().tap_retract_possible && out().state == NC_STATE_IDLE; }, 20000), 0);
    (void)command(false);
    steps(200);
  }
}

// The way out of the hole leads on to a switch that is on already.
TEST_F(TapRetract, DoesNotGoOnToALimitSwitch) {
  into_the_hole();
  in("z_max", 0);
  steps(3);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }), 0);
  manual_mode();
  steps(5);
  in("out_of_hole", 1);
  steps(500);
  EXPECT_NEAR(z(), stood, 0.01) << "a scan sees which way it goes";
  in("z_max", 1);
  steps(100);
  expect_out(false);
}

}  // namespace
