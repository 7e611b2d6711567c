// SPDX-License-Identifier: Apache-2.0
#include "offset/space.hpp"

#include <cmath>
#include <new>

#include "alarm/condition.hpp"
#include "base/same_place.hpp"

namespace nc {
namespace {

/// What rounding makes of two radii that the interpreter has found to agree.
constexpr double kRounding_mm = 1e-6;

bool is_nothing(const SpaceVector& vector) { return vector.v[0] == 0 && vector.v[1] == 0 && vector.v[2] == 0; }

void add(AxisVec& point, const SpaceVector& vector) {
  if (!vector.on) return;
  for (unsigned i = 0; i < 3; ++i) point[vector.axis[i]] += vector.v[i];
}

bool goes_anywhere(const Move& move) {
  if (move.circular) return true;
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if (std::fabs(move.end[i] - move.start[i]) > kNoLength) return true;
  return false;
}

/// The ends have moved, the centre has not: radii and angles follow.
void follow_ends(const AxisVec& start, const AxisVec& end, Move& move) {
  Circle& circle = move.circle;
  const unsigned h = move.plane_axis[0], v = move.plane_axis[1];
  const double from[2] = {start[h] - circle.center[0], start[v] - circle.center[1]};
  const double to[2] = {end[h] - circle.center[0], end[v] - circle.center[1]};
  const double now_from[2] = {move.start[h] - circle.center[0], move.start[v] - circle.center[1]};
  const double now_to[2] = {move.end[h] - circle.center[0], move.end[v] - circle.center[1]};
  const auto turn = [](const double a[2], const double b[2]) { return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]); };
  const double at_start = turn(from, now_from);
  circle.sweep += turn(to, now_to) - at_start;
  circle.angle_start += at_start;
  circle.radius_start = std::hypot(now_from[0], now_from[1]);
  circle.radius_end = std::hypot(now_to[0], now_to[1]);
}

}  // namespace

void SpaceStage::reset() {
  full_ = failed_ = false;
  vector_ = {};
}

bool SpaceStage::push(const Item& item, SpaceRule rule) {
  if (full_) return false;
  if (failed_) return true;  // nothing is read behind an alarm
  item_ = item;
  full_ = true;
  if (item_.kind != ItemKind::move) return true;
  const bool displaced = vector_.on;
  displace(item_.move);
  if (item_.move.circular && (displaced || vector_.on)) {
    const double apart = circle_apart(item_.move.circle.radius_start, item_.move.circle.radius_end);
    if (!(apart <= rule.arc_tolerance + kRounding_mm)) {
      stop(apart);
      return true;
    }
  }
  full_ = goes_anywhere(item_.move);  // a command without a movement, and without another vector
  return true;
}

/// The program stops in front of the arc: the alarm takes its place.
void SpaceStage::stop(double apart) {
  const nc_source source = item_.source;
  item_ = Item();
  item_.kind = ItemKind::alarm;
  item_.source = source;
  new (&item_.alarm) Fault();
  item_.alarm.condition = Condition::arc_displaced;
  item_.alarm.has_value = std::isfinite(apart);
  item_.alarm.value = item_.alarm.has_value ? apart : 0;
  failed_ = true;
}

void SpaceStage::displace(Move& move) {
  SpaceVector next = move.space;
  next.on = next.on && !move.leaves_space && !is_nothing(next);
  const AxisVec start = move.start, end = move.end;
  add(move.start, vector_);
  add(move.end, next);
  const bool moved = vector_.on || next.on;
  vector_ = next.on ? next : SpaceVector{};
  if (moved && move.circular) follow_ends(start, end, move);
}

bool SpaceStage::pop(Item& out) {
  if (!full_) return false;
  out = item_;
  full_ = false;
  return true;
}

}  // namespace nc
