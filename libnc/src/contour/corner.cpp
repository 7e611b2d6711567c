// SPDX-License-Identifier: Apache-2.0
#include "contour/corner.hpp"

#include <cmath>

#include "alarm/condition.hpp"

namespace nc {
namespace {

/// 1 + cosine of a turn that is a way back: no circle touches both lines.
constexpr double kWayBack = 1e-12;

}  // namespace

double corner_travel(const Move& line, const Move& first, uint32_t rotary, unsigned axis_count) {
  double squares = 0;
  for (unsigned i = 0; i < axis_count; ++i) {
    const bool counts = first.corner == Corner::chamfer ? (rotary >> i & 1) == 0 : i == first.plane_axis[0] || i == first.plane_axis[1];
    if (counts) squares += (line.end[i] - line.start[i]) * (line.end[i] - line.start[i]);
  }
  return std::sqrt(squares);
}

Condition cut_corner(const Move& first, const Move& next, uint32_t rotary, unsigned axis_count, CornerCut* cut) {
  *cut = {};
  const double amount = first.corner_mm;
  const double length = corner_travel(first, first, rotary, axis_count), length_next = corner_travel(next, first, rotary, axis_count);
  // M700 13.7.2 (5): a rounding is compared by its radius, whatever it takes of the lines.
  if (length < amount - kCornerSlack_mm) return Condition::corner_short;
  if (length_next < amount - kCornerSlack_mm) return Condition::corner_next_short;
  double taken = amount;
  if (first.corner == Corner::rounding) {
    const unsigned h = first.plane_axis[0], v = first.plane_axis[1];
    const double u1[2] = {(first.end[h] - first.start[h]) / length, (first.end[v] - first.start[v]) / length};
    const double u2[2] = {(next.end[h] - next.start[h]) / length_next, (next.end[v] - next.start[v]) / length_next};
    const double sine = u1[0] * u2[1] - u1[1] * u2[0], cosine = u1[0] * u2[0] + u1[1] * u2[1];
    if (1 + cosine < kWayBack) return Condition::corner_reversal;
    taken = amount * std::fabs(sine) / (1 + cosine);  // tan(turn / 2) = sin / (1 + cos)
    if (taken < kCornerSlack_mm) return Condition::none;
    // Beyond a right angle it takes more than its radius: where there is not that much, there is no such arc.
    if (length < taken - kCornerSlack_mm) return Condition::corner_short;
    if (length_next < taken - kCornerSlack_mm) return Condition::corner_next_short;
    const double left = sine > 0 ? 1 : -1;
    Circle& circle = cut->circle;
    circle.radius_start = circle.radius_end = amount;
    circle.center[0] = first.end[h] - taken * u1[0] - left * amount * u1[1];
    circle.center[1] = first.end[v] - taken * u1[1] + left * amount * u1[0];
    circle.angle_start = std::atan2(-left * u1[0], left * u1[1]);
    circle.sweep = std::atan2(sine, cosine);
    cut->round = true;
  }
  cut->any = true;
  for (unsigned i = 0; i < axis_count; ++i) {
    cut->lead[i] = (next.end[i] - next.start[i]) * (taken / length_next);
    cut->before[i] = first.end[i] - (first.end[i] - first.start[i]) * (taken / length);
    cut->behind[i] = first.end[i] + cut->lead[i];
  }
  return Condition::none;
}

}  // namespace nc
