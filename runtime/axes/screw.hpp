// SPDX-License-Identifier: Apache-2.0
// What the screw (or rack, or worm) of an axis does to the place of its table: backlash where it reverses, and the error of its pitch along the way; and what its drive
// is given beyond the machine position so that the table stands where it is commanded. docs/homing.md says what is promised.
#pragma once

#include <vector>

namespace nc::rt {

// Errors are where the table stands less where it is commanded, as a laser measures them without compensation, mm or deg.
struct ScrewConfig {
  double from = 0, step = 0;          // places of the table on the machine: from, from + step ..., mm or deg
  std::vector<double> error[2];       // at these places, on the way in -, in +; empty: none
  double backlash = 0;                // the drive goes so far without the table where the axis reverses, mm or deg
  double acceleration = 0;            // the drive may get so much more where the axis reverses, mm/s^2 or deg/s^2
  double velocity = 0;                // and so much more speed, mm/s or deg/s; 0: as fast as it accelerates
  bool turns = false;                 // a rotary axis: the table is one turn

  bool present() const { return backlash > 0 || !error[1].empty(); }
};

// Of one axis. Feeds its drive's place in every scan; no allocation.
class ScrewCompensation {
 public:
  // Nothing is compensated at `zero` for an axis that came there in `direction` (-1, +1): there the measuring system was set. The configuration must outlive this.
  void create(const ScrewConfig& config, double zero, int direction) noexcept;
  // What the drive of an axis at `place`, on the machine, is to get beyond that. `known`: the axis knows where it stands. `measured`: the place follows the
  // drive and not the other way round, so that its changes say nothing about the side on which the screw lies.
  double step(double place, bool known, bool measured, double cycle_s) noexcept;
  double value() const noexcept { return value_; }
  // The measuring system was set where the drive stands: what it got is a part of that place.
  void come_in_anew() noexcept { weight_ = value_ = 0; }

 private:
  double time_for(double way) const noexcept;
  double most_error() const noexcept;
  double error_at(unsigned side, double place) const noexcept;
  void turn_round(double place, bool measured) noexcept;

  const ScrewConfig* config_ = nullptr;
  double zero_error_ = 0;   // the measured error where nothing is compensated
  double turn_s_ = 0;       // the change from one side to the other takes so long
  double comes_in_s_ = 0;   // and so long until an axis that has been homed has all of it
  unsigned side_ = 1;       // on which the screw lies or goes to lie: 0 -, 1 +
  double turned_ = 1;       // so much of the way from the other side is behind it, 0 to 1
  double weight_ = 0;       // as much of the compensation is in force, 0 to 1: it comes with the knowledge of the place, and not in a step
  double furthest_ = 0;     // place on the side's way from which a reversal is counted
  bool placed_ = false;
  double value_ = 0;
};

}  // namespace nc::rt
