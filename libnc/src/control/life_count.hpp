// SPDX-License-Identifier: Apache-2.0
// Minutes of cutting for the table of tool life: of a machine (PartSystem::count_tool_life()), and of a run that no machine executes (nc_tool_life_cut()).
#pragma once

#include "interpret/host_tables.hpp"

namespace nc {

/// Counts them for the tool in a slot, up to `most`, the end of their range; its life ends with them. Nothing without a slot (ToolLives::kNone), or where the life of
/// the tool is counted in times.
void count_minutes(const HostTables& tables, unsigned slot, double minutes, double most);

}  // namespace nc
