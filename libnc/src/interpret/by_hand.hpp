// SPDX-License-Identifier: Apache-2.0
// Axes that were moved by hand in a block stop, with manual absolute on (M700 12.4.4): what a block says by the end of the block before (a direction of G45 to
// G48, a line by its angle) counts from the programmed end, and not from where the hand has led the axes, so that "the tool returns to its original path at the
// end point of the block". With manual absolute off the coordinate systems are moved along, and there is nothing to know.
#pragma once

#include "interpret/block_in_hand.hpp"

namespace nc {

/// The axes stand this far (compensation frame) beside the programmed end of the newest block, in addition to what is known already.
void note_way_by_hand(InForce& in, const AxisVec& beside);
/// How far they stand beside it, in programmed coordinates.
AxisVec way_by_hand(const BlockInHand& in);
/// A movement has begun. An axis that is led to a place stands where the program says; in increments, or without a word, it stays as far beside as it is.
void end_way_by_hand(BlockInHand& in, const AxisVec& start, const AxisVec& target);
/// These axes stand where the program says.
void forget_way_by_hand(InForce& in, uint32_t axes);

}  // namespace nc
