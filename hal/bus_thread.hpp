// SPDX-License-Identifier: Apache-2.0
// The thread of a point bus: ordinary, whoever makes it.
#pragma once

#include <pthread.h>

#include <cstdint>
#include <string>

namespace nc::hal {

// Runs body(argument). Its stack is small, because a runtime that locks its memory pays for all of it; it is not scheduled in real time though its
// maker may be, and signals are for the operator's thread. `name` is shown by tools, its first 15 bytes. False with the system's sentence in *why.
bool make_bus_thread(pthread_t* thread, void* (*body)(void*), void* argument, const std::string& name, std::string* why);

// Time of CLOCK_MONOTONIC in nanoseconds. NC_RT: it does not enter the kernel.
std::int64_t monotonic_ns() noexcept;

}  // namespace nc::hal
