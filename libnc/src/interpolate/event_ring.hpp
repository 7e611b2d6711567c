// SPDX-License-Identifier: Apache-2.0
// Events from the scan to the host. The scan never waits: when events are not fetched, the oldest are overwritten and counted as dropped.
#pragma once

#include <atomic>
#include <cstring>

#include "base/arena.hpp"
#include "nc/run.h"

namespace nc {

/// Ring of nc_event in which the writer may overtake the reader. Each event lies there as 32-bit words,
/// stored with release and loaded with acquire order: a reader that saw a word of a newer event also sees
/// that the head has gone on, and throws its copy away.
class EventRing {
 public:
  static constexpr unsigned kWords = sizeof(nc_event) / 4;
  static_assert(sizeof(nc_event) % 4 == 0);

  /// `capacity` a power of two; capacity - 1 events are always kept.
  void create(uint32_t capacity, Arena& arena) {
    mask_ = capacity - 1;
    words_ = arena.make<std::atomic<uint32_t>>(static_cast<size_t>(capacity) * kWords);
  }

  void push(const nc_event& event) NC_RT {
    const uint32_t head = head_.load(std::memory_order_relaxed);
    // Announced before a word of the slot is overwritten, so that a reader that is copying the old event from it notices and drops the copy.
    claimed_.store(head + 1, std::memory_order_relaxed);
    uint32_t raw[kWords];
    std::memcpy(raw, &event, sizeof event);
    std::atomic<uint32_t>* slot = words_ + static_cast<size_t>(head & mask_) * kWords;
    for (unsigned i = 0; i < kWords; ++i) slot[i].store(raw[i], std::memory_order_release);
    head_.store(head + 1, std::memory_order_release);
  }

  /// The oldest event that is kept. False: there is none. *dropped receives how many have been overwritten since create().
  bool pop(nc_event* event, uint64_t* dropped) {
    for (;;) {
      const uint32_t head = head_.load(std::memory_order_acquire);
      if (head == next_) break;
      if (head - next_ > mask_) skip_to(head - mask_);
      uint32_t raw[kWords];
      const std::atomic<uint32_t>* slot = words_ + static_cast<size_t>(next_ & mask_) * kWords;
      for (unsigned i = 0; i < kWords; ++i) raw[i] = slot[i].load(std::memory_order_acquire);
      const uint32_t claimed = claimed_.load(std::memory_order_relaxed);
      if (claimed - next_ > mask_ + 1) {  // overwritten while it was copied
        skip_to(claimed - mask_);
        continue;
      }
      std::memcpy(event, raw, sizeof *event);
      ++next_;
      if (dropped) *dropped = dropped_;
      return true;
    }
    if (dropped) *dropped = dropped_;
    return false;
  }

  /// For tests: events are counted from `first`.
  void count_from(uint32_t first) {
    head_.store(first);
    claimed_.store(first);
    next_ = first;
  }

 private:
  void skip_to(uint32_t index) {
    dropped_ += index - next_;
    next_ = index;
  }

  std::atomic<uint32_t>* words_ = nullptr;
  uint32_t mask_ = 0;
  alignas(64) std::atomic<uint32_t> head_{0};  ///< events written
  std::atomic<uint32_t> claimed_{0};           ///< events written or being written
  alignas(64) uint32_t next_ = 0;              ///< the event that the reader takes next
  uint64_t dropped_ = 0;
};

}  // namespace nc
