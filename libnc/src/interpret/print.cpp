// SPDX-License-Identifier: Apache-2.0
// Names of variables (SETVN, M700 13.5.5) and external output (POPEN, DPRNT, BPRNT, PCLOS, M700 13.5.8).
#include <cmath>
#include <cstring>

#include "dialect/text.hpp"
#include "interpret/calls.hpp"
#include "interpret/interpreter.hpp"
#include "macro/variable_name.hpp"
#include "program/cursor.hpp"

namespace nc {
namespace {

constexpr uint32_t kPort = 1;              ///< the external output; 0 is the message line of the operator
constexpr char kDc2 = 0x12, kDc4 = 0x14;   ///< characters that switch the punch of the external device on and off

Execution set_one_name(Interpreter& in, uint32_t variable, const char* from, size_t length) {
  char name[kNameLength];
  if (length == 0) return Execution::done;  // "[A,,C]": the second variable keeps its name
  if (length > kNameLength) return in.raise(Condition::name_statement, Sign::variable, variable);
  for (size_t i = 0; i < length; ++i) {
    name[i] = upper(from[i]);
    if (!is_letter(name[i]) && (i == 0 || !is_digit(name[i]))) return in.raise(Condition::variable_name, Sign::variable, variable);
  }
  if (is_reserved_name(name, length)) return in.raise(Condition::variable_name, Sign::variable, variable);
  uint32_t other = 0;
  if (in.variables.find_name(name, length, &other) && other != variable) return in.raise(Condition::variable_name_twice, Sign::variable, variable);
  if (!in.variables.set_name(variable, name, length, in.state.seq + 1)) return in.raise(Condition::variable_number, Sign::variable, variable);
  return Execution::done;
}

/// Puts a text for the port into the stream; it is given out when the machine gets there.
Execution emit_line(Interpreter& in, const char* text, size_t length) {
  Message message;
  if (length >= sizeof message.text.s) return in.raise(Condition::block_too_long, Role::port);
  std::memcpy(message.text.s, text, length);
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_MESSAGE;
  action.index = kPort;
  action.text = in.texts.intern(message);
  return Execution::done;
}

/// Reads [dc] behind a variable: the numbers of digits before and behind the point. *at is behind '['.
bool digits_wanted(const char** at, const char* end, unsigned* before, unsigned* behind) {
  const char* p = *at;
  if (end - p < 3 || !is_digit(p[0]) || !is_digit(p[1]) || p[2] != ']') return false;
  *before = static_cast<unsigned>(p[0] - '0');
  *behind = static_cast<unsigned>(p[1] - '0');
  *at = p + 3;
  return *before + *behind >= 1 && *before + *behind <= 8;  // M700 13.5.8: c + d <= 8
}

/// Writes a value. Trailing zeros stay; leading zeros are left out, or become blanks where the parameter says so. A value that needs more digits gets them.
void put_value(TextWriter& out, double value, unsigned before, unsigned behind, bool blanks) {
  double scale = 1;
  for (unsigned i = 0; i < behind; ++i) scale *= 10;
  const bool negative = value < 0;
  const auto scaled = static_cast<unsigned long long>(std::fabs(value) * scale + 0.5);
  const unsigned long long whole = scaled / static_cast<unsigned long long>(scale);
  unsigned digits = 1;
  for (unsigned long long rest = whole; rest >= 10; rest /= 10) ++digits;
  if (blanks) {
    out.put(negative && scaled != 0 ? '-' : ' ');
    for (; digits < before; ++digits) out.put(' ');
  } else if (negative && scaled != 0) {
    out.put('-');
  }
  out.put_integer(whole);
  if (behind == 0) return;
  out.put('.');
  out.put_integer(scaled % static_cast<unsigned long long>(scale), behind);
}

bool printable(char c) { return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '*' || c == '/'; }

}  // namespace

Execution set_names(Interpreter& in, const Statement& statement) {
  if (!in.shared_known()) return in.need(NC_SYNC_SHARED);  // a name that another part system has given must be known, since it cannot be given twice
  const char* p = in.block->text.begin() + statement.text;
  const char* const end = p + statement.text_length;
  uint32_t variable = statement.number;
  if (p == end) return in.raise(Condition::name_statement, Sign::variable, variable);  // App. 1, P292: there is nothing to set
  for (;; ++variable) {
    const char* from = p;
    while (p != end && *p != ',') ++p;
    const Execution did = set_one_name(in, variable, from, static_cast<size_t>(p - from));
    if (did != Execution::done || p == end) return did;
    ++p;
  }
}

bool find_variable_name(void* self, const char* name, size_t length, uint32_t* number) {
  return static_cast<Interpreter*>(self)->variables.find_name(name, length, number);
}

Execution open_port(Interpreter& in) {
  in.state.port_open = true;
  const char text[] = {kDc2, '%'};
  return emit_line(in, text, sizeof text);
}

Execution close_port(Interpreter& in) {
  in.state.port_open = false;
  const char text[] = {'%', kDc4};
  return emit_line(in, text, sizeof text);
}

namespace {

/// Evaluates the value that begins with '#' or '[' at *at, and moves *at behind it.
Execution next_value(Interpreter& in, const char** at, const char* end, double* number) {
  Block& scratch = *in.rewritten;
  scratch.clear();
  uint16_t code = 0;
  size_t used = 0;
  if (!compile_expression(scratch, *at, static_cast<size_t>(end - *at), &used, false, &code, &in.fault)) return Execution::fault;
  *at += used;
  Value value;
  const Eval eval = evaluate(scratch, code, variable_reader(in), eval_options(in), &value, &in.fault, &in.sync_needed);
  if (eval != Eval::ok) return eval == Eval::fault ? Execution::fault : Execution::sync;
  *number = value.or_zero();
  if (*at == end || **at != '[') return in.raise(Condition::format_error, Role::port);
  ++*at;
  return Execution::done;
}

}  // namespace

Execution print_decimal(Interpreter& in, const Statement& statement) {
  if (!in.state.port_open) return in.raise(Condition::print_port);
  char line[160];
  TextWriter out(line, sizeof line);
  const char* p = in.block->text.begin() + statement.text;
  const char* const end = p + statement.text_length;
  while (p != end) {
    if (*p != '#' && *p != '[') {
      const char c = upper(*p++);
      if (!printable(c)) return in.raise(Condition::format_error, static_cast<Sign>(c));
      out.put(c);
      continue;
    }
    double value = 0;
    const Execution did = next_value(in, &p, end, &value);
    if (did != Execution::done) return did;
    unsigned before = 0, behind = 0;
    if (!digits_wanted(&p, end, &before, &behind)) return in.raise(Condition::format_error, Role::port);
    if (std::fabs(value) >= 1e9) return in.raise(Condition::value_range, Role::port, value);
    put_value(out, value, before, behind, in.settings.print_blanks);
  }
  return emit_line(in, line, out.used());
}

/// The manual names BPRNT ("character output and variable value binary output"), but its format is missing there. This is the format of FANUC:
/// BPRNT[text #v[c] ...]. Characters are printed as they are; a value is multiplied by 10^c, rounded, and printed as four bytes in two's complement, the
/// highest first.
Execution print_binary(Interpreter& in, const Statement& statement) {
  if (!in.state.port_open) return in.raise(Condition::print_port);
  Message message;
  nc_text& text = message.text;
  const char* p = in.block->text.begin() + statement.text;
  const char* const end = p + statement.text_length;
  while (p != end) {
    if (text.size + 4 >= sizeof text.s) return in.raise(Condition::block_too_long, Role::binary_port);
    if (*p != '#' && *p != '[') {
      const char c = upper(*p++);
      if (!printable(c)) return in.raise(Condition::format_error, static_cast<Sign>(c));
      text.s[text.size++] = c;
      continue;
    }
    double value = 0;
    const Execution did = next_value(in, &p, end, &value);
    if (did != Execution::done) return did;
    if (end - p < 2 || !is_digit(p[0]) || p[1] != ']' || p[0] == '9') return in.raise(Condition::format_error, Role::binary_port);
    for (int places = *p - '0'; places > 0; --places) value *= 10;
    p += 2;
    if (!(std::fabs(value) < 2147483647.5)) return in.raise(Condition::value_range, Role::binary_port, value);
    const auto bits = static_cast<uint32_t>(static_cast<int64_t>(std::nearbyint(value)));
    for (int shift = 24; shift >= 0; shift -= 8) text.s[text.size++] = static_cast<char>(bits >> shift & 0xff);
  }
  if (text.size == 0) return in.raise(Condition::format_error, Role::binary_port);
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_MESSAGE;
  action.index = kPort;
  action.text = in.texts.intern(message);
  return Execution::done;
}

}  // namespace nc
