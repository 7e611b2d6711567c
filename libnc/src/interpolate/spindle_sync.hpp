// SPDX-License-Identifier: Apache-2.0
// Threads of the optimal mode: the plan of a thread is followed by the turning of the spindle and not by the clock. Let tau be the time of the plan,
// and sigma = tau' how fast it goes. Then the motion of an axis Q(tau) has
//
//     velocity Q' sigma      acceleration Q'' sigma^2 + Q' sigma'      jerk Q''' sigma^3 + 3 Q'' sigma sigma' + Q' sigma''
//
// The plan uses only a share of the limits (ThreadShare); from what it leaves follows how large sigma' and sigma'' may be (docs/motion-optimal.md,
// "Threads"). So each angle of the spindle belongs to one place on the path, also while the axes accelerate and brake.
#pragma once

#include <algorithm>
#include <cmath>

#include "interpolate/brake.hpp"
#include "motion/optimal/piece.hpp"
#include "ring/record.hpp"

namespace nc {

class SpindleSync {
 public:
  /// The spindle and the path at the beginning of a step.
  struct Sample {
    double turns = 0;      ///< turns of the spindle at the end of the step, signed
    double rev_per_s = 0;  ///< speed of the spindle, rev/s, signed
    double u = 0, v = 0;   ///< place on the path, mm; and planned speed, mm per second of the plan
    double lead = 0;       ///< mm of path per revolution
  };
  /// The largest magnitude that sigma' (slope, 1/s) and sigma'' (bend, 1/s^2) may have.
  struct Reach {
    double slope = HUGE_VAL, bend = HUGE_VAL;
  };

  void create(double cycle_s) { pole_ = std::min(kPole, kPolePerCycle / cycle_s); }

  /// The plan begins now: at this angle of the spindle, planned for `planned` rev/s.
  void begin(double turns, double planned) NC_RT {
    turns_ = turns;
    planned_ = planned;
    tau_ = wanted_ = slope_ = 0;
    sigma_ = 1;
    locked_ = false;
  }

  /// Goes on for `time` seconds. @return by how many seconds the time of the plan goes on.
  double advance(double time, const Sample& s, const Reach& reach) NC_RT {
    if (s.v >= kAtPace * s.lead * planned_) {  // at speed the place on the path counts; kAtPace allows for a law that is not quite exact
      if (!locked_) origin_ = turns_ - std::copysign(s.u / s.lead, s.rev_per_s);
      locked_ = true;
      wanted_ = tau_ + (s.lead * std::fabs(turns_ - origin_) - s.u) / s.v;
    } else {
      locked_ = false;
    }
    const double rate = std::fabs(s.rev_per_s) / planned_, p = pole_;
    double bend = p * p * p * (wanted_ - tau_) + 3 * p * p * (rate - sigma_) - 3 * p * slope_;
    bend = std::clamp(bend, -reach.bend, reach.bend);
    const double up = std::min(reach.slope, most_slope(optimal::ThreadShare::kFaster - sigma_, slope_, reach.bend, time));
    const double down = std::min(reach.slope, most_slope(sigma_, -slope_, reach.bend, time));
    const double slope = std::clamp(slope_ + bend * time, -down, up);
    bend = (slope - slope_) / time;
    const double gone = time * (sigma_ + time * (slope_ / 2 + time * bend / 6));
    sigma_ = std::clamp(sigma_ + time * (slope_ + time * bend / 2), 0.0, optimal::ThreadShare::kFaster);
    slope_ = slope;
    tau_ += std::max(0.0, gone);
    wanted_ += std::fabs(s.turns - turns_) / planned_;
    turns_ = s.turns;
    return std::max(0.0, gone);
  }
  double sigma() const { return sigma_; }
  double planned() const { return planned_; }
  PlanPace pace() const { return {sigma_, slope_}; }

  /// The largest sigma' and sigma'' for a thread: the plan uses at most ThreadShare of the limits, the rest is for these.
  static Reach reach_of(const Segment& s, double planned, const optimal::Limits& limits) NC_RT {
    using Share = optimal::ThreadShare;
    constexpr double f = Share::kFaster;
    constexpr double kOfAcceleration = 0.99 - Share::kAcceleration * f * f;  // share left for Q' sigma'
    constexpr double kOfJerk = 0.5 * (0.99 - Share::kJerk * f * f * f);      // share left for each of 3 Q'' sigma sigma' and Q' sigma''
    const bool line = !s.curve.circular && s.curve.shape == nullptr;
    Reach r;
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      const double most = limits.velocity[i] > 0 ? limits.velocity[i] / f : HUGE_VAL;
      const double v = line ? std::min(most, s.feed_mm_rev * planned * std::fabs(s.curve.delta[i]) / s.curve.length) : most;
      const double a = limits.acceleration[i], j = limits.jerk[i];
      if (a > 0 && v > 0) r.slope = std::min(r.slope, kOfAcceleration * a / v);
      if (j > 0 && v > 0) r.bend = std::min(r.bend, kOfJerk * j / v);
      if (a > 0 && j > 0) r.slope = std::min(r.slope, kOfJerk * j / (3 * Share::kAcceleration * a * f));
    }
    r.slope = std::min(r.slope, kMostSlope);
    r.bend = std::min(r.bend, kMostBend);
    return r;
  }

 private:
  /// The largest slope at the end of a step of T = `time` from which sigma can still become steady before it has changed by `left`, counted from the
  /// beginning of the step, where the slope is `slope`. Derivation: a slope s that goes down by bend T in each further step changes sigma by
  /// s^2 / (2 bend) + s T / 2 at most, and the step itself changes it by T times the mean of both slopes. The slope never has to go down by more than
  /// bend T in one step, because sqrt(x^2 + y^2) >= x.
  static double most_slope(double left, double slope, double bend, double time) NC_RT {
    const double by = bend * time;
    return std::max(0.0, std::sqrt(std::max(0.0, by * by + 2 * bend * (left - 0.5 * time * slope))) - by);
  }

  static constexpr double kPole = 120;           ///< 1/s, each of the three poles of the control loop that keeps tau with the spindle
  static constexpr double kPolePerCycle = 0.15;  ///< largest pole times cycle time, for long cycles
  static constexpr double kAtPace = 0.999;       ///< share of the speed of the thread from which on it counts as reached
  static constexpr double kMostSlope = 1e3, kMostBend = 1e6;  ///< where no axis has limits

  double pole_ = kPole;
  double turns_ = 0;    ///< turns of the spindle at the end of the last step
  double planned_ = 1;  ///< speed of the spindle for which the plan was made, rev/s
  double tau_ = 0, sigma_ = 1, slope_ = 0;
  double wanted_ = 0;   ///< what tau should be
  double origin_ = 0;   ///< turns of the spindle at which u would be 0, counted back from where the thread has reached its speed
  bool locked_ = false; ///< the thread has reached its speed, and origin_ is known
};

}  // namespace nc
