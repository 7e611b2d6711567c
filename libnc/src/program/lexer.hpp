// SPDX-License-Identifier: Apache-2.0
// The lexer: text of one block -> Block, in one pass.
#pragma once

#include "program/block.hpp"

namespace nc {

struct LexResult {
  size_t used = 0;       ///< bytes up to the first character of the next block
  bool ran_out = false;  ///< the text ended before the block did: at the end of a program that is its end, in
                         ///< a window read more
  bool newline = false;  ///< ended by a line end
};

/// Compiles the block at text[0]. `columns`, when given, holds the column of text[i] for i < 256 (the text
/// has been condensed). Sets everything of `block` but file, begin, next, line, next_line and end_of_text.
/// Never reads beyond text[size - 1]. `semicolon` is what ';' is in this text (LexRules has that of a family).
LexResult lex_block(const char* text, size_t size, const LexRules& rules, Semicolon semicolon,
                    const uint8_t* columns, Block& block);

}  // namespace nc
