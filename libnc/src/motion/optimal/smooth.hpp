// SPDX-License-Identifier: Apache-2.0
// Smooths a polyline within a tolerance: a cubic spline by the length u of the polyline, whose control points
// lie on the polyline at the Greville places of its knots. Such a spline reproduces straight stretches
// exactly (with |q'| = 1) and never turns more than the polyline. Round a corner with knots at -h, 0, +h it
// leaves the polyline by |t2 - t1| h / 6 at most, so h is the tolerance's; dense polylines get knots at some
// of their vertices, and more of them until every vertex is near enough. A sharp corner that stands alone is
// turned along the curve on which one axis stops while the other starts, each with constant jerk
// (docs/motion-optimal.md).
#pragma once

#include "motion/optimal/piece.hpp"

namespace nc::optimal {

/// `count` vertices; edge k leads from vertex k to k + 1 with the length `length[k]` > 0 and the feed
/// `feed[k]`.
struct Polyline {
  const AxisVec* vertex = nullptr;
  const double* length = nullptr;
  const double* feed = nullptr;
  unsigned count = 0;
};

/// Room for the work, from the caller: `vertices` of u, `knots` of everything else.
struct SmoothRoom {
  double* u = nullptr;
  unsigned vertices = 0;
  double* knot = nullptr;
  AxisVec* control = nullptr;  ///< knots + 2
  unsigned* corner = nullptr;  ///< per knot: the vertex of the sharp corner that it belongs to, 0 = none
  unsigned char* split = nullptr;
  unsigned knots = 0;
};

struct SmoothRequest {
  Polyline line;
  double tolerance = 0.01;  ///< mm (or deg)
  double spacing = 0.5;     ///< of knots, where the tolerance allows
  unsigned axis_count = 3;
  bool straight_start = false, straight_end = false;  ///< without curvature there, however short the edge is
  /// The line goes on from one that was smoothed before: its knots, kGoesOn of them from u = knot[0] >= 0 on, are these. Cells from
  /// kFirstCell on are made, which begin at `at`.
  const double* knot = nullptr;
  AxisVec at;
};
inline constexpr unsigned kGoesOn = 6, kFirstCell = 3;

/// Cells of a line that goes on: those in front of the result do not depend on what follows, and cell `result` is where the next one goes
/// on (with the knots result - kFirstCell and so on of the room); 0 = none.
unsigned settled_cells(const SmoothRequest& request, const SmoothRoom& room, unsigned cells);

/// @return pieces written to `out` (exact at both ends, tangent to the first and the last edge, without
/// curvature there when those are not very short); 0 = no room.
unsigned smooth(const SmoothRequest& request, const SmoothRoom& room, Piece* out, unsigned capacity);

}  // namespace nc::optimal
