// SPDX-License-Identifier: Apache-2.0
// Solids that a probe touches: a box, cylinder, sphere or half-space with holes in it, seen by a ball, on a table that turns
// (docs/trace.md, "Probing").
//
// Everything goes by the signed distance from the centre of the ball to the surface: positive outside, and nowhere longer than the way to
// the nearest point of the solid, so that one may always go on by it. The distance is that way, but beside the rims of holes, where it
// may be shorter: there the ball touches as if the rim had been cut off along both surfaces.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace nc::tools {

/** X, Y, Z in mm. */
using Point3 = std::array<double, 3>;

struct ProbeShape {
  enum class Kind { kBox, kCylinder, kSphere, kHalfSpace };
  Kind kind = Kind::kBox;
  Point3 low{}, high{};       // box; a cylinder along its axis; +-infinity = endless
  Point3 center{};            // cylinder (two of them), sphere; a point of the surface of a half-space
  Point3 normal{0, 0, 1};     // half-space: unit vector out of the solid
  double radius = 0.0;        // cylinder, sphere
  int axis = 2;               // cylinder: 0 X, 1 Y, 2 Z

  /** Signed distance of a point from the surface, mm. */
  double distance(const Point3& p) const;
};

/** A rotary axis that carries the solid. As ISO 841 has it, a positive command turns the table negatively about its axis. */
struct ProbeTurn {
  unsigned axis_index = 0;  // of the part system
  int about = 2;            // 0 X, 1 Y, 2 Z
  Point3 center{};          // a point of the axis, machine coordinates, where the ones further out stand at 0
};

/** One solid with all that belongs to it. */
struct ProbeSolid {
  ProbeShape shape;
  std::vector<ProbeShape> holes;   // taken out of it
  std::vector<ProbeTurn> turns;    // from the machine base outwards
  Point3 ball_center{};            // from the controlled point
  double ball_radius = 0.0;
  bool work = false;               // in the workpiece coordinates of the move, not of the machine

  /** Distance of the ball from the surface where the controlled point is at `p` and the rotary axes at `angles` (by index, degrees). */
  double clearance(const Point3& p, const double* angles) const;

  /** A straight way of the controlled point and its rotary axes. */
  struct Way {
    Point3 from{}, to{};
    const double *angles_from = nullptr, *angles_to = nullptr;
  };
  /**
   * Smallest part of the way, 0 to 1, at which the ball goes into the solid; infinity when it does not. On the surface it is outside: a way
   * that leaves the surface or slides along it is none that goes in; one that would go in where it ends does.
   */
  double first_entry(const Way& way) const;
};

}  // namespace nc::tools
