// SPDX-License-Identifier: Apache-2.0
// G05: high-speed machining I and II (M700 13.16) and high-speed high-accuracy control II with SSS (13.17); G05.1: high-speed high-accuracy control I and the
// spline (13.17, 13.18). This control looks ahead equally far in every mode. So the modes only decide what may be commanded (fine_mode.cpp), switch
// high-accuracy control on, and begin the spline; blocks are never merged.
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

bool in_mode_2(const State& state) { return state.fine_mode == FineMode::accuracy2 || state.fine_mode == FineMode::smooth; }

bool other_words(const Command& w, uint32_t allowed) { return w.functions.size() > 1 || !w.auxiliary.empty() || (w.present & ~allowed) != 0; }

/// The row for the value of a word; nullptr = the family has no such row.
template <class Row>
const Row* row_of(const Table<Row>& rows, double raw) {
  uint32_t value = 0;
  if (!whole_number(raw, &value)) return nullptr;
  for (const Row& row : rows)
    if (row.value == value) return &row;
  return nullptr;
}

Execution refuse(BlockInHand& in) { return in.raise_code(Condition::illegal_g, *in.words.one_shot); }

/// 6.11, 6.12: a mode is in force that excludes the modes of 13.17 and the spline.
bool excluded(const State& state) {
  return state.modal.is(Function::polar_command_on) || is_exponential(state.modal.of(Mode::motion));
}

/// 13.17.1 "relation with other functions" (1), 13.17.2: the modal state is not one in which this mode can start. Mode I can start in the cutting modes except
/// G61.1, with feed per revolution and with constant surface speed (the manual promises no effect then); only mode I needs G49.
bool wrong_state(const InForce& in, FineMode mode) {
  const State& state = in.state;
  const ModalState& modal = state.modal;
  if (state.comp.side != 0 || !modal.is(Function::comp_off) || state.any_mirror() != 0 || has_modal_call(in) ||
      !modal.is(Function::rotation_off) || state.cycle.kind != CycleKind::none || !modal.is(Function::cycle_off) || state.interrupt_on)
    return true;
  const bool per_minute = modal.is(Function::feed_per_minute);
  if (mode != FineMode::accuracy1) return !modal.is(Function::cutting_mode) || !per_minute || !modal.is(Function::surface_off);
  const bool cutting_known = modal.is(Function::exact_stop_mode) || modal.is(Function::corner_override) || modal.is(Function::tapping_mode) ||
                             modal.is(Function::cutting_mode);
  return !modal.is(Function::length_off) || !cutting_known || !(per_minute || modal.is(Function::feed_per_revolution));
}

Execution start(BlockInHand& in, FineMode mode) {
  State& state = in.state;
  if (!in.settings.high_speed_codes || excluded(state)) return refuse(in);
  if (!state.modal.is(Function::normal_line_off)) return in.raise_code(Condition::not_accepted, *in.words.one_shot);  // 13.14
  if (wrong_state(in, mode)) return refuse(in);
  state.fine_mode = mode;
  state.refresh_accuracy();
  return Execution::done;
}

/// Ends the mode. Precaution (5): radius compensation must have been cancelled inside the mode.
Execution leave(BlockInHand& in) {
  State& state = in.state;
  if (state.comp.side != 0 || !state.modal.is(Function::comp_off)) return refuse(in);
  state.fine_mode = FineMode::none;
  state.spline = SplineState{};
  state.refresh_special();
  state.refresh_accuracy();
  return Execution::done;
}

/// Lets the axes come to rest, because the machine slows down at such a block (13.16 restriction (4), 13.17.1 precaution (4)).
void slow_down(BlockContext& in) { in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION; }

Execution high_speed_machining(BlockContext& in, SpeedMode mode) {
  State& state = in.state;
  // 13.20: mode III is refused in a rotation; the manual mentions this mode only there and in the list of P.
  if (mode == SpeedMode::machining_3 && !state.modal.is(Function::rotation_off)) return refuse(in);
  if (mode == SpeedMode::machining_3) return in.raise(Condition::high_speed_3, Role::speed_mode, in.words.get(Role::speed_mode));  // App.1 P65
  if (in_mode_2(state)) return refuse(in);  // it is not in the list of 13.17
  if (is_exponential(state.modal.of(Mode::motion))) return refuse(in);  // 6.11
  if (state.high_speed != mode) slow_down(in);
  state.high_speed = mode;
  return Execution::done;
}

/// The basic axes named with G05.1 Q2; false when the block has other words.
bool spline_axes(const BlockInHand& in, uint8_t* axes) {
  uint32_t named = 0;
  *axes = 0;
  for (const WordSlot name : in.settings.plane_basic) {
    const int axis = in.axis_words.axis(name);
    if (axis < 0 || !in.words.has(name)) continue;
    named |= set_of(name);
    *axes = static_cast<uint8_t>(*axes | 1u << axis);
  }
  return !other_words(in.words, named | in.set_of({Role::speed_option}));
}

Execution spline_on(BlockContext& in) {
  State& state = in.state;
  if (!in_mode_2(state) || !in.settings.spline_allowed || !in.settings.high_speed_codes || excluded(state))
    return refuse(in);  // 13.18 (3), (4), precaution (2)
  uint8_t axes = 0;
  if (!spline_axes(in, &axes)) return in.raise_code(Condition::must_stand_alone, *in.words.one_shot);  // precaution (5)
  state.spline = SplineState{};
  state.spline_way = {};
  state.spline.on = true;
  state.spline.axes = axes;
  state.refresh_special();
  slow_down(in);
  return Execution::done;
}

}  // namespace

Execution do_high_speed(BlockContext& in) {
  State& state = in.state;
  const Command& w = in.words;
  if (!w.has(Role::speed_mode)) return in.raise(Condition::format_error, Role::speed_mode);
  if (w.written(Role::speed_mode).has_point()) return in.raise(Condition::format_error, Role::speed_mode, w.get(Role::speed_mode));
  const SpeedModeRow* const row = row_of(in.dialect->speed_modes, w.get(Role::speed_mode));
  if (row == nullptr) return in.raise(Condition::value_range, Role::speed_mode, w.get(Role::speed_mode));
  const SpeedMode mode = row->mode;
  // By 13.17.1 precaution (5) the alarm is P33, by 13.16 restriction (8) P35.
  const bool accuracy = mode == SpeedMode::accuracy_2 || (mode == SpeedMode::off && in_mode_2(state));
  if (other_words(w, in.set_of({Role::speed_mode}))) return in.raise_code(accuracy ? Condition::must_stand_alone : Condition::value_range, *w.one_shot);
  if (state.fine_mode == FineMode::accuracy1) return refuse(in);  // 13.17.1 precaution (11)
  if (mode == SpeedMode::accuracy_2 && in_mode_2(state)) return Execution::done;
  Execution did = Execution::done;
  if (mode == SpeedMode::off && in_mode_2(state)) did = leave(in);
  if (mode == SpeedMode::accuracy_2) did = start(in, in.settings.smooth_control ? FineMode::smooth : FineMode::accuracy2);
  if (mode != SpeedMode::off && mode != SpeedMode::accuracy_2) return high_speed_machining(in, mode);
  if (did != Execution::done) return did;
  if (state.high_speed != mode) slow_down(in);
  state.high_speed = mode;
  return Execution::done;
}

Execution do_high_speed_accuracy(BlockContext& in) {
  State& state = in.state;
  const Command& w = in.words;
  if (!w.has(Role::speed_option) || w.written(Role::speed_option).has_point()) return in.raise(Condition::format_error, Role::speed_option);
  const SpeedOptionRow* const row = row_of(in.dialect->speed_options, w.get(Role::speed_option));
  if (row == nullptr) return in.raise(Condition::value_range, Role::speed_option, w.get(Role::speed_option));
  if (row->option == SpeedOption::spline) return spline_on(in);
  if (other_words(w, in.set_of({Role::speed_option}))) return in.raise_code(Condition::must_stand_alone, *in.words.one_shot);
  if (row->option == SpeedOption::accuracy_1) {
    if (in_mode_2(state)) return refuse(in);  // 13.17.1 precaution (10)
    if (state.fine_mode == FineMode::accuracy1) return Execution::done;
    state.high_speed = SpeedMode::off;  // 13.16: cancels high-speed machining
    const Execution did = start(in, FineMode::accuracy1);
    if (did == Execution::done) slow_down(in);
    return did;
  }
  if (state.spline.on) {
    state.spline = SplineState{};
    state.refresh_special();
    slow_down(in);
    return Execution::done;
  }
  if (state.fine_mode != FineMode::accuracy1) return Execution::done;
  const Execution did = leave(in);
  if (did == Execution::done) slow_down(in);
  return did;
}

}  // namespace nc
