// SPDX-License-Identifier: Apache-2.0
// The commanded speeds of the spindles of a part system: the S code, or the speed at which the surface at the tool has a constant speed, within the
// clamp (M700 10.3, 10.4). Also the commanded directions, where the program has given one, and which spindles are selected (M700 10.6.1).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "stream/stream.hpp"

namespace nc {

class SpindleSpeeds {
 public:
  void create(unsigned count) { count_ = count; }
  unsigned count() const { return count_; }

  /// M700 10.6.1 (1): bit n of `selected`: spindle n+1 follows the commands; the others keep their speeds.
  void select(uint8_t selected) {
    selected_ = selected;
    if (selected != 0) lead_ = static_cast<unsigned>(std::countr_zero(selected));
  }
  uint8_t selected() const { return selected_; }
  /// The first of the selected spindles, counted from 0; while none is selected, the one that was the first before.
  unsigned lead() const { return lead_; }

  void command(double rev_min) { code_ = rev_min; }
  void turn(SpindleTurn how) {
    for (unsigned i = 0; i < count_ && how != SpindleTurn::as_it_is; ++i)
      if (how == SpindleTurn::stop_all || (selected_ >> i & 1) != 0) direction_[i] = how;
  }
  /// The spindle, counted from 0, turns in the direction opposite to the one commanded. A spindle without a commanded direction may turn either way.
  bool turns_wrong(unsigned spindle, double rev_per_s) const {
    return rev_per_s != 0 && direction_[spindle] == (rev_per_s > 0 ? SpindleTurn::reverse : SpindleTurn::forward);
  }
  /// Constant surface speed of `m_min`, m/min, at the radius that an axis gives: the lowest bit n of `axes` names axis n. No bit: there is no constant
  /// surface speed any more, and the speed stays as it is until the next S code.
  void surface(double m_min, uint32_t axes) {
    const unsigned axis = axes == 0 ? 0 : static_cast<unsigned>(std::countr_zero(axes)) + 1u;
    if (axis == 0 && axis_ != 0) code_ = spindle_[lead_].now;
    m_min_ = m_min;
    axis_ = axis;
  }
  /// The radius at the present coordinate of the axis that the lowest bit of `axes` names; from here on the coordinates of that axis are diameters.
  void surface_radius(double radius_mm, uint32_t axes) {
    if (axes == 0) return;
    radius_axis_ = static_cast<unsigned>(std::countr_zero(axes)) + 1u;
    radius_mm_ = radius_mm;
    radius_waits_ = true;
  }
  /// G92 S Q of the selected spindles (M700 10.6.1, relation (1)); `how`: nc_clamp_bits. Without S and Q no spindle is clamped any more.
  void clamp(uint32_t s, uint32_t q, uint32_t how) {
    const bool any = (how & (NC_CLAMP_S | NC_CLAMP_Q)) != 0;
    for (unsigned i = 0; i < count_; ++i) {
      if (any && (selected_ >> i & 1) == 0) continue;
      Spindle& spindle = spindle_[i];
      if (!any) spindle = {.now = spindle.now};
      if ((how & NC_CLAMP_S) != 0) {
        spindle.s = s;
        spindle.has_s = true;
      }
      if ((how & NC_CLAMP_Q) != 0) spindle.q = q;
      spindle.how = how;
    }
  }
  /// A reset: G97, no clamp unless a reset keeps it, and no commanded direction. Spindles that turn go on with their speeds.
  void reset() {
    std::fill_n(direction_, NC_MAX_SPINDLES, SpindleTurn::as_it_is);
    surface(0, 0);
    radius_axis_ = 0;
    for (Spindle& spindle : spindle_)
      if ((spindle.how & NC_CLAMP_OVER_RESET) == 0) spindle = {.now = spindle.now};
  }

  /// Calculates the speeds for this cycle. `coordinate(axis)`: workpiece coordinate in mm of an axis counted from 0. The radius counts as
  /// kSmallestRadius at least, because the speed would be infinite at the centre.
  template <class Coordinate>
  void update(const Coordinate& coordinate) NC_RT {
    double wanted = code_;
    if (radius_waits_) {
      radius_at_ = coordinate(radius_axis_ - 1);
      radius_waits_ = false;
    }
    if (axis_ != 0) {
      const double at = coordinate(axis_ - 1);
      const double radius = axis_ == radius_axis_ ? radius_mm_ + (at - radius_at_) / 2 : at;
      wanted = 1000 * m_min_ / (2 * std::numbers::pi * std::max(std::fabs(radius), kSmallestRadius));
    }
    for (unsigned i = 0; i < count_; ++i)
      if ((selected_ >> i & 1) != 0) spindle_[i].now = clamped(spindle_[i], wanted);
  }
  /// r/min of a spindle, counted from 0.
  double now(unsigned spindle) const { return spindle_[spindle].now; }
  /// The speed that the S command means, r/min: that of the selected spindle; the S code while no spindle is selected.
  double commanded() const { return selected_ != 0 ? spindle_[lead_].now : code_; }

 private:
  static constexpr double kSmallestRadius = 1e-3;  // mm

  struct Spindle {
    double now = 0;
    bool has_s = false;
    uint32_t s = 0, q = 0, how = 0;  ///< clamp as programmed
  };

  double clamped(const Spindle& spindle, double speed) const {
    if (axis_ == 0 && (spindle.how & NC_CLAMP_ALWAYS) == 0) return speed;
    // M700 10.4, precaution (1): an S that was commanded, be it S0, and is smaller than Q changes places with it. Without an S there is no upper
    // clamp, and Q is the lower one.
    const uint32_t high = spindle.has_s ? std::max(spindle.s, spindle.q) : 0;
    const uint32_t low = spindle.has_s ? std::min(spindle.s, spindle.q) : spindle.q;
    if (high != 0) speed = std::min(speed, static_cast<double>(high));
    return speed > 0 ? std::max(speed, static_cast<double>(low)) : speed;
  }

  unsigned count_ = 1, lead_ = 0;
  uint8_t selected_ = 1;
  double code_ = 0, m_min_ = 0;
  unsigned axis_ = 0;
  unsigned radius_axis_ = 0;  ///< axis, from 1, whose radius has been given; 0 = none
  bool radius_waits_ = false; ///< its coordinate there is still to be taken
  double radius_mm_ = 0, radius_at_ = 0;
  Spindle spindle_[NC_MAX_SPINDLES];
  SpindleTurn direction_[NC_MAX_SPINDLES] = {};
};

}  // namespace nc
