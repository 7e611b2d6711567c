// SPDX-License-Identifier: Apache-2.0
// The lexer of languages that consist of ISO words (ISO 6983: a letter with a number). It turns the text of one block into a Block in one
// pass. A family names this lexer, or a reader of its own, in its rules.
#pragma once

#include "program/block.hpp"

namespace nc {

/// What the words of a dialect look like; a table in dialect/<family>/.
struct WordFormat {
  bool known = false;           ///< the address exists (else Condition::illegal_address)
  Condition refusal{};          ///< alarm for a word of an unknown address; none = Condition::illegal_address
  bool integer = false;         ///< decimals are cut off (M700 5.3: D H L M N O S T)
  bool round_keeps_unit = false;  ///< ROUND alone behind it rounds to the least unit of the word, and not to a whole number (HX 14.2.4)
  uint8_t integer_digits = 8;   ///< most digits before the point, up to 19; a word with more is Condition::value_range
  uint8_t fraction_digits = 8;  ///< most digits behind the point; where it is 8, more are accepted, too
};

/// The rules of a language of ISO words: those that everybody goes by, and those that only its lexer knows.
struct IsoRules : LexRules {
  bool statements = false;         ///< with `macros`: IF, WHILE, GOTO, ... exist, too
  bool zero_numbers = false;       ///< a number at the head of a block may be 0
  Condition skip_misuse{};         ///< of a block skip that is written wrong, or not at the head; none = as any number or character
  bool bare_sums = true;           ///< with `macros`: "X4.-1." is a sum; else formulas stand in brackets, and what follows a number begins a word
  bool slash_only_at_head = true;  ///< '/' skips a block only at its head; elsewhere it is an error (dgshape) or division (with macros)
  bool comma_words = false;        ///< ",R" ",C" ",A" ",I" ",J" ",S" ",D"
  bool jump_letter = false;        ///< the letter of sequence numbers may stand in front of the number behind GOTO (HX 14.5.1)
  uint16_t longest_block = 0;      ///< most characters of a block, blanks and comments not counted (HX 2.2.4); 0 = as many as find room
  bool percent_alone = false;      ///< no word may stand behind '%' in its block (DGSHAPE 2-6); else it is text
  uint32_t message_variable = 0;   ///< with `macros`: what stands behind the value given to this variable, from the first letter on, is a message; 0 = none
  WordFormat word[26];             ///< by address, 0 = A
};
/// The rules of a family of ISO words.
constexpr const IsoRules& iso_rules_of(const LexRules& rules) { return static_cast<const IsoRules&>(rules); }

/// Compiles the block that begins at text[0]. If `columns` is given, the text has been condensed, and columns[i] is the original column of
/// text[i] for i < 256. Sets every member of `block` except file, begin, next, line, next_line and end_of_text. Never reads beyond
/// text[size - 1]. `rules` are IsoRules. `semicolon` says what ';' means in this text; the rules have the meaning that is usual in the family.
LexResult lex_block(const char* text, size_t size, const LexRules& rules, Semicolon semicolon,
                    const uint8_t* columns, Block& block);

/// The rules that every family of ISO words starts from: this lexer, and O and N as the letters of a program and of a sequence number.
constexpr IsoRules iso_rules() {
  IsoRules rules{};
  rules.read = lex_block;
  rules.heads_scanned = true;
  rules.program_letter = 'O';
  rules.sequence_letter = 'N';
  return rules;
}

}  // namespace nc
