// SPDX-License-Identifier: Apache-2.0
// The thread of a point bus. See bus_thread.hpp.
#include "hal/bus_thread.hpp"

#include <csignal>
#include <cstring>
#include <ctime>

namespace nc::hal {
namespace {

constexpr std::size_t kStackBytes = 256 * 1024;

}  // namespace

bool make_bus_thread(pthread_t* thread, void* (*body)(void*), void* argument, const std::string& name, std::string* why) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  const sched_param ordinary{};  // otherwise the priority of a real-time caller would be used, which SCHED_OTHER refuses
  pthread_attr_setschedparam(&attributes, &ordinary);
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const int problem = pthread_create(thread, &attributes, body, argument);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&attributes);
  if (problem != 0) {
    *why = std::strerror(problem);
    return false;
  }
  pthread_setname_np(*thread, name.substr(0, 15).c_str());
  return true;
}

std::int64_t monotonic_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

}  // namespace nc::hal
