// SPDX-License-Identifier: Apache-2.0
// Special fixed cycles: holes on a circle, a line, an arc, a grid (M700 13.2), a frame (Series 8 G49, G50). The cycle in force makes each of them; without one the axes of the
// plane go to each of them. Where a modal call is in force its macro is called at each place, behind the hole: the block is read again when the macro has ended, and goes on with
// the next place.
#include <cmath>

#include "interpret/feed.hpp"
#include "interpret/functions/cycle.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

PatternKind kind_of(Function function) {
  switch (function) {
    case Function::holes_on_circle: return PatternKind::circle;
    case Function::holes_on_line: return PatternKind::line;
    case Function::holes_on_arc: return PatternKind::arc;
    case Function::holes_on_frame_ccw: return PatternKind::frame_ccw;
    case Function::holes_on_frame_cw: return PatternKind::frame_cw;
    default: return PatternKind::grid;
  }
}

/// Note 1: axes of the plane, G N I J K H O P F M S and the second auxiliary function; any other word is an alarm.
Execution check_words(BlockInHand& in, const PlaneAxes& plane) {
  const Command& w = in.words;
  WordSet allowed = in.front.code_words | in.set_of({Role::vector_x, Role::vector_y, Role::vector_z, Role::length_number, Role::hole_angle_step, Role::hole_count, Role::feed,
                                                       Role::spindle_speed, Role::second_function, Role::second_function_2, Role::second_function_3,
                                                       Role::sequence_number, Role::program_number});
  allowed &= ~in.axis_words.all();
  const WordSet others = w.present & ~allowed & ~in.axis_words.all();
  if (others != 0) {
    return in.raise_first(Condition::illegal_address, others);
  }
  const uint32_t axes = w.target.axes() & ~(1u << plane.h | 1u << plane.v);
  return axes == 0 ? Execution::done : in.raise_axis(Condition::illegal_address, first_of(axes), w.get(in.axis_words.word(first_of(axes))));
}

double angle_of(const BlockInHand& in, Role word) { return length_value(in, in.words.written(word), true, true); }

/// Number of holes: whole, from 1 (P221). `last_four`: of more digits the last four count (G35, G37.1, note 2).
Execution take_count(BlockInHand& in, Role word, bool last_four, uint32_t* count) {
  const Command& w = in.words;
  if (!w.has(word)) return in.raise(Condition::no_holes, word);
  const double raw = w.get(word);
  if (!whole_number(raw, count) || (!last_four && *count > in.dialect->rules.range.most_holes)) return in.raise(Condition::value_range, word, raw);
  *count %= in.dialect->rules.range.most_holes + 1;
  return *count != 0 ? Execution::done : in.raise(Condition::no_holes, word, raw);
}

/// G34: the sign of K is the way round.
Execution read_circle(BlockInHand& in, HolePattern* p) {
  Command& w = in.words;
  p->step = 1;
  if (w.has(Role::hole_count) && w.get(Role::hole_count) < 0) {
    p->step = -1;
    const double raw = -w.get(Role::hole_count);
    uint32_t count = 0;
    if (!whole_number(raw, &count) || count > in.dialect->rules.range.most_holes) return in.raise(Condition::value_range, Role::hole_count, -raw);
    p->columns = count;
    return count != 0 ? Execution::done : in.raise(Condition::no_holes, Role::hole_count, -raw);
  }
  return take_count(in, Role::hole_count, false, &p->columns);
}

Execution read_arc(BlockInHand& in, HolePattern* p) {
  p->step = in.words.has(Role::hole_angle_step) ? angle_of(in, Role::hole_angle_step) : 0;
  if (p->step == 0) return in.raise(Condition::hole_angle_zero, Role::hole_angle_step);
  return take_count(in, Role::hole_count, false, &p->columns);
}

Execution read_grid(BlockInHand& in, HolePattern* p) {
  Execution did = take_count(in, Role::hole_columns, true, &p->columns);
  if (did == Execution::done) did = take_count(in, Role::hole_count, true, &p->rows);
  if (did != Execution::done) return did;
  const Command& w = in.words;
  for (const Role word : {Role::hole_interval, Role::hole_interval_2})
    if (!w.has(word) && (word == Role::hole_interval ? p->columns : p->rows) > 1) return in.raise(Condition::words_missing, word);
  p->interval_2 = w.has(Role::hole_interval_2) ? length_of(in, Role::hole_interval_2) : 0;
  return Execution::done;
}

/// Series 8 G49, G50 (docs/series8.md): the sides, and how many places lie on each; two where it is not said.
Execution read_frame(BlockInHand& in, HolePattern* p) {
  const Command& w = in.words;
  p->columns = p->rows = 2;
  for (const Role word : {Role::hole_interval, Role::hole_interval_2}) {
    if (!w.has(word)) return in.raise(Condition::words_missing, word);
    const double side = length_of(in, word);
    if (!(side > 0)) return in.raise(Condition::value_range, word, w.get(word));
    (word == Role::hole_interval ? p->interval : p->interval_2) = side;
  }
  for (const Role word : {Role::hole_columns, Role::hole_count}) {
    uint32_t* const places = word == Role::hole_columns ? &p->columns : &p->rows;
    if (w.has(word) && w.get(word) != std::nearbyint(w.get(word))) return in.raise(Condition::value_range, word, w.get(word));
    const Execution did = w.has(word) ? take_count(in, word, false, places) : Execution::done;
    if (did != Execution::done) return did;
    if (*places < 2) return in.raise(Condition::value_range, word, w.get(word));
  }
  p->closed = in.state.cycle.kind == CycleKind::none;  // without holes it is a path
  return Execution::done;
}

Execution read_pattern(BlockInHand& in, HolePattern* p) {
  const Command& w = in.words;
  if (p->is_frame()) return read_frame(in, p);
  if (p->kind != PatternKind::grid && !w.has(Role::hole_interval)) return in.raise(Condition::words_missing, Role::hole_interval);
  p->interval = w.has(Role::hole_interval) ? length_of(in, Role::hole_interval) : 0;
  // The radius "is given with a positive number".
  if ((p->kind == PatternKind::circle || p->kind == PatternKind::arc) && !(p->interval > 0))
    return in.raise(Condition::value_range, Role::hole_interval, w.get(Role::hole_interval));
  if (p->kind != PatternKind::grid && w.has(Role::hole_angle)) p->angle = angle_of(in, Role::hole_angle);
  switch (p->kind) {
    case PatternKind::circle: return read_circle(in, p);
    case PatternKind::arc: return read_arc(in, p);
    case PatternKind::line: return take_count(in, Role::hole_count, true, &p->columns);
    default: return read_grid(in, p);
  }
}

/// A macro is called at each place: a modal call is in force, and is made at all (L0: no).
bool calls_at_places(const InForce& in) {
  const unsigned slot = in.state.modal_call;
  return slot != 0 && in.records->modal_call[slot - 1].repeats != 0;
}

/// To all places that are left, or to the next one, where a macro is called behind it.
Execution go_to_places(BlockContext& in, const PlacesOfCalls& places) {
  const CycleState& c = in.state.cycle;
  Execution did = Execution::done;
  if (c.kind != CycleKind::none) {
    if (c.drill_axis == places.axis[0] || c.drill_axis == places.axis[1]) return in.raise_code(Condition::plane_mismatch, *in.words.one_shot);
    did = check_hole(in);
  } else if (!in.state.modal.is(Function::rapid)) {
    did = check_feed(in, Function::linear);
  }
  if (did != Execution::done) return did;
  HolesOfBlock& holes = in.jobs.holes;
  holes.begin();
  holes.pattern = places.pattern;
  holes.pattern_at = places.at;
  holes.pattern_axis[0] = places.axis[0];
  holes.pattern_axis[1] = places.axis[1];
  holes.one_by_one = calls_at_places(in);
  uint32_t& made = in.state.frame[in.state.depth].places_made;
  holes.left = places.pattern.count() - made;
  if (!holes.one_by_one) made = 0;  // the block is not read again
  return begin_hole(in);
}

/// The reference point as programmed: the words of the plane's axes, else where the program stands.
AxisVec reference_point(const BlockInHand& in) {
  const Command& w = in.words;
  AxisVec at = program_mapped(in) ? to_program(in, in.position()) : in.position();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (w.target.commands(i)) at[i] = w.target.counts_on(i) ? at[i] + w.target[i] : w.target[i];
  return at;
}

}  // namespace

Execution do_hole_pattern(BlockContext& in) {
  const FunctionRow& row = *in.words.one_shot;
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_code(Condition::plane_mismatch, row);
  Execution did = check_words(in, plane);
  HolePattern pattern;
  pattern.kind = kind_of(row.function);
  if (did == Execution::done) did = read_pattern(in, &pattern);
  if (did != Execution::done) return did;
  if (pattern.closed && is_arc(in.state.modal.of(Mode::motion))) return in.raise_code(Condition::not_accepted, row);  // its sides are lines
  PlacesOfCalls places;
  places.pattern = pattern;
  places.at = reference_point(in);
  places.axis[0] = static_cast<uint8_t>(plane.h);
  places.axis[1] = static_cast<uint8_t>(plane.v);
  if (calls_at_places(in)) in.change(&ProgramRecords::places, in.state.depth, places);
  in.state.frame[in.state.depth].places_made = 0;
  return go_to_places(in, places);
}

// The block is read again behind each of its macros. What its words say counts once: where the pattern lies is kept, and F, S, M have gone out.
Execution go_on_in_pattern(BlockContext& in) {
  in.words.stops_given_out = true;
  in.words.moved_before = (in.words.present & in.axis_words.all()) != 0;
  return go_to_places(in, in.records->places[in.state.depth]);
}

bool makes_pattern(const BlockInHand& in) { return in.words.one_shot != nullptr && is_hole_pattern(in.words.one_shot->function); }

bool calls_behind_place(BlockInHand& in) {
  HolesOfBlock& holes = in.jobs.holes;
  CallFrame& frame = in.state.frame[in.state.depth];
  if (!makes_pattern(in) || !holes.one_by_one) return false;
  if (++frame.places_made < holes.pattern.count()) return true;
  frame.places_made = 0;
  return false;
}

}  // namespace nc
