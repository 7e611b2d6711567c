// SPDX-License-Identifier: Apache-2.0
// Straight stretches of the plan: their laws in closed form, cut into cells as short as those of other laws, because only between cells
// can the plan be changed.
#include <algorithm>
#include <cmath>

#include "motion/optimal/optimal_planner.hpp"

namespace nc::optimal {
namespace {

constexpr double kPeriod = 0.005;  ///< s that a cell lasts
constexpr double kMostSeconds = 2;  ///< s that one law lasts at most, where a part of constant speed can be left away
constexpr unsigned kMostCells = 1024;  ///< cells that one law has at most; where it takes longer, they do
constexpr unsigned kMostPieces = 512;
constexpr double kSame = 1e-9;  ///< directions and speeds that differ by no more are the same
constexpr unsigned kHalvings = 60;
constexpr unsigned kSamples = kMaxCells / LineLaw::kPhases;  ///< places of each phase that are looked at
constexpr unsigned kBends = 32;         ///< places of a piece where its bends are looked at
constexpr unsigned kCreepLooks = 16;    ///< and of each phase of a law along it
constexpr unsigned kSlowerStill = 24;  ///< a law along a bent piece is made twice as slow at most so often
// Instructions: of a look at such a law for each axis, and of a cell that is written.
constexpr int64_t kCreepCost = 30000, kCopyCost = 200, kEdgeCost = 1500;

/// When the motion has come to s, in [from, to] after the state.
double when(const LineState& state, double jerk, double s, double from, double to) {
  for (unsigned n = 0; n < kHalvings; ++n) {
    const double middle = 0.5 * (from + to);
    (state.behind(jerk, middle).s < s ? from : to) = middle;
  }
  return to;
}

}  // namespace

/// The limits along a straight piece. False on any other one.
bool OptimalPlanner::line_limits(const Piece& p, LineLimits* most) const {
  if (p.curve != nullptr || p.quintic) return false;
  double length2 = 0;
  *most = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    if (p.c[2][i] != 0 || p.c[3][i] != 0) return false;
    const double d = std::fabs(p.c[1][i]), v = velocity_of(p, limits_, i);
    if ((limits_.linear >> i & 1) != 0) length2 += d * d;
    if (most->speed * d > v && v > 0) most->speed = v / d;
    const double acceleration = acceleration_share(p, limits_) * limits_.acceleration[i], jerk = jerk_share(p, limits_) * limits_.jerk[i];
    if (most->acceleration * d > acceleration) most->acceleration = acceleration / d;
    if (most->jerk * d > jerk) most->jerk = jerk / d;
  }
  most->speed = std::min(most->speed, feed_of(p, limits_) / std::sqrt(std::max(1.0, length2)));
  return most->speed > 0 && most->acceleration < HUGE_VAL && most->jerk < HUGE_VAL && most->acceleration > 0 && most->jerk > 0;
}

/// From `start` to the end of the pieces, or as far as `reach`, lies one straight line, with one limit for the speed if `feed` asks for it.
bool OptimalPlanner::straight(const Start& start, double reach, bool feed, LineLimits* most, double* length) const {
  const unsigned count = pieces_from(start.piece, kMostPieces);
  *length = -start.x;
  for (unsigned n = 0; n < count && *length < reach; ++n) {
    const Piece &first = store_.piece_at(start.piece), &p = store_.piece_at(start.piece + n);
    LineLimits here;
    if (!line_limits(p, n == 0 ? most : &here)) return false;
    if (n > 0) {
      if (feed && std::fabs(here.speed - most->speed) > kSame * most->speed) return false;
      for (unsigned i = 0; i < limits_.axis_count; ++i)
        if (std::fabs(p.c[1][i] - first.c[1][i]) > kSame) return false;
    }
    *length += p.length;
  }
  *length = std::min(*length, reach);
  return *length > 0;
}

/// The law of a straight line from `start` on.
bool OptimalPlanner::find_line_law(const Start& start, double reach) {
  LineLimits most;
  double length = 0;
  return straight(start, reach, true, &most, &length) && line_.reach(length, start.v, start.a, most, kMostSeconds);
}

/// The stop on the straight line ahead, in less than `most`. @return whether there is a line
bool OptimalPlanner::find_line_stop(const Start& start, double most) {
  LineLimits limits;
  double length = 0;
  if (!line_limits(store_.piece_at(start.piece), &limits) || !line_.stop(start.v, start.a, limits)) return false;
  const double way = line_.distance();
  return way <= most && straight(start, way, false, &limits, &length) && length >= way - unseen(limits, way);
}

/// Where no other law is found: from rest to rest over one piece of any kind, with one limit for all of it, twice as slow until every place that
/// is looked at keeps the limits of the axes. Time stretched by 2 leaves 1/4 of each acceleration and 1/8 of each jerk, so this ends.
Task<bool> OptimalPlanner::find_creep(Work& work, const Start& start, double reach) {
  const Piece& p = store_.piece_at(start.piece);
  const double length = std::min(p.length - start.x, reach);
  if (!start.from_rest || !(length > unseen(p, limits_, p.length)) || stands(p, limits_)) co_return false;
  LineLimits most{feed_of(p, limits_), HUGE_VAL, HUGE_VAL};
  co_await work.pause(kCreepCost * limits_.axis_count);
  for (unsigned n = 0; n < kBends; ++n) bound_creep(p, start.x + length * (n + 0.5) / kBends, &most);
  if (!(most.speed > 0) || !(most.acceleration < HUGE_VAL) || !(most.jerk < HUGE_VAL)) co_return false;
  for (unsigned n = 0; n < kSlowerStill; ++n) {
    if (line_.reach(length, 0, 0, most, kMostSeconds) && keeps_limits(p, start.x)) co_return true;
    co_await work.pause(kCreepCost * limits_.axis_count);
    most.speed *= 0.5;
    most.acceleration *= 0.25;
    most.jerk *= 0.125;
  }
  co_return false;
}

/// Half of what the axes allow at a place, for the bends and for the way along it.
void OptimalPlanner::bound_creep(const Piece& p, double x, LineLimits* most) const {
  CurvePoint q;
  derivatives(p, x, limits_.axis_count, &q);
  double length2 = 0;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    const double v = velocity_of(p, limits_, i), d1 = std::fabs(q.d1[i]), d2 = std::fabs(q.d2[i]), d3 = std::fabs(q.d3[i]);
    const double a = 0.5 * acceleration_share(p, limits_) * limits_.acceleration[i], j = 0.5 * jerk_share(p, limits_) * limits_.jerk[i];
    if ((limits_.linear >> i & 1) != 0) length2 += d1 * d1;
    if (v > 0 && most->speed * d1 > v) most->speed = v / d1;
    if (a > 0 && most->speed * most->speed * d2 > a) most->speed = std::sqrt(a / d2);
    if (j > 0 && most->speed * most->speed * most->speed * d3 > j) most->speed = std::cbrt(j / d3);
    if (a > 0 && most->acceleration * d1 > a) most->acceleration = a / d1;
    if (j > 0 && most->jerk * d1 > j) most->jerk = j / d1;
  }
  if (length2 > 1) most->speed = std::min(most->speed, feed_of(p, limits_) / std::sqrt(length2));
}

/// The law that was found last, along a piece from x on.
bool OptimalPlanner::keeps_limits(const Piece& p, double x) const {
  LineState from = line_.start();
  CurvePoint q;
  for (unsigned k = 0; k < line_.count(); ++k) {
    const Phase& phase = line_.phase(k);
    for (unsigned n = 0; n <= kCreepLooks; ++n) {
      const LineState s = from.behind(phase.jerk, phase.seconds * n / kCreepLooks);
      if (!(s.v > 0)) continue;  // at rest nothing bends
      derivatives(p, std::min(p.length, x + s.s), limits_.axis_count, &q);
      for (unsigned i = 0; i < limits_.axis_count; ++i) {
        const double a = q.d1[i] * s.a + q.d2[i] * s.v * s.v;
        const double j = q.d1[i] * phase.jerk + 3 * q.d2[i] * s.v * s.a + q.d3[i] * s.v * s.v * s.v;
        if (limits_.acceleration[i] > 0 && !(std::fabs(a) <= acceleration_share(p, limits_) * limits_.acceleration[i])) return false;
        if (limits_.jerk[i] > 0 && !(std::fabs(j) <= jerk_share(p, limits_) * limits_.jerk[i])) return false;
      }
    }
    from = from.behind(phase.jerk, phase.seconds);
  }
  return true;
}

/// The speed along the stop that was found last.
template <class PhasesOf>
void OptimalPlanner::phase_way_down(const PhasesOf& law, double share, WayDown* down) {
  LineState from = law.start();
  unsigned n = 0;
  for (unsigned k = 0; k < law.count(); ++k) {
    const Phase& phase = law.phase(k);
    for (unsigned i = 0; i < kSamples; ++i, ++n) {
      const LineState q = from.behind(phase.jerk, phase.seconds * i / kSamples);
      down_u_[n] = q.s;
      down_b_[n] = share * q.v * q.v;
    }
    from = from.behind(phase.jerk, phase.seconds);
  }
  down_u_[n] = law.distance();
  down_b_[n] = 0;
  *down = {down_u_, down_b_, n + 1};
}

/// A law that ends `beyond` mm behind the end of a piece goes on on the next one.
bool OptimalPlanner::goes_beyond(uint32_t piece, double beyond, double way) const {
  return beyond > 0 && piece + 1 != builder_.head() && beyond > unseen(store_.piece_at(piece), limits_, way);
}

/// Writes the law as cells of about a period each, none of which lies on two pieces, to the last bit. The last one lies on the piece that the law
/// ends on. False when they have no room.
template <class PhasesOf>
Task<bool> OptimalPlanner::copy_phases(Work& work, const PhasesOf& law, const Start& start, Start* end) {
  const CellIndex first = write_;
  const double period = std::max(kPeriod, law.seconds() / kMostCells);
  const double way = start.x + law.distance();
  double time = begins_at(start);
  uint32_t piece = start.piece;
  double begun = -start.x;  // where the piece begins on the line
  LineState from = law.start();
  line_keep_ = first;
  for (unsigned k = 0; k < law.count(); ++k) {
    const Phase& phase = law.phase(k);
    const bool last = k + 1 == law.count();
    const auto state = [&](double t) {
      LineState q = from.behind(phase.jerk, t);
      if (last && t == phase.seconds) q = {law.distance(), 0, 0};
      return q;
    };
    if (k == law.last_part() && write_ != first) line_keep_ = write_ - 1;
    const double cells = std::max(1.0, std::ceil(phase.seconds / period - kSame));
    LineState at = from;
    double t = 0;
    for (double n = 1; n <= cells;) {
      double to = n < cells ? phase.seconds * n / cells : phase.seconds;
      LineState then = state(to);
      const double edge = begun + store_.piece_at(piece).length;
      const bool crosses = then.s > edge && goes_beyond(piece, law.distance() - edge, way);
      if (crosses) {
        to = when(from, phase.jerk, edge, t, to);
        then = state(to);
      } else {
        ++n;
      }
      if (write_ + 1 - free_from_ >= kCells) {
        write_ = first;
        co_return false;
      }
      PlanCell& c = store_.cell[write_ & store_.cell_mask];
      c = {};
      c.kind = PlanCell::Kind::ramp;
      c.u = start.u + at.s;
      c.x = at.s - begun;
      c.piece = piece;
      c.h = then.s - at.s;
      c.seconds = to - t;
      c.v = at.v;
      c.a = at.a;
      c.w = phase.jerk;
      c.turns = turns_of(limits_.scale);
      c.turning_axis = limits_.scale.turning_axis;
      if (write_ == first && start.from_rest) {
        c.kind = PlanCell::Kind::launch;
        c.v = then.v;
      }
      if (last && n > cells) {
        c.kind = PlanCell::Kind::land;
        c.a = -2 * c.v / c.seconds;
      }
      chain_next_[write_ & store_.cell_mask] = write_ + 1;
      chain_end_[write_ & store_.cell_mask] = time += c.seconds;
      ++write_;
      if (then.s >= edge && goes_beyond(piece, law.distance() - edge, way)) {
        begun = edge;
        ++piece;
      }
      at = then;
      t = to;
      co_await work.pause(kCopyCost + (crosses ? kEdgeCost : 0));
    }
    from = state(phase.seconds);
  }
  const Piece& p = store_.piece_at(piece);
  const double x = law.distance() - begun;
  PlanCell& last = store_.cell[(write_ - 1) & store_.cell_mask];
  last.path_ends = p.rest_behind && x >= p.length - unseen(p, limits_, way);
  *end = behind_law(piece, x, start.u + law.distance(), way);
  last.before_rest = !last.path_ends && rests_soon(*end);
  co_return true;
}

template void OptimalPlanner::phase_way_down(const LineLaw& law, double share, WayDown* down);
template Task<bool> OptimalPlanner::copy_phases(Work& work, const LineLaw& law, const Start& start, Start* end);
template Task<bool> OptimalPlanner::copy_phases(Work& work, const PhaseLaw& law, const Start& start, Start* end);

}  // namespace nc::optimal
