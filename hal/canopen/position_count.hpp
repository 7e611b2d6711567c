// SPDX-License-Identifier: Apache-2.0
// The 64-bit count of an axis from the 32 bits that its drive sends. It goes on where they overflow, which is known only while each step is one that the axis can make: behind several steps
// of half the range it would be off by 2^32, and nobody would see it. So a step that no axis can make ends the count: from there on it is what the drive says, and the axis must be homed again.
//
// While nothing is counted (from the start until the axis is led for the first time, while its drive homes and says of any place that it is 0, behind a time without positions) each position is taken
// as it comes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace nc::hal::canopen {

class PositionCount {
 public:
  PositionCount() = default;
  // `speed`: the largest of the axis, increments/s, 0 = not known; `slack`: increments that an axis that stands may show.
  PositionCount(double speed, double slack, std::int64_t sync_ns) : speed_(speed), slack_(slack), sync_ns_(sync_ns) {}

  // A position that was measured at this time. False: the axis cannot have come there from the one before.
  bool take(std::int32_t raw, std::int64_t measured_ns) noexcept {
    const auto step = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw) - static_cast<std::uint32_t>(raw_));
    const bool possible = !counts_ || can_make(step, measured_ns - measured_ns_);
    position_ = counts_ && possible ? position_ + step : raw;
    counts_ &= possible;
    raw_ = raw;
    measured_ns_ = measured_ns;
    taken_ = true;
    return possible;
  }
  // The axis is led from the place where it is measured: from here on it is counted.
  void begin() noexcept { counts_ |= taken_; }
  // The next positions are taken as they come.
  void forget() noexcept { counts_ = taken_ = false; }

  std::int64_t position() const noexcept { return position_; }
  std::int32_t raw() const noexcept { return raw_; }

 private:
  // An axis that falls, or is torn away, is faster than the control lets it be. Answers may come late by some SYNCs, each with its own step.
  static constexpr double kFaster = 4, kLateSyncs = 2;
  // A quarter of the 32 bits: an axis that may have gone farther at its largest speed cannot be counted.
  static constexpr double kMost = 1 << 30;

  bool can_make(std::int32_t step, std::int64_t since_ns) const noexcept {
    if (speed_ <= 0) return std::abs(static_cast<double>(step)) <= kMost;
    const double way = speed_ * (static_cast<double>(std::max<std::int64_t>(0, since_ns)) + kLateSyncs * static_cast<double>(sync_ns_)) * 1e-9;
    return way <= kMost && std::abs(static_cast<double>(step)) <= std::min(kFaster * way + slack_, kMost);
  }

  double speed_ = 0, slack_ = 0;
  std::int64_t sync_ns_ = 0;
  std::int64_t position_ = 0, measured_ns_ = 0;
  std::int32_t raw_ = 0;
  bool counts_ = false, taken_ = false;
};

}  // namespace nc::hal::canopen
