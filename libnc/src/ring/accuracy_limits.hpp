// SPDX-License-Identifier: Apache-2.0
// What high-accuracy control asks of a segment. The formulas behind it belong to the family (MotionRules in dialect/rules.hpp); the
// planner keeps to the limits, whoever asked for them.
#pragma once

namespace nc {

/// What high-accuracy control asks of one segment (M700 13.15). Zeros and what is set by default ask nothing.
struct AccuracyLimits {
  float speed_clamp = 0;   ///< by the radius or the curvature, mm/s
  float corner_step = 0;   ///< change of velocity that a corner may make, mm/s
  float smooth_cos = -1;   ///< tangents with this cosine or more between them pass smoothly: no corner
  float corner_least = 0;  ///< a corner is not passed slower for `corner_step`, mm/s
  float arc_joint = 0;     ///< speed where an arc meets another kind of path, mm/s
  float judged_turn = -1;  ///< |change of direction| that the corner at its start counts as; negative: what it is
  float bend_acceleration = 0;  ///< that short lines may cause by turning, mm/s^2
  float acceleration = 0;  ///< along the path, mm/s^2
  /// Something is asked of the joint where the segment begins.
  bool ask_of_joint() const { return corner_step > 0 || arc_joint > 0 || bend_acceleration > 0; }
};

/// Where two segments meet.
struct AccuracyJoint {
  double turn = 0;           ///< how far the direction changes: distance of the two unit tangents, 2 sin(theta / 2)
  double length_before_mm = 0, length_behind_mm = 0;
  bool both_lines = false;
  bool arc_ends = false;     ///< one of the two is an arc, the other is not
};

/// Highest speed at a joint, mm/s; infinite where nothing is asked.
using AccuracyJointSpeed = double (*)(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint);

}  // namespace nc
