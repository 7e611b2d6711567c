// SPDX-License-Identifier: Apache-2.0
// Looks things up in the tables of a family.
#include "dialect/dialect.hpp"

#include <algorithm>
#include <cmath>

#include "dialect/default_alarms.hpp"

namespace nc {
namespace {

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) {
    ++a;
    ++b;
  }
  return *a == *b;
}

// Finds the row with this code in a table that is sorted by code.
template <class Row>
const Row* find(const Table<Row>& table, int code) {
  const Row* first = table.begin();
  unsigned size = table.size;
  while (size > 0) {
    const unsigned half = size / 2;
    if (static_cast<int>(first[half].code) < code) {
      first += half + 1;
      size -= half + 1;
    } else {
      size = half;
    }
  }
  return first != table.end() && static_cast<int>(first->code) == code ? first : nullptr;
}

const AlarmText* listed(const Table<AlarmText>& alarms, const char* code) {
  for (const AlarmText& alarm : alarms)
    if (same(alarm.code, code)) return &alarm;
  return nullptr;
}

const char* message_of(const Dialect& dialect, const char* code) {
  const AlarmText* alarm = listed(dialect.alarms, code);
  if (alarm == nullptr) alarm = listed(kDefaultAlarms, code);
  return alarm != nullptr ? alarm->message : "";
}

const AlarmRow* row_of(const Table<AlarmRow>& rows, Condition condition) {
  for (const AlarmRow& row : rows)
    if (row.condition == condition && row.code != nullptr) return &row;
  return nullptr;
}

/// The family can raise an alarm that has this code from the common table.
bool uses_default(const Dialect& dialect, const char* code) {
  if (listed(dialect.alarms, code) != nullptr) return false;  // one of its own list
  for (const FunctionRow& row : dialect.functions)
    if (row.missing != nullptr && same(row.missing, code)) return true;
  for (const AlarmRow& row : kDefaultConditions)
    if (same(row.code, code) && row_of(dialect.conditions, row.condition) == nullptr) return true;
  return false;
}

// The alarm code in the row of a G or M code that is not built. nullptr = the fault is about something else.
const char* missing_code(const Dialect& dialect, const Fault& fault) {
  if (fault.condition != Condition::no_function || !fault.has_value || fault.value < 0 || fault.value > 1e9)
    return nullptr;
  const int code = static_cast<int>(std::lround(fault.value));
  if (dialect.addresses.is(fault.letter, Role::code)) {
    const FunctionRow* row = find_function(dialect, code);
    return row != nullptr ? row->missing : nullptr;
  }
  if (dialect.addresses.is(fault.letter, Role::misc_code)) {
    const MiscRow* row = find_misc(dialect, static_cast<unsigned>(code));
    return row != nullptr ? row->missing : nullptr;
  }
  return nullptr;
}

}  // namespace

const FunctionRow* find_function(const Dialect& dialect, int code) {
  return find(dialect.functions, code);
}

const MiscRow* find_misc(const Dialect& dialect, unsigned code) {
  return code > 0xffff ? nullptr : find(dialect.misc, static_cast<int>(code));
}

const FunctionRow* find_function(const Dialect& dialect, Function function) {
  for (const FunctionRow& row : dialect.functions)
    if (row.function == function && row.number == 0) return &row;
  return nullptr;
}

bool puts_out(const Dialect& dialect, unsigned code) {
  return std::any_of(dialect.outputs.begin(), dialect.outputs.end(), [code](const OutputRow& row) { return row.code == code; });
}

MiscFunction misc_function(const Dialect& dialect, unsigned code) {
  if (const MiscRow* row = find_misc(dialect, code); row != nullptr) return row->function;
  for (const OutputRow& row : dialect.outputs)
    if (row.code == code) return row.function;
  return MiscFunction::output;
}

unsigned misc_code(const Dialect& dialect, MiscFunction function) {
  for (const MiscRow& row : dialect.misc)
    if (row.function == function) return row.code;
  for (const OutputRow& row : dialect.outputs)
    if (row.function == function) return row.code;
  return kNoMisc;
}

const AlarmText* alarm_at(const Dialect& dialect, unsigned index) {
  if (index < dialect.alarms.size) return &dialect.alarms.row[index];
  index -= dialect.alarms.size;
  for (const AlarmText& alarm : kDefaultAlarms)
    if (uses_default(dialect, alarm.code) && index-- == 0) return &alarm;
  return nullptr;
}

AlarmText alarm_text(const Dialect& dialect, const Fault& fault) {
  if (const char* code = missing_code(dialect, fault); code != nullptr)
    return {code, message_of(dialect, code)};
  const AlarmRow* row = row_of(dialect.conditions, fault.condition);
  if (row == nullptr) row = row_of(kDefaultConditions, fault.condition);
  if (row != nullptr) return {row->code, row->message != nullptr ? row->message : message_of(dialect, row->code)};
  // A condition without a row is a mistake of ours; tests/dialect finds it.
  return {"NC-INTERNAL", message_of(dialect, "NC-INTERNAL")};
}

}  // namespace nc
