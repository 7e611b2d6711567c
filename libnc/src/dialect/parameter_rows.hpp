// SPDX-License-Identifier: Apache-2.0
// The parameters of a family: how their numbers and names are bound to what they mean. A parameter of the manual that is not in these tables
// can be set and read by programs (#100000) but has no effect. Whoever sets such a parameter should be told so.
#pragma once

#include "dialect/parameter.hpp"
#include "dialect/table.hpp"

namespace nc {

struct Dialect;

/// One parameter, or several whose numbers are `step` apart and which mean the same for the first thing, the second and so on.
struct ParameterRow {
  uint32_t first, last, step;  ///< first and last number, and the distance from one number to the next
  int8_t bit;                  ///< bit of the parameter that has this meaning, -1 = the whole parameter
  bool by_axis;                ///< the value may differ from axis to axis
  Parameter what;
  bool (*takes)(double);       ///< tells whether the parameter can have a value; not called if the row is one bit
  const char* values;          ///< unit, or the possible values, of which the first one holds while the parameter is not set
  const char* name;
  const char* section;         ///< of the manual
  uint32_t axis_step = 0;      ///< numbers from one axis to the next, where each axis has its own; 0 = by_axis says
  unsigned base = 0;           ///< which one of several the first number is
  double (*means)(double) = nullptr;  ///< value of the meaning for a value of the manual; nullptr = the same
};

/// A parameter that has a name instead of a number.
struct ParameterName {
  const char* key;       ///< the name as it is written
  Parameter what;
  uint8_t index;         ///< which one of several with the same meaning (ParameterOf::index)
  double value;          ///< value while it is not set
  const char* words;     ///< accepted words in the order of their values, "|"-separated ("conventional|calculator"), nullptr = its value is a number
  const char* values;    ///< unit, or the possible values with the default first; nullptr = `words` lists them
  const char* name;
  const char* section;   ///< section of the manual
  bool (*takes)(double) = nullptr;  ///< tells whether it can have a value, where that is a number; nullptr: any number from 0 on
};

/// A fact about the machine that a program can read like a parameter. It comes from the configuration; no parameter holds it.
enum class MachineDatum : uint8_t { system_used, axis_count, axis_name, rotary };
struct MachineParameter {
  uint32_t number;
  MachineDatum what;
};

/// The value of a meaning for which this family has no parameter and others do. It never changes.
struct FixedParameter {
  Parameter what;
  double value;
};

struct NumberRange {
  uint32_t first, last;
};

/// For each meaning its row in the table of numbers, counted from 1; 0 = no row has this meaning.
struct ParameterPlaces {
  uint8_t row[kParameters] = {};
};
template <unsigned count>
constexpr ParameterPlaces places_of(const ParameterRow (&rows)[count]) {
  static_assert(count < 255);
  ParameterPlaces places;
  for (unsigned i = 0; i < count; ++i) places.row[static_cast<unsigned>(rows[i].what)] = static_cast<uint8_t>(i + 1);
  return places;
}

struct FamilyParameters {
  Table<ParameterRow> numbers = {};            ///< sorted by number
  const ParameterPlaces* places = nullptr;  ///< places in `numbers`; nullptr = the family's parameters have no numbers
  Table<ParameterName> names = {};
  Table<FixedParameter> fixed = {};
  Table<MachineParameter> machine = {};
  NumberRange there = {1, 0};                  ///< numbers that parameters of the maker can have; one that is not used here reads 0. Empty = only those that are used
  Table<NumberRange> of_axes = {};             ///< numbers that a program sets for one axis (parameter input), also numbers without a row
  NumberRange locked_programs[2] = {{1, 0}, {1, 0}};  ///< numbers of the programs that Parameter::edit_lock_b and edit_lock_c protect; empty = none
  double arc_tolerance_mm = 0;            ///< tolerance while Parameter::arc_tolerance is not set,
  double arc_tolerance_of_radius = 0;     ///< or this part of the radius if that is more,
  double arc_tolerance_most_mm = 0;       ///< but never more than this; 0 = only arc_tolerance_mm counts
  bool checks_interference = false;       ///< radius compensation checks for interference unless Parameter::interference_ignored is set
};

/// A parsed key. "1229/bit2" is number 1229, written with 4 digits, bit 2. "1229" has bit -1, which means the whole parameter.
struct ParameterKey {
  uint32_t number;
  unsigned digits;
  int bit;
};

/// @return false if `text` is no such key.
bool parse_parameter_key(const char* text, ParameterKey* key);

/// Identifies a whole parameter of a family: by its number, or, if it has none, by its place in the family's table of names.
struct ParameterId {
  static constexpr uint32_t kFirstName = 1000000;  ///< numbers have six digits
  uint32_t value = 0;
  static constexpr ParameterId of_number(uint32_t number) { return {number}; }
  static constexpr ParameterId of_name(uint32_t place) { return {kFirstName + place}; }
  constexpr bool is_name() const { return value >= kFirstName; }
  bool operator==(const ParameterId&) const = default;
};

/// Finds the parameter that a key of the public interface means: "1229", "1229/bit2", "UNIT*10". `bit` becomes -1 for the whole parameter.
/// @return false if it is no key of this family.
bool parse_parameter(const Dialect& dialect, const char* key, ParameterId* id, int* bit);

/// Size of the longest key of a parameter, with the NUL at its end.
inline constexpr unsigned kParameterKeySize = 24;
/// Writes the key of a whole parameter.
void put_parameter_key(const Dialect& dialect, ParameterId id, char (&key)[kParameterKeySize]);

/// Where a parameter is kept: the whole of it, and its bit there (-1 = all); that of an axis where each has a number. False: the family has no such
/// parameter.
bool parameter_place(const Dialect& dialect, ParameterOf parameter, ParameterId* id, int* bit, int axis = -1);
/// Its row in the table of numbers, nullptr = it has none.
const ParameterRow* parameter_row(const Dialect& dialect, Parameter what);
/// The same with its key.
bool parameter_place(const Dialect& dialect, ParameterOf parameter, char (&key)[kParameterKeySize], int* bit);

/// The row of the parameter with the key's number, nullptr = there is none. If several rows are bits of this number, it is the row of the
/// key's bit, or the first row if the key means the whole parameter.
const ParameterRow* find_parameter(const Dialect& dialect, const ParameterKey& key);
const ParameterName* find_parameter_name(const Dialect& dialect, const char* key);

/// The whole parameter can have this value. A parameter without a row takes any value.
bool parameter_takes(const Dialect& dialect, const ParameterKey& key, double value);
/// The same of a parameter that has a name.
bool parameter_name_takes(const Dialect& dialect, ParameterId id, double value);

/// The whole parameter may be given as a letter, whose code is its value: the name of an axis, the letter of a call, the setting unit, or any without a row. As the value of another
/// one a letter is a mistake, whose code nobody means.
bool parameter_takes_code(const Dialect& dialect, const ParameterKey& key);

/// The control uses the parameter with this key: "1084", "1229/bit2", "1229" (then it uses at least one bit of it), "UNIT*10".
bool parameter_used(const Dialect& dialect, const char* key);

/// When a program sets this number (parameter input), it sets it for one axis.
bool parameter_of_axis(const Dialect& dialect, uint32_t number);
/// This number has one value for all part systems (is_common()).
bool parameter_is_common(const Dialect& dialect, uint32_t number);

}  // namespace nc
