// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/windows.hpp"

#include <algorithm>
#include <cmath>

#include "motion/optimal/profile.hpp"

namespace nc::optimal {
namespace {

/// Where a law is not found at once: slower to begin with, with other cells, and shorter.
struct Attempt {
  double guess;
  unsigned cells;
  double period;  ///< of the one asked for
};
constexpr Attempt kAttempts[] = {
    {0.7, kMaxCells, 1}, {0.4, kMaxCells, 0.7}, {0.7, kMaxCells / 2, 0.5}, {0.3, kMaxCells / 2, 1.2}};
constexpr double kSpare = 1.3;
constexpr unsigned kTightened = 6;  ///< times that a law is corrected
constexpr double kExcess = 1.0005;  ///< of a limit, that a law may use inside its cells
constexpr double kSamePlace = 1e-9;   ///< mm: a cell is gone through from end to end
constexpr unsigned kLooks = 8;      ///< places inside a cell that are looked at

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
  stop_s_ = 0;
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    if (!(limits.acceleration[i] > 0) || !(limits.jerk[i] > 0)) continue;
    const double v = std::max(limits.velocity[i], limits.rapid[i]);
    stop_s_ =
        std::max(stop_s_, kSpare * (v / limits.acceleration[i] + limits.acceleration[i] / limits.jerk[i]));
  }
}

/// Largest share of a limit of acceleration or jerk in a cell, from the path itself and not from the rows of
/// the solver.
Windows::Excess Windows::excess(unsigned k) const {
  const Piece& p = piece_of(k);
  const double seconds = cell_seconds(law_, mesh_, k);
  const bool rest = (k == 0 && mesh_.from_rest) || k + 1 == law_.cells;
  Excess worst;
  for (unsigned n = 0; n <= kLooks; ++n) {
    const CellState u = cell_state(law_, mesh_, k, seconds * n / kLooks);
    if (n == kLooks && !rest && !(std::fabs(u.x - mesh_.h[k]) <= kSamePlace)) worst.jerk = HUGE_VAL;
    const double v = u.v, j = rest ? 0.5 * std::fabs(law_.slope[k + 1 == law_.cells ? k : 1]) / seconds
                                   : law_.half2[k] * v;
    const CurvePoint q = evaluate(p, std::min(p.length, place(k).x + u.x), limits_.axis_count);
    for (unsigned i = 0; i < limits_.axis_count; ++i) {
      const double a = q.d1[i] * u.a + q.d2[i] * v * v,
                   jerk = q.d1[i] * j + 3 * q.d2[i] * v * u.a + q.d3[i] * v * v * v;
      if (limits_.acceleration[i] > 0) worst.acceleration = std::max(worst.acceleration, std::fabs(a) / limits_.acceleration[i]);
      if (limits_.jerk[i] > 0) worst.jerk = std::max(worst.jerk, std::fabs(jerk) / limits_.jerk[i]);
    }
  }
  return worst;
}

/// Where a cell uses more than a limit between the rows, it may use less of it. @return the largest share.
double Windows::tighten() {
  double worst = 0;
  for (unsigned k = 0; k < law_.cells; ++k) {
    const Excess share = excess(k);
    worst = std::max({worst, share.acceleration, share.jerk});
    const double most = std::max(share.jerk, share.acceleration);
    if (most > kExcess) mesh_.use[k] /= 1.001 * most;
    if (share.acceleration > kExcess) mesh_.use_a[k] /= 1.001 * share.acceleration;
  }
  return worst;
}

/// A law that keeps the limits everywhere; false when none was found.
bool Windows::solve(unsigned tries) {
  for (unsigned t = 0; t < tries; ++t) {
    const Attempt& attempt = kAttempts[t];
    request_.guess = attempt.guess;
    request_.most = std::min(attempt.cells, most_);
    request_.period = period_ * attempt.period;
    mesher_.build(request_, limits_, &mesh_);
    for (unsigned n = 0; n < kTightened; ++n) {
      time_law_.solve(mesh_, limits_, n > 0, &law_);
      iterations_ += law_.iterations;
      solved_ += mesh_.cells;
      if (!law_.ok) break;
      const double share = tighten();
      if (!(share < HUGE_VAL)) break;  // a cell that is not gone through
      if (!(share > kExcess)) return true;
    }
  }
  return false;
}

/// What of the law is kept: where its stop at the end has slowed it, the next one will be faster.
void Windows::settle() {
  more_ = !mesher_.whole();
  keep_ = law_.cells;
  if (!more_) return;
  double back = 0;
  while (keep_ > 1 && back < stop_s_) back += cell_seconds(law_, mesh_, --keep_);
}

bool Windows::law_to(const MeshRequest& request, const Limits& limits, const Goal& goal) {
  request_ = request;
  period_ = goal.period;
  most_ = request.most;
  set_limits(limits);
  if (!solve(goal.once ? 1 : sizeof kAttempts / sizeof kAttempts[0])) return false;
  settle();
  return true;
}

bool Windows::next() {
  if (!more_) return false;
  if (!solve(sizeof kAttempts / sizeof kAttempts[0])) {
    failed_ = true;
    more_ = false;
    return false;
  }
  settle();
  if (!more_) return true;
  request_.from = mesher_.place(keep_);
  request_.from_rest = false;
  request_.b0 = law_.b[keep_];
  request_.slope0 = law_.slope[keep_];
  return true;
}

}  // namespace nc::optimal
