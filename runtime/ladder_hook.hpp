// SPDX-License-Identifier: Apache-2.0
// Where the ladder stands in the scan: behind the inputs, before the NC. Empty until there is a ladder
// engine.
#pragma once

#include "hal/hal.hpp"

namespace nc::rt {

// What a ladder reads and writes. All of it belongs to the scan thread; nothing in here may be kept.
struct LadderImage {
  const hal::PointTable* table;
  hal::PointImage* points;   // inputs of this scan; outputs go out at the end of this scan
  hal::Feedback* feedback;   // of this scan
  const nc_outputs* nc_out;  // of the scan before: strobes and codes
  nc_inputs* nc_in;  // what the NC gets in this scan, from panel and machine: the ladder has the last word
  unsigned system_count;
};

class LadderHook {
 public:
  virtual ~LadderHook() = default;
  virtual void scan(LadderImage* image) noexcept { (void)image; }  // NC_RT
};

}  // namespace nc::rt
