// SPDX-License-Identifier: Apache-2.0
// Signals at which a program ends properly. See end_signal.hpp.
#include "runtime/end_signal.hpp"

namespace nc::rt {
namespace {

volatile std::sig_atomic_t g_signal = 0;

extern "C" void note_end_signal(int number) {
  g_signal = number;
}

}  // namespace

void catch_end_signals(std::initializer_list<int> numbers) {
  g_signal = 0;
  std::signal(SIGPIPE, SIG_IGN);
  for (const int number : numbers) std::signal(number, note_end_signal);
}

int end_signal() { return g_signal; }

const volatile std::sig_atomic_t* end_signal_place() { return &g_signal; }

const char* signal_name(int number) {
  switch (number) {
    case SIGINT: return "SIGINT";
    case SIGHUP: return "SIGHUP";
    case SIGQUIT: return "SIGQUIT";
    default: return "SIGTERM";
  }
}

}  // namespace nc::rt
