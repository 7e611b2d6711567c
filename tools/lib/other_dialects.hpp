// SPDX-License-Identifier: Apache-2.0
// Finds out whether a program that has an alarm was perhaps written for another family.
#pragma once

#include <string>
#include <vector>

#include "tools/lib/commands.hpp"
#include "tools/lib/session.hpp"

namespace nc::tools {

/**
 * Families other than that of `options` with which the program runs to its end without an alarm, with a default
 * setup. There are none for a program from standard input, for a tape, and when a setup or a machine is given, because these belong to
 * one family.
 */
std::vector<std::string> dialects_without_alarm(const SessionOptions& options, const RunLimits& limits);

/** A note such as "note: as a program of iso it ends without an alarm: --dialect iso"; "" when there are no such families. */
std::string dialect_note(const std::vector<std::string>& dialects);

}  // namespace nc::tools
