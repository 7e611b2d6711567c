// SPDX-License-Identifier: Apache-2.0
// The clock is handed to the scan, so that a test and a machine run the same code: RealClock sleeps on
// absolute deadlines of CLOCK_MONOTONIC; VirtualClock jumps there, and a run is as fast as the processor and
// always the same.
#pragma once

#include <cstdint>

namespace nc::rt {

class Clock {
 public:
  virtual ~Clock() = default;
  virtual std::int64_t now_ns() noexcept = 0;                       // monotonic
  virtual void sleep_until(std::int64_t deadline_ns) noexcept = 0;  // returns at once when it is in the past
  virtual std::int64_t local_ms() noexcept = 0;                     // ms since 1970-01-01, local time
};

class RealClock final : public Clock {
 public:
  RealClock();  // reads the time zone once, because the scan must not make that call
  std::int64_t now_ns() noexcept override;
  void sleep_until(std::int64_t deadline_ns) noexcept override;
  std::int64_t local_ms() noexcept override;

 private:
  std::int64_t zone_ms_ = 0;
};

// Starts at 2026-01-01T00:00:00.
class VirtualClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override { return now_ns_; }
  void sleep_until(std::int64_t deadline_ns) noexcept override {
    if (deadline_ns > now_ns_) now_ns_ = deadline_ns;
  }
  std::int64_t local_ms() noexcept override { return kEpochMs + now_ns_ / 1'000'000; }
  void advance(std::int64_t ns) noexcept { now_ns_ += ns; }

  static constexpr std::int64_t kEpochMs = 1'767'225'600'000;

 private:
  std::int64_t now_ns_ = 0;
};

}  // namespace nc::rt
