// SPDX-License-Identifier: Apache-2.0
// What the scan tells the feeder of tool life management: how long a tool of the table has cut, and that it is broken.
#pragma once

#include <atomic>
#include <cstdint>

#include "nc/types.h"

namespace nc {

/// A tool of the table of tool life as it came into the spindle.
struct MountedTool {
  uint8_t place = 0;    ///< in the table, 1 to 255; 0 = the life of the tool in the spindle is not managed
  uint32_t number = 0;  ///< by which it was registered there; the place may have another tool since
};

class LifeRing {
 public:
  /// Milliseconds that stand for a tool that is broken.
  static constexpr uint32_t kBroken = ~0u;

  /// Scan. False: the feeder is behind; it is to be told later.
  bool push(const MountedTool& tool, uint32_t ms) NC_RT {
    const uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == kPlaces) return false;
    entry_[head % kPlaces] = {tool, ms};
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  /// Feeder.
  bool pop(MountedTool* tool, uint32_t* ms) {
    const uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    *tool = entry_[tail % kPlaces].tool;
    *ms = entry_[tail % kPlaces].ms;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  struct Entry {
    MountedTool tool;
    uint32_t ms = 0;
  };
  static constexpr uint32_t kPlaces = 32;
  alignas(64) std::atomic<uint32_t> head_{0};
  alignas(64) std::atomic<uint32_t> tail_{0};
  Entry entry_[kPlaces] = {};
};

}  // namespace nc
