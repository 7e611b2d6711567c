// SPDX-License-Identifier: Apache-2.0
#include "interpret/lifetimes.hpp"

#include <initializer_list>

namespace nc {
namespace {

/// M700 9.1, 7.2 note 1: a first movement of coordinate words goes on in the mode of the end. A program that was left before its end leaves
/// nothing, and while nothing has been read since the last beginning what that one has left still counts.
void note_end(LeftByEnd& left, const StateValues& before, bool motion_outlives_end) {
  const ModalState& modal = before.modal;
  if (before.end_seen && motion_outlives_end) {
    left = {modal.feed_digit == 0 ? modal.feed : 0, modal.of(Mode::motion), modal.of(Mode::feed), true};
  } else if (before.seq != 0) {
    left = {};
  }
}

/// Reset 2 (3.7), and what is in force in spite of it.
void set_initial_modes(State& state, const StateValues& before, const InitialValues& initial) {
  state.modal = initial.modal;
  for (unsigned i = 0; i < 2; ++i) state.plane_axis[i] = initial.plane_axis[i];
  if (initial.keeps_polar_command && before.modal.is(Function::polar_command_on)) state.modal.set(Function::polar_command_on);
  if (initial.keeps_clamp) state.spindle_clamped = before.spindle_clamped;
  const LeftByEnd& left = state.left_by_end;
  if (!left.any) return;
  state.modal.set(left.motion);
  if (state.modal.is(left.feed_mode)) state.modal.feed = left.feed;
}

/// What stands among the modes and ends with its text all the same: radius compensation, cycles and modal calls (docs/decisions.md, 5.1), and
/// tapping mode, which ends with its program (7.11).
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
  state.repeat = {};  // of the block that is interrupted
  state.interrupt_moved = false;
  state.parameter_input = false;  // G10 L70 of the program that is interrupted: the blocks to come are no parameters
}

void return_from_interrupt(State& state, const StateValues& before, bool inside_block) {
  const uint32_t m = state.modal.m, moves_since_comp_off = state.moves_since_comp_off;
  take<ModalLife, ModalInProgram>(state, before);
  if (inside_block) {
    take<MachinePosition, AppliedLength>(state, before);
  } else {
    for (unsigned i = 0; i < kMaxAxes; ++i)  // G07: the position of the program is beside that of the axis, as the mode is in force again
      if ((state.map.frozen >> i & 1) != 0) state.machine[i] = before.machine[i];
  }
  state.modal.m = m;  // 13.12 speaks of modals; the code that has been given out is none
  if (moves_since_comp_off != 0) state.moves_since_comp_off = 1;  // a move of the interrupt program is one, too (P112)
  if (state.interrupt_moved) state.spline_way = {};  // the curve begins again where the axes are
}

void go_on_behind_interrupt(State& state, const StateValues& before) { state.parameter_input = before.parameter_input; }

}  // namespace nc
