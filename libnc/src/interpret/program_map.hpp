// SPDX-License-Identifier: Apache-2.0
// The map from programmed points to the active workpiece coordinates: figure rotation (M700 13.3.3), scaling (13.19), coordinate rotation
// (13.20: it turns the centre of scaling, too), then mirror image by program (13.6) and by switch, and the rotation by parameter (13.21,
// interpret/work_rotation.hpp). Scaling and mirror image that a rotated
// program commands itself come before its rotation (13.19 (6)). They are one affine map (frame/affine.hpp), which
// lies in front of tool radius compensation: reflecting the path and its side gives the reflected compensated path.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// Something is in force. Asked in every block that moves.
inline bool program_mapped(const BlockContext& in) { return in.state.mapped; }

AxisVec to_program(const BlockContext& in, const AxisVec& work);
AxisVec from_program(const BlockContext& in, const AxisVec& programmed);
/// A point in workpiece coordinates as it is behind coordinate rotation and in front of mirror image: what the centre of G68 stays in.
AxisVec in_front_of_mirror(const BlockContext& in, const AxisVec& work);
/// A programmed coordinate of an axis that no rotation turns, scaled and mirrored; and the way back.
double mapped_on(const BlockContext& in, unsigned axis, double programmed);
double programmed_on(const BlockContext& in, unsigned axis, double work);
/// Factor of scaling of an axis, 1 where there is none; one of two axes of an arc is scaled, or both are.
double scale_of(const BlockContext& in, unsigned axis);
bool scaled_unevenly(const BlockContext& in, unsigned h, unsigned v);
/// Axes that move when `axes` are programmed: a rotated plane moves with both.
uint32_t moved_axes(const BlockContext& in, uint32_t axes);
/// A move of these axes begins: all that it moves, and what changes with it.
uint32_t begin_mapped_move(BlockContext& in, uint32_t commanded);
/// The increments of an arc's centre on the axes h, v, and its direction.
void map_arc(const BlockContext& in, unsigned h, unsigned v, double center[2], bool* ccw);
/// A mirrored path is compensated on its other side, and the vectors of G40 to G42 (I J K) turn with their blocks.
void map_compensation(const BlockContext& in, Compensation& comp);

/// Figure rotation: M98 with I J K begins it with the frame just entered, each further pass turns on.
void begin_figure(BlockContext& in, const double center[2]);
void turn_figure(BlockContext& in);
/// A coordinate behind the scaling that the rotated program itself has commanded.
double shape_scaled(const BlockContext& in, unsigned axis, double value);
inline bool in_figure(const BlockContext& in) { return in.state.frame[in.state.depth].figure != 0; }
inline void figure_has_moved(BlockContext& in) {
  uint8_t& figure = in.state.frame[in.state.depth].figure;
  if (figure != 0) figure = kFigureMoved;
}

}  // namespace nc
