// SPDX-License-Identifier: Apache-2.0
// The external search: the machine names a program by its number, and a sequence number in it, as by switches at a pallet or by a cell computer. The program is
// selected; where a sequence number is given the place is looked for as the operator would look for it (runtime/restart/desk.hpp), so that the machine cannot
// begin with the modes, tools or spindle of another place. docs/signals.md, "External search".
#pragma once

#include <atomic>
#include <cstdint>

namespace nc::rt {

// The numbers stand in docs/signals.md and do not change.
enum class SearchResult : std::uint8_t {
  kNone = 0,
  kFound = 1,
  kBadNumber = 2,   // neither program nor sequence number, or one out of range
  kRefused = 3,     // not in mode AUTO, a program is in execution, an alarm, a reset; or one of them while it was under way
  kNoProgram = 4,
  kNotChecked = 5,  // the program has not passed its check
  kNoPlace = 6      // the sequence number was not found, or the program cannot begin there
};

struct SearchAsked {
  std::int32_t program = 0;   // O number, 0 = the program that is selected
  std::int32_t sequence = 0;  // 0 = the head
};

// The handshake of one part system, between scan and feeder: asked for by a rising signal, answered once, shown until the signal goes off. A request that comes
// before the one in front of it is answered takes its place.
class SearchDoor {
 public:
  // ---- scan ---- NC_RT.
  void follow(bool on, const SearchAsked& asked) noexcept {
    if (on && !on_) {
      what_.store(static_cast<std::uint64_t>(static_cast<std::uint32_t>(asked.program)) << 32 | static_cast<std::uint32_t>(asked.sequence), std::memory_order_relaxed);
      asked_.store(++number_, std::memory_order_release);
    }
    on_ = on;
  }
  // kNone until it is answered, and where nothing is asked.
  SearchResult shown() const noexcept {
    const std::uint64_t answer = answer_.load(std::memory_order_acquire);
    return on_ && answer >> 8 == number_ ? static_cast<SearchResult>(answer & 0xff) : SearchResult::kNone;
  }

  // ---- feeder ----
  bool take(SearchAsked* asked) noexcept {
    const std::uint32_t number = asked_.load(std::memory_order_acquire);
    if (number == taken_) return false;
    taken_ = number;  // where a newer one comes just now its numbers are taken, and it comes again
    const std::uint64_t what = what_.load(std::memory_order_relaxed);
    *asked = {static_cast<std::int32_t>(static_cast<std::uint32_t>(what >> 32)), static_cast<std::int32_t>(static_cast<std::uint32_t>(what))};
    return true;
  }
  void answer(SearchResult result) noexcept { answer_.store(std::uint64_t{taken_} << 8 | static_cast<std::uint8_t>(result), std::memory_order_release); }

 private:
  std::atomic<std::uint64_t> what_{0};    // program and sequence number
  std::atomic<std::uint32_t> asked_{0};   // number of the newest request
  std::atomic<std::uint64_t> answer_{0};  // number of the newest request that is answered, and the result
  std::uint32_t number_ = 0, taken_ = 0;  // of the scan; of the feeder
  bool on_ = false;
};

}  // namespace nc::rt
