// SPDX-License-Identifier: Apache-2.0
// The clamps of index tables (M700 9.3): an axis is unclamped before it moves and clamped behind that. There is one command and one answer
// for each axis: unclamp on, unclamped on, movement, unclamp off, unclamped off.
#pragma once

#include <cmath>

#include "base/same_place.hpp"
#include "interpolate/axis_parameters.hpp"

namespace nc {

class IndexClamp {
 public:
  /// An axis is unclamped, or on its way to its clamp.
  bool busy() const { return (unclamp_ | clamping_) != 0; }
  uint32_t unclamp() const { return unclamp_; }
  uint32_t clamping() const { return clamping_; }

  /// Asks for it. True when all of `axes` are unclamped.
  bool open(uint32_t axes, uint32_t unclamped) {
    clamping_ &= unclamped;
    if ((clamping_ & axes) != 0) return false;  // first to the end of what has begun
    unclamp_ |= axes;
    return (axes & ~unclamped) == 0;
  }
  /// `axes` leave the places where they were clamped.
  void leave(uint32_t axes) { away_ |= axes; }
  /// A move of the program has brought all of them where they can be clamped (9.3 (8)).
  void arrive() { away_ = 0; }
  /// An axis that has been moved by hand, or was stopped on its way, stands where it can be clamped.
  bool may_clamp(unsigned axis, const AxisParameters& parameters, double position, double reference) const {
    const double unit = parameters.increment[axis];
    return (away_ >> axis & 1) == 0 || !(unit > 0) || std::fabs(position - reference) < kReached ||
           std::fabs(position - unit * std::nearbyint(position / unit)) < kReached;
  }
  /// Clamps `axes`. True when none of them is unclamped any more, nor any other on its way.
  bool close(uint32_t axes, uint32_t unclamped) {
    const uint32_t off = unclamp_ & axes;
    unclamp_ &= ~off;
    away_ &= ~off;
    clamping_ = (clamping_ | off) & unclamped;
    return clamping_ == 0;
  }

 private:
  uint32_t unclamp_ = 0;   ///< commanded
  uint32_t clamping_ = 0;  ///< the command is off, the answer not yet
  uint32_t away_ = 0;      ///< of those commanded: may stand where no clamp is possible
};

}  // namespace nc
