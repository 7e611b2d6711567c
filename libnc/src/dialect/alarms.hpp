// SPDX-License-Identifier: Apache-2.0
// Alarms as a family shows them: its table turns a condition into the code and the short text of its manual (dialect/<family>/alarms.cpp);
// the sentence for the person at the machine is made here, the same for all.
#pragma once

#include <cstddef>

#include "alarm/condition.hpp"
#include "alarm/fault.hpp"

namespace nc {

struct Dialect;

/// One row of a family's alarm table.
struct AlarmRow {
  Condition condition;
  const char* code;      ///< as printed, without blanks
  const char* message;   ///< the manual's short text
};

/// Sentence for the operator: what in this block caused it. Writes a NUL-terminated text.
void alarm_detail(const Dialect& dialect, const Fault& fault, const char* axis_name, char* text, size_t size);

}  // namespace nc
