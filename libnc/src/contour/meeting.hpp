// SPDX-License-Identifier: Apache-2.0
// Where two blocks meet of which the first has no end (M700 13.9): lines given by their angle, circles given by their centre or their radius.
// Everything lies in the plane (h, v), angles count from h, counter-clockwise.
#pragma once

#include "alarm/condition.hpp"
#include "stream/stream.hpp"

namespace nc {

struct PlanePoint {
  double h = 0, v = 0;
};

/// A line as far as it is known: a point that it goes through and its slope. The slope has no sense: A and A + 180 are one line (13.8 (5)).
struct SlopedLine {
  PlanePoint through;
  double angle_deg = 0;
};

/// A circle as far as it is known: a point on it (the start of the first block, the end of the second), and its centre or its radius.
struct KnownCircle {
  PlanePoint on;
  bool ccw = false;
  bool by_radius = false;
  double radius = 0;   ///< by_radius: negative takes the longer way round (6.5)
  PlanePoint center;   ///< else
};

/// What is found: where the blocks meet, and the centre of the circle that was given by its radius.
struct Meeting {
  Condition bad = Condition::none;  ///< geometric_parallel, geometric_contact
  PlanePoint at;
  PlanePoint center;
};

/// sine and cosine of an angle in degrees; whole quarters of a turn are exact.
void direction_of(double angle_deg, double* cosine, double* sine);

/// (a) Line and line. Slopes within one degree of each other have no corner (P392).
Meeting meet_lines(const SlopedLine& first, const SlopedLine& second);

/// (c), (d) Line and circle about a centre: the two points in which they cross, of which `longer` takes the one that leaves the line longer.
/// A line that touches has one.
Meeting meet_line_and_circle(const SlopedLine& line, const KnownCircle& circle, bool longer);

/// (e) Line, then an arc of a radius that touches it; (f) the same the other way round (`arc_first`). Of the circles through the point that
/// touch the line on the side to which the arc turns there is the one whose arc keeps to the sign of the radius, and of two such the one
/// with the shorter arc.
Meeting touch_line_and_circle(const SlopedLine& line, const KnownCircle& circle, bool arc_first);

/// (b) Arc and arc that touch: both by their centres, or one of them by its radius. Opposite senses touch from outside, equal ones from inside.
Meeting touch_circles(const KnownCircle& first, const KnownCircle& second, double tolerance);
/// By how much two circles with their centres miss each other.
double gap_of_circles(const KnownCircle& first, const KnownCircle& second);

/// The arc about a centre from one point on its circle to another, less than a whole turn.
Circle part_of_circle(PlanePoint start, PlanePoint end, PlanePoint center, bool ccw);
/// Centre of the arc of this radius between two points; a negative one takes the longer way round (6.5).
PlanePoint center_of_radius(PlanePoint start, PlanePoint end, double radius, bool ccw);

}  // namespace nc
