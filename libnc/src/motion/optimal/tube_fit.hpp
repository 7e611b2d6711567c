// SPDX-License-Identifier: Apache-2.0
// Some control points of a cubic spline, moved to where the sum of weighted squares of its third derivative is least while the spline stays
// near a line at given places: a quadratic program, by the alternating direction method of multipliers. Each of its steps is a pass through
// the places and one solution with a matrix of three sub-diagonals, which is the same for all axes and all steps
// (docs/motion-optimal.md, "Geometry").
#pragma once

#include "motion/optimal/four.hpp"
#include "motion/optimal/piece.hpp"

namespace nc::optimal {

class TubeFit {
 public:
  static constexpr unsigned kControls = 128;  ///< that are moved at once
  static constexpr unsigned kPlaces = 1536;

  /// Control points [first, first + count) are moved. Control points k to k + 3 make cell k.
  void begin(unsigned first, unsigned count, unsigned axis_count);
  /// weight times the square of the third derivative in a cell, which is the sum of `third` times its control points.
  void add_third(unsigned cell, const double third[4], double weight, const AxisVec* control);
  /// A place in a cell, where the spline is the sum of `basis` times its control points. False: there is no room for another one.
  bool add_place(unsigned cell, const double basis[4], const AxisVec& line, double radius);
  /// All is known now. False when there is no solution.
  bool prepare(const AxisVec* control);

  unsigned places() const { return places_; }
  /// A step is: pass() over all of the places, then solve(), which moves the control points.
  void begin_step();
  void pass(unsigned from, unsigned to, const AxisVec* control);
  void solve(AxisVec* control);
  /// The spline may be no more than `share` times as far from the line in a cell as before. `place` is one of its first or in front of it.
  void tighten(unsigned cell, double share, unsigned* place);

 private:
  /// A place of all axes, four to a vector; what stands behind the last axis is 0.
  static constexpr unsigned kGroups = (kMaxAxes + 3) / 4;
  struct Wide {
    Four group[kGroups] = {};
  };
  static Wide wide(const AxisVec& v);
  struct Place {
    double basis[4];
    Wide line, dual;
    double radius, weight;
    unsigned cell;
  };
  template <unsigned groups>
  void pass_of(unsigned from, unsigned to, const AxisVec* control);
  bool moves(unsigned j) const { return j >= first_ && j < first_ + count_; }
  void add(unsigned cell, const double row[4], double weight, const AxisVec* control);
  void weigh();
  bool factorize();

  unsigned first_ = 0, count_ = 0, axis_count_ = 0, places_ = 0;
  double band_[kControls][4];  ///< the matrix, then its factor: the diagonal and what stands left of it
  Wide known_[kControls];  ///< right side that comes of the control points that stay
  Wide right_[kControls];
  Place place_[kPlaces];
};

}  // namespace nc::optimal
