// SPDX-License-Identifier: Apache-2.0
// How the feeder gives up records that are committed. It asks; the scan agrees when it is at rest in a stop, and from then on touches no record until
// the feeder has claimed the records, given them up and released the scan. The scan may withdraw an agreement that is not claimed yet (a reset
// has come). Claiming and releasing lie in one call of the feeder, so neither side ever waits for a step that may never come.
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
  /// On success only the feeder uses the ring from its tail on, until release(). False: the scan has not agreed, or has withdrawn.
  bool claim() {
    uint32_t agreed = word(asked_, kAgreed);
    return answer_.compare_exchange_strong(agreed, word(asked_, kClaimed), std::memory_order_acq_rel, std::memory_order_relaxed);
  }
  void release() { answer_.store(word(asked_, kOver), std::memory_order_release); }

  /// For tests: requests are counted from `first`.
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
  /// The scan has agreed, and the feeder has not released it yet.
  bool holds() const { return (answer_.load(std::memory_order_acquire) & 3u) != kOver; }
  /// Takes the agreement back. False: the feeder has claimed the records, or has done so since this cycle began. Then the plan that the scan took in
  /// this cycle may lead over records that are given up, so the scan touches no record until the next cycle calls holds().
  bool withdraw() {
    uint32_t agreed = word(seen_, kAgreed);
    return answer_.compare_exchange_strong(agreed, word(seen_, kOver), std::memory_order_acq_rel, std::memory_order_relaxed);
  }

 private:
  enum : uint32_t { kOver = 0, kAgreed = 1, kClaimed = 2 };
  static constexpr uint32_t kNumber = ~0u >> 2;  ///< largest number of a request; only the newest request is ever compared
  static constexpr uint32_t word(uint32_t number, uint32_t state) { return (number & kNumber) << 2 | state; }

  alignas(64) std::atomic<uint32_t> request_{0};  ///< written by the feeder: number of the newest request
  uint32_t asked_ = 0;                            ///< used by the feeder only: requests so far
  alignas(64) std::atomic<uint32_t> answer_{0};   ///< number of the request and what became of it
  uint32_t seen_ = 0;                             ///< used by the scan only: the newest request that it has answered
};

}  // namespace nc
