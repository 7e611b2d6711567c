// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kArc = 0.06;  ///< rad: a cell on an arc turns by no more
constexpr double kRatio = 1.12;  ///< the speed at one end of a cell is at most this many times that at the other: the jerk in a cell goes with its speed
constexpr double kRatioAlone = 1.04;  ///< the same on a line from rest to rest, where nothing else asks for cells
constexpr double kLaunch = 4;  ///< the cell next to rest takes at most this many periods
constexpr double kLaunchSpeed = 0.5;  ///< in the cell next to rest the tool comes to at most this part of the speed and acceleration that the path allows
constexpr unsigned kShorterLaunch = 12;  ///< the cell next to rest is made shorter at most so often
constexpr double kCurvedLaunch = 0.125;  ///< where the path bends, the cell next to rest has this part of its length
constexpr double kShortLaunch = 0.025;  ///< the cell next to rest is at most this part of the window
constexpr double kGentle = 24;  ///< the guess leaves the speed of the start within this many cells
constexpr double kFeed =
    0.9995;  ///< of feed and axis velocities where the path bends: |q'| changes inside a cell
constexpr double kFirstFiner = 0.12, kFirstFine = 12, kStopFiner = 0.8;  ///< of the usual length are the first cells of a stop, longer by that behind so many cells, and the last ones
constexpr double kJointPart = 0.25;  ///< of the cell that would be there: a joint of what is followed that is so near to another place is none
constexpr double kAtStart = 1.0012;   ///< a start at speed is given, and rows of other cells have let it pass
constexpr double kRounding = 1e-12;  ///< two places that are nearer to each other than this part of the length of the window are the same but for rounding
/// The first cell of a start that brakes is at most this part of the length in which it would come to rest braking twice as hard.
constexpr double kBraking = 0.8;
constexpr unsigned kShorter = 100;  ///< a window is made shorter at most so often
constexpr double kSameReach = 1e-9;  ///< mm: where the path ends so near to the end of a piece, it ends with the piece
constexpr unsigned kNodesPerCell = 2;  ///< the estimate has so many nodes for each cell: a cell lasts one of its periods, or half a period more
constexpr unsigned kShare = 8;  ///< a window with too many cells loses one part in so many
constexpr double kSameCap = 1e-7;  ///< two bounds of the squared speed that differ by this part of themselves are the same
constexpr double kLevelUse = 0.9;  ///< where the speed is known to stay, the path itself may take this part of a limit
constexpr double kRampUse = 0.6;  ///< the guess comes to such a steady speed with this part of the limits
constexpr double kGentleLevel = 10;  ///< the guess comes to a steady speed within this many cells
constexpr unsigned kFewestLevel = 8;  ///< a steady speed is looked for where at least so many cells in a row allow the same
constexpr double kSteep = 0.5;         ///< an estimate from rest that is flatter, speed times period by length, makes cells that grow by some percent each
constexpr double kSlowest = 1e-3;  ///< mm/s: the speed that a cell has at least in the estimate, where nothing else bounds it from below
/// The same by the speed that the path allows. A corner between turns of a rotary axis has so little of the linear axes, by which the length goes, that kSlowest is
/// far above all that it allows, and a step with that would leave it at once.
constexpr double kSlowestShare = 0.04;
// Instructions: of a piece or a knot for each axis, on a polynomial and on another curve, of a step of the estimate, and of a cell.
constexpr int64_t kPieceCost = 200, kCurveCost = 1500, kNodeCost = 60, kCellCost = 400, kLevelCost = 60;
constexpr unsigned kNodesAtOnce = 256, kCellsAtOnce = 32, kKnotsAtOnce = 8;  ///< how many are made before others may have their turn

/// What the derivatives of an axis are measured by.
double measure(const Limits& limits, unsigned i) {
  return limits.jerk[i] > 0 ? limits.jerk[i] : 1;
}

}  // namespace

double WayDown::at(double place) const {
  if (count == 0 || place > u[count - 1]) return 0;
  unsigned low = 0, high = count - 1;
  while (high - low > 1) {
    const unsigned middle = (low + high) / 2;
    (u[middle] <= place ? low : high) = middle;
  }
  const double share = (place - u[low]) / (u[high] - u[low]);
  return std::max(b[low] + share * (b[high] - b[low]), 0.0);
}

/// Speed at which the curvature and its change take all, and what is left along the path at no speed.
Mesher::Bound Mesher::bound_of(const Piece& p, double from) const {
  Bound b{feed_of(p, *limits_), HUGE_VAL, HUGE_VAL, HUGE_VAL, false};
  const unsigned samples = p.curve != nullptr || p.quintic ? 4 : 2;  // other curves than arcs come in pieces that are nearly even
  double most[3][kMaxAxes] = {}, along2 = 0, bend2 = 0;  // along, bend: in the measure of the jerk limits, whatever the units of the axes
  CurvePoint q;
  for (unsigned n = 0; n <= samples; ++n) {
    derivatives(p, from + (p.length - from) * n / samples, limits_->axis_count, &q);
    double here2 = 0;
    for (unsigned i = 0; i < limits_->axis_count; ++i) {
      most[0][i] = std::max(most[0][i], std::fabs(q.d1[i]));
      most[1][i] = std::max(most[1][i], std::fabs(q.d2[i]));
      most[2][i] = std::max(most[2][i], std::fabs(q.d3[i]));
      const double share = q.d1[i] / measure(*limits_, i);
      here2 += share * share;
    }
    along2 = std::max(along2, here2);
  }
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    const double share = most[1][i] / measure(*limits_, i);
    bend2 += share * share;
  }
  b.curved = bend2 > 0;
  if (p.curve != nullptr && b.curved) b.cell = kArc * std::sqrt(along2 / bend2);
  if (p.cell > 0) b.cell = p.cell;
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    const double v = velocity_of(p, *limits_, i);
    const double a = acceleration_share(p, *limits_) * limits_->acceleration[i], j = jerk_share(p, *limits_) * limits_->jerk[i];
    if (v > 0 && b.speed * most[0][i] > v) b.speed = v / most[0][i];
    if (a > 0 && b.speed * b.speed * most[1][i] > a) b.speed = std::sqrt(a / most[1][i]);
    if (j > 0 && b.speed * b.speed * b.speed * most[2][i] > j) b.speed = std::cbrt(j / most[2][i]);
    if (a > 0 && b.acceleration * most[0][i] > a) b.acceleration = a / most[0][i];
    if (j > 0 && b.jerk * most[0][i] > j) b.jerk = j / most[0][i];
  }
  return b;
}

/// Seconds of the next step of an estimate: a period, or less where most of the speed is gained in that, because between two steps the
/// estimate is a straight line and the cells go by it.
double Mesher::step_time(double v, double a, const Bound& bound, double period) {
  constexpr double kMost = 0.5, kPart = 0.125;
  if (v >= bound.speed || !(bound.speed < HUGE_VAL) || !(bound.jerk < HUGE_VAL)) return period;
  if (period * (a + 0.5 * bound.jerk * period) <= kMost * bound.speed) return period;
  return std::min(period, (std::sqrt(a * a + 2 * bound.jerk * kPart * bound.speed) - a) / bound.jerk);
}

/// mm: the way of a step of an estimate.
double Mesher::step_way(double v, double a, double t, const Bound& bound) {
  return t * std::max(v + t * (a / 2 + t * bound.jerk / 6), std::min(kSlowest, kSlowestShare * bound.speed));
}

/// Speeds that can be reached from the start, with the acceleration growing by the jerk from 0 wherever the
/// speed is bounded.
Task<bool> Mesher::forward(Work& work) {
  const MeshRequest& in = *in_;
  forward_.count = 0;
  const unsigned nodes = std::min(kNodes, kNodesPerCell * in.most + kNodesPerCell);
  double u = 0, v = in.from_rest ? 0 : std::sqrt(in.b0), a = in.from_rest ? 0 : 0.5 * in.slope0;
  double edge = -in.from.x;
  for (unsigned p = in.from.piece; p < in.count; ++p) {
    const Bound bound = bound_[p - in.from.piece] = bound_of(in.at(p), p == in.from.piece ? in.from.x : 0);
    co_await work.pause(limits_->axis_count * (in.at(p).curve != nullptr ? kCurveCost : kPieceCost));
    edge = std::min(edge + in.at(p).length, in.reach);
    end_piece_ = p;
    // What comes slows it down, and a straight line from rest to there would be too flat for the cells to grow.
    if (v > bound.speed && in.from_rest && forward_.count == 1 && bound.speed * in.period < kSteep * u) forward_.node[forward_.count++] = {u, v};
    if (v > bound.speed) v = bound.speed, a = 0;
    while (u < edge) {
      if (forward_.count == nodes) break;
      forward_.node[forward_.count++] = {u, v};
      if (forward_.count % kNodesAtOnce == 0) co_await work.pause(kNodesAtOnce * kNodeCost);
      const double t = step_time(v, a, bound, in.period);
      const double du = step_way(v, a, t, bound);
      if (u + du >= edge) {
        const double share = std::max(0.0, (edge - u) / du);
        v = std::min(bound.speed, v + share * t * (a + bound.jerk * t / 2));
        a = v >= bound.speed ? 0 : std::min(bound.acceleration, a + share * bound.jerk * t);
        u = edge;
        break;
      }
      u += du;
      v = std::max(v + t * (a + bound.jerk * t / 2), std::min(kSlowest, bound.speed));
      a = std::min(bound.acceleration, a + bound.jerk * t);
      if (v >= bound.speed) v = bound.speed, a = 0;
    }
    if (forward_.count == nodes || u < edge || !(u < in.reach - kSameReach) || p - in.from.piece == in.most) break;
  }
  end_u_ = u;
  whole_ = u == edge && (end_piece_ + 1 == in.count || !(u < in.reach - kSameReach));
  if (forward_.count < kNodes) forward_.node[forward_.count++] = {u, v};
  co_return true;
}

/// The same from the end back.
Task<bool> Mesher::backward(Work& work, unsigned end_piece, double end) {
  const MeshRequest& in = *in_;
  backward_.count = 0;
  double u = end, v = 0, a = 0, edge = -in.from.x;  // of the last piece, which may reach beyond
  for (unsigned p = in.from.piece; p <= end_piece; ++p) edge += in.at(p).length;
  for (unsigned p = end_piece + 1; p-- > in.from.piece;) {
    const Bound& bound = this->bound(p);
    edge -= in.at(p).length;
    const double stop = std::max(edge, 0.0);
    if (v > bound.speed && backward_.count == 1 && bound.speed * in.period < kSteep * (end - u)) backward_.node[backward_.count++] = {u, v};
    if (v > bound.speed) v = bound.speed, a = 0;
    while (u > stop && backward_.count < kNodes) {
      backward_.node[backward_.count++] = {u, v};
      if (backward_.count % kNodesAtOnce == 0) co_await work.pause(kNodesAtOnce * kNodeCost);
      const double t = step_time(v, a, bound, in.period);
      const double du = step_way(v, a, t, bound);
      if (u - du <= stop) {
        const double share = (u - stop) / du;
        v = std::min(bound.speed, v + share * t * (a + bound.jerk * t / 2));
        a = v >= bound.speed ? 0 : std::min(bound.acceleration, a + share * bound.jerk * t);
        u = stop;
        break;
      }
      u -= du;
      v = v + t * (a + bound.jerk * t / 2);
      a = std::min(bound.acceleration, a + bound.jerk * t);
      if (v >= bound.speed) v = bound.speed, a = 0;
    }
    if (backward_.count == kNodes) break;
  }
  if (backward_.count < kNodes) backward_.node[backward_.count++] = {u, v};
  std::reverse(backward_.node, backward_.node + backward_.count);
  co_return true;
}

double Mesher::speed_at(const Track& track, double u, unsigned* hint) const {
  unsigned& k = *hint;
  while (k + 2 < track.count && track.node[k + 1].u <= u) ++k;
  if (k + 1 >= track.count) return track.node[k].v;
  const Node &a = track.node[k], &b = track.node[k + 1];
  if (u <= a.u) return u < a.u ? HUGE_VAL : a.v;
  if (u >= b.u) return b.v;
  return a.v + (b.v - a.v) * (u - a.u) / (b.u - a.u);
}

double Mesher::estimate(double u) {
  return std::min(speed_at(forward_, u, &hint_f_), speed_at(backward_, u, &hint_b_));
}

/// Length of the cell of constant jerk with which the path starts or ends at rest. It is h, shortened until the speed at its far end is at most the
/// share kLaunchSpeed of the speed that a bend nearby allows there.
double Mesher::slow_enough(double h, const Bound& bound, bool starts) const {
  for (unsigned n = 0; n < kShorterLaunch; ++n) {
    unsigned hint = 0;
    const double speed = 0.5 * bound.jerk * std::pow(6 * h / bound.jerk, 2.0 / 3);
    if (!(speed > kLaunchSpeed * (starts ? speed_at(backward_, h, &hint) : speed_at(forward_, end_u_ - h, &hint)))) break;
    h *= 0.7;
  }
  return h;
}

/// `fine`: a straight line by itself may have shorter cells where its speed changes.
Mesher::Walk Mesher::begin_cells(double end, bool fine) const {
  const MeshRequest& in = *in_;
  const double t = in.period;
  const auto rest_cell = [&](const Bound& bound) {
    const double seconds = std::min({kLaunch * t, std::sqrt(kLaunchSpeed * bound.speed / bound.jerk),
                                     kLaunchSpeed * bound.acceleration / bound.jerk});
    return std::min({(bound.curved ? kCurvedLaunch : 1) * bound.jerk * seconds * seconds * seconds / 6,
                     kShortLaunch * end, bound.cell});
  };
  double last_edge = -in.from.x;
  for (unsigned p = in.from.piece; p < end_piece_; ++p) last_edge += in.at(p).length;
  Walk walk;
  walk.launch = slow_enough(rest_cell(bound(in.from.piece)), bound(in.from.piece), true);
  walk.landing = slow_enough(std::min(rest_cell(bound(end_piece_)), end - std::max(0.0, last_edge)), bound(end_piece_), false);
  walk.edge = in.at(in.from.piece).length - in.from.x;
  walk.at = in.from;
  walk.end = end;
  walk.alone = fine && in.count == 1 && in.from_rest && in.down == nullptr && !bound(in.from.piece).curved;
  return walk;
}

/// The next end of a cell of the law that is followed, not nearer than a part of a cell to the end of the piece or to the landing.
double Mesher::next_joint(double u, double h, Walk* walk) const {
  const MeshRequest& in = *in_;
  const auto end_of = [&](unsigned k) { return in.chain[k].s + in.chain[k].h; };
  while (walk->chain < in.chain_cells && !(end_of(walk->chain) > u + kJointPart * std::min(h, in.chain[walk->chain].h))) ++walk->chain;
  if (walk->chain == in.chain_cells) return HUGE_VAL;
  const double at = end_of(walk->chain), next = std::min(walk->edge, walk->end - walk->landing);
  return at < next - kJointPart * h ? at : HUGE_VAL;
}

/// The control value of a cell with which the search for a stop begins: that of what is followed, or where that is slower of a stop on a line.
double Mesher::stop_guess(double u, double h, const Walk& walk) const {
  const MeshRequest& in = *in_;
  const double left = walk.end - u - 0.5 * h, a = in.stop_a, j = in.stop_j, soft = a * a * a / (6 * j * j);
  const double line = left < soft ? std::pow(0.5 * j, 2) * std::pow(6 * left / j, 4.0 / 3) : std::pow(0.5 * a * a / j, 2) + 2 * a * (left - soft);
  if (walk.chain == in.chain_cells) return line;
  const FollowedCell& c = in.chain[walk.chain];
  const double control = c.control(u - c.s, h);
  return control > 0 ? std::min(control, line) : line;
}

/// Walks along and sets a knot at every joint of pieces and about every `period` seconds. Goes on for `count` cells.
void Mesher::cells(Walk* walk, unsigned count) {
  const MeshRequest& in = *in_;
  Mesh& m = *mesh_;
  double t = in.period;
  const double end = walk->end, launch = walk->launch, landing = walk->landing, stop = end - landing;
  const bool alone = walk->alone;
  double u = walk->u, edge = walk->edge;
  PathPlace at = walk->at;
  const unsigned last = std::min(in.most, m.cells + count);
  while (u < end && m.cells < last && !walk->ended) {
    const unsigned f = hint_f_, b = hint_b_;
    double h = launch;
    if (in.chain != nullptr) t = in.period * std::min(kStopFiner, kFirstFiner * (1 + m.cells / kFirstFine));
    if (m.cells > 0 || !in.from_rest) {
      const double ahead = t * estimate(u);
      h = t * estimate(std::min(u + 0.5 * ahead, 0.5 * (u + end)));
      hint_f_ = f;
      hint_b_ = b;
      const double v0 = estimate(u), v1 = estimate(std::min(u + h, end - 0.5 * landing)),
                   ratio = v1 > v0 ? v1 / v0 : v0 / v1;
      const double most = alone ? kRatioAlone : kRatio;
      if (ratio > most) h *= std::max(alone ? 0.1 : 0.3, std::log(most) / std::log(ratio));
      hint_f_ = f;
      hint_b_ = b;
    }
    h = std::min(h, bound(at.piece).cell);
    walk->edge = edge;
    const bool lands = u >= stop - kRounding * end;
    const double limit = lands ? end : std::min({edge, stop, next_joint(u, h, walk)});
    if (lands || u + 1.5 * h >= limit) {
      h = limit - u;
    } else if (u + 2 * h > limit) {
      h = 0.5 * (limit - u);
    }
    if (m.cells == 0 && in.from_rest && h > 4 * launch) h = launch;
    const double given = m.cells < in.first_cells ? in.first_h[m.cells] : HUGE_VAL;
    if (u + given <= limit + kRounding * end) {
      h = limit - u < given + kSameReach ? limit - u : given;
    } else if (m.cells == 0 && !in.from_rest && in.slope0 < 0) {
      h = std::min(h, -kBraking * in.b0 / in.slope0);  // the control value of the first cell, b0 + b0' h / 2, stays above 0
    }
    const double middle = estimate(u + 0.5 * h);
    least_s_ += h / std::max(middle, kSlowest);
    // A start at speed is given: from there the guess goes down gently.
    const double away = in.from_rest ? 1 : std::min(1.0, m.cells / kGentle);
    const double share = 1 - (1 - in.guess) * away * away * (3 - 2 * away);
    place_[m.cells] = at;
    m.h[m.cells] = h;
    const double use = in.chain != nullptr || (!in.from_rest && m.cells < 3) ? kAtStart : 1;
    m.use[m.cells] = use * jerk_share(in.at(at.piece), *limits_);
    m.use_a[m.cells] = use * acceleration_share(in.at(at.piece), *limits_);
    m.guess[m.cells] = std::max(share * share * middle * middle, 1e-8);
    if (in.chain != nullptr) m.guess[m.cells] = std::max(1e-8, stop_guess(u, h, *walk));
    if (in.down != nullptr) m.guess[m.cells] = std::max(m.guess[m.cells], 0.9 * in.down->at(u + 0.5 * h));
    ++m.cells;
    const bool ends_piece = u + h >= edge - kRounding * end;
    if (ends_piece && at.piece + 1 < in.count && u + h < end) {
      u = edge;
      ++at.piece;
      at.x = 0;
      edge += in.at(at.piece).length;
    } else {
      u += h;
      at.x = ends_piece ? in.at(at.piece).length : at.x + h;
    }
    walk->ended = end - u < kRounding * end;
  }
  walk->u = u;
  walk->edge = edge;
  walk->at = at;
  walk->ended = walk->ended || !(u < end) || m.cells >= in.most;
}

/// @return whether they come to the end
Task<bool> Mesher::cells(Work& work, double end, bool fine) {
  mesh_->cells = 0;
  least_s_ = 0;
  hint_f_ = hint_b_ = 0;
  Walk walk = begin_cells(end, fine);
  while (!walk.ended) {
    const unsigned before = mesh_->cells;
    cells(&walk, kCellsAtOnce);
    co_await work.pause((mesh_->cells - before) * kCellCost);
  }
  place_[mesh_->cells] = walk.at;
  co_return end - walk.u < kRounding* end;
}

/// The largest b at a place of a piece.
double Mesher::cap_of(const Piece& p, const CurvePoint& q, double u) const {
  const unsigned axes = limits_->axis_count;
  double length2 = 0, axes_most = HUGE_VAL, v = feed_of(p, *limits_);
  for (unsigned i = 0; i < axes; ++i) {
    if ((limits_->linear >> i & 1) != 0) length2 += q.d1[i] * q.d1[i];
    const double axis = velocity_of(p, *limits_, i);
    if (axis > 0 && axes_most * std::fabs(q.d1[i]) > axis) axes_most = axis / std::fabs(q.d1[i]);
  }
  bool bends = p.curve != nullptr;
  for (unsigned i = 0; i < axes; ++i) bends = bends || q.d2[i] != 0 || q.d3[i] != 0;
  const double use = bends ? kFeed : 1;
  if (use * use * length2 > 1 && v < HUGE_VAL) v /= use * std::sqrt(length2);
  if (in_->down != nullptr) v = std::max(v, std::sqrt(in_->down->at(u)));
  v = std::min(v, axes_most);
  return use * use * v * v;
}

/// Knot k at u, and the inside of cell k. `q`: the path at the end of the cell before, from inside, and then at that of this one.
void Mesher::fill_knot(unsigned k, double u, CurvePoint* q) {
  const MeshRequest& in = *in_;
  Mesh& m = *mesh_;
  const unsigned axes = limits_->axis_count;
  Knot& knot = m.knot[k];
  knot.cap = HUGE_VAL;
  if (k > 0) {
    knot.left3 = knot.right3 = q->d3;
    knot.cap = cap_of(in.at(place_[k - 1].piece), *q, u);
    m.cap[k - 1] = std::min(m.cap[k - 1], knot.cap);
  }
  const bool cell = k < m.cells;
  if (cell && (k == 0 || place_[k].piece != place_[k - 1].piece)) derivatives(in.at(place_[k].piece), place_[k].x, axes, q);
  knot.d1 = q->d1;
  knot.d2 = q->d2;
  if (!cell) return;
  const Piece& p = in.at(place_[k].piece);
  knot.right3 = q->d3;
  m.cap[k] = cap_of(p, *q, u);
  knot.cap = std::min(knot.cap, m.cap[k]);
  const double h = m.h[k];
  derivatives(p, std::min(p.length, place_[k].x + h), axes, q);
  Inside& inside = m.inside[k];
  double length2 = 0;
  inside.d2_start = knot.d2;
  inside.d2_end = q->d2;
  for (unsigned i = 0; i < axes; ++i) {
    inside.d1[i] = knot.d1[i] + 0.5 * h * knot.d2[i];
    inside.d3[i] = (q->d2[i] - knot.d2[i]) / h;
    const double middle = 0.25 * (knot.d1[i] + 2 * inside.d1[i] + q->d1[i]);  // of a cubic
    if ((limits_->linear >> i & 1) != 0) length2 += middle * middle;
  }
  const double feed = feed_of(p, *limits_);
  if (kFeed * kFeed * length2 > 1 && feed < HUGE_VAL && in.down == nullptr)
    m.cap[k] = std::min(m.cap[k], feed * feed / length2);
}

Task<bool> Mesher::fill_knots(Work& work) {
  const Mesh& m = *mesh_;
  double u = 0;
  CurvePoint q;
  for (unsigned k = 0; k <= m.cells;) {
    int64_t cost = 0;
    for (const unsigned to = std::min(m.cells + 1, k + kKnotsAtOnce); k < to; ++k) {
      fill_knot(k, u, &q);
      if (k < m.cells) u += m.h[k];
      cost += in_->at(place_[k].piece).curve != nullptr ? kCurveCost : kPieceCost;
    }
    co_await work.pause(limits_->axis_count * cost);
  }
  co_return true;
}

/// The speed can be the cap all along the cell, with something left to reach it.
bool Mesher::can_be_level(unsigned k) const {
  const Mesh& m = *mesh_;
  const Piece& p = in_->at(place_[k].piece);
  const Knot &left = m.knot[k], &right = m.knot[k + 1];
  const double cap = m.cap[k];
  if (p.quintic || (p.curve != nullptr && !p.curve->circular)) return false;
  if (std::fabs(left.cap - cap) > kSameCap * cap || std::fabs(right.cap - cap) > kSameCap * cap) return false;
  const double v3 = cap * std::sqrt(cap);
  for (unsigned i = 0; i < limits_->axis_count; ++i) {
    const double d2 = std::max(std::fabs(left.d2[i]), std::fabs(right.d2[i])), d3 = std::max(std::fabs(left.right3[i]), std::fabs(right.left3[i]));
    if (d2 * cap > kLevelUse * acceleration_share(p, *limits_) * limits_->acceleration[i] || d3 * v3 > kLevelUse * jerk_share(p, *limits_) * limits_->jerk[i]) return false;
  }
  return true;
}

/// Cells [from, to) can be gone at one speed: those are that are so far from both ends that it is reached from rest with a part of the limits.
void Mesher::level_between(unsigned from, unsigned to) {
  Mesh& m = *mesh_;
  const Piece& p = in_->at(place_[from].piece);  // threads and other moves have a rest between them
  const double use_a = kRampUse * acceleration_share(p, *limits_), use_j = kRampUse * jerk_share(p, *limits_);
  double a = HUGE_VAL, j = HUGE_VAL;
  for (unsigned k = from; k <= to; ++k)
    for (unsigned i = 0; i < limits_->axis_count; ++i) {
      const double d = std::fabs(m.knot[k].d1[i]), acceleration = use_a * limits_->acceleration[i], jerk = use_j * limits_->jerk[i];
      if (a * d > acceleration) a = acceleration / d;
      if (j * d > jerk) j = jerk / d;
    }
  const double v = std::sqrt(m.cap[from]), ramp = 0.5 * v * (v > a * a / j ? v / a + a / j : 2 * std::sqrt(v / j));
  const bool goes_on = from == 0 && !in_->from_rest && std::fabs(in_->b0 - m.cap[0]) <= kSameCap * m.cap[0] &&
                       std::fabs(in_->slope0) * m.h[0] <= kSameCap * m.cap[0];
  double way = goes_on ? ramp : 0;
  while (from < to && way < ramp) way += m.h[from++];
  for (way = 0; from < to && way < ramp;) way += m.h[--to];
  if (to < from + kFewestLevel) return;
  for (unsigned k = from; k < to; ++k) m.level[k] = true;
  m.levels += to - from;
  // The guess goes gently to it from both sides.
  const auto near = [&](unsigned k, unsigned apart) {
    const double away = apart / kGentleLevel;
    m.guess[k] += (m.cap[k] - m.guess[k]) * (1 - away) * (1 - away) * (1 + 2 * away);
  };
  for (unsigned n = 1; n < kGentleLevel && n <= from; ++n) near(from - n, n);
  for (unsigned n = 1; n < kGentleLevel && to + n <= m.cells; ++n) near(to + n - 1, n);
}

Task<bool> Mesher::find_levels(Work& work) {
  Mesh& m = *mesh_;
  m.levels = 0;
  std::fill(m.level, m.level + m.cells, false);
  std::fill(m.kept, m.kept + m.cells, false);
  if (in_->down != nullptr) co_return true;
  unsigned from = 0;
  for (unsigned k = 0; k <= m.cells; ++k) {
    if (k % kCellsAtOnce == 0) co_await work.pause(kCellsAtOnce * kLevelCost * limits_->axis_count);
    if (k < m.cells && can_be_level(k) && (k == from || std::fabs(m.cap[k] - m.cap[from]) <= kSameCap * m.cap[k])) continue;
    if (k > from + kFewestLevel) level_between(from, k);
    from = k + 1;
  }
  co_return true;
}

Task<PathPlace> Mesher::build(Work& work, const MeshRequest& request, const Limits& limits, Mesh* mesh) {
  in_ = &request;
  limits_ = &limits;
  mesh_ = mesh;
  mesh->from_rest = request.from_rest;
  mesh->b0 = request.b0;
  mesh->slope0 = request.slope0;
  mesh->stops = request.chain != nullptr;
  mesh->levels = 0;
  co_await forward(work);
  for (unsigned n = 0;; ++n) {
    co_await backward(work, end_piece_, end_u_);
    const bool all = co_await cells(work, end_u_, n == 0);
    if (all) break;
    if (n == kShorter || mesh->cells < 4) {  // no law has so few cells
      mesh->cells = 0;
      co_return request.from;
    }
    // Too long for one window: it ends, at rest, some way before the place where the cells have run out.
    const unsigned k = mesh->cells - mesh->cells / kShare - 1;
    const PathPlace& at = place_[k];
    end_u_ = -request.from.x + at.x;
    for (unsigned p = request.from.piece; p < at.piece; ++p) end_u_ += request.at(p).length;
    if (!(end_u_ > 0)) {
      mesh->cells = 0;
      co_return request.from;
    }
    end_piece_ = at.piece;
    if (at.x <= 0) --end_piece_;  // there is a piece before, as the window is longer than nothing
    whole_ = false;
  }
  co_await fill_knots(work);
  co_await find_levels(work);
  co_return place_[mesh->cells];
}

}  // namespace nc::optimal
