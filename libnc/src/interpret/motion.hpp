// SPDX-License-Identifier: Apache-2.0
// Moves: from the words of a block, or from a handler, into the stream (motion.cpp, arc.cpp).
#pragma once

#include "interpret/context.hpp"

namespace nc {

struct LinearStyle {
  nc_move_kind kind = NC_MOVE_LINE;
  double feed_mm_min = 0;
  const SkipSpeeds* skip_speeds = nullptr;
  bool exact_stop = false;
  bool transparent = false;   ///< radius compensation vectors are away for this move
  uint8_t skip_mask = 0;
  uint8_t unclamps = 0;       ///< index tables that are unclamped meanwhile (M700 9.3)
  double feed_mm_rev = 0;     ///< thread: lead along the longest axis
  double thread_angle = 0;
  bool tapping = false;       ///< a stroke of a tap: the override is 100 %
  double tap_slope = 0;       ///< highest acceleration of the spindle for it, rev/s^2; 0 = any
  double tap_speed = 0;       ///< of a tap that goes with the spindle: what the spindle is to turn with, r/min, forward positive
  bool special_feed = false;  ///< the modal feed, and it is not the plain one (interpret/feed.hpp)
  Corner corner = Corner::none;  ///< at its end ...
  double corner_mm = 0;       ///< ... of this size
  double in_position = 0;     ///< ,I ,J: what comes behind waits until each axis is as near to its end as this, mm; 0 = by the parameters
};
/// A straight move to `target` in the active coordinates; `commanded` = axes named in the block (tool length is applied to them).
void move_linear(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style);
/// A straight rapid to machine coordinates of the `commanded` axes (G53, second leg of G28), without any compensation on those of them
/// that are `bare`.
void move_machine(BlockContext& in, const AxisVec& machine, uint32_t commanded, uint32_t bare = ~uint32_t{0});
/// Moves end beside their programmed ends, by a vector in space (M700 12.3, 12.5).
inline bool leads_beside(const State& state) { return state.space.on || state.moved_space.on || state.tool_length != 0; }
/// The vector of a move that ends at these machine coordinates (functions/tool_axis.cpp).
SpaceVector space_vector(const BlockContext& in, const AxisVec& machine);
/// The next movement is the one that radius compensation starts or ends with: it must not be an arc.
bool starts_or_ends_compensation(const BlockContext& in);
/// An arc in the plane in force by the words of the block.
Execution move_arc(BlockContext& in, const AxisVec& target, uint32_t commanded, bool ccw);
struct ArcWords;
struct PlaneAxes;
/// The words of the block that say which arc it is, for the plane in force.
Execution read_arc_words(BlockContext& in, const PlaneAxes& plane, uint32_t commanded, ArcWords* words);
/// The same by words that the caller has made.
Execution move_arc_by(BlockContext& in, const PlaneAxes& plane, const AxisVec& target, uint32_t commanded, ArcWords words, bool ccw);
/// Programmed coordinates of a move: where it starts and ends, and the map behind them.
struct MoveFrame {
  Affine to_machine;
  AxisVec start, end;
};
/// Tool length goes to the commanded axes; axes that are not stay where they are.
MoveFrame frame_of_move(BlockContext& in, const AxisVec& target, uint32_t commanded);
/// A circular move (arc, helix, spiral) at the feed in force.
void emit_circular(BlockContext& in, const MoveFrame& frame, const PlaneAxes& plane, const Circle& circle, nc_move_kind kind);
/// A move of any other shape; its feed is the caller's.
Move& emit_shaped(BlockContext& in, const MoveFrame& frame, const MoveShape& shape, nc_move_kind kind);
/// Modal curves that do not bear some other codes.
inline bool bars_codes(Function motion) { return is_space_arc(motion) || is_exponential(motion); }
/// A compensation command in a block that does not move: a move without length carries it to the offset stage (offset/offset.hpp).
void move_nowhere(BlockContext& in);
/// P20: a rotary axis commanded to a position that is no multiple of #2106 (M700 2.3).
Execution check_index_positions(BlockContext& in);
/// The motion that the words of the block ask for by the motion in force.
Execution move_by_words(BlockContext& in);
/// F in force as mm/min, 0 = none.
double feed_mm_min(const BlockContext& in);
/// The same for a line between these points, of which rotary axes alone may be moved.
double feed_for(const BlockContext& in, const AxisVec& start, const AxisVec& end);
/// The end point that the words ask for.
AxisVec target_of_words(const BlockContext& in);
/// The same from values by axis; `axes` of them are programmed.
AxisVec target_of(const BlockContext& in, const AxisVec& position, uint32_t axes, const AxisVec& value);
AxisVec target_of_words(const BlockContext& in, const AxisVec& position);  ///< with position() at hand

/// interpret/arc.cpp
struct ArcWords {
  bool has_radius = false;
  double radius = 0;
  double center[2] = {0, 0};   ///< increments from the start, plane axes
  uint32_t turns = 0;
  bool turns_count_last = false;   ///< `turns` counts the one in which the end lies
};
/// Circle through start and end on the plane axes; Condition::none when it exists. *straight becomes true when the words make no circle: then the path is
/// the straight line to the end, which has no length where the end is the start.
Condition make_circle(const double start[2], const double end[2], const ArcWords& words, bool ccw, double tolerance, Circle* circle,
                      bool* straight);

}  // namespace nc
