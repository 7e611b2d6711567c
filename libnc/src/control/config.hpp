// SPDX-License-Identifier: Apache-2.0
// What create.cpp asks about a configuration.
#pragma once

#include "macro/variables.hpp"
#include "nc/nc.h"

namespace nc {

/// A caller's configuration as one of this library: what an older caller does not know has its default. False when there is none, or its
/// struct_size is none, or it asks for what this library does not know.
bool take_config(const nc_config* given, nc_config* known);

/// M700 13.4: which common variables there are by option, and those that the machine has beside them.
CommonRanges ranges_of(const nc_config& config);

}  // namespace nc
