// SPDX-License-Identifier: Apache-2.0
// What a line of another control has in its text and no family has here: the cause of an alarm that would say little by itself.
#pragma once

#include "dialect/dialect.hpp"
#include "dialect/text.hpp"

namespace nc {

/// What a line of LinuxCNC has and this family has not.
enum class LinuxcncWord : uint8_t { none, o_word, named_parameter };

/// Searches the whole line except comments: for an O-word at its beginning, or behind N, '/' or another word; an O behind a letter is a part of a name.
LinuxcncWord linuxcnc_word(const char* line);

/// Says what the family has in place of it.
void put_linuxcnc_hint(const Dialect& family, LinuxcncWord word, TextWriter& out);

}  // namespace nc
