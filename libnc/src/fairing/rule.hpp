// SPDX-License-Identifier: Apache-2.0
// The parameters of fairing and of the judgement of corners (M700 13.17.1, additional functions (1) and (3)).
#pragma once

namespace nc {

struct FairingRule {
  bool fairing = false;        ///< fairing is on: #8033 = 1, and #8029 gives a length
  bool judge = false;          ///< corners are judged: #8036 = 1, and #8037 gives a length
  double length_mm = 0;        ///< #8029: only lines shorter than this are left out, and no point is moved by more
  double corner_cos = 1;       ///< cosine of the angle (#8020): where two lines turn by more, there is a corner
  double judge_length_mm = 0;  ///< #8037: lines shorter than this do not count when a corner is judged

  bool any() const { return fairing || judge; }
  bool operator==(const FairingRule&) const = default;
};

}  // namespace nc
