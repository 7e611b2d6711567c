// SPDX-License-Identifier: Apache-2.0
// DGSHAPE 1-1, 1-5, 2-1 and 2-7: the words and their digits.
//
// "Range 1" is up to 8 digits without a point; with a point 99999.999 or, in inch, 9999.9999 (the two labels
// are exchanged in print: four decimals belong to inch). Eight digits are what every number word may have;
// the value itself is checked where it is used.
#include "dialect/dgshape/tables.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::dgshape {
namespace {

constexpr unsigned at(char letter) {
  return static_cast<unsigned>(letter - 'A');
}

constexpr LexRules make_rules() {
  LexRules rules = iso_rules();
  rules.percent_alone = true;       // 2-6: "Never specify any word other than % in this block"
  rules.slash_only_at_head = true;  // 2-6: "/" at the start of the block
  // P and K are real numbers somewhere (G51 P 0.5, arc centre K) and integers elsewhere, so they are read as
  // written.
  for (const char* letter = "XYZAIJKRFPQ"; *letter != 0; ++letter) rules.word[at(*letter)].known = true;
  // "Never append a decimal point" (2-4 S, 2-6 N and O, 1-5 for the others): digits behind one are an error,
  // not dropped.
  for (const char* letter = "NOSMTDHL"; *letter != 0; ++letter) {
    rules.word[at(*letter)].known = true;
    rules.word[at(*letter)].fraction_digits = 0;
  }
  rules.word[at('G')].known = true;
  rules.word[at('G')].integer_digits = 2;  // 1-1 "two-digit numerical value following the G address"
  return rules;
}

}  // namespace

constexpr LexRules kLex = make_rules();

}  // namespace nc::dgshape
