// SPDX-License-Identifier: Apache-2.0
// The services that read and set tables of the control: tool offsets, work offsets, common variables, parameters. What they read is what the executed blocks
// have left. What they set is refused while a program is in execution or interrupted (Runtime::change()); the change is kept over power off as one of a program is.
#pragma once

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"

namespace nc::rt::services {

// The refusal of a command of the runtime.
Outcome refused_by(const Runtime& runtime, Answer answer);

Outcome list_tools(Runtime* runtime, const Call& call);
Outcome list_offsets(Runtime* runtime, const Call& call);
Outcome list_variables(Runtime* runtime, const Call& call);
Outcome list_parameters(Runtime* runtime, const Call& call);

// Each adds what has changed to *changes: what, before, after.
using Changes = std::vector<Change>;
Outcome set_tool(Runtime* runtime, const Call& call, Changes* changes);
Outcome set_offset(Runtime* runtime, const Call& call, Changes* changes);
Outcome set_variable(Runtime* runtime, const Call& call, Changes* changes);
Outcome set_parameter(Runtime* runtime, const Call& call, Changes* changes);

}  // namespace nc::rt::services
