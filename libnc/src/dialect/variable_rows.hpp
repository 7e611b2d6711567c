// SPDX-License-Identifier: Apache-2.0
// The system variables of a family: which numbers mean what. The control has one handler for each meaning (interpret/system_variables.cpp)
// and gets the meaning and the place in the range, never a number.
#pragma once

#include <cstdint>

#include "dialect/table.hpp"
#include "nc/control.h"

namespace nc {

/// What a range of system variables is. Unless something else stands beside it a range is one part, and a variable is known by its place
/// in it, from 0.
enum class SystemVariable : uint8_t {
  input_bit, input_word,       ///< macro interface; parts of bits are words, a range may run over several
  output_bit, output_word,
  tool_offset,                 ///< parts are lengths, their wears, radii, their wears; a place for each offset
  work_offset,                 ///< parts are the external offset, the six standard systems, the extended ones; a place for each axis
  alarm, message,
  time_powered, time_running,  ///< with power on, in automatic operation
  control,                     ///< two: single block and FIN, feed hold and override
  mirror,
  date, time_of_day,
  count,                       ///< two: workpieces machined, their maximum
  code, code_now, code_at_interrupt,   ///< a place for each modal group: as read, in execution, as a macro interrupt came
  word, word_now, word_at_interrupt,   ///< a place for each ModalWord of the family, from that of the part on
  extended_work,               ///< number of the extended coordinate system in force
  end_point, machine_position, work_position, skip_position, compensation, deviation,   ///< a place for each axis
  rotation,                    ///< of coordinates: axes h and v, centre h and v, angle, its sine and cosine, vector h and v
  tool_group_select, tool_group, tool_life,
  parameter_select,            ///< three: number, part system, axis
  parameter,
  device_select,               ///< four: device, number, bytes, bit
  device,
  parameter_itself,            ///< the parameter that has the number of the variable
  reference_position,          ///< parts are the reference positions, from 0; a place for each axis
  count_
};

inline constexpr unsigned kSystemVariables = static_cast<unsigned>(SystemVariable::count_);

/// One range. docs/system-variables.md is made from these rows.
struct VariableRow {
  uint32_t first, last;
  SystemVariable what;
  uint16_t part;        ///< that it begins with
  uint16_t stride;      ///< numbers from one part to the next, 0 = it has one part
  const char* unit;
  const char* name;
  const char* section;  ///< of the manual
};

/// Words whose last value can be read.
enum class ModalWord : uint8_t { none, second_auxiliary, radius_number, feed, length_number, misc, sequence, program, spindle, tool };

/// A device of the ladder that programs can read: its code, what its numbers are and how many.
struct DeviceRow {
  uint8_t code;
  bool word;
  uint32_t count;
};

/// How much of a device a program reads: the number that it writes for that, and what it stands for. 0 bytes: one bit.
struct DeviceWidth {
  uint8_t written;
  uint8_t bytes;
  bool is_signed;
};

struct VariableRange {
  uint32_t first, last;
};

struct FamilyVariables {
  Table<VariableRow> rows = {};   ///< sorted by number, apart from one another
  VariableRange common[2] = {};   ///< common variables of a family that has no options of them; none where the configuration says
  Table<ModalWord> words = {};    ///< layout of the ranges of words
  Table<DeviceRow> devices = {};
  Table<DeviceWidth> device_widths = {};
};

/// What a host knows such variables by.
constexpr nc_variable_role interface_role(SystemVariable what) {
  switch (what) {
    case SystemVariable::input_bit: return NC_VARIABLE_INPUT_BIT;
    case SystemVariable::input_word: return NC_VARIABLE_INPUT_WORD;
    case SystemVariable::output_bit: return NC_VARIABLE_OUTPUT_BIT;
    case SystemVariable::output_word: return NC_VARIABLE_OUTPUT_WORD;
    default: return NC_VARIABLE_OTHER;
  }
}

/// Row of a number; nullptr: it is no system variable.
const VariableRow* find_variable(const FamilyVariables& variables, uint32_t number);

/// The part of a row that a number of it belongs to, and its place there.
struct VariablePlace {
  uint32_t part, index;
};
constexpr VariablePlace place_in(const VariableRow& row, uint32_t number) {
  const uint32_t offset = number - row.first;
  return row.stride == 0 ? VariablePlace{row.part, offset} : VariablePlace{row.part + offset / row.stride, offset % row.stride};
}

}  // namespace nc
