// SPDX-License-Identifier: Apache-2.0
// What becomes of the groups of the state and of the records (interpret/state.hpp, interpret/program_records.hpp, where the tables are) when a program begins, is interrupted, or goes on.
// Each event assigns whole groups; a value that goes another way than its group stands here and nowhere else.
#pragma once

#include "interpret/program_records.hpp"
#include "interpret/state.hpp"

namespace nc {

/// Copies whole groups from one state to another.
template <class... Group>
void take(StateValues& to, const StateValues& from) {
  ((static_cast<Group&>(to) = static_cast<const Group&>(from)), ...);
}

/// What a program begins with, by its family and the parameters.
struct InitialValues {
  ModalState modal;                     ///< M700 3.7, 5.1 (4), 7.4 note 6, 7.5 (3), 13.15 (4)
  int8_t plane_axis[2] = {0, 1};        ///< of the plane in `modal`
  bool motion_outlives_end = false;     ///< M700 9.1: the end of a program leaves its group 01 to the start after it
  bool keeps_polar_command = false;     ///< M700 6.12 (3)
  bool keeps_clamp = false;             ///< M700 10.4 (3)
};

/// A program, or a text of MDI, is going to be read from its head: after power on, a selection, an end, a reset. With `mdi` it is a text of MDI
/// behind another one, whose modes it goes on with (M700 5.1). The call stack is empty, what is derived is still to be made.
void begin_program(State& state, const InitialValues& initial, bool mdi);
/// The same of the records. `forgets_midpoints`: the family's programs do not know the points of G28 of the program before.
void begin_program(ProgramRecords& records, bool mdi, bool forgets_midpoints);
/// What a reset by the operator ends and the end of a program does not. Before begin_program().
void end_by_operator(State& state);

/// The interrupt program runs next, with the machine where it stands (M700 13.12).
void begin_interrupt_program(State& state, const AxisVec& machine);
/// M99 of an interrupt program gives the modes back. `before`: what begin_interrupt_program() found. `inside_block`: the interrupted block is read
/// again from its head. What is derived is still to be made.
void return_from_interrupt(State& state, const StateValues& before, bool inside_block);
/// The same where nothing is given back: M99 P, and M99 where the block that was interrupted is lost.
void go_on_behind_interrupt(State& state, const StateValues& before);

}  // namespace nc
