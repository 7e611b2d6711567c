// SPDX-License-Identifier: Apache-2.0
// The scan and what lies behind interpolation: what waits until the filters are empty (M700 7.7, 7.9), and the compensation of an arc's
// radius that is added to the interpolated place (M700 13.15).
#include <cmath>

#include "interpolate/interpolator.hpp"
#include "interpolate/radius_share.hpp"

namespace nc {

/// The next record is executed when the filters are empty: behind a deceleration check every one is (7.9, "XX expresses all commands"),
/// what needs standing axes always, M, S, T and B where the path rests for them, and the end of a block where something stops or is read
/// again there.
bool Interpolator::waits_for_filters(const Record& r, const nc_inputs& in) {
  const bool stands_there = r.kind == ItemKind::gate || r.kind == ItemKind::sync || r.kind == ItemKind::alarm || r.kind == ItemKind::end;
  if (stands_there) law_.v = 0;  // the plan rests in front of these: what is left of the speed is rounding
  if (!at_rest()) return false;
  if (drained()) {
    check_ = false;
    return false;
  }
  bool waits = check_ || stands_there;
  if (r.kind == ItemKind::action) waits = waits || r.action.kind <= NC_ACTION_B || r.action.kind == NC_ACTION_MESSAGE;
  if (r.kind == ItemKind::mark) waits = waits || stops_at(r.mark, in) || interrupt_wanted_ || recalculate_ || stale_ != 0;
  if (waits) wait(NC_CAUSE_IN_POSITION);
  return waits;
}

/// A move begins, or goes on from a rest. Filters change while nothing is in them. Acceleration after interpolation goes on from a rest
/// only when that has ended; a path that is accelerated before interpolation goes on at once, but for a deceleration check.
bool Interpolator::filters_ready(const Record& r) {
  const Segment& s = r.segment;
  const bool same = filter_.uses(s.filter);
  if (!same) law_.v = 0;  // the plan rests here
  if (!at_rest()) return true;
  const bool check = !moving_ && (s.rapid || s.skip || s.rest_before);
  if (same && !check && filter_.goes_on()) return true;
  if (!drained()) return false;
  if (same) return true;
  if (!filter_.settled(place())) return false;  // what was gone in this cycle is not for the new ones
  if (!filter_.use(s.filter)) {  // commit lets none through that does not fit
    (void)fault(r);
    return false;
  }
  return true;
}

/// The position that the axes had when the cycle began, at which the signal was sampled.
void Interpolator::note_skip(const nc_inputs& in) {
  skipped_ = true;
  skip_position_ = filter_.active() ? filter_.position() : wanted_;
  if (!in.actual_valid) return;
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if ((spindles_now() >> i & 1) == 0) skip_position_[i] = in.actual.v[i];
}

/// The path of a skip move rests, or has come to its end, and the axes are still on their way: the signal counts as long as they are.
void Interpolator::watch_skip(const nc_inputs& in) {
  if (drained()) {
    skip_behind_ = 0;
    return;
  }
  const bool inside = moving_ && at_rest() && current().segment.skip;
  const uint32_t mask = inside ? current().segment.skip_mask : moving_ ? uint32_t{0} : skip_behind_;
  if (skipped_ || (in.skip & mask) == 0) return;
  skip_braking_ = inside;
  skip_behind_ = 0;
  note_skip(in);
}

/// M700 13.15 "circular error radius compensation control for each axis": outwards from the centre, growing over the first quarter turn and
/// falling over the last.
void Interpolator::round_arc(const Segment& s) {
  const Curve& c = s.curve;
  const double along = wanted_[c.h] - c.circle.center[0], across = wanted_[c.v] - c.circle.center[1];
  const double radius = std::sqrt(along * along + across * across);
  if (!c.circular || !(radius > 0)) return;
  constexpr double kDegrees = 57.295779513082320877;
  const double sweep = std::fabs(c.circle.sweep) * kDegrees;
  const double share = radius_compensation_share(sweep * (law_.s / c.length), sweep);
  rounding_ = true;
  round_axis_[0] = c.h;
  round_axis_[1] = c.v;
  round_[0] = static_cast<double>(s.round_mm[0]) * share * (along / radius);
  round_[1] = static_cast<double>(s.round_mm[1]) * share * (across / radius);
}

/// The arc is not gone on with: the path is where the axes are.
void Interpolator::end_rounding() {
  wanted_ = place();
  rounding_ = false;
}

/// Composite speed of the linear axes, or of the rotary ones when no linear axis moves (M700 7.6), mm/s.
double Interpolator::feed_of_axes() const {
  double linear = 0, rotary = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    const double way = command_[i] - last_command_[i];
    ((config_.rotary >> i & 1) != 0 ? rotary : linear) += way * way;
  }
  return std::sqrt(linear > 0 ? linear : rotary) / config_.cycle_s;
}

}  // namespace nc
