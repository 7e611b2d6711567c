// SPDX-License-Identifier: Apache-2.0
// Homing in the scan: who may ask for it, the order of axes, and how the position of an axis is set without a jump of what its drive is told.
//
// The machine and its drives count from where they were switched on; `shift` is what is added to that. When the mark of an axis is found, its
// shift changes, and libnc is told the new place by way of nc_inputs::follow_up in the same cycle: the command less the shift, which is what the
// drive gets, stays.
#include <algorithm>
#include <cmath>

#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

constexpr double kSame = 1e-9;  // mm or deg
constexpr unsigned kStopScans = 200;

}  // namespace

// What is lost and what comes by itself. A stop, a limit switch and a following error lose nothing: the encoder counts on.
void Scan::look_at_homed(unsigned s, unsigned a) noexcept {
  const HomingConfig& homing = config_.equipment[s][a].homing;
  AxisWork& axis = axes_[s][a];
  const bool blind = feedback_.lost || ((feedback_.system[s].drive_fault | feedback_.system[s].place_lost) >> a & 1u) != 0;
  switch (homing.kind) {
    case HomingKind::kNone:
      axis.homed = true;
      break;
    case HomingKind::kAbsolute:
      axis.homed = !blind && feedback_.system[s].actual_valid;
      break;
    case HomingKind::kDrive:
      axis.homed = !blind && readable(homing.done) && points_.value[homing.done] != 0;
      break;
    case HomingKind::kSwitch:
    case HomingKind::kLimit:
    case HomingKind::kHere:
      if (blind) axis.homed = false;
      break;
  }
}

// The soft limits of an axis hold: it knows where it stands, and does not look for that just now.
bool Scan::limits_known(unsigned s, unsigned a) const noexcept { return axes_[s][a].homed && !axes_[s][a].homing.searching(); }

// What may not start a program yet; -1: nothing.
int Scan::axis_not_homed(unsigned s) const noexcept {
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
    if (config_.equipment[s][a].homing.required && !axes_[s][a].homed) return static_cast<int>(a);
  return -1;
}

bool Scan::all_homed() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (!axes_[s][a].homed) return false;
  return true;
}

bool Scan::is_homing() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (axes_[s][a].homing.active()) return true;
  return false;
}

Answer Scan::homing_hindrance(unsigned s, unsigned a) const noexcept {
  if (!config_.equipment[s][a].homing.present()) return Answer::kNoHoming;
  if (const Answer why = hand_hindrance(s, a); why != Answer::kDone) return why;
  if (axes_[s][a].locked) return Answer::kLocked;
  if (active_systems() != 0 || out_[s].restart_axes != 0) return Answer::kNotWhileRunning;
  if (axes_[s][a].homing.active()) return Answer::kHoming;
  return out_[s].velocity.v[a] != 0 ? Answer::kAxesMove : Answer::kDone;
}

Answer Scan::begin_homing(unsigned s, unsigned a) noexcept {
  const Answer why = homing_hindrance(s, a);
  if (why != Answer::kDone) return why;
  jog_[s][a] = {};
  axes_[s][a].stop_scans = 0;
  axes_[s][a].homing.begin(config_.equipment[s][a].homing, homing_sight(s, a));
  on_its_way_[s][a] = Asked::kReference;
  return Answer::kDone;
}

// One axis, or all that can be homed.
Answer Scan::home_command(const Command& command) noexcept {
  if (command.system != kAllSystems) {
    if (command.system >= systems_ || command.axis >= config_.nc.system[command.system].axis_count) return Answer::kAxisUnknown;
    return begin_homing(command.system, command.axis);
  }
  Answer why = Answer::kNoHoming;
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      if (!config_.equipment[s][a].homing.present()) continue;
      why = homing_hindrance(s, a);
      if (why != Answer::kDone) return why;
    }
  }
  if (why == Answer::kDone) {
    for (unsigned s = 0; s < systems_; ++s)
      for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) axes_[s][a].waits_for_homing = config_.equipment[s][a].homing.present();
  }
  return why;
}

// Of those that wait the ones with the lowest order, together, when those before them are done.
void Scan::begin_next_homing() noexcept {
  if (is_homing()) return;
  unsigned order = ~0u;
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (axes_[s][a].waits_for_homing) order = std::min(order, config_.equipment[s][a].homing.order);
  for (unsigned s = 0; s < systems_ && order != ~0u; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      AxisWork& axis = axes_[s][a];
      if (!axis.waits_for_homing || config_.equipment[s][a].homing.order != order) continue;
      axis.waits_for_homing = false;
      if (const Answer why = begin_homing(s, a); why != Answer::kDone) {
        refuse(s, Asked::kReference, why, static_cast<int>(a));
        return forget_order();
      }
    }
  }
}

void Scan::forget_order() noexcept {
  for (auto& system : axes_)
    for (AxisWork& axis : system) axis.waits_for_homing = false;
}

AxisHoming::Seen Scan::homing_sight(unsigned s, unsigned a) const noexcept {
  const HomingConfig& homing = config_.equipment[s][a].homing;
  AxisHoming::Seen seen;
  const auto sees = [this](int point) { return point < 0 || readable(point); };
  // Without a measuring system an axis is where it is commanded to be. A mark is a place of the drive: what is compensated goes by the place that the axis believes in.
  seen.actual = (feedback_.system[s].actual_valid ? feedback_.system[s].actual.v[a] : out_[s].command.v[a]) + axes_[s][a].screw.value();
  seen.velocity = out_[s].velocity.v[a];
  seen.all_stand = out_[s].distance_zero && out_[s].state == NC_STATE_IDLE;
  seen.readable = sees(homing.dog.point) && sees(homing.index.point) && sees(homing.done);
  seen.dog = is_on(homing.dog);
  seen.index = is_on(homing.index);
  seen.done = homing.done >= 0 && points_.value[homing.done] != 0;
  seen.at_reference = (out_[s].at_reference >> a & 1u) != 0;
  seen.cycle_s = config_.nc.cycle_s;
  return seen;
}

// What keeps axes from moving by hand ends a search. A drive that homes by itself does not follow meanwhile, and all else counts for it as well.
Answer Scan::search_hindrance(unsigned s, unsigned a) const noexcept {
  const Answer why = hand_hindrance(s, a);
  if (why != Answer::kDrivesOff || config_.equipment[s][a].homing.kind != HomingKind::kDrive || is_powerless(s, a)) return why;
  if (in_[s].interlock) return Answer::kInterlock;
  return machine_holds_[s] ? Answer::kFeedHold : Answer::kDone;
}

// A search that is given up. A drive that homes by itself does not go by what the axis is commanded, so it is told to stop, for so long that also a bus with a slow SYNC
// has passed that on, and until it follows again.
void Scan::end_search(unsigned s, unsigned a) noexcept {
  axes_[s][a].homing.stop();
  if (config_.equipment[s][a].homing.kind == HomingKind::kDrive) axes_[s][a].stop_scans = kStopScans;
}

// The drive moves this axis by itself, or may do so yet.
bool Scan::homes_by_drive(unsigned s, unsigned a) const noexcept {
  const AxisWork& axis = axes_[s][a];
  if (config_.equipment[s][a].homing.kind != HomingKind::kDrive || (!axis.homing.active() && axis.stop_scans == 0)) return false;
  return !feedback_.lost && ((feedback_.system[s].not_following & ~feedback_.system[s].drive_fault) >> a & 1u) != 0;
}

bool Scan::any_homes_by_drive() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (homes_by_drive(s, a)) return true;
  return false;
}

// Bit per axis: its drive is to give up its homing.
std::uint32_t Scan::drives_to_stop(unsigned s) noexcept {
  std::uint32_t stop = 0;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    AxisWork& axis = axes_[s][a];
    if (axis.stop_scans == 0) continue;
    stop |= 1u << a;
    if (axis.stop_scans > 1 || !homes_by_drive(s, a)) --axis.stop_scans;
  }
  return stop;
}

void Scan::home(unsigned s, unsigned a) noexcept {
  AxisWork& axis = axes_[s][a];
  axis.sets = axis.sets_back = false;
  const int request = config_.equipment[s][a].homing.request;
  if (request >= 0) points_.value[request] = 0;
  if (!axis.homing.active()) return;
  if (search_hindrance(s, a) != Answer::kDone) {  // watch_way() notes it
    end_search(s, a);
    forget_order();
    return;
  }
  const AxisHoming::Wish wish = axis.homing.step(homing_sight(s, a));
  in_[s].manual[a] = wish.manual;
  if (request >= 0) points_.value[request] = wish.request ? 1 : 0;
  if (wish.fault != HomingFault::kNone) {
    end_search(s, a);
    forget_order();
    raise(AlarmId::kHoming, s, static_cast<int>(a), static_cast<std::uint32_t>(wish.fault));
    return;
  }
  if (!wish.set) return;
  const HomingConfig& homing = config_.equipment[s][a].homing;
  axis.sets = true;
  axis.set_screw = axis.screw.value();
  axis.set_by = config_.nc.system[s].axis[a].reference[0] - homing.offset - wish.mark + axis.set_screw;
}

// In the cycle in which they are set, the commands of the other axes stay.
void Scan::set_positions(unsigned s) noexcept {
  bool any = false;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) any |= axes_[s][a].sets;
  if (!any) return;
  nc_inputs& in = in_[s];
  in.follow_up = in.actual_valid = true;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    in.actual.v[a] = out_[s].command.v[a] + (axes_[s][a].sets ? axes_[s][a].set_by : 0);
    in.manual[a] = {};
  }
}

// The drive stays where it is: what it got for its screw is a part of its place now, and comes in anew from there.
void Scan::take_mark(AxisWork* axis) noexcept {
  axis->shift += axis->set_by - axis->set_screw;
  axis->drive += axis->set_screw;
  axis->screw.come_in_anew();
}

// Behind the cycle of libnc: it has taken them, or it is asked again with the next scan.
void Scan::take_positions() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      AxisWork& axis = axes_[s][a];
      if (!axis.sets || std::abs(out_[s].command.v[a] - in_[s].actual.v[a]) > kSame) continue;
      if (axis.sets_back) axis.beside = 0;
      else take_mark(&axis);
      axis.homed |= !axis.sets_back;
      feedback_.system[s].actual.v[a] += axis.set_by;
      last_command_[s].v[a] += axis.set_by;
      stood_at_[s].v[a] += axis.set_by;
      if (!axis.sets_back) axis.homing.was_set();
    }
  }
}

void Scan::publish_axes(unsigned s) noexcept {
  AxisFlags& flags = flags_[s];
  flags.homed = flags.homing = flags.limit[0] = flags.limit[1] = 0;
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    const AxisWork& axis = axes_[s][a];
    flags.homed |= static_cast<std::uint32_t>(axis.homed) << a;
    flags.homing |= static_cast<std::uint32_t>(axis.homing.active()) << a;
    for (unsigned side = 0; side < 2; ++side) flags.limit[side] |= static_cast<std::uint32_t>(axis.limit[side]) << a;
    publish_lock(s, a);
  }
}

}  // namespace nc::rt
