// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/windows.hpp"

#include <algorithm>
#include <cmath>

#include "motion/optimal/profile.hpp"

namespace nc::optimal {
namespace {

constexpr double kSpare = 1.3;
constexpr double kFiner = 4;  ///< a short path from rest to rest has cells of one part in so many of the usual length, which makes it faster by some percent
constexpr double kFinerAgain = 2;  ///< the same for a path for which no law was found
constexpr double kOfMost = 0.95;  ///< a mesh has at most this part of the cells that a law may have
constexpr unsigned kTightened = 6;  ///< a law that exceeds a limit is corrected at most so often
constexpr unsigned kNearby = 32;    ///< cells on either side of one that is to use less, whose speeds become others: those farther away feel next to nothing of it
constexpr unsigned kStepsNearby = 15;  ///< of the solver: where it is found, four to eight do
constexpr unsigned kFewestKept = 8;  ///< between two of them at least so many stay what they are, or none
constexpr double kExcess = 1.0003;  ///< inside its cells a law may use this many times a limit
constexpr double kExcessOfStop = 1.0006;  ///< the same of a stop: what it leaves may use as much as any law, on other cells, and there may be no other way
constexpr double kTighter = 1.001, kTighterStop = 0.9998;  ///< a cell that uses too much may use so many times less than what it is too much by
constexpr double kLonger = 1.02;  ///< a law is good enough when it takes no more than this many times the time of the law in phases, or the estimate
constexpr double kOfPhases = 0.9;  ///< another law that begins with the law in phases begins with this part of its squared speed
constexpr double kGentle = 24;  ///< a law that begins with the law in phases leaves the speed of the start within this many cells
constexpr double kMuchLonger = 4;  ///< where there is no law in phases, another one may take this many times the estimated time
constexpr double kPhaseShares[] = {1, 0.9, 0.75, 0.5, 0.3, 0.1};  ///< parts of the limits that are tried for the law in phases
constexpr double kTurning = 1e-9;  ///< mm/s: a speed below 0 by no more than this is 0 but for rounding
constexpr double kAtEnd = 1e-10;  ///< mm: a law that ends so near to the end of its path ends there
constexpr double kEnds = 1e-4;  ///< a look next to the end of a phase lies inside of it by this part of the distance between two looks
constexpr double kLongestPhases = 2;  ///< s: a law in phases is no longer
constexpr unsigned kPhaseLooks = 8;  ///< at a phase, for every 5 ms and piece
constexpr unsigned kAtOnce = 8;  ///< cells that are looked at before others may have their turn
// Instructions: of the look at a cell for each axis, on a cubic and on another curve, of a look at a phase for each axis, and of a speed.
constexpr int64_t kCubicCost = 800, kQuinticCost = 2000, kCurveCost = 20000, kPhaseCost = 60, kPhaseCurveCost = 500, kSpeedCost = 500;

}  // namespace

void Windows::start(const Piece* piece, unsigned count, const Limits& limits, double period) {
  request_ = {};
  request_.piece = piece;
  request_.count = count;
  period_ = period;
  more_ = count > 0;
  failed_ = false;
  iterations_ = solved_ = 0;
  set_limits(limits);
}

void Windows::set_limits(const Limits& limits) {
  limits_ = limits;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    per_acceleration_[i] = limits.acceleration[i] > 0 ? 1 / limits.acceleration[i] : 0;
    per_jerk_[i] = limits.jerk[i] > 0 ? 1 / limits.jerk[i] : 0;
  }
}

/// The longest time that braking takes, with some to spare, from any speed that feed and axes allow: the law itself may be slow because it
/// ends soon, and the next one shall not be.
double Windows::stopping_time() const {
  double b[kMaxAxes] = {};
  for (unsigned k = 1; k < law_.cells; ++k) {
    const Knot& q = mesh_.knot[k];
    for (unsigned i = 0; i < limits_.axis_count; ++i) b[i] = std::max(b[i], q.d1[i] != 0 ? q.cap * q.d1[i] * q.d1[i] : 0);
  }
  double longest = 0;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    if (!(limits_.acceleration[i] > 0) || !(limits_.jerk[i] > 0)) continue;
    const double v = std::min(std::sqrt(b[i]), std::max(limits_.velocity[i], limits_.rapid[i]));
    longest = std::max(longest, v / limits_.acceleration[i] + limits_.acceleration[i] / limits_.jerk[i]);
  }
  return kSpare * longest;
}

/// The motion in a cell at kLooks places, first and last of them its ends: x, v, v^2, v^3, 3 v a, a and j.
struct Windows::Moments {
  Four x[kFours], v[kFours], v2[kFours], v3[kFours], va[kFours], a[kFours], j[kFours];
};

/// False where the cell is not gone through.
[[gnu::always_inline]] inline bool Windows::moments(unsigned k, Moments* m) const {
  const bool launch = k == 0 && mesh_.from_rest, land = k + 1 == law_.cells;
  const double h = mesh_.h[k];
  // Beside rest with t the share of the time: x = h t^3 from there, v = v1 t^2, a = 2 v1 t / T, j = 2 v1 / T^2.
  const double v1 = std::sqrt(launch ? law_.b[1] : law_.b[k]), per = v1 / (3 * h);
  for (unsigned n = 0; n < kFours; ++n) {
    const double first = 4 * n;
    const Four t = Four{first, first + 1, first + 2, first + 3} / all(kLooks - 1);
    Four v;
    if (launch || land) {
      v = all(v1) * t * t;
      m->x[n] = launch ? all(h) * t * t * t : all(h) - all(h) * t * t * t;
      m->a[n] = (launch ? all(2 * v1 * per) : all(-2 * v1 * per)) * t;
      m->j[n] = all(2 * v1 * per * per);
    } else {
      const Four x = all(h) * t, a = all(0.5 * law_.slope[k]) + all(law_.half2[k]) * x;
      const Four b = all(law_.b[k]) + x * (all(0.5 * law_.slope[k]) + a);
      if (!(std::min(std::min(b[0], b[1]), std::min(b[2], b[3])) > 0)) return false;
      v = root_of(b);
      m->x[n] = x;
      m->a[n] = a;
      m->j[n] = all(law_.half2[k]) * v;
    }
    m->v[n] = v;
    m->v2[n] = v * v;
    m->v3[n] = m->v2[n] * v;
    m->va[n] = all(3) * v * m->a[n];
  }
  return true;
}

namespace {

/// r = sqrt(b) at a place of a cell, with b the squared speed, a = b'/2 and w = b''/2 in it, and its first two derivatives by the place: r' = a/r,
/// r'' = (w - a^2/b)/r. It is the same for all axes.
struct RootShape {
  double b, a, w, r, slope, bend;
};
[[gnu::always_inline]] inline RootShape root_shape(double b, double a, double w) {
  const double r = std::sqrt(b), per = 1 / r, slope = a * per;
  return {b, a, w, r, slope, (w - slope * slope) * per};
}

/// The jerk of an axis by the place x in a cell, and its first two derivatives. With Q = q' w + 3 q'' a + q''' b it is r Q, where on a cubic
/// Q' = 4 q'' w + 5 q''' a, Q'' = 9 q''' w.
struct JerkShape {
  double jerk = 0, slope = 0, bend = 0;
};
[[gnu::always_inline]] inline JerkShape jerk_on_cubic(const Piece& p, double x, const RootShape& root, unsigned axis) {
  const double c1 = p.c[1][axis], c2 = 2 * p.c[2][axis], d3 = 6 * p.c[3][axis];
  const double d2 = c2 + d3 * x, d1 = c1 + x * (c2 + 0.5 * d3 * x);
  const double q = d1 * root.w + 3 * d2 * root.a + d3 * root.b, slope = 4 * d2 * root.w + 5 * d3 * root.a;
  return {root.r * q, root.slope * q + root.r * slope, root.bend * q + 2 * root.slope * slope + 9 * root.r * d3 * root.w};
}

/// What the looks at a cell on a cubic have seen: places from x0 on, `step` apart, with the squared speed and u'' there.
struct JerkLooks {
  const Four *x, *v2, *a;
  unsigned count;
  double x0, step, w;
};
/// The largest jerk of an axis in a cell, between the looks, too: where its derivative changes its sign, the peak of the cubic that has the jerk and its
/// derivative at both of them.
NC_BESIDE_WIDE_VECTORS double peak_jerk(const Piece& p, const JerkLooks& looks, unsigned axis) {
  double worst = 0;
  JerkShape last;
  for (unsigned n = 0; n < looks.count; ++n) {
    const unsigned f = n / 4, e = n % 4;
    const JerkShape now = jerk_on_cubic(p, looks.x0 + looks.x[f][e], root_shape(looks.v2[f][e], looks.a[f][e], looks.w), axis);
    worst = std::max(worst, std::fabs(now.jerk));
    if (n > 0 && (now.slope > 0) != (last.slope > 0)) worst = std::max(worst, peaks_between({last.jerk, last.slope}, {now.jerk, now.slope}, looks.step).a);
    last = now;
  }
  return worst;
}

}  // namespace

/// Largest share of a limit of acceleration or jerk in a cell, from the path itself and not from the rows of
/// the solver.
[[gnu::always_inline]] inline Windows::Excess Windows::excess(unsigned k) const {
  const Piece& p = piece_of(k);
  Moments m;
  if (!moments(k, &m)) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  if (p.curve != nullptr || p.quintic) return excess_on_curve(k, m);
  const bool rests = (k == 0 && mesh_.from_rest) || k + 1 == law_.cells;
  const double h = mesh_.h[k], x0 = place(k).x, w = law_.half2[k], a0 = 0.5 * law_.slope[k], a1 = a0 + w * h;
  const RootShape root0 = root_shape(law_.b[k], a0, w), root1 = root_shape(law_.b[k + 1], a1, w);
  double bulge = 0, bulge_j = 0;  // largest second derivative by x of an acceleration and of a jerk at the ends, as a share of its limit
  Four velocity{}, acceleration{}, jerk{};
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    const double most = velocity_of(p, limits_, i);
    const Four per_v = all(most > 0 ? 1 / most : 0), per_a = all(per_acceleration_[i]), per_j = all(per_jerk_[i]), c1 = all(p.c[1][i]), c2 = all(2 * p.c[2][i]), d3 = all(6 * p.c[3][i]);
    for (unsigned n = 0; n < kFours; ++n) {
      const Four x = all(place(k).x) + m.x[n], d2 = c2 + d3 * x, d1 = c1 + x * (c2 + all(0.5) * d3 * x);
      velocity = larger(velocity, size_of(d1 * m.v[n]) * per_v);
      acceleration = larger(acceleration, size_of(d1 * m.a[n] + d2 * m.v2[n]) * per_a);
      jerk = larger(jerk, size_of(d1 * m.j[n] + d2 * m.va[n] + d3 * m.v3[n]) * per_j);
    }
    const double start = c2[0] + d3[0] * x0, end = start + d3[0] * h;  // q''
    bulge = std::max({bulge, std::fabs(4 * start * w + 5 * d3[0] * a0) * per_a[0], std::fabs(4 * end * w + 5 * d3[0] * a1) * per_a[0]});
    if (rests) continue;
    const JerkShape s0 = jerk_on_cubic(p, x0, root0, i), s1 = jerk_on_cubic(p, x0 + h, root1, i);
    bulge_j = std::max({bulge_j, std::fabs(s0.bend) * per_j[0], std::fabs(s1.bend) * per_j[0]});
  }
  Excess worst{largest(acceleration), largest(jerk), largest(velocity)};
  const double step = h / (kLooks - 1);
  if (rests || worst.acceleration + 0.125 * step * step * bulge > kExcess) worst.acceleration = peak_acceleration(k, m);
  if (!rests && worst.jerk + 0.125 * step * step * bulge_j > kExcess)
    for (unsigned i = 0; i < limits_.axis_count; ++i) worst.jerk = std::max(worst.jerk, per_jerk_[i] * peak_jerk(p, {m.x, m.v2, m.a, kLooks, x0, step, w}, i));
  return worst;
}

/// The largest share of a limit of acceleration in a cell, between the looks, too. On a cubic piece q' u'' + q'' u'^2 is a cubic of x, which is
/// no farther from its chords than an eighth of the square of their length times its second derivative 4 q'' w + 5 q''' u'', linear in x
/// (w = b''/2); where that may be too much its peaks are found. Beside rest it is a polynomial of time. On other curves it is nearly one.
class Windows::AccelerationPeaks {
 public:
  AccelerationPeaks(const Windows& windows, unsigned k, const Moments& m) : windows_(windows), m_(m) {
    const bool launch = k == 0 && windows.mesh_.from_rest, land = k + 1 == windows.law_.cells;
    rests_ = launch || land;
    // By time beside rest, else by x, where the jerk is the speed times the derivative of the acceleration.
    const double v1 = std::sqrt(launch ? windows.law_.b[1] : windows.law_.b[k]);
    back_ = land ? -1 : 1;  // landing is looked at from its end
    step_ = (rests_ ? 3 * windows.mesh_.h[k] / v1 : windows.mesh_.h[k]) / (kLooks - 1);
  }
  /// The looks in their order, each with the derivatives of the path there.
  void look(unsigned n, const CurvePoint& q) {
    const unsigned f = n / 4, e = n % 4;
    const double per = rests_ ? back_ : 1 / m_.v[f][e];
    for (unsigned i = 0; i < windows_.limits_.axis_count; ++i) {
      if (windows_.per_acceleration_[i] == 0) continue;
      const Rates now{q.d1[i] * m_.a[f][e] + q.d2[i] * m_.v2[f][e], per * (q.d1[i] * m_.j[f][e] + q.d2[i] * m_.va[f][e] + q.d3[i] * m_.v3[f][e])};
      worst_ = std::max(worst_, std::fabs(now.a) * windows_.per_acceleration_[i]);
      if (n > 0 && (now.j > 0) != (last_[i].j > 0)) worst_ = std::max(worst_, peaks_between(last_[i], now, step_).a * windows_.per_acceleration_[i]);
      last_[i] = now;
    }
  }
  double worst() const { return worst_; }

 private:
  const Windows& windows_;
  const Moments& m_;
  bool rests_ = false;
  double back_ = 1, step_ = 0, worst_ = 0;
  Rates last_[kMaxAxes];
};

NC_BESIDE_WIDE_VECTORS double Windows::peak_acceleration(unsigned k, const Moments& m) const {
  const Piece& p = piece_of(k);
  AccelerationPeaks peaks(*this, k, m);
  CurvePoint q;
  for (unsigned n = 0; n < kLooks; ++n) {
    derivatives(p, std::min(p.length, place(k).x + m.x[n / 4][n % 4]), limits_.axis_count, &q);
    peaks.look(n, q);
  }
  return peaks.worst();
}

/// The looks at a cell on a piece of degree 5. `seconds`: between two of them, at most. Where the acceleration cannot come to its limit in that time
/// nothing more is to be known about it. False where it may.
inline bool Windows::looks_on_quintic(unsigned k, const Moments& m, double seconds, Excess* out) const {
  const Piece& p = piece_of(k);
  Four velocity{}, acceleration{}, jerk{};
  double least = HUGE_VAL;  // by a jerk within its limit, of the share of an acceleration
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    const double most = velocity_of(p, limits_, i);
    const Four per_v = all(most > 0 ? 1 / most : 0), per_a = all(per_acceleration_[i]), per_j = all(per_jerk_[i]);
    const Four c1 = all(p.c[1][i]), c2 = all(p.c[2][i]), c3 = all(p.c[3][i]), c4 = all(p.c[4][i]), c5 = all(p.c[5][i]);
    for (unsigned n = 0; n < kFours; ++n) {
      const Four x = all(place(k).x) + m.x[n];
      const Four d1 = c1 + x * (all(2) * c2 + x * (all(3) * c3 + x * (all(4) * c4 + x * all(5) * c5)));
      const Four d2 = all(2) * c2 + x * (all(6) * c3 + x * (all(12) * c4 + x * all(20) * c5));
      const Four d3 = all(6) * c3 + x * (all(24) * c4 + x * all(60) * c5);
      velocity = larger(velocity, size_of(d1 * m.v[n]) * per_v);
      acceleration = larger(acceleration, size_of(d1 * m.a[n] + d2 * m.v2[n]) * per_a);
      jerk = larger(jerk, size_of(d1 * m.j[n] + d2 * m.va[n] + d3 * m.v3[n]) * per_j);
    }
    if (per_acceleration_[i] > 0) least = std::min(least, per_jerk_[i] / per_acceleration_[i]);
  }
  *out = {largest(acceleration), largest(jerk), largest(velocity)};
  return least > 0 && out->acceleration + out->jerk * seconds / least <= 1;
}

NC_BESIDE_WIDE_VECTORS Windows::Excess Windows::excess_on_curve(unsigned k, const Moments& m) const {
  const Piece& p = piece_of(k);
  if (p.quintic && !(k == 0 && mesh_.from_rest) && k + 1 != law_.cells) {
    double slowest = HUGE_VAL;
    for (const Four& v : m.v) slowest = std::min({slowest, v[0], v[1], v[2], v[3]});
    Excess looks;
    if (looks_on_quintic(k, m, mesh_.h[k] / ((kLooks - 1) * slowest), &looks)) return looks;
  }
  Excess worst;
  AccelerationPeaks peaks(*this, k, m);
  CurvePoint q;
  for (unsigned n = 0; n < kLooks; ++n) {
    const unsigned f = n / 4, e = n % 4;
    derivatives(p, std::min(p.length, place(k).x + m.x[f][e]), limits_.axis_count, &q);
    for (unsigned i = 0; i < limits_.axis_count; ++i) {
      const double most = velocity_of(p, limits_, i);
      if (most > 0) worst.velocity = std::max(worst.velocity, std::fabs(q.d1[i] * m.v[f][e]) / most);
      worst.jerk = std::max(worst.jerk, std::fabs(q.d1[i] * m.j[f][e] + q.d2[i] * m.va[f][e] + q.d3[i] * m.v3[f][e]) * per_jerk_[i]);
    }
    peaks.look(n, q);
  }
  worst.acceleration = peaks.worst();
  return worst;
}

/// The cell is gone through so many times slower.
void Windows::lower_caps(unsigned k, double times) {
  const double part = 1 / (times * times);
  mesh_.cap[k] *= part;
  mesh_.knot[k].cap = std::min(mesh_.knot[k].cap, mesh_.cap[k]);
  mesh_.knot[k + 1].cap = std::min(mesh_.knot[k + 1].cap, mesh_.cap[k]);
}

/// Where a cell uses more than a limit between the rows, it may use less of it. @return the largest share.
NC_FOR_WIDE_VECTORS double Windows::tighten(unsigned from, unsigned to) {
  double worst = 0;
  const double tighter = mesh_.stops ? kTighterStop : kTighter;
  for (unsigned k = from; k < to; ++k) {
    exceeds_[k] = false;
    const unsigned before = k > 0 ? k - 1 : 0, behind = std::min(k + 1, mesh_.cells - 1);
    if (mesh_.level[before] && mesh_.level[k] && mesh_.level[behind]) continue;  // the mesh has looked at it
    if (mesh_.kept[before] && mesh_.kept[k] && mesh_.kept[behind]) continue;     // it is as it was
    const Excess share = excess(k);
    worst = std::max({worst, share.acceleration, share.jerk, share.velocity});
    if (share.velocity > kExcess) lower_caps(k, 1.001 * share.velocity);
    const double most = std::max(share.jerk, share.acceleration);
    if (most > kExcess) mesh_.use[k] /= tighter * most;
    if (share.acceleration > kExcess) mesh_.use_a[k] /= tighter * share.acceleration;
    exceeds_[k] = std::max(most, share.velocity) > kExcess;
  }
  return worst;
}

int64_t Windows::look_cost(unsigned k) const {
  const Piece& p = piece_of(k);
  return limits_.axis_count * (p.curve != nullptr ? kCurveCost : p.quintic ? kQuinticCost : kCubicCost);
}

Task<double> Windows::tighten(Work& work) {
  double worst = 0;
  for (unsigned k = 0; k < law_.cells;) {
    const unsigned from = k;
    int64_t cost = 0;
    for (; k < law_.cells && k < from + kAtOnce && cost < kCurveCost; ++k) cost += look_cost(k);
    worst = std::max(worst, tighten(from, k));
    co_await work.pause(cost);
  }
  co_return worst;
}

/// Only the cells about those that are to use less become others.
void Windows::keep_others() {
  std::fill(mesh_.kept, mesh_.kept + mesh_.cells, false);
  unsigned end = 0;  // of the cells that become others
  for (unsigned k = 0; k <= mesh_.cells; ++k) {
    if (k < mesh_.cells && !exceeds_[k]) continue;
    const unsigned from = k < mesh_.cells ? (k > kNearby ? k - kNearby : 0) : mesh_.cells;
    if (from >= end + kFewestKept) std::fill(mesh_.kept + end, mesh_.kept + from, true);
    end = std::max(end, std::min(mesh_.cells, k + kNearby + 1));
  }
}

/// The law of the mesh once more, where some cells are to use less of a limit.
Task<bool> Windows::solve_again(Work& work) {
  if (!mesh_.stops) {
    keep_others();
    const bool solved = co_await time_law_.solve(work, mesh_, limits_, TimeLaw::Begins::nearby, &law_, std::min(steps_, kStepsNearby));
    iterations_ += law_.iterations;
    if (solved) co_return true;
    std::fill(mesh_.kept, mesh_.kept + mesh_.cells, false);
  }
  const bool solved = co_await time_law_.solve(work, mesh_, limits_, TimeLaw::Begins::again, &law_, steps_);
  iterations_ += law_.iterations;
  co_return solved;
}

/// The law of the mesh, with less of the limits where it uses more than all of them.
Task<bool> Windows::corrected(Work& work) {
  std::fill(mesh_.kept, mesh_.kept + mesh_.cells, false);
  for (unsigned n = 0; n < kTightened; ++n) {
    bool solved = false;
    if (n == 0) {
      solved = co_await time_law_.solve(work, mesh_, limits_, TimeLaw::Begins::anew, &law_, steps_);
      iterations_ += law_.iterations;
    } else {
      solved = co_await solve_again(work);
    }
    solved_ += mesh_.cells;
    if (!solved) co_return false;
    const double share = co_await tighten(work);
    if (!(share < HUGE_VAL)) co_return false;  // a cell that is not gone through
    if (!(share > (mesh_.stops ? kExcessOfStop : kExcess))) co_return true;
  }
  co_return false;
}

/// What was asked for, no farther than the mesh goes.
MeshRequest Windows::same_way() const {
  MeshRequest same = request_;
  double length = 0;
  for (unsigned k = 0; k < mesh_.cells; ++k) length += mesh_.h[k];
  same.reach = std::min(same.reach, length);
  return same;
}

/// The law takes no longer than the one that is known over the same way. That one need not be made where the law is as fast as the estimate that
/// the cells go by, which knows of no way up and down between neighbouring places; where there is none, no more than a few times as long.
Task<bool> Windows::soon_enough(Work& work) {
  if (law_.seconds <= kLonger * mesher_.least_seconds()) co_return true;
  const MeshRequest same = same_way();
  const bool found = co_await known_.find(work, same, limits_, &phases_);
  if (found && known_.whole()) co_return law_.seconds <= kLonger* known_.seconds();
  co_return law_.seconds <= kMuchLonger* mesher_.least_seconds();
}

/// A state of a law in phases, `step` seconds behind the last one that was looked at.
bool Windows::phase_keeps_limits(const MeshRequest& request, const LineState& s, double jerk, double step, PhaseLook* look) const {
  for (; look->piece + 1 < request.count && s.s > look->begun + request.at(look->piece).length; look->goes_on = false)
    look->begun += request.at(look->piece++).length;
  const Piece& p = request.at(look->piece);
  CurvePoint q;
  derivatives(p, std::clamp(s.s - look->begun, 0.0, p.length), limits_.axis_count, &q);
  if (!(s.v >= -kTurning)) return false;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    Rates& last = look->last[i];
    const double most = velocity_of(p, limits_, i), a = q.d1[i] * s.a + q.d2[i] * s.v * s.v,
                 j = q.d1[i] * jerk + 3 * q.d2[i] * s.v * s.a + q.d3[i] * s.v * s.v * s.v;
    if (most > 0 && !(std::fabs(q.d1[i] * s.v) <= kExcess * most)) return false;
    if (!(std::fabs(a) * per_acceleration_[i] <= kExcess * acceleration_share(p, limits_))) return false;
    if (!(std::fabs(j) * per_jerk_[i] <= kExcess * jerk_share(p, limits_))) return false;
    if (look->goes_on && (j > 0) != (last.j > 0) && !(peaks_between(last, {a, j}, step).a * per_acceleration_[i] <= kExcess * acceleration_share(p, limits_)))
      return false;
    last = {a, j};
  }
  return true;
}

/// The law in phases, at some places of every 5 ms and of each piece that it lies on.
Task<bool> Windows::phases_keep_limits(Work& work, const MeshRequest& request) {
  LineState from = phases_.start();
  PhaseLook look;
  look.piece = request.from.piece;
  look.begun = -request.from.x;
  for (unsigned k = 0; k < phases_.count(); ++k) {
    const Phase& phase = phases_.phase(k);
    const LineState end = from.behind(phase.jerk, phase.seconds);
    unsigned pieces = 1;
    double edge = look.begun;
    for (unsigned n = look.piece; n + 1 < request.count && (edge += request.at(n).length) < end.s; ++n) ++pieces;
    const unsigned looks = kPhaseLooks * (pieces + static_cast<unsigned>(std::min(phase.seconds / period_, 1000.0)));
    const double step = phase.seconds / (looks + 2 * kEnds);
    for (unsigned n = 0; n <= looks; ++n) {  // hardly inside of its ends, where pieces may meet
      look.goes_on = n > 0;
      if (!phase_keeps_limits(request, from.behind(phase.jerk, step * (n + kEnds)), phase.jerk, step, &look)) co_return false;
      co_await work.pause(limits_.axis_count * (request.at(look.piece).curve != nullptr ? kPhaseCurveCost : kPhaseCost));
    }
    from = end;
  }
  co_return std::fabs(from.s - phases_.distance()) <= kAtEnd&& std::fabs(from.v) <= kTurning;
}

Task<bool> Windows::phases_to(Work& work, const MeshRequest& request, const Limits& limits) {
  set_limits(limits);
  for (const double share : kPhaseShares) {
    const bool found = co_await phases_.find(work, request, limits_, share);
    if (!found) {
      if (request.from_rest) continue;
      co_return false;  // with less of the limits there is none, too
    }
    const bool kept = co_await phases_keep_limits(work, request);
    if (!kept) continue;
    if (phases_.seconds() <= kLongestPhases) co_return true;
    const bool rests = co_await rest_earlier(work, request, share);
    co_return rests;
  }
  co_return false;
}

Task<unsigned> Windows::leaves_at(Work& work, const MeshRequest& request, const Limits& limits) {
  const bool found = co_await known_.find(work, request, limits, &phases_);
  co_return found && !known_.rests() ? known_.leaves_at() : kNone;
}

/// A plan is changed between cells, and there are so many of them at most: those of a law that takes hours would take seconds each, and an
/// override that is raised meanwhile would wait for the end of one. So it rests earlier, and what is kept of it is what comes before
/// that stop.
Task<bool> Windows::rest_earlier(Work& work, const MeshRequest& request, double share) {
  MeshRequest nearer = request;
  nearer.reach = phases_.way_after(kLongestPhases);
  bool found = co_await phases_.find(work, nearer, limits_, share);
  if (found) found = co_await phases_keep_limits(work, nearer);
  if (!found) {
    found = co_await phases_.find(work, request, limits_, share);
    co_return found;
  }
  phases_.ends_early();
  co_return true;
}

/// The law of cells that begins with the one that is known: where feeds of several sizes lie side by side, what the estimate gives breaks
/// limits so many times that the solver never comes back from there.
Task<bool> Windows::from_phases(Work& work) {
  request_.guess = kAttempts[0].guess;
  request_.most = most_;
  request_.period = period_;
  co_await mesher_.build(work, request_, limits_, &mesh_);
  if (mesh_.cells == 0) co_return false;
  const MeshRequest same = same_way();
  const bool found = co_await known_.find(work, same, limits_, &phases_);
  if (!found || known_.rests() || !known_.whole()) co_return false;
  double u = 0;
  for (unsigned k = 0; k < mesh_.cells; ++k) {
    const double away = request_.from_rest ? 1 : std::min(1.0, k / kGentle), share = 1 - (1 - kOfPhases) * away * away * (3 - 2 * away);
    mesh_.guess[k] = std::max(share * known_.squared_speed(u + 0.5 * mesh_.h[k]), 1e-8);
    u += mesh_.h[k];
    co_await work.pause(kSpeedCost);
  }
  std::fill(mesh_.level, mesh_.level + mesh_.cells, false);
  mesh_.levels = 0;
  const bool taken = co_await take(work);
  co_return taken;
}

/// The cells of an attempt; those of a short path from rest to rest are finer.
Task<bool> Windows::lay_cells(Work& work, const Attempt& attempt, bool first) {
  request_.guess = attempt.guess;
  request_.most = std::min(attempt.cells, most_);
  request_.period = period_ * attempt.period;
  co_await mesher_.build(work, request_, limits_, &mesh_);
  const double finer = std::min(first ? kFiner : kFinerAgain, kOfMost * request_.most / (mesh_.cells + 1));
  if (!(request_.from_rest && request_.count > 1 && mesher_.whole() && finer > 1)) co_return true;
  const double plain = request_.period;
  request_.period /= finer;
  co_await mesher_.build(work, request_, limits_, &mesh_);
  if (mesh_.cells == 0 || !mesher_.whole()) {  // too many of them
    request_.period = plain;
    co_await mesher_.build(work, request_, limits_, &mesh_);
  }
  co_return true;
}

/// The law of the mesh, if it keeps the limits and does not crawl.
Task<bool> Windows::take(Work& work) {
  const bool found = co_await corrected(work);
  if (!found) co_return false;
  const bool soon = co_await soon_enough(work);
  co_return soon;
}

/// A law that keeps the limits everywhere; false when none was found.
Task<bool> Windows::solve(Work& work, unsigned tries) {
  for (unsigned t = 0; t < tries; ++t) {
    co_await lay_cells(work, kAttempts[t], t == 0);
    bool taken = co_await take(work);
    if (taken) co_return true;
    if (mesh_.levels > 0) {
      std::fill(mesh_.level, mesh_.level + mesh_.cells, false);
      mesh_.levels = 0;
      taken = co_await take(work);
      if (taken) co_return true;
    }
    if (t > 0 || request_.chain != nullptr) continue;
    taken = co_await from_phases(work);
    if (taken) co_return true;
  }
  co_return false;
}

/// What of the law is kept: where its stop at the end has slowed it, the next one will be faster.
void Windows::settle() {
  more_ = !mesher_.whole();
  keep_ = law_.cells;
  stop_s_ = stopping_time();
  if (!more_) return;
  double back = 0;
  while (keep_ > 1 && back < stop_s_) back += cell_seconds(law_, mesh_, --keep_);
  keep_ = better_start(keep_, [this](unsigned k) { return law_.slope[k]; });
}

Task<bool> Windows::law_to(Work& work, const MeshRequest& request, const Limits& limits, const Goal& goal) {
  request_ = request;
  period_ = goal.period;
  most_ = request.most;
  steps_ = goal.steps;
  set_limits(limits);
  const bool solved = co_await solve(work, goal.once ? 1 : sizeof kAttempts / sizeof kAttempts[0]);
  if (!solved) co_return false;
  settle();
  work.spend(kSpeedCost * (law_.cells - keep_) + kPhaseCost * law_.cells);
  co_return true;
}

Task<bool> Windows::next(Work& work) {
  if (!more_) co_return false;
  const bool solved = co_await solve(work, sizeof kAttempts / sizeof kAttempts[0]);
  if (!solved) {
    failed_ = true;
    more_ = false;
    co_return false;
  }
  settle();
  if (!more_) co_return true;
  request_.from = mesher_.place(keep_);
  request_.from_rest = false;
  request_.first_cells = 0;
  for (unsigned k = keep_; k + 1 < law_.cells && request_.first_cells < kFirstCells; ++k) request_.first_h[request_.first_cells++] = mesh_.h[k];
  request_.b0 = law_.b[keep_];
  request_.slope0 = law_.slope[keep_];
  co_return true;
}

}  // namespace nc::optimal
