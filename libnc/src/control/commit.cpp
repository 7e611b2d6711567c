// SPDX-License-Identifier: Apache-2.0
#include "control/commit.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include "base/same_place.hpp"
#include "base/units.hpp"
#include "frame/rotary.hpp"

namespace nc {
namespace {

/// A circle in machine coordinates, where the map from the compensated path to the machine keeps its plane. That map may turn and reflect but never
/// stretch: it would stretch the radius of the tool together with the path.
Circle map_circle(const Circle& c, const Affine& map, unsigned h, unsigned v) {
  Circle m = c;
  AxisVec center;
  center[h] = c.center[0];
  center[v] = c.center[1];
  center = map.apply(center);
  m.center[0] = center[h];
  m.center[1] = center[v];
  if (map.only_translates()) return m;
  const double turned = std::atan2(map.coefficient(v, h), map.coefficient(h, h));
  const bool reflected = map.reflects(h, v);
  m.angle_start = turned + (reflected ? -c.angle_start : c.angle_start);
  if (reflected) m.sweep = -c.sweep;
  return m;
}

/// Full turns in addition to the arc that first reaches the end point. Compensation may have made the arc longer than programmed.
uint32_t extra_turns(double sweep) {
  constexpr double kNoise = 1e-7;  // turns
  const double turns = std::ceil(std::fabs(sweep) / (2 * kPi) - kNoise) - 1;
  return turns > 0 ? static_cast<uint32_t>(turns) : 0;
}

/// Largest share of each axis in the direction of the path. It is exact on lines; on any other curve it is taken as 1 for each axis that moves.
AxisVec shares_of(const Curve& curve, unsigned axis_count) {
  AxisVec share;
  const bool straight = !curve.circular && curve.shape == nullptr;
  for (unsigned i = 0; i < axis_count; ++i) {
    const bool turns = curve.circular && (i == curve.h || i == curve.v);
    share[i] = straight ? std::fabs(curve.delta[i]) / curve.length : turns || curve.delta[i] != 0 ? 1.0 : 0.0;
  }
  return share;
}

/// What high-accuracy control needs to know of this move.
AccuracyMove accuracy_move(const Move& move, const Curve& curve, const Circle& circle, unsigned axis_count) {
  AccuracyMove m;
  m.axis_count = axis_count;
  m.share = shares_of(curve, axis_count);
  m.rapid = move.kind == NC_MOVE_RAPID;
  m.circular = move.circular;
  if (move.circular) m.radius_mm = std::fmin(circle.radius_start, circle.radius_end);
  m.speed_clamp_mm_s = static_cast<double>(move.speed_clamp);
  m.judged_turn = move.judged_turn;
  m.fine_segments = (move.high_accuracy & kFineSegmentsOn) != 0;
  return m;
}

nc_axes to_axes(const AxisVec& a) {
  nc_axes out;
  std::memcpy(out.v, a.v, sizeof(out.v));
  return out;
}

}  // namespace

void Commit::create(const CommitConfig& config, Arena& arena) {
  config_ = config;
  length_rotary_ = 0;
  axis_count_ = config.system->axis_count;
  for (unsigned i = 0; i < axis_count_; ++i) {
    if (config.system->axis[i].rotary) rotary_ |= 1u << i;
    if (config.system->axis[i].max_acceleration > 0) limited_ |= 1u << i;
    any_limit_ = any_limit_ || config.system->axis[i].soft_limited;
  }
  if (!config.rotary_makes_length) length_rotary_ = rotary_;
  marks_ = arena.make_blank<MarkPoint>(config.marks);
  resumes_ = arena.make<Stages::Resume>(config.marks);
  constexpr uint32_t kMostShapes = 256;
  shape_mask_ = (config.records < kMostShapes ? config.records : kMostShapes) - 1;
  shapes_ = arena.make<CurveShape>(shape_mask_ + 1);
  shape_record_ = arena.make<uint32_t>(shape_mask_ + 1);
  mark_mask_ = config.marks - 1;
}

/// M700 6.16 (5): an axis that G07 holds does not move. Its stroke limits are still checked, for the way that is commanded.
void Commit::add_held_axes(const Curve& curve, AxisVec* from, AxisVec* low, AxisVec* high) {
  CurveShape& shape = shapes_[shape_count_ & shape_mask_];
  const uint8_t held = shape.what.map.frozen;
  Curve commanded = curve;
  AxisVec commanded_low, commanded_high;
  shape.what.map.frozen = 0;
  const AxisVec from_here = shape.to_machine.apply(shape.base.start);
  for (unsigned i = 0; i < axis_count_; ++i)
    if (((held >> i) & 1) != 0) commanded.start[i] = from_here[i];
  commanded.end = curve_position(commanded, commanded.length, axis_count_);
  curve_bounds(commanded, axis_count_, &commanded_low, &commanded_high);
  shape.what.map.frozen = held;
  for (unsigned i = 0; i < axis_count_; ++i) {
    if (((held >> i) & 1) == 0) continue;
    (*from)[i] = commanded.start[i];
    (*low)[i] = commanded_low[i];
    (*high)[i] = commanded_high[i];
  }
}

/// Stored stroke limits, checked over the whole curve before it moves.
bool Commit::inside_limits(const Curve& curve) {
  constexpr double kOnTheLimit = 1e-6;  // mm: standing on a limit is inside
  AxisVec low, high, start = curve.start;
  curve_bounds(curve, axis_count_, &low, &high);
  if (curve.shape != nullptr && curve.shape->what.map.frozen != 0) add_held_axes(curve, &start, &low, &high);
  for (unsigned i = 0; i < axis_count_ && settings_->machine_turn != 0; ++i) {
    if (((settings_->machine_turn >> i) & 1) == 0 || !config_.system->axis[i].soft_limited) continue;
    const nc_axis_config& axis = config_.system->axis[i];
    const double away = 360 * turns_outside(start[i], axis.soft_min, axis.soft_max);
    start[i] -= away;
    low[i] -= away;
    high[i] -= away;
  }
  for (unsigned i = 0; i < axis_count_; ++i) {
    const nc_axis_config& axis = config_.system->axis[i];
    if (!axis.soft_limited) continue;
    // A move that starts outside of its limits may lead back towards them.
    const double from = start[i];
    const bool above = high[i] > axis.soft_max + kOnTheLimit && high[i] > from + kOnTheLimit;
    const bool below = low[i] < axis.soft_min - kOnTheLimit && low[i] < from - kOnTheLimit;
    if (above || below) {
      limit_axis_ = static_cast<int8_t>(i);
      return false;
    }
  }
  return true;
}

bool Commit::shape_room(uint32_t tail, uint32_t head) const {
  if (shape_count_ <= shape_mask_) return true;
  const uint32_t record = shape_record_[shape_count_ & shape_mask_];
  return record - tail >= head - tail;
}

void Commit::note_record(uint32_t record) {
  if (curve_.shape != nullptr) shape_record_[(shape_count_ - 1) & shape_mask_] = record;
}

/// A curve of any other shape than a line or a circle of the axes.
void Commit::commit_shape(const Move& move, const Affine& to_machine, const MoveShape& shape) {
  circle_ = Circle{};
  if (move.circular) circle_ = map_circle(move.circle, to_machine, move.plane_axis[0], move.plane_axis[1]);
  const AxisMap& map = shape.map;
  for (unsigned i = 0; i < 2 && map.kind == AxisMap::Kind::cylinder && move.circular; ++i) {
    const unsigned axis = map.rotary;
    if (move.plane_axis[i] == axis) circle_.center[i] = to_machine.on_axis(axis, move.circle.center[i] / map.scale);
  }
  const PlainMove plain{&move.start, &move.end, move.circular ? &move.circle : nullptr, move.plane_axis[0], move.plane_axis[1]};
  make_shaped(shape, plain, to_machine, machine_, axis_count_, length_rotary_, &shapes_[shape_count_ & shape_mask_], &curve_, &ahead_);
}

bool Commit::make_ahead(const Move& move, const MoveShape& shape, int64_t* left) {
  return ahead_.go_on(shape, {&move.start, &move.end, nullptr, move.plane_axis[0], move.plane_axis[1]}, axis_count_, length_rotary_, left);
}

/// The curve of the move does not begin where the axes are, so that they would jump. It cannot happen to a line, which is made from the place of
/// the axes. An arc or a shape is made from what its block says, and since then the axes may have been moved by hand, or stand beside the
/// programmed path because of radius compensation.
bool Commit::begins_elsewhere(const Move& move) const {  // a shape, or an arc
  constexpr double kNoJump = 1e-4;  // mm or deg: far above rounding, far below a step of any cycle
  if (curve_.shape != nullptr) return leaves_from(curve_, axis_count_) > kNoJump;
  const double h = circle_.center[0] + circle_.radius_start * std::cos(circle_.angle_start) - machine_[move.plane_axis[0]];
  const double v = circle_.center[1] + circle_.radius_start * std::sin(circle_.angle_start) - machine_[move.plane_axis[1]];
  return std::fabs(h) > kNoJump || std::fabs(v) > kNoJump;
}

/// An arc behind a block stop on the rounding of a corner begins beside its programmed start by that rounding, where the axes were moved by hand there, as a line does: about its centre from where they are to its
/// end. False: they are elsewhere, or the arc is no larger than the rounding.
bool Commit::begin_on_rounding(const Move& move) {
  constexpr double kLarger = 10;
  const unsigned h = move.plane_axis[0], v = move.plane_axis[1];
  if (machine_[h] != rounded_at_[h] || machine_[v] != rounded_at_[v]) return false;
  const AxisVec place = machine_;
  machine_[h] -= rounding_[h];
  machine_[v] -= rounding_[v];
  const bool elsewhere = begins_elsewhere(move);
  machine_ = place;
  if (elsewhere || std::fmin(circle_.radius_start, circle_.radius_end) < kLarger * std::hypot(rounding_[h], rounding_[v])) return false;
  const double to_h = machine_[h] - circle_.center[0], to_v = machine_[v] - circle_.center[1];
  const double ahead = std::remainder(std::atan2(to_v, to_h) - circle_.angle_start, 2 * kPi);
  if (std::fabs(ahead) >= std::fabs(circle_.sweep)) return false;
  circle_.radius_start = std::hypot(to_h, to_v);
  circle_.angle_start += ahead;
  circle_.sweep -= ahead;
  return true;
}

/// HX 15.5.3: a place of the curve between its ends is prohibited. Curves are looked at in pieces, which differ from their chords by less than the
/// tolerance of an arc.
bool Commit::enters(const StrokeBox& box) const {
  constexpr double kPiece_mm = 0.5;
  constexpr unsigned kMostPieces = 2000;
  const bool straight = !curve_.circular && curve_.shape == nullptr;
  const bool whole = straight && !box.any_turns() && !box.outside;
  const double wanted = std::ceil(curve_.length / kPiece_mm);
  const unsigned pieces = whole ? 1 : wanted < 16 ? 16 : wanted > kMostPieces ? kMostPieces : static_cast<unsigned>(wanted);
  AxisVec from = machine_;
  for (unsigned i = 1; i <= pieces; ++i) {
    const AxisVec to = i == pieces ? curve_.end : curve_position(curve_, curve_.length * i / pieces, axis_count_);
    if (box.prohibits(to)) return true;
    if (!box.outside && !box.any_turns() && box.meets(from, to)) return true;
    from = to;
  }
  return false;
}

Committed Commit::commit(const Item& item, const Named& named) {
  if (item.kind == ItemKind::move) {
    const Move& move = item.move;
    const Affine& to_machine = *named.to_machine;
    const MoveShape* shape = named.shape;
    settings_ = named.settings;
    const bool tilted = move.circular && shape == nullptr && !to_machine.only_translates() && !to_machine.keeps_plane(move.plane_axis[0], move.plane_axis[1]);
    if (tilted) shape = &arc_in_space_;
    // The move begins exactly where the one before ended, to the last bit.
    const bool few = axis_count_ <= kFewAxes;
    AxisVec end = few ? to_machine.apply_to<kFewAxes>(move.end) : to_machine.apply(move.end);
    if (shape != nullptr) {
      commit_shape(move, to_machine, *shape);
      if (jumps_at_pole(curve_)) return Committed::at_pole;
      if (begins_elsewhere(move)) return Committed::displaced;
      end = curve_.end;
    } else if (move.circular) {
      circle_ = map_circle(move.circle, to_machine, move.plane_axis[0], move.plane_axis[1]);
      curve_.shape = nullptr;
      if (begins_elsewhere(move) && !begin_on_rounding(move)) return Committed::displaced;
      curve_ = make_arc(machine_, end, move.plane_axis[0], move.plane_axis[1], circle_, axis_count_, length_rotary_);
    } else {
      if (circle_.sweep != 0) [[unlikely]] circle_ = Circle{};
      few ? make_line<kFewAxes>(machine_, end, axis_count_, length_rotary_, &curve_) : make_line<kMaxAxes>(machine_, end, axis_count_, length_rotary_, &curve_);
    }
    if (curve_.length < kNoLength) {
      machine_ = end;
      return Committed::nothing;
    }
    if (any_limit_ && !inside_limits(curve_)) return Committed::soft_limit;
    if (move.stroke_box != 0) [[unlikely]] {  // M700 15.7 (2)
      const StrokeBox& box = (*config_.stroke_boxes)[move.stroke_box - 1];
      if (box.unknown) return Committed::unknown_area;
      if (box.prohibits(machine_) || box.prohibits(end) || (box.way && enters(box))) return Committed::prohibited;
    }
    if (shape != nullptr) ++shape_count_;
    start_ = machine_;
    machine_ = end;
  }
  ++last_serial_;
  return Committed::yes;
}

/// How much faster the path of the move just committed goes than its F says: the lead of a thread is along the axis that goes furthest (M700 6.7.1), or along the
/// path (LinuxCNC G33), and F of a helix may be the speed in the plane of its arc (6.6).
double Commit::path_by_feed(const Move& move) const {
  if (move.kind == NC_MOVE_THREAD) return config_.rules->lead_along_path ? 1.0 : along_longest();
  return move.plane_feed ? helix_slope() : 1.0;
}

/// Way along the path per way of the axis that moves most. M700 6.7.1: the lead of a tapered thread is measured along its longest axis, and the
/// way along the path is longer.
double Commit::along_longest() const {
  double longest = 0;
  for (unsigned i = 0; i < axis_count_; ++i) longest = std::fmax(longest, std::fabs(curve_.delta[i]));
  return longest > 0 ? curve_.length / longest : 1.0;
}

/// Factor from the speed in the plane of the arc to the speed along the helix (M700 6.6).
double Commit::helix_slope() const {
  const double in_plane = std::fabs(circle_.sweep) * 0.5 * (circle_.radius_start + circle_.radius_end);
  return in_plane > 0 ? curve_.length / in_plane : 1.0;
}

const MarkPoint* Commit::find(Serial serial) const {
  for (uint64_t i = 0; i < mark_count_ && i <= mark_mask_; ++i) {
    const MarkPoint& point = marks_[(mark_count_ - 1 - i) & mark_mask_];
    if (point.serial == serial) return &point;
    if (point.serial < serial) break;
  }
  return nullptr;
}

void Commit::rewind_to(const MarkPoint& point) {
  const Serial serial = point.serial;
  machine_ = point.machine;
  last_serial_ = serial;
  while (mark_count_ > 0 && marks_[(mark_count_ - 1) & mark_mask_].serial > serial) --mark_count_;
}

void Commit::circle_to_public(nc_move* out) const {
  out->turns = extra_turns(circle_.sweep);
  out->sweep_deg = circle_.sweep * 180 / kPi;
  out->ccw = circle_.sweep > 0;
}

void Commit::space_arc_to_public(nc_move* out) const {
  const CurveShape& shape = *curve_.shape;
  const SpaceArc& arc = shape.what.arc;
  out->center_axes = 3;
  AxisVec center;
  for (unsigned i = 0; i < 3; ++i) center[arc.axis[i]] = arc.center[i];
  const AxisVec on_machine = shape.to_machine.apply(center);
  for (unsigned i = 0; i < 3; ++i) {
    out->plane_axis[i] = arc.axis[i];
    out->center[i] = arc.center[i];
    out->machine_center[i] = on_machine[arc.axis[i]];
  }
  out->radius = arc.radius;
}

/// An arc whose plane is tilted in machine coordinates: its centre has three coordinates there, the third one on the axis that the plane is tilted
/// towards.
void Commit::tilted_arc_to_public(const Move& move, nc_move* out) const {
  const CurveShape& shape = *curve_.shape;
  const unsigned h = move.plane_axis[0], v = move.plane_axis[1];
  AxisVec center = shape.base.start;
  center[h] = move.circle.center[0];
  center[v] = move.circle.center[1];
  const AxisVec on_machine = shape.to_machine.apply(center);
  const unsigned third = static_cast<unsigned>(std::countr_zero(shape.to_machine.coupled() & ~(1u << h | 1u << v)));
  out->center_axes = 3;
  out->plane_axis[2] = static_cast<uint8_t>(third);
  out->center[2] = center[third];
  for (unsigned i = 0; i < 3; ++i) out->machine_center[i] = on_machine[out->plane_axis[i]];
}

namespace {

void put_mark(const Item& item, nc_item* out) {
  out->kind = NC_ITEM_MARK;
  out->u.mark.work = to_axes(item.mark.work);
  out->u.mark.modal = item.mark.modal;
  out->u.mark.stop = item.mark.stop;
  out->u.mark.report = item.mark.report;
  out->u.mark.again = item.mark.again;
}

}  // namespace

void Commit::mark_to_public(const Item& item, nc_item* out) const {
  out->serial = last_serial_;
  out->source = item.source;
  put_mark(item, out);
}

void Commit::to_public(const Item& item, nc_item* out) const {
  out->serial = last_serial_;
  out->source = item.source;
  switch (item.kind) {
    case ItemKind::move: {
      const Move& move = item.move;
      nc_move& m = out->u.move;
      out->kind = NC_ITEM_MOVE;
      m.work = to_axes(move.work);
      m.machine_start = to_axes(start_);
      m.machine = to_axes(machine_);
      m.kind = static_cast<uint8_t>(move.kind);
      m.feed_mm_min = move.feed_mm_min;
      m.feed_mm_rev = move.feed_mm_rev;
      if (move.kind == NC_MOVE_THREAD && config_.rules->lead_along_path) m.feed_mm_rev /= along_longest();
      m.length = curve_.length;
      m.index_axes = index_axes(curve_);
      m.exact_stop = move.exact_stop || m.index_axes != 0;
      m.skip_mask = move.skip_mask;
      m.skip_away = move.skip_away;
      m.plane = move.circular ? static_cast<uint8_t>(move.plane) : static_cast<uint8_t>(NC_PLANE_NONE);
      m.turns = 0;
      m.curved = curve_.shape != nullptr;
      m.center_axes = move.circular ? 2 : 0;
      m.center[0] = move.work_center[0];
      m.center[1] = move.work_center[1];
      m.plane_axis[0] = move.plane_axis[0];
      m.plane_axis[1] = move.plane_axis[1];
      m.machine_center[0] = circle_.center[0];
      m.machine_center[1] = circle_.center[1];
      m.radius = circle_.radius_start;
      m.sweep_deg = 0;
      m.ccw = false;
      if (move.circular) circle_to_public(&m);
      if (curve_.shape != nullptr && curve_.shape->what.kind == ShapeKind::space_arc) space_arc_to_public(&m);
      if (curve_.shape != nullptr && move.circular && move.shape == 0) tilted_arc_to_public(move, &m);
      break;
    }
    case ItemKind::action: {
      out->kind = NC_ITEM_ACTION;
      nc_action& a = out->u.action;
      a.value = item.action.value;
      a.mask = item.action.mask;
      a.bits = item.action.bits;
      a.index = item.action.index;
      a.text = item.action.text;
      a.kind = static_cast<uint8_t>(item.action.kind);
      a.letter = item.action.letter;
      break;
    }
    case ItemKind::gate:
      out->kind = NC_ITEM_GATE;
      out->u.gate.value = item.gate.value;
      out->u.gate.kind = static_cast<uint8_t>(item.gate.kind);
      out->u.gate.skip_mask = item.gate.skip_mask;
      out->u.gate.announce = item.gate.announce;
      break;
    case ItemKind::sync:
      out->kind = NC_ITEM_SYNC;
      out->u.sync.what = item.sync.what;
      break;
    case ItemKind::mark:
      put_mark(item, out);
      break;
    case ItemKind::alarm: out->kind = NC_ITEM_ALARM; break;
    case ItemKind::end:
      out->kind = NC_ITEM_END;
      out->u.end.ok = item.end.ok;
      out->u.end.work = to_axes(item.end.work);
      out->u.end.modal = item.end.modal;
      break;
  }
}

/// Bit i: the curve moves axis i, an index table. M700 9.3: the kind of move makes no difference.
uint8_t Commit::moved_tables(const Curve& curve) const {
  AxisVec low, high;
  curve_bounds(curve, axis_count_, &low, &high);
  uint32_t axes = 0;
  for (unsigned i = 0; i < axis_count_; ++i)
    if (((settings_->index_axes >> i) & 1) != 0 && high[i] - low[i] > kNoLength) axes |= 1u << i;
  return static_cast<uint8_t>(axes);
}

/// M700 7.9.2: at the start of the move an axis reverses its direction. An axis that does not move on one side of the start does not count.
bool Commit::turns_round(bool checked) {
  constexpr double kStill = 1e-9;
  bool back = false;
  if (checked) {
    const AxisVec entry = curve_evaluate(curve_, 0, axis_count_).d1;
    for (unsigned i = 0; exit_known_ && i < axis_count_; ++i)
      back = back || (std::fabs(entry[i]) > kStill && std::fabs(exit_[i]) > kStill && (entry[i] > 0) != (exit_[i] > 0));
    exit_ = curve_evaluate(curve_, curve_.length, axis_count_).d1;
  }
  exit_known_ = checked;
  return back;
}

/// M700 13.1.1: the path goes at its feed and turns the spindle with it.
void Commit::set_tap(const Move& move, Segment* s) const {
  s->feed_mm_rev = 0;
  s->tap_rev_per_mm = std::copysign(1 / move.feed_mm_rev, static_cast<double>(move.tap_rev_min));
  s->tap_acceleration = static_cast<double>(move.tap_slope) * move.feed_mm_rev;
}

/// What the feed of a segment goes by beside its number.
void Commit::set_rule(const FeedRule& rule, bool dry_rapid, bool is_tap, Segment* s) {
  s->feed_digit = rule.digit;
  s->rest_before = turns_round(rule.check_reversal);
  s->fixed_override = rule.tapping;
  s->dry = s->rapid ? dry_rapid : !s->skip && !rule.tapping && !is_tap;  // M700 13.1.1, 15.2
  s->digit_most_mm_s = rule.digit_most / 60;
  s->digit_step_mm_s = rule.digit_step / 60;
  if (rule.scale > 0) {
    s->feed_mm_s *= rule.scale;
    s->feed_mm_rev *= rule.scale;
  }
  s->corner_reach = rule.corner_reach;
  if (rule.slow_zone > 0) {
    s->slow_zone = rule.slow_zone;
    s->slow_factor = rule.corner_override;
  }
}

/// Sets the filters behind interpolation. A thread and a tap get none, because a filter would change their relation to the spindle.
void Commit::set_filter(const Move& move, const FilterParameters& filters, Segment* s) const {
  if (!config_.filters || (!filters.any && move.high_accuracy == 0) || move.kind == NC_MOVE_THREAD || move.kind == NC_MOVE_TAP || move.rule.tapping) return;
  FilteredMove filtered;
  filtered.kind = move.kind == NC_MOVE_RAPID  ? FilteredMove::Kind::rapid
                  : move.kind == NC_MOVE_SKIP ? FilteredMove::Kind::skip
                                              : FilteredMove::Kind::cut;
  filtered.high_accuracy = move.high_accuracy != 0;
  filtered.straight = !curve_.circular && curve_.shape == nullptr;
  filtered.limited = limited_;
  AxisVec low, high;
  curve_bounds(curve_, axis_count_, &low, &high);
  for (unsigned i = 0; i < axis_count_; ++i)
    if (high[i] > low[i]) filtered.moving |= 1u << i;
  s->filter = config_.rules->filter_times(filters, filtered, config_.cycle_s);
  if (s->filter.kind == FilterTimes::Kind::none && filtered.high_accuracy && filtered.kind == FilteredMove::Kind::cut) s->filter = config_.rounding;
  // M700 13.15: only arcs that two linear axes make themselves are compensated; with a rotary axis the path is not round anyway.
  if (!curve_.circular || curve_.shape != nullptr || filtered.kind != FilteredMove::Kind::cut) return;
  if (((rotary_ >> curve_.h | rotary_ >> curve_.v) & 1) != 0) return;
  s->round_mm[0] = static_cast<float>(filters.round_mm[curve_.h]);
  s->round_mm[1] = static_cast<float>(filters.round_mm[curve_.v]);
}

void Commit::to_record(const Item& item, const Named& named, Record* out) {
  out->serial = last_serial_;
  out->source = item.source;
  out->kind = item.kind;
  switch (item.kind) {
    case ItemKind::move: {
      out->segment = Segment{};
      Segment& s = out->segment;
      const Affine& to_machine = *named.to_machine;
      s.curve = curve_;
      s.to_work = to_machine.inverse();
      s.rapid = item.move.kind == NC_MOVE_RAPID;
      s.feed_mm_s = s.rapid ? 0 : item.move.feed_mm_min / 60;
      s.feed_mm_rev = item.move.feed_mm_rev;
      s.exact_stop = item.move.exact_stop;
      s.flows = s.rapid && item.move.flows;
      s.skip = item.move.kind == NC_MOVE_SKIP;
      s.skip_mask = item.move.skip_mask;
      s.skip_away = item.move.skip_away;
      s.skip_speeds = item.move.skip_speeds;
      s.start_feed_mm_s = s.feed_mm_s;
      for (unsigned i = 0; s.skip_speeds != nullptr && i < SkipSpeeds::kSignals; ++i)
        s.feed_mm_s = std::fmax(s.feed_mm_s, s.skip_speeds->feed_mm_min[i] / 60);  // the plan must allow for the fastest of them
      s.thread = item.move.kind == NC_MOVE_THREAD;
      set_rule(item.move.rule, named.settings->rapid_dry, item.move.kind == NC_MOVE_TAP, &s);
      if (item.move.kind == NC_MOVE_TAP) set_tap(item.move, &s);
      if (!s.rapid) {
        const double factor = path_by_feed(item.move);
        s.feed_mm_rev *= factor;
        s.feed_mm_s *= factor;
      }
      s.feed_end_mm_s = static_cast<double>(item.move.feed_end) / 60;
      s.thread_angle = item.move.thread_angle;
      if (item.move.high_accuracy != 0 && !s.thread && item.move.kind != NC_MOVE_TAP)  // threads and taps go with the spindle
        s.accuracy = config_.rules->accuracy_limits(named.settings->accuracy, accuracy_move(item.move, curve_, circle_, axis_count_));
      set_filter(item.move, named.settings->filters, &s);
      s.unclamps = item.move.unclamps;
      set_index_axes(&s);
      break;
    }
    case ItemKind::action: out->action = item.action; break;
    case ItemKind::gate: out->gate = item.gate; break;
    case ItemKind::sync: out->sync = item.sync; break;
    case ItemKind::mark: out->mark = item.mark; break;
    case ItemKind::alarm: out->alarm = item.alarm; break;
    case ItemKind::end: out->end = item.end; break;
  }
}

}  // namespace nc
