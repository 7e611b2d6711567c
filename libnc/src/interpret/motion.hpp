// SPDX-License-Identifier: Apache-2.0
// Moves: from the words of a block, or from a handler, into the stream (motion.cpp, arc.cpp).
#pragma once

#include "interpret/context.hpp"

namespace nc {

/// Its members stand by their size, so that those which are 0 lie together: one is made for every stroke of a hole.
struct LinearStyle {
  double feed_mm_min = 0;
  const SkipSpeeds* skip_speeds = nullptr;
  double feed_mm_rev = 0;     ///< thread: lead along the longest axis
  double thread_angle = 0;
  double tap_slope = 0;       ///< highest acceleration of the spindle for it, rev/s^2; 0 = any
  double tap_speed = 0;       ///< of a tap that goes with the spindle: what the spindle is to turn with, r/min, forward positive
  double corner_mm = 0;       ///< of this size is ...
  double in_position = 0;     ///< ,I ,J: what comes behind waits until each axis is as near to its end as this, mm; 0 = by the parameters
  nc_move_kind kind = NC_MOVE_LINE;
  Corner corner = Corner::none;  ///< ... the corner at its end
  uint8_t skip_mask = 0;
  uint8_t unclamps = 0;       ///< bit i: axis i, an index table, is unclamped during the move (M700 9.3)
  bool exact_stop = false;
  bool flows = false;         ///< rapid traverse: see Move::flows
  bool transparent = false;   ///< the vectors of radius compensation are taken away for this move
  bool skip_away = false;     ///< see Move::skip_away
  bool tapping = false;       ///< a stroke of a tap: the override is 100 %
  bool special_feed = false;  ///< the modal feed, and it is not the plain one (interpret/feed.hpp)
  bool checks_itself = false; ///< whether the axes are waited for behind it is not for the parameters to say: who makes the move adds the check
};
/// Makes a straight move to `target` in the active coordinates; `commanded`: the axes named in the block, to which tool length is applied.
void move_linear(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style);
/// An axis goes to this coordinate, as the strokes of a hole do: it is not there yet. Applies the tool length to it, also where it stays.
bool goes_along_axis(InForce& in, unsigned axis, double to);
/// Moves an axis alone that goes there.
void move_axis(BlockContext& in, unsigned axis, double to, const LinearStyle& style);
/// Makes a straight rapid to machine coordinates of the `commanded` axes (G53, second part of G28); those of them that are in `bare` get no compensation.
void move_machine(BlockContext& in, const AxisVec& machine, uint32_t commanded, uint32_t bare = ~uint32_t{0});
/// The same from a contour to a place of the machine, its reference position or that of the tool change: a block of radius compensation in front of it ends at right
/// angles, as there is nothing behind it that it could meet.
void leave_for_machine(BlockContext& in, const AxisVec& machine, uint32_t commanded);
/// Moves end beside their programmed ends, by a vector in space (M700 12.3, 12.5).
inline bool leads_beside(const State& state) { return state.space.on || state.moved_space.on || state.tool_length != 0; }
/// The vector of a move that ends at these machine coordinates (functions/tool_axis.cpp).
SpaceVector space_vector(const InForce& in, const AxisVec& machine);
/// The next movement is the one that radius compensation starts or ends with: it must not be an arc.
bool starts_or_ends_compensation(const InForce& in);
/// Radius compensation has been cancelled by a block without a movement in its plane, and this one has none either: the tool stays beside the path.
bool keeps_vector(const BlockInHand& in);
/// Makes an arc in the plane in force, by the words of the block.
Execution move_arc(BlockContext& in, const AxisVec& target, uint32_t commanded, bool ccw);
struct ArcWords;
struct PlaneAxes;
/// Reads the words of the block that determine an arc in this plane.
Execution read_arc_words(BlockInHand& in, const PlaneAxes& plane, uint32_t commanded, ArcWords* words);
/// Makes an arc by words that the caller gives.
Execution move_arc_by(BlockContext& in, const PlaneAxes& plane, const AxisVec& target, uint32_t commanded, ArcWords words, bool ccw);
/// The start and end of a move in the compensation frame, and the map from there to the machine.
struct MoveFrame {
  Affine to_machine;
  AxisVec start, end;
};
/// The frame of a move to `target`. Tool length is applied to the commanded axes; the other axes stay where they are.
MoveFrame frame_of_move(InForce& in, const AxisVec& target, uint32_t commanded);
/// Emits a circular move (arc, helix, spiral) at the feed in force.
void emit_circular(BlockContext& in, const MoveFrame& frame, const PlaneAxes& plane, const Circle& circle, nc_move_kind kind);
/// Emits a move of any other shape; the caller sets its feed.
Move& emit_shaped(BlockContext& in, const MoveFrame& frame, const MoveShape& shape, nc_move_kind kind);
/// A modal curve during which some other codes may not be commanded.
inline bool bars_codes(Function motion) { return is_space_arc(motion) || is_exponential(motion); }
/// Emits a move without length, which carries a compensation command in a block that does not move to the offset stage (offset/offset.hpp).
void move_nowhere(BlockContext& in, bool leads_space = false);
/// P20: a rotary axis is commanded to a position that is not a multiple of #2106 (M700 2.3).
Execution check_index_positions(BlockInHand& in);
/// Makes the motion that the words of the block command in the motion mode in force.
Execution move_by_words(BlockContext& in);
/// F in force in mm/min, 0 = none.
double feed_mm_min(const InForce& in);
/// What F counts in for a line between these points: mm, in inch mode 25.4 mm; in inch mode 10 deg where it moves only rotary axes, and both together where a
/// degree is a tenth of an inch (M700 3.2 note 6). Its way is in mm and degrees.
double feed_unit(const InForce& in, const AxisVec& start, const AxisVec& end);
/// F in force for a line between these points: in mm/min, or in deg/min where it moves only rotary axes.
double feed_for(const InForce& in, const AxisVec& start, const AxisVec& end);
/// The end point that the words command.
AxisVec target_of_words(const BlockInHand& in);
/// The end point that these targets command.
AxisVec target_of(const BlockInHand& in, const AxisVec& position, const Targets& targets);
AxisVec target_of_words(const BlockInHand& in, const AxisVec& position);  ///< for a caller that has position() already

/// interpret/arc.cpp
struct ArcWords {
  bool has_radius = false;
  double radius = 0;
  double center[2] = {0, 0};   ///< centre as increments from the start, on the axes of the plane
  uint32_t turns = 0;          ///< number of turns (P)
  bool turns_count_last = false;   ///< `turns` includes the turn in which the end point lies
  bool may_be_short = false;       ///< a radius below half the chord is half the chord
};
/// Series 8 G02: gives the increments of a centre, which are without a sign, their signs. False: no arc stays within a quadrant about it.
bool center_of_quadrant(const double start[2], const double end[2], bool ccw, double tolerance, double center[2]);
/// Makes the circle through start and end on the axes of the plane; Condition::none when it exists. *straight becomes true when the words make no circle: then
/// the path is the straight line to the end, which has no length where the end is the start.
Condition make_circle(const double start[2], const double end[2], const ArcWords& words, bool ccw, double tolerance, Circle* circle,
                      bool* straight);

}  // namespace nc
