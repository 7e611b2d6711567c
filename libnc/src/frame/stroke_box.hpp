// SPDX-License-Identifier: Apache-2.0
// Stroke check before travel (M700 15.7): the area that G22 prohibits, in machine coordinates.
#pragma once

#include <cmath>

#include "stream/stream.hpp"

namespace nc {

struct StrokeBox {
  static constexpr unsigned kBasicAxes = 3;
  int8_t axis[kBasicAxes] = {-1, -1, -1};  ///< index of the axis; -1: not checked, because its two coordinates are the same
  bool turns[kBasicAxes] = {};             ///< the position of the axis is shown within one turn (14.13): the area is converted as a command is
  double low[kBasicAxes] = {}, high[kBasicAxes] = {};
  bool outside = false;                    ///< it is what lies around the box that is prohibited (HX 15.5.3)

  bool operator==(const StrokeBox& other) const {
    for (unsigned i = 0; i < kBasicAxes; ++i)
      if (axis[i] != other.axis[i] || turns[i] != other.turns[i] || low[i] != other.low[i] || high[i] != other.high[i]) return false;
    return outside == other.outside;
  }

  /// The position is in the area. The border belongs to the area: 15.7 (8) prints 45 <= Z <= 315.
  bool holds(const AxisVec& machine) const {
    bool any = false;
    for (unsigned i = 0; i < kBasicAxes; ++i) {
      if (axis[i] < 0) continue;
      any = true;
      const double at = machine[static_cast<unsigned>(axis[i])];
      // For an axis that turns: the lowest angle that is the same place as `at` and not below the area.
      const double here = turns[i] ? low[i] + (at - low[i]) - 360 * std::floor((at - low[i]) / 360) : at;
      if (here < low[i] || here > high[i]) return false;
    }
    return any;
  }
  bool prohibits(const AxisVec& machine) const {
    bool any = false;
    for (const int8_t of : axis) any = any || of >= 0;
    return any && holds(machine) != outside;
  }
};

}  // namespace nc
