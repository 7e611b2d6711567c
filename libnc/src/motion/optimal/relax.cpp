// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/relax.hpp"

#include "motion/optimal/smoother.hpp"

namespace nc::optimal {
namespace {

constexpr unsigned kRounds = 2;  ///< rounds of the whole; the second one has the speeds of the first
constexpr unsigned kSteps = 15;  ///< steps of a fit
constexpr unsigned kMoreSteps = 10;  ///< steps of a fit whose places have been told to come nearer to the line
constexpr unsigned kTrials = 12;  ///< trials that are made until all cells are near enough
constexpr double kWorthwhile = 0.97;  ///< of the time of a run: less is not worth a path that uses more of the limits, since a hold stops later on it
constexpr double kAtFeed = 1.03;  ///< times the time at the feed: a run that is gone in less has nothing to gain
/// What a fit makes smaller shows soon whether it is worth it: after the first step and after some more the sum has to be below so many times what it was, the
/// second where cells were halved. Of 16,500 fits that were worth it four were not below.
constexpr unsigned kSome = 4;
constexpr double kAfterFirst[] = {0.9, 0.98}, kAfterSome[] = {0.9, 0.95};
constexpr double kWithin = 0.96;  ///< a fit keeps its places within this part of the tolerance ...
constexpr double kTighter = 0.93;  ///< ... and within this part of that in each further trial
constexpr double kBetween = 0.1;      ///< of the tolerance: a cell that bends by more between two places has twice as many
constexpr unsigned kVertices = 8;     ///< of a cell that a fit looks at, at most; the look at its distance is at all of them
constexpr unsigned kFewest = 8;  ///< a fit is worth it for at least so many control points
constexpr unsigned kCellsAtOnce = 8;  ///< cells that are looked at before others may have their turn
constexpr unsigned kPlacesAtOnce = 64;
// Instructions: to add a place; for each axis, to pass a place, to solve for a control point, to make a piece, and to measure the distance of a cell; of a run.
constexpr int64_t kAddCost = 400, kPassCost = 30, kSolveCost = 40, kPieceCost = 120, kLookCost = 400, kRunCost = 500;

}  // namespace

/// A control point that may be moved: not where the cells make the shape of a sharp corner, on a straight line that is long, nor where the
/// feed changes, for the reason that it is not fitted there.
bool Smoother::moves(unsigned j) const {
  if (j < 3 || j >= last_) return false;
  const SmoothCell* const cell = room_.cell + (j - 3);
  for (unsigned k = j - 3; k <= j; ++k)
    if (in_turn(k)) return false;
  const bool straight = cell[0].first_edge == cell[3].last_edge;
  if (straight && room_.knot[j + 1] - room_.knot[j - 3] > kLongEdge * spacing_of(in_, room_, cell[0].first_edge)) return false;
  const double least = std::min({cell[0].least_feed, cell[1].least_feed, cell[2].least_feed, cell[3].least_feed});
  return std::max({cell[0].most_feed, cell[1].most_feed, cell[2].most_feed, cell[3].most_feed}) <= kOtherFeed * least;
}

/// What a cell's four control points make of its third derivative, by the differences that pieces() takes.
void Smoother::third(unsigned cell, double* out) const {
  const int k = static_cast<int>(cell);
  const double h = t(k + 1) - t(k), g0 = 2 / ((t(k + 1) - t(k - 1)) * h), g1 = 2 / ((t(k + 2) - t(k)) * h);
  const double w1 = 3 / (t(k + 1) - t(k - 2)), w2 = 3 / (t(k + 2) - t(k - 1)), w3 = 3 / (t(k + 3) - t(k));
  out[0] = -g0 * w1;
  out[1] = g0 * w1 + (g0 + g1) * w2;
  out[2] = -(g0 + g1) * w2 - g1 * w3;
  out[3] = g1 * w3;
}

/// And of its position at x, by de Boor's recursion.
void Smoother::basis(unsigned cell, double x, double* out) const {
  const int k = static_cast<int>(cell);
  const double u = room_.knot[cell] + x;
  out[0] = 1;
  for (int degree = 1; degree <= 3; ++degree) {
    double from_left = 0;
    for (int n = 0; n < degree; ++n) {
      const double a = t(k + 1 + n - degree), b = t(k + 1 + n), share = out[n] / (b - a);
      out[n] = from_left + (b - u) * share;
      from_left = (u - a) * share;
    }
    out[degree] = from_left;
  }
}

/// The places of a cell that shall be near the line.
bool Smoother::add_cell(unsigned k, Relaxation* room) const {
  const double from = room_.knot[k], h = room_.knot[k + 1] - from, radius = kWithin * in_.tolerance;
  const Piece& p = out_[k];
  double bend2 = 0;
  for (unsigned i = 0; i < in_.axis_count; ++i) {
    const double bend = 2 * std::max(std::fabs(p.c[2][i]), std::fabs(p.c[2][i] + 3 * h * p.c[3][i]));
    bend2 += bend * bend;
  }
  const bool bent = h / kLooks * h / kLooks / 8 * std::sqrt(bend2) > kBetween * in_.tolerance;
  const unsigned looks = bent ? 2 * kLooks : kLooks;
  unsigned edge = room_.cell[k].first_edge;
  double values[4];
  bool room_left = true;
  for (unsigned n = 1; n <= looks; ++n) {
    const double x = n == looks ? h : h * n / looks;
    basis(k, x, values);
    room_left = room->fit.add_place(k, values, on_line(from + x, &edge), radius);
  }
  const unsigned first = room_.cell[k].first_edge, last = room_.cell[k].last_edge;
  for (unsigned e = first; e <= last; e += 1 + (last - first) / kVertices) {
    if (!(room_.u[e] > from) || !(room_.u[e] < from + h)) continue;
    basis(k, room_.u[e] - from, values);
    room_left = room->fit.add_place(k, values, in_.line.vertex[e], radius);
  }
  return room_left;
}

/// The speed goes with the cubic root of the third derivative. With v^3 its square is that of the jerk at a speed v of the path, with the time that
/// the cell takes, and less weight of the fastest cells than by v^5.
double Smoother::bend_weight(const Relaxation& room, unsigned cell) const {
  const double speed = room.speed[cell].speed;
  return (room_.knot[cell + 1] - room_.knot[cell]) * speed * speed * speed;
}

/// The fit of control points from `from` on: as many, up to `to`, as there is room for. @return how many
Task<unsigned> Smoother::begin_fit(Work& work, Relaxation* room, unsigned from, unsigned to) const {
  unsigned end = from - 3;
  for (unsigned places = 0; end < to; ++end) {
    places += 2 * kLooks + 1 + std::min(kVertices, room_.cell[end].last_edge - room_.cell[end].first_edge);
    if (places > TubeFit::kPlaces) break;
  }
  if (end < from + kFewest && end < to) co_return 0;
  TubeFit& fit = room->fit;
  fit.begin(from, end - from, in_.axis_count);
  for (unsigned k = from - 3; k < end; ++k) {
    double row[4];
    third(k, row);
    fit.add_third(k, row, bend_weight(*room, k), room_.control);
    add_cell(k, room);
    co_await work.pause(kAddCost * (2 * kLooks + kVertices));
  }
  const bool solvable = fit.prepare(room_.control);
  co_await work.pause(kAddCost * fit.places());
  co_return solvable ? end - from : 0;
}

/// Cells [from, to) as their control points are now.
Task<bool> Smoother::pieces_again(Work& work, unsigned from, unsigned to) {
  unsigned edge = room_.cell[from].first_edge;
  for (unsigned k = from; k < to; k += kCellsAtOnce) {
    pieces(k, std::min(k + kCellsAtOnce, to), &edge);
    co_await work.pause(kCellsAtOnce * in_.axis_count * kPieceCost);
  }
  co_return true;
}

/// Cells that are too far from the line shall come nearer. True: there are none.
Task<bool> Smoother::tightened(Work& work, Relaxation* room, unsigned from, unsigned to) {
  bool near = true;
  unsigned vertex = 1, place = 0, edge = room_.cell[from].first_edge;
  for (unsigned k = from; k < to; ++k) {
    const double most = (in_.from != nullptr && k < kStartCells ? kUseStart : kUseMost) * in_.tolerance;
    if (far(k, most * most, &vertex, &edge)) {
      near = false;
      room->fit.tighten(k, kTighter, &place);
    }
    co_await work.pause(in_.axis_count * kLookCost);
  }
  co_return near;
}

/// What a fit of control points [from, from + count) makes as small as it can.
double Smoother::bending(const Relaxation& room, unsigned from, unsigned count) const {
  double sum = 0;
  for (unsigned k = from - 3; k < from + count; ++k) {
    double row[4], square = 0;
    third(k, row);
    for (unsigned i = 0; i < in_.axis_count; ++i) {
      double bend = 0;
      for (unsigned n = 0; n < 4; ++n) bend += row[n] * room_.control[k + n][i];
      square += bend * bend;
    }
    sum += bend_weight(room, k) * square;
  }
  return sum;
}

/// The steps of a fit. False where it is not worth it: then it has been broken off.
Task<bool> Smoother::fit_steps(Work& work, Relaxation* room, unsigned steps, bool look, unsigned from, unsigned count) {
  const double before = look ? bending(*room, from, count) : 0;
  bool halved = false;
  for (unsigned k = from; k < from + count; ++k) halved = halved || (room_.cell[k].halved & kTimes) > 0;
  for (unsigned step = 1; step <= steps; ++step) {
    room->fit.begin_step();
    for (unsigned m = 0; m < room->fit.places(); m += kPlacesAtOnce) {
      room->fit.pass(m, m + kPlacesAtOnce, room_.control);
      co_await work.pause(kPlacesAtOnce * in_.axis_count * kPassCost);
    }
    room->fit.solve(room_.control);
    co_await work.pause(count * in_.axis_count * kSolveCost);
    if (!look || (step != 1 && step != kSome)) continue;
    if (!(bending(*room, from, count) < (step == 1 ? kAfterFirst : kAfterSome)[halved] * before)) co_return false;
  }
  co_return true;
}

/// Control points from `from` on, which may all be moved. Where they end in no tube, or hardly faster, they stay. @return how many of them this was about
Task<unsigned> Smoother::relax_run(Work& work, Relaxation* room, const Relaxing& how, bool first, unsigned from, unsigned to) {
  const unsigned count = co_await begin_fit(work, room, from, to);
  if (count == 0) co_return 0;
  AxisVec* const control = room_.control;
  const double before = co_await path_speeds(work, out_ + from - 3, count + 3, *how.limits, how.turns, room->of_run);
  std::copy(control + from, control + from + count, room->kept);
  for (unsigned trial = 0; trial < kTrials; ++trial) {
    const bool worth = co_await fit_steps(work, room, trial == 0 ? kSteps : kMoreSteps, first && trial == 0, from, count);
    if (!worth) break;
    co_await pieces_again(work, from - 3, from + count);
    const double now = co_await path_speeds(work, out_ + from - 3, count + 3, *how.limits, how.turns, room->of_run);
    if (!(now < before)) break;  // nearer to the line it would hardly be faster
    const bool near = co_await tightened(work, room, from - 3, from + count);
    if (!near) continue;
    if (now < (first ? kWorthwhile : 1) * before) co_return count;
    break;
  }
  room_.cell[from].stays = true;
  std::copy(room->kept, room->kept + count, control + from);
  co_await pieces_again(work, from - 3, from + count);
  co_return count;
}

/// Control points [from, to) make cells that are gone more slowly than at their feed.
bool Smoother::below_feed(const Relaxation& room, double turns, unsigned from, unsigned to) const {
  double seconds = 0, at_feed = 0;
  for (unsigned k = from - 3; k < to; ++k) {
    seconds += out_[k].length / room.speed[k].speed;
    at_feed += out_[k].length / (turns * out_[k].feed);
  }
  return seconds > kAtFeed * at_feed;
}

/// Every run of control points that may be moved and is worth it. @return some have been moved
Task<bool> Smoother::relax_once(Work& work, Relaxation* room, const Relaxing& how, bool first, unsigned to) {
  bool any = false;
  for (unsigned j = 3; j < to;) {
    unsigned end = j;
    while (end < to && end - j < TubeFit::kControls && moves(end)) ++end;
    unsigned count = 0;
    if (end > j && (first ? below_feed(*room, how.turns, j, end) : !room_.cell[j].stays)) count = co_await relax_run(work, room, how, first, j, end);
    if (count == 0) room_.cell[j].stays = true;
    any = any || !room_.cell[j].stays;
    j = count > 0 ? j + count : std::max(end, j + 1);
    co_await work.pause(kRunCost);
  }
  co_return any;
}

Task<bool> Smoother::relax(Work& work, Relaxation* room, const Relaxing& how, unsigned cells, unsigned to) {
  last_ = cells;
  for (unsigned k = 0; k < to; ++k) room_.cell[k].stays = false;
  const double* const feed = in_.line.feed;
  for (unsigned k = 0; k + 1 < in_.line.count && feed != nullptr; ++k) one_feed_ = one_feed_ && feed[k] == feed[0];
  double best = co_await path_speeds(work, out_, to, *how.limits, how.turns, room->speed);
  bool changed = false;
  for (unsigned round = 0; round < kRounds; ++round) {
    std::copy(room_.control, room_.control + cells + 3, room->before);
    const bool any = co_await relax_once(work, room, how, round == 0, to);
    if (!any) break;
    const double seconds = co_await path_speeds(work, out_, to, *how.limits, how.turns, room->speed);
    if (!(seconds < best)) {
      std::copy(room->before, room->before + cells + 3, room_.control);
      co_await pieces_again(work, 0, to);
      break;
    }
    best = seconds;
    changed = true;
  }
  co_return changed;
}

Task<bool> relax(Work& work, const SmoothRequest& request, const SmoothRoom& room, Relaxation* relaxation, Relaxing how, Piece* out,
                 unsigned cells, unsigned to) {
  Smoother smoother(request, room, out, cells);
  const bool changed = co_await smoother.relax(work, relaxation, how, cells, to);
  co_return changed;
}

}  // namespace nc::optimal
