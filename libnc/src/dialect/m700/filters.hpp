// SPDX-License-Identifier: Apache-2.0
// Which filters behind interpolation a move has (7.7, 13.15, 15.5).
#pragma once

#include "filter/filter_parameters.hpp"

namespace nc::m700 {

/// A move has acceleration after interpolation where each of its axes has a constant of its kind (or no
/// limit that could be broken).
FilterTimes filter_times(const FilterParameters& parameters, const FilteredMove& move, double cycle_s);

}  // namespace nc::m700
