// SPDX-License-Identifier: Apache-2.0
// The plan: the time law over committed geometry, as the scan needs it, and nothing else. Whatever planner
// fills it (this one is a trapezoid's; a jerk-limited one is to come), the scan reads it the same way.
#pragma once

#include "base/arena.hpp"
#include "base/triple_buffer.hpp"

namespace nc {

/// One version of the plan. Segments are counted in the order in which they are committed (Segment::ordinal).
struct Plan {
  uint32_t version = 0;
  uint32_t end = 0;  ///< ring index behind the last record that the scan may execute; the path rests there
  double* exit_speed2 = nullptr;  ///< per ordinal & mask: (mm/s)^2 at the end of the segment
  uint32_t mask = 0;
  double exit2(uint32_t ordinal) const { return exit_speed2[ordinal & mask]; }
};

/// Three plans, swapped atomically. The writer copies only what has changed since it last held the buffer it
/// writes.
class PlanExchange {
 public:
  void create(uint32_t capacity, Arena& arena) {
    for (Plan& plan : plan_) {
      plan.mask = capacity - 1;
      plan.exit_speed2 = arena.make<double>(capacity);
    }
  }

  /// Planner: exit_speed2 of `speed2[ordinal & mask]` has changed from ordinal `changed` on, the live ones
  /// are [begin, end).
  void publish(const double* speed2, uint32_t begin, uint32_t changed, uint32_t end, uint32_t end_record) {
    for (uint32_t& dirty : dirty_from_) {
      if (static_cast<int32_t>(changed - dirty) < 0) dirty = changed;
    }
    const unsigned back = index_.back();
    Plan& plan = plan_[back];
    uint32_t from = dirty_from_[back];
    if (static_cast<int32_t>(from - begin) < 0) from = begin;
    for (uint32_t k = from; static_cast<int32_t>(end - k) > 0; ++k)
      plan.exit_speed2[k & plan.mask] = speed2[k & plan.mask];
    dirty_from_[back] = end;
    plan.end = end_record;
    plan.version = ++version_;
    index_.publish();
  }
  uint32_t version() const { return version_; }

  void count_from(uint32_t first) {
    for (Plan& plan : plan_) plan.end = first;
    for (uint32_t& dirty : dirty_from_) dirty = first;
    version_ = first;
  }

  /// Scan: the newest plan.
  const Plan& newest() NC_RT {
    index_.refresh();
    return plan_[index_.front()];
  }

 private:
  Plan plan_[3];
  TripleIndex index_;
  uint32_t dirty_from_[3] = {0, 0, 0};
  uint32_t version_ = 0;
};

}  // namespace nc
