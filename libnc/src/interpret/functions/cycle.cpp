// SPDX-License-Identifier: Apache-2.0
// Fixed cycles: the words of a block -> hole data -> holes (M700 13.1.1, DGSHAPE G80-G89, RS-274/NGC 3.5.16). The strokes of one hole are
// cycle/strokes.cpp, what becomes of them functions/cycle_strokes.cpp.
#include "interpret/functions/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "interpret/feed.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

/// Which cycle a function is: by the strokes of M700 13.1.1, and by those of RS-274/NGC 3.5.16.
struct CycleOfFunction {
  Function function;
  CycleKind plain, by_direction;
};
constexpr CycleOfFunction kCycles[] = {
    {Function::cycle_step, CycleKind::step, CycleKind::step},
    {Function::cycle_reverse_tap, CycleKind::reverse_tap, CycleKind::reverse_tap_by_direction},
    {Function::cycle_circle, CycleKind::circle, CycleKind::circle},
    {Function::cycle_fine_bore, CycleKind::fine_bore, CycleKind::fine_bore},
    {Function::cycle_drill, CycleKind::drill, CycleKind::drill},
    {Function::cycle_spot, CycleKind::spot, CycleKind::spot},
    {Function::cycle_peck, CycleKind::peck, CycleKind::peck},
    {Function::cycle_tap, CycleKind::tap, CycleKind::tap_by_direction},
    {Function::cycle_rigid_tap, CycleKind::tap, CycleKind::tap_by_direction},
    {Function::cycle_rigid_reverse_tap, CycleKind::reverse_tap, CycleKind::reverse_tap_by_direction},
    {Function::cycle_bore_feed, CycleKind::bore_feed, CycleKind::bore_feed},
    {Function::cycle_bore_stop, CycleKind::bore_stop, CycleKind::bore_stop_as_before},
    {Function::cycle_back_bore, CycleKind::back_bore, CycleKind::back_bore_to_level},
    {Function::cycle_bore_stop_dwell, CycleKind::bore_by_hand, CycleKind::bore_left_by_hand},
    {Function::cycle_bore_dwell, CycleKind::bore_dwell, CycleKind::bore_dwell},
    {Function::cycle_bore_restart, CycleKind::bore_stop_as_before, CycleKind::bore_stop_as_before},
    {Function::cycle_case_bore, CycleKind::case_bore, CycleKind::case_bore},
    {Function::cycle_bore_oriented, CycleKind::bore_oriented, CycleKind::bore_oriented},
    {Function::cycle_face_upwards, CycleKind::face_upwards, CycleKind::face_upwards},
};

/// The pair of axes, I J or K (0, 1, 2), that is normal to the plane in force.
unsigned normal_pair(const InForce& in) {
  const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
  return 3u - plane.first - plane.second;
}

/// Drilling axis: the axis normal to the plane, the parallel one where the block of the cycle names it; Z with #1080 (M700 13.1.1
/// "Positioning plane and hole drilling axis").
int drilling_axis(const BlockInHand& in) {
  if (in.settings.drilling_axis_z) return in.axis_called(Role::basic_z);
  return axis_of_pair(in, normal_pair(in));
}

/// M700 13.1.1 note 2: the axis is changed in the cancelled state. A code in the mode may name the axis in force or none of its pair.
Execution check_axis_stays(BlockInHand& in) {
  const WordSlot drills = in.axis_words.word(in.state.cycle.drill_axis);
  if (in.settings.drilling_axis_z || in.words.has(drills)) return Execution::done;
  const unsigned pair = normal_pair(in);
  const WordSlot basic = in.settings.plane_basic[pair], parallel = in.settings.plane_parallel[pair];
  const bool of_pair = drills == basic || drills == parallel;
  for (const WordSlot name : {basic, parallel})
    if (of_pair && in.words.has(name)) return in.raise(Condition::drilling_axis_changed, name, in.words.get(name));
  return of_pair ? Execution::done : in.raise_mode(Condition::drilling_axis_changed, Mode::plane);
}

void forget_hole_data(CycleState& c) {
  c.has_z = c.has_r = c.has_p = false;
  c.q = 0;
}

void begin_mode(InForce& in, unsigned axis) {
  State& state = in.state;
  state.cycle.drill_axis = static_cast<uint8_t>(axis);
  state.cycle.initial_level = state.machine[axis] - state.applied[axis];
}

Execution select_cycle(BlockContext& in, const FunctionRow& row) {
  State& state = in.state;
  const CycleRules& rules = in.dialect->rules.cycle;
  if (row.function == Function::cycle_off) {
    cancel_cycle(in);
    state.modal.set(row);
    return Execution::done;
  }
  // Behind G40 alone the vector is there until a movement in the plane has ended without it: a hole without one would lie beside its place.
  if (state.compensated() || keeps_vector(in)) return in.raise_code(Condition::cycle_in_compensation, row);
  if (!state.modal.is(Function::plane_xy) && rules.xy_plane_only) return in.raise_code(Condition::cycle_wrong_plane, row);
  const bool begins = state.cycle.kind == CycleKind::none;
  if (begins || rules.ends_at_r) {  // without a level to return to, that of each code is the one from which it begins
    const int axis = drilling_axis(in);
    if (axis < 0) return in.raise(Condition::illegal_axis, Role::basic_z);
    if (begins && !rules.levels_outlive_mode) state.cycle = CycleState{};
    begin_mode(in, static_cast<unsigned>(axis));
  } else if (!rules.axis_follows_plane) {
    const Execution did = check_axis_stays(in);
    if (did != Execution::done) return did;
  }
  const CycleKind kind = cycle_kind(*in.dialect, row.function);
  if (rules.data == HoleData::of_code || (rules.data == HoleData::of_cycle && kind != state.cycle.kind)) forget_hole_data(state.cycle);
  const bool tapping = is_tap(kind), tapped = is_tap(state.cycle.kind);
  if (tapping && rules.tap_has_lead_word) state.cycle.has_p = false;  // the dwell of another cycle is none of its own
  state.cycle.kind = kind;
  state.cycle.synchronous = state.cycle.synchronous && tapping;
  state.modal.set(row);
  if (tapping != tapped) announce_tapping(in, false);
  return Execution::done;
}

/// RS-274/NGC 3.5.16: the axis that is normal to the plane drills, also where the plane has changed in the mode.
Execution follow_plane(BlockInHand& in) {
  const int axis = drilling_axis(in);
  if (axis < 0) return in.raise(Condition::illegal_axis, Role::basic_z);
  if (axis != in.state.cycle.drill_axis) begin_mode(in, static_cast<unsigned>(axis));
  return Execution::done;
}

bool names_shift(const InForce& in, Role word) {
  const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
  const AddressTable& addresses = in.dialect->addresses;
  return addresses.same(word, vector_along(plane.first)) || addresses.same(word, vector_along(plane.second)) ||
         (in.state.cycle.kind == CycleKind::back_bore_to_level && addresses.same(word, Role::vector_z));
}

/// The word of a shift along a basic axis is a count as well in some families: which it is, the cycle and its plane say, where it is not always the count.
bool is_shift_word(const InForce& in, Role word) {
  const AddressTable& addresses = in.dialect->addresses;
  const bool counts = in.dialect->rules.cycle.count_is_no_shift && (addresses.same(word, Role::cycle_count) || addresses.same(word, Role::cycle_count_2));
  return !counts && strokes_of(in.state.cycle.kind).shifts && names_shift(in, word);
}

/// The word is kept as one of a shift. In a cycle without a shift the letter of a count stays one.
bool keeps_shift_word(const InForce& in, Role word) {
  if (is_shift_word(in, word)) return true;
  const AddressTable& addresses = in.dialect->addresses;
  const bool counts = addresses.same(word, Role::cycle_count) || addresses.same(word, Role::cycle_count_2);
  return in.dialect->rules.cycle.shift_of_any_hole && !counts && names_shift(in, word);
}

/// Q without I J says where the place beside the hole is, so those of an earlier block count no more (HX 12.3.10; M700 13.1.1 with #1080).
bool q_replaces_shift(const BlockInHand& in) {
  if (!strokes_of(in.state.cycle.kind).shifts || is_shift_word(in, Role::cycle_depth_step)) return false;
  for (unsigned i = 0; i < 3; ++i)
    if (in.words.has(vector_along(i)) && is_shift_word(in, vector_along(i))) return false;
  return in.dialect->rules.cycle.q_is_shift || in.settings.drilling_axis_z;
}

/// I J K: the way to the place beside the hole, and of RS-274/NGC 3.5.16.7 the third level.
void take_shift_words(BlockInHand& in) {
  CycleState& c = in.state.cycle;
  for (unsigned i = 0; i < 3; ++i)
    if (in.words.has(vector_along(i)) && keeps_shift_word(in, vector_along(i))) c.shift[i] = length_of(in, vector_along(i));
  if (c.kind != CycleKind::back_bore_to_level || !in.words.has(Role::vector_z)) return;
  c.third = length_of(in, Role::vector_z);
  c.has_third = true;
  c.third_incremental = is_incremental(in);
}

/// P: milliseconds, or the number of an offset.
Execution take_p(BlockInHand& in) {
  CycleState& c = in.state.cycle;
  const CycleRules& rules = in.dialect->rules.cycle;
  if (!in.words.has(Role::cycle_dwell) || is_word_of_call(in, Role::cycle_dwell)) return Execution::done;
  const double p = in.words.get(Role::cycle_dwell);
  const double ms = rules.dwell_in_seconds ? p * 1000 : std::trunc(p);  // of milliseconds decimals are ignored
  if (!(ms >= 0) || ms > rules.longest_dwell_ms) return in.raise(Condition::value_range, Role::cycle_dwell, p);
  c.p = ms;
  c.has_p = true;
  return Execution::done;
}

/// Hole data of the block (modal). M700 13.1.1: without an axis word or R they are ignored.
Execution take_hole_data(BlockInHand& in) {
  const Command& w = in.words;
  CycleState& c = in.state.cycle;
  const uint32_t drill_bit = 1u << c.drill_axis;
  if ((w.target.axes() & drill_bit) != 0) {
    c.has_z = true;
    c.z = w.target[c.drill_axis];
    c.z_incremental = (w.target.incremental() & drill_bit) != 0;
  }
  if (w.has(Role::cycle_level) && !is_word_of_call(in, Role::cycle_level)) {
    c.has_r = true;
    c.r = axis_value(in, c.drill_axis, w.written(Role::cycle_level), false);  // M700 2.1: a position of that axis
    c.r_incremental = is_incremental(in);
  }
  if (in.dialect->rules.cycle.levels_by_mode_of_hole) c.z_incremental = c.r_incremental = is_incremental(in);
  if (w.in_position_drill > 0) c.in_position = w.in_position_drill;  // "Programmable in-position width": it stays, ,I does not
  if (w.has(Role::cycle_first_depth) && strokes_of(c.kind).pecks) {
    c.has_first = true;
    c.first = axis_value(in, c.drill_axis, w.written(Role::cycle_first_depth), false);
  }
  if (w.has(Role::cycle_depth_step) && !is_shift_word(in, Role::cycle_depth_step) && !is_word_of_call(in, Role::cycle_depth_step)) {
    c.q = length_of(in, Role::cycle_depth_step);  // of any hole: the cycles that need a Q find it (M700 13.1.1, HX 12.1.2)
    if (is_tap(c.kind)) c.tap_q = std::fabs(c.q);  // a tap goes in cuts by a Q of its own alone
    if (q_replaces_shift(in)) std::fill_n(c.shift, 3, 0.0);
  }
  take_shift_words(in);
  const Execution did = take_p(in);
  return did == Execution::done && is_tap(c.kind) ? take_tap_words(in) : did;
}

/// Number of holes of this block: M700 L (13.1.1; default 1, 0 = data only), or K, which the table of 5.3 has for it; DGSHAPE K.
Execution hole_count(BlockInHand& in, uint32_t* count) {
  const Role second = Role::cycle_count_2, first = Role::cycle_count;
  const Role word = in.words.has(second) ? second : first;
  *count = 1;
  if (!in.words.has(word) || is_shift_word(in, word) || is_word_of_call(in, word)) return Execution::done;
  if (!whole_number(in.words.get(word), count) || *count > in.dialect->rules.range.most_hole_repeats) return in.raise(Condition::value_range, word, in.words.get(word));
  return *count == 0 && in.dialect->rules.cycle.repeats_from_one ? in.raise(Condition::value_range, word, in.words.get(word)) : Execution::done;
}

/// RS-274/NGC 3.5.16: it is an error if the spindle is not turning, a tap wants it the right way round.
Execution check_spindle(BlockInHand& in) {
  const CycleKind kind = in.state.cycle.kind;
  const CycleRules& rules = in.dialect->rules.cycle;
  const CycleTable& table = strokes_of(kind);  // where it restarts the spindle, the direction must be known
  const bool wanted = rules.needs_turning_spindle || table.restarts || (rules.keeps_spindle_direction && table.turns_spindle);
  const bool wrong = rules.keeps_spindle_direction && is_tap(kind) && in.state.spindle_reverse != taps_left_hand(kind);
  return wanted && (!in.state.spindle_on || wrong) ? in.raise_mode(Condition::spindle_not_turning, Mode::cycle) : Execution::done;
}

/// What a circle around the hole needs.
Execution check_circle(BlockInHand& in) {
  const CycleState& c = in.state.cycle;
  uint32_t number = 0;
  if (c.q == 0) return in.raise(Condition::words_missing, Role::cycle_depth_step);
  if (!c.has_p || !whole_number(c.p, &number) || number > in.tool_offsets()) return in.raise(Condition::no_offset_number, Role::cycle_dwell, c.p);
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0 || plane.h == c.drill_axis || plane.v == c.drill_axis) return in.raise_mode(Condition::plane_mismatch, Mode::cycle);
  const bool fits = (std::fabs(c.q) - radius_amount(in, number)) / 2 > kNoRadius_mm;
  return fits ? Execution::done : in.raise(Condition::circle_radius, Role::cycle_depth_step, c.q);
}

}  // namespace

CycleKind cycle_kind(const Dialect& dialect, Function function) {
  const CycleRules& rules = dialect.rules.cycle;
  for (const CycleOfFunction& row : kCycles) {
    if (row.function != function) continue;
    const CycleKind kind = rules.keeps_spindle_direction ? row.by_direction : row.plain;
    return kind == CycleKind::bore_by_hand && rules.bore_waits_for_hand ? CycleKind::bore_waits_for_hand : kind;
  }
  return CycleKind::none;
}

uint32_t positioning_axes(const InForce& in) {
  const WordSlot drills = in.axis_words.word(in.state.cycle.drill_axis);
  uint32_t axes = 0;
  for (const int axis : in.state.plane_axis)
    if (axis >= 0) axes |= 1u << axis;
  for (unsigned pair = 0; pair < 3; ++pair) {
    const WordSlot basic = in.settings.plane_basic[pair];
    if (basic == kNoWord || basic == drills || in.settings.plane_parallel[pair] == drills || in.axis_words.axis(basic) < 0) continue;
    axes |= 1u << in.axis_words.axis(basic);
  }
  return axes;
}

namespace {

/// M700 13.1.1, G76 (5), G87 (3): without a shift the tool is drawn out along the wall, and a bar for back boring goes down through the work.
bool has_shift(const InForce& in) {
  const ShiftInPlane by = shift_in_plane(in);
  return by.way[0] != 0 || by.way[1] != 0 || by.none_by_parameter;
}

/// Back boring from below cuts towards the level from which the tool has come, in an increment by the sign rule of R (13.1.1).
bool back_bores_downwards(const InForce& in) {
  const CycleState& c = in.state.cycle;
  if (c.kind != CycleKind::back_bore || !c.has_z || !c.has_r || c.z_incremental || c.r_incremental) return false;
  return (c.z - c.r) * (c.initial_level - in.zero()[c.drill_axis] - c.r) < 0;
}

}  // namespace

Execution check_hole(BlockInHand& in) {
  const Command& w = in.words;
  CycleState& c = in.state.cycle;
  const CycleRules& rules = in.dialect->rules.cycle;
  if (is_tap(c.kind) && rules.tap_follows_spindle) c.kind = in.state.spindle_reverse ? CycleKind::reverse_tap : CycleKind::tap;
  if (rules.begins_with_both_levels && !(c.has_z && c.has_r)) return in.raise_mode(Condition::words_missing, Mode::cycle);
  if ((w.target.axes() & in.rotary) != 0 && !rules.takes_rotary_axes) return in.raise_axis(Condition::illegal_axis, first_of(w.target.axes() & in.rotary));
  Execution did = check_spindle(in);
  if (did != Execution::done) return did;
  if (turns_axis(in, c.drill_axis)) return in.raise(Condition::plane_mismatch, in.axis_words.word(c.drill_axis));  // 13.21: not an axis alone
  if (is_tap(c.kind)) did = check_tap(in);
  if (did == Execution::done && !c.synchronous) did = check_feed(in, Function::linear);
  if (did != Execution::done) return did;
  // A peck below the finest unit of the control (M700 2.1 E) is none: the hole would never be done.
  if (strokes_of(c.kind).pecks && !(std::fabs(c.q) >= 1e-6)) return in.raise(Condition::words_missing, Role::cycle_depth_step);
  if (strokes_of(c.kind).pecks && c.q < 0 && rules.peck_is_positive) return in.raise(Condition::value_range, Role::cycle_depth_step, c.q);
  if (c.has_first && strokes_of(c.kind).pecks && c.has_r && !c.r_incremental && c.has_z && !c.z_incremental && !((c.first - c.r) * (c.z - c.r) > 0))
    return in.raise(Condition::value_range, Role::cycle_first_depth, c.first);
  if (strokes_of(c.kind).shifts && !has_shift(in)) return in.raise(Condition::words_missing, Role::vector_x);
  const double depth = c.z_incremental ? -c.z : c.r - c.z;  // below R
  const bool same_kind = c.z_incremental || (c.has_r && !c.r_incremental);
  const bool cuts_upwards = c.kind == CycleKind::back_bore_to_level || c.kind == CycleKind::face_upwards;
  if (rules.bottom_is_below_r && c.has_z && same_kind && !cuts_upwards && depth < 0) return in.raise(Condition::level_below_bottom, Role::cycle_level, c.r);
  // Series 8 G89, step 6, HX 12.3.10: from below it cuts in the positive direction.
  const bool from_below = c.kind == CycleKind::face_upwards || (c.kind == CycleKind::back_bore && rules.back_bore_is_upwards);
  if ((from_below && c.has_z && same_kind && !(depth < 0)) || back_bores_downwards(in)) return in.raise(Condition::value_range, Role::basic_z, c.z);
  if (c.kind == CycleKind::back_bore_to_level && !c.has_third) return in.raise(Condition::words_missing, Role::vector_z);
  return c.kind == CycleKind::circle ? check_circle(in) : Execution::done;
}

void cancel_cycle(BlockContext& in) {
  if (in.state.cycle.kind == CycleKind::none) return;
  const bool tapped = is_tap(in.state.cycle.kind);
  CycleState left;
  if (in.dialect->rules.cycle.levels_outlive_mode) {
    const CycleState& c = in.state.cycle;
    left.has_z = c.has_z && !c.z_incremental;
    left.has_r = c.has_r && !c.r_incremental;
    left.z = left.has_z ? c.z : 0;
    left.r = left.has_r ? c.r : 0;
  }
  in.state.cycle = left;
  in.state.modal.set(Function::cycle_off);
  if (!tapped) return;
  in.state.tap_code = false;
  announce_tapping(in, false);
}

Execution do_cycle(BlockContext& in) {
  const Command& w = in.words;
  const CycleRules& rules = in.dialect->rules.cycle;
  Execution did = Execution::done;
  if (w.cycle != nullptr) {
    did = select_cycle(in, *w.cycle);
    if (did != Execution::done) return did;
    if (in.state.cycle.kind == CycleKind::none) return move_by_words(in);  // G80 with axis words: they go by the motion in force
  }
  if (w.target.axes() == 0 && !w.has(Role::cycle_level)) return Execution::done;  // M700 13.1.1 (2)
  if (rules.axis_follows_plane) did = follow_plane(in);
  if (did == Execution::done) did = take_hole_data(in);
  uint32_t count = 1;
  if (did == Execution::done) did = hole_count(in, &count);
  if (did != Execution::done) return did;
  if (count == 0) return Execution::done;  // data only
  in.jobs.holes.begin();
  in.jobs.holes.target = w.target;
  if (in.state.modal.is(Function::polar_command_on)) in.jobs.holes.polar = in.jobs.polar_holes;
  in.jobs.holes.places_only = !in.state.cycle.has_z && rules.without_bottom_positions;
  if (!in.jobs.holes.places_only) did = check_hole(in);
  if (did != Execution::done) return did;
  in.jobs.holes.left = count;
  return begin_hole(in);
}

}  // namespace nc
