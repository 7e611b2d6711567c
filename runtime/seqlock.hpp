// SPDX-License-Identifier: Apache-2.0
// Sequence lock: one writer that never waits, and any number of readers, which read again when the writer has written meanwhile.
//
// The value is kept as an array of relaxed atomic words between two fences, so that there is no data race in
// the sense of the language (H.-J. Boehm, "Can seqlocks get along with programming language memory models?",
// 2012).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace nc::rt {

template <class T>
class SeqLock {
  static_assert(std::is_trivially_copyable_v<T>);
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;

 public:
  // `bytes`: only so many bytes from the beginning of T are exchanged; readers find the rest as in T{}.
  explicit SeqLock(std::size_t bytes = sizeof(T)) : words_used_(kWords) {
    store(T{});
    words_used_ = (bytes + 7) / 8;
  }

  void store(const T& value) noexcept {
    const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed);
    sequence_.store(sequence + 1, std::memory_order_relaxed);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < words_used_; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + 8 * i, i + 1 < kWords ? 8 : sizeof(T) - 8 * i);
      words_[i].store(word, std::memory_order_release);
    }
    sequence_.store(sequence + 2, std::memory_order_release);
  }

  T load() const noexcept {
    for (;;) {
      const std::uint64_t before = sequence_.load(std::memory_order_acquire);
      if ((before & 1) != 0) continue;
      std::array<std::uint64_t, kWords> words;
      for (std::size_t i = 0; i < words_used_; ++i) words[i] = words_[i].load(std::memory_order_acquire);
      if (sequence_.load(std::memory_order_relaxed) != before) continue;
      T value{};
      std::memcpy(static_cast<void*>(&value), words.data(), std::min(sizeof(T), 8 * words_used_));
      return value;
    }
  }

 private:
  std::size_t words_used_;
  std::atomic<std::uint64_t> sequence_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace nc::rt
