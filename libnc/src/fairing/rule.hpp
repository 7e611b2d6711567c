// SPDX-License-Identifier: Apache-2.0
// What fairing and the judgement of corners go by (M700 13.17.1, additional functions (1) and (3)).
#pragma once

namespace nc {

struct FairingRule {
  bool fairing = false;        ///< #8033 = 1 with a length
  bool judge = false;          ///< #8036 = 1 with a length
  double length_mm = 0;        ///< #8029: only shorter lines are left out, and no point moves by more
  double corner_cos = 1;       ///< cosine of the angle from which on a corner is one (#8020)
  double judge_length_mm = 0;  ///< #8037: shorter lines do not count where a corner is judged

  bool any() const { return fairing || judge; }
  bool operator==(const FairingRule&) const = default;
};

}  // namespace nc
