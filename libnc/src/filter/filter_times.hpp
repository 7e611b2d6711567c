// SPDX-License-Identifier: Apache-2.0
// The filters behind interpolation that one segment needs (docs/motion.md, "Behind interpolation"). They travel with the segment, so that a parameter
// which a program changes acts from that place of the program on.
#pragma once

#include "stream/stream.hpp"

namespace nc {

struct FilterTimes {
  enum class Kind : uint8_t {
    none,    ///< the commanded place is the interpolated one
    after,   ///< acceleration after interpolation: each axis has filters by its own constants, and the path itself is not accelerated gradually
    before,  ///< acceleration before interpolation: the planner accelerates the path; S-pattern filters, the same for all axes, act behind it
  };
  Kind kind = Kind::none;
  bool one_way = false;             ///< after: a straight line between two rests, so that no axis reverses (same() does not compare this)
  uint16_t second = 0;              ///< before: cycles of a second mean behind the first, 0 = none
  uint16_t mean[kMaxAxes] = {};     ///< cycles of the mean of each axis, 0 = none
  float lag_s[kMaxAxes] = {};       ///< after: time constant of the lag of first order behind the mean, s; 0 = none

  /// The filters are the same, so the path may go on from one segment to the other at speed.
  bool same(const FilterTimes& other) const {
    if (kind != other.kind) return false;
    if (kind == Kind::none) return true;
    for (unsigned i = 0; i < kMaxAxes; ++i)
      if (mean[i] != other.mean[i] || lag_s[i] != other.lag_s[i]) return false;
    return second == other.second;
  }
};

/// Longest time constants that parameters can give, ms.
inline constexpr double kLongestMean = 4000, kLongestLag = 5000, kLongestSPattern = 200;
/// The most cycles that a mean can have.
inline constexpr uint32_t kMostFilterCycles = 65535;

/// A time constant in whole cycles: the nearest, at least one where there is a constant at all, and at most kMostFilterCycles.
inline uint32_t filter_cycles(double ms, double cycle_s) {
  if (!(ms > 0)) return 0;
  const double cycles = ms / (cycle_s * 1000);
  if (!(cycles < kMostFilterCycles)) return kMostFilterCycles;
  return cycles < 1 ? 1 : static_cast<uint32_t>(cycles + 0.5);
}

}  // namespace nc
