// SPDX-License-Identifier: Apache-2.0
#include "macro/compile.hpp"

#include "alarm/condition.hpp"

namespace nc {
namespace {

// M700 13.5.6. A name that begins with another name of the table stands before it, so that it is found first.
constexpr Keyword kFunctions[] = {
    {"ASIN", Op::asin}, {"ACOS", Op::acos}, {"ATAN", Op::atan}, {"ATN", Op::atan},    {"ABS", Op::abs},
    {"SIN", Op::sin},   {"SQRT", Op::sqrt}, {"SQR", Op::sqrt},  {"COS", Op::cos},     {"TAN", Op::tan},
    {"BIN", Op::bin},   {"BCD", Op::bcd},   {"RND", Op::round}, {"ROUND", Op::round}, {"FIX", Op::fix},
    {"FUP", Op::fup},   {"LN", Op::ln},     {"EXP", Op::exp}};

constexpr Keyword kAdditive[] = {{"OR", Op::bit_or}, {"XOR", Op::bit_xor}};
constexpr Keyword kMultiplicative[] = {{"MOD", Op::modulo}, {"AND", Op::bit_and}};
constexpr Keyword kComparisons[] = {{"EQ", Op::equal}, {"NE", Op::not_equal},     {"GT", Op::greater},
                                    {"LT", Op::less},  {"GE", Op::greater_equal}, {"LE", Op::less_equal}};

}  // namespace

bool starts_function(Cursor at, Formula formula) {
  if (formula == Formula::ngc) return ExpressionCompiler::starts_ngc_function(at);
  Op op{};
  return accept_keyword(at, kFunctions, &op) && at.peek() == '[';
}

bool ExpressionCompiler::start(uint16_t* code) {
  *code = static_cast<uint16_t>(block_.code.size());
  return true;
}

bool ExpressionCompiler::word_value(uint16_t* code, bool sums) {
  start(code);
  word_ = true;
  return (ngc_ ? ngc_value(0) : sums ? sum(0, false) : signed_operand(0, false)) && emit(Op::end);
}

void ExpressionCompiler::leave_lone_round_out() {
  if (behind_round_ == 0) return;
  const unsigned size = block_.code.size();  // the last instruction is Op::end
  const auto at = [this](unsigned place) { return static_cast<Op>(block_.code[place]); };
  const bool with_sign = behind_round_ + 2 == size && (at(behind_round_) == Op::negate || at(behind_round_) == Op::negate_word);
  if (behind_round_ + 1 == size || with_sign) block_.code[behind_round_ - 1] = static_cast<uint8_t>(Op::zero_for_vacant);
}

bool ExpressionCompiler::condition(uint16_t* code) {
  start(code);
  if (at_.peek() != '[') return fail(Condition::calculation);
  if (!bracket(0, true)) return false;
  return compared_ ? emit(Op::end) : fail(Condition::calculation);
}

bool ExpressionCompiler::expression_or_condition(uint16_t* code) {
  start(code);
  if (!sum(0, true)) return false;
  bool found = false;
  if (!compared_ && !comparison(0, &found)) return false;
  return emit(Op::end);
}

bool ExpressionCompiler::comparison(unsigned depth, bool* found) {
  Op op{};
  *found = is_letter(at_.peek()) && accept_keyword(at_, kComparisons, &op);
  if (!*found) return true;
  compared_ = true;
  return sum(depth, false) && emit(op);
}

bool ExpressionCompiler::sum(unsigned depth, bool comparison_allowed) {
  if (!product(depth, comparison_allowed)) return false;
  for (;;) {
    const char c = at_.peek();
    Op op{};
    if (c == '+' || c == '-') {
      op = c == '+' ? Op::add : Op::subtract;
      ++at_.p;
    } else if (!is_letter(c) || (word_ && depth == 0) || !accept_keyword(at_, kAdditive, &op)) {
      return true;
    }
    if (!product(depth, false) || !emit(op)) return false;
  }
}

bool ExpressionCompiler::product(unsigned depth, bool comparison_allowed) {
  if (!signed_operand(depth, comparison_allowed)) return false;
  for (;;) {
    const char c = at_.peek();
    Op op{};
    if (c == '*' || c == '/') {
      op = c == '*' ? Op::multiply : Op::divide;
      ++at_.p;
    } else if (!is_letter(c) || (word_ && depth == 0) || !accept_keyword(at_, kMultiplicative, &op)) {
      return true;
    }
    if (!signed_operand(depth, false) || !emit(op)) return false;
  }
}

/// There may be one sign at most: --5 must be written -[-5] (M700 13.4 (1)).
bool ExpressionCompiler::signed_operand(unsigned depth, bool comparison_allowed) {
  const char c = at_.peek();
  if (c != '-' && c != '+') return operand(depth, comparison_allowed, false);
  ++at_.p;
  const char next = at_.peek();
  if (next == '-' || next == '+') return fail(Condition::calculation);
  const bool literal = is_digit(next) || next == '.';
  if (!operand(depth, false, literal && c == '-')) return false;
  if (c == '+' || literal) return true;
  return emit(word_ && depth == 0 ? Op::negate_word : Op::negate);
}

bool ExpressionCompiler::operand(unsigned depth, bool comparison_allowed, bool negative) {
  const char c = at_.peek();
  if (is_digit(c) || c == '.') return number(negative);
  if (c == '#') return variable(depth, true);
  if (c == '[') return bracket(depth, comparison_allowed);
  Op op{};
  if (is_letter(c) && accept_keyword(at_, kFunctions, &op)) {
    if (at_.peek() != '[') return fail(Condition::calculation);  // M700 13.5.6 (Note 3)
    if (!bracket(depth, false) || !emit(op)) return false;
    if (op == Op::round) behind_round_ = block_.code.size();
    return true;
  }
  // There is a ']' too many, or the block ends before a '[' is closed.
  const bool unpaired = depth == 0 ? c == ']' : at_.at_end();
  return fail(unpaired ? Condition::bracket_pair : Condition::calculation);
}

bool ExpressionCompiler::bracket(unsigned depth, bool comparison_allowed) {
  if (depth == most_brackets_) return fail(Condition::bracket_nesting);  // M700 P280
  ++at_.p;
  if (at_.peek() == '#') {
    Cursor ahead = at_;
    ++ahead.p;
    if (is_letter(ahead.peek())) return name(depth) && emit(Op::load);
  }
  if (!sum(depth + 1, false)) return false;
  if (comparison_allowed && depth == 0) {
    bool found = false;
    if (!comparison(depth + 1, &found)) return false;
  }
  return at_.accept(']') || fail(unclosed(depth + 1, Condition::calculation));
}

/// The fault where a ']' is expected and does not stand, with `open` brackets open: the block has not as many '[' as ']' (M700 App. 1, P281), or something
/// else stands before it (`otherwise`).
Condition ExpressionCompiler::unclosed(unsigned open, Condition otherwise) const {
  Cursor ahead = at_;
  for (ahead.skip(); !ahead.at_end(); ahead.skip()) {
    const char c = *ahead.p++;
    if (c == '[') ++open;
    if (c == ']' && open-- == 0) return Condition::bracket_pair;
  }
  return open == 0 ? otherwise : Condition::bracket_pair;
}

/// #NAME] of SETVN (M700 13.5.5 (10.12)); the cursor is on '#'.
bool ExpressionCompiler::name(unsigned depth) {
  ++at_.p;
  const unsigned begin = block_.text.size();
  for (char c = at_.peek(); is_letter(c) || is_digit(c); c = at_.peek()) {
    if (!block_.text.push_back(c)) return fail(Condition::block_too_long);
    ++at_.p;
  }
  const unsigned length = block_.text.size() - begin;
  if (length > UINT8_MAX) return fail(Condition::variable_name);
  if (!at_.accept(']')) return fail(unclosed(depth + 1, Condition::variable_name));
  return emit(Op::name) && byte(begin & 0xff) && byte(begin >> 8) && byte(length);
}

bool ExpressionCompiler::variable_number(uint16_t* code) {
  start(code);
  if (ngc_) return ngc_target() && emit(Op::end);
  if (at_.peek() == '#') return variable(0, false) && emit(Op::end);
  if (!at_.accept('[') || at_.peek() != '#') return fail(Condition::format_error);
  Cursor ahead = at_;
  ++ahead.p;
  if (!is_letter(ahead.peek())) return fail(Condition::format_error);
  return name(0) && emit(Op::end);
}

/// '#' { '#' } ( digits | '[' formula ']' ). Each further '#' takes the value before it as the number of a
/// variable.
bool ExpressionCompiler::variable(unsigned depth, bool value_wanted) {
  unsigned hashes = 0;
  for (; at_.accept('#'); ++hashes) {
  }
  const char c = at_.peek();
  unsigned loads = value_wanted ? hashes : hashes - 1;
  if (is_digit(c)) {
    const Decimal d = at_.number();
    if (d.point) return fail(Condition::variable_number);
    if (d.integer > kMaxVariable) return fail(Condition::variable_number, d.value);
    const uint32_t number = static_cast<uint32_t>(d.integer);
    if (loads == 0) return constant(number);
    if (!variable_code(number)) return false;
    --loads;
  } else if (c == '[') {
    if (!bracket(depth, false)) return false;
  } else {
    return fail(is_letter(c) ? Condition::variable_name : Condition::variable_number);  // #-5: M700 P241
  }
  for (; loads != 0; --loads) {
    if (!emit(Op::load)) return false;
  }
  return true;
}

bool ExpressionCompiler::number(bool negative) {
  const Decimal d = at_.number();
  if (d.digits == 0) return fail(Condition::calculation);
  constexpr uint32_t kMostDigits = 19;
  if (d.integer_digits > kMostDigits) return fail(Condition::value_range, d.value);
  return constant(negative ? -d.value : d.value);
}

bool ExpressionCompiler::constant(double value) {
  const bool small = value >= INT16_MIN && value <= INT16_MAX && value == static_cast<int16_t>(value);
  if (small && !(value == 0 && 1 / value < 0)) {
    const unsigned bits = static_cast<uint16_t>(static_cast<int16_t>(value));
    return emit(Op::small) && byte(bits & 0xff) && byte(bits >> 8);
  }
  const unsigned index = block_.constants.size();
  if (!block_.constants.push_back(value)) return fail(Condition::block_too_long);
  return emit(Op::constant) && byte(index);
}

bool ExpressionCompiler::variable_code(uint32_t number) {
  return emit(Op::variable) && byte(number & 0xff) && byte(number >> 8 & 0xff) && byte(number >> 16);
}

bool ExpressionCompiler::byte(unsigned value) {
  return block_.code.push_back(static_cast<uint8_t>(value)) || fail(Condition::block_too_long);
}

bool ExpressionCompiler::fail(Condition condition) {
  fault_ = Fault{};
  fault_.condition = condition;
  return false;
}

bool ExpressionCompiler::fail(Condition condition, double value) {
  fail(condition);
  fault_.has_value = true;
  fault_.value = value;
  return false;
}

bool compile_expression(Block& block, const char* text, size_t size, size_t* at, bool condition,
                        uint16_t* code, Fault* fault) {
  Cursor cursor;
  cursor.p = text + *at;
  cursor.end = text + size;
  static constexpr LexRules kPlain;
  ExpressionCompiler compiler(block, &cursor, kPlain);
  const bool good = condition ? compiler.expression_or_condition(code) : compiler.expression(code);
  *at = static_cast<size_t>(cursor.p - text);
  if (!good) *fault = compiler.fault();
  return good;
}

}  // namespace nc
