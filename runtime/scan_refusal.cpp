// SPDX-License-Identifier: Apache-2.0
// How the scan notes that something asked for at the panel does not happen. See refusal.hpp.
#include <bit>

#include "runtime/scan.hpp"

namespace nc::rt {

void Scan::refuse(unsigned system, Asked asked, Answer why, int axis, bool stopped, Asker by) noexcept {
  Refusal& refusal = refusal_[system];
  refusal = {refusal.count + 1, asked, why, stopped, static_cast<std::int8_t>(axis), by};
}

void Scan::settle(Asked asked, Answer answer, Asker by) noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    if (answer != Answer::kDone) refuse(s, asked, answer, -1, false, by);
    else happened(s, asked);
    if (answer == Answer::kRestartAxes) name_axis_away(s);
  }
}

// The axis for which a start waits: one of this part system, or else the first one of another.
void Scan::name_axis_away(unsigned system) noexcept {
  for (unsigned n = 0; n < systems_; ++n) {
    const unsigned s = (system + n) % systems_;
    if (out_[s].restart_axes == 0 || !goes_on_from_path(s)) continue;
    refusal_[system].axis = static_cast<std::int8_t>(std::countr_zero(out_[s].restart_axes));
    refusal_[system].of = static_cast<std::int8_t>(n == 0 ? -1 : static_cast<int>(s));
    return;
  }
}

// What was refused or stopped before a start is no news behind it.
void Scan::happened(unsigned system, Asked asked) noexcept {
  Refusal& refusal = refusal_[system];
  if (refusal.asked == asked || asked == Asked::kCycleStart) refusal = {refusal.count, Asked::kNothing, Answer::kDone, false, -1, refusal.by};
}

}  // namespace nc::rt
