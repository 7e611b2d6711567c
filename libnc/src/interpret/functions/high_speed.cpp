// SPDX-License-Identifier: Apache-2.0
// G05: high-speed high-accuracy control II on and off (M700 13.16). This control looks ahead as far in every mode, so the code changes
// nothing of the motion; it is the state that other functions ask for or exclude.
#include "interpret/functions/functions.hpp"

namespace nc {

Did do_high_speed(Interpreter& in) {
  State& state = in.state;
  uint32_t p = 0;
  // 13.16 (8): an address beside P is P35, and so is any other P than those of the family's modes.
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (letter != 'P' && in.words.has(letter)) return in.raise(Condition::value_range, letter, in.words.get(letter));
  if (!in.words.has('P')) return in.raise(Condition::format_error, 'P');
  if (!whole_number(in.words.get('P'), &p)) return in.raise(Condition::value_range, 'P', in.words.get('P'));
  if (p >= 1 && p <= 3) return in.raise(Condition::no_function, 'P', p);
  if (p != 0 && p != kHighAccuracy2) return in.raise(Condition::value_range, 'P', p);
  const int16_t motion = state.modal.code[kGroupMotion];
  const bool exponential = motion == 23 || motion == 33;  // 6.11
  if (p != 0 && (state.modal.code[kGroupPolarCommand] == 160 || exponential)) return in.raise(Condition::illegal_g, 'G', 5);  // 6.12
  state.high_speed = static_cast<uint16_t>(p);
  return Did::done;
}

}  // namespace nc
