// SPDX-License-Identifier: Apache-2.0
// The simulated clamp of an index table: it opens and closes a fixed time after it was commanded.
#pragma once

namespace nc::hal {

struct SimClamp {
  double unclamp_s = 0.5, clamp_s = 0.5;
};

class SimClampState {
 public:
  // Simulates one cycle; true while the table is unclamped.
  bool step(const SimClamp& clamp, bool unclamp, double cycle_s) noexcept {
    if (unclamp == unclamped_) {
      gone_s_ = 0;
      return unclamped_;
    }
    gone_s_ += cycle_s;
    const double rounding = 1e-9;
    if (gone_s_ + rounding >= (unclamp ? clamp.unclamp_s : clamp.clamp_s)) {
      unclamped_ = unclamp;
      gone_s_ = 0;
    }
    return unclamped_;
  }

 private:
  bool unclamped_ = false;
  double gone_s_ = 0;
};

}  // namespace nc::hal
