// SPDX-License-Identifier: Apache-2.0
// Mirror image by program: G51.1, G50.1 (M700 13.6).
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"

namespace nc {

Did do_mirror(Interpreter& in) {
  const BlockWords& w = in.words;
  const bool on = w.one_shot->function == Function::mirror_on;
  if (on && w.axes == 0) return in.raise(Condition::words_missing, 'G', 51.1);
  uint32_t mirror = in.state.mirror;
  if (on) {
    const AxisVec centre = target_of_words(in);  // by G90 or G91 like any position
    for (unsigned i = 0; i < in.axis_count; ++i) {
      if (((w.axes >> i) & 1) == 0) continue;
      in.set_note(Notes::mirror_key(i), ((w.incremental >> i) & 1) != 0 ? centre[i] : w.axis[i]);
    }
    mirror |= w.axes;
  } else {
    mirror = w.axes == 0 ? 0 : mirror & ~w.axes;  // of the named axes, whatever the value
  }
  in.state.mirror = static_cast<uint8_t>(mirror);
  in.program_changed();
  in.state.modal.code[kGroupMirror] = mirror != 0 ? int16_t{511} : int16_t{501};
  return Did::done;
}

}  // namespace nc
