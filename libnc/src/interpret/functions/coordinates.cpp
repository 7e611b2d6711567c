// SPDX-License-Identifier: Apache-2.0
// Work coordinate systems G54-G59, G54.1; local system G52; coordinate system setting G92, preset G92.1.
#include <algorithm>

#include "interpret/by_hand.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {

/// A one-shot function, and a call, have words of their own: which code they belong to is not for this one to say.
void take_word_of_code(BlockInHand& in, Role word) {
  if (in.words.one_shot == nullptr && !has_words_of_call(in)) in.words.present &= ~in.set_of({word});
}

/// The block ends radius compensation, which acts in front of what else it says.
static bool ends_compensation_first(const BlockInHand& in) {
  const auto ends = [](const FunctionRow* row) { return row->function == Function::comp_off; };
  return in.dialect->rules.compensation.end_is_at_once && std::any_of(in.words.functions.begin(), in.words.functions.end(), ends);
}

Execution select_work_system(BlockInHand& in, const FunctionRow& row) {
  State& state = in.state;
  const bool barred = in.dialect->rules.compensation.bars_systems_and_data && state.comp.side != 0;
  if (barred && !ends_compensation_first(in)) return in.raise_code(Condition::not_in_compensation, row);
  const AxisVec zero_before = in.zero();
  if (row.function == Function::work_system) {
    const unsigned standard = Frames::kStandardSystems;
    if (row.number >= standard + in.frames.extended_systems()) return in.raise_code(Condition::no_function, row);
    state.work_system = row.number;
    state.modal.extended = row.number < standard ? uint16_t{0} : static_cast<uint16_t>(row.number - standard + 1);  // the family has codes for extended systems
  } else {
    uint32_t p = 0;
    if (!in.words.has(Role::system_number)) return in.raise(Condition::format_error, Role::system_number);
    if (!whole_number(in.words.get(Role::system_number), &p) || p == 0) return in.raise(Condition::value_range, Role::system_number, in.words.get(Role::system_number));
    // M700 14.10 (13): the option does not include this system.
    if (p > in.frames.extended_systems()) return in.raise(Condition::no_function, Role::system_number, p);
    state.work_system = static_cast<uint16_t>(5 + p);
    state.modal.extended = static_cast<uint16_t>(p);
    take_word_of_code(in, Role::system_number);
  }
  state.modal.set(row);
  keep_rotation_center(in, zero_before);
  return Execution::done;
}

Execution do_local_system(BlockContext& in) {
  if (in.state.work_system >= 6) return in.raise_code(Condition::local_in_extended, *in.words.one_shot);
  const Command& w = in.words;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    // M700 14.11: G90 replaces (measured from the workpiece zero), G91 adds to the present local zero.
    const unsigned key = Frames::local_key(in.state.work_system, i);
    in.set_table(key, (w.target.counts_on(i) ? in.frames.get(key) : 0.0) + w.target[i]);
  }
  return Execution::done;
}

/// Series 8 G92 while the plane is rotated or scaled about the zero point: the programmed position becomes that of the words, and the zero point goes
/// where the map then leads from it to the machine.
static void set_zero_under_map(BlockInHand& in) {
  const Command& w = in.words;
  const AxisVec work = in.position();
  AxisVec programmed = to_program(in, work);
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (w.target.commands(i)) programmed[i] = w.target[i];
  const AxisVec behind = from_program(in, programmed);
  const uint32_t axes = moved_axes(in, w.target.axes());
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) in.set_table(Frames::shift_key(i), in.frames.get(Frames::shift_key(i)) + work[i] - behind[i]);
  in.state.map_begins = false;
}

/// M700 14.5, 14.12: the coordinates are set "without moving the machine", so the words that are read next lead to where the axis stands also where a switch mirrors it: its mirror image has
/// its centre there from now on.
static void mirror_from_here(BlockInHand& in, uint32_t axes, const AxisVec& here) {
  if ((in.state.switch_mirror & axes) == 0) return;
  SwitchMirror mirror = in.records->switch_mirror;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((in.state.switch_mirror & axes) >> i & 1) != 0) mirror.center[i] = here[i] - in.state.applied[i] / 2;  // the length is no part of what is mirrored, and stays
  in.change(&ProgramRecords::switch_mirror, mirror);
}

/// By how much the axes stand beside the program by a vector in space (12.3, 12.5).
static AxisVec vector_in_place(const InForce& in) {
  const SpaceVector& vector = in.state.moved_space;
  AxisVec beside;
  for (unsigned i = 0; vector.on && i < 3; ++i) beside[vector.axis[i]] = vector.v[i];
  return beside;
}

/// M700 13.21 (2): where a place of the machine lies in the hypothetical machine coordinates that have turned with the workpiece systems, in which their zero points are counted.
static AxisVec in_turned_machine(const InForce& in, const AxisVec& machine) {
  if (!in.state.work_turned) return machine;
  const AxisVec zero = in.zero();
  AxisVec at;
  for (unsigned i = 0; i < in.axis_count; ++i) at[i] = machine[i] - zero[i];
  at = work_rotation(in, in.records->work_turn.reached).apply_inverse(at);
  for (unsigned i = 0; i < in.axis_count; ++i) at[i] += zero[i];
  return at;
}

Execution do_coordinate_set(BlockContext& in) {
  const Command& w = in.words;
  if (in.dialect->rules.compensation.bars_systems_and_data && in.state.comp.side != 0) return in.raise_code(Condition::not_in_compensation, *w.one_shot);
  if (in.dialect->rules.coordinate.setting_needs_axes && w.target.axes() == 0) return in.raise_code(Condition::words_missing, *w.one_shot);
  if (w.any({Role::clamp_highest, Role::clamp_lowest}) && in.dialect->rules.spindle.limits_by_coordinate_setting) {
    const Execution did = set_spindle_clamp(in);
    if (did != Execution::done) return did;
  }
  if (w.has(Role::surface_radius) && in.dialect->rules.spindle.radius_by_coordinate_setting) {
    const Execution did = set_surface_radius(in);
    if (did != Execution::done) return did;
  }
  const AxisVec zero_before = in.zero();
  if (in.dialect->rules.rotation.about_zero && program_mapped(in)) {
    set_zero_under_map(in);
    return Execution::done;
  }
  const AxisVec beside = vector_in_place(in);
  AxisVec here = in.state.machine;
  for (unsigned i = 0; i < in.axis_count; ++i) here[i] += beside[i];
  const AxisVec counted = in_turned_machine(in, here);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    // M700 14.5, 14.10 (3): the reading of the axis, including compensation, becomes the value; the shift is the same for all systems. RS-274/NGC 3.5.18: a
    // tool length that shifts the reading belongs to it.
    const double length = in.dialect->rules.length.shifts_reading ? in.state.applied[i] : 0;
    const double shift = in.frames.get(Frames::shift_key(i)) + counted[i] - length - in.frames.zero(in.state.work_system, i) - w.target[i];
    in.set_table(Frames::shift_key(i), shift);
  }
  mirror_from_here(in, w.target.axes(), here);
  keep_rotation_center(in, zero_before);
  forget_way_by_hand(in, w.target.axes());  // the value is of the place where the axis stands
  return Execution::done;
}

namespace {

Execution shift_to(BlockInHand& in, const AxisVec& shift) {
  if (in.dialect->rules.compensation.bars_systems_and_data && in.state.comp.side != 0) return in.raise_code(Condition::not_in_compensation, *in.words.one_shot);
  if (in.words.target.axes() != 0) return in.raise_code(Condition::must_stand_alone, *in.words.one_shot);  // they would be lost
  const AxisVec zero_before = in.zero();
  for (unsigned i = 0; i < in.axis_count; ++i) in.set_table(Frames::shift_key(i), shift[i]);
  keep_rotation_center(in, zero_before);
  return Execution::done;
}

}  // namespace

/// RS-274/NGC 3.5.18: takes away the shift of all axes.
Execution do_shift_off(BlockContext& in) {
  const Execution did = shift_to(in, AxisVec{});
  if (did == Execution::done) in.change(&ProgramRecords::shift_kept, ShiftKept{});
  return did;
}

/// RS-274/NGC 3.5.18: G92.2 takes the shift away as well, and G92.3 brings back what was there.
Execution do_shift_suspend(BlockContext& in) {
  ShiftKept kept;
  for (unsigned i = 0; i < in.axis_count; ++i) kept.at[i] = in.frames.get(Frames::shift_key(i));
  if (kept.at == AxisVec{}) kept = in.records->shift_kept;  // a second one has nothing to keep
  const Execution did = shift_to(in, AxisVec{});
  if (did == Execution::done) in.change(&ProgramRecords::shift_kept, kept);
  return did;
}

Execution do_shift_restore(BlockContext& in) {
  const AxisVec at = in.records->shift_kept.at;
  return at == AxisVec{} && in.words.target.axes() == 0 ? Execution::done : shift_to(in, at);
}

/// The axes of radius compensation that stand beside the program when one of them is preset, 0 = none.
static uint32_t axes_beside(const BlockInHand& in) {
  const Compensation& comp = in.state.comp;
  const uint32_t plane = in.in_contour() ? 1u << comp.axis[0] | 1u << comp.axis[1] : 0;
  return (plane & in.words.target.axes()) != 0 ? plane : 0;
}

/// M700 14.12, precaution (1): the coordinates become those of the machine less the offset, "thus the compensation vector will be temporarily canceled": the axes stay where the block before
/// has brought them, at right angles to it, and the next block leads to the contour as a first one does.
static void leave_vector_out(BlockContext& in, uint32_t axes) {
  AxisVec here = in.state.machine;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) here[i] = in.world.machine.v[i];
  leave_for_machine(in, here, axes);
}

Execution do_coordinate_preset(BlockContext& in) {
  const Command& w = in.words;
  if (!in.settings.preset_allowed) return in.raise_code(Condition::illegal_g, *w.one_shot);  // M700 14.12: the code exists in list 1 only, chosen by #1267 bit 0
  // 14.12: it is not allowed during scaling, coordinate rotation, or mirror image by program.
  if (in.state.modal.is(Function::scaling_on) || in.state.rotated || in.state.mirror != 0) return in.raise_code(Condition::illegal_g, *w.one_shot);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    if (w.target[i] != 0) return in.raise(Condition::value_range, in.axis_words.word(i), w.target[i]);
  }
  const uint32_t beside = axes_beside(in);
  if (beside != 0 && !in.world_fresh) return in.need(NC_SYNC_POSITION | BlockInHand::kSyncAhead);
  if (beside != 0) leave_vector_out(in, beside);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    in.set_table(Frames::shift_key(i), 0);
    if (in.state.work_system < 6) in.set_table(Frames::local_key(in.state.work_system, i), 0);
    in.state.applied[i] = 0;  // precaution (1): the reading becomes the machine value minus the offset; the length acts again with the next command
  }
  mirror_from_here(in, w.target.axes(), in.state.machine);
  return Execution::done;
}

}  // namespace nc
