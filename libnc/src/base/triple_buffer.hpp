// SPDX-License-Identifier: Apache-2.0
// Hands a value from one thread to another without a lock: three buffers, exchanged by one 32-bit atomic.
#pragma once

#include <atomic>
#include <cstdint>

namespace nc {

/// Which of three buffers belongs to the writer, which to the reader, and which lies between them. The writer
/// fills its buffer and exchanges it with the middle one; the reader takes the middle one when it is new.
/// Neither ever waits. A 32-bit exchange is lock-free on every core that libnc runs on.
class TripleIndex {
 public:
  static_assert(std::atomic<uint32_t>::is_always_lock_free);
  unsigned back() const { return back_; }    ///< writer's
  unsigned front() const { return front_; }  ///< reader's
  /// Writer: give the back buffer away and get another.
  void publish() { back_ = middle_.exchange(back_ | kNew, std::memory_order_acq_rel) & 3u; }
  /// Reader: true when there is something new; front() is then the newest.
  bool refresh() {
    if (!(middle_.load(std::memory_order_relaxed) & kNew)) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & 3u;
    return true;
  }

 private:
  static constexpr uint32_t kNew = 4;
  alignas(64) std::atomic<uint32_t> middle_{1};
  alignas(64) uint32_t back_ = 0;
  alignas(64) uint32_t front_ = 2;
};

/// The newest value of a small struct, from one writing to one reading thread.
template <class T>
class Latest {
 public:
  void write(const T& value) {
    slot_[index_.back()] = value;
    index_.publish();
  }
  const T& read() {
    index_.refresh();
    return slot_[index_.front()];
  }

 private:
  TripleIndex index_;
  T slot_[3] = {};
};

}  // namespace nc
