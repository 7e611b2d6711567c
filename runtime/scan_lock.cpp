// SPDX-License-Identifier: Apache-2.0
// Machine lock: axes are commanded and shown as if they moved, and their drives stand. docs/signals.md says what is promised.
//
// A locked axis counts what it is commanded beside the place of its drive, as homing counts from another place: the drive gets the same place in every
// scan, whatever happens to the lock. So nothing moves when the lock goes off. Then the shown place is not where the axis stands, and nothing
// moves it on from there: a reset takes back what was counted.
#include <cmath>

#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

constexpr double kSamePlace = 1e-9;  // mm or deg: the rounding of an axis that has come back to its place in a lock

}  // namespace

// Locks are taken over where no program is in execution and none stands in the middle of a block, and nothing moves. A spindle is not locked: as a C axis it
// would have to leave the place that it holds when its servo goes off. Nor is anything while a tap stands in its hole: drawn out, its spindle would turn
// and its axis would not.
void Scan::follow_locks(unsigned s) noexcept {
  const nc_outputs& out = out_[s];
  const LadderRequests::System& asked = last_requests_.system[s];
  const bool stands = out.state == NC_STATE_IDLE || (out.state == NC_STATE_STOPPED && out.manual_allowed);
  const bool between = stands && !out.tap_retract_possible && out.tap_holds == 0;
  in_[s].locked = 0;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    AxisWork& axis = axes_[s][a];
    const bool wanted = (asked.machine_lock || (asked.axis_lock >> a & 1u) != 0) && config_.nc.system[s].axis[a].spindle == 0;
    if (between && out.distance_zero && !axis.homing.active()) axis.locked = wanted;
    in_[s].locked |= static_cast<std::uint64_t>(axis.locked) << a;
    // A start that was given before the lock went off may only now begin.
    in_[s].interlock |= lock_left(s, a) && (out.state == NC_STATE_RUNNING || in_[s].cycle_start);
  }
}

// The axis is not where it is shown, and its drive would follow.
bool Scan::lock_left(unsigned s, unsigned a) const noexcept {
  return std::abs(axes_[s][a].beside) > kSamePlace && (!axes_[s][a].locked || (set_back_asked_ >> s & 1u) != 0);
}

// Behind a reset, when nothing moves any more.
void Scan::set_back(unsigned s) noexcept {
  if ((set_back_asked_ >> s & 1u) == 0) return;
  const nc_outputs& out = out_[s];
  const bool rests = out.distance_zero && (out.state == NC_STATE_IDLE || out.state == NC_STATE_ALARM);
  bool any = false;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    AxisWork& axis = axes_[s][a];
    if (axis.beside == 0) continue;
    any = true;
    if (axis.sets || !rests) continue;
    axis.sets = axis.sets_back = true;
    axis.set_by = -axis.beside;
  }
  if (!any) set_back_asked_ &= ~(1u << s);
}

// What libnc takes over of a drive that is off, or of one that it has homed, is no motion: it changes the place that the drive is given, not what is counted.
void Scan::give_to_drive(unsigned s, unsigned a) noexcept {
  AxisWork& axis = axes_[s][a];
  const double command = out_[s].command.v[a] - axis.shift;
  if (axis.locked && !out_[s].followed) {
    axis.beside = command - axis.held;
    machine_.system[s].velocity.v[a] = 0;
  } else {
    axis.held = command - axis.beside;
  }
  const double before = axis.screw.value();
  const double beyond = axis.screw.step(axis.held + axis.shift, axis.homed, out_[s].followed, config_.nc.cycle_s);
  machine_.system[s].position.v[a] = axis.held + beyond;
  machine_.system[s].velocity.v[a] += (beyond - before) / config_.nc.cycle_s;
}

void Scan::publish_lock(unsigned s, unsigned a) noexcept {
  AxisFlags& flags = flags_[s];
  const AxisWork& axis = axes_[s][a];
  if (a == 0) flags.locked = flags.beside = 0;
  flags.locked |= static_cast<std::uint32_t>(axis.locked) << a;
  flags.beside |= static_cast<std::uint32_t>(std::abs(axis.beside) > kSamePlace) << a;
  flags.counted[a] = axis.beside;
  flags.screw[a] = axis.screw.value();
}

}  // namespace nc::rt
