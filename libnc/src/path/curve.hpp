// SPDX-License-Identifier: Apache-2.0
// Curves: what one committed move looks like, by its path parameter. Lines and circular arcs (with any
// further axes going linearly along: helices) are exact; there are no chords anywhere behind this header. All other
// curves are shapes (path/shape.hpp).
#pragma once

#include "stream/stream.hpp"

namespace nc {

/// Position and its first three derivatives by the path parameter s (per mm of path). d2 and d3 are exact for
/// the arcs; where the end radius differs from the start radius the angle, the radius and the other axes all
/// go linearly with one parameter u, and u(s) is such that |d1| stays 1.
struct CurvePoint {
  AxisVec position, d1, d2, d3;
};

struct CurveShape;  // path/shape.hpp

/// A move in machine coordinates. s runs from 0 to `length`; |d1| over the axes that make the length is 1.
/// Which axes make the length: all linear axes that move, or all rotary ones when no linear axis moves
/// (M700 7.6).
struct Curve {
  bool circular = false;
  uint8_t h = 0, v = 1;  ///< plane axes of the circle
  AxisVec start, delta;  ///< delta = end - start
  AxisVec end;           ///< exact at s = length, bit for bit what the curve was made with
  Circle circle;         ///< in machine coordinates
  double length = 0;
  double linear2 = 0;  ///< circular: squared way of the linear axes outside the plane, mm^2
  /// Any other curve; then |d1| is 1 over the axes as they are programmed, not over those that move. It outlives the curve.
  const CurveShape* shape = nullptr;
};

/// Makes a line. `axis_count` axes; bit i of `rotary` = axis i is rotary.
Curve make_line(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary);
/// The same in place: one is made for every block.
void make_line(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, Curve* curve);

/// Makes an arc or helix. `circle` in the frame of start and end.
Curve make_arc(const AxisVec& start, const AxisVec& end, uint8_t h, uint8_t v, const Circle& circle,
               unsigned axis_count, uint32_t rotary);

/// Position at s, clamped to [0, length]; the end is exact.
AxisVec curve_position(const Curve& curve, double s, unsigned axis_count) NC_RT;

/// Position and derivatives at s.
CurvePoint curve_evaluate(const Curve& curve, double s, unsigned axis_count) NC_RT;

/// The share of its sweep that an arc has gone at s, 0 to 1.
double curve_arc_parameter(const Curve& curve, double s) NC_RT;

/// Smallest and largest coordinate of each axis over the whole curve (for stroke limits): exact for arcs.
void curve_bounds(const Curve& curve, unsigned axis_count, AxisVec* low, AxisVec* high);

}  // namespace nc
