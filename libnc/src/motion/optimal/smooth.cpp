// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/smoother.hpp"

#include <algorithm>
#include <cmath>

#include "motion/optimal/turn.hpp"

namespace nc::optimal {
namespace {

constexpr double kUse = 0.94;  ///< one corner is given this part of the tolerance ...
constexpr double kSharp = 0.5;  ///< a corner with |t2 - t1| above this always has its own knots
constexpr double kAlone = 1.7;      ///< of its room, that a corner may ask for and is still one by itself, with what there is
/// The same for one that is not sharp: lines that follow a curve within the tolerance have no such corners.
constexpr double kAloneGentle = 0.95;
constexpr double kApart = 0.1;      ///< of the reach of a corner, that its knots lie apart from others, at least
constexpr double kShared = 1e-6;    ///< of it: a knot so near to its place is the last one, too
constexpr double kHigh = 2;         ///< in tolerances: a sharp corner of shorter edges is what the lines are rough by
constexpr double kStraight = 1e-9;  ///< where |t2 - t1| is no larger than this, there is no corner
constexpr unsigned kFine = 8;       ///< more of them, where they leave it open
constexpr double kRounding = 1e-11;  ///< a difference of q' that is smaller is rounding
constexpr double kStraightEnd = 0.2;  ///< the first knot lies no farther than this part of the first edge from its end
constexpr double kCornerCell = 0.26;  ///< of a piece of a sharp corner: its third derivative changes much, and that in a law is the same all along a cell
constexpr unsigned kRounds = 40;
constexpr unsigned kHangsOn = 3;    ///< cells on either side, whose knots make what a cell is
constexpr double kGrown = 2;        ///< times as long as the last cell that is known the next one may be to begin with
constexpr double kGrowth = 0.5;     ///< and by this much of the way more: where it asked for short cells it does so again
constexpr unsigned kRemembered = 4;  ///< cells that are known, the longest of which counts
/// Times that a cell is halved until its control points lie on the line, where halving is known to end.
constexpr unsigned char kFitted = 6;
constexpr double kLeastSpacing = 0.005;  ///< mm: a slow feed brings knots no nearer to each other ...
constexpr double kShortestSpacing = 1e-4;  ///< mm: ... and short lines no nearer than this
constexpr double kUseBorder = 0.9;  ///< of the tolerance, which a border is preferably no farther away from the line than
constexpr unsigned kLast = 3;  ///< so many knots belong to the end of the line
constexpr unsigned kFinal = 6;  ///< so many cells change when the end of the line does
constexpr unsigned kBorders = 24;   ///< places that are looked at for such a one
constexpr double kShortRest = 1e-6; ///< mm, of an edge: it is not cut so near to its end
constexpr int64_t kPlaces = 256;    ///< and of places where the distance is measured
constexpr unsigned kMeasured = 512; ///< the same of vertices where the line is measured
// Instructions: to measure along a vertex, to look whether it wants a knot, of an edge in a sum; of a cell for each axis: its control point, its
// polynomial, the distance of a place; to move a cell; and to look at the lines beside a corner.
constexpr int64_t kAlongCost = 12, kVertexCost = 150, kEdgeCost = 100, kControlCost = 150, kPieceCost = 120, kPlaceCost = 15, kMoveCost = 80, kCornerCost = 200;

}  // namespace

/// Of the knots about an edge: it goes by the lines there and by nothing that lies farther away.
double spacing_of(const SmoothRequest& in, const SmoothRoom& room, unsigned edge) {
  const Polyline& l = in.line;
  double most = in.spacing;
  if (in.seconds > 0) most = std::min(most, std::max(in.seconds * l.feed[edge], kLeastSpacing));
  if (in.edges > 0) {
    const unsigned from = edge > in.edges / 2 ? edge - in.edges / 2 : 0, to = std::min(edge + in.edges / 2 + 1, l.count - 1);
    most = std::min(most, std::max((room.u[to] - room.u[from]) * in.edges / (to - from), kShortestSpacing));
  }
  return most;
}

double Smoother::spacing(unsigned edge) const {
  const double grown = kGrown * grown_ + kGrowth * std::max(room_.u[edge] - grown_at_, 0.0);
  return std::min(spacing_of(in_, room_, edge), grown);
}

/// A knot at u, unless it lies less than `apart` behind the last one.
void Smoother::set(double u, double apart) {
  if (u - room_.knot[last_] < apart) return;
  if (last_ + 1 >= room_.knots) {
    full_ = true;
    return;
  }
  room_.knot[++last_] = u;
  room_.corner[last_] = 0;
  fresh(last_);
}

void Smoother::fresh(unsigned k) {
  SmoothCell& cell = room_.cell[k];
  cell.summed = cell.near = cell.split = false;
  cell.halved = 0;
}

/// A knot at a corner that is kept.
void Smoother::set_corner(double u, double apart) {
  const unsigned before = last_;
  set(u, apart);
  if (last_ != before) room_.cell[last_].halved = kCorner;
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

void Smoother::begin_knots() {
  const Polyline& l = in_.line;
  const double* u = room_.u;
  const double end = u[l.count - 1];
  room_.knot[0] = 0;
  room_.corner[0] = 0;
  fresh(0);
  last_ = 0;
  if (in_.from != nullptr) {
    for (unsigned n = 0; n < in_.kept_count && in_.kept[n] < end; ++n) set(in_.kept[n], 0);
    keep_ = room_.knot[last_];
    if (last_ > 0) grown_ = 0, grown_at_ = keep_;
    for (unsigned k = last_; k > 0 && k + kRemembered > last_; --k)
      grown_ = std::max(grown_, room_.knot[k] - room_.knot[k - 1]);
    while (first_ + 1 < l.count && u[first_] <= keep_) ++first_;
  } else if (in_.straight_start) {  // the first three control points lie on the first edge
    const double step = std::min(kStraightEnd * l.length[0], spacing(0));
    set(step, 0);
    set(2 * step, 0);
    keep_ = 2 * step;
  }
}

/// The knots that some vertices want.
void Smoother::knots(unsigned first, unsigned to) {
  const Polyline& l = in_.line;
  const double* u = room_.u;
  const double end = u[l.count - 1];
  double keep = keep_, apart = apart_;
  unsigned valid = valid_;
  for (unsigned k = first; k < to; ++k) {
    const double turn = corner(k);
    const bool feed = l.feed != nullptr && l.feed[k] != l.feed[k - 1];
    if (turn < kStraight && !feed) continue;
    const double reach = turn < kStraight ? HUGE_VAL : 6 * kUse * in_.tolerance / turn;
    const double before = l.length[k - 1] + (k == 1 ? in_.hidden : 0), behind = l.length[k];
    const double turn_most = kUseTurn * in_.tolerance / (kTurnDepth * turn);
    const double turn_reach = std::min(turn_most, 0.4999 * std::min(before, behind));
    if (turn > kSharp && turn_reach < turn_most && set_turn_of_lines(k, turn_most, turn_reach, &keep)) continue;
    if (turn > kSharp && turn_reach > kLeastTurn * turn_most && u[k] - turn_reach > keep) {
      set_turn(k, turn_reach);
      keep = u[k] + turn_reach;
      continue;
    }
    const double high = turn * before * behind / (before + behind);  // about that of the triangle of its edges
    const bool sharp = turn > kSharp && high > kHigh * in_.tolerance;
    const bool alone = 2 * reach <= (sharp ? kAlone : kAloneGentle) * std::min(before, behind);
    if (alone || sharp) {
      double h = std::min({reach, alone ? 0.5 * std::min(before, behind) : reach, end - u[k], u[k]});
      const double from = std::max(room_.knot[last_], keep);
      // The knot in front of it is its own, as far away as that behind it: beside one some percent farther away it would be cut by more than it
      // was given, and then all its cells would be halved.
      if (u[k] - from > (1 + kShared) * h) {
        h = std::min(h, (u[k] - from) / (1 + kApart));
        set(u[k] - h, 0.9 * kApart * h);
      }
      set_corner(u[k], kApart * h);
      keep = u[k] + h;
      if (alone) set(keep, 0);
      continue;
    }
    const double gap = u[k] - room_.knot[last_];
    if (k >= valid) apart = spacing(k - 1), valid = k + 1 + in_.edges / 8;
    if (feed) valid = k + 1;
    if (gap > kLongEdge * apart) {  // what bends at one end shall not reach the other
      set(room_.knot[last_] + apart, 0);
      set(u[k] - apart, 0.3 * apart);
    }
    set(u[k], feed ? 1e-6 : 0.7 * apart);
  }
  keep_ = keep;
  apart_ = apart;
  valid_ = valid;
}

void Smoother::end_knots() {
  const Polyline& l = in_.line;
  const double end = room_.u[l.count - 1];
  // The end: three knots of their own on the last edge, so that it is straight there.
  apart_ = spacing(l.count - 2);
  while (last_ > 0 && end - room_.knot[last_] < 1e-9 * end) --last_;
  if (in_.straight_end) {
    const double step = std::min(kStraightEnd * l.length[l.count - 2], apart_);
    set(end - 2 * step, 0.1 * step);
    set(end - step, 0.1 * step);
  }
  const double gap = end - room_.knot[last_];
  if (last_ == 0 || gap > 2 * apart_) {
    const double step = std::min(apart_, gap / 4);
    const double bent = room_.knot[last_];
    set(bent + step, 0);
    if (in_.open && gap > kLongEdge * apart_) set(bent + 2 * step, 0);  // straight from there on, so that it can be cut
    set(end - step, 0);
  }
  set(end, 0);
}

/// u of some vertices.
void Smoother::measure(unsigned from, unsigned to) {
  const Polyline& l = in_.line;
  double* u = room_.u;
  for (unsigned k = from; k < to; ++k) u[k] = u[k - 1] + l.length[k - 1];
  bool one = one_feed_;
  for (unsigned k = from; k < to && k + 1 < l.count && l.feed != nullptr; ++k) one = one && l.feed[k] == l.feed[0];
  one_feed_ = one;
}

Task<bool> Smoother::first_knots(Work& work) {
  const unsigned count = in_.line.count;
  room_.u[0] = 0;
  for (unsigned k = 1; k < count; k += kMeasured) {
    measure(k, std::min(count, k + kMeasured));
    co_await work.pause(kMeasured * kAlongCost);
  }
  begin_knots();
  for (unsigned k = first_; k + 1 < count; k += kAtOnce) {
    const unsigned to = std::min(count - 1, k + kAtOnce);
    corners_looked_at_ = 0;
    knots(k, to);
    co_await work.pause((to - k) * kVertexCost + corners_looked_at_ * in_.axis_count * kCornerCost);
  }
  end_knots();
  co_return !full_;
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

/// Control point j goes through the middle of the line where it hangs on no end and on no corner that is kept.
/// Others, and those of a straight part, lie on the line at the mean of knots j - 2, j - 1, j (the end knots
/// count three times).
void Smoother::controls(unsigned from, unsigned to, unsigned* edge) {
  for (unsigned j = from; j < to; ++j) {
    if (fits(j)) {
      const SmoothCell* const first = room_.cell + (j - 3);
      const CellMoments* const cells[4] = {&first[0].moments, &first[1].moments, &first[2].moments, &first[3].moments};
      room_.control[j] = fitted_control(cells, in_.axis_count);
    } else {
      const int k = static_cast<int>(j);
      room_.control[j] = on_line((t(k - 2) + t(k - 1) + t(k)) / 3, edge);
    }
  }
}

Task<bool> Smoother::controls(Work& work) {
  unsigned edge = 0;
  for (unsigned k = 0; k < last_; ++k) {
    const bool summed = room_.cell[k].summed;
    sum_up(k, &edge);
    if (!summed) co_await work.pause(in_.axis_count * kEdgeCost * (1 + room_.cell[k].last_edge - room_.cell[k].first_edge));
  }
  edge = 0;
  for (unsigned j = 0; j < last_ + 3; j += kAtOnce) {
    controls(j, std::min(last_ + 3, j + kAtOnce), &edge);
    co_await work.pause(kAtOnce * in_.axis_count * kControlCost);
  }
  for (unsigned k = 1; k + kTurnPieces <= last_; ++k) {
    if (room_.corner[k] == 0 || room_.corner[k + kTurnPieces] != room_.corner[k]) continue;
    turn_controls(k);
    co_await work.pause(kTurnPieces * in_.axis_count * kPieceCost);
  }
  room_.control[0] = in_.line.vertex[0];
  if (in_.from != nullptr) start_controls();
  room_.control[last_ + 2] = in_.line.vertex[in_.line.count - 1];
  co_return true;
}

/// Moments of a cell, if it is new. `edge`: one at or in front of the cell, and then that at its end.
void Smoother::sum_up(unsigned k, unsigned* edge) {
  const Edges line{in_.line.vertex, in_.line.length, room_.u, in_.line.count};
  SmoothCell& cell = room_.cell[k];
  if (!cell.summed) {
    while (*edge + 2 < line.count && room_.u[*edge + 1] <= room_.knot[k]) ++*edge;
    cell.first_edge = *edge;
    cell_moments(line, room_.knot[k], room_.knot[k + 1], in_.axis_count, edge, &cell.moments);
    cell.last_edge = *edge;
    find_feeds(&cell);
    cell.summed = true;
  }
  *edge = cell.last_edge;
}

void Smoother::find_feeds(SmoothCell* cell) const {
  const double* feed = in_.line.feed;
  cell->least_feed = cell->most_feed = 0;
  if (feed == nullptr || one_feed_) return;
  const auto [least, most] = std::minmax_element(feed + cell->first_edge, feed + cell->last_edge + 1);
  cell->least_feed = *least;
  cell->most_feed = *most;
}

/// Where the feed changes much no control point is fitted. Knots beside a short slow line lie close together and those of its fast neighbours
/// far apart: what the fit takes to be nearest to these may lie beside the line by the tolerance, many times the length of the short one, and
/// that way would be gone at its feed. Control points on the line make |q'| <= 1 instead: the path with a feed is no longer than its line.
bool Smoother::fits(unsigned j) const {
  if (j < 3 || j >= last_) return false;
  const SmoothCell* const cell = room_.cell + (j - 3);
  if (cell[0].first_edge == cell[3].last_edge) return false;  // straight: it stays so to the last bit
  const double least = std::min({cell[0].least_feed, cell[1].least_feed, cell[2].least_feed, cell[3].least_feed});
  if (std::max({cell[0].most_feed, cell[1].most_feed, cell[2].most_feed, cell[3].most_feed}) > kOtherFeed * least) return false;
  return std::max({room_.cell[j - 2].halved, room_.cell[j - 1].halved, room_.cell[j].halved}) < kFitted;
}

/// The control points that make the position q and the derivatives q', q'' at the start, where the knots count three times: values of the
/// polar form f(0, 0, 0), f(0, 0, t1) and f(0, t1, t2), of which f(0, b, c) = q + q' (b + c) / 3 + q'' b c / 6. What follows is free, so a
/// curve can go on from any place of another one, whatever its knots were.
void Smoother::start_controls() {
  const CurvePoint& q = *in_.from;
  const double b = t(1), c = t(2);
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    room_.control[0][i] = q.position[i];
    room_.control[1][i] = q.position[i] + q.d1[i] * b / 3;
    room_.control[2][i] = q.position[i] + q.d1[i] * (b + c) / 3 + q.d2[i] * b * c / 6;
  }
}

/// Polynomials of some cells, from the derivatives of the spline at the knots.
void Smoother::pieces(unsigned from, unsigned to, unsigned* first_edge) {
  const AxisVec* d = room_.control;
  unsigned edge = *first_edge;
  for (unsigned k = from; k < to; ++k) {
    const int c = static_cast<int>(k);
    const double h = t(c + 1) - t(c);
    Piece& p = out_[k];
    p.length = h;
    p.curve = nullptr;
    p.rapid = p.quintic = false;
    p.cell = 0;
    p.feed = HUGE_VAL;
    const bool turn = in_turn(k);
    AxisVec rest[6];
    if (turn) {
      turn_rest(k, rest);
      p.quintic = true;
      p.cell = kCornerCell * h;
    }
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
      if (k == 0) {
        p.c[0][i] = d[0][i];
      } else {
        const Piece& b = out_[k - 1];
        p.c[0][i] = place_on(b, b.length, i);
        if (turn) p.c[0][i] -= rest[0][i];
      }
      p.c[2][i] = f2 / 2;
      p.c[3][i] = (f3 - f2) / (6 * h);
      // Beside a corner the knots are so near to one another that the rounding of their control values is 1e-12 of a slope: at the end of a long
      // cell that would be a place beside the line. So the cell leads to where the spline is at its end, as far as rounding may turn it.
      const double before = d[k + 1][i] + w2 / 3 * (t(c + 1) - t(c - 1)) * (d[k + 2][i] - d[k + 1][i]),
                   behind = d[k + 2][i] + w3 / 3 * h * (d[k + 3][i] - d[k + 2][i]);
      const double missed = before + (behind - before) * h / g1 - (p.c[0][i] + h * (slope + h * (p.c[2][i] + h * p.c[3][i])));
      p.c[1][i] = slope + std::clamp(missed / h, -kRounding, kRounding);
      if (!turn) continue;
      for (unsigned j = 0; j < 4; ++j) p.c[j][i] += rest[j][i];
      p.c[4][i] = rest[4][i];
      p.c[5][i] = rest[5][i];
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
  *first_edge = edge;
}

Task<bool> Smoother::pieces(Work& work) {
  unsigned edge = 0;
  for (unsigned k = 0; k < last_; k += kAtOnce) {
    pieces(k, std::min(last_, k + kAtOnce), &edge);
    co_await work.pause(kAtOnce * in_.axis_count * kPieceCost);
  }
  co_return true;
}

/// Squared.
double Smoother::distance2(unsigned cell, double u, const AxisVec& p) const {
  const Piece& q = out_[cell];
  const double x = u - room_.knot[cell];
  double sum = 0;
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    const double off = place_on(q, x, i) - p[i];
    sum += off * off;
  }
  return sum;
}

/// A cell is no farther from the polyline than `most` (squared), at its places that are looked at, its start among them, and at the vertices. Between two of them the
/// polyline is straight and the distance bends by q'' alone: with d the places' distance it may be larger by d^2 / 8 max|q''|.
bool Smoother::far(unsigned k, double most, unsigned* vertex, unsigned* edge) const {
  const Polyline& l = in_.line;
  const double from = room_.knot[k], to = room_.knot[k + 1], h = to - from;
  double worst = 0;
  for (unsigned n = 0; n <= kLooks; ++n) {
    const double u = n == kLooks ? to : from + h * n / kLooks;
    worst = std::max(worst, distance2(k, u, on_line(u, edge)));
  }
  *vertex = std::max(*vertex, room_.cell[k].first_edge);
  for (; *vertex + 1 < l.count && room_.u[*vertex] <= to; ++*vertex)
    if (room_.u[*vertex] >= from) worst = std::max(worst, distance2(k, room_.u[*vertex], l.vertex[*vertex]));
  if (worst > most) return true;
  const Piece& p = out_[k];
  double bend2 = 0;
  CurvePoint end;
  derivatives(p, h, in_.axis_count, &end);
  for (unsigned i = 0; i < in_.axis_count; ++i) {  // the largest one is at an end: also in a sharp corner the second derivative grows up to its middle
    const double bend = std::max(std::fabs(2 * p.c[2][i]), std::fabs(end.d2[i]));
    bend2 += bend * bend;
  }
  const double between = h / kLooks * h / kLooks / 8 * std::sqrt(bend2);
  if (std::sqrt(worst) + between <= in_.tolerance) return false;
  const double fine2 = std::max(in_.tolerance - between / (kFine * kFine), 0.0) * std::max(in_.tolerance - between / (kFine * kFine), 0.0);
  for (unsigned n = 0; n < kFine * kLooks; ++n) {
    const double u = from + h * n / (kFine * kLooks);
    if (distance2(k, u, on_line(u, edge)) > fine2) return true;
  }
  return false;
}

/// Marks cells to be split where the spline is too far from the polyline. Goes on for some of them. @return what it has cost
int64_t Smoother::look_on(Look* look) {
  const double kept = look->kept;
  unsigned vertex = look->vertex, edge = look->edge, k = look->cell;
  int64_t places = 0;
  for (; k < last_ && places < kPlaces; ++k) {
    const double use = in_.from != nullptr && k < kStartCells ? kUseStart : kUseMost;
    if (room_.cell[k].near) continue;
    room_.cell[k].near = !far(k, use * in_.tolerance * use * in_.tolerance, &vertex, &edge);
    places += kLooks * (kFine / 2) + 2 + room_.cell[k].last_edge - room_.cell[k].first_edge;
    if (room_.cell[k].near) continue;
    const double from = room_.knot[k], to = room_.knot[k + 1];
    look->good = false;
    room_.cell[k].split = true;
    if (k > 0 && room_.knot[k - 1] >= kept && from - room_.knot[k - 1] > 0.6 * (to - from))
      room_.cell[k - 1].split = true;
    if (k + 1 < last_ && to >= kept && room_.knot[k + 2] - to > 0.6 * (to - from))
      room_.cell[k + 1].split = true;
  }
  look->cell = k;
  look->vertex = vertex;
  look->edge = edge;
  return places * in_.axis_count * kPlaceCost;
}

Task<bool> Smoother::near_enough(Work& work) {
  Look look;
  look.kept = in_.from != nullptr && in_.kept_count > 0 ? in_.kept[in_.kept_count - 1] : 0;
  while (look.cell < last_) co_await work.pause(look_on(&look));
  // They were near enough when they were followed by finer cells.
  bool others = false;
  for (unsigned k = 0; k < last_; ++k) others = others || (room_.knot[k] >= look.kept && room_.cell[k].split);
  for (unsigned k = 0; others && k < last_ && room_.knot[k] < look.kept; ++k) room_.cell[k].split = false;
  co_return look.good;
}

/// Cells are halved.
Task<bool> Smoother::split(Work& work) {
  unsigned more = 0;
  for (unsigned k = 0; k < last_; ++k) more += halved(k) ? 1u : 0u;
  if (more == 0 || last_ + more + 3 >= room_.knots) co_return false;
  unsigned apart = kHangsOn;  // cells behind the last one that was halved
  for (unsigned k = last_ + 1, to = last_ + more + 1; k-- > 0;) {  // from the end backward, in place
    SmoothCell& cell = room_.cell[k];
    const bool half = k < last_ && halved(k);
    cell.split = false;
    if (half) {
      --to;  // knot k + 1 stands right behind
      room_.knot[to] = 0.5 * (room_.knot[k] + room_.knot[to + 1]);
      room_.corner[to] = 0;
      if ((cell.halved & kTimes) < kTimes) ++cell.halved;
      cell.summed = false;
      fresh(to);
      room_.cell[to].halved = cell.halved & kTimes;
      for (unsigned n = to + 1; n <= to + kHangsOn && n < last_ + more; ++n) room_.cell[n].near = false;
    }
    apart = half ? 0 : apart + 1;
    --to;
    if (to != k) room_.cell[to] = cell;
    if (apart <= kHangsOn) room_.cell[to].near = false;
    room_.knot[to] = room_.knot[k];
    room_.corner[to] = room_.corner[k];
    if (k % kAtOnce == 0) co_await work.pause(kAtOnce * kMoveCost);
  }
  last_ += more;
  co_return true;
}

Task<unsigned> Smoother::run(Work& work) {
  if (in_.line.count < 2 || in_.line.count > room_.vertices || room_.knots < 8) co_return 0;
  bool done = co_await first_knots(work);
  if (!done) co_return 0;
  for (unsigned n = 0; n < kRounds; ++n) {
    if (last_ > capacity_) co_return 0;
    co_await controls(work);
    co_await pieces(work);
    done = co_await near_enough(work);
    if (done) co_return last_;
    done = co_await split(work);
    if (!done) co_return 0;
  }
  co_return 0;
}

namespace {

/// The cell is a straight part of the line.
bool straight(const Piece& p, unsigned axis_count) {
  for (unsigned i = 0; i < axis_count; ++i)
    if (p.c[2][i] != 0 || p.c[3][i] != 0) return false;
  return true;
}

/// The end of the line is straight for more than its knots need: it is cut there, wherever its knots lie.
bool cut_straight(const SmoothRequest& request, const SmoothRoom& room, const Piece* pieces, unsigned cells, unsigned most, Border* border) {
  const Polyline& l = request.line;
  double u = room.knot[cells] - (kFinal + 1) * spacing_of(request, room, l.count - 2);
  unsigned k = std::min(cells, most);
  while (k > 0 && room.knot[k] > u) --k;
  if (k == 0 || k >= most || k == cells || !(u > room.knot[k]) || !straight(pieces[k], request.axis_count)) return false;
  unsigned edge = l.count - 2;
  while (edge > 0 && room.u[edge] > u) --edge;
  if (room.u[edge + 1] - u < kShortRest) u = 0.5 * (room.u[edge] + room.u[edge + 1]);
  if (room.u[edge + 1] - u < kShortRest || u - room.knot[k] < kShortRest) return false;
  border->cells = k + 1;
  border->u = u;
  border->kept_count = 0;
  return true;
}

}  // namespace

Border find_border(const SmoothRequest& request, const SmoothRoom& room, const Piece* pieces, unsigned cells, unsigned most) {
  const Polyline& l = request.line;
  unsigned edge = l.count - 2;
  double least = HUGE_VAL;
  Border best;
  if (cut_straight(request, room, pieces, cells, most, &best)) return best;
  // The last three knots belong to the end, and cell k - 1 hangs on knots up to k + 2. Two places of kinds that are left out never follow one
  // another but inside of a sharp corner, which has kTurnPieces cells: so there is a border wherever there are more cells than that.
  for (unsigned k = cells < kFinal + 1 ? 0 : std::min(cells - kFinal, most), n = 0; k > 0 && (n < kBorders || best.cells == 0); --k, ++n) {
    if (room.corner[k] != 0 && room.corner[k] == room.corner[k + 1]) continue;  // a sharp corner is made as a whole
    const double u = room.knot[k];
    while (edge > 0 && room.u[edge] > u) --edge;
    if (room.u[edge + 1] - u < kShortRest) continue;
    double off2 = 0;
    for (unsigned i = 0; i < request.axis_count; ++i) {
      const double line = l.vertex[edge][i] + (u - room.u[edge]) / l.length[edge] * (l.vertex[edge + 1][i] - l.vertex[edge][i]);
      off2 += (pieces[k].c[0][i] - line) * (pieces[k].c[0][i] - line);
    }
    if (!(off2 < least)) continue;
    least = off2;
    best.cells = k;
    best.u = u;
    best.kept_count = 0;
    while (best.kept_count < kKept && k + best.kept_count + kLast < cells && room.cell[k + 1 + best.kept_count].halved < kFitted) {
      best.kept[best.kept_count] = room.knot[k + 1 + best.kept_count] - u;
      ++best.kept_count;
    }
    if (off2 <= kUseBorder * request.tolerance * kUseBorder * request.tolerance) break;
  }
  return best;
}

Task<unsigned> smooth(Work& work, const SmoothRequest& request, const SmoothRoom& room, Piece* out, unsigned capacity) {
  Smoother smoother(request, room, out, capacity);
  const unsigned count = co_await smoother.run(work);
  co_return count;
}

}  // namespace nc::optimal
