// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/phase_law.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kBend = 0.6;  ///< the bends of the path may take this part of the limits where the speed changes ...
constexpr double kHold = 0.98;  ///< ... and this part where the speed stays
constexpr double kBendOfRest = 0.5;  ///< the term 3 q'' u' u'' may take this part of the jerk that the other terms leave
constexpr double kTurn = 0.15;  ///< rad: a stretch of a curve turns by no more
constexpr unsigned kMostParts = 64;  ///< a piece is cut into at most so many stretches
constexpr unsigned kLooks = 4;  ///< the derivatives of a stretch are looked at between so many parts of it
constexpr double kSameSpeed = 1.03;  ///< a speed that is higher by no more than this factor is not worth a change of the speed
constexpr double kNear = 1e-9;  ///< mm: places that are nearer to each other are the same
constexpr double kNearSpeed = 1e-9;  ///< speeds that differ by this part of themselves are the same
constexpr unsigned kHalvings = 24;
constexpr double kStart = 1.004;  ///< a given start may use this many times what a stretch allows
/// Parts of the speed that a start comes to by itself, which are tried one after the other.
constexpr double kSlowerStart[] = {1, 0.8, 0.6, 0.4, 0.2, 0.1, 0.05};
constexpr double kTurnsBack = 1.001;  ///< a start must be faster by this factor than what it loses until its acceleration is 0
constexpr double kWorthIt = 1.5;      ///< a speed that is higher by less is not gone to for a moment

// Instructions: of a look at the derivatives of an axis of a polynomial and of another curve, to bound a stretch, to look for the slowest of
// some, and of a range that is divided.
constexpr int64_t kAxisCost = 40, kCurveCost = 500, kBoundCost = 150, kSlowestCost = 5, kDivideCost = 400, kMoveCost = 150;

double ramp_seconds(double v0, double v1, double a, double j) {
  const double change = std::fabs(v1 - v0);
  return change * j >= a * a ? change / a + a / j : 2 * std::sqrt(change / j);
}

}  // namespace

// ---- the path
// ---------------------------------------------------------------------------------------------------------------------

/// The largest derivatives between two places of a piece.
bool PhaseLaw::measure_stretch(const Piece& p, double from, double to, unsigned samples, Stretch* out) const {
  const unsigned axes = limits_->axis_count;
  for (unsigned i = 0; i < axes; ++i) out->d1[i] = out->d2[i] = out->d3[i] = 0;
  CurvePoint q, last;
  const double step = (to - from) / samples;
  for (unsigned n = 0; n <= samples; ++n) {
    derivatives(p, from + step * n, axes, &q);
    for (unsigned i = 0; i < axes; ++i) {
      // Between two places each derivative is off its chord by no more than an eighth of step^2 times the second one after it; the next
      // one changes by step times that at most, so a quarter of its change is enough for a parabola and stands for other curves.
      const double more1 = n > 0 ? 0.125 * step * std::fabs(q.d2[i] - last.d2[i]) : 0,
                   more2 = n > 0 ? 0.125 * step * std::fabs(q.d3[i] - last.d3[i]) : 0,
                   more3 = n > 0 && (p.quintic || p.curve != nullptr) ? 0.125 * std::fabs(q.d3[i] - last.d3[i]) : 0;
      const double before1 = n > 0 ? std::fabs(last.d1[i]) : 0, before2 = n > 0 ? std::fabs(last.d2[i]) : 0, before3 = n > 0 ? std::fabs(last.d3[i]) : 0;
      out->d1[i] = std::max(out->d1[i], std::max(std::fabs(q.d1[i]), before1) + more1);
      out->d2[i] = std::max(out->d2[i], std::max(std::fabs(q.d2[i]), before2) + more2);
      out->d3[i] = std::max(out->d3[i], std::max(std::fabs(q.d3[i]), before3) + more3);
    }
    last = q;
  }
  out->from = from;
  out->to = to;
  bound(p, out);
  return out->cap > 0;
}

/// The speeds of a stretch. Bends alone take |q''| v^2 of the acceleration and |q'''| v^3 of the jerk.
void PhaseLaw::bound(const Piece& p, Stretch* s) const {
  s->use_a = share_ * acceleration_share(p, *limits_);
  s->use_j = share_ * jerk_share(p, *limits_);
  double length2 = 0, axes = HUGE_VAL, bends = HUGE_VAL, hold = HUGE_VAL;
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    const double v = velocity_of(p, *limits_, i), a = s->use_a * limits_->acceleration[i], j = s->use_j * limits_->jerk[i];
    if ((limits_->linear >> i & 1) != 0) length2 += s->d1[i] * s->d1[i];
    if (v > 0 && axes * s->d1[i] > v) axes = v / s->d1[i];
    if (a > 0 && s->d2[i] > 0) {
      bends = std::min(bends, std::sqrt(kBend * a / s->d2[i]));
      hold = std::min(hold, std::sqrt(kHold * a / s->d2[i]));
    }
    if (j > 0 && s->d3[i] > 0) {
      bends = std::min(bends, std::cbrt(kBend * j / s->d3[i]));
      hold = std::min(hold, std::cbrt(kHold * j / s->d3[i]));
    }
  }
  s->hold = std::min(axes, hold);
  s->cap = std::min({axes, bends, feed_of(p, *limits_) / std::sqrt(std::max(1.0, length2))});
}

/// Into how many stretches a part of a piece is cut.
unsigned PhaseLaw::parts_of(const Piece& p, double x, double length) const {
  const unsigned axes = limits_->axis_count;
  double most1 = 0, most2 = 0;
  CurvePoint q;
  for (unsigned n = 0; n <= 2 * kLooks; ++n) {
    derivatives(p, x + length * n / (2 * kLooks), axes, &q);
    double here1 = 0, here2 = 0;
    for (unsigned i = 0; i < axes; ++i) {
      here1 += q.d1[i] * q.d1[i];
      here2 += q.d2[i] * q.d2[i];
    }
    most1 = std::max(most1, here1);
    most2 = std::max(most2, here2);
  }
  const double turn = most1 > 0 ? length * std::sqrt(most2 / most1) : 0;
  return static_cast<unsigned>(std::clamp(std::ceil(turn / kTurn), 1.0, static_cast<double>(kMostParts)));
}

Task<bool> PhaseLaw::stretches(Work& work, const MeshRequest& request) {
  const unsigned axes = limits_->axis_count;
  stretches_ = 0;
  whole_ = true;
  double begun = 0, x = request.from.x;
  for (unsigned k = request.from.piece; k < request.count && begun < request.reach - kNear; ++k, x = 0) {
    const Piece& p = request.at(k);
    const double length = std::min(p.length - x, request.reach - begun);
    if (!(length > 0)) continue;
    const bool curve = p.curve != nullptr || p.quintic;
    const unsigned samples = curve ? kLooks : 1, parts = curve ? parts_of(p, x, length) : 1;
    const int64_t look = axes * (p.curve != nullptr ? kCurveCost : kAxisCost);
    if (curve) co_await work.pause(2 * kLooks * look);
    for (unsigned n = 0; n < parts; ++n) {
      if (stretches_ == kStretches) {
        whole_ = false;
        co_return true;
      }
      Stretch& s = stretch_[stretches_];
      const bool measured = measure_stretch(p, x + length * n / parts, x + length * (n + 1) / parts, samples, &s);
      co_await work.pause(kBoundCost * axes + (samples + 1) * look);
      if (!measured) {
        if (stretches_ > 0) whole_ = false;
        co_return stretches_ > 0;
      }
      s.from = begun + length * n / parts;
      s.to = n + 1 < parts ? begun + length * (n + 1) / parts : begun + length;
      ++stretches_;
    }
    begun += length;
  }
  co_return stretches_ > 0;
}

/// With no more than `speed` on the stretch, for each axis
///     |q'| a + |q''| v^2 <= A,    |q'| j + 3 |q''| v a + |q'''| v^3 <= J.
PhaseLaw::Budget PhaseLaw::budget(unsigned stretch, double speed) const {
  const Stretch& s = stretch_[stretch];
  Budget most;
  const double v2 = speed * speed, v3 = v2 * speed;
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    if (limits_->acceleration[i] > 0) {
      const double left = s.use_a * limits_->acceleration[i] - s.d2[i] * v2;
      if (most.acceleration * s.d1[i] > left) most.acceleration = left / s.d1[i];
    }
    if (limits_->jerk[i] > 0) {
      const double left = kBendOfRest * (s.use_j * limits_->jerk[i] - s.d3[i] * v3), bend = 3 * s.d2[i] * speed;
      if (bend > 0 && most.acceleration * bend > left) most.acceleration = left / bend;
    }
  }
  if (!(most.acceleration > 0)) return {0, 0};
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    if (!(limits_->jerk[i] > 0)) continue;
    const double bend = s.d2[i] > 0 ? 3 * s.d2[i] * speed * most.acceleration : 0, left = s.use_j * limits_->jerk[i] - s.d3[i] * v3 - bend;
    if (most.jerk * s.d1[i] > left) most.jerk = left / s.d1[i];
  }
  return most;
}

/// The stretch that goes on from a place; seen from the end, the one that leads to it.
unsigned PhaseLaw::next_to(double s, Sense sense) const {
  unsigned low = 0, high = stretches_;  // of the first stretch that ends behind the place, or does not begin in front of it
  while (low < high) {
    const unsigned middle = (low + high) / 2;
    if (sense == Sense::forward ? stretch_[middle].to > s + kNear : !(stretch_[middle].from < s - kNear)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return sense == Sense::forward ? std::min(low, stretches_ - 1) : low - std::min(low, 1u);
}

// ---- from one speed to another
// -----------------------------------------------------------------------------------------------------

/// The way between two constant speeds that begins at a place (seen backward: that ends there), with what all the stretches leave that it
/// takes; HUGE_VAL where that is nothing, or more than there is room. A ramp seen backward is one, so which speed is the first one is the same.
double PhaseLaw::ramp(double at, Sense sense, double v0, double v1, double room, Budget* most) const {
  *most = {};
  const double speed = std::max(v0, v1);
  if (std::fabs(v1 - v0) <= kNearSpeed * speed) return 0;
  for (unsigned k = next_to(at, sense); k < stretches_; k = beyond(k, sense)) {
    ++looks_;
    const Budget here = budget(k, speed);
    most->acceleration = std::min(most->acceleration, here.acceleration);
    most->jerk = std::min(most->jerk, here.jerk);
    if (!(here.acceleration > 0) || !(here.jerk > 0)) return HUGE_VAL;
    if (most->acceleration < HUGE_VAL && most->jerk < HUGE_VAL) {
      const double way = 0.5 * (v0 + v1) * ramp_seconds(v0, v1, most->acceleration, most->jerk);
      if (way > room) return HUGE_VAL;
      if (way <= far_edge(k, at, sense) + kNear) return way;
    }
  }
  return HUGE_VAL;
}

/// Beside an end of the range that is passed at speed the stretches that are soon over and allow little more are gone at that speed, too:
/// the next ramp would be as gentle as their bends make it. @return how far that goes from the end
double PhaseLaw::stay(const Range& r, Sense sense) const {
  const bool back = sense == Sense::backward;
  const double here = back ? r.to : r.from, there = back ? r.from : r.to, v = back ? r.v1 : r.v0, other = back ? r.v0 : r.v1;
  if (!(v > 0)) return 0;
  const unsigned first = next_to(here, sense);
  const Budget free = budget(first, 0);
  if (!free.ok()) return 0;
  const double whole = r.to - r.from, look = v * std::sqrt(v / free.jerk);
  double way = 0;
  for (unsigned k = first; k < stretches_ && near_edge(k, here, sense) < look && far_edge(k, here, sense) < whole; k = beyond(k, sense))
    if (stretch_[k].cap < kWorthIt * v) way = far_edge(k, here, sense);
  if (!(way > 0) || v == other) return way;
  const double left = whole - way;
  Budget most;
  const double change = other > v ? ramp(back ? r.to - way : r.from + way, sense, v, other, left, &most)
                                  : ramp(there, back ? Sense::forward : Sense::backward, v, other, left, &most);
  return change <= left ? way : 0;
}

// ---- the law
// ------------------------------------------------------------------------------------------------------------------------

bool PhaseLaw::push(const Range& r) {
  if (depth_ == sizeof stack_ / sizeof stack_[0]) return false;
  stack_[depth_++] = r;
  return true;
}

/// The range has room to go to a speed and to come down from it.
bool PhaseLaw::fits(const Range& r, double speed, Budget* rise, Budget* fall) const {
  const double way = r.to - r.from, first = ramp_from(r.from, r.v0, speed, way, rise);
  return first <= way && ramp_to(r.to, speed, r.v1, way - first, fall) <= way - first;
}

/// To one speed between, no more than `most`, as high as the way leaves room for, and to the speed at the end.
Task<bool> PhaseLaw::hill(Work& work, const Range& r, double most) {
  const double way = r.to - r.from;
  double low = std::max(r.v0, r.v1), high = most;
  Budget rise, fall;
  for (unsigned n = 0; n < kHalvings || (low == 0 && n < 4 * kHalvings); ++n) {
    const double middle = low > 0.5 * high ? 0.5 * (low + high) : low > 0 ? std::sqrt(low * high) : 0.25 * high;
    (fits(r, middle, &rise, &fall) ? low : high) = middle;
    co_await work.pause(looked());
    if (high - low < 0.005 * high) break;
  }
  if (!(low > 0)) co_return false;
  const double first = ramp_from(r.from, r.v0, low, way, &rise), last = ramp_to(r.to, low, r.v1, way - first, &fall);
  if (!(first + last <= way)) co_return false;
  co_return push({r.to - last, r.to, low, r.v1, true, fall}) && push({r.from + first, r.to - last, low, low, true, {}}) &&
      push({r.from, r.from + first, r.v0, low, true, rise});
}

/// A range whose speeds at the ends are no higher than what all its stretches allow: at its slowest stretch that is the speed, if there is
/// way enough to come to it and to leave it; on either side there is a smaller range. Else it is a hill up to `*hill`.
PhaseLaw::Divided PhaseLaw::divide(const Range& r, double* hill) {
  const auto done = [](bool pushed) { return pushed ? Divided::yes : Divided::no; };
  const double fastest = std::max(r.v0, r.v1);
  if (!(r.to - r.from > kNear)) return done(!(fastest > 0) || push({r.from, r.to, fastest, fastest, true, {}}));
  if (!r.stayed) {
    const double from = r.from + stay(r, Sense::forward), to = r.to - stay({from, r.to, r.v0, r.v1, false, {}}, Sense::backward);
    return done(push({to, r.to, r.v1, r.v1, true, {}}) && push({from, to, r.v0, r.v1, false, {}, true}) && push({r.from, from, r.v0, r.v0, true, {}}));
  }
  const unsigned first = next_to(r.from, Sense::forward), last = next_to(r.to, Sense::backward);
  unsigned least = first;
  for (unsigned k = first; k <= last; ++k)
    if (stretch_[k].cap < stretch_[least].cap) least = k;
  looks_ += kSlowestCost * (last - first) / kLookCost;
  const double most = std::max({stretch_[least].cap, r.v0, r.v1}), way = r.to - r.from;
  *hill = most;
  Budget rise, fall;
  const double one = ramp_from(r.from, r.v0, most, way, &rise), other = one <= way ? ramp_to(r.to, most, r.v1, way - one, &fall) : HUGE_VAL;
  if (!(one + other <= way)) return Divided::as_a_hill;
  unsigned a = least, b = least;
  while (a > first && stretch_[a - 1].cap <= kSameSpeed * most) --a;
  while (b < last && stretch_[b + 1].cap <= kSameSpeed * most) ++b;
  const double edge0 = std::max(r.from, stretch_[a].from), edge1 = std::min(r.to, stretch_[b].to);
  // Rounding, but never a whole move: a stop from 1e-5 mm/s takes less way than that.
  if (r.from + one > edge0 + std::min(kNear, 0.5 * one)) {  // it comes to that speed behind the place only
    if (!(one > 0)) return Divided::as_a_hill;
    return done(push({r.from + one, r.to, most, r.v1, false, {}}) && push({r.from, r.from + one, r.v0, most, true, rise}));
  }
  if (r.to - other < edge1 - std::min(kNear, 0.5 * other)) {
    if (!(other > 0)) return Divided::as_a_hill;
    return done(push({r.to - other, r.to, most, r.v1, true, fall}) && push({r.from, r.to - other, r.v0, most, false, {}}));
  }
  return done(push({edge1, r.to, most, r.v1, false, {}}) && push({edge0, edge1, most, most, true, {}}) && push({r.from, edge0, r.v0, most, false, {}}));
}

/// A range that begins faster than what some stretch allows: that one is passed at its own speed, or slower where the way behind it asks
/// for that; then its left part is such a range, and its right part is not.
Task<bool> PhaseLaw::descend(Work& work, const Range& all) {
  Range r = all;
  for (unsigned n = 0; n < kStretches; ++n) {
    const unsigned first = next_to(r.from, Sense::forward), last = next_to(r.to, Sense::backward);
    unsigned least = first;
    for (unsigned k = first; k <= last; ++k)
      if (stretch_[k].cap <= stretch_[least].cap) least = k;
    co_await work.pause(kDivideCost + kSlowestCost * (last - first));
    Budget most;
    const double way = r.to - r.from;
    if (r.v0 <= stretch_[least].cap * (1 + kNearSpeed)) {
      const bool room = r.v0 > r.v1 ? ramp_to(r.to, r.v0, r.v1, way, &most) <= way : ramp_from(r.from, r.v0, r.v1, way, &most) <= way;
      work.spend(looked());
      co_return room&& push(r);
    }
    const double edge = std::max(r.from, stretch_[least].from);
    if (!(edge > r.from + kNear)) {
      const bool left = leave_fast(r, first, last, least);
      work.spend(looked());
      co_return left;
    }
    const Range rest{edge, r.to, 0, r.v1, false, {}};
    const double speed = co_await slow_enough(work, rest, std::max(stretch_[least].cap, r.v1));
    if (!(speed > 0) || !push({edge, r.to, speed, r.v1, false, {}})) co_return false;
    r = {r.from, edge, r.v0, speed, false, {}};
    if (!(r.v1 <= r.v0)) r.v1 = r.v0;
  }
  co_return false;
}

/// Faster than the feed or than what bends should take where it begins: down at once, if they let it.
bool PhaseLaw::leave_fast(const Range& r, unsigned first, unsigned last, unsigned least) {
  Budget most, end;
  for (unsigned k = first; k <= last && stretch_[k].from < r.from + kNear; ++k)
    if (r.v0 > stretch_[k].hold) return false;
  const double way = r.to - r.from, speed = std::max(std::min(stretch_[least].cap, r.v0), r.v1);
  const double ramp = ramp_from(r.from, r.v0, speed, way, &most);
  if (!(ramp <= way)) return false;
  for (unsigned k = first; k <= last && stretch_[k].from < r.from + ramp; ++k)
    if (r.v0 > stretch_[k].hold) return false;
  if (!(ramp_to(r.to, speed, r.v1, way - ramp, &end) <= way - ramp)) return false;
  return push({r.from + ramp, r.to, speed, r.v1, false, {}}) && push({r.from, r.from + ramp, r.v0, speed, true, most});
}

/// The speed at the start of a range, `high` or as much lower as it must be to come down to that at its end.
Task<double> PhaseLaw::slow_enough(Work& work, const Range& rest, double high) {
  const double way = rest.to - rest.from;
  Budget most;
  const bool room = ramp_to(rest.to, high, rest.v1, way, &most) <= way;
  co_await work.pause(looked());
  if (room) co_return high;
  double low = rest.v1;
  for (unsigned m = 0; m < kHalvings; ++m) {
    const double middle = 0.5 * (low + high);
    (ramp_to(rest.to, middle, rest.v1, way, &most) <= way ? low : high) = middle;
    co_await work.pause(looked());
  }
  co_return low;
}

Task<bool> PhaseLaw::solve(Work& work, const Range& whole) {
  depth_ = moves_ = 0;
  const bool comes_down = co_await descend(work, whole);
  if (!comes_down) co_return false;
  while (depth_ > 0) {
    const Range r = stack_[--depth_];
    if (!r.is_move) {
      double most = 0;
      Divided divided = divide(r, &most);
      co_await work.pause(kDivideCost + looked());
      if (divided == Divided::as_a_hill) {
        const bool found = co_await hill(work, r, most);
        divided = found ? Divided::yes : Divided::no;
      }
      if (divided == Divided::no) co_return false;
      continue;
    }
    if (!(r.to > r.from)) continue;
    if (moves_ == kMoves) co_return false;
    move_[moves_++] = {r.v0, r.v1, r.to - r.from, r.most};
  }
  co_return true;
}

bool PhaseLaw::add(double seconds, double jerk) {
  if (!(seconds > 0)) return true;
  if (count_ == kPhases) return false;
  phase_[count_++] = {seconds, jerk};
  seconds_ += seconds;
  at_ = at_.behind(jerk, seconds);
  return true;
}

/// From the start to constant speed, LineLaw::to_speed() with what the stretches leave on the way. @return where that ends, HUGE_VAL where
/// there is none
double PhaseLaw::first_move(double speed) {
  const double v = start_.v, a = start_.a;
  const unsigned first = next_to(start_.s, Sense::forward);
  double top = std::max(v, speed);
  Budget most;
  const double change = speed - v;
  for (unsigned pass = 0, last = first; pass < 64; ++pass) {
    if (a > 0) top = std::max(top, pass == 0 ? v : v + 0.5 * a * a / most.jerk);
    for (unsigned k = first; k <= last; ++k, ++looks_) {
      const Budget here = budget(k, top);
      most.acceleration = std::min(most.acceleration, here.acceleration);
      most.jerk = std::min(most.jerk, here.jerk);
      if (top > kStart * stretch_[k].hold) return HUGE_VAL;
      if (k > first && top > stretch_[k].cap && v <= stretch_[first].cap) return HUGE_VAL;  // only what begins too fast may be so for a while
    }
    if (!most.ok() || std::fabs(a) > kStart * most.acceleration) return HUGE_VAL;
    const double j = most.jerk;
    if (a < 0 && !(v > kTurnsBack * 0.5 * a * a / j)) return HUGE_VAL;  // it would stand or go back before the acceleration is 0
    const double sign = change >= a * std::fabs(a) / (2 * j) ? 1 : -1, a0 = sign * a, dv = sign * change;
    const double peak_most = std::max(most.acceleration, a0);
    double peak = std::sqrt(std::max(0.0, j * dv + 0.5 * a * a)), hold = 0;
    if (peak > peak_most) {
      peak = peak_most;
      hold = dv / peak - (2 * peak * peak - a * a) / (2 * j * peak);
    }
    if (peak < a0) {
      peak = a0;
      hold = 0;
    }
    count_ = 0;
    seconds_ = 0;
    at_ = start_;
    add((peak - a0) / j, sign * j);
    add(hold, 0);
    add(peak / j, -sign * j);
    if (std::fabs(at_.v - speed) > kNearSpeed * top) return HUGE_VAL;
    if (at_.s <= stretch_[last].to + kNear && (a <= 0 || top >= v + 0.5 * a * a / j)) return at_.s;
    while (last + 1 < stretches_ && at_.s > stretch_[last].to + kNear) ++last;
    if (at_.s > stretch_[last].to + kNear) return HUGE_VAL;
  }
  return HUGE_VAL;
}

/// From a state to constant speed, and from there on.
Task<bool> PhaseLaw::begin(Work& work) {
  const double v = start_.v, a = start_.a;
  count_ = 0;
  seconds_ = 0;
  if (a == 0) {
    const Range whole{start_.s, distance_, v, 0, false, {}};
    const bool solved = co_await solve(work, whole);
    if (solved || v == 0) co_return moves_ > 0;
  }
  const unsigned first = next_to(start_.s, Sense::forward);
  const Budget here = budget(first, v);
  if (!here.ok()) co_return false;
  const double level = std::max(0.0, v + 0.5 * a * std::fabs(a) / here.jerk);
  for (const double slower : kSlowerStart) {
    const double speed = slower * std::min(level, std::max(v, stretch_[first].cap));
    if (!(speed > 0)) break;
    const double way = first_move(speed);
    co_await work.pause(kMoveCost + looked());
    if (!(way < distance_)) continue;
    const Range rest{way, distance_, speed, 0, false, {}};
    const bool solved = co_await solve(work, rest);
    if (solved) {
      at_.s = way;
      co_return true;
    }
  }
  co_return false;
}

/// The moves as phases of constant jerk.
bool PhaseLaw::make_phases() {
  bool brakes = false;
  last_part_ = 0;
  for (unsigned k = 0; k < moves_; ++k) {
    const Move& m = move_[k];
    const double v0 = k == 0 && count_ == 0 ? m.v0 : at_.v, change = std::fabs(m.v1 - v0);  // what has been come to, to the last bit
    const bool level = std::fabs(m.v1 - m.v0) <= kNearSpeed * std::max(m.v0, m.v1), slower = !level && m.v1 < m.v0;
    if (slower && !brakes) last_part_ = count_;
    brakes = slower;
    if (level) {
      if (!add(m.length / v0, 0)) return false;
      at_.a = 0;
      continue;
    }
    // The way is given, and the speeds are: so is the time. With less than the limits where it is longer than they ask for.
    const double time = 2 * m.length / (v0 + m.v1), sign = m.v1 > v0 ? 1 : -1;
    const double a = m.most.acceleration, j = m.most.jerk;
    const double first = change * j >= a * a ? a / j : std::sqrt(change / j), whole = change * j >= a * a ? change / a + a / j : 2 * first;
    const double t = first * time / whole, jerk = change / (t * (time - t));
    if (!add(t, sign * jerk) || !add(std::max(0.0, time - 2 * t), 0) || !add(t, -sign * jerk)) return false;
    at_.v = m.v1;
    at_.a = 0;
  }
  return count_ > 0;
}

Task<bool> PhaseLaw::measure(Work& work, const MeshRequest& request, const Limits& limits, double share) {
  limits_ = &limits;
  share_ = share;
  const bool some = co_await stretches(work, request);
  if (!some) co_return false;
  distance_ = stretch_[stretches_ - 1].to;
  co_return true;
}

Task<bool> PhaseLaw::from(Work& work, double s, double v, double a) {
  count_ = 0;
  start_ = at_ = {s, v, a};
  if (!(s < distance_)) co_return false;
  const bool begun = co_await begin(work);
  if (!begun || !make_phases()) co_return false;
  co_await work.pause(kMoveCost * moves_);
  at_phase_ = 0;
  at_ = start_;
  co_return true;
}

Task<bool> PhaseLaw::find(Work& work, const MeshRequest& request, const Limits& limits, double share) {
  const bool measured = co_await measure(work, request, limits, share);
  if (!measured) co_return false;
  const double v = request.from_rest ? 0 : std::sqrt(request.b0), a = request.from_rest ? 0 : 0.5 * request.slope0;
  const bool found = co_await from(work, 0, v, a);
  co_return found;
}

double PhaseLaw::way_after(double seconds) const {
  LineState at = start_;
  for (unsigned k = 0; k < count_ && seconds > 0; ++k) {
    const double part = std::min(seconds, phase_[k].seconds);
    at = at.behind(phase_[k].jerk, part);
    seconds -= part;
  }
  return at.s;
}

double PhaseLaw::squared_speed(double s) {
  while (at_phase_ < count_) {
    const LineState next = at_.behind(phase_[at_phase_].jerk, phase_[at_phase_].seconds);
    if (next.s > s || at_phase_ + 1 == count_) break;
    at_ = next;
    ++at_phase_;
  }
  if (at_phase_ >= count_) return 0;
  double low = 0, high = phase_[at_phase_].seconds;
  for (unsigned n = 0; n < 30; ++n) {
    const double t = 0.5 * (low + high);
    (at_.behind(phase_[at_phase_].jerk, t).s < s ? low : high) = t;
  }
  const double v = at_.behind(phase_[at_phase_].jerk, high).v;
  return v * v;
}

}  // namespace nc::optimal
