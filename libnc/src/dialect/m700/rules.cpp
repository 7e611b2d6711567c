// SPDX-License-Identifier: Apache-2.0
// Those rules of the m700 family that are functions.
#include "dialect/m700/rules.hpp"

namespace nc::m700 {

double units_per_micrometre(double parameter) {
  double finer = 1;
  for (int letter = 'B'; letter < parameter && letter < 'E'; ++letter) finer *= 10;
  return finer;
}

double speed_of_word(uint32_t value) { return value; }

bool factor_of_word(double value, bool pointed, double* factor) {
  constexpr double kUnit = 1e-6, kLeast = 1e-6, kLargest = 99.999999, kNoise = 1e-12;
  *factor = pointed ? value : value * kUnit;
  return *factor >= kLeast - kNoise && *factor <= kLargest + kNoise;
}

}  // namespace nc::m700
