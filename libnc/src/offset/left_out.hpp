// SPDX-License-Identifier: Apache-2.0
// What the avoidance of interference (M700 12.4.8, #8102) leaves out stays as it is: no block within the pre-read, be it in front of the new way or behind it, comes nearer than
// the amount to what has been left out, nor past it to a block beyond. The avoidance itself sees the two blocks that it joins and the one behind them; the vectors of
// blocks farther away need not cross, and the ends of these blocks are not known yet when it joins.
//
// So before a block is let go it is compared once more with all that have been read behind it: its path with their walls, and their paths with its wall. Besides, a block
// that bends passes another beyond a step lower than the tool without vectors that cross: two blocks with such a step between them are always compared where one of them
// is an arc.
//
// Where the contour closes within the pre-read, what is in front of that place may be a way in and what is behind it a way out, and these are no walls
// (docs/compensation.md).
#pragma once

#include "offset/interference.hpp"

namespace nc {

/// Does the path of the section at the front of the chain cut into the wall of one behind it, or a path there into its wall? Its vectors are settled; it begins with `start`.
bool cuts_into_left_out(const Chain& chain, unsigned front, const ChainStart& start);

}  // namespace nc
