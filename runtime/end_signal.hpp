// SPDX-License-Identifier: Apache-2.0
// Signals that end a program in order: the handler only notes the number, and whoever waits looks at it.
#pragma once

#include <csignal>
#include <initializer_list>

namespace nc::rt {

// From now on these signals are noted, and a pipe whose reader has gone is an error of the write, not the end of a machine in motion. What came
// before is forgotten.
void catch_end_signals(std::initializer_list<int> numbers);

// The last one that came, 0 = none. Any thread.
int end_signal();
// The same, for those who are given a place to look at.
const volatile std::sig_atomic_t* end_signal_place();

// "SIGINT". One that has no name here is shown as SIGTERM, which the others stand for.
const char* signal_name(int number);

// As a shell says of a process that a signal has ended.
constexpr int exit_status_of_signal(int number) { return 128 + number; }

}  // namespace nc::rt
