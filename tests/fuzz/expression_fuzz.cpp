// SPDX-License-Identifier: Apache-2.0
// Any bytes as a formula: it is refused with a condition, or it compiles and results in a finite number, vacant, or a
// fault.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "macro/expression.hpp"

namespace {

[[noreturn]] void broken(const char* what) {
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

nc::Eval variable(void*, uint32_t number, nc::Value* value, nc::Fault* fault, uint32_t* sync) {
  if (number == 77) {
    *sync = 1;
    return nc::Eval::need_sync;
  }
  if (number > 100000) {
    fault->condition = static_cast<nc::Condition>(1);
    return nc::Eval::fault;
  }
  *value = number % 3 == 0 ? nc::Value{} : nc::Value::of(number * 0.37 - 5);
  return nc::Eval::ok;
}

bool name(void*, const char* text, size_t length, uint32_t* number) {
  *number = length != 0 ? static_cast<unsigned char>(text[length - 1]) : 0u;
  return length < 8;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const char* text = reinterpret_cast<const char*>(data) + 1;
  --size;
  nc::Block block;
  block.clear();
  size_t at = 0;
  uint16_t code = 0;
  nc::Fault fault;
  if (!nc::compile_expression(block, text, size, &at, (data[0] & 1) != 0, &code, &fault)) {
    if (fault.condition == nc::Condition{}) broken("refused without a condition");
    return 0;
  }
  if (at > size) broken("went beyond the text");
  nc::Value value;
  uint32_t sync = 0;
  fault = nc::Fault{};
  const nc::Eval eval =
      nc::evaluate(block, code, {nullptr, variable, name}, {(data[0] & 2) != 0}, &value, &fault, &sync);
  if (eval == nc::Eval::ok && !std::isfinite(value.number)) broken("not a finite number");
  if (eval == nc::Eval::fault && fault.condition == nc::Condition{}) broken("a fault without a condition");
  if (eval == nc::Eval::need_sync && sync == 0) broken("waits for nothing");
  return 0;
}
