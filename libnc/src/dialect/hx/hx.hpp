// SPDX-License-Identifier: Apache-2.0
// TurboTek HX, machining centre, by its programming manual (cited "HX" with the section where it is not plain).
#pragma once

#include "dialect/dialect.hpp"

namespace nc::hx {

extern const Dialect kDialect;

}  // namespace nc::hx
