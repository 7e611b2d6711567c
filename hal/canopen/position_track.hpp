// SPDX-License-Identifier: Apache-2.0
// The positions of an axis at the last SYNCs. They say when an axis passed a place that its drive has latched, and where another axis was at that moment.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace nc::hal::canopen {

class PositionTrack {
 public:
  static constexpr unsigned kSyncs = 32;

  void clear() noexcept { count_ = 0; }
  void note(std::int64_t position) noexcept {
    newest_ = (newest_ + 1) % kSyncs;
    position_[newest_] = position;
    count_ = std::min(count_ + 1, kSyncs);
  }
  bool empty() const noexcept { return count_ == 0; }

  // The time since the axis was at `place` for the last time, in SYNCs. A place that is not farther from the newest position than the way of the last SYNC and
  // `slack` counts as the newest, because a drive may latch it behind the moment in which it measures its position. Negative when the axis was not there.
  double since(std::int64_t place, std::int64_t slack) const noexcept {
    for (unsigned i = 0; i + 1 < count_; ++i) {
      const std::int64_t newer = back(i), older = back(i + 1);
      if (place < std::min(newer, older) || place > std::max(newer, older)) continue;
      return newer == older ? i : i + static_cast<double>(newer - place) / static_cast<double>(newer - older);
    }
    const std::int64_t step = count_ > 1 ? std::abs(back(0) - back(1)) : 0;
    return count_ > 0 && std::abs(place - back(0)) <= step + slack ? 0 : -1;
  }

  // The position at that time. Before the first SYNC that is known the axis counts as standing.
  std::int64_t at(double since) const noexcept {
    if (count_ == 0) return 0;
    const double last = count_ - 1;
    const double time = std::clamp(since, 0.0, last);
    const auto whole = static_cast<unsigned>(time);
    const std::int64_t newer = back(whole), older = back(std::min(whole + 1, count_ - 1));
    return newer + std::llround(static_cast<double>(older - newer) * (time - whole));
  }

 private:
  std::int64_t back(unsigned syncs) const noexcept { return position_[(newest_ + kSyncs - syncs) % kSyncs]; }

  std::array<std::int64_t, kSyncs> position_{};
  unsigned newest_ = 0, count_ = 0;
};

}  // namespace nc::hal::canopen
