// SPDX-License-Identifier: Apache-2.0
// Patterns of holes: where each hole of a circle, a line, an arc or a grid lies (M700 13.2), or of a frame (Series 8 G49, G50).
#pragma once

#include <cstdint>

namespace nc {

enum class PatternKind : uint8_t { none, circle, line, arc, grid, frame_ccw, frame_cw };

/// Lengths in mm, angles in degrees, counter-clockwise positive.
struct HolePattern {
  PatternKind kind = PatternKind::none;
  uint32_t columns = 0, rows = 1;   ///< number of holes; a grid alone has several rows
  double interval = 0;              ///< between two holes, or the radius
  double interval_2 = 0;            ///< between two rows
  double angle = 0;                 ///< of the line, or of the first hole
  double step = 0;                  ///< of circle and arc, from one hole to the next
  bool closed = false;              ///< a frame: its first place is its last one as well
  bool operator==(const HolePattern&) const = default;
  bool is_frame() const { return kind == PatternKind::frame_ccw || kind == PatternKind::frame_cw; }
  uint32_t count() const {
    if (!is_frame()) return columns * rows;
    return 2 * (columns - 1) + 2 * (rows - 1) + (closed ? 1u : 0u);
  }
};

/// A frame: `columns` places along the first axis, `rows` along the second one, two of each at least; `interval` and `interval_2` are the lengths of its
/// sides. It is gone round from the reference point, which is its corner.
/// Hole number `index`, from 0, along the first and the second axis of the plane, seen from the reference point. A grid is gone through to and
/// fro.
void place_of_hole(const HolePattern& pattern, uint32_t index, double place[2]);

}  // namespace nc
