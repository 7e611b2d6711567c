// SPDX-License-Identifier: Apache-2.0
// A move as it is committed: its curve in axis coordinates, and what planner and interpolator have to know of it.
#pragma once

#include "filter/filter_times.hpp"
#include "frame/affine.hpp"
#include "path/curve.hpp"
#include "ring/accuracy_limits.hpp"
#include "stream/stream.hpp"

namespace nc {

/// Committed geometry and its own speed limits. The plan over it (motion/plan.hpp) may change, a segment never does.
struct Segment {
  Curve curve;
  Affine to_work;        ///< from machine coordinates to the workpiece coordinates that the display shows
  double feed_mm_s = 0;  ///< commanded path speed; 0 for rapid
  double feed_mm_rev = 0;        ///< feed per revolution; 0 = the feed is per time
  bool rapid = false;
  bool exact_stop = false;       ///< the path comes to rest at its end
  uint8_t skip_mask = 0;  ///< skip: the signals that end it, bit n = signal n+1
  bool skip = false;
  bool skip_away = false; ///< skip: ends where these signals are off
  bool ended_by(uint32_t signals) const { return skip && ((signals & skip_mask) != 0) != skip_away; }
  const SkipSpeeds* skip_speeds = nullptr;  ///< skip: signals that change its feed; feed_mm_s is then the fastest feed
  double start_feed_mm_s = 0;               ///< feed with which it begins: feed_mm_s, unless there are skip_speeds
  bool thread = false;       ///< goes with the spindle; override and feed hold do not act (M700 6.7.1)
  float thread_angle = 0;    ///< angle of the spindle where the thread starts, deg
  double feed_end_mm_s = 0;  ///< the feed changes evenly to this at the end; 0 = it does not change
  uint8_t feed_digit = 0;    ///< n + 1: commanded as the one-digit feed Fn (M700 7.3); 0 = not
  bool fixed_override = false;  ///< the feed override does not act (G63)
  bool dry = false;             ///< the feed of dry run acts in the place of its own (M700 7.4 note 4)
  bool flows = false;           ///< rapid traverse: the path goes on at speed where what is behind begins with its direction
  bool rest_before = false;     ///< the path comes to rest where it begins
  float digit_most_mm_s = 0, digit_step_mm_s = 0;  ///< F1 to F5: what the handle may make of the feed, and by one pulse
  float slow_zone = 0, slow_factor = 1;            ///< the feed over this length before the end (M700 7.10)
  float corner_reach = 0;                          ///< so far behind the corner may lie that the feed is for, mm
  uint8_t index_axes = 0;    ///< bit i: axis i of an index table is moved and has to be unclamped (M700 9.3)
  uint8_t unclamps = 0;      ///< and these are unclamped meanwhile, for the move behind
  double tap_rev_per_mm = 0;    ///< synchronous tap: the spindle turns so much with the path, forward positive; 0 = none
  double tap_acceleration = 0;  ///< highest along it, mm/s^2; 0 = that of the axes
  double begun = 0;          ///< so much of its length has been gone before an interrupt (M700 13.12), mm
  AccuracyLimits accuracy;   ///< of high-accuracy control
  FilterTimes filter;        ///< behind interpolation
  float round_mm[2] = {};    ///< arc: radius compensation of its two axes (M700 13.15, #2069), mm outwards
  bool rounds() const { return round_mm[0] != 0.0f || round_mm[1] != 0.0f; }
  // set by the planner when the segment is committed
  double speed_limit = 0;  ///< mm/s: path speed at which some axis reaches its limit of velocity, or by curvature its limit of
                           ///< acceleration
  double acceleration = 0;  ///< mm/s^2: largest path acceleration that keeps the limits of every axis
  double dry_limit = 0;     ///< mm/s: and up to here it does so in dry run
  uint32_t ordinal = 0;     ///< number of the segment, which names it in the plan
};

}  // namespace nc
