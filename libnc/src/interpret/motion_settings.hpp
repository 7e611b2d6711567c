// SPDX-License-Identifier: Apache-2.0
// The parameters that are needed for a move behind the interpreter. They are interned like its transform and travel with the move as a number, because a
// stage may hold the move back while a later block, or the operator, changes the parameters.
#pragma once

#include "dialect/accuracy.hpp"
#include "fairing/rule.hpp"
#include "filter/filter_parameters.hpp"

namespace nc {

struct MotionSettings {
  AccuracyParameters accuracy;  ///< parameters of high-accuracy control (M700 13.15)
  FairingRule fairing;          ///< M700 13.17.1
  FilterParameters filters;     ///< filters behind interpolation (M700 7.7, 13.15)
  uint32_t index_axes = 0;      ///< bit i: axis i is an index table (M700 9.3)
  uint32_t machine_turn = 0;    ///< bit i: the machine coordinate of axis i is shown within one turn (M700 14.13)
  bool corner_arcs = false;     ///< ,C and ,R beside arcs are cut (corner_ii)
  double arc_tolerance = 0.1;   ///< mm, by which the radii of an arc may differ (M700 6.4, #1084)
  bool rapid_dry = false;       ///< dry run concerns rapid traverse (M700 13.1.1, #1085)
  bool operator==(const MotionSettings&) const = default;
};

/// The number of different settings that may be under way at once. Between two moves with different parameters lies at least one mark, so of the 32 items
/// that compensation holds at most every second one has its own settings. Fairing gives out its lines before it takes one with other settings, a
/// corner has two lines, and the items on their way to the sink belong to one block.
inline constexpr unsigned kMotionSettings = 32;

}  // namespace nc
