// SPDX-License-Identifier: Apache-2.0
// Alarms as a family shows them. The family's table (dialect/<family>/alarms.cpp) turns a condition into the code and the short text of its
// manual. The sentence for the person at the machine is made here and is the same for all families.
#pragma once

#include <cstddef>

#include "alarm/condition.hpp"
#include "alarm/fault.hpp"

namespace nc {

struct Dialect;

/// One row of a family's alarm table.
struct AlarmRow {
  Condition condition;
  const char* code;      ///< as the manual prints it, without blanks
  const char* message;   ///< the manual's short text
};

/// Writes a sentence for the operator that says what in the block caused the alarm. The text ends with NUL and is cut to `size` bytes.
void alarm_detail(const Dialect& dialect, const Fault& fault, const char* axis_name, char* text, size_t size);

}  // namespace nc
