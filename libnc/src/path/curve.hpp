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
/// Makes a line in *curve, without a copy and without a call, because one is made for every move. There are no more than kAxes axes.
template <unsigned kAxes = kMaxAxes>
inline void make_line(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, Curve* curve) {
  curve->circular = false;
  curve->shape = nullptr;
  for (unsigned i = 0; i < kAxes; ++i) curve->delta[i] = end[i] - start[i];
  for (unsigned i = 0; i < kAxes; ++i) curve->start[i] = start[i];
  for (unsigned i = 0; i < kAxes; ++i) curve->end[i] = end[i];
  double linear = 0, turned = 0;
  if (rotary == 0) [[likely]] {
    for (unsigned i = 0; i < kAxes; ++i) linear += (end[i] - start[i]) * (end[i] - start[i]);
  } else {
    for (unsigned i = 0; i < axis_count; ++i) ((rotary >> i & 1) != 0 ? turned : linear) += curve->delta[i] * curve->delta[i];
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
