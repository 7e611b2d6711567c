// SPDX-License-Identifier: Apache-2.0
// GPIO: what a bank of lines is and which points they are, as plain data. docs/gpio.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/gpio/line_chip.hpp"

namespace nc::hal::gpio {

struct PointLine {
  unsigned point = 0;  // index in the PointTable
  LineSetup line;
  unsigned debounce_ms = 0;       // of an input: a new level counts when it has stood for so long
  bool hold_on_loss = false;      // of an input: it keeps its last value while nobody knows the line
  std::uint8_t loss_value = 0;    // else it has this one
  std::uint8_t stop_value = 0;    // of an output, written when the control ends in order
};

struct BankConfig {
  std::string name;
  std::string chip;  // label, name or path
  std::string consumer = "ncrtd";
  unsigned poll_ms = 1;
  unsigned lost_after = 3;   // errors in a row
  bool has_watchdog = false;
  LineSetup watchdog;        // an output that is no point
  unsigned ok_point = 0;     // the input point "<name>.ok"
  std::vector<PointLine> lines;
};

}  // namespace nc::hal::gpio
