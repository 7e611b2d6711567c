// SPDX-License-Identifier: Apache-2.0
// How the scan notes that something asked for at the panel does not happen. See refusal.hpp.
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
  }
}

void Scan::happened(unsigned system, Asked asked) noexcept {
  Refusal& refusal = refusal_[system];
  if (refusal.asked == asked) refusal = {refusal.count, Asked::kNothing, Answer::kDone, false, -1, refusal.by};
}

}  // namespace nc::rt
