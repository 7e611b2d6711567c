// SPDX-License-Identifier: Apache-2.0
#include "interpret/code_calls.hpp"

#include "dialect/text.hpp"
#include "interpret/parameters.hpp"

namespace nc {
namespace {

constexpr uint32_t kLargestProgram = 99999999;

uint32_t whole(const Parameters& parameters, unsigned number, uint32_t fallback) {
  char key[8];
  TextWriter(key, sizeof key).put_integer(number);
  double value = 0;
  if (!parameters.get(key, -1, &value)) return fallback;
  return value >= 0 && value <= 4294967295.0 ? static_cast<uint32_t>(value) : fallback;
}

/// <Type> and <Program No.>; an unused row is printed with program 199999999.
void read_call(const Parameters& parameters, unsigned type, unsigned program, CodeCall* call) {
  const uint32_t kind = whole(parameters, type, 0);
  call->program = whole(parameters, program, 0);
  call->type = static_cast<CodeCallType>(kind);
  if (kind > 3 || call->program > kLargestProgram) call->program = 0;
}

/// M700 13.5.2 (2): M00 to M95 but M0 M1 M2 M30.
bool m_allowed(uint32_t code) { return code >= 3 && code <= 95 && code != 30; }

/// M700 13.5.3: letters that can be registered.
bool letter_allowed(uint32_t letter) {
  for (const char* at = "ABDFHIJKMQRST"; *at != 0; ++at)
    if (static_cast<uint32_t>(*at) == letter) return true;
  return false;
}

const CodeCall* find(const CodeCall* rows, unsigned count, uint32_t code) {
  for (unsigned i = 0; i < count; ++i)
    if (rows[i].program != 0 && rows[i].code == code) return &rows[i];
  return nullptr;
}

bool whole_code(double value, uint32_t* code) {
  if (!(value >= 0 && value < 1e9)) return false;
  *code = static_cast<uint32_t>(value + 1e-6);
  return value - *code < 1e-6;
}

}  // namespace

const CodeCall* CodeCalls::find_g(double value) const {
  uint32_t code = 0;
  return whole_code(value, &code) ? find(g, kCodes, code) : nullptr;
}

const CodeCall* CodeCalls::find_m(double value) const {
  uint32_t code = 0;
  return whole_code(value, &code) ? find(m, kCodes, code) : nullptr;
}

const CodeCall* CodeCalls::find_ascii(char letter) const { return find(ascii, kLetters, static_cast<uint32_t>(letter)); }

// Numbers of the parameters: those of 13.5.3 are printed there; 13.5.2 leaves them to the machine's documents. Rows are ten apart.
CodeCalls read_code_calls(const Parameters& parameters) {
  CodeCalls calls;
  calls.system_codes = whole(parameters, 1081, 0) != 0;
  for (unsigned i = 0; i < CodeCalls::kCodes; ++i) {
    CodeCall& m = calls.m[i];
    m.code = whole(parameters, 7001 + 10 * i, 9999);
    read_call(parameters, 7002 + 10 * i, 7003 + 10 * i, &m);
    if (!m_allowed(m.code) || whole(parameters, 1195, 1) == 0) m.program = 0;
    CodeCall& g = calls.g[i];
    g.code = whole(parameters, 7201 + 10 * i, 9999);
    read_call(parameters, 7202 + 10 * i, 7203 + 10 * i, &g);
    const bool user_range = g.code >= 100 && g.code <= 255;
    if (!user_range && !(calls.system_codes && g.code < 100)) g.program = 0;
    calls.any = calls.any || m.program != 0 || g.program != 0;
  }
  read_call(parameters, 7102, 7103, &calls.b);
  read_call(parameters, 7302, 7303, &calls.s);
  read_call(parameters, 7312, 7313, &calls.t);
  if (whole(parameters, 1198, 1) == 0) calls.b.program = 0;
  if (whole(parameters, 1196, 1) == 0) calls.s.program = 0;
  if (whole(parameters, 1197, 1) == 0) calls.t.program = 0;
  for (unsigned i = 0; i < CodeCalls::kLetters; ++i) {
    CodeCall& a = calls.ascii[i];
    a.code = whole(parameters, 7402 + 10 * i, 0);
    read_call(parameters, 7403 + 10 * i, 7404 + 10 * i, &a);
    a.variable = whole(parameters, 7405 + 10 * i, 0);
    if (whole(parameters, 7401 + 10 * i, 0) != 1 || !letter_allowed(a.code)) a.program = 0;
    calls.any = calls.any || a.program != 0;
  }
  calls.any = calls.any || calls.s.program != 0 || calls.t.program != 0 || calls.b.program != 0;
  return calls;
}

}  // namespace nc
