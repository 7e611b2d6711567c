// SPDX-License-Identifier: Apache-2.0
// The strokes of a fixed cycle (cycle/strokes.cpp) -> moves, dwells, M codes and places where single block stops.
#include <cmath>

#include "base/same_place.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/cycle.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// `start`, but where `axes` go.
AxisVec plain_end(const AxisVec& start, const AxisVec& target, uint32_t axes) {
  AxisVec end = start;
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if (((axes >> i) & 1) != 0) end[i] = target[i];
  return end;
}

AxisVec as_programmed(const BlockInHand& in, const AxisVec& place) { return program_mapped(in) ? to_program(in, place) : place; }
AxisVec as_moved(const BlockInHand& in, const AxisVec& place) { return program_mapped(in) ? from_program(in, place) : place; }

uint32_t stroke_plane(const InForce& in) {
  uint32_t axes = 0;
  for (const int axis : in.state.plane_axis)
    if (axis >= 0) axes |= 1u << axis;
  return axes & ~(1u << in.state.cycle.drill_axis);
}

/// M700 13.1.1, "absolute/incremental": where R is incremental its sign is ignored. It has that of Z, of back boring the other one; where Z is a coordinate R lies on
/// the side of the initial level where the bottom does, with either.
double incremental_r(const InForce& in, double initial) {
  const CycleState& c = in.state.cycle;
  if (!in.dialect->rules.cycle.r_takes_sign_of_z || !c.has_z) return c.r;
  if (!c.z_incremental) return c.z == initial ? c.r : std::copysign(c.r, c.z - initial);
  return std::copysign(c.r, c.kind == CycleKind::back_bore ? -c.z : c.z);
}

double clearance(const InForce& in, CycleKind kind) {
  const double fixed = in.dialect->rules.cycle.fixed_clearance_mm;
  if (fixed > 0) return fixed;
  if (is_tap(kind)) return in.settings.tap_clearance;
  return kind == CycleKind::step ? in.settings.step_clearance : in.settings.peck_clearance;
}

/// The times of the hole. M700 13.1.1, "synchronous tap in-position check": #1313 is the least of the "hole bottom wait time" where the checks are chosen by
/// bits, and back at R there is P alone.
void resolve_dwells(const InForce& in, Hole* hole) {
  const CycleState& c = in.state.cycle;
  const CycleRules& rules = in.dialect->rules.cycle;
  const bool takes_p = c.kind != CycleKind::circle && (c.kind != CycleKind::bore_stop || rules.bore_stop_dwells) && (c.kind != CycleKind::step || rules.step_dwells);
  const double p = c.has_p && takes_p ? c.p / 1000 : 0;
  hole->dwell_s = c.synchronous && in.settings.tap_checks ? std::fmax(p, in.settings.tap_dwell_s) : p;
  hole->dwell_at_r_s = p;
}

/// Levels of this hole from the hole data (M700 13.1.1 "Absolute/incremental").
void resolve_levels(BlockInHand& in) {
  const CycleState& c = in.state.cycle;
  const CycleRules& rules = in.dialect->rules.cycle;
  Hole& h = in.jobs.holes.hole;
  h.kind = tap_in_cuts(in, c.kind);
  h.has_first = c.has_first;
  h.first = c.first;
  h.synchronous = c.synchronous;
  // As a coordinate of now: the zero point may have changed since the cycle was commanded. A tool length that comes into
  // force in between (also one that is pending, M700 12.2) displaces this level like every other end point.
  h.initial = programmed_on(in, c.drill_axis, c.initial_level - in.zero()[c.drill_axis]);  // levels as programmed; the maps come last
  if (!c.has_r) {
    h.r = h.initial;  // DGSHAPE: omitted R = initial level
  } else {
    h.r = c.r_incremental ? h.initial + incremental_r(in, h.initial) : c.r;
  }
  h.bottom = !c.has_z ? h.r : c.z_incremental ? h.r + c.z : c.z;
  h.third = c.third_incremental ? h.bottom + c.third : c.third;
  const bool below = cuts_down(h) ? h.initial < h.r : h.initial > h.r;
  if (rules.rises_before_positioning && below) h.initial = h.r;  // it has gone up
  if (program_mapped(in))  // M700 13.6, 13.19
    for (double* level : {&h.initial, &h.r, &h.bottom, &h.third, &h.first}) *level = mapped_on(in, c.drill_axis, *level);
  h.return_to = rules.ends_at_r || in.state.modal.is(Function::return_r) ? h.r : h.initial;
}

/// Beside the hole. The shift is that of the spindle, which stands oriented: no map of the program scales, mirrors or turns it (HX 15.2.2, Series 8 G88), or the tip
/// would be drawn along the wall.
AxisVec place_beside(BlockInHand& in) {
  const ShiftInPlane by = shift_in_plane(in);
  AxisVec place = in.jobs.holes.over;
  for (unsigned i = 0; i < 2; ++i)
    if (by.way[i] != 0) place[static_cast<unsigned>(in.state.plane_axis[i])] += by.way[i];
  return place;
}

void resolve_hole(BlockInHand& in) {
  const CycleState& c = in.state.cycle;
  Hole& h = in.jobs.holes.hole;
  resolve_levels(in);
  h.q = in.jobs.holes.whole ? 0 : is_tap(c.kind) ? c.tap_q : std::fabs(c.q);
  resolve_dwells(in, &h);
  h.clearance = clearance(in, c.kind);
  if (strokes_of(c.kind).moves_in_plane) in.jobs.holes.over = in.position();
  if (strokes_of(c.kind).shifts) in.jobs.holes.beside = place_beside(in);
}

/// RS-274/NGC 3.5.16: the tool leaves the material before it goes to the next hole, and R is the level from then on.
void rise_to_level(BlockContext& in) {
  resolve_levels(in);
  const unsigned axis = in.state.cycle.drill_axis;
  const Hole& h = in.jobs.holes.hole;
  AxisVec target = in.position();
  const double up = cuts_down(h) ? 1.0 : -1.0;
  if ((h.r - target[axis]) * up <= 0) return;
  target[axis] = h.r;
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  move_linear(in, target, 1u << axis, style);
}

/// A line as the words of a block would make it, in the motion in force.
LinearStyle by_motion_in_force(InForce& in, const AxisVec& start, const AxisVec& end) {
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  if (in.state.modal.is(Function::rapid)) return style;
  style.kind = NC_MOVE_LINE;
  style.feed_mm_min = feed_for(in, start, end);
  style.special_feed = special_feed(in);
  style.exact_stop = true;  // the cycle begins behind it
  return style;
}

/// Where the hole in hand of a pattern lies.
AxisVec place_in_pattern(const BlockInHand& in) {
  const HolePattern& pattern = in.jobs.holes.pattern;
  double place[2];
  place_of_hole(pattern, pattern.count() - in.jobs.holes.left, place);
  AxisVec target = in.jobs.holes.pattern_at;
  for (unsigned i = 0; i < 2; ++i) target[in.jobs.holes.pattern_axis[i]] += place[i];
  return as_moved(in, target);
}

/// Hole of a pattern (M700 13.2): in rapid where a cycle is in force, else by the motion in force.
void position_in_pattern(BlockContext& in) {
  const AxisVec target = place_in_pattern(in);
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  const uint32_t axes = 1u << in.jobs.holes.pattern_axis[0] | 1u << in.jobs.holes.pattern_axis[1];
  if (in.state.cycle.kind == CycleKind::none) {
    style = by_motion_in_force(in, in.position(), target);
  } else if (traverse_beyond_level(in, target, axes)) {
    return;
  }
  move_linear(in, target, axes, style);
}

/// Half circles and the circle of M700 13.1.1, G75: about the hole, its entry on the minus side of the plane's first axis.
void move_on_circle(BlockContext& in, StrokeKind kind) {
  const CycleState& c = in.state.cycle;
  uint32_t number = 0;
  whole_number(c.p, &number);
  const PlaneAxes plane = plane_axes(in);
  const auto h = static_cast<unsigned>(plane.h);
  const double radius = std::fabs(c.q) - radius_amount(in, number) / scale_of(in, h);
  const bool in_centre = kind == StrokeKind::circle_out;
  AxisVec end = as_programmed(in, in.jobs.holes.over);
  if (!in_centre) end[h] -= radius;
  AxisVec target = in.position();
  const AxisVec mapped = as_moved(in, end);
  for (const int axis : in.state.plane_axis) target[static_cast<unsigned>(axis)] = mapped[static_cast<unsigned>(axis)];
  ArcWords words;
  words.center[0] = kind == StrokeKind::circle_in ? -radius / 2 : kind == StrokeKind::circle ? radius : radius / 2;
  move_arc_by(in, plane, target, stroke_plane(in), words, c.q < 0);
}

void move_in_plane(BlockContext& in, const CycleStep& step) {
  const AxisVec& place = step.level == Level::beside ? in.jobs.holes.beside : in.jobs.holes.over;
  LinearStyle style;
  style.kind = step.kind == StrokeKind::shift_rapid ? NC_MOVE_RAPID : NC_MOVE_LINE;
  if (style.kind == NC_MOVE_LINE) {
    style.feed_mm_min = feed_mm_min(in);
    style.special_feed = special_feed(in);
  }
  style.exact_stop = true;
  move_linear(in, plain_end(in.position(), place, stroke_plane(in)), stroke_plane(in), style);
}

/// A stroke of a tap that goes with the spindle: the lead, and the speed that the spindle is to have (M700 13.1.1 (6) (c): on the way back not
/// below that of the way in).
void set_tap(const BlockInHand& in, const CycleStep& step, LinearStyle* style) {
  const CycleState& c = in.state.cycle;
  const bool back = step.level != Level::bottom && step.level != Level::peck;
  // #1172 is the return override of the family; precaution (15): ,S switches it off.
  const double s = in.state.modal.spindle, by_override = in.settings.tap_return > 0 ? in.settings.tap_return * s : s;
  const double speed = !back ? s : c.return_speed > 0 ? std::fmax(c.return_speed, s) : by_override;
  const TapLaw law = tap_law(in, speed, std::fabs(step.to - in.position()[c.drill_axis]) / c.pitch);
  const double hand = taps_left_hand(c.kind) != back ? -1.0 : 1.0;
  style->kind = NC_MOVE_TAP;
  style->special_feed = false;
  style->feed_mm_rev = c.pitch;
  style->feed_mm_min = c.pitch * law.rev_min;
  style->tap_speed = hand * law.rev_min;
  style->tap_slope = law.slope;
}

/// A stroke of a synchronous tap to R or to the bottom, whose check is the tap's and not that of a move.
bool checks_itself(const InForce& in, const CycleStep& step) {
  if (!in.state.cycle.synchronous) return false;
  return (step.kind == StrokeKind::rapid && step.level == Level::r) || (step.kind == StrokeKind::feed && (step.level == Level::r || step.level == Level::bottom));
}

void move_along(BlockContext& in, const CycleStep& step) {
  const CycleState& c = in.state.cycle;
  if (!goes_along_axis(in, c.drill_axis, step.to)) return;
  LinearStyle style;
  style.kind = step.kind == StrokeKind::rapid ? NC_MOVE_RAPID : NC_MOVE_LINE;
  if (style.kind != NC_MOVE_RAPID) style.feed_mm_min = feed_mm_min(in);
  style.special_feed = style.kind != NC_MOVE_RAPID && special_feed(in);
  style.exact_stop = true;  // every level of a hole is reached
  style.tapping = (step.flags & kStrokeTaps) != 0;
  if (style.tapping && c.synchronous) set_tap(in, step, &style);
  const double width = (step.flags & kStrokeReturns) != 0 && strokes_of(c.kind).takes_widths ? c.in_position : 0;
  style.in_position = width;
  style.checks_itself = checks_itself(in, step);
  const bool taps_next = is_tap(c.kind) && step.level == Level::r;  // a hold on the way in comes to rest in front of the thread, or behind the way back
  style.flows = in.retract_overlap > 0 && style.kind == NC_MOVE_RAPID && width == 0 && !taps_next && strokes_flow(in);
  move_axis(in, c.drill_axis, step.to, style);
}

/// M700 13.1.1 (7): #3028 names the M of the spindle forward in taps; reverse is the one behind it.
void turn_spindle(BlockContext& in, CycleSpindle turn) {
  const bool reverse = turn == CycleSpindle::reverse || (turn == CycleSpindle::as_before && in.state.spindle_reverse);
  MiscFunction function = reverse ? MiscFunction::spindle_reverse : MiscFunction::spindle_forward;
  if (turn == CycleSpindle::stop) function = MiscFunction::spindle_stop;
  if (turn == CycleSpindle::orient) function = MiscFunction::spindle_oriented;
  const bool turns = turn != CycleSpindle::stop && turn != CycleSpindle::orient;
  if (turns && is_tap(in.state.cycle.kind) && in.settings.spindle_forward_m != 0)
    return give_out_spindle(in, function, reverse ? in.settings.spindle_reverse_m : in.settings.spindle_forward_m);
  uint32_t out = misc_code(*in.dialect, function);
  give_out_spindle(in, function, out);
}

/// M700 13.1.1, "in-position check during synchronous tapping": at R on the way in, at the bottom, and back at R. With #1223 bit 3 each of the three has a bit of
/// its own, and there is none without P; else all of them are made where the parameters of 7.9 ask for them, without G09 and G61.
void check_tap_position(BlockContext& in, const CycleStep& step) {
  const Settings& s = in.settings;
  if (!checks_itself(in, step)) return;
  const bool approach = step.kind == StrokeKind::rapid, bottom = step.level == Level::bottom;
  const bool by_bit = in.state.cycle.has_p && (approach ? s.tap_check_approach : bottom ? s.tap_check_bottom : s.tap_check_r);
  const bool by_method = approach ? s.check_rapid : s.check_cutting;
  if (s.tap_checks ? by_bit : by_method) in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION;
}

void emit_dwell(BlockContext& in, double seconds) {
  if (!(seconds > 0)) return;
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = NC_GATE_DWELL_SECONDS;
  gate.announce = true;
  gate.value = seconds;
}

void make_stroke(BlockContext& in, const CycleStep& step, CountedStrokes& counted) {
  if (goes_along(step.kind)) {  // most do, and a jump by a table is foreseen less often than this one
    if (counted.take(step)) return;
    move_along(in, step);
    return check_tap_position(in, step);
  }
  switch (step.kind) {
    case StrokeKind::shift_rapid:
    case StrokeKind::shift_feed: move_in_plane(in, step); break;
    case StrokeKind::circle_in:
    case StrokeKind::circle:
    case StrokeKind::circle_out: move_on_circle(in, step.kind); break;
    case StrokeKind::dwell: emit_dwell(in, dwell_of(in.jobs.holes.hole, step.level)); break;
    case StrokeKind::spindle: turn_spindle(in, step.spindle); break;
    case StrokeKind::program_stop: in.emit(ItemKind::gate).gate.kind = NC_GATE_STOP; break;
    case StrokeKind::rapid:
    case StrokeKind::feed:
    case StrokeKind::again: break;
  }
}

/// M700 13.1.1, G84: a hold that comes between R and R again acts behind the way back.
void note_tapping(BlockContext& in, bool strokes) {
  if (in.jobs.holes.tapping == strokes) return;
  in.jobs.holes.tapping = strokes;
  announce_tapping(in, strokes);
}
bool ends_tapping(const CycleStep& step) { return (step.flags & (kStrokeTaps | kWhilePecking)) == kStrokeTaps && (step.level == Level::r || step.level == Level::exit); }

}  // namespace

ShiftInPlane shift_in_plane(const InForce& in) {
  const CycleState& c = in.state.cycle;
  const PlanePair pair = pair_of(in.state.modal.of(Mode::plane));
  const unsigned along[2] = {pair.first, pair.second};
  ShiftInPlane by;
  bool moves[2];
  for (unsigned i = 0; i < 2; ++i) {
    moves[i] = in.state.plane_axis[i] >= 0 && in.state.plane_axis[i] != c.drill_axis;  // with #1080 the plane may have Z, which drills
    if (moves[i]) by.way[i] = c.shift[along[i]];
  }
  if (by.way[0] != 0 || by.way[1] != 0 || c.q == 0) return by;
  const Settings& s = in.settings;
  for (unsigned i = 0; i < 2; ++i) {
    if (!moves[i]) continue;
    const auto axis = static_cast<unsigned>(in.state.plane_axis[i]);
    const bool by_choice = s.shift_axis >= 0 && s.shift_direction != 0 && (s.shift_axis != 0) == (i != 0);  // HX 12.3.9
    if (by_choice) by.way[i] = s.shift_direction * std::fabs(c.q);
    if (!s.drilling_axis_z) continue;
    const bool ignored = (s.shift_ignored >> axis & 1) != 0;
    by.none_by_parameter = by.none_by_parameter || ignored;
    if (!ignored) by.way[i] = (s.shift_minus >> axis & 1) != 0 ? -std::fabs(c.q) : std::fabs(c.q);
  }
  return by;
}

/// The move to the hole. Axes that neither drill nor are of the plane go first (M700 13.1.1 precaution (6)), by the motion from
/// before the cycle (13.1.2, example 2, N012): rapid by G00, else a line with the feed, which is what such an axis does beside an arc, too.
/// Then the plane in rapid traverse, which ,I of the block belongs to.
void position_over_hole(BlockContext& in) {
  if (in.jobs.holes.pattern.kind != PatternKind::none) return position_in_pattern(in);
  const Targets over = in.jobs.holes.target.without(1u << in.state.cycle.drill_axis);
  const uint32_t axes = over.axes();
  const uint32_t over_hole = positioning_axes(in);
  const AxisVec start = in.position(), target = target_of(in, start, over);
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  if (strokes_of(in.state.cycle.kind).takes_widths) style.in_position = in.words.in_position;
  if (in.words.one_shot == nullptr && style.in_position == 0 && (axes & ~over_hole) == 0 && traverse_beyond_level(in, target, axes)) return;
  if (in.words.one_shot != nullptr && in.words.one_shot->function == Function::unidirectional)  // M700 6.8, HX 4.2: not the axis that drills
    move_linear(in, before_creep(in, target, axes), axes, style);
  if (!in.dialect->rules.cycle.others_keep_motion_mode) return move_linear(in, target, axes, style);  // all of them together (Series 8 G81: X Y A)
  if ((axes & ~over_hole) != 0) {
    const LinearStyle other = by_motion_in_force(in, start, plain_end(start, target, axes & ~over_hole));
    move_linear(in, target, axes & ~over_hole, other);
  }
  move_linear(in, target, axes & over_hole, style);
}

/// The block goes on at the place where the tool stands, but for the axis that drills.
bool stays_over_hole(const BlockInHand& in) {
  const AxisVec start = in.position();
  const unsigned drills = in.state.cycle.drill_axis;
  const bool pattern = in.jobs.holes.pattern.kind != PatternKind::none;
  const AxisVec target = pattern ? place_in_pattern(in) : target_of(in, start, in.jobs.holes.target.without(1u << drills));
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (i != drills && std::fabs(target[i] - start[i]) > kAddingUp) return false;
  return true;
}

/// Series 8 G87: the tool stands at the bottom of a layer. A block at another place begins a hole of its own ("first block"), and the tool leaves the one it is
/// in by its R, or by the R of the new one where that is higher. The R of a lower layer is no R of the new one, which would be entered in rapid traverse.
Execution leave_hole(BlockContext& in) {
  CycleState& c = in.state.cycle;
  if (!c.in_hole || stays_over_hole(in)) return Execution::done;
  resolve_levels(in);
  const Hole& h = in.jobs.holes.hole;
  const double up = cuts_down(h) ? 1.0 : -1.0, out = c.way_out - in.zero()[c.drill_axis];
  const bool r_of_layer = (out - h.r) * up > kAddingUp;
  if (r_of_layer && !in.words.has(Role::cycle_level)) return in.raise(Condition::words_missing, Role::cycle_level);
  c.in_hole = false;
  AxisVec target = in.position();
  const double level = r_of_layer ? out : h.r;
  if ((level - target[c.drill_axis]) * up <= 0) return Execution::done;
  target[c.drill_axis] = level;
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  move_linear(in, target, 1u << c.drill_axis, style);
  if (in.words.cycle != nullptr) c.initial_level = in.state.machine[c.drill_axis] - in.state.applied[c.drill_axis];  // its code begins from here
  return Execution::done;
}

/// Notes the way out of the hole where the tool stays in it.
void note_hole(BlockInHand& in) {
  CycleState& c = in.state.cycle;
  const bool stays = c.kind == CycleKind::case_bore;
  if (stays && !c.in_hole) c.way_out = in.jobs.holes.hole.r + in.zero()[c.drill_axis];
  c.in_hole = stays;
}

/// M700 13.1.1 (2): "M00 and M01 will be output after positioning", precaution (5): once, where the block makes several holes. True: the program stops here
/// whatever the switches say, so single block needs no stop of its own.
bool stop_over_hole(BlockContext& in) {
  if (!in.dialect->rules.cycle.stops_over_hole || in.words.stops_given_out || in.state.cycle.kind == CycleKind::none) return false;
  in.words.stops_given_out = true;
  bool stops = false;
  for (const Auxiliary& m : in.words.auxiliary) {
    if (!stops_program(m.function)) continue;
    auxiliary_behind(in, m);
    stops = stops || m.function == MiscFunction::program_stop;
  }
  return stops;
}

Execution begin_hole(BlockContext& in) {
  const Execution left = leave_hole(in);
  if (left != Execution::done) return left;
  if (in.dialect->rules.cycle.rises_before_positioning) rise_to_level(in);
  position_over_hole(in);
  const bool hole = in.state.cycle.kind != CycleKind::none && !in.jobs.holes.places_only;
  if (hole && !stop_over_hole(in)) in.emit_stop_point();  // places alone have one stop each
  resolve_hole(in);
  if (!hole) {
    in.jobs.holes.hole.kind = CycleKind::none;
    in.jobs.holes.hole.dwell_s = in.jobs.holes.hole.dwell_at_r_s = 0;
  }
  note_hole(in);
  in.jobs.holes.progress = begin_strokes(in.jobs.holes.hole);
  in.next_step = Step::cycle;
  return Execution::later;
}

namespace {

Execution make_strokes(BlockContext& in, CountedStrokes& counted) {
  HolesOfBlock& holes = in.jobs.holes;
  while (in.queue_has_room()) {
    CycleStep step;
    if (next_stroke(holes.hole, holes.progress, &step)) {
      holes.inside = true;
      if ((step.flags & kStrokeTaps) != 0) note_tapping(in, true);
      make_stroke(in, step, counted);
      if (ends_tapping(step)) note_tapping(in, false);
      if ((step.flags & kStrokeStops) != 0 && !counted.take_stop_point()) in.emit_stop_point();
      holes.inside = false;
      continue;
    }
    if (!holes.places_only) in.state.cycle.returned = way_back(in);
    if (--holes.left == 0 || holes.one_by_one) return Execution::done;
    in.emit_stop_point();  // single block also stops at the end of each hole but the last, where the block itself ends
    if (holes.polar.on) step_polar_hole(in);
    return begin_hole(in);
  }
  return Execution::later;
}

}  // namespace

Execution continue_cycle(BlockContext& in) {
  CountedStrokes counted(in);
  const Execution did = make_strokes(in, counted);
  counted.end();
  return did;
}

}  // namespace nc
