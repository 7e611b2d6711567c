// SPDX-License-Identifier: Apache-2.0
// What the axis limits mean for one segment and for the joint between two: speeds and path accelerations that
// no axis limit is broken by, whatever the override does. docs/motion.md derives every formula in here.
#pragma once

#include "motion/axis_limits.hpp"
#include "motion/rounding.hpp"
#include "ring/segment.hpp"

namespace nc {

/// A scan crosses at most this many segments in one cycle: path speed <= kSegmentsPerCycle * length / cycle.
inline constexpr unsigned kSegmentsPerCycle = 16;
/// At most this many other records lie between two segments that are passed at speed; where there are more
/// the path comes to rest.
inline constexpr unsigned kRecordsBetween = 8;
/// Largest share of an axis' acceleration that the velocity steps at corners may take.
inline constexpr double kCornerShare = 0.75;
/// Largest share that centripetal acceleration may take on an arc; the rest (in quadrature) is left for
/// speeding up and braking.
inline constexpr double kArcShare = 0.9;
/// Share that the beginning and the end of circular error radius compensation may take, of kCornerShare where they meet a corner.
inline constexpr double kRoundShare = 0.2;
/// Path acceleration where no axis is limited, mm/s^2.
inline constexpr double kUnlimitedAcceleration = 1e9;

struct MotionLimits {
  unsigned axis_count = 3;
  AxisLimits axis[kMaxAxes];
  double cycle_s = 0.001;
  double max_feed_override = 2.0;
  AccuracyJointSpeed accuracy_joint_speed = nullptr;  ///< the family's; nullptr: it has no high-accuracy control
  bool dry = false;                                   ///< dry run is on: what is committed now may have any feed that its axes bear
  double tolerance = 0;                               ///< by which corners may be rounded behind interpolation, mm
};

/// What joints and limits need to know of a segment's geometry.
struct SegmentShape {
  AxisVec entry, exit;   ///< unit tangents d1 at the start and at the end
  AxisVec most;          ///< largest |d1| of each axis over the segment
  double curvature = 0;  ///< largest |d2| in the plane of an arc, 1/mm
  double in_plane = 0;   ///< largest |d1| in the plane of an arc
  double bend = 0;       ///< spiral: |d2| of the axes that go along is at most `most` times this, 1/mm
  bool dry = false;      ///< its feed is not the program's: MotionLimits::dry
  double reach = 0;      ///< no speed on this segment is ever higher, mm/s
  double round = 0;      ///< radius compensation by the radius: the larger of its two axes
};

/// Geometry and the highest speed of a segment.
SegmentShape shape_of(const Segment& segment, const MotionLimits& limits);

/// How the path passes from one segment to the next.
struct Joint {
  double speed2 = 0;  ///< (mm/s)^2; 0 = at rest
  double turn = 0;    ///< |t2 - t1| of the largest turn in the mean
  AxisVec share;      ///< of the acceleration of each axis, what the velocity step takes at that speed
};

/// The joint from a to b where nothing asks for rest. `turns` holds the corners up to and including that between a and b. Without it, or where no filter
/// behind interpolation rounds corners, the velocity steps within one cycle.
Joint joint_between(const Segment& a, const SegmentShape& sa, const Segment& b, const SegmentShape& sb,
                    const MotionLimits& limits, const RecentTurns* turns = nullptr);

/// The acceleration of a segment between two corners, passed at these speeds, where several of them may fall into one mean.
double even_acceleration(const Segment& segment, double entry, double exit, const MotionLimits& limits);

/// Shares of the axes' acceleration to reserve on a segment for what happens at (and shortly behind) one of
/// its ends.
AxisVec reserve_towards(const Joint& joint, const Segment& neighbour, const SegmentShape& shape,
                        const MotionLimits& limits);

/// Fills speed_limit and acceleration of a segment of which `share` is reserved for corner steps.
void set_segment_limits(Segment& segment, const SegmentShape& shape, const AxisVec& share,
                        const MotionLimits& limits);

}  // namespace nc
