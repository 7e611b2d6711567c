// SPDX-License-Identifier: Apache-2.0
// A family whose language has keywords instead of letters with numbers, and no G or M codes. It is made of what any family is made of (dialect/dialect.hpp)
// and of a reader of its own; nothing else of the library knows of it. A program:
//
//     PROGRAM 1               ! what follows '!' in a line is a comment
//     FEED 500 | TOOL 3       ! '|' ends a block within a line
//     LABEL 10 LINE X+10 Y+20
//     CALL 2 TIMES 3
//     END
#pragma once

#include "dialect/dialect.hpp"

namespace nc::keywords {

extern const Dialect kDialect;

}  // namespace nc::keywords
