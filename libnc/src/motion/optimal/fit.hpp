// SPDX-License-Identifier: Apache-2.0
// Control points of a cubic spline that goes through the middle of a polyline: a least-squares fit for each
// of them, over the four cells that it bends. So it depends on nothing outside of these, and many short lines are averaged
// (docs/motion-optimal.md, "Geometry").
#pragma once

#include "motion/optimal/piece.hpp"

namespace nc::optimal {

/// Integrals of the polyline over a cell from knot to knot, s from 0 to 1 along it.
struct CellMoments {
  double from = 0, length = 0;  ///< u
  AxisVec at;                   ///< the polyline at its start
  AxisVec moment[4];            ///< of (p - at) s^n
};

/// Edges of a polyline as Polyline has them, with the lengths up to each vertex.
struct Edges {
  const AxisVec* vertex;
  const double *length, *u;
  unsigned count;  ///< vertices
};

/// The moments of cell [from, to]. `edge` is one at or in front of its start, and afterwards the one at its end.
void cell_moments(const Edges& line, double from, double to, unsigned axis_count, unsigned* edge,
                  CellMoments* out);

/// The cubic that is nearest to the polyline over four cells (least squares by u) has the polar form that is
/// wanted of a control point: its arguments are the three knots between the cells. A polyline that is
/// straight, or follows a cubic, is given back.
AxisVec fitted_control(const CellMoments* const cell[4], unsigned axis_count);

}  // namespace nc::optimal
