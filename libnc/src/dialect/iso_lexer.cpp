// SPDX-License-Identifier: Apache-2.0
// The lexer. Words of the common form (letter, sign, digits) go through words() and short_words(), which are the innermost loop of the whole
// product. Everything else (expressions, statements, comments inside words, missing values) is left to the functions behind them.
#include "dialect/iso_lexer.hpp"

#include <cstddef>
#include <cstring>
#include <initializer_list>

#include "alarm/condition.hpp"
#include "base/utf8.hpp"
#include "macro/compile.hpp"
#include "program/cursor.hpp"

namespace nc {
namespace {

constexpr unsigned kMaxMessage = 127;     // bytes kept of a comment that may be a message

/// What a character behind a number means for the word: the word is done; the character is a blank; or there is `more` of the word to read,
/// as in X1 0, X1+2 and S1=5.
enum class Behind : uint8_t { done, blank, more };
struct BehindNumber {
  Behind is[256] = {};
  constexpr BehindNumber() {
    for (char c = '0'; c <= '9'; ++c) is[static_cast<unsigned char>(c)] = Behind::more;
    for (char c : {'.', '+', '-', '*', '/', '='}) is[static_cast<unsigned char>(c)] = Behind::more;
    for (char c : {' ', '\t', '\r', '\0', '\x7f'}) is[static_cast<unsigned char>(c)] = Behind::blank;
  }
};
constexpr BehindNumber kBehindNumber;

Behind behind(const char* p, const char* end) {
  return p == end ? Behind::done : kBehindNumber.is[static_cast<unsigned char>(*p)];
}

/// Sign and number of a word of the common form.
struct Plain {
  uint64_t mantissa = 0;
  uint32_t integer_digits = 0;  ///< with leading zeros
  uint32_t fraction_digits = 0;
  uint8_t flags = 0;
  bool good = false;  ///< there is at least one digit and there are not too many

  double value(bool integer_only) const {
    // The division has to round only once. A good mantissa is below 10^18, but only up to 2^53 is it exact in a double.
    const uint64_t whole = mantissa / kPowersOfTen[fraction_digits];
    const double v = integer_only ? static_cast<double>(whole)
                                  : scale_decimal(mantissa, fraction_digits);
    return (flags & kWordNegative) != 0 ? -v : v;
  }
  /// The number has more digits before the point than `most`, leading zeros not counted. A good mantissa is below the last power of the
  /// table.
  bool longer_than(unsigned most) const {
    if (integer_digits <= most) return false;
    const unsigned power = most + fraction_digits;
    return mantissa >= kPowersOfTen[power < 19 ? power : 19];
  }

  const char* scan(const char* p, const char* end) {
    constexpr size_t kMostDigits = 18;  // cannot overflow the mantissa
    *this = Plain{};
    if (p != end && (*p == '-' || *p == '+')) flags = *p++ == '-' ? kWordNegative : kWordPlus;
    const char* from = p;
    for (; p != end && is_digit(*p); ++p) mantissa = mantissa * 10 + static_cast<uint64_t>(*p - '0');
    size_t digits = static_cast<size_t>(p - from);
    integer_digits = static_cast<uint32_t>(digits);
    if (p != end && *p == '.') {
      flags |= kWordPoint;
      from = ++p;
      for (; p != end && is_digit(*p); ++p) mantissa = mantissa * 10 + static_cast<uint64_t>(*p - '0');
      fraction_digits = static_cast<uint32_t>(p - from);
      digits += fraction_digits;
    }
    good = digits != 0 && digits <= kMostDigits;
    return p;
  }
};

/// How many characters short_words() may look at from the start of a word: letter, sign, seven digits, point, eight characters and the one
/// behind them.
constexpr ptrdiff_t kShortReach = 20;

class Lexer {
 public:
  Lexer(const char* text, size_t size, const IsoRules& rules, Semicolon semicolon, const uint8_t* columns,
        Block& block)
      : rules_(rules), block_(block), text_(text), columns_(columns), semicolon_(semicolon) {
    at_.p = text;
    at_.end = text + size;
    at_.semicolon_ends = semicolon != Semicolon::unknown;
  }

  LexResult run() {
    if (head()) {
      while (!block_.has_fault && words() && special()) {
      }
    }
    return finish();
  }

 private:
  /// Reads what may stand at the head of a block: skip sign, O, N. False if the block is over or has a fault.
  bool head() {
    if (at_.p != at_.end && *at_.p > 'A' && *at_.p <= 'Z' && *at_.p != rules_.sequence_letter && *at_.p != rules_.program_letter)
      return true;  // most blocks begin like this
    char c = at_.peek();
    if (c == '\0' && at_.p != at_.end && *at_.p == '%') {
      block_.percent = true;
      if (rules_.percent_alone) check_percent_alone();
      return false;
    }
    if (c == '/') {
      skip_sign();
      c = at_.peek();
    }
    if (c == '\0') return !block_.has_fault;  // the block is over; it must not be compared below with letters that a family has not, which are 0
    if (c == rules_.program_letter) {
      if (!head_number(c, &block_.has_o, &block_.o)) return false;
      c = at_.peek();
    }
    if (c == rules_.sequence_letter && c != '\0' && !head_number(c, &block_.has_n, &block_.n)) return false;
    return !block_.has_fault;
  }

  /// Raises a fault if the rest of the line behind '%' consists of letters with numbers: these would be words that are lost. With comments
  /// and plain text nothing is lost.
  void check_percent_alone() {
    ++at_.p;
    const char first = at_.peek();
    for (char letter = first; is_letter(letter); letter = at_.peek()) {
      ++at_.p;
      if (!at_.accept('-')) at_.accept('+');
      if (at_.number().digits == 0) return;
    }
    if (is_letter(first) && at_.at_end()) fault(Condition::no_start_mark, first);
  }

  void skip_sign() {  // M700 3.4
    ++at_.p;
    block_.skip = 1;
    if (!rules_.skip_numbers || !is_digit(at_.peek())) return;
    block_.skip = static_cast<uint8_t>(*at_.p - '0');
    ++at_.p;
    if (rules_.skip_misuse != Condition::none && (block_.skip == 0 || is_digit(at_.peek()))) {
      fault(rules_.skip_misuse, '/');
    } else if (block_.skip == 0) {
      fault(Condition::value_range, '/', 0);
    }
  }

  bool head_number(char letter, bool* has, uint32_t* number) {
    const WordFormat& format = rules_.word[letter - 'A'];
    if (!format.known) return fault(unknown(format), letter);
    ++at_.p;
    const char c = at_.peek();
    if (c == '#' || c == '[')
      return fault(rules_.macros ? Condition::variable_use : Condition::illegal_character, letter);
    const Decimal d = at_.number();
    if (d.digits == 0) return fault(Condition::format_error, letter);
    if (d.point && format.fraction_digits == 0) return fault(Condition::format_error, letter, d.value);
    if (d.integer > UINT32_MAX || out_of_range(format, d))
      return fault(refusal(format, d.fraction_digits), letter, d.value);
    if (d.integer == 0 && !rules_.zero_numbers) return fault(Condition::number_zero, letter, 0);  // M700 P37
    *has = true;
    *number = static_cast<uint32_t>(d.integer);
    return true;
  }

  /// Reads words until something else comes. True if there is something else at the cursor.
  bool words() {
    const char* p = at_.p;
    const char* const end = at_.end;
    while (p != end && is_blank(*p)) ++p;
    for (;;) {
      p = short_words(p);
      if (p == end) break;
      const unsigned letter = static_cast<unsigned>(static_cast<unsigned char>(*p) | 0x20u) - 'a';
      if (letter >= 26) break;
      Plain plain;
      const char* q = plain.scan(p + 1, end);
      Behind next = behind(q, end);
      while (next == Behind::blank) next = behind(++q, end);
      if (!plain.good || next == Behind::more || *p == 'e') {  // what a small e means depends on what stands before it: see word()
        at_.p = p;
        if (!slow_word()) return false;
        p = at_.p;
        while (p != end && is_blank(*p)) ++p;
        continue;
      }
      const WordFormat& format = rules_.word[letter];
      const char name = static_cast<char>('A' + letter);
      if (!format.known) return fault(unknown(format), name);
      const double value = plain.value(format.integer);
      if (plain.longer_than(format.integer_digits) ||
          (plain.fraction_digits > format.fraction_digits && !keeps_any_fraction(format))) {
        return fault(refusal(format, plain.fraction_digits), name, value);
      }
      Word* word = new_word(name);
      if (word == nullptr) return false;
      fill(word, WordSlot{static_cast<uint8_t>(letter)}, plain.flags, p, value);
      p = q;
    }
    at_.p = p;
    return p != end && *p != '\n';
  }

  /// Reads the words from here on that are a letter, a sign and at most seven digits on either side of a point, which nearly all words are.
  /// Stops at the first word that is not of this form or may be wrong, and leaves it to words(). Returns where it stopped.
  const char* short_words(const char* p) {
    if (!EightCharacters::kUsable || columns_ != nullptr || !block_.statements.empty()) return p;
    const char* const end = at_.end;
    Word* const first = block_.words.begin();
    Word* const limit = first + decltype(Block::words)::capacity();
    Word* word = first + block_.words.size();
    for (; end - p >= kShortReach && word != limit; ++word) {
      const unsigned letter = static_cast<unsigned>(static_cast<unsigned char>(*p) | 0x20u) - 'a';
      if (letter >= 26 || *p == 'e') break;
      const bool minus = p[1] == '-', plus = p[1] == '+';
      const char* q = p + 1 + (minus || plus);
      const EightCharacters all(q);
      const unsigned digits = all.digits();
      const WordFormat& format = rules_.word[letter];
      if (digits > format.integer_digits || digits == 8 || !format.known) break;
      uint8_t flags = static_cast<uint8_t>((minus ? kWordNegative : 0) | (plus ? kWordPlus : 0));
      unsigned length = digits, fraction = 0;
      uint64_t mantissa;
      if (q[digits] == '.') {
        length = all.length_past_point();
        fraction = length - 1 - digits;
        if (length < 8) {
          mantissa = all.value_without(digits, length);
        } else {  // longer: the digits before the point and those behind it are read one after the other
          const EightCharacters tail(q + digits + 1);
          fraction = tail.digits();
          if (fraction == 8) break;
          length = digits + 1 + fraction;
          mantissa = all.value() * kPowersOfTen[fraction] + tail.value();
        }
        if (fraction > format.fraction_digits || format.integer) break;
        flags |= kWordPoint;
      } else {
        mantissa = all.value();
      }
      if (digits + fraction == 0) break;
      q += length;
      Behind next = kBehindNumber.is[static_cast<unsigned char>(*q)];
      while (next == Behind::blank) next = behind(++q, end);
      if (next == Behind::more) break;
      // At most fourteen digits, so mantissa and power are exact in a double and the division rounds once.
      const double value = static_cast<double>(static_cast<int64_t>(mantissa)) / kExactPowersOfTen[fraction];
      fill(word, WordSlot{static_cast<uint8_t>(letter)}, flags, p, minus ? -value : value);
      p = q;
    }
    const auto count = static_cast<unsigned>(word - first);
    if (count != block_.words.size()) block_.empty = false;
    block_.words.resize(count);
    return p;
  }

  /// Writes the members of a word in its place. If the word were put together from bytes and then copied as a whole, the copy would wait for
  /// the store buffer.
  void fill(Word* word, WordSlot slot, uint8_t flags, const char* at, double value) const {
    word->slot = slot;
    word->flags = flags;
    word->index = 0;
    word->column = column(at);
    word->code = kNoCode;
    word->value = value;
  }

  static Condition unknown(const WordFormat& format) { return format.refusal == Condition::none ? Condition::illegal_address : format.refusal; }

  static bool keeps_any_fraction(const WordFormat& format) {
    return format.integer || format.fraction_digits >= 8;
  }

  static bool out_of_range(const WordFormat& format, const Decimal& d) {
    return d.integer_digits > format.integer_digits ||
           (d.fraction_digits > format.fraction_digits && !keeps_any_fraction(format));
  }

  /// The condition of a number that does not fit its format. If no point may stand in the number (DGSHAPE 2-2 to 2-4), a fraction is a fault
  /// of format, not of range.
  static Condition refusal(const WordFormat& format, unsigned fraction_digits) {
    return format.fraction_digits == 0 && fraction_digits != 0 ? Condition::format_error : Condition::value_range;
  }

  /// Makes a place for a word in the block. nullptr, with a fault, if the block cannot take a word.
  Word* new_word(char letter) {
    const unsigned count = block_.words.size();
    if (!block_.statements.empty()) {
      fault(Condition::macro_and_words, letter);  // M700 P272
      return nullptr;
    }
    if (block_.words.full()) {
      fault(Condition::block_too_long, letter);
      return nullptr;
    }
    block_.words.resize(count + 1);
    block_.empty = false;
    return &block_.words[count];
  }

  /// Reads a word that is not of the form letter, sign, number, or a macro statement.
  bool slow_word() {
    const char letter = upper(*at_.p);
    if (rules_.statements) {
      bool was_statement = false;
      if (!keyword(letter, &was_statement)) return false;
      if (was_statement) return true;
    }
    return word(0);
  }

  bool word(uint8_t flags) {
    const char letter = upper(*at_.p);
    const WordFormat& format = rules_.word[letter - 'A'];
    if (!format.known && (flags & kWordComma) == 0) return fault(unknown(format), letter);
    // A small e directly behind a number, as in "X1e2", is meant as an exponent and not as the address E.
    if (*at_.p == 'e' && at_.p != text_ && (is_digit(at_.p[-1]) || at_.p[-1] == '.')) flags |= kWordExponent;
    Word word{word_named(letter), flags, 0, column(at_.p), kNoCode, 0};
    ++at_.p;
    if (!value(format, &word, true)) return false;
    Word* const place = new_word(letter);
    if (place == nullptr) return false;
    *place = word;
    return true;
  }

  /// Reads the value behind a letter, or behind "S1=".
  bool value(const WordFormat& format, Word* word, bool may_count) {
    const Cursor start = at_;
    char c = at_.peek();
    const bool sign = c == '-' || c == '+';
    if (sign) {
      word->flags |= c == '-' ? kWordNegative : kWordPlus;
      ++at_.p;
      c = at_.peek();
    }
    if (is_digit(c) || c == '.') return number_value(format, word, may_count && !sign, start);
    if (c == '#' || c == '[') {
      if (!rules_.macros) return fault(Condition::illegal_character, c);
      at_ = start;
      return expression_value(word);
    }
    if (rules_.macros && is_letter(c) && starts_function(at_, rules_.formula)) {
      at_ = start;
      return expression_value(word);
    }
    if (sign || !may_count) return fault(Condition::format_error, letter_of(word->slot));
    at_ = start;
    word->flags |= kWordNoValue;
    return true;
  }

  /// A sum or a product without brackets.
  static bool goes_on(char next) { return next == '+' || next == '-' || next == '*'; }

  bool number_value(const WordFormat& format, Word* word, bool may_count, const Cursor& start) {
    const Decimal d = at_.number();
    if (d.digits == 0) return fault(Condition::format_error, letter_of(word->slot));
    const char next = at_.peek();
    if (rules_.macros && !rules_.bare_sums && goes_on(next)) return fault(Condition::format_error, letter_of(word->slot));
    if (rules_.macros && rules_.bare_sums && rules_.formula == Formula::macro && (next == '+' || next == '-' || next == '*' || next == '/')) {  // M700 5.3: X123+0
      at_ = start;
      return expression_value(word);
    }
    if (next == '=' && may_count) return count_value(format, word, d);
    if (out_of_range(format, d)) return fault(refusal(format, d.fraction_digits), letter_of(word->slot), d.value);
    if (d.point) word->flags |= kWordPoint;
    word->value = format.integer ? static_cast<double>(d.integer) : d.value;
    if ((word->flags & kWordNegative) != 0) word->value = -word->value;
    return true;
  }

  /// Reads words such as S1=500 and F1=10, in which the number before '=' chooses the spindle or the speed.
  bool count_value(const WordFormat& format, Word* word, const Decimal& count) {
    if ((letter_of(word->slot) != 'S' && letter_of(word->slot) != 'F') || count.point)
      return fault(Condition::format_error, letter_of(word->slot));
    if (count.integer > UINT8_MAX) return fault(Condition::value_range, letter_of(word->slot), count.value);
    word->index = static_cast<uint8_t>(count.integer);
    word->flags |= kWordCount;
    ++at_.p;
    return value(format, word, false);
  }

  bool expression_value(Word* word) {
    if (letter_of(word->slot) == rules_.sequence_letter || letter_of(word->slot) == rules_.program_letter)
      return fault(Condition::variable_use, letter_of(word->slot));  // M700 13.4 (3)
    word->flags = static_cast<uint8_t>((word->flags & ~(kWordNegative | kWordPlus)) | kWordExpression);
    ExpressionCompiler compiler(block_, &at_, rules_);
    if (!compiler.word_value(&word->code, rules_.bare_sums)) return fault(compiler.fault(), letter_of(word->slot));
    if (rules_.word[index_of(word->slot)].round_keeps_unit) compiler.leave_lone_round_out();
    if (!rules_.bare_sums && goes_on(at_.peek())) return fault(Condition::format_error, letter_of(word->slot));
    if (at_.peek() == '=') return fault(Condition::macro_and_words, letter_of(word->slot));  // X#1=#3+100
    return true;
  }

  /// Reads what stands here and is no word. False if the block is over or has a fault.
  bool special() {
    const char c = at_.peek();
    switch (c) {
      case '\0':
        return false;
      case '#':
      case '[':
        if (!rules_.macros) return fault(Condition::illegal_character, c);
        if (c == '[' && rules_.formula == Formula::ngc) return fault(Condition::format_error, c);  // it has no names for variables in brackets
        return assignment();
      case ',':
        if (!rules_.comma_words) return fault(Condition::illegal_character, c);
        ++at_.p;
        return is_letter(at_.peek()) ? word(kWordComma) : fault(Condition::format_error, c);
      case '<':
        if (!rules_.angle_names) return fault(Condition::illegal_character, c);
        return angle_name();
      case ']':
        return fault(rules_.macros ? Condition::bracket_pair : Condition::illegal_character, c);
      case '*':
      case '=':
        return fault(rules_.macros ? Condition::format_error : Condition::illegal_character, c);
      case '/':
        return fault(rules_.skip_misuse != Condition::none ? rules_.skip_misuse : Condition::format_error, c);
      case '+':
      case '-':
      case '.':
        return fault(Condition::format_error, c);
      default:
        break;
    }
    if (is_letter(c)) return true;  // a word behind a comment
    return fault(is_digit(c) ? Condition::format_error : Condition::illegal_character, c);
  }

  bool angle_name() {
    const char* from = ++at_.p;
    while (!at_.at_end() && *at_.p != '>' && *at_.p != '(') ++at_.p;
    if (at_.at_end() || *at_.p != '>' || at_.p == from || block_.name_length != 0)
      return fault(Condition::format_error, '<');
    const char* to = at_.p++;
    if (!block_.statements.empty()) return fault(Condition::macro_and_words, '<');
    if (!keep_text(from, to, &block_.name, &block_.name_length)) return false;
    block_.empty = false;
    return true;
  }

  // ---- statements
  // --------------------------------------------------------------------------------------------------

  bool add_statement(const Statement& statement) {
    if (!block_.words.empty()) return fault(Condition::macro_and_words);  // M700 P272
    if (!block_.statements.push_back(statement)) return fault(Condition::block_too_long);
    block_.empty = false;
    return true;
  }

  /// #100=value, [#NAME]=value
  bool assignment() {
    if (!block_.words.empty()) return fault(Condition::macro_and_words, '#');
    Statement s;
    s.kind = StatementKind::assign;
    const char* const bare = bare_message();
    ExpressionCompiler target(block_, &at_, rules_);
    if (!target.variable_number(&s.target)) return fault(target.fault());
    if (!at_.accept('=')) return fault(Condition::no_equals, '#');  // M700 P242
    at_.comment = nullptr;
    if (!value_before(bare, &s.value)) return false;
    if (at_.comment != nullptr && !message(&s)) return false;
    return add_statement(s);
  }

  /// Where a message without brackets begins: with the first letter behind the number (M700 13.5.5, #3000, note 2). nullptr = there is none. A letter in
  /// brackets belongs to the formula, and so does one right behind '='.
  const char* bare_message() const {
    Cursor ahead = at_;
    if (rules_.message_variable == 0 || !ahead.accept('#') || ahead.number().integer != rules_.message_variable || !ahead.accept('=')) return nullptr;
    if (is_letter(ahead.peek())) return nullptr;
    ahead.comment = nullptr;
    unsigned depth = 0;
    for (char c = ahead.peek(); c != '\0'; c = ahead.peek()) {
      if (depth == 0 && is_letter(c)) return ahead.comment == nullptr ? ahead.p : nullptr;
      if (c == '[') ++depth;
      if (c == ']' && depth != 0) --depth;
      ++ahead.p;
    }
    return nullptr;
  }

  /// The value that is assigned, and the message that begins at `bare`, which goes on to the end of the block: at_.comment.
  bool value_before(const char* bare, uint16_t* code) {
    const char* const end = at_.end;
    if (bare != nullptr) at_.end = bare;
    const bool there = expression(code, Condition::calculation);
    if (there) at_.skip();
    at_.end = end;
    if (!there || bare == nullptr || at_.p != bare) return there;
    at_.comment = bare;
    while (!at_.at_end()) ++at_.p;
    at_.comment_end = at_.p;
    while (is_blank(at_.comment_end[-1])) --at_.comment_end;
    return true;
  }

  /// Keeps the comment behind #3000=1(...). It is a message if the variable turns out to be one that has messages.
  bool message(Statement* s) {
    const size_t room = decltype(Block::text)::capacity() - block_.text.size();
    size_t length = static_cast<size_t>(at_.comment_end - at_.comment);
    if (length > kMaxMessage) length = whole_characters(at_.comment, kMaxMessage);
    if (length > room) length = whole_characters(at_.comment, room);
    if (!keep_text(at_.comment, at_.comment + length, &s->text, &s->text_length)) return false;
    block_.comment = s->text;
    block_.comment_length = s->text_length;
    return true;
  }

  bool expression(uint16_t* code, Condition when_missing) {
    const char c = at_.peek();
    const bool there =
        is_digit(c) || c == '.' || c == '#' || c == '[' || c == '-' || c == '+' || is_letter(c);
    if (!there) return fault(c == ']' ? Condition::bracket_pair : when_missing, c);
    ExpressionCompiler compiler(block_, &at_, rules_);
    if (!compiler.expression(code)) return fault(compiler.fault());
    return true;
  }

  bool condition(uint16_t* code, Condition statement_error) {
    if (at_.peek() != '[') return fault(statement_error);
    ExpressionCompiler compiler(block_, &at_, rules_);
    if (!compiler.condition(code)) {
      return fault(compiler.fault().condition == Condition::calculation ? Fault{statement_error}
                                                                        : compiler.fault());
    }
    return true;
  }

  /// The fault of what stands behind a condition: a ']' too many (M700 App. 1, P281), or something else.
  Condition behind_condition(Condition statement_error) { return at_.peek() == ']' ? Condition::bracket_pair : statement_error; }

  /// Reads a macro statement if its keyword stands here. False on a fault.
  bool keyword(char letter, bool* was_statement) {
    *was_statement = true;
    switch (letter) {
      case 'I':
        if (at_.accept("IF")) return if_statement();
        break;
      case 'W':
        if (at_.accept("WHILE")) return while_statement();
        break;
      case 'D':
        if (at_.accept("DO")) return loop_statement(StatementKind::do_loop);
        if (at_.accept("DPRNT")) return print_statement(StatementKind::print_decimal);
        break;
      case 'E':
        if (at_.accept("END")) return loop_statement(StatementKind::end_loop);
        break;
      case 'G':
        if (at_.accept("GOTO")) return goto_statement();
        break;
      case 'S':
        if (at_.accept("SETVN")) return name_statement();
        break;
      case 'P':
        if (at_.accept("POPEN")) return add_statement(Statement{StatementKind::open_port});
        if (at_.accept("PCLOS")) return add_statement(Statement{StatementKind::close_port});
        break;
      case 'B':
        if (at_.accept("BPRNT")) return print_statement(StatementKind::print_binary);
        break;
      default:
        break;
    }
    *was_statement = false;
    return true;
  }

  bool if_statement() {  // M700 13.5.7
    Statement s;
    if (!condition(&s.value, Condition::if_statement)) return false;
    if (at_.accept("THEN")) {
      s.kind = StatementKind::if_then;
      return add_statement(s);
    }
    if (!at_.accept("GOTO")) return fault(behind_condition(Condition::if_statement));
    s.kind = StatementKind::if_goto;
    return jump_target(&s.target, Condition::if_statement) && add_statement(s);
  }

  bool goto_statement() {
    Statement s;
    s.kind = StatementKind::go_to;
    return jump_target(&s.target, Condition::format_error) && add_statement(s);
  }

  bool jump_target(uint16_t* code, Condition when_missing) {
    if (rules_.jump_letter && at_.peek() == rules_.sequence_letter) ++at_.p;
    return expression(code, when_missing);
  }

  bool while_statement() {
    Statement s;
    s.kind = StatementKind::while_do;
    if (!condition(&s.value, Condition::while_statement)) return false;
    if (!at_.accept("DO")) return fault(behind_condition(Condition::while_statement));
    return loop_number(&s) && add_statement(s);
  }

  bool loop_statement(StatementKind kind) {
    Statement s;
    s.kind = kind;
    return loop_number(&s) && add_statement(s);
  }

  bool loop_number(Statement* s) {
    const Decimal d = at_.number();
    if (d.digits == 0 || d.point || d.integer == 0 || d.integer > rules_.most_loop_number)
      return fault(Condition::while_statement);
    s->number = static_cast<uint32_t>(d.integer);
    return true;
  }

  /// SETVN500[NAME1,NAME2]
  bool name_statement() {
    Statement s;
    s.kind = StatementKind::set_name;
    const Decimal d = at_.number();
    if (d.digits == 0 || d.point || d.integer > UINT32_MAX) return fault(Condition::name_statement);
    s.number = static_cast<uint32_t>(d.integer);
    if (at_.peek() != '[') return fault(Condition::name_statement);
    return body(&s) && add_statement(s);
  }

  bool print_statement(StatementKind kind) {
    Statement s;
    s.kind = kind;
    if (at_.peek() != '[') return fault(Condition::format_error);
    return body(&s) && add_statement(s);
  }

  /// Keeps the text between '[' and the ']' that belongs to it, without blanks.
  bool body(Statement* s) {
    unsigned depth = 1;
    ++at_.p;
    s->text = static_cast<uint16_t>(block_.text.size());
    for (at_.skip(); !at_.at_end(); at_.skip()) {
      const char c = *at_.p++;
      if (c == '[') ++depth;
      if (c == ']' && --depth == 0) {
        s->text_length = static_cast<uint16_t>(block_.text.size() - s->text);
        return true;
      }
      if (static_cast<signed char>(c) <= 0) return fault(Condition::illegal_character);
      if (!block_.text.push_back(c)) return fault(Condition::block_too_long);
    }
    return fault(Condition::bracket_pair);
  }

  bool keep_text(const char* from, const char* to, uint16_t* at, uint16_t* length) {
    *at = static_cast<uint16_t>(block_.text.size());
    for (; from != to; ++from) {
      if (!is_ignored(*from) && !block_.text.push_back(*from)) return fault(Condition::block_too_long);
    }
    *length = static_cast<uint16_t>(block_.text.size() - *at);
    return true;
  }

  // ---- end
  // ---------------------------------------------------------------------------------------------------------

  /// Passes over what is left of the block after a fault, and over the end of the block.
  LexResult finish() {
    if (block_.percent) {
      to_line_end();
    } else {
      for (at_.skip(); !at_.at_end(); at_.skip()) ++at_.p;
      if (at_.comment_is_open && rules_.comments_end && !block_.has_fault) fault(Condition::comment_open);
      if (at_.p != at_.end && *at_.p == ';') pass_semicolon();
    }
    LexResult result;
    if (at_.p == at_.end) {
      result.ran_out = true;
    } else if (*at_.p == '\n') {
      result.newline = true;
      ++at_.p;
    } else if (*at_.p == ';') {
      ++at_.p;
    }
    result.used = static_cast<size_t>(at_.p - text_);
    if (rules_.longest_block != 0 && result.used > rules_.longest_block) [[unlikely]] check_length();
    return result;
  }

  /// The characters of the block that mean something are no more than the family has room for.
  void check_length() {
    Cursor from{.p = text_, .end = at_.p, .semicolon_ends = at_.semicolon_ends};
    unsigned count = 0;
    for (from.skip(); !from.at_end(); from.skip()) {
      ++from.p;
      ++count;
    }
    if (count > rules_.longest_block && !block_.has_fault) fault(Condition::block_too_long);
  }

  void to_line_end() {
    const void* line_end = std::memchr(at_.p, '\n', static_cast<size_t>(at_.end - at_.p));
    at_.p = line_end != nullptr ? static_cast<const char*>(line_end) : at_.end;
  }

  /// The cursor is at the ';' behind the words. What follows in the line must never be executed by accident: it is another block only in a
  /// text that may have several blocks in a line.
  void pass_semicolon() {
    if (semicolon_ == Semicolon::ends_block) return;
    if (semicolon_ == Semicolon::ends_line) {
      while (at_.p != at_.end && *at_.p == ';') {
        ++at_.p;
        at_.skip();
      }
      if (at_.at_end()) return;
      if (!block_.has_fault) fault(Condition::behind_semicolon);
    }
    to_line_end();
  }

  uint8_t column(const char* p) const {
    const size_t i = static_cast<size_t>(p - text_);
    if (columns_ != nullptr) return i < 256 ? columns_[i] : UINT8_MAX;
    return i < UINT8_MAX ? static_cast<uint8_t>(i + 1) : UINT8_MAX;
  }

  bool fault(const Fault& what, char letter = 0) {
    block_.has_fault = true;
    block_.fault = what;
    if (block_.fault.letter == 0) block_.fault.letter = letter;
    return false;
  }
  bool fault(Condition condition, char letter = 0) {
    Fault f;
    f.condition = condition;
    return fault(f, letter);
  }
  bool fault(Condition condition, char letter, double value) {
    Fault f;
    f.condition = condition;
    f.has_value = true;
    f.value = value;
    return fault(f, letter);
  }

  const IsoRules& rules_;
  Block& block_;
  const char* const text_;
  const uint8_t* const columns_;
  const Semicolon semicolon_;
  Cursor at_;
};

}  // namespace

LexResult lex_block(const char* text, size_t size, const LexRules& rules, Semicolon semicolon,
                    const uint8_t* columns, Block& block) {
  block.clear();
  return Lexer(text, size, iso_rules_of(rules), semicolon, columns, block).run();
}

}  // namespace nc
