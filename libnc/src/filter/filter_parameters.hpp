// SPDX-License-Identifier: Apache-2.0
// What decides which filters act behind interpolation (docs/motion.md, "Behind interpolation"): the parameters, and the move. The choice itself is a rule
// of the family (MotionRules in dialect/rules.hpp).
#pragma once

#include "filter/filter_times.hpp"

namespace nc {

/// Time constants for one kind of move, for each axis, ms; 0 = none.
struct TimeConstants {
  double linear_ms[kMaxAxes] = {};
  double exponential_ms[kMaxAxes] = {};
  bool operator==(const TimeConstants&) const = default;
};

/// The parameters that concern filters.
struct FilterParameters {
  bool any = false;             ///< true: one of the members below is not 0
  TimeConstants cut;            ///< #2007 G1tL, #2008 G1t1
  TimeConstants rapid;          ///< #2004 G0tL, #2005 G0t1
  TimeConstants skip;           ///< #2102 skip_tL, #2103 skip_t1
  double pattern_cut_ms = 0;    ///< #1568 SfiltG1
  double pattern_rapid_ms = 0;  ///< #1569 SfiltG0
  double pattern_second_ms = 0; ///< #1570 Sfilt2
  bool rapid_before = false;    ///< #1205 G0bdcc: rapid traverse is accelerated before interpolation, too
  double round_mm[kMaxAxes] = {};  ///< #2069 Rcoeff while #8107 and #8108 are on: mm by which arcs are moved outwards
  bool operator==(const FilterParameters&) const = default;
};

/// The move for which filters are chosen.
struct FilteredMove {
  enum class Kind : uint8_t { cut, rapid, skip } kind = Kind::cut;
  bool high_accuracy = false;
  bool straight = true;
  uint32_t moving = 0;   ///< bit i: axis i moves
  uint32_t limited = 0;  ///< bit i: axis i has a limit of acceleration
};

/// Highest speed, mm/s, at which the filters keep an axis within `acceleration`; infinite where the filters do not limit the acceleration.
double filter_speed(const FilterTimes& times, unsigned axis, double acceleration, double cycle_s);

}  // namespace nc
