// SPDX-License-Identifier: Apache-2.0
#include "filter/filter_parameters.hpp"

#include <algorithm>
#include <cmath>

namespace nc {

double filter_speed(const FilterTimes& times, unsigned axis, double acceleration, double cycle_s) {
  if (times.kind != FilterTimes::Kind::after || !(acceleration > 0)) return HUGE_VAL;
  // Behind the mean over T the acceleration of an axis is (v(t) - v(t - T)) / T, behind the lag it is (v - v') / tau: with speeds from -V to V at
  // most 2 V / T, with speeds from 0 to V at most V / T. The longer of the two times decides.
  const double longest = std::max(times.mean[axis] * cycle_s, static_cast<double>(times.lag_s[axis]));
  return acceleration * longest * (times.one_way ? 1.0 : 0.5);
}

}  // namespace nc
