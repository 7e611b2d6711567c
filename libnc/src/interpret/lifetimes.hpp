// SPDX-License-Identifier: Apache-2.0
// What becomes of the groups of the state and of the records when a program begins, is interrupted, or goes on; interpret/state.hpp and
// interpret/program_records.hpp have the tables. Each event assigns whole groups; a value that is treated otherwise than its group is handled here and
// nowhere else.
#pragma once

#include "interpret/program_records.hpp"
#include "interpret/state.hpp"

namespace nc {

/// Copies whole groups from one state to another.
template <class... Group>
void take(StateValues& to, const StateValues& from) {
  ((static_cast<Group&>(to) = static_cast<const Group&>(from)), ...);
}

/// What a program begins with, by the family and the parameters.
struct InitialValues {
  ModalState modal;                     ///< M700 3.7, 5.1 (4), 7.4 note 6, 7.5 (3), 13.15 (4)
  int8_t plane_axis[2] = {0, 1};        ///< axes of the plane in `modal`
  int8_t third_axis = 2;                ///< the basic axis that is not one of them
  bool motion_outlives_end = false;     ///< M700 9.1: the motion mode (group 01) at the end of a program stays for the next start
  bool keeps_polar_command = false;     ///< M700 6.12 (3): G16 stays in force
  bool keeps_clamp = false;             ///< M700 10.4 (3): the clamp of spindle speeds stays in force
};

/// Sets the state for a program, or an MDI text, that is read from its beginning: after power on, a selection, an end, a reset. `mdi`: it is an MDI text
/// after another one, whose modes stay in force (M700 5.1). The call stack becomes empty; the group Derived has to be made by the caller.
void begin_program(State& state, const InitialValues& initial, bool mdi);
/// Sets the records in the same way. `forgets_midpoints`: in this family the points of G28 end with the program.
void begin_program(ProgramRecords& records, bool mdi, bool forgets_midpoints);
/// Ends what a reset by the operator ends and the end of a program does not. To be called before begin_program().
void end_by_operator(State& state);

/// The interrupt program runs next, with the machine where it stands (M700 13.12).
void begin_interrupt_program(State& state, const AxisVec& machine);
/// M99 of an interrupt program restores the modes. `before`: the state before begin_interrupt_program(). `inside_block`: the interrupted block is read again
/// from its beginning. The group Derived has to be made by the caller.
void return_from_interrupt(State& state, const StateValues& before, bool inside_block);
/// The return from an interrupt program that restores no modes: M99 P, and M99 where the rest of the interrupted block is not executed.
void go_on_behind_interrupt(State& state, const StateValues& before);

/// The tools and the spindle as the blocks know them that have been read.
InHand in_hand(const StateValues& state);
void take_in_hand(State& state, const InHand& hand);

}  // namespace nc
