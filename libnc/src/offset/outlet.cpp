// SPDX-License-Identifier: Apache-2.0
// The stage of tool radius compensation, second half: items whose joints are decided leave it, moves with the
// geometry of the tool centre. Only straight displacements along the vectors are added to what was
// programmed.
#include <algorithm>
#include <cmath>

#include "base/same_place.hpp"
#include "base/units.hpp"
#include "offset/offset.hpp"
#include "stream/copy_item.hpp"

namespace nc {
namespace {

constexpr double kSamePoint_mm = 1e-8;

void shift(AxisVec* p, const uint8_t axis[2], Vec2 w) {
  (*p)[axis[0]] += w.h;
  (*p)[axis[1]] += w.v;
}

AxisVec shifted(const AxisVec& p, const uint8_t axis[2], Vec2 w) {
  AxisVec q = p;
  shift(&q, axis, w);
  return q;
}

// Rounding is not a gap: where two ends are the same point they are made the same number.
void snap(AxisVec* start, const AxisVec& last_end) {
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    if (!(std::abs((*start)[i] - last_end[i]) <= kSamePoint_mm)) return;
  }
  *start = last_end;
}

void make_line(Move* move) {
  move->circular = false;
  move->kind = NC_MOVE_LINE;
  move->plane = Plane::none;
  move->circle = Circle{};
}

bool has_length(const Move& move) {
  if (move.circular && std::abs(move.circle.sweep) * move.circle.radius_start > kNoLength) return true;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    if (std::abs(move.end[i] - move.start[i]) > kNoLength) return true;
  }
  return false;
}

// How far the radius turns at one end of an arc. Where the tool passes through the centre itself (its radius is
// that of the arc) nothing is left that could point anywhere: what remains is rounding, and the angle stays.
double radius_turned_by(Vec2 from, Vec2 to, double way) { return norm(to) > kNoLength ? turned(from, to, way) : 0; }

// The centre stays; radii and angles follow the vectors at both ends. Vectors that are not along the radius
// (I J K, a changed amount) make a spiral. M700 12.4.2 "Arc exceeding 360 degrees": with `trim` only what is
// beyond the full circle is travelled. The radii of `circle` are not 0 (goes_round()); those of the result may
// be, so its angles are counted from the programmed ones and lead to `end` whatever the radius at its start.
void shift_circle(Circle* circle, Vec2 start, Vec2 end, Vec2 w_start, Vec2 w_end, bool trim) {
  if (w_start == Vec2{} && w_end == Vec2{}) return;
  const Vec2 center{circle->center[0], circle->center[1]};
  const Vec2 from = start + w_start - center, to = end + w_end - center;
  const double turn_start = radius_turned_by(start - center, from, circle->sweep);
  const double sweep = circle->sweep + radius_turned_by(end - center, to, -circle->sweep) - turn_start;
  circle->radius_start = norm(from);
  circle->radius_end = norm(to);
  circle->angle_start += turn_start;
  const double full = 2 * kPi;
  const bool exceeds = trim && std::abs(circle->sweep) <= full + 1e-9 && std::abs(sweep) > full + 1e-9;
  circle->sweep = exceeds ? sweep - std::copysign(full, sweep) : sweep;
}

double straight_length(const Move& move) {
  double squares = 0;
  for (unsigned i = 0; i < kMaxAxes; ++i) squares += (move.end[i] - move.start[i]) * (move.end[i] - move.start[i]);
  return std::sqrt(squares);
}

// HX 5.3.6: what is cut by an inner arc goes at F where the centre of the tool goes at F times the ratio of the radii.
void slow_inner_arc(const Move& programmed, Move* move) {
  const double least = static_cast<double>(programmed.rule.inner_arc), before = programmed.circle.radius_start, now = move->circle.radius_start;
  if (least <= 0 || !programmed.circular || !move->circular || !(now < before)) return;
  move->rule.scale = std::max(now / before, std::min(least, 1.0));
}

// The end of the first `way` mm of a move, which the rest begins with; false: the move is not longer than that.
bool cut_in_two(const Move& whole, double way, Move* first, Move* rest) {
  double squares = 0;
  const double round = whole.circular ? (whole.circle.radius_start + whole.circle.radius_end) / 2 * whole.circle.sweep : 0;
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if (!whole.circular || (i != whole.plane_axis[0] && i != whole.plane_axis[1])) squares += (whole.end[i] - whole.start[i]) * (whole.end[i] - whole.start[i]);
  const double length = std::sqrt(squares + round * round), part = way / length;
  if (!(length > way + kNoLength)) return false;
  *first = *rest = whole;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    first->end[i] = whole.start[i] + part * (whole.end[i] - whole.start[i]);
    first->work[i] = whole.work[i] + (1 - part) * (whole.start[i] - whole.end[i]);
  }
  if (whole.circular) {
    Circle& head = first->circle;
    Circle& tail = rest->circle;
    head.sweep = whole.circle.sweep * part;
    tail.sweep = whole.circle.sweep - head.sweep;
    tail.angle_start = whole.circle.angle_start + head.sweep;
    head.radius_end = tail.radius_start = whole.circle.radius_start + part * (whole.circle.radius_end - whole.circle.radius_start);
    const double at[2] = {std::cos(tail.angle_start), std::sin(tail.angle_start)};
    for (unsigned i = 0; i < 2; ++i) {
      const unsigned axis = whole.plane_axis[i];
      first->end[axis] = whole.circle.center[i] + tail.radius_start * at[i];
      first->work[axis] = whole.work[axis] + first->end[axis] - whole.end[axis];
    }
  }
  rest->start = first->end;
  first->exact_stop = false;
  return true;
}

// M700 7.5: inverse time is that of the block, so the tool centre goes as much faster as its path is longer, or its radius larger.
void scale_feed(const Move& programmed, Move* move) {
  move->rule.scale = 0;
  if (!programmed.rule.inverse_time) return slow_inner_arc(programmed, move);
  const double before = programmed.circular ? programmed.circle.radius_start : straight_length(programmed);
  const double now = move->circular ? move->circle.radius_start : straight_length(*move);
  if (before > 0 && now > 0) move->rule.scale = now / before;
}

Plane plane_of(const Move& like) {
  if (like.circular) return like.plane;
  const unsigned h = like.comp.axis[0], v = like.comp.axis[1];
  if (h == 0 && v == 1) return Plane::xy;
  if (h == 2 && v == 0) return Plane::zx;
  return h == 1 && v == 2 ? Plane::yz : Plane::none;
}

// A rapid move has no feed. One that an arc is inserted behind has brought that of the arc with it (intake_command()).
void drop_feed_of_rapid(Move* move) {
  if (move->kind == NC_MOVE_RAPID) move->feed_mm_min = move->feed_mm_rev = 0;
}

// A straight displacement in the plane, in the manner of the block `like` that it belongs to (M700 7.5 (4):
// at its feed).
void make_straight(const Item& like, const AxisVec& programmed, const AxisVec& start, const AxisVec& end,
                   Item* out) {
  *out = like;
  out->block_end = false;
  Move& move = out->move;
  move.kind = like.move.kind == NC_MOVE_RAPID ? NC_MOVE_RAPID : NC_MOVE_LINE;
  move.rule.slow_zone = 0;
  move.circular = false;
  move.connecting = true;
  move.skip_mask = 0;
  move.skip_away = false;
  move.plane = Plane::none;
  move.start = start;
  move.end = end;
  move.work = programmed;
  move.circle = Circle{};
  drop_feed_of_rapid(&move);
}

// Makes the displacement an arc about the programmed point (G39), at the feed of the move `like`. Half a turn goes round the outside.
void bend(const Move& like, const AxisVec& programmed, Vec2 from, Vec2 to, Item* out) {
  Move& move = out->move;
  const Plane plane = plane_of(like);
  move.feed_mm_min = like.feed_mm_min;
  move.feed_mm_rev = like.feed_mm_rev;
  const uint8_t* axis = move.comp.axis;
  move.kind = NC_MOVE_ARC;
  move.circular = true;
  move.plane = plane;
  for (unsigned i = 0; i < 2; ++i) {
    move.plane_axis[i] = axis[i];
    move.work_center[i] = move.circle.center[i] = programmed[axis[i]];
  }
  move.circle.radius_start = norm(from);
  move.circle.radius_end = norm(to);
  move.circle.angle_start = std::atan2(from.v, from.h);
  move.circle.sweep = corner_sweep(from, to, signed_offset(move.comp));
}

}  // namespace

bool OffsetStage::pop_ready(Item& out) {
  if (has_rest_) [[unlikely]] {
    out = rest_;
    has_rest_ = false;
    return true;
  }
  while (first_ != released_) {
    Held& held = held_at(first_);
    if (held.item.kind == ItemKind::move) {
      if (pop_move(&held, out)) return true;
      continue;
    }
    copy_item(held.item, &out);
    if (held.item.kind == ItemKind::mark) {
      note_mark(held);
      out.mark.resume = out.mark.resume && !bound_ && !held.passed;
    }
    drop_front();
    return true;
  }
  return false;
}

// One step with the move in front. False: nothing came out of it.
bool OffsetStage::pop_move(Held* held, Item& out) {
  if (held->has_lead && !lead_done_) {
    lead_done_ = true;
    if (pop_lead(*held, out)) return true;
  }
  switch (held->role) {
    case Role::pass:
      out = held->item;
      bound_ = false;
      vector_ = {};
      resume_.programmed = resume_.compensated = held->item.move.end;
      drop_front();
      return true;
    case Role::command:
      resume_.comp = held->item.move.comp;
      drop_front();
      return false;
    case Role::carried: {
      const bool any = pop_shifted(*held, vector_, out);
      drop_front();
      return any;
    }
    case Role::section:
      break;
  }
  if (connecting_ == 0) {
    note_section(*held);
    axis_[0] = held->item.move.comp.axis[0];
    axis_[1] = held->item.move.comp.axis[1];
    const bool any = pop_shifted(*held, held->joint.v[0], out);
    if (held->joint.n > 1) {
      connecting_ = 1;
    } else {
      drop_front();
    }
    return any;
  }
  pop_connecting(*held, out);
  if (++connecting_ == held->joint.n) drop_front();
  return has_length(out.move);
}

// The move itself, from the vector in force to `end_vector`.
bool OffsetStage::pop_shifted(const Held& held, Vec2 end_vector, Item& out) {
  const Move& programmed = held.item.move;
  out = held.item;
  Move& move = out.move;
  shift(&move.start, axis_, vector_);
  snap(&move.start, resume_.compensated);
  shift(&move.end, axis_, end_vector);
  const bool in_plane = move.circular && move.plane_axis[0] == axis_[0] && move.plane_axis[1] == axis_[1];
  if (in_plane && (held.straight || !goes_round(programmed))) {  // only axes off the plane still move; a straight line
    make_line(&move);
  } else if (in_plane) {
    const Vec2 start{programmed.start[axis_[0]], programmed.start[axis_[1]]};
    const Vec2 end{programmed.end[axis_[0]], programmed.end[axis_[1]]};
    shift_circle(&move.circle, start, end, vector_, end_vector, held.trim);
    // An arc whose radius is that of the tool: what is left of it is rounding, which would stop the machine as the bend that it is.
    if (std::max(move.circle.radius_start, move.circle.radius_end) < unsure_of(move.inch)) make_line(&move);
  } else if (move.circular) {  // an arc in another plane goes along as a whole
    for (unsigned i = 0; i < 2; ++i) {
      if (move.plane_axis[i] == axis_[0]) move.circle.center[i] += vector_.h;
      if (move.plane_axis[i] == axis_[1]) move.circle.center[i] += vector_.v;
    }
  }
  vector_ = end_vector;
  if (!held.inner) move.rule.slow_zone = 0;
  drop_feed_of_rapid(&move);
  scale_feed(programmed, &move);
  feed_scale_ = programmed.rule.inverse_time ? move.rule.scale : 0;
  if (!has_length(move) && !move.leads_space) {
    note_move(held, resume_.compensated);
    return false;
  }
  note_move(held, move.end);
  if (held.behind_inner && move.rule.behind_zone > 0 && move.rule.corner_override > 0 && move.shape == 0) slow_behind_corner(out);
  return true;
}

// HX 5.3.5: the first part of a block behind an inner corner has the override, too, and is a move of its own.
void OffsetStage::slow_behind_corner(Item& out) {
  const Move whole = out.move;
  Move rest;
  const float zone = whole.rule.behind_zone;
  if (cut_in_two(whole, static_cast<double>(zone), &out.move, &rest)) {
    rest_ = out;
    rest_.move = rest;
    has_rest_ = true;
    out.block_end = false;
  }
  out.move.rule.slow_zone = std::max(zone, out.move.rule.slow_zone);
}

// The displacement before a move: the perpendicular vector of a start without movement, a vector commanded
// without movement.
bool OffsetStage::pop_lead(const Held& held, Item& out) {
  const Move& move = held.item.move;
  AxisVec start = shifted(move.start, axis_, vector_);
  snap(&start, resume_.compensated);
  const Vec2 from = vector_;
  axis_[0] = move.comp.axis[0];
  axis_[1] = move.comp.axis[1];
  vector_ = held.lead;
  out_commanded_ = true;  // where the section behind it is not its own
  const AxisVec end = shifted(move.start, axis_, vector_);
  make_straight(held.item, move.start, start, end, &out);
  out.move.rule.scale = feed_scale_;
  if (held.lead_arc && bendable(from, vector_)) bend(move, move.start, from, vector_, &out);
  if (!has_length(out.move)) return false;
  resume_.compensated = end;
  return true;
}

// From one vector of a joint to the next (M700 12.4.2 "Corner movement").
void OffsetStage::pop_connecting(const Held& held, Item& out) {
  const Move& move = held.item.move;
  const Vec2 from = held.joint.v[connecting_ - 1], to = held.joint.v[connecting_];
  make_straight(held.item, move.work, resume_.compensated, shifted(move.end, axis_, to), &out);
  out.move.rule.scale = feed_scale_;
  if (held.joint.corner_arc && bendable(from, to)) bend(move, move.end, from, to, &out);
  vector_ = to;
  if (has_length(out.move)) resume_.compensated = out.move.end;
}

void OffsetStage::drop_front() {
  --count_;
  ++first_;
  lead_done_ = false;
  connecting_ = 0;
}

void OffsetStage::note_move(const Held& held, const AxisVec& compensated_end) {
  const Move& programmed = held.item.move;
  resume_.programmed = programmed.end;
  resume_.compensated = compensated_end;
  resume_.comp = programmed.comp;
  if (held.direction != Vec2{}) direction_ = held.direction;
}

void OffsetStage::note_section(const Held& held) {
  out_commanded_ = held.commanded;
  out_trim_ = held.trim_next;
  out_alone_ = held.alone;
  bound_ = held.bound_next;
  doubt_ = held.doubt;
}

void OffsetStage::note_mark(const Held& held) {
  resume_.active = held.mode != Mode::off;
  resume_.pending = held.mode == Mode::pending;
  resume_.idle_blocks = held.idle_blocks;
  resume_.cancelled = held.cancelled;
  resume_.level = held.level;
  resume_.contour.open = false;
  if (held.in_contour) resume_.contour = ContourMemory::with(contour_at(held), doubt_);
  resume_.commanded = out_commanded_;
  resume_.trim = out_trim_;
  resume_.approach[0] = held.approach.h;
  resume_.approach[1] = held.approach.v;
  resume_.side_changed = held.side_changed;
  resume_.given = held.given || out_alone_;  // whether a block behind comes in time is known later than its mark
  resume_.feed_scale = feed_scale_;
  resume_.vector[0] = vector_.h;
  resume_.vector[1] = vector_.v;
  resume_.direction[0] = direction_.h;
  resume_.direction[1] = direction_.v;
}

}  // namespace nc
