// SPDX-License-Identifier: Apache-2.0
// See rounding.hpp.
#include "motion/rounding.hpp"

#include "motion/limits.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

/// Of the tolerance, what corners may take; what speeding up and arcs do to the mean has the rest.
constexpr double kCornerTolerance = 0.8;

}  // namespace

FilterTimes rounding_filter(const MotionLimits& limits) {
  FilterTimes times;
  double sum = 0;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    if (!(limits.axis[i].acceleration > 0)) return times;
    sum += limits.axis[i].acceleration * limits.axis[i].acceleration;
  }
  const double seconds = std::sqrt(8 * kCornerTolerance * limits.tolerance / (kRoundingShare * std::sqrt(sum)));
  const double cycles = std::floor(std::min(seconds, kLongestSPattern / 1000) / limits.cycle_s);
  if (!(cycles >= 1)) return times;
  times.kind = FilterTimes::Kind::before;
  for (uint16_t& mean : times.mean) mean = static_cast<uint16_t>(std::min<double>(cycles, kMostFilterCycles));
  return times;
}

double rounding_window(const Segment& s, const MotionLimits& limits) {
  if (s.filter.kind != FilterTimes::Kind::before) return 0;
  const FilterTimes longest = rounding_filter(limits);
  if (longest.kind == FilterTimes::Kind::none) return 0;
  return std::min(s.filter.mean[0], longest.mean[0]) * limits.cycle_s;
}

void RecentTurns::go(double length, double entry, double grain, const AxisVec& turn, unsigned axes) {
  const bool joins = count_ > 0 && way_ + length - began_ < grain;
  if (!joins) {
    if (count_ == kWays) {  // the two oldest become one: what lies far back may seem nearer
      const Way& oldest = back(kWays - 1);
      Way& next = back(kWays - 2);
      for (unsigned i = 0; i < axes; ++i) {
        next.low[i] = std::min(oldest.low[i], next.low[i]);
        next.high[i] = std::max(oldest.high[i], next.high[i]);
      }
      next.fastest = std::max(oldest.fastest, next.fastest);
      next.turns = true;
      --count_;
    }
    newest_ = (newest_ + 1) % kWays;
    ++count_;
    back(0) = {direction_, direction_, 0, 0, false};
    began_ = way_;
  }
  Way& newest = back(0);
  way_ += length;
  newest.end = way_;
  newest.fastest = std::max(newest.fastest, entry);
  newest.turns = newest.turns || joins;
  for (unsigned i = 0; i < axes; ++i) {
    newest.low[i] = std::min(newest.low[i], direction_[i]);
    newest.high[i] = std::max(newest.high[i], direction_[i]);
    direction_[i] += turn[i];
  }
}

RecentTurns::Corner RecentTurns::corner(double most, double share, double window, const MotionLimits& limits) const {
  AxisVec low = direction_, high = direction_;
  double fastest = 0;
  Corner best;
  for (unsigned n = 0; n < count_; ++n) {
    const Way& way = back(n);
    double change = 0;  // of direction, in units of what the axes can do: s^2/mm
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      low[i] = std::min(low[i], way.low[i]);
      high[i] = std::max(high[i], way.high[i]);
      change = std::max(change, (high[i] - low[i]) / limits.axis[i].acceleration);
    }
    const bool alone = n == 0 && !way.turns;
    fastest = alone ? 0 : std::max(fastest, way.fastest);
    const double even = change > 0 ? share * window / change : HUGE_VAL;
    double cap = alone ? even : even / (1 + kUneven);
    if (!alone && cap < fastest) cap = even - kUneven * fastest;
    cap = std::min(cap, most);
    // Below this speed nothing in front of this way is in the window.
    double apart = HUGE_VAL;
    if (n + 1 < count_) {
      apart = (way_ - back(n + 1).end) / window;
      apart = std::min(apart / (1 + kUneven), apart - kUneven * fastest);
    }
    const double v = std::min(cap, apart);
    if (v > best.speed) best = {v, std::min(share, (v + (alone ? 0 : kUneven * std::max(v, fastest))) * change / window)};
    if (cap <= apart) break;
  }
  return best;
}

}  // namespace nc
