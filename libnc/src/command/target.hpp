// SPDX-License-Identifier: Apache-2.0
// Where a block sends the axes: for each axis whether it is commanded, how its value is meant, and the value.
#pragma once

#include <bit>

#include "stream/stream.hpp"

namespace nc {

/// How the target of an axis is meant. A radius and an angle are polar coordinates in the plane; either may be absolute or an increment.
enum class TargetKind : uint8_t { omitted, absolute, incremental, radius, radius_increment, angle, angle_increment };

/// The targets of one block by axis, in mm or degrees.
class Targets {
 public:
  void clear() {
    for (TargetKind& kind : kind_) kind = TargetKind::omitted;
    axes_ = incremental_ = 0;
  }
  void set(unsigned axis, TargetKind kind, double value) {
    const uint32_t bit = 1u << axis;
    const bool counts_on = kind == TargetKind::incremental || kind == TargetKind::radius_increment || kind == TargetKind::angle_increment;
    axes_ |= bit;
    incremental_ = counts_on ? incremental_ | bit : incremental_ & ~bit;
    kind_[axis] = kind;
    value_[axis] = value;
  }
  /// The same targets without those of the axes whose bits are set.
  Targets without(uint32_t axes) const {
    Targets left = *this;
    left.axes_ &= ~axes;
    left.incremental_ &= ~axes;
    for (; axes != 0; axes &= axes - 1) left.kind_[std::countr_zero(axes)] = TargetKind::omitted;
    return left;
  }
  TargetKind kind(unsigned axis) const { return kind_[axis]; }
  /// The value of an axis that is commanded.
  double operator[](unsigned axis) const { return value_[axis]; }
  bool commands(unsigned axis) const { return (axes_ >> axis & 1) != 0; }
  /// The target of the axis counts on from where it is.
  bool counts_on(unsigned axis) const { return (incremental_ >> axis & 1) != 0; }
  /// Bit i: axis i is commanded, and by a target that counts on from where it is.
  uint32_t axes() const { return axes_; }
  uint32_t incremental() const { return incremental_; }

 private:
  TargetKind kind_[kMaxAxes] = {};
  uint32_t axes_ = 0, incremental_ = 0;   ///< follow from kind_: nearly every question is about several axes at once
  AxisVec value_;
};

}  // namespace nc
