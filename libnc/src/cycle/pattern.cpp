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

/// Along the four sides: `first` places on a side of the length `a`, then `second` on one of the length `b`, and back.
void on_frame(uint32_t index, uint32_t first, uint32_t second, double a, double b, double* along, double* across) {
  const uint32_t steps[4] = {first - 1, second - 1, first - 1, second - 1};
  index %= steps[0] + steps[1] + steps[2] + steps[3];
  unsigned side = 0;
  while (index >= steps[side]) index -= steps[side++];
  const double part = static_cast<double>(index) / steps[side];
  *along = side == 0 ? a * part : side == 1 ? a : side == 2 ? a * (1 - part) : 0;
  *across = side == 0 ? 0 : side == 1 ? b * part : side == 2 ? b : b * (1 - part);
}

}  // namespace

void place_of_hole(const HolePattern& p, uint32_t index, double place[2]) {
  switch (p.kind) {
    case PatternKind::none: place[0] = place[1] = 0; return;
    case PatternKind::circle: return on_circle(p.interval, p.angle + 360.0 * index / p.columns * (p.step < 0 ? -1 : 1), place);
    case PatternKind::line: return on_circle(p.interval * index, p.angle, place);
    case PatternKind::arc: return on_circle(p.interval, p.angle + p.step * index, place);
    case PatternKind::frame_ccw: return on_frame(index, p.columns, p.rows, p.interval, p.interval_2, &place[0], &place[1]);
    case PatternKind::frame_cw: return on_frame(index, p.rows, p.columns, p.interval_2, p.interval, &place[1], &place[0]);
    case PatternKind::grid: break;
  }
  const uint32_t row = index / p.columns, column = index % p.columns;
  place[0] = p.interval * (row % 2 == 0 ? column : p.columns - 1 - column);
  place[1] = p.interval_2 * row;
}

}  // namespace nc
