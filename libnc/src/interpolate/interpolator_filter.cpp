// SPDX-License-Identifier: Apache-2.0
// The scan and what acts behind interpolation: records that wait until the filters are empty (M700 7.7, 7.9), and the compensation of an arc's radius,
// which is added to the interpolated place (M700 13.15).
#include <cmath>

#include "interpolate/interpolator.hpp"
#include "interpolate/radius_share.hpp"

namespace nc {

/// The next record has to wait until the filters are empty. After a deceleration check every record waits (7.9, "XX expresses all commands"). Records
/// that need standing axes always wait; M, S, T, B and messages wait where the path rests before them; and the end of a block waits where the program
/// stops, is interrupted, or is read again from there.
bool Interpolator::waits_for_filters(const Record& r, const nc_inputs& in) {
  const bool stands_there = r.kind == ItemKind::gate || r.kind == ItemKind::sync || r.kind == ItemKind::alarm || r.kind == ItemKind::end;
  if (stands_there) law_.v = 0;  // the plan comes to rest before such a record, so any speed that is left is rounding
  if (!at_rest()) return false;
  if (drained()) {
    check_ = false;
    return false;
  }
  bool waits = check_ || stands_there;
  if (r.kind == ItemKind::action) waits = waits || r.action.kind <= NC_ACTION_B || r.action.kind == NC_ACTION_MESSAGE;
  if (r.kind == ItemKind::mark) waits = waits || stops_at(r.mark, in) || interrupt_wanted_ || recalculate_ || length_waits() || stale_ != 0;
  if (waits) wait(NC_CAUSE_IN_POSITION);
  return waits;
}

/// A move begins, or goes on from a rest: whether the filters are ready for it. Filters are changed only while they are empty. With acceleration after
/// interpolation the path goes on from a rest only when the axes rest, too; with acceleration before interpolation it goes on at once, except after
/// a deceleration check.
bool Interpolator::filters_ready(const Record& r) {
  const Segment& s = r.segment;
  const bool same = filter_.uses(s.filter);
  if (!same) law_.v = 0;  // the plan rests here
  if (!at_rest()) return true;
  const bool check = !moving_ && (s.rapid || s.skip || s.rest_before);
  if (same && !check && filter_.goes_on()) return true;
  if (!drained()) return false;
  if (same) return true;
  if (!filter_.settled(place())) return false;  // the way of this cycle still belongs to the old filters
  if (!filter_.use(s.filter)) {  // never happens: commit makes only filters that fit
    (void)fault(r);
    return false;
  }
  return true;
}

/// Notes where the skip signal came: the place that was latched with one of the signals that `came` during the move, or else the position that the axes had
/// when the cycle began, which is when the signal was sampled.
void Interpolator::note_skip(const nc_inputs& in, uint32_t came) {
  skipped_ = true;
  skip_position_ = filter_.active() ? filter_.position() : wanted_;
  const bool latched = (came & in.skip_latched) != 0;
  if (!latched && !in.actual_valid) return;
  const nc_axes& place = latched ? in.skip_place : in.actual;
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if ((spindles_now() >> i & 1) == 0) skip_position_[i] = place.v[i];
}

/// When the path of a skip move rests, or has come to its end, the axes may still be moving behind the filters: the signal counts as long as they do.
void Interpolator::watch_skip(const nc_inputs& in) {
  if (drained()) {
    skip_behind_ = 0;
    return;
  }
  const bool inside = moving_ && at_rest() && current().segment.skip && !all_locked(current().segment, in);
  const uint32_t mask = inside ? current().segment.skip_mask : moving_ ? uint32_t{0} : skip_behind_;
  const bool away = inside ? current().segment.skip_away : skip_behind_away_;
  if (skipped_ || mask == 0 || ((in.skip & mask) != 0) == away) return;
  skip_braking_ = inside;
  skip_behind_ = 0;
  note_skip(in, away ? 0 : in.skip & mask);
}

/// M700 13.15 "circular error radius compensation control for each axis": moves the place outwards from the centre, by an amount that grows over the
/// first quarter turn and falls over the last one.
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

/// The arc does not go on: the path goes on from where the compensation has brought the axes.
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
