// SPDX-License-Identifier: Apache-2.0
#include "contour/contour.hpp"

#include <algorithm>
#include <iterator>
#include <new>

#include "alarm/condition.hpp"
#include "contour/meeting.hpp"

namespace nc {
namespace {

/// M700 13.7: between two straight cuts and nothing else.
bool is_line(const Move& m) { return m.kind == NC_MOVE_LINE && !m.circular && m.shape == 0 && !m.comp.transparent; }

/// The same, or an arc.
bool is_cut(const Move& m) { return is_line(m) || (m.circular && m.shape == 0 && (m.kind == NC_MOVE_ARC || m.kind == NC_MOVE_HELIX) && !m.comp.transparent); }

bool meets_later(const Move& m) { return m.corner == Corner::meet || m.corner == Corner::meet_by_radius; }

/// A command of radius compensation without a movement (offset/offset.hpp).
bool without_length(const Move& m) { return !m.circular && m.shape == 0 && m.corner == Corner::none && m.start == m.end && !stands_beside(m.comp); }

/// A line as it is programmed, while this lives: its corner is that of the programmed lines, also where the axes were moved by hand in front of it and a compensated line leads back (M700 12.4.4).
class AsProgrammed {
 public:
  explicit AsProgrammed(Move& line) : line_(line), start_(line.start) {
    for (unsigned i = 0; i < 2; ++i) line.start[line.comp.axis[i]] -= line.comp.by_hand[i];
  }
  ~AsProgrammed() { line_.start = start_; }
  AsProgrammed(const AsProgrammed&) = delete;
  AsProgrammed& operator=(const AsProgrammed&) = delete;

 private:
  Move& line_;
  AxisVec start_;
};

/// Do rotary axes turn the tool, along which its length is compensated, between the ends of these moves? A piece that is cut off ends on the way (M700 12.3).
bool turns_tool(const Move& first, const Move& next, uint32_t rotary, unsigned axis_count) {
  if (!first.space.turns && !next.space.turns) return false;
  for (unsigned i = 0; i < axis_count; ++i)
    if ((rotary >> i & 1) != 0 && (first.end[i] != first.start[i] || next.end[i] != next.start[i])) return true;
  return false;
}

}  // namespace

void ContourStage::reset() {
  first_ = count_ = ready_ = 0;
  pending_ = behind_mark_ = failed_ = false;
  entry_ = state_ = {};
}

ContourStage::Held& ContourStage::append(const Item& item) {
  Held& place = held(count_++);
  place.item = item;
  place.vacant = place.cut = place.meets = false;
  return place;
}

bool ContourStage::push(const Item& item, ContourRule rule) {
  if (failed_) return true;  // nothing is read behind an alarm
  if (item.kind == ItemKind::move && !without_length(item.move)) {
    push_move(item, rule);
    return true;
  }
  Item& taken = append(item).item;
  if (!pending_) {
    if (entry_.meets) show_meeting(taken, entry_.lead);
    ready_ = count_;
    return true;
  }
  const bool block_over = item.kind == ItemKind::mark && item.block_end;
  if (meets_later(held(ready_).item.move)) {
    push_behind_meeting(item);
    behind_mark_ = behind_mark_ || block_over;
    return true;
  }
  if (item.kind == ItemKind::alarm) {
    stop_by(item);
  } else if (inhibits_read_ahead(item) || (block_over && behind_mark_)) {
    fail(Condition::corner_no_move, item.source, 0);
  } else if (count_ == kHeld - 2) {  // a line and its cut must find room
    fail(Condition::pre_read, held(ready_).item.source, 0);
  }
  behind_mark_ = behind_mark_ || block_over;
  return true;
}

void ContourStage::push_move(const Item& item, ContourRule rule) {
  if (pending_) settle(item, rule);
  if (failed_) return;
  Held& place = append(item);
  Move& move = place.item.move;
  if (entry_.displaced && !move.meets) {
    AxisVec start = move.start;
    for (unsigned i = 0; i < axis_count_; ++i) start[i] += entry_.lead[i];
    if (move.circular && move.shape == 0) begin_arc_at(&move, start);
    move.start = start;
  }
  entry_ = {};
  if (move.corner == Corner::none) {
    ready_ = count_;
    return;
  }
  ready_ = count_ - 1;
  pending_ = true;
  behind_mark_ = false;
  append(item).vacant = true;
  if (meets_later(move) || move.circular) return;
  const AsProgrammed programmed(move);
  if (corner_travel(move, move, rotary_, axis_count_) < move.corner_mm - kCornerSlack_mm) fail(Condition::corner_short, item.source, move.corner_mm);
}

/// The movement that the pending line has waited for.
void ContourStage::settle(const Item& next, ContourRule rule) {
  Held& first = held(ready_);
  if (meets_later(first.item.move)) return settle_meeting(next.move);
  Held& place = held(ready_ + 1);
  Move& line = first.item.move;
  const double amount = line.corner_mm;
  const bool arcs = line.circular || (next.move.circular && rule.arcs && is_cut(next.move));
  if (!arcs && !is_line(next.move)) return fail(next.move.circular ? Condition::corner_arc : Condition::corner_no_move, next.source, amount);
  // By its radius alone an arc goes nowhere, but where the block behind it meets it, and then there is no end yet from which the corner could take its part.
  if (arcs && (!is_cut(next.move) || next.move.corner == Corner::meet_by_radius)) return fail(Condition::corner_no_move, next.source, amount);
  // A line whose end is the point where the next block meets it (13.9) has no length yet from which the corner could take its part.
  if (is_line(next.move) && meets_later(next.move)) return fail(Condition::corner_option, next.source, amount);
  if (turns_tool(line, next.move, rotary_, axis_count_)) return fail(Condition::tool_axis_code, first.item.source, amount);
  CornerCut cut;
  Condition bad = Condition::none;
  {
    const AsProgrammed programmed(line);
    bad = arcs ? cut_arc_corner(line, next.move, axis_count_, &cut) : cut_corner(line, next.move, rotary_, axis_count_, &cut);
  }
  const bool at_next = bad == Condition::corner_next_short || bad == Condition::corner_arc;
  if (bad != Condition::none) return fail(bad, at_next ? next.source : first.item.source, amount);
  pending_ = false;
  line.corner = Corner::none;
  if (!cut.any) return;
  place.item = first.item;
  place.vacant = false;
  place.cut = true;
  place.lead = cut.lead;
  entry_ = {true, false, cut.lead};
  Move& corner = place.item.move;
  if (line.circular) end_arc_at(&line, cut.before);
  if (corner.circular) {
    corner.kind = NC_MOVE_LINE;
    corner.circular = false;
    corner.circle = Circle{};
    if (!cut.round) corner.plane = Plane::none;
  }
  corner.start = line.end = line.work = cut.before;
  corner.end = corner.work = cut.behind;
  corner.connecting = true;
  // What is commanded of the vectors at the start of the block has been done, and a stop is at the end of the block.
  corner.comp.has_vector = corner.comp.hold_vector = corner.comp.corner_arc = corner.comp.cancel_vector = false;
  corner.comp.by_hand[0] = corner.comp.by_hand[1] = 0;  // the way from where the axes were moved to ends in front of the cut
  line.exact_stop = false;
  line.rule.slow_zone = 0;
  if (!cut.round) return;
  corner.kind = NC_MOVE_ARC;
  for (unsigned i = 0; i < axis_count_; ++i)
    if (i != corner.plane_axis[0] && i != corner.plane_axis[1] && corner.end[i] != corner.start[i]) corner.kind = NC_MOVE_HELIX;
  corner.circular = true;
  corner.circle = cut.circle;
  for (unsigned i = 0; i < 2; ++i) corner.work_center[i] = cut.circle.center[i];
}

/// The end of the pending move, if the movement behind it meets it.
void ContourStage::settle_meeting(const Move& next) {
  if (!next.meets) return stand_alone();
  Held& first = held(ready_);
  Move& move = first.item.move;
  const AxisVec placeholder = move.start;
  for (unsigned i = 0; i < axis_count_; ++i) first.lead[i] = next.start[i] - placeholder[i];
  first.cut = first.meets = true;
  for (unsigned i = ready_ + 2; i < count_; ++i) show_meeting(held(i).item, first.lead);
  move.end = move.work = next.start;
  if (move.circular) {
    const unsigned h = move.plane_axis[0], v = move.plane_axis[1];
    const PlanePoint start{move.start[h], move.start[v]}, end{move.end[h], move.end[v]};
    const bool ccw = move.circle.sweep > 0;
    const PlanePoint center = move.corner == Corner::meet ? PlanePoint{move.circle.center[0], move.circle.center[1]}
                                                          : center_of_radius(start, end, move.circle.radius_start, ccw);
    move.circle = part_of_circle(start, end, center, ccw);
    for (unsigned i = 0; i < 2; ++i) move.work_center[i] = move.circle.center[i];
  }
  first.vacant = corner_travel(move, move, 0, axis_count_) < kCornerSlack_mm;
  move.corner = Corner::none;
  pending_ = false;
}

/// The interpreter did not know yet where the block ends.
void ContourStage::show_meeting(Item& item, const AxisVec& lead) const {
  for (unsigned i = 0; item.kind == ItemKind::mark && i < axis_count_; ++i) item.mark.work[i] += lead[i];
}

/// Nothing meets the pending move.
void ContourStage::stand_alone() {
  Held& first = held(ready_);
  first.vacant = first.item.move.corner == Corner::meet_by_radius || first.item.move.corner_mm > 0;
  first.item.move.corner = Corner::none;
  pending_ = false;
}

/// An item that does not move, behind a pending move without an end. A line has no meaning without the block that meets it, which the
/// interpreter has said by an alarm; the program cannot stop in between.
/// M700 13.9: the pair of blocks cannot meet.
static bool is_of_meeting(Condition condition) {
  constexpr Condition kOfMeeting[] = {Condition::geometric_option,        Condition::geometric_arc_option, Condition::geometric_circle_option,
                                      Condition::geometric_parallel,      Condition::geometric_incremental, Condition::geometric_no_line,
                                      Condition::geometric_address,       Condition::geometric_plane,      Condition::geometric_contact};
  return std::find(std::begin(kOfMeeting), std::end(kOfMeeting), condition) != std::end(kOfMeeting);
}

void ContourStage::push_behind_meeting(const Item& item) {
  const bool needed = held(ready_).item.move.corner_mm > 0;
  const bool second_block = item.kind == ItemKind::mark && item.block_end && behind_mark_;
  const bool full = count_ >= kHeld - 2;
  if (!inhibits_read_ahead(item) && !second_block && !full) return;
  // An arc by its centre would be a whole circle by itself, but with a block behind it that fails as the second one of the pair it was none.
  if (item.kind == ItemKind::alarm && (needed || is_of_meeting(item.alarm.condition))) return stop_by(item);
  if (needed) return fail(full ? Condition::pre_read : Condition::geometric_no_line, full ? held(ready_).item.source : item.source, 0);
  stand_alone();
  ready_ = count_;
}

/// The program stops before the pending move: the alarm takes its place, and what was read behind it is forgotten.
void ContourStage::stop_by(const Item& alarm) {
  count_ = ready_;
  append(alarm);
  ready_ = count_;
  pending_ = false;
  failed_ = true;
}

void ContourStage::fail(Condition condition, const nc_source& source, double value) {
  Item alarm;
  alarm.kind = ItemKind::alarm;
  alarm.source = source;
  new (&alarm.alarm) Fault();
  alarm.alarm.condition = condition;
  if (value > 0) {
    alarm.alarm.letter = held(ready_).item.move.corner == Corner::chamfer ? chamfer_letter_ : rounding_letter_;
    alarm.alarm.has_value = true;
    alarm.alarm.value = value;
  }
  stop_by(alarm);
}

bool ContourStage::pop(Item& out) {
  while (ready_ != 0) {
    Held& front = held(0);
    first_ = (first_ + 1) % kHeld;
    --count_;
    --ready_;
    if (front.vacant) continue;
    out = front.item;
    if (out.kind == ItemKind::move && (front.cut || !without_length(out.move))) state_ = {front.cut, front.meets, front.lead};
    if (out.kind == ItemKind::mark) out.mark.beside = state_.displaced;
    return true;
  }
  return false;
}

}  // namespace nc
