// SPDX-License-Identifier: Apache-2.0
// What parameters and offsets say of the axes and the scan has to know, also while no program runs: the feeder hands it over.
#pragma once

#include "stream/stream.hpp"

namespace nc {

struct AxisParameters {
  uint32_t index = 0;      ///< #2076, bit i = axis i: of an index table (M700 9.3)
  uint32_t turning = 0;    ///< #8213 0 to 2: the machine position counts within one turn (M700 14.13)
  uint32_t short_cut = 0;  ///< 1: and goes the shorter way
  double increment[kMaxAxes] = {};  ///< #2106: a table that stands by hand or by chance can be clamped at its multiples; 0 = anywhere
  /// No program runs: the counters of the workpiece show what the next block would find, work = machine - zero. Behind power on
  /// that is the first coordinate system with the offsets as they were kept; what is changed meanwhile is seen at once.
  bool idle = false;
  AxisVec zero;
  bool operator==(const AxisParameters&) const = default;
};

}  // namespace nc
