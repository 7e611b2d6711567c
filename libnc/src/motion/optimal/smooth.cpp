// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/smooth.hpp"

#include <algorithm>
#include <cmath>

#include "motion/optimal/turn.hpp"

namespace nc::optimal {
namespace {

constexpr double kUse = 0.94;       ///< of the tolerance, that one corner is given
constexpr double kUseMost = 0.98;   ///< of the tolerance, that any of the places may use
constexpr double kUseTurn = 0.975;  ///< the same at a sharp corner, which is cut by a known depth
constexpr double kSharp = 0.5;      ///< |t2 - t1| of a corner that always has its own knots
constexpr double kStraight = 1e-9;  ///< |t2 - t1| of no corner
constexpr double kLongEdge = 8;     ///< in spacings
constexpr unsigned kLooks = 4;      ///< places in a cell, beside the vertices, where the distance is measured
constexpr double kRounding = 1e-11;  ///< of q'
constexpr double kStraightEnd = 0.2; ///< of an edge, up to its first knot
constexpr double kCornerCell = 0.55;  ///< of a cell of a sharp corner: there the speed changes much, so a law has two cells in it
constexpr unsigned kRounds = 16;

class Smoother {
 public:
  Smoother(const SmoothRequest& request, const SmoothRoom& room, Piece* out, unsigned capacity)
      : in_(request), room_(room), out_(out), capacity_(capacity) {}
  unsigned run();

 private:
  void set(double u, double apart);
  void set_turn(unsigned vertex, double reach);
  void turn_controls(unsigned first);
  double corner(unsigned k) const;
  bool first_knots();
  unsigned frozen() const { return in_.knot != nullptr ? kGoesOn - 1 : 0; }        ///< knots up to here stay
  unsigned first_cell() const { return in_.knot != nullptr ? kFirstCell : 0; }
  void controls();
  void pieces();
  bool near_enough();
  bool split();
  AxisVec on_line(double u, unsigned* edge) const;
  double distance2(unsigned cell, double u, const AxisVec& p) const;
  double t(int k) const {
    return room_.knot[k < 0 ? 0 : k > static_cast<int>(last_) ? last_ : static_cast<unsigned>(k)];
  }

  const SmoothRequest& in_;
  const SmoothRoom& room_;
  Piece* out_;
  unsigned capacity_;
  unsigned last_ = 0;  ///< index of the last knot
  bool full_ = false;
  bool one_feed_ = true;
};

/// A knot at u, unless it lies less than `apart` behind the last one.
void Smoother::set(double u, double apart) {
  if (u - room_.knot[last_] < apart) return;
  if (last_ + 1 >= room_.knots) {
    full_ = true;
    return;
  }
  room_.knot[++last_] = u;
  room_.corner[last_] = 0;
}

void Smoother::set_turn(unsigned vertex, double reach) {
  const double u = room_.u[vertex];
  for (unsigned n = 0; n <= 2 * kTurnKnots; ++n) {
    const double at = n < kTurnKnots ? -kTurnAt[kTurnKnots - n] : kTurnAt[n - kTurnKnots];
    set(u + at * reach, 0);
    room_.corner[last_] = vertex;
  }
}

/// |t2 - t1| at vertex k.
double Smoother::corner(unsigned k) const {
  const Polyline& l = in_.line;
  const double pa = 1 / l.length[k - 1], pb = 1 / l.length[k];
  double sum = 0;
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    const double d = (l.vertex[k + 1][i] - l.vertex[k][i]) * pb - (l.vertex[k][i] - l.vertex[k - 1][i]) * pa;
    sum += d * d;
  }
  return std::sqrt(sum);
}

bool Smoother::first_knots() {
  const Polyline& l = in_.line;
  double* u = room_.u;
  u[0] = 0;
  for (unsigned k = 1; k < l.count; ++k) u[k] = u[k - 1] + l.length[k - 1];
  for (unsigned k = 1; k + 1 < l.count && l.feed != nullptr; ++k) one_feed_ = one_feed_ && l.feed[k] == l.feed[0];
  const double end = u[l.count - 1];
  room_.knot[0] = 0;
  room_.corner[0] = 0;
  last_ = 0;
  double keep = 0;  // the knots behind a corner stay clear of what follows up to here
  unsigned first = 1;
  if (in_.knot != nullptr) {
    for (unsigned k = 0; k < kGoesOn; ++k) {
      room_.knot[k] = in_.knot[k];
      room_.corner[k] = 0;
    }
    last_ = kGoesOn - 1;
    keep = room_.knot[last_];
    while (first + 1 < l.count && u[first] <= keep) ++first;
    if (!(end > keep)) return false;
  } else if (in_.straight_start) {  // the first three control points lie on the first edge
    const double step = std::min(kStraightEnd * l.length[0], in_.spacing);
    set(step, 0);
    set(2 * step, 0);
    keep = 2 * step;
  }
  for (unsigned k = first; k + 1 < l.count; ++k) {
    const double turn = corner(k);
    const bool feed = l.feed != nullptr && l.feed[k] != l.feed[k - 1];
    if (turn < kStraight && !feed) continue;
    const double reach = turn < kStraight ? HUGE_VAL : 6 * kUse * in_.tolerance / turn;
    const double before = l.length[k - 1], behind = l.length[k];
    const double turn_most = kUseTurn * in_.tolerance / (kTurnDepth * turn);
    const double turn_reach = std::min(turn_most, 0.4999 * std::min(before, behind));
    if (turn > kSharp && turn_reach > 0.6 * turn_most && u[k] - turn_reach > keep) {
      set_turn(k, turn_reach);
      keep = u[k] + turn_reach;
      continue;
    }
    const bool alone = 2 * reach <= std::min(before, behind);
    if (alone || turn > kSharp) {
      const double h = std::min({reach, end - u[k], u[k]});
      const double from = std::max(room_.knot[last_], keep);
      if (u[k] - from > 1.2 * h) set(u[k] - h, 0.1 * h);
      set(u[k], 0.1 * h);
      keep = u[k] + h;
      if (alone) set(keep, 0);
      continue;
    }
    const double gap = u[k] - room_.knot[last_];
    if (gap > kLongEdge * in_.spacing) {  // what bends at one end shall not reach the other
      set(room_.knot[last_] + in_.spacing, 0);
      set(u[k] - in_.spacing, 0.3 * in_.spacing);
    }
    set(u[k], feed ? 1e-6 : 0.7 * in_.spacing);
  }
  // The end: three knots of their own on the last edge, so that it is straight there.
  while (last_ > frozen() && end - room_.knot[last_] < 1e-9 * end) --last_;
  if (in_.straight_end) {
    const double step = std::min(kStraightEnd * l.length[l.count - 2], in_.spacing);
    set(end - 2 * step, 0.1 * step);
    set(end - step, 0.1 * step);
  }
  const double gap = end - room_.knot[last_];
  if (last_ == 0 || gap > 2 * in_.spacing) {
    const double step = std::min(in_.spacing, gap / 4);
    set(room_.knot[last_] + step, 0);
    set(end - step, 0);
  }
  set(end, 0);
  return !full_;
}

AxisVec Smoother::on_line(double u, unsigned* edge) const {
  const Polyline& l = in_.line;
  unsigned& e = *edge;
  while (e + 2 < l.count && room_.u[e + 1] < u) ++e;
  while (e > 0 && room_.u[e] > u) --e;
  const double share = (u - room_.u[e]) / l.length[e];
  AxisVec p;
  for (unsigned i = 0; i < in_.axis_count; ++i)
    p[i] = l.vertex[e][i] + share * (l.vertex[e + 1][i] - l.vertex[e][i]);
  return p;
}

/// Control point j lies on the polyline at the mean of knots j - 2, j - 1, j (the end knots count three
/// times).
void Smoother::controls() {
  unsigned edge = 0;
  for (unsigned j = 0; j < last_ + 3; ++j) {
    const int k = static_cast<int>(j);
    room_.control[j] = on_line((t(k - 2) + t(k - 1) + t(k)) / 3, &edge);
  }
  for (unsigned k = 1; k + 2 * kTurnKnots <= last_; ++k) {
    if (room_.corner[k] != 0 && room_.corner[k + 2 * kTurnKnots] == room_.corner[k]) turn_controls(k);
  }
  room_.control[0] = in_.line.vertex[0];
  room_.control[last_ + 2] = in_.line.vertex[in_.line.count - 1];
}

/// A sharp corner whose first knot is `first`. With q'' = (t2 - t1) K(u) the control values of the part that
/// turns follow from the differences that pieces() takes: e grows by K (t_(k+1) - t_(k-1)) / 2 at knot k, d
/// by e (t_j - t_(j-3)) / 3.
void Smoother::turn_controls(unsigned first) {
  const Polyline& l = in_.line;
  const unsigned vertex = room_.corner[first];
  const int a = static_cast<int>(first);
  const double u = room_.u[vertex], reach = u - t(a), scale = kTurnScale / reach;
  const double pa = 1 / l.length[vertex - 1], pb = 1 / l.length[vertex];
  double e = 0, d = 0;
  for (int n = 1; n <= 2 * static_cast<int>(kTurnKnots); ++n) {
    const int j = a + 2 + n;  // control value a + 2 is the last one before the turn
    if (n < 2 * static_cast<int>(kTurnKnots)) {
      const unsigned side =
          static_cast<unsigned>(n < static_cast<int>(kTurnKnots) ? static_cast<int>(kTurnKnots) - n
                                                                 : n - static_cast<int>(kTurnKnots));
      e += kTurnK[side] * scale * (t(a + n + 1) - t(a + n - 1)) / 2;
    }
    d += e * (t(j) - t(j - 3)) / 3;
    const double along = (t(j - 2) + t(j - 1) + t(j)) / 3 - u;
    for (unsigned i = 0; i < in_.axis_count; ++i) {
      const double t1 = (l.vertex[vertex][i] - l.vertex[vertex - 1][i]) * pa,
                   t2 = (l.vertex[vertex + 1][i] - l.vertex[vertex][i]) * pb;
      room_.control[static_cast<unsigned>(j)][i] = l.vertex[vertex][i] + along * t1 + d * (t2 - t1);
    }
  }
}

/// Polynomials of the cells, from the derivatives of the spline at the knots.
void Smoother::pieces() {
  const AxisVec* d = room_.control;
  unsigned edge = 0;
  for (unsigned k = 0; k < last_; ++k) {
    const int c = static_cast<int>(k);
    const double h = t(c + 1) - t(c);
    Piece& p = out_[k];
    p.length = h;
    p.curve = nullptr;
    p.rapid = p.quintic = false;
    p.cell = room_.corner[k] != 0 && room_.corner[k] == room_.corner[k + 1] ? kCornerCell * h : 0;
    p.feed = HUGE_VAL;
    // Differences: e_j = 3 (d_j - d_(j-1)) / (t_j - t_(j-3)), f_j = 2 (e_j - e_(j-1)) / (t_(j-1) - t_(j-3));
    // q'' at knot k is f_(k+2).
    const double w1 = 3 / (t(c + 1) - t(c - 2)), w2 = 3 / (t(c + 2) - t(c - 1)), w3 = 3 / (t(c + 3) - t(c));
    const double g0 = t(c + 1) - t(c - 1), g1 = t(c + 2) - t(c);
    for (unsigned i = 0; i < in_.axis_count; ++i) {
      const double e1 = w1 * (d[k + 1][i] - d[k][i]), e2 = w2 * (d[k + 2][i] - d[k + 1][i]),
                   e3 = w3 * (d[k + 3][i] - d[k + 2][i]);
      // On a line the differences are rounding and no curvature.
      const double f2 = std::fabs(e2 - e1) < kRounding ? 0 : 2 * (e2 - e1) / g0;
      const double f3 = std::fabs(e3 - e2) < kRounding ? 0 : 2 * (e3 - e2) / g1;
      const double slope = (e1 * h + e2 * (t(c) - t(c - 1))) / g0;
      if (k <= first_cell()) {
        p.c[0][i] = in_.knot != nullptr ? in_.at[i] : d[0][i];
      } else {
        const Piece& b = out_[k - 1];
        p.c[0][i] = b.c[0][i] + b.length * (b.c[1][i] + b.length * (b.c[2][i] + b.length * b.c[3][i]));
      }
      p.c[1][i] = slope;
      p.c[2][i] = f2 / 2;
      p.c[3][i] = (f3 - f2) / (6 * h);
    }
    if (in_.line.feed == nullptr) continue;
    if (one_feed_) {
      p.feed = in_.line.feed[0];
      continue;
    }
    while (edge + 2 < in_.line.count && room_.u[edge + 1] <= t(c) + 1e-9) ++edge;
    p.feed = in_.line.feed[edge];
    for (unsigned e = edge; e + 1 < in_.line.count && room_.u[e] < t(c + 1) - 1e-9; ++e)
      p.feed = std::min(p.feed, in_.line.feed[e]);
  }
}

/// Squared.
double Smoother::distance2(unsigned cell, double u, const AxisVec& p) const {
  const Piece& q = out_[cell];
  const double x = u - room_.knot[cell];
  double sum = 0;
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    const double off = q.c[0][i] + x * (q.c[1][i] + x * (q.c[2][i] + x * q.c[3][i])) - p[i];
    sum += off * off;
  }
  return sum;
}

/// Marks the cells to be split where the spline is too far from the polyline.
bool Smoother::near_enough() {
  const Polyline& l = in_.line;
  const double most = kUseMost * in_.tolerance * kUseMost * in_.tolerance;
  for (unsigned k = 0; k < last_; ++k) room_.split[k] = 0;
  bool good = true;
  unsigned vertex = 1, edge = 0;
  while (vertex + 1 < l.count && room_.u[vertex] < room_.knot[first_cell()]) ++vertex;
  for (unsigned k = first_cell(); k < last_; ++k) {
    const double from = room_.knot[k], to = room_.knot[k + 1];
    bool far = false;
    for (unsigned n = 1; n <= kLooks; ++n) {
      const double u = n == kLooks ? to : from + (to - from) * n / kLooks;
      far = far || distance2(k, u, on_line(u, &edge)) > most;
    }
    for (; vertex + 1 < l.count && room_.u[vertex] <= to; ++vertex) {
      if (!far && room_.u[vertex] >= from && distance2(k, room_.u[vertex], l.vertex[vertex]) > most) far = true;
    }
    if (!far) continue;
    good = false;
    room_.split[k] = 1;
    if (k > 0 && from - room_.knot[k - 1] > 0.6 * (to - from)) room_.split[k - 1] = 1;
    if (k + 1 < last_ && room_.knot[k + 2] - to > 0.6 * (to - from)) room_.split[k + 1] = 1;
  }
  return good;
}

/// Cells are halved, those of a sharp corner are not: they have their shape.
bool Smoother::split() {
  const auto halved = [&](unsigned k) {
    return k >= frozen() && room_.split[k] != 0 && !(room_.corner[k] != 0 && room_.corner[k] == room_.corner[k + 1]);
  };
  unsigned more = 0;
  for (unsigned k = 0; k < last_; ++k) more += halved(k) ? 1u : 0u;
  if (more == 0 || last_ + more + 3 >= room_.knots) return false;
  for (unsigned k = last_ + 1, to = last_ + more + 1; k-- > 0;) {  // from the end backward, in place
    if (k < last_ && halved(k)) {
      --to;  // knot k + 1 stands right behind
      room_.knot[to] = 0.5 * (room_.knot[k] + room_.knot[to + 1]);
      room_.corner[to] = 0;
    }
    --to;
    room_.knot[to] = room_.knot[k];
    room_.corner[to] = room_.corner[k];
  }
  last_ += more;
  return true;
}

unsigned Smoother::run() {
  if (in_.line.count < 2 || in_.line.count > room_.vertices || room_.knots < 8) return 0;
  if (!first_knots()) return 0;
  for (unsigned n = 0; n < kRounds; ++n) {
    if (last_ > capacity_) return 0;
    controls();
    pieces();
    if (near_enough()) return last_;
    if (!split()) return 0;
  }
  return 0;
}

}  // namespace

unsigned settled_cells(const SmoothRequest& request, const SmoothRoom& room, unsigned cells) {
  const unsigned least = request.knot != nullptr ? kFirstCell : 0;
  // The last three knots belong to the end, and cell k hangs on knots k - 2 to k + 3. No turn lies across the border.
  for (unsigned k = cells < 6 ? 0 : cells - 5; k > least && k >= kFirstCell; --k) {
    bool turn = false;
    for (unsigned n = k - kFirstCell; n < k + kGoesOn - 2; ++n) turn = turn || room.corner[n] != 0;
    if (!turn) return k;
  }
  return 0;
}

unsigned smooth(const SmoothRequest& request, const SmoothRoom& room, Piece* out, unsigned capacity) {
  return Smoother(request, room, out, capacity).run();
}

}  // namespace nc::optimal
