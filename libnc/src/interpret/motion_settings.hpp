// SPDX-License-Identifier: Apache-2.0
// Parameters that a move needs behind the interpreter. They are interned like its transform and travel with it as a number: a stage may
// hold the move back while a later block, or the operator, writes other ones.
#pragma once

#include "dialect/accuracy.hpp"
#include "fairing/rule.hpp"
#include "filter/filter_parameters.hpp"

namespace nc {

struct MotionSettings {
  AccuracyParameters accuracy;  ///< of high-accuracy control (M700 13.15)
  FairingRule fairing;          ///< M700 13.17.1
  FilterParameters filters;     ///< behind interpolation (M700 7.7, 13.15)
  uint32_t index_axes = 0;      ///< bit i: axis i is one of an index table (M700 9.3)
  uint32_t machine_turn = 0;    ///< bit i: machine coordinates of axis i are shown within one turn (M700 14.13)
  bool operator==(const MotionSettings&) const = default;
};

/// So many may be under way at once. Between two moves with other parameters lies a mark at least: no more than one of two items that
/// compensation holds (32) brings its own. Fairing lets go before it takes a line with other ones, a corner has two lines, and what is on
/// its way to the sink is one block.
inline constexpr unsigned kMotionSettings = 32;

}  // namespace nc
