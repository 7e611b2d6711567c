// SPDX-License-Identifier: Apache-2.0
// Finds out whether a program that has an alarm was perhaps written for another family.
#pragma once

#include <cstdint>
#include <string>

#include "tools/lib/commands.hpp"
#include "tools/lib/session.hpp"

namespace nc::tools {

/** Blocks and moves that each family reads of a program at most, in all its runs together: a note never takes longer than this, whatever the program is. */
constexpr uint64_t kMostReadByFamily = 800'000;

/**
 * A note such as "note: this looks like a program of iso, as which it ends without an alarm; try --dialect iso" when another family reads the program clearly
 * better than `own`, "" otherwise. Each family runs the program with a default setup and no machine, because these belong to one family, and again without each
 * line that has had an alarm; the lines that only one of two families refuses are compared, and what the text alone shows: lines that are written in the
 * language of one of them, and codes that only one executes. So a slip that every family sees, or a sub program that is missing, counts for nobody, and one
 * sign alone is a slip in a program of a few blocks. A run that is long ends early, and for the rest of a program says nothing. A text from standard input that `options` do not have and a
 * tape have no note.
 * @param whole_numbers the program has no alarm, but lengths that look like whole mm or inch: only families that read them so, and have no alarm, are named
 * @param work gets the number of blocks and moves that were read for the note; may be null
 */
std::string other_dialect_note(const SessionOptions& options, const RunLimits& limits, const std::string& own, bool whole_numbers,
                               uint64_t* work = nullptr);

}  // namespace nc::tools
