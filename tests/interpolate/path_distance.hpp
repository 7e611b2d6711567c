// SPDX-License-Identifier: Apache-2.0
// Distance of a point from a curve.
#pragma once

#include <algorithm>
#include <cmath>

#include "path/curve.hpp"

namespace nc::test {

/// By a search along the curve.
inline double distance_to(const Curve& c, const AxisVec& p, unsigned axes) {
  const auto off = [&](double s) {
    const AxisVec q = curve_position(c, s, axes);
    double sum = 0;
    for (unsigned i = 0; i < axes; ++i) sum += (q[i] - p[i]) * (q[i] - p[i]);
    return std::sqrt(sum);
  };
  if (!c.circular && c.shape == nullptr) {
    double along = 0, length2 = 0;
    for (unsigned i = 0; i < axes; ++i) along += (p[i] - c.start[i]) * c.delta[i], length2 += c.delta[i] * c.delta[i];
    return off(std::clamp(along / length2, 0.0, 1.0) * c.length);
  }
  constexpr int kPlaces = 64;
  const double step = c.length / kPlaces;
  double at[kPlaces + 1], least = HUGE_VAL;
  for (int n = 0; n <= kPlaces; ++n) least = std::min(least, at[n] = off(step * n));
  const double coarse = least;
  for (int n = 0; n <= kPlaces; ++n) {
    if (at[n] > coarse + step) continue;
    double low = step * std::max(0, n - 1), high = step * std::min(kPlaces, n + 1);
    for (int k = 0; k < 60; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (off(a) < off(b)) {
        high = b;
      } else {
        low = a;
      }
    }
    least = std::min(least, off(0.5 * (low + high)));
  }
  return least;
}

}  // namespace nc::test
