// SPDX-License-Identifier: Apache-2.0
// Handwheels and joysticks of the configuration: what they ask for is added to what the ladder asks for, so that the same things prevent it.
#include <algorithm>
#include <cmath>

#include "runtime/scan.hpp"

namespace nc::rt {

bool Scan::is_held(int point) const noexcept { return point >= 0 && points_.value[point] != 0 && readable(point); }

// The place in wheel.axes of the first axis that is chosen, -1 = none; *alone: it is the only one.
int Scan::chosen_axis(const HandwheelConfig& wheel, bool* alone) const noexcept {
  int chosen = -1;
  *alone = true;
  for (std::size_t i = 0; i < wheel.axes.size(); ++i) {
    if (!is_held(wheel.axes[i].point)) continue;
    if (chosen >= 0) *alone = false;
    else chosen = static_cast<int>(i);
  }
  return chosen;
}

// An axis that two wheels have chosen goes by neither, because none of the two hands expects the way of the other; and a wheel that has chosen two axes turns
// neither. Where such a wheel is turned that is a refusal that is noted (watch_handle()).
void Scan::turn_handwheels(LadderRequests* requests) noexcept {
  constexpr std::int64_t kMost = INT16_MAX;
  std::uint32_t chosen[NC_MAX_SYSTEMS] = {}, twice[NC_MAX_SYSTEMS] = {};
  std::int32_t way[kMostHandwheels] = {};
  int choice[kMostHandwheels];
  std::fill_n(wheels_clash_, NC_MAX_SYSTEMS, 0u);
  for (std::size_t n = 0; n < config_.handwheels.size(); ++n) {
    const HandwheelConfig& wheel = config_.handwheels[n];
    bool alone = true;
    choice[n] = chosen_axis(wheel, &alone);
    way[n] = handwheel_[n].step(points_.value[wheel.counter], readable(static_cast<int>(wheel.counter)), wheel.bits, wheel.counts, choice[n]);
    if (choice[n] < 0) continue;
    const HandwheelConfig::Choice& axis = wheel.axes[static_cast<std::size_t>(choice[n])];
    twice[axis.system] |= (chosen[axis.system] | (alone ? 0u : ~0u)) & 1u << axis.axis;
    if (alone) chosen[axis.system] |= 1u << axis.axis;
  }
  for (std::size_t n = 0; n < config_.handwheels.size(); ++n) {
    if (choice[n] < 0 || way[n] == 0) continue;
    const HandwheelConfig& wheel = config_.handwheels[n];
    const HandwheelConfig::Choice& axis = wheel.axes[static_cast<std::size_t>(choice[n])];
    if ((twice[axis.system] >> axis.axis & 1u) != 0) {
      if (mode_ == Mode::kManual) wheels_clash_[axis.system] |= 1u << axis.axis;
      continue;
    }
    const int times = is_held(wheel.times_100) ? 100 : is_held(wheel.times_10) ? 10 : 1;
    std::int16_t& increments = requests->system[axis.system].handle[axis.axis];
    increments = static_cast<std::int16_t>(std::clamp(increments + std::int64_t{way[n]} * times, -kMost, kMost));
  }
}

// The counter of the wheel that has chosen this axis has jumped in this scan.
bool Scan::wheel_jumped(unsigned system, unsigned axis) const noexcept {
  for (std::size_t n = 0; n < config_.handwheels.size(); ++n) {
    if (!handwheel_[n].jumped() || mode_ != Mode::kManual) continue;
    bool alone = true;
    const int choice = chosen_axis(config_.handwheels[n], &alone);
    if (choice < 0 || !alone) continue;
    const HandwheelConfig::Choice& chosen = config_.handwheels[n].axes[static_cast<std::size_t>(choice)];
    if (chosen.system == system && chosen.axis == axis) return true;
  }
  return false;
}

// A stick is a jog button whose speed is how far it is out. With a button of the other direction the axis stands.
void Scan::move_joysticks(LadderRequests* requests) noexcept {
  for (std::size_t n = 0; n < config_.joysticks.size(); ++n) {
    const JoystickConfig& stick = config_.joysticks[n];
    const bool enabled = is_held(static_cast<int>(stick.dead_man)) && (stick.chosen_by < 0 || is_held(stick.chosen_by)) && readable(static_cast<int>(stick.input));
    const double out = joystick_[stick.system][stick.axis].step(stick, static_cast<std::int32_t>(points_.value[stick.input]), enabled);
    if (out == 0) continue;
    LadderRequests::System& asked = requests->system[stick.system];
    (out > 0 ? asked.jog_p : asked.jog_m) |= 1u << stick.axis;
    asked.stick_feed[stick.axis] = std::abs(out) * stick.top_speed;
  }
}

}  // namespace nc::rt
