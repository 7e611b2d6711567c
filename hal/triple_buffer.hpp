// SPDX-License-Identifier: Apache-2.0
// Passes the newest state of something from one thread to another. Neither side ever waits, and the reader sees
// only whole states.
//
// There are three copies: one belongs to the writer, one to the reader, and the third is passed on by one atomic exchange
// that carries its number and whether it is new. A state that the reader has not taken is overwritten by the next one.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace nc::hal {

template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& initial) : copy_{initial, initial, initial} {}

  // ---- writer ----
  T& back() noexcept { return copy_[back_]; }
  void publish() noexcept {
    const std::uint8_t taken =
        middle_.exchange(static_cast<std::uint8_t>(back_ | kNew), std::memory_order_acq_rel);
    back_ = taken & kNumber;
  }

  // ---- reader ----
  // True when there is a newer state than at the last call; then front() is that state.
  bool take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    const std::uint8_t taken = middle_.exchange(front_, std::memory_order_acq_rel);
    front_ = taken & kNumber;
    return true;
  }
  const T& front() const noexcept { return copy_[front_]; }

 private:
  static constexpr std::uint8_t kNumber = 3, kNew = 4;
  std::array<T, 3> copy_;
  std::uint8_t back_ = 0;
  alignas(64) std::atomic<std::uint8_t> middle_{1};
  alignas(64) std::uint8_t front_ = 2;
};

}  // namespace nc::hal
