// SPDX-License-Identifier: Apache-2.0
// The clamps of index tables (M700 9.3): an axis is unclamped before it moves and clamped after the movement. Each axis has one command (unclamp)
// and one answer (unclamped): unclamp on, unclamped on, movement, unclamp off, unclamped off.
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

  /// Commands `axes` to be unclamped. True when all of them are; `unclamped` is the answer of the machine.
  bool open(uint32_t axes, uint32_t unclamped) {
    clamping_ &= unclamped;
    if ((clamping_ & axes) != 0) return false;  // clamping has begun and is finished first
    unclamp_ |= axes;
    return (axes & ~unclamped) == 0;
  }
  /// `axes` have left the positions at which they were clamped.
  void leave(uint32_t axes) { away_ |= axes; }
  /// A move of the program has brought all axes to positions at which they can be clamped (9.3 (8)).
  void arrive() { away_ = 0; }
  /// The axis stands where it can be clamped: at the end of a move of the program, or, where it was moved by hand or stopped on its way, at its
  /// reference position or a multiple of its increment.
  bool may_clamp(unsigned axis, const AxisParameters& parameters, double position, double reference) const {
    const double unit = parameters.increment[axis];
    return (away_ >> axis & 1) == 0 || !(unit > 0) || std::fabs(position - reference) < kReached ||
           std::fabs(position - unit * std::nearbyint(position / unit)) < kReached;
  }
  /// Commands `axes` to be clamped. True when neither they nor any other axis is still being clamped.
  bool close(uint32_t axes, uint32_t unclamped) {
    const uint32_t off = unclamp_ & axes;
    unclamp_ &= ~off;
    away_ &= ~off;
    clamping_ = (clamping_ | off) & unclamped;
    return clamping_ == 0;
  }

 private:
  // Bit i of each: axis i.
  uint32_t unclamp_ = 0;   ///< the command is on
  uint32_t clamping_ = 0;  ///< the command is off, but the answer is still on
  uint32_t away_ = 0;      ///< the axis, whose command is on, may stand where it cannot be clamped
};

}  // namespace nc
