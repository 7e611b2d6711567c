// SPDX-License-Identifier: Apache-2.0
// The position that a display shows of a rotary axis whose position goes on counting over several turns (nc_position_shown). FeederInfo says
// which axes are shown within one turn.
#pragma once

#include <cmath>
#include <cstdint>

namespace nc::rt {

// Where bit `axis` of `one_turn` is set, the result is an angle with 0 <= angle < 360; otherwise it is the position itself.
inline double axis_shown(double position, std::uint32_t one_turn, unsigned axis) {
  constexpr double kNoise = 1e-9;  // deg: rounding errors of added positions; 359.9999999999 is shown as 0
  if (((one_turn >> axis) & 1) == 0) return position;
  const double left = position - 360 * std::floor(position / 360);
  return left >= 360 - kNoise ? 0 : left;
}

}  // namespace nc::rt
