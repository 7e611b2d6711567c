// SPDX-License-Identifier: Apache-2.0
// Those rules of the Series 8 that are functions.
#include "dialect/series8/rules.hpp"

namespace nc::series8 {

double units_per_micrometre(double /*parameter*/) { return 1; }

double speed_of_word(uint32_t value) { return value; }

bool factor_of_word(double value, bool /*pointed*/, const RangeRules& range, double* factor) {
  *factor = value;
  return value >= range.least_scale && value <= range.most_scale;
}

}  // namespace nc::series8
