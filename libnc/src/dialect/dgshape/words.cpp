// SPDX-License-Identifier: Apache-2.0
// DGSHAPE 1-1, 1-5, 2-1 and 2-7: the words and their digits.
//
// "Range 1" is up to 8 digits without a point. With a point it is up to 99999.999 or, in inch, 9999.9999 (the print exchanges the two labels:
// four decimals belong to inch). Every word with a number may have eight digits here; the value itself is checked when the word is used.
#include "dialect/dgshape/tables.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::dgshape {
namespace {

constexpr unsigned at(char letter) {
  return static_cast<unsigned>(letter - 'A');
}

constexpr IsoRules make_rules() {
  IsoRules rules = iso_rules();
  rules.percent_alone = true;       // 2-6: "Never specify any word other than % in this block"
  rules.comments_end = true;        // 2-6: the text "between a ( and )"
  rules.slash_only_at_head = true;  // 2-6: "/" at the start of the block
  // P and K are real numbers in some functions (G51 P 0.5, arc centre K) and integers in others, so they are read as written.
  for (const char* letter = "XYZAIJKRFPQ"; *letter != 0; ++letter) rules.word[at(*letter)].known = true;
  // "Never append a decimal point" (2-4 for S, 2-6 for N and O, 1-5 for the others): digits behind a point are an error and are not dropped.
  for (const char* letter = "NOSMTDHL"; *letter != 0; ++letter) {
    rules.word[at(*letter)].known = true;
    rules.word[at(*letter)].fraction_digits = 0;
  }
  rules.word[at('G')].known = true;
  rules.word[at('G')].integer_digits = 2;  // 1-1 "two-digit numerical value following the G address"
  return rules;
}

}  // namespace

constexpr IsoRules kLex = make_rules();

}  // namespace nc::dgshape
