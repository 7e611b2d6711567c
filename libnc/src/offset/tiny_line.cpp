// SPDX-License-Identifier: Apache-2.0
#include "offset/tiny_line.hpp"

#include <cmath>

#include "offset/walls.hpp"

namespace nc {
namespace {

/// Longer lines have a direction: the digits of their words turn it by less than what matters.
constexpr double kTiny_mm = 0.1 + kOneLength_mm;
/// Less than this is no way aside that a digit has made, but a turn: the sine of its angle.
constexpr double kAside = 0.005;

/// Along this direction, aside from it by no more than a digit.
bool goes_along(const Section& line, Vec2 way) { return dot(way, line.delta) > kOneLength_mm && std::abs(cross(way, line.delta)) <= unsure_of(line.inch); }

}  // namespace

bool may_be_part(const Section& before, const Section& line) {
  if (line.begin.curvature != 0 || dot(line.delta, line.delta) > kTiny_mm * kTiny_mm) return false;
  return std::abs(cross(before.end.u, line.begin.u)) > kAside && goes_along(line, before.end.u);
}

bool is_part(const Section& before, const Section& line, const Section& behind) {
  const double aside = cross(before.end.u, line.begin.u), back = cross(line.begin.u, behind.begin.u);
  if (aside * back >= 0 || std::abs(back) <= kAside || !goes_along(line, behind.begin.u)) return false;
  Piece way;
  way.from = perpendicular(before.end, before.offset);
  way.to = line.delta + perpendicular(behind.begin, behind.offset);
  const double least = std::abs(line.offset) - enters_of(line.inch);
  return !comes_nearer(way, wall_of(before, -1 * before.delta), least) && !comes_nearer(way, wall_of(line, {}), least) && !comes_nearer(way, wall_of(behind, line.delta), least);
}

}  // namespace nc
