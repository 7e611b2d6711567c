// SPDX-License-Identifier: Apache-2.0
// G10: offsets by program (M700 12.7, 14.10 (6); DGSHAPE G10).
#include <cmath>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// Work offsets of one table row; `key(axis)`.
template <class Key>
Did write_axes(Interpreter& in, bool accumulate, Key key) {
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((in.words.axes >> i) & 1) == 0) continue;
    const bool add = accumulate && ((in.words.incremental >> i) & 1) != 0;
    const double offset = (add ? in.frames.get(key(i)) : 0.0) + in.words.axis[i];
    if (std::fabs(offset) >= kOffsetRange) return in.raise(Condition::value_range, in.system->axis[i].name, in.words.axis[i]);  // M700 14.10 (6)
    in.set_table(key(i), offset);
  }
  return Did::done;
}

Did work_offset(Interpreter& in, uint32_t l, bool accumulate) {
  const BlockWords& w = in.words;
  const bool extended_active = in.state.work_system >= 6;
  uint32_t p = 0;
  if (l == 20 && in.frames.extended_systems() == 0) return in.raise(Condition::g10_l, 'L', l);  // M700 14.10 (14)
  if (w.has('P')) {
    const uint32_t last = l == 20 ? in.frames.extended_systems() : 6;
    if (!whole_number(w.get('P'), &p) || p > last || (l == 20 && p == 0)) return in.raise(Condition::value_range, 'P', w.get('P'));
  } else if ((l == 20) != extended_active) {
    return in.raise(Condition::format_error, 'P');  // M700 14.10 (6): without P only for the kind that is selected
  }
  unsigned system = in.state.work_system;
  if (w.has('P')) system = l == 20 ? 5 + p : p - 1;
  if (w.has('P') && l == 2 && p == 0) return write_axes(in, accumulate, [](unsigned axis) { return Frames::external_key(axis); });
  return write_axes(in, accumulate, [system](unsigned axis) { return Frames::work_key(system, axis); });
}

Did tool_offset(Interpreter& in, unsigned column, bool accumulate) {
  const BlockWords& w = in.words;
  uint32_t number = 0;
  if (!w.has('P') || !w.has('R')) return in.raise(Condition::format_error, w.has('P') ? 'R' : 'P');
  if (!whole_number(w.get('P'), &number) || number == 0 || number > in.frames.tool_offsets())
    return in.raise(Condition::g10_p, 'P', w.get('P'));
  const unsigned key = in.frames.tool_key(number, column);
  const bool add = accumulate && in.state.modal.code[kGroupDistance] == 910;
  // M700 2.2 (4): the tenfold unit is not for the amounts of tool compensation.
  const double input = length_value(in, w.get('R'), w.flags['R' - 'A'], false, true, false);
  const double amount = (add ? in.frames.get(key) : 0.0) + input;
  // M700 12.1: the range of an offset.
  if (std::fabs(amount) >= kOffsetRange) return in.raise(Condition::value_range, 'R', w.get('R'));
  in.set_table(key, amount);
  return Did::done;
}

Did dgshape_data_input(Interpreter& in) {
  const BlockWords& w = in.words;
  if (in.state.comp.side != 0) return in.raise(Condition::not_in_compensation, 'G', 10);
  uint32_t l = 0;
  if (!w.has('L')) return tool_offset(in, NC_TOOL_LENGTH, false);  // G10 P R: tool-diameter offset n
  if (!whole_number(w.get('L'), &l) || l != 2) return in.raise(Condition::g10_l, 'L', w.get('L'));
  if (!w.has('P')) return in.raise(Condition::format_error, 'P');
  return work_offset(in, 2, false);  // absolute, G90/G91 make no difference
}

/// M700 12.7 (5): L2 or L20 "should not [be] issued in the same block as" L10. One of them would be lost.
bool two_kinds(const Interpreter& in) {
  unsigned kinds = 0;
  for (const Word& word : in.block->words) kinds += word.letter == 'L' ? 1u : 0u;
  return kinds > 1;
}

}  // namespace

/// M700 15.6: percent of the rated current, whatever decimals stand behind it.
Did set_current_limit(Interpreter& in) {
  const BlockWords& w = in.words;
  if (w.axes == 0) return in.raise(Condition::format_error, 'L', 14);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((w.axes >> i) & 1) == 0) continue;
    const char name = in.system->axis[i].name;
    if (name == 'C') return in.raise(Condition::illegal_address, name, w.get(name));  // (6): not from a program
    const double percent = std::trunc(w.get(name));
    if (!(percent >= 1 && percent <= 300)) return in.raise(Condition::value_range, name, w.get(name));
    Action& action = in.emit(ItemKind::action).action;
    action.kind = NC_ACTION_CURRENT_LIMIT;
    action.letter = name;
    action.index = i;
    action.value = percent;
  }
  return Did::done;
}

Did do_data_input(Interpreter& in) {
  const BlockWords& w = in.words;
  if (two_kinds(in)) return in.raise(Condition::g10_l, 'L', w.get('L'));
  if (in.dialect->id == NC_DIALECT_DGSHAPE) return dgshape_data_input(in);
  if (!w.has('L') && w.any(letters("IJK"))) return do_work_rotation(in);  // 13.21
  uint32_t l = 2;  // no L is judged as L2
  if (w.has('L') && !whole_number(w.get('L'), &l)) return in.raise(Condition::g10_l, 'L', w.get('L'));
  switch (l) {
    case 2:
    case 20:
      // A block for a control with other rules (no L: tool offset P of R) would change nothing without a word.
      if (w.axes == 0) return in.raise(Condition::format_error, w.has('R') ? 'R' : 'G', w.has('R') ? w.get('R') : 10);
      return work_offset(in, l, true);
    case 10: return tool_offset(in, NC_TOOL_LENGTH, true);
    case 11:
    case 12:
    case 13:
      // Length wear, radius, radius wear exist in tool memory type II only (M700 12.7).
      if (!in.settings.tool_memory_2) return in.raise(Condition::g10_l, 'L', l);
      return tool_offset(in, l - 10, true);
    case 3: return in.raise(Condition::no_function, 'L', l);  // tool life: not built
    case 14: return set_current_limit(in);
    case 50:
    case 70: return begin_parameter_input(in);
    default: return in.raise(Condition::g10_l, 'L', l);
  }
}

}  // namespace nc
