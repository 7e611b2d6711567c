// SPDX-License-Identifier: Apache-2.0
// Which changes a power cut has taken. A change is on the disk before its reply, the tables that it has changed are up to `retain_every_s` later (docs/services.md): so
// behind a power cut the last changes stand in the log, and their values are those from before.
//
// A file of tables is as it was at one moment. So what is lost of the changes of one value are the newest ones, and the value is the one from before the first of them.
// A value that no change has had before or left behind was set by a program, and then nothing is lost.
#pragma once

#include <deque>
#include <functional>
#include <string>

#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

struct Change;

// The value that a place has now. False when it cannot be read.
using ValueOf = std::function<bool(const TablePlace& place, std::string* value)>;

// Marks what is lost of these changes, the oldest of which comes first. What a lost one has taken back is not taken back any more. To be called at the start of
// ncrtd, before anything changes a table.
void mark_lost(std::deque<Change>* changes, const ValueOf& value_of);

}  // namespace nc::rt::services
