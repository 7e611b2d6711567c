// SPDX-License-Identifier: Apache-2.0
// RS-274/NGC 3.3: lines, words, parameters and expressions. Letters may be of either case and blanks may stand anywhere (3.3). A number means
// the same with or without a point (3.3.2.1).
#include "alarm/condition.hpp"
#include "dialect/iso/tables.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::iso {
namespace {

constexpr unsigned at(char letter) {
  return static_cast<unsigned>(letter - 'A');
}

constexpr IsoRules make_rules() {
  IsoRules rules = iso_rules();
  rules.program_letter = 0;  // LinuxCNC "O-codes": O does not begin a program but a control structure, which is not built
  rules.comments_end = true;
  rules.macros = true;       // RS-274/NGC 3.3.2.2, 3.3.2.3
  rules.formula = Formula::ngc;
  rules.most_brackets = 10;  // RS-274/NGC names no bound
  rules.semicolon = Semicolon::comment;
  rules.mdi_semicolon = Semicolon::comment;
  rules.slash_only_at_head = true;  // RS-274/NGC 3.3.1: the block delete character stands first; elsewhere it is a division
  rules.zero_numbers = true;        // RS-274/NGC 3.3.2.1: N0 to N99999
  for (const char* letter = "ABCDEFHIJKLMNPQRSTUVWXYZ"; *letter != 0; ++letter) {
    rules.word[at(*letter)].known = true;
    rules.word[at(*letter)].integer_digits = 11;
  }
  rules.word[at('G')].known = true;
  rules.word[at('G')].integer_digits = 3;
  rules.word[at('N')].integer = true;
  rules.word[at('N')].integer_digits = 8;
  rules.word[at('O')].refusal = Condition::control_structure;
  return rules;
}

}  // namespace

constexpr IsoRules kLex = make_rules();

}  // namespace nc::iso
