// SPDX-License-Identifier: Apache-2.0
// Signals at which a program ends properly. See end_signal.hpp.
#include "runtime/end_signal.hpp"

#include <atomic>

namespace nc::rt {
namespace {

// The kernel gives a signal to any thread of the process, so the handler may run beside the thread that waits: a volatile sig_atomic_t would be enough for one thread only.
EndSignal g_signal = 0;
static_assert(EndSignal::is_always_lock_free, "a handler of signals must not take a lock");

extern "C" void note_end_signal(int number) {
  g_signal.store(number);
}

}  // namespace

void catch_end_signals(std::initializer_list<int> numbers) {
  g_signal = 0;
  std::signal(SIGPIPE, SIG_IGN);
  for (const int number : numbers) std::signal(number, note_end_signal);
}

int end_signal() { return g_signal; }

const EndSignal* end_signal_place() { return &g_signal; }

const char* signal_name(int number) {
  switch (number) {
    case SIGINT: return "SIGINT";
    case SIGHUP: return "SIGHUP";
    case SIGQUIT: return "SIGQUIT";
    default: return "SIGTERM";
  }
}

}  // namespace nc::rt
