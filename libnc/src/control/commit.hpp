// SPDX-License-Identifier: Apache-2.0
// Commit: the last stage before the sinks. Gives an item its serial, takes it to machine coordinates, checks the stroke limits. What
// leaves here never changes.
#pragma once

#include "base/intern_pool.hpp"
#include "control/stages.hpp"
#include "dialect/rules.hpp"
#include "filter/filter_parameters.hpp"
#include "frame/affine.hpp"
#include "frame/stroke_box.hpp"
#include "nc/control.h"
#include "path/shape.hpp"
#include "ring/record.hpp"

namespace nc {

struct CommitConfig {
  const nc_system_config* system = nullptr;
  const InternPool<StrokeBox>* stroke_boxes = nullptr;  ///< that moves name
  uint32_t marks = 1024;      ///< marks that can be rewound to, power of two
  uint32_t records = 1024;    ///< that may be under way behind here
  double cycle_s = 0.001;
  const MotionRules* rules = nullptr;  ///< of the family
  bool filters = false;       ///< there are filters behind interpolation
  FilterTimes rounding;       ///< of cuts in high-accuracy control whose parameters give no filter
  bool rotary_makes_length = false;  ///< F of a line is composite: a degree counts as a millimetre (M700 7.6)
};

/// A place to rewind to, right behind a mark.
struct MarkPoint {
  Serial serial = 0;
  BlockSeq seq = 0;
  AxisVec machine;
  uint8_t stages = 0;  ///< bit k: stage k of the row goes on from here in its own way, by Commit::resume()
};

/// What a move names by number. Of any other item nothing is looked at.
struct Named {
  const Affine* to_machine;
  const MoveShape* shape;          ///< nullptr: none
  const MotionSettings* settings;
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
  /// The machine has been moved to this place at the newest mark: a program that goes back to that mark begins here, too.
  void displace(const AxisVec& machine) {
    machine_ = machine;
    if (mark_count_ != 0) marks_[(mark_count_ - 1) & mark_mask_].machine = machine;
  }
  /// These stages go on otherwise from the newest mark: what they have kept for it is no more.
  void forget_stages(uint8_t which) {
    if (mark_count_ != 0) marks_[(mark_count_ - 1) & mark_mask_].stages &= static_cast<uint8_t>(~which);
  }
  void restart() {
    last_serial_ = 0;
    mark_count_ = 0;
  }

  /// Fills the geometry members.
  Committed commit(const Item& item, const Named& named);
  /// What trying changes, to be put back behind it.
  struct Place {
    AxisVec machine, start;
    Circle circle;
    Curve curve;
    Serial serial = 0;
    uint64_t shapes = 0;
  };
  Place place() const { return {machine_, start_, circle_, curve_, last_serial_, shape_count_}; }
  void put_back(const Place& place) {
    machine_ = place.machine;
    start_ = place.start;
    circle_ = place.circle;
    curve_ = place.curve;
    last_serial_ = place.serial;
    shape_count_ = place.shapes;
  }
  /// What commit() would say; the next one to be tried begins behind it.
  Committed try_item(const Item& item, const Named& named) {
    const uint64_t shapes = shape_count_;
    const Committed committed = commit(item, named);
    shape_count_ = shapes;
    return committed;
  }
  /// False when every place for a shape is taken by one that the scan may still evaluate: records from `tail` up to `head` are under way.
  bool shape_room(uint32_t tail, uint32_t head) const;
  /// The curve just committed, which is a move, goes into record number `record`.
  void note_record(uint32_t record);
  const Curve& curve() const { return curve_; }
  /// The item just committed is `mark`: a place to go back to, if it is one. No stage needs anything to go on from there.
  void remember(const Item& mark) {
    if (mark.mark.resume) add_point(mark).stages = 0;
  }
  /// The same of a mark behind which stages need `stages` to go on.
  void remember(const Item& mark, const Stages::Resume& stages) {
    if (!mark.mark.resume) return;
    MarkPoint& point = add_point(mark);
    point.stages = stages.stages;
    resumes_[&point - marks_].take(stages);
  }

  /// The item just committed, as a sink sees it.
  void to_public(const Item& item, nc_item* out) const;
  /// commit() of a mark, which has nothing but its serial, and to_public() of it.
  void commit_mark() { ++last_serial_; }
  void mark_to_public(const Item& item, nc_item* out) const;
  /// The same for the ring.
  void to_record(const Item& item, const Named& named, Record* out);

  /// A segment of the move just committed that has its curve: the index tables that it moves, and that it begins and ends at rest then.
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
  /// Of a point that find() has given, where its `stages` are not 0.
  const Stages::Resume& resume(const MarkPoint& point) const { return resumes_[&point - marks_]; }
  const MarkPoint* newest() const { return mark_count_ == 0 ? nullptr : &marks_[(mark_count_ - 1) & mark_mask_]; }
  /// Serial numbers go on behind `point`.
  void rewind_to(const MarkPoint& point);

 private:
  MarkPoint& add_point(const Item& mark) {
    MarkPoint& point = marks_[mark_count_++ & mark_mask_];
    point.serial = last_serial_;
    point.seq = mark.mark.seq;
    point.machine = machine_;
    return point;
  }
  bool begins_elsewhere(const Move& move) const;
  bool inside_limits(const Curve& curve);
  void add_held_axes(const Curve& curve, AxisVec* from, AxisVec* low, AxisVec* high);
  void commit_shape(const Move& move, const Affine& to_machine, const MoveShape& shape);
  double along_longest() const;
  void set_tap(const Move& move, Segment* s) const;
  void set_rule(const FeedRule& rule, Segment* segment);
  void set_filter(const Move& move, const FilterParameters& filters, Segment* segment) const;
  bool turns_round(bool checked);
  void space_arc_to_public(nc_move* out) const;
  void tilted_arc_to_public(const Move& move, nc_move* out) const;
  double helix_slope() const;
  uint8_t moved_tables(const Curve& curve) const;
  uint8_t index_axes(const Curve& curve) const { return settings_->index_axes == 0 ? uint8_t{0} : moved_tables(curve); }

  CommitConfig config_;
  unsigned axis_count_ = 3;
  uint32_t rotary_ = 0, line_rotary_ = 0;
  uint32_t limited_ = 0;     ///< bit i: axis i has a limit of acceleration
  bool any_limit_ = false;
  static inline constexpr MotionSettings kNoSettings{};
  const MotionSettings* settings_ = &kNoSettings;  ///< of the move just committed
  AxisVec machine_;
  AxisVec start_;            ///< of the move just committed
  AxisVec taken_end_;        ///< end of the move that was taken back
  Circle circle_;            ///< of the move just committed, machine coordinates
  Curve curve_;
  /// Shapes in a ring: one is free when its record has been executed or given up.
  CurveShape* shapes_ = nullptr;
  const MoveShape arc_in_space_{};  ///< an arc of a plane that the map to the machine tilts: the move's own, in front of that map
  uint32_t* shape_record_ = nullptr;
  uint32_t shape_mask_ = 0;
  uint64_t shape_count_ = 0;
  AxisVec exit_;             ///< tangent at the end of the last move put into the ring, where reversals are checked
  bool exit_known_ = false;
  Serial last_serial_ = 0;
  int8_t limit_axis_ = -1;
  MarkPoint* marks_ = nullptr;
  Stages::Resume* resumes_ = nullptr;  ///< beside each of them: nearly none has one, and those that are written in every block stay in the cache
  uint32_t mark_mask_ = 0;
  uint64_t mark_count_ = 0;
};

}  // namespace nc
