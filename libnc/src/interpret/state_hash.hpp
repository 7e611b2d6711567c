// SPDX-License-Identifier: Apache-2.0
// One number for everything that decides how a program goes on: the state of an interpreter and every table that blocks write.
#pragma once

#include <cstdint>

namespace nc {

struct Interpreter;

/// When two hashes differ, a block could tell the two states apart, or something that the states name has been entered anew. When they are the same (chance
/// apart, 1 in 2^64), the program goes on in the same way, as long as nothing from outside differs. The function reads every variable, offset and
/// parameter, so it is not meant for every block.
uint64_t state_hash(const Interpreter& in);

/// The same of offsets, coordinate systems and parameters alone.
uint64_t tables_hash(const Interpreter& in);

}  // namespace nc
