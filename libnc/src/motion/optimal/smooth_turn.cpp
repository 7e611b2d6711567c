// SPDX-License-Identifier: Apache-2.0
// Sharp corners of a smoothed polyline, each with the curve of turn.hpp. It needs a straight line on either side, of twice its reach. That is one edge,
// or several of them that lie on a straight line but for a part of the tolerance: the end of a row of a surface in short lines is a corner, too.
#include <algorithm>
#include <cmath>

#include "motion/optimal/smoother.hpp"
#include "motion/optimal/turn.hpp"

namespace nc::optimal {
namespace {

constexpr double kLine = 2;  ///< reaches of a corner, for which there is a line on either side
constexpr double kOffLine = 0.25;  ///< of the tolerance, by which edges may lie off it
constexpr unsigned kLineEdges = 16;  ///< of a line, at most
constexpr double kOwnKnots = 3;  ///< reaches, up to which all knots beside such a corner are its own: they keep the curve on its line
constexpr double kClear = 0.3;   ///< of the reach, that they are away from others
constexpr unsigned kReaches = 4;  ///< that are tried
constexpr double kSafeShare = 0.98;  ///< of the reach that should do: the line is another one when it is shorter
constexpr double kNearly = 1e-9;

}  // namespace

void Smoother::set_turn(unsigned vertex, double reach) {
  const double u = room_.u[vertex];
  for (unsigned n = 0; n <= kTurnPieces; ++n) {
    set_corner(n < kTurnPieces ? u + kTurn.piece[n].at * reach : u + reach, 0);
    room_.corner[last_] = vertex;
  }
}

/// The lines beside a corner with that reach are made of several edges.
bool Smoother::of_lines(unsigned vertex, double reach) const {
  const double before = in_.line.length[vertex - 1] + (vertex == 1 ? in_.hidden : 0);
  return kLine * reach > std::min(before, in_.line.length[vertex]);
}

/// Directions of the lines beside a corner, by u: of the edge where that is long enough, else to the place of the polyline at the end of the line.
Smoother::TurnSides Smoother::turn_sides(unsigned vertex, double reach) const {
  const Polyline& l = in_.line;
  const AxisVec& at = l.vertex[vertex];
  const double before = l.length[vertex - 1] + (vertex == 1 ? in_.hidden : 0), way = kLine * reach;
  TurnSides out;
  unsigned edge = vertex - 1;
  const bool edge_before = way <= before, edge_behind = way <= l.length[vertex];
  const AxisVec from = edge_before ? l.vertex[vertex - 1] : on_line(room_.u[vertex] - way, &edge);
  const AxisVec to = edge_behind ? l.vertex[vertex + 1] : on_line(room_.u[vertex] + way, &edge);
  const double pa = 1 / (edge_before ? l.length[vertex - 1] : way), pb = 1 / (edge_behind ? l.length[vertex] : way);
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    out.before[i] = (at[i] - from[i]) * pa;
    out.behind[i] = (to[i] - at[i]) * pb;
  }
  return out;
}

/// What the curve of a corner with that reach is away from the polyline at the most. HUGE_VAL where there are no lines beside it.
double Smoother::turn_depth(unsigned vertex, double reach) const {
  const Polyline& l = in_.line;
  const double u = room_.u[vertex], way = kLine * reach;
  const TurnSides sides = turn_sides(vertex, reach);
  double turn2 = 0, off2 = 0;
  for (unsigned i = 0; i < in_.axis_count; ++i) turn2 += (sides.behind[i] - sides.before[i]) * (sides.behind[i] - sides.before[i]);
  const auto look = [&](unsigned k, const AxisVec& along) {
    double sum = 0;
    for (unsigned i = 0; i < in_.axis_count; ++i) {
      const double off = l.vertex[vertex][i] + (room_.u[k] - u) * along[i] - l.vertex[k][i];
      sum += off * off;
    }
    off2 = std::max(off2, sum);
    return sum <= kOffLine * in_.tolerance * kOffLine * in_.tolerance;
  };
  for (unsigned k = vertex; k-- > 0 && u - room_.u[k] < way;)
    if (vertex - k > kLineEdges || !look(k, sides.before)) return HUGE_VAL;
  for (unsigned k = vertex + 1; k < l.count && room_.u[k] - u < way; ++k)
    if (k - vertex > kLineEdges || !look(k, sides.behind)) return HUGE_VAL;
  return kTurnDepth * std::sqrt(turn2) * reach + std::sqrt(off2);
}

/// All edges on either side of a corner, up to that way, have one feed: the curve and its knots take no heed of where one of them ends.
bool Smoother::one_feed_beside(unsigned vertex, double way) const {
  const Polyline& l = in_.line;
  if (one_feed_ || l.feed == nullptr) return true;
  const double u = room_.u[vertex];
  for (unsigned k = vertex - 1; k-- > 0 && u - room_.u[k + 1] < way;)
    if (l.feed[k] != l.feed[vertex - 1]) return false;
  for (unsigned k = vertex + 1; k + 1 < l.count && room_.u[k] - u < way; ++k)
    if (l.feed[k] != l.feed[vertex]) return false;
  return true;
}

/// The control points in front of a corner are on its line when `last` is the last knot in front of it. Those that make the start of a line are what
/// they are.
bool Smoother::on_line_before(unsigned vertex, double reach, unsigned last) const {
  const double u = room_.u[vertex], knot[4] = {room_.knot[last > 0 ? last - 1 : 0], room_.knot[last], u - reach, u + kTurn.piece[1].at * reach};
  const unsigned first = in_.from != nullptr ? kStartCells : 1;
  for (unsigned n = 0; n < 2; ++n)
    if (last + 1 + n >= first && (knot[n] + knot[n + 1] + knot[n + 2]) / 3 < u - (kLine + kNearly) * reach) return false;
  return true;
}

/// Knots for a sharp corner between lines of several edges, if there are such. `most`: the reach that it would have between long edges;
/// `of_edges`: that between its own. Other knots than its own lie in front of `*keep`, and behind it then.
bool Smoother::set_turn_of_lines(unsigned vertex, double most, double of_edges, double* keep) {
  const double u = room_.u[vertex], end = room_.u[in_.line.count - 1], deepest = kUseTurn * in_.tolerance;
  const double least = std::max(kLeastTurn * most, of_edges);
  double reach = most;
  for (unsigned n = 0;; ++n) {
    if (n == kReaches || reach < least || u - reach * (1 + kClear) < *keep || u + reach * (kOwnKnots + kClear) > end) return false;
    const double depth = turn_depth(vertex, reach);
    ++corners_looked_at_;
    if (depth == HUGE_VAL) return false;
    if (depth <= deepest) break;
    reach *= kSafeShare * deepest / depth;
  }
  if (!one_feed_beside(vertex, (kOwnKnots + kClear) * reach)) return false;
  const bool own = u - (kOwnKnots + kClear) * reach > *keep;
  // Where a line goes on from one that was smoothed before, the knots in front of the corner may be known already.
  unsigned last = last_;
  while (last > 0 && room_.knot[last] > *keep && room_.knot[last] > u - ((own ? kOwnKnots : 1) + kClear) * reach) --last;
  if (!own && !on_line_before(vertex, reach, last)) return false;
  last_ = last;
  if (own) {
    set(u - kOwnKnots * reach, 0);
    set(u - kLine * reach, 0);
  }
  set_turn(vertex, reach);
  set(u + kLine * reach, 0);
  set(u + kOwnKnots * reach, 0);
  *keep = u + kOwnKnots * reach;
  return true;
}

/// A sharp corner whose first knot is `first`. With q'' = (t2 - t1) K(u) the control values of the part that
/// turns follow from the differences that pieces() takes: e grows by K (t_(k+1) - t_(k-1)) / 2 at knot k, d
/// by e (t_j - t_(j-3)) / 3. Those beside it lie on its lines.
void Smoother::turn_controls(unsigned first) {
  const Polyline& l = in_.line;
  const unsigned vertex = room_.corner[first];
  const int a = static_cast<int>(first);
  const double u = room_.u[vertex], reach = u - t(a);
  const TurnSides sides = turn_sides(vertex, reach);
  const int beside = of_lines(vertex, reach) ? 2 : -1;
  double e = 0, d = 0;
  for (int n = -beside; n <= static_cast<int>(kTurnPieces); ++n) {
    const int j = a + 2 + n;  // control value a + 2 is the last one before the turn
    if (n > 0) {
      e += kTurn.chord[n] / reach * (t(a + n + 1) - t(a + n - 1)) / 2;  // nothing at the last one
      d += e * (t(j) - t(j - 3)) / 3;
    }
    const double along = (t(j - 2) + t(j - 1) + t(j)) / 3 - u;
    for (unsigned i = 0; i < in_.axis_count; ++i) {
      const double t1 = sides.before[i], t2 = sides.behind[i];
      room_.control[static_cast<unsigned>(j)][i] = l.vertex[vertex][i] + along * t1 + d * (t2 - t1);
    }
  }
}

/// What the curve of a sharp corner has beyond the cubic of its cell k, by axis.
void Smoother::turn_rest(unsigned k, AxisVec* out) const {
  const unsigned vertex = room_.corner[k];
  unsigned first = k;
  while (room_.corner[first - 1] == vertex) --first;
  const double reach = room_.u[vertex] - room_.knot[first];
  const TurnSides sides = turn_sides(vertex, reach);
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    double scale = reach * (sides.behind[i] - sides.before[i]);
    for (unsigned j = 0; j < 6; ++j, scale /= reach) out[j][i] = scale * kTurn.rest[k - first][j];
  }
}

}  // namespace nc::optimal
