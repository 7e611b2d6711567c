// SPDX-License-Identifier: Apache-2.0
// The services that show the ladder program in execution: its rungs with the power flow of a scan, and the values of devices.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"

namespace nc::rt::services {

// To be used by one thread.
class LadderDesk {
 public:
  explicit LadderDesk(Runtime* runtime) : runtime_(*runtime) {}

  Outcome list_rungs(const Call& call);
  Outcome list_devices(const Call& call);
  // `change` gets what was done, when it was.
  Outcome swap(const Call& call, Change* change);

 private:
  Runtime& runtime_;
  // The power flow of the whole program in one scan, and when it was taken: it costs that scan some time, so all clients together get at most one in kFlowPause.
  std::vector<std::uint8_t> flow_;
  std::uint64_t flow_scan_ = 0;
  std::chrono::steady_clock::time_point flow_time_{};
};

}  // namespace nc::rt::services
