// SPDX-License-Identifier: Apache-2.0
// What the scan tells the feeder of tool life management: how long a tool of the table has cut, and that it is broken.
#pragma once

#include <atomic>
#include <cstdint>

#include "nc/types.h"

namespace nc {

class LifeRing {
 public:
  /// Milliseconds that stand for a tool that is broken.
  static constexpr uint32_t kBroken = 0xffffff;

  /// Scan. `tool`: its number in the table, 1 to 255. False: the feeder is behind; it is to be told later.
  bool push(uint8_t tool, uint32_t ms) NC_RT {
    const uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == kPlaces) return false;
    entry_[head % kPlaces] = uint32_t{tool} << 24 | (ms & kBroken);
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  /// Feeder.
  bool pop(uint8_t* tool, uint32_t* ms) {
    const uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    *tool = static_cast<uint8_t>(entry_[tail % kPlaces] >> 24);
    *ms = entry_[tail % kPlaces] & kBroken;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  static constexpr uint32_t kPlaces = 32;
  alignas(64) std::atomic<uint32_t> head_{0};
  alignas(64) std::atomic<uint32_t> tail_{0};
  uint32_t entry_[kPlaces] = {};
};

}  // namespace nc
