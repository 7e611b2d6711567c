// SPDX-License-Identifier: Apache-2.0
// A feed hold that waits for no other command. Any thread asks for it; the scan takes what was asked for in its next run, answers when its snapshot shows it, and
// notes when what it holds has come to rest: who asks later finds that it has, whatever has been started since, and by whom.
//
// Feed holds are counted, and a command that moves something carries the count of the moment in which it was asked for (Command::holds). So one that waits for
// its turn while a hold comes is refused by the scan, wherever it waits: nothing moves by what was asked for before the last hold.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "nc/types.h"

namespace nc::rt {

class HoldDoor {
 public:
  // ---- any thread ----
  // Asks for a hold of these part systems, one bit each. The number of the request, never 0.
  std::uint64_t ask(std::uint32_t systems) noexcept {
    const std::uint64_t number = asked_.fetch_add(1, std::memory_order_acq_rel) + 1;
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s)
      if ((systems >> s & 1u) != 0) raise(&wanted_[s], number);
    return number;
  }
  // The holds that have been asked for so far.
  std::uint64_t asked() const noexcept { return asked_.load(std::memory_order_acquire); }
  // The part systems that were to be held since so many had been asked for.
  std::uint32_t asked_since(std::uint64_t holds) const noexcept {
    std::uint32_t systems = 0;
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) systems |= wanted_[s].load(std::memory_order_acquire) > holds ? 1u << s : 0;
    return systems;
  }
  bool is_answered(std::uint64_t number, std::uint32_t systems) const noexcept {
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s)
      if ((systems >> s & 1u) != 0 && answered_[s].load(std::memory_order_acquire) < number) return false;
    return true;
  }
  // The axes of these part systems have been at rest behind the hold, or have been started before they were.
  bool has_stood(std::uint64_t number, std::uint32_t systems) const noexcept {
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s)
      if ((systems >> s & 1u) != 0 && stood_[s].load(std::memory_order_acquire) < number) return false;
    return true;
  }

  // ---- the scan, NC_RT ----
  // The part systems that are to be held.
  std::uint32_t take() noexcept {
    std::uint32_t systems = 0;
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
      const std::uint64_t wanted = wanted_[s].load(std::memory_order_acquire);
      if (wanted == taken_[s]) continue;
      taken_[s] = wanted;
      systems |= 1u << s;
    }
    return systems;
  }
  void answer() noexcept {
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s)
      if (answered_[s].load(std::memory_order_relaxed) != taken_[s]) answered_[s].store(taken_[s], std::memory_order_release);
  }
  // The part systems whose rest behind a hold has not been noted.
  std::uint32_t braking() const noexcept {
    std::uint32_t systems = 0;
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) systems |= stood_[s].load(std::memory_order_relaxed) != taken_[s] ? 1u << s : 0;
    return systems;
  }
  void stands(unsigned system) noexcept { stood_[system].store(taken_[system], std::memory_order_release); }

 private:
  static void raise(std::atomic<std::uint64_t>* to, std::uint64_t number) noexcept {
    std::uint64_t now = to->load(std::memory_order_relaxed);
    while (now < number && !to->compare_exchange_weak(now, number, std::memory_order_acq_rel)) continue;
  }

  std::atomic<std::uint64_t> asked_{0};
  std::array<std::atomic<std::uint64_t>, NC_MAX_SYSTEMS> wanted_{}, answered_{}, stood_{};  // by part system, numbers of requests
  std::array<std::uint64_t, NC_MAX_SYSTEMS> taken_{};
};

}  // namespace nc::rt
