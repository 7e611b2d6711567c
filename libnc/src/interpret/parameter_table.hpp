// SPDX-License-Identifier: Apache-2.0
// The parameters that something in the control asks for. Others of the manual are kept for programs that read them (#100000), and do
// nothing; who sets one should be told.
#pragma once

#include <cstdint>

#include "dialect/dialect.hpp"

namespace nc {

/// One parameter, or several `step` apart with the same meaning for one thing after the other.
struct ParameterRow {
  uint32_t first, last, step;  ///< numbers
  int8_t bit;                  ///< of it, -1 = all
  bool by_axis;                ///< may differ from axis to axis
  bool (*takes)(double);       ///< values that it can have; a row of one bit is not asked
  const char* values;          ///< unit or values; the first one in force when it is not set
  const char* name;
  const char* section;         ///< of the manual
};

extern const Table<ParameterRow> kParameterTable;  ///< of the m700, sorted by number

/// "1229/bit2": number 1229, written with 4 digits, bit 2. "1229": bit -1, all of it.
struct ParameterKey {
  uint32_t number;
  unsigned digits;
  int bit;
};

/// @return false when `text` is no such key.
bool parse_parameter_key(const char* text, ParameterKey* key);

/// The whole parameter can have this value. One that nothing asks for takes any.
bool parameter_takes(const ParameterKey& key, double value);

/// A function of the control asks for it: "1084", "1229/bit2", "1229" (some bit of it), "UNIT*10".
bool parameter_used(const Dialect& dialect, const char* key);

}  // namespace nc
