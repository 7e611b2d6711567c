// SPDX-License-Identifier: Apache-2.0
// What ncmon does with what it hears: fills the screen, prints once, prints a line for each status, measures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dds/participant.hpp"

namespace nc::dds {

struct MonitorOptions {
  std::string machine;  // name of the control; "" = the first that is heard
  unsigned domain = kDefaultDomain;
  bool once = false, json = false, progress = false;
  bool signals = false;  // instead of the status
  double wait_s = 5;     // for the first status
  unsigned latency = 0;  // so many samples; 0 = not measured
};

// Until it is done, or a signal ends it. The exit status of ncmon.
int monitor_command(const MonitorOptions& options);

// "scan to subscriber, N samples: p50 ... max ...", of at least one time.
std::string latency_text(std::vector<std::int64_t> times_ns);

}  // namespace nc::dds
