// SPDX-License-Identifier: Apache-2.0
// Behind interpolation: filters over the interpolated positions, and the answer whether they have settled (M700 7.7, 13.15;
// docs/motion.md, "Behind interpolation"). The filters change only while nothing is in them.
#pragma once

#include <cstddef>

#include "filter/axis_filter.hpp"
#include "filter/filter_times.hpp"

namespace nc {

class PositionFilter {
 public:
  /// Places for each axis' filters.
  static uint32_t places(double longest_ms, double cycle_s) {
    return filter_cycles(longest_ms, cycle_s);
  }
  /// @param rings  `places` values for each axis, the filters' alone; 0 places: there are no filters
  void create(unsigned axis_count, double cycle_s, double* rings, uint32_t places) {
    axis_count_ = axis_count;
    cycle_s_ = cycle_s;
    rings_ = rings;
    places_ = rings != nullptr ? places : 0;
  }

  /// Start from rest at a place.
  void reset(const AxisVec& position) {
    in_ = last_ = position;
    for (unsigned i = 0; active_ && i < axis_count_; ++i) filter_[i].empty();
    lagging_ = false;
  }
  /// The place counts from elsewhere: what is on its way stays so.
  void relocate(const AxisVec& position) NC_RT {
    for (unsigned i = 0; i < kMaxAxes; ++i) last_[i] += position[i] - in_[i];
    in_ = position;
    if (!lagging_) last_ = in_;
  }

  bool uses(const FilterTimes& times) const NC_RT { return times_.same(times); }
  /// False when they do not fit. Only while drained().
  bool use(const FilterTimes& times) NC_RT {
    if (uses(times)) return true;
    for (unsigned i = 0; i < axis_count_; ++i)
      if (uint32_t{times.mean[i]} + times.second > places_) return false;
    times_ = times;
    active_ = times.kind != FilterTimes::Kind::none;
    for (unsigned i = 0; active_ && i < axis_count_; ++i)
      filter_[i].use(rings_ + size_t{places_} * i, times.mean[i], times.second, static_cast<double>(times.lag_s[i]), cycle_s_);
    return true;
  }
  /// The path has an acceleration of its own, so it may go on from a rest while something is still on its way.
  bool goes_on() const { return times_.kind != FilterTimes::Kind::after; }

  /// One cycle: what the interpolator wants in, what the axes are told out. `rests`: it stands and does not go on before all is drained.
  AxisVec filter(const AxisVec& wanted, bool rests) NC_RT {
    if (!active_) [[likely]] {
      in_ = last_ = wanted;
      return wanted;
    }
    lagging_ = false;
    for (unsigned i = 0; i < axis_count_; ++i) {
      const double behind = filter_[i].advance(wanted[i] - in_[i], rests);
      last_[i] = wanted[i] - behind;
      lagging_ = lagging_ || !filter_[i].settled();
    }
    in_ = wanted;
    return last_;
  }
  /// Nothing of what went in is still on its way out: needed by in-position checks, gates and syncs.
  bool settled(const AxisVec& wanted) const NC_RT { return last_ == wanted && !lagging_; }
  /// The same where there is a filter; without one nothing is ever on its way.
  bool drained(const AxisVec& wanted) const NC_RT { return !active_ || (!lagging_ && in_ == wanted); }
  bool active() const { return active_; }
  /// Where the axes are told to be.
  const AxisVec& position() const { return last_; }

 private:
  unsigned axis_count_ = 0;
  double cycle_s_ = 0.001;
  double* rings_ = nullptr;
  uint32_t places_ = 0;
  FilterTimes times_;
  bool active_ = false;
  bool lagging_ = false;
  AxisVec in_, last_;
  AxisFilter filter_[kMaxAxes];
};

}  // namespace nc
