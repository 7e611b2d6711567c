// SPDX-License-Identifier: Apache-2.0
// What a controller family is: tables. One folder per family (dialect/m700, dialect/dgshape) holds its word formats, its G and M codes,
// its alarms; this header says what such a table looks like. To add a family, add a folder and one line in registry.cpp.
#pragma once

#include "dialect/alarms.hpp"
#include "dialect/function.hpp"
#include "dialect/parameter_rows.hpp"
#include "dialect/role.hpp"
#include "dialect/rules.hpp"
#include "dialect/table.hpp"
#include "dialect/variable_rows.hpp"
#include "program/block.hpp"

namespace nc {

struct FunctionRow {
  int16_t code;          ///< times 10: G54.1 = 541
  uint8_t group;         ///< modal group as the manual numbers it, 0 = one-shot; for showing only
  Function function;
  const char* missing;   ///< not built: the code of the alarm that it raises ("P90"); nullptr = built
  const char* name;      ///< short English name, our words
  const char* section;   ///< of the manual
  const char* part = nullptr;  ///< supported in part: what of it is not built
  uint8_t number = 0;    ///< which one of the rows with this function, from 0: G54 to G59 are 0 to 5, G107 is the second name of G07.1
};

struct MiscRow {
  uint16_t code;
  MiscFunction function;
  const char* missing;   ///< as that of FunctionRow
  const char* name;
  const char* section;
};

/// What data setting by program sets.
enum class DataInput : uint8_t {
  missing,           ///< in the manual, not built
  work_offset,       ///< of a workpiece coordinate system, or of them all
  work_offset_here,  ///< the same, so that the axis reads the value where it stands
  extended_offset,   ///< of an extended workpiece coordinate system
  tool_length, tool_length_wear, tool_radius, tool_radius_wear,
  current_limit, parameters
};

/// The value of L that says what is set.
struct DataInputRow {
  static constexpr uint32_t kWithoutL = ~uint32_t{0};
  uint32_t l;        ///< kWithoutL: the block has none
  DataInput input;
};

/// What the codes of high speed select by their value: the modes of the first one, those of the second.
enum class SpeedMode : uint8_t { off, machining_1, machining_2, machining_3, accuracy_2 };
enum class SpeedOption : uint8_t { off, accuracy_1, spline };
struct SpeedModeRow {
  uint32_t value;
  SpeedMode mode;
};
struct SpeedOptionRow {
  uint32_t value;
  SpeedOption option;
};

/// An M code that goes out like any other and means something to the control besides.
struct OutputRow {
  uint16_t code;
  MiscFunction function;
};

/// Numbers of codes from the first to the last; none when the last comes before the first.
struct CodeRange {
  uint16_t first, last;
  constexpr bool holds(uint32_t code) const { return code >= first && code <= last; }
};

/// Every code of the manual's alarm list, with its short text.
struct AlarmText {
  const char* code;
  const char* message;
};

struct Dialect {
  nc_dialect id;
  const char* name;                  ///< "m700"
  const LexRules* lex;
  AddressTable addresses;            ///< which address carries which meaning
  uint32_t axis_addresses;           ///< bit n: address n is for axes; one that no axis has is a fault (or the second auxiliary function)
  uint32_t length_addresses;         ///< of words other than those of axes: the ones whose values have the range of lengths
  const uint8_t* argument_of;        ///< local variable that takes the word of each address in a macro call, 0 = none; nullptr without macros
  const char* calling_letters;       ///< those that may be registered to call a program by parameter
  char device_letter;                ///< in front of the number of a device where sub programs are looked for, 0 = there are none
  Table<FunctionRow> functions;      ///< sorted by code
  Table<MiscRow> misc;               ///< M codes that the control keeps for itself, sorted by code
  Table<OutputRow> outputs;          ///< those that go out and mean something besides, sorted by code
  Table<AlarmRow> conditions;        ///< condition -> code, at most one row for each; what has none is as dialect/default_alarms.hpp says
  Table<AlarmText> alarms;           ///< the manual's whole list
  Table<DataInputRow> data_input;
  Table<SpeedModeRow> speed_modes;
  Table<SpeedOptionRow> speed_options;
  const FamilyParameters* parameters;  ///< their numbers, names and what they mean
  const FamilyVariables* variables;    ///< system variables: their numbers and what they mean
  Rules rules;                       ///< in which families differ
  Table<Function> initial;           ///< what is in force at power on, each by its row that is numbered 0; modes that are not here have no group
  CodeRange macro_codes;             ///< G codes that exist to call macros where a parameter registers them
  CodeRange own_codes;               ///< G codes that may be registered, too, where a parameter allows it
  CodeRange macro_misc;              ///< M codes that may be registered, but for those that the control keeps for itself
  CodeRange interrupt_misc;          ///< M codes that a parameter may give the meaning of those of macro interrupt, as long as they go out otherwise
  // rules of program texts
  bool percent_required;             ///< DGSHAPE 2: the first block must be '%'
  bool end_code_required;            ///< M700 P36: text must not end without M02/M30
  bool bare_letters;                 ///< "G" alone is G00, "G28 XYZ" means zeros (M700 3.7, 14.10); else every word has its number
  unsigned call_depth;               ///< levels of sub programs
};

/// The family of a configuration that names none.
inline constexpr nc_dialect kDefaultDialect = NC_DIALECT_M700;

/// `id` came from outside and names a family.
constexpr bool known(unsigned id) { return id < NC_DIALECT_COUNT; }

/// The families there are stand in registry.cpp.
const Dialect& dialect(nc_dialect id);

/// Row of a G code (times 10), nullptr = the manual does not list it (Condition::illegal_g).
const FunctionRow* find_function(const Dialect& dialect, int code);
const MiscRow* find_misc(const Dialect& dialect, unsigned code);

/// The row of this function that is numbered 0, whatever the order of the codes; nullptr = the family has no code for it.
const FunctionRow* find_function(const Dialect& dialect, Function function);
/// What an M code means; MiscFunction::output where it means nothing here.
MiscFunction misc_function(const Dialect& dialect, unsigned code);
/// First M code that means this, kNoMisc where there is none.
inline constexpr unsigned kNoMisc = ~0u;
unsigned misc_code(const Dialect& dialect, MiscFunction function);

/// Alarms that the family can raise, from 0 on: those of its list, then those of the common table (dialect/default_alarms.hpp) that it has no
/// code of its own for. nullptr behind the last.
const AlarmText* alarm_at(const Dialect& dialect, unsigned index);

/// Code and message of a fault. Condition::no_function with the letter of a G or M code and the code (G: times 10) as value takes the row's own alarm.
AlarmText alarm_text(const Dialect& dialect, const Fault& fault);

}  // namespace nc
