// SPDX-License-Identifier: Apache-2.0
// The map from programmed points to the active workpiece coordinates: figure rotation (M700 13.3.3), scaling (13.19), coordinate rotation (13.20: it
// rotates the centre of scaling, too), then mirror image by program (13.6) and by switch, and the rotation by parameter (13.21,
// interpret/work_rotation.hpp). Scaling and mirror image that a rotated program itself commands come before its rotation (13.19 (6)). Together they are
// one affine map (frame/affine.hpp), which comes before tool radius compensation: reflecting the path and its side gives the reflected compensated
// path.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// One of these maps is in force. It is asked in every block that moves.
inline bool program_mapped(const InForce& in) { return in.state.mapped; }

AxisVec to_program(const BlockInHand& in, const AxisVec& work);
AxisVec from_program(const BlockInHand& in, const AxisVec& programmed);
/// to_program() of a place that is not where the program stands.
AxisVec as_programmed_end(const BlockInHand& in, const AxisVec& work);
/// A point in workpiece coordinates, in the coordinates after coordinate rotation and before mirror image: in these the centre of G68 is given.
AxisVec in_front_of_mirror(const BlockInHand& in, const AxisVec& work);
/// The programmed coordinate of an axis that no rotation concerns, scaled and mirrored; and the way back.
double mapped_on(const BlockInHand& in, unsigned axis, double programmed);
double programmed_on(const BlockInHand& in, unsigned axis, double work);
/// Scaling factor of an axis, 1 where there is none.
double scale_of(const InForce& in, unsigned axis);
/// Only one of two axes of an arc is scaled.
bool scaled_unevenly(const InForce& in, unsigned h, unsigned v);
/// The axes that move when `axes` are programmed: of a rotated plane both do.
uint32_t moved_axes(const InForce& in, uint32_t axes);
/// A move that commands these axes begins: makes the changes that come with it, and returns all axes that it moves.
uint32_t begin_mapped_move(InForce& in, uint32_t commanded);
/// Maps the increments of an arc's centre on the axes h and v, and its direction.
void map_arc(const BlockInHand& in, unsigned h, unsigned v, double center[2], bool* ccw);
/// Maps compensation: a mirrored path is compensated on its other side, and the vectors of G40 to G42 (I J K) are rotated with their blocks.
void map_compensation(const BlockInHand& in, Compensation& comp);

/// Figure rotation: M98 with I J K begins it, with the frame just entered; turn_figure() rotates on for each further pass.
void begin_figure(BlockInHand& in, const double center[2]);
void turn_figure(BlockInHand& in);
/// A coordinate after the scaling that the rotated program itself has commanded.
double shape_scaled(const InForce& in, unsigned axis, double value);
inline bool in_figure(const InForce& in) { return in.state.frame[in.state.depth].figure != 0; }
inline void figure_has_moved(InForce& in) {
  uint8_t& figure = in.state.frame[in.state.depth].figure;
  if (figure != 0) figure = kFigureMoved;
}

}  // namespace nc
