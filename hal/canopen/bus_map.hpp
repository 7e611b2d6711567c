// SPDX-License-Identifier: Apache-2.0
// CANopen: what a bus of drives is made from, as plain data. docs/canopen.md.
//
// A position of the drive is a number of increments as its object 6064h counts them; increments_per_unit is what the configuration makes of
// encoder, gear and screw. Machine position = increments / increments_per_unit + zero, mm or deg.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nc/types.h"

namespace nc::hal::canopen {

inline constexpr unsigned kMaxAxesPerNode = 4;  // as many PDOs of each direction as a node has identifiers for
inline constexpr unsigned kMaxNodes = 32, kMaxAxes = 32;

// One value that is written into a drive while it is set up.
struct ObjectValue {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::uint8_t bytes = 0;  // 1, 2 or 4
  std::uint32_t value = 0;
};

struct AxisMap {
  unsigned system = 0, axis = 0;  // of the control
  std::string name;               // "X": for people
  unsigned slot = 0;              // of the node's axes: objects 6000h + 800h * slot (CiA 402)
  unsigned rpdo = 1, tpdo = 1;    // number of the PDO in the drive, from 1
  double increments_per_unit = 1;  // negative: the axis counts against the drive
  double zero = 0;                 // machine position where the drive says 0
  double following_limit = 0;      // mm or deg; 0 = the drive's own check alone
  double max_velocity = 0;         // mm/s or deg/s: twice of it in one SYNC is a jump, which no drive is given; 0 = not checked
  // Drive-side homing (6098h); 0 = none.
  std::int8_t homing_method = 0;
  double homing_fast = 0, homing_slow = 0, homing_acceleration = 0;  // mm/s, mm/s^2
  double homing_position = 0;                                        // machine position of the reference mark
  double homing_timeout_s = 120;
  int homing_request = -1, homed = -1;  // points: the output whose rising edge begins it, the input that says it is done
  // Touch probe 1 of the drive (60B8h): its signal is this skip signal, 1 to 8; 0 = none.
  unsigned skip_signal = 0;
  bool skip_falling = false;

  bool has_homing() const { return homing_method != 0; }
  bool has_probe() const { return skip_signal != 0; }
  unsigned object(unsigned index) const { return index + 0x800 * slot; }
};

struct NodeMap {
  std::string name;
  unsigned id = 1;
  std::vector<AxisMap> axes;
  std::vector<ObjectValue> objects;  // written behind what the control itself sets
  std::uint32_t vendor = 0, product = 0;  // 1018h; 0 = any
};

struct BusMap {
  std::string interface;      // make_port()
  unsigned bit_s = 1'000'000;
  unsigned cycle_us = 1000;   // of the scan
  unsigned sync_us = 1000;    // a whole number of cycles
  unsigned own_id = 127;      // of the control's heartbeat
  unsigned heartbeat_ms = 100;  // of the control and of each node
  unsigned lost_after = 3;      // SYNCs without a position of a drive
  unsigned command_timeout_ms = 20;  // the bus's thread stops the axes when the scan has given no position for so long
  unsigned sdo_timeout_ms = 500;
  unsigned boot_timeout_ms = 10'000;
  unsigned enable_timeout_ms = 3000;
  unsigned stop_timeout_ms = 2000;  // of a quick stop, then voltage off
  int priority = 85;                // SCHED_FIFO of the bus's thread, 0 = an ordinary one
  std::vector<NodeMap> nodes;
  bool completes_functions = true;  // no ladder: M, S, T and B are complete at once
};

}  // namespace nc::hal::canopen
