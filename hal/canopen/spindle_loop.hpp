// SPDX-License-Identifier: Apache-2.0
// What a spindle on a drive is to do in each scan, as one number, the speed that its drive is given: it goes to its speed with a ramp, comes to rest at its angle
// (orientation), or follows the angle of a synchronous tap. Position is held by the speed here: the drive has a loop of its speed only.
//
// Angles are revolutions of the spindle, forward positive; at whole numbers it stands at its zero mark.
#pragma once

#include <cstdint>

namespace nc::hal::canopen {

struct SpindleLaw {
  double acceleration = 0;      // rev/s^2
  double most = 0;              // rev/s
  double orient_speed = 0;      // rev/s; 0 = it cannot be oriented
  double orient_angle = 0;      // rev, 0 <= angle < 1
  double orient_window = 0;     // rev: so near it is oriented
  double gain = 30;             // 1/s, of the position
};

struct SpindleAsked {
  bool enabled = false;      // its drive follows
  double speed = 0;          // rev/s, signed
  bool orient = false;
  bool synchronous = false;  // it stands, then follows `turns`
  double turns = 0;
};

class SpindleLoop {
 public:
  SpindleLoop() = default;
  explicit SpindleLoop(const SpindleLaw& law) : law_(law) {}
  // One scan of `cycle_s`, with what is measured. Returns the speed for the drive, rev/s.
  double step(const SpindleAsked& asked, double turns, double cycle_s) noexcept;
  // The motor goes on as it does, which is so many times the speed for the spindle: the slope leads on from there.
  void change_gear(double faster) noexcept { speed_ *= faster; }
  bool oriented() const noexcept { return oriented_; }

 private:
  double ramp(double wanted, double cycle_s) noexcept;
  double towards(double place, double speed_there, double turns) const noexcept;

  SpindleLaw law_;
  double speed_ = 0;        // given to the drive
  enum class Phase : std::uint8_t { kTurns, kStops, kOrients, kFollows } phase_ = Phase::kTurns;
  double mark_ = 0;         // revolutions at which it is oriented
  double taken_at_ = 0, last_turns_ = 0;
  double place_ = 0;        // measured in the scan before
  unsigned still_ = 0;      // scans in which it has stood
  bool oriented_ = false;
};

}  // namespace nc::hal::canopen
