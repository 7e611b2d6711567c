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

bool factor_of_word(double value, bool pointed, const RangeRules& range, double* factor) {
  constexpr double kUnit = 1e-6, kNoise = 1e-12;
  *factor = pointed ? value : value * kUnit;
  return *factor >= range.least_scale - kNoise && *factor <= range.most_scale + kNoise;
}

}  // namespace nc::m700
