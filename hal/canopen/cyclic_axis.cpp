// SPDX-License-Identifier: Apache-2.0
// The real-time part of a bus of drives: the handling of one axis with each SYNC. See cyclic.hpp.
#include <algorithm>
#include <cmath>

#include "hal/canopen/cyclic.hpp"

namespace nc::hal::canopen {
namespace {

// A drive answers each SYNC with one position, so it never sends more of them than there were SYNCs, however late they come. Two drives under one identifier do.
constexpr int kAheadLimit = 20;   // positions more than SYNCs until that is a fault
constexpr int kMostOwed = 200;    // positions fewer than SYNCs that are remembered: as late as a drive can be without looking like two
constexpr unsigned kHomingSettle = 10;    // SYNCs in the homing mode behind which the status is that of this mode
constexpr unsigned kStandsFor = 10;       // SYNCs in which an axis that comes to rest has not moved: it stands
constexpr unsigned kHomingBeginMs = 2000;  // time within which a homing has to begin
constexpr double kStandsWithin = 0.005;   // mm or deg in kStandsFor SYNCs: an axis that stands
constexpr unsigned kProbeHold = 20;       // SYNCs for which the skip signal stays on
constexpr double kProbeSlack = 0.1;       // mm or deg beside its way at which an axis may have been when its drive latched the place
constexpr double kJumpFactor = 2;         // a set-point may need at most this multiple of the largest velocity
constexpr double kSpeedReserve = 1.25;     // an axis whose position is held here is given at most this multiple of its largest velocity
constexpr double kJumpSlack = 0.02;       // mm or deg in addition
constexpr unsigned kResetMs = 500;        // time that a drive may take to leave its fault
constexpr std::uint16_t kProbeEnable = 0x0001, kProbeRising = 0x0010, kProbeFalling = 0x0020;  // 60B8h
constexpr std::uint16_t kStoredRising = 0x0002, kStoredFalling = 0x0004;                       // 60B9h

}  // namespace

void Cyclic::fault(Axis* axis, DriveTrouble trouble) noexcept {
  if (axis->faulty) return;
  axis->faulty = true;
  axis->trouble = trouble;
}

bool Cyclic::follows(unsigned index) const noexcept {
  const Axis& axis = axes_[index];
  return nodes_[axis.node].operational && axis.known && !axis.faulty && axis.homing == Homing::kNo && axis.control == kEnableOperation &&
         drive_state(axis.status) == DriveState::kOperationEnabled &&
         ((axis.status & kStatusFollows) != 0 || axis.map->mode == kModeProfileVelocity) &&  // bit 12 is "stands" in that mode
         mode_[index].load(std::memory_order_acquire) == axis.map->mode;
}

// Checks whether positions of the axis come, and whether its status reports a fault. A node whose heartbeat says "operational" while its positions stay away has
// lost its PDOs (it has started anew, unheard, and gone to "operational" by itself). So when the time for the quick stop is over it is set up again, once, and
// then with each reset.
void Cyclic::watch_axis(unsigned index) noexcept {
  Axis& axis = axes_[index];
  if (!nodes_[axis.node].operational) return;
  axis.missed = axis.fresh ? 0 : axis.missed + 1;
  axis.ahead = std::max(axis.ahead - 1, -kMostOwed);
  if (!axis.fresh) statistics_.missed_positions.fetch_add(1, std::memory_order_relaxed);
  axis.fresh = false;
  if (axis.known && axis.homing == Homing::kNo) axis.track.note(axis.position, axis.missed == 0);
  else axis.track.clear();  // a drive that homes changes its position without moving
  if (axis.missed == bus_.lost_after) lose_place(&axis);  // in so long a time it may have gone anywhere
  if (axis.missed >= bus_.lost_after) fault(&axis, DriveTrouble::kNoPosition);
  if (silent_for_good(axis) && !axis.set_up_again) {
    axis.set_up_again = true;
    set_phase(axis.node, NodePhase::kAway);
  }
  if (axis.ahead >= kAheadLimit) fault(&axis, DriveTrouble::kTwice);
  const bool was_in_fault = axis.in_fault;
  const DriveState state = drive_state(axis.status);
  axis.in_fault = state == DriveState::kFault || state == DriveState::kFaultReaction;
  if (was_in_fault) forget_emergency(axis.node);
  if (axis.in_fault && axis.reset_left == 0) {
    axis.following_fault |= axis.was_on && !axis.map->takes_speed() && (axis.status & kStatusError) != 0 && axis.homing == Homing::kNo;
    fault(&axis, DriveTrouble::kNone);
  }
}

// A drive says once why it is in fault, so that counts for as long as it is: a reset that does not help takes no reason away.
void Cyclic::forget_emergency(unsigned node) noexcept {
  for (const Axis& axis : axes_)
    if (axis.node == node && axis.in_fault) return;
  nodes_[node].emergency = 0;
}

// Its positions have not come for so long that the drive has ended its quick stop.
bool Cyclic::silent_for_good(const Axis& axis) const noexcept { return axis.missed >= bus_.lost_after + syncs_of(bus_.stop_timeout_ms); }

// True while the scan gives positions in time. A new command is recognized by its serial number.
bool Cyclic::take_wanted(std::int64_t now_ns) noexcept {
  wanted_.take();
  fresh_command_ = wanted_.front().serial != serial_;
  serial_ = wanted_.front().serial;
  late_syncs_ = fresh_command_ ? 0 : late_syncs_ + 1;
  if (fresh_command_) command_ns_ = now_ns;
  else if (serial_ != 0) statistics_.missed_commands.fetch_add(1, std::memory_order_relaxed);
  return serial_ != 0 && now_ns - command_ns_ <= command_limit_ns_;
}

// What the drive is to do now. An axis with a fault stays off until a reset, one whose loop is lost until it may be held again (lost_loop.hpp).
DriveWish Cyclic::wish_of(Axis* axis, const AxisWanted& wanted, bool commanded) noexcept {
  const DriveWish wish = wanted.on ? DriveWish::kOn : DriveWish::kOff;
  if (wanted.reset && commanded && silent_for_good(*axis)) {
    set_phase(axis->node, NodePhase::kAway);  // its fault stays until positions come
    return DriveWish::kOff;
  }
  if (wanted.reset && commanded) {
    axis->faulty = axis->following_fault = false;
    axis->trouble = DriveTrouble::kNone;
    axis->reset_left = static_cast<unsigned>(syncs_of(kResetMs));
    axis->ahead = std::min(axis->ahead, 0);
    axis->on_syncs = 0;
    forget_emergency(axis->node);
    axis->was_on &= drive_state(axis->status) == DriveState::kOperationEnabled;
  }
  if (axis->reset_left > 0) {
    const bool there = drive_state(axis->status) != DriveState::kFault;
    axis->reset_left = there ? 0 : axis->reset_left - 1;
    if (!there) return DriveWish::kReset;
  }
  if (!commanded && serial_ != 0 && wanted.on) fault(axis, DriveTrouble::kNoCommand);
  return axis->faulty || axis->loop.is_lost() || !commanded ? DriveWish::kOff : wish;
}

void Cyclic::move_axis(unsigned index, bool commanded) noexcept {
  Axis& axis = axes_[index];
  const AxisWanted& wanted = wanted_.front().axis[index];
  axis.loop.step({wanted.reset, has_torque(axis) || axis.missed != 0, axis.position, wanted.target});
  if (!nodes_[axis.node].operational || !axis.known) {
    if (commanded && wanted.reset && nodes_[axis.node].operational) (void)wish_of(&axis, wanted, commanded);
    if (axis.homing != Homing::kNo) wanted_mode_[index].store(axis.map->mode, std::memory_order_release);
    axis.homing = Homing::kNo;
    axis.was_on = false;
    axis.on_syncs = 0;
    return;
  }
  const bool followed = follows(index);
  if (followed || axis.map->spindle) axis.count.begin();
  const DriveWish wish = wish_of(&axis, wanted, commanded);
  const bool in_mode = mode_[index].load(std::memory_order_acquire) == axis.map->mode;
  const bool homing = home_axis(index, &axis, wanted);
  if (wish == DriveWish::kOn) {
    if (axis.was_on && drive_state(axis.status) != DriveState::kOperationEnabled) fault(&axis, DriveTrouble::kLeftEnabled);  // also one that homes: nothing holds its axis
    axis.was_on |= followed;
    if (!axis.was_on && !homing && ++axis.on_syncs > syncs_of(bus_.enable_timeout_ms)) fault(&axis, DriveTrouble::kNotEnabled);
  } else {
    axis.was_on = false;
    axis.on_syncs = 0;
  }
  std::copy_backward(axis.target, axis.target + kTargets - 1, axis.target + kTargets);
  const bool led = followed && wish == DriveWish::kOn;
  if (axis.map->spindle) axis.target[0] = led ? wanted.target : 0;  // a command that is missing: the speed stays
  else axis.target[0] = led ? target_of(&axis, wanted) : axis.position;
  if (axis.map->spindle || !followed) std::fill(axis.target, axis.target + kTargets, axis.target[0]);
  else check_following(&axis);
  if (axis.map->holds_position()) check_way(&axis, led);
  const DriveWish now = (axis.faulty || axis.loop.is_lost()) && wish == DriveWish::kOn ? DriveWish::kOff : wish;  // what this SYNC has found acts at once
  axis.speed = led && now == DriveWish::kOn ? speed_of(axis) : 0;
  axis.watch.give(axis.speed / axis.map->velocity_per_increment * bus_.sync_us * 1e-6);
  axis.control = now == DriveWish::kOn && !in_mode && !homing ? kShutdown : axis.way.next(axis.status, now);
  if (axis.homing == Homing::kRuns && axis.control == kEnableOperation) axis.control |= kStartHoming;
  if (axis.homing == Homing::kStops && axis.control == kEnableOperation) axis.control |= kHalt;
  if (axis.map->has_probe()) work_probe(&axis);
  send_rpdo(axis);
}

// The set-point for this SYNC. When the command of the scan is missing, the axis goes on for one SYNC as in the last one, or with a longer SYNC keeps the last
// set-point. Then it stays: the time of the program stands still while there is no scan, so what the axis went on meanwhile it would have to go back in one SYNC.
// command_timeout_ms ends that. A jump that the axis can never follow is a fault, and the last set-point stays.
std::int64_t Cyclic::target_of(Axis* axis, const AxisWanted& wanted) noexcept {
  const std::int64_t last = axis->target[1];
  if (!fresh_command_) {
    const std::int64_t step = last - axis->target[2], slower = 2 * step - (axis->target[2] - axis->target[3]);  // an axis that brakes brakes on, and does not pass its end
    const std::int64_t next = (step < 0) != (slower < 0) ? 0 : std::abs(slower) < std::abs(step) ? slower : step;
    return bus_.sync_us > bus_.cycle_us || late_syncs_ > 1 ? last : last + next;
  }
  const double most = (axis->map->max_velocity * kJumpFactor * bus_.sync_us * 1e-6 + kJumpSlack) * std::abs(axis->map->increments_per_unit);
  if (axis->map->max_velocity <= 0 || std::abs(static_cast<double>(wanted.target - last)) <= most) return wanted.target;
  fault(axis, DriveTrouble::kJump);
  return last;
}

// The speed of an axis whose position is held here: that of the set-points, and what brings the axis to the one that it should have been at when it was measured. While
// positions are missing that of the set-points is all that is known.
std::int32_t Cyclic::speed_of(const Axis& axis) const noexcept {
  const double sync_s = bus_.sync_us * 1e-6, most = axis.map->max_velocity > 0 ? axis.map->max_velocity * kSpeedReserve * std::abs(axis.map->increments_per_unit) : HUGE_VAL;
  const auto back = static_cast<unsigned>(axis.map->velocity_delay);
  const double share = axis.map->velocity_delay - back;
  const double place = static_cast<double>(axis.target[back]) + share * static_cast<double>(axis.target[back + 1] - axis.target[back]);
  const double away = axis.missed == 0 ? place - static_cast<double>(axis.position) : 0;
  const double speed = std::clamp(static_cast<double>(axis.target[0] - axis.target[1]) / sync_s + axis.map->velocity_gain * away, -most, most);
  return static_cast<std::int32_t>(std::lround(std::clamp(speed * axis.map->velocity_per_increment, -2147483647.0, 2147483647.0)));
}

// The following error is the distance of the axis from the range between the set-points of this SYNC and of the two before, because on its way the axis may be
// anywhere in it; where the position is held here it lies as far back as that takes, and beyond the limit the loop is lost. A place of before says nothing about this SYNC: while positions are missing, lost_after bounds the time.
void Cyclic::check_following(Axis* axis) noexcept {
  if (axis->missed != 0) return;
  const auto [least, most] = std::minmax_element(axis->target, axis->target + (axis->map->holds_position() ? static_cast<unsigned>(axis->map->velocity_delay) + 2 : 3));
  const std::int64_t away = std::max({std::int64_t{0}, *least - axis->position, axis->position - *most});
  const double limit = axis->map->following_limit * std::abs(axis->map->increments_per_unit);
  const bool own = limit > 0 && static_cast<double>(away) > limit;
  if (own && axis->map->holds_position()) return axis->loop.lose();
  if (own || (!axis->map->takes_speed() && (axis->status & kStatusError) != 0)) axis->following_fault = true;  // bit 13 says something else in that mode
}

// Far less is measured of an axis whose position is held here than it was given: its encoder does not count. A place of before is none that says so.
void Cyclic::check_way(Axis* axis, bool led) noexcept {
  if (!led) return axis->watch.rest(axis->position);
  if (axis->watch.step(axis->position) && axis->missed == 0) axis->loop.lose();
}

// Homing by the drive itself: the drive moves the axis, and the commanded position follows meanwhile. True while homing is under way.
bool Cyclic::home_axis(unsigned index, Axis* axis, const AxisWanted& wanted) noexcept {
  const bool rises = wanted.home && !axis->home_before;
  axis->home_before = wanted.home;
  if (rises && follows(index) && axis->map->has_homing()) {
    axis->homing = Homing::kMode;
    axis->homing_syncs = axis->mode_syncs = 0;
    axis->homed = false;
    axis->count.forget();  // its drive redefines its position
    wanted_mode_[index].store(kModeHoming, std::memory_order_release);
  }
  if (axis->homing == Homing::kNo) return false;
  give_up_homing(axis, wanted);
  const std::int8_t mode = mode_[index].load(std::memory_order_acquire);
  const bool done = axis->homing == Homing::kRuns && judge_homing(axis);
  if (axis->homing == Homing::kMode) begin_homing(axis, mode);
  ++axis->homing_syncs;
  const unsigned most_ms = axis->homing == Homing::kStops ? bus_.stop_timeout_ms : static_cast<unsigned>(axis->map->homing_timeout_s * 1000);
  const bool late = axis->homing_syncs > syncs_of(most_ms);
  const bool stopped = axis->homing == Homing::kStops && axis->stood_syncs > kStandsFor;
  if (late) fault(axis, DriveTrouble::kHoming);
  if (done && !axis->faulty) axis->homed = true;
  if (done || stopped || axis->faulty || !wanted.on) {
    if (axis->homing != Homing::kBack) axis->homing_syncs = 0;
    axis->homing = Homing::kBack;
    wanted_mode_[index].store(axis->map->mode, std::memory_order_release);
  }
  if (axis->homing == Homing::kBack && mode == axis->map->mode) axis->homing = Homing::kNo;
  return axis->homing != Homing::kNo;
}

// The start bit follows when the drive has been in the homing mode for so long that the status is no longer that of its mode before.
void Cyclic::begin_homing(Axis* axis, std::int8_t mode) noexcept {
  if (mode != kModeHoming || axis->missed != 0 || ++axis->mode_syncs <= kHomingSettle) return;
  axis->homing = Homing::kRuns;
  axis->homing_syncs = 0;
  axis->answer.start(axis->status, axis->map->homing_method);
}

// True when the drive has attained its mark.
bool Cyclic::judge_homing(Axis* axis) noexcept {
  if (axis->missed != 0) return false;  // a status of before says nothing
  const HomingAnswer::Says says = axis->answer.step(axis->status, axis->position, still_of(*axis), syncs_of(kHomingBeginMs));
  if (says == HomingAnswer::Says::kFailed) fault(axis, DriveTrouble::kHoming);
  if (says == HomingAnswer::Says::kNotBegun) fault(axis, DriveTrouble::kHomingNotBegun);
  return says == HomingAnswer::Says::kAttained;
}

// Increments within which an axis that stands keeps its place.
std::int64_t Cyclic::still_of(const Axis& axis) noexcept { return std::max<std::int64_t>(2, std::llround(kStandsWithin * std::abs(axis.map->increments_per_unit))); }

// Bit 4 of the control word off interrupts a homing, and bit 8 brings the axis to rest; in the drive's next mode, whose first set-point is where it stands, it must not move.
void Cyclic::give_up_homing(Axis* axis, const AxisWanted& wanted) noexcept {
  if (wanted.stop_homing && (axis->homing == Homing::kMode || axis->homing == Homing::kRuns)) {
    axis->homing = Homing::kStops;
    axis->homing_syncs = axis->stood_syncs = 0;
    axis->stop_place = axis->position;
  }
  if (axis->homing != Homing::kStops || axis->missed != 0) return;
  ++axis->stood_syncs;
  if (std::abs(axis->position - axis->stop_place) <= still_of(*axis)) return;
  axis->stop_place = axis->position;
  axis->stood_syncs = 0;
}

// The drive latches the position of its axis at the edge of the probe. The skip signal is then on for some SYNCs, and after that the probe is made ready for
// the next edge.
void Cyclic::work_probe(Axis* axis) noexcept {
  if (axis->edge_waits) return;
  const bool falling = axis->map->skip_falling;
  const bool stored = (axis->probe_status & (falling ? kStoredFalling : kStoredRising)) != 0;
  if (axis->probe_on) {
    if (axis->probe_syncs > 0 && --axis->probe_syncs > 0) return;
    axis->probe_on = false;
    axis->probe_function = 0;
  } else if (axis->probe_function == 0) {
    if (!stored) axis->probe_function = static_cast<std::uint16_t>(kProbeEnable | (falling ? kProbeFalling : kProbeRising));
  } else if (stored) {
    const auto back = static_cast<std::int32_t>(static_cast<std::uint32_t>(axis->probe_raw) - static_cast<std::uint32_t>(axis->count.raw()));
    axis->probe = axis->position + back;
    axis->edge_waits = true;
    axis->edge_syncs = 0;
  }
}

// Of each axis of the part system a position has come since the edge. One that stays away is a fault soon, and then nobody waits for it. They need not come with one SYNC: of drives that
// answer by turns no SYNC has them all, and the edge would wait until the track has forgotten it.
bool Cyclic::knows_places(const Axis& probe) const noexcept {
  for (const Axis& axis : axes_)
    if (axis.map->system == probe.map->system && !axis.faulty && nodes_[axis.node].operational && !axis.track.known_since(probe.edge_syncs)) return false;
  return true;
}

// Where all axes of a part system were at the edge of a probe: the signal waits until that is known, which is one SYNC longer where an answer is late or lost. When
// probes with different signals come with one SYNC, the first one has its place, and the other signal counts as not latched.
void Cyclic::note_edges() noexcept {
  std::uint32_t noted = 0;
  for (Axis& axis : axes_) {
    if (!axis.edge_waits) continue;
    if (!knows_places(axis)) {
      ++axis.edge_syncs;
      continue;
    }
    axis.probe_on = true;
    axis.probe_syncs = kProbeHold;
    const std::uint32_t system = 1u << axis.map->system;
    if ((noted & system) == 0) note_edge(axis);
    noted |= system;
    axis.edge_waits = false;
  }
}

// An axis whose own drive has latched its place for the same signal has that. The others were, at the time at which the axis of the probe passed its place, on
// the way between their positions of two SYNCs.
void Cyclic::note_edge(const Axis& probe) noexcept {
  const AxisMap& map = *probe.map;
  latched_[map.system] = 0;
  if (probe.track.empty()) return;
  const double since = probe.track.since(probe.probe, std::llround(kProbeSlack * std::abs(map.increments_per_unit)));
  if (since < 0) return fault(&axes_[static_cast<std::size_t>(&probe - axes_.data())], DriveTrouble::kProbe);
  for (Axis& axis : axes_) {
    if (axis.map->system != map.system) continue;
    const bool own = (axis.probe_on || axis.edge_waits) && axis.map->skip_signal == map.skip_signal;
    axis.edge = own ? axis.probe : axis.track.at(since);
  }
  latched_[map.system] = 1u << (map.skip_signal - 1);
}

void Cyclic::send_rpdo(const Axis& axis) noexcept {
  CanFrame frame;
  frame.id = axis.rpdo_id;
  frame.length = axis.map->has_probe() ? 8 : 6;
  put_le(frame.data, 2, axis.control);
  put_le(frame.data + 2, 4, static_cast<std::uint32_t>(axis.map->holds_position() ? axis.speed : axis.target[0]));
  if (axis.map->has_probe()) put_le(frame.data + 6, 2, axis.probe_function);
  send(frame);
}

}  // namespace nc::hal::canopen
