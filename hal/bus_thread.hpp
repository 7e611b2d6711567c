// SPDX-License-Identifier: Apache-2.0
// The thread of a point bus. It is an ordinary thread even when a real-time thread makes it.
#pragma once

#include <pthread.h>

#include <cstdint>
#include <string>

namespace nc::hal {

// Makes a thread that runs body(argument). Its stack is small, because a runtime that locks its memory locks the whole stack. It is not scheduled in
// real time, even if the caller is, and it takes no signals, which are for the operator's thread. Tools show the first 15 bytes of `name`. False with the
// error of the system in *why.
bool make_bus_thread(pthread_t* thread, void* (*body)(void*), void* argument, const std::string& name, std::string* why);

// The time of CLOCK_MONOTONIC in nanoseconds. NC_RT: it does not enter the kernel.
std::int64_t monotonic_ns() noexcept;

}  // namespace nc::hal
