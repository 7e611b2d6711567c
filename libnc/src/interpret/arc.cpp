// SPDX-License-Identifier: Apache-2.0
// Circles from the words of a block (M700 6.4-6.6, DGSHAPE G02/G03).
#include <cmath>
#include <initializer_list>

#include "base/units.hpp"
#include "interpret/motion.hpp"

namespace nc {
namespace {

constexpr double kSamePoint = 1e-9;   // mm: points that are no farther apart are the same; far below every command unit

/// Centre of an arc of radius |radius| through start and end: on the perpendicular bisector of the chord, at distance
/// sqrt(r^2 - (L/2)^2) from its middle; radius > 0 takes the shorter arc, radius < 0 the longer one (M700 6.5).
Condition center_from_radius(const double start[2], const double end[2], double radius, bool ccw, bool may_be_short, double tolerance, double center[2]) {
  const double dh = end[0] - start[0], dv = end[1] - start[1];
  const double half = std::hypot(dh, dv) / 2;
  const double r = std::fabs(radius);
  if (half - r > tolerance && !may_be_short) return Condition::arc_center;  // M700 6.5: L/2 - r > #1084 is P71
  const double height = std::sqrt(std::fmax(0.0, r * r - half * half));
  // Left of the chord for a short ccw arc; the side changes with the direction and with the sign of R.
  const double side = (ccw == (radius >= 0)) ? 1.0 : -1.0;
  center[0] = (start[0] + end[0]) / 2 - side * height * dv / (2 * half);
  center[1] = (start[1] + end[1]) / 2 + side * height * dh / (2 * half);
  return Condition::none;
}

/// The arc from `start` to `end` about `center` leaves the quadrant that it begins in, by more than the tolerance.
bool leaves_quadrant(const double start[2], const double end[2], const double center[2], bool ccw, double tolerance) {
  const double from[2] = {start[0] - center[0], start[1] - center[1]}, to[2] = {end[0] - center[0], end[1] - center[1]};
  for (unsigned i = 0; i < 2; ++i)
    if (from[i] * to[i] < 0 && std::fmin(std::fabs(from[i]), std::fabs(to[i])) > tolerance) return true;
  const double turn = from[0] * to[1] - from[1] * to[0];  // |.| is the sine of the sweep, times the squared radius
  return (ccw ? turn : -turn) <= 0;
}

}  // namespace

bool center_of_quadrant(const double start[2], const double end[2], bool ccw, double tolerance, double center[2]) {
  for (const double h : {1.0, -1.0})
    for (const double v : {1.0, -1.0}) {
      const double at[2] = {start[0] + h * center[0], start[1] + v * center[1]};
      const double apart = std::fabs(std::hypot(end[0] - at[0], end[1] - at[1]) - std::hypot(center[0], center[1]));
      if (apart > tolerance + 1e-9 || leaves_quadrant(start, end, at, ccw, tolerance)) continue;
      center[0] *= h;
      center[1] *= v;
      return true;
    }
  return false;
}

Condition make_circle(const double start[2], const double end[2], const ArcWords& words, bool ccw, double tolerance, Circle* circle,
                      bool* straight) {
  *straight = false;
  const bool closed = std::fabs(end[0] - start[0]) < kSamePoint && std::fabs(end[1] - start[1]) < kSamePoint;
  Circle c;
  if (words.has_radius) {
    if (closed || (words.radius == 0 && !words.may_be_short)) {  // M700 6.5: with R an arc to its start is a circle that is finished already
      *straight = closed;
      return closed ? Condition::none : Condition::arc_center;
    }
    const Condition bad = center_from_radius(start, end, words.radius, ccw, words.may_be_short, tolerance, c.center);
    if (bad != Condition::none) return bad;
  } else {
    c.center[0] = start[0] + words.center[0];
    c.center[1] = start[1] + words.center[1];
  }
  c.radius_start = std::hypot(start[0] - c.center[0], start[1] - c.center[1]);
  c.radius_end = std::hypot(end[0] - c.center[0], end[1] - c.center[1]);
  // M700 6.4: a difference greater than the tolerance is P70; the 1e-9 allows for rounding, so that 5.0 - 4.9 is not more than 0.1.
  *circle = c;
  if (std::fabs(c.radius_end - c.radius_start) > tolerance + 1e-9) return Condition::arc_deviation;
  // Within the tolerance it is a spiral "in the direction of the commanded end point". A spiral that begins or ends in its centre has no angle there, so
  // only the straight line to the end remains.
  *straight = c.radius_start < kNoRadius_mm || c.radius_end < kNoRadius_mm;
  if (*straight) return Condition::none;
  c.angle_start = std::atan2(start[1] - c.center[1], start[0] - c.center[0]);
  double sweep = 0;
  if (!closed) {
    sweep = std::atan2(end[1] - c.center[1], end[0] - c.center[0]) - c.angle_start;
    // An end on the same ray from the centre as the start is a whole turn away, on whichever side of that ray rounding puts it.
    const double none = kSamePoint / std::fmax(c.radius_start, c.radius_end);
    if (ccw && sweep <= none) sweep += 2 * kPi;
    if (!ccw && sweep >= -none) sweep -= 2 * kPi;
  } else {
    sweep = ccw ? 2 * kPi : -2 * kPi;  // M700 6.4: end equal to the start is a full circle
  }
  // M700 6.6: the sweep is 2 pi P + theta with 0 <= theta < 2 pi, so P2 with the end at the start makes two turns, as 6.16 draws it.
  const unsigned more = (closed || words.turns_count_last) && words.turns != 0 ? words.turns - 1 : words.turns;
  c.sweep = sweep + (ccw ? 2 : -2) * kPi * more;
  *circle = c;
  return Condition::none;
}

}  // namespace nc
