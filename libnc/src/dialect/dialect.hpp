// SPDX-License-Identifier: Apache-2.0
// A controller family is a set of tables. One folder per family (dialect/m700, dialect/dgshape, dialect/iso) holds its word formats, its G
// and M codes and its alarms; this header says what such a table looks like. To add a family, add a folder and one line in registry.cpp.
#pragma once

#include "dialect/alarms.hpp"
#include "dialect/function.hpp"
#include "dialect/parameter_rows.hpp"
#include "dialect/precedence.hpp"
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
  const char* missing;   ///< if the function is not built: the code of the alarm that it raises ("P90"); nullptr = it is built
  const char* name;      ///< short English name, our words
  const char* section;   ///< section of the manual
  const char* part = nullptr;  ///< if the function is built in part: what is not built; of one that is not there: why, for the sentence of its alarm
  uint8_t number = 0;    ///< counts the rows with the same function from 0: G54 to G59 are 0 to 5; G107, the second code of G07.1, is 1
};

struct MiscRow {
  uint16_t code;
  MiscFunction function;
  const char* missing;   ///< as in FunctionRow
  const char* name;
  const char* section;
  uint8_t number = 0;    ///< which of the codes with this function
  const char* part = nullptr;  ///< as in FunctionRow
};

/// What data setting by program sets.
enum class DataInput : uint8_t {
  missing,           ///< something that the manual has and that is not built
  work_offset,       ///< the offset of a workpiece coordinate system, or of all of them
  work_offset_here,  ///< the same offset, chosen such that the axis shows the given value where it stands
  extended_offset,   ///< the offset of an extended workpiece coordinate system
  tool_length, tool_length_wear, tool_radius, tool_radius_wear,
  current_limit, parameters,
  tool_life          ///< groups of tools whose life is managed: blocks with them follow
};

/// Which value of L sets what.
struct DataInputRow {
  static constexpr uint32_t kWithoutL = ~uint32_t{0};
  uint32_t l;        ///< value of L; kWithoutL stands for a block without L
  DataInput input;
};

/// What the two codes of high speed select by their value: SpeedMode belongs to the first code (Function::high_speed), SpeedOption to the
/// second one (Function::high_speed_accuracy).
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

/// An M code that is put out like any other and also means something to the control.
struct OutputRow {
  uint16_t code;
  MiscFunction function;
};

/// The code numbers from `first` to `last`. The range is empty if `last` is less than `first`.
struct CodeRange {
  uint16_t first, last;
  constexpr bool holds(uint32_t code) const { return code >= first && code <= last; }
};

/// One code of the manual's alarm list, with its short text.
struct AlarmText {
  const char* code;
  const char* message;
};

/// What has a value here may be left out by a family that does not have it. All else has to be said.
struct Dialect {
  nc_dialect id;
  const char* name;                  ///< "m700"
  const char* title;                 ///< whose programs it reads, one short line
  const LexRules* lex;
  AddressTable addresses;            ///< which address carries which meaning
  uint32_t axis_addresses;           ///< bit n: address n is for axes; if no axis has it, the word is a fault (or the second auxiliary function)
  uint32_t length_addresses;         ///< bit n: the words of address n, which are not those of axes, have the range of lengths
  const uint8_t* argument_of = nullptr;  ///< by address: local variable that takes its word in a macro call, 0 = none; nullptr = no macros
  WordSet calling_words = 0;         ///< words that a parameter may register to call a program
  char device_letter = 0;            ///< letter in front of the number of a device that holds sub programs, 0 = there are no such devices
  bool codes_by_name = false;        ///< a code is shown by the name in its row ("LINE"); otherwise by letter and number
  Table<FunctionRow> functions;      ///< G codes, sorted by code
  Table<MiscRow> misc;               ///< M codes that the control keeps for itself, sorted by code
  Table<OutputRow> outputs;          ///< those that go out and mean something besides, or are all there are (AuxiliaryRules::codes_are_listed), sorted by code
  Table<AlarmRow> conditions;        ///< condition -> code, at most one row for each; what has none is as dialect/default_alarms.hpp says
  Table<AlarmText> alarms;           ///< the manual's whole list
  Table<PrecedenceRow> precedence{};  ///< what becomes of the codes of a block, where it is not as dialect/default_precedence.hpp says
  Table<BarredRow> barred{};         ///< functions that are alarms in a mode, beside those that are so in every family
  Table<DataInputRow> data_input{};
  Table<SpeedModeRow> speed_modes{};
  Table<SpeedOptionRow> speed_options{};
  const FamilyParameters* parameters;  ///< numbers and names of the parameters and what they mean
  const FamilyVariables* variables;    ///< numbers of the system variables and what they mean
  Rules rules;                       ///< rules in which families differ
  Table<Function> initial;           ///< functions in force at power on, by their row number 0; a mode without an entry begins with resting() (modal/modes.hpp)
  CodeRange macro_codes{1, 0};       ///< G codes that call a macro if a parameter registers them
  CodeRange own_codes{1, 0};         ///< G codes of the control that may be registered too if a parameter allows it
  CodeRange macro_misc{1, 0};        ///< M codes that may be registered, except those that the control keeps for itself
  CodeRange interrupt_misc{1, 0};    ///< M codes that a parameter may make the codes of macro interrupt, except those that the control keeps
  // rules of program texts
  bool percent_required;             ///< the first block must be '%' (DGSHAPE 2)
  bool end_code_required;            ///< the text must not end without M02 or M30 (M700 P36)
  bool bare_letters;                 ///< "G" alone is G00, "G28 XYZ" means zeros (M700 3.7, 14.10); otherwise every word needs its number
  unsigned most_offsets = ~0u;       ///< highest number of an offset of a tool that a program can name
  unsigned call_depth;               ///< how many levels deep sub programs may be called
};

/// The family that applies if a configuration names none.
inline constexpr nc_dialect kDefaultDialect = NC_DIALECT_M700;

/// `id`, which came from outside libnc, is the number of a family.
constexpr bool known(unsigned id) { return id < NC_DIALECT_COUNT; }

/// The tables of a family. registry.cpp lists the families.
const Dialect& dialect(nc_dialect id);

/// Row of a G code (times 10), nullptr = the manual does not list the code (Condition::illegal_g).
const FunctionRow* find_function(const Dialect& dialect, int code);
const MiscRow* find_misc(const Dialect& dialect, unsigned code);

/// The row with number 0 of this function, whatever the order of the codes. nullptr = the family has no code for the function.
const FunctionRow* find_function(const Dialect& dialect, Function function);
/// The M code stands in the table of those that go out.
bool puts_out(const Dialect& dialect, unsigned code);
/// What an M code means. MiscFunction::output if it means nothing to the control.
MiscFunction misc_function(const Dialect& dialect, unsigned code);
/// The result of misc_code() if there is no such code.
inline constexpr unsigned kNoMisc = ~0u;
/// The first M code that means this, or kNoMisc.
unsigned misc_code(const Dialect& dialect, MiscFunction function);

/// Alarms that the family can raise, from 0 on: those of its list, then those of the common table (dialect/default_alarms.hpp) that it has no
/// code of its own for. nullptr behind the last.
const AlarmText* alarm_at(const Dialect& dialect, unsigned index);

/// Code and message of a fault. Condition::no_function with the letter of a G or M code and the code (G: times 10) as value takes the row's own alarm.
AlarmText alarm_text(const Dialect& dialect, const Fault& fault);

}  // namespace nc
