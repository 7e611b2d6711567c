// SPDX-License-Identifier: Apache-2.0
// The search for the mark of one axis, scan by scan. It says what the axis is to do next (a jog, a reference return) and where the mark was;
// the scan moves the axis under its limits as by hand, sets its position, and stops the search when something keeps axes from moving.
//
//   switch, edge "enter":  fast ─▶ dog on, rest ─▶ back, fast, until the dog is off, rest ─▶ creep ─▶ dog on: mark (or the next index pulse)
//   switch, edge "leave":  fast ─▶ dog on ─▶ creep, the same way on ─▶ dog off: mark (or the next index pulse)          M700 14.7, dog type
//   limit:                 fast ─▶ switch on, rest ─▶ back, creep ─▶ switch off: mark (or the next index pulse)
//   from on the dog:       away from it first, fast, then as above
//   then:                  rest ─▶ the position is set ─▶ to the reference position
//
// The mark is the place that is measured in the scan that sees the edge. docs/homing.md.
#pragma once

#include <cstdint>

#include "nc/run.h"
#include "runtime/axes/equipment.hpp"

namespace nc::rt {

// Why a search has failed: alarm R23. Numbers are the alarm's detail.
enum class HomingFault : std::uint8_t {
  kNone,
  kNoDog,      // not within `travel`
  kDogStays,   // the axis has gone `travel` away from it, and it is on
  kDogShort,   // it was left before the axis had come down to creep speed
  kNoIndex,    // not within `index_travel`
  kTimeout,
  kUnreadable, // a switch is on a bus that does not answer
  kLast = kUnreadable
};
const char* homing_fault_text(HomingFault fault);

class AxisHoming {
 public:
  struct Seen {
    double actual = 0;       // measured, mm or deg; what the drive says, with what it got for its screw
    double velocity = 0;     // commanded, mm/s or deg/s
    bool all_stand = false;  // no axis of its part system is commanded to move
    bool readable = true;    // its switches
    bool dog = false, index = false, done = false;
    bool at_reference = false;
    double cycle_s = 0.001;
  };
  struct Wish {
    nc_manual manual{};       // this is what the axis does; a jog at 0 brakes
    bool request = false;     // of the drive
    bool set = false;         // its position is to be set: the mark was at `mark`
    double mark = 0;          // in the coordinates of Seen::actual
    bool done = false;        // the axis is homed: nothing of its homing is left to do
    HomingFault fault = HomingFault::kNone;
  };

  void begin(const HomingConfig& config, const Seen& seen) noexcept;
  void stop() noexcept { phase_ = Phase::kIdle; }
  // The position has been set as the last wish said.
  void was_set() noexcept { phase_ = Phase::kReturn; }
  bool active() const noexcept { return phase_ != Phase::kIdle; }
  // It does not know yet where it stands.
  bool searching() const noexcept { return active() && phase_ != Phase::kReturn; }
  // Motion towards its own limit switch, and standing on it, belongs to the search. The way to the reference position does not: an offset may lead through the switch.
  bool uses_limit() const noexcept { return searching() && config_.kind == HomingKind::kLimit; }
  Wish step(const Seen& seen) noexcept;

 private:
  enum class Phase : std::uint8_t {
    kIdle, kAway, kAwayRest, kSeek, kSeekRest, kBack, kBackRest, kCreep, kLeave, kIndex, kRest, kSet, kReturn, kDriveForgets, kDrive
  };
  void enter(Phase phase, const Seen& seen) noexcept;
  Wish fail(HomingFault fault) noexcept;
  Wish go(int direction, double speed) const noexcept;
  Wish rest_then(Phase next, const Seen& seen) noexcept;
  Wish found(const Seen& seen) noexcept;
  Wish seek(const Seen& seen) noexcept;
  Wish back(const Seen& seen) noexcept;
  Wish leave(const Seen& seen) noexcept;
  Wish look_for_index(const Seen& seen) noexcept;
  bool beyond(double travel, const Seen& seen) const noexcept;

  HomingConfig config_;
  Phase phase_ = Phase::kIdle;
  double from_ = 0, mark_ = 0;
  double time_s_ = 0;
  bool was_on_ = false, index_before_ = false, crept_ = false;
  int way_ = 1;  // in which the edge was passed
};

}  // namespace nc::rt
