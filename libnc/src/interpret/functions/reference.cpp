// SPDX-License-Identifier: Apache-2.0
// G27 to G30: reference positions 1 to 4; G53: machine coordinates (M700 14.4, 14.7 to 14.9; DGSHAPE G28).
#include <cmath>

#include "frame/rotary.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// DGSHAPE G28: an axis that is not named moves, too, by the intermediate point that an earlier G28 of the program gave it.
void take_remembered_midpoints(InForce& in, AxisVec& mid, uint32_t& axes) {
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const OptionalDouble given = in.records->midpoints.axis[i];
    if (((axes >> i) & 1) != 0 || !given.has_value()) continue;
    mid[i] = *given;
    axes |= 1u << i;
  }
}

/// The area of G22 does not count for the moves that are made while this object exists (M700 15.7 (6)).
class WithoutStrokeCheck {
 public:
  explicit WithoutStrokeCheck(InForce& in) : in_(in), box_(in.state.stroke_box) { in_.state.stroke_box = 0; }
  ~WithoutStrokeCheck() { in_.state.stroke_box = box_; }
  WithoutStrokeCheck(const WithoutStrokeCheck&) = delete;
  WithoutStrokeCheck& operator=(const WithoutStrokeCheck&) = delete;

 private:
  InForce& in_;
  uint32_t box_;
};

/// G28 and G30: goes through the intermediate point to reference position `which`, 0 to 3.
Execution go_to_reference(BlockContext& in, unsigned which, AxisVec mid, uint32_t axes) {
  if (axes == 0 && in.dialect->rules.reference.all_axes_without_words) {
    axes = (1u << in.axis_count) - 1;
    mid = in.position();
  }
  if (axes == 0) return in.dialect->rules.reference.may_move_nothing ? Execution::done : in.raise_code(Condition::words_missing, *in.words.one_shot);
  ReferenceMidpoints midpoints = in.records->midpoints;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) midpoints.axis[i] = mid[i];
  in.change(&ProgramRecords::midpoints, midpoints);
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  style.transparent = true;  // M700 12.4.2: there is no offset vector at the intermediate point
  move_linear(in, mid, axes, style);
  AxisVec place;
  for (unsigned i = 0; i < in.axis_count; ++i) place[i] = in.reference(which, i);
  const WithoutStrokeCheck from_here(in);
  move_to_place(in, place, axes);
  if (in.dialect->rules.reference.cancels_length) cancel_length_of(in, axes);
  if (in.state.scaled != 0) end_scaling(in);  // M700 13.19, relation (2): scaling ends at the intermediate point
  return Execution::done;
}

/// M700 14.13: turns an angle in machine coordinates into a position of the axis, which counts on over several turns.
double machine_target(const InForce& in, unsigned axis, double angle) {
  const double at = in.state.machine[axis];
  if (((in.settings.turning >> axis) & 1) != 0)
    return at + turn_to(angle, within_one_turn(at), ((in.settings.short_cut >> axis) & 1) != 0);
  if (((in.settings.machine_turn >> axis) & 1) != 0) return at + angle - within_one_turn(at);
  return angle;
}

/// Half of the finest unit of a command: an axis that is nearer than this is where it should be.
double same_place(const InForce& in) { return in.settings.setting_unit_mm / 2; }

/// Which reference position P names; `fallback` where there is no P.
bool place_of_p(const BlockInHand& in, uint32_t fallback, uint32_t* place) {
  *place = fallback;
  return !in.words.has(Role::return_place) || whole_number(in.words.get(Role::return_place), place);
}

}  // namespace

void move_to_place(BlockContext& in, const AxisVec& place, uint32_t axes) {
  AxisVec machine = in.state.machine;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const uint32_t bit = 1u << i;
    if ((axes & bit) == 0) continue;
    if ((in.settings.machine_turn & bit) == 0) {
      machine[i] = place[i];
    } else {  // M700 14.13: the axis turns by less than 360 deg
      machine[i] += turn_to(within_one_turn(place[i]), within_one_turn(machine[i]), (in.settings.short_cut & bit) != 0);
    }
  }
  leave_for_machine(in, machine, axes);
}

/// M700 12.2, 14.7 (9), 14.8 (6): the tool length compensation of an axis is cancelled when the axis reaches a reference position.
void cancel_length_of(InForce& in, uint32_t axes) {
  if (((axes >> in.state.length_axis) & 1) == 0 || in.state.modal.is(Function::length_off)) return;
  in.state.length_value = 0;
  in.state.modal.set(Function::length_off);
}

Execution do_reference_return(BlockContext& in) {
  uint32_t axes = in.words.target.axes();
  AxisVec mid = target_of_words(in);
  const Rules& rules = in.dialect->rules;
  if (in.state.comp.side != 0 && rules.compensation.bars_reference_return) return in.raise_code(Condition::not_in_compensation, *in.words.one_shot);
  if ((axes & in.rotary) != 0 && !rules.reference.takes_rotary_axes) return in.raise(Condition::illegal_axis, Role::second_function_2);
  if (rules.reference.remembered_axes_go) take_remembered_midpoints(in, mid, axes);
  return go_to_reference(in, 0, mid, axes);
}

Execution do_second_reference(BlockContext& in) {
  if (in.state.comp.side != 0 && in.dialect->rules.compensation.bars_reference_return) return in.raise_code(Condition::not_in_compensation, *in.words.one_shot);
  // M700 14.8 (1): without P, and with another P than 2 to 4, it is the 2nd reference position.
  uint32_t place = 2;
  if (!place_of_p(in, 2, &place) || place < 2 || place > 4) {
    if (in.dialect->rules.reference.place_is_checked) return in.raise(Condition::value_range, Role::return_place, in.words.get(Role::return_place));
    place = 2;
  }
  if (in.dialect->rules.reference.place_is_checked && in.words.has(Role::return_place) && in.words.get(Role::return_place) != place)
    return in.raise(Condition::value_range, Role::return_place, in.words.get(Role::return_place));  // P2.6
  return go_to_reference(in, place - 1, target_of_words(in), in.words.target.axes());
}

Execution do_start_return(BlockContext& in) {
  const Command& w = in.words;
  if (!w.auxiliary.empty()) return in.raise(Condition::start_return_m, Role::misc_code, w.auxiliary[0].number);  // App.1 P436
  if (w.target.axes() == 0) return in.raise_code(Condition::words_missing, *w.one_shot);
  // M700 14.7 (5), (8): the intermediate points of the newest G28 or G30 of each axis.
  const AxisVec position = in.position();
  AxisVec mid = position;
  uint32_t known = 0;
  bool returned = false;  // (5): "if automatic reference position return is not performed", by whichever axis
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const OptionalDouble given = in.records->midpoints.axis[i];
    returned = returned || given.has_value();
    if (!w.target.commands(i) || !given.has_value()) continue;
    mid[i] = *given;
    if (((in.settings.turning >> i) & 1) != 0)
      mid[i] = position[i] + turn_to(within_one_turn(mid[i]), within_one_turn(position[i]), ((in.settings.short_cut >> i) & 1) != 0);
    known |= 1u << i;
  }
  if (!returned) {
    in.raise_code(Condition::no_reference, *w.one_shot);
    for (unsigned i = 0; i < in.axis_count && in.fault.axis < 0; ++i)
      if (w.target.commands(i)) in.fault.axis = static_cast<int8_t>(i);
    return Execution::fault;
  }
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  if (known != 0) {
    const WithoutStrokeCheck to_the_point(in);
    style.transparent = true;
    move_linear(in, mid, known, style);
  }
  style.transparent = false;  // 14.8 (5): from the intermediate point on radius compensation acts again
  move_linear(in, target_of_words(in), w.target.axes(), style);  // incremental words count from the intermediate point
  return Execution::done;
}

Execution do_reference_check(BlockContext& in) {
  const Command& w = in.words;
  uint32_t place = 1;
  if (!w.auxiliary.empty()) return in.raise(Condition::reference_check_m, Role::misc_code, w.auxiliary[0].number);  // App.1 P435
  if (w.target.axes() == 0) return in.raise_code(Condition::words_missing, *w.one_shot);
  if (!place_of_p(in, 1, &place) || place < 1 || place > 4) return in.raise(Condition::value_range, Role::return_place, w.get(Role::return_place));
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  move_linear(in, target_of_words(in), w.target.axes(), style);
  // The comparison comes after the move, because only then it is known where radius compensation has led.
  in.next_step = Step::reference_check;
  return in.state.compensated() ? in.need(NC_SYNC_POSITION) : Execution::later;
}

Execution compare_reference(BlockInHand& in) {
  const Command& w = in.words;
  uint32_t place = 1;
  place_of_p(in, 1, &place);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    const double at = in.state.compensated() ? in.world.machine.v[i] : in.state.machine[i];
    double apart = at - in.reference(place - 1, i);
    if (((in.settings.machine_turn >> i) & 1) != 0) apart -= 360 * std::nearbyint(apart / 360);
    if (std::fabs(apart) <= same_place(in)) continue;
    in.raise(Condition::reference_compare);  // P434
    in.fault.axis = static_cast<int8_t>(i);
    return Execution::fault;
  }
  if (in.state.scaled != 0) end_scaling(in);  // M700 13.19, relation (1)
  return Execution::done;
}

/// M700 14.5 note: `G92 G53 X0 Y0 Z0` takes the G92 shift of the named axes away without a motion.
Execution clear_shift(BlockInHand& in) {
  const Command& w = in.words;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    if (w.target[i] != 0) return in.raise(Condition::value_range, in.axis_words.word(i), w.target[i]);
    in.set_table(Frames::shift_key(i), 0);
  }
  return Execution::done;
}

Execution do_machine_move(BlockContext& in) {
  const Command& w = in.words;
  for (const FunctionRow* row : w.functions)
    if (row->function == Function::coordinate_set && in.dialect->rules.coordinate.machine_code_ends_shift) return clear_shift(in);
  const bool absolute_here = in.dialect->rules.coordinate.machine_move_is_absolute;
  const bool incremental = !absolute_here && (w.target.incremental() != 0 || in.state.modal.is(Function::incremental));
  in.state.map_begins = false;
  if (incremental && in.dialect->rules.coordinate.incremental_machine_move_rests) return Execution::done;
  if (incremental && !in.dialect->rules.coordinate.machine_move_may_be_incremental) return in.raise_code(Condition::code_in_incremental, *w.one_shot);
  AxisVec machine = in.state.machine;
  uint32_t absolute = 0;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const uint32_t bit = 1u << i;
    if ((w.target.axes() & bit) == 0) continue;
    if ((w.target.incremental() & bit) != 0 && !absolute_here) {  // M700 14.4 (4): in G91 it is a plain incremental rapid, on which mirror image does not act (13.6 (7))
      machine[i] += w.target[i];
      continue;
    }
    absolute |= bit;
    machine[i] = machine_target(in, i, w.target[i]);
  }
  if (!in.dialect->rules.coordinate.machine_move_by_motion || in.state.modal.is(Function::rapid)) {
    move_machine(in, machine, w.target.axes(), absolute);
    return Execution::done;
  }
  const Function motion = in.state.modal.of(Mode::motion);
  // An arc whose radius or centre a map of the program has turned or scaled has no place in machine coordinates.
  const bool arc = is_arc(motion) && absolute_here && !program_mapped(in);
  if (motion != Function::linear && !arc) return in.raise_code(Condition::not_accepted, *w.one_shot);
  const Execution fed = check_feed(in, motion);
  if (fed != Execution::done) return fed;
  AxisVec target = in.position();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (w.target.commands(i)) target[i] = machine[i] - in.zero()[i] - in.state.applied[i];
  if (arc) return move_arc(in, target, w.target.axes(), motion == Function::arc_ccw);
  LinearStyle style;
  style.feed_mm_min = feed_mm_min(in);
  style.special_feed = special_feed(in);
  style.exact_stop = asks_exact_stop(in);
  move_linear(in, target, w.target.axes(), style);
  return Execution::done;
}

}  // namespace nc
