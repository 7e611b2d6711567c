// SPDX-License-Identifier: Apache-2.0
// Rotation of the workpiece coordinate systems by parameter (M700 13.21): all of them turn about a point of
// the machine, because the workpiece is clamped askew. It is the last map in front of the active workpiece
// coordinates (interpret/program_map.hpp), which do not turn themselves, and neither does what counters show
// (13.21 (3)):
//
//     work = turned(p + zero about C, by t) - zero      C #8623, #8624, machine coordinates; t #8627
//
// G10 changes it at once, but the axes stand where they are until they are next commanded. Until then the
// programmed position is what the rotation of before makes of it: an increment counts from there and ends in
// the new rotation, and so a rotation is cancelled by the next move in G91 as well as in G90 (precaution (1)).
// The rotation as commanded and the one that the axes have reached are kept apart for that.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// Takes the rotation over from the parameters. `at_head` of a program the axes are in it already: increments
/// count from where they stand.
void take_work_rotation(BlockContext& in, bool at_head);

/// What the state says of it is made again from the records, which outlive a state that is put back.
void refresh_work_rotation(BlockContext& in);

/// The map of a rotation, in workpiece coordinates.
Affine work_rotation(const BlockContext& in, const WorkTurn& turn);

/// Axes that move when `axes` are programmed.
uint32_t moved_by_work_rotation(const BlockContext& in, uint32_t axes);
/// These axes are commanded: they go into the rotation.
void work_rotation_reached(BlockContext& in, uint32_t commanded);

/// The rotation tilts the plane (h, v): it turns one of the two axes out of it.
bool tilts_plane(const BlockContext& in, unsigned h, unsigned v);
/// The rotation turns this axis towards another one.
bool turns_axis(const BlockContext& in, unsigned axis);
/// What a block that moves must observe; curves may not be the first move behind a change (precaution (2)).
Execution check_work_rotation(BlockContext& in);

}  // namespace nc
