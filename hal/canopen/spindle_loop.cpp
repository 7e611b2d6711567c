// SPDX-License-Identifier: Apache-2.0
// The speed of a spindle on a drive. See spindle_loop.hpp.
#include "hal/canopen/spindle_loop.hpp"

#include <algorithm>
#include <cmath>

namespace nc::hal::canopen {
namespace {

constexpr double kStands = 0.002;        // revolutions in a scan below which it counts as standing
constexpr unsigned kStillScans = 5;
constexpr double kCorrection = 0.5;      // share of the acceleration with which a place is approached; the rest is for the lag of drive and bus

}  // namespace

double SpindleLoop::ramp(double wanted, double cycle_s) noexcept {
  const double step = law_.acceleration * cycle_s;
  speed_ += std::clamp(std::clamp(wanted, -law_.most, law_.most) - speed_, -step, step);
  return speed_;
}

// The speed that leads to `place`, and with which it can still be braked there.
double SpindleLoop::towards(double place, double speed_there, double turns) const noexcept {
  const double away = place - turns;
  const double braking = std::sqrt(2 * kCorrection * law_.acceleration * std::abs(away));
  return speed_there + std::clamp(law_.gain * away, -braking, braking);
}

double SpindleLoop::step(const SpindleAsked& asked, double turns, double cycle_s) noexcept {
  const bool stands = std::abs(turns - place_) < kStands && std::abs(speed_) < 1e-9;
  place_ = turns;
  still_ = stands ? still_ + 1 : 0;
  const bool orient = asked.orient && asked.speed == 0 && law_.orient_speed > 0;
  if (!asked.enabled) {  // it runs out, or is turned by hand
    phase_ = Phase::kTurns;
    speed_ = 0;
    oriented_ = false;
    return 0;
  }
  if (!asked.synchronous && !orient) phase_ = Phase::kTurns;
  else if (phase_ == Phase::kTurns || (asked.synchronous && phase_ == Phase::kOrients) || (!asked.synchronous && phase_ == Phase::kFollows)) phase_ = Phase::kStops;
  oriented_ = false;
  switch (phase_) {
    case Phase::kTurns:
      return ramp(asked.speed, cycle_s);
    case Phase::kStops:
      if (still_ < kStillScans) return ramp(0, cycle_s);
      phase_ = asked.synchronous ? Phase::kFollows : Phase::kOrients;
      taken_at_ = turns - asked.turns;
      last_turns_ = asked.turns;
      mark_ = std::ceil(turns - law_.orient_angle - law_.orient_window) + law_.orient_angle;  // forwards, unless it stands there
      return ramp(0, cycle_s);
    case Phase::kOrients:
      oriented_ = std::abs(turns - mark_) <= law_.orient_window && std::abs(speed_) * cycle_s < law_.orient_window;
      return ramp(std::clamp(towards(mark_, 0, turns), -law_.orient_speed, law_.orient_speed), cycle_s);
    case Phase::kFollows: {
      const double commanded = (asked.turns - last_turns_) / cycle_s;
      last_turns_ = asked.turns;
      return ramp(towards(taken_at_ + asked.turns, commanded, turns), cycle_s);
    }
  }
  return 0;
}

}  // namespace nc::hal::canopen
