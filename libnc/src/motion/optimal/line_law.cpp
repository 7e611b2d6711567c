// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/line_law.hpp"

#include <algorithm>
#include <cmath>

#include "motion/optimal/piece.hpp"

namespace nc::optimal {
namespace {

constexpr double kNear = 1e-10;  ///< mm: a stop may miss its end by this much at most
constexpr double kSame = 1e-12;  ///< two speeds that differ by this part of themselves are the same but for rounding
constexpr double kMoreJerk = 1.0005;  ///< from a state that needs up to this many times the limit of the jerk to come to rest, only such a stop leads to rest
constexpr double kClose = 1e-14;  ///< a length is found when it is known to this part of the distance
constexpr unsigned kSteps = 100;

/// The largest x in [low, high] with way(x) <= distance, where way grows and lies around it (regula falsi, Illinois).
template <class Way>
double largest(double low, double high, double distance, Way&& way) {
  double f_low = way(low) - distance, f_high = way(high) - distance;
  int side = 0;
  for (unsigned n = 0; n < kSteps && high - low > kClose * high && f_low < -kClose * distance; ++n) {
    double x = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(x > low) || !(x < high)) x = 0.5 * (low + high);
    const double f = way(x) - distance;
    if (f <= 0) {
      low = x;
      f_low = f;
      if (side < 0) f_high *= 0.5;
      side = -1;
    } else {
      high = x;
      f_high = f;
      if (side > 0) f_low *= 0.5;
      side = 1;
    }
  }
  return low;
}

}  // namespace

double unseen(const LineLimits& limits, double distance) {
  return std::max(std::min(kNear, kUnseen * limits.jerk), kClose * distance);
}

void LineLaw::begin(double v, double a) {
  start_ = at_ = {0, v, a};
  count_ = last_part_ = 0;
  seconds_ = 0;
}

void LineLaw::add(double seconds, double jerk) {
  if (!(seconds > 0)) return;
  phase_[count_++] = {seconds, jerk};
  at_ = at_.behind(jerk, seconds);
  seconds_ += seconds;
}

/// From the state reached to constant speed: the acceleration goes to its peak with the largest jerk, stays there where that is its limit,
/// and goes to 0. From a to the peak p and back the speed changes by (2 p^2 - a^2) / (2 j).
void LineLaw::to_speed(double speed) {
  const double j = limits_.jerk, change = speed - at_.v;
  const double sign = change >= at_.a * std::fabs(at_.a) / (2 * j) ? 1 : -1, a = sign * at_.a, dv = sign * change;
  const double most = std::max(limits_.acceleration, a);
  double peak = std::sqrt(std::max(0.0, j * dv + 0.5 * a * a)), hold = 0;
  if (peak > most) {
    peak = most;
    hold = dv / peak - (2 * peak * peak - a * a) / (2 * j * peak);
  }
  add((peak - a) / j, sign * j);
  add(hold, 0);
  add(peak / j, -sign * j);
  at_.v = speed;
  at_.a = 0;
}

/// The last phase has the acceleration go to 0 from below, always.
bool LineLaw::to_rest() {
  last_part_ = count_;
  const double v = at_.v, a = at_.a;
  if (!(a < 0) || v > a * a / (2 * limits_.jerk) * (1 + kSame)) {
    to_speed(0);
    return true;
  }
  if (!(v > 0)) return false;
  const double jerk = a * a / (2 * v);
  add(-2 * v / a, jerk);
  return jerk <= kMoreJerk * limits_.jerk;
}

bool LineLaw::stop(double v, double a, const LineLimits& limits) {
  limits_ = limits;
  begin(v, a);
  return to_rest();
}

/// @return the way to rest by a speed that is kept for `cruise` seconds
double LineLaw::way_through(double speed, double cruise) {
  begin(start_.v, start_.a);
  to_speed(speed);
  if (cruise > 0) add(cruise, 0);
  to_rest();
  return at_.s;
}

/// @return the way to rest when braking becomes weaker for `rise` seconds before
double LineLaw::way_behind(double rise) {
  begin(start_.v, start_.a);
  add(rise, limits_.jerk);
  to_rest();
  return at_.s;
}

bool LineLaw::reach(double distance, double v, double a, const LineLimits& limits, double most_seconds) {
  whole_ = true;
  if (!stop(v, a, limits)) return false;
  const double near = unseen(limits, distance);
  if (at_.s > distance + near) return false;
  if (at_.s >= distance - near && v > 0) return true;
  const double level = std::max(0.0, v + a * std::fabs(a) / (2 * limits.jerk));  // the speed when its change has ended as soon as possible
  const bool slower = limits.speed < (1 - kSame) * level;
  const double most = slower ? limits.speed : std::max(level, limits.speed);
  double way = way_through(most, 0);
  if (way <= distance) {
    const double cruise = (distance - way) / most, over = seconds_ + cruise - most_seconds;
    whole_ = !(over > 0);
    way_through(most, whole_ ? cruise : std::max(cruise - over, 0.0));
    return true;
  }
  if (slower) return false;
  if (way_through(level, 0) > distance) {
    if (!(a < 0)) return false;
    way_behind(largest(0, -a / limits.jerk, distance, [this](double rise) { return way_behind(rise); }));
    return true;
  }
  const double speed = largest(level, most, distance, [this](double x) { return way_through(x, 0); });
  way = way_through(speed, 0);
  if (speed > 0 && way < distance) way_through(speed, (distance - way) / speed);
  last_part_ = 0;
  while (last_part_ < count_ && !(phase_[last_part_].jerk < 0)) ++last_part_;
  return true;
}

}  // namespace nc::optimal
