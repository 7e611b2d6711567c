// SPDX-License-Identifier: Apache-2.0
// System variables (M700 13.5.5): each meaning has a function that reads and one that writes it. The numbers of a meaning are in the family's table
// (dialect/variable_rows.hpp).
#include <cmath>
#include <cstring>

#include "base/struct_size.hpp"
#include "base/units.hpp"
#include "base/utf8.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/system_variable_table.hpp"

namespace nc {
namespace {

bool reads_inch(const Interpreter& in, unsigned axis) {
  return in.state.modal.is(Function::inch) && ((in.rotary >> axis) & 1) == 0;
}

/// A position as a program reads it: rounded to the setting unit #1003, the finest step in which an axis can be commanded or read (M700 2.1). So the
/// rounding of sums of offsets, of maps and of the division by 25.4 does not show. Where numbers are not counted in a unit it is as calculated.
double position_read(const Interpreter& in, unsigned axis, double mm) {
  const Settings& s = in.settings;
  if (in.dialect->rules.number.positions_as_calculated) return reads_inch(in, axis) ? mm / kMillimetresPerInch : mm;
  if (reads_inch(in, axis)) return whole_units(mm / kMillimetresPerInch, s.setting_unit_inch);
  return whole_units(mm, ((in.rotary >> axis) & 1) != 0 ? s.setting_unit_deg : s.setting_unit_mm);
}

/// A position, as a program reads it, of an axis that may be counted within one turn: 359.9999 is 0 where the unit is 0.001.
using Shown = AxisVec (*)(const InForce&, const AxisVec&);
double shown_position(const Interpreter& in, unsigned axis, AxisVec position, Shown shown) {
  if (((in.rotary >> axis) & 1) != 0) position[axis] = position_read(in, axis, position[axis]);
  return position_read(in, axis, shown(in, position)[axis]);
}

// ---- macro interface (M700 13.5.5, tables 21036-22098) ------------------------------------------------------------------

/// The word and bit of a variable that is one bit of the interface; a.part is the word with which its range begins.
void interface_bit(const Access& a, uint32_t* word, uint32_t* bit) {
  *word = a.part + a.index / 32;
  *bit = a.index % 32;
}

Eval read_input_bit(Access& a) {
  if (!world_known(a, NC_SYNC_INPUT)) return Eval::need_sync;
  uint32_t word = 0, bit = 0;
  interface_bit(a, &word, &bit);
  return give(a, (a.in.world.input[word] >> bit) & 1);
}
Eval read_input_word(Access& a) {
  if (!world_known(a, NC_SYNC_INPUT)) return Eval::need_sync;
  return give(a, a.in.world.input[a.part + a.index]);
}

uint32_t output_word(const Interpreter& in, uint32_t word) { return in.records->output[word].bits; }

Execution put_outputs(Access& a, uint32_t word, uint32_t mask, uint32_t bits) {
  give_out_bits(a.in, word, mask, bits, a.written);
  return Execution::done;
}
Eval read_output_bit(Access& a) {
  uint32_t word = 0, bit = 0;
  interface_bit(a, &word, &bit);
  return give(a, (output_word(a.in, word) >> bit) & 1);
}
Execution write_output_bit(Access& a) {
  uint32_t word = 0, bit = 0;
  interface_bit(a, &word, &bit);
  // Vacant is 0, and any number other than 0 is 1; for values below 1e-8 the manual says "indefinite", and here they are 0.
  return put_outputs(a, word, 1u << bit, std::fabs(a.written) < 1e-8 ? 0 : 1u << bit);
}
Eval read_output_word(Access& a) { return give(a, output_word(a.in, a.part + a.index)); }
Eval read_input_answer(Access& a) { return give(a, a.in.records->answer.value); }
Execution write_output_word(Access& a) {
  const double whole = std::trunc(a.written);
  if (whole < -2147483648.0 || whole > 4294967295.0) return a.in.raise(Condition::value_range, Sign::variable, a.number);
  return put_outputs(a, a.part + a.index, 0xffffffffu, static_cast<uint32_t>(static_cast<int64_t>(whole)));
}

// ---- offsets ---------------------------------------------------------------------------------------------------------------

unsigned tool_column(const Access& a) {
  constexpr unsigned kColumn[4] = {NC_TOOL_LENGTH, NC_TOOL_LENGTH_WEAR, NC_TOOL_RADIUS, NC_TOOL_RADIUS_WEAR};
  return kColumn[a.part];
}
bool tool_key(Access& a, uint32_t* key) {
  const unsigned column = tool_column(a);
  const uint32_t number = a.index + 1;
  if (number > a.in.frames.tool_offsets() || (column != NC_TOOL_LENGTH && !a.in.settings.tool_memory_2)) return false;
  *key = a.in.frames.tool_key(number, column);
  return true;
}
/// mm of one unit of an offset that is read or written as a variable: of the unit that the program is written in (HX), or of the one that offsets are set in
/// (M700 2.1 note 1: #1041, whatever G20 and G21 say).
double unit_of_offsets(const Access& a, bool length) {
  const bool inch = a.in.dialect->rules.data_input.variables_in_unit ? a.in.state.modal.is(Function::inch) : a.in.settings.initial_inch;
  return length && inch ? kMillimetresPerInch : 1;
}
Execution set_offset(Access& a, uint32_t key, bool length, double end) {
  const double value = a.written * unit_of_offsets(a, length);
  if (std::fabs(value) >= end) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  a.in.set_table(key, value);
  return Execution::done;
}
bool of_length(const Access& a) { return ((a.in.rotary >> a.index) & 1) == 0; }

Eval read_tool(Access& a) {
  uint32_t key = 0;
  if (!tool_key(a, &key)) return no_variable(a);
  return shared_known(a) ? give(a, a.in.frames.get(key) / unit_of_offsets(a, true)) : Eval::need_sync;
}
Execution write_tool(Access& a) {
  uint32_t key = 0;
  return tool_key(a, &key) ? set_offset(a, key, true, end_of_offset(a.in, tool_column(a))) : a.in.raise(Condition::variable_number, Sign::variable, a.number);
}

/// Part 0 is the external offset, the next six are the standard systems, then come the extended ones.
bool work_key(Access& a, uint32_t* key) {
  if (a.index >= a.in.axis_count) return false;
  if (a.part > Frames::kStandardSystems && a.part - Frames::kStandardSystems > a.in.frames.extended_systems()) return false;
  *key = a.part == 0 ? Frames::external_key(a.index) : Frames::work_key(a.part - 1, a.index);
  return true;
}
Eval read_work(Access& a) {
  uint32_t key = 0;
  return work_key(a, &key) ? give(a, a.in.frames.get(key) / unit_of_offsets(a, of_length(a))) : no_variable(a);
}
Execution write_work(Access& a) {
  uint32_t key = 0;
  return work_key(a, &key) ? set_offset(a, key, of_length(a), end_of_work_offset(a.in, a.index)) : a.in.raise(Condition::variable_number, Sign::variable, a.number);
}

// ---- alarm, message, clock, control ------------------------------------------------------------------------------------------

uint32_t keep_text(Access& a) {
  Message message;
  const size_t room = sizeof(message.text.s) - 1;
  const char* const text = a.in.block->text.begin() + a.statement->text;
  const size_t length = a.statement->text_length <= room ? a.statement->text_length : whole_characters(text, room);
  std::memcpy(message.text.s, text, length);
  return a.in.texts.intern(message);
}

Execution write_alarm(Access& a) {
  if (!(a.written >= 1) || a.written > a.in.dialect->rules.range.largest_alarm) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  a.in.raise(Condition::user_alarm, Sign::variable, a.written);
  a.in.user_alarm_text = keep_text(a);
  return Execution::fault;
}
Execution write_message(Access& a) {
  Action& action = a.in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_MESSAGE;
  action.value = a.written;
  action.text = keep_text(a);
  a.in.emit(ItemKind::gate).gate.kind = NC_GATE_STOP;
  return Execution::done;
}

/// Counters of time: with power on, and in automatic operation.
enum Counter : unsigned { kPowered, kRunning };

double counter_ms(const Interpreter& in, Counter which) { return which == kPowered ? in.world.power_on_ms : in.world.run_ms; }
double counter_unit(const Interpreter& in, Counter which) { return which == kRunning && in.settings.run_time_hours ? 3600000.0 : 1.0; }

template <Counter which>
Eval read_counter(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  return give(a, (counter_ms(a.in, which) - a.in.state.clock_base[which]) / counter_unit(a.in, which));
}
template <Counter which>
Execution write_counter(Access& a) {
  const double unit = counter_unit(a.in, which);
  if (!(a.written >= 0) || a.written * unit > a.in.dialect->rules.range.longest_counter_ms) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  if (!a.in.world_fresh) return a.in.need(NC_SYNC_CLOCK);
  a.in.state.clock_base[which] = counter_ms(a.in, which) - a.written * unit;
  return Execution::done;
}

/// Civil date of days since 1970-01-01 (proleptic Gregorian; era arithmetic over 400 years).
void civil(int64_t days, int64_t* year, unsigned* month, unsigned* day) {
  days += 719468;
  const int64_t era = (days >= 0 ? days : days - 146096) / 146097;
  const auto doe = static_cast<unsigned>(days - era * 146097);
  const unsigned yoe = (doe - doe / 1460 + doe / 36524 - doe / 146096) / 365;
  const unsigned doy = doe - (365 * yoe + yoe / 4 - yoe / 100);
  const unsigned mp = (5 * doy + 2) / 153;
  *day = doy - (153 * mp + 2) / 5 + 1;
  *month = mp < 10 ? mp + 3 : mp - 9;
  *year = static_cast<int64_t>(yoe) + era * 400 + (*month <= 2 ? 1 : 0);
}

/// Inverse of civil().
int64_t days_of(int64_t year, unsigned month, unsigned day) {
  year -= month <= 2 ? 1 : 0;
  const int64_t era = year / 400;
  const auto yoe = static_cast<unsigned>(year - era * 400);
  const unsigned doy = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  const unsigned doe = yoe * 365 + yoe / 4 - yoe / 100 + doy;
  return era * 146097 + static_cast<int64_t>(doe) - 719468;
}

int64_t clock_seconds(const Interpreter& in) { return in.world.clock_ms / 1000 + in.state.clock_shift_s; }

/// Sets the clock of programs, which is kept as its difference from the clock of the machine.
Execution set_clock(Access& a, int64_t day, int64_t second_of_day) {
  if (!a.in.world_fresh) return a.in.need(NC_SYNC_CLOCK);
  a.in.state.clock_shift_s += day * 86400 + second_of_day - clock_seconds(a.in);
  return Execution::done;
}

/// A number of six or eight digits, split into pairs from the right (M700 13.5.5 (10.18)).
struct Digits {
  unsigned high, middle, low;
};
bool digits_of(const Access& a, Digits* digits) {
  constexpr double kEightDigits = 1e8;
  if (!(a.written >= 0) || !(a.written < kEightDigits)) return false;
  const auto all = static_cast<uint32_t>(a.written);
  *digits = {all / 10000, all / 100 % 100, all % 100};
  return true;
}

/// YYYYMMDD.
Execution write_date(Access& a) {
  Digits d{};
  if (!digits_of(a, &d)) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  int64_t year = 0;
  unsigned month = 0, day = 0;
  const RangeRules& range = a.in.dialect->rules.range;
  civil(days_of(d.high, d.middle == 0 ? 1 : d.middle, d.low == 0 ? 1 : d.low), &year, &month, &day);
  if (d.high < range.first_year || d.high > range.last_year || month != d.middle || day != d.low) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  return set_clock(a, days_of(d.high, d.middle, d.low), clock_seconds(a.in) % 86400);
}
Eval read_date(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  int64_t year = 0;
  unsigned month = 0, day = 0;
  civil(clock_seconds(a.in) / 86400, &year, &month, &day);
  return give(a, static_cast<double>(year * 10000 + month * 100 + day));
}

/// HHMMSS.
Execution write_time_of_day(Access& a) {
  Digits d{};
  if (!digits_of(a, &d) || d.high > 23 || d.middle > 59 || d.low > 59) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  const int64_t now = clock_seconds(a.in), midnight = now - now % 86400;
  return set_clock(a, midnight / 86400, int64_t{d.high} * 3600 + d.middle * 60 + d.low);
}
Eval read_time_of_day(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  const int64_t seconds = clock_seconds(a.in);
  return give(a, static_cast<double>(seconds / 3600 % 24 * 10000 + seconds / 60 % 60 * 100 + seconds % 60));
}

/// Number of machined workpieces, and its maximum: positive. Macros of machine makers write -1 as the first, which an option allows.
Eval read_count(Access& a) { return give(a, a.in.records->workpieces.count[a.index]); }
Execution write_count(Access& a) {
  const double most = a.in.dialect->rules.range.most_workpieces, least = a.index == 0 && a.in.settings.negative_count ? -most : 0;
  if (!(a.written >= least) || a.written > most) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  WorkpieceCounts workpieces = a.in.records->workpieces;
  workpieces.count[a.index] = static_cast<int32_t>(a.written);
  a.in.change(&ProgramRecords::workpieces, workpieces);
  return Execution::done;
}

/// The bits of #3003 and #3004. M700 13.5.5: the first takes 0 to 3, the second 0 to 7.
struct ControlBits {
  uint8_t State::*bits;
  double end;
  nc_control_index index;
};
constexpr ControlBits kControlBits[] = {{&State::suppressed, 4, NC_CONTROL_SUPPRESS}, {&State::disabled, 8, NC_CONTROL_DISABLE}};

Execution write_control(Access& a) {
  const ControlBits& control = kControlBits[a.index];
  if (!(a.written >= 0) || a.written >= control.end) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  const auto bits = static_cast<uint8_t>(a.written);
  a.in.state.*control.bits = bits;
  Action& action = a.in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = control.index;
  action.value = bits;
  return Execution::done;
}
Execution write_single_block_off(Access& a) {  // HX 14.2.3 (4)
  if (a.written != 0 && a.written != 1) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  return write_control(a);
}
Eval read_control(Access& a) { return give(a, a.in.state.*kControlBits[a.index].bits); }
Eval read_mirror(Access& a) { return give(a, a.in.state.any_mirror()); }

// ---- modal state ---------------------------------------------------------------------------------------------------------------

Eval give_group(Access& a, const ModalState& modal) {
  const int16_t code = code_in_force(*a.in.dialect, modal, a.index + 1);
  if (code < 0) {
    *a.value = Value{};
    return Eval::ok;
  }
  return give(a, code / 10.0);
}
Eval read_group_ahead(Access& a) { return give_group(a, a.in.state.modal); }
Eval read_group_now(Access& a) { return world_known(a, NC_SYNC_MODAL) ? give_group(a, a.in.state.executed) : Eval::need_sync; }

/// M700 13.5.5 (10.10): the number that the name of the file stands for; where it is no number the variable is vacant ("blank").
Eval give_program(Access& a, uint32_t number) {
  if (number != 0) return give(a, number);
  *a.value = Value{};
  return Eval::ok;
}

ModalWord word_of(const Access& a) {
  const Table<ModalWord>& words = a.in.dialect->variables->words;
  const uint32_t place = a.part + a.index;
  return place < words.size ? words.row[place] : ModalWord::none;
}

Eval give_word(Access& a, const ModalState& m) {
  switch (word_of(a)) {
    case ModalWord::second_auxiliary: return give(a, m.b);
    case ModalWord::radius_number: return give(a, m.d);
    case ModalWord::feed: return give(a, m.feed);
    case ModalWord::length_number: return give(a, m.h);
    case ModalWord::misc: return give(a, m.m);
    case ModalWord::sequence: return give(a, m.n);
    case ModalWord::program: return give_program(a, a.in.source.program);
    case ModalWord::spindle: return give(a, m.spindle);
    case ModalWord::tool: return give(a, m.tool);
    case ModalWord::spindle_tool: return give(a, a.in.state.spindle_tool == kNoTool ? 0 : a.in.state.spindle_tool);
    case ModalWord::none: break;
  }
  return no_variable(a);
}
/// Number of the extended system that is selected, 0 while none is.
Eval read_extended_work(Access& a) {
  const unsigned system = a.in.state.work_system;
  return give(a, system < Frames::kStandardSystems ? 0 : system - Frames::kStandardSystems + 1);
}
Eval read_word_ahead(Access& a) { return give_word(a, a.in.state.modal); }
Eval read_word_now(Access& a) { return world_known(a, NC_SYNC_MODAL) ? give_word(a, a.in.state.executed) : Eval::need_sync; }

/// The modal state when the interrupt program was entered, which can be read only in it (M700 13.12).
Eval read_group_interrupt(Access& a) {
  return a.in.state.interrupt_depth != 0 ? give_group(a, a.in.interrupted_modal()) : no_variable(a);
}
Eval read_word_interrupt(Access& a) {
  if (a.in.state.interrupt_depth == 0) return no_variable(a);
  const ModalState& m = a.in.interrupted_modal();
  if (word_of(a) != ModalWord::program) return give_word(a, m);
  return give_program(a, a.in.state.frame[a.in.state.interrupt_depth - 1].program.number);
}

// ---- positions -----------------------------------------------------------------------------------------------------------------

AxisVec axes_of(const nc_axes& axes) {
  AxisVec out;
  std::memcpy(out.v, axes.v, sizeof out.v);
  return out;
}

bool axis_ok(Access& a) { return a.index < a.in.axis_count; }

Eval read_end_point(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, shown_position(a.in, a.index, a.in.position(), work_shown));
}
Eval read_machine(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  if (!world_known(a, NC_SYNC_POSITION)) return Eval::need_sync;
  return give(a, shown_position(a.in, a.index, axes_of(a.in.world.machine), machine_shown));
}
/// It includes tool compensation (M700 13.5.5 (10.11)), but for a length that shifts what is read (RS-274/NGC 3.5.11, LinuxCNC #5420).
Eval read_work_position(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  if (a.in.dialect->rules.compensation.bars_reading_position && a.in.state.compensated()) {
    a.in.raise(Condition::not_in_compensation, Sign::variable, a.number);
    return Eval::fault;
  }
  if (!world_known(a, NC_SYNC_POSITION)) return Eval::need_sync;
  AxisVec work = axes_of(a.in.world.machine);
  work[a.index] -= a.in.zero()[a.index] + (a.in.dialect->rules.length.shifts_reading ? a.in.state.applied[a.index] : 0);
  return give(a, shown_position(a.in, a.index, work, work_shown));
}
Eval read_skip(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  AxisVec skip;
  skip[a.index] = a.in.records->skip.work[a.index];
  return give(a, shown_position(a.in, a.index, skip, work_shown));
}
Eval read_skip_answer(Access& a) { return give(a, a.in.records->skip.touched ? 1 : 0); }
Eval read_compensation(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, position_read(a.in, a.index, a.in.state.applied[a.index]));
}
/// After a sync the machine is in position, so the deviation that is left is below the in-position width.
Eval read_deviation(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return world_known(a, NC_SYNC_POSITION) ? give(a, 0) : Eval::need_sync;
}

Eval read_reference(Access& a) { return axis_ok(a) ? give(a, position_read(a.in, a.index, a.in.reference(a.part, a.index))) : no_variable(a); }

constexpr uint32_t kPosition = NC_SYNC_POSITION, kInput = NC_SYNC_INPUT, kClock = NC_SYNC_CLOCK, kModal = NC_SYNC_MODAL;

using V = SystemVariable;

constexpr VariableHandler kHandlers[kSystemVariables] = {
    {V::input_bit, read_input_bit, nullptr, kInput},
    {V::input_word, read_input_word, nullptr, kInput},
    {V::output_bit, read_output_bit, write_output_bit, 0},
    {V::output_word, read_output_word, write_output_word, 0},
    {V::tool_offset, read_tool, write_tool, 0},
    {V::work_offset, read_work, write_work, 0},
    {V::alarm, nullptr, write_alarm, 0},
    {V::message, nullptr, write_message, 0},
    {V::time_powered, read_counter<kPowered>, write_counter<kPowered>, kClock},
    {V::time_running, read_counter<kRunning>, write_counter<kRunning>, kClock},
    {V::control, read_control, write_control, 0},
    {V::single_block_off, read_control, write_single_block_off, 0},
    {V::mirror, read_mirror, nullptr, 0},
    {V::date, read_date, write_date, kClock},
    {V::time_of_day, read_time_of_day, write_time_of_day, kClock},
    {V::count, read_count, write_count, 0},
    {V::code, read_group_ahead, nullptr, 0},
    {V::code_now, read_group_now, nullptr, kModal},
    {V::code_at_interrupt, read_group_interrupt, nullptr, 0},
    {V::word, read_word_ahead, nullptr, 0},
    {V::word_now, read_word_now, nullptr, kModal},
    {V::word_at_interrupt, read_word_interrupt, nullptr, 0},
    {V::extended_work, read_extended_work, nullptr, 0},
    {V::end_point, read_end_point, nullptr, 0},
    {V::machine_position, read_machine, nullptr, kPosition},
    {V::work_position, read_work_position, nullptr, kPosition},
    {V::skip_position, read_skip, nullptr, 0},
    {V::compensation, read_compensation, nullptr, 0},
    {V::deviation, read_deviation, nullptr, kPosition},
    {V::rotation, read_rotation, nullptr, 0},
    {V::tool_group_select, nullptr, select_tool_group, 0},
    {V::tool_group, read_tool_group, nullptr, 0},
    {V::tool_life, read_tool_life, nullptr, 0},
    {V::parameter_select, nullptr, select_parameter, 0},
    {V::parameter, read_parameter, nullptr, 0},
    {V::device_select, nullptr, select_device, 0},
    {V::device, read_device, nullptr, kInput},
    {V::parameter_itself, read_parameter_itself, write_parameter_itself, 0},
    {V::reference_position, read_reference, nullptr, 0},
    {V::input_answer, read_input_answer, nullptr, 0},
    {V::skip_answer, read_skip_answer, nullptr, 0},
    {V::speed_code, nullptr, nullptr, 0},
    {V::spindle_speed, nullptr, nullptr, 0},
};
constexpr bool in_order() {
  for (unsigned i = 0; i < kSystemVariables; ++i)
    if (static_cast<unsigned>(kHandlers[i].what) != i) return false;
  return true;
}
static_assert(in_order());

const VariableHandler& handler_of(const VariableRow& row) { return kHandlers[static_cast<unsigned>(row.what)]; }

Eval read_any(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
  Interpreter& in = *static_cast<Interpreter*>(self);
  if (number == 0) {  // M700 13.5.4: always vacant
    *value = Value{};
    return Eval::ok;
  }
  if (in.variables.get(number, in.macro_level(), value)) {
    if (in.shared_known() || !in.variables.shares(number)) return Eval::ok;
    *sync = NC_SYNC_SHARED;
    return Eval::need_sync;
  }
  return read_system_variable(in, number, value, fault, sync);
}

bool find_named(void* self, const char* name, size_t length, bool make, uint32_t* number) {
  return static_cast<Interpreter*>(self)->variables.find_named(name, length, make, number);
}

}  // namespace

EvalOptions eval_options(const Interpreter& in) { return {in.settings.asin_0_360, in.dialect->rules.number.variable_numbers_within}; }

VariableReader variable_reader(Interpreter& in) {
  const uint32_t names_need = in.shared_known() ? 0 : uint32_t{NC_SYNC_SHARED};
  return {&in, read_any, find_variable_name, in.variables.locals(in.macro_level()), kLocals, names_need, find_named};
}

Eval read_system_variable(Interpreter& in, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
  const VariableRow* range = find_variable(*in.dialect->variables, number);
  const VariableGet read = range != nullptr ? handler_of(*range).read : nullptr;
  if (read == nullptr) {
    in.raise(range == nullptr ? Condition::variable_number : Condition::variable_use, Sign::variable, number);
    *fault = in.fault;
    return Eval::fault;
  }
  const VariablePlace place = place_in(*range, number);
  Access access{in, place.part, place.index, number, value, sync};
  const Eval eval = read(access);
  if (eval == Eval::fault) *fault = in.fault;
  // Not where an interrupt program may come in between: it counts what its block has done in the order of the program.
  const bool interruptible = in.state.interrupt_on || in.state.interrupt_depth != 0;
  if (eval == Eval::need_sync && in.in_contour() && !interruptible && *sync != NC_SYNC_SHARED) *sync |= Interpreter::kSyncAhead;
  return eval;
}

Execution write_system_variable(Interpreter& in, uint32_t number, Value value, const Statement& statement) {
  const VariableRow* range = find_variable(*in.dialect->variables, number);
  if (range == nullptr) return in.raise(Condition::variable_number, Sign::variable, number);
  const VariableSet write = handler_of(*range).write;
  if (write == nullptr) return in.raise(Condition::variable_use, Sign::variable, number);
  const VariablePlace place = place_in(*range, number);
  Access access{in, place.part, place.index, number};
  access.written = value.or_zero();
  access.statement = &statement;
  return write(access);
}

}  // namespace nc

nc_status nc_system_variable_row(nc_dialect dialect, unsigned index, nc_system_variable* row) {
  if (row == nullptr || nc::caller_bytes(row) == 0 || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::Table<nc::VariableRow>& rows = nc::dialect(dialect).variables->rows;
  if (index >= rows.size) return NC_E_NOT_FOUND;
  const nc::VariableRow& from = rows.row[index];
  const nc::VariableHandler& handler = nc::handler_of(from);
  const nc_variable_role role = nc::interface_role(from.what);
  const auto word = static_cast<uint8_t>(role != NC_VARIABLE_OTHER ? from.part : 0);
  nc::give_struct(nc_system_variable{sizeof(nc_system_variable), from.first, from.last, static_cast<uint8_t>(role), word, handler.read != nullptr, handler.write != nullptr, handler.sync, from.unit,
                                     from.name, from.section}, row);
  return NC_OK;
}
