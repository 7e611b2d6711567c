// SPDX-License-Identifier: Apache-2.0
// An operator at a machine with everything that hands move: three handwheels whose counters jump, a joystick whose wire breaks, jog buttons, steps, homing, and programs that
// are held, moved away from, led back and gone on with, while the emergency stop, resets, modes, overrides, servo and drive faults come at any moment. In every scan: no drive
// gets more than its limits, no axis goes further behind a limit switch than it needs for stopping, and where it says that it stands it stands. In the end all is let go: then
// the machine is homed again and makes its part.
#include <array>
#include <cstdlib>
#include <random>

#include "axes_machine.hpp"
#include "support/seeds.hpp"

namespace {

using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr double kScrewAcceleration = 1500;
constexpr const char* kBits[] = {"w1_x", "w1_y", "w1_z", "w2_x", "w2_y", "w3_z", "ten", "hundred", "grip", "jog_x_p", "jog_x_m", "jog_y_p", "jog_z_m", "stop_chain", "back_x", "back_y", "back_z", "rapid", "probe"};

std::string hand_points() {
  std::string text;
  for (const char* name : kBits) text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\n";
  for (const auto& [name, initial] : {std::pair{"wheel1", 0}, {"wheel2", 0}, {"wheel3", 0}, {"stick", 512}, {"jog_feed", 3'000'000}})
    text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\ntype = \"word\"\ninitial = " + std::to_string(initial) + "\n";
  text += "[[handwheel]]\ncounter = \"wheel1\"\nbits = 16\naxes = { X = \"w1_x\", Y = \"w1_y\", Z = \"w1_z\" }\ntimes_10 = \"ten\"\ntimes_100 = \"hundred\"\n";
  text += "[[handwheel]]\ncounter = \"wheel2\"\ncounts = 4\naxes = { X = \"w2_x\", Y = \"w2_y\" }\ntimes_100 = \"hundred\"\n";
  text += "[[handwheel]]\ncounter = \"wheel3\"\nbits = 8\naxes = { Z = \"w3_z\" }\n";
  return text + "[[joystick]]\naxis = \"X\"\ninput = \"stick\"\nlow = 0\nmiddle = 512\nhigh = 1023\ntop_speed = 150.0\ndead_man = \"grip\"\n";
}
constexpr const char* kHandSignals =
    "\"plc.jog_p.X\" = \"jog_x_p\"\n\"plc.jog_m.X\" = \"jog_x_m\"\n\"plc.jog_p.Y\" = \"jog_y_p\"\n\"plc.jog_m.Z\" = \"jog_z_m\"\n\"plc.jog_feed\" = \"jog_feed\"\n"
    "\"plc.jog_rapid\" = \"rapid\"\n\"plc.alarm.1\" = \"stop_chain\"\n\"plc.restart_approach.X\" = \"back_x\"\n\"plc.restart_approach.Y\" = \"back_y\"\n\"plc.restart_approach.Z\" = \"back_z\"\n"
    "\"plc.skip.1\" = \"probe\"\n";

class HandOperator : public nc::test::AxesMachine {
 protected:
  static std::string hand_toml(int stands_at) {
    std::string text = std::string(nc::test::kAxesToml) + hand_points() + nc::test::axes_points() + kHandSignals + nc::test::kAxesSim;
    std::string table = "screw = { from = -320.0, step = 20.0, backlash = 0.05, acceleration = 1500.0, error = [";
    for (int n = 0; n <= 32; ++n) table += (n > 0 ? ", " : "") + std::to_string(0.03 * std::sin(n * 0.7));
    for (const auto& [from, to] : {std::pair{std::string("limit_switches = { minus = \"x_min\""), table + "] }\nlimit_switches = { minus = \"x_min\""},
                                   {std::string("stands_at = -37.5"), "stands_at = " + std::to_string(stands_at)}}) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    return text;
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }

  void turn_wheels() {
    constexpr const char* kWheels[] = {"wheel1", "wheel2", "wheel3"};
    for (unsigned n = 0; n < 3; ++n) {
      if (below(400) == 0) turning_[n] = static_cast<int>(below(9)) - 4;
      if (below(6000) == 0) wheel_[n] += static_cast<std::uint32_t>(random_());  // the counter jumps
      if (below(3) == 0) wheel_[n] += static_cast<std::uint32_t>(below(20) == 0 ? -turning_[n] : turning_[n]);
      in(kWheels[n], wheel_[n]);
    }
    if (below(500) == 0) stick_ = below(3) == 0 ? 512 : below(12) == 0 ? static_cast<int>(random_()) : static_cast<int>(below(1024));
    in("stick", static_cast<std::uint32_t>(stick_));
  }
  void work_switch() {
    const char* name = kBits[below(static_cast<unsigned>(std::size(kBits)))];
    const bool rare = std::string(name) == "stop_chain";
    in(name, below(rare ? 6 : 2) == 0 ? 1 : 0);
  }
  void do_anything() {
    const unsigned axis = below(3);
    const double direction = below(2) == 0 ? 1 : -1;
    switch (below(18)) {
      case 0: jog_axis_ = axis, jog_velocity_ = direction * (1 + below(200)), jog_left_ = 1 + below(2000); break;
      case 1: (void)ask(CommandKind::kStep, axis, direction * below(50)); break;
      case 2: (void)ask(CommandKind::kHome, axis); break;
      case 3: (void)home_all(); break;
      case 4: (void)ask(CommandKind::kReference, axis); break;
      case 5: (void)ask(CommandKind::kReset); break;
      case 6:
      case 7: (void)ask(CommandKind::kSetMode, 0, static_cast<double>(Mode::kManual)); break;
      case 8:
      case 9:
      case 10:
        (void)ask(CommandKind::kSetMode, 0, static_cast<double>(Mode::kAuto));
        (void)ask(CommandKind::kCycleStart);
        break;
      case 11: (void)ask(CommandKind::kFeedHold); break;
      case 12: (void)ask(CommandKind::kFeedOverride, 0, below(4) == 0 ? 0 : below(200) / 100.0); break;
      case 13: (void)ask(CommandKind::kRapidOverride, 0, below(4) == 0 ? 0 : below(101) / 100.0); break;
      case 14: back_axis_ = axis, back_left_ = 1 + below(1500); break;
      case 15:
        in(below(2) == 0 ? "x_go" : below(2) == 0 ? "x_free_p" : "x_free_m", below(3) != 0);
        break;
      case 16: in("z_servo_off", below(3) == 0); break;
      case 17:
        if (below(4) == 0) fault_left_ = 1 + below(50), fault_axis_ = axis;
        if (below(8) == 0) bus_left_ = 1 + below(20);
        break;
    }
  }
  void scan() {
    turn_wheels();
    if (below(60) == 0) work_switch();
    if (jog_left_ > 0 && --jog_left_ % 50 == 0) (void)ask(CommandKind::kJog, jog_axis_, jog_left_ == 0 ? 0 : jog_velocity_);
    if (back_left_ > 0 && --back_left_ % 50 == 0) (void)ask(CommandKind::kApproach, back_axis_, 30);
    if (fault_left_ > 0) machine->fail_drive(0, fault_axis_, --fault_left_ > 0);
    if (bus_left_ > 0) machine->fail_bus(--bus_left_ > 0);
    runtime->step();
    if (std::getenv("NC_LOG") != nullptr) show();
  }
  // One line for each scan: what was asked for and what came of it.
  void show() const {
    const nc::rt::Snapshot all = runtime->snapshot();
    const nc_outputs& now = all.system[0].nc;
    std::printf("state %d cause %d alarms %u fault %u bus %u | homed %u homing %u limits %u %u brake %d off %u |", now.state, now.cause, all.alarms.count, fault_left_, bus_left_, flags().homed, flags().homing,
                flags().limit[0], flags().limit[1], brake_open(), measured->last.off);
    for (unsigned a = 0; a < 3; ++a) std::printf(" %.5f %.5f %.5f %.5f", now.command.v[a], now.velocity.v[a], measured->last.position.v[a], place(a));
    std::printf("\n");
  }
  void look(unsigned n) {
    const nc::rt::AxisFlags now = flags();
    ASSERT_LE(measured->fastest_of[kX], 1.001 + 0.25 + 0.02) << n;
    ASSERT_LE(measured->hardest_of[kX], 1.001 + kScrewAcceleration / 2000 + 0.03) << n;
    for (const unsigned axis : {kY, kZ}) {
      ASSERT_LE(measured->fastest_of[axis], 1.001) << n << " axis " << axis;
      ASSERT_LE(measured->hardest_of[axis], 1.001) << n << " axis " << axis;
    }
    const nc::rt::Snapshot all = runtime->snapshot();
    const bool stood = all.system[0].nc.distance_zero;
    stood_ = stood && all.alarms.count == 0 ? stood_ + 1 : 0;
    for (unsigned a = 0; a < 3; ++a) {
      const double wrong = stood_ > 300 ? 0.008 : 200 * config.nc.cycle_s + 0.06;  // two scans at creep speed, and the noise of nothing
      const bool knows = (now.homed >> a & 1u) != 0;
      ASSERT_NEAR(knows ? all.system[0].actual.v[a] + now.screw[a] - place(a) : 0, 0, wrong) << n << " axis " << a;
      homed_ |= knows;
    }
    const double most[] = {320, 320, 140};  // Z is heavy: without its drive it falls a little while its brake closes
    for (unsigned a = 0; a < 3; ++a) {
      const nc_axis_config& limits = config.nc.system[0].axis[a];
      const double v = limits.max_velocity * 1.25, at = place(a);
      ASSERT_LE(a == kZ ? at : std::abs(at), most[a] + v * v / (2 * limits.max_acceleration) + v * (0.005 + limits.max_acceleration / (2 * limits.max_jerk) + 0.06)) << n << " axis " << a;
    }
  }
  void let_all_go() {
    for (const char* name : kBits) in(name, 0);
    for (const char* name : {"x_go", "x_free_p", "x_free_m"}) in(name, 1);
    in("z_servo_off", 0);
    in("stick", 512);
    machine->fail_bus(false);
    for (unsigned a = 0; a < 3; ++a) {
      machine->fail_drive(0, a, false);
      (void)ask(CommandKind::kJog, a, 0);
    }
    jog_left_ = back_left_ = fault_left_ = bus_left_ = 0;
    (void)ask(CommandKind::kFeedOverride, 0, 1);
    (void)ask(CommandKind::kRapidOverride, 0, 1);
  }

  std::mt19937 random_;
  std::array<std::uint32_t, 3> wheel_{};
  std::array<int, 3> turning_{};
  int stick_ = 512;
  unsigned jog_axis_ = 0, jog_left_ = 0, back_axis_ = 0, back_left_ = 0, fault_left_ = 0, fault_axis_ = 0, bus_left_ = 0, stood_ = 0;
  double jog_velocity_ = 0;
  bool homed_ = false;
};

TEST_F(HandOperator, MovesNothingBeyondItsLimitsAndTheMachineMakesItsPartBehindIt) {
  const unsigned first = static_cast<unsigned>(nc::test::wish("NC_FIRST_SEED", 1)), seeds = static_cast<unsigned>(nc::test::seeds(8, 2));
  std::uint64_t homed = 0, moved = 0;
  for (unsigned seed = first; seed < first + seeds && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_.seed(seed);
    stick_ = 512, stood_ = 0, homed_ = false;
    build(hand_toml(static_cast<int>(below(600)) - 300));
    load("G90 G53 G0 X-280. Y100. Z-30.\nG53 G1 X250. Y-200. Z20. F9000\nG2 X200. Y-200. I-25. J0.\nG31 Z-40. F600\nG53 G0 X0. Y0. Z0.\nM30\n");
    manual_mode();
    if (below(2) == 0) home_machine();
    for (unsigned n = 0; n < 30000 && !HasFatalFailure(); ++n) {
      if (below(flags().homing != 0 ? 5000 : 250) == 0) do_anything();
      scan();
      look(n);
    }
    if (HasFatalFailure()) break;
    let_all_go();
    steps(300);
    reset();
    steps(3000);
    manual_mode();
    for (unsigned a = 0; a < 3; ++a) {  // from the limit switches, and from behind the dogs
      const double at = place(a);
      if (std::abs(at) < 100) continue;
      jog(a, at > 0 ? -20 : 20, static_cast<int>((std::abs(at) - 90) / 20 * 1000));
      ASSERT_TRUE(let_go(a));
      reset();
      steps(500);
    }
    ASSERT_EQ(alarm(), "");
    home_machine();
    if (HasFatalFailure()) break;
    ASSERT_EQ(ask(CommandKind::kSetMode, 0, static_cast<double>(Mode::kAuto)), nc::rt::Answer::kDone);
    ASSERT_EQ(ask(CommandKind::kCycleStart), nc::rt::Answer::kDone) << refusal();
    ASSERT_GE(until([&] { return out().state == NC_STATE_RUNNING; }), 0);
    ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE || out().state == NC_STATE_ALARM; }, 100000), 0) << static_cast<int>(out().state) << " cause " << static_cast<int>(out().cause);
    nc_alarm told{};
    (void)nc_alarm_get(runtime->control(), 0, &told);
    ASSERT_EQ(alarm(), "") << told.code << " " << told.detail.s << " line " << told.source.line;
    steps(300);
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(place(a) - flags().screw[a], 0, 0.008) << a;
    homed += homed_;
    moved += measured->moved;
  }
  EXPECT_GE(homed, 1u);
  EXPECT_GE(moved, 10000u);
}

}  // namespace
