// SPDX-License-Identifier: Apache-2.0
// The services that read tables of the control: tool offsets, tool life, work offsets, common variables, parameters, as lists or as TOML. What they read is what the executed
// blocks have left.
#pragma once

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"

namespace nc::rt::services {

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
Outcome export_tables(Runtime* runtime, const Call& call);

}  // namespace nc::rt::services
