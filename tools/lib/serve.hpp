// SPDX-License-Identifier: Apache-2.0
// ncrtd as a service: the machine runs and waits for commands until it is told to end. The service manager
// is told when the machine is ready. Its watchdog is fed only when the scan goes on, not by this loop alone: when the
// scan stands still, the process is ended, even if everything else works.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>

#include "runtime/end_signal.hpp"
#include "runtime/runtime.hpp"

namespace nc::tools {

struct ServeOptions {
  const nc::rt::EndSignal* signal = nullptr;  // the service ends when this is not 0; set by the handler of signals
  // Called at each look (every 5 ms), in the thread of serve().
  std::function<void()> look;
  // Called once, when the axes have been told to stop, and before the end: no command may come after it.
  std::function<void()> leave;
  std::int64_t rest_ns = 20'000'000'000;  // time in which the axes must come to rest, and again for the reset
  std::FILE* out = stdout;                // gets one line for each event, for the journal
};

// Serves a started runtime until the signal, and then until every axis stands: feed hold, rest, reset. After that the caller
// stops the runtime, which makes the outputs safe. False when the axes did not come to rest in time.
bool serve(nc::rt::Runtime* runtime, const ServeOptions& options);

}  // namespace nc::tools
