// SPDX-License-Identifier: Apache-2.0
// The services of the signal trace (runtime/trace/): one recording of the machine at a time. It belongs to the machine and not to the client that has begun it, so
// that what happens in the night can be looked at in the morning.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"

namespace nc::rt::services {

// To be used by one thread.
class TraceDesk {
 public:
  explicit TraceDesk(Runtime* runtime) : runtime_(*runtime) {}

  Outcome list_signals(const Call& call) const;
  // `user`, `client`: who asks for it, to be shown.
  Outcome arm(const Call& call, const std::string& user, const std::string& client);
  Outcome stop();
  Outcome status() const;
  Outcome read(const Call& call) const;

 private:
  bool read_plan(const Call& call, trace::Plan* plan, Outcome* outcome) const;
  std::int64_t time_of_day(std::int64_t scan_time_ns) const;

  Runtime& runtime_;
  std::uint32_t number_ = 0;  // of the newest recording, 0 = there was none
  std::vector<std::string> names_;
  std::string trigger_, user_, client_;
};

}  // namespace nc::rt::services
