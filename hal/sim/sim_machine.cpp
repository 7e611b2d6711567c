// SPDX-License-Identifier: Apache-2.0
// The simulated machine. See sim_machine.hpp for the model.
#include "hal/sim/sim_machine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nc::hal {
namespace {

constexpr std::size_t kRecordedChanges = 4096;
constexpr std::uint8_t kStrobeM = 1, kStrobeT = 4;

}  // namespace

SimSolid::SimSolid() {
  for (unsigned a = 0; a < NC_MAX_AXES; ++a) {
    min[a] = -std::numeric_limits<double>::infinity();
    max[a] = std::numeric_limits<double>::infinity();
  }
}

SimMachine::SimMachine(const SimConfig& config, const PointTable& table)
    : config_(config), table_(table), plant_(config.plant), script_(config.script), changes_(kRecordedChanges) {
  for (unsigned s = 0; s < config_.system_count; ++s) {
    System& system = system_[s];
    system.command = system.actual = config_.start[s];
    for (unsigned a = 0; a < config_.axis_count[s]; ++a) {
      const double lag = config_.axis[s][a].lag_s;
      system.follow[a] = lag > 0 ? 1.0 - std::exp(-config_.cycle_s / lag) : 1.0;
      const double coast = config_.axis[s][a].coast_s;
      system.fade[a] = coast > 0 ? std::exp(-config_.cycle_s / coast) : 0.0;
    }
  }
}

bool SimMachine::start(const PointImage& initial, std::string* error) {
  (void)error;  // a simulated machine is always there
  input_ = initial;
  output_ = initial;
  for (unsigned s = 0; s < config_.system_count; ++s) work_switches(s, initial);
  script_.restart();
  stopped_ = false;
  return true;
}

void SimMachine::stop() noexcept {
  for (unsigned s = 0; s < config_.system_count; ++s) {
    for (int& direction : system_[s].direction) direction = 0;
    system_[s].fin = system_[s].busy = false;
  }
  for (unsigned p = 0; p < table_.size(); ++p)
    if (table_.at(p).bus == 0 && table_.at(p).direction == PointDirection::kOutput)
      output_.value[p] = table_.at(p).initial;
  stopped_ = true;
}

void SimMachine::fail_drive(unsigned system, unsigned axis, bool fault) {
  const std::uint32_t bit = 1u << axis;
  system_[system].drive_fault =
      fault ? system_[system].drive_fault | bit : system_[system].drive_fault & ~bit;
}

void SimMachine::block_axis(unsigned system, unsigned axis, bool blocked) {
  const std::uint32_t bit = 1u << axis;
  system_[system].blocked = blocked ? system_[system].blocked | bit : system_[system].blocked & ~bit;
}

void SimMachine::fail_unclamp(unsigned system, unsigned axis, bool fault) {
  const std::uint32_t bit = 1u << axis;
  system_[system].clamp_failed = fault ? system_[system].clamp_failed | bit : system_[system].clamp_failed & ~bit;
}

void SimMachine::read(Feedback* feedback, PointImage* image) noexcept {
  feedback->lost = lost_;
  if (lost_) return;  // everything else keeps the values of before
  for (unsigned s = 0; s < config_.system_count; ++s) {
    const System& system = system_[s];
    SystemFeedback& out = feedback->system[s];
    out.actual_valid = true;
    out.actual = system.actual;
    out.following_fault = system.following_fault;
    out.drive_fault = system.drive_fault;
    out.not_following = system.off;
    out.skip = skip_signals(s);
    out.skip_latched = 0;
    for (unsigned n = 0; n < config_.spindle_count[s]; ++n) {
      const SimSpindle& turning = spindle(s, n);
      out.spindle[n] = {turning.rpm() / 60.0, turning.turns(), true, turning.ready(), turning.ready(), false};
    }
    out.unclamped = system.unclamped & ~system.clamp_failed;
    out.fin = system.fin;
  }
  for (unsigned p = 0; p < table_.size(); ++p)
    if (table_.at(p).bus == 0 && table_.at(p).direction == PointDirection::kInput)
      image->value[p] = input_.value[p];
}

void SimMachine::write(const Command& command, const PointImage& image) noexcept {
  ++scan_;
  if (lost_) {
    for (unsigned s = 0; s < config_.system_count; ++s)
      for (unsigned a = 0; a < config_.axis_count[s]; ++a) coast(s, a);
    return;
  }
  for (unsigned s = 0; s < config_.system_count; ++s) switch_servos(s, command.system[s]);
  plant_.follow(command.system[0].spindle_synchronous, command.system[0].spindle_turns);
  plant_.step(config_.cycle_s, image, &input_);
  for (unsigned s = 0; s < config_.system_count; ++s) {
    if (!plant_.present()) handshake(&system_[s], command.system[s]);
    turn_spindles(s, command.system[s]);
    move_axes(s, command.system[s]);
    work_clamps(s, command.system[s].unclamp);
    work_switches(s, image);
  }
  const SystemCommand& first = command.system[0];
  script_.step(scan_, first.source, (first.strobe & kStrobeM) != 0, first.m, &input_);
  record_outputs(image);
}

void SimMachine::move_axes(unsigned index, const SystemCommand& command) noexcept {
  System& system = system_[index];
  system.off = command.enable ? command.off : 0;
  for (unsigned a = 0; a < config_.axis_count[index]; ++a) {
    const std::uint32_t bit = 1u << a;
    system.command.v[a] = command.position.v[a];
    if (is_spindle_now(index, a, command)) {  // the axis follows the turning spindle
      system.actual.v[a] = spindle(index, config_.axis_spindle[index][a] - 1u).angle_deg();
      system.step[a] = 0;
      system.following_fault &= ~bit;
      continue;
    }
    if (!command.enable || (command.off & bit) != 0) {  // the command of a disabled drive is not followed
      coast(index, a);
      system.following_fault &= ~bit;
      continue;
    }
    system.step[a] =
        (system.blocked & bit) != 0 ? 0 : (system.command.v[a] - system.actual.v[a]) * system.follow[a];
    system.actual.v[a] += system.step[a];
    if (config_.axis_spindle[index][a] != 0)
      spindle(index, config_.axis_spindle[index][a] - 1u).turn_axis(system.step[a], config_.cycle_s);
    const double limit = config_.axis[index][a].following_error_limit;
    if (limit > 0 && std::abs(system.command.v[a] - system.actual.v[a]) > limit)
      system.following_fault |= bit;
    else
      system.following_fault &= ~bit;
  }
}

void SimMachine::work_clamps(unsigned index, std::uint32_t unclamp) noexcept {
  System& system = system_[index];
  for (unsigned a = 0; a < config_.axis_count[index]; ++a) {
    const std::uint32_t bit = 1u << a;
    const bool open = system.clamp[a].step(config_.axis[index][a].clamp, (unclamp & bit) != 0, config_.cycle_s);
    system.unclamped = open ? system.unclamped | bit : system.unclamped & ~bit;
  }
}

void SimMachine::coast(unsigned index, unsigned axis) noexcept {
  System& system = system_[index];
  const SimSwitches& switches = config_.axis[index][axis].switches;
  const bool held = (system.blocked >> axis & 1u) != 0 || (switches.brake >= 0 && !system.switches[axis].open);
  const double fall = switches.weight * config_.cycle_s * config_.cycle_s;
  system.step[axis] = held ? 0 : system.step[axis] * (switches.weight > 0 ? 1 : system.fade[axis]) - fall;
  system.actual.v[axis] += system.step[axis];
}

void SimMachine::work_switches(unsigned index, const PointImage& outputs) noexcept {
  for (unsigned a = 0; a < config_.axis_count[index]; ++a)
    system_[index].switches[a].step(config_.axis[index][a].switches, place(index, a), config_.cycle_s, outputs, &input_);
}

// True while the axis turns as a spindle: the NC does not position it, or the spindle does not hold its position yet.
bool SimMachine::is_spindle_now(unsigned system, unsigned axis, const SystemCommand& command) const noexcept {
  const unsigned number = config_.axis_spindle[system][axis];
  return number != 0 && !(spindle(system, number - 1).ready() && (command.servo_ready >> axis & 1) != 0);
}

void SimMachine::switch_servos(unsigned index, const SystemCommand& command) noexcept {
  for (unsigned a = 0; a < config_.axis_count[index]; ++a) {
    const unsigned number = config_.axis_spindle[index][a];
    if (number == 0) continue;
    const bool on = command.enable && (command.servo_on >> a & 1) != 0;
    if (on) system_[index].direction[number - 1] = 0;  // afterwards it turns only with the next code that starts it
    spindle(index, number - 1).set_servo(on);
  }
}

nc_code_role SimMachine::role_of(std::uint32_t m) const noexcept { return nc_code_role_get(static_cast<nc_dialect>(config_.dialect), 'M', m); }

double SimMachine::target_rpm(const System& system, unsigned number) const noexcept {
  return system.direction[number] * std::min(system.wanted_rpm[number], config_.spindle_max_rpm);
}

void SimMachine::turn_spindles(unsigned index, const SystemCommand& command) noexcept {
  System& system = system_[index];
  for (unsigned n = 0; n < config_.spindle_count[index]; ++n) {
    if (index == 0 && plant_.turns_spindle(n)) continue;
    if ((command.spindle_synchronous >> n & 1) != 0) {
      system.direction[n] = 0;  // it turns again with the next code that starts it
      system.spindle[n].follow(command.spindle_turns, config_.cycle_s, config_.spindle_ramp_rpm_per_s);
      continue;
    }
    system.spindle[n].let_go();
    if (system.direction[n] != 0) system.wanted_rpm[n] = std::abs(command.spindle_rev_min[n]);  // constant surface speed
    system.spindle[n].step(config_.cycle_s, target_rpm(system, n), config_.spindle_ramp_rpm_per_s);
  }
}

// The codes that turn and stop spindles are for those that the NC has selected; the end of the program stops all of them.
void SimMachine::direct_spindles(System* system, const SystemCommand& command) noexcept {
  const nc_code_role role = role_of(command.m);
  const bool ends = role == NC_CODE_PROGRAM_END, forward = role == NC_CODE_SPINDLE_FORWARD, reverse = role == NC_CODE_SPINDLE_REVERSE;
  if (!forward && !reverse && role != NC_CODE_SPINDLE_STOP && !ends) return;
  for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n)
    if (ends || (command.spindle_selected >> n & 1) != 0) system->direction[n] = forward ? 1 : reverse ? -1 : 0;
}

// Starts the functions whose strobes are in `strobe`; returns the time until FIN.
double SimMachine::begin_function(System* system, const SystemCommand& command,
                                  std::uint8_t strobe) noexcept {
  double time = config_.m_time_s;
  if (strobe & kStrobeT) {
    system->selected = command.t;
    time = std::max(time, config_.tool_select_s);
  }
  if (strobe & kStrobeM) {
    direct_spindles(system, command);
    if (role_of(command.m) == NC_CODE_TOOL_CHANGE) {
      system->tool = system->selected;
      time = std::max(time, config_.tool_change_s);
    }
  }
  // A function of a spindle is complete when the speed is reached.
  for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) {
    if ((command.spindle_selected >> n & 1) != 0) system->wanted_rpm[n] = std::abs(command.spindle_rev_min[n]);
    time = std::max(time, std::abs(target_rpm(*system, n) - system->spindle[n].rpm()) / config_.spindle_ramp_rpm_per_s);
  }
  return time;
}

// The handshake of FIN1: strobe on -> function -> FIN on -> strobe off -> FIN off. When the strobe goes off early (reset), the
// function ends at once. When a new strobe comes while the FIN of the previous one is still on, FIN goes off and a
// new function begins.
void SimMachine::handshake(System* system, const SystemCommand& command) noexcept {
  const auto rising = static_cast<std::uint8_t>(command.strobe & ~system->strobe);
  const bool another = command.strobe != 0 && command.serial != system->serial && system->fin;
  if (command.strobe == 0) {
    system->busy = system->fin = false;
  } else if (rising != 0 || another) {
    const double time = begin_function(system, command, another ? command.strobe : rising);
    system->remaining_s = system->busy ? std::max(system->remaining_s, time) : time;
    system->busy = true;
    system->fin = false;
  } else if (system->busy) {
    system->remaining_s -= config_.cycle_s;
    if (system->remaining_s <= 0 && !fin_held_) {
      system->busy = false;
      system->fin = true;
    }
  }
  system->strobe = command.strobe;
  if (rising != 0 || command.strobe == 0) system->serial = command.serial;
}

std::uint32_t SimMachine::skip_signals(unsigned index) const noexcept {
  std::uint32_t signals = 0;
  for (const SimSolid& solid : config_.solids) {
    if (solid.system != index) continue;
    bool inside = true;
    for (unsigned a = 0; a < config_.axis_count[index] && inside; ++a)
      inside = system_[index].actual.v[a] >= solid.min[a] && system_[index].actual.v[a] <= solid.max[a];
    if (inside) signals |= 1u << (solid.signal - 1);
  }
  return signals;
}

void SimMachine::record_outputs(const PointImage& image) noexcept {
  for (unsigned p = 0; p < table_.size(); ++p) {
    if (table_.at(p).direction != PointDirection::kOutput || image.value[p] == output_.value[p]) continue;
    output_.value[p] = image.value[p];
    if (change_count_ < changes_.size())
      changes_[change_count_++] = SimOutputChange{scan_, p, image.value[p]};
    else
      ++lost_changes_;
  }
}

}  // namespace nc::hal
