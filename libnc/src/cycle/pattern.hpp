// SPDX-License-Identifier: Apache-2.0
// Patterns of holes (M700 13.2): where each hole of a circle, a line, an arc or a grid lies.
#pragma once

#include <cstdint>

namespace nc {

enum class PatternKind : uint8_t { none, circle, line, arc, grid };

/// Lengths in mm, angles in degrees, counter-clockwise positive.
struct HolePattern {
  PatternKind kind = PatternKind::none;
  uint32_t columns = 0, rows = 1;   ///< number of holes; a grid alone has several rows
  double interval = 0;              ///< between two holes, or the radius
  double interval_2 = 0;            ///< between two rows
  double angle = 0;                 ///< of the line, or of the first hole
  double step = 0;                  ///< of circle and arc, from one hole to the next
  uint32_t count() const { return columns * rows; }
};

/// Hole number `index`, from 0, along the first and the second axis of the plane, seen from the reference point. A grid is gone through to and
/// fro.
void place_of_hole(const HolePattern& pattern, uint32_t index, double place[2]);

}  // namespace nc
