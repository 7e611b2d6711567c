// SPDX-License-Identifier: Apache-2.0
// The filters of one axis. Each takes the way of a cycle and gives the way of a cycle; the way that it holds back is its lag. The commanded place is the
// interpolated one minus the lags, so an empty filter gives exactly the interpolated place, and rounding does not add up over several moves. Between
// two cycles the path is taken as straight, and each filter is exact for such a path.
#pragma once

#include <cmath>
#include <cstdint>

#include "nc/types.h"

namespace nc {

/// Mean of the path over a number of cycles: where the velocity of the path steps, that of the axis changes linearly.
class MeanFilter {
 public:
  /// `ring` has room for `cycles` values and is used by this filter only. With 0 cycles the way passes unchanged.
  void use(double* ring, uint32_t cycles) {
    ring_ = ring;
    cycles_ = cycles;
    per_cycle_ = cycles > 0 ? 1.0 / cycles : 0;
    empty();
  }
  void empty() {
    place_ = sum_ = rest_ = 0;
    at_ = filled_ = 0;
    quiet_ = cycles_;
  }
  /// @param way  way of this cycle  @return the way behind the filter
  double advance(double way) NC_RT {
    if (cycles_ == 0) return way;
    if (way != 0) {
      quiet_ = 0;
    } else if (quiet_ == cycles_) {
      return 0;
    } else {
      ++quiet_;
    }
    // The mean of a path of straight pieces is the mean of their middles.
    const double middle = place_ + 0.5 * way;
    place_ += way;
    double oldest = 0;
    if (filled_ == cycles_) {
      oldest = ring_[at_];
    } else {
      ++filled_;
    }
    ring_[at_] = middle;
    if (++at_ == cycles_) at_ = 0;
    add(middle);
    add(-oldest);
    const double out = (middle - oldest) * per_cycle_;
    if (quiet_ == cycles_) empty();
    return out;
  }
  bool settled() const { return quiet_ == cycles_; }
  double lag() const { return settled() ? 0 : place_ - (sum_ + rest_) * per_cycle_; }

 private:
  /// Adds to the sum, and keeps in rest_ what rounding takes from it: together they are exact to 100 bits however long the path goes on.
  void add(double x) {
    const double s = sum_ + x, part = s - sum_;
    rest_ += (sum_ - (s - part)) + (x - part);
    sum_ = s;
  }

  double* ring_ = nullptr;
  uint32_t cycles_ = 0, at_ = 0, filled_ = 0;
  uint32_t quiet_ = 0;      ///< number of cycles in a row without a way, up to cycles_
  double per_cycle_ = 0;
  double place_ = 0;        ///< way that has gone in since the filter was empty
  double sum_ = 0, rest_ = 0;
};

/// Lag of first order, l' = v - l / tau. When the path has come to rest the axis goes the rest of its way with a constant deceleration, which takes 2
/// tau (a lag of first order would never end): M700 7.7, exponential acceleration and linear deceleration.
class LagFilter {
 public:
  void use(double tau_s, double cycle_s) {
    tau_ = tau_s;
    cycle_ = cycle_s;
    if (tau_s > 0) {
      decay_ = std::exp(-cycle_s / tau_s);
      gain_ = -std::expm1(-cycle_s / tau_s) * tau_s / cycle_s;
    }
    empty();
  }
  void empty() { lag_ = from_ = time_ = 0, landing_ = false; }
  /// @param rests  true: no way comes any more until the filter has settled
  double advance(double way, bool rests) NC_RT {
    if (!(tau_ > 0)) return way;
    const double before = lag_;
    if (rests && way == 0) {
      if (lag_ != 0) land();
    } else {
      landing_ = false;
      lag_ = lag_ * decay_ + way * gain_;
    }
    return way + before - lag_;
  }
  bool settled() const { return lag_ == 0; }
  double lag() const { return lag_; }

 private:
  void land() {
    if (!landing_) from_ = lag_, time_ = 0, landing_ = true;
    time_ += cycle_;
    // From the speed lag / tau to 0 in 2 tau. A cycle that is short of the end only by rounding counts as the end.
    const double left = 1 - time_ / (2 * tau_);
    lag_ = left > 1e-9 ? from_ * left * left : 0;
    landing_ = lag_ != 0;
  }

  double tau_ = 0, cycle_ = 0, decay_ = 0, gain_ = 0;
  double lag_ = 0;
  double from_ = 0, time_ = 0;  ///< while it lands: lag when that began, and s since then
  bool landing_ = false;
};

/// A mean, and behind it another mean or a lag.
class AxisFilter {
 public:
  void use(double* ring, uint32_t mean, uint32_t second, double lag_s, double cycle_s) {
    first_.use(ring, mean);
    second_.use(ring + mean, second);
    lag_.use(lag_s, cycle_s);
  }
  void empty() {
    first_.empty();
    second_.empty();
    lag_.empty();
  }
  /// @return how far the axis is behind the interpolated place
  double advance(double way, bool rests) NC_RT {
    const double one = first_.advance(way);
    const double two = second_.advance(one);
    lag_.advance(two, rests && first_.settled() && second_.settled());
    return first_.lag() + second_.lag() + lag_.lag();
  }
  bool settled() const { return first_.settled() && second_.settled() && lag_.settled(); }

 private:
  MeanFilter first_, second_;
  LagFilter lag_;
};

}  // namespace nc
