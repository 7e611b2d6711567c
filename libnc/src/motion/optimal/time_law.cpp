// SPDX-License-Identifier: Apache-2.0
// A primal-dual interior-point method. Rows are r(c) <= 1 with slack s and multiplier l; one step solves
//     (H + sum l/s g g') dc = -grad T - sum g (mu/s + l/s rho),   rho = r + s - 1,   g = grad r,
// H the (diagonal, positive) second derivative of the time. The second derivative of the jerk rows (their
// root) is left out: that changes the way, not the goal, because rho is always that of the true row.
//
// A step goes through the rows twice: rows() ends the last one, finds r and adds up matrix and right side; directions() finds the steps
// of slacks and multipliers. Everything that a row needs lies together, two rows to a vector.
#include "motion/optimal/time_law.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr unsigned kIterations = 60;
constexpr double kGap = 2e-4;       ///< of the time, that the result may be longer than the optimum
constexpr double kInside = 0.9998;  ///< of the limits, that the law may use
constexpr double kInsideCurve =
    0.996;  ///< the same of the jerk where the path bends: between the rows it may be a little more
constexpr double kToWall = 0.99;  ///< of the way to the nearest wall, that one step may go
constexpr double kResidual = 0.05;
constexpr double kSmallestSlack = 0.5;
constexpr double kGapFirst = 0.4;      ///< of the time
constexpr double kSlackAgain = 0.003;   ///< the same from a solution of nearly the same rows
constexpr double kGapAgain = 0.003;
constexpr double kStartUse = 1.004;    ///< of the acceleration at a given start: nothing there can become less

inline Two both(double x) {
  return Two{x, x};
}
inline Two larger(Two a, Two b) {
  return a > b ? a : b;
}
inline Two smaller(Two a, Two b) {
  return a < b ? a : b;
}
inline double sum(Two a) {
  return a[0] + a[1];
}
inline double largest(Two a) {
  return std::max(a[0], a[1]);
}
inline double smallest(Two a) {
  return std::min(a[0], a[1]);
}

}  // namespace

/// b, b' and b''/2 by the control values.
void TimeLaw::forms() {
  const Mesh& m = *mesh_;
  n_ = m.cells;
  first_ = 1;
  last_ = n_ - 1;
  for (unsigned k = 1; k < n_; ++k) {
    const double per = 1 / (m.h[k - 1] + m.h[k]);
    at_[k] = {{m.h[k] * per, m.h[k - 1] * per, 0}};
    slope_[k] = {{-2 * per, 2 * per, 0}};
  }
  // At a given start as if a cell as long lay in front of it.
  at_[0] = m.from_rest ? Form{} : Form{{0.5, 0.5, 0}};
  slope_[0] = m.from_rest ? Form{} : Form{{-1 / m.h[0], 1 / m.h[0], 0}};
  at_[n_] = slope_[n_] = {};
  const double share_end = 1 / (1 + 2 * m.h[n_ - 2] / (3 * m.h[n_ - 1]));
  at_[n_ - 1] = {{share_end, 0, 0}};
  slope_[n_ - 1] = {{-share_end * 4 / (3 * m.h[n_ - 1]), 0, 0}};
  double share_start = 0;
  if (m.from_rest) {
    share_start = 1 / (1 + 2 * m.h[1] / (3 * m.h[0]));
    at_[1] = {{0, share_start, 0}};
    slope_[1] = {{0, share_start * 4 / (3 * m.h[0]), 0}};
  }
  for (unsigned k = 0; k < n_; ++k) {
    const double per = 0.5 / m.h[k];
    const Form &a = slope_[k], &b = slope_[k + 1];
    half2_[k] = {{-per * a.g[0], per * (b.g[0] - a.g[1]), per * b.g[1]}};
  }
  if (m.from_rest) half2_[0] = {{0, 0, share_start * (2.0 / 9) / (m.h[0] * m.h[0])}};
  half2_[n_ - 1] = {{share_end * (2.0 / 9) / (m.h[n_ - 1] * m.h[n_ - 1]), 0, 0}};
  for (unsigned k = 0; k < n_; ++k) weight_[k] = m.h[k];
  if (m.from_rest) weight_[1] += 3 * m.h[0] / std::sqrt(share_start);
  weight_[n_ - 2] += 3 * m.h[n_ - 1] / std::sqrt(share_end);
}

void TimeLaw::moving_axes() {
  axes_ = 0;
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    bool moves = false;
    for (unsigned k = 0; k <= n_ && !moves; ++k) {
      const Knot& q = mesh_->knot[k];
      moves = q.d1[i] != 0 || q.d2[i] != 0 || q.left3[i] != 0 || q.right3[i] != 0;
    }
    if (moves && (limits_->jerk[i] > 0 || limits_->acceleration[i] > 0)) axis_[axes_++] = i;
  }
}

/// The rows without their roots. Jerk inside a cell: without its root it is a quadratic of u where the path is a cubic, so it stays below
/// the largest of its ends, which have rows of their own, and its middle Bezier coefficient; the root is largest where b is.
void TimeLaw::fill_rows() {
  const Mesh& m = *mesh_;
  static constexpr Form kNone{};
  for (unsigned k = 0; k < n_; ++k) {
    const bool launch = k == 0 && m.from_rest, land = k + 1 == n_;
    const Form &b0 = at_[k], &b1 = at_[k + 1], &half = half2_[k];
    const Form s0 = slope_[k], s1{{0, slope_[k + 1].g[0], slope_[k + 1].g[1]}};
    for (unsigned e = 0; e < 3; ++e) {
      root_[k][0].at[e] = Two{b0.g[e], e > 0 && !land ? b1.g[e - 1] : 0};
      root_[k][1].at[e] = Two{e == 1 ? 1.0 : 0.0, 0};
    }
    const Knot &left = m.knot[k], &right = m.knot[k + 1];
    const Inside& in = m.inside[k];
    const double use_a = k == 0 ? kStartUse : std::min(m.use_a[k - 1], m.use_a[k]);
    for (unsigned n = 0; n < axes_; ++n) {
      const unsigned i = axis_[n];
      const double per_j = limits_->jerk[i] > 0 ? 1 / (m.use[k] * limits_->jerk[i]) : 0;
      const auto jerk = [&](bool bends) { return per_j * (bends ? 1 / kInsideCurve : 1 / kInside); };
      const double j0 = launch ? 0 : jerk(left.d2[i] != 0 || left.left3[i] != 0 || left.right3[i] != 0),
                   j1 = land ? 0 : jerk(right.d2[i] != 0 || right.left3[i] != 0 || right.right3[i] != 0),
                   jm = launch || land ? 0 : jerk(in.d2_start[i] != 0 || in.d2_end[i] != 0 || in.d3[i] != 0),
                   a = launch || !(limits_->acceleration[i] > 0) ? 0 : 1 / (kInside * use_a * limits_->acceleration[i]);
      Rows* x = row_ + 2 * (k * axes_ + n);
      for (unsigned e = 0; e < 3; ++e) {
        const double at1 = (e > 0 ? b1 : kNone).g[e > 0 ? e - 1 : 0];
        x[0].g[e] = Two{j0 * (left.d1[i] * half.g[e] + 1.5 * left.d2[i] * s0.g[e] + left.right3[i] * b0.g[e]),
                        j1 * (right.d1[i] * half.g[e] + 1.5 * right.d2[i] * s1.g[e] + right.left3[i] * at1)};
        x[1].g[e] = Two{jm * (in.d1[i] * half.g[e] + 0.75 * (in.d2_end[i] * s0.g[e] + in.d2_start[i] * s1.g[e]) + (e == 1 ? in.d3[i] : 0)),
                        a * (0.5 * left.d1[i] * s0.g[e] + left.d2[i] * b0.g[e])};
      }
    }
    const double knot = k > 0 ? 1 / m.knot[k].cap : 0, cell = k >= first_ && k < last_ ? 1 / m.cap[k] : 0;
    cap_[k].g[0] = Two{knot * b0.g[0], 0};
    cap_[k].g[1] = Two{knot * b0.g[1], cell};
  }
  rows_ = n_ * (8 * axes_ + 2);
}

/// The roots of cell k: b at its ends and the largest b inside.
void TimeLaw::roots(unsigned k) {
  const unsigned base = k + kPad - 1;
  const double b0 = value(at_[k], base), b1 = value(at_[k + 1], base + 1);
  const double slope0 = value(slope_[k], base), slope1 = value(slope_[k + 1], base + 1), c = c_[k + kPad];
  const double peak = slope0 > 0 && slope1 < 0 ? b0 + 0.5 * mesh_->h[k] * slope0 * slope0 / (slope0 - slope1) : std::max(b0, b1);
  Roots &ends = root_[k][0], &middle = root_[k][1];
  ends.root = Two{std::sqrt(b0), std::sqrt(b1)};
  ends.half_per = Two{b0 > 0 ? 0.5 / b0 : 0, b1 > 0 ? 0.5 / b1 : 0};
  middle.root = Two{std::sqrt(peak), 1};
  middle.half_per = Two{c > 0 ? 0.5 / c : 0, 0};
}

/// All rows at c, and what they give to the matrix and the right side. A slack that is smaller than its row leaves is made as large.
/// kFirst: slacks of at least `least` begin, with multipliers of mu / s; else the last step is gone first.
template <bool kFirst>
TimeLaw::Sums TimeLaw::rows(double mu, double least) {
  for (unsigned k = 0; k < n_ + 2 * kPad; ++k) diag_[k] = off1_[k] = off2_[k] = side_[k] = side_mu_[k] = 0;
  const Two one = both(1), primal = both(primal_), dual = both(dual_), first_mu = both(mu), first_least = both(least);
  Two gap{}, residual{}, worst{};
  for (unsigned k = 0; k < n_; ++k) {
    const unsigned base = k + kPad - 1;
    const Two c0 = both(c_[base]), c1 = both(c_[base + 1]), c2 = both(c_[base + 2]);
    roots(k);
    Two m00{}, m01{}, m02{}, m11{}, m12{}, m22{}, a0{}, a1{}, a2{}, d0{}, d1{}, d2{};
    Rows* const cell = row_ + 2 * k * axes_;
    for (unsigned half = 0; half < 2; ++half) {
      const Roots& q = root_[k][half];
      for (unsigned n = 0; n < axes_; ++n) {
        Rows& x = cell[2 * n + half];
        const Two r = q.root * (x.g[0] * c0 + x.g[1] * c1 + x.g[2] * c2), bend = r * q.half_per;
        const Two low = one - r, high = one + r;
        Two s0, s1, l0, l1;
        if constexpr (kFirst) {
          s0 = larger(low, first_least);
          s1 = larger(high, first_least);
          l0 = first_mu / s0;
          l1 = first_mu / s1;
        } else {
          s0 = larger(low, x.s[0] + primal * x.ds[0]);
          s1 = larger(high, x.s[1] + primal * x.ds[1]);
          l0 = x.l[0] + dual * x.dl[0];
          l1 = x.l[1] + dual * x.dl[1];
        }
        x.r = r;
        x.s[0] = s0;
        x.s[1] = s1;
        x.l[0] = l0;
        x.l[1] = l1;
        gap += s0 * l0 + s1 * l1;
        const Two rho0 = s0 - low, rho1 = s1 - high;
        residual = larger(residual, larger(rho0, rho1));
        worst = larger(worst, larger(r, -r));
        const Two per = one / (s0 * s1), per0 = per * s1, per1 = per * s0, w0 = l0 * per0, w1 = l1 * per1, w = w0 + w1;
        const Two t = w0 * rho0 - w1 * rho1, t_mu = per0 - per1;
        const Two g0 = q.root * x.g[0] + bend * q.at[0], g1 = q.root * x.g[1] + bend * q.at[1], g2 = q.root * x.g[2] + bend * q.at[2];
        const Two w0g = w * g0, w1g = w * g1;
        m00 += w0g * g0;
        m01 += w0g * g1;
        m02 += w0g * g2;
        m11 += w1g * g1;
        m12 += w1g * g2;
        m22 += w * g2 * g2;
        a0 += g0 * t;
        a1 += g1 * t;
        a2 += g2 * t;
        d0 += g0 * t_mu;
        d1 += g1 * t_mu;
        d2 += g2 * t_mu;
      }
    }
    Caps& x = cap_[k];
    const Two r = x.g[0] * c0 + x.g[1] * c1, low = one - r;
    if constexpr (kFirst) {
      x.s = larger(low, first_least);
      x.l = first_mu / x.s;
    } else {
      x.s = larger(low, x.s + primal * x.ds);
      x.l += dual * x.dl;
    }
    x.r = r;
    gap += x.s * x.l;
    const Two rho = x.s - low, per = one / x.s, w = x.l * per, t = w * rho;
    residual = larger(residual, rho);
    worst = larger(worst, r);
    m00 += w * x.g[0] * x.g[0];
    m01 += w * x.g[0] * x.g[1];
    m11 += w * x.g[1] * x.g[1];
    a0 += x.g[0] * t;
    a1 += x.g[1] * t;
    d0 += x.g[0] * per;
    d1 += x.g[1] * per;
    diag_[base] += sum(m00);
    diag_[base + 1] += sum(m11);
    diag_[base + 2] += sum(m22);
    off1_[base] += sum(m01);
    off1_[base + 1] += sum(m12);
    off2_[base] += sum(m02);
    side_[base] -= sum(a0);
    side_[base + 1] -= sum(a1);
    side_[base + 2] -= sum(a2);
    side_mu_[base] -= sum(d0);
    side_mu_[base + 1] -= sum(d1);
    side_mu_[base + 2] -= sum(d2);
  }
  return {sum(gap), largest(residual), largest(worst)};
}

double TimeLaw::time() const {
  double seconds = 0;
  for (unsigned k = first_; k < last_; ++k) seconds += weight_[k] / std::sqrt(c_[k + kPad]);
  return seconds;
}

/// Of the step towards mu; the second derivative of the time goes into the matrix.
void TimeLaw::right_side(double mu) {
  for (unsigned k = first_ + kPad; k < last_ + kPad; ++k) {
    const double per = 1 / c_[k], w = weight_[k - kPad] * per * std::sqrt(per);
    diag_[k] += 0.75 * w * per;
    dc_[k] = 0.5 * w + side_[k] + mu * side_mu_[k];  // minus the gradient of the time
  }
}

/// L D L' of the band; what is not free stays where it is. dc_ holds the right side and then the step.
bool TimeLaw::factor_and_solve() {
  for (unsigned k = 0; k < n_ + 2 * kPad; ++k) {
    if (k >= first_ + kPad && k < last_ + kPad) continue;
    diag_[k] = 1;
    dc_[k] = 0;
    off1_[k] = off2_[k] = 0;
    if (k >= 1) off1_[k - 1] = 0;
    if (k >= 2) off2_[k - 2] = 0;
  }
  const unsigned end = last_ + kPad;
  for (unsigned k = first_ + kPad; k < end; ++k) {
    const double d = diag_[k];
    if (!(d > 0)) return false;
    const double per = 1 / d, l1 = off1_[k] * per, l2 = off2_[k] * per;
    diag_[k + 1] -= l1 * off1_[k];
    off1_[k + 1] -= l1 * off2_[k];
    diag_[k + 2] -= l2 * off2_[k];
    dc_[k + 1] -= l1 * dc_[k];
    dc_[k + 2] -= l2 * dc_[k];
    off1_[k] = l1;
    off2_[k] = l2;
    dc_[k] *= per;
  }
  for (unsigned k = end; k < n_ + 2 * kPad; ++k) dc_[k] = 0;
  for (unsigned k = end; k-- > first_ + kPad;) dc_[k] -= off1_[k] * dc_[k + 1] + off2_[k] * dc_[k + 2];
  return true;
}

/// No step reaches the wall of these rows.
void TimeLaw::shorten(const Rows& x) {
  for (unsigned side = 0; side < 2; ++side) {
    for (unsigned lane = 0; lane < 2; ++lane) {
      const double s = x.s[side][lane], l = x.l[side][lane], ds = x.ds[side][lane], dl = x.dl[side][lane];
      if (-ds * primal_ > kToWall * s) primal_ = kToWall * s / -ds;
      if (-dl * dual_ > kToWall * l) dual_ = kToWall * l / -dl;
    }
  }
}

/// The steps of slacks and multipliers that belong to dc_, how far they may be gone, and the one of c gone.
void TimeLaw::directions(double target) {
  const Two one = both(1), mu = both(target), wall = both(kToWall);
  primal_ = dual_ = 1;
  for (unsigned k = first_ + kPad; k < last_ + kPad; ++k) {
    if (c_[k] + primal_ * dc_[k] < 0.2 * c_[k]) primal_ = -0.8 * c_[k] / dc_[k];
    if (primal_ * dc_[k] > 4 * c_[k]) primal_ = 4 * c_[k] / dc_[k];
  }
  for (unsigned k = 0; k < n_; ++k) {
    const unsigned base = k + kPad - 1;
    const Two d0 = both(dc_[base]), d1 = both(dc_[base + 1]), d2 = both(dc_[base + 2]);
    const Two primal = both(primal_), dual = both(dual_);
    Two room = one;
    Rows* const cell = row_ + 2 * k * axes_;
    for (unsigned half = 0; half < 2; ++half) {
      const Roots& q = root_[k][half];
      const Two bend = q.half_per * (q.at[0] * d0 + q.at[1] * d1 + q.at[2] * d2);
      for (unsigned n = 0; n < axes_; ++n) {
        Rows& x = cell[2 * n + half];
        const Two s0 = x.s[0], s1 = x.s[1], l0 = x.l[0], l1 = x.l[1];
        const Two gd = q.root * (x.g[0] * d0 + x.g[1] * d1 + x.g[2] * d2) + x.r * bend, r = x.r + gd;
        const Two ds0 = (one - r) - s0, ds1 = (one + r) - s1, per = one / (s0 * s1);
        const Two dl0 = (mu - l0 * ds0) * (per * s1) - l0, dl1 = (mu - l1 * ds1) * (per * s0) - l1;
        x.ds[0] = ds0;
        x.ds[1] = ds1;
        x.dl[0] = dl0;
        x.dl[1] = dl1;
        room = smaller(room, smaller(ds0 * primal + wall * s0, ds1 * primal + wall * s1));
        room = smaller(room, smaller(dl0 * dual + wall * l0, dl1 * dual + wall * l1));
      }
    }
    if (smallest(room) < 0) {
      for (unsigned n = 0; n < 2 * axes_; ++n) shorten(cell[n]);
    }
    Caps& x = cap_[k];
    x.ds = one - x.r - x.s - (x.g[0] * d0 + x.g[1] * d1);
    x.dl = (mu - x.l * x.ds) / x.s - x.l;
    for (unsigned lane = 0; lane < 2; ++lane) {
      if (-x.ds[lane] * primal_ > kToWall * x.s[lane]) primal_ = kToWall * x.s[lane] / -x.ds[lane];
      if (-x.dl[lane] * dual_ > kToWall * x.l[lane]) dual_ = kToWall * x.l[lane] / -x.dl[lane];
    }
  }
  for (unsigned k = first_ + kPad; k < last_ + kPad; ++k) c_[k] += primal_ * dc_[k];
}

void TimeLaw::finish(Law* law) {
  const Mesh& m = *mesh_;
  law->cells = n_;
  law->b[0] = m.from_rest ? 0 : m.b0;
  law->slope[0] = m.from_rest ? 0 : m.slope0;
  law->b[n_] = law->slope[n_] = 0;
  for (unsigned k = 1; k < n_; ++k) {
    law->b[k] = value(at_[k], k + kPad - 1);
    law->slope[k] = value(slope_[k], k + kPad - 1);
  }
  for (unsigned k = 0; k < n_; ++k) law->half2[k] = value(half2_[k], k + kPad - 1);
}

void TimeLaw::solve(const Mesh& mesh, const Limits& limits, bool again, Law* law) {
  mesh_ = &mesh;
  limits_ = &limits;
  law->ok = false;
  law->cells = 0;
  law->iterations = 0;
  if (mesh.cells < 4 || mesh.cells > kMaxCells) return;
  forms();
  moving_axes();
  fill_rows();
  for (unsigned k = 0; k < kPad; ++k) c_[k] = c_[n_ + kPad + k] = 0;
  for (unsigned k = 0; k < n_ && !again; ++k) c_[k + kPad] = mesh.guess[k];
  c_[kPad] = mesh.from_rest ? 0 : mesh.b0 + 0.5 * mesh.slope0 * mesh.h[0];
  c_[kPad - 1] = mesh.from_rest ? 0 : mesh.b0 - 0.5 * mesh.slope0 * mesh.h[0];
  c_[n_ - 1 + kPad] = 0;
  Sums sums = rows<true>((again ? kGapAgain : kGapFirst) * time() / rows_, again ? kSlackAgain : kSmallestSlack);
  for (unsigned n = 0; n < kIterations; ++n) {
    const double seconds = time();
    law->iterations = n;
    law->seconds = seconds;
    law->worst = sums.worst * kInside;
    if (sums.gap < kGap * seconds && sums.worst < 1.0005) {
      law->ok = true;
      finish(law);
      return;
    }
    const double average = sums.gap / rows_;
    // Not nearer to the walls than the rows are to being kept: else the steps become short.
    const double target = std::max((sums.residual > 0.3    ? 0.5
                                    : sums.residual > 1e-3 ? 0.3
                                                           : 0.1) *
                                       average,
                                   kResidual * sums.residual * seconds / rows_);
    right_side(target);
    if (!factor_and_solve()) return;
    directions(target);
    sums = rows<false>(0, 0);
  }
}

}  // namespace nc::optimal
