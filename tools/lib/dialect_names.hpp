// SPDX-License-Identifier: Apache-2.0
// Names of dialects, from the list of the library: the values of an option, its help, and the error for another value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** All dialects, in the order of nc_dialect. */
std::vector<std::string> dialect_names();
/** The same as part of a sentence: "m700 or dgshape". */
std::string dialect_list(const char* conjunction);
/** The dialect of a configuration that names none. */
std::string default_dialect();
std::optional<nc_dialect> dialect_from_name(const std::string& name);
/** The error for a name that is not a dialect. */
std::string no_dialect(const std::string& name);

}  // namespace nc::tools
