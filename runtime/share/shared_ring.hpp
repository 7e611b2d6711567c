// SPDX-License-Identifier: Apache-2.0
// Queue between two processes in shared memory: one producer and one consumer, which never wait for each other. Either may die
// at any moment, because an element counts only when the head has moved past it. The consumer trusts no index: impossible ones empty the ring.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace nc::rt::share {

template <class T, std::uint32_t kCapacity>
class SharedRing {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert((kCapacity & (kCapacity - 1)) == 0, "capacity is a power of two");

 public:
  // False when full.
  bool push(const T& value) noexcept {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) >= kCapacity) return false;
    ring_[head & (kCapacity - 1)] = value;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  // False when the ring is empty, or when the indices were impossible; then the ring is emptied.
  bool pop(T* value) noexcept {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    const std::uint32_t head = head_.load(std::memory_order_acquire);
    if (head == tail) return false;
    if (head - tail > kCapacity) {
      tail_.store(head, std::memory_order_release);
      return false;
    }
    *value = ring_[tail & (kCapacity - 1)];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  std::uint32_t size() const noexcept {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_acquire);
  }
  // For tests of damaged segments.
  void force(std::uint32_t head, std::uint32_t tail) noexcept {
    head_.store(head);
    tail_.store(tail);
  }

 private:
  alignas(64) std::atomic<std::uint32_t> head_;
  alignas(64) std::atomic<std::uint32_t> tail_;
  std::array<T, kCapacity> ring_;
};

}  // namespace nc::rt::share
