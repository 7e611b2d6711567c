// SPDX-License-Identifier: Apache-2.0
// The speed that the spindle is wanted at: the S code, or so many revolutions that the surface at the tool goes with a constant speed,
// within the clamp (M700 10.3, 10.4).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stream/stream.hpp"

namespace nc {

class SpindleSpeed {
 public:
  void command(double rev_min) { code_ = rev_min; }
  /// m/min around the coordinate of `axis` (from 1); 0 = the speed stays what it is until the next code.
  void surface(double m_min, unsigned axis) {
    if (axis == 0 && axis_ != 0) code_ = now_;
    m_min_ = m_min;
    axis_ = axis;
  }
  /// `how`: bit 0 in G97 too, bit 1 a reset keeps it.
  void clamp(uint32_t low, uint32_t high, uint32_t how) {
    low_ = low;
    high_ = high;
    how_ = how;
  }
  /// G97 and no clamp; what turns goes on turning.
  void reset() {
    surface(0, 0);
    if ((how_ & 2) == 0) clamp(0, 0, 0);
  }

  /// `coordinate(axis)`: workpiece coordinate in mm of an axis counted from 0. No speed is as high as one around the centre.
  template <class Coordinate>
  double now(const Coordinate& coordinate) NC_RT {
    double speed = code_;
    if (axis_ != 0) speed = 1000 * m_min_ / (2 * std::numbers::pi * std::max(std::fabs(coordinate(axis_ - 1)), kSmallestRadius));
    if (axis_ != 0 || (how_ & 1) != 0) {
      if (high_ != 0) speed = std::min(speed, static_cast<double>(high_));
      if (speed > 0) speed = std::max(speed, static_cast<double>(low_));
    }
    return now_ = speed;
  }

 private:
  static constexpr double kSmallestRadius = 1e-3;  // mm

  double code_ = 0, m_min_ = 0, now_ = 0;
  unsigned axis_ = 0;
  uint32_t low_ = 0, high_ = 0;
  uint32_t how_ = 0;
};

}  // namespace nc
