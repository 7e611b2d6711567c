// SPDX-License-Identifier: Apache-2.0
#include "hal/sim/sim_spindle.hpp"

#include <algorithm>
#include <cmath>

namespace nc::hal {
namespace {

constexpr double kOrientRpm = 300;

}  // namespace

void SimSpindle::set_servo(bool on) noexcept {
  if (on == (phase_ != Phase::kTurning)) return;
  phase_ = on ? Phase::kStopping : Phase::kTurning;
}

void SimSpindle::step(double cycle_s, double wanted_rpm, double ramp_rpm_per_s) noexcept {
  if (phase_ == Phase::kHolding) return;
  if (phase_ == Phase::kOrienting) {
    rpm_ = kOrientRpm;
    turns_ += rpm_ / 60.0 * cycle_s;
    if (turns_ < mark_) return;
    turns_ = mark_;
    rpm_ = 0;
    phase_ = Phase::kHolding;
    return;
  }
  const double target = phase_ == Phase::kStopping ? 0 : wanted_rpm;
  const double step = ramp_rpm_per_s * cycle_s;
  rpm_ += std::clamp(target - rpm_, -step, step);
  turns_ += rpm_ / 60.0 * cycle_s;
  if (phase_ != Phase::kStopping || rpm_ != 0) return;
  phase_ = Phase::kOrienting;
  mark_ = std::floor(turns_) + 1;
}

void SimSpindle::follow(double turns, double cycle_s, double ramp_rpm_per_s) noexcept {
  if (!following_) {
    step(cycle_s, 0, ramp_rpm_per_s);
    following_ = rpm_ == 0;
    taken_at_ = turns_ - turns;
    last_turns_ = turns;
    return;
  }
  // Its drive takes the speed of the command, and what is missing of the angle is made good as fast as it can accelerate.
  const double commanded = (turns - last_turns_) / cycle_s, behind = taken_at_ + turns - turns_ - commanded * cycle_s;
  last_turns_ = turns;
  const double ramp = ramp_rpm_per_s / 60;  // rev/s^2
  const double most = std::sqrt(ramp * std::abs(behind));  // half of it is for braking again
  const double wanted = commanded + std::clamp(behind / cycle_s, -most, most);
  const double now = rpm_ / 60, speed = std::clamp(wanted, now - ramp * cycle_s, now + ramp * cycle_s);
  rpm_ = speed * 60;
  turns_ += speed * cycle_s;
}

void SimSpindle::turn_axis(double degrees, double cycle_s) noexcept {
  turns_ += degrees / 360;
  rpm_ = degrees / 360 / cycle_s * 60;
}

double SimSpindle::angle_deg() const noexcept { return 360 * (turns_ - std::floor(turns_)); }

}  // namespace nc::hal
