// SPDX-License-Identifier: Apache-2.0
// Speed and acceleration limits of segments and joints. The derivation is in docs/motion.md, "Corners without
// smoothing".
#include "motion/limits.hpp"

#include "filter/filter_parameters.hpp"
#include "path/shape.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;

/// Radius compensation k by the angle: its share grows by 2/pi in a radian, and what it moves by turns with the angle. First and second
/// derivative are at most k times these.
constexpr double kRoundSpeed = 1 + 2 / (2 * kHalfPi), kRoundBend = 1 + 4 / (2 * kHalfPi);
/// Steps of its derivative, in 2 k / pi, that fall into one window where an arc takes at least a cycle.
constexpr double kRoundSteps = 4;

/// Of what is left for braking on a spiral, the part that its uneven parameter may take.
constexpr double kBendShare = 0.2;

/// Largest |sin| over the angles from `from` through `sweep`.
double largest_sine(double from, double sweep) {
  const double low = std::min(from, from + sweep), high = std::max(from, from + sweep);
  const double n = std::ceil((low - kHalfPi) / (2 * kHalfPi));
  if (kHalfPi + n * 2 * kHalfPi <= high) return 1.0;
  return std::max(std::fabs(std::sin(low)), std::fabs(std::sin(high)));
}

/// Tangents and curvature of an arc; `most` of the two plane axes is the worst case over its sweep.
void shape_arc(const Segment& s, const MotionLimits& limits, SegmentShape& g) {
  const Curve& c = s.curve;
  const Circle& k = c.circle;
  g.entry = curve_evaluate(c, 0, limits.axis_count).d1;
  g.exit = curve_evaluate(c, c.length, limits.axis_count).d1;
  const double dr = std::fabs(k.radius_end - k.radius_start), turn = std::fabs(k.sweep);
  const double r_min = std::min(k.radius_start, k.radius_end), r_max = std::max(k.radius_start, k.radius_end);
  // |dP/du| is smallest where the radius is, so the share of the other axes (constant by u) is largest there.
  const double slowest = std::sqrt(dr * dr + c.linear2 + turn * turn * r_min * r_min);
  const double fastest = std::sqrt(dr * dr + c.linear2 + turn * turn * r_max * r_max);
  for (unsigned i = 0; i < limits.axis_count; ++i)
    g.most[i] = slowest > 0 ? std::fabs(c.delta[i]) / slowest : 0;
  g.in_plane = fastest > 0 ? std::sqrt(dr * dr + turn * turn * r_max * r_max) / fastest : 0;
  const double radial = slowest > 0 ? dr / slowest : 0;
  g.most[c.h] = std::min(1.0, g.in_plane * largest_sine(k.angle_start, k.sweep) + radial);
  g.most[c.v] = std::min(1.0, g.in_plane * largest_sine(k.angle_start + kHalfPi, k.sweep) + radial);
  // In the plane the curvature of R(t) is (R^2 + 2 R'^2) / (R^2 + R'^2)^1.5, falling with R; along the helix
  // it acts with in_plane^2.
  const double slope = turn > 0 ? dr / turn : 0;
  const double q = r_min * r_min + slope * slope;
  const double plane_curvature = q > 0 ? (q + slope * slope) / (q * std::sqrt(q)) : 0;
  g.curvature = plane_curvature * g.in_plane * g.in_plane;
  // On a spiral the parameter itself speeds up and slows down along the path: u'' = sweep^2 R R' / sigma^4,
  // with R' = dr.
  if (slowest > 0) g.bend = turn * turn * r_max * dr / (slowest * slowest * slowest);
  if (s.rounds() && r_min > 0) {
    g.round = std::fmax(std::fabs(static_cast<double>(s.round_mm[0])), std::fabs(static_cast<double>(s.round_mm[1]))) / r_min;
    g.most[c.h] += kRoundSpeed * g.round * g.in_plane;
    g.most[c.v] += kRoundSpeed * g.round * g.in_plane;
  }
}

/// Near the pole radius and angle change over a stretch as short as the distance from it, which samples may miss. With |z'| <= 1 and
/// |z''| <= k at the distance d or more: |angle'| <= 1/d, |angle''| <= k/d + 1/d^2, |radius''| <= k + 1/d.
void bound_near_pole(const CurveShape& shape, SegmentShape& g, AxisVec& bend) {
  constexpr double kDegrees = 90 / kHalfPi;
  const AxisMap& map = shape.what.map;
  const PolarReach reach = polar_reach(shape);
  if (reach.radial || !(reach.distance > 0)) return;
  const double near = 1 / reach.distance;
  g.most[map.linear] = 1;
  bend[map.linear] = reach.curvature + near;
  g.most[map.rotary] = kDegrees * near;
  bend[map.rotary] = kDegrees * near * (reach.curvature + near);
}

/// Where a curve all but has a cusp, equal steps miss how much it bends: its table is divided there, and so are the places looked at.
void look_beside_cusp(const Curve& c, const MotionLimits& limits, SegmentShape& g, AxisVec& bend) {
  constexpr unsigned kInside = 4;
  const ParameterTable& t = c.shape->table;
  for (unsigned k = 0; k < ParameterTable::kSteps; ++k)
    for (unsigned n = 0; n < t.graded[k] * kInside; ++n) {
      const unsigned at = t.first[k] + n / kInside;
      const double behind = t.behind[at] + (t.behind[at + 1] - t.behind[at]) * (n % kInside) / kInside;
      const CurvePoint q = curve_evaluate(c, c.length * k / ParameterTable::kSteps + behind, limits.axis_count);
      for (unsigned i = 0; i < limits.axis_count; ++i) {
        g.most[i] = std::max(g.most[i], std::fabs(q.d1[i]));
        bend[i] = std::max(bend[i], std::fabs(q.d2[i]));
      }
    }
}

/// Any other curve: tangents at the ends, the largest |d1| of each axis, and as `bend` what its curvature takes from the path
/// acceleration at a speed of 1 mm/s. Between the samples d3 bounds how far d1 and d2 may go beyond them.
void shape_general(const Segment& s, const MotionLimits& limits, SegmentShape& g) {
  constexpr unsigned kPieces = 32;
  const Curve& c = s.curve;
  const double h = c.length / kPieces;
  AxisVec bend, twist;
  for (unsigned k = 0; k <= kPieces; ++k) {
    const CurvePoint q = curve_evaluate(c, k == kPieces ? c.length : h * k, limits.axis_count);
    if (k == 0) g.entry = q.d1;
    if (k == kPieces) g.exit = q.d1;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      g.most[i] = std::max(g.most[i], std::fabs(q.d1[i]));
      bend[i] = std::max(bend[i], std::fabs(q.d2[i]));
      twist[i] = std::max(twist[i], std::fabs(q.d3[i]));
    }
  }
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    g.most[i] += h * h / 8 * twist[i];
    bend[i] += h / 2 * twist[i];
  }
  if (c.shape->what.kind == ShapeKind::rational || c.shape->what.kind == ShapeKind::spline) look_beside_cusp(c, limits, g, bend);
  if (c.shape->what.map.kind == AxisMap::Kind::polar) bound_near_pole(*c.shape, g, bend);
  double along = HUGE_VAL, across = HUGE_VAL;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const double axis = limits.axis[i].acceleration;
    if (axis <= 0) continue;
    if (g.most[i] > 0) along = std::min(along, axis / g.most[i]);
    if (bend[i] > 0) across = std::min(across, axis / bend[i]);
  }
  if (across < HUGE_VAL && along < HUGE_VAL) g.bend = along / across;
}

/// Acceleration limit of the plane: the weaker of its two axes, less what radius compensation adds to everything.
double plane_acceleration(const Curve& c, const SegmentShape& g, const MotionLimits& limits) {
  const double h = limits.axis[c.h].acceleration, v = limits.axis[c.v].acceleration;
  const double ah = h > 0 ? h : kUnlimitedAcceleration, av = v > 0 ? v : kUnlimitedAcceleration;
  return std::min(ah, av) / (1 + kRoundBend * g.round);
}

/// No feed is ever higher, whatever the override is; `dry`: whatever the feed of dry run is, too.
double highest_feed(const Segment& s, bool dry, const MotionLimits& limits) {
  if (dry) return HUGE_VAL;
  const double feed = std::max({s.feed_mm_s, s.feed_end_mm_s, static_cast<double>(s.digit_most_mm_s)});
  if (s.rapid || s.feed_mm_rev > 0 || !(feed > 0)) return HUGE_VAL;
  return s.skip || s.fixed_override ? feed : feed * limits.max_feed_override;
}

/// Speed that keeps the per-axis velocity limits and the bound on segments per cycle.
double velocity_limit(const Segment& s, const SegmentShape& g, const MotionLimits& limits) {
  double v = kSegmentsPerCycle * s.curve.length / limits.cycle_s;
  if (s.accuracy.speed_clamp > 0.0f) v = std::min(v, static_cast<double>(s.accuracy.speed_clamp));  // M700 13.15, 13.18
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const AxisLimits& a = limits.axis[i];
    const double axis = s.rapid && a.rapid > 0 ? a.rapid : a.velocity;
    if (axis > 0 && g.most[i] * v > axis) v = axis / g.most[i];
    const double kept = filter_speed(s.filter, i, a.acceleration, limits.cycle_s);
    if (g.most[i] * v > kept) v = kept / g.most[i];
  }
  return v;
}

AxisVec every_axis(double share) {
  AxisVec each;
  for (double& v : each.v) v = share;
  return each;
}

/// What is left of each axis' acceleration on a segment beside `share`.
AxisVec rest_of(const AxisVec& share, const SegmentShape& g) {
  AxisVec keep;
  for (unsigned i = 0; i < kMaxAxes; ++i) keep[i] = 1 - std::max(share[i], g.round > 0 ? kRoundShare : 0.0);
  return keep;
}

double least(const AxisVec& of, const MotionLimits& limits) {
  double v = 1;
  for (unsigned i = 0; i < limits.axis_count; ++i) v = std::min(v, of[i]);
  return v;
}

/// Path acceleration at which `keep` of some axis' limit is reached, centripetal acceleration at speed v
/// included.
double path_acceleration(const Segment& s, const SegmentShape& g, const AxisVec& keep, double v,
                         const MotionLimits& limits) {
  const Curve& c = s.curve;
  double a = kUnlimitedAcceleration;
  if (s.filter.kind == FilterTimes::Kind::after) return a;
  const double all = c.shape != nullptr ? least(keep, limits) : 1;  // `bend` of such a curve is of all axes together
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const double axis = limits.axis[i].acceleration;
    if (axis <= 0 || (c.circular && (i == c.h || i == c.v))) continue;
    const double most = std::min(keep[i], all) * axis;
    if (g.most[i] * a > most) a = most / g.most[i];
  }
  if (c.circular && g.in_plane > 0) {
    const double whole = std::min(keep[c.h], keep[c.v]) * plane_acceleration(c, g, limits), centripetal = v * v * g.curvature;
    const double rest = std::sqrt(std::max(0.0, whole * whole - centripetal * centripetal));
    if (g.in_plane * a > rest) a = rest / g.in_plane;
  }
  a -= v * v * g.bend;
  const double slope = static_cast<double>(s.accuracy.acceleration);  // M700 13.15: one for all axes
  return slope > 0 ? std::min(a, slope) : a;
}

/// Speed at which centripetal acceleration takes kArcShare of `keep`, and what goes along unevenly
/// kBendShare.
double arc_speed(const Segment& s, const SegmentShape& g, const AxisVec& keep, const MotionLimits& limits) {
  if (s.filter.kind == FilterTimes::Kind::after) return HUGE_VAL;
  if (s.curve.shape != nullptr) {
    return g.bend > 0 ? std::sqrt(kArcShare * path_acceleration(s, g, keep, 0, limits) / g.bend) : HUGE_VAL;
  }
  if (!s.curve.circular || g.curvature <= 0) return HUGE_VAL;
  const double plane = plane_acceleration(s.curve, g, limits);
  double v2 = kArcShare * std::min(keep[s.curve.h], keep[s.curve.v]) * plane / g.curvature;
  if (g.bend > 0) v2 = std::min(v2, kBendShare * path_acceleration(s, g, keep, 0, limits) / g.bend);
  if (!(g.round > 0)) return std::sqrt(v2);
  // The derivative of radius compensation steps where its share begins, stops growing, begins to fall and ends.
  const double step = kRoundSteps * g.round / kHalfPi * g.in_plane;
  return std::min({std::sqrt(v2), s.curve.length / limits.cycle_s, kRoundShare * plane * limits.cycle_s / step});
}

}  // namespace

SegmentShape shape_of(const Segment& s, const MotionLimits& limits) {
  SegmentShape g;
  g.dry = limits.dry && s.dry;
  const Curve& c = s.curve;
  if (c.length > 0) {
    if (c.shape != nullptr) {
      shape_general(s, limits, g);
    } else if (c.circular) {
      shape_arc(s, limits, g);
    } else {
      const double per_mm = 1 / c.length;
      for (unsigned i = 0; i < limits.axis_count; ++i) {
        g.entry[i] = g.exit[i] = c.delta[i] * per_mm;
        g.most[i] = std::fabs(g.entry[i]);
      }
    }
  }
  const double v = std::min(velocity_limit(s, g, limits), arc_speed(s, g, rest_of({}, g), limits));
  g.reach = std::min(v, highest_feed(s, g.dry, limits));
  return g;
}

namespace {

/// Seconds of a segment from a corner to rest at its other end, on which `reserve` is kept for the corner.
double time_of(const Segment& s, const SegmentShape& g, const Joint& corner, const AxisVec& reserve, const MotionLimits& limits) {
  const AxisVec keep = rest_of(reserve, g);
  const double most = std::min({velocity_limit(s, g, limits), arc_speed(s, g, keep, limits), highest_feed(s, g.dry, limits)});
  const double a = path_acceleration(s, g, keep, most, limits), way = s.curve.length, from = std::min(std::sqrt(corner.speed2), most);
  // Up to the speed from which it can still come to rest, and down.
  const double top2 = std::min(most * most, std::max(from * from, a * way + 0.5 * from * from)), top = std::sqrt(top2);
  return (2 * top - from) / a + std::max(0.0, way - (top2 - 0.5 * from * from) / a) / top;
}

/// What is kept for a corner slows both of its neighbours all along: of some shares the one by which both, at rest at their other ends, take the
/// least time. A slower corner has to save a part of that, and a rest a larger one: cuts run on (M700 7.12). `corner(part)` is the corner with so much of
/// what it may take, `whole` as it is without that; which takes the share `takes` of it; only what is faster than `slowest` is looked at.
template <class Corner>
Joint quickest_joint(const Segment& a, const SegmentShape& sa, const Segment& b, const SegmentShape& sb, const MotionLimits& limits, double slowest,
                     const Joint& whole, double takes, Corner&& corner) {
  constexpr double kParts[] = {1, 0.6, 0.35, 0.2, 0.1};
  constexpr double kRest = 1.05, kSlower = 0.97;
  Joint best;
  double least = kRest * (time_of(a, sa, {}, {}, limits) + time_of(b, sb, {}, {}, limits));
  for (const double part : kParts) {
    const Joint joint = part < 1 ? corner(part * takes) : whole;
    if (joint.speed2 <= slowest * slowest) break;
    const double time = time_of(a, sa, joint, reserve_towards(joint, b, sb, limits), limits) + time_of(b, sb, joint, reserve_towards(joint, a, sa, limits), limits);
    if (!(time < (best.speed2 > 0 ? kSlower : 1) * least)) continue;
    least = time;
    best = joint;
  }
  return best;
}

/// A corner whose step of velocity lies within one cycle, passed as fast as `share` of every axis' acceleration lets it.
Joint corner_of_a_cycle(const SegmentShape& sa, const SegmentShape& sb, double shortest, double reach, double share, const MotionLimits& limits) {
  AxisVec change;  // of direction, in units of each axis' acceleration: s^2/mm
  double most = 0;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const double limit = limits.axis[i].acceleration;
    if (limit > 0) most = std::max(most, change[i] = std::fabs(sb.entry[i] - sa.exit[i]) / limit);
  }
  // v (v dt/L + 1) change = share dt, solved for v without cancellation.
  const double dt = limits.cycle_s, p = dt / shortest;
  double v = reach;
  if (v * (v * p + 1) * most > share * dt) {
    const double q = share * dt / most;
    v = std::min(reach, 2 * q / (1 + std::sqrt(1 + 4 * p * q)));
  }
  Joint joint;
  joint.speed2 = v * v;
  for (unsigned i = 0; i < limits.axis_count; ++i) joint.share[i] = std::min(share, v * (v * p + 1) * change[i] / dt);
  return joint;
}

/// Joint by the axes' limits, no faster than `accuracy`.
Joint joint_by_axes(const Segment& a, const SegmentShape& sa, const Segment& b, const SegmentShape& sb, double accuracy,
                    const MotionLimits& limits, const RecentTurns* turns) {
  constexpr double kNothing = 0.1;  // a share that is not weighed
  constexpr double kShort = 2;      // times the speed of the corner, below which a segment stays from rest to rest: nor is that
  const double reach = std::min({sa.reach, sb.reach, accuracy});
  // The filters round the corner: what they make of any step keeps the limits.
  if (a.filter.kind == FilterTimes::Kind::after) return {reach * reach, 0, {}};
  const double window = turns != nullptr ? rounding_window(b, limits) : 0;
  const double rounding = sa.round > 0 || sb.round > 0 ? kRoundShare : 0;
  const double shortest = std::min(a.curve.length, b.curve.length);
  const auto corner = [&](double part) {
    Joint joint;
    if (window > 0) {
      const RecentTurns::Corner c = turns->corner(reach, part, rounding, window, limits);
      joint = {c.speed * c.speed, c.turn, c.share};
    } else {
      joint = corner_of_a_cycle(sa, sb, shortest, reach, part * (kCornerShare - rounding), limits);
    }
    for (unsigned i = 0; rounding > 0 && i < limits.axis_count; ++i) joint.share[i] += rounding;
    return joint;
  };
  const Joint joint = corner(1);
  double share = 0;
  for (unsigned i = 0; i < limits.axis_count; ++i) share = std::max(share, joint.share[i]);
  if (share <= kNothing + rounding && joint.speed2 >= reach * reach) return joint;
  // A corner that is passed slower than one cycle of braking is not worth passing: rest, so that its point is
  // hit exactly.
  const double v = std::sqrt(joint.speed2);
  const double brake = std::min(path_acceleration(a, sa, every_axis(1), 0, limits), path_acceleration(b, sb, every_axis(1), 0, limits));
  if (v <= brake * limits.cycle_s) return {};
  if (kShort * kShort * v * v >= brake * std::max(a.curve.length, b.curve.length)) return joint;
  const double takes = std::min(1.0, (share - rounding) / ((window > 0 ? kRoundingShare : kCornerShare) - rounding));
  return quickest_joint(a, sa, b, sb, limits, brake * limits.cycle_s, joint, takes, corner);
}

bool is_arc(const Segment& s) { return s.curve.circular && s.curve.shape == nullptr; }

/// Speed that high-accuracy control leaves at the joint.
double accuracy_speed(const Segment& a, const SegmentShape& sa, const Segment& b, const SegmentShape& sb,
                      const MotionLimits& limits) {
  if (limits.accuracy_joint_speed == nullptr) return HUGE_VAL;
  double aa = 0, bb = 0, turn2 = 0;
  for (unsigned i = 0; i < limits.axis_count; ++i) aa += sa.exit[i] * sa.exit[i], bb += sb.entry[i] * sb.entry[i];
  if (!(aa > 0) || !(bb > 0)) return HUGE_VAL;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const double change = sb.entry[i] / std::sqrt(bb) - sa.exit[i] / std::sqrt(aa);
    turn2 += change * change;
  }
  AccuracyJoint joint;
  joint.turn = std::sqrt(turn2);
  joint.length_before_mm = a.curve.length;
  joint.length_behind_mm = b.curve.length;
  joint.both_lines = !a.curve.circular && !b.curve.circular;
  joint.arc_ends = is_arc(a) != is_arc(b);
  return limits.accuracy_joint_speed(a.accuracy, b.accuracy, joint);
}

}  // namespace

Joint joint_between(const Segment& a, const SegmentShape& sa, const Segment& b, const SegmentShape& sb,
                    const MotionLimits& limits, const RecentTurns* turns) {
  return joint_by_axes(a, sa, b, sb, b.accuracy.ask_of_joint() ? accuracy_speed(a, sa, b, sb, limits) : HUGE_VAL, limits, turns);
}

AxisVec reserve_towards(const Joint& joint, const Segment& neighbour, const SegmentShape& shape,
                        const MotionLimits& limits) {
  if (joint.speed2 <= 0) return {};
  // Behind a short neighbour lie other corners that fall into the same cycle, or into the same mean.
  const double window = rounding_window(neighbour, limits);
  if (window > 0) {
    // No faster than this on the way through it.
    const double mean = std::sqrt(joint.speed2) + path_acceleration(neighbour, shape, every_axis(1), 0, limits) * window / 2;
    const bool within = neighbour.curve.length < std::min(mean, shape.reach) * window;
    return within ? reserve_for_turns(joint.share, joint.turn, limits.axis_count) : joint.share;
  }
  return neighbour.curve.length < shape.reach * limits.cycle_s ? every_axis(kCornerShare) : joint.share;
}

double even_acceleration(const Segment& s, double entry, double exit, const MotionLimits& limits) {
  const double window = rounding_window(s, limits);
  if (!(window > 0) || !(entry > 0) || !(exit > 0)) return s.acceleration;
  if (s.curve.length >= (std::max(entry, exit) + s.acceleration * window / 2) * window) return s.acceleration;  // it never lies within the mean
  return std::min(s.acceleration, kUneven * std::min(entry, exit) / window);
}

void set_segment_limits(Segment& s, const SegmentShape& g, const AxisVec& share, const MotionLimits& limits) {
  const AxisVec keep = rest_of(share, g);
  s.speed_limit = std::min(velocity_limit(s, g, limits), arc_speed(s, g, keep, limits));
  const double most = highest_feed(s, g.dry, limits);
  s.acceleration = path_acceleration(s, g, keep, std::min(s.speed_limit, most), limits);
  const bool bends = s.curve.circular || s.curve.shape != nullptr;
  s.dry_limit = bends ? most : HUGE_VAL;  // only what bends needs a part of the acceleration for its speed
}

}  // namespace nc
