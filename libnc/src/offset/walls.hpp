// SPDX-License-Identifier: Apache-2.0
// Pieces of a path and of the programmed contour, and how near they come to each other. Vectors that do not cross (M700 12.4.8) do not tell: an arc
// may bend round the tip of a vector, and a block of a nanometre has vectors beside each other.
#pragma once

#include "offset/box_row.hpp"
#include "offset/interference.hpp"

namespace nc {

/// A piece of a path or of the programmed contour: a line, or an arc about `center` whose radius may change evenly along its angle.
struct Piece {
  Vec2 from, to;
  bool round = false;
  Vec2 center;
  double radius = 0, radius_end = 0;
  double sweep = 0;  ///< rad, counter-clockwise positive
};

/// The programmed geometry of a section that starts at this point.
Piece wall_of(const Section& section, Vec2 start);
/// The tool's path along it, with these vectors at its ends.
Piece path_of(const Section& section, Vec2 start, Vec2 from, Vec2 to);
/// Does an arc about the corner (G39) lead from one vector to the other? Else it is a line.
bool bendable(Vec2 from, Vec2 to);
/// Its angle, counter-clockwise positive: the shorter way, and half a turn round the outside of what is compensated by this amount.
double corner_sweep(Vec2 from, Vec2 to, double offset);
/// An arc about `center` from one vector to the other.
Piece arc_about(Vec2 center, Vec2 from, Vec2 to, double offset);

/// The way from one vector to another at the programmed point: a line, or where it may bend (G39) and the vectors allow it an arc.
Piece way_at(Vec2 point, Vec2 from, Vec2 to, bool bends, double offset);

/// What it lies in.
Box box_of(const Piece& piece);

/// Ends of a wall whose distance is not asked for: where the tool comes to the contour or leaves it. Of the way there cuts_end() is asked.
struct OpenEnds {
  bool from = false, to = false;
};
/// A way to such an end (`comes`), or from it.
struct WayPast {
  const Piece& path;
  bool comes = false;
  double amount = 0, margin = 0;
};
/// Does it come nearer to that end than `amount`, and than the place beside the wall where it ends or begins, by more than `margin`? Straight on along the wall it may, where it leads
/// on by the tool's diameter: a shorter way sinks into the wall more than it leaves it.
bool cuts_end(const WayPast& way, const Piece& wall, OpenEnds open);
/// Does the one lead on into the other, without a corner?
bool goes_straight_on(const Piece& before, const Piece& behind);
/// Does a block lie along the wall from its start to its end, in the same direction?
bool lies_along(const Piece& block, const Piece& wall);
/// Shortest distance of two pieces, 0 where they cross. An arc counts with the mean of its radii.
double distance(const Piece& path, const Piece& wall, OpenEnds open = {});
/// Whether they come nearer to each other than `least`, also where radii change, to a tenth of a micrometre.
bool comes_nearer(const Piece& path, const Piece& wall, double least, OpenEnds open = {});

/// The amount along a block, at its start and at its end: it changes evenly in a block with another offset number (M700 12.4.6).
struct Amount {
  double start = 0, end = 0;
};
/// Whether they come nearer to each other than the smaller one of the two amounts less `margin`, each at its place, to a tenth of a micrometre.
bool comes_nearer(const Piece& path, Amount of_path, const Piece& wall, Amount of_wall, double margin, OpenEnds open = {});

/// Between the two radii of an arc (#1084) it is not said where its circle is. The path between them may lie by so much nearer than the radius.
inline double slop_of(const Piece& wall) { return 0.1 * std::abs(wall.radius - wall.radius_end); }

/// A contour that comes back to a point this near has closed there,
inline constexpr double kCloses_mm = 1e-3 + kOneLength_mm;
/// once it has been this far away.
inline constexpr double kAway_mm = 0.01 + kOneLength_mm;
/// Levels that differ by less are one; so are distances from a wall.
inline constexpr double kLevel_mm = 1e-3 + kOneLength_mm;

/// Does it cut along its offset curve?
inline bool is_wall(const Section& section) { return !section.start && !section.cancel && section.cuts && section.offset != 0; }
/// Is some of the one as deep as some of the other?
bool on_one_level(const Section& a, const Section& b);
/// Does the contour, from the start of section `first` on, come back to one of its joints before section `last` ends?
bool closes(const Chain& chain, unsigned first, unsigned last);

/// Which part of a piece, from its start on (or from its end back), comes no farther away from the other than `clear` without a gap? 0: none of it, 1: all.
double stretch_beside(const Piece& piece, bool from_start, const Piece& other, double clear);
/// What is left of a piece behind this part of it, or in front of it.
Piece without_stretch(const Piece& piece, bool from_start, double part);

/// By how much a path may come nearer than the radius: rounding, and the micrometre that a vector may be off where an arc ends beside its circle.
inline constexpr double kEnters_mm = 1e-3 + kOneLength_mm;
/// The same of words in inch, the last of whose four digits is 2.54 um.
inline double enters_of(bool inch) { return inch ? 2.54 * kEnters_mm : kEnters_mm; }

}  // namespace nc
