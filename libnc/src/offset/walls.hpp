// SPDX-License-Identifier: Apache-2.0
// Does the path of the tool come nearer than the radius to the blocks before and behind its own? Vectors that do not cross (M700 12.4.8) do not
// tell: an arc may bend round the tip of a vector, and a block of a nanometre has vectors beside each other. That is asked where the machine's
// option says so: the blocks around have to be the walls of a part. A way in and out on an arc is none, and the path crosses it.
#pragma once

#include "offset/interference.hpp"

namespace nc {

/// A piece of a path or of the programmed contour: a line, or an arc about `center`.
struct Piece {
  Vec2 from, to;
  bool round = false;
  Vec2 center;
  double radius = 0;
  double sweep = 0;  ///< rad, counter-clockwise positive
};

/// The programmed geometry of a section that starts at this point. An arc whose radii differ is none: its curve is not looked at.
bool wall_of(const Section& section, Vec2 start, Piece* wall);
/// The tool's path along it, with these vectors at its ends.
bool path_of(const Section& section, Vec2 start, Vec2 from, Vec2 to, Piece* path);

/// Shortest distance of two pieces, 0 where they cross.
double distance(const Piece& a, const Piece& b);

/// A block that is done, as far as the path of those behind it has to keep away from it.
struct Wall {
  Piece piece;        ///< seen from the end of the last block that is done
  double offset = 0;  ///< signed, mm; 0 = it is none
};

/// By how much a path may come nearer than the radius: rounding, and the micrometre that a vector may be off where an arc ends beside its circle.
inline constexpr double kEnters_mm = 1e-3;

}  // namespace nc
