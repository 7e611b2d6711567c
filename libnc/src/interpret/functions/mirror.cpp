// SPDX-License-Identifier: Apache-2.0
// Mirror image by program: G51.1, G50.1 (M700 13.6).
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"

namespace nc {

Execution do_mirror(BlockContext& in) {
  const Command& w = in.words;
  const bool on = w.one_shot->function == Function::mirror_on;
  if (on && w.target.axes() == 0) return in.raise_code(Condition::words_missing, *w.one_shot);
  uint32_t mirror = in.state.mirror;
  if (on) {
    // The centre is given by G90 or G91 like any position; in a rotated program it is a point of the shape that is rotated.
    const bool shape = in_figure(in);
    const AxisVec at = shape ? to_program(in, in.position()) : target_of_words(in);
    ProgramMaps maps = in.records->maps;
    for (unsigned i = 0; i < in.axis_count; ++i) {
      if (!w.target.commands(i)) continue;
      const double counted = shape ? shape_scaled(in, i, at[i] + w.target[i]) : at[i];
      maps.mirror_center[i] = w.target.counts_on(i) ? counted : w.target[i];
    }
    in.change(&ProgramRecords::maps, maps);
    mirror |= w.target.axes();
    if (shape) in.state.figure_mirror |= static_cast<uint8_t>(w.target.axes());  // M700 13.3.3 (3): all blocks are rotated
  } else {
    mirror = w.target.axes() == 0 ? 0 : mirror & ~w.target.axes();  // the named axes are not mirrored any more, whatever their values are
  }
  in.state.mirror = static_cast<uint8_t>(mirror);
  in.program_changed();
  in.state.modal.set(mirror != 0 ? Function::mirror_on : Function::mirror_off);
  return Execution::done;
}

}  // namespace nc
