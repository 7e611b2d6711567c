// SPDX-License-Identifier: Apache-2.0
// Feed functions (M700 7): F by mode, F of one digit, inverse time.
#include "interpret/feed.hpp"

#include <cmath>
#include <numbers>

namespace nc {
namespace {

constexpr double kUnitNoise = 1e-9;

bool inch(const InForce& in) { return in.state.modal.is(Function::inch); }

/// M700 7.4 (1): F without a point counts in the setting unit; its range has one more decimal for each finer unit.
Execution take_feed_per_revolution(BlockInHand& in) {
  const double unit = inch(in) ? in.settings.setting_unit_inch : in.settings.setting_unit_mm;
  const double raw = in.words.get(Role::feed);
  const double value = in.words.pointed(Role::feed) || in.settings.decimal_type_2 ? raw : raw / std::nearbyint(1 / unit);
  const bool below = value > 0 && value < unit - kUnitNoise * unit;
  if (!(value >= 0) || below || value > in.dialect->rules.range.end_of_revolution_feed - unit + kUnitNoise) return in.raise(Condition::value_range, Role::feed, raw);
  in.state.modal.feed = value;
  return Execution::done;
}

/// M700 7.5 (2), precaution (3): the range of F in 1/min begins with the setting unit; F0 is an alarm.
Execution take_inverse_time(BlockInHand& in) {
  const double unit = in.settings.setting_unit_mm, value = in.words.get(Role::feed);
  if (value == 0) return in.raise(Condition::no_feed, Role::feed, value);
  if (!(value >= unit - kUnitNoise * unit) || value > in.dialect->rules.range.end_of_inverse_time - unit + kUnitNoise) return in.raise(Condition::value_range, Role::feed, value);
  in.state.modal.feed = value;
  return Execution::done;
}

double straight_length(const InForce& in, const Move& move) {
  double squares = 0;
  for (unsigned i = 0; i < in.axis_count; ++i) squares += (move.end[i] - move.start[i]) * (move.end[i] - move.start[i]);
  return std::sqrt(squares);
}

/// Length of an arc, with the axes that make it a helix.
double arc_length(const InForce& in, const Move& move) {
  const double round = (move.circle.radius_start + move.circle.radius_end) / 2 * move.circle.sweep;
  double squares = round * round;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (i != move.plane_axis[0] && i != move.plane_axis[1]) squares += (move.end[i] - move.start[i]) * (move.end[i] - move.start[i]);
  return std::sqrt(squares);
}

/// M700 7.5 (2): F is the speed divided by the length of a line, or by the start radius of an arc; by the length of the arc in families whose F is for the
/// whole block.
void apply_inverse_time(BlockContext& in, Move& move) {
  double extent = straight_length(in, move);
  if (move.circular && in.dialect->rules.feed.inverse_time_is_of_block) {
    extent = arc_length(in, move);
  } else if (move.circular) {
    extent = move.circle.radius_start > 0 ? move.circle.radius_start : move.circle.radius_end;
  }
  if (move.shape != 0 && in.shapes[move.shape - 1].kind == ShapeKind::space_arc) extent = in.shapes[move.shape - 1].arc.radius;
  move.rule.inverse_time = extent > 0;
  if (extent > 0) in.state.last_feed = in.state.modal.feed * extent;
  // A block that only displaces the tool goes at the speed of the block before (7.5 (4)). Where there was none, a speed is taken from F and the tool radius.
  if (!(in.state.last_feed > 0)) in.state.last_feed = in.state.modal.feed * std::fmax(std::fabs(move.comp.radius), 1);
  move.feed_mm_min = in.state.last_feed;
}

/// M700 7.3: F0 is the rapid rate in the motion of group 1; the speeds of F1 to F5 are given by parameters, in inch by a tenth of them.
void apply_digit(InForce& in, Move& move) {
  const unsigned digit = in.state.modal.feed_digit - 1u;
  move.rule.digit = static_cast<uint8_t>(digit + 1);
  if (digit == 0) {
    move.kind = NC_MOVE_RAPID;
    move.exact_stop = true;
    move.feed_mm_min = 0;
    return;
  }
  const double unit = move.feed_mm_min / digit / (inch(in) ? 10 : 1);  // mm/min or deg/min of one unit of F
  move.feed_mm_min = in.settings.digit_feed[digit - 1] * unit;
  move.rule.digit_most = static_cast<float>(in.settings.digit_most * unit);
  move.rule.digit_step = static_cast<float>(in.settings.digit_step * unit);
}

}  // namespace

bool is_feed_digit(const BlockInHand& in, double raw) {
  return in.settings.feed_by_digit && !in.words.pointed(Role::feed) && raw >= 0 && raw <= 5 && raw == std::floor(raw);
}

Execution take_feed_word(BlockInHand& in) {
  ModalState& modal = in.state.modal;
  in.state.vacant_feed = 0;
  if (modal.is(Function::feed_per_revolution)) return take_feed_per_revolution(in);
  if (modal.is(Function::inverse_time_feed)) return take_inverse_time(in);
  const double raw = in.words.get(Role::feed);
  const uint16_t before = modal.feed_digit;
  if (is_feed_digit(in, raw)) {
    const bool drills = in.words.cycle != nullptr || in.state.cycle.kind != CycleKind::none;
    if (raw == 0 && !drills && is_arc(modal.of(Mode::motion))) return in.raise(Condition::arc_feed_zero, Role::feed, raw);  // 7.3 (2) (c)
    modal.feed = raw;
    modal.feed_digit = static_cast<uint16_t>(raw + 1);
  } else {
    const Execution did = feed_of(in, &modal.feed);
    if (did != Execution::done) return did;
    modal.feed_digit = 0;
  }
  if (before != modal.feed_digit) in.state.refresh_special();
  return Execution::done;
}

Execution change_feed_mode(BlockInHand& in, Function before) {
  State& state = in.state;
  const Function now = state.modal.of(Mode::feed);
  if (in.dialect->rules.feed.end_of_inverse_time_needs_feed && before == Function::inverse_time_feed && !in.words.has(Role::feed)) return in.raise(Condition::no_feed, Role::feed);
  if (now == Function::inverse_time_feed) state.last_feed = before == Function::feed_per_minute ? feed_mm_min(in) : 0;
  state.vacant_feed = 0;
  state.modal.feed = 0;  // an F of one mode means nothing in another one
  state.modal.feed_digit = 0;
  state.refresh_special();
  return Execution::done;
}

/// Tells the scan that G63 begins or ends, because feed hold does not act in it (M700 7.11 (3), (5)).
void change_cutting_mode(BlockContext& in, Function before) {
  const bool tapping = in.state.modal.is(Function::tapping_mode);
  in.state.refresh_special();
  if ((before == Function::tapping_mode) != tapping) announce_tapping(in, false);
}

void announce_tapping(BlockContext& in, bool strokes) {
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = NC_CONTROL_TAPPING;
  action.value = (in.state.modal.is(Function::tapping_mode) ? NC_TAPPING_MODE : 0) + (is_tap(in.state.cycle.kind) ? NC_TAPPING_CYCLE : 0) +
                 (strokes ? NC_TAPPING_STROKES : 0) + (strokes && in.state.cycle.synchronous ? NC_TAPPING_SYNCHRONOUS : 0);
}

bool refused_in_inverse_time(Function function) {
  switch (function) {
    case Function::exponential_positive:
    case Function::exponential_negative:
    case Function::nurbs:
    case Function::circle_cut_cw:
    case Function::circle_cut_ccw:
    case Function::skip:
    case Function::multi_skip:
    case Function::probe_once:
    case Function::probe:
    case Function::probe_try:
    case Function::probe_away:
    case Function::probe_away_try:
    case Function::thread:
    case Function::holes_on_circle:
    case Function::holes_on_line:
    case Function::holes_on_arc:
    case Function::holes_on_grid:
    case Function::holes_on_frame_ccw:
    case Function::holes_on_frame_cw:
    case Function::sine_loop:      // as the patterns and cycles: a block of many moves has no one time
    case Function::cavity_ccw:
    case Function::cavity_cw:
    case Function::cavity_circle:
    case Function::measure_length:
    case Function::surface_on: return true;
    case Function::cycle_off:
    case Function::user_cycle: return false;
    default: return mode_of(function) == Mode::cycle;
  }
}

bool inverse_time_so_far(const BlockInHand& in) {
  Function mode = in.state.modal.of(Mode::feed);
  for (const FunctionRow* row : in.words.functions)
    if (mode_of(row->function) == Mode::feed) mode = row->function;
  return mode == Function::inverse_time_feed;
}

Execution check_inverse_time_block(BlockInHand& in) {
  const Command& w = in.words;
  for (const FunctionRow* row : w.functions)
    if (refused_in_inverse_time(row->function)) return in.raise_code(Condition::inverse_time_code, *row);
  // (5): modes that were in force before
  const Function motion = in.state.modal.of(Mode::motion);
  if (is_probing(motion) ? w.target.axes() != 0 && w.one_shot == nullptr : motion != Function::nurbs && refused_in_inverse_time(motion)) return in.raise_mode(Condition::inverse_time_code, Mode::motion);
  if (motion == Function::nurbs && w.target.axes() != 0) return in.raise_mode(Condition::inverse_time_code, Mode::motion);
  const bool cycle = in.state.cycle.kind != CycleKind::none && w.cycle == nullptr && w.motion == nullptr;
  if (cycle) return in.raise_mode(Condition::inverse_time_code, Mode::cycle);
  if (in.state.modal.is(Function::surface_on)) return in.raise_mode(Condition::inverse_time_code, Mode::surface_speed);
  return Execution::done;
}

Execution check_special_feed(BlockInHand& in, Function motion) {
  const ModalState& modal = in.state.modal;
  if (modal.is(Function::inverse_time_feed)) {  // M700 7.5, precaution (2)
    const bool known = in.words.has(Role::feed) || (in.dialect->rules.feed.inverse_time_is_modal && modal.feed > 0);
    return known ? Execution::done : in.raise(Condition::no_feed, Role::feed);
  }
  if (modal.feed_digit == 1 && motion != Function::linear) return in.raise(Condition::arc_feed_zero, Role::feed, 0);  // M700 7.3 (2) (c)
  if (modal.feed_digit != 0) return Execution::done;
  return modal.feed <= 0 ? in.raise(Condition::no_feed, Role::feed) : Execution::done;
}

namespace {

/// HX 5.3.5 (2): by parameter in the cutting mode as well; exact stops and tapping have no override.
bool overrides_corners(const InForce& in) {
  const ModalState& modal = in.state.modal;
  return modal.is(Function::corner_override) || (in.settings.corners_always && modal.is(Function::cutting_mode));
}

}  // namespace

void apply_special_feed(BlockContext& in, Move& move) {
  const ModalState& modal = in.state.modal;
  if (modal.is(Function::inverse_time_feed)) {
    apply_inverse_time(in, move);
  } else if (modal.is(Function::feed_per_revolution)) {
    move.feed_mm_rev = move.feed_mm_min;
    move.feed_mm_min = 0;
    move.plane_feed = false;  // M700 6.6: it holds only for the feed per minute
  } else if (modal.feed_digit != 0) {
    apply_digit(in, move);
  }
  if (modal.is(Function::tapping_mode)) {  // M700 7.11 (1), (2)
    move.rule.tapping = true;
    move.exact_stop = move.kind == NC_MOVE_RAPID;
  } else if (overrides_corners(in) && move.comp.side != 0 && !move.comp.transparent && move.kind != NC_MOVE_RAPID) {
    const Settings& s = in.settings;  // M700 7.10, precautions (8), (9)
    move.rule.inner_arc = static_cast<float>(s.inner_arc_least);
    const double factor = s.corner_feed > 0 && move.feed_mm_min > 0 ? s.corner_feed / move.feed_mm_min : s.corner_override / 100;
    if (s.corner_angle <= 0 || s.corner_angle >= 180 || factor <= 0 || factor >= 1) return;
    move.rule.corner_override = static_cast<float>(factor);
    move.rule.behind_zone = static_cast<float>(s.corner_behind);
    move.rule.corner_angle = static_cast<float>(s.corner_angle * std::numbers::pi / 180);
    move.rule.slow_zone = move.rule.corner_reach = static_cast<float>(s.corner_zone);
  }
}

}  // namespace nc
