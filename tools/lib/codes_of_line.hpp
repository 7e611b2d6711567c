// SPDX-License-Identifier: Apache-2.0
// The codes that a line of a program has for a family, and those that a family has: what a text shows before it is run.
#pragma once

#include <set>
#include <string_view>

#include "nc/nc.h"

namespace nc::tools {

/** Codes as nc_modal::code has them, times 10: 382 is G38.2. */
using CodeSet = std::set<int>;

/** The code that a word is; -1: it is none. */
int code_of(const nc_plain_word& word);

/**
 * The codes of the family's function table.
 * @param supported only those that the family executes
 */
CodeSet codes_of_family(nc_dialect dialect, bool supported = false);

/** The codes whose numbers stand in a line, as this family reads it; up to where it is no line of the family. A code that a formula gives is not among them. */
CodeSet codes_of_line(nc_dialect dialect, std::string_view line);

}  // namespace nc::tools
