// SPDX-License-Identifier: Apache-2.0
// High-accuracy control: its parameters and a move that is made in it, which a family's rule is asked about (MotionRules in
// dialect/rules.hpp). The answer travels with the segment (ring/accuracy_limits.hpp).
#pragma once

#include "stream/stream.hpp"

namespace nc {

/// Parameters of the mode; 0 = not set.
struct AccuracyParameters {
  double target_mm_min = 0;      ///< #1206 G1bF
  double time_ms = 0;            ///< #1207 G1btL: time to #1206
  double radius_percent = 0;     ///< #8019 R COMPEN: accuracy coefficient Ks, negative = faster
  double corner_angle_deg = 0;   ///< #8020 DCC ANGLE
  bool separate = false;         ///< #8021 COMP CHANGE: the two below instead of #8019
  double corner_percent = 0;     ///< #8022 CORNER COMP
  double curve_percent = 0;      ///< #8023 CURVE COMP
  double arc_joint_mm_min = 0;   ///< #1209 cirdcc, where #1149 cireft is on

  double clamp_mm_min[kMaxAxes] = {};    ///< #2110 Clamp(H-precision)
  double rapid_mm_min[kMaxAxes] = {};    ///< #2109 Rapid(H-precision)
  double corner_least_mm_min[kMaxAxes] = {};  ///< #2096 crncsp
  bool acceleration_clamp = false;       ///< #8034 AccClamp ON, in high-speed high-accuracy control II

  double corner_coefficient() const { return separate ? corner_percent : radius_percent; }
  double curve_coefficient() const { return separate ? curve_percent : radius_percent; }
  bool operator==(const AccuracyParameters&) const = default;
};

/// One move in the mode.
struct AccuracyMove {
  unsigned axis_count = 0;
  AxisVec share;               ///< largest share of each axis in the path
  bool rapid = false;
  bool circular = false;
  double radius_mm = 0;        ///< of an arc, the smaller one where it changes
  double speed_clamp_mm_s = 0; ///< that its own function asked for, 0 = none
  float judged_turn = -1;      ///< AccuracyLimits::judged_turn
  bool fine_segments = false;  ///< in high-speed high-accuracy control II
};

}  // namespace nc
