// SPDX-License-Identifier: Apache-2.0
// An alarm as data: what is wrong, and with what. It becomes words when someone reads it.
#pragma once

#include <cstdint>

namespace nc {

/// Listed in alarm/condition.hpp, which only those include who tell one from another.
enum class Condition : uint16_t;

/// An alarm on its way: data, turned into words by the dialect when someone reads it.
struct Fault {
  Condition condition{};
  int8_t axis = -1;    ///< axis index or -1
  char letter = 0;     ///< address that caused it, 0 = none
  bool has_value = false;
  double value = 0;    ///< its value, or the number of a variable, a program, ...
  const char* function = nullptr;  ///< function or operator that has no result for `value`; a literal
};

}  // namespace nc
