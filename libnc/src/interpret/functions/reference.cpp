// SPDX-License-Identifier: Apache-2.0
// G28 reference return, G53 machine coordinates.
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// DGSHAPE G28: an axis that is not named takes part with the midpoint that an earlier G28 of the program gave it.
void take_remembered_midpoints(Interpreter& in, AxisVec& mid, uint32_t& axes) {
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((axes >> i) & 1) != 0) {
      in.set_table(Frames::midpoint_set_key(i), 1);
    } else if (in.frames.get(Frames::midpoint_set_key(i)) != 0) {
      mid[i] = in.frames.get(Frames::midpoint_key(i));
      axes |= 1u << i;
    }
  }
}

}  // namespace

Did do_reference_return(Interpreter& in) {
  uint32_t axes = in.words.axes;
  AxisVec mid = target_of_words(in);
  if (in.dialect->id == NC_DIALECT_DGSHAPE) {
    if (in.state.comp.side != 0) return in.raise(Condition::not_in_compensation, 'G', 28);
    if ((axes & in.rotary) != 0) return in.raise(Condition::illegal_axis, 'A');
    take_remembered_midpoints(in, mid, axes);
  }
  if (axes == 0) return in.raise(Condition::words_missing, 'G', 28);
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) in.set_table(Frames::midpoint_key(i), mid[i]);
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  style.transparent = true;  // M700 12.4.2: no vector at the intermediate point
  move_linear(in, mid, axes, style);
  AxisVec reference = in.state.machine;
  for (unsigned i = 0; i < in.axis_count; ++i) reference[i] = in.system->axis[i].reference[0];
  move_machine(in, reference, axes);
  // M700 12.2, 14.7: tool length compensation of the axis is cancelled for good when the reference position is reached.
  if (in.dialect->id == NC_DIALECT_M700 && ((axes >> in.state.length_axis) & 1) != 0 && in.state.modal.code[kGroupLength] != 490) {
    in.state.length_value = 0;
    in.state.modal.code[kGroupLength] = 490;
  }
  return Did::done;
}

/// M700 14.5 note: `G92 G53 X0 Y0 Z0` takes the G92 shift of the named axes away, without motion.
Did clear_shift(Interpreter& in) {
  const BlockWords& w = in.words;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((w.axes >> i) & 1) == 0) continue;
    if (w.axis[i] != 0) return in.raise(Condition::value_range, in.system->axis[i].name, w.axis[i]);
    in.set_table(Frames::shift_key(i), 0);
  }
  return Did::done;
}

Did do_machine_move(Interpreter& in) {
  const BlockWords& w = in.words;
  for (const FunctionRow* row : w.g)
    if (row->function == Function::coordinate_set && in.dialect->id == NC_DIALECT_M700) return clear_shift(in);
  bool incremental = w.incremental != 0 || in.state.modal.code[kGroupDistance] == 910;
  if (in.dialect->id == NC_DIALECT_DGSHAPE && incremental) return in.raise(Condition::code_in_incremental, 'G', 53);
  if (w.incremental != 0) {  // M700 14.4: in G91 a plain incremental rapid
    LinearStyle style;
    style.kind = NC_MOVE_RAPID;
    style.transparent = true;
    move_linear(in, target_of_words(in), w.axes, style);
    return Did::done;
  }
  AxisVec machine = in.state.machine;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((w.axes >> i) & 1) != 0) machine[i] = w.axis[i];
  move_machine(in, machine, w.axes);
  return Did::done;
}

}  // namespace nc
