// SPDX-License-Identifier: Apache-2.0
// Compensation of an arc's radius behind interpolation (M700 13.15): which share of it acts at which place of the arc.
#pragma once

#include <algorithm>

namespace nc {

/// Share of the compensation at `angle_deg` behind the start of an arc of `sweep_deg`, both positive: it grows from 0 to 1 over the first quarter turn
/// and falls to 0 over the last.
inline double radius_compensation_share(double angle_deg, double sweep_deg) {
  constexpr double kQuarter = 90;
  const double share = std::min(angle_deg, sweep_deg - angle_deg) / kQuarter;
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace nc
