// SPDX-License-Identifier: Apache-2.0
// A path of any length in bounded memory: one time law after the other, each of which ends at rest, and of
// which only the part is kept that the artificial stop at its end has not slowed.
#pragma once

#include "motion/optimal/known_law.hpp"
#include "motion/optimal/peaks.hpp"

namespace nc::optimal {

/// Where the next law begins, at cell k or some cells in front of it: where the speed has begun to rise it is found more easily than where
/// braking takes all that the limits leave. `slope(k)` has the sign of the acceleration at the start of cell k > 0.
template <class Slope>
unsigned better_start(unsigned k, Slope&& slope) {
  constexpr unsigned kSearch = 40;
  unsigned rising = k;
  for (unsigned n = k; n > 1 && n + kSearch > k; --n) {
    if (slope(n) < 0) continue;
    if (slope(n - 1) < 0) return n;
    if (slope(rising) < 0) rising = n;
  }
  return rising;
}

class Windows {
 public:
  /// Pieces from rest to rest. They stay where they are as long as this is used.
  void start(const Piece* piece, unsigned count, const Limits& limits, double period = 0.005);
  /// The next law. False at the end, and when none was found (failed()).
  Task<bool> next(Work& work);
  bool failed() const { return failed_; }

  /// One law, from the place and the state that the request names to the end of its pieces or as far as its cells reach.
  struct Goal {
    double period = 0.005;
    bool once = false;  ///< without a second try: the caller has other goals
    unsigned steps = kMaxSteps;  ///< of the solver, for each law
  };
  Task<bool> law_to(Work& work, const MeshRequest& request, const Limits& limits, const Goal& goal);
  /// The law in phases from the same place, which is looked at in the same way.
  Task<bool> phases_to(Work& work, const MeshRequest& request, const Limits& limits);
  const PhaseLaw& phases() const { return phases_; }
  /// The place of what is followed (MeshRequest::followed) from which there is a law in phases, the first one that is found; kNone where there is none.
  static constexpr unsigned kNone = ~0u;
  Task<unsigned> leaves_at(Work& work, const MeshRequest& request, const Limits& limits);
  /// The last law reaches the end of the pieces (or the reach that was asked).
  bool whole() const { return !more_; }

  const Mesh& mesh() const { return mesh_; }
  const Law& law() const { return law_; }
  /// Cells [0, keep()) of the law are final.
  unsigned keep() const { return keep_; }
  const Piece& piece_of(unsigned cell) const { return request_.at(mesher_.place(cell).piece); }
  const PathPlace& place(unsigned cell) const { return mesher_.place(cell); }
  double stop_seconds() const { return stop_s_; }
  unsigned iterations() const { return iterations_; }  ///< of all laws so far
  unsigned solved() const { return solved_; }          ///< cells of all laws so far

 private:
  /// Where a law is not found at once: slower to begin with, with other cells, and shorter.
  struct Attempt {
    double guess;
    unsigned cells;
    double period;  ///< of the one asked for
  };
  static constexpr Attempt kAttempts[] = {
      {0.85, kMaxCells, 1}, {0.4, kMaxCells, 0.7}, {0.7, kMaxCells / 2, 0.5}, {0.3, kMaxCells / 2, 1.2}};
  void set_limits(const Limits& limits);
  Task<bool> solve(Work& work, unsigned tries);
  Task<bool> lay_cells(Work& work, const Attempt& attempt, bool first);
  Task<bool> take(Work& work);
  Task<bool> soon_enough(Work& work);
  MeshRequest same_way() const;
  Task<bool> from_phases(Work& work);
  /// The place on the path of a look at a law in phases, and what was seen at the last one.
  struct PhaseLook {
    unsigned piece = 0;
    double begun = 0;
    bool goes_on = false;  ///< from the last look in one phase on one piece, so nothing has jumped
    Rates last[kMaxAxes];
  };
  bool phase_keeps_limits(const MeshRequest& request, const LineState& s, double jerk, double step, PhaseLook* look) const;
  Task<bool> phases_keep_limits(Work& work, const MeshRequest& request);
  Task<bool> rest_earlier(Work& work, const MeshRequest& request, double share);
  void keep_others();
  Task<bool> solve_again(Work& work);
  Task<bool> corrected(Work& work);
  void settle();
  double stopping_time() const;
  Task<double> tighten(Work& work);
  double tighten(unsigned from, unsigned to);
  void lower_caps(unsigned cell, double times);
  struct Excess {
    double acceleration = 0, jerk = 0, velocity = 0;
  };
  static constexpr unsigned kFours = 4, kLooks = 4 * kFours;  ///< places of a cell that are looked at
  struct Moments;
  class AccelerationPeaks;
  bool moments(unsigned cell, Moments* m) const;
  Excess excess(unsigned cell) const;
  bool looks_on_quintic(unsigned cell, const Moments& m, double seconds, Excess* out) const;
  Excess excess_on_curve(unsigned cell, const Moments& m) const;
  double peak_acceleration(unsigned cell, const Moments& m) const;
  int64_t look_cost(unsigned cell) const;

  MeshRequest request_;
  Limits limits_;
  double period_ = 0.005;
  double per_acceleration_[kMaxAxes] = {}, per_jerk_[kMaxAxes] = {};  ///< 1 / limit, 0 without one
  double stop_s_ = 0;  ///< so long before its end the last law may have been slowed by its stop
  unsigned most_ = kMaxCells, steps_ = kMaxSteps;
  unsigned keep_ = 0, iterations_ = 0, solved_ = 0;
  bool more_ = false, failed_ = false;
  Mesher mesher_;
  Mesh mesh_;
  bool exceeds_[kMaxCells];  ///< the cell uses more than a limit
  TimeLaw time_law_;
  PhaseLaw phases_;
  KnownLaw known_;
  Law law_;
};

}  // namespace nc::optimal
