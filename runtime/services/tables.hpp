// SPDX-License-Identifier: Apache-2.0
// The services that read tables of the control: tool offsets, tool life, work offsets, common variables, parameters, as lists or as TOML. What they read is what the executed
// blocks have left.
#pragma once

#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

// The parameters that are set now. False with the refusal in *outcome.
bool read_parameters(Runtime* runtime, std::vector<TableValue>* values, Outcome* outcome);

// The refusal of a command of the runtime.
Outcome refused_by(const Runtime& runtime, Answer answer);
// The part system of a request that must name one; the first one when none is named. False when there is no such part system.
bool system_of(const Runtime& runtime, const Call& call, unsigned* system);
Outcome no_system();

Outcome list_tools(Runtime* runtime, const Call& call);
Outcome list_lives(Runtime* runtime, const Call& call);
Outcome list_offsets(Runtime* runtime, const Call& call);
Outcome list_variables(Runtime* runtime, const Call& call);
Outcome list_parameters(Runtime* runtime, const Call& call);
Outcome export_parameters(Runtime* runtime);
Outcome export_tables(Runtime* runtime, const Call& call);

}  // namespace nc::rt::services
