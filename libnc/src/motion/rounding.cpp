// SPDX-License-Identifier: Apache-2.0
// See rounding.hpp.
#include "motion/rounding.hpp"

#include "motion/limits.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

/// Of the tolerance, what corners may take; what speeding up and arcs do to the mean has the rest.
constexpr double kCornerTolerance = 0.87;
/// |t2 - t1| is no more than this.
constexpr double kReversal = 2;

}  // namespace

FilterTimes rounding_filter(const MotionLimits& limits) {
  FilterTimes times;
  double most = 0;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    if (!(limits.axis[i].acceleration > 0)) return times;
    most = std::max(most, limits.axis[i].acceleration);
  }
  // A corner along one axis that takes all of its share takes all of the tolerance, too.
  const double seconds = std::sqrt(8 * kCornerTolerance * limits.tolerance / (kAloneShare * most));
  const double cycles = std::floor(std::min(seconds, kLongestSPattern / 1000) / limits.cycle_s);
  if (!(cycles >= 1)) return times;
  times.kind = FilterTimes::Kind::before;
  for (uint16_t& mean : times.mean) mean = static_cast<uint16_t>(std::min<double>(cycles, kMostFilterCycles));
  return times;
}

AxisVec reserve_for_turns(const AxisVec& share, double turn, unsigned axes) {
  constexpr double kMore = 1.3, kOver = 0.05;          // times the share that is known, and above it
  constexpr double kLeast = 0.45;                      // reserved where the path hardly turns
  constexpr double kGentle = 0.4, kWild = 1.2;         // |t2 - t1| up to which an axis keeps its part, and from which on any axis may be the next
  const double least = kLeast + (kRoundingShare - kLeast) * std::clamp((turn - kGentle) / (kWild - kGentle), 0.0, 1.0);
  AxisVec reserve;
  for (unsigned i = 0; i < axes; ++i) reserve[i] = std::max(share[i], std::clamp(kMore * share[i] + kOver, least, kRoundingShare));
  return reserve;
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
        next.reserved[i] = std::min(oldest.reserved[i], next.reserved[i]);
      }
      next.fastest = std::max(oldest.fastest, next.fastest);
      next.turns = true;
      --count_;
    }
    newest_ = (newest_ + 1) % kWays;
    ++count_;
    back(0) = {direction_, direction_, {}, 0, 0, false};
    for (double& share : back(0).reserved.v) share = 1;
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

void RecentTurns::reserve(const AxisVec& share, unsigned axes) {
  if (count_ == 0) return;
  for (unsigned i = 0; i < axes; ++i) back(0).reserved[i] = std::min(back(0).reserved[i], share[i]);
}

RecentTurns::Corner RecentTurns::corner(double most, double part, double kept, double window, const MotionLimits& limits) const {
  AxisVec low = direction_, high = direction_, left;
  for (unsigned i = 0; i < limits.axis_count; ++i) left[i] = 1;
  // The mean is that of the middles between cycles: a corner in between is cut by 1 + (cycle / window)^2 times as much.
  const double cycle = limits.cycle_s / window;
  const double deviates = 8 * kCornerTolerance * limits.tolerance / (window * (1 + cycle * cycle));
  double fastest = 0;
  Corner best;
  for (unsigned n = 0; n < count_; ++n) {
    const Way& way = back(n);
    const bool alone = n == 0 && !way.turns;
    const double share = part * ((alone ? kAloneShare : kRoundingShare) - kept);
    double even = HUGE_VAL, wide2 = 0;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      low[i] = std::min(low[i], way.low[i]);
      high[i] = std::max(high[i], way.high[i]);
      if (!alone) left[i] = std::min(left[i], way.reserved[i] - kept);
      const double change = high[i] - low[i];
      if (change > 0) even = std::min(even, std::min(share, left[i]) * limits.axis[i].acceleration * window / change);
      wide2 += change * change;
    }
    if (wide2 > 0) even = std::min(even, deviates / std::min(kReversal, std::sqrt(wide2)));
    fastest = alone ? 0 : std::max(fastest, way.fastest);
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
    if (v > best.speed) {
      best.speed = v;
      best.turn = std::sqrt(wide2);
      const double with = (v + (alone ? 0 : kUneven * std::max(v, fastest))) / window;
      for (unsigned i = 0; i < limits.axis_count; ++i) best.share[i] = std::min(share, with * (high[i] - low[i]) / limits.axis[i].acceleration);
    }
    if (cap <= apart) break;
  }
  return best;
}

}  // namespace nc
