// SPDX-License-Identifier: Apache-2.0
// Signals at which a program ends properly. The handler only stores the number of the signal; the loops that wait look at it and leave.
#pragma once

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace nc::rt {

// The number of a signal, 0 = none. Written by the handler, which may run in any thread.
using EndSignal = std::atomic<int>;

// From now on these signals are stored, and a signal stored before is forgotten. SIGPIPE is ignored: writing to a pipe without a reader becomes an error
// of the write; it must not end the process while the machine is in motion.
void catch_end_signals(std::initializer_list<int> numbers);

// The last signal that came, 0 = none. Any thread.
int end_signal();
// The place where that number is stored, for code that polls it itself.
const EndSignal* end_signal_place();

// The name of a signal, such as "SIGINT". "SIGTERM" for every signal other than SIGINT, SIGHUP and SIGQUIT.
const char* signal_name(int number);

// The exit status that a shell reports of a process that was ended by a signal.
constexpr int exit_status_of_signal(int number) { return 128 + number; }

}  // namespace nc::rt
