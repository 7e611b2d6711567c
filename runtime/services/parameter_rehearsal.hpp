// SPDX-License-Identifier: Apache-2.0
// A control has no way to take the setting of a parameter away, so an import of parameters that fails in the middle could not be taken back. It is tried first on a
// control apart, with the configuration and the parameters of the machine.
#pragma once

#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

// The refusal names every value that is refused, with its line.
Outcome rehearse_parameters(Runtime* runtime, const std::vector<TableValue>& wanted);

}  // namespace nc::rt::services
