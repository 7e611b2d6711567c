// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1) whose spindle is a C axis (10.5). The turns of the tap are added to the commands of that axis, behind interpolation, and both
// axes go as two axes of one line do: the path leaves to each its velocity, its acceleration and (in the optimal mode) its jerk, and neither follows the other,
// since the drives of both lag alike.
//
// What an axis of a line has no need of is looked at here: whether C follows. A C axis that loses its servo READY in the hole, or whose measured place is not that
// of the thread any more, is the alarm of a spindle that does not follow. From then on the axis of the tap goes by the place that is measured of C, as it does
// with a spindle (interpolate/tap_follower.hpp), so that it stands where that stands.
#include <algorithm>
#include <cmath>

#include "base/same_place.hpp"
#include "base/units.hpp"
#include "interpolate/interpolator.hpp"

namespace nc {
namespace {

// Turns by which the measured places of the two axes may be apart: what is a quarter of a turn beside its thread is torn.
constexpr double kPairApart = 0.25;
constexpr double kTurns = 1e-9;  // turns in one cycle: less is rounding

}  // namespace

/// The C axis that the spindle of the tap is, -1 = it is a spindle. What it is stays as it is from the beginning of the mode to its end (10.6.1); that the drive
/// loses its READY meanwhile makes no spindle of it.
int Interpolator::tap_as_axis() const {
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if ((servo_on_ >> i & 1) != 0 && config_.axis_spindle[i] == spindles_.lead() + 1) return static_cast<int>(i);
  return -1;
}

/// 10.5: a C axis without its servo READY is not commanded.
bool Interpolator::tap_axis_ready() {
  if ((servo_ready_ >> tap_.c_axis & 1) != 0) return true;
  wait(NC_CAUSE_SERVO_OFF);
  return false;
}

/// The tap takes its C axis over where it stands.
void Interpolator::take_tap_axis(const nc_inputs& in) {
  const auto c = static_cast<unsigned>(tap_.c_axis);
  tap_.c_from = command_[c] - kDegreesOfTurn * in.spindle[config_.axis_spindle[c] - 1].turns;
}

/// Behind a power cut nobody knows what the spindle of the tap has been. It is what it is when the tap begins to move.
void Interpolator::adopt_tap_axis(const nc_inputs& in) {
  const int now = tap_as_axis();
  if (manual_.active() || now == tap_.c_axis || (now >= 0 && (servo_ready_ >> now & 1) == 0)) return;
  tap_.c_axis = now;
  tap_.shown = tap_turns();
  tap_follower_.drop();
  if (now >= 0) take_tap_axis(in);
}

/// The tap lets it go. Where it has not been turned back as far as it has been turned it stands beside the committed path, which does not know of that.
void Interpolator::leave_tap_axis() {
  if (tap_.c_axis < 0 || !tap_.known) return;
  const double turned = kDegreesOfTurn * tap_turns();
  tap_.added = 0;
  if (std::fabs(turned) <= kAddingUp) return;
  const auto c = static_cast<unsigned>(tap_.c_axis);
  turned_[c] += turned;
  stale_ = static_cast<uint8_t>(stale_ | 1u << c);
}

/// What such a limit of the C axis allows along the path of a tap, HUGE_VAL = anything.
double Interpolator::tap_axis_most(const Segment& s, double AxisLimits::*limit) const {
  if (s.tap_rev_per_mm == 0 || tap_.c_axis < 0) return HUGE_VAL;
  const double most = config_.limits[tap_.c_axis].*limit;
  return most > 0 ? most / (kDegreesOfTurn * std::fabs(s.tap_rev_per_mm)) : HUGE_VAL;
}

/// A tap in its hole turns this axis.
bool Interpolator::tap_turns_axis(unsigned axis) const {
  return tap_.c_axis == static_cast<int>(axis) && (tap_.held || ((tapping_ & NC_TAPPING_SYNCHRONOUS) != 0 && tap_.known));
}

/// Where the C axis is measured to be, deg.
double Interpolator::tap_axis_place(const nc_inputs& in) const {
  const auto c = static_cast<unsigned>(tap_.c_axis);
  return in.actual_valid ? in.actual.v[c] : tap_.c_from + kDegreesOfTurn * in.spindle[config_.axis_spindle[c] - 1].turns;
}

bool Interpolator::tap_axis_measured(const nc_inputs& in) const {
  const nc_spindle_inputs& spindle = in.spindle[config_.axis_spindle[tap_.c_axis] - 1];
  return in.actual_valid || (spindle.turns_valid && !spindle.unmeasured);
}

/// Adds the turns of the tap to the commands of the C axis: in a cycle to those of the path, by hand to where it has been turned to.
void Interpolator::turn_tap_axis() {
  const auto c = static_cast<unsigned>(tap_.c_axis);
  const double turned = kDegreesOfTurn * (tap_turns() - tap_.shown);
  tap_.added = tap_.held ? 0 : kDegreesOfTurn * tap_turns();
  if (tap_.held) wanted_[c] += turned;
  command_[c] += tap_.held ? turned : tap_.added;
}

/// The C axis does not do what the tap commands: it is not ready, or the two axes are not at one place of the thread. A tap that is left in its hole is looked at
/// as its axis is moved.
bool Interpolator::tap_axis_fails(const nc_inputs& in) const {
  const auto c = static_cast<unsigned>(tap_.c_axis);
  if ((!tap_.taken && !tap_.held) || tap_.locked) return false;
  if (tap_.held && std::fabs(tap_turns() - tap_.shown) <= kTurns) return false;
  if ((servo_ready_ >> c & 1) == 0) return true;
  if (!tap_axis_measured(in)) return false;
  const double behind = (tap_axis_place(in) - last_command_[c]) / kDegreesOfTurn;
  if (std::fabs(behind) > config_.tap_most_apart) return true;
  if (!in.actual_valid) return false;
  const double apart = behind - (in.actual.v[tap_.axis] - last_command_[tap_.axis]) * tap_.per_mm;
  return std::fabs(apart) > std::min(kPairApart, config_.tap_most_apart);
}

/// It has failed: from the next cycle on the axis of the tap goes by what is measured of the C axis, beginning with the speed that it has.
void Interpolator::begin_following_tap_axis(const nc_inputs& in) {
  if (!tap_axis_measured(in)) return;
  const unsigned a = tap_.axis;
  const double commanded = tap_turns(), turned = commanded - tap_.shown;
  tap_follower_.begin_moving(tap_axis_place(in) / kDegreesOfTurn + turned, commanded, command_[a], (command_[a] - last_command_[a]) / config_.cycle_s, tap_.per_mm);
}

/// By hand the axis of the tap goes no faster than its C axis can turn with it.
void Interpolator::spare_tap_axis(Manual::Rules* rules) const {
  const AxisLimits& c = config_.limits[tap_.c_axis];
  const double turning = kDegreesOfTurn * std::fabs(tap_.per_mm);
  rules->gentle |= 1u << tap_.axis;
  if (c.velocity > 0) rules->gentle_velocity = c.velocity / turning;
  if (c.acceleration > 0) rules->gentle_acceleration = std::min(rules->gentle_acceleration, c.acceleration / turning);
}

}  // namespace nc
