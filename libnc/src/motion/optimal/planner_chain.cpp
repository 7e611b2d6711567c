// SPDX-License-Identifier: Apache-2.0
// Places of the chain of cells that the scan follows: where a law may begin, how far ahead of the scan that is, and how long the chain lasts behind it.
#include "motion/optimal/optimal_planner.hpp"

namespace nc::optimal {
namespace {

constexpr double kLeastPart = 0.25;  ///< of a cycle, that either part of a cell takes at least that is cut in two

}  // namespace

OptimalPlanner::Start OptimalPlanner::at_end() const {
  Start s;
  if (fresh_) {
    s.fresh = true;
    s.piece = fresh_piece_;
    s.x = fresh_x_;
    s.u = fresh_piece_ != builder_.head() ? builder_.start_of(fresh_piece_) + fresh_x_ : 0;
    return s;
  }
  s.after = chain_.last;
  s.piece = chain_.piece;
  s.x = chain_.x;
  s.u = chain_.u;
  return s;
}

/// The state behind a cell of the chain.
OptimalPlanner::Start OptimalPlanner::behind(CellIndex cell) const {
  if (cell == chain_.last) return at_end();
  const PlanCell& next = store_.at(chain_next_[cell & store_.cell_mask]);
  Start s;
  s.after = cell;
  s.piece = next.piece;
  s.x = next.x;
  s.u = next.u;
  s.from_rest = next.kind == PlanCell::Kind::launch;
  s.v = s.from_rest ? 0 : next.v;
  s.a = next.a;
  return s;
}

/// Seconds until the scan leaves the cell of the chain; 0 when it has.
double OptimalPlanner::ahead(const Following& f, CellIndex cell) const {
  if (f.cell == kNoCell || cell < f.cell) return 0;
  const double time = f.at_end ? 0 : store_.at(f.cell).seconds - f.t;
  return time + chain_end_[cell & store_.cell_mask] - chain_end_[f.cell & store_.cell_mask];
}

/// Seconds from the start of the chain to the scan.
double OptimalPlanner::scan_at() const {
  if (fresh_ || now_.cell == kNoCell) return 0;
  return chain_end_[now_.cell & store_.cell_mask] - (now_.at_end ? 0 : store_.at(now_.cell).seconds - now_.t);
}

/// The first place at least `lead` seconds ahead where a law may begin, or the next rest. False when that is the end of the chain.
bool OptimalPlanner::find_ahead(const Following& f, double lead, Start* start) const {
  if (!moving(f)) return false;
  CellIndex k = f.cell;
  double time = f.at_end ? 0 : store_.at(k).seconds - f.t;
  while (k != chain_.last) {
    const bool rests = store_.at(k).kind == PlanCell::Kind::land;
    if (time >= lead || (rests && (time > 0 || f.at_end))) {
      *start = behind(k);
      return true;
    }
    k = chain_next_[k & store_.cell_mask];
    time += store_.at(k).seconds;
  }
  return false;
}

/// The place `lead` seconds ahead, in the midst of a cell or, where that is as good as one, at its end; or the next rest, as above.
bool OptimalPlanner::find_amid(const Following& f, double lead, Start* start) const {
  if (!find_ahead(f, lead, start)) return false;
  if (start->from_rest || start->after == chain_.last) return true;
  const CellIndex k = start->after;
  const PlanCell& c = store_.at(k);
  const double cut = c.seconds - (ahead(f, k) - lead), least = kLeastPart * setup_.cycle_s;
  CellIndex before = kNoCell;
  for (CellIndex n = f.cell; n != k; n = chain_next_[n & store_.cell_mask]) before = n;
  if (cut < least && before != kNoCell) {
    const Start sooner = behind(before);
    if (!sooner.from_rest) *start = sooner;
    return true;
  }
  if (!can_be_cut(c) || !(cut > least) || !(cut < c.seconds - least)) return true;
  const CellState q = state_in(c, cut);
  if (!(q.v > 0) || !(q.x > 0) || !(q.x < c.h)) return true;
  start->cut = cut;
  start->before = before;
  start->piece = c.piece;
  start->x = c.x + q.x;
  start->u = c.u + q.x;
  start->v = q.v;
  start->a = q.a;
  return true;
}

/// Writes the part of a cell of the chain that is gone before a law that begins amid it.
void OptimalPlanner::cut_cell(const Start& start) {
  PlanCell& c = store_.cell[write_ & store_.cell_mask];
  c = store_.at(start.after);
  c.seconds = start.cut;
  c.h = start.x - c.x;
  chain_next_[write_ & store_.cell_mask] = write_ + 1;
  chain_end_[write_ & store_.cell_mask] = begins_at(start);
  ++write_;
}

/// Seconds from the start of the chain to a place of it.
double OptimalPlanner::begins_at(const Start& start) const {
  if (start.fresh) return 0;
  return chain_end_[start.after & store_.cell_mask] - (start.cut > 0 ? store_.at(start.after).seconds - start.cut : 0);
}

/// Seconds from a place that is passed at speed to the next rest of the chain.
double OptimalPlanner::rests_in(const Start& start) const {
  CellIndex k = start.after;
  while (k != chain_.last && store_.at(k).kind != PlanCell::Kind::land) k = chain_next_[k & store_.cell_mask];
  return chain_end_[k & store_.cell_mask] - begins_at(start);
}

/// The cell of the chain that lies `count` cells before another one, not before the one in execution.
CellIndex OptimalPlanner::before(const Following& f, CellIndex cell, unsigned count) const {
  unsigned between = 0;
  for (CellIndex k = f.cell; k != cell && k != chain_.last; k = chain_next_[k & store_.cell_mask]) ++between;
  CellIndex k = f.cell;
  for (; between > count; --between) k = chain_next_[k & store_.cell_mask];
  return k;
}

}  // namespace nc::optimal
