// SPDX-License-Identifier: Apache-2.0
// A program that alarms may have been written for another family.
#pragma once

#include <string>
#include <vector>

#include "tools/lib/commands.hpp"
#include "tools/lib/session.hpp"

namespace nc::tools {

/**
 * Families other than that of `options` that run its program to its end without an alarm, with the setup of a control that nobody has set
 * up. Their own tables and rules decide. None for a program from standard input, for a tape, and where a setup or a machine has been given: these
 * are of one family.
 */
std::vector<std::string> dialects_without_alarm(const SessionOptions& options, const RunLimits& limits);

/** "note: as a program of iso it ends without an alarm: --dialect iso"; "" where there are none. */
std::string dialect_note(const std::vector<std::string>& dialects);

}  // namespace nc::tools
