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
  static constexpr unsigned kSyncs = 128;  // more than an axis may be without a position (lost_after), and a slow drive with its answer

  void clear() noexcept { count_ = 0; }
  // `measured`: the position came with this SYNC; else it is the last one, and where the axis was says the next that comes.
  void note(std::int64_t position, bool measured) noexcept {
    newest_ = (newest_ + 1) % kSyncs;
    position_[newest_] = position;
    measured_[newest_] = measured;
    count_ = std::min(count_ + 1, kSyncs);
  }
  bool empty() const noexcept { return count_ == 0; }
  // Whether a position has come since `syncs` SYNCs ago, with which the axis was on its way at that time. With 0: the newest one has.
  bool known_since(unsigned syncs) const noexcept {
    if (count_ == 0) return true;
    const unsigned newest = older(0);
    return measured_[place_of(newest)] && newest <= syncs;
  }

  // The time since the axis was at `place` for the last time, in SYNCs. A place that is not farther from the newest position than the way of the last SYNC and
  // `slack` counts as the newest, because a drive may latch it behind the moment in which it measures its position. Negative when the axis was not there.
  double since(std::int64_t place, std::int64_t slack) const noexcept {
    for (unsigned i = 0, k = 0; i + 1 < count_; i = k) {
      k = older(i + 1);
      const std::int64_t to = back(i), from = back(k);
      if (place < std::min(to, from) || place > std::max(to, from)) continue;
      return to == from ? i : i + static_cast<double>(to - place) / static_cast<double>(to - from) * (k - i);
    }
    const std::int64_t step = count_ > 1 ? std::abs(back(0) - back(older(1))) : 0;
    return count_ > 0 && std::abs(place - back(0)) <= step + slack ? 0 : -1;
  }

  // The position at that time. Before the first SYNC that is known the axis counts as standing.
  std::int64_t at(double since) const noexcept {
    if (count_ == 0) return 0;
    const double last = count_ - 1;
    const double time = std::clamp(since, 0.0, last);
    const auto whole = static_cast<unsigned>(time);
    const unsigned to = newer(whole), from = older(std::min(whole + 1, count_ - 1));
    if (from == to) return back(to);
    return back(to) + std::llround(static_cast<double>(back(from) - back(to)) * (time - to) / (from - to));
  }

 private:
  unsigned place_of(unsigned syncs) const noexcept { return (newest_ + kSyncs - syncs) % kSyncs; }
  std::int64_t back(unsigned syncs) const noexcept { return position_[place_of(syncs)]; }
  // The nearest SYNC with a measured position from there on, towards the oldest and towards the newest; that one itself counts where there is none.
  unsigned older(unsigned syncs) const noexcept {
    while (syncs + 1 < count_ && !measured_[place_of(syncs)]) ++syncs;
    return syncs;
  }
  unsigned newer(unsigned syncs) const noexcept {
    while (syncs > 0 && !measured_[place_of(syncs)]) --syncs;
    return syncs;
  }

  std::array<std::int64_t, kSyncs> position_{};
  std::array<bool, kSyncs> measured_{};
  unsigned newest_ = 0, count_ = 0;
};

}  // namespace nc::hal::canopen
