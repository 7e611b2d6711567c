// SPDX-License-Identifier: Apache-2.0
// What the scan does for what stands beside the axes: limit switches, interlocks of an axis and a direction, drives and brakes one by one.
// docs/homing.md says what is promised. Homing itself: scan_homing.cpp.
#include <algorithm>
#include <cmath>

#include "runtime/axes/direction.hpp"
#include "runtime/scan.hpp"

namespace nc::rt {
void Scan::create_axes() {
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      axes_[s][a].drive = axes_[s][a].held = config_.start[s].v[a];
      const AxisEquipment& equipment = config_.equipment[s][a];
      axes_[s][a].power.create(equipment.brake);
      axes_[s][a].screw.create(equipment.screw, equipment.homing.mark(config_.nc.system[s].axis[a]), equipment.homing.mark_direction());
    }
  }
}

bool Scan::readable(int point) const noexcept {
  return config_.points.at(static_cast<unsigned>(point)).bus == 0 ? !feedback_.lost : points_.good[point] != 0;
}

// A contact on a bus that does not answer says nothing: readable() is asked for beside it.
bool Scan::is_on(const Contact& contact) const noexcept {
  return contact.present() && (points_.value[contact.point] != 0) != contact.closed;
}

// ---- 1 inputs ----

// The machine has the places of its drives, everybody else those of the machine.
void Scan::read_machine() noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) feedback_.system[s].actual.v[a] = axes_[s][a].drive + axes_[s][a].screw.value();
  hal_->read(&feedback_, &points_);
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      double& actual = feedback_.system[s].actual.v[a];
      axes_[s][a].drive = actual - axes_[s][a].screw.value();
      actual = axes_[s][a].drive + axes_[s][a].shift + axes_[s][a].beside;
    }
  }
}

void Scan::look_at_axes() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      look_at_limits(s, a);
      look_at_homed(s, a);
    }
  }
}

// A switch that comes on is an alarm once; the alarm stays while it is on, and for how long nothing goes further that way.
void Scan::look_at_limits(unsigned s, unsigned a) noexcept {
  const AxisEquipment& equipment = config_.equipment[s][a];
  AxisWork& axis = axes_[s][a];
  const int search = axis.homing.uses_limit() ? static_cast<int>(side_of(equipment.homing.direction)) : -1;
  for (unsigned side = 0; side < 2; ++side) {
    const Contact& contact = equipment.limit[side];
    if (!contact.present()) continue;
    axis.blind[side] = !readable(contact.point);
    axis.limit[side] = !axis.blind[side] && is_on(contact);
    if (!axis.limit[side]) axis.limit_told[side] = false;
  }
  if (axis.limit[0] && axis.limit[1]) {
    axis.limit_told[0] = axis.limit_told[1] = true;
    raise(AlarmId::kLimitSwitch, s, static_cast<int>(a), kBothLimits);
    return;
  }
  for (unsigned side = 0; side < 2; ++side) {
    if (!axis.limit[side] || axis.limit_told[side] || static_cast<int>(side) == search) continue;
    axis.limit_told[side] = raise(AlarmId::kLimitSwitch, s, static_cast<int>(a), side == 0 ? kLimitMinus : kLimitPlus);
  }
}

// A limit switch that is on, of those that are told one by one: reset acknowledges it, and the alarm goes with the switch (watch_retained()). Both at once are a
// fault that comes back with the next scan.
bool Scan::limit_holds(const ActiveAlarm& alarm) const noexcept {
  if (alarm.detail != kLimitMinus && alarm.detail != kLimitPlus) return false;
  return axes_[alarm.system][alarm.axis].limit[alarm.detail == kLimitMinus ? 0 : 1];
}

// ---- what keeps an axis from going in a direction ----

Answer Scan::way_hindrance(unsigned s, unsigned a, int direction) const noexcept {
  if (direction == 0) return Answer::kDone;
  const AxisWork& axis = axes_[s][a];
  const unsigned side = side_of(direction);
  const bool searched = axis.homing.uses_limit() && config_.equipment[s][a].homing.direction == direction;
  if ((axis.limit[side] || axis.blind[side]) && !searched) return Answer::kLimitSwitch;
  return is_interlocked(s, a, direction) ? Answer::kInterlock : Answer::kDone;
}

bool Scan::is_interlocked(unsigned s, unsigned a, int direction) const noexcept {
  return (last_requests_.system[s].interlocked[side_of(direction)] >> a & 1u) != 0;
}

// Some axis of these part systems stands on a limit switch, or cannot see one.
bool Scan::at_limit_switch(std::uint32_t systems) const noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    if ((systems >> s & 1u) == 0) continue;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      for (unsigned side = 0; side < 2; ++side)
        if (axes_[s][a].limit[side] || axes_[s][a].blind[side]) return true;
  }
  return false;
}

// ---- behind the ladder ----

void Scan::run_axes() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    in_[s].unlimited = 0;
    follow_locks(s);
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      home(s, a);
      limit_by_hand(s, a);
      in_[s].unlimited |= static_cast<std::uint64_t>(!limits_known(s, a)) << a;
    }
    follow_tap(s);
    hold_at_interlock(s);
    hold_positions(s);
    set_back(s);
    set_positions(s);
  }
  begin_next_homing();
}

// Motion by hand that may not go on in its direction comes to rest, and is given up.
void Scan::limit_by_hand(unsigned s, unsigned a) noexcept {
  nc_manual& manual = in_[s].manual[a];
  const HomingConfig& homing = config_.equipment[s][a].homing;
  const bool unknown = homing.forgets() && !axes_[s][a].homed && !axes_[s][a].homing.active();
  hindered_[s][a] = Answer::kDone;
  if (unknown && manual.kind == NC_MANUAL_JOG) manual.velocity = std::clamp(manual.velocity, -homing.jog, homing.jog);
  if (unknown && manual.kind == NC_MANUAL_STEP) manual.velocity = homing.jog;
  int direction = direction_of(out_[s].velocity.v[a]);
  if (manual.kind == NC_MANUAL_JOG && manual.velocity != 0) direction = direction_of(manual.velocity);
  if (manual.kind == NC_MANUAL_STEP || manual.kind == NC_MANUAL_HANDLE) direction = direction_of(manual.distance);
  if (manual.kind == NC_MANUAL_REFERENCE && direction == 0) direction = direction_of(config_.nc.system[s].axis[a].reference[0] - out_[s].command.v[a]);
  Answer why = way_hindrance(s, a, direction);
  if (why == Answer::kDone && unknown && (manual.kind == NC_MANUAL_HANDLE || manual.kind == NC_MANUAL_RETURN)) why = Answer::kNotHomed;
  if (why == Answer::kDone && manual.kind != NC_MANUAL_NONE && lock_left(s, a)) why = Answer::kLockLeft;
  if (why == Answer::kDone) return;
  hindered_[s][a] = why;
  // Nothing of it goes on by itself later.
  if (axes_[s][a].homing.active()) {
    end_search(s, a);
    forget_order();
  }
  if (on_its_way_[s][a] != Asked::kNothing) give_up_way(s, a, why);
  if (manual.kind == NC_MANUAL_HANDLE) pulses_lost_[s] |= 1u << a;
  manual = {NC_MANUAL_JOG, 0, 0};
}

// M700 M01 0004: an axis that a program moves in a direction that is interlocked brings the whole path to rest, until it is not any more. A start behind a feed hold
// goes on with the same block, so that what has waited there goes on to wait.
void Scan::hold_at_interlock(unsigned s) noexcept {
  std::uint32_t& waits = interlock_waits_[s];
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    const int direction = out_[s].state == NC_STATE_RUNNING ? direction_of(out_[s].velocity.v[a]) : 0;
    if (direction != 0 && is_interlocked(s, a, direction)) waits |= 1u << (2 * a + side_of(direction));
    for (unsigned side = 0; side < 2; ++side)
      if ((last_requests_.system[s].interlocked[side] >> a & 1u) == 0) waits &= ~(1u << (2 * a + side));
  }
  if (out_[s].state != NC_STATE_RUNNING && out_[s].state != NC_STATE_HOLD) waits = 0;
  in_[s].interlock |= waits != 0;
}

// While the command follows what is measured, that of an axis whose drive holds stays: what is measured there is a little beside it.
void Scan::hold_positions(unsigned s) noexcept {
  nc_inputs& in = in_[s];
  const std::uint32_t not_following = feedback_.system[s].not_following;
  std::uint32_t off = 0;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) off |= static_cast<std::uint32_t>(!axes_[s][a].power.drive_on()) << a;
  if (off != 0 && in.actual_valid && !feedback_.lost) in.follow_up = true;
  if (!in.follow_up) return;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    const bool by_brake = drives_off_ && axes_[s][a].power.has_brake();
    const bool on = axes_[s][a].power.drive_on() && (!drives_off_ || by_brake) && (not_following >> a & 1u) == 0;
    if (!on || is_spindle_now(s, a)) continue;
    in.actual.v[a] = out_[s].command.v[a];
    in.follow_up &= out_[s].velocity.v[a] == 0;  // the last cycle of its ramp moves it yet
  }
}

// ---- 4 outputs ----

// Bit per axis of a part system: its drive is to be off though others are on.
std::uint32_t Scan::power_axes(unsigned s) noexcept {
  std::uint32_t off = 0;
  flags_[s].brake_open = flags_[s].servo_off = 0;
  const bool active = ((active_systems() | start_pulse_) >> s & 1u) != 0;  // a start that goes to the NC with the next scan was judged with the drives on
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    AxisPower& power = axes_[s][a].power;
    const bool asked = (last_requests_.system[s].servo_off >> a & 1u) != 0;
    AxisPower::Seen seen;
    // A drive that goes off in a program would take the axis from its path.
    seen.off = asked && (!power.free() || (!active && out_[s].distance_zero && !homes_by_drive(s, a)));
    seen.off |= drives_off_ && power.has_brake();
    const hal::SystemFeedback& machine = feedback_.system[s];
    const std::uint32_t let_go = machine.following_fault & machine.not_following;  // by a drive whose position loop is lost
    seen.dead = feedback_.lost || ((machine.drive_fault | let_go) >> a & 1u) != 0;
    seen.follows = (machine.not_following >> a & 1u) == 0;
    seen.stands = out_[s].distance_zero;
    seen.cycle_s = config_.nc.cycle_s;
    power.step(seen);
    if (!power.drive_on() || (drives_off_ && !power.has_brake())) off |= 1u << a;
    if (power.brake_point() >= 0) points_.value[power.brake_point()] = power.brake_open() ? 1 : 0;
    flags_[s].brake_open |= static_cast<std::uint32_t>(power.brake_open()) << a;
    flags_[s].servo_off |= static_cast<std::uint32_t>(asked) << a;
  }
  return off;
}

// Its drive is off, comes on, or its brake opens.
bool Scan::is_powerless(unsigned s, unsigned a) const noexcept { return !axes_[s][a].power.free(); }

bool Scan::any_powerless() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (is_powerless(s, a)) return true;
  return false;
}

}  // namespace nc::rt
