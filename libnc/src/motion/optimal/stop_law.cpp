// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/stop_law.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kSteps = 48;         ///< in the time that a stop takes on a line
constexpr double kLongest = 0.00125;  ///< s, of a step
constexpr double kCoarser = 1;        ///< the steps of a way on that is only looked at
constexpr double kChain = 1.0003;     ///< of a limit, that the chain may use
constexpr double kShares[] = {kChain, 0.995, 0.97};  ///< of the limits, for a stop
constexpr double kExcess = 1.0008;    ///< of a limit, that it may come to between the places of a step
constexpr unsigned kRelease = 160;     ///< steps, after which the braking must have been taken back
constexpr unsigned kHalvings = 3;     ///< between too strong a braking and none
constexpr double kLanding = 0.9;      ///< of what there is, from which on a landing is tried
constexpr double kLeastLanding = 0.5; ///< of the limits of jerk
constexpr unsigned kLooks = 4;        ///< at a step of a stop that has been found
constexpr double kTiny = 1e-12, kRounding = 1e-9;
// Instructions: of a look, and of each axis of it, on a cubic and on another curve.
constexpr int64_t kLookCost = 150, kCubicCost = 60, kCurveCost = 500;

}  // namespace

/// |constant + factor x| <= most.
void StopLaw::Range::keep(double constant, double factor, double most) {
  if (std::fabs(factor) < kTiny) {
    if (std::fabs(constant) > most) low = HUGE_VAL;
    return;
  }
  const double a = (-most - constant) / factor, b = (most - constant) / factor;
  low = std::max(low, std::min(a, b));
  high = std::min(high, std::max(a, b));
}

/// The next cell. False where the chain rests.
bool StopLaw::enter(Place* place) const {
  if (chain_.at(place->cell).kind == PlanCell::Kind::land) {
    place->rests = true;
    return false;
  }
  place->begun = end_of(*place);
  place->cell = chain_.next[place->cell & chain_.store->cell_mask];
  return true;
}

void StopLaw::go_to(double tau, Place* place) const {
  while (!place->rests && tau >= end_of(*place)) enter(place);
}

/// Narrows sigma'' of a step to what the axes allow `t` seconds after its start. With the motion v, a, j of the chain there and sigma' = s + sigma'' t
///     u'  = v sigma      u'' = a sigma^2 + v s                    + sigma'' v t
///     u''' = j sigma^3 + 3 a sigma s                              + sigma'' (v + 3 a sigma t)
/// in which sigma is that of the sigma'' that is thought of.
void StopLaw::look(const Place& place, double tau, const Pace& from, double guess, double t, bool acceleration, Range* out) {
  const PlanCell& c = chain_.at(place.cell);
  const PlanMoment m = moment_in(*chain_.store, c, std::max(0.0, tau - place.begun), limits_->axis_count);
  const Piece& p = chain_.store->piece_at(c.piece);
  const double sigma = from.after(guess, t).sigma, sigma2 = sigma * sigma, u1 = m.v * sigma;
  const double u2 = m.a * sigma2 + m.v * from.slope, u3 = m.j * sigma2 * sigma + 3 * m.a * sigma * from.slope;
  // At a constant pace the chain, which may use all of the limits, needs no more than its square and its cube.
  const double use_a = std::max(share_, kChain * sigma2) * acceleration_share(p), use_j = std::max(share_, kChain * sigma2 * sigma) * jerk_share(p);
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    const double d1 = m.path.d1[i], d2 = m.path.d2[i], d3 = m.path.d3[i];
    if (limits_->jerk[i] > 0) {
      const double factor = d1 * m.v + 3 * t * (d1 * m.a * sigma + d2 * u1 * m.v);
      out->keep(d1 * u3 + 3 * d2 * u1 * u2 + d3 * u1 * u1 * u1, factor, use_j * limits_->jerk[i]);
    }
    if (acceleration && limits_->acceleration[i] > 0) out->keep(d1 * u2 + d2 * u1 * u1, d1 * m.v * t, use_a * limits_->acceleration[i]);
  }
  spent_ += kLookCost + limits_->axis_count * (p.curve != nullptr ? kCurveCost : kCubicCost);
}

/// sigma'' that a step may have: at its start, its middle and its end, and on both sides of each end of a cell between them, where the jerk jumps.
StopLaw::Range StopLaw::range(const Pace& from, Place place, double guess, double seconds) {
  Range out;
  look(place, from.tau, from, guess, 0, false, &out);
  bool middle = false;
  for (;;) {
    const double to = from.after(guess, middle ? seconds : seconds / 2).tau, edge = end_of(place);
    if (edge < to) {
      const double t = seconds * std::clamp((edge - from.tau) / (from.after(guess, seconds).tau - from.tau), 0.0, 1.0);
      look(place, edge, from, guess, t, false, &out);
      if (!enter(&place)) return out;
      look(place, edge, from, guess, t, false, &out);
      continue;
    }
    look(place, to, from, guess, middle ? seconds : seconds / 2, middle, &out);
    if (middle) return out;
    middle = true;
  }
}

/// The same for the strongest braking.
StopLaw::Range StopLaw::lowest(const Pace& from, const Place& place) {
  double guess = 0;
  Range out = range(from, place, guess, step_);
  for (unsigned n = 0; n < 2 && out.some(); ++n) {
    guess = std::max(out.low, -(2 * from.sigma / step_ + from.slope) / step_);  // not beyond rest
    out = range(from, place, guess, step_);
  }
  return out;
}

/// From here the braking can be taken back before sigma is 0. Then the chain is gone on with at a constant pace: each acceleration has the
/// square of it, each jerk the cube. `first`: sigma'' of its first step.
Task<bool> StopLaw::release(Work& work, Pace from, Place place, double* first) {
  const double seconds = kCoarser * step_;
  for (unsigned n = 0; n < kRelease; ++n) {
    const double wanted = -from.slope / seconds;
    if (n == 0) *first = std::max(-from.slope / step_, 0.0);
    if (!(from.slope < -kRounding)) co_return true;
    const Range may = range(from, place, from.bend, seconds);
    if (!may.some()) co_return false;
    const double bend = std::max(may.low, std::min(may.high, wanted));
    if (n == 0) *first = bend;
    from = from.after(bend, seconds);
    if (!(from.sigma > 0)) co_return false;
    go_to(from.tau, &place);
    if (place.rests) co_return true;
    co_await work.pause(looked());
  }
  co_return false;
}

/// Whether there is a way on behind a step.
Task<bool> StopLaw::goes_on(Work& work, const Pace& to, Place place) {
  if (!(to.sigma > 0)) co_return false;
  go_to(to.tau, &place);
  if (place.rests) co_return true;
  double first = 0;
  const bool released = co_await release(work, to, place, &first);
  co_return released;
}

/// sigma'' of a step: the strongest braking that leaves a way on, of those that there may be; else what takes the braking back, as was looked at
/// before the step in front of it.
Task<bool> StopLaw::brake(Work& work, const Pace& from, const Place& place, const Range& may, double* bend) {
  if (may.some()) {
    *bend = may.low;
    const bool on = co_await goes_on(work, from.after(may.low, step_), place);
    if (on) co_return true;
  }
  co_await release(work, from, place, bend);
  if (!may.some()) co_return true;
  double none = may.low;
  for (unsigned n = 0; n < kHalvings && none < *bend; ++n) {
    const double x = 0.5 * (none + *bend);
    const bool on = co_await goes_on(work, from.after(x, step_), place);
    (on ? *bend : none) = x;
  }
  co_return true;
}

/// The constant sigma'' that ends at rest keeps the limits. It becomes the end of the stop.
Task<bool> StopLaw::lands(Work& work, const Pace& from, Place place) {
  const double bend = from.slope * from.slope / (2 * from.sigma), time = -2 * from.sigma / from.slope;
  const unsigned count = stop_.count;
  Pace here = from;
  for (double left = time; left > 0; left -= step_) {
    if (stop_.count == PacedStop::kMost) break;
    const double step = std::min(left, step_);
    const Range may = range(here, place, bend, step);
    if (!(bend >= may.low) || !(bend <= may.high)) break;
    stop_.bend[stop_.count++] = bend;
    stop_.last = step;
    if (left <= step_) co_return true;
    here = here.after(bend, step);
    go_to(here.tau, &place);
    if (place.rests) break;
    co_await work.pause(looked());
  }
  stop_.count = count;
  co_return false;
}

/// The constant sigma'' that ends at rest is about what there is, and not because it is little here: the jerk that it makes is a good part of the limits.
/// Or rest is as near as a step.
bool StopLaw::may_land(const Pace& from, const Place& place) {
  if (from.sigma <= -from.slope * step_) return true;
  const double bend = from.slope * from.slope / (2 * from.sigma);
  const PlanMoment m = moment_in(*chain_.store, chain_.at(place.cell), std::max(0.0, from.tau - place.begun), limits_->axis_count);
  double share = 0;
  for (unsigned i = 0; i < limits_->axis_count; ++i)
    if (limits_->jerk[i] > 0) share = std::max(share, bend * std::fabs(m.path.d1[i] * m.v) / limits_->jerk[i]);
  return share >= kLeastLanding && bend >= kLanding * range(from, place, bend, step_).high;
}

Task<bool> StopLaw::steps(Work& work, Place place) {
  Pace at;
  stop_.count = 0;
  while (stop_.count + 1 < PacedStop::kMost) {
    const Range may = lowest(at, place);
    co_await work.pause(looked());
    if (at.slope < 0 && may_land(at, place)) {
      const bool landed = co_await lands(work, at, place);
      if (landed) co_return true;
    }
    double bend = 0;
    co_await brake(work, at, place, may, &bend);
    stop_.bend[stop_.count++] = bend;
    at = at.after(bend, step_);
    go_to(at.tau, &place);
    if (place.rests) co_return false;
  }
  co_return false;
}

/// Nothing is trusted: the stop that was found, at more places.
Task<bool> StopLaw::keeps_limits(Work& work, Place place) {
  Pace at;
  share_ = kExcess;
  for (unsigned k = 0; k < stop_.count; ++k) {
    const double step = k + 1 < stop_.count ? stop_.step : stop_.last;
    for (unsigned n = 0; n < kLooks; ++n) {
      const double from = step * n / kLooks, to = step * (n + 1) / kLooks, bend = stop_.bend[k];
      const Pace here = at.after(bend, from);
      const Range may = range(here, place, bend, to - from);
      if (!(bend >= may.low) || !(bend <= may.high)) co_return false;
      go_to(at.after(bend, to).tau, &place);
      if (place.rests) co_return false;
    }
    at = at.after(stop_.bend[k], step);
    co_await work.pause(looked());
  }
  co_return std::fabs(at.sigma) <= kRounding&& std::fabs(at.slope * step_) <= kRounding;
}

int64_t StopLaw::looked() {
  const int64_t cost = spent_;
  spent_ = 0;
  return cost;
}

Task<bool> StopLaw::find(Work& work, const ChainView& chain, CellIndex cell, double t, const Limits& limits, double seconds) {
  chain_ = chain;
  limits_ = &limits;
  stop_.step = step_ = std::min(kLongest, seconds / kSteps);
  spent_ = 0;
  for (const double share : kShares) {
    share_ = share;
    bool found = co_await steps(work, {cell, -t});
    if (!found) continue;
    found = co_await keeps_limits(work, {cell, -t});
    if (found) co_return true;
  }
  co_return false;
}

}  // namespace nc::optimal
