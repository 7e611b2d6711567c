// SPDX-License-Identifier: Apache-2.0
// Where the ladder stands in the scan: behind the inputs, before the NC. Without a ladder program the hook is
// empty and the machine's own FIN goes to the NC.
#pragma once

#include "hal/hal.hpp"
#include "runtime/command.hpp"

namespace nc::rt {

// What the scan says of itself.
struct LadderStatus {
  Mode mode = Mode::kAuto;
  bool alarm = false;      // any alarm is active
  bool resetting = false;  // from the request to the end of the reset
  bool drives_on = true;
  std::uint64_t scan = 0;
};

inline constexpr unsigned kLadderAlarms = 8;

// What the ladder asks of the scan, beside what it writes into the inputs of the NC: levels, cleared before
// every scan. When they act is the scan's business (runtime/scan_ladder.cpp).
struct LadderRequests {
  bool cycle_start = false;
  bool reset = false;
  bool mode[3] = {};       // by Mode
  std::uint8_t alarm = 0;  // bit n: the ladder's alarm n+1
  bool stopped = false;    // the program has a fault and does not run
  unsigned stopped_line = 0;
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
};

class LadderHook {
 public:
  virtual ~LadderHook() = default;
  virtual void scan(LadderImage* image) noexcept { (void)image; }  // NC_RT
  // After a fault: as at power on, with the next scan. NC_RT.
  virtual void restart() noexcept {}
};

}  // namespace nc::rt
