// SPDX-License-Identifier: Apache-2.0
// High-accuracy control (M700 13.15): G61.1, a cutting mode, and G08, a function of its own that excludes the other cutting modes. How the mode limits the
// motion is a rule of the family (MotionRules).
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// 13.15 "relation with other functions" (1): the state is not one in which G08 P1 is possible. The manual names no alarm for it; it is P34, as for the modes
/// of 13.17.
bool refuses_command(const InForce& in) {
  const State& state = in.state;
  const ModalState& modal = state.modal;
  return state.high_speed != SpeedMode::off || state.fine_mode != FineMode::none || state.accuracy_command || !modal.is(Function::polar_command_off) ||
         state.comp.side != 0 || !modal.is(Function::comp_off) || !modal.is(Function::length_off) || state.any_mirror() != 0 ||
         has_modal_call(in) || !modal.is(Function::feed_per_minute) || !modal.is(Function::surface_off) || state.interrupt_on;
}

/// (2), and 13.20: raises an alarm in modes in which high-accuracy control cannot be commanded.
Execution check_modes_before(BlockInHand& in, const FunctionRow& row) {
  if (in.state.map.kind != AxisMap::Kind::none) return in.raise_code(Condition::mill_code, row);
  if (!in.state.modal.is(Function::normal_line_off)) return in.raise_code(Condition::not_accepted, row);
  if (!in.state.modal.is(Function::rotation_off)) return in.raise_code(Condition::illegal_g, row);
  return Execution::done;
}

}  // namespace

Execution check_cutting_code(BlockInHand& in, const FunctionRow& row) {
  // After G08 P1 the cutting mode is G64; any other code of the cutting mode is an error.
  if (in.state.accuracy_command && row.function != Function::cutting_mode) return in.raise_code(Condition::in_high_accuracy, row);
  if (row.function != Function::high_accuracy_mode) return Execution::done;
  if (!in.settings.high_accuracy_code) return in.raise_code(Condition::illegal_g, row);  // precaution (3)
  return check_modes_before(in, row);
}

Execution do_high_accuracy(BlockContext& in) {
  State& state = in.state;
  const Command& w = in.words;
  if (w.functions.size() > 1 || !w.auxiliary.empty() || (w.present & ~in.set_of({Role::accuracy_switch})) != 0) return in.raise_code(Condition::must_stand_alone, *w.one_shot);
  if (!w.has(Role::accuracy_switch)) return in.raise(Condition::format_error, Role::accuracy_switch);
  uint32_t p = 0;
  if (!whole_number(w.get(Role::accuracy_switch), &p) || p > 1) return in.raise(Condition::value_range, Role::accuracy_switch, w.get(Role::accuracy_switch));
  if (p == 1) {
    const Execution did = check_modes_before(in, *w.one_shot);
    if (did != Execution::done) return did;
    if (refuses_command(in)) return in.raise_code(Condition::illegal_g, *w.one_shot);
    const Function before = state.modal.of(Mode::cutting);
    in.state.modal.set(Function::cutting_mode);  // G08 P0 will not restore the previous mode
    if (before != Function::cutting_mode) change_cutting_mode(in, before);
  }
  state.accuracy_command = p == 1;
  state.refresh_accuracy();
  return Execution::done;
}

}  // namespace nc
