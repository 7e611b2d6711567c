// SPDX-License-Identifier: Apache-2.0
// All members of an executor: the ring, the planner of the feeder, the scan, and what feeder and scan tell each other.
#pragma once

#include "interpolate/interpolator.hpp"

namespace nc {

class ExecutorState {
 public:
  ExecutorConfig config;
  Record* ring = nullptr;
  LeftRecord* left = nullptr;  ///< one for each place of the ring; nullptr: not needed (ExecutorConfig::tells_marks)
  uint32_t mask = 0;
  // used by the feeder only
  alignas(64) uint32_t head = 0;  ///< ring index behind the last record pushed
  uint32_t seen = 0;              ///< ring index behind the last record that executed_mark() has looked at
  bool truncate_open = false;  ///< a request is waiting for its answer
  alignas(64) Planner planner;
  optimal::OptimalPlanner* optimal = nullptr;  ///< in the optimal mode used instead of `planner`; otherwise nullptr
  alignas(64) ScanShared shared;
  alignas(64) Interpolator scan;

  unsigned truncate_age = 0;  ///< plan() calls since the request

  Planner::Inputs scan_said();
  void forget_truncation();
};

}  // namespace nc
