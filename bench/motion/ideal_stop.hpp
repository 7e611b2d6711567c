// SPDX-License-Identifier: Apache-2.0
// The stop that a hold is compared with, by bench/motion/holds and by tests/interpolate/planned_hold_test.cpp: from the positions of the last three
// cycles, straight on along the tangent of the path, as fast as the limits of the axes allow. It shares no code with the control.
#pragma once

#include <algorithm>
#include <cmath>

namespace nc::ideal {

/// The shortest time in which speed v and acceleration a come to 0, wherever that is: the acceleration goes with the full jerk to a peak,
/// stays there for a while if the peak is its limit, `most`, and goes back to 0 with the full jerk.
inline double to_rest(double v, double a, double most, double jerk) {
  const double sign = v + a * std::fabs(a) / (2 * jerk) > 0 ? -1 : 1, from = sign * a, change = -sign * v;  // the speed that is to be gained
  double peak = std::sqrt(std::max(0.0, jerk * change + 0.5 * from * from)), stays = 0;
  if (peak > most) {
    peak = std::max(most, from);
    stays = std::max(0.0, change / peak - (2 * peak * peak - from * from) / (2 * jerk * peak));
  }
  return (2 * peak - from) / jerk + stays;
}

struct Stop {
  double speed = 0;   ///< mm/s, in the last cycle
  double line_s = 0;  ///< s, of the stop along the tangent; 0 below the speed that counts as moving
  double axes_s = 0;  ///< s that the slowest axis needs to come to rest, whatever the path
};

constexpr double kMoves = 1e-3;  ///< mm/s: below that the axes as good as stand, and a hold says nothing

/// From the places of three cycles, `dt` seconds apart, of `axes` axes that all have these limits.
template <class Place>
Stop stop_from(const Place& before, const Place& last, const Place& now, unsigned axes, double dt, double acceleration, double jerk) {
  Stop stop;
  const auto velocity = [&](unsigned i) { return (now[i] - last[i]) / dt; };
  const auto change = [&](unsigned i) { return (now[i] - 2 * last[i] + before[i]) / (dt * dt); };
  for (unsigned i = 0; i < axes; ++i) stop.speed += velocity(i) * velocity(i);
  stop.speed = std::sqrt(stop.speed);
  if (!(stop.speed > kMoves)) return stop;
  double along = 0, most_a = HUGE_VAL, most_j = HUGE_VAL;
  for (unsigned i = 0; i < axes; ++i) {
    const double d = velocity(i) / stop.speed, size = std::fabs(d);
    along += change(i) * d;
    if (most_a * size > acceleration) most_a = acceleration / size;
    if (most_j * size > jerk) most_j = jerk / size;
    stop.axes_s = std::max(stop.axes_s, to_rest(velocity(i), change(i), acceleration, jerk));
  }
  stop.line_s = to_rest(stop.speed, along, most_a, most_j);
  return stop;
}

}  // namespace nc::ideal
