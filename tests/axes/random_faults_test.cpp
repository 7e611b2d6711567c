// SPDX-License-Identifier: Apache-2.0
// Causes of docs/safety.md at random moments, alone, together and one behind another, while an operator does anything: in rapid traverse, cuts, taps, homing, jogs, feed holds and
// returns to the path. In every scan: the brake of Z is open only where its drive holds, and the drive goes off only behind the brake; behind an alarm everything comes to
// rest, and nothing moves before somebody has asked for it.
#include "random_machine.hpp"

namespace {

using nc::rt::AlarmId;
using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr const char* kAnyProgram =
    "G90 G53 G0 X-20. Y10. Z-20.\nN1 G91\nG84 X2. Y1. Z-10. R-2. S600 F1.5 P50 ,R1\nG80\nG1 X60. Y-40. Z5. F9000\nG2 X20. Y20. I20. J0. F4000\nM8\nG4 X0.1\nG0 X-60. Y30. Z8.\nG1 X-22. Y-11. Z-1. F6000\nGOTO 1\n";

class RandomFaults : public nc::test::RandomMachine {
 protected:
  static std::string machine_text() {
    std::string inputs = nc::test::input_points({"supply", "contact_n", "go_all", "z_free_p", "z_free_m"}, {"contact", "tap_out", "mode_hand", "mode_auto", "back_x", "reset_button"});
    inputs +=
        "[signals]\n\"plc.power_fail_n\" = \"supply\"\n\"plc.alarm.1\" = \"contact\"\n\"plc.interlock_n\" = \"go_all\"\n\"plc.interlock_p_n.Z\" = \"z_free_p\"\n\"plc.interlock_m_n.Z\" = \"z_free_m\"\n"
        "\"plc.tap_retract\" = \"tap_out\"\n\"plc.mode_manual\" = \"mode_hand\"\n\"plc.mode_auto\" = \"mode_auto\"\n\"plc.restart_approach.X\" = \"back_x\"\n\"plc.reset\" = \"reset_button\"\n";
    std::string text = changed({{"[signals]\n", inputs.c_str()}, {"[sim]\n", "[sim]\nspindle_ramp_rpm_per_s = 3000.0\n"}, {"servo_lag_ms = 2.0", "servo_lag_ms = 2.0\nfollowing_error_limit = 1.0"}});
    return text + "[power]\nstop_s = 0.5\nsettle_s = 0.03\n[parameters]\n\"3005\" = 3000\n\"3013\" = 600\n\"3017\" = 250\n[scheduling]\noverrun = \"alarm\"\noverrun_limit = 3\n";
  }

  // ---- the operator ----

  void operate() override {
    const unsigned axis = below(3);
    switch (below(22)) {
      case 0:
      case 1: jog_ = {0, axis, either_way(1 + below(90)), 1 + below(1500)}; break;
      case 2: asked(ask(CommandKind::kStep, axis, either_way(below(60)))); break;
      case 3: asked(ask(CommandKind::kHome, axis)); break;
      case 4: asked(home_all()); break;
      case 5: asked(ask(CommandKind::kReference, axis)); break;
      case 6:
      case 7: (void)ask(CommandKind::kReset); break;
      case 8: (void)ask(CommandKind::kFeedHold); break;
      case 9: asked(ask(CommandKind::kCycleStart)); break;
      case 10: press("start"); break;
      case 11: press("mode_hand"); break;
      case 12: press("mode_auto"); break;
      case 13: press("reset_button"); break;
      case 14: press("tap_out", 1 + below(2000)); break;
      case 15: press("back_x", 1 + below(500)); break;
      case 16:
      case 17:
      case 18:  // a program that runs
        (void)ask(CommandKind::kReset);
        (void)mode(Mode::kAuto);
        asked(ask(CommandKind::kCycleStart));
        break;
      case 19:  // by hand in a feed hold
        (void)ask(CommandKind::kFeedHold);
        held_mode_ = 300;
        break;
      case 20: (void)mode(static_cast<Mode>(below(3))); break;
      default: asked(ask(CommandKind::kApproach, axis, 40)); break;
    }
  }
  // ---- causes, for so many scans ----
  void cause() override {
    const unsigned scans = below(3) == 0 ? 1 + below(3) : 1 + below(400), axis = below(3);
    switch (below(12)) {
      case 0: drive_[0][axis] = scans; break;
      case 1: bus_ = 1 + scans / 4; break;
      case 2: blocked_[0] = 100 + scans; break;
      case 3: hold("supply", 0, scans); break;
      case 4: hold("contact", 1, scans); break;
      case 5: hold("x_go", 0, scans); break;
      case 6: hold("go_all", 0, scans); break;
      case 7: hold("z_servo_off", 1, scans * 3); break;
      case 8: hold(below(2) == 0 ? "z_free_p" : "z_free_m", 0, scans); break;
      case 9: hold(below(2) == 0 ? "x_free_p" : "x_free_m", 0, scans); break;
      case 10: clock.advance(1'000'000 * (1 + below(6))); break;
      default: hold("supply", 0, 1); break;
    }
  }
  // Somebody who looks at the edge of the tool in a feed hold.
  void go_by_hand() {
    if (held_mode_ > 0 && --held_mode_ == 0) {
      (void)mode(Mode::kManual);
      asked(ask(CommandKind::kStep, kX, 5));
      back_ = 600;
    }
    if (back_ > 0 && --back_ % 50 == 0 && back_ < 400) asked(ask(CommandKind::kApproach, kX, 40));
  }

  // ---- what is looked at ----

  void look() override {
    go_by_hand();
    const nc::rt::Snapshot now = runtime->snapshot();
    const nc_outputs& nc = now.system[0].nc;
    const int scans = scans_since(now);
    look_at_brake(0, kZ, measured->last, nc, brake_open(), 200, scans);
    ASSERT_FALSE(nc.state == NC_STATE_RUNNING && now.mode == Mode::kManual) << "a program in mode manual";
    stopped_for_ = now.stopped_by_alarm() ? stopped_for_ + scans : 0;
    ASSERT_TRUE(stopped_for_ <= kStopScans || nc.distance_zero || nc.followed) << "an alarm, and it moves";
    quiet_ |= stopped_for_ > kStopScans;
    if (!quiet_) moved_ = measured->moved;
    ASSERT_EQ(measured->moved, moved_) << "nobody has asked for that";
    ASSERT_LE(measured->fastest, 1.001);
    ASSERT_LE(measured->hardest, 1.001);
    ran_ += nc.state == NC_STATE_RUNNING && !nc.distance_zero;
    tapped_ += nc.tapping != 0;
    returned_ += nc.state == NC_STATE_MANUAL && nc.restart_axes != 0;
    quiets_ += quiet_;
    for (unsigned i = 0; i < now.alarms.count; ++i) seen_[static_cast<unsigned>(now.alarms.alarm[i].id)] = true;
  }
  void begin() override {
    moving_buttons = {"tap_out", "back_x"};
    held_mode_ = back_ = 0;
    ASSERT_NO_FATAL_FAILURE(build(machine_text()));
    if (below(4) != 0) {
      ASSERT_NO_FATAL_FAILURE(home_machine());
    }
    load(kAnyProgram);
    moved_ = measured->moved;
  }

  unsigned held_mode_ = 0, back_ = 0;
  std::uint64_t moved_ = 0, ran_ = 0, tapped_ = 0, returned_ = 0, quiets_ = 0;
  std::array<bool, static_cast<unsigned>(AlarmId::kCount)> seen_{};
};

TEST_F(RandomFaults, TheBrakeHoldsAndNothingMovesUnasked) {
  const std::uint64_t seeds = nc::test::wish("NC_SEEDS", 8);
  ASSERT_NO_FATAL_FAILURE(run_seeds(nc::test::wish("NC_FIRST_SEED", 1), seeds, 30000));
  if (seeds < 8) return;  // a few that were wished show what they show
  EXPECT_GT(ran_, 1000u) << "else it shows little";
  EXPECT_GT(tapped_, 100u);
  EXPECT_GT(quiets_, 1000u);
  for (const AlarmId id : {AlarmId::kDriveFault, AlarmId::kHalLost, AlarmId::kFollowingError, AlarmId::kPowerFails, AlarmId::kLadder, AlarmId::kScanOverrun})
    EXPECT_TRUE(seen_[static_cast<unsigned>(id)]) << nc::rt::alarm_row(id).text;
  std::printf("%u scans of programs, %u in taps, %u back to the path, %u behind alarms\n", static_cast<unsigned>(ran_), static_cast<unsigned>(tapped_), static_cast<unsigned>(returned_),
              static_cast<unsigned>(quiets_));
}

}  // namespace
