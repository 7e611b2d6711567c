// SPDX-License-Identifier: Apache-2.0
// Rotary axes (M700 14.13, #8213). Inside the control the angle of such an axis is counted on over several turns, like the position of any other axis, so
// that curves, set-points and limits need no rules of their own. Its type says what the counters show and which way an absolute command goes:
//
//   type                        shown (workpiece / machine)   G90 goes by                                     G91
//   0 rotating, no short cut    one turn / one turn           target - shown, whole turns left out            the amount
//   1 rotating, short cut       one turn / one turn           the shorter way, 180 deg: the plus direction    the amount
//   2 workpiece linear          any / one turn                target - shown                                  the amount
//   3 all linear                any / any                     target - shown                                  the amount
//
// From the intermediate point to a reference position types 0 to 2 turn by less than 360 deg.
#pragma once

#include <cmath>

namespace nc {

/// 0 <= angle < 360.
inline double within_one_turn(double angle) {
  constexpr double kNoise = 1e-9;  // deg, for rounding: 359.9999999999 counts as 0
  const double left = angle - 360 * std::floor(angle / 360);
  return left >= 360 - kNoise ? 0 : left;
}

/// The way, deg, of a rotating axis (types 0 and 1) from the angle `shown` to `target`.
inline double turn_to(double target, double shown, bool short_cut) {
  const double way = std::fmod(target - shown, 360);
  if (!short_cut) return way;
  return way > 180 ? way - 360 : way <= -180 ? way + 360 : way;
}

/// For an axis whose machine position is counted within one turn, the limits `low` and `high` hold in each turn. Returns by how many turns they have to
/// be shifted to be those of the turn in which `from` is.
inline double turns_outside(double from, double low, double high) {
  const double turns = std::floor((from - low) / 360);
  return from - 360 * turns <= high ? turns : std::floor(from / 360);
}

}  // namespace nc
