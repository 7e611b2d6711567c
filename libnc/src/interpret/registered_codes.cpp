// SPDX-License-Identifier: Apache-2.0
// The codes that parameters register to call a program (docs/macros.md lists these parameters).
#include "interpret/registered_codes.hpp"

#include "interpret/parameters.hpp"

namespace nc {
namespace {

constexpr uint32_t kUnset = ~0u;  // a row that no parameter gives a code to

using P = Parameter;

/// Indexes of Parameter::words_call.
enum WordsCall : unsigned { kCallsByM, kCallsByS, kCallsByT, kCallsBySecondAux };

struct Reader {
  const Parameters& parameters;
  const Dialect& dialect;
  uint32_t operator()(ParameterOf parameter, uint32_t fallback) const {
    double value = 0;
    if (!parameters.get(dialect, parameter, -1, &value)) return fallback;
    return value >= 0 && value <= 4294967295.0 ? static_cast<uint32_t>(value) : fallback;
  }
};

/// Reads <Type> and <Program No.> of a row; the manual shows an unused row with program 199999999.
void read_call(const Reader& whole, ParameterOf type, ParameterOf program, CodeCall* call) {
  const uint32_t kind = whole(type, 0);
  call->program = whole(program, 0);
  call->type = static_cast<CodeCallType>(kind);
  if (kind > 3 || call->program > whole.dialect.rules.range.largest_program) call->program = 0;
}

/// M700 13.5.2 (2): M00 to M95, except M0 M1 M2 M30.
bool m_allowed(const Dialect& dialect, uint32_t code) { return dialect.macro_misc.holds(code) && find_misc(dialect, code) == nullptr; }

/// Programs in the order of the parameters.
void of_place(uint32_t first, unsigned place, CodeCall* call) {
  call->program = first + place;
  call->type = CodeCallType::macro;
}

/// HX 14.1.3 (2): G65 G66 G67 call nothing else.
bool of_macros(const Dialect& dialect, uint32_t number) {
  const FunctionRow* const row = dialect.macro_codes.holds(number) ? find_function(dialect, static_cast<int>(number * 10)) : nullptr;
  return row != nullptr && (is_macro_call(row->function) || row->function == Function::macro_modal_off);
}

}  // namespace

CodeCalls read_code_calls(const Parameters& parameters, const Dialect& dialect) {
  const Reader whole{parameters, dialect};
  CodeCalls calls;
  calls.system_codes = whole(P::system_codes_call, 0) != 0;
  for (unsigned i = 0; i < CodeCalls::kCodes; ++i) {
    CodeCall& m = calls.m[i];
    m.code = whole({P::m_call_code, i}, kUnset);
    const CodeCallRules& rules = dialect.rules.code_call;
    if (rules.first_of_m != 0) {
      of_place(rules.first_of_m, i, &m);
    } else {
      read_call(whole, {P::m_call_type, i}, {P::m_call_program, i}, &m);
    }
    if (!m_allowed(dialect, m.code) || whole({P::words_call, kCallsByM}, 1) == 0) m.program = 0;
    CodeCall& g = calls.g[i];
    g.code = whole({P::g_call_code, i}, kUnset);
    if (rules.first_of_g != 0) {
      of_place(rules.first_of_g, i, &g);
      if (of_macros(dialect, g.code)) g.program = 0;
    } else {
      read_call(whole, {P::g_call_type, i}, {P::g_call_program, i}, &g);
    }
    if (!dialect.macro_codes.holds(g.code) && !(calls.system_codes && dialect.own_codes.holds(g.code))) g.program = 0;
    calls.any = calls.any || m.program != 0 || g.program != 0;
  }
  read_call(whole, P::second_aux_call_type, P::second_aux_call_program, &calls.b);
  read_call(whole, P::s_call_type, P::s_call_program, &calls.s);
  if (const auto tool_program = dialect.rules.code_call.tool_program; tool_program != nullptr) {
    calls.t.program = tool_program(whole({P::tool_macro, 0}, 0), whole({P::tool_macro, 1}, 0));
    calls.t.variable = dialect.rules.code_call.tool_variable;
  } else {
    read_call(whole, P::t_call_type, P::t_call_program, &calls.t);
  }
  if (whole({P::words_call, kCallsBySecondAux}, 1) == 0) calls.b.program = 0;
  if (whole({P::words_call, kCallsByS}, 1) == 0) calls.s.program = 0;
  if (whole({P::words_call, kCallsByT}, 1) == 0) calls.t.program = 0;
  for (unsigned i = 0; i < CodeCalls::kAsciiCodes; ++i) {
    CodeCall& a = calls.ascii[i];
    a.word = word_of_capital(whole({P::ascii_call_letter, i}, 0));
    read_call(whole, {P::ascii_call_type, i}, {P::ascii_call_program, i}, &a);
    a.variable = whole({P::ascii_call_variable, i}, 0);
    if (whole({P::ascii_call_on, i}, 0) != 1 || !holds(dialect.calling_words, a.word)) a.program = 0;
    calls.any = calls.any || a.program != 0;
  }
  calls.any = calls.any || calls.s.program != 0 || calls.t.program != 0 || calls.b.program != 0;
  return calls;
}

}  // namespace nc
