// SPDX-License-Identifier: Apache-2.0
// A simulated machine of three axes with dogs, limit switches, an index pulse and a brake, which measures what its drives are given.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <string>

#include "hal/sim/sim_machine.hpp"
#include "runtime/refusal.hpp"
#include "runtime/runtime.hpp"

namespace nc::test {

// Of each drive: the largest velocity and acceleration that it was given while it was on, as shares of what its axis may.
class MeasuredMachine final : public hal::Hal {
 public:
  MeasuredMachine(const rt::Config& config, hal::SimMachine* machine) : config_(config), machine_(machine) {}
  bool start(const hal::PointImage& initial, std::string* error) override { return machine_->start(initial, error); }
  void read(hal::Feedback* feedback, hal::PointImage* image) noexcept override {
    machine_->read(feedback, image);
    if (lies) feedback->system[0].spindle[0].rev_per_s = std::nan("");
  }
  void write(const hal::Command& command, const hal::PointImage& image) noexcept override {
    const hal::SystemCommand& system = command.system[0];
    for (unsigned a = 0; a < config_.nc.system[0].axis_count; ++a) measure(a, system);
    last = system;
    machine_->write(command, image);
  }
  void stop() noexcept override { machine_->stop(); }

  hal::SystemCommand last{};
  bool lies = false;  // the measured speed of the spindle is no number
  double fastest = 0, hardest = 0;  // of all; set back with forget()
  double fastest_of[NC_MAX_AXES] = {}, hardest_of[NC_MAX_AXES] = {};
  void forget() {
    fastest = hardest = 0;
    std::fill(std::begin(fastest_of), std::end(fastest_of), 0.0);
    std::fill(std::begin(hardest_of), std::end(hardest_of), 0.0);
  }
  std::uint64_t moved = 0;  // scans in which a drive was given another place

 private:
  void measure(unsigned a, const hal::SystemCommand& command) noexcept {
    const nc_axis_config& axis = config_.nc.system[0].axis[a];
    const double dt = config_.nc.cycle_s;
    const bool on = command.enable && (command.off >> a & 1u) == 0;
    if (!on) return void(known_[a] = 0);
    const double velocity = (command.position.v[a] - at_[a]) / dt;
    if (known_[a] >= 1) fastest_of[a] = std::max(fastest_of[a], std::abs(velocity) / axis.max_velocity);
    if (known_[a] >= 2) hardest_of[a] = std::max(hardest_of[a], std::abs(velocity - velocity_[a]) / dt / axis.max_acceleration);
    fastest = std::max(fastest, fastest_of[a]);
    hardest = std::max(hardest, hardest_of[a]);
    moved += known_[a] >= 1 && velocity != 0;
    at_[a] = command.position.v[a];
    velocity_[a] = velocity;
    known_[a] = std::min(known_[a] + 1, 2);
  }

  const rt::Config& config_;
  hal::SimMachine* machine_;
  double at_[NC_MAX_AXES] = {}, velocity_[NC_MAX_AXES] = {};
  int known_[NC_MAX_AXES] = {};
};

// Where the marks are, the machine's coordinates are its places.
inline constexpr const char* kAxesToml = R"([machine]
name = "axes"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
max_jerk = 50000.0
soft_limits = [-300.0, 300.0]
servo_lag_ms = 2.0
homing = { kind = "switch", direction = "-", fast = 40.0, creep = 2.0, dog = "x_dog", offset = 290.0, order = 2 }
limit_switches = { minus = "x_min", plus = "x_max" }
[[axis]]
name = "Y"
max_velocity = 150.0
max_acceleration = 1500.0
max_jerk = 50000.0
soft_limits = [-300.0, 300.0]
servo_lag_ms = 2.0
homing = { kind = "limit", direction = "+", fast = 60.0, creep = 3.0, offset = -320.0, order = 2 }
limit_switches = { minus = "y_min", plus = "y_max" }
[[axis]]
name = "Z"
max_velocity = 100.0
max_acceleration = 1000.0
max_jerk = 50000.0
soft_limits = [-120.0, 120.0]
servo_lag_ms = 2.0
homing = { kind = "switch", direction = "+", edge = "leave", fast = 30.0, creep = 2.0, dog = "z_dog", index = "z_index", index_travel = 6.0, offset = -135.0, order = 1 }
limit_switches = { minus = "z_min", plus = "z_max" }
brake = { point = "z_brake", open_s = 0.1, close_s = 0.2 }
)";

inline std::string axes_points() {
  std::string text;
  for (const char* name : {"x_dog", "x_min", "x_max", "y_min", "y_max", "z_dog", "z_index", "z_min", "z_max"})
    text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\n";
  for (const char* name : {"home", "x_free_p", "x_free_m", "x_go", "z_servo_off", "start"})
    text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\ninitial = " + (name[1] == '_' && name[0] == 'x' ? "1" : "0") + "\n";
  text += "[[point]]\nname = \"z_brake\"\ndirection = \"output\"\n";
  text +=
      "[signals]\n\"plc.home\" = \"home\"\n\"plc.interlock_p_n.X\" = \"x_free_p\"\n\"plc.interlock_m_n.X\" = \"x_free_m\"\n\"plc.servo_off.Z\" = \"z_servo_off\"\n"
      "\"plc.cycle_start\" = \"start\"\n\"plc.feed_hold_n\" = \"x_go\"\n";
  return text;
}

inline constexpr const char* kAxesSim = R"([sim]
m_time_s = 0.004
[[sim.axis]]
name = "X"
stands_at = -37.5
dog = [-310.0, -290.0]
minus = -320.0
plus = 320.0
[[sim.axis]]
name = "Y"
stands_at = 12.25
minus = -320.0
plus = 320.0
[[sim.axis]]
name = "Z"
stands_at = 3.0
dog = [125.0, 130.0]
index = [10.0, 5.0]
minus = -140.0
plus = 140.0
weight = 9810.0
)";

class AxesMachine : public testing::Test {
 protected:
  static std::string toml() { return kAxesToml + axes_points() + kAxesSim; }
  // With each `from` replaced by its `to`.
  static std::string changed(std::initializer_list<std::pair<const char*, const char*>> changes) {
    std::string text = toml();
    for (const auto& [from, to] : changes) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      if (at != std::string::npos) text.replace(at, std::string(from).size(), to);
    }
    return text;
  }
  void build(const std::string& text = toml(), int settle = 150) {
    runtime.reset();
    config = rt::Config();
    for (const rt::ConfigError& error : rt::parse_config(text, "axes.toml", &config)) ADD_FAILURE() << error.text();
    machine = std::make_unique<hal::SimMachine>(config.sim, config.points);
    measured = std::make_unique<MeasuredMachine>(config, machine.get());
    std::vector<rt::ConfigError> errors;
    runtime = rt::Runtime::create(config, {&clock, measured.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    steps(settle);  // brakes are open
  }
  void steps(int n) {
    while (n-- > 0) runtime->step();
  }
  template <class Done>
  int until(Done done, int most = 60000) {
    for (int n = 0; n < most; ++n) {
      if (done()) return n;
      runtime->step();
    }
    return -1;
  }
  rt::Answer ask(rt::CommandKind kind, unsigned axis = 0, double value = 0) {
    rt::Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    if (kind == rt::CommandKind::kSetMode) command.number = static_cast<std::uint32_t>(value);
    return runtime->execute(command);
  }
  rt::Answer home_all() {
    rt::Command command;
    command.kind = rt::CommandKind::kHome;
    command.system = rt::kAllSystems;
    return runtime->execute(command);
  }
  void manual_mode() {
    ASSERT_EQ(ask(rt::CommandKind::kSetMode, 0, static_cast<double>(rt::Mode::kManual)), rt::Answer::kDone);
    steps(3);
  }
  void reset() {
    ASSERT_EQ(ask(rt::CommandKind::kReset), rt::Answer::kDone);
    ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 3000), 0);
  }
  // A jog for so many scans; it is repeated as a client does.
  void jog(unsigned axis, double velocity, int scans) {
    for (int n = 0; n < scans; n += 50) {
      (void)ask(rt::CommandKind::kJog, axis, velocity);
      steps(std::min(50, scans - n));
    }
  }
  bool let_go(unsigned axis) {
    (void)ask(rt::CommandKind::kJog, axis, 0);
    return until([&] { return out().distance_zero; }, 1000) >= 0;
  }
  void home_machine() {
    manual_mode();
    ASSERT_EQ(home_all(), rt::Answer::kDone);
    steps(2);
    ASSERT_GE(until([&] { return flags().homing == 0 && flags().homed == 7; }), 0) << alarm() << refusal();
    steps(20);
  }
  void in(const char* name, std::uint32_t value) { machine->set_input(point_of(name), value); }
  unsigned point_of(const char* name) const {
    const int index = config.points.find(name);
    EXPECT_GE(index, 0) << name;
    return static_cast<unsigned>(index);
  }
  bool brake_open() const { return machine->outputs().value[point_of("z_brake")] != 0; }
  nc_outputs out() const { return runtime->snapshot().system[0].nc; }
  rt::AxisFlags flags() const { return runtime->snapshot().system[0].axes; }
  double place(unsigned axis) const { return machine->place(0, axis); }
  std::string alarm() const {
    const rt::Snapshot now = runtime->snapshot();
    return now.alarms.count == 0 ? "" : runtime->alarm_text(now.alarms.alarm[0]);
  }
  bool stopped_by_alarm() const { return runtime->snapshot().stopped_by_alarm(); }
  std::string refusal() const { return rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); }
  void load(const std::string& source) {
    unsigned file = 0;
    const std::string& text = texts.emplace_back(source);
    EXPECT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
    EXPECT_EQ(runtime->execute(rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(rt::Mode::kAuto)), rt::Answer::kDone);
    EXPECT_EQ(runtime->select_program(file), rt::Answer::kDone);
    steps(5);
  }
  rt::Answer start_program(const std::string& source) {
    load(source);
    return runtime->execute(rt::CommandKind::kCycleStart);
  }
  void expect_limits_kept() const {
    EXPECT_LE(measured->fastest, 1.001);
    EXPECT_LE(measured->hardest, 1.001);
  }

  static constexpr unsigned kX = 0, kY = 1, kZ = 2;
  rt::Config config;
  rt::VirtualClock clock;
  std::unique_ptr<hal::SimMachine> machine;
  std::unique_ptr<MeasuredMachine> measured;
  std::unique_ptr<rt::Runtime> runtime;
  std::deque<std::string> texts;
};

}  // namespace nc::test
