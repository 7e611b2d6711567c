// SPDX-License-Identifier: Apache-2.0
// The axis of a synchronous tap follows the angle that its spindle really has (M700 13.1.1). The path commands both, the place of the axis and the angle
// of the spindle. The encoder shows by how much the spindle is behind (or before) what it was commanded in the cycle before; the axis is commanded that
// much of the lead behind its path. So a spindle that lags as it accelerates, or runs on at the bottom, takes the axis along, and the thread is as good as
// the lag of one cycle is constant. A drive that does what it is told changes nothing.
#pragma once

#include <algorithm>
#include <cmath>

#include "nc/types.h"

namespace nc {

class TapFollower {
 public:
  struct Limits {
    double velocity = 0, acceleration = 0;  ///< of the axis, mm/s and mm/s^2; 0 = none
    double cycle_s = 0.001;
  };

  /// The spindle is taken over where it stands, at `turns` revolutions of its encoder and `commanded` ones of the tap.
  void begin(double turns, double commanded) NC_RT {
    if (!active_) beside_ = 0;
    began_ = turns - commanded;
    commanded_ = commanded;
    aim_ = beside_;
    fresh_ = active_ = true;
    ends_ = false;
  }
  /// The axis has been put where it is: it is on its path.
  void drop() NC_RT { active_ = false; }
  /// The spindle is let go. The axis comes back to its path.
  void end() NC_RT { ends_ = true; }
  bool active() const NC_RT { return active_; }
  /// The axis is on its path, but for the resolution of an encoder, or the spindle stands and comes no nearer.
  bool arrived() const NC_RT { return !active_ || std::fabs(beside_) <= kArrived || stands_; }

  /**
   * One cycle.
   * @param turns of the encoder at the beginning of the cycle, if it was `measured`
   * @param commanded revolutions that the spindle is commanded for the end of the cycle, since begin()
   * @param per_mm revolutions per mm of the axis
   * @param place of the axis that the path commands
   * @return what is added to that place, mm
   */
  double step(bool measured, double turns, double commanded, double per_mm, double place, const Limits& limits) NC_RT {
    const bool follows = measured && !ends_ && per_mm != 0;
    double aim = follows ? (turns - began_ - commanded_) / per_mm : 0;
    if (!std::isfinite(aim)) aim = aim_;
    commanded_ = commanded;
    stands_ = !measured || std::fabs(turns - turns_) <= kStill;
    turns_ = turns;
    const double time = limits.cycle_s;
    if (fresh_) {  // it stands
      last_ = place + beside_;
      speed_ = 0;
      fresh_ = false;
    }
    const double of_path = (place - last_ + beside_) / time, change = limits.acceleration * time;
    const double behind = follows ? aim_ - beside_ : aim - beside_;  // what earlier cycles have left to be made good
    double back = behind / time;
    if (limits.acceleration > 0) {  // in such a way that it can end
      const double most = std::sqrt(2 * kOfAcceleration * limits.acceleration * std::fabs(behind));
      back = std::clamp(back, -most, most);
    }
    double speed = of_path + back + (follows ? (aim - aim_) / time : 0);
    aim_ = aim;
    if (limits.velocity > 0) speed = std::clamp(speed, std::min(of_path, -limits.velocity), std::max(of_path, limits.velocity));
    // The path itself keeps the limits, whatever the speed behind it is.
    if (limits.acceleration > 0) speed = std::clamp(speed, std::min(speed_, of_path) - change, std::max(speed_, of_path) + change);
    last_ += speed * time;
    speed_ = speed;
    beside_ = last_ - place;
    if (ends_ && std::fabs(beside_) <= kGone) {
      beside_ = 0;
      active_ = false;
    }
    return beside_;
  }
  /// How far the axis is beside its path.
  double beside() const NC_RT { return active_ ? beside_ : 0; }

 private:
  static constexpr double kArrived = 1e-3;        ///< mm
  static constexpr double kStill = 1e-6;          ///< revolutions in one cycle
  static constexpr double kGone = 1e-12;          ///< mm
  static constexpr double kOfAcceleration = 0.5;  ///< share of the axis' acceleration with which it comes back

  bool active_ = false, fresh_ = false, ends_ = false, stands_ = false;
  double turns_ = 0, began_ = 0, commanded_ = 0;
  double aim_ = 0, beside_ = 0, last_ = 0, speed_ = 0;
};

}  // namespace nc
