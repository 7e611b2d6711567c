// SPDX-License-Identifier: Apache-2.0
// How fast an axis may be, and how fast it may become so.
#pragma once

namespace nc {

/// Limits of one axis, mm/s or deg/s and so on. 0 = no limit.
struct AxisLimits {
  double rapid = 0, velocity = 0, acceleration = 0, jerk = 0, in_position = 0;
};

}  // namespace nc
