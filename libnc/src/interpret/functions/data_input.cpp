// SPDX-License-Identifier: Apache-2.0
// G10: offsets by program (M700 12.7, 14.10 (6); DGSHAPE G10).
#include <cmath>

#include "base/units.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// Writes the work offsets of one coordinate system; key(axis) gives the key of each.
template <class Key>
Execution write_axes(BlockInHand& in, Key key) {
  const bool accumulate = in.dialect->rules.data_input.incremental_adds;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!in.words.target.commands(i)) continue;
    const bool add = accumulate && in.words.target.counts_on(i);
    const double offset = (add ? in.frames.get(key(i)) : 0.0) + in.words.target[i];
    if (std::fabs(offset) >= end_of_work_offset(in, i)) return in.raise(Condition::value_range, in.axis_words.word(i), in.words.target[i]);
    in.set_table(key(i), offset);
  }
  return Execution::done;
}

/// Number of coordinate systems that have a code of their own.
uint32_t work_systems(const Dialect& dialect) {
  uint32_t count = 0;
  for (const FunctionRow& row : dialect.functions) count += row.function == Function::work_system ? 1u : 0u;
  return count;
}

/// LinuxCNC G10 L20: sets the offset with which the axis, where it stands, reads the commanded value.
Execution work_offset_here(BlockInHand& in) {
  const Command& w = in.words;
  uint32_t p = 0;
  const bool given = w.has(Role::input_number);
  if (!given || !whole_number(w.get(Role::input_number), &p) || p > work_systems(*in.dialect) || p > Frames::kStandardSystems + in.frames.extended_systems())
    return given ? in.raise(Condition::value_range, Role::input_number, w.get(Role::input_number)) : in.raise(Condition::words_missing, Role::input_number);
  const unsigned system = p == 0 ? in.state.work_system : p - 1;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    const unsigned key = Frames::work_key(system, i);
    const double reads = in.state.machine[i] - in.state.applied[i] - in.frames.zero(system, i);
    const double offset = in.frames.get(key) + reads - w.target[i];
    if (std::fabs(offset) >= end_of_work_offset(in, i)) return in.raise(Condition::value_range, in.axis_words.word(i), w.target[i]);
    in.set_table(key, offset);
  }
  return Execution::done;
}

/// Writes a work offset. `l`: the number of L, for alarms.
Execution work_offset(BlockInHand& in, bool extended, uint32_t l) {
  const Command& w = in.words;
  const DataInputRules& rules = in.dialect->rules.data_input;
  if (w.target.axes() == 0 && rules.axes_required)
    return w.has(Role::input_amount) ? in.raise(Condition::format_error, Role::input_amount, w.get(Role::input_amount)) : in.raise_code(Condition::format_error, *w.one_shot);
  if (extended && in.frames.extended_systems() == 0) return in.raise(Condition::data_input_kind, Role::input_kind, l);  // M700 14.10 (14)
  const bool extended_active = in.state.work_system >= 6;
  uint32_t p = 0;
  if (w.has(Role::input_number)) {
    const uint32_t extended_systems = in.frames.extended_systems(), named = work_systems(*in.dialect);
    const uint32_t last = extended || named > Frames::kStandardSystems + extended_systems ? extended_systems : named;
    if (!whole_number(w.get(Role::input_number), &p) || p > last || (extended && p == 0)) return in.raise(Condition::value_range, Role::input_number, w.get(Role::input_number));
  } else if (rules.system_required || extended != extended_active) {
    return in.raise(Condition::words_missing, Role::input_number);  // M700 14.10 (6): without P only for the kind that is selected
  }
  unsigned system = in.state.work_system;
  const bool selected = p == 0 && rules.zero_is_selected_system;
  if (w.has(Role::input_number) && !selected) system = extended ? 5 + p : p - 1;
  if (w.has(Role::input_number) && !extended && p == 0 && !selected) return write_axes(in, [](unsigned axis) { return Frames::external_key(axis); });
  return write_axes(in, [system](unsigned axis) { return Frames::work_key(system, axis); });
}

}  // namespace

double end_of_offset(const InForce& in, unsigned column) {
  const RangeRules& range = in.dialect->rules.range;
  const bool radius = column == NC_TOOL_RADIUS || column == NC_TOOL_RADIUS_WEAR;
  if (in.state.modal.is(Function::inch) || in.settings.initial_inch) return (radius ? range.end_of_radius_inch : range.end_of_offset_inch) * kMillimetresPerInch;
  return radius ? range.end_of_radius_mm : range.end_of_offset_mm;
}

double end_of_work_offset(const InForce& in, unsigned axis) {
  const bool angle = ((in.rotary >> axis) & 1) != 0;
  return angle ? in.dialect->rules.range.end_of_offset_mm : end_of_offset(in, NC_TOOL_LENGTH);
}

namespace {

Execution tool_offset(BlockInHand& in, unsigned column) {
  const Command& w = in.words;
  uint32_t number = 0;
  if (!w.has(Role::input_number) || !w.has(Role::input_amount)) return in.raise(Condition::words_missing, w.has(Role::input_number) ? Role::input_amount : Role::input_number);
  if (!whole_number(w.get(Role::input_number), &number) || number == 0 || number > in.tool_offsets())
    return in.raise(Condition::data_input_number, Role::input_number, w.get(Role::input_number));
  const unsigned key = in.frames.tool_key(number, column);
  const bool add = in.dialect->rules.data_input.incremental_adds && in.state.modal.is(Function::incremental);
  // M700 2.2 (4): the tenfold unit does not act on the amounts of tool compensation.
  const double input = length_value(in, w.written(Role::input_amount), false, true, false);
  const double amount = (add ? in.frames.get(key) : 0.0) + input;
  // M700 12.1, HX 13.3: the range of an offset.
  if (std::fabs(amount) >= end_of_offset(in, column)) return in.raise(Condition::value_range, Role::input_amount, w.get(Role::input_amount));
  in.set_table(key, amount);
  return Execution::done;
}

/// The row for an L (kWithoutL: there is no L); nullptr = the family has no such row.
const DataInputRow* row_of(const Dialect& dialect, uint32_t l) {
  for (const DataInputRow& row : dialect.data_input)
    if (row.l == l) return &row;
  return nullptr;
}

unsigned column_of(DataInput input) {
  switch (input) {
    case DataInput::tool_length_wear: return NC_TOOL_LENGTH_WEAR;
    case DataInput::tool_radius: return NC_TOOL_RADIUS;
    case DataInput::tool_radius_wear: return NC_TOOL_RADIUS_WEAR;
    default: return NC_TOOL_LENGTH;
  }
}

/// M700 12.7 (5): L2 or L20 "should not [be] issued in the same block as" L10, because one of them would be ignored.
bool two_kinds(const BlockInHand& in) {
  return count_of(*in.block, in.word(Role::input_kind)) > 1;
}

}  // namespace

/// M700 15.6: the limit is in percent of the rated current; decimals are ignored.
Execution set_current_limit(BlockContext& in) {
  const Command& w = in.words;
  if (w.target.axes() == 0) return in.raise(Condition::format_error, Role::input_kind, w.get(Role::input_kind));
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    const WordSlot name = in.axis_words.word(i);
    if (name == in.word(Role::second_function_3)) return in.raise(Condition::illegal_address, name, w.get(name));  // (6): a program cannot set the limit of this axis
    const double percent = std::trunc(w.get(name));
    if (!(percent >= 1 && percent <= in.dialect->rules.range.most_current_percent)) return in.raise(Condition::value_range, name, w.get(name));
    Action& action = in.emit(ItemKind::action).action;
    action.kind = NC_ACTION_CURRENT_LIMIT;
    name_word(action, name);
    action.index = i;
    action.value = percent;
  }
  return Execution::done;
}

Execution do_data_input(BlockContext& in) {
  const Command& w = in.words;
  if (two_kinds(in)) return in.raise(Condition::data_input_kind, Role::input_kind, w.get(Role::input_kind));
  const Rules& rules = in.dialect->rules;
  if (in.state.comp.side != 0 && rules.compensation.bars_systems_and_data) return in.raise_code(Condition::not_in_compensation, *w.one_shot);
  if (!w.has(Role::input_kind) && w.any({Role::vector_x, Role::vector_y, Role::vector_z}) && rules.data_input.vector_turns_work) return do_work_rotation(in);
  uint32_t l = DataInputRow::kWithoutL;
  if (w.has(Role::input_kind) && !whole_number(w.get(Role::input_kind), &l)) return in.raise(Condition::data_input_kind, Role::input_kind, w.get(Role::input_kind));
  const DataInputRow* const row = row_of(*in.dialect, l);
  if (row == nullptr && l == DataInputRow::kWithoutL) return in.raise(Condition::data_input_kind);
  if (row == nullptr) return in.raise(Condition::data_input_kind, Role::input_kind, l);
  const bool of_system = row->input == DataInput::work_offset || row->input == DataInput::work_offset_here;
  if (of_system && rules.data_input.amount_turns_system && w.has(Role::input_amount) && w.get(Role::input_amount) != 0)
    return in.raise(Condition::no_function, Role::input_amount, w.get(Role::input_amount));
  if (rules.block.unused_words_are_faults && row->input != DataInput::missing) {  // the offset of a tool has no axes, a coordinate system no amount
    const WordSet lost = of_system ? in.set_of({Role::input_amount}) : in.axis_words.all();
    if (w.any(lost) && !(of_system && rules.data_input.amount_turns_system)) return in.raise_first(Condition::illegal_address, w.present & lost);
  }
  switch (row->input) {
    case DataInput::missing: return in.raise(Condition::no_function, Role::input_kind, l);
    case DataInput::work_offset: return work_offset(in, false, l);
    case DataInput::work_offset_here: return work_offset_here(in);
    case DataInput::extended_offset: return work_offset(in, true, l);
    case DataInput::tool_length: return tool_offset(in, NC_TOOL_LENGTH);
    case DataInput::tool_length_wear:
    case DataInput::tool_radius:
    case DataInput::tool_radius_wear:
      // Length wear, radius and radius wear exist only in tool memory type II (M700 12.7).
      if (!in.settings.tool_memory_2) return in.raise(Condition::data_input_kind, Role::input_kind, l);
      return tool_offset(in, column_of(row->input));
    case DataInput::current_limit: return set_current_limit(in);
    case DataInput::parameters: return begin_parameter_input(in);
    case DataInput::tool_life: return begin_tool_life_input(in);
  }
  return Execution::done;
}

}  // namespace nc
