// SPDX-License-Identifier: Apache-2.0
// A primal-dual interior-point method. Rows are r(c) <= 1 with slack s and multiplier l; one step solves
//     (H + sum l/s g g') dc = -grad T - sum g (mu/s + l/s rho),   rho = r + s - 1,   g = grad r,
// H the (diagonal, positive) second derivative of the time. The second derivative of the jerk rows (their
// root) is left out: that changes the way, not the goal, because rho is always that of the true row.
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

}  // namespace

/// Base index (padded) of a form of knot k: c_(k-2), c_(k-1), c_k for the left side, one more for the right
/// side.
template <class F>
void TimeLaw::each_pair(F&& f) {
  for (unsigned k = 0; k < n_; ++k) {
    for (unsigned p = 0; p < used_[k]; p += 3) {
      f(k + kPad - 2, pair_[k][p]);
      f(k + kPad - 1, pair_[k][p + 1]);
      f(k + kPad - 1, pair_[k][p + 2]);
    }
    for (unsigned p = 0; p < inside_[k]; ++p) f(k + kPad - 1, middle_[k][p]);
  }
}

template <class F>
void TimeLaw::each_single(F&& f) {
  for (unsigned k = 1; k < n_; ++k) f(k + kPad - 1, knot_cap_[k]);
  for (unsigned k = first_; k < last_; ++k) f(k + kPad - 1, cell_cap_[k]);
}

/// b, b' and b''/2 by the control values.
void TimeLaw::forms() {
  const Mesh& m = *mesh_;
  n_ = m.cells;
  first_ = 1;
  last_ = n_ - 1;
  for (unsigned k = 1; k < n_; ++k) {
    const double sum = m.h[k - 1] + m.h[k];
    at_[k] = {{m.h[k] / sum, m.h[k - 1] / sum, 0}, 0};
    slope_[k] = {{-2 / sum, 2 / sum, 0}, 0};
  }
  at_[0] = {{0, 0, 0}, m.from_rest ? 0 : m.b0};
  slope_[0] = {{0, 0, 0}, m.from_rest ? 0 : m.slope0};
  at_[n_] = slope_[n_] = {};
  const double share_end = 1 / (1 + 2 * m.h[n_ - 2] / (3 * m.h[n_ - 1]));
  at_[n_ - 1] = {{share_end, 0, 0}, 0};
  slope_[n_ - 1] = {{-share_end * 4 / (3 * m.h[n_ - 1]), 0, 0}, 0};
  double share_start = 0;
  if (m.from_rest) {
    share_start = 1 / (1 + 2 * m.h[1] / (3 * m.h[0]));
    at_[1] = {{0, share_start, 0}, 0};
    slope_[1] = {{0, share_start * 4 / (3 * m.h[0]), 0}, 0};
  }
  for (unsigned k = 0; k < n_; ++k) {
    const double per = 0.5 / m.h[k];
    const Form &a = slope_[k], &b = slope_[k + 1];
    half2_[k] = {{-per * a.g[0], per * (b.g[0] - a.g[1]), per * b.g[1]}, per * (b.constant - a.constant)};
  }
  if (m.from_rest) half2_[0] = {{0, 0, share_start * (2.0 / 9) / (m.h[0] * m.h[0])}, 0};
  half2_[n_ - 1] = {{share_end * (2.0 / 9) / (m.h[n_ - 1] * m.h[n_ - 1]), 0, 0}, 0};
  for (unsigned k = 0; k < n_; ++k) weight_[k] = m.h[k];
  if (m.from_rest) weight_[1] += 3 * m.h[0] / std::sqrt(share_start);
  weight_[n_ - 2] += 3 * m.h[n_ - 1] / std::sqrt(share_end);
}

/// Pairs of a knot come in threes: jerk on its left, jerk on its right, acceleration.
void TimeLaw::knot_rows(unsigned k) {
  const Limits& limits = *limits_;
  const Form &fb = at_[k], &fs = slope_[k], &right = half2_[k];
  const double b = value(fb, k + kPad - 1), slope = value(fs, k + kPad - 1);
  const double right2 = value(right, k + kPad - 1);
  static constexpr Form kNone{};
  const Form& left = k > 0 ? half2_[k - 1] : kNone;
  const double left2 = k > 0 ? value(left, k + kPad - 2) : 0;
  const double root = std::sqrt(b), per_root = b > 0 ? 0.5 / root : 0;
  const Knot& q = mesh_->knot[k];
  Pair* pair = pair_[k];
  used_[k] = 0;
  // The start is given: nothing there can become less.
  const double use_a = k == 0 ? 1.004 : std::min(mesh_->use_a[k - 1], mesh_->use_a[k < n_ ? k : k - 1]);
  const double per_left = 1 / mesh_->use[k > 0 ? k - 1 : 0], per_right = 1 / mesh_->use[k];
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const double d1 = q.d1[i], d2 = q.d2[i];
    if (d1 == 0 && d2 == 0 && q.left3[i] == 0 && q.right3[i] == 0) continue;
    if (!(limits.jerk[i] > 0) || !(limits.acceleration[i] > 0)) continue;
    const bool bends = d2 != 0 || q.left3[i] != 0 || q.right3[i] != 0;
    const double per_j = 1 / ((bends ? kInsideCurve : kInside) * limits.jerk[i]),
                 per_a = 1 / (kInside * use_a * limits.acceleration[i]);
    const double common = 1.5 * d2 * slope;
    double scale = root * per_j * per_left;
    Pair &l = pair[0], &r = pair[1], &a = pair[2];
    double y = d1 * left2 + common + q.left3[i] * b,
           bend = y * per_root * per_j * per_left + scale * q.left3[i];
    if (k > 0) {  // on c_(k-2), c_(k-1), c_k; b and b' of the knot are on the last two of them
      l.r = scale * y;
      l.g[0] = scale * d1 * left.g[0];
      l.g[1] = scale * (d1 * left.g[1] + 1.5 * d2 * fs.g[0]) + bend * fb.g[0];
      l.g[2] = scale * (d1 * left.g[2] + 1.5 * d2 * fs.g[1]) + bend * fb.g[1];
    } else {
      l.r = l.g[0] = l.g[1] = l.g[2] = 0;
    }
    y = d1 * right2 + common + q.right3[i] * b;
    scale = root * per_j * per_right;
    bend = y * per_root * per_j * per_right + scale * q.right3[i];
    r.r = scale * y;
    r.g[0] = scale * (d1 * right.g[0] + 1.5 * d2 * fs.g[0]) + bend * fb.g[0];
    r.g[1] = scale * (d1 * right.g[1] + 1.5 * d2 * fs.g[1]) + bend * fb.g[1];
    r.g[2] = scale * d1 * right.g[2];
    a.r = per_a * (0.5 * d1 * slope + d2 * b);
    a.g[0] = per_a * (0.5 * d1 * fs.g[0] + d2 * fb.g[0]);
    a.g[1] = per_a * (0.5 * d1 * fs.g[1] + d2 * fb.g[1]);
    a.g[2] = 0;
    pair += 3;
    used_[k] += 3;
  }
}

/// Jerk inside a cell, on c_(k-1), c_k, c_(k+1). Without its root it is a quadratic of u where the path is a
/// cubic, so it stays below the largest of its ends, which the knots look after, and its middle Bezier
/// coefficient; the root is largest where b is.
void TimeLaw::middle_rows(unsigned k) {
  inside_[k] = 0;
  const Inside& q = mesh_->inside[k];
  if (k + 1 == n_ || (k == 0 && mesh_->from_rest)) return;
  const Limits& limits = *limits_;
  const Form &s0 = slope_[k], &s1 = slope_[k + 1], &half = half2_[k];
  const unsigned base = k + kPad - 1;
  const double c = c_[k + kPad], slope0 = value(s0, base), slope1 = value(s1, base + 1),
               half2 = value(half, base);
  const double b0 = value(at_[k], base), b1 = value(at_[k + 1], base + 1);
  const bool peaks = slope0 > 0 && slope1 < 0;
  const double root =
      std::sqrt(peaks ? b0 + 0.5 * mesh_->h[k] * slope0 * slope0 / (slope0 - slope1) : std::max(b0, b1));
  for (unsigned i = 0; i < limits.axis_count; ++i) {
    const bool bends = q.d2_start[i] != 0 || q.d2_end[i] != 0 || q.d3[i] != 0;
    if ((q.d1[i] == 0 && !bends) || !(limits.jerk[i] > 0)) continue;
    Pair& x = middle_[k][inside_[k]++];
    const double scale = root / ((bends ? kInsideCurve : kInside) * mesh_->use[k] * limits.jerk[i]),
                 w0 = 0.75 * q.d2_end[i], w1 = 0.75 * q.d2_start[i];
    const double y = q.d1[i] * half2 + w0 * slope0 + w1 * slope1 + q.d3[i] * c;
    x.r = scale * y;
    x.g[0] = scale * (q.d1[i] * half.g[0] + w0 * s0.g[0]);
    x.g[1] = scale * (q.d1[i] * half.g[1] + w0 * s0.g[1] + w1 * s1.g[0] + q.d3[i] + 0.5 * y / c);
    x.g[2] = scale * (q.d1[i] * half.g[2] + w1 * s1.g[1]);
  }
}

/// `least` > 0: the slacks begin.
void TimeLaw::slacks(Pair& x, double least) {
  const double s0 = 1 - x.r, s1 = 1 + x.r;
  x.s[0] = std::max(s0, least > 0 ? least : x.s[0]);
  x.s[1] = std::max(s1, least > 0 ? least : x.s[1]);
}

void TimeLaw::slack(Single& x, double least) {
  x.s = std::max(1 - x.r, least > 0 ? least : x.s);
}

/// All rows at c. A slack that is smaller than its row leaves is made as large.
void TimeLaw::evaluate_rows(double least) {
  const Mesh& m = *mesh_;
  used_[0] = 0;
  for (unsigned k = m.from_rest ? 1 : 0; k < n_; ++k) knot_rows(k);
  for (unsigned k = 0; k < n_; ++k) middle_rows(k);
  for (unsigned k = 1; k < n_; ++k) {
    Single& cap = knot_cap_[k];
    cap.r = value(at_[k], k + kPad - 1) / m.knot[k].cap;
    for (unsigned e = 0; e < 3; ++e) cap.g[e] = at_[k].g[e] / m.knot[k].cap;
  }
  for (unsigned k = first_; k < last_; ++k) {
    Single& cap = cell_cap_[k];
    cap.r = c_[k + kPad] / m.cap[k];
    cap.g[0] = cap.g[2] = 0;
    cap.g[1] = 1 / m.cap[k];
  }
  rows_ = 0;
  each_pair([&](unsigned, Pair& x) {
    slacks(x, least);
    rows_ += 2;
  });
  each_single([&](unsigned, Single& x) {
    slack(x, least);
    ++rows_;
  });
}

void TimeLaw::assemble(double mu) {
  for (unsigned k = 0; k < n_ + 2 * kPad; ++k) diag_[k] = off1_[k] = off2_[k] = dc_[k] = 0;
  for (unsigned k = first_; k < last_; ++k) {
    const double c = c_[k + kPad], root = std::sqrt(c), w = weight_[k] / (c * root);
    dc_[k + kPad] = 0.5 * w;         // minus the gradient of the time
    diag_[k + kPad] = 0.75 * w / c;  // its second derivative
  }
  const auto add = [&](unsigned base, const double* g, double w, double t) {
    const double w0 = w * g[0], w1 = w * g[1], w2 = w * g[2];
    diag_[base] += w0 * g[0];
    diag_[base + 1] += w1 * g[1];
    diag_[base + 2] += w2 * g[2];
    off1_[base] += w0 * g[1];
    off1_[base + 1] += w1 * g[2];
    off2_[base] += w0 * g[2];
    dc_[base] -= g[0] * t;
    dc_[base + 1] -= g[1] * t;
    dc_[base + 2] -= g[2] * t;
  };
  each_pair([&](unsigned base, Pair& x) {
    const double per0 = 1 / x.s[0], per1 = 1 / x.s[1], w0 = x.l[0] * per0, w1 = x.l[1] * per1;
    const double t0 = mu * per0 + w0 * (x.r + x.s[0] - 1), t1 = mu * per1 + w1 * (-x.r + x.s[1] - 1);
    add(base, x.g, w0 + w1, t0 - t1);
  });
  each_single([&](unsigned base, Single& x) {
    const double per = 1 / x.s, w = x.l * per;
    add(base, x.g, w, mu * per + w * (x.r + x.s - 1));
  });
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

/// The steps of slacks and multipliers that belong to dc_, how far they may be gone, and gone.
void TimeLaw::directions(double mu, double* step_primal, double* step_dual) {
  double primal = 1, dual = 1;
  const auto take = [&](double s, double l, double ds, double* ds_out, double* dl_out) {
    const double dl = (mu - l * ds) / s - l;
    if (-ds * primal > kToWall * s) primal = kToWall * s / -ds;
    if (-dl * dual > kToWall * l) dual = kToWall * l / -dl;
    *ds_out = ds;
    *dl_out = dl;
  };
  each_pair([&](unsigned base, Pair& x) {
    const double gd = x.g[0] * dc_[base] + x.g[1] * dc_[base + 1] + x.g[2] * dc_[base + 2];
    take(x.s[0], x.l[0], 1 - x.r - x.s[0] - gd, &x.ds[0], &x.dl[0]);
    take(x.s[1], x.l[1], 1 + x.r - x.s[1] + gd, &x.ds[1], &x.dl[1]);
  });
  each_single([&](unsigned base, Single& x) {
    const double gd = x.g[0] * dc_[base] + x.g[1] * dc_[base + 1] + x.g[2] * dc_[base + 2];
    take(x.s, x.l, 1 - x.r - x.s - gd, &x.ds, &x.dl);
  });
  for (unsigned k = first_ + kPad; k < last_ + kPad; ++k) {
    if (c_[k] + primal * dc_[k] < 0.2 * c_[k]) primal = -0.8 * c_[k] / dc_[k];
    if (primal * dc_[k] > 4 * c_[k]) primal = 4 * c_[k] / dc_[k];
  }
  each_pair([&](unsigned, Pair& x) {
    for (unsigned side = 0; side < 2; ++side) {
      x.s[side] += primal * x.ds[side];
      x.l[side] += dual * x.dl[side];
    }
  });
  each_single([&](unsigned, Single& x) {
    x.s += primal * x.ds;
    x.l += dual * x.dl;
  });
  for (unsigned k = first_ + kPad; k < last_ + kPad; ++k) c_[k] += primal * dc_[k];
  *step_primal = primal;
  *step_dual = dual;
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
  for (unsigned k = 0; k < kPad; ++k) c_[k] = c_[n_ + kPad + k] = 0;
  for (unsigned k = 0; k < n_ && !again; ++k) c_[k + kPad] = mesh.guess[k];
  c_[kPad] = mesh.from_rest ? 0 : mesh.b0 + 0.5 * mesh.slope0 * mesh.h[0];
  c_[n_ - 1 + kPad] = 0;
  evaluate_rows(again ? kSlackAgain : kSmallestSlack);
  double time = 0;
  for (unsigned k = first_; k < last_; ++k) time += weight_[k] / std::sqrt(c_[k + kPad]);
  const double mu = (again ? kGapAgain : kGapFirst) * time / rows_;
  each_pair([&](unsigned, Pair& x) {
    x.l[0] = mu / x.s[0];
    x.l[1] = mu / x.s[1];
  });
  each_single([&](unsigned, Single& x) { x.l = mu / x.s; });
  for (unsigned n = 0; n < kIterations; ++n) {
    double gap = 0, residual = 0, worst = 0;
    each_pair([&](unsigned, Pair& x) {
      gap += x.s[0] * x.l[0] + x.s[1] * x.l[1];
      residual = std::max({residual, x.r + x.s[0] - 1, x.s[1] - x.r - 1});
      worst = std::max(worst, std::fabs(x.r));
    });
    each_single([&](unsigned, Single& x) {
      gap += x.s * x.l;
      residual = std::max(residual, x.r + x.s - 1);
      worst = std::max(worst, x.r);
    });
    time = 0;
    for (unsigned k = first_; k < last_; ++k) time += weight_[k] / std::sqrt(c_[k + kPad]);
    law->iterations = n;
    law->seconds = time;
    law->worst = worst * kInside;
    if (gap < kGap * time && worst < 1.0005) {
      law->ok = true;
      finish(law);
      return;
    }
    const double average = gap / rows_;
    // Not nearer to the walls than the rows are to being kept: else the steps become short.
    const double target = std::max((residual > 0.3    ? 0.5
                                    : residual > 1e-3 ? 0.3
                                                      : 0.1) *
                                       average,
                                   kResidual * residual * time / rows_);
    assemble(target);
    if (!factor_and_solve()) return;
    double primal = 1, dual = 1;
    directions(target, &primal, &dual);
    evaluate_rows(0);
  }
}

}  // namespace nc::optimal
