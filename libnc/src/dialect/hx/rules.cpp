// SPDX-License-Identifier: Apache-2.0
// The rules of the HX family that are functions.
#include "dialect/hx/rules.hpp"

#include <cmath>

namespace nc::hx {

double units_per_micrometre(double /*parameter*/) { return 1; }

double speed_of_word(uint32_t value) { return value; }

bool factor_of_word(double value, bool /*pointed*/, const RangeRules& range, double* factor) {
  constexpr double kNoise = 1e-12;
  *factor = value / 1000;
  const double size = std::fabs(*factor);
  return size >= range.least_scale - kNoise && size <= range.most_scale + kNoise;
}

uint32_t tool_program(double pi_105, double pi_106) {
  constexpr uint32_t kFirst = 9000, kLast = 9009;
  if (pi_106 == 1) {
    return pi_105 >= 0 && pi_105 <= kLast - kFirst ? kFirst + static_cast<uint32_t>(pi_105) : 0;
  }
  return pi_105 == 1 ? kFirst : 0;
}

}  // namespace nc::hx
