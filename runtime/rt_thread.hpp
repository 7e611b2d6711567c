// SPDX-License-Identifier: Apache-2.0
// Real-time set-up of the process, and a thread with a small stack that may run under SCHED_FIFO.
//
// A request that the system does not allow gives a warning, never a failure: the same program runs on a desk computer and on a
// machine.
#pragma once

#include <pthread.h>

#include <functional>
#include <string>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt {

// To be called before any other thread exists: sets malloc to one arena, because each further one would be locked into memory, and turns trimming
// off.
void limit_allocator();

// Locks all memory that is mapped now or later. To be called when all memory is allocated; adds a warning when that is not allowed.
void lock_memory(std::vector<std::string>* warnings);

// A thread with a fixed, pre-faulted stack.
class RtThread {
 public:
  RtThread() = default;
  ~RtThread() { join(); }
  RtThread(const RtThread&) = delete;
  RtThread& operator=(const RtThread&) = delete;

  // False with a sentence in *error when the thread cannot be made.
  bool start(std::function<void()> body, std::string* error);
  void join();

 private:
  static void* enter(void* self);
  std::function<void()> body_;
  pthread_t thread_{};
  bool running_ = false;
};

// Gives the calling thread SCHED_FIFO and its core, as configured. To be called last before its loop.
void promote_scan_thread(const SchedulingConfig& scheduling, std::vector<std::string>* warnings);
// Gives the calling thread timers without the slack of 50 us that ordinary threads have on Linux.
void sharpen_timers();

}  // namespace nc::rt
