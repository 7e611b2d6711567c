// SPDX-License-Identifier: Apache-2.0
#include "contour/corner.hpp"

#include <cmath>

#include "alarm/condition.hpp"
#include "base/units.hpp"
#include "offset/corner.hpp"

namespace nc {
namespace {

/// 1 + cosine of a turn that is a way back: no circle touches both lines.
constexpr double kWayBack = 1e-12;
/// Longer than any block.
constexpr double kBeyond_mm = 1e9;

/// Turns that are none: the blocks go on in one direction, or straight back.
constexpr double kNoTurn = 1e-6;

Vec2 in_plane(const AxisVec& point, const uint8_t axis[2]) { return {point[axis[0]], point[axis[1]]}; }
double turned(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

/// A block as seen from the corner.
struct Side {
  Leg leg;
  double length = 0;  ///< in the plane
};

bool side_of(const Move& move, const uint8_t plane[2], bool ends, Side* side) {
  if (move.circular && (move.plane_axis[0] != plane[0] || move.plane_axis[1] != plane[1])) return false;
  const Vec2 start = in_plane(move.start, plane), end = in_plane(move.end, plane);
  if (!move.circular || !goes_round(move)) {
    side->length = norm(end - start);
    side->leg = {unit(end - start), 0};
    return side->length > kCornerSlack_mm;
  }
  const Vec2 radius = (ends ? end : start) - Vec2{move.circle.center[0], move.circle.center[1]};
  const double turning = move.circle.sweep < 0 ? -1 : 1;
  side->leg = {(turning / norm(radius)) * left_of(radius), turning / norm(radius)};
  side->length = std::abs(move.circle.sweep) * norm(radius);
  return true;
}

/// Where a point of the block lies that is this far along it from the corner; seen from the corner.
Vec2 point_along(const Leg& leg, double way) {
  if (leg.curvature == 0) return way * leg.u;
  const double angle = way * leg.curvature, c = std::cos(angle), s = std::sin(angle);
  return (s / leg.curvature) * leg.u + ((1 - c) / leg.curvature) * left_of(leg.u);
}

/// How far along the block from the corner the foot of a point beside it lies.
double way_to(const Leg& leg, Vec2 point) {
  if (leg.curvature == 0) return dot(point, leg.u);
  const Vec2 center = (1 / leg.curvature) * left_of(leg.u);
  return turned(-center, point - center) / leg.curvature;
}

/// How far along the block a circle of this radius about the corner crosses it; beyond any length where it does not.
double way_to_circle(const Leg& leg, double radius) {
  if (leg.curvature == 0) return radius;
  const double half = 0.5 * radius * std::abs(leg.curvature);
  return half <= 1 ? 2 * std::asin(half) / std::abs(leg.curvature) : kBeyond_mm;
}

/// How much a cut takes of the two blocks, and the centre of a rounding.
struct Taken {
  double before = 0, behind = 0;
  Vec2 center;
  double left = 1;  ///< the rounding turns to the left, -1 to the right
};

Condition fits(const Side& before, const Side& behind, const Taken& taken) {
  if (before.length < taken.before - kCornerSlack_mm) return Condition::corner_short;
  if (behind.length < taken.behind - kCornerSlack_mm) return Condition::corner_next_short;
  return Condition::none;
}

/// The rounding on one side of travel.
Condition round_on_side(const Side& before, const Side& behind, double radius, double left, Taken* taken) {
  const double beside = left * radius;
  taken->left = left;
  if (!offset_exists(before.leg, beside)) return Condition::corner_short;  // an arc that turns to that side, and is smaller
  if (!offset_exists(behind.leg, beside)) return Condition::corner_next_short;
  if (!intersection(before.leg, beside, behind.leg, beside, &taken->center)) return Condition::corner_short;
  taken->before = -way_to(before.leg, taken->center);
  taken->behind = way_to(behind.leg, taken->center);
  if (taken->before < 0) return Condition::corner_short;
  if (taken->behind < 0) return Condition::corner_next_short;
  return fits(before, behind, *taken);
}

/// By how much a rounding turns, 0 to a whole turn.
double sweep_of(const Side& before, const Side& behind, const Taken& taken) {
  const Vec2 from = point_along(before.leg, -taken.before), to = point_along(behind.leg, taken.behind);
  const double sweep = taken.left * turned(from - taken.center, to - taken.center);
  return sweep < -kNoTurn ? sweep + 2 * kPi : sweep;
}

/// The rounding lies on the side to which the path turns. At a cusp the tangents may tell one side of a gap of micrometres, behind which the blocks cross and
/// lie apart on the other: there it is the side on which the rounding has room. A circle of about the radius of an arc may touch it where the gap ends, and turn
/// by nothing there: the path would still turn back in one point, so at a cusp that is none.
Condition round_between(const Side& before, const Side& behind, double radius, Taken* taken) {
  const double sine = sine_of_turn(before.leg, behind.leg), left = sine > 0 ? 1 : -1;
  const Condition bad = round_on_side(before, behind, radius, left, taken);
  if (!is_cusp(before.leg, behind.leg)) return bad;
  const auto rounds = [&](const Taken& one) { return sweep_of(before, behind, one) * radius >= kNoDirection_mm; };
  if (bad == Condition::none && rounds(*taken)) return Condition::none;
  const Condition other = round_on_side(before, behind, radius, -left, taken);
  if (other == Condition::none && rounds(*taken)) return Condition::none;
  if (std::abs(sine) < kNoTurn) return Condition::corner_reversal;
  return bad != Condition::none ? bad : other != Condition::none ? other : Condition::corner_reversal;
}

}  // namespace

void end_arc_at(Move* arc, const AxisVec& end) {
  const Vec2 center{arc->circle.center[0], arc->circle.center[1]};
  const Vec2 old_radius = in_plane(arc->end, arc->plane_axis) - center, radius = in_plane(end, arc->plane_axis) - center;
  const double sense = arc->circle.sweep < 0 ? -1 : 1;
  double back = sense * turned(radius, old_radius);
  if (back < -kNoTurn) back += 2 * kPi;
  arc->circle.sweep -= sense * back;
  arc->circle.radius_end = norm(radius);
  arc->end = arc->work = end;
}

void begin_arc_at(Move* arc, const AxisVec& start) {
  const Vec2 center{arc->circle.center[0], arc->circle.center[1]};
  const Vec2 old_radius = in_plane(arc->start, arc->plane_axis) - center, radius = in_plane(start, arc->plane_axis) - center;
  const double sense = arc->circle.sweep < 0 ? -1 : 1;
  double on = sense * turned(old_radius, radius);
  if (on < -kNoTurn) on += 2 * kPi;
  arc->circle.sweep -= sense * on;
  arc->circle.angle_start += sense * on;
  arc->circle.radius_start = norm(radius);
  arc->start = start;
}

Condition cut_arc_corner(const Move& first, const Move& next, unsigned axis_count, CornerCut* cut) {
  *cut = {};
  Side before, behind;
  if (!side_of(first, first.plane_axis, true, &before)) return Condition::corner_short;
  if (next.circular && (next.plane_axis[0] != first.plane_axis[0] || next.plane_axis[1] != first.plane_axis[1])) return Condition::corner_arc;
  if (!side_of(next, first.plane_axis, false, &behind)) return Condition::corner_next_short;
  const bool round = first.corner == Corner::rounding;
  if (round && !is_cusp(before.leg, behind.leg) && std::abs(sine_of_turn(before.leg, behind.leg)) < kNoTurn) return Condition::none;
  Taken taken;
  taken.before = way_to_circle(before.leg, first.corner_mm);
  taken.behind = way_to_circle(behind.leg, first.corner_mm);
  const Condition bad = round ? round_between(before, behind, first.corner_mm, &taken) : fits(before, behind, taken);
  if (bad != Condition::none) return bad;
  const Vec2 from = point_along(before.leg, -taken.before), to = point_along(behind.leg, taken.behind);
  const double sweep = sweep_of(before, behind, taken);
  if (round && sweep * first.corner_mm < kNoDirection_mm) return Condition::none;
  const unsigned h = first.plane_axis[0], v = first.plane_axis[1];
  for (unsigned i = 0; i < axis_count; ++i) {
    cut->before[i] = first.end[i] - (first.end[i] - first.start[i]) * (taken.before / before.length);
    cut->lead[i] = (next.end[i] - next.start[i]) * (taken.behind / behind.length);
  }
  cut->before[h] = first.end[h] + from.h;
  cut->before[v] = first.end[v] + from.v;
  cut->lead[h] = to.h;
  cut->lead[v] = to.v;
  for (unsigned i = 0; i < axis_count; ++i) cut->behind[i] = first.end[i] + cut->lead[i];
  cut->any = true;
  if (!round) return Condition::none;
  cut->round = true;
  const Vec2 begin = from - taken.center;
  cut->circle.center[0] = first.end[h] + taken.center.h;
  cut->circle.center[1] = first.end[v] + taken.center.v;
  cut->circle.radius_start = cut->circle.radius_end = first.corner_mm;
  cut->circle.angle_start = std::atan2(begin.v, begin.h);
  cut->circle.sweep = taken.left * sweep;
  return Condition::none;
}

double corner_travel(const Move& line, const Move& first, uint32_t rotary, unsigned axis_count) {
  double squares = 0;
  for (unsigned i = 0; i < axis_count; ++i) {
    const bool counts = first.corner == Corner::chamfer ? (rotary >> i & 1) == 0 : i == first.plane_axis[0] || i == first.plane_axis[1];
    if (counts) squares += (line.end[i] - line.start[i]) * (line.end[i] - line.start[i]);
  }
  return std::sqrt(squares);
}

Condition cut_corner(const Move& first, const Move& next, uint32_t rotary, unsigned axis_count, CornerCut* cut) {
  *cut = {};
  const double amount = first.corner_mm;
  const double length = corner_travel(first, first, rotary, axis_count), length_next = corner_travel(next, first, rotary, axis_count);
  // M700 13.7.2 (5): a rounding is compared by its radius, whatever it takes of the lines.
  if (length < amount - kCornerSlack_mm) return Condition::corner_short;
  if (length_next < amount - kCornerSlack_mm) return Condition::corner_next_short;
  double taken = amount;
  if (first.corner == Corner::rounding) {
    const unsigned h = first.plane_axis[0], v = first.plane_axis[1];
    const double u1[2] = {(first.end[h] - first.start[h]) / length, (first.end[v] - first.start[v]) / length};
    const double u2[2] = {(next.end[h] - next.start[h]) / length_next, (next.end[v] - next.start[v]) / length_next};
    const double sine = u1[0] * u2[1] - u1[1] * u2[0], cosine = u1[0] * u2[0] + u1[1] * u2[1];
    if (1 + cosine < kWayBack) return Condition::corner_reversal;
    taken = amount * std::fabs(sine) / (1 + cosine);  // tan(turn / 2) = sin / (1 + cos)
    if (amount * std::atan2(std::fabs(sine), cosine) < kNoDirection_mm) return Condition::none;
    // Beyond a right angle it takes more than its radius: where there is not that much, there is no such arc.
    if (length < taken - kCornerSlack_mm) return Condition::corner_short;
    if (length_next < taken - kCornerSlack_mm) return Condition::corner_next_short;
    const double left = sine > 0 ? 1 : -1;
    Circle& circle = cut->circle;
    circle.radius_start = circle.radius_end = amount;
    circle.center[0] = first.end[h] - taken * u1[0] - left * amount * u1[1];
    circle.center[1] = first.end[v] - taken * u1[1] + left * amount * u1[0];
    circle.angle_start = std::atan2(-left * u1[0], left * u1[1]);
    circle.sweep = std::atan2(sine, cosine);
    cut->round = true;
  }
  cut->any = true;
  for (unsigned i = 0; i < axis_count; ++i) {
    cut->lead[i] = (next.end[i] - next.start[i]) * (taken / length_next);
    cut->before[i] = first.end[i] - (first.end[i] - first.start[i]) * (taken / length);
    cut->behind[i] = first.end[i] + cut->lead[i];
  }
  return Condition::none;
}

}  // namespace nc
