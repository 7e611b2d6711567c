// SPDX-License-Identifier: Apache-2.0
// What stands beside an axis on the machine, as the configuration says it: how it is homed, its limit switches, its brake, its screw. docs/homing.md.
#pragma once

#include <cstdint>
#include <string>

#include "nc/config.h"
#include "nc/types.h"
#include "runtime/axes/screw.hpp"

namespace nc::rt {

// A contact on a point. A closed one is 1 while nothing has happened, so that a broken wire counts as the event.
struct Contact {
  int point = -1;  // -1: there is none
  bool closed = false;

  bool present() const { return point >= 0; }
};

enum class HomingKind : std::uint8_t {
  kNone,      // the axis knows where it stands from the beginning, or nobody asks
  kSwitch,    // a dog
  kLimit,     // its limit switch is the dog
  kHere,      // it stands where it stands
  kAbsolute,  // its encoder knows
  kDrive      // the drive homes by itself
};

struct HomingConfig {
  HomingKind kind = HomingKind::kNone;
  bool required = true;    // no program starts before it is homed
  int direction = 1;       // in which the switch is looked for: +1, -1
  bool leaves = false;     // the mark is where the axis leaves the dog, still in this direction (M700 14.7), not where it comes on to it
  double fast = 0, creep = 0;  // mm/s or deg/s
  double travel = 0;       // mm or deg: the switch is within so much
  double index_travel = 0; // mm or deg: and the index pulse within so much behind the edge
  double offset = 0;       // mm or deg, signed: from the mark to the reference position
  double timeout_s = 120;
  double jog = 0;          // mm/s or deg/s: as fast by hand at most until it is homed
  unsigned order = 1;      // of home all: the lower ones first, equal ones together
  Contact dog, index;      // of kLimit the dog is the limit switch
  int request = -1, done = -1;  // of kDrive: the output point that asks for it, the input point that says that it is done

  bool present() const { return kind != HomingKind::kNone; }
  // In which the axis goes over its mark, -1 or +1; without one it is taken to lie on the side in +.
  int mark_direction() const { return kind == HomingKind::kSwitch ? direction : kind == HomingKind::kLimit ? -direction : 1; }
  // Where its measuring system is set.
  double mark(const nc_axis_config& axis) const { return axis.reference[0] - (kind == HomingKind::kDrive ? 0 : offset); }
  // Its position is lost with the power, and to be found again.
  bool forgets() const { return present() && kind != HomingKind::kAbsolute; }
};

struct BrakeConfig {
  int point = -1;        // output: 1 opens it
  double open_s = 0.1;   // from the output to the axis being free
  double close_s = 0.2;  // from the output going off to the brake holding: so long the drive holds yet
};

struct AxisEquipment {
  HomingConfig homing;
  Contact limit[2];  // in -, in +
  BrakeConfig brake;
  ScrewConfig screw;
};

// Direction of a motion, -1 or +1, as a place in AxisEquipment::limit.
constexpr unsigned side_of(int direction) { return direction > 0 ? 1 : 0; }

// What monitors and the ladder see of the axes of one part system: bit n = axis n.
struct AxisFlags {
  std::uint32_t homed = 0;       // its position is known
  std::uint32_t homing = 0;      // it is being homed
  std::uint32_t limit[2] = {};   // it stands on its limit switch in -, in +
  std::uint32_t brake_open = 0;  // the brake's output is on
  std::uint32_t servo_off = 0;   // its drive is off, or going to be, by plc.servo_off
  std::uint32_t locked = 0;      // machine lock: its commands are counted, and its drive is not given them
  std::uint32_t beside = 0;      // what was counted in a machine lock is not where it stands
  double counted[NC_MAX_AXES] = {};  // so much, mm or deg
  double screw[NC_MAX_AXES] = {};    // what its drive is given beyond the machine position for backlash and pitch, mm or deg
};

}  // namespace nc::rt
