// SPDX-License-Identifier: Apache-2.0
// The way to rest along a plan when the planner does not answer. The time of the plan goes ever more slowly: tau' = sigma(t) falls from 1 to 0 in
// steps of constant sigma''. In each step sigma'' is as low as the limits of the axes allow at both ends of the step, so that the next state is
// allowed, too; the last part has the constant sigma'' that ends at rest (docs/motion-optimal.md, "When the feeder is silent").
#pragma once

#include <cmath>
#include <cstdint>

#include "motion/optimal/peaks.hpp"
#include "motion/optimal/piece.hpp"

namespace nc {

/// The plan at one moment of its time: the path, and the derivatives of the path length u by time.
struct PlanMoment {
  CurvePoint path;
  double v = 0, a = 0, j = 0;  ///< mm/s, mm/s^2, mm/s^3
  bool rests = false;  ///< the moment lies behind the end of the plan
};

/// How fast the time of the plan goes: sigma, and its derivative (1/s).
struct PlanPace {
  double sigma = 1, slope = 0;
};

class Brake {
 public:
  /// Finds a way to rest from `pace`. `plan` gives later and later moments of the plan (PlanAhead). @param use  share of what the limits leave
  /// @param longest  it takes no more than so many times the time of a stop on a line
  template <class Plan>
  bool find(Plan plan, const optimal::Limits& limits, double use, PlanPace pace = {}, double longest = HUGE_VAL) NC_RT {
    count_ = 0;
    from_ = pace;
    State x{0, pace.sigma, pace.slope};
    look_[0].plan = plan.at(0.0);
    const double soonest = soonest_for(look_[0].plan, limits, pace);
    if (soonest < kNothing) return begin_at_rest();
    step_ = std::fmin(step_for(look_[0].plan, limits, pace.sigma), kOfSoonest * soonest);
    at_once_ = std::fmin(kAtOnce, kOfStep * step_);
    most_ = static_cast<uint16_t>(std::fmin(kSteps, std::ceil(longest * stop_on_line(look_[0].plan, limits, pace.sigma) / step_)));
    while (count_ < most_) {
      const Plan here = plan;
      if (!gather(plan, x, 0, step_)) return false;
      if (rests_) return keeps(x, 0, limits) <= 1 && begin();  // the plan itself comes to rest here
      if (jerk_to_land(x, look_[0].plan, limits) > use * kLanding) return land(here, limits, x);
      double bend = 0;
      if (!chooses(here, &plan, limits, use, x, &bend)) return lands_sooner(here, limits, x);
      bend_[count_++] = bend;
      x.step(bend, step_);
      look_[0].plan = plan.at(x.tau);
    }
    return false;
  }

  /// Goes on for `time` seconds. @return by how many seconds the time of the plan goes on.
  double advance(double time) NC_RT {
    const double from = now_.tau;
    while (time > 0 && at_ < count_) {
      const double left = (at_ + 1 == count_ ? last_ : step_) - in_step_, part = std::fmin(time, left);
      now_.step(bend_[at_], part);
      time -= part;
      in_step_ += part;
      if (part == left) ++at_, in_step_ = 0;
    }
    if (at_ == count_ && !lands_ && time > 0) {  // to the end of the plan, which comes before sigma is 0
      const double most = now_.slope < 0 ? -now_.sigma / now_.slope : time;
      now_.step(0, std::fmin(time, most));
      if (now_.slope < 0 && !(time < most)) now_.tau += kRounding;
    }
    return std::fmax(0, now_.tau - from);
  }
  /// The braking has come to rest.
  bool done() const { return lands_ && at_ == count_; }
  double sigma() const { return std::fmax(0, now_.sigma); }

 private:
  static constexpr unsigned kSteps = 512;
  static constexpr unsigned kLooks = 16;    ///< the most moments that are looked at in a step
  static constexpr double kLongest = 0.00125, kShortest = 0.00025;  ///< longest and shortest step, s
  static constexpr double kOfRise = 0.25;   ///< a step takes this share of the time in which the acceleration rises to its limit
  static constexpr double kOfSoonest = 0.25;  ///< it takes at most this share of the time in which axes that only jerk limits would stand
  static constexpr double kNothing = 1e-6;  ///< s: axes that could stand within this time count as standing; it is the shortest cycle
  static constexpr double kSteady = 0.75;   ///< a stop on a line may take at most this share of kSteps
  static constexpr double kShare = 1.0005;  ///< share of the limit of acceleration that may be used; the plan may use as much
  static constexpr double kJerk = 0.995;    ///< share of the limit of jerk: a cell of the plan may begin and end between two moments that are looked at
  static constexpr double kMostAcceleration = 1.0009;  ///< largest share of the limit anywhere in a step, since measured shares are to be below 1.001
  static constexpr unsigned kTighter = 4;   ///< how many times a step is chosen anew with tighter limits
  static constexpr double kFurther = 1.5;   ///< limits are tightened by this multiple of what was too much
  static constexpr double kLanding = 0.5;   ///< share of the jerk limits above which the landing has to begin
  static constexpr double kTiny = 1e-9;     ///< a factor below this, mm/s or deg/s, counts as 0
  static constexpr double kAtOnce = 1e-6, kOfStep = 0.01;  ///< moments count as the same one within this time, s, and within this share of a step
  static constexpr double kRounding = 1e-9; ///< s, so that rounding does not leave the plan short of its end

  struct State {
    double tau = 0, sigma = 1, slope = 0;
    /// The state `t` later, but with tau and the slope of now.
    State behind(double bend, double t) const { return {tau, sigma + t * (slope + t * bend / 2), slope}; }
    double tau_behind(double bend, double t) const { return tau + t * (sigma + t * (slope / 2 + t * bend / 6)); }
    void step(double bend, double t) {
      tau = tau_behind(bend, t);
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

  /// Seconds of one step of the search: a share kOfRise of the time in which the acceleration of an axis can rise to its limit, or more where the way to rest
  /// would take too many such steps.
  static double step_for(const PlanMoment& now, const optimal::Limits& limits, double sigma) NC_RT {
    double rise = HUGE_VAL;
    for (unsigned i = 0; i < limits.axis_count; ++i)
      if (limits.acceleration[i] > 0 && limits.jerk[i] > 0) rise = std::fmin(rise, limits.acceleration[i] / limits.jerk[i]);
    const double stop = stop_on_line(now, limits, sigma);
    return std::fmin(kLongest, std::fmax(std::fmin(kOfRise * rise, kLongest), std::fmax(kShortest, stop / (kSteady * kSteps))));
  }
  /// Seconds of a stop on a line, whatever the acceleration is that it begins with.
  static double stop_on_line(const PlanMoment& now, const optimal::Limits& limits, double sigma) NC_RT {
    double stop = 0;
    for (unsigned i = 0; i < limits.axis_count; ++i)
      if (limits.acceleration[i] > 0 && limits.jerk[i] > 0)
        stop = std::fmax(stop, std::fabs(now.path.d1[i] * now.v * sigma) / limits.acceleration[i] + 2 * limits.acceleration[i] / limits.jerk[i]);
    return stop;
  }
  /// Seconds in which the axes would come to rest if only jerk was limited: first the acceleration goes to 0, then the velocity in two halves. A step has
  /// to be shorter than that, or the lowest sigma'' that the limits allow would lead beyond rest.
  static double soonest_for(const PlanMoment& now, const optimal::Limits& limits, const PlanPace& pace) NC_RT {
    const double u1 = now.v * pace.sigma, u2 = now.a * pace.sigma * pace.sigma + now.v * pace.slope;
    double t = 0;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      if (!(limits.jerk[i] > 0)) continue;
      const double a = std::fabs(now.path.d1[i] * u2 + now.path.d2[i] * u1 * u1), v = std::fabs(now.path.d1[i] * u1);
      t = std::fmax(t, a / limits.jerk[i] + 2 * std::sqrt(v / limits.jerk[i]));
    }
    return t;
  }
  struct Look {
    PlanMoment plan;
    double t = 0;  ///< s behind the start of the step
  };

  /// Collects the moments of the plan that are looked at in a step. The first is at its beginning and given; then come its middle and end, and both
  /// sides of each place where a cell of the plan ends, because the jerk changes there. False when there are too many.
  template <class Plan>
  bool gather(Plan& plan, const State& x, double bend, double step) NC_RT {
    const double middle = x.tau_behind(bend, step / 2), end = x.tau_behind(bend, step);
    rests_ = look_[0].plan.rests;
    looks_ = 1;
    look_[0].t = 0;
    entered_ = x.tau;
    for (double to = middle; !rests_;) {
      const double edge = plan.cell_end();
      if (edge < to) {
        if (looks_ + 2 > kLooks) return false;
        const double t = std::fmax(look_[looks_ - 1].t, std::fmin(step, time_of(x, bend, step, edge)));
        look_[looks_++] = {plan.at_cell_end(), t};
        look_[looks_++] = {plan.at_next_cell(), t};
        rests_ = look_[looks_ - 1].plan.rests;
        entered_ = edge;
        continue;
      }
      if (looks_ + 1 > kLooks) return false;
      look_[looks_++] = {plan.at(to), to == end ? step : step / 2};
      rests_ = look_[looks_ - 1].plan.rests;
      if (to == end) break;
      to = end;
    }
    return true;
  }
  /// Chooses sigma'' of a step whose moments were collected for a steady pace. `here` is the plan at the beginning of the step, and `plan` becomes the
  /// plan at its end.
  template <class Plan>
  bool chooses(const Plan& here, Plan* plan, const optimal::Limits& limits, double use, const State& x, double* bend) NC_RT {
    if (!choose(x, limits, use, bend)) return false;
    // With this sigma'' the step ends at another time of the plan. If that is in another cell, the moments are collected again.
    for (unsigned n = 0; misses(*plan, x, *bend); ++n) {
      if (n == kTighter) return false;
      *plan = here;
      if (!gather(*plan, x, *bend, step_) || rests_ || !choose(x, limits, use, bend)) return false;
    }
    State next = x;
    next.step(*bend, step_);
    return next.sigma > 0 && (next.slope >= 0 || jerk_to_land(next, look_[looks_ - 1].plan, limits) <= kJerk);
  }
  /// With this sigma'' the step does not end in the cell of the last moment that was collected.
  template <class Plan>
  bool misses(const Plan& plan, const State& x, double bend) const NC_RT {
    const double end = x.tau_behind(bend, step_);
    return end >= plan.cell_end() || end < entered_;
  }
  /// The time within the step at which the time of the plan is tau.
  static double time_of(const State& x, double bend, double step, double tau) NC_RT {
    double t = step * (tau - x.tau) / (x.tau_behind(bend, step) - x.tau);
    for (unsigned n = 0; n < 2; ++n) t += (tau - x.tau_behind(bend, t)) / (x.sigma + t * (x.slope + t * bend / 2));
    return t;
  }

  /// sigma'' of the step that is looked at. Where a limit is exceeded between two moments, it is chosen again with both limits lowered by as much.
  bool choose(const State& x, const optimal::Limits& limits, double use, double* bend) NC_RT {
    double share = 1;
    for (unsigned n = 0; n < kTighter; ++n) {
      if (!least(x, limits, use, share, bend)) return false;
      const double most = keeps(x, *bend, limits);
      if (most <= 1) return true;
      share /= 1 + kFurther * (most - 1);
    }
    return false;
  }
  /// The lowest sigma'' that the limits allow at the moments looked at; false where they allow none.
  bool least(const State& x, const optimal::Limits& limits, double use, double share, double* out) NC_RT {
    Range r;
    double bend = 0;
    for (unsigned pass = 0; pass < 2; ++pass) {  // the second pass knows how sigma changes within the step
      r = {};
      for (unsigned n = 0; n < looks_; ++n) {
        const State then = x.behind(bend, look_[n].t);
        jerk_range(look_[n].plan, limits, then, look_[n].t, share, &r);
        acceleration_range(look_[n].plan, limits, then, look_[n].t, use, share, &r);
      }
      bend = std::fmin(r.low < 0 ? use * r.low : r.low, r.high);
    }
    if (x.slope + bend * step_ > 0) bend = -x.slope / step_;
    *out = bend;
    return bend >= r.low && bend <= r.high;
  }

  using Rates = optimal::Rates;
  using Peaks = optimal::Peaks;
  static Rates rates(const PlanMoment& p, const State& x, double bend, unsigned i) NC_RT {
    const double u1 = p.v * x.sigma, u2 = p.a * x.sigma * x.sigma + p.v * x.slope;
    const double u3 = p.j * x.sigma * x.sigma * x.sigma + 3 * p.a * x.sigma * x.slope + p.v * bend;
    return {p.path.d1[i] * u2 + p.path.d2[i] * u1 * u1, p.path.d1[i] * u3 + 3 * p.path.d2[i] * u1 * u2 + p.path.d3[i] * u1 * u1 * u1};
  }
  /// The largest acceleration or jerk of an axis in the step with this sigma'', as a share of its limit. Between two moments nothing jumps, because both
  /// sides of each jump are looked at: there the acceleration is taken as the cubic with the values and slopes (jerks) at both moments.
  double keeps(const State& x, double bend, const optimal::Limits& limits) const NC_RT {
    double most = 0;
    for (unsigned n = 1; n < looks_; ++n) {
      const double t = look_[n].t - look_[n - 1].t;
      if (!(t > at_once_) || look_[n].plan.rests) continue;
      State from = x, to = x;
      from.step(bend, look_[n - 1].t);
      to.step(bend, look_[n].t);
      for (unsigned i = 0; i < limits.axis_count; ++i) {
        const Peaks peaks = optimal::peaks_between(rates(look_[n - 1].plan, from, bend, i), rates(look_[n].plan, to, bend, i), t);
        if (limits.acceleration[i] > 0) most = std::fmax(most, peaks.a / (kMostAcceleration * limits.acceleration[i]));
        if (limits.jerk[i] > 0) most = std::fmax(most, peaks.j / limits.jerk[i]);
      }
    }
    return most;
  }

  /// Narrows the range of sigma'' to what the limits of jerk allow `behind` seconds after the beginning of the step. x.slope is sigma' at the beginning.
  static void jerk_range(const PlanMoment& p, const optimal::Limits& limits, const State& x, double behind, double share, Range* r) NC_RT {
    const double sigma = x.sigma, slope = x.slope;
    const double u1 = p.v * sigma, u2 = p.a * sigma * sigma + p.v * slope, u3 = p.j * sigma * sigma * sigma + 3 * p.a * sigma * slope;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      if (!(limits.jerk[i] > 0)) continue;
      r->keep(p.path.d1[i] * u3 + 3 * p.path.d2[i] * u1 * u2 + p.path.d3[i] * u1 * u1 * u1,
              p.path.d1[i] * p.v + 3 * behind * sigma * (p.path.d1[i] * p.a + p.path.d2[i] * p.v * p.v), share * kJerk * limits.jerk[i]);
    }
  }
  /// Narrows the range of sigma'' to what the limits of acceleration allow `behind` seconds after the beginning, where sigma' was x.slope.
  void acceleration_range(const PlanMoment& p, const optimal::Limits& limits, const State& x, double behind, double use, double share, Range* r) const NC_RT {
    Range slopes;
    const bool now = behind < at_once_;  // too soon for sigma'' to change anything
    const double most = now ? kShare : share * kShare;
    const double sigma2 = x.sigma * x.sigma;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      if (!(limits.acceleration[i] > 0)) continue;
      slopes.keep(p.path.d1[i] * p.a * sigma2 + p.path.d2[i] * p.v * p.v * sigma2, p.path.d1[i] * p.v, most * limits.acceleration[i]);
    }
    if (now) {
      if (!(x.slope >= slopes.low) || !(x.slope <= slopes.high)) r->low = HUGE_VAL;
      return;
    }
    const double low = slopes.low < 0 ? use * slopes.low : slopes.low;
    r->low = std::fmax(r->low, (low - x.slope) / behind);
    r->high = std::fmin(r->high, (slopes.high - x.slope) / behind);
  }
  /// Jerk of the constant sigma'' that ends at rest from here, as a share of the limits of the axes.
  static double jerk_to_land(const State& x, const PlanMoment& p, const optimal::Limits& limits) NC_RT {
    const double bend = x.slope * x.slope / (2 * x.sigma);
    double share = 0;
    for (unsigned i = 0; i < limits.axis_count; ++i)
      if (limits.jerk[i] > 0) share = std::fmax(share, bend * std::fabs(p.path.d1[i] * p.v) / limits.jerk[i]);
    return share;
  }
  /// For a step that would lead beyond rest, or to where the landing would exceed the limits: lands from its beginning, which needs less.
  template <class Plan>
  bool lands_sooner(const Plan& here, const optimal::Limits& limits, const State& x) NC_RT {
    return x.slope < 0 && land(here, limits, x);
  }
  template <class Plan>
  bool land(Plan plan, const optimal::Limits& limits, State x) NC_RT {
    const double bend = x.slope * x.slope / (2 * x.sigma);
    double left = -2 * x.sigma / x.slope;
    while (count_ < most_) {
      last_ = std::fmin(left, step_);
      bend_[count_++] = bend;
      look_[0].plan = plan.at(x.tau);
      if (!gather(plan, x, bend, last_)) return false;
      if (keeps(x, bend, limits) > 1) return false;
      if (rests_) return begin();
      for (unsigned n = 0; n < looks_; ++n) {
        State then = x;
        then.step(bend, look_[n].t);
        Range bends;
        jerk_range(look_[n].plan, limits, then, 0, 1, &bends);
        acceleration_range(look_[n].plan, limits, then, 0, 1, 1, &bends);
        if (!(bend >= bends.low) || !(bend <= bends.high)) return false;
      }
      x.step(bend, last_);
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
  bool begin_at_rest() {
    from_ = {0, 0};
    return begin() && (lands_ = true);
  }

  Look look_[kLooks];
  unsigned looks_ = 0;
  double entered_ = 0;      ///< time of the plan at which the cell of the last moment begins, or the step, whichever is later
  bool rests_ = false;      ///< the plan comes to rest in the step that is looked at
  uint16_t most_ = kSteps;  ///< steps that the way to rest may take
  double bend_[kSteps] = {};
  unsigned count_ = 0, at_ = 0;
  double step_ = kLongest, at_once_ = kAtOnce;
  double last_ = kLongest;  ///< length of the last step, s
  double in_step_ = 0;      ///< s of the step in execution that have passed
  bool lands_ = false;      ///< true: it ends at rest with sigma = 0; false: at the end of the plan
  State now_;
  PlanPace from_;
};

}  // namespace nc
