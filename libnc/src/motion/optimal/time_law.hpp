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

#include "motion/optimal/piece.hpp"

namespace nc::optimal {

inline constexpr unsigned kMaxCells = 768;

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
  Knot knot[kMaxCells + 1];
  Inside inside[kMaxCells];
  bool from_rest = true;  ///< else b and b' at the start are given
  double b0 = 0, slope0 = 0;
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
  /// The law of least time that ends at rest. !law->ok when none was found; nothing may then be done with it.
  /// `again`: the mesh is that of the last law, some limits are a little lower; it begins with that law.
  void solve(const Mesh& mesh, const Limits& limits, bool again, Law* law);

 private:
  static constexpr unsigned kPad = 2;
  static constexpr unsigned kPairs = 3 * kMaxAxes;
  /// r in [-1, 1]: slacks and multipliers of both sides.
  struct Pair {
    double r, g[3], s[2], l[2], ds[2], dl[2];
  };
  /// r <= 1.
  struct Single {
    double r, g[3], s, l, ds, dl;
  };
  /// A value that is linear in three neighbouring control values.
  struct Form {
    double g[3] = {0, 0, 0}, constant = 0;
  };

  void forms();
  void evaluate_rows(double least);
  void knot_rows(unsigned k);
  void middle_rows(unsigned k);
  void slacks(Pair& x, double least);
  void slack(Single& x, double least);
  void assemble(double mu);
  bool factor_and_solve();
  void directions(double mu, double* step_primal, double* step_dual);
  void finish(Law* law);
  double value(const Form& f, unsigned base) const {
    return f.g[0] * c_[base] + f.g[1] * c_[base + 1] + f.g[2] * c_[base + 2] + f.constant;
  }
  template <class F>
  void each_pair(F&& f);
  template <class F>
  void each_single(F&& f);

  const Mesh* mesh_ = nullptr;
  const Limits* limits_ = nullptr;
  unsigned n_ = 0;                 ///< cells
  unsigned first_ = 0, last_ = 0;  ///< free control values: [first_, last_)
  unsigned rows_ = 0;
  double weight_[kMaxCells];
  // Padded by kPad on either side: control value k is c_[k + kPad].
  double c_[kMaxCells + 2 * kPad], dc_[kMaxCells + 2 * kPad];
  double diag_[kMaxCells + 2 * kPad], off1_[kMaxCells + 2 * kPad], off2_[kMaxCells + 2 * kPad];
  Form at_[kMaxCells + 1], slope_[kMaxCells + 1];  ///< of knot k, on c_(k-1), c_k
  Form half2_[kMaxCells];                          ///< of cell k, on c_(k-1), c_k, c_(k+1)
  unsigned used_[kMaxCells + 1];                   ///< pairs of knot k
  unsigned inside_[kMaxCells];                     ///< pairs of the middle of cell k
  Pair pair_[kMaxCells + 1][kPairs];
  Pair middle_[kMaxCells][kMaxAxes];
  Single knot_cap_[kMaxCells + 1], cell_cap_[kMaxCells];
};

}  // namespace nc::optimal
