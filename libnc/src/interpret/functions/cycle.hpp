// SPDX-License-Identifier: Apache-2.0
// What the files of the fixed cycles have of each other: cycle.cpp (the words), cycle_strokes.cpp (the moves of a hole), tap.cpp (the words of
// tapping), hole_pattern.cpp (M700 13.2).
#pragma once

#include "interpret/functions/functions.hpp"

namespace nc {

/// The cycle that a function is in this family, CycleKind::none where it is none.
CycleKind cycle_kind(const Dialect& dialect, Function function);

/// Everything that a hole needs is there: feed, spindle, cuts.
Execution check_hole(BlockInHand& in);

/// cycle_strokes.cpp: to the next hole of the block; its strokes follow in continue_cycle().
Execution begin_hole(BlockContext& in);
/// The move over the hole alone.
void position_over_hole(BlockContext& in);
/// Axes that are positioned over the hole: those of the plane that is selected, and the basic axes that are not parallel to the drilling axis.
uint32_t positioning_axes(const InForce& in);

/// The way beside the hole along the axes of the plane that move there: I J K, or Q with #1080, #8207 and #8208 (M700 13.1.1, G76 and G87). A word along the axis that
/// drills is none of it.
struct ShiftInPlane {
  double way[2] = {0, 0};
  bool none_by_parameter = false;  ///< an axis has no shift because #8207 says so
};
ShiftInPlane shift_in_plane(const InForce& in);

/// retract_overlap.cpp, an option of the machine (nc_config::retract_overlap): strokes along the drilling axis go on at speed where they can.
bool strokes_flow(const BlockInHand& in);
/// The direction in which the hole in hand has been left along the drilling axis, 1 or -1; 0 where that was not in rapid traverse out of the hole.
int8_t way_back(const BlockInHand& in);
/// Over to the next hole beyond the level on which the tool is, without a rest. False: it has to go there as it is programmed.
bool traverse_beyond_level(BlockContext& in, const AxisVec& target, uint32_t axes);

/// tap.cpp: what the block says of tapping, kept in State::cycle; and whether a tap can be made.
Execution take_tap_words(BlockInHand& in);
Execution check_tap(BlockInHand& in);
/// With what the spindle makes a stroke of a synchronous tap of so many turns at this speed at most: its highest speed and acceleration, by #3005 to #3045.
struct TapLaw {
  double rev_min = 0;
  double slope = 0;  ///< rev/s^2; 0 = the parameters say nothing
};
TapLaw tap_law(const InForce& in, double rev_min, double turns);
/// The tap of the cycle in force, made in cuts where it has a depth for them.
CycleKind tap_in_cuts(const InForce& in, CycleKind kind);

}  // namespace nc
