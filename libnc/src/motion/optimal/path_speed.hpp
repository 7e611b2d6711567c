// SPDX-License-Identifier: Apache-2.0
// About how fast cubic pieces can be gone: to compare one path with another, and to know where on it time is lost. It is no law and keeps no
// limit exactly.
#pragma once

#include "motion/optimal/piece.hpp"
#include "motion/optimal/work.hpp"

namespace nc::optimal {

/// Of one piece.
struct PieceSpeed {
  double speed = 0;                   ///< by u
  double acceleration = 0, jerk = 0;  ///< that the axes have along it
};

/// The speed on each of the pieces is at first that at which its bends and its feed, `turns` times that of the piece, let it be gone, and then no
/// more than a pass forward and one backward reach, with the acceleration growing by the jerk. @return seconds
Task<double> path_speeds(Work& work, const Piece* pieces, unsigned count, const Limits& limits, double turns, PieceSpeed* out);

}  // namespace nc::optimal
