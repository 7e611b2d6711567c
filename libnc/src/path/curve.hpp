// SPDX-License-Identifier: Apache-2.0
// Curves: the path of one committed move as a function of its path length. Lines and circular arcs (with further axes that go along linearly: helices)
// are exact; nothing behind this header replaces an arc by chords. All other curves are shapes (path/shape.hpp).
#pragma once

#include <cmath>

#include "stream/stream.hpp"

namespace nc {

/// Position and its first three derivatives by the path length s. All are exact, also for arcs. Where the end radius of an arc differs from its start radius
/// the angle, the radius and the other axes change linearly with one parameter u, and u(s) is such that |d1| stays 1.
struct CurvePoint {
  AxisVec position, d1, d2, d3;
};

struct CurveShape;  // path/shape.hpp

/// A move in machine coordinates. s runs from 0 to `length`; |d1| over the axes that make the length is 1. These are all linear axes that move, or all rotary
/// axes when no linear axis moves (M700 7.6).
struct Curve {
  bool circular = false;
  uint8_t h = 0, v = 1;  ///< plane axes of the circle
  AxisVec start, delta;  ///< delta = end - start
  AxisVec end;           ///< position at s = length, exactly as the curve was made with
  Circle circle;         ///< in machine coordinates
  double length = 0;
  double linear2 = 0;  ///< circular: squared way of the linear axes outside the plane, mm^2
  /// Not nullptr: the curve is a shape, and |d1| is 1 over the programmed axes, not over those that move. The shape must outlive the curve.
  const CurveShape* shape = nullptr;
};

/// Makes a line. `axis_count` axes; bit i of `rotary` = axis i is rotary.
Curve make_line(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary);
/// Makes a line in *curve, without a copy and without a call, because one is made for every move.
inline void make_line(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, Curve* curve) {
  curve->circular = false;
  curve->shape = nullptr;
  AxisVec way;  // of all axes, because the compiler knows that count; those that the machine does not have are 0
  for (unsigned i = 0; i < kMaxAxes; ++i) way[i] = end[i] - start[i];
  curve->start = start;
  curve->end = end;
  curve->delta = way;
  double linear = 0, turned = 0;
  for (unsigned i = 0; i < axis_count; ++i) {
    const double square = way[i] * way[i];
    if ((rotary >> i & 1) != 0) [[unlikely]] turned += square;
    else linear += square;
  }
  curve->length = std::sqrt(linear > 0 ? linear : turned);
}

/// Makes an arc or helix. `circle` is in the same coordinates as start and end.
Curve make_arc(const AxisVec& start, const AxisVec& end, uint8_t h, uint8_t v, const Circle& circle,
               unsigned axis_count, uint32_t rotary);

/// Position at s, clamped to [0, length]; the end is exact.
AxisVec curve_position(const Curve& curve, double s, unsigned axis_count) NC_RT;

/// Position and derivatives at s.
CurvePoint curve_evaluate(const Curve& curve, double s, unsigned axis_count) NC_RT;

/// The share of the sweep of an arc that lies before s, 0 to 1.
double curve_arc_parameter(const Curve& curve, double s) NC_RT;

/// Smallest and largest coordinate of each axis over the whole curve (for stroke limits): exact for arcs.
void curve_bounds(const Curve& curve, unsigned axis_count, AxisVec* low, AxisVec* high);

}  // namespace nc
