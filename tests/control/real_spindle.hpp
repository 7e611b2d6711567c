// SPDX-License-Identifier: Apache-2.0
// A spindle as it really turns, for the tests of synchronous taps: it accelerates no faster than its motor can, and is behind its command by a time constant.
#pragma once

#include <algorithm>
#include <cmath>

#include "nc/nc.h"

namespace nc::test {

class RealSpindle {
 public:
  RealSpindle(double ramp_rev_s2, double lag_s, double cycle_s) : ramp_(ramp_rev_s2), lag_(lag_s), cycle_s_(cycle_s) {}
  /// One cycle. A tap takes it where it has come to rest.
  void step(const nc_outputs& out) {
    const bool follows = (out.spindle_synchronous & 1) != 0, before = taken_;
    double wanted = follows ? 0 : out.spindle_rev_min[0] / 60;
    if (follows && !taken_ && speed_ == 0) {
      taken_ = true;
      taken_at_ = turns_ - out.spindle_turns;
    }
    if (!follows) taken_ = false;
    if (taken_) wanted = (taken_at_ + out.spindle_turns - turns_) / lag_;
    speed_ += std::clamp(wanted - speed_, -ramp_ * cycle_s_, ramp_ * cycle_s_);
    turns_ += speed_ * cycle_s_;
    const double behind = taken_at_ + out.spindle_turns - turns_;
    behind_changed_ = taken_ && before ? std::fabs(behind - behind_) : 0;
    behind_ = behind;
  }
  /// The power is cut: it stands where it is.
  void power_cut() {
    speed_ = 0;
    taken_ = false;
  }
  /// What its encoder shows.
  void show(nc_inputs& in) const {
    in.spindle[0].rev_per_s = speed_;
    in.spindle[0].turns = turns_;
    in.spindle[0].turns_valid = true;
  }
  double turns() const { return turns_; }
  bool taken() const { return taken_; }
  /// Since a tap has taken it; 0 where none has it.
  double since_taken() const { return taken_ ? turns_ - taken_at_ : 0; }
  /// By how many turns it is behind its command more, or less, than a cycle ago.
  double behind_changed() const { return behind_changed_; }

 private:
  double ramp_, lag_, cycle_s_, turns_ = 0.3, speed_ = 0, taken_at_ = 0, behind_ = 0, behind_changed_ = 0;
  bool taken_ = false;
};

}  // namespace nc::test
