// SPDX-License-Identifier: Apache-2.0
// Moves that the time-optimal mode does not make, and the alarm that says so before such a move begins.
#pragma once

#include "alarm/condition.hpp"
#include "path/shape.hpp"
#include "ring/record.hpp"

namespace nc {

struct OptimalMode {
  static bool moves(const Segment& s) { return !stands(s.curve); }
  /// A line on which only axes that G07 holds are commanded (M700 6.16): no axis moves, so there is no way that a time law could be planned for.
  static bool stands(const Curve& curve) {
    if (curve.shape == nullptr || curve.shape->what.map.frozen == 0) return false;
    if (curve.shape->what.kind != ShapeKind::plain || curve.shape->base.circular) return false;
    for (unsigned i = 0; i < kMaxAxes; ++i)
      if (curve.delta[i] != 0) return false;
    return true;
  }
  static Fault refusal() {
    Fault fault;
    fault.condition = Condition::not_accepted;
    return fault;
  }
};

}  // namespace nc
