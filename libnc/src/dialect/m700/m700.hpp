// SPDX-License-Identifier: Apache-2.0
// Mitsubishi CNC 700 series, machining centre: the manual is "700 Series Programming Manual (Machining Center
// System)".
#pragma once

#include "dialect/dialect.hpp"

namespace nc::m700 {

extern const Dialect kDialect;

}  // namespace nc::m700
