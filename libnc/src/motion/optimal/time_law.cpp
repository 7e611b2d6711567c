// SPDX-License-Identifier: Apache-2.0
// A primal-dual interior-point method. Rows are r(c) <= 1 with slack s and multiplier l; one step solves
//     (H + sum l/s g g') dc = -grad T - sum g (mu/s + l/s rho),   rho = r + s - 1,   g = grad r,
// H the (diagonal, positive) second derivative of the time. The second derivative of the jerk rows (their
// root) is left out: that changes the way, not the goal, because rho is always that of the true row.
//
// Steps are not cut short as a whole where one row comes to its wall: a slack or a multiplier keeps a share of itself at least, and the
// rho that this leaves is the next step's. So one pass through the rows ends a step, finds r and adds up the next matrix and right side.
// Everything that a row needs lies together, four rows to a vector.
#include "motion/optimal/time_law.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kGap = 4e-4;  ///< a law may take longer than the shortest one by this part of its time
constexpr double kGapOfDip = 1e-5;  ///< the same where the speed falls into a hole ...
constexpr unsigned kDipSteps = 8;  ///< ... for which at most so many more steps of the solver are made
constexpr double kDip = 1.0 / 9;  ///< a cell is a hole when its b is less than this part of the b on both sides of it
constexpr double kInside = 0.999;  ///< a law may use this part of the limits: what is left makes the start of the next law a place inside of them
constexpr double kInsideCurve =
    0.996;  ///< the same of the jerk where the path bends: between the rows it may be a little more
constexpr double kLeft = 0.2;  ///< a step leaves at least this part of each slack and of each multiplier
constexpr double kFall = 0.2, kRise = 5;  ///< of a control value, after a step
constexpr double kResidual = 0.003;
constexpr double kSmallestSlack = 0.5;
constexpr double kGapFirst = 0.4;  ///< the solver begins with a gap of this part of the time, shared by all rows
constexpr double kNoStop = 3;  ///< where there is no stop the multipliers grow without end: the gap becomes more than so many times the time; of stops that are found it is below half of it
constexpr double kGapOfStop = 2e-3;  ///< kGap of a stop, whose rows come near to being kept and away again where the gap is smaller
constexpr double kGapUnkept = 0.5;  ///< as long as rows are not kept the gap of a stop stays above this part of that
constexpr double kSlackAgain = 0.003;  ///< the smallest slack where it begins from a solution of nearly the same rows
constexpr double kGapAgain = 0.003;
constexpr double kAlong = 2.5;         ///< times the acceleration and jerk that an axis would allow, at most, along the path
constexpr double kLittle = 0.5;  ///< an axis that can take no more than this part of a limit has no row for it
constexpr double kStartUse = 1.004;  ///< a given start may use this many times the acceleration: nothing there can become less
constexpr unsigned kAtOnce = 32;  ///< cells that are worked through before others may have their turn
// Instructions: of a cell in a pass without axes and for each of them, to fill its rows, to begin with it and to end a step in it.
constexpr int64_t kCellCost = 400, kAxisCost = 250, kFillCost = 200, kBeginCost = 150, kStepCost = 60;

}  // namespace

/// b, b' and b''/2 by the control values.
void TimeLaw::forms() {
  const Mesh& m = *mesh_;
  n_ = m.cells;
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

/// The first and the last control value are given, and those of level cells and of cells that are kept.
void TimeLaw::find_runs() {
  runs_ = 0;
  for (unsigned k = 1; k + 1 < n_; ++k) {
    const auto given = [this](unsigned cell) { return mesh_->level[cell] || mesh_->kept[cell]; };
    if (given(k)) continue;
    const unsigned from = k;
    while (k + 1 < n_ && !given(k)) ++k;
    Run& run = run_[runs_++];
    run.from = from;
    run.to = std::min(k, n_ - 1);
  }
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

/// Of a cell: the largest share of a limit per unit of acceleration and jerk along the path.
TimeLaw::Share TimeLaw::share_of(unsigned k) const {
  const Knot &left = mesh_->knot[k], &right = mesh_->knot[k + 1];
  Share most;
  for (unsigned n = 0; n < axes_; ++n) {
    const unsigned i = axis_[n];
    const double d = std::max(std::fabs(left.d1[i]), std::fabs(right.d1[i]));
    if (limits_->acceleration[i] > 0) most.acceleration = std::max(most.acceleration, d / limits_->acceleration[i]);
    if (limits_->jerk[i] > 0) most.jerk = std::max(most.jerk, d / limits_->jerk[i]);
  }
  most.speed = std::sqrt(mesh_->cap[k]);
  return most;
}

/// False for an axis that has so little part in a cell that the limits of others are met before one of its own. The look at the law is at
/// all axes; where it has found something, they have rows.
bool TimeLaw::matters(unsigned k, unsigned i, const Share& most) const {
  if (mesh_->use[k] != 1 || mesh_->use_a[k] != 1 || !(most.speed < HUGE_VAL) || !(most.acceleration > 0) || !(most.jerk > 0)) return true;
  const Knot &left = mesh_->knot[k], &right = mesh_->knot[k + 1];
  const double d1 = std::max(std::fabs(left.d1[i]), std::fabs(right.d1[i])), d2 = std::max(std::fabs(left.d2[i]), std::fabs(right.d2[i])),
               d3 = std::max(std::fabs(left.right3[i]), std::fabs(right.left3[i])), v = most.speed;
  return kAlong * d1 + most.acceleration * d2 * v * v > kLittle * most.acceleration * limits_->acceleration[i] ||
         kAlong * d1 * most.acceleration + most.jerk * (3 * d2 * v + most.acceleration * d3 * v * v * v) >
             kLittle * most.jerk * most.acceleration * limits_->jerk[i];
}

/// The rows without their roots. Jerk inside a cell: without its root it is a quadratic of u where the path is a cubic, so it stays below
/// the largest of its ends, which have rows of their own, and its middle Bezier coefficient; the root is largest where b is.
TimeLaw::Rows* TimeLaw::fill_rows(const Run& run, unsigned k, Rows* row) {
  const Mesh& m = *mesh_;
  static constexpr Form kNone{};
  const bool launch = k == 0 && m.from_rest, land = k + 1 == n_;
  const Form &b0 = at_[k], &b1 = at_[k + 1], &half = half2_[k];
  const Form s0 = slope_[k], s1{{0, slope_[k + 1].g[0], slope_[k + 1].g[1]}};
  for (unsigned e = 0; e < 3; ++e) {  // beside rest the jerk is the same all over the cell, and so is its root
    const double start = b0.g[e], end = e > 0 ? b1.g[e - 1] : 0;
    root_[k].at[e] = Four{launch ? end : start, land ? start : end, e == 1 ? 1.0 : 0.0, 0};
  }
  const Knot &left = m.knot[k], &right = m.knot[k + 1];
  const Inside& in = m.inside[k];
  const double use_a = k == 0 ? kStartUse : std::min(m.use_a[k - 1], m.use_a[k]);
  const Share most = share_of(k);
  Rows* const first = row;
  for (unsigned n = 0; n < axes_; ++n) {
    const unsigned i = axis_[n];
    if (!matters(k, i, most)) continue;
    const double per_j = limits_->jerk[i] > 0 ? 1 / (m.use[k] * limits_->jerk[i]) : 0;
    const auto jerk = [&](bool bends) { return per_j * (bends && !m.stops ? 1 / kInsideCurve : 1 / kInside); };
    const double j0 = jerk(left.d2[i] != 0 || left.left3[i] != 0 || left.right3[i] != 0),
                 j1 = jerk(right.d2[i] != 0 || right.left3[i] != 0 || right.right3[i] != 0),
                 jm = launch || land ? 0 : jerk(in.d2_start[i] != 0 || in.d2_end[i] != 0 || in.d3[i] != 0),
                 a = launch || !(limits_->acceleration[i] > 0) ? 0 : 1 / (kInside * use_a * limits_->acceleration[i]);
    Rows& x = *row++;
    for (unsigned e = 0; e < 3; ++e) {
      const double at1 = (e > 0 ? b1 : kNone).g[e > 0 ? e - 1 : 0];
      x.g[e] = Four{j0 * (left.d1[i] * half.g[e] + 1.5 * left.d2[i] * s0.g[e] + left.right3[i] * b0.g[e]),
                    j1 * (right.d1[i] * half.g[e] + 1.5 * right.d2[i] * s1.g[e] + right.left3[i] * at1),
                    jm * (in.d1[i] * half.g[e] + 0.75 * (in.d2_end[i] * s0.g[e] + in.d2_start[i] * s1.g[e]) + (e == 1 ? in.d3[i] : 0)),
                    a * (0.5 * left.d1[i] * s0.g[e] + left.d2[i] * b0.g[e])};
    }
  }
  in_cell_[k] = static_cast<unsigned char>(row - first);
  rows_ += 8 * in_cell_[k] + 2u;
  const bool free = k >= run.from && k < run.to;
  const double knot = k >= run.from ? 1 / m.knot[k].cap : 0, cell = free ? 1 / m.cap[k] : 0;
  cap_[k].g0 = Four{knot * b0.g[0], 0, 0, 0};
  cap_[k].g1 = Four{knot * b0.g[1], cell, 0, 0};
  return row;
}

Task<bool> TimeLaw::fill_rows(Work& work) {
  Rows* row = row_;
  rows_ = 0;
  for (const Run *run = run_, *runs_end = run_ + runs_; run != runs_end; ++run)
    for (unsigned k = run->from - 1; k <= run->to; ++k) {
      row = fill_rows(*run, k, row);
      co_await work.pause(kFillCost + kAxisCost * in_cell_[k]);
    }
  co_return true;
}

[[gnu::always_inline]] inline double TimeLaw::Elimination::add(double diag, Row r) {  // @return 1 / D
  diag -= last.lower1 * last.off1 + before.lower2 * before.off2;
  r.off1 -= last.lower1 * last.off2;
  r.side -= last.lower1 * last.side + before.lower2 * before.side;
  r.side_mu -= last.lower1 * last.side_mu + before.lower2 * before.side_mu;
  const double per = 1 / diag;
  possible = possible && diag > 0;
  r.lower1 = r.off1 * per;
  r.lower2 = r.off2 * per;
  before = last;
  last = r;
  return per;
}

/// The roots of cell k: b at its ends and the largest b inside. @return 1 / root(c_k)
[[gnu::always_inline]] inline double TimeLaw::roots(unsigned k) {
  const unsigned base = k + kPad - 1;
  const Form &f0 = at_[k], &f1 = at_[k + 1], &e0 = slope_[k], &e1 = slope_[k + 1];
  const double c0 = c_[base], c = c_[base + 1], c2 = c_[base + 2];
  const double b0 = f0.g[0] * c0 + f0.g[1] * c, b1 = f1.g[0] * c + f1.g[1] * c2;
  const double slope0 = e0.g[0] * c0 + e0.g[1] * c, slope1 = e1.g[0] * c + e1.g[1] * c2;
  const bool launch = k == 0 && mesh_->from_rest, land = k + 1 == n_;
  const double left = launch ? b1 : b0, right = land ? b0 : b1, any = c > 0 ? c : 1;
  const double peak = slope0 > 0 && slope1 < 0 ? b0 + 0.5 * mesh_->h[k] * slope0 * slope0 / (slope0 - slope1) : std::max(b0, b1);
  Roots& q = root_[k];
  const Four root = root_of(Four{left, right, peak, any});
  const Four half_per = all(0.5) / Four{left, right, any, 1};
  q.root = Four{root[0], root[1], root[2], 1};
  q.half_per = Four{half_per[0], half_per[1], c > 0 ? half_per[2] : 0, 0};
  return 2 * half_per[2] * root[3];
}

/// All rows at c, and what they give to the matrix and the right side, which is eliminated forward. A slack that is smaller than its row
/// leaves is made as large.
/// `first`: slacks of at least `least` begin, with multipliers of mu / s; else the step dc towards mu, which c has gone, is theirs, too.
void TimeLaw::begin_pass(bool first, double target, double least) {
  pass_ = {};
  pass_.first = first;
  pass_.target = target;
  pass_.smallest = least;
  pass_.row = row_;
  pass_.run = run_;
  time_ = 0;
}

TimeLaw::Sums TimeLaw::sums() const {
  return {sum(pass_.gap), largest(pass_.residual), largest(pass_.worst)};
}

/// Of a pass through so many cells.
int64_t TimeLaw::cost_of(unsigned cells) const {
  return cells * (kCellCost + kAxisCost * axes_);
}

/// Goes on with the pass for `most` cells. @return those that it has gone through
NC_FOR_WIDE_VECTORS unsigned TimeLaw::rows(unsigned most) {
  Pass& pass = pass_;
  const bool first = pass.first;
  const Four one = all(1), mu = all(pass.target), least = all(pass.smallest), left = all(kLeft);
  const Four kIsCap = {1, 1, 0, 0};
  Four gap = pass.gap, residual = pass.residual, worst = pass.worst;
  Rows* row = pass.row;
  unsigned cells = 0;
  for (Run *run = pass.run, *runs_end = run_ + runs_; run != runs_end; ++run) {
    // What belongs to c_(k-1), c_k and c_(k+1) in matrix and right side: the first is done with behind cell k, the others go on.
    Four m00{}, m01{}, m11{}, a0{}, a1{}, d0{}, d1{};
    double diag = 0, side = 0, side_mu = 0;  // of c_(k-1): what the time and the rows of cell k - 1 give it
    Elimination band;
    unsigned k = run->from - 1;
    if (pass.inside) {
      k = pass.cell;
      m00 = pass.m00, m01 = pass.m01, m11 = pass.m11;
      a0 = pass.a0, a1 = pass.a1, d0 = pass.d0, d1 = pass.d1;
      diag = pass.diag, side = pass.side, side_mu = pass.side_mu;
      band = pass.band;
      pass.inside = false;
    }
    for (; k <= run->to; ++k) {
      if (cells++ == most) {
        pass.inside = true;
        pass.run = run;
        pass.cell = k;
        pass.row = row;
        pass.gap = gap, pass.residual = residual, pass.worst = worst;
        pass.m00 = m00, pass.m01 = m01, pass.m11 = m11;
        pass.a0 = a0, pass.a1 = a1, pass.d0 = d0, pass.d1 = d1;
        pass.diag = diag, pass.side = side, pass.side_mu = side_mu;
        pass.band = band;
        return most;
      }
      const unsigned base = k + kPad - 1;
      Roots& q = root_[k];
      const Four c0 = all(c_[base]), c1 = all(c_[base + 1]), c2 = all(c_[base + 2]);
      const Four e0 = all(dc_[base]), e1 = all(dc_[base + 1]), e2 = all(dc_[base + 2]);
      const Four old = q.root, old_bend = q.half_per * (q.at[0] * e0 + q.at[1] * e1 + q.at[2] * e2);
      const double per_root = roots(k);
      Four m02{}, m12{}, m22{}, a2{}, d2{};
      for (const Rows* end = row + in_cell_[k]; row != end; ++row) {
        Rows& x = *row;
        const Four g0 = x.g[0], g1 = x.g[1], g2 = x.g[2];
        const Four r = q.root * (g0 * c0 + g1 * c1 + g2 * c2), low = one - r, high = one + r;
        Four s0, s1, l0, l1;
        if (first) {
          s0 = larger(low, least);
          s1 = larger(high, least);
          l0 = mu / s0;
          l1 = mu / s1;
        } else {
          const Four line = x.r + old * (g0 * e0 + g1 * e1 + g2 * e2) + x.r * old_bend;  // what the step was to make of r
          const Four line0 = one - line, line1 = one + line;
          s0 = larger(low, larger(left * x.s[0], line0));
          s1 = larger(high, larger(left * x.s[1], line1));
          l0 = larger(left * x.l[0], (mu - x.l[0] * (line0 - x.s[0])) * x.per[0]);
          l1 = larger(left * x.l[1], (mu - x.l[1] * (line1 - x.s[1])) * x.per[1]);
        }
        const Four per = one / (s0 * s1), per0 = per * s1, per1 = per * s0;
        x.r = r;
        x.s[0] = s0;
        x.s[1] = s1;
        x.l[0] = l0;
        x.l[1] = l1;
        x.per[0] = per0;
        x.per[1] = per1;
        const Four rho0 = s0 - low, rho1 = s1 - high;
        gap += s0 * l0 + s1 * l1;
        residual = larger(residual, larger(rho0, rho1));
        worst = larger(worst, larger(r, -r));
        const Four w0 = l0 * per0, w1 = l1 * per1, w = w0 + w1;
        const Four t = w0 * rho0 - w1 * rho1, t_mu = per0 - per1, bend = r * q.half_per;
        const Four h0 = q.root * g0 + bend * q.at[0], h1 = q.root * g1 + bend * q.at[1], h2 = q.root * g2 + bend * q.at[2];
        const Four w0h = w * h0, w1h = w * h1;
        m00 += w0h * h0;
        m01 += w0h * h1;
        m02 += w0h * h2;
        m11 += w1h * h1;
        m12 += w1h * h2;
        m22 += w * h2 * h2;
        a0 += h0 * t;
        a1 += h1 * t;
        a2 += h2 * t;
        d0 += h0 * t_mu;
        d1 += h1 * t_mu;
        d2 += h2 * t_mu;
      }
      Caps& x = cap_[k];
      const Four low = one - (x.g0 * c0 + x.g1 * c1);
      Four s, l;
      if (first) {
        s = larger(low, least);
        l = mu / s;
      } else {
        s = larger(low, left * x.s);
        l = larger(left * x.l, (mu - x.l * (low - x.s)) * x.per);
      }
      const Four per_s = one / s, rho = s - low, w = l * per_s, t = w * rho;
      x.s = s;
      x.l = l;
      x.per = per_s;
      gap += s * l * kIsCap;
      residual = larger(residual, rho);
      worst = larger(worst, one - low);
      const Four w0 = w * x.g0, w1 = w * x.g1;
      const Four of = Four{sum2(w0 * x.g0), sum2(w0 * x.g1), sum2(w1 * x.g1), 0};
      const double side_k = side - sum(a0) - sum2(x.g0 * t), side_mu_k = side_mu - sum(d0) - sum2(x.g0 * per_s);
      if (k > run->from) {  // c_(k-1) is free; beside the last one of them nothing is
        const bool next = k < run->to, next2 = k + 1 < run->to;
        const double per = band.add(diag + sum(m00) + of[0], {.off1 = next ? sum(m01) + of[1] : 0,
                                                                         .off2 = next2 ? sum(m02) : 0,
                                                                         .side = side_k,
                                                                         .side_mu = side_mu_k});
        lower1_[base] = band.last.lower1;
        lower2_[base] = band.last.lower2;
        side_[base] = band.last.side * per;
        side_mu_[base] = band.last.side_mu * per;
      } else if (k == run->from) {
        run->side[0] = side_k;
        run->side_mu[0] = side_mu_k;
      }
      diag = of[2];
      side = -sum2(x.g1 * t);
      side_mu = -sum2(x.g1 * per_s);
      if (k >= run->from && k < run->to) {
        const double per = per_root * per_root, slope = weight_[k] * per * per_root;
        time_ += weight_[k] * per_root;
        diag += 0.75 * slope * per;
        side += 0.5 * slope;  // minus the gradient of the time
      }
      m00 = m11;
      m01 = m12;
      m11 = m22;
      a0 = a1;
      a1 = a2;
      d0 = d1;
      d1 = d2;
    }
    run->side[1] = side - sum(a0);
    run->side_mu[1] = side_mu - sum(d0);
    run->possible = band.possible;
  }
  pass.gap = gap, pass.residual = residual, pass.worst = worst;
  pass.ended = true;
  return cells;
}

Task<bool> TimeLaw::all_rows(Work& work) {
  while (!pass_.ended) {
    const unsigned cells = rows(kAtOnce);
    co_await work.pause(cost_of(cells));
  }
  co_return true;
}

void TimeLaw::find_time() {
  time_ = 0;
  for (const Run *run = run_, *end = run_ + runs_; run != end; ++run)
    for (unsigned k = run->from; k < run->to; ++k) time_ += weight_[k] / std::sqrt(c_[k + kPad]);
}

/// One step towards mu; what is not free stays where it is.
bool TimeLaw::step(double mu) {
  for (const Run *run = run_, *runs_end = run_ + runs_; run != runs_end; ++run) {
    if (!run->possible) return false;
    double step1 = 0, step2 = 0;  // of the next two, in full
    for (unsigned k = run->to + kPad; k-- > run->from + kPad;) {
      const double whole = side_[k] + mu * side_mu_[k] - lower1_[k] * step1 - lower2_[k] * step2;
      const double to = std::clamp(c_[k] + whole, kFall * c_[k], kRise * c_[k]);
      dc_[k] = to - c_[k];
      c_[k] = to;
      step2 = step1;
      step1 = whole;
    }
  }
  return true;
}

/// No law is shorter whose level cells are slower: beside them less speed there would not let the others be faster.
bool TimeLaw::levels_hold(double mu) const {
  for (const Run *run = run_, *end = run_ + runs_; run != end; ++run) {
    const auto gain = [&](unsigned side, unsigned k) {
      const double c = c_[k + kPad];
      return 0.5 * weight_[k] / (c * std::sqrt(c)) + run->side[side] + mu * run->side_mu[side];
    };
    if (run->from > 1 && mesh_->level[run->from - 1] && gain(0, run->from - 1) < 0) return false;
    if (run->to + 1 < n_ && mesh_->level[run->to] && gain(1, run->to) < 0) return false;
  }
  return true;
}

/// Somewhere the law is far slower than just before and just behind: in a corner of some nanometres that is next to nothing of the time, and
/// the axes stand for some cycles.
bool TimeLaw::dips() const {
  for (unsigned k = kPad + 2; k + 2 < n_ + kPad; ++k)
    if (c_[k] < kDip * std::min(std::max(c_[k - 1], c_[k - 2]), std::max(c_[k + 1], c_[k + 2]))) return true;
  return false;
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
  law->seconds = time_;
  for (unsigned k = 1; k + 1 < n_; ++k) law->seconds += m.level[k] || m.kept[k] ? weight_[k] / std::sqrt(c_[k + kPad]) : 0;
}

/// All that is known of the rows and does not hang on c, and where c begins.
void TimeLaw::begin(const Mesh& mesh, Begins begins) {
  for (unsigned k = 0; k < kPad; ++k) c_[k] = c_[n_ + kPad + k] = 0;
  for (unsigned k = 0; k < n_ && begins == Begins::anew; ++k) c_[k + kPad] = mesh.level[k] ? mesh.cap[k] : mesh.guess[k];
  c_[kPad] = mesh.from_rest ? 0 : mesh.b0 + 0.5 * mesh.slope0 * mesh.h[0];
  c_[kPad - 1] = mesh.from_rest ? 0 : mesh.b0 - 0.5 * mesh.slope0 * mesh.h[0];
  c_[n_ - 1 + kPad] = 0;
  for (unsigned k = 0; k < n_ + 2 * kPad; ++k) dc_[k] = 0;
  find_time();
}

Task<bool> TimeLaw::solve(Work& work, const Mesh& mesh, const Limits& limits, Begins begins, Law* law, unsigned most) {
  mesh_ = &mesh;
  limits_ = &limits;
  law->ok = false;
  law->cells = 0;
  law->iterations = 0;
  if (mesh.cells < 4 || mesh.cells > kMaxCells) co_return false;
  if (begins == Begins::anew) forms();
  find_runs();
  if (begins == Begins::anew) moving_axes();
  if (begins == Begins::nearby) std::copy(c_, c_ + n_ + 2 * kPad, before_);
  co_await work.pause(kBeginCost * n_);
  const bool found = co_await find(work, begins, law, most);
  if (!found && begins == Begins::nearby) std::copy(before_, before_ + n_ + 2 * kPad, c_);
  co_return found;
}

/// The steps of the solver. How small the gap is to be goes by the time of the whole law and its rows, also where some of its cells are solved once more.
Task<bool> TimeLaw::find(Work& work, Begins begins, Law* law, unsigned most) {
  const Mesh& mesh = *mesh_;
  co_await fill_rows(work);
  begin(mesh, begins);
  co_await work.pause(kStepCost * n_);
  const bool nearby = begins == Begins::nearby, anew = begins == Begins::anew;
  const auto time = [&] { return nearby ? time_per_row_ * rows_ : time_; };
  begin_pass(true, (anew ? kGapFirst : kGapAgain) * time() / rows_, anew ? kSmallestSlack : kSlackAgain);
  co_await all_rows(work);
  Sums sums = this->sums();
  for (unsigned n = 0, more = 0; n < most; ++n) {
    law->iterations = n;
    law->worst = sums.worst * kInside;
    if (sums.gap < (mesh.stops ? kGapOfStop : kGap) * time() && sums.worst < 1.0005 && (mesh.stops || sums.gap < kGapOfDip * time() || more++ == kDipSteps || !dips())) {
      law->ok = levels_hold(sums.gap / rows_);
      if (law->ok) finish(law);
      if (!nearby) time_per_row_ = time_ / rows_;
      work.spend(kStepCost * n_);
      co_return law->ok;
    }
    if (mesh.stops && !(sums.gap < kNoStop * time())) co_return false;
    const double average = sums.gap / rows_, least = mesh.stops && !(sums.worst < 1.0005) ? kGapUnkept * kGapOfStop * time() / rows_ : 0;
    // Not nearer to the walls than the rows are to being kept: else the steps become short.
    const double part = sums.residual > 0.3 ? 0.5 : sums.residual > 1e-3 ? 0.3 : 0.1;
    const double target = std::max({part * average, kResidual * sums.residual * time() / rows_, least});
    if (!step(target)) co_return false;
    co_await work.pause(kStepCost * n_);
    begin_pass(false, target, 0);
    co_await all_rows(work);
    sums = this->sums();
  }
  co_return false;
}

}  // namespace nc::optimal
