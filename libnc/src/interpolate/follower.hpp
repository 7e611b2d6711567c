// SPDX-License-Identifier: Apache-2.0
// The scan's side of the optimal mode: goes along the chain of cells in time. It has no law of its own: what it follows always ends at
// rest, and where the chain goes on is changed only in front of it (docs/motion-optimal.md, "Changing the plan on the way").
#pragma once

#include "interpolate/exchange.hpp"
#include "motion/optimal/plan_cell.hpp"

namespace nc {

class Follower {
 public:
  void create(optimal::PlanStore* store, unsigned axis_count) {
    store_ = store;
    axis_count_ = axis_count;
  }

  /// Looks at the newest offer, once.
  void look(const optimal::Proposal& offer) NC_RT {
    if (offer.number == answered_) return;
    answered_ = offer.number;
    if (offer.fresh && offer.first == optimal::kNoCell && offer.generation == generation_ && at_rest()) {  // void
      cell_ = optimal::kNoCell;
      at_end_ = true;
      begins_ = false;
    }
    taken_ = offer.first != optimal::kNoCell && offer.generation == generation_ && fits(offer);
    if (!taken_) return;
    for (uint32_t k = offer.first; k != offer.last; ++k) next(k) = k + 1;
    next(offer.last) = optimal::kNoCell;
    if (offer.fresh) {
      cell_ = offer.first;
      t_ = 0;
      begins_ = true;
      at_end_ = false;
      u_ = store_->at(cell_).u;
    } else {
      next(offer.after) = offer.first;
    }
  }

  /// At rest, and nothing is left to follow.
  bool idle() const { return cell_ == optimal::kNoCell || (at_end_ && store_->next[cell_ & store_->cell_mask] == optimal::kNoCell); }
  bool at_rest() const { return at_end_ || begins_; }
  /// The path, not the plan alone, rests here.
  bool at_path_end() const { return at_end_ && cell_ != optimal::kNoCell && store_->at(cell_).path_ends; }
  uint32_t generation() const { return generation_; }
  double u() const { return u_; }
  double v() const { return v_; }

  /// Where the next cell begins; not when idle().
  AxisVec start() const NC_RT {
    const optimal::PlanCell& c = store_->at(at_end_ ? store_->next[cell_ & store_->cell_mask] : cell_);
    return point(c, 0);
  }

  /// Goes on for `time` seconds or to the next rest. @return what is left of the time.
  double advance(double time) NC_RT {
    if (idle() || !(time > 0)) return time;
    if (at_end_) {
      cell_ = next(cell_);
      t_ = 0;
      at_end_ = false;
    }
    begins_ = false;
    for (;;) {
      const optimal::PlanCell& c = store_->at(cell_);
      const double left = c.seconds - t_;
      if (time < left) {
        t_ += time;
        const optimal::CellState q = optimal::state_in(c, t_);
        x_ = std::fmin(c.h, std::fmax(0, q.x));
        u_ = c.u + x_;
        v_ = q.v;
        return 0;
      }
      time -= left;
      if (c.kind == optimal::PlanCell::Kind::land) {
        t_ = c.seconds;
        x_ = c.h;
        u_ = c.u + c.h;
        v_ = 0;
        at_end_ = true;
        return time;
      }
      cell_ = next(cell_);
      t_ = 0;
    }
  }
  AxisVec position() const NC_RT { return point(store_->at(cell_), x_); }

  /// Everything that is planned is void: only a plan made for what comes then is followed.
  void give_up() NC_RT {
    if (store_ == nullptr) return;
    ++generation_;
    cell_ = optimal::kNoCell;
    at_end_ = true;
    begins_ = false;
    v_ = 0;
  }
  void say(optimal::Following* out) const NC_RT {
    out->answered = answered_;
    out->taken = taken_;
    out->generation = generation_;
    out->cell = cell_;
    out->t = t_;
    out->at_end = at_end_;
  }

 private:
  uint32_t& next(uint32_t k) { return store_->next[k & store_->cell_mask]; }
  bool fits(const optimal::Proposal& offer) const NC_RT {
    if (offer.fresh) return at_rest();
    if (cell_ == optimal::kNoCell || static_cast<int32_t>(offer.after - cell_) < 0) return false;
    // Behind the end of a plan that rests there, or behind a cell that has not been left.
    return true;
  }
  AxisVec point(const optimal::PlanCell& c, double x) const NC_RT {
    const optimal::Piece& p = store_->piece_at(c.piece);
    const double at = std::fmin(p.length, c.x + x);
    if (p.curve != nullptr) return curve_position(*p.curve, p.curve_from + at, axis_count_);
    AxisVec q;
    if (!p.quintic) {
      for (unsigned i = 0; i < axis_count_; ++i) q[i] = p.c[0][i] + at * (p.c[1][i] + at * (p.c[2][i] + at * p.c[3][i]));
      return q;
    }
    for (unsigned i = 0; i < axis_count_; ++i)
      q[i] = p.c[0][i] + at * (p.c[1][i] + at * (p.c[2][i] + at * (p.c[3][i] + at * (p.c[4][i] + at * p.c[5][i]))));
    return q;
  }

  optimal::PlanStore* store_ = nullptr;
  unsigned axis_count_ = 3;
  uint32_t cell_ = optimal::kNoCell, generation_ = 0, answered_ = 0;
  double t_ = 0, x_ = 0, u_ = 0, v_ = 0;
  bool at_end_ = true, begins_ = false, taken_ = false;
};

}  // namespace nc
