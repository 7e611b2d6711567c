// SPDX-License-Identifier: Apache-2.0
// Real-time set-up of the process and a thread with a small stack that may run under SCHED_FIFO.
//
// What is asked for and not allowed is a warning, never a failure: the same program runs on a desk and on a
// machine.
#pragma once

#include <pthread.h>

#include <functional>
#include <string>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt {

// Before any other thread exists: one malloc arena (each further one would be locked into memory), no
// trimming.
void limit_allocator();

// Locks what is mapped now and later. Call when all memory is there; adds a sentence when it is not allowed.
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

// For the calling thread, as the last thing before its loop: SCHED_FIFO and the core, as configured.
void promote_scan_thread(const SchedulingConfig& scheduling, std::vector<std::string>* warnings);
// For a helper thread: timers without the slack of 50 us that Linux gives ordinary threads.
void sharpen_timers();

}  // namespace nc::rt
