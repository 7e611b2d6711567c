// SPDX-License-Identifier: Apache-2.0
// What programs leave in force of the coordinate systems, over their end and over a reset (M700 9.1), and what no table of offsets shows: the shift of G92, the
// local systems of G52, the shift that LinuxCNC G92.2 keeps for G92.3, and G16 where a parameter keeps it (M700 6.12 (3)). A program that is begun inside
// (nc/restart.h) has to be read with what its run was begun with; with what that run has left each of them would count twice.
#include "interpret/interpreter.hpp"

namespace nc {

nc_restart_coordinates Interpreter::coordinates() const {
  nc_restart_coordinates left{};
  for (unsigned i = 0; i < axis_count; ++i) {
    left.shift.v[i] = frames.get(Frames::shift_key(i));
    left.shift_kept.v[i] = records->shift_kept.at[i];
    for (unsigned of = 0; of < Frames::kStandardSystems; ++of) left.local[of].v[i] = frames.get(Frames::local_key(of, i));
  }
  left.polar = settings.keeps_polar_command && state.modal.is(Function::polar_command_on);
  return left;
}

void Interpreter::set_coordinates(const nc_restart_coordinates& left) {
  ShiftKept kept;
  for (unsigned i = 0; i < axis_count; ++i) {
    set_table_from_outside(Frames::shift_key(i), left.shift.v[i]);
    kept.at[i] = left.shift_kept.v[i];
    for (unsigned of = 0; of < Frames::kStandardSystems; ++of) set_table_from_outside(Frames::local_key(of, i), left.local[of].v[i]);
  }
  records.change_from_outside(&ProgramRecords::shift_kept, kept);
  if (settings.keeps_polar_command) state.modal.set(left.polar ? Function::polar_command_on : Function::polar_command_off);
}

}  // namespace nc
