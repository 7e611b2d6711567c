// SPDX-License-Identifier: Apache-2.0
// Electronic handwheels: what a counter has gone on is what the chosen axis goes, in increments of 0.001 mm or deg. docs/connecting-a-machine.md.
#pragma once

#include <cstdint>
#include <vector>

namespace nc::rt {

inline constexpr unsigned kMostHandwheels = 3;  // M700 has three handles
inline constexpr unsigned kMostDivisions = 200;  // two turns of a usual wheel: no hand makes them from one reading to the next

// What the configuration says of one wheel; points are indices of the point table, -1 = none.
struct HandwheelConfig {
  struct Choice {
    std::uint8_t system = 0, axis = 0;
    int point = -1;  // the wheel turns the axis while this is on
  };
  unsigned counter = 0;  // input word
  unsigned bits = 32;    // at which the counter wraps
  unsigned counts = 1;   // of the counter for each division of the wheel
  std::vector<Choice> axes;
  int times_10 = -1, times_100 = -1;
};

// The way of one wheel from scan to scan, in divisions.
class Handwheel {
 public:
  // Divisions since the scan before. A count that is not good, and the first one behind that, are no way, and neither is a jump: its counter has begun anew, or is
  // disturbed. The counts of a division that is not complete are kept, until another axis is chosen. NC_RT.
  std::int32_t step(std::uint32_t count, bool good, unsigned bits, unsigned counts, int choice) noexcept {
    const unsigned unused = 32 - bits;
    const auto way = static_cast<std::int32_t>((count - before_) << unused) >> unused;
    jumped_ = good && known_ && (way < 0 ? -std::int64_t{way} : std::int64_t{way}) > std::int64_t{kMostDivisions} * counts;
    const bool moved = good && known_ && !jumped_;
    known_ = good;
    before_ = count;
    if (choice != choice_ || !good || jumped_) rest_ = 0;
    choice_ = choice;
    if (!moved || choice < 0) return 0;
    rest_ += way;
    const std::int64_t divisions = rest_ / counts;
    rest_ -= divisions * counts;
    return static_cast<std::int32_t>(divisions);
  }
  // In the last step.
  bool jumped() const noexcept { return jumped_; }

 private:
  std::uint32_t before_ = 0;
  std::int64_t rest_ = 0;
  bool known_ = false, jumped_ = false;
  int choice_ = -1;  // axis that was chosen
};

}  // namespace nc::rt
