// SPDX-License-Identifier: Apache-2.0
// The geometry of a joint; the derivation stands in the header.
#include "offset/corner.hpp"

#include <algorithm>
#include <cmath>

#include "base/same_place.hpp"

namespace nc {
namespace {

constexpr double kSmallTurn = 1e-6;   // rad: below it two tangents count as one direction
constexpr double kCusp = 0.1;         // sine below which a turn back may be a cusp, depending on the curvatures
// Where the tangents of a cusp tell another side than its curvatures do, the blocks overlap behind it until they cross, sin^2 / 2 (k + k') at most. What the last of three
// digits makes, of the ends of lines that are long enough for the tool and of centres, is less than 20 nm. Round the point of a larger overlap the tool would go, too, and
// then through both blocks; below what is no direction of a line it is no place that a tool could go round.
constexpr double kOverlap_mm = kNoDirection_mm;
constexpr double kOneNumber = 1e-9;    // numbers that differ by less of their size are one
constexpr double kRightAngle = 1e-6;  // 90 degrees belongs to the obtuse corners (M700 12.4.1)

Vec2 in_plane(const AxisVec& p, const uint8_t axis[2]) {
  return {p[axis[0]], p[axis[1]]};
}

// Perpendicular, lengthened, lengthened, perpendicular. The form of the manual's figure is lost: each offset
// line is lengthened by the amount and the ends are linked, as is usual. Up to a right angle the two meet before that, and their meeting is one vector in place of
// the two: behind it each would lead through what the other one is beside.
ContourJoint lengthened_joint(const Leg& before, const Leg& behind, double offset) {
  ContourJoint joint;
  joint.lengthened = true;
  joint.v[0] = perpendicular(before, offset);
  const double d = dot(before.u, behind.u);
  if (d > -kRightAngle) {
    joint.n = 3;
    joint.v[1] = (1 / (1 + d)) * (joint.v[0] + perpendicular(behind, offset));
  } else {
    joint.n = 4;
    joint.v[1] = joint.v[0] + std::abs(offset) * before.u;
    joint.v[2] = perpendicular(behind, offset) - std::abs(offset) * behind.u;
  }
  joint.v[joint.n - 1] = perpendicular(behind, offset);
  return joint;
}

// Up to a right angle the tool comes to the contour (type B) straight in a point on the lengthened start block, and leaves it in one on the lengthened cancel: of these
// blocks the perpendicular is none that it has to go by.
ContourJoint joint_beside_way(const Leg& before, const Leg& behind, double offset, bool starts) {
  ContourJoint joint = lengthened_joint(before, behind, offset);
  if (joint.n == ContourJoint::kMax) return joint;
  --joint.n;
  for (unsigned k = 0; starts && k < joint.n; ++k) joint.v[k] = joint.v[k + 1];
  return joint;
}

ContourJoint two_perpendiculars(const Leg& before, double offset_before, const Leg& behind, double offset_behind) {
  ContourJoint joint;
  joint.v[0] = perpendicular(before, offset_before);
  joint.v[1] = perpendicular(behind, offset_behind);
  joint.n = norm(joint.v[1] - joint.v[0]) > kOneLength_mm ? 2 : 1;
  return joint;
}

constexpr double kSineOfHalfADegree = 0.0087265354983739;

// How much of a block there is for a change of side to cut off: the length of a line, the radius of an arc.
double reach(const Leg& leg, Vec2 delta) { return leg.curvature == 0 ? norm(delta) : std::abs(1 / leg.curvature); }

// M700 12.4.2 "Changing the compensation direction": the intersection of the two offset curves; where there
// is none, both perpendiculars. An intersection that lies far off, or cuts more off a block than there is,
// counts as none. Two lines that go on nearly straight meet |offset| / sin(angle / 2) away; arcs with such tangents count as these lines do. Their curves
// may meet nearer, but only ahead, where the tool would come to through the wall, and where is a matter of rounding.
ContourJoint joint_of_side_change(const Leg& before, double offset_before, Vec2 delta_before, const Leg& behind, double offset_behind, Vec2 delta_behind) {
  Vec2 w;
  const double square_of_sin = (1 - dot(before.u, behind.u)) / 2;  // of half the angle
  const bool meets = square_of_sin * kExtremelyLarge * kExtremelyLarge >= 1 - kOneNumber && offset_exists(before, offset_before) && offset_exists(behind, offset_behind) &&
                     intersection(before, offset_before, behind, offset_behind, &w) &&
                     norm(w) <= kExtremelyLarge * std::abs(offset_before) + kOneLength_mm &&
                     -dot(w, before.u) <= reach(before, delta_before) + kOneLength_mm && dot(w, behind.u) <= reach(behind, delta_behind) + kOneLength_mm;
  return meets ? ContourJoint::single(w) : two_perpendiculars(before, offset_before, behind, offset_behind);
}

// How far a point is from the offset curve beside this leg; it is a vector.
double distance_from_curve(const Leg& leg, double offset, Vec2 point) {
  if (leg.curvature == 0) return std::abs(offset - dot(point, left_of(leg.u)));
  return std::abs(std::abs(1 / leg.curvature - offset) - norm(point - (1 / leg.curvature) * left_of(leg.u)));
}

// Curves that pass each other by less than what is no direction of a line touch: the last digit of the words decides whether they meet. Of the point between them `beyond` is what the
// square of its distance from the centre of a circle has more than that of a point on it. What is left of an arc that is hardly larger than the tool is no such circle but a place,
// which a line of micrometres may pass as its digits lead it (meets_in_a_point()).
constexpr double kSmallCircle_mm = 0.01;
bool touches(const Leg& leg, double offset, double beyond) {
  if (leg.curvature == 0) return true;
  const double radius = std::abs(1 / leg.curvature - offset);
  return radius >= kSmallCircle_mm - kOneLength_mm && beyond <= kNoDirection_mm * (2 * radius + kNoDirection_mm);
}

// Curves that touch as far as the words tell: of the two numbers whose difference the discriminant is all digits but some last binary ones are the same. These would decide whether
// and where the curves meet; `whole` is one of the two.
double without_noise(double discriminant, double whole) { return std::abs(discriminant) <= kOneNumber * whole ? 0 : discriminant; }

bool turns_back(double sine, double cosine) { return cosine < 0 && std::abs(sine) < kCusp; }

// Where the offset curves of a cusp meet. With the way a along the block before and q = |w|^2 - o^2 the two equations of a point are
//
//     w.n = o + k q/2,   a c = d (w.n) - o - k' q/2
//
// so q is linear in a, q = q0 + g a, and a^2 = q + o^2 - (w.n)^2 is a quadratic that stays exact where c becomes nothing. The curves lie behind the corner,
// so it is the negative a. False: they do not bend towards each other.
bool meet_behind_cusp(const Leg& before, const Leg& behind, double offset, Vec2* w) {
  const double c = cross(before.u, behind.u), d = dot(before.u, behind.u), o = offset, k = before.curvature;
  const double bend = d * k - behind.curvature;
  if (bend * o <= 0) return false;
  const double q0 = 2 * o * (1 - d) / bend, g = 2 * c / bend;
  const double a2 = 1 + 0.25 * k * k * g * g, a1 = g * (0.5 * k * k * q0 - (1 - o * k)), a0 = 0.25 * k * k * q0 * q0 - q0 * (1 - o * k);
  const double discriminant = without_noise(a1 * a1 - 4 * a2 * a0, a1 * a1 + a2 * std::abs(q0 * (1 - o * k))), beyond = -discriminant / (4 * a2);
  if (!(discriminant >= 0) && !(touches(before, o, beyond) && touches(behind, o, beyond))) return false;
  const double a = (-a1 - std::sqrt(std::max(discriminant, 0.0))) / (2 * a2);
  *w = a * before.u + (o + 0.5 * k * (q0 + g * a)) * left_of(before.u);
  return a < kOneLength_mm && std::isfinite(w->h) && std::isfinite(w->v);
}

// Of an arc whose radius is the amount there is no more than a point, its centre, and rounding decides whether that lies on the other curve. It does as far as the
// words can tell. The vector leads to the centre, from which the tool touches all of the arc.
bool meets_in_a_point(const Leg& arc, const Leg& other, double offset, double unsure, Vec2* w) {
  if (!is_point(arc, offset, unsure)) return false;
  *w = (1 / arc.curvature) * left_of(arc.u);
  return distance_from_curve(other, offset, *w) < unsure;
}

// Two blocks with lines between them that have no direction, in which the amount changes: the first half of the corner that the amount in front of them makes, the
// second half of the one of the amount behind them.
bool joint_of_amount_change(const Leg& before, double offset_before, Vec2 delta_before, const Leg& behind, double offset_behind, Vec2 delta_behind, double unsure, ContourJoint* joint) {
  ContourJoint first, last;
  if (!joint_in_mode(before, offset_before, delta_before, behind, offset_before, delta_behind, unsure, &first)) return false;
  if (!joint_in_mode(before, offset_behind, delta_before, behind, offset_behind, delta_behind, unsure, &last)) return false;
  const unsigned of_first = (first.n + 1) / 2;
  joint->set({});
  joint->n = 0;
  for (unsigned k = 0; k < of_first; ++k) joint->v[joint->n++] = first.v[k];
  for (unsigned k = last.n / 2; k < last.n; ++k) joint->v[joint->n++] = last.v[k];
  joint->lengthened = first.lengthened && last.lengthened;
  return true;
}

}  // namespace

bool goes_round(const Move& move) {
  const Vec2 center{move.circle.center[0], move.circle.center[1]};
  const auto away = [&](const AxisVec& at) {
    const Vec2 radius = in_plane(at, move.plane_axis) - center;
    return longer_than(radius, kNoRadius_mm) || norm(radius) == kNoRadius_mm;
  };
  return move.circle.sweep != 0 && away(move.start) && away(move.end);
}

bool make_legs(const Move& move, Leg* begin, Leg* end) {
  const uint8_t* axis = move.comp.axis;
  const Vec2 start = in_plane(move.start, axis), finish = in_plane(move.end, axis);
  if (move.circular && (move.plane_axis[0] != axis[0] || move.plane_axis[1] != axis[1])) return false;
  if (move.circular && goes_round(move)) {
    const Vec2 center{move.circle.center[0], move.circle.center[1]};
    const double turning = move.circle.sweep < 0 ? -1 : 1;
    const double r0 = norm(start - center), r1 = norm(finish - center);
    *begin = {(turning / r0) * left_of(start - center), turning / r0};
    *end = {(turning / r1) * left_of(finish - center), turning / r1};
    return true;
  }
  const Vec2 programmed = finish - start + Vec2{move.comp.by_hand[0], move.comp.by_hand[1]};
  const bool led_there = stands_beside(move.comp) && longer_than(programmed, kNoLength);  // by hand
  if (!longer_than(finish - start, kNoLength) && !led_there) return false;
  const double length = norm(programmed);
  *begin = *end = {length > kNoLength ? (1 / length) * programmed : unit(finish - start), 0};
  return true;
}

bool is_cusp(const Leg& before, const Leg& behind) { return turns_back(cross(before.u, behind.u), dot(before.u, behind.u)); }

double sine_of_turn(const Leg& before, const Leg& behind) {
  const double c = cross(before.u, behind.u), bend = before.curvature + behind.curvature;
  const double least = 2 * kOverlap_mm * std::abs(bend);
  return is_cusp(before, behind) && c * c < least ? -std::copysign(std::sqrt(least), bend) : c;
}

Turn classify(const Leg& before, const Leg& behind, double offset) {
  const double c = sine_of_turn(before, behind), d = dot(before.u, behind.u);
  if (std::abs(c) < kSmallTurn) return d > 0 ? Turn::straight : Turn::acute;  // straight back: round the end
  if ((c > 0) == (offset > 0)) return Turn::inner;  // the path turns towards the tool
  return d > -kRightAngle ? Turn::obtuse : Turn::acute;
}

bool turns_to_tool(Vec2 before, Vec2 behind, double offset) {
  const double c = cross(before, behind);
  return std::abs(c) >= kSmallTurn * offset * offset && (c > 0) == (offset > 0);
}

bool intersection(const Leg& before, double offset_before, const Leg& behind, double offset_behind, Vec2* w) {
  const double c = cross(before.u, behind.u), d = dot(before.u, behind.u);
  const double oa = offset_before, ob = offset_behind, ka = before.curvature, kb = behind.curvature;
  if (oa == ob && turns_back(c, d) && meet_behind_cusp(before, behind, oa, w)) return true;
  if (std::abs(c) < kSmallTurn) {
    if (d < 0 || oa != ob) return false;
    *w = oa * (left_of(before.u) -
               (c / (1 + d)) * before.u);  // the lines' formula; the error is of the order of c squared
    return true;
  }
  // With p = q - oa^2: w = w0 + p w1 solves both linear equations, |w|^2 = p + oa^2 gives p.
  Vec2 w0;
  if (oa == ob) {
    const double half_turn = d > 0 ? c / (1 + d) : (1 - d) / c;  // tan(turn / 2), without cancellation
    w0 = oa * (left_of(before.u) - half_turn * before.u);
  } else {
    w0 = (1 / c) * (oa * behind.u - (ob + kb / 2 * (oa * oa - ob * ob)) * before.u);
  }
  if (ka == 0 && kb == 0) {
    *w = w0;
    return std::isfinite(w->h) && std::isfinite(w->v);
  }
  const Vec2 w1 = (0.5 / c) * (ka * behind.u - kb * before.u);
  const double a2 = dot(w1, w1), a1 = 2 * dot(w0, w1) - 1, a0 = dot(w0, w0) - oa * oa;
  const double discriminant = without_noise(a1 * a1 - 4 * a2 * a0, a1 * a1);
  if (discriminant <= 0) {
    const double beyond = -discriminant / (4 * a2);
    if (beyond > 0 && !(touches(before, oa, beyond) && touches(behind, ob, beyond))) return false;
    *w = w0 - a1 / (2 * a2) * w1;
    return std::isfinite(w->h) && std::isfinite(w->v);
  }
  const double root = std::sqrt(discriminant);
  const double p = a1 < 0 ? 2 * a0 / (root - a1) : (-a1 - root) / (2 * a2);
  *w = w0 + p * w1;
  return std::isfinite(w->h) && std::isfinite(w->v);
}

bool joint_in_mode(const Leg& before, double offset_before, Vec2 delta_before, const Leg& behind, double offset_behind, Vec2 delta_behind, double unsure, ContourJoint* joint) {
  if (offset_before == 0) {
    joint->set({});
    return true;
  }
  if (offset_before * offset_behind < 0) {
    *joint = joint_of_side_change(before, offset_before, delta_before, behind, offset_behind, delta_behind);
    return true;
  }
  if (offset_before != offset_behind) return joint_of_amount_change(before, offset_before, delta_before, behind, offset_behind, delta_behind, unsure, joint);
  // The vectors at the end of a block have the amount of that block (M700 12.4.5 (2)).
  const double o = offset_before;
  const Turn turn = classify(before, behind, o);
  Vec2 w;
  const bool curves = offset_exists(before, o) && offset_exists(behind, o);
  if (turn != Turn::acute && curves && intersection(before, o, behind, o, &w)) {
    joint->set(w);
    return true;
  }
  if (meets_in_a_point(before, behind, o, unsure, &w) || meets_in_a_point(behind, before, o, unsure, &w)) {
    joint->set(w);
    return true;
  }
  if (turn == Turn::inner) return false;
  *joint = lengthened_joint(before, behind, o);
  return true;
}

bool is_of_spike(const ContourJoint& joint, double offset) { return joint.n == 1 && norm(joint.v[0]) * kSineOfHalfADegree >= std::abs(offset); }

ContourJoint joint_of_spike(const Leg& before, const Leg& behind, double offset) { return two_perpendiculars(before, offset, behind, offset); }

ContourJoint joint_at_start(const Leg& before, const Leg& behind, double offset, bool type_b) {
  const Turn turn = classify(before, behind, offset);
  Vec2 w;
  if (!type_b || turn == Turn::inner || turn == Turn::straight)
    return ContourJoint::single(perpendicular(behind, offset));
  if (turn == Turn::obtuse && intersection(before, offset, behind, offset, &w)) return ContourJoint::single(w);
  return joint_beside_way(before, behind, offset, true);
}

ContourJoint joint_at_cancel(const Leg& before, const Leg& behind, double offset, bool type_b) {
  const Turn turn = classify(before, behind, offset);
  Vec2 w;
  if (!type_b || turn == Turn::inner || turn == Turn::straight)
    return ContourJoint::single(perpendicular(before, offset));
  if (turn == Turn::obtuse && intersection(before, offset, behind, offset, &w)) return ContourJoint::single(w);
  return joint_beside_way(before, behind, offset, false);
}

ContourJoint joint_at_cancel_vector(const Leg& before, Vec2 direction, double offset) {
  const Leg hypothetical{unit(direction), 0};
  Vec2 w;
  if (norm(direction) > 0 && intersection(before, offset, hypothetical, offset, &w) &&
      norm(w) <= kExtremelyLarge * std::abs(offset) + kOneLength_mm) {
    return ContourJoint::single(w);
  }
  return ContourJoint::single(perpendicular(before, offset));
}

bool is_outer(const Leg& before, const Leg& behind, double offset) {
  const Turn turn = classify(before, behind, offset);
  return turn == Turn::obtuse || turn == Turn::acute;
}

ContourJoint joint_corner_arc(const Leg& before, const Leg& behind, double offset) {
  ContourJoint joint = two_perpendiculars(before, offset, behind, offset);
  joint.corner_arc = joint.n == 2;
  return joint;
}

bool joint_of_outer_corner(const Leg& before, const Leg& behind, double offset, double arc_cos, ContourJoint* joint) {
  if (offset == 0 || !is_outer(before, behind, offset)) return false;
  Vec2 w;
  const bool sharp = dot(before.u, behind.u) < arc_cos;
  const bool meets = !sharp && offset_exists(before, offset) && offset_exists(behind, offset) && intersection(before, offset, behind, offset, &w);
  *joint = meets ? ContourJoint::single(w) : joint_corner_arc(before, behind, offset);
  return true;
}

Vec2 commanded_vector(const Compensation& comp) {
  const Vec2 direction = unit({comp.vector[0], comp.vector[1]});
  if (comp.hold_vector) return comp.radius * direction;  // M700 12.4.2, G38 I J: along the words
  return signed_offset(comp) * left_of(direction);       // M700 12.4.3, G41/G42 I J: at right angles
}

}  // namespace nc
