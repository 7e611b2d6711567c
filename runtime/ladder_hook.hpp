// SPDX-License-Identifier: Apache-2.0
// Where the ladder stands in the scan: behind the inputs, before the NC. Without a ladder program the hook is
// empty and the machine's own FIN goes to the NC.
#pragma once

#include "hal/hal.hpp"
#include "runtime/axes/equipment.hpp"
#include "runtime/command.hpp"
#include "runtime/snapshot.hpp"

namespace nc::rt {

// What the scan says of itself.
struct LadderStatus {
  Mode mode = Mode::kAuto;
  bool alarm = false;      // an alarm is active that stops the machine
  bool warning = false;    // one that lets a program end
  bool resetting = false;  // from the request to the end of the reset
  bool drives_on = true;
  std::uint64_t scan = 0;
  const std::uint32_t* macro_output = nullptr;  // NC_WORDS words of #1132..., as the machine has them
  const AxisFlags* axes = nullptr;              // of each part system
  bool all_homed = true;
};

inline constexpr unsigned kLadderAlarms = 8;

// What the ladder asks of the scan, beside what it writes into the inputs of the NC: levels, cleared before
// every scan. When they act is the scan's business (runtime/scan_ladder.cpp).
struct LadderRequests {
  bool cycle_start = false;
  bool reset = false;
  bool home = false;       // every axis that can be homed, in order
  bool mode[3] = {};       // by Mode
  std::uint8_t alarm = 0;  // bit n: the ladder's alarm n+1
  bool stopped = false;    // the program has a fault and does not run
  unsigned stopped_line = 0, stopped_fault = 0;  // ladder::Fault
  std::uint32_t macro_input[NC_WORDS] = {};  // beside the points of #1000...

  // By part system.
  struct System {
    std::uint32_t skip_switches = 0;  // bit n: optional block skip n
    bool recalculate = false;
    bool rapid = false;          // of jogs
    std::int32_t feed_override = -1, rapid_override = -1;  // 0.01 %; -1: none, the operator's holds
    std::int32_t jog_feed = 0;   // mm/min or deg/min
    std::uint32_t jog_p = 0, jog_m = 0, reference = 0;  // bit n: axis n
    std::uint32_t interlocked[2] = {};  // bit n: axis n may not go in -, in +
    std::uint32_t servo_off = 0;        // bit n: the drive of axis n is to be off
    std::int16_t handle[NC_MAX_AXES] = {};              // increments in this scan
  };
  System system[NC_MAX_SYSTEMS];
};

// What a ladder reads and writes. All of it belongs to the scan thread; nothing in here may be kept.
struct LadderImage {
  const hal::PointTable* table;
  hal::PointImage* points;   // inputs of this scan; outputs go out at the end of this scan
  hal::Feedback* feedback;   // of this scan
  const nc_outputs* nc_out;  // of the scan before: strobes and codes
  nc_inputs* nc_in;  // what the NC gets in this scan, from panel and machine: the ladder has the last word
  unsigned system_count;
  const LadderStatus* status;
  LadderRequests* requests;
  const nc_config* nc = nullptr;
};

class LadderHook {
 public:
  virtual ~LadderHook() = default;
  virtual void scan(LadderImage* image) noexcept { (void)image; }  // NC_RT
  // After a fault: as at power on, with the next scan. NC_RT.
  virtual void restart() noexcept {}

  // ---- forced devices: held at a value whatever the program and the machine say. NC_RT. ----
  virtual Answer force(std::uint32_t number, std::int32_t value) noexcept {
    (void)number, (void)value;
    return Answer::kNoLadder;
  }
  virtual Answer release(std::uint32_t number) noexcept {
    (void)number;
    return Answer::kNoLadder;
  }
  // Behind the NC, which may have switched outputs too.
  virtual void hold_outputs(hal::PointImage* points) noexcept { (void)points; }
  virtual void list_forces(ForceList* list) const noexcept { list->count = 0; }
};

}  // namespace nc::rt
