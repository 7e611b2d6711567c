// SPDX-License-Identifier: Apache-2.0
// M700 3.2 (digit table) and 5.3 (which addresses take a decimal point).
//
// The digit table gives each address one format for each setting unit (#1003): X5.3 for 0.001 mm to X5.6 for 0.000001 mm, X4.7 in inch. A
// word without a point may use all digits of both sides (X12345678 = 12345.678 mm). "The digit check uses the largest digit count of the
// address" (3.2, note), and the lexer does not know the unit, which is a parameter. So `integer_digits` is the largest total of all units, 11
// for a coordinate. A value that is too large for the unit in force is alarm P35 when the word is used.
#include "dialect/iso_lexer.hpp"
#include "dialect/m700/tables.hpp"

namespace nc::m700 {
namespace {

constexpr unsigned at(char letter) {
  return static_cast<unsigned>(letter - 'A');
}

constexpr WordFormat kCoordinate{.known = true, .integer = false, .integer_digits = 11, .fraction_digits = 8};
constexpr WordFormat kNumber8{.known = true, .integer = false, .integer_digits = 8, .fraction_digits = 8};
constexpr WordFormat kWhole8{.known = true, .integer = true, .integer_digits = 8, .fraction_digits = 8};

constexpr IsoRules make_rules() {
  IsoRules rules = iso_rules();
  rules.macros = rules.statements = true;  // 13.4, 13.5
  // 3.2 (2): ';' is printed where a block ends. In a line no other block begins behind it, since programs of other families have comments there.
  rules.semicolon = Semicolon::ends_line;
  rules.mdi_semicolon = Semicolon::ends_block;  // in MDI several blocks are typed in one line
  rules.skip_numbers = true;    // 3.4 prints "/" alone; "/2" is for the second skip switch of the family and
                                // can mean nothing else at the head of a block
  rules.slash_only_at_head = true;  // 3.4 (1): elsewhere '/' is a division
  rules.comma_words = true;         // 6.1 ,I  13.1.1 ,R ,I ,J  13.3.1 ,D  13.7 ,C ,R
  rules.angle_names = true;         // 13.3.1 M98 <file>
  rules.message_variable = 3000;    // 13.5.5; the text of #3006 "should be enclosed"
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    rules.word[at(letter)] = kCoordinate;  // A B C E I J K Q R U V W X Y Z
  // 5.3 drops the decimals of D, H, L, M, N, O, S and T. L, N and O are always whole numbers. D, H, M, S and T are macro arguments as well, which
  // "may carry a decimal point" (13.5.1): they are read as written and lose their decimals when they are used as numbers.
  for (const char* letter = "LNO"; *letter != 0; ++letter) rules.word[at(*letter)] = kWhole8;
  for (const char* letter = "DHMST"; *letter != 0; ++letter) rules.word[at(*letter)] = kNumber8;
  rules.word[at('N')].integer_digits = 6;  // 3.5
  rules.word[at('L')].integer_digits = 4;
  rules.word[at('G')].integer_digits = 3;  // "G3 or 2.1"
  // F6.3 to F6.6 and 0.001 to 10000000.000 mm/min (5.3): eight digits in front of the point. P has eight digits as a dwell, a program number and a
  // sequence number. It may have a point in G51 and, if #8112 says so, in G04 and the cycles (5.3).
  rules.word[at('F')] = kNumber8;
  rules.word[at('P')] = kNumber8;
  return rules;
}

}  // namespace

constexpr IsoRules kLex = make_rules();

}  // namespace nc::m700
