// SPDX-License-Identifier: Apache-2.0
// Solids that a probe touches with its ball: a box, cylinder, sphere or half-space with holes in it, on a table that may turn
// (docs/trace.md, "Probing").
//
// All results come from the signed distance between the centre of the ball and the surface. It is positive outside, and never greater than the true
// distance to the nearest point of the solid, so that the ball can always move on by it. It is the true distance except near the rims of holes, where it
// may be smaller: there the ball touches as if the rim had been cut off along both surfaces.
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
  Point3 low{}, high{};       // limits of a box, and of a cylinder along its axis; +-infinity = unlimited
  Point3 center{};            // centre of a sphere or of a cylinder (without its axis); for a half-space a point of its surface
  Point3 normal{0, 0, 1};     // half-space: unit vector out of the solid
  double radius = 0.0;        // cylinder, sphere
  int axis = 2;               // axis of a cylinder: 0 X, 1 Y, 2 Z

  /** Signed distance of a point from the surface, mm. */
  double distance(const Point3& p) const;
};

/** A rotary axis that carries the solid. According to ISO 841, a positive command turns the table in the negative direction about its axis. */
struct ProbeTurn {
  unsigned axis_index = 0;  // index of the axis in the part system
  int about = 2;            // it turns about 0 X, 1 Y, 2 Z
  Point3 center{};          // a point of its axis in machine coordinates, when all other rotary axes are at 0
};

/** One solid with its holes, the rotary axes that carry it, and the ball that touches it. */
struct ProbeSolid {
  ProbeShape shape;
  std::vector<ProbeShape> holes;   // shapes that are removed from it
  std::vector<ProbeTurn> turns;    // rotary axes that carry it, from the machine base outwards
  Point3 ball_center{};            // centre of the ball, relative to the controlled point
  double ball_radius = 0.0;
  bool work = false;               // the solid is given in the workpiece coordinates of the move, not in machine coordinates

  /** Distance of the ball from the surface when the controlled point is at `p` and the rotary axes at `angles` (by index, degrees). */
  double clearance(const Point3& p, const double* angles) const;

  /** A straight way of the controlled point and its rotary axes. */
  struct Way {
    Point3 from{}, to{};
    const double *angles_from = nullptr, *angles_to = nullptr;
  };
  /**
   * The smallest part of the way, 0 to 1, at which the ball enters the solid; infinity when it does not. A ball on the surface is outside: a way
   * that leaves the surface or slides along it does not enter, but a way that would enter just beyond its end does.
   */
  double first_entry(const Way& way) const;
};

}  // namespace nc::tools
