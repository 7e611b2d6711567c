// SPDX-License-Identifier: Apache-2.0
// One spindle of the simulated machine. Its speed follows the commanded one with a ramp, and its encoder counts. When its servo is switched on, it comes
// to rest, turns on to its zero mark (orientation) and from then on holds its position as a C axis (M700 10.5).
#pragma once

namespace nc::hal {

class SimSpindle {
 public:
  void set_servo(bool on) noexcept;
  // Simulates one cycle: the speed goes towards `wanted_rpm` (signed), or to what the servo asks for.
  void step(double cycle_s, double wanted_rpm, double ramp_rpm_per_s) noexcept;
  // Of a synchronous tap: it comes to rest, and then its angle follows so many revolutions from there on, as far as the ramp lets it.
  void follow(double turns, double cycle_s, double ramp_rpm_per_s) noexcept;
  void let_go() noexcept { following_ = false; }
  // The axis that it is has turned it by so many degrees.
  void turn_axis(double degrees, double cycle_s) noexcept;

  double rpm() const { return rpm_; }
  double turns() const { return turns_; }
  double angle_deg() const noexcept;  // 0 <= angle < 360
  bool ready() const { return phase_ == Phase::kHolding; }

 private:
  enum class Phase { kTurning, kStopping, kOrienting, kHolding };
  Phase phase_ = Phase::kTurning;
  double rpm_ = 0, turns_ = 0;
  double mark_ = 0;  // turns at which it is oriented
  bool following_ = false;
  double taken_at_ = 0;  // turns at which it was taken over, less those of the command
  double last_turns_ = 0;  // of the command in the cycle before
};

}  // namespace nc::hal
