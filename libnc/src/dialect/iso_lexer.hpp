// SPDX-License-Identifier: Apache-2.0
// The lexer of languages of ISO words (ISO 6983: letters with numbers): text of one block -> Block, in one pass. A family names it, or
// another reader of its own, in its LexRules.
#pragma once

#include "program/block.hpp"

namespace nc {

/// Compiles the block at text[0]. `columns`, when given, holds the column of text[i] for i < 256 (the text
/// has been condensed). Sets everything of `block` but file, begin, next, line, next_line and end_of_text.
/// Never reads beyond text[size - 1]. `semicolon` is what ';' is in this text (LexRules has that of a family).
LexResult lex_block(const char* text, size_t size, const LexRules& rules, Semicolon semicolon,
                    const uint8_t* columns, Block& block);

/// What all families of ISO words begin with: this lexer, O and N at the head of a block.
constexpr LexRules iso_rules() {
  LexRules rules{};
  rules.read = lex_block;
  rules.program_letter = 'O';
  rules.sequence_letter = 'N';
  return rules;
}

}  // namespace nc
