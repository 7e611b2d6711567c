// SPDX-License-Identifier: Apache-2.0
// An alarm as data: what is wrong, and with which word or axis. It is turned into a text only when somebody reads it.
#pragma once

#include <cstdint>

namespace nc {

/// The conditions are listed in alarm/condition.hpp, which only files include that distinguish them.
enum class Condition : uint16_t;

/// An alarm on its way through the stream. The dialect turns it into a text when somebody reads it.
struct Fault {
  Condition condition{};
  int8_t axis = -1;    ///< index of the axis, -1 = none
  char letter = 0;     ///< address that caused it, 0 = none
  bool has_value = false;
  double value = 0;    ///< value of that address, or the number of a variable, a program, ...
  const char* function = nullptr;  ///< name of the macro function or operator that has no result for `value`; a constant text
};

}  // namespace nc
