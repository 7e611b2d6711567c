// SPDX-License-Identifier: Apache-2.0
// HX 2.2: a word is an address, one of the letters, and its data of up to 12 digits; a block has up to 300 characters.
#include "dialect/hx/tables.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::hx {
namespace {

constexpr unsigned at(char letter) {
  return static_cast<unsigned>(letter - 'A');
}

constexpr IsoRules make_rules() {
  IsoRules rules = iso_rules();
  rules.macros = rules.statements = true;        // 14
  rules.comments_end = true;                     // docs/decisions.md
  rules.semicolon = Semicolon::comment;          // 14.5: programs have a comment behind the end of a block
  rules.mdi_semicolon = Semicolon::ends_block;
  rules.skip_numbers = true;                     // 2.3.3
  rules.skip_misuse = Condition::block_skip;     // F_82017
  rules.bare_sums = false;                       // 14.2.4: X-[#1+#2]
  rules.slash_only_at_head = true;               // 14.2.4: elsewhere it is a division
  rules.comma_words = true;                      // 4.3.1, 4.3.2
  rules.jump_letter = true;                      // 14.5.1 prints GOTO N10
  rules.most_brackets = 10;                      // 14.2.4
  rules.longest_block = 300;                     // 2.2.4
  rules.most_loop_number = 9999;                 // 14.5.3 prints DO 210
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    rules.word[at(letter)] = WordFormat{.known = true, .refusal = {}, .integer = false, .integer_digits = 12, .fraction_digits = 8};
  for (const char* letter = "ABCIJQRUVWXYZ"; *letter != 0; ++letter) rules.word[at(*letter)].round_keeps_unit = true;  // 14.2.4: X[ROUND[#1]]; K may be a count
  for (const char* letter = "NO"; *letter != 0; ++letter) rules.word[at(*letter)].integer = true;
  rules.word[at('N')].integer_digits = 8;
  rules.word[at('O')].integer_digits = 8;
  rules.word[at('G')].integer_digits = 3;
  return rules;
}

}  // namespace

constexpr IsoRules kLex = make_rules();

}  // namespace nc::hx
