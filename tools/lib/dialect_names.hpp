// SPDX-License-Identifier: Apache-2.0
// Dialects as people write them, from the library's own list: an option's words, its help, and what is wrong with another word.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** Every dialect there is, in the order of nc_dialect. */
std::vector<std::string> dialect_names();
/** The same in a sentence: "m700 or dgshape". */
std::string dialect_list(const char* conjunction);
/** The dialect of a configuration that names none. */
std::string default_dialect();
std::optional<nc_dialect> dialect_from_name(const std::string& name);
/** What is wrong with a name that is none. */
std::string no_dialect(const std::string& name);

}  // namespace nc::tools
