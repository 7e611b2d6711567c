// SPDX-License-Identifier: Apache-2.0
// A compiled block: one line of program text, split into words and statements, its expressions turned into code for the evaluator. Compiling looks only at
// the characters; it does not know what a G code means.
#pragma once

#include "base/fixed.hpp"
#include "program/word_slot.hpp"
#include "stream/stream.hpp"

namespace nc {

/// How expressions are written and what they mean.
enum class Formula : uint8_t {
  macro,  ///< M700 13.5.6
  ngc     ///< RS-274/NGC 3.3.2.3, 3.3.2.4, and LinuxCNC's comparisons and named parameters
};

/// The meaning of ';' in a text.
enum class Semicolon : uint8_t {
  unknown,     ///< the family does not have this character
  ends_line,   ///< it ends the block, and the line: only blanks and comments in ( ) may follow in the line, anything else is a fault
  comment,     ///< it begins a comment, which ends with the line
  ends_block   ///< it ends the block; the next block may follow in the same line
};

struct LexResult {
  size_t used = 0;       ///< bytes up to the first character of the next block
  bool ran_out = false;  ///< the text ended before the block did: at the end of a program the block ends there, in a window more has to be
                         ///< read
  bool newline = false;  ///< the block was ended by a line end
};

struct Block;
struct LexRules;

/// Compiles the block at text[0] in a family's language. `columns` is given when the text has been condensed, and holds the column of text[i] for
/// i < 256. Sets all members of `block` except file, begin, next, line, next_line and end_of_text. Never reads beyond text[size - 1]. `semicolon` is the
/// meaning of ';' in this text (LexRules has the one of the family).
using ReadBlock = LexResult (*)(const char* text, size_t size, const LexRules& rules, Semicolon semicolon, const uint8_t* columns, Block& block);

/// What everybody but the reader itself goes by of a family's language. The reader gets these rules back and may have put more behind them (IsoRules in
/// dialect/iso_lexer.hpp).
struct LexRules {
  ReadBlock read = nullptr;        ///< reads a block of the language; never null in a family
  /// A text of the language is one of ISO 6983: a block ends with its line or ';', comments stand in ( ), blanks mean nothing, and program and sequence numbers
  /// stand with their letters at the head of a block. Searches then pass over what is behind the head, and a block that is longer than the window is read
  /// without its blanks and comments. Otherwise searches read every block, and a block ends at the latest with its line.
  bool heads_scanned = false;
  char program_letter = 0, sequence_letter = 0;  ///< letters of the program and sequence numbers at the head of a block
  bool skip_numbers = false;       ///< true: "/1" to "/9" name the skip switch; false: only "/" exists
  bool comments_end = false;       ///< a comment without ')' is a fault (RS-274/NGC 3.3.4, DGSHAPE 2-6); otherwise it ends with its line
  bool angle_names = false;        ///< <FILE.NC> behind M98 G65, in which a blank is a character
  bool macros = false;             ///< the language has variables and formulas: '#' and '[ ]' in one of ISO words
  Formula formula = Formula::macro;              ///< of which kind
  uint8_t most_brackets = 5;       ///< of a formula, open at once (M700 13.4 (Note 2))
  uint32_t most_loop_number = 127; ///< of DO and END (M700 13.5.7)
  Semicolon semicolon = Semicolon::unknown;      ///< meaning in program texts; a parameter of the machine may make it a comment
  Semicolon mdi_semicolon = Semicolon::unknown;  ///< meaning in blocks of MDI
};

enum WordFlag : uint8_t {
  kWordPoint = 1,       ///< written with a decimal point
  kWordExpression = 2,  ///< value comes from `code`; always counts as with a point (M700 5.3)
  kWordComma = 4,       ///< ",R"
  kWordNegative = 8,    ///< written with '-': X-0 differs from X0 (M700 12.6)
  kWordNoValue = 16,    ///< letter alone: "G28 XYZ"
  kWordCount = 32,      ///< S1=, F1=: `index` holds the number before '='
  kWordPlus = 64,       ///< written with '+'
  kWordExponent = 128   ///< a lower-case e stands directly behind the number: X1e2
};

struct Word {
  WordSlot slot = kNoWord;
  uint8_t flags = 0;
  uint8_t index = 0;
  uint8_t column = 0;  ///< from 1; 255 = this or any column further right
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
  uint64_t begin = 0, next = 0;      ///< byte offsets of its first character, and of the first character of the next block
  uint32_t line = 0, next_line = 0;  ///< lines of these characters, from 1
  uint16_t file = 0;
  bool percent = false;      ///< a '%' block
  bool end_of_text = false;  ///< there is no block: the text has ended
  uint8_t skip = 0;          ///< optional block skip number, 0 = none
  bool has_n = false, has_o = false;
  uint32_t n = 0, o = 0;
  bool empty = true;  ///< no word and no statement (comments do not count)
  bool ordinary = false;  ///< only words or statements: there is no '%', O, N, skip, fault or end of text to look at before them
  bool has_fault = false;
  Fault fault{};                ///< first error, raised when the block is executed
  FixedVector<Word, 48> words;  ///< without O, N and the skip
  FixedVector<Statement, 12> statements;
  FixedVector<uint8_t, 480> code;  ///< expression code, see macro/expression.hpp
  FixedVector<double, 64> constants;
  FixedVector<char, 256> text;         ///< messages and names as they are written
  uint16_t name = 0, name_length = 0;  ///< <...> as a range of `text`
  uint16_t comment = 0,
           comment_length = 0;  ///< last ( ) as a range of `text` (only kept where it may be a message)

  void clear();  ///< sets all sizes to 0 and all flags off, without clearing the arrays
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
