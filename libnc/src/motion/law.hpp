// SPDX-License-Identifier: Apache-2.0
// The time law of one axis or one path: constant acceleration, constant speed, constant deceleration,
// followed exactly and not in steps of a cycle. The path generator and manual motion are both made of it.
#pragma once

#include <algorithm>
#include <cmath>

#include "nc/types.h"

namespace nc {

/// Where a trapezoid stands.
struct LawState {
  double s = 0;  ///< mm
  double v = 0;  ///< mm/s, >= 0
};

/// What it has to keep.
struct LawGoal {
  double length = 0;  ///< mm
  double exit2 = 0;   ///< (mm/s)^2 allowed at s = length
  double cap = 0;     ///< mm/s
  double accel = 1;   ///< mm/s^2, also of braking
};

/// Goes on for `time` seconds: as fast as cap and exit speed allow; brakes where it is too fast for either.
/// Braking is never harder than accel, so a state that is too fast for the exit speed passes the end too
/// fast: the exit speeds of a plan are such that this happens only on the way down to a plan with lower
/// speeds, see docs/motion.md.
/// @return the time that is left when the end is reached (state.s == length exactly), else 0.
inline double advance(LawState& state, const LawGoal& goal, double time) NC_RT {
  const double a = goal.accel, end2 = std::max(0.0, goal.exit2);
  double left = goal.length - state.s, v = state.v;
  if (left <= 0) {
    state.s = goal.length;
    return time;
  }
  const double reach2 = end2 + 2 * a * left;
  // Rounding of s (relative to the whole length) and of v is not "too fast": such a state still ends exactly
  // at its exit speed.
  const double rounding2 = 1e-11 * reach2 + 1e-14 * a * goal.length;
  const bool too_fast_for_exit = v * v > reach2 + rounding2;
  if (too_fast_for_exit || v > goal.cap) {
    const double at_end2 = v * v - 2 * a * left;
    const double t_end = at_end2 >= 0 ? 2 * left / (v + std::sqrt(at_end2)) : HUGE_VAL;
    double t = too_fast_for_exit ? t_end : (v - goal.cap) / a;
    if (t > t_end) t = t_end;
    if (time < t) {
      state.s += time * (v - 0.5 * a * time);
      state.v = v - a * time;
      return 0;
    }
    if (t == t_end) {
      state.s = goal.length;
      state.v = std::sqrt(std::max(0.0, too_fast_for_exit ? at_end2 : std::min(at_end2, end2)));
      return time - t;
    }
    state.s += t * (v - 0.5 * a * t);
    state.v = v = goal.cap;
    left = goal.length - state.s;
    time -= t;
  }
  if (goal.cap <= 0) {
    state.v = 0;
    return 0;
  }
  // Up to the peak, along it, down to the exit: each phase in closed form.
  const double gain = 2 * a * left;
  double peak = std::sqrt(std::min(0.5 * (v * v + end2 + gain), v * v + gain));
  peak = std::max(v, std::min(goal.cap, peak));
  const double t_up = (peak - v) / a;
  if (time < t_up) {
    state.s += time * (v + 0.5 * a * time);
    state.v = v + a * time;
    return 0;
  }
  time -= t_up;
  const double peak2 = peak * peak;
  left -= 0.5 * (peak2 - v * v) / a;
  const double out2 = std::min(peak2, end2);
  const double braking = 0.5 * (peak2 - out2) / a;
  const double level = left - braking;
  if (level > 0) {
    const double t_level = level / peak;
    if (time < t_level) {
      state.s = goal.length - left + peak * time;
      state.v = peak;
      return 0;
    }
    time -= t_level;
  }
  const double out = std::sqrt(out2);
  const double t_down = (peak - out) / a;
  if (time < t_down) {
    const double rest = t_down - time;  // measured from the end, where the place is exact
    state.s = goal.length - rest * (out + 0.5 * a * rest);
    state.v = out + a * rest;
    if (state.s >= goal.length) state.v = out;  // nearer to the end than a double can tell: it has arrived
    return 0;
  }
  state.s = goal.length;
  state.v = out;
  return time - t_down;
}

}  // namespace nc
