// SPDX-License-Identifier: Apache-2.0
// One number for all that a program can go by: the state of an interpreter and every table that blocks write.
#pragma once

#include <cstdint>

namespace nc {

struct Interpreter;

/// Two numbers that differ: a block could tell the two states apart, or what they name has been entered anew. The same number twice (but for one case in
/// 2^64): as long as nothing from outside differs, what follows is the same. Looks at every variable, offset and parameter, so it is not for every block.
uint64_t state_hash(const Interpreter& in);

}  // namespace nc
