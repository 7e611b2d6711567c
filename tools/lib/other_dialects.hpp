// SPDX-License-Identifier: Apache-2.0
// Finds out whether a program that has an alarm was perhaps written for another family.
#pragma once

#include <string>

#include "tools/lib/commands.hpp"
#include "tools/lib/session.hpp"

namespace nc::tools {

/**
 * A note such as "note: this looks like a program of iso, as which it ends without an alarm; try --dialect iso" when another family reads the program clearly
 * better than `own`, "" otherwise. Each family runs the program with a default setup and no machine, because these belong to one family, and again without each
 * line that has had an alarm; the lines that only one of two families refuses are compared. So a slip that every family sees, or a sub program that is
 * missing, counts for nobody. A text from standard input and a tape have no note.
 * @param whole_numbers the program has no alarm, but lengths that look like whole mm or inch: only families that read them so, and have no alarm, are named
 */
std::string other_dialect_note(const SessionOptions& options, const RunLimits& limits, const std::string& own, bool whole_numbers);

}  // namespace nc::tools
