// SPDX-License-Identifier: Apache-2.0
// System variables of the M700 (13.5.5): one table of ranges, laid out as the manual's; each range has a reader and a writer.
#include <cmath>
#include <cstring>

#include "interpret/interpreter.hpp"

namespace nc {
namespace {

struct Access {
  Interpreter& in;
  uint32_t number;
  uint32_t offset;          ///< number - first of the range
  Value* value = nullptr;   ///< read
  uint32_t* sync = nullptr; ///< read: what is missing
  double written = 0;       ///< write
  const Statement* statement = nullptr;
};

using Reader = Eval (*)(Access& a);
using Writer = Did (*)(Access& a);

struct Range {
  uint32_t first, last;
  Reader read;
  Writer write;             ///< nullptr: read only (P243)
};

Eval give(Access& a, double number) {
  *a.value = Value::of(number);
  return Eval::ok;
}

/// The value exists only when everything before has happened: is the answer there?
bool world_known(Access& a, uint32_t what) {
  if (a.in.world_fresh) return true;
  *a.sync = what;
  return false;
}

bool reads_inch(const Interpreter& in, unsigned axis) {
  return in.state.modal.code[kGroupUnit] == 200 && ((in.rotary >> axis) & 1) == 0;
}
double in_program_unit(const Interpreter& in, unsigned axis, double mm) { return reads_inch(in, axis) ? mm / 25.4 : mm; }

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
Eval no_variable(Access& a) {
  a.in.raise(Condition::variable_number, '#', a.number);
  return Eval::fault;
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
  const size_t length = a.statement->text_length < room ? a.statement->text_length : room;
  std::memcpy(message.text.s, a.in.block->text.begin() + a.statement->text, length);
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

double counter_ms(const Interpreter& in, unsigned which) { return which == 0 ? in.world.power_on_ms : in.world.run_ms; }
double counter_unit(const Interpreter& in, unsigned which) { return which == 1 && in.settings.run_time_hours ? 3600000.0 : 1.0; }

Eval read_counter(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  return give(a, (counter_ms(a.in, a.offset) - a.in.state.clock_base[a.offset]) / counter_unit(a.in, a.offset));
}
Did write_counter(Access& a) {
  const double unit = counter_unit(a.in, a.offset);
  if (!(a.written >= 0) || a.written * unit > 244335917226.0) return a.in.raise(Condition::value_range, '#', a.written);  // M700 13.5.5 (24299)
  if (!a.in.world_fresh) return a.in.need(NC_SYNC_CLOCK);
  a.in.state.clock_base[a.offset] = counter_ms(a.in, a.offset) - a.written * unit;
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
  if (a.offset == 0) {
    civil(days_of(high, middle == 0 ? 1 : middle, low == 0 ? 1 : low), &year, &month, &day);
    if (high < 2000 || high > 2099 || month != middle || day != low) return a.in.raise(Condition::value_range, '#', a.written);
  } else if (high > 23 || middle > 59 || low > 59) {
    return a.in.raise(Condition::value_range, '#', a.written);
  }
  if (!a.in.world_fresh) return a.in.need(NC_SYNC_CLOCK);
  const int64_t now = clock_seconds(a.in);
  const int64_t wanted = a.offset == 0 ? days_of(high, middle, low) * 86400 + now % 86400 : now - now % 86400 + high * 3600 + middle * 60 + low;
  a.in.state.clock_shift_s += wanted - now;
  return Did::done;
}

/// #3901 machinings, #3902 their maximum (M700 10.13).
Eval read_count(Access& a) { return give(a, a.in.frames.get(Frames::count_key(a.offset))); }
Did write_count(Access& a) {
  if (!(a.written >= 0) || a.written > 999999) return a.in.raise(Condition::value_range, '#', a.written);
  a.in.set_table(Frames::count_key(a.offset), std::trunc(a.written));
  return Did::done;
}

Eval read_date(Access& a) {
  if (!world_known(a, NC_SYNC_CLOCK)) return Eval::need_sync;
  const int64_t seconds = clock_seconds(a.in);
  if (a.offset == 1) return give(a, static_cast<double>(seconds / 3600 % 24 * 10000 + seconds / 60 % 60 * 100 + seconds % 60));
  int64_t year = 0;
  unsigned month = 0, day = 0;
  civil(seconds / 86400, &year, &month, &day);
  return give(a, static_cast<double>(year * 10000 + month * 100 + day));
}

Did write_control(Access& a) {
  if (!(a.written >= 0) || a.written >= 8) return a.in.raise(Condition::value_range, '#', a.written);
  const auto bits = static_cast<uint8_t>(a.written);
  (a.number == 3003 ? a.in.state.control_3003 : a.in.state.control_3004) = bits;
  Action& action = a.in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = a.number;
  action.value = bits;
  return Did::done;
}
Eval read_control(Access& a) { return give(a, a.number == 3003 ? a.in.state.control_3003 : a.in.state.control_3004); }
Eval read_mirror(Access& a) { return give(a, a.in.state.mirror); }
Eval write_only(Access& a) {
  a.in.raise(Condition::variable_use, '#', a.number);
  return Eval::fault;
}

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

/// #41nn, #43nn: 2 B, 7 D, 9 F, 11 H, 13 M, 14 N, 15 O, 19 S, 20 T (M700 10.10).
Eval give_word(Access& a, const ModalState& m) {
  switch (a.offset + 1) {
    case 2: return give(a, m.b);
    case 7: return give(a, m.d);
    case 9: return give(a, m.feed);
    case 11: return give(a, m.h);
    case 13: return give(a, m.m);
    case 14: return give(a, m.n);
    case 15: return give(a, a.in.source.program);
    case 19: return give(a, m.spindle);
    case 20: return give(a, m.tool);
    default: return no_variable(a);
  }
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
  return give(a, a.in.state.frame[a.in.state.interrupt_depth - 1].program.number);
}

// ---- positions -----------------------------------------------------------------------------------------------------------------

bool axis_ok(Access& a) { return a.offset < a.in.axis_count; }

Eval read_end_point(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, in_program_unit(a.in, a.offset, a.in.position()[a.offset]));
}
Eval read_machine(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  if (!world_known(a, NC_SYNC_POSITION)) return Eval::need_sync;
  return give(a, in_program_unit(a.in, a.offset, a.in.world.machine.v[a.offset]));
}
Eval read_work_position(Access& a) {  // with tool compensation in it (M700 10.11)
  if (!axis_ok(a)) return no_variable(a);
  if (!world_known(a, NC_SYNC_POSITION)) return Eval::need_sync;
  return give(a, in_program_unit(a.in, a.offset, a.in.world.machine.v[a.offset] - a.in.zero()[a.offset]));
}
Eval read_skip(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, in_program_unit(a.in, a.offset, a.in.frames.get(Frames::skip_key(a.offset))));
}
Eval read_compensation(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return give(a, in_program_unit(a.in, a.offset, a.in.state.applied[a.offset]));
}
/// Behind a sync the machine is in position: the deviation that is left is below the in-position width.
Eval read_deviation(Access& a) {
  if (!axis_ok(a)) return no_variable(a);
  return world_known(a, NC_SYNC_POSITION) ? give(a, 0) : Eval::need_sync;
}

constexpr Range kRanges[] = {
    {1000, 1031, read_input_bit, nullptr},
    {1032, 1035, read_input_word, nullptr},
    {1100, 1131, read_output_bit, write_output_bit},
    {1132, 1135, read_output_word, write_output_word},
    {1200, 1295, read_input_bit, nullptr},
    {1300, 1395, read_output_bit, write_output_bit},
    {2001, 2800, read_tool, write_tool},
    {3000, 3000, write_only, write_alarm},
    {3001, 3002, read_counter, write_counter},
    {3003, 3004, read_control, write_control},
    {3006, 3006, write_only, write_message},
    {3007, 3007, read_mirror, nullptr},
    {3011, 3012, read_date, write_date},
    {3901, 3902, read_count, write_count},
    {4001, 4021, read_group_ahead, nullptr},
    {4101, 4120, read_word_ahead, nullptr},
    {4201, 4221, read_group_now, nullptr},
    {4301, 4320, read_word_now, nullptr},
    {4401, 4421, read_group_interrupt, nullptr},
    {4501, 4520, read_word_interrupt, nullptr},
    {5001, 5020, read_end_point, nullptr},
    {5021, 5040, read_machine, nullptr},
    {5041, 5060, read_work_position, nullptr},
    {5061, 5080, read_skip, nullptr},
    {5081, 5100, read_compensation, nullptr},
    {5101, 5120, read_deviation, nullptr},
    {5201, 5340, read_work, write_work},
    {7001, 8920, read_work, write_work},
    {10001, 10999, read_tool, write_tool},
    {11001, 11999, read_tool, write_tool},
    {16001, 16999, read_tool, write_tool},
    {17001, 17999, read_tool, write_tool},
};

const Range* find_range(uint32_t number) {
  for (const Range& range : kRanges)
    if (number >= range.first && number <= range.last) return &range;
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
  const Range* range = find_range(number);
  if (range == nullptr) {
    in.raise(Condition::variable_number, '#', number);
    *fault = in.fault;
    return Eval::fault;
  }
  Access access{in, number, number - range->first, value, sync};
  const Eval eval = range->read(access);
  if (eval == Eval::fault) *fault = in.fault;
  return eval;
}

Did write_system_variable(Interpreter& in, uint32_t number, Value value, const Statement& statement) {
  const Range* range = find_range(number);
  if (range == nullptr) return in.raise(Condition::variable_number, '#', number);
  if (range->write == nullptr) return in.raise(Condition::variable_use, '#', number);
  Access access{in, number, number - range->first};
  access.written = value.or_zero();
  access.statement = &statement;
  return range->write(access);
}

}  // namespace nc
