// SPDX-License-Identifier: Apache-2.0
#include "offset/left_out.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "offset/walls.hpp"

namespace nc {
namespace {

/// The path of a block and what is inserted at the corner behind it.
struct Way {
  Piece pieces[ContourJoint::kMax];
  unsigned count = 0;
};

/// Has it a path with two vectors that are computed? Where the program gives one of them it is not checked (12.4.3).
bool has_path(const Chain& chain, unsigned i, const ChainStart& start) {
  const Section& section = chain[i];
  const bool given = section.commanded || (i == 0 ? start.commanded : chain[i - 1].commanded);
  return is_wall(section) && !given && section.jointed && !section.dead && !section.vanished && section.joint.n > 0;
}

Way way_of(const Chain& chain, unsigned i, Vec2 from_joint, const ChainStart& start) {
  const Section& section = chain[i];
  const Vec2 from = i == 0 ? start.vector : chain[i - 1].joint.v[chain[i - 1].joint.n - 1];
  Way way;
  way.pieces[way.count++] = path_of(section, from_joint, from, section.joint.v[0]);
  for (unsigned n = 1; n < section.joint.n; ++n) way.pieces[way.count++] = way_at(from_joint + section.delta, section.joint.v[n - 1], section.joint.v[n], section.joint.corner_arc, section.offset);
  return way;
}

/// The two blocks, on one level: of a path and of the wall.
bool enters(const Way& way, const Section& of_way, const Piece& wall, const Section& of_wall) {
  if (!on_one_level(of_way, of_wall)) return false;
  const double least = std::min(std::abs(of_way.offset), std::abs(of_wall.offset)) - kEnters_mm - slop_of(wall) - slop_of(wall_of(of_way, {}));
  return std::any_of(way.pieces, way.pieces + way.count, [&](const Piece& piece) { return comes_nearer(piece, wall, least); });
}

bool is_low_step(const Section& section) {
  const double length = section.begin.curvature != 0 ? std::abs(section.sweep / section.begin.curvature) : norm(section.delta);
  return length < std::abs(section.offset) - kOneLength_mm;
}

}  // namespace

bool cuts_into_left_out(const Chain& chain, unsigned front, const ChainStart& start) {
  const Section& first = chain[front];
  if (!is_wall(first)) return false;
  const bool goes = has_path(chain, front, start);
  const Piece wall = wall_of(first, {});
  Way way;
  if (goes) way = way_of(chain, front, {}, start);
  bool past = first.dead;  // something is left out, in front of the block that is asked about or with it
  Vec2 joint = first.delta;
  for (unsigned i = front + 1; i < chain.size(); ++i) {
    const Section& section = chain[i];
    if (!is_wall(section) || section.offset * first.offset < 0) return false;
    const Vec2 from = joint + section.approach;
    const bool beyond_step = i == front + 2 && (first.begin.curvature != 0 || section.begin.curvature != 0) && is_low_step(chain[front + 1]);
    past = past || section.dead;
    if (past || beyond_step) {
      const bool cuts = (goes && enters(way, first, wall_of(section, from), section)) || (has_path(chain, i, start) && enters(way_of(chain, i, from, start), section, wall, first));
      if (cuts && !closes(chain, front, chain.size() - 1)) return true;
    }
    joint = from + section.delta;
  }
  return false;
}

}  // namespace nc
