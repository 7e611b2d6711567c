// SPDX-License-Identifier: Apache-2.0
// What a display shows of an axis that counts on over its turns (nc_position_shown; FeederInfo has the axes).
#pragma once

#include <cmath>
#include <cstdint>

namespace nc::rt {

// Bit `axis` of `one_turn`: 0 <= angle < 360.
inline double axis_shown(double position, std::uint32_t one_turn, unsigned axis) {
  constexpr double kNoise = 1e-9;  // deg: what adding up leaves; 359.9999999999 is 0
  if (((one_turn >> axis) & 1) == 0) return position;
  const double left = position - 360 * std::floor(position / 360);
  return left >= 360 - kNoise ? 0 : left;
}

}  // namespace nc::rt
