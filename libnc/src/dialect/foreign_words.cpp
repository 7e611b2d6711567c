// SPDX-License-Identifier: Apache-2.0
#include "dialect/foreign_words.hpp"

#include <cstring>

namespace nc {
namespace {

/// The words that may follow the number or name of an O-word of LinuxCNC.
constexpr const char* kOWords[] = {"SUB",   "ENDSUB", "CALL",     "RETURN", "IF",       "ELSEIF",   "ELSE",
                                   "ENDIF", "WHILE",  "ENDWHILE", "DO",     "CONTINUE", "BREAK",    "REPEAT",
                                   "ENDREPEAT"};

char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

void skip_blanks(const char** at) {
  while (**at == ' ' || **at == '\t') ++*at;
}
void skip_digits(const char** at) {
  while (**at >= '0' && **at <= '9') ++*at;
}

/// `at` is at an O: whether an O-word follows, like "o100 sub", "O<name> call [1]", "o[#1] if [...]", "o#1 call".
bool is_o_word(const char* at) {
  ++at;
  skip_blanks(&at);
  const char close = *at == '<' ? '>' : *at == '[' ? ']' : '\0';
  if (close != 0) {
    at = std::strchr(at, close);
    if (at == nullptr) return false;
    ++at;
  } else {
    while (*at == '#') ++at;
    skip_digits(&at);
  }
  skip_blanks(&at);
  char word[12] = {};
  for (unsigned n = 0; n + 1 < sizeof word && capital(*at) >= 'A' && capital(*at) <= 'Z'; ++at) word[n++] = capital(*at);
  for (const char* known : kOWords)
    if (std::strcmp(word, known) == 0) return true;
  return false;
}

/// `at` is at a #: whether a named parameter follows, like "#<feed>", "# <_global>".
bool is_named_parameter(const char* at) {
  ++at;
  skip_blanks(&at);
  return *at == '<';
}

}  // namespace

LinuxcncWord linuxcnc_word(const char* line) {
  LinuxcncWord found = LinuxcncWord::none;
  bool comment = false;
  for (const char* at = line; *at != 0; ++at) {
    if (*at == '(') comment = true;
    if (*at == ')') comment = false;
    if (comment) continue;
    const char before = at == line ? ' ' : capital(at[-1]);
    if (capital(*at) == 'O' && !(before >= 'A' && before <= 'Z') && is_o_word(at)) return LinuxcncWord::o_word;
    if (*at == '#' && is_named_parameter(at)) found = LinuxcncWord::named_parameter;
  }
  return found;
}

void put_linuxcnc_hint(const Dialect& family, LinuxcncWord word, TextWriter& out) {
  const bool macros = family.argument_of != nullptr;
  if (word == LinuxcncWord::named_parameter) {
    out.put("Named parameters of LinuxCNC do not exist here");
    out.put(macros ? ": a variable has a number behind #, not a name in < >." : ", nor do variables.");
    return;
  }
  out.put("O-words of LinuxCNC do not exist here");
  const auto put_misc = [&](MiscFunction function) { out.put(family.addresses.letter(Role::misc_code)).put_integer(misc_code(family, function), 2); };
  const bool calls = family.call_depth != 0;
  const FunctionRow* const macro_call = find_function(family, Function::macro_call);
  if (calls || macro_call != nullptr) {
    out.put(": ");
    if (calls) put_misc(MiscFunction::call_sub);
    if (calls && macro_call != nullptr) out.put(" and ");
    if (macro_call != nullptr) out.put(family.addresses.letter(Role::code)).put_integer(static_cast<unsigned>(macro_call->code / 10));
    out.put(calls && macro_call != nullptr ? " call" : " calls");
  }
  if (calls) {
    out.put(", ");
    put_misc(MiscFunction::return_sub);
    out.put(" returns");
  }
  if (macros) out.put(calls ? ", IF [ ] GOTO and WHILE [ ] DO branch" : ": IF [ ] GOTO and WHILE [ ] DO branch");
  out.put(".");
}

}  // namespace nc
