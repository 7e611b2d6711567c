// SPDX-License-Identifier: Apache-2.0
// How a curve that is no arc is cut into pieces: at its cusps, and so that a feed suits all of a piece.
#include <algorithm>
#include <cmath>

#include "motion/optimal/path_builder.hpp"
#include "path/shape.hpp"

namespace nc::optimal {
namespace {

constexpr unsigned kHalvings = 24;     ///< how often a part of a curve is halved, at most
constexpr double kShortest = 2e-8;     ///< mm, and as a share of the curve's length where that is above 1 mm: a part no longer than this is not halved
constexpr double kUneven = 2;          ///< ratio of the highest and the lowest speed that the bends allow at the ends and in the middle of a part: above it the part is halved
constexpr double kFarTurn = 0.94;      ///< cosine of the angle by which the direction turns between the ends of a part: below it the part is halved
constexpr unsigned kParts = 32;        ///< pieces of a curve that is no arc, at most
constexpr double kSpread = 1.5;        ///< ratio of the highest and the lowest speed that such a piece allows: above it another piece begins
constexpr double kMostOverride = 2;    ///< that a feed is expected to have
// Instructions.
constexpr int64_t kPlaceCost = 1200;   ///< of a place of a curve that is no arc, where its bends are looked at
constexpr unsigned kPlacesOfPart = 14; ///< of a part of it

}  // namespace

/// What the bends alone let a curve be gone through with between two places.
double PathBuilder::own_speed(const Curve& curve, double from, double to) const {
  double speed = HUGE_VAL;
  for (unsigned n = 0; n <= 2; ++n) {
    const CurvePoint q = curve_evaluate(curve, from + 0.5 * n * (to - from), limits_.axis_count);
    for (unsigned i = 0; i < limits_.axis_count; ++i) {
      const double v = limits_.velocity[i], a = limits_.acceleration[i], j = limits_.jerk[i];
      if (v > 0 && speed * std::fabs(q.d1[i]) > v) speed = v / std::fabs(q.d1[i]);
      if (a > 0 && speed * speed * std::fabs(q.d2[i]) > a) speed = std::sqrt(a / std::fabs(q.d2[i]));
      if (j > 0 && speed * speed * speed * std::fabs(q.d3[i]) > j) speed = std::cbrt(j / std::fabs(q.d3[i]));
    }
  }
  return speed;
}

/// The bends allow very different speeds at the ends and in the middle of a part, or it turns so far that a place in between may be slower:
/// next to a cusp all of that happens within some um.
bool PathBuilder::uneven(const Curve& curve, double from, double to, double feed) const {
  double slowest = feed, fastest = 0;
  for (unsigned n = 0; n <= 2; ++n) {
    const double at = from + 0.5 * n * (to - from), speed = std::min(own_speed(curve, at, at), feed);
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  return fastest > kUneven * slowest || turns_far(curve, from, to);
}

bool PathBuilder::turns_far(const Curve& curve, double from, double to) const {
  double first2 = 0, last2 = 0, both = 0;
  const AxisVec a = curve_evaluate(curve, from, limits_.axis_count).d1, b = curve_evaluate(curve, to, limits_.axis_count).d1;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    first2 += a[i] * a[i];
    last2 += b[i] * b[i];
    both += a[i] * b[i];
  }
  return both < kFarTurn * std::sqrt(first2 * last2);
}

/// A part of a curve as a straight line, to rest.
void PathBuilder::push_straight(const Curve& curve, double from, double to, const Piece& like) {
  const AxisVec a = curve_position(curve, from, limits_.axis_count), b = curve_position(curve, to, limits_.axis_count);
  Piece p = like;
  p.curve = nullptr;
  p.length = to - from;
  p.rest_behind = true;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    p.c[0][i] = a[i];
    p.c[1][i] = (b[i] - a[i]) / p.length;
  }
  push_piece(p);
}

/// The part of a curve between two places has the lower feed of its ends where the feed goes from F to Q with the linear axis (M700 6.11).
double PathBuilder::feed_between(const Segment& s, double from, double to) const {
  const unsigned axis = s.curve.shape->what.exponential.linear;
  const auto at = [&](double place) {
    const double share = (curve_position(s.curve, place, limits_.axis_count)[axis] - s.curve.start[axis]) / s.curve.delta[axis];
    return s.feed_mm_s + (s.feed_end_mm_s - s.feed_mm_s) * std::clamp(share, 0.0, 1.0);
  };
  return std::min(at(from), at(to));
}

/// A part of a curve. An arc is the same everywhere; where another curve bends less or more, or has another feed, begins a piece of its
/// own, because the cells of a time law and what is expected of its speed go by pieces.
Task<bool> PathBuilder::push_curve(Work& work, const Piece& whole, const Segment& s) {
  const Curve& curve = *whole.curve;
  if (curve.shape == nullptr) {
    push_piece(whole);
    co_return true;
  }
  Piece p = whole;
  p.rest_behind = false;
  const double end = whole.curve_from + whole.length, step = curve.length / kParts;
  const bool fades = s.feed_end_mm_s > 0;
  const double feed = goes_by_spindle(whole.by) ? HUGE_VAL : kMostOverride * whole.feed;
  const auto push_to = [&](double to) {
    p.length = to - p.curve_from;
    if (fades) p.feed = feed_between(s, p.curve_from, to);
    push_piece(p);
    p.curve_from = to;
  };
  const double shortest = std::max(curve.length, 1.0) * kShortest;
  double low = 0, high = 0, at = whole.curve_from, part = at;
  double ends[kHalvings + 1];  // of the parts that are still to be looked at
  unsigned open = 0, pieces = 0;
  while (at + kNothing < end) {
    if (open == 0) {
      part = part + 1.5 * step < end ? part + step : end;
      ends[open++] = part;
    }
    co_await work.pause(kPlaceCost * kPlacesOfPart);
    const double to = ends[open - 1];
    const bool whole_part = to - at <= shortest || open > kHalvings || pieces >= kPiecesOfCurve;
    if (!whole_part && uneven(curve, at, to, feed)) {
      ends[open++] = 0.5 * (at + to);
      continue;
    }
    --open;
    if (to - at <= shortest && turns_far(curve, at, to)) {  // a cusp: the path turns round at rest
      p.rest_behind = true;
      if (at > p.curve_from) push_to(at);
      push_straight(curve, at, to, p);
      p.rest_behind = false;
      p.curve_from = at = to;
      pieces += 2;
      high = 0;
      continue;
    }
    const double speed = std::min(own_speed(curve, at, to), feed);
    if (at > p.curve_from && pieces < kPiecesOfCurve && (fades || std::max(high, speed) > kSpread * std::min(low, speed))) {
      push_to(at);
      ++pieces;
      high = 0;
    }
    low = high > 0 ? std::min(low, speed) : speed;
    high = std::max(high, speed);
    at = to;
  }
  if (!(end > p.curve_from + kNothing)) co_return true;  // it ends with such a turn, at rest
  p.rest_behind = whole.rest_behind;
  push_to(end);
  co_return true;
}

}  // namespace nc::optimal
