// SPDX-License-Identifier: Apache-2.0
// A drive that homes by itself: what stops motion by hand stops it, its brake closes where the drive lets the axis go, and it does not go on by itself.
#include <gtest/gtest.h>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::Command;
using nc::rt::CommandKind;
using nc::rt::Mode;
using nc::test::can_toml;
using nc::test::CanRig;

constexpr unsigned kLongWay = 3000;  // SYNCs that the drive needs to its switch

// X has a brake and is homed by its drive; inputs of the machine are macro inputs' neighbours.
std::string machine_text(const std::string& bus = "") {
  std::string text = can_toml(bus, "homing = { method = 17, fast = 20.0, slow = 2.0, acceleration = 200.0, position = -30.0, request = \"home_x\", done = \"x_homed\", timeout_s = 20.0 }\n");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
  };
  replace("[macro_interface]\n\"#1100\" = \"home_x\"\n\"#1000\" = \"x_homed\"\n",
          "[[point]]\nname = \"x_brake\"\ndirection = \"output\"\n[[point]]\nname = \"door\"\ndirection = \"input\"\n[[point]]\nname = \"go\"\ndirection = \"input\"\ninitial = 1\n[[point]]\nname = \"supply\"\n"
          "direction = \"input\"\ninitial = 1\n[[point]]\nname = \"off_x\"\ndirection = \"input\"\n"
          "[signals]\n\"plc.alarm.1\" = \"door\"\n\"plc.feed_hold_n\" = \"go\"\n\"plc.power_fail_n\" = \"supply\"\n\"plc.servo_off.X\" = \"off_x\"\n[power]\nstop_s = 1.0\nsettle_s = 0.05\n");
  replace("soft_limits = [-500.0, 500.0]\n", "soft_limits = [-500.0, 500.0]\nhoming = { kind = \"drive\", request = \"home_x\", done = \"x_homed\" }\nbrake = { point = \"x_brake\", open_s = 0.05, close_s = 0.1 }\n");
  return text;
}

class DriveHoming : public testing::Test {
 protected:
  void homing(const std::string& bus = "") {
    rig = std::make_unique<CanRig>(machine_text(bus));
    rig->drives[0]->homing_syncs = kLongWay;
    ASSERT_NO_FATAL_FAILURE(rig->bring_up());
    rig->step(100);
    ASSERT_TRUE(brake_open());
    manual_mode();
    ASSERT_EQ(home_all(), Answer::kDone);
    ASSERT_TRUE(rig->until([this] { return moves(); }, 500)) << rig->alarms();
    ASSERT_TRUE(brake_open());
  }
  void manual_mode() { ASSERT_EQ(rig->run(CommandKind::kSetMode, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone); }
  Answer home_all() {
    Command home;
    home.kind = CommandKind::kHome;
    home.system = nc::rt::kAllSystems;
    return rig->runtime->execute(home);
  }
  bool moves() {
    const double before = rig->plant_mm(0);
    rig->step(2);
    return std::abs(rig->plant_mm(0) - before) > 1e-3;
  }
  bool brake_open() const { return (rig->runtime->snapshot().system[0].axes.brake_open & 1u) != 0; }
  bool is_homing() const { return rig->runtime->snapshot().system[0].axes.homing != 0; }
  void in(const char* name, std::uint32_t value) { rig->shell.inputs[static_cast<unsigned>(rig->config.points.find(name))] = value; }
  void reset() {
    ASSERT_EQ(rig->runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(rig->until([this] { return !rig->runtime->snapshot().resetting; }, 3000));
  }
  // It has come to rest within `most` scans, and nothing moves before somebody asks for it.
  void expect_rest(unsigned most, const char* what) {
    ASSERT_TRUE(rig->until([this] { return !moves(); }, most)) << what;
    rig->step(60);  // the end of its ramp
    const double stands = rig->plant_mm(0);
    rig->step(500);
    EXPECT_NEAR(rig->plant_mm(0), stands, 1e-3) << what;
    EXPECT_FALSE(is_homing()) << what;
    EXPECT_EQ(rig->runtime->snapshot().system[0].axes.homed & 1u, 0u) << what;
  }
  // And it can be homed then.
  void expect_homes() {
    rig->drives[0]->homing_syncs = 50;
    rig->step(300);
    ASSERT_TRUE(rig->until([this] { return rig->following() && brake_open(); }, 3000)) << rig->alarms();
    rig->step(100);
    ASSERT_EQ(home_all(), Answer::kDone) << rig->alarms();
    rig->step(5);
    ASSERT_TRUE(rig->until([this] { return !is_homing(); }, 3000)) << rig->alarms();
    EXPECT_EQ(rig->alarms(), "");
    EXPECT_EQ(rig->runtime->snapshot().system[0].axes.homed & 1u, 1u);
    rig->step(50);
    EXPECT_NEAR(rig->plant_mm(0), 0, 1e-3);
    EXPECT_NEAR(rig->command(0), -30, 1e-3);
  }
  std::unique_ptr<CanRig> rig;
};

// A safety input takes the torque: nothing but the brake holds the axis then, and behind it the drive does not home on.
TEST_F(DriveHoming, TheBrakeClosesWhereTheDriveLetsTheAxisGo) {
  ASSERT_NO_FATAL_FAILURE(homing());
  rig->drives[0]->never_enables = true;
  rig->drives[0]->leave_enabled(0);
  rig->step(5);
  EXPECT_FALSE(brake_open());
  EXPECT_NE(rig->alarms().find("R12"), std::string::npos) << rig->alarms();
  rig->drives[0]->never_enables = false;
  expect_rest(300, "the torque is back");
  ASSERT_NO_FATAL_FAILURE(reset());
  expect_rest(300, "behind the reset");
  expect_homes();
}

TEST_F(DriveHoming, AnAlarmAndAResetStopIt) {
  for (const bool by_reset : {false, true}) {
    SCOPED_TRACE(by_reset);
    ASSERT_NO_FATAL_FAILURE(homing());
    if (by_reset) {
      ASSERT_NO_FATAL_FAILURE(reset());
    } else {
      in("door", 1);
    }
    expect_rest(300, "behind it");
    EXPECT_TRUE(brake_open()) << "drives hold";
    EXPECT_TRUE(rig->drives[0]->enabled());
    in("door", 0);
    ASSERT_NO_FATAL_FAILURE(reset());
    expect_rest(300, "behind the reset");
    expect_homes();
  }
}

TEST_F(DriveHoming, FeedHoldAndAnotherModeStopIt) {
  for (const bool by_mode : {false, true}) {
    SCOPED_TRACE(by_mode);
    ASSERT_NO_FATAL_FAILURE(homing("sync_us = 2000\n"));
    if (by_mode) {
      ASSERT_EQ(rig->run(CommandKind::kSetMode, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kDone);
    } else {
      in("go", 0);
    }
    expect_rest(600, "behind it");
    in("go", 1);
    manual_mode();
    expect_rest(300, "it does not go on by itself");
    EXPECT_EQ(rig->alarms(), "");
    expect_homes();
  }
}

// The drives go off when the axes stand, which this one is not led to.
TEST_F(DriveHoming, APowerFailureIsAtRestWhenTheDriveIs) {
  ASSERT_NO_FATAL_FAILURE(homing());
  in("supply", 0);
  bool closed_moving = false;
  for (unsigned n = 0; n < 200; ++n) {
    const bool open = brake_open(), moving = moves();
    closed_moving |= !open && moving;
  }
  EXPECT_FALSE(closed_moving) << "the brake closes when the axis stands";
  EXPECT_FALSE(brake_open());
  EXPECT_NE(rig->alarms().find("came to rest on their paths within"), std::string::npos) << rig->alarms();
}

TEST_F(DriveHoming, ServoOffWaitsForItsEnd) {
  ASSERT_NO_FATAL_FAILURE(homing());
  rig->drives[0]->homing_syncs = 50;
  in("off_x", 1);
  for (unsigned n = 0; n < 2000 && is_homing(); ++n) {
    ASSERT_TRUE(brake_open() || !moves()) << n;
    rig->step(1);
  }
  ASSERT_TRUE(rig->until([this] { return !brake_open(); }, 3000));
  EXPECT_EQ(rig->alarms(), "");
}

}  // namespace
