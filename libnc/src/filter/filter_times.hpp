// SPDX-License-Identifier: Apache-2.0
// What one segment wants of the filters behind interpolation (docs/motion.md, "Behind interpolation"). It goes with the segment, so a
// parameter that a program changes acts where the program says.
#pragma once

#include "stream/stream.hpp"

namespace nc {

struct FilterTimes {
  enum class Kind : uint8_t {
    none,    ///< the commanded place is the interpolated one
    after,   ///< acceleration after interpolation: each axis by its own constants, the path without any acceleration
    before,  ///< the path is accelerated by the planner; S-pattern filters, the same for all axes
  };
  Kind kind = Kind::none;
  bool one_way = false;             ///< after: a straight line between two rests, so no axis turns round (not part of the equality)
  uint16_t second = 0;              ///< before: cycles of the mean behind the first
  uint16_t mean[kMaxAxes] = {};     ///< cycles of the mean, 0 = none
  float lag_s[kMaxAxes] = {};       ///< after: time constant of the lag of first order behind it, s; 0 = none

  /// The same filters: a path may go on from one to the other at speed.
  bool same(const FilterTimes& other) const {
    if (kind != other.kind) return false;
    if (kind == Kind::none) return true;
    for (unsigned i = 0; i < kMaxAxes; ++i)
      if (mean[i] != other.mean[i] || lag_s[i] != other.lag_s[i]) return false;
    return second == other.second;
  }
};

/// Longest time constants that a parameter can have, ms.
inline constexpr double kLongestMean = 4000, kLongestLag = 5000, kLongestSPattern = 200;
/// Most cycles that a mean goes over.
inline constexpr uint32_t kMostFilterCycles = 65535;

/// A time constant in whole cycles: the nearest, at least one where there is a constant at all, and at most kMostFilterCycles.
inline uint32_t filter_cycles(double ms, double cycle_s) {
  if (!(ms > 0)) return 0;
  const double cycles = ms / (cycle_s * 1000);
  if (!(cycles < kMostFilterCycles)) return kMostFilterCycles;
  return cycles < 1 ? 1 : static_cast<uint32_t>(cycles + 0.5);
}

}  // namespace nc
