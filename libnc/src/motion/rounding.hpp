// SPDX-License-Identifier: Apache-2.0
// Corners behind a mean of all axes (M700 13.15, S-pattern filter): how fast the path may pass them, by how far it turns within the time that the
// mean goes over. docs/motion.md, "Corners behind the mean", derives every formula in here.
#pragma once

#include "filter/filter_times.hpp"
#include "ring/segment.hpp"

namespace nc {

struct MotionLimits;

/// Largest share of an axis' acceleration that a corner may take that is alone in the mean, and that several corners behind the mean may take together.
inline constexpr double kAloneShare = 0.75, kRoundingShare = 0.85;
/// By this part of itself the speed may change within the mean where there are several corners.
inline constexpr double kUneven = 0.08;

/// The mean with which corners are rounded by the tolerance; kind none where that is no cycle, where some axis has no limit of acceleration, and with a
/// tolerance of 0.
FilterTimes rounding_filter(const MotionLimits& limits);

/// Seconds that the mean goes over: 0 where corners are not rounded by it.
double rounding_window(const Segment& segment, const MotionLimits& limits);

/// What to reserve of each axis' acceleration on a segment next to one that lies in the mean as a whole, where the corner between them takes `share`: corners
/// behind them, which are not known yet, fall into the same mean and may take as much. `turn` is Corner::turn.
AxisVec reserve_for_turns(const AxisVec& share, double turn, unsigned axes);

/// The directions that the path has had since the last rest, by the way that has been gone in them.
class RecentTurns {
 public:
  void clear() { count_ = 0, way_ = 0, began_ = 0, direction_ = {}; }
  /// A segment of this length has been travelled. It began with a corner that was passed at the speed `entry`, and ends with one in which the tangent
  /// changes by `turn`. Lengths below `grain` are kept together.
  void go(double length, double entry, double grain, const AxisVec& turn, unsigned axes);

  /// So much of each axis' acceleration is reserved on the segment that was travelled last.
  void reserve(const AxisVec& share, unsigned axes);

  struct Corner {
    double speed = 0;  ///< mm/s; 0: none
    double turn = 0;   ///< largest |t2 - t1| of the path that lies in the mean with it
    AxisVec share;     ///< of the acceleration of each axis that it takes
  };
  /// Where the last turn was: the highest speed, at most `most`, at which it and those in front of it stay within the tolerance and take no more than `part`
  /// of what corners may take, less `kept`, and nowhere more than is reserved.
  Corner corner(double most, double part, double kept, double window, const MotionLimits& limits) const;

 private:
  static constexpr unsigned kWays = 64;
  struct Way {
    AxisVec low, high;   ///< of the directions; a direction is the sum of all steps of the tangent, so that an arc has one
    AxisVec reserved;    ///< on each of its segments, of the acceleration of each axis
    double end = 0;      ///< way from the last rest to its end, mm
    double fastest = 0;  ///< of the corners at its beginning and inside it, mm/s
    bool turns = false;  ///< there are corners inside it
  };

  const Way& back(unsigned n) const { return ways_[(newest_ + kWays - n) % kWays]; }  ///< 0: the newest
  Way& back(unsigned n) { return ways_[(newest_ + kWays - n) % kWays]; }

  Way ways_[kWays];
  unsigned newest_ = 0;
  unsigned count_ = 0;
  double way_ = 0, began_ = 0;  ///< end and beginning of the newest way
  AxisVec direction_;           ///< behind the last turn
};

}  // namespace nc
