// SPDX-License-Identifier: Apache-2.0
// What creating a control asks about a configuration.
#pragma once

#include "macro/variables.hpp"
#include "nc/nc.h"

namespace nc {

/// Turns a caller's configuration into one of this version of the library: members that an older caller does not know get their defaults. False
/// when `given` is nullptr, its struct_size is not valid, or it sets members that this library does not know.
bool take_config(const nc_config* given, nc_config* known);

/// The common variables of a machine: those of its option (M700 13.4) and the further ranges of its configuration.
CommonRanges ranges_of(const nc_config& config);

}  // namespace nc
