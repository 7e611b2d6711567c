// SPDX-License-Identifier: Apache-2.0
// The system variables of a family: which number means what. The control has one handler for each meaning
// (interpret/system_variables.cpp). A handler gets the meaning and the place in the range, never the number.
#pragma once

#include <cstdint>

#include "dialect/table.hpp"
#include "nc/control.h"

namespace nc {

/// Meaning of a range of system variables. A variable is known by the part of the range it is in and by its place in this part, counted
/// from 0. A range has one part only, unless the comment beside the meaning names several.
enum class SystemVariable : uint8_t {
  input_bit, input_word,       ///< macro interface; a part of a range of bits is one word, and a range may run over several words
  output_bit, output_word,
  tool_offset,                 ///< the parts are lengths, wears of lengths, radii, wears of radii; one place for each offset
  work_offset,                 ///< the parts are the external offset, the six standard systems, the extended systems; one place for each axis
  alarm, message,
  time_powered, time_running,  ///< time with power on, time in automatic operation
  control,                     ///< two places: single block and FIN, feed hold and override
  single_block_off,            ///< the first of them where it is yes or no
  mirror,
  date, time_of_day,
  count,                       ///< two: workpieces machined, their maximum
  code, code_now, code_at_interrupt,   ///< a place for each modal group: as read, in execution, as a macro interrupt came
  word, word_now, word_at_interrupt,   ///< a place for each ModalWord of the family, from that of the part on
  extended_work,               ///< number of the extended coordinate system in force
  end_point, machine_position, work_position, skip_position, compensation, deviation,   ///< one place for each axis
  rotation,                    ///< rotation of coordinates: axes h and v, centre h and v, angle, sine and cosine of it, vector h and v
  tool_group_select, tool_group, tool_life,
  parameter_select,            ///< three places: number, part system, axis
  parameter,
  device_select,               ///< four places: device, number, bytes, bit
  device,
  parameter_itself,            ///< the parameter that has the number of the variable
  reference_position,          ///< parts are the reference positions, from 0; a place for each axis
  input_answer,                ///< what the last wait for an input has found
  skip_answer,                 ///< 1: the signal of the last skip has come, 0: it has not
  speed_code, spindle_speed,   ///< names of the machine's side, which no program reads: the S code, the speed that the spindle is wanted at
  count_
};

inline constexpr unsigned kSystemVariables = static_cast<unsigned>(SystemVariable::count_);

/// One range of system variables. docs/system-variables.md is made from these rows.
struct VariableRow {
  uint32_t first, last;
  SystemVariable what;
  uint16_t part;        ///< the part that the range begins with
  uint16_t stride;      ///< distance in numbers from one part to the next, 0 = the range has one part only
  const char* unit;
  const char* name;
  const char* section;  ///< section of the family's manual
};

/// Words whose last value a program can read in a system variable.
enum class ModalWord : uint8_t { none, second_auxiliary, radius_number, feed, length_number, misc, sequence, program, spindle, tool, spindle_tool };

/// A kind of ladder device that programs can read.
struct DeviceRow {
  uint8_t code;    ///< the number by which a program selects this kind
  bool word;       ///< each device is a word, otherwise a bit
  uint32_t count;  ///< how many devices of this kind there are
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
  Table<VariableRow> rows = {};   ///< sorted by number; no two ranges overlap
  uint32_t last_local = 33;       ///< #1 to this one are local; a macro call fills #1 to #33 (macro/variables.hpp: at most kMostLocals)
  VariableRange common[2] = {};   ///< common variables if the family fixes them; empty if the configuration chooses them
  VariableRange named = {500, 519};    ///< common variables that can have a name (M700 13.5.5 SETVN), at most kNames (macro/variables.hpp)
  VariableRange cleared = {100, 199};  ///< those that Parameter::reset_clears_common and power_off_clears_common clear (M700 13.4 #1128, #1129, HX 14.4)
  VariableRange divided[2] = {{100, 199}, {500, 999}};  ///< the values of Parameter::last_shared_of_first and last_shared_of_second (M700 13.4 #1303, #1304)
  Table<ModalWord> words = {};    ///< the places of the ranges `word`, `word_now` and `word_at_interrupt`, in this order
  Table<DeviceRow> devices = {};
  Table<DeviceWidth> device_widths = {};
};

/// The role of such variables as the host's interface names it.
constexpr nc_variable_role interface_role(SystemVariable what) {
  switch (what) {
    case SystemVariable::input_bit: return NC_VARIABLE_INPUT_BIT;
    case SystemVariable::input_word: return NC_VARIABLE_INPUT_WORD;
    case SystemVariable::output_bit: return NC_VARIABLE_OUTPUT_BIT;
    case SystemVariable::output_word: return NC_VARIABLE_OUTPUT_WORD;
    case SystemVariable::speed_code: return NC_VARIABLE_SPEED_CODE;
    case SystemVariable::spindle_speed: return NC_VARIABLE_SPINDLE_SPEED;
    default: return NC_VARIABLE_OTHER;
  }
}

/// Row of a variable number, nullptr = the number is no system variable.
const VariableRow* find_variable(const FamilyVariables& variables, uint32_t number);

/// Where a number is in its row: the part, and the place in this part.
struct VariablePlace {
  uint32_t part, index;
};
constexpr VariablePlace place_in(const VariableRow& row, uint32_t number) {
  const uint32_t offset = number - row.first;
  return row.stride == 0 ? VariablePlace{row.part, offset} : VariablePlace{row.part + offset / row.stride, offset % row.stride};
}

}  // namespace nc
