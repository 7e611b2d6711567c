// SPDX-License-Identifier: Apache-2.0
// The way to rest along a plan whose maker is silent: the time of the plan goes ever slower, tau' = sigma(t), from 1 to 0 in steps of
// constant sigma''. In each step it is as low as the limits of the axes leave at both ends of the step, which makes the next state
// allowed, too; the last part has the constant sigma'' that ends at rest (docs/motion-optimal.md, "When the feeder is silent").
#pragma once

#include <cmath>

#include "motion/optimal/piece.hpp"

namespace nc {

/// The plan at one moment of its time: the path, and u by time.
struct PlanMoment {
  CurvePoint path;
  double v = 0, a = 0, j = 0;
  bool rests = false;  ///< behind its end
};

/// How fast the time of the plan goes, and how that changes.
struct PlanPace {
  double sigma = 1, slope = 0;
};

class Brake {
 public:
  /// Finds a way to rest from `pace`. `plan(tau)` tells of ever later moments, 0 = now. @param use  of what the limits leave
  template <class Plan>
  bool find(Plan&& plan, const optimal::Limits& limits, double use, PlanPace pace = {}) NC_RT {
    count_ = 0;
    from_ = pace;
    State x{0, pace.sigma, pace.slope};
    PlanMoment now = plan(0.0);
    while (count_ < kSteps) {
      const double ahead = kStep * (x.sigma + 0.5 * kStep * x.slope);
      const PlanMoment middle = plan(x.tau + 0.5 * ahead), then = plan(x.tau + ahead);
      if (now.rests || then.rests) return begin();  // it stands there anyway
      if (lands(x, now, limits, use)) return land(plan, limits, x);
      Range r;
      double bend = 0;
      for (unsigned pass = 0; pass < 2; ++pass) {  // the second one knows how sigma goes on
        r = {};
        jerk_range(now, limits, x, 0, &r);
        jerk_range(middle, limits, x.behind(bend, 0.5 * kStep), 0.5 * kStep, &r);
        const State end = x.behind(bend, kStep);
        jerk_range(then, limits, end, kStep, &r);
        acceleration_range(then, limits, end.sigma, x.slope, use, &r);
        bend = std::fmin(r.low < 0 ? use * r.low : r.low, r.high);
      }
      if (x.slope + bend * kStep > 0) bend = -x.slope / kStep;
      if (!(bend >= r.low) || !(bend <= r.high)) return false;
      bend_[count_++] = bend;
      x.step(bend, kStep);
      if (!(x.sigma > 0)) return false;
      now = plan(x.tau);
    }
    return false;
  }

  /// Goes on for `time` seconds. @return seconds of the plan.
  double advance(double time) NC_RT {
    const double from = now_.tau;
    while (time > 0 && at_ < count_) {
      const double left = (at_ + 1 == count_ ? last_ : kStep) - in_step_, part = std::fmin(time, left);
      now_.step(bend_[at_], part);
      time -= part;
      in_step_ += part;
      if (part == left) ++at_, in_step_ = 0;
    }
    if (at_ == count_ && !lands_) now_.step(0, time);
    return std::fmax(0, now_.tau - from);
  }
  /// At rest.
  bool done() const { return lands_ && at_ == count_; }
  double sigma() const { return std::fmax(0, now_.sigma); }

 private:
  static constexpr unsigned kSteps = 512;
  static constexpr double kStep = 0.00125;  ///< s
  static constexpr double kShare = 1.0005;  ///< of the acceleration, which the plan may use, too
  static constexpr double kJerk = 0.995;    ///< of the jerk: between the places that are looked at a cell of the plan may begin and end
  static constexpr double kLanding = 0.5;   ///< of the jerk limits, where there is nothing else
  static constexpr double kTiny = 1e-9;     ///< of velocity

  struct State {
    double tau = 0, sigma = 1, slope = 0;
    /// Its sigma `t` later, the slope of now.
    State behind(double bend, double t) const { return {tau, sigma + t * (slope + t * bend / 2), slope}; }
    void step(double bend, double t) {
      tau += t * (sigma + t * (slope / 2 + t * bend / 6));
      sigma += t * (slope + t * bend / 2);
      slope += t * bend;
    }
  };
  struct Range {
    double low = -HUGE_VAL, high = HUGE_VAL;
    /// |constant + factor x| <= most.
    void keep(double constant, double factor, double most) {
      if (std::fabs(factor) < kTiny) {
        if (std::fabs(constant) > most) low = HUGE_VAL;
        return;
      }
      const double a = (-most - constant) / factor, b = (most - constant) / factor;
      low = std::fmax(low, std::fmin(a, b));
      high = std::fmin(high, std::fmax(a, b));
    }
  };

  /// What jerk allows sigma'' to be, `behind` seconds after sigma' was `slope`.
  static void jerk_range(const PlanMoment& p, const optimal::Limits& limits, const State& x, double behind, Range* r) NC_RT {
    const double sigma = x.sigma, slope = x.slope;
    const double u1 = p.v * sigma, u2 = p.a * sigma * sigma + p.v * slope, u3 = p.j * sigma * sigma * sigma + 3 * p.a * sigma * slope;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      if (!(limits.jerk[i] > 0)) continue;
      r->keep(p.path.d1[i] * u3 + 3 * p.path.d2[i] * u1 * u2 + p.path.d3[i] * u1 * u1 * u1,
              p.path.d1[i] * p.v + 3 * behind * sigma * (p.path.d1[i] * p.a + p.path.d2[i] * p.v * p.v), kJerk * limits.jerk[i]);
    }
  }
  /// What acceleration at the end of the step allows it to be.
  static void acceleration_range(const PlanMoment& p, const optimal::Limits& limits, double sigma, double slope, double use, Range* r) NC_RT {
    Range slopes;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      if (!(limits.acceleration[i] > 0)) continue;
      slopes.keep(p.path.d1[i] * p.a * sigma * sigma + p.path.d2[i] * p.v * p.v * sigma * sigma, p.path.d1[i] * p.v,
                  kShare * limits.acceleration[i]);
    }
    const double low = slopes.low < 0 ? use * slopes.low : slopes.low;
    r->low = std::fmax(r->low, (low - slope) / kStep);
    r->high = std::fmin(r->high, (slopes.high - slope) / kStep);
  }
  /// sigma'' that ends at rest from here is as much as the axes can have.
  static bool lands(const State& x, const PlanMoment& p, const optimal::Limits& limits, double use) NC_RT {
    const double bend = x.slope * x.slope / (2 * x.sigma);
    for (unsigned i = 0; i < limits.axis_count; ++i)
      if (limits.jerk[i] > 0 && bend * std::fabs(p.path.d1[i] * p.v) > use * kLanding * limits.jerk[i]) return true;
    return false;
  }
  template <class Plan>
  bool land(Plan&& plan, const optimal::Limits& limits, State x) NC_RT {
    const double bend = x.slope * x.slope / (2 * x.sigma);
    double left = -2 * x.sigma / x.slope;
    while (count_ < kSteps) {
      last_ = std::fmin(left, kStep);
      bend_[count_++] = bend;
      for (unsigned n = 0; n < 3; ++n) {
        const PlanMoment p = plan(x.tau);
        if (p.rests) return begin();
        Range jerks, slopes;
        jerk_range(p, limits, x, 0, &jerks);
        acceleration_range(p, limits, x.sigma, x.slope, 1, &slopes);
        if (!(bend >= jerks.low) || !(bend <= jerks.high) || !(slopes.low <= 0) || !(slopes.high >= 0)) return false;
        if (n < 2) x.step(bend, 0.5 * last_);
      }
      left -= last_;
      if (!(left > 0)) return begin() && (lands_ = true);
    }
    return false;
  }
  bool begin() {
    now_ = {0, from_.sigma, from_.slope};
    at_ = 0;
    in_step_ = 0;
    lands_ = false;
    return true;
  }

  double bend_[kSteps] = {};
  unsigned count_ = 0, at_ = 0;
  double last_ = kStep;     ///< s, of the last step
  double in_step_ = 0;
  bool lands_ = false;      ///< it ends at rest, else with the plan
  State now_;
  PlanPace from_;
};

}  // namespace nc
