// SPDX-License-Identifier: Apache-2.0
// The G codes that a line of a program has, and those that a family has: what a text shows before it is run.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "nc/nc.h"

namespace nc::tools {

/** G codes as nc_modal::code has them, times 10: 382 is G38.2. */
using CodeSet = std::set<int>;

/** The G codes of the family's function table, those that it does not support included. */
CodeSet codes_of_family(nc_dialect dialect);

/** The G codes that stand in a line as plain numbers (line_words.hpp). A code that a formula gives is not among them, nor one beside a keyword. */
CodeSet codes_of_line(std::string_view line);

}  // namespace nc::tools
