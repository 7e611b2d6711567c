// SPDX-License-Identifier: Apache-2.0
// DGSHAPE NC code (JIS codes) of modelling machines: the manual is DGSHAPE's "NC Code Reference Manual".
#pragma once

#include "dialect/dialect.hpp"

namespace nc::dgshape {

extern const Dialect kDialect;

}  // namespace nc::dgshape
