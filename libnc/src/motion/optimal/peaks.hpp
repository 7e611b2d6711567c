// SPDX-License-Identifier: Apache-2.0
// The most that an acceleration comes to between two places at which it is looked at.
#pragma once

#include <cmath>
#include <initializer_list>

#include "nc/types.h"

namespace nc::optimal {

/// Acceleration and jerk of an axis.
struct Rates {
  double a = 0, j = 0;
};
/// Absolute values.
struct Peaks {
  double a = 0, j = 0;
};

/// Between two moments `t` seconds apart, where the acceleration is the cubic a(s), s from 0 to 1, that has its value and its jerk at both:
/// its derivative is the parabola j = p + q s + r s^2 with j(0), j(1) and the mean that leads from the one acceleration to the other.
inline Peaks peaks_between(const Rates& from, const Rates& to, double t) NC_RT {
  Peaks peaks{std::fmax(std::fabs(from.a), std::fabs(to.a)), std::fmax(std::fabs(from.j), std::fabs(to.j))};
  const double mean = (to.a - from.a) / t, p = from.j, r = 3 * (from.j + to.j) - 6 * mean, q = to.j - from.j - r;
  const double top = -q / (2 * r);
  if (top > 0 && top < 1) peaks.j = std::fmax(peaks.j, std::fabs(p + top * q / 2));
  const double root = q * q - 4 * p * r;
  if (!(root >= 0)) return peaks;
  const double sum = -0.5 * (q + std::copysign(std::sqrt(root), q));
  for (const double s : {sum / r, p / sum})
    if (s > 0 && s < 1) peaks.a = std::fmax(peaks.a, std::fabs(from.a + t * s * (p + s * (q / 2 + s * r / 3))));
  return peaks;
}

}  // namespace nc::optimal
