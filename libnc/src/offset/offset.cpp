// SPDX-License-Identifier: Apache-2.0
// The stage of tool radius compensation, first half: what it holds back, how the joints are decided and when
// it lets go. The second half, from vectors to geometry, is outlet.cpp.
#include "offset/offset.hpp"

#include <cmath>
#include <type_traits>

#include "alarm/condition.hpp"
#include "base/same_place.hpp"
#include "base/units.hpp"
#include "offset/left_out.hpp"
#include "offset/tiny_line.hpp"
#include "stream/copy_item.hpp"

namespace nc {

static_assert(std::is_trivially_copyable_v<OffsetStage>);

namespace {

bool same_plane(const Compensation& a, const Compensation& b) {
  return a.axis[0] == b.axis[0] && a.axis[1] == b.axis[1];
}

Vec2 plane_delta(const Move& move) {
  const uint8_t h = move.comp.axis[0], v = move.comp.axis[1];
  return {move.end[h] - move.start[h], move.end[v] - move.start[v]};
}

/// How far the move leads across the plane of compensation, along the third of the basic axes.
double rise(const Move& move) {
  const unsigned h = move.comp.axis[0], v = move.comp.axis[1];
  if (h == v || h > 2 || v > 2) return 0;
  return move.end[3 - h - v] - move.start[3 - h - v];
}

// Where the axes were moved by hand to the end of a line, it is a block of the contour all the same.
bool without_length(const Move& move) {
  return !move.circular && move.start == move.end && !stands_beside(move.comp);
}

// A block that only asks for something of the compensation: nothing of it goes to the machine.
bool is_command(const Move& move) { return without_length(move) && !move.leads_space; }

// The first offset on the side of the second.
double offset_on_side(double amount, double side) { return side == 0 ? amount : std::copysign(amount, side); }

/// M700 7.10: the corner between two cutting blocks is an inner one, sharper than the angle of G62, and its vector is computed.
bool cuts_inner_corner(const Section& before, const Move& move, const Section& behind, const Move& move_behind) {
  if (move.rule.corner_override <= 0 || move_behind.kind == NC_MOVE_RAPID) return false;
  const auto commanded = [](const Compensation& c) { return c.has_vector || c.hold_vector || c.corner_arc; };
  if (commanded(move.comp) || commanded(move_behind.comp) || before.offset * behind.offset <= 0) return false;
  if (classify(before.end, behind.begin, before.offset) != Turn::inner) return false;
  const double turn = std::atan2(std::abs(cross(before.end.u, behind.begin.u)), dot(before.end.u, behind.begin.u));
  return kPi - turn < static_cast<double>(move.rule.corner_angle);
}

bool vanishes(const Leg& begin, const Leg& end, double offset, double unsure) {
  return !tool_fits(begin, offset, unsure) || !tool_fits(end, offset, unsure);
}

Item alarm_in(const nc_source& source, Condition condition) {
  Item alarm;
  alarm.kind = ItemKind::alarm;
  alarm.source = source;
  alarm.alarm = Fault{};
  alarm.alarm.condition = condition;
  return alarm;
}

Condition condition_of(Clearance found) { return found == Clearance::full ? Condition::contour_too_long : Condition::comp_interference; }

// What is found in this block may be the fault of another one, which the sentence then names by its line, if that is one of the same text.
Item alarm_by(const nc_source& source, Clearance found, const ContourMemory::Culprit* culprit) {
  Item alarm = alarm_in(source, condition_of(found));
  if (found != Clearance::enters || culprit == nullptr) return alarm;
  if (culprit->way) alarm.alarm.condition = Condition::comp_way;
  alarm.alarm.has_value = culprit->source.file == source.file && culprit->source.line != 0;
  alarm.alarm.value = culprit->source.line;
  return alarm;
}

}  // namespace

bool OffsetStage::can_push() const {
  return count_ < kHeld;
}

// How many sections at the front of the chain wait for nothing any more.
unsigned OffsetStage::may_release() const {
  const unsigned size = chain_.size();
  if (mode_ == Mode::off) return size;
  // Behind a block that has been left out all five of the pre-read have their joints when they are compared with it (left_out.hpp).
  const unsigned more = chain_.may_have_left_out() ? 1 : 0;
  unsigned n = 0;
  for (; n < size; ++n) {
    const Section& s = chain_[n];
    if (s.check && size - n < kChain + more && blocks_ - s.block < kLookAheadBlocks + more) break;
    if (!s.jointed || s.vanished) break;
    if (chain_.may_have_vanished() && n + 1 < size && chain_[n + 1].vanished) break;
  }
  return n;
}

bool OffsetStage::push(const Item& item, NoRule) {
  if (!can_push()) return false;
  if (failed_) return true;
  if (item.kind == ItemKind::sync && item.sync.ahead && mode_ != Mode::off) {
    let_pass(item);
    return true;
  }
  Held& held = new_slot(next_index(), item);
  if (item.kind == ItemKind::move) {
    intake_move(&held);
  } else {
    if (item.kind == ItemKind::alarm && mode_ != Mode::off) {
      stop_by(next_index(), item);
      return true;
    }
    if (item.kind == ItemKind::sync) held.item.sync.ahead = false;  // all in front of it is executed first
    if (inhibits_read_ahead(item)) close();
    if (!failed_ && item.kind == ItemKind::end && memory_.suspects()) stop_by(next_index(), alarm_by(item.source, Clearance::enters, memory_.suspect()));
    if (!failed_) ++count_;
  }
  if (!failed_ && item.block_end) count_block_end();
  if (failed_) return true;
  if (item.kind == ItemKind::mark) keep_state(&held);
  if (const unsigned n = may_release(); n > 0 || unchecked_) {
    settle(n);
  } else {  // behind most marks
    wait_for_chain();
  }
  // Counted without what only waits to be fetched: the caller's pace never changes the geometry.
  if (next_index() - released_ >= kLookAheadItems) make_room();
  return true;
}

// Behind a mark, for a checkpoint there.
void OffsetStage::keep_state(Held* mark) {
  Held& held = *mark;
  held.mode = mode_;
  held.idle_blocks = idle_blocks_;
  held.cancelled = cancelled_;
  held.level = level_end_;
  held.approach = approach_;
  held.side_changed = side_changed_;
  held.passed = held.passed || amount_changed_;  // read again from here, the block behind would go from one amount to the other
  held.given = given_ && open() == nullptr;
  held.in_contour = memory_.state().open;
  if (held.in_contour) contour_at(held) = memory_.state();
}

// A read of the machine between two blocks of the contour. If the block before it had to be executed first, it would have to end without the one behind it,
// which decides how far it goes: at an inner corner it would cut into the part. So the read goes in front of all that is held.
void OffsetStage::let_pass(const Item& sync) {
  for (uint32_t i = next_index(); i != released_; --i) {
    held_at(i) = held_at(i - 1);
    contour_at(held_at(i)) = contour_at(held_at(i - 1));
    held_at(i).passed = true;  // read again from here, it would be asked for once more
  }
  for (unsigned i = 0; i < chain_.size(); ++i) ++chain_[i].index;
  ++turn_.index;
  ++bend_.index;
  Sync& passed = new_slot(released_, sync).item.sync;
  const Section* last = open();
  const Vec2 vector = last == nullptr ? tail_ : last->start || last->vanished ? Vec2{} : perpendicular(last->end, last->offset);
  for (unsigned i = 0; i < 2; ++i) passed.axis[i] = comp_.axis[i];
  passed.vector[0] = vector.h;
  passed.vector[1] = vector.v;
  ++released_;
  ++count_;
}

OffsetStage::Held& OffsetStage::new_slot(uint32_t index, const Item& item) {
  Held& held = held_at(index);
  copy_item(item, &held.item);
  held.role = Role::pass;
  held.passed = false;
  if (item.kind != ItemKind::move) return held;  // has nothing of what follows
  held.has_lead = held.lead_arc = held.straight = held.trim = held.inner = held.behind_inner = held.trim_next = held.bound_next = false;
  held.commanded = true;
  held.alone = false;
  held.doubt = {};
  held.lead = held.lead_from = Vec2{};
  held.lead_crosses = false;
  held.joint.n = 0;
  return held;
}

void OffsetStage::reset() {
  chain_.clear();
  count_ = first_ = released_ = blocks_ = chain_start_block_ = 0;
  mode_ = Mode::off;
  idle_blocks_ = connecting_ = 0;
  moved_ = failed_ = cancelled_ = lead_done_ = has_rest_ = false;
  comp_ = Compensation{};
  tail_ = chain_start_ = approach_ = vector_ = direction_ = Vec2{};
  start_commanded_ = out_commanded_ = true;
  start_erased_ = false;
  trim_next_ = out_trim_ = out_alone_ = bound_ = side_changed_ = amount_changed_ = false;
  given_ = true;
  unchecked_ = false;
  turn_ = {};
  bend_ = {};
  doubt_ = {};
  memory_.reset();
  level_ = level_end_ = 0;
  feed_scale_ = 0;
  axis_[0] = 0;
  axis_[1] = 1;
  resume_ = OffsetResume{};
}

// Marks that go round an idle stage have nothing to resume.
OffsetResume OffsetStage::resume_point() const {
  return idle() ? OffsetResume{} : resume_;
}

void OffsetStage::restore(const OffsetResume& resume) {
  reset();
  resume_ = resume;
  direction_ = {resume.direction[0], resume.direction[1]};
  for (unsigned i = 0; i < 2; ++i) axis_[i] = resume_.comp.axis[i] = resume.comp.axis[i] % kMaxAxes;
  comp_ = resume_.comp;
  if (!resume.active) return;
  idle_blocks_ = resume.idle_blocks;
  chain_start_block_ = blocks_ - 1 - idle_blocks_;
  cancelled_ = resume.cancelled;
  memory_.restore(resume.contour);
  level_ = level_end_ = resume.level;
  start_commanded_ = out_commanded_ = resume.commanded;
  trim_next_ = out_trim_ = resume.trim;
  approach_ = {resume.approach[0], resume.approach[1]};
  side_changed_ = resume.side_changed;
  given_ = resume.given;
  feed_scale_ = resume.feed_scale;
  mode_ = resume.pending ? Mode::pending : Mode::on;
  vector_ = {resume.vector[0], resume.vector[1]};
  tail_ = vector_;
}

void OffsetStage::count_block_end() {
  ++blocks_;
  if (moved_) {
    moved_ = false;
    return;
  }
  if (idle_blocks_ < kIdleLimit) ++idle_blocks_;
  if (idle_blocks_ == kIdleLimit && mode_ != Mode::off) close();
}

// Nothing more is waited for: four blocks without movement, a pre-read inhibit, or no room (M700 12.4.2). The
// last block ends perpendicular; a start block gets no vector at all, and a command without a block behind it
// none either.
void OffsetStage::close() {
  turn_.waits = false;
  if (mode_ == Mode::pending) mode_ = Mode::on;
  if (!decide_waiting()) return;
  if (Section* last = open()) {
    if (last->vanished)
      return fail(last->index, Condition::comp_interference, held_at(last->index).item.source);
    if (held_at(last->index).item.move.comp.corner_arc && !last->start)  // where the arc of G39 leads to nobody knows
      return fail(bend_.index, Condition::comp_turn_open, bend_.source);
    last->joint.set(last->start ? Vec2{} : perpendicular(last->end, last->offset));
    last->jointed = last->commanded = last->alone = true;
    tail_ = last->joint.v[0];
  }
  if (check_joints(chain_.size())) release(chain_.size());
}

bool OffsetStage::interferes(unsigned* at) {
  return !chain_.empty() && check_interference(&chain_, chain_.size(), chain_start(), at) == Finding::alarm;
}

// ---- moves ----

void OffsetStage::intake_move(Held* held) {
  Move& move = held->item.move;
  for (uint8_t& axis : move.comp.axis) axis %= kMaxAxes;
  level_ = level_end_;
  level_end_ += rise(move);
  if (mode_ == Mode::off && move.comp.side == 0) {
    if (is_command(move)) held->role = Role::command;
    ++count_;
    return;
  }
  if (move.comp.side == 0) {  // a cancel stays in the plane of what it cancels
    move.comp.axis[0] = comp_.axis[0];
    move.comp.axis[1] = comp_.axis[1];
  }
  if (mode_ == Mode::on &&
      !same_plane(move.comp, comp_)) {  // P112 keeps programs from it; the path stays in one piece
    close();
    if (failed_) return;
    held->has_lead = true;
    tail_ = {};
  }
  // M700 12.4.2 (4): without a movement to the intermediate point the vector goes away on the way to the reference position, which leads anywhere. A corner with it
  // would take the tool round the end of the contour to its other side.
  if (move.leaves && open() != nullptr) {
    close();
    if (failed_) return;
  }
  // A start behind G40 that has not moved yet either: the vector of the contour before is still there, and goes as in a contour.
  if (mode_ == Mode::pending && norm(tail_) > 0 && (move.comp.side == 0 || move.comp.transparent)) mode_ = Mode::on;
  const bool again = cancelled_ && move.comp.side != 0;
  if (again) {  // the contour has ended, at right angles; another one starts from its vector
    close();
    if (failed_) return;
    cancelled_ = false;
  }
  const double offset_before = signed_offset(comp_), offset = signed_offset(move.comp);
  const bool other_side = mode_ == Mode::on && move.comp.side != 0 && offset_before * offset < 0;
  if (move.comp.side != 0) comp_ = move.comp;
  Leg begin, end;
  const bool moves = make_legs(move, &begin, &end);
  held->direction = moves ? end.u : Vec2{};
  if (move.comp.side == 0 && (!moves || mode_ == Mode::pending)) return intake_uncompensated(held);
  const bool starts = mode_ == Mode::off || again;
  if (starts) {
    mode_ = Mode::pending;
    idle_blocks_ = 0;
    moved_ = true;  // the block of the command itself is not one of the blocks without movement
  }
  const bool commands = without_length(move) || move.comp.has_vector || move.comp.corner_arc;
  const Vec2 way = plane_delta(move);
  const bool is_short = dot(way, way) <= 2 * kNoDirection_mm * kNoDirection_mm && !stands_beside(move.comp);
  if (!moves || (is_short && !starts && !commands && intake_without_direction(held, offset_before, &begin, &end))) {
    side_changed_ = side_changed_ != other_side;
    if (!moves) return commands && !move.comp.transparent ? intake_command(held) : intake_carried(held);
    return;
  }
  if (mode_ == Mode::pending && !starts && !move.comp.transparent) {
    // M700 12.4.2 (1): the vector of a command without movement is perpendicular at the start of the next
    // moving block.
    lead(held, perpendicular(begin, signed_offset(move.comp)));
    start_commanded_ = false;
    mode_ = Mode::on;
  }
  // The vector in front of a change of side that comes without a direction was given by the program, so no joint leads to the other side: the tool goes
  // there at right angles before the block begins, as it does where no intersection is found. An arc would become a spiral through its own wall.
  if (side_changed_ && !other_side && mode_ == Mode::on && move.comp.side != 0 && !move.comp.transparent && given_ && open() == nullptr) {
    close();
    if (failed_) return;
    lead(held, perpendicular(begin, signed_offset(move.comp)));
    start_commanded_ = false;
  }
  side_changed_ = false;
  given_ = true;
  moved_ = true;
  idle_blocks_ = 0;
  intake_section(held, begin, end);
}

// Moves off the plane only: the vector goes along. A move with its vectors taken away loses them all the
// same.
void OffsetStage::intake_carried(Held* held) {
  held->role = Role::carried;
  if (held->item.move.comp.transparent && mode_ == Mode::on) {
    close();
    if (failed_) return;
    held->role = Role::section;
    held->joint.set({});
    tail_ = {};
    start_commanded_ = true;
  }
  ++count_;
}

// A line without a direction of its own goes along. False: it is a block, with the direction of all such lines since the joint.
bool OffsetStage::intake_without_direction(Held* held, double offset_before, Leg* begin, Leg* end) {
  const Move& move = held->item.move;
  const Vec2 delta = plane_delta(move);
  const bool other_amount = std::abs(signed_offset(move.comp)) != std::abs(offset_before);
  const bool ordinary = move.comp.side == 0 || move.comp.transparent || move.comp.hold_vector || (other_amount && open() == nullptr);
  if (ordinary || begin->curvature != 0 || norm(delta) >= kNoDirection_mm) return false;
  const Vec2 since_joint = approach_ + delta;
  if (norm(since_joint) >= kNoDirection_mm) {
    begin->u = end->u = unit(since_joint);
    return false;
  }
  approach_ = since_joint;
  amount_changed_ = amount_changed_ || other_amount;
  moved_ = true;
  idle_blocks_ = 0;
  held->role = Role::carried;
  ++count_;
  return true;
}

// G40 where nothing moves in the plane, or before anything was compensated.
void OffsetStage::intake_uncompensated(Held* held) {
  const Move& move = held->item.move;
  if (mode_ == Mode::pending) {
    mode_ = Mode::off;
    if (is_command(move)) held->role = Role::command;
  } else {
    held->role = is_command(move) ? Role::command : Role::carried;
    cancelled_ = true;
    if (!decide_waiting()) return;
    Section* last = open();
    if (without_length(move) && move.comp.cancel_vector && last && !last->start && !last->vanished) {
      last->joint =
          joint_at_cancel_vector(last->end, {move.comp.vector[0], move.comp.vector[1]}, last->offset);
      last->jointed = last->commanded = true;
      held_at(last->index).trim = true;
      tail_ = last->joint.v[0];
    }
  }
  ++count_;
}

// The block `corner` asks for an arc at the end of the move at `index`.
void OffsetStage::bend_behind(uint32_t index, const Item& corner) {
  held_at(index).item.move.comp.corner_arc = true;
  bend_ = {next_index(), nc_source(corner.source)};
  feed_bend(index, corner);
}

// The arc goes at the feed of that move, and behind a rapid, which has none, at that of its own block.
void OffsetStage::feed_bend(uint32_t index, const Item& corner) {
  Move& last = held_at(index).item.move;
  if (last.kind != NC_MOVE_RAPID) return;
  last.feed_mm_min = corner.move.feed_mm_min;
  last.feed_mm_rev = corner.move.feed_mm_rev;
  if (last.feed_mm_min <= 0 && last.feed_mm_rev <= 0) fail(index, Condition::no_feed, nc_source(corner.source));
}

// The tool goes from the vector in force to this one before the move.
void OffsetStage::lead(Held* held, Vec2 vector) {
  held->has_lead = true;
  chain_start_block_ = blocks_ - 1;
  held->lead_from = tail_;
  held->lead = tail_ = vector;
  held->lead_crosses = side_changed_;
}

// Does the way to a vector that a block without movement gives cut into the contour? A chord between two vectors comes nearer to the corner than both of them.
bool OffsetStage::look_at_step(const Held& held) {
  if (!comp_.check || !comp_.walls) return true;
  ContourMemory::Step step;
  step.from = held.lead_from;
  step.to = held.lead;
  step.bends = held.lead_arc;
  step.offset = signed_offset(comp_);
  step.approach = approach_;
  step.crosses = held.lead_crosses;
  step.source = held.item.source;
  const Clearance found = memory_.step(step);
  if (found != Clearance::fits) fail(next_index(), condition_of(found), nc_source(held.item.source));
  return !failed_;
}

// DGSHAPE G39 behind the start: the way that it names is that of the block behind, so the start ends as it does in front of such a block. Only a start of type B comes to a corner that an arc can go
// round.
void OffsetStage::turn_start(Section* start, const Held& turn) {
  const Compensation& comp = turn.item.move.comp;
  const Leg behind{unit({comp.vector[0], comp.vector[1]}), 0};
  const bool goes_round = comp.type_b && is_outer(start->end, behind, start->offset);
  start->joint = goes_round ? joint_corner_arc(start->end, behind, start->offset) : joint_at_start(start->end, behind, start->offset, false);
  if (goes_round) feed_bend(start->index, turn.item);
  start->jointed = start->commanded = true;
  tail_ = start->joint.v[start->joint.n - 1];
  turn_ = {true, true, start->index, tail_, nc_source(turn.item.source)};
}

// A command that does not move in the plane: its vector, if it gives one, holds from here on (M700 12.4.3
// (4)).
void OffsetStage::intake_command(Held* held) {
  const Compensation& comp = held->item.move.comp;
  held->role = is_command(held->item.move) ? Role::command : Role::carried;
  if (!decide_waiting()) return;
  Section* last = open();
  if (comp.corner_arc &&
      comp.has_vector) {  // DGSHAPE G39: from the normal of the block before to the normal of the direction
    if (last && last->start) {
      turn_start(last, *held);
      if (!failed_) ++count_;
      return;
    }
    close();
    if (failed_) return;
    const Vec2 vector = signed_offset(comp) * left_of(unit({comp.vector[0], comp.vector[1]}));
    if (turns_to_tool(tail_, vector, signed_offset(comp))) return fail(next_index(), Condition::comp_turn_inside, nc_source(held->item.source));
    start_commanded_ = held->lead_arc = true;
    lead(held, vector);
    if (!look_at_step(*held)) return;
    turn_ = {true, true, next_index(), vector, nc_source(held->item.source)};
  } else if (comp.corner_arc) {
    if (last) bend_behind(last->index, held->item);
    if (failed_) return;
  } else if (comp.has_vector) {
    mode_ = Mode::on;
    const Vec2 vector = commanded_vector(comp);
    if (last && !last->vanished) {
      tail_ = vector;
      last->joint.set(tail_);
      last->jointed = last->commanded = true;
    } else {  // all joints in front are known
      close();
      if (failed_) return;
      start_commanded_ = true;
      lead(held, vector);
      if (!look_at_step(*held)) return;
    }
    side_changed_ = false;
  }
  ++count_;
}

// Does the block behind an arc that the program has led on begin at the end of this arc? Wherever else it begins, the tool would come nearer to it than the
// amount (DGSHAPE G39: the words are those of the block behind).
bool OffsetStage::turn_fits(const Section& behind) {
  const Turn turn = turn_;
  turn_ = {};
  if (!turn.made || behind.cancel || behind.start) return true;
  const Vec2 vector = perpendicular(behind.begin, behind.offset);
  const double shared = dot(unit(turn.vector), unit(vector));
  if ((1 - shared) * std::min(norm(turn.vector), norm(vector)) <= kEnters_mm) return true;
  fail(turn.waits ? turn.index : behind.index, Condition::comp_turn_inside, turn.source);
  return false;
}

void OffsetStage::intake_section(Held* held, const Leg& begin, const Leg& end) {
  const Move& move = held->item.move;
  const Compensation& comp = move.comp;
  held->role = Role::section;
  Section& section = chain_.new_next();
  section.index = next_index();
  section.block = blocks_;
  section.begin = begin;
  section.end = end;
  section.approach = approach_;
  section.delta = plane_delta(move);
  section.offset = signed_offset(comp);
  section.sweep = begin.curvature != 0 ? move.circle.sweep : 0;
  section.start = mode_ == Mode::pending && !comp.transparent;
  section.cancel = comp.side == 0 || comp.transparent;
  section.check = comp.check;
  section.walls = comp_.check && comp_.walls;  // a cancel goes by what it cancels
  section.level = level_;
  section.level_end = level_end_;
  section.transparent = comp.transparent;
  section.cuts = move.kind != NC_MOVE_RAPID;
  section.led = held->has_lead && !held->lead_arc;
  section.led_from = held->lead_from;
  section.led_turns = section.led && held->lead_from != Vec2{} && !held->lead_crosses;
  section.avoid = comp.avoid;
  section.inch = move.inch;
  section.by_hand = stands_beside(comp);
  if (comp.corner_arc) bend_ = {section.index, nc_source(held->item.source)};
  if (!section.cancel && !section.start) {
    // It begins with the amount of the block before (M700 12.4.6).
    const Section* last = open();
    const double offset_begin = last == nullptr || amount_changed_ ? section.offset : offset_on_side(last->offset, section.offset);
    const double unsure = unsure_of(section.inch);
    section.vanished = vanishes(begin, end, section.offset, unsure) || !tool_fits(begin, offset_begin, unsure);
  }
  if (!turn_fits(section)) return;
  if (trim_next_) held->trim = true;
  trim_next_ = false;
  if (section.start) mode_ = Mode::on;
  join(section, held);
  if (failed_) return;
  if (section.walls) read_wall(&section, held->item.source);
  if (failed_) return;
  if (chain_.empty()) chain_start_ = tail_;
  if (section.cancel) {
    section.joint.set({});
    section.jointed = true;
  } else if (comp.has_vector) {
    section.joint.set(commanded_vector(comp));
    section.jointed = true;
  } else if (comp.hold_vector) {  // M700 12.4.2 G38: the vector of the end before
    section.joint.set(tail_);
    section.jointed = section.holds = true;
  }
  section.commanded = section.jointed;
  if (section.jointed) tail_ = section.joint.v[0];
  if (comp.side == 0) {
    mode_ = Mode::off;
    cancelled_ = false;
  }
  chain_.push_back();
  approach_ = {};
  amount_changed_ = false;
  ++count_;
  // settle() compares its joints. Which sections it may let go depends on arcs that only the avoidance leaves out, so these are looked for first.
  unchecked_ = true;
  for (unsigned i = 0; chain_.may_have_vanished() && i < chain_.size() && unchecked_; ++i) unchecked_ = !chain_[i].vanished;
  if (!unchecked_) check_joints(0);
}

// ---- joints ----

// Decides the joint between the block that is open and `behind`.
void OffsetStage::join(const Section& behind, Held* held_behind) {
  const nc_source& source_behind = held_behind->item.source;
  if (behind.vanished && !decide_waiting()) return;
  Section* last = open();
  if (behind.vanished) {  // M700 12.4.8: only the avoidance can leave such an arc out, once the block behind
                          // it is known
    const bool avoidable = last && !last->vanished && !last->start && last->check && last->avoid;
    if (!avoidable) return fail(behind.index, Condition::comp_interference, source_behind);
  }
  if (!last) return;
  if (Section* const before = waiting()) {
    if (goes_on(*last, behind, held_behind->item.move.comp) && is_part(*before, *last, behind)) {
      before->joint.set(perpendicular(before->end, before->offset));
      last->joint.set(perpendicular(behind.begin, behind.offset));
      before->jointed = last->jointed = last->part = last->bound = true;
      tail_ = last->joint.v[0];
      return;
    }
    if (!decide_waiting()) return;
  }
  if (may_be_part(*last, behind) && goes_on(*last, behind, held_behind->item.move.comp)) return;
  join_pair(last, behind, held_behind);
}

// Two blocks of the contour with one amount, and nothing at their joint that the program says a word about.
bool OffsetStage::goes_on(const Section& before, const Section& behind, const Compensation& comp_behind) {
  const auto plain = [](const Section& section, const Compensation& comp) {
    return !section.start && !section.cancel && !section.vanished && !comp.has_vector && !comp.hold_vector && !comp.corner_arc && comp.arc_cos == 0;
  };
  return plain(before, held_at(before.index).item.move.comp) && plain(behind, comp_behind) && before.offset == behind.offset && !amount_changed_ && behind.approach == Vec2{};
}

// The block whose joint waits for the one behind the next, which is the last.
Section* OffsetStage::waiting() { return chain_.size() > 1 && !chain_.back().jointed && !chain_[chain_.size() - 2].jointed ? &chain_[chain_.size() - 2] : nullptr; }

// There is no such block, or it does not make the next one a part of it. False: the program stops.
bool OffsetStage::decide_waiting() {
  Section* const before = waiting();
  if (before != nullptr) join_pair(before, chain_.back(), &held_at(chain_.back().index));
  return !failed_;
}

void OffsetStage::join_pair(Section* last, const Section& behind, Held* held_behind) {
  Held& held_last = held_at(last->index);
  const Compensation& comp_behind = held_behind->item.move.comp;
  if (last->vanished || behind.vanished) {  // provisional, replaced by the avoidance
    last->joint.set(perpendicular(last->end, last->offset));
    last->jointed = true;
    tail_ = last->joint.v[0];
    return;
  }
  const bool found = find_joint(*last, held_last.item.move.comp, behind, comp_behind, &last->joint);
  last->jointed = true;
  if (!found) return fail(last->index, Condition::comp_no_intersection, held_last.item.source);
  held_last.inner = !last->start && !behind.cancel && cuts_inner_corner(*last, held_last.item.move, behind, held_behind->item.move);
  held_behind->behind_inner = held_last.inner;
  const bool changes_side = !behind.cancel && last->offset * behind.offset < 0;
  if (changes_side || comp_behind.cancel_vector) held_last.trim = held_last.trim_next = held_behind->trim = true;
  last->merge_first = last->end.curvature == 0 && !last->start;
  const bool own_end = !comp_behind.hold_vector && !comp_behind.has_vector && behind.offset == last->offset;
  last->merge_last = behind.begin.curvature == 0 && !behind.cancel && own_end;
  tail_ = last->joint.v[last->joint.n - 1];
}

// False: there is no such joint.
bool OffsetStage::find_joint(const Section& before, const Compensation& comp_before, const Section& behind, const Compensation& comp_behind, ContourJoint* joint) const {
  const bool cancels = comp_behind.side == 0;
  const double offset_behind = cancels ? before.offset : amount_changed_ ? behind.offset : offset_on_side(before.offset, behind.offset);
  if (before.start) {
    *joint = joint_at_start(before.end, behind.begin, offset_behind, comp_before.type_b);
  } else if (cancels && comp_behind.cancel_vector) {
    *joint = joint_at_cancel_vector(before.end, {comp_behind.vector[0], comp_behind.vector[1]}, before.offset);
  } else if (cancels && comp_before.corner_arc && is_outer(before.end, behind.begin, before.offset)) {
    *joint = joint_corner_arc(before.end, behind.begin, before.offset);
  } else if (cancels) {
    *joint = joint_at_cancel(before.end, behind.begin, before.offset, comp_before.type_b);
  } else if (comp_before.corner_arc && offset_behind == before.offset) {
    *joint = joint_corner_arc(before.end, behind.begin, before.offset);
  } else if (comp_before.arc_cos == 0 || offset_behind != before.offset ||
             !joint_of_outer_corner(before.end, behind.begin, before.offset, static_cast<double>(comp_before.arc_cos), joint)) {
    if (!joint_in_mode(before.end, before.offset, before.delta, behind.begin, offset_behind, behind.delta, unsure_of(before.inch), joint)) return false;
    if (comp_before.square_in_spike && offset_behind == before.offset && is_of_spike(*joint, before.offset)) *joint = joint_of_spike(before.end, behind.begin, before.offset);
  }
  return true;
}

// Interference check of what is held; sections below `last_call` are about to be released. False: the program
// stops.
bool OffsetStage::check_joints(unsigned last_call) {
  unsigned at = 0;
  if (!chain_.empty() && check_interference(&chain_, last_call, chain_start(), &at) == Finding::alarm) {
    fail(chain_[at].index, Condition::comp_interference, held_at(chain_[at].index).item.source);
    return false;
  }
  if (chain_.size() < 2) return look_at_left_out(last_call) && look_at_walls(last_call);
  if (!look_at_left_out(last_call)) return false;
  if (chain_.may_have_walls() && !look_at_walls(last_call)) return false;
  unsigned known = chain_.size();
  while (known > 0 && !chain_[known - 1].jointed) --known;
  if (known == 0) return true;
  const ContourJoint& joint = chain_[known - 1].joint;
  tail_ = joint.v[joint.n - 1];
  return true;
}

// With the avoidance: these sections, which have their joints for good, and those that have been read behind them against what it leaves out.
bool OffsetStage::look_at_left_out(unsigned sections) {
  for (unsigned i = 0; i < sections && i < chain_.size(); ++i) {
    const Section& section = chain_[i];
    if (!section.avoid || !section.check || !cuts_into_left_out(chain_, i, chain_start())) continue;
    fail(section.index, Condition::comp_interference, held_at(section.index).item.source);
    return false;
  }
  return true;
}

// The paths of these sections, which have their joints for good, against all blocks of the contour that have been read.
bool OffsetStage::look_at_walls(unsigned sections) {
  Clearance found = Clearance::fits;
  const unsigned at = first_too_near(sections, &found);
  if (found == Clearance::fits) return true;
  stop_by(chain_[at].index, alarm_by(held_at(chain_[at].index).item.source, found, memory_.culprit()));
  return false;
}

// The first of these sections whose path comes too near to a block, as `found` says; `sections`: none does.
unsigned OffsetStage::first_too_near(unsigned sections, Clearance* found) {
  for (unsigned i = 0; i < sections && i < chain_.size(); ++i) {
    Section& section = chain_[i];
    if (!section.walls || section.settled || section.joint.n == 0) continue;
    section.settled = true;
    const ContourJoint* before = i == 0 ? nullptr : &chain_[i - 1].joint;
    const bool from_given = !section.start && (i == 0 ? start_commanded_ : chain_[i - 1].commanded);
    *found = memory_.settle(section, before == nullptr ? chain_start_ : before->v[before->n - 1], from_given, held_at(section.index).item.source);
    held_at(section.index).doubt = memory_.doubt();
    if (*found != Clearance::fits) return i;
  }
  return sections;
}

// The section as a wall, against the paths in front of it.
void OffsetStage::read_wall(Section* section, const nc_source& source) {
  const Compensation& comp = held_at(section->index).item.move.comp;
  const Clearance found = section->by_hand ? memory_.read_by_hand(section, {comp.by_hand[0], comp.by_hand[1]}) : memory_.read(section);
  const ContourMemory::Culprit* const culprit = memory_.culprit();  // which stays where it is: no more is read
  if (found == Clearance::fits || !check_joints(chain_.size())) return;
  stop_by(section->index, alarm_by(source, found, culprit));
}

// ---- letting go ----

void OffsetStage::settle(unsigned n) {
  const bool checks = n > 0 && chain_[0].check;
  if ((checks || unchecked_) && !check_joints(checks ? n : 0)) return;
  unchecked_ = false;
  release(n);
}

// No room to wait any longer: what has its joint goes. If the block that has none is all that is held, its end cannot be known, and a guess would cut
// into the corner or leave it standing.
void OffsetStage::make_room() {
  turn_.waits = false;
  if (!decide_waiting()) return;
  unsigned n = 0;
  while (n < chain_.size() && chain_[n].jointed && !chain_[n].vanished && !(n + 1 < chain_.size() && chain_[n + 1].vanished)) ++n;
  if (n > 0 && !check_joints(n)) return;
  release(n);
  if (next_index() - released_ < kLookAheadItems) return;
  fail(chain_[0].index, Condition::pre_read, held_at(chain_[0].index).item.source);
}

// The first `sections` of the chain have their joints for good.
void OffsetStage::release(unsigned sections) {
  for (unsigned i = 0; i < sections; ++i) {
    Section& section = chain_[i];
    Held& held = held_at(section.index);
    ContourJoint& joint = held.joint;
    joint.copy(section.joint);
    if (joint.lengthened && section.merge_last) --joint.n;
    if (joint.lengthened && section.merge_first && runs_beside(section, chain_start_)) {
      --joint.n;
      for (unsigned k = 0; k < joint.n; ++k) joint.v[k] = joint.v[k + 1];
    }
    held.straight = section.dead || section.oblique;
    held.commanded = start_commanded_ = section.commanded || !section.check;
    held.alone = section.alone;
    held.bound_next = i + 1 < chain_.size() && chain_[i + 1].bound;
    chain_start_ = joint.v[joint.n - 1];
    chain_start_block_ = section.block;
    start_erased_ = joint.last_erased;
  }
  chain_.drop_front(sections);
  wait_for_chain();
}

// The program stops before the move `index`: an alarm takes its place, and what was read behind it is
// forgotten.
void OffsetStage::fail(uint32_t index, Condition condition, const nc_source& source) {
  stop_by(index, alarm_in(source, condition));
}

// What is in front of an alarm is still driven, though not all of it has been looked at, and the last block of it ends at right angles, or otherwise than had
// been thought. Only blocks that can be machined without those behind them stay in the chain. Where one cannot, the alarm stands in front of it; it is P153
// in that block where the blocks around it are known, and the avoidance could not join it to one that there is not (App. 1, P40). Returns the item that the
// alarm takes the place of.
uint32_t OffsetStage::stop_at(uint32_t index, Item* alarm) {
  unsigned size = 0;
  while (size < chain_.size() && static_cast<int32_t>(chain_[size].index - index) < 0) ++size;
  chain_.keep_front(size);
  const auto cut = [&](unsigned at, bool by_itself, Condition condition) {
    index = chain_[at].index;
    if (by_itself) *alarm = alarm_in(held_at(index).item.source, condition);
    chain_.keep_front(at);
  };
  if (waiting() != nullptr) cut(chain_.size() - 1, false, Condition::none);  // whether it is a part of the block before is not known
  if (const Section* first = open(); first != nullptr && first->start) cut(size - 1, false, Condition::none);  // the vector at its end is that of a block that is not reached
  for (unsigned at = 0; interferes(&at);) cut(at, chain_[at].vanished || !chain_[at].avoid, Condition::comp_interference);
  if (Section* last = open()) {
    last->joint.set(perpendicular(last->end, last->offset));
    last->jointed = true;
    // Whether it would have fitted with the vector that it does not get is not known, so it is not to blame.
    if (unsigned at = 0; interferes(&at)) cut(chain_.size() - 1, false, Condition::none);
  }
  Clearance found = Clearance::fits;
  const unsigned near = first_too_near(chain_.size(), &found);
  if (found != Clearance::fits) cut(near, near + 1 < chain_.size(), condition_of(found));
  return index;
}

void OffsetStage::stop_by(uint32_t index, const Item& because) {
  turn_ = {};
  Item alarm = because;
  index = stop_at(index, &alarm);
  release(chain_.size());
  chain_.clear();
  held_at(index) = Held();
  held_at(index).item = alarm;
  if (index == next_index()) {
    ++count_;
  } else {
    for (uint32_t i = index + 1; i != next_index(); ++i) {
      held_at(i) = Held();
      held_at(i).item.kind = ItemKind::move;
      held_at(i).item.move = Move();
      held_at(i).role = Role::command;
    }
  }
  failed_ = true;
  released_ = next_index();
}

}  // namespace nc
