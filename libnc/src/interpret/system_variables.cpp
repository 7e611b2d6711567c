// SPDX-License-Identifier: Apache-2.0
// System variables of the M700 (13.5.5): one table of ranges, laid out as the manual's; each range has a reader and a writer.
#include <cmath>
#include <cstring>

#include "base/utf8.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/system_variable_table.hpp"

namespace nc {
namespace {

bool reads_inch(const Interpreter& in, unsigned axis) {
  return in.state.modal.code[kGroupUnit] == 200 && ((in.rotary >> axis) & 1) == 0;
}

/// A position as a program reads it. It is a whole number of the setting unit #1003, the finest step that an axis can be commanded to or
/// be read at (M700 2.1): what is left of sums of offsets, of maps and of the division by 25.4 is no place of the machine.
double position_read(const Interpreter& in, unsigned axis, double mm) {
  const Settings& s = in.settings;
  if (reads_inch(in, axis)) return whole_units(mm / 25.4, s.setting_unit_inch);
  return whole_units(mm, ((in.rotary >> axis) & 1) != 0 ? s.setting_unit_deg : s.setting_unit_mm);
}

/// The same of an axis that may count within one turn: 359.9999 is 0 where the unit is 0.001.
using Shown = AxisVec (*)(const Interpreter&, const AxisVec&);
double shown_position(const Interpreter& in, unsigned axis, AxisVec position, Shown shown) {
  if (((in.rotary >> axis) & 1) != 0) position[axis] = position_read(in, axis, position[axis]);
  return position_read(in, axis, shown(in, position)[axis]);
}

// ---- macro interface (M700 13.5.5, tables 21036-22098) ------------------------------------------------------------------

/// Word and bit of #1000-#1031 (word 0), #1200-#1295 (words 1..3); outputs alike at +100.
void interface_bit(uint32_t number, uint32_t* word, uint32_t* bit) {
  const uint32_t low = number % 100;
  if (number < 1200) {
    *word = 0;
    *bit = low;
  } else {
    *word = 1 + low / 32;
    *bit = low % 32;
  }
}

Eval read_input_bit(Access& a) {
  if (!world_known(a, NC_SYNC_INPUT)) return Eval::need_sync;
  uint32_t word = 0, bit = 0;
  interface_bit(a.number, &word, &bit);
  return give(a, (a.in.world.input[word] >> bit) & 1);
}
Eval read_input_word(Access& a) {
  if (!world_known(a, NC_SYNC_INPUT)) return Eval::need_sync;
  return give(a, a.in.world.input[a.offset]);
}

uint32_t output_word(const Interpreter& in, uint32_t word) { return static_cast<uint32_t>(in.frames.get(Frames::output_key(word))); }

/// Outputs change when the machine gets there: the interpreter keeps what it has read ahead, the action goes into the stream.
Did put_outputs(Access& a, uint32_t word, uint32_t mask, uint32_t bits) {
  a.in.set_table(Frames::output_key(word), (output_word(a.in, word) & ~mask) | (bits & mask));
  Action& action = a.in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_OUTPUT;
  action.index = word;
  action.mask = mask;
  action.bits = bits & mask;
  action.value = a.written;
  return Did::done;
}
Eval read_output_bit(Access& a) {
  uint32_t word = 0, bit = 0;
  interface_bit(a.number, &word, &bit);
  return give(a, (output_word(a.in, word) >> bit) & 1);
}
Did write_output_bit(Access& a) {
  uint32_t word = 0, bit = 0;
  interface_bit(a.number, &word, &bit);
  // vacant = 0, any number other than 0 = 1; below 1e-8 the manual says "indefinite": here 0.
  return put_outputs(a, word, 1u << bit, std::fabs(a.written) < 1e-8 ? 0 : 1u << bit);
}
Eval read_output_word(Access& a) { return give(a, output_word(a.in, a.offset)); }
Did write_output_word(Access& a) {
  const double whole = std::trunc(a.written);
  if (whole < -2147483648.0 || whole > 4294967295.0) return a.in.raise(Condition::value_range, '#', a.number);
  return put_outputs(a, a.offset, 0xffffffffu, static_cast<uint32_t>(static_cast<int64_t>(whole)));
}

// ---- offsets ---------------------------------------------------------------------------------------------------------------

bool tool_key(Access& a, uint32_t* key) {
  const uint32_t n = a.number;
  unsigned column = 0;
  uint32_t index = 0;
  if (n < 10000) {
    constexpr unsigned kColumn[4] = {NC_TOOL_LENGTH, NC_TOOL_LENGTH_WEAR, NC_TOOL_RADIUS, NC_TOOL_RADIUS_WEAR};
    column = kColumn[(n - 2001) / 200];
    index = (n - 2001) % 200 + 1;
  } else {
    column = n < 11000 ? NC_TOOL_LENGTH : n < 12000 ? NC_TOOL_LENGTH_WEAR : n < 17000 ? NC_TOOL_RADIUS : NC_TOOL_RADIUS_WEAR;
    index = n % 1000;
  }
  if (index == 0 || index > a.in.frames.tool_offsets() || (column != NC_TOOL_LENGTH && !a.in.settings.tool_memory_2)) return false;
  *key = a.in.frames.tool_key(index, column);
  return true;
}
Eval read_tool(Access& a) {
  uint32_t key = 0;
  return tool_key(a, &key) ? give(a, a.in.frames.get(key)) : no_variable(a);
}
Did write_tool(Access& a) {
  uint32_t key = 0;
  if (!tool_key(a, &key)) return a.in.raise(Condition::variable_number, '#', a.number);
  if (std::fabs(a.written) >= kOffsetRange) return a.in.raise(Condition::value_range, '#', a.written);
  a.in.set_table(key, a.written);
  return Did::done;
}

/// #5201 external, #5221 G54 ... #5321 G59 (axis number behind), #7001 + 20 (n - 1): G54.1 Pn.
bool work_key(Access& a, uint32_t* key) {
  const uint32_t row = a.offset / 20, axis = a.offset % 20;
  if (axis >= a.in.axis_count) return false;
  if (a.number >= 7000) {
    if (row >= a.in.frames.extended_systems()) return false;
    *key = Frames::work_key(6 + row, axis);
  } else {
    *key = row == 0 ? Frames::external_key(axis) : Frames::work_key(row - 1, axis);
  }
  return true;
}
Eval read_work(Access& a) {
  uint32_t key = 0;
  return work_key(a, &key) ? give(a, a.in.frames.get(key)) : no_variable(a);
}
Did write_work(Access& a) {
  uint32_t key = 0;
  if (!work_key(a, &key)) return a.in.raise(Condition::variable_number, '#', a.number);
  if (std::fabs(a.written) >= kOffsetRange) return a.in.raise(Condition::value_range, '#', a.written);
  a.in.set_table(key, a.written);
  return Did::done;
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

Did write_alarm(Access& a) {
  if (!(a.written >= 1) || a.written > 9999) return a.in.raise(Condition::value_range, '#', a.written);  // M700 10.3
  a.in.raise(Condition::user_alarm, '#', a.written);
  a.in.user_alarm_text = keep_text(a);
  return Did::fault;
}
Did write_message(Access& a) {
  Action& action = a.in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_MESSAGE;
  action.value = a.written;
  action.text = keep_text(a);
  a.in.emit(ItemKind::gate).gate.kind = NC_GATE_STOP;
  return Did::done;
}

unsigned counter_of(const Access& a) { return a.number - 3001; }

double counter_ms(const Interpreter& in, unsigned which) { return which == 0 ? in.world.power_on_ms : in.world.run_ms; }
double counter_unit(const Interpreter& in, unsigned which) { return which == 1 && in.settings.run_time_hours ? 3600000.0 : 1.0; }

Eval read_counter(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  return give(a, (counter_ms(a.in, counter_of(a)) - a.in.state.clock_base[counter_of(a)]) / counter_unit(a.in, counter_of(a)));
}
Did write_counter(Access& a) {
  const double unit = counter_unit(a.in, counter_of(a));
  if (!(a.written >= 0) || a.written * unit > 244335917226.0) return a.in.raise(Condition::value_range, '#', a.written);  // M700 13.5.5 (24299)
  if (!a.in.world_fresh) return a.in.need(NC_SYNC_CLOCK);
  a.in.state.clock_base[counter_of(a)] = counter_ms(a.in, counter_of(a)) - a.written * unit;
  return Did::done;
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

/// #3011 YYYYMMDD, #3012 HHMMSS (M700 10.18): the program sets its own clock, kept as a shift against the machine's.
Did write_date(Access& a) {
  if (!(a.written >= 0) || a.written > 99999999) return a.in.raise(Condition::value_range, '#', a.written);
  const auto digits = static_cast<uint32_t>(a.written);
  const unsigned high = digits / 10000, middle = digits / 100 % 100, low = digits % 100;
  int64_t year = 0;
  unsigned month = 0, day = 0;
  if ((a.number - 3011) == 0) {
    civil(days_of(high, middle == 0 ? 1 : middle, low == 0 ? 1 : low), &year, &month, &day);
    if (high < 2000 || high > 2099 || month != middle || day != low) return a.in.raise(Condition::value_range, '#', a.written);
  } else if (high > 23 || middle > 59 || low > 59) {
    return a.in.raise(Condition::value_range, '#', a.written);
  }
  if (!a.in.world_fresh) return a.in.need(NC_SYNC_CLOCK);
  const int64_t now = clock_seconds(a.in);
  const int64_t wanted = (a.number - 3011) == 0 ? days_of(high, middle, low) * 86400 + now % 86400 : now - now % 86400 + high * 3600 + middle * 60 + low;
  a.in.state.clock_shift_s += wanted - now;
  return Did::done;
}

/// #3901 machinings, #3902 their maximum (M700 10.13: positive). Macros of the maker write #3901 = -1, which is an option.
Eval read_count(Access& a) { return give(a, a.in.frames.get(Frames::count_key(a.offset))); }
Did write_count(Access& a) {
  constexpr double kMost = 999999;
  const double least = a.number == 3901 && a.in.settings.negative_count ? -kMost : 0;
  if (!(a.written >= least) || a.written > kMost) return a.in.raise(Condition::value_range, '#', a.written);
  a.in.set_table(Frames::count_key(a.offset), std::trunc(a.written));
  return Did::done;
}

Eval read_date(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  const int64_t seconds = clock_seconds(a.in);
  if ((a.number - 3011) == 1) return give(a, static_cast<double>(seconds / 3600 % 24 * 10000 + seconds / 60 % 60 * 100 + seconds % 60));
  int64_t year = 0;
  unsigned month = 0, day = 0;
  civil(seconds / 86400, &year, &month, &day);
  return give(a, static_cast<double>(year * 10000 + month * 100 + day));
}

/// M700 13.5.5: #3003 has the values 0 to 3, #3004 0 to 7.
Did write_control(Access& a) {
  if (!(a.written >= 0) || a.written >= (a.number == 3003 ? 4 : 8)) return a.in.raise(Condition::value_range, '#', a.written);
  const auto bits = static_cast<uint8_t>(a.written);
  (a.number == 3003 ? a.in.state.control_3003 : a.in.state.control_3004) = bits;
  Action& action = a.in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = a.number;
  action.value = bits;
  return Did::done;
}
Eval read_control(Access& a) { return give(a, a.number == 3003 ? a.in.state.control_3003 : a.in.state.control_3004); }
Eval read_mirror(Access& a) { return give(a, a.in.state.any_mirror()); }

// ---- modal state ---------------------------------------------------------------------------------------------------------------

Eval give_group(Access& a, const ModalState& modal) {
  const int16_t code = modal.code[a.offset + 1];
  if (code < 0) {
    *a.value = Value{};
    return Eval::ok;
  }
  return give(a, code / 10.0);
}
Eval read_group_ahead(Access& a) { return give_group(a, a.in.state.modal); }
Eval read_group_now(Access& a) { return world_known(a, NC_SYNC_MODAL) ? give_group(a, a.in.finished_modal) : Eval::need_sync; }

/// M700 10.10: the number that the name of the file is, "blank" where it is none.
Eval give_program(Access& a, uint32_t number) {
  if (number != 0) return give(a, number);
  *a.value = Value{};
  return Eval::ok;
}

/// #41nn, #43nn: 2 B, 7 D, 9 F, 11 H, 13 M, 14 N, 15 O, 19 S, 20 T (M700 10.10).
Eval give_word(Access& a, const ModalState& m) {
  switch (a.offset + 1) {
    case 2: return give(a, m.b);
    case 7: return give(a, m.d);
    case 9: return give(a, m.feed);
    case 11: return give(a, m.h);
    case 13: return give(a, m.m);
    case 14: return give(a, m.n);
    case 15: return give_program(a, a.in.source.program);
    case 19: return give(a, m.spindle);
    case 20: return give(a, m.tool);
    default: return no_variable(a);
  }
}
/// #4130: P of the G54.1 that is selected, 0 while none is.
Eval read_extended_work(Access& a) {
  constexpr unsigned kStandard = 6;  // G54 to G59
  const unsigned system = a.in.state.work_system;
  return give(a, system < kStandard ? 0 : system - kStandard + 1);
}
Eval read_word_ahead(Access& a) { return give_word(a, a.in.state.modal); }
Eval read_word_now(Access& a) { return world_known(a, NC_SYNC_MODAL) ? give_word(a, a.in.finished_modal) : Eval::need_sync; }

/// #4401-#4421, #4507-#4520: as the interrupt program was entered, and only in it (M700 13.12).
Eval read_group_interrupt(Access& a) {
  return a.in.state.interrupt_depth != 0 ? give_group(a, a.in.interrupted_modal()) : no_variable(a);
}
Eval read_word_interrupt(Access& a) {
  if (a.in.state.interrupt_depth == 0) return no_variable(a);
  const ModalState& m = a.in.interrupted_modal();
  if (a.offset + 1 != 15) return give_word(a, m);
  return give_program(a, a.in.state.frame[a.in.state.interrupt_depth - 1].program.number);
}

// ---- positions -----------------------------------------------------------------------------------------------------------------

AxisVec axes_of(const nc_axes& axes) {
  AxisVec out;
  std::memcpy(out.v, axes.v, sizeof out.v);
  return out;
}

bool axis_ok(Access& a) { return a.offset < a.in.axis_count; }

Eval read_end_point(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, shown_position(a.in, a.offset, a.in.position(), work_shown));
}
Eval read_machine(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  if (!world_known(a, NC_SYNC_POSITION)) return Eval::need_sync;
  return give(a, shown_position(a.in, a.offset, axes_of(a.in.world.machine), machine_shown));
}
Eval read_work_position(Access& a) {  // with tool compensation in it (M700 10.11)
  if (!axis_ok(a)) return no_variable(a);
  if (!world_known(a, NC_SYNC_POSITION)) return Eval::need_sync;
  AxisVec work = axes_of(a.in.world.machine);
  work[a.offset] -= a.in.zero()[a.offset];
  return give(a, shown_position(a.in, a.offset, work, work_shown));
}
Eval read_skip(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  AxisVec skip;
  skip[a.offset] = a.in.frames.get(Frames::skip_key(a.offset));
  return give(a, shown_position(a.in, a.offset, skip, work_shown));
}
Eval read_compensation(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, position_read(a.in, a.offset, a.in.state.applied[a.offset]));
}
/// Behind a sync the machine is in position: the deviation that is left is below the in-position width.
Eval read_deviation(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return world_known(a, NC_SYNC_POSITION) ? give(a, 0) : Eval::need_sync;
}

constexpr uint32_t kPosition = NC_SYNC_POSITION, kInput = NC_SYNC_INPUT, kClock = NC_SYNC_CLOCK, kModal = NC_SYNC_MODAL;

// The table. Sections are those of 13.5.5 but for 13.12 and 14.10.
constexpr SystemVariableRow kRows[] = {
    {1000, 1031, read_input_bit, nullptr, kInput, "0/1", "macro interface inputs, bits of #1032", "13.5.5"},
    {1032, 1035, read_input_word, nullptr, kInput, "32 bits", "macro interface inputs, words", "13.5.5"},
    {1100, 1131, read_output_bit, write_output_bit, 0, "0/1", "macro interface outputs, bits of #1132", "13.5.5"},
    {1132, 1135, read_output_word, write_output_word, 0, "32 bits", "macro interface outputs, words", "13.5.5"},
    {1200, 1295, read_input_bit, nullptr, kInput, "0/1", "macro interface inputs, bits of #1033 to #1035", "13.5.5"},
    {1300, 1395, read_output_bit, write_output_bit, 0, "0/1", "macro interface outputs, bits of #1133 to #1135", "13.5.5"},
    {2001, 2800, read_tool, write_tool, 0, "mm", "tool offsets 1 to 200: length, #2201 its wear, #2401 radius, #2601 its wear", "13.5.5"},
    {3000, 3000, nullptr, write_alarm, 0, "1-9999", "alarm of the program, with its text in ( )", "13.5.5"},
    {3001, 3001, read_counter, write_counter, kClock, "ms", "time with power on", "13.5.5"},
    {3002, 3002, read_counter, write_counter, kClock, "ms, h (#1273 bit 1)", "time in automatic start", "13.5.5"},
    {3003, 3004, read_control, write_control, 0, "bits", "#3003 no single block stop, no FIN; #3004 no feed hold, override, G09", "13.5.5"},
    {3006, 3006, nullptr, write_message, 0, "-", "stop with the message in ( )", "13.5.5"},
    {3007, 3007, read_mirror, nullptr, 0, "bits", "mirrored axes, bit 0 = first axis", "13.5.5"},
    {3011, 3011, read_date, write_date, kClock, "YYYYMMDD", "date", "13.5.5"},
    {3012, 3012, read_date, write_date, kClock, "HHMMSS", "time of day", "13.5.5"},
    {3901, 3902, read_count, write_count, 0, "count", "workpieces machined, #3902 their maximum", "13.5.5"},
    {4001, 4021, read_group_ahead, nullptr, 0, "G code", "active G code of groups 1 to 21, as read", "13.5.5"},
    {4101, 4120, read_word_ahead, nullptr, 0, "as programmed", "B D F H M N O S T (#4102 07 09 11 13 14 15 19 20), as read", "13.5.5"},
    {4130, 4130, read_extended_work, nullptr, 0, "as programmed", "P of the G54.1 in force, as read; 0 = G54 to G59", "14.10"},
    {4201, 4221, read_group_now, nullptr, kModal, "G code", "active G code of groups 1 to 21, block in execution", "13.5.5"},
    {4301, 4320, read_word_now, nullptr, kModal, "as programmed", "B D F H M N O S T, block in execution", "13.5.5"},
    {4401, 4421, read_group_interrupt, nullptr, 0, "G code", "active G code of groups 1 to 21 at a macro interrupt", "13.12"},
    {4501, 4520, read_word_interrupt, nullptr, 0, "as programmed", "D F H M N O S T at a macro interrupt", "13.12"},
    {5001, 5020, read_end_point, nullptr, 0, "mm, inch, deg", "end point of the block before, by axis", "13.5.5"},
    {5021, 5040, read_machine, nullptr, kPosition, "mm, inch, deg", "machine position", "13.5.5"},
    {5041, 5060, read_work_position, nullptr, kPosition, "mm, inch, deg", "workpiece position, tool compensation in it", "13.5.5"},
    {5061, 5080, read_skip, nullptr, 0, "mm, inch, deg", "position of the last skip", "13.5.5"},
    {5081, 5100, read_compensation, nullptr, 0, "mm, inch, deg", "tool position compensation", "13.5.5"},
    {5101, 5120, read_deviation, nullptr, kPosition, "mm, inch, deg", "servo deviation", "13.5.5"},
    {5201, 5340, read_work, write_work, 0, "mm, deg", "work offsets: external, #5221 G54 to #5321 G59, by axis", "13.5.5"},
    {7001, 8920, read_work, write_work, 0, "mm, deg", "work offsets G54.1 P1 to P96, 20 numbers each, by axis", "14.10"},
    {10001, 10999, read_tool, write_tool, 0, "mm", "tool offsets: length (type I: the value)", "13.5.5"},
    {11001, 11999, read_tool, write_tool, 0, "mm", "tool offsets: length wear (type II)", "13.5.5"},
    {16001, 16999, read_tool, write_tool, 0, "mm", "tool offsets: radius (type II)", "13.5.5"},
    {17001, 17999, read_tool, write_tool, 0, "mm", "tool offsets: radius wear (type II)", "13.5.5"},
    {30060, 30068, read_rotation, nullptr, 0, "axis, mm, deg", "coordinate rotation: axes, centre, angle, SIN, COS, vector", "13.5.5"},
    {60000, 60000, nullptr, select_tool_group, 0, "group", "tool life: group that is read", "13.5.5"},
    {60001, 60008, read_tool_group, nullptr, 0, "-", "tool life of the group; -1 = not registered", "13.5.5"},
    {60501, 60700, read_tool_life, nullptr, 0, "-", "tool life: group number; -1 = no tool registered", "13.5.5"},
    {61001, 61200, read_tool_life, nullptr, 0, "-", "tool life: tool number", "13.5.5"},
    {61501, 61700, read_tool_life, nullptr, 0, "-", "tool life: flags", "13.5.5"},
    {62001, 62200, read_tool_life, nullptr, 0, "-", "tool life: status", "13.5.5"},
    {62501, 62700, read_tool_life, nullptr, 0, "-", "tool life: life", "13.5.5"},
    {63001, 63200, read_tool_life, nullptr, 0, "-", "tool life: used", "13.5.5"},
    {63501, 63700, read_tool_life, nullptr, 0, "-", "tool life: length compensation", "13.5.5"},
    {64001, 64200, read_tool_life, nullptr, 0, "-", "tool life: radius compensation", "13.5.5"},
    {64501, 64700, read_tool_life, nullptr, 0, "-", "tool life: auxiliary data", "13.5.5"},
    {100000, 100002, nullptr, select_parameter, 0, "-", "parameter that is read: number, part system, axis", "13.5.5"},
    {100010, 100010, read_parameter, nullptr, 0, "the parameter's", "value of that parameter", "13.5.5"},
    {100100, 100103, nullptr, select_device, 0, "-", "PLC data that is read: device, number, bytes, bit", "13.5.5"},
    {100110, 100110, read_device, nullptr, kInput, "-", "value of that device", "13.5.5"},
};

const SystemVariableRow* find_range(uint32_t number) {
  for (const SystemVariableRow& row : kRows)
    if (number >= row.first && number <= row.last) return &row;
  return nullptr;
}

Eval read_any(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
  Interpreter& in = *static_cast<Interpreter*>(self);
  if (number == 0) {  // M700 13.5.4: always vacant
    *value = Value{};
    return Eval::ok;
  }
  if (in.variables.get(number, in.macro_level(), value)) return Eval::ok;
  return read_system_variable(in, number, value, fault, sync);
}

}  // namespace

VariableReader variable_reader(Interpreter& in) { return {&in, read_any, find_variable_name, in.variables.locals(in.macro_level()), kLocals}; }

Eval read_system_variable(Interpreter& in, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
  const SystemVariableRow* range = find_range(number);
  if (range == nullptr || range->read == nullptr) {
    in.raise(range == nullptr ? Condition::variable_number : Condition::variable_use, '#', number);
    *fault = in.fault;
    return Eval::fault;
  }
  Access access{in, number, number - range->first, value, sync};
  const Eval eval = range->read(access);
  if (eval == Eval::fault) *fault = in.fault;
  return eval;
}

Did write_system_variable(Interpreter& in, uint32_t number, Value value, const Statement& statement) {
  const SystemVariableRow* range = find_range(number);
  if (range == nullptr) return in.raise(Condition::variable_number, '#', number);
  if (range->write == nullptr) return in.raise(Condition::variable_use, '#', number);
  Access access{in, number, number - range->first};
  access.written = value.or_zero();
  access.statement = &statement;
  return range->write(access);
}

}  // namespace nc

nc_status nc_system_variable_get(unsigned index, nc_system_variable* row) {
  constexpr unsigned kCount = sizeof nc::kRows / sizeof nc::kRows[0];
  if (row == nullptr) return NC_E_ARGUMENT;
  if (index >= kCount) return NC_E_NOT_FOUND;
  const nc::SystemVariableRow& from = nc::kRows[index];
  *row = nc_system_variable{from.first, from.last, from.read != nullptr, from.write != nullptr, from.sync, from.unit, from.name, from.section};
  return NC_OK;
}
