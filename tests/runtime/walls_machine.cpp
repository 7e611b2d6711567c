// SPDX-License-Identifier: Apache-2.0
// See walls_machine.hpp.
#include "walls_machine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

namespace nc::test {
namespace {

constexpr double kSlack = 1.001;         // velocity and acceleration may exceed their limits by this factor
constexpr double kPositionSlack = 1e-9;  // a position may be this far outside its soft limit, mm
constexpr std::size_t kReported = 5;

class Recorder final : public rt::EventSink {
 public:
  Recorder(Recording* recording, const WatchedMachine* machine) : recording_(recording), machine_(machine) {}
  void executed(unsigned system, const nc_event& event) override {
    if (system != 0) return;
    recording_->items.push_back({event.serial, event.kind, event.source.line, event.machine});
    if (event.kind == NC_ITEM_SYNC)
      recording_->syncs[event.serial] = {event.machine, machine_->skip_position.load()};
  }

 private:
  Recording* recording_;
  const WatchedMachine* machine_;
};

// The operator: now and then he changes an override or a switch, or presses feed hold; whatever stops the program, he starts it again.
class Hands {
 public:
  Hands(rt::Runtime* runtime, const Operator& op, Recording* recording)
      : runtime_(*runtime), op_(op), recording_(*recording), random_(op.seed) {}

  void act() {
    const nc_outputs now = runtime_.snapshot().system[0].nc;
    if (now.state == NC_STATE_STOPPED || (now.state == NC_STATE_HOLD && resume_at_ <= ++hold_scans_)) {
      recording_.block_stops += now.cause == NC_CAUSE_SINGLE_BLOCK;
      hold_scans_ = 0;
      runtime_.execute(rt::CommandKind::kCycleStart);
      return;
    }
    if (now.state != NC_STATE_RUNNING || draw(60) != 0) return;
    switch (draw(4)) {
      case 0:
        return change_feed();
      case 1:
        return change_rapid();
      case 2:
        return hold();
      default:
        return toggle_single_block();
    }
  }

 private:
  unsigned draw(unsigned n) { return static_cast<unsigned>(random_() % n); }
  double draw_override(double max) {
    const unsigned kind = draw(8);
    if (kind == 0) return 0;
    if (kind == 1) return max;
    return max * (1 + draw(1000)) / 1000.0;
  }
  void change_feed() {
    if (!op_.overrides) return;
    ++recording_.override_changes;
    EXPECT_EQ(runtime_.execute(rt::CommandKind::kFeedOverride, draw_override(2.0)), rt::Answer::kDone);
  }
  void change_rapid() {
    if (!op_.overrides) return;
    ++recording_.override_changes;
    EXPECT_EQ(runtime_.execute(rt::CommandKind::kRapidOverride, draw_override(1.0)), rt::Answer::kDone);
  }
  void hold() {
    if (!op_.holds) return;
    ++recording_.holds;
    resume_at_ = draw(150);
    hold_scans_ = 0;
    EXPECT_EQ(runtime_.execute(rt::CommandKind::kFeedHold), rt::Answer::kDone);
  }
  void toggle_single_block() {
    if (!op_.single_block) return;
    single_block_ = !single_block_;
    EXPECT_EQ(runtime_.execute(rt::CommandKind::kSingleBlock, 0, single_block_ ? 1 : 0), rt::Answer::kDone);
  }

  rt::Runtime& runtime_;
  const Operator& op_;
  Recording& recording_;
  std::mt19937 random_;
  unsigned resume_at_ = 0, hold_scans_ = 0;
  bool single_block_ = false;
};

void note_end(const rt::Runtime& runtime, Recording* recording) {
  const rt::Snapshot snapshot = runtime.snapshot();
  const rt::FeederInfo info = runtime.info();
  recording->ended = info.system[0].ended;
  recording->ended_ok = info.system[0].ended_ok;
  recording->dropped = info.dropped;
  for (unsigned w = 0; w < NC_WORDS; ++w) recording->interface_output[w] = snapshot.interface_output[w];
  if (snapshot.alarms.count == 0) return;
  const rt::ActiveAlarm& alarm = snapshot.alarms.alarm[0];
  recording->alarm =
      alarm.id == rt::AlarmId::kProgram ? info.system[0].program_alarm.code : runtime.alarm_code(alarm.id);
  recording->alarm_line =
      alarm.id == rt::AlarmId::kProgram ? info.system[0].program_alarm.source.line : alarm.source.line;
}

}  // namespace

WatchedMachine::WatchedMachine(const rt::Config& config, Recording* recording)
    : sim(config.sim, config.points), config_(config), recording_(recording), before_(config.start[0]) {}

void WatchedMachine::read(hal::Feedback* feedback, hal::PointImage* image) noexcept {
  sim.read(feedback, image);
  const std::uint32_t skip = feedback->system[0].skip;
  if ((skip & ~skip_before_) != 0) skip_position.store(feedback->system[0].actual);
  skip_before_ = skip;
}

void WatchedMachine::write(const hal::Command& command, const hal::PointImage& image) noexcept {
  ++recording_->scans;
  source_ = command.system[0].source;
  for (unsigned a = 0; a < config_.nc.system[0].axis_count; ++a) check(a, command.system[0].position.v[a]);
  before_ = command.system[0].position;
  sim.write(command, image);
}

void WatchedMachine::take(const nc_axes& position) noexcept {
  before_ = position;
  for (double& velocity : velocity_before_) velocity = 0;
}

// Velocity and acceleration are differences of the commanded positions, that is, averages over a cycle: they cannot
// exceed the limits if the motion keeps them.
void WatchedMachine::check(unsigned a, double position) {
  const nc_axis_config& axis = config_.nc.system[0].axis[a];
  const double t = config_.nc.cycle_s;
  const double velocity = (position - before_.v[a]) / t;
  const double acceleration = (velocity - velocity_before_[a]) / t;
  velocity_before_[a] = velocity;
  // Rounding of positions of some hundred mm, divided by the square of the cycle.
  const double noise = 4 * std::abs(position) * 2.3e-16 / (t * t);
  recording_->velocity_ratio = std::max(recording_->velocity_ratio, std::abs(velocity) / axis.max_velocity);
  recording_->acceleration_ratio =
      std::max(recording_->acceleration_ratio, (std::abs(acceleration) - noise) / axis.max_acceleration);
  if (std::abs(velocity) > axis.max_velocity * kSlack) violation(a, "velocity", velocity, axis.max_velocity);
  if (std::abs(acceleration) > axis.max_acceleration * kSlack + noise)
    violation(a, "acceleration", acceleration, axis.max_acceleration);
  if (!axis.soft_limited) return;
  if (position < axis.soft_min - kPositionSlack) violation(a, "position", position, axis.soft_min);
  if (position > axis.soft_max + kPositionSlack) violation(a, "position", position, axis.soft_max);
}

void WatchedMachine::violation(unsigned axis, const char* what, double value, double limit) {
  if (recording_->violations.size() >= kReported) return;
  recording_->violations.push_back(std::string("scan ") + std::to_string(recording_->scans) + " line " +
                                   std::to_string(source_.line) + " axis " +
                                   config_.nc.system[0].axis[axis].name + " " + what + " " +
                                   std::to_string(value) + " limit " + std::to_string(limit));
}

Recording run_online(const rt::Config& config, const std::string& text, const Operator& op) {
  Recording recording;
  WatchedMachine machine(config, &recording);
  Recorder recorder(&recording, &machine);
  rt::VirtualClock virtual_clock;
  rt::RealClock real_clock;
  rt::Clock* const clock = op.threads ? static_cast<rt::Clock*>(&real_clock) : &virtual_clock;
  std::vector<rt::ConfigError> errors;
  const auto runtime = rt::Runtime::create(config, {clock, &machine, nullptr, nullptr}, &errors);
  for (const rt::ConfigError& error : errors) ADD_FAILURE() << error.text();
  if (runtime == nullptr) return recording;
  unsigned file = 0;
  EXPECT_EQ(nc_program_add_text(runtime->control(), "main.nc", text.data(), text.size(), &file), NC_OK);
  runtime->set_sink(&recorder);
  std::string error;
  EXPECT_TRUE(op.threads ? runtime->start(&error) : runtime->start_stepping(&error)) << error;
  const auto pass = [&] {
    op.threads ? std::this_thread::sleep_for(std::chrono::milliseconds(1)) : runtime->step();
  };
  runtime->execute(rt::CommandKind::kSwitches, 0, op.optional_skip);
  runtime->execute(rt::CommandKind::kOptionalStop, 0, op.optional_stop ? 1 : 0);
  EXPECT_EQ(runtime->select_program(file), rt::Answer::kDone);
  EXPECT_EQ(runtime->execute(rt::CommandKind::kCycleStart), rt::Answer::kDone);
  Hands hands(runtime.get(), op, &recording);
  const bool busy_hands = op.overrides || op.holds || op.single_block || op.threads;
  const unsigned passes = busy_hands ? 1 : 32;  // scans between two snapshots, since a snapshot costs more than a scan
  for (rt::Snapshot now; runtime->info().system[0].runs == 0 && !now.alarmed() && now.scan < op.max_scans;) {
    hands.act();
    for (unsigned i = 0; i < passes; ++i) pass();
    now = runtime->snapshot();
  }
  // Wait until the axes rest, and record everything that the last scans executed.
  for (unsigned i = 0; i < 2000 && (i < 20 || !runtime->snapshot().system[0].nc.distance_zero); ++i) pass();
  runtime->stop();
  note_end(*runtime, &recording);
  std::uint32_t number = 0;
  double value = 0;
  for (std::uint32_t from = 0; nc_variable_next(runtime->control(), 0, from, &number, &value) == NC_OK;
       from = number + 1)
    recording.variables[number] = value;
  return recording;
}

}  // namespace nc::test
