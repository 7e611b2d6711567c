// SPDX-License-Identifier: Apache-2.0
// What the scan tells the history of the machine: alarms that come and go, the state of each part system when it changes, and how long what has run.
//
// look() compares the picture of a scan with what it has told already, and tells the difference through a bounded queue. When the queue is full, the difference is
// told in a later scan; only what came and went meanwhile is lost, and counted. So the history never waits for the scan, and the scan never for the history. The
// counters are no messages: they are never lost.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "runtime/snapshot.hpp"
#include "runtime/spsc.hpp"

namespace nc::rt::history {

struct ScanEvent {
  enum class Kind : std::uint8_t { kRaised, kCleared, kState };
  Kind kind = Kind::kState;
  std::uint8_t system = 0;             // kState: index of the part system
  nc_run_state before = NC_STATE_IDLE, state = NC_STATE_IDLE;  // kState
  std::int64_t time_ns = 0;            // clock of the scan
  double run_s = 0;                    // kState: seconds in execution since the cycle start
  ActiveAlarm alarm;                   // kRaised, kCleared
};

// The same occurrence of an alarm: raised in the same scan.
constexpr bool same_alarm(const ActiveAlarm& a, const ActiveAlarm& b) {
  return a.id == b.id && a.axis == b.axis && a.system == b.system && a.scan == b.scan && a.detail == b.detail;
}

class ScanTap {
 public:
  // Scan thread, at the end of each scan.
  void look(const Snapshot& now) noexcept;

  // ---- one reader ----
  bool pop(ScanEvent* event) noexcept { return events_.pop(event); }

  // ---- any thread ----
  // Alarms that came and went while the queue was full.
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }
  std::uint64_t scans() const noexcept { return scans_.load(std::memory_order_relaxed); }
  // Scans in which a program was in execution, and in which a spindle whose speed is measured turned.
  std::uint64_t running(unsigned system) const noexcept { return running_[system].load(std::memory_order_relaxed); }
  std::uint64_t turning(unsigned system, unsigned spindle) const noexcept { return turning_[system][spindle].load(std::memory_order_relaxed); }

  static constexpr std::size_t kQueue = 256;

 private:
  struct Known {
    ActiveAlarm alarm;
    bool told = false, gone = false;
  };
  void look_at_alarms(const Snapshot& now) noexcept;
  void look_at_system(const Snapshot& now, unsigned system) noexcept;
  bool tell(ScanEvent::Kind kind, const ActiveAlarm& alarm, std::int64_t time_ns) noexcept;

  SpscQueue<ScanEvent, kQueue> events_;
  std::array<Known, 2 * kMaxActiveAlarms> known_{};
  unsigned known_count_ = 0;
  nc_run_state state_[NC_MAX_SYSTEMS] = {};
  // Written by the scan alone, so a load and a store are enough.
  std::atomic<std::uint64_t> lost_{0}, scans_{0};
  std::array<std::atomic<std::uint64_t>, NC_MAX_SYSTEMS> running_{};
  std::array<std::array<std::atomic<std::uint64_t>, NC_MAX_SPINDLES>, NC_MAX_SYSTEMS> turning_{};
};

}  // namespace nc::rt::history
