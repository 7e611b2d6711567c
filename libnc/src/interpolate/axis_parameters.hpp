// SPDX-License-Identifier: Apache-2.0
// What the scan has to know of the parameters and offsets of the axes, also while no program runs. The feeder hands it over.
#pragma once

#include "stream/stream.hpp"

namespace nc {

struct AxisParameters {
  uint32_t index = 0;      ///< bit i: axis i is an index table (#2076, M700 9.3)
  uint32_t turning = 0;    ///< bit i: the machine position of axis i is counted within one turn (#8213 = 0 to 2, M700 14.13)
  uint32_t short_cut = 0;  ///< bit i: axis i takes the shorter way to an angle (#8213 = 1)
  double increment[kMaxAxes] = {};  ///< #2106, deg: a table that was moved by hand or was stopped can be clamped at multiples of this; 0 = anywhere
  /// No program runs: the workpiece counters show the coordinates that the next block would find, work = machine - zero. After power on these are of
  /// the first coordinate system, with the offsets that were kept; a change of an offset shows at once.
  bool idle = false;
  AxisVec zero;  ///< machine coordinates of the workpiece zero, while `idle`
  bool operator==(const AxisParameters&) const = default;
};

}  // namespace nc
