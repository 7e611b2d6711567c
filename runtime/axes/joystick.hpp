// SPDX-License-Identifier: Apache-2.0
// Joysticks: an analog input jogs its axis, the faster the further it is out, while the grip is held. docs/connecting-a-machine.md.
#pragma once

#include <cstdint>

namespace nc::rt {

// What the configuration says of one direction of a stick; points are indices of the point table.
struct JoystickConfig {
  std::uint8_t system = 0, axis = 0;
  unsigned input = 0;       // input word
  unsigned dead_man = 0;    // input bit: the grip
  int chosen_by = -1;       // input bit: the stick moves the axis while it is on; -1 = always
  std::int32_t low = 0, middle = 0, high = 0;  // counts where the stick is full out in -, at rest, full out in +
  double dead_band = 0.1;   // share of the way to either side that counts as at rest
  double top_speed = 0;     // mm/s or deg/s
};

// How far a stick is out, from -1 to 1. NC_RT.
class Joystick {
 public:
  // The stick counts from where it has been at rest with the grip held: one that is out when the grip is taken, or whose input has come back, moves nothing.
  // `enabled`: the grip is held, the axis is chosen, and every input is good.
  double step(const JoystickConfig& config, std::int32_t count, bool enabled) noexcept {
    const double middle = config.middle, end = static_cast<double>(config.high) - middle, other = middle - static_cast<double>(config.low);
    const double way = count - middle;
    const double out = (way < 0) == (end < 0) ? way / end : way / other;  // share of the way to the end on this side
    // Far beyond its ends nothing moves: the wire is broken, or its supply is gone.
    if (!enabled || !(out <= kBroken && out >= -kBroken)) {
      armed_ = false;
      return 0;
    }
    const double size = out < 0 ? -out : out;
    if (size <= config.dead_band) {
      armed_ = true;
      return 0;
    }
    if (!armed_) return 0;
    const double share = (size - config.dead_band) / (1 - config.dead_band);
    return (out < 0 ? -1 : 1) * (share < 1 ? share : 1);
  }

 private:
  static constexpr double kBroken = 1.1;
  bool armed_ = false;
};

}  // namespace nc::rt
