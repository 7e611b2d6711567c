// SPDX-License-Identifier: Apache-2.0
// When a run moved, and how often it rested in between.
#pragma once

#include <cstdint>

#include "stream/stream.hpp"

namespace nc::test {

class Rests {
 public:
  explicit Rests(const AxisVec& start) : before_(start) {}

  /// To be called with the command of each cycle.
  void see(const AxisVec& now) {
    ++cycle_;
    if (now == before_) {
      ++still_;
    } else {
      if (still_ > 1 && last_ > 0) ++count_;  // a single cycle without motion is the reversal of an axis
      still_ = 0;
      if (first_ == 0) first_ = cycle_;
      last_ = cycle_;
    }
    before_ = now;
  }
  /// Cycles without motion up to now.
  uint64_t still() const { return still_; }
  /// Number of rests between two motions.
  unsigned count() const { return count_; }
  /// Cycles from the first motion to the last.
  uint64_t cycles() const { return last_ - first_ + 1; }

 private:
  AxisVec before_;
  uint64_t cycle_ = 0, first_ = 0, last_ = 0, still_ = 0;
  unsigned count_ = 0;
};

}  // namespace nc::test
