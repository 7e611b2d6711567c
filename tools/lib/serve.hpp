// SPDX-License-Identifier: Apache-2.0
// ncrtd as a service: the machine is up and waits for commands until it is told to end. The service manager
// hears when the machine is ready, and its watchdog is fed by the heartbeat of the scan, not by this loop: a
// scan that stands still ends the process, however well everything else works.
#pragma once

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <functional>

#include "runtime/runtime.hpp"

namespace nc::tools {

struct ServeOptions {
  const volatile std::sig_atomic_t* signal = nullptr;  // not 0: end; set by the handler of SIGTERM and SIGINT
  // Called every look (5 ms), in the thread of serve().
  std::function<void()> look;
  // Called once before the machine is brought to rest: no command may come after it.
  std::function<void()> leave;
  std::int64_t rest_ns = 20'000'000'000;  // for the axes to come to rest, and again for the reset
  std::FILE* out = stdout;                // what happens, one line each, for the journal
};

// From a started runtime to the signal, and on until every axis stands: feed hold, rest, reset. The caller
// stops the runtime, which makes the outputs safe. False when the axes did not come to rest in time.
bool serve(nc::rt::Runtime* runtime, const ServeOptions& options);

}  // namespace nc::tools
