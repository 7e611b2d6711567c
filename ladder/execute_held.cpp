// SPDX-License-Identifier: Apache-2.0
// The interpreter with devices that are held: see Hold in ladder.hpp.
#include "ladder/machine.hpp"

namespace nc::ladder {
#define NC_LADDER_HELD
#define NC_LADDER_EXECUTE execute_held
#include "ladder/execute_body.hpp"
}  // namespace nc::ladder
