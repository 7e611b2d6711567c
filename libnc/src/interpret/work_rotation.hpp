// SPDX-License-Identifier: Apache-2.0
// Rotation of the workpiece coordinate systems by parameter (M700 13.21): all of them are rotated about a point of the machine, because the workpiece is
// clamped askew. It is the last map before the active workpiece coordinates (interpret/program_map.hpp). These themselves are not rotated, and neither is
// what the counters show (13.21 (3)):
//
//     work = turned(p + zero about C, by t) - zero      C #8623, #8624, machine coordinates; t #8627
//
// G10 changes the rotation at once, but the axes stay where they are until they are next commanded. Until then the programmed position follows from the
// previous rotation: an increment counts from there and ends in the new rotation, so that a rotation is cancelled by the next move in G91 as well as in
// G90 (precaution (1)). For that the rotation that is commanded and the one that the axes have reached are kept apart.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// Takes the rotation over from the parameters. `at_head`: at the beginning of a program the axes count as having reached it: increments count from where
/// they stand.
void take_work_rotation(InForce& in, bool at_head);

/// Sets the members of the state that follow from the records, after a state has been put back.
void refresh_work_rotation(InForce& in);

/// The map of a rotation, in workpiece coordinates.
Affine work_rotation(const InForce& in, const WorkTurn& turn);

/// The axes that move when `axes` are programmed.
uint32_t moved_by_work_rotation(const InForce& in, uint32_t axes);
/// These axes are commanded, so that they reach the rotation.
void work_rotation_reached(InForce& in, uint32_t commanded);

/// The rotation tilts the plane (h, v): it rotates one of the two axes out of it.
bool tilts_plane(const InForce& in, unsigned h, unsigned v);
/// The axis is one of the two that the rotation concerns.
bool turns_axis(const InForce& in, unsigned axis);
/// Checks the rules for a block that moves; a curve may not be the first move after a change of the rotation (precaution (2)).
Execution check_work_rotation(BlockInHand& in);

}  // namespace nc
