// SPDX-License-Identifier: Apache-2.0
// Which common variables exist where the family leaves it to the configuration of the machine (FamilyVariables::common is empty).
#pragma once

#include "dialect/variable_rows.hpp"

namespace nc {

/// Common variables that come with nc_config::variable_sets = `sets`, and with every larger number.
struct CommonOption {
  uint32_t sets, first, last;
};

/// M700 13.4: 100, 200, 300 or 600 sets. The two ranges grow from one row to the next without a gap.
inline constexpr CommonOption kCommonOptions[] = {
    {100, 100, 149}, {100, 500, 549}, {200, 150, 199}, {200, 550, 599}, {300, 600, 699}, {600, 700, 999},
};

/// Later models have these, too: nc_config::extended_variables.
inline constexpr VariableRange kExtendedCommon = {900000, 907399};

/// Behind the local variables the ranges of a machine (nc_config::variable_ranges) usually go up to here.
inline constexpr uint32_t kLastOfMachine = 499;

constexpr bool is_common_option(uint32_t sets) {
  for (const CommonOption& row : kCommonOptions)
    if (row.sets == sets) return true;
  return false;
}

}  // namespace nc
