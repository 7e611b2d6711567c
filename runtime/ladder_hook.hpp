// SPDX-License-Identifier: Apache-2.0
// The place of the ladder in the scan: after the inputs have been read, before the NC. Without a ladder program the hook is
// empty, and the FIN of the machine goes to the NC directly.
#pragma once

#include "hal/hal.hpp"
#include "runtime/axes/equipment.hpp"
#include "runtime/command.hpp"
#include "runtime/restart/external_search.hpp"
#include "runtime/snapshot.hpp"

namespace nc::rt {

// What the scan tells the ladder about its own state.
struct LadderStatus {
  Mode mode = Mode::kAuto;
  bool alarm = false;      // an alarm is active that stops the machine
  bool warning = false;    // only warnings are active, which let a program go on to its end
  bool resetting = false;  // from the request to the end of the reset
  bool drives_on = true;
  std::uint64_t scan = 0;
  const std::uint32_t* macro_output = nullptr;  // NC_WORDS words of #1132..., as the machine has them
  const AxisFlags* axes = nullptr;              // of each part system
  bool all_homed = true;
  bool power_failed = false, power_done = false;  // runtime/power/power_watch.hpp
  std::int64_t time_ns = 0;  // clock of the scan, at its start
  std::uint32_t restart_stands = 0, restart_bars = 0;  // one bit per part system: Scan::set_restart()
  const SearchDoor* search = nullptr;                  // of each part system
};

inline constexpr unsigned kLadderAlarms = 8;

// What the ladder asks of the scan, in addition to what it writes into the inputs of the NC. All are levels, cleared before
// every scan; on which edge they act is decided in runtime/scan_ladder.cpp.
struct LadderRequests {
  bool cycle_start = false;
  bool reset = false;
  bool power_fails = false;  // the supply says so
  bool home = false;       // every axis that can be homed, in order
  bool mode[3] = {};       // by Mode
  std::uint8_t alarm = 0;  // bit n: the ladder's alarm n+1
  bool stopped = false;    // the program has a fault and does not run
  unsigned stopped_line = 0, stopped_fault = 0;  // line of the ladder program; ladder::Fault
  std::uint32_t macro_input[NC_WORDS] = {};  // #1032 to #1035; combined by OR with the input points of #1000 ...

  // What concerns one part system.
  struct System {
    std::uint32_t skip_switches = 0;  // bit n: optional block skip n
    bool recalculate = false;
    bool rapid = false;          // jogs go at rapid
    bool length_by_handle = false;  // the handle of the third axis changes the length along the tool axis
    std::int32_t feed_override = -1, rapid_override = -1;  // in 0.01 %; -1 = none given: that of the operator is in force
    std::int32_t jog_feed = 0;   // mm/min or deg/min
    std::uint32_t jog_p = 0, jog_m = 0, reference = 0;  // bit n: axis n
    std::uint32_t interlocked[2] = {};  // bit n: axis n may not go in -, in +
    std::uint32_t servo_off = 0;        // bit n: the drive of axis n is to be off
    bool machine_lock = false;          // every axis is to be locked
    std::uint32_t axis_lock = 0;        // bit n: axis n is to be locked
    std::uint8_t feed_code = 0;         // feed override as a code of five bits, inverted
    std::uint32_t approach = 0;         // bit n: axis n goes back to where its program goes on
    double stick_feed[NC_MAX_AXES] = {};  // mm/s or deg/s at which a joystick jogs the axis, in place of jog_feed; 0 = none does
    bool search = false;                // the external search
    SearchAsked search_for;
    std::int16_t handle[NC_MAX_AXES] = {};              // increments in this scan
  };
  System system[NC_MAX_SYSTEMS];
};

// What a ladder reads and writes. All of it belongs to the scan thread; no pointer in here may be kept after the call.
struct LadderImage {
  const hal::PointTable* table;
  hal::PointImage* points;   // inputs of this scan; outputs are written to the machine at the end of this scan
  hal::Feedback* feedback;   // measured in this scan
  const nc_outputs* nc_out;  // outputs of the NC from the previous scan: strobes and codes
  nc_inputs* nc_in;  // what the NC gets in this scan; filled from commands and machine, the ladder may overwrite it
  unsigned system_count;
  const LadderStatus* status;
  LadderRequests* requests;
  const nc_config* nc = nullptr;
};

class LadderHook {
 public:
  virtual ~LadderHook() = default;
  virtual void scan(LadderImage* image) noexcept { (void)image; }  // NC_RT
  // After a fault: the program begins anew with the next scan, as at power on. NC_RT.
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
  // A device gets a value once, before the next run of the program. NC_RT.
  virtual Answer write(std::uint32_t number, std::int32_t value) noexcept {
    (void)number, (void)value;
    return Answer::kNoLadder;
  }
  // Called after the NC, because a program of the NC may have switched outputs, too.
  virtual void hold_outputs(hal::PointImage* points) noexcept { (void)points; }
  virtual void list_forces(ForceList* list) const noexcept { list->count = 0; }
};

}  // namespace nc::rt
