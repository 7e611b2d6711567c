// SPDX-License-Identifier: Apache-2.0
// The corner between two lines: chamfered or rounded (M700 13.7).
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

/// Length that is left of a line for its corner: of all its linear axes, of a rounding in its plane.
double corner_travel(const Move& line, const Move& first, uint32_t rotary, unsigned axis_count);

/// Equality is no alarm (M700 13.7.1: "less than"); this is below every command unit.
inline constexpr double kCornerSlack_mm = 1e-9;

/// Condition::none, corner_short (the first line is too short for its corner; a corner before may have taken a part of it), corner_reversal (a rounding between a line and its way back) or
/// corner_next_short.
Condition cut_corner(const Move& first, const Move& next, uint32_t rotary, unsigned axis_count, CornerCut* cut);

}  // namespace nc
