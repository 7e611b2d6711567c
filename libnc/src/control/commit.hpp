// SPDX-License-Identifier: Apache-2.0
// Commit: the last stage before the sinks. It gives an item its serial, transforms it to machine coordinates and checks the stroke limits. An item
// that has been committed never changes.
#pragma once

#include <cmath>
#include <cstring>

#include "base/intern_pool.hpp"
#include "control/stages.hpp"
#include "dialect/rules.hpp"
#include "filter/filter_parameters.hpp"
#include "frame/affine.hpp"
#include "frame/stroke_box.hpp"
#include "nc/control.h"
#include "nc/run.h"
#include "path/shape_ahead.hpp"
#include "ring/record.hpp"

namespace nc {

struct CommitConfig {
  const nc_system_config* system = nullptr;
  const InternPool<StrokeBox>* stroke_boxes = nullptr;  ///< the prohibited areas that moves name by number
  uint32_t marks = 1024;      ///< marks that can be rewound to, power of two
  uint32_t records = 1024;    ///< records that may be under way between here and the scan
  double cycle_s = 0.001;
  const MotionRules* rules = nullptr;  ///< rules of the controller family
  bool filters = false;       ///< there are filters behind interpolation
  FilterTimes rounding;       ///< filter for cuts in high-accuracy control for which the parameters give none
  bool rotary_makes_length = false;  ///< F is the composite speed of all axes, in which a degree counts as a millimetre (M700 7.6)
};

/// A place to rewind to, right behind a mark.
struct MarkPoint {
  Serial serial = 0;
  BlockSeq seq = 0;
  AxisVec machine;
  uint8_t stages = 0;  ///< bit k: stage k of the row needs something to go on from here, see Commit::resume()
};

/// What a move names by number. For items of other kinds it is not used.
struct Named {
  const Affine* to_machine;
  const MoveShape* shape;          ///< nullptr: none
  const MotionSettings* settings;
};

enum class Committed : uint8_t {
  yes,
  nothing,       ///< the item is a move without length: it is left out
  unknown_area,  ///< G22 is in force and no area is known: nothing was committed
  prohibited,    ///< the move starts or ends in the area of G22: nothing was committed
  displaced,     ///< the axes are not where the curve of the move begins: nothing was committed
  at_pole,       ///< the rotary axis of polar coordinate interpolation would jump: nothing was committed
  soft_limit     ///< the move would leave the stroke: nothing was committed, `limit_axis()` says which axis
};

class Commit {
 public:
  void create(const CommitConfig& config, Arena& arena);

  /// Sets where the machine stands before the next move.
  void set_machine(const AxisVec& machine) { machine_ = machine; }
  const AxisVec& machine() const { return machine_; }
  /// The machine has been moved to this place at the newest mark: a program that goes back to that mark begins here, too.
  void displace(const AxisVec& machine) {
    machine_ = machine;
    rounded_at_ = {};
    rounding_ = {};
    if (mark_count_ != 0) marks_[(mark_count_ - 1) & mark_mask_].machine = machine;
  }
  /// The same in a block stop. The program knows nothing of `rounding`, by which the time-optimal mode has left the axes beside the end of the block: the next move begins there all the same.
  void displace(const AxisVec& machine, const AxisVec& rounding) {
    displace(machine);
    rounded_at_ = machine;
    rounding_ = rounding;
  }
  /// Takes back what these stages have kept to go on from the newest mark: they will not go on that way.
  void forget_stages(uint8_t which) {
    if (mark_count_ != 0) marks_[(mark_count_ - 1) & mark_mask_].stages &= static_cast<uint8_t>(~which);
  }
  /// Changes what a stage needs to go on from the newest mark.
  template <class Stage>
  void change_stage(const typename Stage::Resume& resume) {
    if (mark_count_ == 0) return;
    constexpr size_t kPlace = Stages::place_of<Stage>();
    MarkPoint& newest = marks_[(mark_count_ - 1) & mark_mask_];
    newest.stages = static_cast<uint8_t>(newest.stages & ~(1u << kPlace));
    if (!in_force(resume)) return;
    newest.stages = static_cast<uint8_t>(newest.stages | 1u << kPlace);
    std::get<kPlace>(resumes_[&newest - marks_].of) = resume;
  }
  void restart() {
    last_serial_ = 0;
    mark_count_ = 0;
  }

  /// Gives the item its serial, and makes the curve of a move: machine_, start_, circle_ and curve_.
  Committed commit(const Item& item, const Named& named);
  /// What commit() changes, kept to be put back after items have only been tried.
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
  /// What commit() would answer. The next move that is tried begins where this one ends.
  Committed try_item(const Item& item, const Named& named) {
    const uint64_t shapes = shape_count_;
    const Committed committed = commit(item, named);
    shape_count_ = shapes;
    return committed;
  }
  /// Makes a part of what commit() will need for a move with such a shape, and takes from `left` what that is in instructions. @return whether all is there
  bool make_ahead(const Move& move, const MoveShape& shape, int64_t* left);
  /// False when every place for a shape is taken by one that the scan may still evaluate: records from `tail` up to `head` are under way.
  bool shape_room(uint32_t tail, uint32_t head) const;
  /// The curve just committed, which is a move, goes into record number `record`.
  void note_record(uint32_t record);
  const Curve& curve() const { return curve_; }
  /// The item just committed is `mark`. Remembers it as a place to rewind to, if it is one; no stage needs anything to go on from there.
  void remember(const Item& mark) {
    if (mark.mark.resume) add_point(mark).stages = 0;
  }
  /// Remembers a mark in the same way, where the stages need `stages` to go on behind it.
  void remember(const Item& mark, const Stages::Resume& stages) {
    if (!mark.mark.resume) return;
    MarkPoint& point = add_point(mark);
    point.stages = stages.stages;
    resumes_[&point - marks_].take(stages);
  }

  /// The item just committed, as a sink sees it.
  void to_public(const Item& item, nc_item* out) const;
  /// Adds the move just committed, which is `move`, to what has been passed over.
  void count_move(const Move& move, nc_passed* passed) const {
    double feed = move.feed_mm_min;
    if (move.feed_mm_rev > 0 && move.kind != NC_MOVE_TAP) feed = move.feed_mm_rev * passed->spindle_rev_min;
    if (move.kind == NC_MOVE_THREAD || move.plane_feed) [[unlikely]] feed *= path_by_feed(move);
    if (move.kind == NC_MOVE_RAPID) feed = passed->rapid_mm_min;
    if (feed > 0) passed->seconds += curve_.length / feed * 60;
    passed->length += curve_.length;
    static_assert(sizeof passed->machine == sizeof machine_);
    std::memcpy(&passed->machine, &machine_, sizeof machine_);
  }
  /// Commits a line along one axis that is only counted, and gives its length. False: commit() has to say what becomes of it.
  bool commit_stroke(unsigned axis, double to, double* length) {
    const nc_axis_config& limits = config_.system->axis[axis];
    if (limits.soft_limited && (to > limits.soft_max || to < limits.soft_min)) return false;
    *length = std::fabs(to - machine_[axis]);  // in binary arithmetic the root of a square is its number, to the last bit
    if (*length < kNoLength) return false;
    machine_[axis] = to;
    ++last_serial_;
    return true;
  }
  /// Short forms of commit() and to_public() for a mark, to which commit() gives only its serial.
  void commit_mark() { ++last_serial_; }
  void mark_to_public(const Item& item, nc_item* out) const;
  /// The item just committed, as a record for the ring.
  void to_record(const Item& item, const Named& named, Record* out);

  /// Notes in a segment, whose curve is set, which index tables it moves. A segment that moves one begins and ends at rest.
  void set_index_axes(Segment* segment) const {
    segment->index_axes = index_axes(segment->curve);
    if (segment->index_axes != 0) segment->rest_before = segment->exact_stop = true;
  }

  /// The move just committed turns an index table.
  bool moves_tables() const { return index_axes(curve_) != 0; }

  /// ... is an arc beside which the axes may go (M700 13.15).
  bool rounds() const { return curve_.circular && (settings_->filters.round_mm[curve_.h] != 0 || settings_->filters.round_mm[curve_.v] != 0); }

  /// Takes the item just committed back, which has not been executed; `move`: it is a move. put_back() undoes it.
  void take_back(bool move) {
    taken_end_ = machine_;
    if (move) machine_ = start_;
    --last_serial_;
  }
  void put_back(bool move) {
    if (move) machine_ = taken_end_;
    ++last_serial_;
  }
  /// The serials to come follow `serial`, and the machine stands at `machine`.
  void go_on(Serial serial, const AxisVec& machine) {
    last_serial_ = serial;
    displace(machine);
  }
  /// Takes the serial of the item just committed back: the item has been executed before, under another serial.
  void uncount() { --last_serial_; }

  Serial serial() const { return last_serial_; }
  int8_t limit_axis() const { return limit_axis_; }
  const MarkPoint* find(Serial serial) const;
  /// What the stages need to go on from a point that find() has given, when its `stages` are not 0.
  const Stages::Resume& resume(const MarkPoint& point) const { return resumes_[&point - marks_]; }
  const MarkPoint* newest() const { return mark_count_ == 0 ? nullptr : &marks_[(mark_count_ - 1) & mark_mask_]; }
  /// Back to `point`: the machine stands there, and the serials to come follow that of the point.
  void rewind_to(const MarkPoint& point);

 private:
  MarkPoint& add_point(const Item& mark) {
    MarkPoint& point = marks_[mark_count_++ & mark_mask_];
    point.serial = last_serial_;
    point.seq = mark.mark.seq;
    point.machine = machine_;
    return point;
  }
  bool enters(const StrokeBox& box) const;
  bool begins_elsewhere(const Move& move) const;
  bool begin_on_rounding(const Move& move);
  bool inside_limits(const Curve& curve);
  void add_held_axes(const Curve& curve, AxisVec* from, AxisVec* low, AxisVec* high);
  void commit_shape(const Move& move, const Affine& to_machine, const MoveShape& shape);
  double path_by_feed(const Move& move) const;
  double along_longest() const;
  void set_tap(const Move& move, Segment* s) const;
  void set_rule(const FeedRule& rule, bool dry_rapid, bool is_tap, Segment* segment);
  void set_filter(const Move& move, const FilterParameters& filters, Segment* segment) const;
  bool turns_round(bool checked);
  void circle_to_public(nc_move* out) const;
  void space_arc_to_public(nc_move* out) const;
  void tilted_arc_to_public(const Move& move, nc_move* out) const;
  double helix_slope() const;
  uint8_t moved_tables(const Curve& curve) const;
  uint8_t index_axes(const Curve& curve) const { return settings_->index_axes == 0 ? uint8_t{0} : moved_tables(curve); }

  CommitConfig config_;
  unsigned axis_count_ = 3;
  uint32_t rotary_ = 0, length_rotary_ = 0;  ///< bit i: axis i is rotary; ... and does not count in the length of a path
  uint32_t limited_ = 0;     ///< bit i: axis i has a limit of acceleration
  bool any_limit_ = false;
  static inline constexpr MotionSettings kNoSettings{};
  const MotionSettings* settings_ = &kNoSettings;  ///< of the move just committed
  AxisVec machine_;
  AxisVec rounded_at_, rounding_;  ///< where the axes were moved to by hand, and how far beside the program they stood before that
  AxisVec start_;            ///< start of the move just committed
  AxisVec taken_end_;        ///< end of the move that was taken back
  Circle circle_;            ///< of the move just committed, machine coordinates
  Curve curve_;
  /// The shapes of moves, in a ring. The place of a shape is free when its record has been executed or given up.
  CurveShape* shapes_ = nullptr;
  const MoveShape arc_in_space_{};  ///< the shape of an arc whose plane is tilted by the map to the machine: plain, so that the map makes the tilt
  ShapeAhead ahead_;
  uint32_t* shape_record_ = nullptr;
  uint32_t shape_mask_ = 0;
  uint64_t shape_count_ = 0;
  AxisVec exit_;             ///< tangent at the end of the last move put into the ring, where reversals are checked
  bool exit_known_ = false;
  Serial last_serial_ = 0;
  int8_t limit_axis_ = -1;
  MarkPoint* marks_ = nullptr;
  Stages::Resume* resumes_ = nullptr;  ///< one for each of marks_. Nearly no mark needs it, so it is kept apart: marks_, written in every block, stay in
                                       ///< the cache
  uint32_t mark_mask_ = 0;
  uint64_t mark_count_ = 0;
};

}  // namespace nc
