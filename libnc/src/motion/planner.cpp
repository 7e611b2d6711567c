// SPDX-License-Identifier: Apache-2.0
// The backward pass and what leads to it. See planner.hpp for the rule and docs/motion.md for why it is
// feasible at every swap.
#include "motion/planner.hpp"
#include "base/same_place.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

bool before(uint32_t a, uint32_t b) {
  return static_cast<int32_t>(a - b) < 0;
}

/// Of the way that is gone within the mean at full speed: shorter ways are looked at together.
constexpr double kWaysInWindow = 1.0 / 16;

/// A record at which nothing may move, whatever lies around it.
bool demands_rest(const Record& r) {
  if (r.kind == ItemKind::action)
    return r.action.kind == NC_ACTION_MESSAGE;  // a text is shown at rest, none is lost
  return r.kind == ItemKind::gate || r.kind == ItemKind::sync || r.kind == ItemKind::alarm ||
         r.kind == ItemKind::end;
}

}  // namespace

void Planner::create(const MotionLimits& limits, Record* ring, uint32_t capacity, Arena& arena) {
  limits_ = limits;
  ring_ = ring;
  mask_ = capacity - 1;
  entry_ = arena.make<Entry>(capacity);
  exit2_ = arena.make<double>(capacity);
  exchange_.create(capacity, arena);
}

bool Planner::must_rest(const Record& from, const Record& to) const {
  const Segment &a = from.segment, &b = to.segment;
  if (a.rapid || b.rapid || a.exact_stop || a.skip || b.skip || b.rest_before) return true;
  if (!a.filter.same(b.filter)) return true;
  if (from.epoch != to.epoch || tip_.between > kRecordsBetween) return true;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    if (std::fabs(a.curve.end[i] - b.curve.start[i]) > kJoined) return true;
  }
  return false;
}

double Planner::cap(const Entry& e) const {
  if (dry_.on() && e.dry_limit >= 0) return std::min({e.limit, e.dry_limit, dry_.cut});
  return std::min(e.limit, e.constant ? e.feed : e.feed * override_);
}

/// Exit speed that the neighbours of a joint allow at the present override, or in dry run.
void Planner::update_joint(uint32_t ordinal) {
  Entry& e = entry(ordinal);
  if (e.corner2 <= 0 || (single_block_ && e.stop_mark)) {
    e.joint2 = 0;
    return;
  }
  const double v = std::min(cap(e), cap(entry(ordinal + 1)));
  e.joint2 = std::min(e.corner2, v * v);
}

/// The end of the tip is known: its limits are final.
void Planner::close(const Joint& exit, const AxisVec& reserve) {
  if (!(exit.speed2 > 0)) turns_.clear();
  Segment& s = record(tip_.record).segment;
  AxisVec share;
  for (unsigned i = 0; i < limits_.axis_count; ++i) share[i] = std::max(tip_.reserve[i], reserve[i]);
  turns_.reserve(share, limits_.axis_count);
  set_segment_limits(s, tip_.shape, share, limits_);
  s.acceleration = even_acceleration(s, tip_.entry, std::sqrt(exit.speed2), limits_);
  if (s.tap_acceleration > 0) s.acceleration = std::min(s.acceleration, s.tap_acceleration);
  Entry& e = entry(tip_.ordinal);
  e.corner2 = exit.speed2;
  e.joint2 = 0;
  e.feed = s.rapid || s.feed_mm_rev > 0 ? HUGE_VAL
           : s.feed_end_mm_s > 0      ? std::min(s.feed_mm_s, s.feed_end_mm_s)
                                      : std::max(s.feed_mm_s, static_cast<double>(s.digit_most_mm_s));  // the scan keeps what the handle says
  e.limit = s.speed_limit;
  e.dry_limit = s.dry && !s.rapid && !s.thread ? s.dry_limit : -1;  // a thread that has begun with the spindle goes on with it
  e.gain = 2 * s.acceleration * s.curve.length;
  e.constant = s.skip || s.fixed_override || e.feed == HUGE_VAL;
  tip_.open = false;
  update_joint(tip_.ordinal - 1);
}

/// The corner behind the tip, for the mean that rounds it.
void Planner::add_turn(const Segment& from, const Segment& to, const SegmentShape& shape) {
  const double window = rounding_window(to, limits_);
  if (!(window > 0)) return;
  AxisVec turn;
  for (unsigned i = 0; i < limits_.axis_count; ++i) turn[i] = shape.entry[i] - tip_.shape.exit[i];
  turns_.go(from.curve.length, tip_.entry, kWaysInWindow * tip_.shape.reach * window, turn, limits_.axis_count);
}

void Planner::commit_segment(uint32_t index) {
  Record& r = record(index);
  Tip tip;
  tip.record = index;
  tip.ordinal = r.segment.ordinal = next_ordinal_++;
  tip.shape = shape_of(r.segment, limits_);
  tip.open = tip.valid = true;
  tip.thread = r.segment.thread;
  entry(tip.ordinal).stop_mark = false;
  if (tip_.open) {
    const Segment& from = record(tip_.record).segment;
    Joint joint;
    if (!must_rest(record(tip_.record), r)) {
      add_turn(from, r.segment, tip.shape);
      joint = joint_between(from, tip_.shape, r.segment, tip.shape, limits_, &turns_);
    }
    tip.reserve = reserve_towards(joint, from, tip_.shape, limits_);
    tip.entry = std::sqrt(joint.speed2);
    close(joint, reserve_towards(joint, r.segment, tip.shape, limits_));
  }
  tip_ = tip;
}

void Planner::commit(uint32_t index) {
  const Record& r = record(index);
  head_ = index + 1;
  if (r.kind == ItemKind::move && r.segment.curve.length > 0) {
    commit_segment(index);
    return;
  }
  ++tip_.between;
  // M700 6.7.1: single block stops behind the first block that is no thread any more.
  if (r.kind == ItemKind::mark && r.mark.stop && tip_.valid && !tip_.thread) entry(tip_.ordinal).stop_mark = true;
  if (tip_.open && demands_rest(r)) close({}, {});
}

/// Exit speeds from the last planned segment backward. Returns the first ordinal that has changed.
uint32_t Planner::backward(uint32_t begin, uint32_t end, bool all) {
  uint32_t changed = end;
  double next = 0;
  for (uint32_t k = end; before(begin, k);) {
    --k;
    const double speed2 = k + 1 == end ? 0 : std::min(entry(k).joint2, next);
    double& exit2 = exit2_[k & mask_];
    if (!all && before(k, planned_) && exit2 == speed2) break;
    exit2 = speed2;
    changed = k;
    next = speed2 + entry(k).gain;
  }
  planned_ = end;
  return changed;
}

void Planner::publish(uint32_t begin, uint32_t changed) {
  shown_ = tip_.open ? tip_.record : head_;
  exchange_.publish(exit2_, begin, changed, planned_, shown_);
}

void Planner::replan(const Inputs& in) {
  const bool idle = head_ == seen_head_;
  seen_head_ = head_;
  // Nothing has come behind the segment held back and the machine stands in front of it: it ends at rest.
  if (tip_.open && idle && in.tail == tip_.record) close({}, {});
  const bool all = in.feed_override != override_ || in.single_block != single_block_ || in.dry != dry_;
  const uint32_t end = tip_.open ? tip_.ordinal : next_ordinal_;
  if (!all && shown_ == (tip_.open ? tip_.record : head_)) return;
  if (all) {
    override_ = in.feed_override;
    dry_ = in.dry;
    limits_.dry = dry_.on();
    single_block_ = in.single_block;
    for (uint32_t k = in.ordinal; before(k + 1, next_ordinal_); ++k) update_joint(k);
  }
  publish(in.ordinal, backward(in.ordinal, end, all));
}

void Planner::truncate(uint32_t end, const Inputs& in) {
  if (tip_.open && before(tip_.record, end)) {
    close({}, {});
  }
  next_ordinal_ = in.ordinal;
  for (uint32_t i = in.tail; i != end; ++i) {
    const Record& r = record(i);
    if (r.kind == ItemKind::move && r.segment.curve.length > 0) next_ordinal_ = r.segment.ordinal + 1;
  }
  tip_ = {};
  turns_.clear();
  head_ = seen_head_ = end;
  if (next_ordinal_ != in.ordinal) {
    Entry& last = entry(next_ordinal_ - 1);
    last.corner2 = last.joint2 = 0;
  }
  publish(in.ordinal, backward(in.ordinal, next_ordinal_, true));
}

}  // namespace nc
