// SPDX-License-Identifier: Apache-2.0
// The corner between two blocks: chamfered or rounded (M700 13.7). The manual's corners lie between lines; those beside arcs are ours (corner_ii).
//
// A block is known there by its unit tangent u in the direction of travel and its curvature k, as in offset/corner.hpp. The centre of a rounding lies
// beside both blocks by R, on the side to which the path turns: it is where their offset curves meet, and the arc leads from the foot of that point
// on the first block to its foot on the next. A chamfer leads from where the circle of its size about the corner crosses the first block to where
// it crosses the next.
#pragma once

#include "stream/stream.hpp"

namespace nc {

/// `first` leads to the imaginary corner K, `next` leads away from it; their directions there are u1 and u2.
///
///   chamfer c:   the line from K - c u1 to K + c u2
///   rounding R:  the arc that touches both lines, from K - t u1 to K + t u2 with t = R tan(turn / 2); in the plane of `first`, where t and
///                the directions are those of the projections; other axes go linearly along
struct CornerCut {
  bool any = false;  ///< the lines go straight on: a rounding of nothing
  bool round = false;
  AxisVec before;    ///< where the first line ends now: by the corner before K
  AxisVec behind;    ///< where the cut ends: by the corner behind K, in the coordinates of `first`
  AxisVec lead;      ///< behind - K, by which the next line begins later
  Circle circle;     ///< of a rounding
};

/// An arc that ends earlier, or begins later, than it was programmed, at a point of its circle.
void end_arc_at(Move* arc, const AxisVec& end);
void begin_arc_at(Move* arc, const AxisVec& start);

/// Length that is left of a line for its corner: of all its linear axes, of a rounding in its plane.
double corner_travel(const Move& line, const Move& first, uint32_t rotary, unsigned axis_count);

/// Equality is no alarm (M700 13.7.1: "less than"); this is below every command unit.
inline constexpr double kCornerSlack_mm = 1e-9;

/// The same where one of the two is an arc of the plane of `first`. Condition::corner_arc: it lies in another plane.
Condition cut_arc_corner(const Move& first, const Move& next, unsigned axis_count, CornerCut* cut);

/// Condition::none, corner_short (the first line is too short for its corner; a corner before may have taken a part of it), corner_reversal (a rounding between a line and its way back) or
/// corner_next_short.
Condition cut_corner(const Move& first, const Move& next, uint32_t rotary, unsigned axis_count, CornerCut* cut);

}  // namespace nc
