// SPDX-License-Identifier: Apache-2.0
// The commands of ncmon: it fills the screen, prints once, prints a line for each status, or measures the latency.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dds/participant.hpp"

namespace nc::dds {

struct MonitorOptions {
  std::string machine;  // name of the control; "" = the first one that is received
  Access access;
  bool once = false, json = false, progress = false;
  bool signals = false;  // show signals instead of the status
  double wait_s = 5;     // time to wait for the first status
  unsigned latency = 0;  // number of samples with which the latency is measured; 0 = it is not measured
};

// Runs until the command is done or a signal ends it. Returns the exit status of ncmon.
int monitor_command(const MonitorOptions& options);

// A line such as "scan to subscriber, N samples: p50 ... max ..."; there must be at least one time.
std::string latency_text(std::vector<std::int64_t> times_ns);

}  // namespace nc::dds
