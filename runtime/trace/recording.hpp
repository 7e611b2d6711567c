// SPDX-License-Identifier: Apache-2.0
// One recording of signals in the scan: what is recorded, what it waits for, and its memory, which is taken whole before the scan sees it.
//
// Each scan is one row. Until the trigger the rows run round in a ring; from it on so many are added that the whole has as many rows as were asked for. A trigger
// that comes before the ring holds all the rows that are to stand in front of it is taken all the same: what happens once must not be missed for its beginning.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ladder/devices.hpp"

namespace nc::rt::trace {

inline constexpr std::size_t kMostSignals = 64;
inline constexpr std::uint32_t kMostRows = 1'000'000;
inline constexpr std::size_t kMostBytes = 16u << 20;  // of the rows of one recording

// What a recording begins at, of the value of its trigger and a level. kHigh and kLow look at one scan; the others compare it with the one before.
enum class When : std::uint8_t {
  kAtOnce,  // there is no trigger: the first scan
  kRise,    // it was below the level, and is not any more
  kFall,    // it was not below the level, and is now
  kChange,  // it is another value
  kHigh,    // it is not below the level
  kLow      // it is below the level
};

// Where the value of a signal is found in a scan.
struct Source {
  enum class Kind : std::uint8_t { kSignal, kPoint, kDevice };
  Kind kind = Kind::kSignal;
  ladder::DeviceType type = ladder::DeviceType::kBit;  // of a device
  std::uint32_t index = 0;  // in machine_signals(), in the table of points, or of the device
};

struct Plan {
  std::vector<Source> sources;
  When when = When::kAtOnce;
  std::uint32_t trigger = 0;  // index in sources
  std::int32_t level = 1;
  std::uint32_t rows = 1;     // of the whole recording, the row of the trigger among them
  std::uint32_t before = 0;   // rows in front of the trigger, fewer than `rows`
};

// Bytes that one row takes.
constexpr std::size_t row_bytes(std::size_t signals) { return signals * sizeof(std::int32_t) + sizeof(std::int64_t); }
// The most rows that a recording of so many signals may have.
constexpr std::uint32_t most_rows(std::size_t signals) {
  const std::size_t rows = kMostBytes / row_bytes(signals);
  return rows < kMostRows ? static_cast<std::uint32_t>(rows) : kMostRows;
}

// "" = the plan can be recorded, else what is wrong with it.
const char* plan_fault(const Plan& plan);

enum class State : std::uint8_t { kWaiting, kRecording, kComplete, kStopped };

class Recording {
 public:
  // The plan has no fault. Takes the memory and writes all of it, so that no page of it is missing in the scan.
  explicit Recording(Plan plan);
  const Plan& plan() const { return plan_; }

  // ---- the scan, NC_RT ----
  // The values of the row of this scan, to be filled in before end_row().
  std::int32_t* row() noexcept { return &values_[slot_ * plan_.sources.size()]; }
  // False when this was the last row.
  bool end_row(std::uint64_t scan, std::int64_t time_ns) noexcept;
  void stop() noexcept;

  // ---- any thread, while the scan records ----
  State state() const noexcept { return state_.load(std::memory_order_relaxed); }
  // Rows that the recording has, of plan().rows at most.
  std::uint32_t progress() const noexcept { return progress_.load(std::memory_order_relaxed); }

  // ---- when the scan has given it back ----
  struct Row {
    std::uint64_t scan = 0;
    std::int64_t time_ns = 0;
    const std::int32_t* values = nullptr;
  };
  std::uint32_t row_count() const { return kept_; }
  Row at(std::uint32_t row) const;
  bool triggered() const { return triggered_; }
  // The row of the trigger; the first one when there was none.
  std::uint32_t trigger_row() const { return triggered_ ? in_front_ : 0; }

 private:
  bool fires(std::int32_t now) const noexcept;

  const Plan plan_;
  std::vector<std::int32_t> values_;
  std::vector<std::int64_t> times_;
  std::atomic<State> state_{State::kWaiting};
  std::atomic<std::uint32_t> progress_{0};
  std::size_t slot_ = 0;         // place of the next row in the ring
  std::uint32_t kept_ = 0;       // rows that the recording has so far
  std::uint32_t in_front_ = 0;   // of them in front of the trigger
  bool triggered_ = false, any_ = false;
  std::int32_t last_ = 0;        // value of the trigger in the scan before; any_ says whether there was one
  std::uint64_t last_scan_ = 0;  // scan of the newest row
};

}  // namespace nc::rt::trace
