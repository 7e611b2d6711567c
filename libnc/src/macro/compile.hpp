// SPDX-License-Identifier: Apache-2.0
// The expression compiler: text -> short stack code in the block that it stands in. Private to the lexer and
// expression.hpp.
//
//   formula   = [sign] operand { operator [sign] operand }      binding: + - OR XOR weakest, then * / MOD AND, then functions (M700 13.5.6)
//   operand   = number | variable | '[' formula ']' | function '[' formula ']' | '[' '#' NAME ']'
//   variable  = '#' digits | '#' variable | '#' '[' formula ']'                                    (M700 13.4 (1))
//   condition = '[' formula (EQ NE GT LT GE LE) formula ']'                                        (M700 13.5.7)
#pragma once

#include "macro/expression.hpp"
#include "program/cursor.hpp"

namespace nc {

/// Instructions of the stack machine. The operands named here (u8: one byte, u16: two bytes, lowest first, ...) follow the byte of the instruction.
enum class Op : uint8_t {
  end,
  constant,     ///< u8: push Block::constants[u8]
  small,        ///< i16: push
  variable,     ///< u24: push the value of this variable
  load,         ///< replace the number of a variable by the value of that variable
  name,         ///< u16 u8: push the number of the variable with a name; begin and length of the name in Block::text
  named,        ///< u16 u8: push the value of the parameter with a name
  name_for_writing,  ///< u16 u8: push the number of the parameter with a name; if there is none yet, make it
  exists,       ///< u16 u8: push whether the parameter with a name has a value: 1 or 0
  zero_for_vacant,  ///< replace a vacant value by 0
  check_number,  ///< check that the value is the number of a variable, and leave it
  negate,       ///< change the sign; vacant becomes 0
  negate_word,  ///< vacant stays vacant: X-#1 is ignored like X#1 (M700 13.5.4)
  add,
  subtract,
  bit_or,
  bit_xor,
  multiply,
  divide,
  modulo,
  power,
  remainder,
  logic_and,
  logic_or,
  logic_xor,
  atan2,
  bit_and,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sqrt,
  abs,
  bin,
  bcd,
  round,
  fix,
  fup,
  floor,
  ceil,
  ln,
  exp,
  equal,
  not_equal,
  greater,
  less,
  greater_equal,
  less_equal
};

/// The most brackets that may be open at once in any family (HX 14.2.4: ten); RS-274/NGC names no bound. LexRules::most_brackets is the family's own.
inline constexpr unsigned kMaxBrackets = 10;
/// Values of a stack that no expression can exceed: of each level (brackets, and outside of them) two operands can wait, in RS-274/NGC five, one for each
/// step of binding; and a few more for the operand at work.
inline constexpr unsigned kStackDepth = 5 * (kMaxBrackets + 1) + 4;

/// The largest variable number that the code can hold (24 bits). Which numbers exist is checked only when a variable is read or written.
inline constexpr uint32_t kMaxVariable = 0xffffff;

struct Keyword {
  const char* text;
  Op op;
};

template <size_t N>
bool accept_keyword(Cursor& at, const Keyword (&table)[N], Op* op) {
  for (const Keyword& k : table) {
    if (at.accept(k.text)) {
      *op = k.op;
      return true;
    }
  }
  return false;
}

/// True when the name of a function and '[' stand here, as in XSIN[30].
bool starts_function(Cursor at, Formula formula);

class ExpressionCompiler {
 public:
  ExpressionCompiler(Block& block, Cursor* at, const LexRules& rules) : block_(block), at_(*at), ngc_(rules.formula == Formula::ngc), most_brackets_(rules.most_brackets) {}

  static bool starts_ngc_function(Cursor at);

  /// A formula, up to the first character that cannot belong to it.
  bool expression(uint16_t* code) { return start(code) && (ngc_ ? ngc_value(0) : sum(0, false)) && emit(Op::end); }
  /// The value of a word without brackets around it: only + - * / may stand in it, and those only with `sums`; a sign at its head belongs to the word.
  bool word_value(uint16_t* code, bool sums);
  /// Where the value that word_value() has compiled is ROUND of something, with or without a sign, it becomes that something, vacant still as 0: the word
  /// is then rounded as every word is.
  void leave_lone_round_out();
  /// '[' formula comparison formula ']'
  bool condition(uint16_t* code);
  /// A formula, or two formulas with a comparison between them, with or without brackets around it.
  bool expression_or_condition(uint16_t* code);
  /// '#' ..., or [#NAME]: code that gives the number of the variable, and not its value.
  bool variable_number(uint16_t* code);

  const Fault& fault() const { return fault_; }

 private:
  bool start(uint16_t* code);
  bool sum(unsigned depth, bool comparison_allowed);
  bool product(unsigned depth, bool comparison_allowed);
  bool signed_operand(unsigned depth, bool comparison_allowed);
  bool operand(unsigned depth, bool comparison_allowed, bool negative);
  bool bracket(unsigned depth, bool comparison_allowed);
  bool comparison(unsigned depth, bool* found);
  bool variable(unsigned depth, bool value_wanted);
  bool name(unsigned depth);
  bool number(bool negative);
  bool constant(double value);
  bool variable_code(uint32_t number);
  bool emit(Op op) { return byte(static_cast<uint8_t>(op)); }
  bool byte(unsigned value);
  bool ngc_formula(unsigned depth, unsigned step);
  bool ngc_value(unsigned depth);
  bool ngc_bracket(unsigned depth);
  bool ngc_parameter(unsigned depth);
  bool ngc_number(unsigned depth);
  bool ngc_index(uint32_t* number);
  bool ngc_name(Op op);
  bool ngc_target();
  Condition unclosed(unsigned open, Condition otherwise) const;
  bool fail(Condition condition);
  bool fail(Condition condition, double value);

  Block& block_;
  Cursor& at_;
  Fault fault_;
  const bool ngc_;
  const unsigned most_brackets_;
  unsigned behind_round_ = 0;  ///< place in the code behind the ROUND that was compiled last, 0 = none
  bool word_ = false;      ///< the value of a word without brackets is being compiled
  bool compared_ = false;  ///< a comparison has been compiled
};

}  // namespace nc
