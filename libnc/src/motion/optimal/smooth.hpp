// SPDX-License-Identifier: Apache-2.0
// Smooths a polyline within a tolerance: a cubic spline by the length u of the polyline, whose control points
// lie on the polyline at the Greville places of its knots. Such a spline reproduces straight stretches
// exactly (with |q'| = 1) and never turns more than the polyline. Round a corner with knots at -h, 0, +h it
// leaves the polyline by |t2 - t1| h / 6 at most, so h is the tolerance's; dense polylines get knots at some
// of their vertices, and more of them until every vertex is near enough. A sharp corner that stands alone is
// turned along the curve on which one axis stops while the other starts, each with constant jerk
// (docs/motion-optimal.md).
#pragma once

#include "motion/optimal/fit.hpp"
#include "motion/optimal/work.hpp"

namespace nc::optimal {

/// `count` vertices; edge k leads from vertex k to k + 1 with the length `length[k]` > 0 and the feed
/// `feed[k]`.
struct Polyline {
  const AxisVec* vertex = nullptr;
  const double* length = nullptr;
  const double* feed = nullptr;
  unsigned count = 0;
};

/// What is known of the cell behind a knot.
struct SmoothCell {
  CellMoments moments;
  unsigned first_edge = 0, last_edge = 0;
  double least_feed = 0, most_feed = 0;  ///< of these edges
  bool summed = false;       ///< the moments, edges and feeds are those of the cell
  bool near = false;         ///< it was near enough to the line, and nothing that it hangs on has changed
  bool split = false;        ///< it is to be halved
  bool stays = false;        ///< relax() did not find the control points from its knot on a better place
  unsigned char halved = 0;  ///< how often it was; kCorner: its knot is that of a corner that is kept
};

/// Room for the work, from the caller: `vertices` of u, `knots` of everything else.
struct SmoothRoom {
  double* u = nullptr;
  unsigned vertices = 0;
  double* knot = nullptr;
  AxisVec* control = nullptr;  ///< knots + 2
  unsigned* corner = nullptr;  ///< per knot: the vertex of the sharp corner that it belongs to, 0 = none
  SmoothCell* cell = nullptr;
  unsigned knots = 0;
};

inline constexpr unsigned kKept = 16;  ///< knots behind the place where a line goes on, at most

struct SmoothRequest {
  Polyline line;
  double tolerance = 0.01;  ///< mm (or deg)
  double spacing = 0.5;     ///< of knots, where the tolerance allows
  /// > 0: a spacing is what the feed of the line there goes in so many seconds, kLeastSpacing at least, and no more than `spacing`.
  double seconds = 0;
  unsigned edges = 0;       ///< > 0: nor more than so many of the lines about there are long
  unsigned axis_count = 3;
  bool open = false;        ///< it goes on behind its last vertex
  bool straight_start = false, straight_end = false;  ///< without curvature there, however short the edge is
  /// The line goes on from one that was smoothed before, which ended with this position, first and second derivative, on its first edge and
  /// beside vertex 0 by no more than the tolerance.
  const CurvePoint* from = nullptr;
  double hidden = 0;         ///< so much of that edge lies in front of vertex 0
  double kept[kKept] = {};   ///< the first knots, which the one before had there
  unsigned kept_count = 0;
};

/// Where a line that goes on is cut: behind so many of its cells, the last of which ends there.
struct Border {
  unsigned cells = 0;       ///< 0 = there is none
  double u = 0;
  double kept[kKept] = {};  ///< the next knots, from there on
  unsigned kept_count = 0;
};

/// A border so far from the end of the line that what follows changes nothing in front of it, behind `most` cells at most.
Border find_border(const SmoothRequest& request, const SmoothRoom& room, const Piece* pieces, unsigned cells, unsigned most);

/// @return pieces written to `out` (exact at both ends, tangent to the first and the last edge, without
/// curvature there when those are not very short); 0 = no room.
Task<unsigned> smooth(Work& work, const SmoothRequest& request, const SmoothRoom& room, Piece* out, unsigned capacity);

}  // namespace nc::optimal
