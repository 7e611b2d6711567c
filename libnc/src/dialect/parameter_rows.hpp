// SPDX-License-Identifier: Apache-2.0
// The parameters of a family: how their numbers and names are bound to what they mean. Others that a manual has are kept for programs that
// read them (#100000), and do nothing; who sets one should be told.
#pragma once

#include "dialect/parameter.hpp"
#include "dialect/table.hpp"

namespace nc {

struct Dialect;

/// One parameter, or several `step` apart with the same meaning for one thing after the other.
struct ParameterRow {
  uint32_t first, last, step;  ///< numbers
  int8_t bit;                  ///< of it, -1 = all
  bool by_axis;                ///< may differ from axis to axis
  Parameter what;
  bool (*takes)(double);       ///< values that it can have; a row of one bit is not asked
  const char* values;          ///< unit or values; the first one in force when it is not set
  const char* name;
  const char* section;         ///< of the manual
  uint32_t axis_step = 0;      ///< numbers from one axis to the next, where each axis has its own; 0 = by_axis says
  unsigned base = 0;           ///< which one of several the first number is
  double (*means)(double) = nullptr;  ///< value of the meaning for a value of the manual; nullptr = the same
};

/// A parameter that has no number but a name: how its key is written.
struct ParameterName {
  const char* key;
  Parameter what;
  uint8_t index;
  double value;          ///< default
  const char* words;     ///< accepted words in the order of their values, "|"-separated ("conventional|calculator"), nullptr = number
  const char* values;    ///< what holds without it first; nullptr = the words
  const char* name;
  const char* section;   ///< of the manual
};

/// What a program can read like a parameter, but the configuration of the machine says and no parameter repeats.
enum class MachineDatum : uint8_t { axis_count, axis_name, rotary };
struct MachineParameter {
  uint32_t number;
  MachineDatum what;
};

/// What holds for good where a family has no such parameter and others do.
struct FixedParameter {
  Parameter what;
  double value;
};

struct NumberRange {
  uint32_t first, last;
};

/// Row of each meaning in the table of numbers, counted from 1; 0 = it has no number.
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
  const ParameterPlaces* places = nullptr;  ///< in it; nullptr: parameters have no numbers
  Table<ParameterName> names = {};
  Table<FixedParameter> fixed = {};
  Table<MachineParameter> machine = {};
  Table<NumberRange> of_axes = {};             ///< numbers that parameter input by program sets of one axis, those of no row among them
  double arc_tolerance_mm = 0;            ///< where Parameter::arc_tolerance is not set
  double arc_tolerance_of_radius = 0;     ///< or this part of the radius, if that is more,
  double arc_tolerance_most_mm = 0;       ///< and never more than this; 0 = arc_tolerance_mm alone counts
  bool checks_interference = false;       ///< of radius compensation, unless Parameter::interference_ignored
};

/// "1229/bit2": number 1229, written with 4 digits, bit 2. "1229": bit -1, all of it.
struct ParameterKey {
  uint32_t number;
  unsigned digits;
  int bit;
};

/// @return false when `text` is no such key.
bool parse_parameter_key(const char* text, ParameterKey* key);

/// A whole parameter of a family: one with a number, or the place of one that has none among the family's names.
struct ParameterId {
  static constexpr uint32_t kFirstName = 1000000;  ///< numbers have six digits
  uint32_t value = 0;
  static constexpr ParameterId of_number(uint32_t number) { return {number}; }
  static constexpr ParameterId of_name(uint32_t place) { return {kFirstName + place}; }
  constexpr bool is_name() const { return value >= kFirstName; }
  bool operator==(const ParameterId&) const = default;
};

/// What a key of the public interface means: "1229", "1229/bit2" (bit -1 = the whole parameter), "UNIT*10". False: it is none of the family's.
bool parse_parameter(const Dialect& dialect, const char* key, ParameterId* id, int* bit);

/// Longest key of a parameter, its end included.
inline constexpr unsigned kParameterKeySize = 24;
/// The key of a whole parameter.
void put_parameter_key(const Dialect& dialect, ParameterId id, char (&key)[kParameterKeySize]);

/// Where a parameter is kept: the whole of it, and its bit there (-1 = all); that of an axis where each has a number. False: the family has no such
/// parameter.
bool parameter_place(const Dialect& dialect, ParameterOf parameter, ParameterId* id, int* bit, int axis = -1);
/// Its row in the table of numbers, nullptr = it has none.
const ParameterRow* parameter_row(const Dialect& dialect, Parameter what);
/// The same with its key.
bool parameter_place(const Dialect& dialect, ParameterOf parameter, char (&key)[kParameterKeySize], int* bit);

/// The row of a number; of several rows for bits of it the one that has the key's, or the first if the key is all of it.
const ParameterRow* find_parameter(const Dialect& dialect, const ParameterKey& key);
const ParameterName* find_parameter_name(const Dialect& dialect, const char* key);

/// The whole parameter can have this value. One that nothing asks for takes any.
bool parameter_takes(const Dialect& dialect, const ParameterKey& key, double value);

/// A function of the control asks for it: "1084", "1229/bit2", "1229" (some bit of it), "UNIT*10".
bool parameter_used(const Dialect& dialect, const char* key);

/// Parameter input by program sets this number of one axis.
bool parameter_of_axis(const Dialect& dialect, uint32_t number);
/// There is one for all part systems (is_common()).
bool parameter_is_common(const Dialect& dialect, uint32_t number);

}  // namespace nc
