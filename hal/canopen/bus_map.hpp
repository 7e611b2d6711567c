// SPDX-License-Identifier: Apache-2.0
// CANopen: the description of a bus of drives as plain data. docs/canopen.md.
//
// The position of a drive is a number of increments as in its object 6064h. The configuration computes increments_per_unit from
// encoder, gear and screw. Machine position = increments / increments_per_unit + zero, in mm or deg.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/canopen/module_map.hpp"
#include "hal/canopen/spindle_loop.hpp"
#include "nc/types.h"

namespace nc::hal::canopen {

inline constexpr unsigned kMaxAxesPerNode = 4;  // a node has identifiers for four PDOs of each direction
inline constexpr unsigned kMaxNodes = 32, kMaxAxes = 32;

// One value that is written into a drive while it is set up.
struct ObjectValue {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::uint8_t bytes = 0;  // 1, 2 or 4
  std::uint32_t value = 0;
};

inline constexpr unsigned kMostVelocityDelay = 8;

// Modes of operation (6060h) of an axis.
inline constexpr std::int8_t kModeProfileVelocity = 3, kModeHoming = 6, kModeCyclicPosition = 8, kModeCyclicVelocity = 9;

// An axis of a drive that is a spindle of the control. It is given a speed (60FFh) and measured by its position (6064h).
struct SpindleMap {
  unsigned number = 0;            // index among the spindles of the part system
  std::vector<double> gears;      // turns of the motor for one of the spindle, in each gear step; negative: the motor turns the other way
  int gear_select = -1;           // point: word output with the number of the gear step, from 1; another number is a gear that is not in
  double increments = 1;          // of 6064h, per turn of the motor
  double velocity_scale = 1;      // value of 60FFh at 1 r/min of the motor
  int forward = -1, backward = -1;      // points: the outputs that turn it (M3, M4)
  int orient = -1, oriented = -1;       // points: the output that asks for it, the input that says it is done
  double tap_axis_lag_s = 0;            // by which the drive of the axis that taps is behind its set-points
  SpindleLaw law;
};

struct AxisMap {
  unsigned system = 0, axis = 0;  // indices of part system and axis in the control
  std::string name;               // "X", for messages
  unsigned slot = 0;              // number of the axis in the node; its objects begin at 6000h + 800h * slot (CiA 402)
  unsigned rpdo = 1, tpdo = 1;    // number of the PDO in the drive, from 1
  double increments_per_unit = 1;  // negative: the axis counts against the drive
  double zero = 0;                 // machine position at which the position of the drive is 0: of one that homes by itself its mark
  double following_limit = 0;      // mm or deg; 0 = only the drive itself checks the following error
  double max_velocity = 0;         // mm/s or deg/s: a set-point that needs more than twice of it is a fault and is not sent; 0 = not checked
  // Homing by the drive (6098h); 0 = none.
  std::int8_t homing_method = 0;
  double homing_fast = 0, homing_slow = 0, homing_acceleration = 0;  // mm/s, mm/s^2; acceleration 0: the drive's own
  double homing_timeout_s = 120;
  int homing_request = -1, homed = -1;  // points: the output whose rising edge starts homing; the input that is on when it is done
  std::int8_t mode = kModeCyclicPosition;
  // Of an axis in kModeCyclicVelocity: its drive has a loop of its speed only, and the position is held here.
  double velocity_gain = 30;         // 1/s
  double velocity_delay = 3;         // SYNCs from the one whose cycle gives a set-point to the one whose cycle knows the place measured where the axis has come to it
  double velocity_per_increment = 1; // value of 60FFh at one increment/s
  std::optional<SpindleMap> spindle;  // `axis` is NC_MAX_AXES + its number then, and no axis of the control
  // The skip signal, 1 to 8, that touch probe 1 of the drive (60B8h) gives; 0 = the probe is not used.
  unsigned skip_signal = 0;
  bool skip_falling = false;

  bool holds_position() const { return !spindle && mode == kModeCyclicVelocity; }
  bool takes_speed() const { return spindle.has_value() || holds_position(); }  // 60FFh in place of 607Ah
  bool has_homing() const { return homing_method != 0; }
  bool has_probe() const { return skip_signal != 0; }
  unsigned object(unsigned index) const { return index + 0x800 * slot; }
};

struct NodeMap {
  std::string name;
  unsigned id = 1;
  std::vector<AxisMap> axes;         // of a drive
  std::optional<ModuleMap> module;   // of an I/O module, which has no axes
  std::vector<ObjectValue> objects;  // written after the objects that the control itself sets
  std::uint32_t vendor = 0, product = 0;  // required values of 1018h; 0 = any
};

struct BusMap {
  std::string interface;      // as make_port() takes it
  unsigned bit_s = 1'000'000;
  unsigned cycle_us = 1000;   // period of the scan
  unsigned sync_us = 1000;    // period of SYNC, a whole number of cycles
  unsigned own_id = 127;      // node number of the control, for its heartbeat
  unsigned heartbeat_ms = 100;  // period of the heartbeats of the control and of each node
  unsigned lost_after = 3;      // SYNCs without a position of a drive after which the axis has a fault
  unsigned command_timeout_ms = 20;  // when the scan has given no positions for this time, the bus's thread stops the axes
  unsigned sdo_timeout_ms = 500;
  unsigned boot_timeout_ms = 10'000;
  unsigned enable_timeout_ms = 3000;
  unsigned stop_timeout_ms = 2000;  // time for a quick stop; after it the voltage is switched off
  int priority = 85;                // SCHED_FIFO priority of the bus's thread, 0 = an ordinary thread
  std::vector<NodeMap> nodes;
  bool completes_functions = true;  // there is no ladder: M, S, T and B are complete at once
};

}  // namespace nc::hal::canopen
