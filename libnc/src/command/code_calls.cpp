// SPDX-License-Identifier: Apache-2.0
#include "command/code_calls.hpp"

namespace nc {
namespace {

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

const CodeCall* CodeCalls::find_ascii(WordSlot word) const {
  for (const CodeCall& row : ascii)
    if (row.program != 0 && row.word == word) return &row;
  return nullptr;
}

}  // namespace nc
