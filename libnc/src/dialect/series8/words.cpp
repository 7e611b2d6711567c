// SPDX-License-Identifier: Apache-2.0
// Words as the examples of the manual write them: a letter and a number with or without a point, or a letter alone; ';' begins a comment.
#include "dialect/iso_lexer.hpp"
#include "dialect/series8/tables.hpp"

namespace nc::series8 {
namespace {

constexpr unsigned at(char letter) { return static_cast<unsigned>(letter - 'A'); }

constexpr IsoRules make_rules() {
  IsoRules rules = iso_rules();
  rules.program_letter = 0;
  rules.semicolon = Semicolon::comment;
  rules.mdi_semicolon = Semicolon::comment;
  rules.zero_numbers = true;
  for (const char* letter = "ABCDFIJKLMNPQRSTUVWXYZ"; *letter != 0; ++letter) rules.word[at(*letter)].known = true;
  rules.word[at('G')].known = true;
  rules.word[at('G')].integer_digits = 2;
  for (const char* letter = "DLMNST"; *letter != 0; ++letter) rules.word[at(*letter)].fraction_digits = *letter == 'L' ? 8 : 0;
  return rules;
}

}  // namespace

constexpr IsoRules kLex = make_rules();

}  // namespace nc::series8
