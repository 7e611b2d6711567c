// SPDX-License-Identifier: Apache-2.0
// A feed hold that waits for no other command. Any thread asks for it; the scan takes what was asked for in its next run, and answers when its snapshot shows it.
#pragma once

#include <atomic>
#include <cstdint>

namespace nc::rt {

class HoldDoor {
 public:
  // ---- any thread ----
  // Asks for a hold of these part systems, one bit each. The number of the request, never 0.
  std::uint64_t ask(std::uint32_t systems) noexcept {
    wanted_.fetch_or(systems, std::memory_order_release);
    return asked_.fetch_add(1, std::memory_order_acq_rel) + 1;
  }
  bool is_answered(std::uint64_t number) const noexcept { return answered_.load(std::memory_order_acquire) >= number; }

  // ---- the scan, NC_RT ----
  // The part systems that are to be held.
  std::uint32_t take() noexcept {
    const std::uint64_t asked = asked_.load(std::memory_order_acquire);
    if (asked == taken_) return 0;
    taken_ = asked;  // what is asked for from here on is answered by the next run, which may find that this one has done it
    return wanted_.exchange(0, std::memory_order_acq_rel);
  }
  void answer() noexcept { answered_.store(taken_, std::memory_order_release); }

 private:
  std::atomic<std::uint32_t> wanted_{0};
  std::atomic<std::uint64_t> asked_{0}, answered_{0};
  std::uint64_t taken_ = 0;
};

}  // namespace nc::rt
