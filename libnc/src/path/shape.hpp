// SPDX-License-Identifier: Apache-2.0
// Shapes: the curves that are neither lines nor circular arcs of the axes themselves, and the maps between a programmed plane and the axes that move. A move
// has a MoveShape (what the program says). Commit makes a CurveShape of it, which holds all that evaluation needs and lies in one of a fixed number of
// places; a Curve points to it.
//
// Every point is exact, from a closed form of the curve. Where the path length has no closed form, a table of the parameter at equal steps of length gives the
// parameter for a length; so an error of the table moves a point along the curve but never off it.
#pragma once

#include "frame/affine.hpp"
#include "path/curve.hpp"

namespace nc {

/// The map from programmed coordinates to those of the axes, which comes before the affine map to the machine.
struct AxisMap {
  enum class Kind : uint8_t {
    none,
    cylinder,  ///< M700 6.9: the programmed coordinate of axis `rotary` is in mm on the developed surface, `scale` mm per degree
    polar      ///< M700 6.10: the programmed coordinates of `linear` and `rotary` are x and y of a plane; the axes go to radius and angle
  };
  Kind kind = Kind::none;
  uint8_t linear = 0, rotary = 0;
  int8_t side = 1;      ///< polar: -1 = the linear axis is on the minus side of the pole
  uint8_t frozen = 0;   ///< bit i: axis i is a part of the path but does not move (M700 6.16)
  double scale = 1;
  double angle = 0;     ///< polar: machine position of the rotary axis at the angle 0

  bool active() const { return kind != Kind::none || frozen != 0; }
};

/// Part of a circle anywhere in space: center + radius (e1 cos t + e2 sin t), t from 0 to sweep.
struct SpaceArc {
  double center[3], e1[3], e2[3];
  double radius, sweep;
  uint8_t axis[3];
};

/// M700 6.11: the linear axis moves by k (e^(t/d) - 1) and the rotary axis by degrees_per_rad t, for t from 0 to `end` > 0; all other axes move in proportion
/// to the linear axis.
struct Exponential {
  double k, d, end, degrees_per_rad;
  uint8_t linear, rotary;
};

/// One span of a NURBS as a rational Bezier curve of `degree` 1 to 3.
struct RationalSpan {
  double point[4][3];
  double weight[4];
  uint8_t axis[3];
  uint8_t degree;
};

/// One block of a spline: start + c[0] u + ... + c[4] u^5 on up to three axes, u in [0, 1].
struct SplineSpan {
  double c[5][3];
  uint8_t axis[3];
};

/// `sine`: a SpaceArc without e2, which goes to and fro on a line. Its length is that of the arc, so that at an even speed along it the axes move as a sine.
enum class ShapeKind : uint8_t { plain, space_arc, exponential, rational, spline, sine };

/// The shape of a move as the program says it. `plain`: it is the line or circle of the move itself, mapped by `map`.
struct MoveShape {
  AxisMap map;
  ShapeKind kind = ShapeKind::plain;
  union {
    SpaceArc arc;
    Exponential exponential;
    RationalSpan span;
    SplineSpan spline;
  };
  MoveShape() : span{} {}
  bool operator==(const MoveShape& other) const;
};

/// The parameter u of a curve as a function of the path length, at equal steps of length.
struct ParameterTable {
  static constexpr unsigned kSteps = 32;
  double u[kSteps + 1], du[kSteps + 1], ddu[kSteps + 1];  ///< u and its first two derivatives by the length
  uint8_t newton[kSteps];  ///< steps of Newton's method that are needed within a step of length
  uint8_t panels[kSteps];  ///< parts in which the length is integrated for that
  // A step in which the curve nearly has a cusp is divided into intervals of the parameter, which are shorter near the cusp, so that each can be integrated
  // in one part. The places first[k] to first[k] + graded[k] are the ends of the intervals of step k.
  static constexpr unsigned kGraded = 128;
  uint8_t first[kSteps], graded[kSteps];  ///< first place and number of intervals of a step; graded 0 = the step is not divided
  uint8_t places;                         ///< number of places in use
  uint8_t effort[kGraded];                ///< steps of Newton's method in the interval that begins at this place
  double graded_u[kGraded], behind[kGraded];  ///< the parameter at this place, and the length from the beginning of the step to it
};

/// A committed shape.
struct CurveShape {
  MoveShape what;
  Curve base;            ///< the curve in programmed coordinates; for kinds other than `plain` only start, end, delta and length are set
  Affine to_machine;     ///< machine = to_machine(mapped coordinates); in it the rotary axis of the map depends on no other axis
  double begin_deg = 0;  ///< polar: machine position of the rotary axis at the start
  double circle_arg = 0; ///< polar: continuous angle (angle_on_circle) at the start of an arc
  bool circles_pole = false;   ///< polar: the pole is inside the circle of an arc
  uint32_t length_axes = 0;    ///< bit i: axis i counts in the length, for kinds other than `plain`
  double power[4][4] = {};     ///< rational: coefficients of w x, w y, w z and w as polynomials of the parameter
  double along2 = 0;           ///< exponential: squared way of all axes but the rotary one, where the linear one moves by 1
  ParameterTable table;
};

/// Geometry of a move in programmed coordinates.
struct PlainMove {
  const AxisVec* start;
  const AxisVec* end;
  const Circle* circle;  ///< nullptr = straight
  uint8_t h, v;
};

class ShapeAhead;
/// Makes *shape and *curve. The machine stands at `machine_start`, and the move ends at curve->end. `ahead`: its table may have been made there; or nullptr.
void make_shaped(const MoveShape& what, const PlainMove& move, const Affine& to_machine, const AxisVec& machine_start, unsigned axis_count,
                 uint32_t rotary, CurveShape* shape, Curve* curve, const ShapeAhead* ahead = nullptr);
/// Only where it ends, which needs no table.
AxisVec shaped_end(const MoveShape& what, const PlainMove& move, const Affine& to_machine, const AxisVec& machine_start, unsigned axis_count,
                   uint32_t rotary);
/// The axes whose programmed coordinates are degrees: on a mapped plane that of the rotary axis is in millimetres.
uint32_t programmed_degrees(const AxisMap& map, uint32_t rotary);

/// The programmed coordinates of a machine position. Frozen axes are not treated differently from others.
AxisVec to_programmed(const AxisMap& map, const Affine& to_machine, const AxisVec& machine);

AxisVec shape_position(const Curve& curve, double s, unsigned axis_count) NC_RT;
CurvePoint shape_evaluate(const Curve& curve, double s, unsigned axis_count) NC_RT;
/// The curve in programmed coordinates; there |d1| over the axes that make the length is 1.
CurvePoint shape_programmed(const CurveShape& shape, double s, unsigned axis_count) NC_RT;
void shape_bounds(const Curve& curve, unsigned axis_count, AxisVec* low, AxisVec* high);

/// For a polar shape: smallest distance of its plain base from the pole, mm, and the curvature of the base in the plane, 1/mm.
struct PolarReach {
  double distance = 0, curvature = 0;
  bool radial = false;  ///< the base is a line from or to the pole, on which the angle does not change
};
PolarReach polar_reach(const CurveShape& shape);
/// How far the beginning of the curve is from where the axes stand, mm or deg, on the axis with the largest difference.
double leaves_from(const Curve& curve, unsigned axis_count);
/// The angle of a polar shape would jump, because it goes through the pole, or leaves the pole in another direction than the rotary axis stands.
bool jumps_at_pole(const Curve& curve);

/// The angle, rad, by which the plain base of a polar shape turns about the pole from its start to its end, full turns included.
double polar_turn(const Curve& base, const AxisMap& map);

}  // namespace nc
