// SPDX-License-Identifier: Apache-2.0
// G07: axes that are interpolated but do not move (M700 6.16).
#include "interpret/functions/functions.hpp"

namespace nc {

Execution do_hypothetical_axis(BlockContext& in) {
  State& state = in.state;
  const Command& w = in.words;
  if (w.target.axes() == 0) return in.raise_code(Condition::words_missing, *w.one_shot);
  AxisVec held = state.map.frozen != 0 ? in.points[state.held_point].at : AxisVec{};
  uint8_t frozen = state.map.frozen;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    const uint8_t bit = static_cast<uint8_t>(1u << i);
    // The number 0 (or the name alone) switches it on, every other number off.
    const bool on = w.get(in.axis_words.word(i)) == 0;
    if (on && (frozen & bit) == 0) held[i] = state.machine[i];
    if (!on && (frozen & bit) != 0) state.machine[i] = held[i];  // the axis has stood there all the time
    frozen = static_cast<uint8_t>(on ? frozen | bit : frozen & ~bit);
  }
  state.map.frozen = frozen;
  state.refresh_special();
  if (frozen != 0) state.held_point = in.points.intern(PathPoint{held});
  return Execution::done;
}

}  // namespace nc
