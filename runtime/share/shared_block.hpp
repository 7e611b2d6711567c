// SPDX-License-Identifier: Apache-2.0
// A value in shared memory with a sequence lock as in runtime/seqlock.hpp, but between two processes: the reader
// gives up when the writer died in the middle of writing, and the sequence tells it whether the value is new.
#pragma once

#include <sched.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace nc::rt::share {

template <class T>
class SharedBlock {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  static constexpr std::size_t kWords = sizeof(T) / 8;

 public:
  // For one writer. When a writer died and left the sequence odd, the next store() makes it even.
  void store(const T& value) noexcept {
    const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed) | 1;
    sequence_.store(sequence, std::memory_order_relaxed);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < kWords; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + 8 * i, 8);
      words_[i].store(word, std::memory_order_release);  // not before the odd sequence
    }
    sequence_.store(sequence + 1, std::memory_order_release);
  }

  // False when no consistent value was found for a second, because the writer has stopped in the middle of writing. A writer without a real-time
  // priority may be put aside there for many milliseconds by others, so that counting attempts alone would give up too early. Not for a real-time
  // thread: it may sleep.
  bool load(T* value, std::uint64_t* sequence = nullptr) const noexcept {
    for (unsigned attempt = 0; attempt < kQuickAttempts + kSlowAttempts; ++attempt) {
      if (attempt >= kQuickAttempts) usleep(kPauseUs);
      else if (attempt != 0) sched_yield();
      const std::uint64_t before = sequence_.load(std::memory_order_acquire);
      if ((before & 1) != 0) continue;
      auto* bytes = reinterpret_cast<unsigned char*>(value);
      for (std::size_t i = 0; i < kWords; ++i) {
        const std::uint64_t word = words_[i].load(std::memory_order_acquire);
        std::memcpy(bytes + 8 * i, &word, 8);
      }
      if (sequence_.load(std::memory_order_relaxed) != before) continue;
      if (sequence != nullptr) *sequence = before;
      return true;
    }
    return false;
  }
  std::uint64_t sequence() const noexcept { return sequence_.load(std::memory_order_acquire); }

 private:
  static constexpr unsigned kQuickAttempts = 100, kSlowAttempts = 1000, kPauseUs = 1000;
  std::atomic<std::uint64_t> sequence_;
  std::array<std::atomic<std::uint64_t>, kWords> words_;
};

}  // namespace nc::rt::share
