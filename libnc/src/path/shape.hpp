// SPDX-License-Identifier: Apache-2.0
// Shapes: the curves that are neither lines nor circular arcs of the axes themselves, and the maps between a plane that is programmed
// and the axes that move. A move carries a MoveShape (what the program says); commit makes a CurveShape of it, which is all that
// evaluation needs, in one of a fixed number of places, and a Curve points to it.
//
// Everything is exact: closed forms throughout. Where the path length has none, a table of the parameter at equal steps of length
// says where to look; the point itself always comes from the closed form of the curve, so an error of the table moves it along the
// curve and never off it.
#pragma once

#include "frame/affine.hpp"
#include "path/curve.hpp"

namespace nc {

/// From the coordinates that are programmed to those of the axes, in front of the affine map that leads to the machine.
struct AxisMap {
  enum class Kind : uint8_t {
    none,
    cylinder,  ///< M700 6.9: axis `rotary` holds mm on the developed surface, `scale` mm to the degree
    polar      ///< M700 6.10: (linear, rotary) hold x, y of a plane; the axes go to its radius and angle
  };
  Kind kind = Kind::none;
  uint8_t linear = 0, rotary = 0;
  int8_t side = 1;      ///< polar: -1 = the linear axis works on the minus side
  uint8_t frozen = 0;   ///< bit i: axis i takes part in the path and does not move (M700 6.16)
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

/// M700 6.11: the linear axis goes k (e^(t/d) - 1), the rotary axis degrees_per_rad t, t from 0 to `end` > 0; all others go with the
/// linear axis.
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

enum class ShapeKind : uint8_t { plain, space_arc, exponential, rational, spline };

/// What a program says of the shape of a move; with `plain` the move's own line or circle under `map`.
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

/// The parameter by path length, at equal steps.
struct ParameterTable {
  static constexpr unsigned kSteps = 32;
  double u[kSteps + 1], du[kSteps + 1], ddu[kSteps + 1];  ///< and its derivatives by the length
  uint8_t newton[kSteps];  ///< steps of Newton's method that are needed inside a step of length
  uint8_t panels[kSteps];  ///< and parts of it in which the length is measured for that
  // A step in which the curve all but has a cusp is divided by the parameter, finer towards that place, so that one part is enough
  // everywhere. Places [first, first + graded] belong to step k.
  static constexpr unsigned kGraded = 128;
  uint8_t first[kSteps], graded[kSteps];  ///< graded: intervals, 0 = the step is not divided
  uint8_t places;                         ///< in use
  uint8_t effort[kGraded];                ///< steps of Newton's method in the interval that begins here
  double graded_u[kGraded], behind[kGraded];  ///< the parameter, and the length behind the beginning of the step
};

/// A committed shape.
struct CurveShape {
  MoveShape what;
  Curve base;            ///< in programmed coordinates; of the kinds beside `plain` start, end, delta and length
  Affine to_machine;     ///< machine = to_machine(mapped); a rotary axis of the map depends on no other one in it
  double begin_deg = 0;  ///< polar: machine position of the rotary axis at the start
  double circle_arg = 0; ///< polar: what the continuous angle of an arc counts from
  bool circles_pole = false;
  uint32_t length_axes = 0;
  double power[4][4] = {};     ///< rational: w x, w y, w z and w by powers of the parameter
  double along2 = 0;           ///< exponential: squared way of all axes but the rotary one, per way of the linear one
  ParameterTable table;
};

/// Geometry of a move in programmed coordinates.
struct PlainMove {
  const AxisVec* start;
  const AxisVec* end;
  const Circle* circle;  ///< nullptr = straight
  uint8_t h, v;
};

/// Fills `shape` and `curve`. The machine stands at `machine_start`; where it ends is curve->end.
void make_shaped(const MoveShape& what, const PlainMove& move, const Affine& to_machine, const AxisVec& machine_start, unsigned axis_count,
                 uint32_t rotary, CurveShape* shape, Curve* curve);

/// Where the axes stand that are at `machine`, in programmed coordinates. Frozen axes are left as they are.
AxisVec to_programmed(const AxisMap& map, const Affine& to_machine, const AxisVec& machine);

AxisVec shape_position(const Curve& curve, double s, unsigned axis_count) NC_RT;
CurvePoint shape_evaluate(const Curve& curve, double s, unsigned axis_count) NC_RT;
/// In programmed coordinates: |d1| over the axes that make the length is 1.
CurvePoint shape_programmed(const CurveShape& shape, double s, unsigned axis_count) NC_RT;
void shape_bounds(const Curve& curve, unsigned axis_count, AxisVec* low, AxisVec* high);

/// Smallest distance from the pole of the plain base of a polar shape, and the curvature of its way in the plane.
struct PolarReach {
  double distance = 0, curvature = 0;
  bool radial = false;  ///< a straight way from or to the pole: the angle does not change
};
PolarReach polar_reach(const CurveShape& shape);
/// How far the curve itself begins from where the axes stand at its start: mm or deg, of the axis that is farthest away.
double leaves_from(const Curve& curve, unsigned axis_count);
/// The angle would jump: a polar shape goes through the pole, or leaves it in another direction than the axis stands.
bool jumps_at_pole(const Curve& curve);

/// Angle in rad, continuous along the plain base of a polar shape, from its start to its end.
double polar_turn(const Curve& base, const AxisMap& map);

}  // namespace nc
