// SPDX-License-Identifier: Apache-2.0
// What a controller family is: tables. One folder per family (dialect/m700, dialect/dgshape) holds its word formats, its G and M codes,
// its alarms; this header says what such a table looks like. To add a family, add a folder and one line in dialect.cpp.
#pragma once

#include "dialect/alarms.hpp"
#include "program/block.hpp"

namespace nc {

/// What a G code does: functions shared by all families, implemented in interpret/. A family's table binds its codes to them.
enum class Function : uint8_t {
  missing,            ///< in the manual, not built: raises the row's alarm when used
  rapid, linear, arc_cw, arc_ccw,
  spiral, exponential, space_arc, nurbs, thread,   ///< G02.1 G02.3 G02.4 G06.2 G33 and their counterparts: group 1 tells which
  cylinder, polar_on, polar_off,   ///< G07.1 G12.1 G13.1
  polar_command_on, polar_command_off,   ///< G16 G15
  hypothetical_axis,  ///< G07
  unidirectional,     ///< G60
  high_speed,         ///< G05
  high_speed_accuracy,///< G05.1
  high_accuracy,      ///< G08
  high_accuracy_mode, ///< G61.1
  dwell, data_input, data_input_end,   ///< G04 G10 G11
  exact_stop_once,    ///< G09
  plane_xy, plane_zx, plane_yz,
  inch, metric,
  reference_return, skip, machine_move,
  reference_check, start_return, second_reference, tool_change_return,   ///< G27 G29 G30 G30.1-G30.6
  multi_skip, measure_length,          ///< G31.1-G31.3 G37
  stroke_check_on, stroke_check_off,   ///< G22 G23: modal, and G22 takes the axis words of the block
  comp_off, comp_left, comp_right,
  length_plus, length_minus, length_off,
  work_system,        ///< G54..G59; which one is code10 / 10 - 54
  extended_system,    ///< G54.1 P
  local_system,       ///< G52
  coordinate_set,     ///< G92
  coordinate_preset,  ///< G92.1
  cycle_off, cycle_drill, cycle_spot, cycle_peck, cycle_step, cycle_bore_feed, cycle_bore_dwell,   ///< G80 G81 G82 G83 G73 G85 G89
  absolute, incremental,
  feed_per_minute, feed_per_revolution, inverse_time_feed,   ///< G94 G95 G93
  return_initial, return_r,
  exact_stop_mode, corner_override, tapping_mode, cutting_mode,   ///< G61 G62 G63 G64
  macro_call, macro_modal, macro_every_block,   ///< G65 G66 G66.1: the words behind them are arguments
  macro_modal_off,    ///< G67
  surface_on, surface_off,   ///< G96 G97
  mirror_on, mirror_off,   ///< G51.1 G50.1: modal, and they take the axis words of the block
  scaling_on, scaling_off, rotation_on, rotation_off,   ///< G51 G50, G68 G69
  modal_off           ///< the cancel code of a function that is not built: the state it asks for is the only one there is
};

/// G27 to G30.
constexpr bool is_reference_move(Function f) {
  return f == Function::reference_check || f == Function::reference_return || f == Function::start_return || f == Function::second_reference;
}
/// One-shot functions whose axis words are positions to go to; those of the others are data.
constexpr bool goes_to_position(Function f) {
  return is_reference_move(f) || f == Function::tool_change_return || f == Function::skip || f == Function::multi_skip ||
         f == Function::measure_length || f == Function::machine_move || f == Function::unidirectional;
}
constexpr bool is_macro_call(Function f) { return f == Function::macro_call || f == Function::macro_modal || f == Function::macro_every_block; }

struct FunctionRow {
  int16_t code;          ///< times 10: G54.1 = 541
  uint8_t group;         ///< modal group as the manual numbers it, 0 = one-shot
  Function function;
  const char* missing;   ///< alarm code raised when function == missing ("P90"); nullptr otherwise
  const char* name;      ///< short English name, our words
  const char* section;   ///< of the manual
  const char* part = nullptr;  ///< supported in part: what of it is not built
};

/// What an M code is to the control itself; every other M is output.
enum class MiscFunction : uint8_t { output, program_stop, optional_stop, program_end, call_sub, return_sub, call_external, missing };
struct MiscRow {
  uint16_t code;
  MiscFunction function;
  const char* missing;
  const char* name;
  const char* section;
};

/// Every code of the manual's alarm list, with its short text.
struct AlarmText {
  const char* code;
  const char* message;
};

/// A parameter the manual names: how its key is written. Digits are always accepted (M700); words only when they are here.
struct ParameterName {
  const char* key;
  double value;          ///< default
  const char* words;     ///< accepted words in the order of their values, "|"-separated ("conventional|calculator"), nullptr = number
  const char* values;    ///< what holds without it first; nullptr = the words
  const char* name;
  const char* section;   ///< of the manual
};

template <class T>
struct Table {
  const T* row = nullptr;
  unsigned size = 0;
  const T* begin() const { return row; }
  const T* end() const { return row + size; }
};

struct Dialect {
  nc_dialect id;
  const char* name;                  ///< "m700"
  const LexRules* lex;
  Table<FunctionRow> functions;      ///< sorted by code
  Table<MiscRow> misc;               ///< sorted by code
  Table<AlarmRow> conditions;        ///< condition -> code, one row for each condition of Condition
  Table<AlarmText> alarms;           ///< the manual's whole list
  Table<ParameterName> parameters;   ///< named ones
  int16_t initial[NC_GROUPS];        ///< active code of each group at power on, times 10; -1 = the group does not exist
  // rules that differ by family and belong to no single function
  bool percent_required;             ///< DGSHAPE 2: the first block must be '%'
  bool end_code_required;            ///< M700 P36: text must not end without M02/M30
  bool bare_letters;                 ///< "G" alone is G00, "G28 XYZ" means zeros (M700 3.7, 14.10); else every word has its number
  unsigned call_depth;               ///< levels of sub programs
};

/// `id` came from outside and names a family.
constexpr bool known(unsigned id) { return id < NC_DIALECT_COUNT; }

const Dialect& dialect(nc_dialect id);

/// Row of a G code (times 10), nullptr = the manual does not list it (Condition::illegal_g).
const FunctionRow* find_function(const Dialect& dialect, int code);
const MiscRow* find_misc(const Dialect& dialect, unsigned code);

/// Code and message of a fault. Condition::no_function with letter 'G' or 'M' and the code (G: times 10) as value takes the row's own alarm.
AlarmText alarm_text(const Dialect& dialect, const Fault& fault);

}  // namespace nc
