// SPDX-License-Identifier: Apache-2.0
// The path of the centre of a cutter that mills a cavity at one depth, seen from the centre of the cavity: rings from the inside to the wall, each as
// far from the one before as the step says (Series 8 G34 to G36, docs/series8.md).
#pragma once

#include <cstdint>

namespace nc {

struct Cavity {
  bool circle = false, ccw = true;
  double half[2] = {0, 0};  ///< of the outermost path, mm; of a circle the first is its radius
  double corner = 0;        ///< radius of the corners of the outermost path, mm; of a path inside it is smaller by what lies between the two, and at least 0
  uint32_t rings = 0;       ///< number 0 is what is left between two long walls: a line, or nothing
};

/// A line, or an arc about `center`.
struct CavityPiece {
  bool arc = false, ccw = false;
  double to[2] = {0, 0}, center[2] = {0, 0};
};

/// Where rings with sharp corners are farther from each other than this, a post stays in the corner: the cutter inside reaches its own radius along the
/// diagonal, the cutter outside its radius from the sides.
double widest_step_round_corners(double cutter);
/// Rings of a step that is not larger than `step` > 0.
uint32_t rings_of_cavity(const Cavity& cavity, double step);
/// Piece `number`, from 0, of a ring. False: the ring is done. A piece may have no length.
bool piece_of_cavity(const Cavity& cavity, uint32_t ring, unsigned number, CavityPiece* piece);

}  // namespace nc
