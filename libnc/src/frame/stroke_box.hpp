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
  bool way = false;                        ///< the way of a block is looked at (HX 15.5.3), and not its two ends (M700 15.7)
  bool outside = false;                    ///< it is what lies around the box that is prohibited (HX 15.5.3)

  bool unknown = false;                    ///< the check is in force and has no area yet: no way is known to be allowed (HX PI 148)

  bool limits_any() const { return axis[0] >= 0 || axis[1] >= 0 || axis[2] >= 0; }
  bool operator==(const StrokeBox& other) const {
    for (unsigned i = 0; i < kBasicAxes; ++i)
      if (axis[i] != other.axis[i] || turns[i] != other.turns[i] || low[i] != other.low[i] || high[i] != other.high[i]) return false;
    return outside == other.outside && way == other.way && unknown == other.unknown;
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
  /// A straight way enters the area, whose axes do not turn: the part of it that is between the two sides of each axis.
  bool meets(const AxisVec& from, const AxisVec& to) const {
    double enter = 0, leave = 1;
    bool any = false;
    for (unsigned i = 0; i < kBasicAxes; ++i) {
      if (axis[i] < 0) continue;
      any = true;
      const auto of = static_cast<unsigned>(axis[i]);
      const double at = from[of], way_of = to[of] - at;
      if (way_of == 0) {
        if (at < low[i] || at > high[i]) return false;
        continue;
      }
      const double first = (low[i] - at) / way_of, second = (high[i] - at) / way_of;
      enter = std::fmax(enter, std::fmin(first, second));
      leave = std::fmin(leave, std::fmax(first, second));
    }
    return any && enter <= leave;
  }
  bool any_turns() const { return turns[0] || turns[1] || turns[2]; }
  bool prohibits(const AxisVec& machine) const {
    return limits_any() && holds(machine) != outside;
  }
};

}  // namespace nc
