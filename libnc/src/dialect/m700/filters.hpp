// SPDX-License-Identifier: Apache-2.0
// The filters behind interpolation that act on a move (M700 7.7, 13.15, 15.5).
#pragma once

#include "filter/filter_parameters.hpp"

namespace nc::m700 {

/// The time constants of the filters that act on a move. `cycle_s` is the cycle time in s. A move has acceleration after interpolation if
/// each of its axes has a time constant for this kind of move, or has no limit that could be exceeded.
FilterTimes filter_times(const FilterParameters& parameters, const FilteredMove& move, double cycle_s);

}  // namespace nc::m700
