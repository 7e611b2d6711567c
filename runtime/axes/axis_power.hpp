// SPDX-License-Identifier: Apache-2.0
// Drive and brake of one axis in order: the drive holds before the brake opens, and until it has closed.
//
//   off ─▶ starting: drive on ─▶ (it follows) ─▶ opening: brake open ─▶ (open_s) ─▶ on: the axis may move
//   on ─▶ closing: brake closed, the drive holds yet ─▶ (close_s) ─▶ off
//
// An axis without a brake goes from starting to on, and from on to off. docs/homing.md.
#pragma once

#include <cstdint>

#include "runtime/axes/equipment.hpp"

namespace nc::rt {

class AxisPower {
 public:
  struct Seen {
    bool off = false;      // its drive is to be off: plc.servo_off at rest with no program, or a fault of the machine
    bool dead = false;     // its own drive has a fault, or nobody reaches it
    bool follows = false;  // its drive follows the command
    bool stands = false;   // all axes of its part system: only then a drive comes on
    double cycle_s = 0.001;
  };

  void create(const BrakeConfig& brake) noexcept {
    brake_ = brake;
    phase_ = brake.point >= 0 ? Phase::kOff : Phase::kOn;
  }
  void step(const Seen& seen) noexcept;
  bool drive_on() const noexcept { return phase_ != Phase::kOff; }
  bool brake_open() const noexcept { return brake_.point >= 0 && (phase_ == Phase::kOpening || phase_ == Phase::kOn); }
  bool has_brake() const noexcept { return brake_.point >= 0; }
  bool free() const noexcept { return phase_ == Phase::kOn; }
  int brake_point() const noexcept { return brake_.point; }

 private:
  enum class Phase : std::uint8_t { kOff, kStarting, kOpening, kOn, kClosing };
  void enter(Phase phase) noexcept {
    phase_ = phase;
    time_s_ = 0;
  }

  BrakeConfig brake_;
  Phase phase_ = Phase::kOn;
  double time_s_ = 0;
};

}  // namespace nc::rt
