// SPDX-License-Identifier: Apache-2.0
// What smooth() has made is near to its polyline and no more than that. Where it had to halve cells to be so, relax() moves the control points within
// the tolerance to where the path can be gone faster: its third derivative, which the limit of jerk makes slow, becomes as small as the tube lets
// it be (docs/motion-optimal.md, "Geometry").
#pragma once

#include "base/arena.hpp"
#include "motion/optimal/path_speed.hpp"
#include "motion/optimal/smooth.hpp"
#include "motion/optimal/tube_fit.hpp"

namespace nc::optimal {

/// What the path is gone by.
struct Relaxing {
  const Limits* limits = nullptr;
  double turns = 1;  ///< feeds of the pieces are multiplied by that: rev/s of the spindle where they go by its turns
};

/// Room for the work.
struct Relaxation {
  TubeFit fit;
  PieceSpeed* speed = nullptr;       ///< of each cell
  AxisVec* before = nullptr;         ///< control points, as they were in front of a round
  AxisVec kept[TubeFit::kControls];  ///< and those of one run
  PieceSpeed of_run[TubeFit::kControls + 3];

  /// nullptr where the arena only measures.
  static Relaxation* create(unsigned knots, Arena& arena) {
    Relaxation* const out = arena.make<Relaxation>();
    PieceSpeed* const speed = arena.make<PieceSpeed>(knots);
    AxisVec* const before = arena.make<AxisVec>(knots + 3);
    if (out != nullptr) out->speed = speed, out->before = before;
    return out;
  }
};

/// Moves control points of the first `to` of the `cells` pieces that smooth() has just made of the same request in the same room. Where these end the
/// path keeps its position, tangent and curvature. It stays within the tolerance. True where pieces have changed: these can be gone in less time, as
/// far as path_speeds() knows.
Task<bool> relax(Work& work, const SmoothRequest& request, const SmoothRoom& room, Relaxation* relaxation, Relaxing how, Piece* out,
                 unsigned cells, unsigned to);

}  // namespace nc::optimal
