// SPDX-License-Identifier: Apache-2.0
// Expressions of RS-274/NGC 3.3.2.3 and 3.3.2.4, with LinuxCNC's comparisons and named parameters. What differs from macro/compile.cpp:
//
//   * outside of [ ] a value is a number, a parameter, an expression in brackets or a function, never a formula: X1+2 is an error;
//   * operators bind in five steps: ** first, then * / MOD, then + -, then EQ NE GT GE LT LE, then AND OR XOR, which only know true and false;
//     operators of the same step are executed from left to right, ** included;
//   * ATAN has two arguments, ATAN[y]/[x]; FIX rounds down and FUP up, also below 0; MOD is never negative;
//   * a parameter without a value counts as 0; a named parameter without a value is an error.
#include "alarm/condition.hpp"
#include "macro/compile.hpp"

namespace nc {
namespace {

constexpr Keyword kNgcFunctions[] = {{"ACOS", Op::acos}, {"ASIN", Op::asin}, {"ATAN", Op::atan2}, {"ABS", Op::abs},   {"COS", Op::cos},
                                  {"EXISTS", Op::exists}, {"EXP", Op::exp}, {"FIX", Op::floor}, {"FUP", Op::ceil}, {"LN", Op::ln},
                                  {"ROUND", Op::round}, {"SIN", Op::sin}, {"SQRT", Op::sqrt}, {"TAN", Op::tan}};

/// Steps of binding, from the weakest to the strongest.
enum Step : unsigned { kLogic, kComparison, kSum, kProduct, kPower, kSteps };
struct Operator {
  const char* text;
  Op op;
  Step step;
};
constexpr Operator kOperators[] = {
    {"AND", Op::logic_and, kLogic}, {"XOR", Op::logic_xor, kLogic}, {"OR", Op::logic_or, kLogic},
    {"EQ", Op::equal, kComparison}, {"NE", Op::not_equal, kComparison}, {"GT", Op::greater, kComparison},
    {"GE", Op::greater_equal, kComparison}, {"LT", Op::less, kComparison}, {"LE", Op::less_equal, kComparison},
    {"+", Op::add, kSum}, {"-", Op::subtract, kSum},
    {"**", Op::power, kPower}, {"*", Op::multiply, kProduct}, {"/", Op::divide, kProduct}, {"MOD", Op::remainder, kProduct},
};

/// Takes the operator that comes next, if it belongs to `step`.
bool accept_operator(Cursor& at, unsigned step, Op* op) {
  for (const Operator& row : kOperators) {
    const Cursor before = at;
    if (!at.accept(row.text)) continue;
    if (row.step == step) {
      *op = row.op;
      return true;
    }
    at = before;
    return false;
  }
  return false;
}

}  // namespace

bool ExpressionCompiler::starts_ngc_function(Cursor at) {
  Op op{};
  return accept_keyword(at, kNgcFunctions, &op) && at.peek() == '[';
}

bool ExpressionCompiler::ngc_formula(unsigned depth, unsigned step) {
  if (step == kSteps) return ngc_value(depth);
  if (!ngc_formula(depth, step + 1)) return false;
  for (Op op{}; accept_operator(at_, step, &op);)
    if (!ngc_formula(depth, step + 1) || !emit(op)) return false;
  return true;
}

bool ExpressionCompiler::ngc_value(unsigned depth) {
  const char c = at_.peek();
  if (c == '-' || c == '+') {
    ++at_.p;
    const char next = at_.peek();
    if (next == '-' || next == '+') return fail(Condition::calculation);
    if (is_digit(next) || next == '.') return number(c == '-');
    return ngc_value(depth) && (c == '+' || emit(Op::negate));
  }
  if (is_digit(c) || c == '.') return number(false);
  if (c == '[') return ngc_bracket(depth);
  if (c == '#') {
    ++at_.p;
    return ngc_parameter(depth);
  }
  Op op{};
  if (!is_letter(c) || !accept_keyword(at_, kNgcFunctions, &op)) return fail(depth == 0 ? c == ']' ? Condition::bracket_pair : Condition::calculation
                                                                                    : at_.at_end() ? Condition::bracket_pair : Condition::calculation);
  if (at_.peek() != '[') return fail(Condition::calculation);
  if (op == Op::exists) {
    at_.accept('[');
    return at_.accept('#') ? ngc_name(Op::exists) && (at_.accept(']') || fail(unclosed(depth + 1, Condition::variable_name))) : fail(Condition::variable_name);
  }
  if (!ngc_bracket(depth)) return false;
  if (op != Op::atan2) return emit(op);
  if (!at_.accept('/') || at_.peek() != '[') return fail(Condition::calculation);
  return ngc_bracket(depth) && emit(op);
}

bool ExpressionCompiler::ngc_bracket(unsigned depth) {
  if (depth == most_brackets_) return fail(Condition::bracket_nesting);
  ++at_.p;
  if (!ngc_formula(depth + 1, 0)) return false;
  return at_.accept(']') || fail(unclosed(depth + 1, Condition::calculation));
}

/// Behind '#': the value of the parameter whose number or name stands here; each further '#' takes the value as the number of another parameter. The '#' are
/// counted in a loop and not by recursion, so that a line with very many of them does not overflow the small stack of a firmware.
bool ExpressionCompiler::ngc_parameter(unsigned depth) {
  unsigned more = 0;
  while (at_.accept('#')) ++more;
  const char c = at_.peek();
  uint32_t number = 0;
  bool good = false;
  if (c == '<') {
    good = ngc_name(Op::named);
  } else if (is_digit(c)) {
    good = ngc_index(&number) && variable_code(number) && emit(Op::zero_for_vacant);
  } else {
    good = ngc_number(depth) && emit(Op::load) && emit(Op::zero_for_vacant);
  }
  for (; good && more > 0; --more) good = emit(Op::load) && emit(Op::zero_for_vacant);
  return good;
}

/// The number of a parameter where it is a value itself: ##2, #[1+2].
bool ExpressionCompiler::ngc_number(unsigned depth) {
  const char c = at_.peek();
  if (c == '[') return ngc_bracket(depth);
  if (!at_.accept('#')) return fail(Condition::variable_number);
  return ngc_parameter(depth);
}

bool ExpressionCompiler::ngc_index(uint32_t* number) {
  const Decimal d = at_.number();
  if (d.point) return fail(Condition::variable_number);
  if (d.integer > kMaxVariable) return fail(Condition::variable_number, d.value);
  *number = static_cast<uint32_t>(d.integer);
  return true;
}

/// A <name>; it is put into Block::text in capitals and without blanks.
bool ExpressionCompiler::ngc_name(Op op) {
  if (!at_.accept('<')) return fail(Condition::variable_name);
  const unsigned begin = block_.text.size();
  for (char c = at_.peek(); c != '>'; c = at_.peek()) {
    if (c == 0) return fail(Condition::variable_name);
    if (!block_.text.push_back(c)) return fail(Condition::block_too_long);
    ++at_.p;
  }
  ++at_.p;
  const unsigned length = block_.text.size() - begin;
  if (length == 0 || length > UINT8_MAX) return fail(Condition::variable_name);
  return emit(op) && byte(begin & 0xff) && byte(begin >> 8) && byte(length);
}

bool ExpressionCompiler::ngc_target() {
  if (!at_.accept('#')) return fail(Condition::format_error);
  const char c = at_.peek();
  if (c == '<') return ngc_name(Op::name_for_writing);
  if (!is_digit(c)) return ngc_number(0) && emit(Op::check_number);
  uint32_t number = 0;
  return ngc_index(&number) && constant(number);
}

}  // namespace nc
