// SPDX-License-Identifier: Apache-2.0
// GPIO: the description of a bank of lines and of their points, as plain data. docs/gpio.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/gpio/line_chip.hpp"

namespace nc::hal::gpio {

struct PointLine {
  unsigned point = 0;  // index in the PointTable
  LineSetup line;
  unsigned debounce_ms = 0;       // input: a new level counts when it has lasted for this time
  bool hold_on_loss = false;      // input: it keeps its last value while the line cannot be read
  std::uint8_t loss_value = 0;    // input: otherwise it has this value then
  std::uint8_t stop_value = 0;    // output: value that is written when the control ends properly
};

// An input whose edges are a skip signal: the axes were measured at the time of the edge.
struct Probe {
  unsigned line = 0;         // index in BankConfig::lines; its LineSetup::edges is set
  std::uint8_t system = 0;   // part system that gets the signal
  std::uint8_t signal = 0;   // bit of the skip signal, 0 = signal 1
  bool falling = false;      // the signal is on while the point is 0, and comes with its falling edge
};

// Two lines in quadrature as one point, which counts.
struct Encoder {
  unsigned point = 0;        // index in the PointTable, a word
  LineSetup a, b;            // their LineSetup::edges is set
  unsigned counts = 4;       // for each period of the lines: 1, 2 or 4
  unsigned bits = 32;        // the count wraps at so many bits, 16 or 32
  unsigned debounce_ms = 0;
};

struct BankConfig {
  std::string name;
  std::string chip;  // label, name or path
  std::string consumer = "ncrtd";
  unsigned poll_ms = 1;
  unsigned lost_after = 3;   // errors in a row after which the bank is lost
  bool has_watchdog = false;
  LineSetup watchdog;        // an output line that is not a point
  unsigned ok_point = 0;     // the input point "<name>.ok"
  std::vector<PointLine> lines;
  std::vector<Probe> probes;
  std::vector<Encoder> encoders;
};

}  // namespace nc::hal::gpio
