// SPDX-License-Identifier: Apache-2.0
// The SERIES 8 control: the manual is its "G Code" reference, a list of codes with a page for most of them.
#pragma once

#include "dialect/dialect.hpp"

namespace nc::series8 {

extern const Dialect kDialect;

}  // namespace nc::series8
