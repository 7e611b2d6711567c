// SPDX-License-Identifier: Apache-2.0
// Real-time set-up on Linux. See rt_thread.hpp.
#include "runtime/rt_thread.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>

#include "runtime/sanitizer.hpp"

namespace nc::rt {
namespace {

#if defined(NC_UNDER_SANITIZER)
constexpr std::size_t kStackBytes = 8 << 20;  // a sanitizer keeps data of its own on the stack
#else
constexpr std::size_t kStackBytes = 512 * 1024;  // nc_create, for the check of a program and an import of parameters, takes 240 KB
#endif
constexpr std::size_t kPrefaultBytes = 128 * 1024;

// Touches the pages of the stack, so that no page fault happens later.
__attribute__((noinline)) void prefault_stack() {
  volatile unsigned char block[kPrefaultBytes];
  for (std::size_t i = 0; i < sizeof block; i += 4096) block[i] = 0;
}

}  // namespace

void limit_allocator() {
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TRIM_THRESHOLD, -1);
}

void lock_memory(std::vector<std::string>* warnings) {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return;
  warnings->push_back(std::string("memory is not locked (") + std::strerror(errno) +
                      "): a page fault may delay a scan; allow it with CAP_IPC_LOCK or a memlock limit");
}

void* RtThread::enter(void* self) {
  prefault_stack();
  static_cast<RtThread*>(self)->body_();
  return nullptr;
}

bool RtThread::start(std::function<void()> body, std::string* error) {
  body_ = std::move(body);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  const int failed = pthread_create(&thread_, &attributes, &RtThread::enter, this);
  pthread_attr_destroy(&attributes);
  running_ = failed == 0;
  if (failed != 0) *error = std::string("a thread cannot be started: ") + std::strerror(failed);
  return running_;
}

void RtThread::join() {
  if (!running_) return;
  pthread_join(thread_, nullptr);
  running_ = false;
}

void promote_scan_thread(const SchedulingConfig& scheduling, std::vector<std::string>* warnings) {
  if (scheduling.cpu >= 0) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(scheduling.cpu, &set);
    if (const int failed = pthread_setaffinity_np(pthread_self(), sizeof set, &set); failed != 0)
      warnings->push_back("the scan thread is not bound to cpu " + std::to_string(scheduling.cpu) + " (" +
                          std::strerror(failed) + ")");
  }
  if (!scheduling.fifo) return;
  sched_param parameter{};
  parameter.sched_priority = scheduling.priority;
  if (const int failed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter); failed != 0)
    warnings->push_back(std::string("the scan runs without real-time priority (") + std::strerror(failed) +
                        "): cycles will be late; allow it with CAP_SYS_NICE or an rtprio limit");
}

void sharpen_timers() {
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
}

}  // namespace nc::rt
