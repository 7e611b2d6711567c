// SPDX-License-Identifier: Apache-2.0
// The filters behind interpolation for all axes, and whether they have settled (M700 7.7, 13.15; docs/motion.md, "Behind interpolation"). Filters are
// changed only while they hold nothing.
#pragma once

#include <cstddef>

#include "filter/axis_filter.hpp"
#include "filter/filter_times.hpp"

namespace nc {

class PositionFilter {
 public:
  /// Number of values that the filters of one axis need room for.
  static uint32_t places(double longest_ms, double cycle_s) {
    return filter_cycles(longest_ms, cycle_s);
  }
  /// @param rings  room for `places` values for each axis, used by the filters only; nullptr or 0 places: there are no filters
  void create(unsigned axis_count, double cycle_s, double* rings, uint32_t places) {
    axis_count_ = axis_count;
    cycle_s_ = cycle_s;
    rings_ = rings;
    places_ = rings != nullptr ? places : 0;
  }

  /// Begins at rest at `position`.
  void reset(const AxisVec& position) {
    in_ = last_ = position;
    for (unsigned i = 0; active_ && i < axis_count_; ++i) filter_[i].empty();
    lagging_ = false;
  }
  /// Shifts the interpolated place to `position` without moving the axes by the filters: what they hold stays.
  void relocate(const AxisVec& position) NC_RT {
    for (unsigned i = 0; i < kMaxAxes; ++i) last_[i] += position[i] - in_[i];
    in_ = position;
    if (!lagging_) last_ = in_;
  }

  bool uses(const FilterTimes& times) const NC_RT { return times_.same(times); }
  /// Changes the filters, only while drained(). False when they do not fit into the room given to create().
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
  /// The path may go on from a rest while the filters still hold something, because the planner accelerates it.
  bool goes_on() const { return times_.kind != FilterTimes::Kind::after; }

  /// One cycle: takes the interpolated place, and returns the commanded one. `rests`: the path rests and does not go on before drained().
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
  /// The filters hold nothing, and the commanded place is `wanted`: needed by in-position checks, gates and syncs.
  bool settled(const AxisVec& wanted) const NC_RT { return last_ == wanted && !lagging_; }
  /// The filters hold nothing, and `wanted` has gone in; always true without filters.
  bool drained(const AxisVec& wanted) const NC_RT { return !active_ || (!lagging_ && in_ == wanted); }
  bool active() const { return active_; }
  /// The commanded place of the last cycle.
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
