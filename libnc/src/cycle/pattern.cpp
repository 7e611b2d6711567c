// SPDX-License-Identifier: Apache-2.0
#include "cycle/pattern.hpp"

#include <cmath>
#include <numbers>

namespace nc {
namespace {

/// Whole quarters are exact, so that a hole on an axis lies on it.
void on_circle(double radius, double degrees, double place[2]) {
  const double turn = degrees - 360 * std::floor(degrees / 360), quarters = turn / 90;
  double c = std::cos(turn * std::numbers::pi / 180), s = std::sin(turn * std::numbers::pi / 180);
  if (quarters == std::floor(quarters)) {
    c = std::nearbyint(c);
    s = std::nearbyint(s);
  }
  place[0] = radius * c;
  place[1] = radius * s;
}

}  // namespace

void place_of_hole(const HolePattern& p, uint32_t index, double place[2]) {
  switch (p.kind) {
    case PatternKind::none: place[0] = place[1] = 0; return;
    case PatternKind::circle: return on_circle(p.interval, p.angle + 360.0 * index / p.columns * (p.step < 0 ? -1 : 1), place);
    case PatternKind::line: return on_circle(p.interval * index, p.angle, place);
    case PatternKind::arc: return on_circle(p.interval, p.angle + p.step * index, place);
    case PatternKind::grid: break;
  }
  const uint32_t row = index / p.columns, column = index % p.columns;
  place[0] = p.interval * (row % 2 == 0 ? column : p.columns - 1 - column);
  place[1] = p.interval_2 * row;
}

}  // namespace nc
