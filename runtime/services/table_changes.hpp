// SPDX-License-Identifier: Apache-2.0
// The services that set tables of the control: tool offsets, tool life, work offsets, common variables, parameters; one value, a file of them, or what was there before a
// change. They are refused while a program is in execution or interrupted (Runtime::change()); the change is kept over power off as one of a program is.
//
// A change is whole: all of its values are looked up before the first one is written, and one that the control does not take gives the others back.
#pragma once

#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"
#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

// Each fills in *change when it is done: what, before and after for people, and the values. Without values nothing has changed.
Outcome set_tool(Runtime* runtime, const Call& call, Change* change);
Outcome set_life(Runtime* runtime, const Call& call, Change* change);
Outcome set_offset(Runtime* runtime, const Call& call, Change* change);
Outcome set_variable(Runtime* runtime, const Call& call, Change* change);
Outcome set_parameter(Runtime* runtime, const Call& call, Change* change);
Outcome import_parameters(Runtime* runtime, const Call& call, Change* change);
Outcome import_tables(Runtime* runtime, const Call& call, Change* change);
// Gives the values back that `done` has changed and that are not lost. Refused when one of them is not any more as `done` has left it.
Outcome take_back(Runtime* runtime, const Change& done, Change* change);

// Compares the changes with what the tables hold now (lost_changes.hpp). Nothing is marked when they cannot be read.
void find_lost(Runtime* runtime, ChangeLog* log);

}  // namespace nc::rt::services
