// SPDX-License-Identifier: Apache-2.0
// The speeds that the spindles of a part system are wanted at: the S code, or so many revolutions that the surface at the tool goes with
// a constant speed, within the clamp (M700 10.3, 10.4); which way round, where the program has said it; and which of the spindles that is for (M700 10.6.1).
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

  /// M700 10.6.1 (1): bit n: spindle n+1 follows what is commanded; the others keep the speed that they have.
  void select(uint8_t selected) {
    selected_ = selected;
    if (selected != 0) lead_ = static_cast<unsigned>(std::countr_zero(selected));
  }
  uint8_t selected() const { return selected_; }
  /// The first of the selected spindles; while none is selected, the one that was last.
  unsigned lead() const { return lead_; }

  void command(double rev_min) { code_ = rev_min; }
  void turn(SpindleTurn how) {
    for (unsigned i = 0; i < count_ && how != SpindleTurn::as_it_is; ++i)
      if (how == SpindleTurn::stop_all || (selected_ >> i & 1) != 0) direction_[i] = how;
  }
  /// The spindle, counted from 0, turns the other way round than the program has said. What it has not said may be either way.
  bool turns_wrong(unsigned spindle, double rev_per_s) const {
    return rev_per_s != 0 && direction_[spindle] == (rev_per_s > 0 ? SpindleTurn::reverse : SpindleTurn::forward);
  }
  /// m/min around the coordinate of `axis` (from 1); 0 = the speed stays what it is until the next code.
  void surface(double m_min, uint32_t axes) {
    const unsigned axis = axes == 0 ? 0 : static_cast<unsigned>(std::countr_zero(axes)) + 1u;
    if (axis == 0 && axis_ != 0) code_ = spindle_[lead_].now;
    m_min_ = m_min;
    axis_ = axis;
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
  /// G97 and no clamp; what turns goes on turning, and which way nobody has said any more.
  void reset() {
    std::fill_n(direction_, NC_MAX_SPINDLES, SpindleTurn::as_it_is);
    surface(0, 0);
    for (Spindle& spindle : spindle_)
      if ((spindle.how & NC_CLAMP_OVER_RESET) == 0) spindle = {.now = spindle.now};
  }

  /// `coordinate(axis)`: workpiece coordinate in mm of an axis counted from 0. No speed is as high as one around the centre.
  template <class Coordinate>
  void update(const Coordinate& coordinate) NC_RT {
    double wanted = code_;
    if (axis_ != 0) wanted = 1000 * m_min_ / (2 * std::numbers::pi * std::max(std::fabs(coordinate(axis_ - 1)), kSmallestRadius));
    for (unsigned i = 0; i < count_; ++i)
      if ((selected_ >> i & 1) != 0) spindle_[i].now = clamped(spindle_[i], wanted);
  }
  /// r/min of a spindle, counted from 0.
  double now(unsigned spindle) const { return spindle_[spindle].now; }
  /// What the S command stands for: the speed of the selected spindle; of none the code.
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
    // M700 10.4, precaution (1): where the S that was commanded, if only S0, is smaller than Q the two change places. Without an S there is
    // no upper clamp, and Q is the lower one.
    const uint32_t high = spindle.has_s ? std::max(spindle.s, spindle.q) : 0;
    const uint32_t low = spindle.has_s ? std::min(spindle.s, spindle.q) : spindle.q;
    if (high != 0) speed = std::min(speed, static_cast<double>(high));
    return speed > 0 ? std::max(speed, static_cast<double>(low)) : speed;
  }

  unsigned count_ = 1, lead_ = 0;
  uint8_t selected_ = 1;
  double code_ = 0, m_min_ = 0;
  unsigned axis_ = 0;
  Spindle spindle_[NC_MAX_SPINDLES];
  SpindleTurn direction_[NC_MAX_SPINDLES] = {};
};

}  // namespace nc
