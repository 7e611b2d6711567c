// SPDX-License-Identifier: Apache-2.0
// Compensation of an arc's radius behind interpolation (M700 13.15): how much of it acts where.
#pragma once

#include <algorithm>

namespace nc {

/// Share of the compensation at `angle` behind the start of an arc that sweeps `sweep`, both positive: it
/// grows to the whole over the first quarter turn and falls over the last.
inline double radius_compensation_share(double angle_deg, double sweep_deg) {
  constexpr double kQuarter = 90;
  const double share = std::min(angle_deg, sweep_deg - angle_deg) / kQuarter;
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace nc
