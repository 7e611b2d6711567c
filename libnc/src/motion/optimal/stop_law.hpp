// SPDX-License-Identifier: Apache-2.0
// The way to rest from any place of a chain, inside of a cell or not, along the chain itself: its time goes ever more slowly, tau' = sigma from 1
// to 0. Each step brakes as hard as leaves a way on, and that is known for every state: the braking is taken back, and the chain is gone on with
// at a constant pace. So a stop never runs into a place from which there is none (docs/motion-optimal.md, "A stop from inside").
#pragma once

#include "motion/optimal/plan_cell.hpp"
#include "motion/optimal/work.hpp"

namespace nc::optimal {

/// The chain as its planner knows it.
struct ChainView {
  const PlanStore* store = nullptr;
  const CellIndex* next = nullptr;
  CellIndex left = kNoCell;  ///< this cell is left after so many seconds
  double left_s = 0;
  const PlanCell& at(CellIndex k) const { return store->at(k); }
  double seconds_of(CellIndex k) const { return k == left ? left_s : at(k).seconds; }
};

class StopLaw {
 public:
  /// From `t` seconds behind the start of a cell on. `seconds`: of the stop on a straight line, by which the steps are measured. False where
  /// there is no braking from here, or where the chain rests before.
  Task<bool> find(Work& work, const ChainView& chain, CellIndex cell, double t, const Limits& limits, double seconds);

  const PacedStop& stop() const { return stop_; }
  double seconds() const { return stop_.step * (stop_.count - 1) + stop_.last; }

 private:
  /// On the way along the chain; times are those of the chain, 0 where the stop begins.
  struct Place {
    CellIndex cell = kNoCell;
    double begun = 0;  ///< the cell
    bool rests = false;
  };
  struct Pace {
    double tau = 0, sigma = 1, slope = 0;
    double bend = 0;  ///< of the step that ends here
    Pace after(double x, double t) const { return {tau + t * (sigma + t * (slope / 2 + t * x / 6)), sigma + t * (slope + t * x / 2), slope + t * x, x}; }
  };
  /// Of sigma''.
  struct Range {
    double low = -HUGE_VAL, high = HUGE_VAL;
    void keep(double constant, double factor, double most);
    bool some() const { return low <= high; }
  };
  enum class Side : uint8_t { start, end };

  double end_of(const Place& place) const { return place.begun + chain_.seconds_of(place.cell); }
  bool enter(Place* place) const;
  void go_to(double tau, Place* place) const;
  void look(const Place& place, double tau, const Pace& from, double guess, double t, bool acceleration, Range* out);
  Range range(const Pace& from, Place place, double guess, double seconds);
  Range lowest(const Pace& from, const Place& place);
  Task<bool> release(Work& work, Pace from, Place place, double* first);
  Task<bool> goes_on(Work& work, const Pace& to, Place place);
  Task<bool> brake(Work& work, const Pace& from, const Place& place, const Range& may, double* bend);
  bool may_land(const Pace& from, const Place& place);
  Task<bool> lands(Work& work, const Pace& from, Place place);
  Task<bool> steps(Work& work, Place place);
  Task<bool> keeps_limits(Work& work, Place place);
  int64_t looked();

  ChainView chain_;
  const Limits* limits_ = nullptr;
  double share_ = 1, step_ = 0;
  PacedStop stop_;
  int64_t spent_ = 0;  ///< instructions since the last pause
};

}  // namespace nc::optimal
