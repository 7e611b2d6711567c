// SPDX-License-Identifier: Apache-2.0
// The loop of an axis whose position is held here, while it is lost: the axis is farther from its set-points than its limit allows. A motor that turns the wrong way, or an
// encoder that stands, makes of every speed that the loop gives a larger distance, so the axis is let go: no speed, and a quick stop of its drive.
//
//   held ─▶ (beyond the limit) lost ─▶ (a reset begins) acknowledged ─▶ (reset over, the drive off, the axis stands, the set-point is where it is) held
#pragma once

#include <cstdint>
#include <cstdlib>

namespace nc::hal::canopen {

class LostLoop {
 public:
  struct Seen {
    bool reset = false;     // the scan asks for a reset
    bool may_move = false;  // its drive is on or stopping, or where the axis is has not come
    std::int64_t position = 0, set_point = 0;  // increments
  };

  // `slack`: increments that an axis at rest may be beside the place where it stands.
  explicit LostLoop(std::int64_t slack = 0) : slack_(slack) {}

  void lose() noexcept { state_ = State::kLost; }
  bool is_lost() const noexcept { return state_ != State::kHeld; }
  bool waits_for_reset() const noexcept { return state_ == State::kLost; }

  // Once per SYNC. Only a reset that begins behind the loss acknowledges it: whoever holds the button does not know of it.
  void step(const Seen& seen) noexcept {
    if (seen.reset && !reset_before_ && state_ == State::kLost) state_ = State::kAcknowledged;
    reset_before_ = seen.reset;
    if (seen.may_move || std::abs(seen.position - stood_at_) > slack_) {
      stood_at_ = seen.position;
      stood_syncs_ = 0;
    } else if (stood_syncs_ < kStandstillSyncs) {
      ++stood_syncs_;
    }
    const bool stands = stood_syncs_ == kStandstillSyncs;
    if (state_ == State::kAcknowledged && !seen.reset && stands && std::abs(seen.set_point - seen.position) <= slack_) state_ = State::kHeld;
  }

 private:
  static constexpr unsigned kStandstillSyncs = 10;
  enum class State : std::uint8_t { kHeld, kLost, kAcknowledged };

  std::int64_t slack_;
  std::int64_t stood_at_ = 0;
  unsigned stood_syncs_ = 0;
  bool reset_before_ = false;
  State state_ = State::kHeld;
};

}  // namespace nc::hal::canopen
