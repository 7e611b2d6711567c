// SPDX-License-Identifier: Apache-2.0
#include "interpret/lifetimes.hpp"

#include <initializer_list>

namespace nc {
namespace {

/// M700 9.1, 7.2 note 1: a first movement that has only coordinate words is made in the mode at the end of the last program. A program that was left before
/// its end leaves no mode. When a program begins again before anything of it was read, what was left before still counts.
void note_end(LeftByEnd& left, const StateValues& before, bool motion_outlives_end) {
  const ModalState& modal = before.modal;
  if (before.end_seen && motion_outlives_end) {
    left = {modal.feed_digit == 0 ? modal.feed : 0, modal.of(Mode::motion), modal.of(Mode::feed), true};
  } else if (before.seq != 0) {
    left = {};
  }
}

/// Sets the modes of reset 2 (3.7), and those that stay in force in spite of it.
void set_initial_modes(State& state, const StateValues& before, const InitialValues& initial) {
  state.modal = initial.modal;
  for (unsigned i = 0; i < 2; ++i) state.plane_axis[i] = initial.plane_axis[i];
  state.third_axis = initial.third_axis;
  if (initial.keeps_polar_command && before.modal.is(Function::polar_command_on)) state.modal.set(Function::polar_command_on);
  if (initial.keeps_clamp) state.spindle_clamp = before.spindle_clamp;
  const LeftByEnd& left = state.left_by_end;
  if (!left.any) return;
  state.modal.set(left.motion);
  if (state.modal.is(left.feed_mode)) state.modal.feed = left.feed;
}

/// Ends the modes that end with their MDI text: radius compensation, cycles and modal calls (docs/decisions.md, 5.1), and tapping mode, which ends with
/// its program (7.11).
void end_modes_of_text(ModalState& modal, const ModalState& initial) {
  for (const Mode mode : {Mode::radius, Mode::cycle, Mode::macro}) modal.set(initial.of(mode));
  if (modal.is(Function::tapping_mode)) modal.set(initial.of(Mode::cutting));
}

}  // namespace

void begin_program(State& state, const InitialValues& initial, bool mdi) {
  const StateValues before = state;
  state = State{};
  take<MachinePosition, UntilOperatorReset, UntilPowerOff>(state, before);
  note_end(state.left_by_end, before, initial.motion_outlives_end);
  if (mdi) {
    take<ModalLife, AppliedLength, UntilReset>(state, before);
    end_modes_of_text(state.modal, initial.modal);
  } else {
    set_initial_modes(state, before, initial);
  }
  state.executed = state.modal;
}

void begin_program(ProgramRecords& records, bool mdi, bool forgets_midpoints) {
  static_cast<ProgramRecordsLife&>(records) = ProgramRecordsLife{};
  if (!mdi) static_cast<MapRecordsLife&>(records) = MapRecordsLife{};
  if (forgets_midpoints) records.midpoints = ReferenceMidpoints{};
}

void end_by_operator(State& state) {
  state.end_seen = false;
  static_cast<UntilOperatorReset&>(state) = UntilOperatorReset{};
}

void begin_interrupt_program(State& state, const AxisVec& machine) {
  state.machine = machine;
  state.repeat = {};  // it concerned the block that is interrupted
  state.interrupt_moved = false;
  state.parameter_input = false;  // a G10 L70 of the interrupted program does not make the blocks to come parameters
  state.life_input = {};
}

void return_from_interrupt(State& state, const StateValues& before, bool inside_block) {
  const uint32_t m = state.modal.m, moves_since_comp_off = state.moves_since_comp_off;
  take<ModalLife, ModalInProgram>(state, before);
  if (inside_block) {
    take<MachinePosition, AppliedLength>(state, before);
  } else {
    for (unsigned i = 0; i < kMaxAxes; ++i)  // an axis that G07 holds is again at the position of the program, beside where the axis stands
      if ((state.map.frozen >> i & 1) != 0) state.machine[i] = before.machine[i];
  }
  state.modal.m = m;  // 13.12 restores modal information; the last M code that was given out is not modal
  if (moves_since_comp_off != 0) state.moves_since_comp_off = 1;  // a move of the interrupt program counts, too (P112)
  if (state.interrupt_moved) {
    state.spline_way = {};  // the curve begins again where the axes are
    state.by_hand = false;  // and so does what counts from the end of the block before
  }
}

void go_on_behind_interrupt(State& state, const StateValues& before) {
  state.parameter_input = before.parameter_input;
  state.life_input = before.life_input;
}

InHand in_hand(const StateValues& state) {
  return {state.modal.tool, state.selected_tool, state.spindle_tool, state.spindle_on, state.spindle_reverse};
}

void take_in_hand(State& state, const InHand& hand) {
  state.modal.tool = hand.called;
  state.selected_tool = hand.selected;
  state.spindle_tool = hand.in_spindle;
  state.spindle_on = hand.spindle_on;
  state.spindle_reverse = hand.spindle_reverse;
}

}  // namespace nc
