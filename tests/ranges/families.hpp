// SPDX-License-Identifier: Apache-2.0
// The families as this program gives them to the library: copies, whose rows a test can change before it makes a control.
#pragma once

#include <array>

#include "dialect/dialect.hpp"

namespace nc::test {

/// In the order of their ids.
std::array<Dialect, NC_DIALECT_COUNT>& families();

}  // namespace nc::test
