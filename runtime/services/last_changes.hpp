// SPDX-License-Identifier: Apache-2.0
// Who has changed a row of a list last, and when: two members of each row. They are of the newest change of one of its values through the services; where a value is not
// any more as that change has left it, a program, or the machine, has written it since, and nobody knows when.
#pragma once

#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"

namespace nc::rt::services {

inline constexpr char kByProgram[] = "program";

// Adds changed_by and changed_ns to the rows of a reply of one of the lists of tables. `system`: index of the part system that was asked for.
void add_last_changes(const ChangeLog& log, Service list, unsigned system, Json* reply);

}  // namespace nc::rt::services
