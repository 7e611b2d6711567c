// SPDX-License-Identifier: Apache-2.0
// High-accuracy control: its parameters, and the description of one move in this mode. A rule of the family (MotionRules in
// dialect/rules.hpp) gets both and answers with limits, which travel with the segment (ring/accuracy_limits.hpp).
#pragma once

#include "stream/stream.hpp"

namespace nc {

/// Parameters of the mode. 0 = the parameter is not set.
struct AccuracyParameters {
  double target_mm_min = 0;      ///< #1206 G1bF
  double time_ms = 0;            ///< #1207 G1btL: time to #1206
  double radius_percent = 0;     ///< #8019 R COMPEN: accuracy coefficient Ks, negative = faster
  double corner_angle_deg = 0;   ///< #8020 DCC ANGLE
  bool separate = false;         ///< #8021 COMP CHANGE: #8022 and #8023 are used instead of #8019
  double corner_percent = 0;     ///< #8022 CORNER COMP
  double curve_percent = 0;      ///< #8023 CURVE COMP
  double arc_joint_mm_min = 0;   ///< #1209 cirdcc, if #1149 cireft is on

  double clamp_mm_min[kMaxAxes] = {};    ///< #2110 Clamp(H-precision)
  double rapid_mm_min[kMaxAxes] = {};    ///< #2109 Rapid(H-precision)
  double corner_least_mm_min[kMaxAxes] = {};  ///< #2096 crncsp
  bool acceleration_clamp = false;       ///< #8034 AccClamp ON, in high-speed high-accuracy control II

  double corner_coefficient() const { return separate ? corner_percent : radius_percent; }
  double curve_coefficient() const { return separate ? curve_percent : radius_percent; }
  bool operator==(const AccuracyParameters&) const = default;
};

/// One move in high-accuracy control.
struct AccuracyMove {
  unsigned axis_count = 0;
  AxisVec share;               ///< largest share of each axis in the path
  bool rapid = false;
  bool circular = false;
  double radius_mm = 0;        ///< radius of an arc; the smaller one if it changes along the arc
  double speed_clamp_mm_s = 0; ///< highest speed that the function of the move asks for, 0 = none
  float judged_turn = -1;      ///< AccuracyLimits::judged_turn
  bool fine_segments = false;  ///< in high-speed high-accuracy control II
};

}  // namespace nc
