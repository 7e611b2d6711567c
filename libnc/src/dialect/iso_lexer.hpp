// SPDX-License-Identifier: Apache-2.0
// The lexer of languages that consist of ISO words (ISO 6983: a letter with a number). It turns the text of one block into a Block in one
// pass. A family names this lexer, or a reader of its own, in its LexRules.
#pragma once

#include "program/block.hpp"

namespace nc {

/// Compiles the block that begins at text[0]. If `columns` is given, the text has been condensed, and columns[i] is the original column of
/// text[i] for i < 256. Sets every member of `block` except file, begin, next, line, next_line and end_of_text. Never reads beyond
/// text[size - 1]. `semicolon` says what ';' means in this text; LexRules has the meaning that is usual in the family.
LexResult lex_block(const char* text, size_t size, const LexRules& rules, Semicolon semicolon,
                    const uint8_t* columns, Block& block);

/// The rules that every family of ISO words starts from: this lexer, and O and N as the letters of a program and of a sequence number.
constexpr LexRules iso_rules() {
  LexRules rules{};
  rules.read = lex_block;
  rules.heads_scanned = true;
  rules.program_letter = 'O';
  rules.sequence_letter = 'N';
  return rules;
}

}  // namespace nc
