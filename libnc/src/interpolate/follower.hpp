// SPDX-License-Identifier: Apache-2.0
// The scan's side of the optimal mode: it goes along the chain of cells in time. It has no time law of its own. The chain that it follows always ends
// at rest, and is changed only ahead of it (docs/motion-optimal.md, "Changing the plan on the way"). When the planner does not answer a request for a
// stop, the follower stops by itself, by going through the plan ever more slowly.
#pragma once

#include "base/triple_buffer.hpp"
#include "interpolate/brake.hpp"
#include "motion/optimal/plan_cell.hpp"

namespace nc {

class Follower {
 public:
  void create(optimal::PlanStore* store, const optimal::Limits* limits) {
    store_ = store;
    limits_ = limits;
    axis_count_ = limits->axis_count;
  }

  /// Looks at the newest offer of the planner, and takes it where it fits. Each offer is answered once.
  void look(const optimal::Proposal& offer) NC_RT {
    rests_ = offer.generation == generation_ ? offer.rests : optimal::kNoCell;
    if (offer.number == answered_) return;
    answered_ = offer.number;
    taken_to_ = offer.taken;
    if (offer.fresh && offer.first == optimal::kNoCell && offer.generation == generation_ && at_rest()) {  // void
      cell_ = optimal::kNoCell;
      at_end_ = true;
      begins_ = false;
    }
    taken_ = offer.first != optimal::kNoCell && offer.generation == generation_ && fits(offer);
    if (!taken_) return;
    stops_ = offer.stops;
    if (offer.fresh) {
      cell_ = offer.first;
      t_ = 0;
      begins_ = true;
      at_end_ = false;
      u_ = store_->at(cell_).u;
    } else if (enters_cut(offer)) {
      cell_ = offer.first;  // the same motion, which ends sooner: t_ stays
    } else {
      next(offer.after) = offer.first;
    }
  }

  /// At rest, and there is nothing left to follow.
  bool idle() const { return cell_ == optimal::kNoCell || (at_end_ && store_->next[cell_ & store_->cell_mask] == optimal::kNoCell); }
  bool at_rest() const { return at_end_ || begins_; }
  /// Speed of the spindle, rev/s, for which the next cell was planned. Not to be called when idle().
  double planned_turns() const NC_RT {
    return static_cast<double>(store_->at(at_end_ ? store_->next[cell_ & store_->cell_mask] : cell_).turns);
  }
  /// The axis that the spindle of a synchronous tap is, for which the next cell was planned, -1 = none. Not to be called when idle().
  int planned_turning_axis() const NC_RT { return store_->at(at_end_ ? store_->next[cell_ & store_->cell_mask] : cell_).turning_axis; }
  /// At rest at a place where the path itself rests, and not only the plan.
  bool at_path_end() const { return at_end_ && (cell_ != optimal::kNoCell ? store_->at(cell_).path_ends : halted_ && halt_ends_); }
  /// At rest at the end of the plan, right in front of a place where the path itself rests.
  bool before_path_end() const { return at_end_ && cell_ != optimal::kNoCell && store_->at(cell_).before_rest; }
  /// At rest at the end of the plan, and the record at ring index k lies on the path of that plan.
  bool rests_behind(uint32_t k) const { return at_end_ && cell_ != optimal::kNoCell && static_cast<int32_t>(k - taken_to_) < 0; }
  /// At rest at a place of the path where no plan ends: a stop that brake() has found has come to its end, and nothing further is planned.
  bool halted() const { return halted_ && cell_ == optimal::kNoCell; }
  uint32_t generation() const { return generation_; }
  double u() const { return u_; }
  double v() const { return v_; }
  double planned_v() const { return planned_v_; }  ///< mm per second of the plan
  /// The path is on the way to a stop that was asked for.
  bool stops() const { return stops_ || braking_ || (rests_ != optimal::kNoCell && !at_end_ && rests_ >= cell_); }

  /// Positions of the axes where the next cell begins. Not to be called when idle().
  AxisVec start() const NC_RT {
    const optimal::PlanCell& c = store_->at(at_end_ ? store_->next[cell_ & store_->cell_mask] : cell_);
    return point(c, 0);
  }

  /// Looks for a way to rest along the plan ahead that keeps the limits, and takes it where it takes no more than `longest` times as long as a stop on a line.
  /// To be called in each cycle until stops().
  void brake(PlanPace pace = {}, double longest = HUGE_VAL) NC_RT {
    if (braking_ || at_rest()) return;
    const double use = ++tries_ % kOfGentle != 0 ? 1 : kGentle[tries_ / kOfGentle % (sizeof kGentle / sizeof kGentle[0])];
    braking_ = brake_.find(PlanAhead{this, cell_, -t_}, limits_here(), use, pace, longest);
  }
  bool braking() const { return braking_; }

  /// Goes on for `time` seconds or to the next rest. @return what is left of the time.
  double advance(double time) NC_RT {
    if (!braking_) return follow(time);
    follow(brake_.advance(time));
    v_ *= brake_.sigma();
    if (at_end_) {
      braking_ = false;
    } else if (brake_.done()) {
      halt();
    }
    return 0;
  }
  /// Goes on by `plan_time` seconds of the plan, whose time goes `sigma` times as fast as that of the machine at the end of the step.
  /// @return the part of `plan_time` that is left when the plan has come to rest.
  double advance_plan(double plan_time, double sigma) NC_RT {
    const double left = follow(plan_time);
    v_ *= sigma;
    return left;
  }
  AxisVec position() const NC_RT {
    return cell_ == optimal::kNoCell ? on_piece(halt_piece_, halt_x_) : point(store_->at(cell_), x_);
  }

  /// Gives up everything that is planned: from now on only a plan with the new generation number is followed.
  void give_up() NC_RT {
    if (store_ == nullptr) return;
    let_go();
    halted_ = false;
  }
  /// For tests: generations, offers and records are counted from `first`.
  void count_from(uint32_t first) { generation_ = answered_ = taken_to_ = first; }
  void say(optimal::Following* out) const NC_RT {
    out->answered = answered_;
    out->taken = taken_;
    out->generation = generation_;
    out->cell = cell_;
    out->t = t_;
    out->at_end = at_end_;
    out->waits = begins_;
    out->halted = halted_;
    out->piece = halt_piece_;
    out->x = halt_x_;
  }

 private:
  static constexpr unsigned kOfGentle = 8;                ///< one of so many tries of brake() is gentle: it uses less than the limits leave
  static constexpr double kGentle[] = {0.6, 0.35, 0.15};  ///< shares that gentle tries use

  /// The limits of the piece in execution. A synchronous tap may use a share of them alone, because its spindle bears no more.
  optimal::Limits limits_here() const NC_RT {
    const optimal::PlanCell& cell = store_->at(cell_);
    const optimal::Piece& piece = store_->piece_at(cell.piece);
    optimal::Limits limits = *limits_;
    limits.scale.turning_axis = cell.turning_axis;
    const double acceleration = tap_acceleration_share(piece, limits), jerk = tap_jerk_share(piece, limits);
    for (unsigned i = 0; i < limits.axis_count; ++i) {
      limits.acceleration[i] *= acceleration;
      limits.jerk[i] *= jerk;
    }
    return limits;
  }
  /// Goes on by `time` seconds of the plan. @return what is left behind a rest.
  double follow(double time) NC_RT {
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
        v_ = planned_v_ = q.v;
        return 0;
      }
      time -= left;
      if (c.kind == optimal::PlanCell::Kind::land) {
        t_ = c.seconds;
        x_ = c.h;
        u_ = c.u + c.h;
        v_ = planned_v_ = 0;
        at_end_ = true;
        return time;
      }
      cell_ = next(cell_);
      t_ = 0;
    }
  }
  void let_go() {
    ++generation_;
    cell_ = optimal::kNoCell;
    at_end_ = true;
    begins_ = braking_ = stops_ = false;
    v_ = planned_v_ = 0;
  }
  /// At rest within a cell: the next plan begins at this place of the same path.
  void halt() NC_RT {
    const optimal::PlanCell& c = store_->at(cell_);
    halt_piece_ = c.piece;
    const optimal::Piece& p = store_->piece_at(c.piece);
    halt_x_ = std::fmin(p.length, c.x + x_);
    halt_ends_ = p.rest_behind && halt_x_ >= p.length - optimal::unseen(p, *limits_, p.length);
    let_go();
    halted_ = true;
  }

  /// The plan as Brake goes through it, in the direction of time: `begun` is the time of the plan at which `cell` is entered, 0 = now.
  struct PlanAhead {
    const Follower* of;
    optimal::CellIndex cell;
    double begun;

    double cell_end() const NC_RT { return begun + of->store_->at(cell).seconds; }
    PlanMoment at(double tau) NC_RT {
      while (tau >= cell_end())
        if (!enter()) return rest();
      return of->moment(of->store_->at(cell), std::fmax(0, tau - begun));
    }
    PlanMoment at_cell_end() const NC_RT { return of->moment(of->store_->at(cell), of->store_->at(cell).seconds); }
    PlanMoment at_next_cell() NC_RT { return enter() ? of->moment(of->store_->at(cell), 0) : rest(); }

   private:
    bool enter() NC_RT {
      if (of->store_->at(cell).kind == optimal::PlanCell::Kind::land) return false;
      begun = cell_end();
      cell = of->store_->next[cell & of->store_->cell_mask];
      return true;
    }
    static PlanMoment rest() {
      PlanMoment m;
      m.rests = true;
      return m;
    }
  };
  PlanMoment moment(const optimal::PlanCell& c, double t) const NC_RT {
    PlanMoment m;
    const optimal::CellState q = optimal::state_in(c, t);
    const optimal::Piece& p = store_->piece_at(c.piece);
    m.path = evaluate(p, std::fmin(p.length, c.x + std::fmin(c.h, std::fmax(0, q.x))), axis_count_);
    m.v = q.v;
    m.a = q.a;
    using Kind = optimal::PlanCell::Kind;
    m.j = c.kind == Kind::level ? c.w * q.v : c.kind == Kind::ramp ? c.w : 2 * c.v / (c.seconds * c.seconds);
    return m;
  }

  optimal::CellIndex& next(optimal::CellIndex k) { return store_->next[k & store_->cell_mask]; }
  bool fits(const optimal::Proposal& offer) const NC_RT {
    if (braking_) return false;
    if (offer.fresh) return at_rest();
    if (cell_ == optimal::kNoCell) return false;
    // The offer goes on behind the end of the plan, where it rests, or behind a cell that has not been left yet, or amid one before the place comes.
    return enters_cut(offer) || (offer.after != optimal::kNoCell && offer.after >= cell_);
  }
  bool enters_cut(const optimal::Proposal& offer) const NC_RT { return cell_ == offer.cuts && !at_end_ && t_ < store_->at(offer.first).seconds; }
  AxisVec point(const optimal::PlanCell& c, double x) const NC_RT { return on_piece(c.piece, c.x + x); }
  AxisVec on_piece(uint32_t piece, double x) const NC_RT {
    const optimal::Piece& p = store_->piece_at(piece);
    const double at = std::fmin(p.length, x);
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
  optimal::CellIndex cell_ = optimal::kNoCell;
  uint32_t generation_ = 0, answered_ = 0;
  uint32_t taken_to_ = 0;
  double t_ = 0, x_ = 0, u_ = 0, v_ = 0, planned_v_ = 0;
  bool at_end_ = true, begins_ = false, taken_ = false;
  const optimal::Limits* limits_ = nullptr;
  Brake brake_;
  unsigned tries_ = 0;
  bool stops_ = false, braking_ = false;
  optimal::CellIndex rests_ = optimal::kNoCell;
  bool halted_ = false;       ///< at rest on the path, not at the end of a plan
  uint32_t halt_piece_ = 0;
  double halt_x_ = 0;
  bool halt_ends_ = false;    ///< no axis shows that it is not where the path itself rests
};

}  // namespace nc
