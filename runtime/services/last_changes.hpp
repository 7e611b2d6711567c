// SPDX-License-Identifier: Apache-2.0
// Who has changed a row of a list last, and when: two members of each row. They are of the newest change of one of its values, through the services or by a program, which is named
// (runtime/retain/writers.hpp). Where a value is not as the last known of them has left it, it was a program, or the machine, and nobody knows which one and when.
#pragma once

#include "runtime/retain/writers.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"

namespace nc::rt::services {

inline constexpr char kByProgram[] = "program";

// Adds changed_by and changed_ns to the rows of a reply of one of the lists of tables. `writers`: null = nothing is known of programs. `system`: index of the part system that was asked for.
void add_last_changes(const ChangeLog& log, const WriterTable* writers, Service list, unsigned system, Json* reply);

}  // namespace nc::rt::services
