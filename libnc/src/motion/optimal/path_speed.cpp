// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/path_speed.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kShare = 0.3;       ///< of the axes' acceleration and jerk, with which the speed along the path changes: the bends need the rest
constexpr double kNothing = 1e-9;  ///< is added to each derivative, so that nothing is divided by one that is 0
constexpr double kSlowest = 1e-6;  ///< mm/s: no piece is slower, whatever its limits say
constexpr double kFastest = 1e4;  ///< mm/s: no piece is faster, also where nothing limits it
constexpr unsigned kAtOnce = 32;  ///< pieces that are looked at before others may have their turn
constexpr int64_t kBendCost = 70, kWayCost = 40;  ///< instructions that a piece costs: for each axis, and for each way

/// What the bends of one piece allow: the largest derivatives are at its ends.
PieceSpeed bend_speed(const Piece& p, const Limits& limits, double turns) {
  PieceSpeed out{std::min(p.feed * turns, kFastest), HUGE_VAL, HUGE_VAL};
  CurvePoint from, to;
  derivatives(p, 0, limits.axis_count, &from);
  derivatives(p, p.length, limits.axis_count, &to);
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const double d1 = std::max(std::fabs(from.d1[i]), std::fabs(to.d1[i])) + kNothing;
    const double d2 = std::max(std::fabs(from.d2[i]), std::fabs(to.d2[i])) + kNothing;
    const double d3 = std::max(std::fabs(from.d3[i]), std::fabs(to.d3[i])) + kNothing;
    if (limits.velocity[i] > 0) out.speed = std::min(out.speed, limits.velocity[i] / d1);
    if (limits.acceleration[i] > 0) {
      out.speed = std::min(out.speed, std::sqrt(limits.acceleration[i] / d2));
      out.acceleration = std::min(out.acceleration, kShare * limits.acceleration[i] / d1);
    }
    if (limits.jerk[i] > 0) {
      out.speed = std::min(out.speed, std::cbrt(limits.jerk[i] / d3));
      out.jerk = std::min(out.jerk, kShare * limits.jerk[i] / d1);
    }
  }
  out.speed = std::max(out.speed, kSlowest);
  return out;
}

}  // namespace

Task<double> path_speeds(Work& work, const Piece* pieces, unsigned count, const Limits& limits, double turns, PieceSpeed* out) {
  for (unsigned k = 0; k < count; ++k) {
    out[k] = bend_speed(pieces[k], limits, turns);
    if (k % kAtOnce == 0) co_await work.pause(kAtOnce * limits.axis_count * kBendCost);
  }
  for (const bool forward : {true, false}) {
    double speed = HUGE_VAL, acceleration = 0;
    for (unsigned n = 0; n < count; ++n) {
      const unsigned k = forward ? n : count - 1 - n;
      const double seconds = pieces[k].length / std::min(speed, out[k].speed);
      acceleration = std::min(acceleration + out[k].jerk * seconds, out[k].acceleration);
      speed += acceleration * seconds;
      if (!(speed < out[k].speed)) speed = out[k].speed, acceleration = 0;
      out[k].speed = speed;
      if (n % kAtOnce == 0) co_await work.pause(kAtOnce * kWayCost);
    }
  }
  double seconds = 0;
  for (unsigned k = 0; k < count; ++k) seconds += pieces[k].length / out[k].speed;
  co_return seconds;
}

}  // namespace nc::optimal
