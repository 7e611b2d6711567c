// SPDX-License-Identifier: Apache-2.0
// A compiled block: one line of program text, split into words and statements, its expressions as code for
// the evaluator. Compiling looks at characters only; what a G code means is none of its business.
#pragma once

#include "base/fixed.hpp"
#include "stream/stream.hpp"

namespace nc {

/// How expressions are written and what they mean.
enum class Formula : uint8_t {
  macro,  ///< M700 13.5.6
  ngc     ///< RS-274/NGC 3.3.2.3, 3.3.2.4, and LinuxCNC's comparisons and named parameters
};

/// What the words of a dialect look like; a table in dialect/<family>/.
struct WordFormat {
  bool known = false;           ///< the address exists (else Condition::illegal_address)
  Condition refusal{};          ///< what a word of an address that is not known is, in place of that
  bool integer = false;         ///< decimals are cut off (M700 5.3: D H L M N O S T)
  uint8_t integer_digits = 8;   ///< at most 19; more in a word is Condition::value_range
  uint8_t fraction_digits = 8;  ///< more is accepted and kept when 8
};

/// What ';' is in a text.
enum class Semicolon : uint8_t {
  unknown,     ///< no character of the family
  ends_line,   ///< the end of the block, last in its line: blanks and comments in ( ) may follow, anything else is a fault
  comment,     ///< the rest of the line is a comment
  ends_block   ///< the end of the block; the next one may follow in the line
};

struct LexResult {
  size_t used = 0;       ///< bytes up to the first character of the next block
  bool ran_out = false;  ///< the text ended before the block did: at the end of a program that is its end, in
                         ///< a window read more
  bool newline = false;  ///< ended by a line end
};

struct Block;
struct LexRules;

/// Compiles the block at text[0] of a family's language. `columns`, when given, holds the column of text[i] for i < 256 (the text has been
/// condensed). Sets everything of `block` but file, begin, next, line, next_line and end_of_text. Never reads beyond text[size - 1].
/// `semicolon` is what ';' is in this text (LexRules has that of a family).
using ReadBlock = LexResult (*)(const char* text, size_t size, const LexRules& rules, Semicolon semicolon, const uint8_t* columns, Block& block);

struct LexRules {
  ReadBlock read = nullptr;        ///< reads a block of the language; never null in a family
  char program_letter = 0, sequence_letter = 0;  ///< of the numbers at the head of a block
  bool macros = false;             ///< '#', '[ ]' exist
  bool statements = false;         ///< with them: IF, WHILE, GOTO, ...
  Formula formula = Formula::macro;
  bool zero_numbers = false;       ///< a number at the head of a block may be 0
  Semicolon semicolon = Semicolon::unknown;      ///< in program texts; a machine may have made it a comment
  Semicolon mdi_semicolon = Semicolon::unknown;  ///< in blocks of MDI
  bool skip_numbers = false;       ///< "/3": switches 1..9; else only "/"
  bool slash_only_at_head = true;  ///< elsewhere '/' is an error (dgshape) or division (with macros)
  bool comma_words = false;        ///< ",R" ",C" ",A" ",I" ",J" ",S" ",D"
  bool angle_names = false;        ///< <FILE.NC> behind M98 G65
  bool jump_letter = false;        ///< the letter of sequence numbers may stand in front of the number behind GOTO (HX 14.5.1)
  uint32_t most_loop_number = 127; ///< of DO and END (M700 13.5.7)
  bool percent_alone = false;      ///< no word may stand behind '%' in its block (DGSHAPE 2-6); else it is text
  WordFormat word[26];             ///< by address, 0 = A
};

enum WordFlag : uint8_t {
  kWordPoint = 1,       ///< written with a decimal point
  kWordExpression = 2,  ///< value comes from `code`; always counts as with a point (M700 5.3)
  kWordComma = 4,       ///< ",R"
  kWordNegative = 8,    ///< written with '-': X-0 differs from X0 (M700 12.6)
  kWordNoValue = 16,    ///< letter alone: "G28 XYZ"
  kWordCount = 32,      ///< S1=, F1=: `index` holds the number before '='
  kWordPlus = 64,       ///< written with '+'
  kWordExponent = 128   ///< a lower-case e directly behind a number: X1e2
};

struct Word {
  char letter = 0;
  uint8_t flags = 0;
  uint8_t index = 0;
  uint8_t column = 0;  ///< 1-based, 255 = further right
  uint16_t code = 0;   ///< start in Block::code
  double value = 0;    ///< as written, sign included, no unit applied
};

enum class StatementKind : uint8_t {
  assign,    ///< #[target] = value
  if_goto,   ///< IF [value] GOTO target
  go_to,     ///< GOTO target
  while_do,  ///< WHILE [value] DO number
  do_loop,   ///< DO number
  end_loop,  ///< END number
  if_then,   ///< IF [value] THEN: the next statement belongs to it (option, off by default)
  set_name,  ///< SETVN: text
  open_port,
  close_port,
  print_decimal,
  print_binary  ///< POPEN PCLOS DPRNT BPRNT: text
};

struct Statement {
  StatementKind kind = StatementKind::assign;
  uint16_t target = 0;  ///< code giving the variable number / the sequence number
  uint16_t value = 0;   ///< code giving the value / the condition
  uint32_t number = 0;  ///< m of DOm, ENDm
  uint16_t text = 0,
           text_length = 0;  ///< range of Block::text: comment behind #3000=1(...), body of DPRNT[...]
};

/// 0xffff = no code.
inline constexpr uint16_t kNoCode = 0xffff;

struct Block {
  uint64_t begin = 0, next = 0;      ///< byte offsets: first character, first character of the next block
  uint32_t line = 0, next_line = 0;  ///< 1-based line of the first character, and of `next`
  uint16_t file = 0;
  bool percent = false;      ///< a '%' block
  bool end_of_text = false;  ///< nothing was left
  uint8_t skip = 0;          ///< optional block skip number, 0 = none
  bool has_n = false, has_o = false;
  uint32_t n = 0, o = 0;
  bool empty = true;  ///< no word and no statement (comments do not count)
  bool ordinary = false;  ///< words or statements and nothing to look at before them: no '%', O, N, skip or fault, not the end
  bool has_fault = false;
  Fault fault{};                ///< first error, raised when the block is executed
  FixedVector<Word, 48> words;  ///< without O, N and the skip
  FixedVector<Statement, 12> statements;
  FixedVector<uint8_t, 480> code;  ///< expression code, see macro/expression.hpp
  FixedVector<double, 64> constants;
  FixedVector<char, 256> text;         ///< messages and names, raw
  uint16_t name = 0, name_length = 0;  ///< <...> as a range of `text`
  uint16_t comment = 0,
           comment_length = 0;  ///< last ( ) as a range of `text` (only kept where it may be a message)

  void clear();  ///< sizes to zero, flags off; arrays are not touched
};

inline void Block::clear() {
  begin = next = 0;
  line = next_line = 0;
  file = 0;
  percent = end_of_text = has_n = has_o = has_fault = false;
  skip = 0;
  n = o = 0;
  empty = true;
  ordinary = false;
  fault = Fault{};
  words.clear();
  statements.clear();
  code.clear();
  constants.clear();
  text.clear();
  name = name_length = comment = comment_length = 0;
}

}  // namespace nc
