// SPDX-License-Identifier: Apache-2.0
// The feeder wants to give up records that are committed: it asks, the scan agrees at rest in a stop and touches no record until the feeder
// has claimed them, given them up and released the scan. What was agreed to and is not claimed yet the scan may withdraw (a reset has come);
// claiming and releasing lie in one call of the feeder. So nobody waits for somebody who may never come.
#pragma once

#include <atomic>
#include <cstdint>

namespace nc {

class Truncation {
 public:
  // ---- feeder
  void ask() { request_.store(++asked_ & kNumber, std::memory_order_release); }
  /// The scan has answered the newest request.
  bool answered() const { return answer_.load(std::memory_order_acquire) >> 2 == (asked_ & kNumber); }
  /// From here until release() the ring is the feeder's from its tail on. False: the scan has not agreed, or has withdrawn.
  bool claim() {
    uint32_t agreed = word(asked_, kAgreed);
    return answer_.compare_exchange_strong(agreed, word(asked_, kClaimed), std::memory_order_acq_rel, std::memory_order_relaxed);
  }
  void release() { answer_.store(word(asked_, kOver), std::memory_order_release); }

  /// For tests: requests are counted from here.
  void count_from(uint32_t first) {
    asked_ = seen_ = first & kNumber;
    request_.store(asked_);
    answer_.store(word(asked_, kOver));
  }

  // ---- scan
  /// A request that has no answer yet.
  bool open() const { return request_.load(std::memory_order_acquire) != seen_; }
  void answer(bool agrees) {
    seen_ = request_.load(std::memory_order_relaxed);
    answer_.store(word(seen_, agrees ? kAgreed : kOver), std::memory_order_release);
  }
  /// What the scan has agreed to is still to be done.
  bool holds() const { return (answer_.load(std::memory_order_acquire) & 3u) != kOver; }
  /// Takes the agreement back. False: the feeder is at it, or has been since this cycle began. Then the plan that the scan took in this cycle may
  /// lead over records that are given up, so the ring stays the feeder's until the next cycle looks at holds().
  bool withdraw() {
    uint32_t agreed = word(seen_, kAgreed);
    return answer_.compare_exchange_strong(agreed, word(seen_, kOver), std::memory_order_acq_rel, std::memory_order_relaxed);
  }

 private:
  enum : uint32_t { kOver = 0, kAgreed = 1, kClaimed = 2 };
  static constexpr uint32_t kNumber = ~0u >> 2;  ///< of a request; only the newest one is compared
  static constexpr uint32_t word(uint32_t number, uint32_t state) { return (number & kNumber) << 2 | state; }

  alignas(64) std::atomic<uint32_t> request_{0};  ///< feeder's
  uint32_t asked_ = 0;                            ///< feeder's own
  alignas(64) std::atomic<uint32_t> answer_{0};   ///< number of the request and what became of it
  uint32_t seen_ = 0;                             ///< scan's own
};

}  // namespace nc
