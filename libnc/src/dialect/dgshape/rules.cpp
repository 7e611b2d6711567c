// SPDX-License-Identifier: Apache-2.0
// Those rules of the dgshape family that are functions.
#include "dialect/dgshape/rules.hpp"

#include <cmath>

namespace nc::dgshape {

double units_per_micrometre(double /*parameter*/) { return 1; }

// The code n stands for 10^(n/20), with the rounded factors of the series.
double speed_of_word(uint32_t value) {
  static constexpr double kFactor[20] = {1,    1.12, 1.25, 1.4, 1.6, 1.8, 2,   2.24, 2.5, 2.8,
                                        3.15, 3.55, 4, 4.5, 5, 5.6, 6.3, 7.1, 8, 9};
  if (value >= 100) return value;
  double decade = 1;
  for (uint32_t i = 0; i < value / 20; ++i) decade *= 10;
  return kFactor[value % 20] * decade;
}

bool factor_of_word(double value, bool /*pointed*/, const RangeRules& range, double* factor) {
  *factor = std::fmin(std::fmax(value, range.least_scale), range.most_scale);
  return true;
}

}  // namespace nc::dgshape
