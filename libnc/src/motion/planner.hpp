// SPDX-License-Identifier: Apache-2.0
// The planner (feeder thread): gives every committed segment its limits and its exit speed, so that the scan
// can always come to rest at the end of what it has been shown.
//
// Exit speeds come from one backward pass over the segments, in squares of speed, where braking is a straight
// line:
//     exit2[last] = 0,   exit2[k] = min( joint2[k], exit2[k+1] + 2 a[k+1] L[k+1] )
// joint2[k] is the smallest of: the corner's speed, the speed limits of both neighbours, both feeds times the
// override; 0 where the path must rest. A pass that starts at new segments ends at the first one whose exit
// speed it does not change.
//
// The last segment is held back until the record behind it tells how it ends (docs/motion.md, "Why one
// segment waits").
#pragma once

#include "motion/dry_run.hpp"
#include "motion/limits.hpp"
#include "motion/plan.hpp"
#include "ring/record.hpp"

namespace nc {

class Planner {
 public:
  /// What the scan last said.
  struct Inputs {
    double feed_override = 1;
    DryFeeds dry;
    bool single_block = false;  ///< every mark that allows a stop is a place of rest
    uint32_t tail = 0;          ///< ring index of the record in execution
    uint32_t ordinal = 0;       ///< ordinal of the segment in execution, or of the next one
  };

  void create(const MotionLimits& limits, Record* ring, uint32_t capacity, Arena& arena);

  /// The record at ring index `index` (the next one) has been written: computes its limits.
  void commit(uint32_t index);

  /// Brings the plan up to date and publishes it when something has changed.
  void replan(const Inputs& in);

  /// Forget the records from ring index `end` on; the path rests at what is left. The scan is at rest and
  /// waits.
  void truncate(uint32_t end, const Inputs& in);

  /// For tests: records and segments are counted from here. Before anything is committed.
  void count_from(uint32_t first) {
    head_ = next_ordinal_ = planned_ = shown_ = seen_head_ = first;
    exchange_.count_from(first);
  }

  const Plan& newest() NC_RT { return exchange_.newest(); }

 private:
  /// The planner's own view of a segment.
  struct Entry {
    double corner2 = 0;      ///< exit: what geometry allows
    double feed = 0;         ///< mm/s at 100 %; HUGE_VAL where no feed holds
    double limit = 0;        ///< mm/s
    double gain = 0;         ///< 2 a L
    double joint2 = 0;       ///< exit: what geometry, limits and feeds at the present override allow
    double dry_limit = -1;   ///< mm/s in dry run; below 0: it does not concern the segment, or not its corners
    bool constant = false;   ///< feed without override (skip)
    bool stop_mark = false;  ///< a mark at its end lets single block stop
  };
  struct Tip {  ///< the segment committed last
    uint32_t record = 0, ordinal = 0;
    SegmentShape shape;
    AxisVec reserve;       ///< shares reserved for its start
    double entry = 0;      ///< speed of the corner at its start, mm/s
    unsigned between = 0;  ///< other records committed behind it
    bool open = false;     ///< its end is not known: held back, its record is still there
    bool valid = false;
    bool thread = false;   ///< it goes with the spindle
  };

  Record& record(uint32_t index) const { return ring_[index & mask_]; }
  Entry& entry(uint32_t ordinal) const { return entry_[ordinal & mask_]; }
  void commit_segment(uint32_t index);
  bool must_rest(const Record& from, const Record& to) const;
  void add_turn(const Segment& from, const Segment& to, const SegmentShape& shape);
  void close(const Joint& exit, const AxisVec& reserve);
  double cap(const Entry& e) const;
  void update_joint(uint32_t ordinal);
  uint32_t backward(uint32_t begin, uint32_t end, bool all);
  void publish(uint32_t begin, uint32_t changed);

  MotionLimits limits_;
  Record* ring_ = nullptr;
  Entry* entry_ = nullptr;
  double* exit2_ = nullptr;
  uint32_t mask_ = 0;
  uint32_t head_ = 0;  ///< ring index behind the last committed record
  uint32_t next_ordinal_ = 0;
  uint32_t planned_ = 0;    ///< ordinal behind the last segment that has an exit speed
  uint32_t shown_ = 0;      ///< ring index that the last published plan ends at
  uint32_t seen_head_ = 0;  ///< head_ at the last replan()
  double override_ = 1;
  DryFeeds dry_;
  bool single_block_ = false;
  Tip tip_;
  RecentTurns turns_;  ///< in front of what comes behind the tip
  PlanExchange exchange_;
};

}  // namespace nc
