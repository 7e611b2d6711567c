// SPDX-License-Identifier: Apache-2.0
// The time law: along a path that is cut into cells, the largest speed that keeps the velocity, acceleration
// and jerk of every axis.
//
// Unknown is b(u) = u'^2 (u' = du/dt) as a quadratic spline: one control value c_k for each cell, b
// continuous with its slope. Then
//     u'' = b'/2,   u''' = sqrt(b) b''/2,
//     axis velocity      q' sqrt(b)
//     axis acceleration  q' b'/2 + q'' b                                   linear in c
//     axis jerk          sqrt(b) (q' b''/2 + 3/2 q'' b' + q''' b)          linear in c but for the root
// and the time is the sum of h_k / sqrt(c_k), convex. An interior-point method with a band matrix of two
// sub-diagonals solves it (docs/motion-optimal.md). Next to rest b grows as u^(4/3), which no quadratic
// follows: the cell there has constant jerk instead.
#pragma once

#include "motion/optimal/four.hpp"
#include "motion/optimal/piece.hpp"
#include "motion/optimal/work.hpp"

namespace nc::optimal {

inline constexpr unsigned kMaxCells = 768;
inline constexpr unsigned kMaxSteps = 60;  ///< of the solver, for one law

/// The path at the joint of two cells; q''' may jump there.
struct Knot {
  AxisVec d1, d2, left3, right3;
  double cap = 0;  ///< largest b, (mm/s)^2: feed and axis velocities
};

/// The path inside a cell: the middle Bezier coefficient of q' as a quadratic, q'' at both ends, the mean
/// q'''.
struct Inside {
  AxisVec d1, d2_start, d2_end, d3;
};

struct Mesh {
  unsigned cells = 0;
  double h[kMaxCells];      ///< length of cell k, between knots k and k + 1
  double cap[kMaxCells];    ///< largest b in the cell
  double guess[kMaxCells];  ///< b to begin with
  double use[kMaxCells];    ///< share of the jerk limits that the cell may use, 1 or a little less
  double use_a[kMaxCells];  ///< the same of the acceleration limits
  bool level[kMaxCells];    ///< the control value of the cell is its cap: it is known that the speed stays there
  unsigned levels = 0;      ///< cells that are level
  bool kept[kMaxCells];     ///< of a law that is solved once more: the control value stays what it was
  Knot knot[kMaxCells + 1];
  Inside inside[kMaxCells];
  bool from_rest = true;  ///< else b and b' at the start are given
  double b0 = 0, slope0 = 0;
  bool stops = false;  ///< it is a stop from a law that is followed, one of many that are tried, and there may be none
};

/// b at the knots, its slope, and b''/2 in the cells. The first cell when it starts from rest, and the last
/// one, have constant jerk.
struct Law {
  unsigned cells = 0;
  double b[kMaxCells + 1], slope[kMaxCells + 1], half2[kMaxCells];
  double seconds = 0;
  unsigned iterations = 0;
  double worst = 0;  ///< largest share of a limit that is used at a knot
  bool ok = false;
};

class TimeLaw {
 public:
  /// anew: it begins with the guess of the mesh. again: the mesh is that of the last law, some limits are a little lower; it begins with that law. nearby: the
  /// same, and the cells that are kept stay what they are.
  enum class Begins : uint8_t { anew, again, nearby };
  /// The law of least time that ends at rest. !law->ok when none was found; nothing may then be done with it but to solve again, from where that one began.
  /// `most`: steps until it gives up. @return law->ok
  Task<bool> solve(Work& work, const Mesh& mesh, const Limits& limits, Begins begins, Law* law, unsigned most = kMaxSteps);

 private:
  static constexpr unsigned kPad = 2;
  /// A value that is linear in three neighbouring control values.
  struct Form {
    double g[3] = {0, 0, 0};
  };
  /// The rows of one axis in cell k, all on c_(k-1), c_k, c_(k+1):
  ///     jerk behind knot k, jerk in front of knot k + 1, jerk in the middle, acceleration at knot k
  /// with r = root (g c) in [-1, 1]. Slacks, multipliers and 1 / slack of both sides.
  struct Rows {
    Four g[3], r, s[2], l[2], per[2];
  };
  /// What the rows of all axes of a cell have in common: the root, b under it by the control values, and 1 / 2b.
  struct Roots {
    Four root, half_per, at[3];
  };
  /// b at knot k and c_k below feed and axis velocities: r = g0 c_(k-1) + g1 c_k <= 1. Two rows, the other two places are none.
  struct Caps {
    Four g0, g1, s, l, per;
  };
  /// L D L' of the band, each row as soon as it is known, for two right sides: what the second is multiplied by is known later.
  struct Elimination {
    struct Row {
      double lower1 = 0, lower2 = 0, off1 = 0, off2 = 0, side = 0, side_mu = 0;
    };
    Row last, before;
    bool possible = true;
    double add(double diag, Row r);
  };
  struct Sums {
    double gap = 0, residual = 0, worst = 0;
  };

  /// Free control values next to each other. The rows of cells [from - 1, to] hang on them.
  struct Run {
    unsigned from = 0, to = 0;
    bool possible = true;                    ///< a step can be found
    double side[2] = {}, side_mu[2] = {};    ///< right side beside its ends, of what is given there
  };

  void forms();
  void find_runs();
  void moving_axes();
  struct Share {
    double acceleration = 0, jerk = 0, speed = 0;
  };
  Share share_of(unsigned cell) const;
  bool matters(unsigned cell, unsigned axis, const Share& most) const;
  /// One pass through the rows, and what it is amid of when it is interrupted in front of a cell.
  struct Pass {
    bool first = false;
    double target = 0, smallest = 0;
    Four gap{}, residual{}, worst{};
    Rows* row = nullptr;
    Run* run = nullptr;
    unsigned cell = 0;
    bool ended = false;   ///< the pass
    bool inside = false;  ///< of the run: what follows is that of its cells up to this one
    Four m00{}, m01{}, m11{}, a0{}, a1{}, d0{}, d1{};
    double diag = 0, side = 0, side_mu = 0;
    Elimination band;
  };

  Rows* fill_rows(const Run& run, unsigned cell, Rows* row);
  Task<bool> fill_rows(Work& work);
  void begin_pass(bool first, double mu, double least);
  unsigned rows(unsigned most);
  Task<bool> all_rows(Work& work);
  Sums sums() const;
  int64_t cost_of(unsigned cells) const;
  void begin(const Mesh& mesh, Begins begins);
  Task<bool> find(Work& work, Begins begins, Law* law, unsigned most);
  double roots(unsigned k);
  void find_time();
  bool step(double mu);
  bool levels_hold(double mu) const;
  bool dips() const;
  void finish(Law* law);
  double value(const Form& f, unsigned base) const {
    return f.g[0] * c_[base] + f.g[1] * c_[base + 1] + f.g[2] * c_[base + 2];
  }

  const Mesh* mesh_ = nullptr;
  const Limits* limits_ = nullptr;
  unsigned n_ = 0;                 ///< cells
  Run run_[kMaxCells / 2];
  unsigned runs_ = 0;
  unsigned axes_ = 0, axis_[kMaxAxes];  ///< that move
  unsigned rows_ = 0;
  double time_ = 0;
  double time_per_row_ = 0;  ///< of the last law that was solved as a whole
  double weight_[kMaxCells];
  // Padded by kPad on either side: control value k is c_[k + kPad].
  double c_[kMaxCells + 2 * kPad], dc_[kMaxCells + 2 * kPad];
  double before_[kMaxCells + 2 * kPad];  ///< c of the law that some cells of are solved once more
  double side_[kMaxCells + 2 * kPad], side_mu_[kMaxCells + 2 * kPad];  ///< eliminated: the right side is the one and mu times the other
  double lower1_[kMaxCells + 2 * kPad], lower2_[kMaxCells + 2 * kPad];
  Form at_[kMaxCells + 1], slope_[kMaxCells + 1];  ///< of knot k, on c_(k-1), c_k
  Form half2_[kMaxCells];                          ///< of cell k, on c_(k-1), c_k, c_(k+1)
  Roots root_[kMaxCells];
  Caps cap_[kMaxCells];
  unsigned char in_cell_[kMaxCells];  ///< axes that have rows there
  Rows row_[kMaxAxes * kMaxCells];    ///< of these, cell by cell
  Pass pass_;
};

}  // namespace nc::optimal
