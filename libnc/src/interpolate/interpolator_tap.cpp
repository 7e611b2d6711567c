// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1): the path turns the spindle, and the axis follows the angle that the spindle really has (interpolate/tap_follower.hpp). Also the
// tap that a reset or a power cut has left in its hole: its spindle turns with its axis by hand, and a signal draws it out.
// Where the spindle is a C axis (M700 10.5): interpolator_tap_axis.cpp.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/same_place.hpp"
#include "base/units.hpp"
#include "interpolate/interpolator.hpp"

namespace nc {
namespace {

constexpr double kStands_rev_s = 1e-3;
constexpr double kOut = 1e-3;  // mm: so near to R a tap is out of its hole
constexpr double kLongestWait_s = 1;  // for a spindle to come to the place where it is let go

}  // namespace

/// A synchronous tap takes its spindles over where they stand: once, also where its cuts go back to where they have begun.
bool Interpolator::tap_spindle_ready(const nc_inputs& in) {
  if (tap_.taken) return true;
  tap_.c_axis = tap_as_axis();
  if (optimal_ != nullptr && (follower_.idle() || follower_.planned_turning_axis() != tap_.c_axis)) {  // the planner has not heard of it yet
    wait(NC_CAUSE_STARVED);
    return false;
  }
  if (tap_.c_axis >= 0) return tap_axis_ready();
  const nc_spindle_inputs& spindle = encoder(in);
  if (encoder_ == 0 || spindle.unmeasured) {  // appendix 1, P182: there is no connection to the spindle
    wait(NC_CAUSE_SPINDLE_UNMEASURED);
    return false;
  }
  bool stand = std::fabs(spindle.rev_per_s) <= kStands_rev_s;
  for (unsigned n = 0; n < spindles_.count(); ++n)
    stand = stand && ((spindles_.selected() >> n & 1) == 0 || std::fabs(in.spindle[n].rev_per_s) <= kStands_rev_s);
  if (stand) return true;
  wait(NC_CAUSE_SPINDLE_ANGLE);
  return false;
}

/// The move that begins is a stroke of a tap: what a retract needs to know of it.
void Interpolator::note_tap(const Segment& s, const nc_inputs& in) {
  if (tap_.taken) return;
  tap_.taken = true;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    const double way = s.curve.delta[i];
    if (std::fabs(way) <= kAddingUp) continue;
    tap_.axis = i;
    tap_.per_mm = s.tap_rev_per_mm * s.curve.length / way;
    tap_.entry = s.curve.start[i];
    const double share = std::fabs(way) / s.curve.length;
    tap_.speed = std::copysign(s.feed_mm_s * share, way);
    tap_.acceleration = s.tap_acceleration * share;
  }
  tap_.known = true;
  tap_.locked = (in.locked >> tap_.axis & 1) != 0;
  if (tap_.c_axis >= 0) {
    take_tap_axis(in);
  } else if (!tap_.locked && encoder(in).turns_valid) {
    tap_follower_.begin(encoder(in).turns, 0);
  }
}

/// The tap may let its spindle go: both have come to their places. Where the spindle stands a little beside its own, the axis comes back to its path while that
/// rests, since later it would be more than the moves behind it bear beside their own jerk.
bool Interpolator::tap_lets_go() {
  if (!tap_follower_.active()) return true;
  if (tap_follower_.ended()) return !tap_follower_.waited_for();
  if (!tap_follower_.arrived()) {
    tap_.waited_s += config_.cycle_s;
    if (tap_.waited_s > kLongestWait_s) tap_follower_.say_apart();
    return false;
  }
  tap_.waited_s = 0;
  if (tap_follower_.on_path()) return true;
  tap_follower_.end_at_rest();
  return false;
}

/// M700 13.1.1, G84: a hold that came between R and R again acts now.
Interpolator::Done Interpolator::take_tapping(uint8_t bits) {
  if ((bits & NC_TAPPING_STROKES) == 0 && !tap_lets_go()) return wait(NC_CAUSE_SPINDLE_ANGLE);
  tap_.waited_s = 0;
  if ((bits & ~tapping_ & NC_TAPPING_SYNCHRONOUS) != 0) {
    tap_.turns = 0;
    tap_.held = tap_.taken = false;
  }
  if ((bits & NC_TAPPING_STROKES) == 0) {
    leave_tap_axis();
    tap_follower_.end();
  }
  if ((bits & NC_TAPPING_SYNCHRONOUS) == 0) tap_.known = false;  // between two holes the tap is in none
  tapping_ = bits;
  if (!hold_behind_tap_ || (bits & NC_TAPPING_STROKES) != 0) return Done::yes;
  hold_behind_tap_ = false;
  if (state_ != NC_STATE_RUNNING) return Done::yes;
  hold_ = true;
  state_ = NC_STATE_HOLD;
  return Done::yes;
}

/// What is committed is given up between R and R again: from here on the spindle goes with the axis by hand, so that the tap can be drawn out.
/// One whose axis is locked is in no hole.
void Interpolator::hold_tap() {
  if ((tapping_ & NC_TAPPING_SYNCHRONOUS) == 0 || !tap_.known) return;
  if (tap_.locked) return release_tap();
  if (tap_.c_axis >= 0) wanted_[static_cast<unsigned>(tap_.c_axis)] += tap_.added;
  tap_.added = 0;
  tap_.held = true;
  tap_.stuck = false;
}

/// The next code for the spindle ends it, the next program, and motion by hand out of the hole.
void Interpolator::release_tap() {
  tap_.held = tap_.known = tap_.drawing = tap_.adopts = tap_.selects = false;
  tap_follower_.end();
}

/// The next program begins. What the axis is beside its path by then is taken away before its first move, which has all of the acceleration for itself.
void Interpolator::leave_tap() {
  const bool beside = !tap_follower_.on_path();
  release_tap();
  if (beside) tap_follower_.end_at_rest();
}

/// Revolutions since the tap has taken its spindle over. With an axis that stands in a machine lock it would turn in one place, so it stands as well.
double Interpolator::tap_turns() const {
  if (tap_.locked) return 0;
  if (tap_.held) return (wanted_[tap_.axis] - tap_.entry) * tap_.per_mm;
  return tap_.turns + (moving_ ? law_.s * current().segment.tap_rev_per_mm : 0);
}

/// Adds to the commanded places what the tap makes of them: the axis follows the measured angle, a C axis turns.
void Interpolator::follow_tap(const nc_inputs& in) {
  const bool taps = tap_.held || ((tapping_ & NC_TAPPING_SYNCHRONOUS) != 0 && tap_.known);
  const unsigned a = tap_.axis;
  if (tap_.held && tap_.adopts) adopt_tap_axis(in);
  if (taps && tap_.c_axis >= 0) turn_tap_axis();
  else tap_.added = 0;
  const bool stands = tap_.held && tap_.c_axis < 0 && !tap_follower_.active() && encoder(in).rev_per_s == 0;
  if (stands && encoder(in).turns_valid) tap_follower_.begin(encoder(in).turns, tap_turns());  // behind a power cut, or with drives that were off
  if (taps && tap_.c_axis >= 0 && faulted_ == ScanFault::none && tap_axis_fails(in)) {
    fail_tap(ScanFault::tap);
    if (!tap_follower_.active()) return begin_following_tap_axis(in);
  }
  if (!tap_follower_.active()) return;
  const bool as_axis = tap_.c_axis >= 0;
  const bool measured = taps && (as_axis ? tap_axis_measured(in) : encoder(in).turns_valid && !encoder(in).unmeasured);
  const double turns = as_axis ? tap_axis_place(in) / kDegreesOfTurn : encoder(in).turns;
  if (tap_.held && measured && !alarmed_ && (as_axis ? tap_follower_.rests() : tap_follower_.rests_beside()) && !manual_.active()) take_tap_where_it_stands(in);
  if (!tap_follower_.active()) return;
  TapFollower::Limits limits{config_.limits[a].velocity, config_.limits[a].acceleration, config_.limits[a].jerk, config_.cycle_s};
  limits.most_apart = config_.tap_most_apart;
  limits.before = last_command_[a];
  if ((config_.soft_limited >> a & 1) != 0 && (in.unlimited >> a & 1) == 0) {
    limits.low = std::min(config_.soft_min[a], command_[a]);
    limits.high = std::max(config_.soft_max[a], command_[a]);
  }
  command_[a] += tap_follower_.step(measured, turns, as_axis ? 0 : encoder_age_s(in), taps ? tap_turns() : 0, tap_.per_mm, command_[a], limits);
  if (tap_follower_.trouble() == TapFollower::Trouble::none || faulted_ != ScanFault::none) return;
  fail_tap(tap_follower_.trouble() == TapFollower::Trouble::jumped ? ScanFault::encoder : ScanFault::tap);
}

/// The spindle of the tap does not do what it is told: the alarm that stops the path.
void Interpolator::fail_tap(ScanFault fault) {
  if (!alarmed_ && placed_) stop_in(source_, serial_ == last_mark_ ? last_block_ - 1 : last_block_);
  faulted_ = fault;
  tap_.stuck = tap_.held;
  alarmed_ = true;
}

/// A tap that is left in its hole beside its path: axis and spindle are at one place of the thread, from which both go on. Only the command of either is
/// taken to it.
void Interpolator::take_tap_where_it_stands(const nc_inputs& in) {
  const double beside = tap_follower_.beside();
  wanted_[tap_.axis] += beside;
  command_[tap_.axis] += beside;
  tap_.shown += beside * tap_.per_mm;
  tap_follower_.drop();
  if (tap_.c_axis < 0) tap_follower_.begin(encoder(in).turns, tap_turns());
}

/// A tap that stands in its hole: the signal draws it out, with the speed and the acceleration with which it has gone in. True: `wish` says how.
bool Interpolator::draw_tap_out(const nc_inputs& in, nc_manual* wish, Manual::Rules* rules) {
  if (!tap_.held) return false;
  const uint32_t bit = 1u << tap_.axis;
  const double way = tap_.entry - wanted_[tap_.axis];
  if (tap_.acceleration > 0) {
    rules->gentle = bit;
    rules->gentle_acceleration = tap_.acceleration;
  }
  if (tap_.c_axis >= 0) spare_tap_axis(rules);
  const bool there = !(way * tap_.speed < 0) || std::fabs(way) <= kAddingUp;
  const bool rises = in.tap_retract && !tap_.pressed;
  tap_.pressed = in.tap_retract;
  if (there || rules->stop || (in.unlimited >> tap_.axis & 1) != 0) tap_.drawing = false;
  else if (rises) tap_.drawing = true, tap_.stuck = false;  // the spindle may turn again: this attempt tells
  if (!tap_.drawing) return false;
  if (!in.tap_retract) rules->held |= bit;
  wish[tap_.axis] = {NC_MANUAL_STEP, std::fabs(tap_.speed), way};
  return true;
}

/// A tap was given up, and its axis is not yet back at R.
bool Interpolator::tap_stands_in_hole() const {
  return tap_.held && out_by(wanted_[tap_.axis] + tap_follower_.beside()) < -kOut;  // the axis is where its spindle is
}

/// How far out of the hole this place of its axis is, mm; in the hole less than 0.
double Interpolator::out_by(double place) const { return std::copysign(1.0, tap_.speed) * (tap_.entry - place); }

/// It stands there, and can be drawn out. Where its spindle does not follow any more there is no other way than to free it by hand, and the machine has to be
/// moved for that.
bool Interpolator::tap_bars() const { return !tap_.stuck && tap_stands_in_hole(); }

/// By hand, out of its hole: the tap lets its spindle go, which could not turn as fast as its axis moves now. The axis comes back to its path then, and may be carried
/// a little beyond it, so that has to be out by a turn of the thread where they are not together. A C axis, whose turns are commands, is let go while it stands.
void Interpolator::let_tap_go_outside(const nc_inputs& in) {
  if (!tap_.held || (in.unlimited >> tap_.axis & 1) != 0 || tap_stands_in_hole()) return;
  const double out = out_by(wanted_[tap_.axis]);
  if (tap_follower_.on_path() ? out < -kOut : out * std::fabs(tap_.per_mm) < 1) return;
  const bool moves = manual_.active(), begins = !moves && in.manual[tap_.axis].kind != NC_MANUAL_NONE;
  if (tap_.c_axis >= 0 ? begins : moves || begins) release_tap();
}

/// The axes that would tear the tap sideways out of its hole. As long as its own axis does not know where it stands, the tap may be in it.
uint32_t Interpolator::tap_holds(const nc_inputs& in) const {
  const bool lost = tap_.held && !tap_.stuck && (in.unlimited >> tap_.axis & 1) != 0;
  if (!lost && !tap_bars()) return 0;
  return ((1u << config_.axis_count) - 1) & ~(1u << tap_.axis);
}

/// Bit n: spindle n+1 turns with the tap. Where the selection has gone it is the one that was selected last.
uint8_t Interpolator::tap_spindles() const { return spindles_.selected() != 0 ? spindles_.selected() : static_cast<uint8_t>(1u << spindles_.lead()); }

/// The angle that belongs to the place on the path, or of the axis that is moved by hand.
void Interpolator::turn_tap_spindle(const nc_inputs& in, nc_outputs& out) {
  out.tap_retract_possible = manual_allowed_ && tap_stands_in_hole();
  out.tap_holds = tap_holds(in);
  const bool taps = (tapping_ & NC_TAPPING_SYNCHRONOUS) != 0;
  const double turns = taps || tap_.held ? tap_turns() : 0;
  const double of_path = tap_.locked || !moving_ ? 0 : law_.v * current().segment.tap_rev_per_mm;
  const double speed = tap_.held ? (turns - tap_.shown) / config_.cycle_s : of_path;
  tap_.shown = turns;
  if ((!taps && !tap_.held) || tap_.c_axis >= 0) return;
  out.spindle_turns = turns;
  out.spindle_synchronous = tap_spindles();
  for (unsigned n = 0; n < spindles_.count(); ++n)
    if ((out.spindle_synchronous >> n & 1) != 0) out.spindle_rev_min[n] = 60 * speed;
}

nc_tap Interpolator::tap() const {
  nc_tap tap = NC_INIT(nc_tap);
  if (!tap_.known || tap_.locked) return tap;
  tap.axis = static_cast<uint8_t>(tap_.axis + 1);
  tap.entry = tap_.entry;
  tap.turns_per_mm = tap_.per_mm;
  tap.speed = tap_.speed;
  tap.acceleration = tap_.acceleration;
  if (tap_.selects) return tap;
  tap.spindles = tap_spindles();
  tap.encoder = static_cast<uint8_t>(encoder_);
  return tap;
}

/// Before the first cycle: the tap that stood in a hole when the power was cut.
void Interpolator::set_tap(const nc_tap& tap) {
  tap_ = {};
  if (tap.axis == 0) return;
  tap_.axis = tap.axis - 1u;
  tap_.entry = tap.entry;
  tap_.per_mm = tap.turns_per_mm;
  tap_.speed = tap.speed;
  tap_.acceleration = tap.acceleration;
  tap_.known = tap_.held = tap_.adopts = true;
  tap_.selects = tap.spindles == 0;
  if (tap_.selects) return;
  spindles_.select(tap.spindles);
  encoder_ = tap.encoder;
}

/// M700 10.6.1, relation (4), (5): in the tapping mode another selection is wanted, or its spindle as a C axis. The axes wait until that
/// is taken back (operation error M01 1026).
bool Interpolator::tap_disturbed(const nc_inputs& in) const {
  const unsigned count = spindles_.count();
  if (count > 1 && (in.spindle_select & ((1u << count) - 1)) != spindles_.selected()) return true;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    if ((c_axes_ & in.servo_on & ~servo_on_) >> i & 1) return true;
  }
  return false;
}

}  // namespace nc
