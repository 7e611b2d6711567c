// SPDX-License-Identifier: Apache-2.0
// Finds out whether a program that has an alarm was perhaps written for another family.
#pragma once

#include <string>
#include <vector>

#include "tools/lib/commands.hpp"
#include "tools/lib/session.hpp"

namespace nc::tools {

/**
 * Families other than `own` with which the program runs to its end without an alarm, with a default setup and no machine, because these belong to one
 * family. There are none for a program from standard input, for a tape, and for one that has no alarm in its own family with a default setup: then the
 * alarm comes from the setup or the machine. `whole_numbers`: only families that read lengths without a decimal point in whole mm or inch, whatever `own` does.
 */
std::vector<std::string> dialects_without_alarm(const SessionOptions& options, const RunLimits& limits, const std::string& own, bool whole_numbers = false);

/** A note such as "note: this looks like a program of iso, as which it ends without an alarm; try --dialect iso"; "" when there are no such families. */
std::string dialect_note(const std::vector<std::string>& dialects);

}  // namespace nc::tools
