// SPDX-License-Identifier: Apache-2.0
// The interpreter that holds devices at a value (Hold in ladder.hpp), and that shows the power flow of a scan. It takes longer than the other two, and runs only in
// scans that need it.
#include "ladder/machine.hpp"

namespace nc::ladder {
#define NC_LADDER_WATCHED
#define NC_LADDER_EXECUTE execute_watched
#include "ladder/execute_body.hpp"
}  // namespace nc::ladder
