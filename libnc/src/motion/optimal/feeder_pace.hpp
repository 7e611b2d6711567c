// SPDX-License-Identifier: Apache-2.0
// How far the scan goes while the planner works: who calls nc_feed() says how much may be done in each call, and how often it calls is its own affair. A law that is
// looked for has to begin where the axes have not been when it is found, so how long that takes has to be known before.
#pragma once

#include <cstdint>

namespace nc::optimal {

class FeederPace {
 public:
  /// A call begins with `given` instructions, and the scan is `at` seconds from the start of what it follows.
  void begins(double at, int64_t given) {
    const double went = at - at_;
    if (went > 0 && given_ > 0 && spent_) {
      const double seen = went / given_;
      per_instruction_ = per_instruction_ > 0 ? per_instruction_ + kNewest * (seen - per_instruction_) : seen;
    }
    if (went != 0) given_ = 0;
    at_ = at;
    given_ += static_cast<double>(given);
    spent_ = false;
  }
  /// All that the call was given has been used, and something is left to be done. Where the last call before the scan moved on had more than it needed, it tells nothing.
  void spent() { spent_ = true; }
  /// Seconds that go by while so much is done, as far as is known.
  double seconds(double instructions) const { return per_instruction_ * instructions; }

 private:
  static constexpr double kNewest = 0.25;  ///< the share that the newest call has in what is known

  double per_instruction_ = 0, at_ = 0;
  double given_ = 0;  ///< since the scan has moved on
  bool spent_ = false;
};

}  // namespace nc::optimal
