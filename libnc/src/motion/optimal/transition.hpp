// SPDX-License-Identifier: Apache-2.0
// Where two curves meet, of which one is no line, the path changes over within the tolerance: both are left and entered at the same
// distance from the joint, and between the two places runs the polynomial of degree 5 that has the position, the direction and the
// curvature of either at its ends. Of a sharp corner the step of the direction is taken out and goes the way of turn.hpp instead
// (docs/motion-optimal.md, "Transitions").
#pragma once

#include "motion/optimal/piece.hpp"
#include "motion/optimal/turn.hpp"

namespace nc::optimal {

/// A curve at the joint: one end of an arc, or a line through it.
struct JointSide {
  const Curve* curve = nullptr;
  double s = 0;          ///< of the joint on the curve
  AxisVec place, along;  ///< of a line: the joint, and q'

  /// x from the joint, negative in front of it.
  CurvePoint at(double x, unsigned axis_count) const;
};
JointSide line_through(const AxisVec& joint, const AxisVec& from, const AxisVec& to, double length, unsigned axis_count);
JointSide arc_end(const Curve& curve);
JointSide arc_start(const Curve& curve);

struct Joint {
  bool found = false;  ///< the path need not rest
  bool turns = false;  ///< as a sharp corner
  double reach = 0;    ///< on either side; 0: the curves go on in each other without a transition
  AxisVec step;        ///< of q' at the joint
};

struct Transition {
  Piece piece[kTurnPieces];
  unsigned count = 0;
};

/// The longest transition that stays within the tolerance and reaches `most` at most. `room` is for the work.
Joint find_joint(const JointSide& before, const JointSide& after, double most, double tolerance, unsigned axis_count, Transition* room);

/// The transition from `from`, which the path has in front of the joint, into `after`.
void make_transition(const Joint& joint, const CurvePoint& from, const JointSide& after, unsigned axis_count, Transition* out);
/// Its largest distance from the two curves.
double transition_distance(const Transition& t, const JointSide& before, const JointSide& after, double reach, unsigned axis_count);

}  // namespace nc::optimal
