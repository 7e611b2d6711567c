// SPDX-License-Identifier: Apache-2.0
// The real clock: CLOCK_MONOTONIC for deadlines, because it is never set back, and CLOCK_REALTIME plus the time zone for the
// clock that programs read.
#include "runtime/clock.hpp"

#include <cerrno>
#include <ctime>

namespace nc::rt {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

}  // namespace

RealClock::RealClock() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  if (localtime_r(&now, &local) != nullptr) zone_ms_ = static_cast<std::int64_t>(local.tm_gmtoff) * 1000;
}

std::int64_t RealClock::now_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * kNsPerS + t.tv_nsec;
}

void RealClock::sleep_until(std::int64_t deadline_ns) noexcept {
  timespec t{};
  t.tv_sec = deadline_ns / kNsPerS;
  t.tv_nsec = deadline_ns % kNsPerS;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

std::int64_t RealClock::local_ms() noexcept {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return t.tv_sec * 1000 + t.tv_nsec / 1'000'000 + zone_ms_;
}

}  // namespace nc::rt
