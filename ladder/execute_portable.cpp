// SPDX-License-Identifier: Apache-2.0
// The interpreter in standard C++.
#include "ladder/machine.hpp"

namespace nc::ladder {
#define NC_LADDER_EXECUTE execute_portable
#include "ladder/execute_body.hpp"
}  // namespace nc::ladder
