// SPDX-License-Identifier: Apache-2.0
// Behind interpolation: filters over the commanded positions, and the answer whether they have settled. A
// filter that holds positions back (acceleration after interpolation, S filters: M700 7.7, 13.15) goes in
// here without the interpolator knowing.
#pragma once

#include "stream/stream.hpp"

namespace nc {

class Shape {
 public:
  /// Start from rest at a place.
  void reset(const AxisVec& position) { last_ = position; }
  /// One cycle: what the interpolator wants in, what the axes are told out.
  AxisVec filter(const AxisVec& wanted) NC_RT {
    last_ = wanted;
    return last_;
  }
  /// Nothing of what went in is still on its way out: needed by in-position checks, gates and syncs.
  bool settled(const AxisVec& wanted) const NC_RT { return last_ == wanted; }

 private:
  AxisVec last_;
};

}  // namespace nc
