// SPDX-License-Identifier: Apache-2.0
// The limits that high-accuracy control sets for a segment. How they are calculated belongs to the family (MotionRules in dialect/rules.hpp); the
// planner only keeps them.
#pragma once

namespace nc {

/// The limits that high-accuracy control sets for one segment (M700 13.15). The defaults, mostly 0, limit nothing.
struct AccuracyLimits {
  float speed_clamp = 0;   ///< highest speed, by the radius or the curvature of the path, mm/s
  float corner_step = 0;   ///< largest step of velocity at a corner, mm/s
  float smooth_cos = -1;   ///< where the cosine of the angle between two tangents is this or more, there is no corner
  float corner_least = 0;  ///< `corner_step` does not make the speed at a corner lower than this, mm/s
  float arc_joint = 0;     ///< highest speed where an arc meets another kind of path, mm/s
  float judged_turn = -1;  ///< change of direction, 2 sin(angle / 2), that the corner at its start is judged by; negative: the real one
  float bend_acceleration = 0;  ///< largest acceleration that the bends of a row of short lines may cause, mm/s^2
  float acceleration = 0;  ///< largest acceleration along the path, mm/s^2
  /// Something limits the joint where the segment begins.
  bool ask_of_joint() const { return corner_step > 0 || arc_joint > 0 || bend_acceleration > 0; }
};

/// Where two segments meet.
struct AccuracyJoint {
  double turn = 0;           ///< how far the direction changes: distance of the two unit tangents, 2 sin(theta / 2)
  double length_before_mm = 0, length_behind_mm = 0;
  bool both_lines = false;
  bool arc_ends = false;     ///< one of the two is an arc, the other is not
};

/// Highest speed at a joint, mm/s; infinite where nothing limits it.
using AccuracyJointSpeed = double (*)(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint);

}  // namespace nc
