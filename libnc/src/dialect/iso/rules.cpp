// SPDX-License-Identifier: Apache-2.0
// Those rules of the iso family that are functions.
#include "dialect/iso/rules.hpp"

namespace nc::iso {

double units_per_micrometre(double /*parameter*/) { return 1; }

double speed_of_word(uint32_t value) { return value; }

bool factor_of_word(double /*value*/, bool /*pointed*/, const RangeRules& /*range*/, double* factor) {
  *factor = 1;
  return false;
}

}  // namespace nc::iso
