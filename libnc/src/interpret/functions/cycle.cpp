// SPDX-License-Identifier: Apache-2.0
// Fixed cycles: the words of a block -> hole data -> holes (M700 13.1.1, DGSHAPE G80-G89). The moves of one hole are cycle/drilling.cpp.
#include <cmath>
#include <initializer_list>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

CycleKind kind_of(Function function) {
  switch (function) {
    case Function::cycle_drill: return CycleKind::drill;
    case Function::cycle_spot: return CycleKind::spot;
    case Function::cycle_peck: return CycleKind::peck;
    case Function::cycle_step: return CycleKind::step;
    case Function::cycle_bore_feed: return CycleKind::bore_feed;
    case Function::cycle_bore_dwell: return CycleKind::bore_dwell;
    default: return CycleKind::none;
  }
}

/// The pair of axes, I J or K (0, 1, 2), that is normal to the plane in force.
unsigned normal_pair(const BlockContext& in) {
  const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
  return 3u - plane.first - plane.second;
}

/// Drilling axis: the axis normal to the plane, the parallel one where the block of the cycle names it; Z with #1080 (M700 13.1.1
/// "Positioning plane and hole drilling axis").
int drilling_axis(const BlockContext& in) {
  if (in.settings.drilling_axis_z) return in.axis_called(Role::basic_z);
  return axis_of_pair(in, normal_pair(in));
}

/// Axes that are positioned over the hole: those of the plane that is selected, and the basic axes that are not parallel to the
/// drilling axis.
uint32_t positioning_axes(const BlockContext& in) {
  const char drills = in.system->axis[in.state.cycle.drill_axis].name;
  uint32_t axes = 0;
  for (const int axis : in.state.plane_axis)
    if (axis >= 0) axes |= 1u << axis;
  for (unsigned pair = 0; pair < 3; ++pair) {
    const char basic = in.settings.plane_basic[pair];
    if (basic == 0 || basic == drills || in.settings.plane_parallel[pair] == drills || in.axis_named(basic) < 0) continue;
    axes |= 1u << in.axis_named(basic);
  }
  return axes;
}

Execution select_cycle(BlockContext& in, const FunctionRow& row) {
  State& state = in.state;
  if (row.function == Function::cycle_off) {
    cancel_cycle(in);
    state.modal.set(row);
    return Execution::done;
  }
  if (state.comp.side != 0) return in.raise_code(Condition::cycle_in_compensation, row);
  if (!state.modal.is(Function::plane_xy) && in.dialect->rules.cycle.xy_plane_only) return in.raise_code(Condition::cycle_wrong_plane, row);
  const int axis = drilling_axis(in);
  if (axis < 0) return in.raise(Condition::illegal_axis, Role::basic_z);
  if (state.cycle.kind == CycleKind::none) {  // note 2: in the mode the drilling axis does not change
    state.cycle = CycleState{};
    state.cycle.drill_axis = static_cast<uint8_t>(axis);
    state.cycle.initial_level = state.machine[static_cast<unsigned>(axis)] - state.applied[static_cast<unsigned>(axis)];
  }
  state.cycle.kind = kind_of(row.function);
  state.modal.set(row);
  return Execution::done;
}

/// Hole data of the block (modal). M700 13.1.1: without an axis word or R they are ignored.
Execution take_hole_data(BlockContext& in) {
  const BlockWords& w = in.words;
  CycleState& c = in.state.cycle;
  const uint32_t drill_bit = 1u << c.drill_axis;
  if ((w.axes & drill_bit) != 0) {
    c.has_z = true;
    c.z = w.axis[c.drill_axis];
    c.z_incremental = (w.incremental & drill_bit) != 0;
  }
  if (w.has(Role::cycle_level)) {
    c.has_r = true;
    c.r = axis_value(in, c.drill_axis, w.get(Role::cycle_level), w.flag(Role::cycle_level), false);  // M700 2.1: a position of that axis
    c.r_incremental = in.state.modal.is(Function::incremental);
  }
  if (w.in_position_drill > 0) c.in_position = w.in_position_drill;  // "Programmable in-position width": it stays, ,I does not
  if (w.has(Role::cycle_depth_step)) c.q = std::fabs(length_of(in, Role::cycle_depth_step));
  if (w.has(Role::cycle_dwell)) {
    const double p = w.get(Role::cycle_dwell);
    const double ms = in.dialect->rules.cycle.dwell_in_seconds ? p * 1000 : std::trunc(p);  // of milliseconds decimals are ignored
    if (!(ms >= 0) || ms > in.dialect->rules.cycle.longest_dwell_ms) return in.raise(Condition::value_range, Role::cycle_dwell, w.get(Role::cycle_dwell));
    c.dwell_s = ms / 1000;
  }
  return Execution::done;
}

/// `start`, but where `axes` go.
AxisVec plain_end(const AxisVec& start, const AxisVec& target, uint32_t axes) {
  AxisVec end = start;
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if (((axes >> i) & 1) != 0) end[i] = target[i];
  return end;
}

/// Levels of this hole from the hole data (M700 13.1.1 "Absolute/incremental").
void resolve_hole(BlockContext& in) {
  const CycleState& c = in.state.cycle;
  const CycleRules& rules = in.dialect->rules.cycle;
  Hole& h = in.hole;
  h.kind = c.kind;
  // As a coordinate of now: the zero point may have changed since the cycle was commanded. A tool length that comes into
  // force in between (also one that is pending, M700 12.2) displaces this level like every other end point.
  h.initial = programmed_on(in, c.drill_axis, c.initial_level - in.zero()[c.drill_axis]);  // levels as programmed; the maps come last
  if (!c.has_r) {
    h.r = h.initial;  // DGSHAPE: omitted R = initial level
  } else if (c.r_incremental) {
    h.r = h.initial + (rules.r_takes_sign_of_z && c.z_incremental && c.has_z ? std::copysign(c.r, c.z) : c.r);
  } else {
    h.r = c.r;
  }
  h.bottom = !c.has_z ? h.r : c.z_incremental ? h.r + c.z : c.z;
  const bool below = h.bottom < h.r ? h.initial < h.r : h.initial > h.r;
  if (rules.rises_before_positioning && below) h.initial = h.r;  // it has gone up
  for (double* level : {&h.initial, &h.r, &h.bottom}) *level = mapped_on(in, c.drill_axis, *level);  // M700 13.6, 13.19
  h.return_to = in.state.modal.is(Function::return_r) ? h.r : h.initial;
  h.q = c.q;
  h.dwell_s = c.dwell_s;
  if (rules.fixed_clearance_mm > 0) {
    h.clearance = rules.fixed_clearance_mm;
  } else {
    h.clearance = c.kind == CycleKind::step ? in.settings.peck_clearance_73 : in.settings.peck_clearance_83;
  }
}

/// The move to the hole. Axes that neither drill nor are of the plane go first (M700 13.1.1 precaution (6)), by the motion from
/// before the cycle (13.1.2, example 2, N012): rapid by G00, else a line with the feed, which is what such an axis does beside an arc, too.
/// Then the plane in rapid traverse, which ,I of the block belongs to.
void position_over_hole(BlockContext& in) {
  const uint32_t axes = in.hole_axes & ~(1u << in.state.cycle.drill_axis);
  const uint32_t over_hole = positioning_axes(in);
  const AxisVec start = in.position(), target = target_of(in, start, axes, in.hole_increment);
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  LinearStyle other = style;
  if (!in.state.modal.is(Function::rapid) && in.dialect->rules.cycle.others_keep_motion_mode) {
    other.kind = NC_MOVE_LINE;
    other.feed_mm_min = feed_for(in, start, plain_end(start, target, axes & ~over_hole));
    other.special_feed = special_feed(in);
    other.exact_stop = true;  // the cycle begins behind it
  }
  move_linear(in, target, axes & ~over_hole, other);
  style.in_position = in.words.in_position;
  move_linear(in, target, axes & over_hole, style);
}

void emit_cycle_move(BlockContext& in, const CycleStep& step, bool last) {
  AxisVec target = in.position();
  target[in.state.cycle.drill_axis] = step.to;
  LinearStyle style;
  style.kind = step.kind == CycleStep::Kind::rapid ? NC_MOVE_RAPID : NC_MOVE_LINE;
  style.feed_mm_min = feed_mm_min(in);
  style.special_feed = style.kind != NC_MOVE_RAPID && special_feed(in);
  style.exact_stop = true;  // every level of a hole is reached
  if (last) style.in_position = in.state.cycle.in_position;
  move_linear(in, target, 1u << in.state.cycle.drill_axis, style);
}

/// RS-274/NGC 3.5.16: the tool leaves the material before it goes to the next hole, and R is the level from then on.
void rise_to_level(BlockContext& in) {
  resolve_hole(in);
  const unsigned axis = in.state.cycle.drill_axis;
  AxisVec target = in.position();
  const double up = in.hole.bottom < in.hole.r ? 1.0 : -1.0;
  if ((in.hole.r - target[axis]) * up <= 0) return;
  target[axis] = in.hole.r;
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  move_linear(in, target, 1u << axis, style);
}

Execution begin_hole(BlockContext& in) {
  if (in.dialect->rules.cycle.rises_before_positioning) rise_to_level(in);
  position_over_hole(in);
  in.emit_stop_point();
  resolve_hole(in);
  in.progress = HoleProgress{};
  in.next_step = Step::cycle;
  return Execution::later;
}

/// Number of holes of this block: M700 L (13.1.1; default 1, 0 = data only), or K, which the table of 5.3 has for it; DGSHAPE K.
Execution hole_count(BlockContext& in, uint32_t* count) {
  const Role word = in.words.has(Role::cycle_count_2) ? Role::cycle_count_2 : Role::cycle_count;
  *count = 1;
  if (!in.words.has(word)) return Execution::done;
  if (!whole_number(in.words.get(word), count) || *count > 9999) return in.raise(Condition::value_range, word, in.words.get(word));
  return Execution::done;
}

}  // namespace

void cancel_cycle(BlockContext& in) {
  if (in.state.cycle.kind == CycleKind::none) return;
  in.state.cycle = CycleState{};
  in.state.modal.set(Function::cycle_off);
}

Execution do_cycle(BlockContext& in) {
  const BlockWords& w = in.words;
  if (w.cycle != nullptr) {
    const Execution did = select_cycle(in, *w.cycle);
    if (did != Execution::done) return did;
    if (in.state.cycle.kind == CycleKind::none) return move_by_words(in);  // G80 with axis words: they go by the motion in force
  }
  if (w.axes == 0 && !w.has(Role::cycle_level)) return Execution::done;  // M700 13.1.1 (2)
  Execution did = take_hole_data(in);
  if (did != Execution::done) return did;
  uint32_t count = 1;
  did = hole_count(in, &count);
  if (did != Execution::done) return did;
  const CycleState& c = in.state.cycle;
  if (count == 0) return Execution::done;  // data only
  in.hole_axes = w.axes;
  in.hole_increment = w.axis;
  const CycleRules& rules = in.dialect->rules.cycle;
  if (rules.begins_with_both_levels && !(c.has_z && c.has_r)) return in.raise_mode(Condition::words_missing, Mode::cycle);
  if (!c.has_z && rules.without_bottom_positions) {
    position_over_hole(in);
    return Execution::done;
  }
  if ((w.axes & in.rotary) != 0 && !rules.takes_rotary_axes) return in.raise_axis(Condition::illegal_axis, first_of(w.axes & in.rotary));
  if (!in.state.spindle_on && rules.needs_turning_spindle) return in.raise_mode(Condition::spindle_not_turning, Mode::cycle);
  if (turns_axis(in, c.drill_axis)) return in.raise(Condition::plane_mismatch, in.system->axis[c.drill_axis].name);  // 13.21: not an axis alone
  did = check_feed(in, Function::linear);
  if (did != Execution::done) return did;
  // A peck below the finest unit of the control (M700 2.1 E) is none: the hole would never be done.
  if ((c.kind == CycleKind::peck || c.kind == CycleKind::step) && !(c.q >= 1e-6)) return in.raise(Condition::words_missing, Role::cycle_depth_step);
  in.holes_left = count;
  return begin_hole(in);
}

Execution continue_cycle(BlockContext& in) {
  while (in.queue_has_room()) {
    const CycleStep step = next_step(in.hole, in.progress);
    switch (step.kind) {
      case CycleStep::Kind::rapid:
      case CycleStep::Kind::feed: {
        HoleProgress ahead = in.progress;
        emit_cycle_move(in, step, next_step(in.hole, ahead).kind == CycleStep::Kind::done);
        break;
      }
      case CycleStep::Kind::stop_point: in.emit_stop_point(); break;
      case CycleStep::Kind::dwell: {
        Gate& gate = in.emit(ItemKind::gate).gate;
        gate.kind = NC_GATE_DWELL_SECONDS;
        gate.announce = true;
        gate.value = step.seconds;
        break;
      }
      case CycleStep::Kind::done:
        if (--in.holes_left == 0) return Execution::done;
        in.emit_stop_point();  // single block also stops at the end of each hole but the last, where the block itself ends
        return begin_hole(in);
    }
  }
  return Execution::later;
}

}  // namespace nc
