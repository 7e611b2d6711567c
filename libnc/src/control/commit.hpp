// SPDX-License-Identifier: Apache-2.0
// Commit: the last stage before the sinks. Gives an item its serial, takes it to machine coordinates, checks the stroke limits. What
// leaves here never changes.
#pragma once

#include "frame/stroke_box.hpp"
#include "frame/transform.hpp"
#include "nc/control.h"
#include "interpolate/record.hpp"
#include "motion/m700_accuracy.hpp"
#include "fairing/fairing.hpp"
#include "motion/m700_filters.hpp"
#include "offset/offset.hpp"
#include "path/shape.hpp"

namespace nc {

struct CommitConfig {
  const nc_system_config* system = nullptr;
  const InternPool<StrokeBox>* stroke_boxes = nullptr;  ///< that moves name
  const uint32_t* index_axes = nullptr;    ///< bit i: axis i is one of an index table (M700 9.3)
  const uint32_t* machine_turn = nullptr;  ///< bit i: machine coordinates of axis i are shown within one turn (M700 14.13)
  uint32_t marks = 1024;      ///< marks that can be rewound to, power of two
  uint32_t records = 1024;    ///< that may be under way behind here
  double cycle_s = 0.001;
  bool filters = false;       ///< there are filters behind interpolation
  bool rotary_makes_length = false;  ///< F of a line is composite: a degree counts as a millimetre (M700 7.6)
};

/// A place to rewind to: what the stages must know to go on right behind a mark. One stage at most holds items back.
struct MarkPoint {
  enum class Held : uint8_t { nothing, contour, lines };
  Serial serial = 0;
  BlockSeq seq = 0;
  AxisVec machine;
  Held held = Held::nothing;
  union {
    OffsetResume offset;    ///< contour
    FairingResume fairing;  ///< lines
  };
  MarkPoint() : offset() {}
};

enum class Committed : uint8_t {
  yes,
  nothing,       ///< the item vanishes: a move without length
  prohibited,    ///< it starts or ends in the area of G22: nothing was committed
  displaced,     ///< the axes are not where its curve begins: nothing was committed
  at_pole,       ///< the rotary axis of polar coordinate interpolation would jump: nothing was committed
  soft_limit     ///< the move would leave the stroke: nothing was committed, `limit_axis()` says which axis
};

class Commit {
 public:
  void create(const CommitConfig& config, Arena& arena);

  /// The machine stands here, before the next move.
  void set_machine(const AxisVec& machine) { machine_ = machine; }
  const AxisVec& machine() const { return machine_; }
  /// The same at the newest mark, and it holds for whoever goes back there.
  void displace(const AxisVec& machine) {
    machine_ = machine;
    if (mark_count_ != 0) marks_[(mark_count_ - 1) & mark_mask_].machine = machine;
  }
  /// The machine does not stand where fairing has brought it at the newest mark.
  void forget_fairing() {
    MarkPoint* point = newest_point();
    if (point != nullptr && point->held == MarkPoint::Held::lines) point->held = MarkPoint::Held::nothing;
  }
  void restart() {
    last_serial_ = 0;
    mark_count_ = 0;
  }

  /// `transform` and `shape` are what the move names (ignored for other items; nullptr = no shape). Fills the geometry members.
  Committed commit(const Item& item, const Transform& transform, const MoveShape* shape);
  /// What trying changes, to be put back behind it.
  struct Place {
    AxisVec machine, start;
    Circle circle;
    Curve curve;
    Serial serial = 0;
  };
  Place place() const { return {machine_, start_, circle_, curve_, last_serial_}; }
  void put_back(const Place& place) {
    machine_ = place.machine;
    start_ = place.start;
    circle_ = place.circle;
    curve_ = place.curve;
    last_serial_ = place.serial;
  }
  /// What commit() would say; the next one to be tried begins behind it.
  Committed try_item(const Item& item, const Transform& transform, const MoveShape* shape) {
    const uint64_t shapes = shape_count_;
    const Committed committed = commit(item, transform, shape);
    shape_count_ = shapes;
    return committed;
  }
  /// False when every place for a shape is taken by one that the scan may still evaluate: records from `tail` up to `head` are under way.
  bool shape_room(uint32_t tail, uint32_t head) const;
  /// The curve just committed, which is a move, goes into record number `record`.
  void note_record(uint32_t record);
  const Curve& curve() const { return curve_; }
  /// The item just committed is `mark`: a place to go back to, if it is one. Nothing is held back there.
  void remember(const Item& mark);
  /// The same where compensation or fairing holds items back.
  void remember(const Item& mark, const OffsetResume& offset);
  void remember(const Item& mark, const FairingResume& fairing);

  /// The item just committed, as a sink sees it.
  void to_public(const Item& item, nc_item* out) const;
  /// commit() and to_public() of a mark.
  void mark_to_public(const Item& item, nc_item* out);
  /// The same for the ring.
  /// `accuracy`: of the moves made under high-accuracy control.
  void to_record(const Item& item, const Transform& transform, const AccuracyParameters& accuracy, const FilterParameters& filters, Record* out);

  /// A segment that has its curve: the index tables that it moves, and that it begins and ends at rest then.
  void set_index_axes(Segment* segment) const {
    segment->index_axes = index_axes(segment->curve);
    if (segment->index_axes != 0) segment->rest_before = segment->exact_stop = true;
  }

  /// The item just committed has not been executed and is given up; `move`: it was one.
  void take_back(bool move) {
    taken_end_ = machine_;
    if (move) machine_ = start_;
    --last_serial_;
  }
  void put_back(bool move) {
    if (move) machine_ = taken_end_;
    ++last_serial_;
  }
  /// Serial numbers go on behind `serial`, the machine stands here.
  void go_on(Serial serial, const AxisVec& machine) {
    last_serial_ = serial;
    displace(machine);
  }
  /// It has been executed before under another serial.
  void uncount() { --last_serial_; }

  Serial serial() const { return last_serial_; }
  int8_t limit_axis() const { return limit_axis_; }
  const MarkPoint* find(Serial serial) const;
  const MarkPoint* newest() const { return mark_count_ == 0 ? nullptr : &marks_[(mark_count_ - 1) & mark_mask_]; }
  /// Serial numbers go on behind `point`.
  void rewind_to(const MarkPoint& point);

 private:
  MarkPoint* newest_point() { return mark_count_ == 0 ? nullptr : &marks_[(mark_count_ - 1) & mark_mask_]; }
  bool begins_elsewhere(const Move& move) const;
  bool inside_limits(const Curve& curve);
  void add_held_axes(const Curve& curve, AxisVec* from, AxisVec* low, AxisVec* high);
  void commit_shape(const Move& move, const Transform& transform, const MoveShape& shape);
  double along_longest() const;
  void set_rule(const FeedRule& rule, Segment* segment);
  void set_filter(const Move& move, const FilterParameters& filters, Segment* segment) const;
  bool turns_round(bool checked);
  void space_arc_to_public(nc_move* out) const;
  double helix_slope() const;
  uint8_t moved_tables(const Curve& curve) const;
  uint8_t index_axes(const Curve& curve) const { return *config_.index_axes == 0 ? uint8_t{0} : moved_tables(curve); }

  CommitConfig config_;
  unsigned axis_count_ = 3;
  uint32_t rotary_ = 0, line_rotary_ = 0;
  uint32_t limited_ = 0;     ///< bit i: axis i has a limit of acceleration
  bool any_limit_ = false;
  AxisVec machine_;
  AxisVec start_;            ///< of the move just committed
  AxisVec taken_end_;        ///< end of the move that was taken back
  Circle circle_;            ///< of the move just committed, machine coordinates
  Curve curve_;
  /// Shapes in a ring: one is free when its record has been executed or given up.
  CurveShape* shapes_ = nullptr;
  uint32_t* shape_record_ = nullptr;
  uint32_t shape_mask_ = 0;
  uint64_t shape_count_ = 0;
  AxisVec exit_;             ///< tangent at the end of the last move put into the ring, where reversals are checked
  bool exit_known_ = false;
  Serial last_serial_ = 0;
  int8_t limit_axis_ = -1;
  MarkPoint* marks_ = nullptr;
  uint32_t mark_mask_ = 0;
  uint64_t mark_count_ = 0;
};

}  // namespace nc
