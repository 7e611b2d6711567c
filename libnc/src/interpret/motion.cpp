// SPDX-License-Identifier: Apache-2.0
// Moves: from words to curves in the compensation frame.
#include <cmath>

#include "interpret/interpreter.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

constexpr double kNoMotion = 1e-9;  // mm or deg

bool same_place(const AxisVec& a, const AxisVec& b, unsigned count) {
  for (unsigned i = 0; i < count; ++i)
    if (std::fabs(a[i] - b[i]) > kNoMotion) return false;
  return true;
}

/// Tool length goes to an axis when it is commanded (M700 12.2).
void apply_length(Interpreter& in, uint32_t commanded) {
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((commanded >> i) & 1) == 0) continue;
    in.state.applied[i] = i == in.state.length_axis ? in.state.length_value : 0.0;
  }
}

Transform transform_in_force(const Interpreter& in) {
  Transform t;
  const AxisVec& z = in.zero();
  for (unsigned i = 0; i < kMaxAxes; ++i) t.offset[i] = z[i] + in.state.applied[i];
  return t;
}

/// What every move has in common.
Move& begin_move(Interpreter& in, const Transform& transform, const AxisVec& start, const AxisVec& target) {
  Move& move = in.emit_move(start, target);
  if (in.state.mirror != 0) map_compensation(in, move.comp);
  move.transform = in.transforms.intern(transform);
  in.state.machine = transform.to_machine(target);
  in.state.moves_since_comp_off = 1;
  return move;
}

struct PlaneAxes {
  int h, v;
  Plane plane;
  char center[2];  ///< address letters of the centre
};

PlaneAxes plane_axes(const Interpreter& in) {
  const int x = in.axis_of['X' - 'A'], y = in.axis_of['Y' - 'A'], z = in.axis_of['Z' - 'A'];
  switch (in.state.modal.code[kGroupPlane]) {
    case 180: return {z, x, Plane::zx, {'K', 'I'}};   // right-handed: Z is the first axis of G18
    case 190: return {y, z, Plane::yz, {'J', 'K'}};
    default: return {x, y, Plane::xy, {'I', 'J'}};
  }
}

/// M700 2.3: a rotary position must be a multiple of #2106.
bool off_increment(const Interpreter& in, unsigned axis, double value) {
  const double unit = in.settings.index_increment[axis];
  if (unit <= 0 || ((in.rotary >> axis) & 1) == 0) return false;
  return std::fabs(value - unit * std::nearbyint(value / unit)) > 1e-6;
}

}  // namespace

double feed_mm_min(const Interpreter& in) {
  const bool inch = in.state.modal.code[kGroupUnit] == 200;
  return in.state.modal.feed * (inch ? 25.4 : 1.0);
}

namespace {

/// When only rotary axes move F is deg/min; in inch its unit is 10 deg (M700 3.2 note 6).
double feed_for(const Interpreter& in, const AxisVec& start, const AxisVec& end) {
  const bool inch = in.state.modal.code[kGroupUnit] == 200;
  if (!inch || in.rotary == 0 || in.dialect->id != NC_DIALECT_M700) return feed_mm_min(in);
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((in.rotary >> i) & 1) == 0 && std::fabs(end[i] - start[i]) > kNoMotion) return feed_mm_min(in);
  return in.state.modal.feed * 10;
}

}  // namespace

AxisVec target_of_words(const Interpreter& in) { return target_of_words(in, in.position()); }

namespace {

inline AxisVec plain_target(const Interpreter& in, const AxisVec& position, uint32_t axes, const AxisVec& value) {
  AxisVec target = position;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((axes >> i) & 1) == 0) continue;
    target[i] = ((in.words.incremental >> i) & 1) != 0 ? target[i] + value[i] : value[i];
  }
  return target;
}

}  // namespace

AxisVec target_of_words(const Interpreter& in, const AxisVec& position) { return target_of(in, position, in.words.axes, in.words.axis); }

AxisVec target_of(const Interpreter& in, const AxisVec& position, uint32_t axes, const AxisVec& value) {
  if (!program_mapped(in)) return plain_target(in, position, axes, value);
  return from_program(in, plain_target(in, to_program(in, position), axes, value));
}

void move_linear(Interpreter& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style) {
  if (program_mapped(in) && commanded != 0) {
    commanded = moved_axes(in, commanded);
    figure_has_moved(in);
  }
  apply_length(in, commanded);
  const Transform transform = transform_in_force(in);
  const AxisVec start = transform.from_machine(in.state.machine);
  AxisVec end = target;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded >> i) & 1) == 0) end[i] = start[i];  // an axis that is not named stays where it is
  if (same_place(start, end, in.axis_count)) return;
  Move& move = begin_move(in, transform, start, end);
  move.kind = style.kind;
  move.exact_stop = style.exact_stop || style.kind == NC_MOVE_RAPID;
  move.feed_mm_min = style.kind == NC_MOVE_RAPID ? 0 : style.feed_mm_min;
  move.skip_mask = style.skip_mask;
  move.comp.transparent = style.transparent;
}

void move_nowhere(Interpreter& in) {
  const Transform transform = transform_in_force(in);
  const AxisVec at = transform.from_machine(in.state.machine);
  const auto moves = in.state.moves_since_comp_off;
  Move& move = begin_move(in, transform, at, at);
  in.state.moves_since_comp_off = moves;
  move.kind = in.state.modal.code[kGroupMotion] == 0 ? NC_MOVE_RAPID : NC_MOVE_LINE;
  move.exact_stop = move.kind == NC_MOVE_RAPID;
  move.feed_mm_min = move.kind == NC_MOVE_RAPID ? 0 : feed_mm_min(in);
}

void move_machine(Interpreter& in, const AxisVec& machine, uint32_t commanded) {
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded >> i) & 1) != 0) in.state.applied[i] = 0;
  const Transform transform = transform_in_force(in);
  const AxisVec start = transform.from_machine(in.state.machine);
  AxisVec end = transform.from_machine(machine);
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded >> i) & 1) == 0) end[i] = start[i];
  if (same_place(start, end, in.axis_count)) return;
  Move& move = begin_move(in, transform, start, end);
  move.kind = NC_MOVE_RAPID;
  move.exact_stop = true;
  move.comp.transparent = true;
}

Did move_arc(Interpreter& in, const AxisVec& target, uint32_t commanded, bool ccw) {
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise(Condition::plane_mismatch, 'G', in.state.modal.code[kGroupMotion] / 10.0);
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  const BlockWords& w = in.words;
  if (in.dialect->id == NC_DIALECT_DGSHAPE && (commanded & in.rotary) != 0) return in.raise(Condition::illegal_axis, 'A');  // G02/G03: A cannot take part
  ArcWords words;
  words.has_radius = w.has('R');
  if (words.has_radius) {
    words.radius = length_of(in, 'R');
    if (w.has('P') && in.dialect->id == NC_DIALECT_M700) return in.raise(Condition::format_error, 'P');  // M700 6.6: P not with R
  } else {
    for (unsigned i = 0; i < 2; ++i)
      if (w.has(plane.center[i])) words.center[i] = length_of(in, plane.center[i]);
    if (w.has('P') && (!whole_number(w.get('P'), &words.turns) || words.turns > 9999)) return in.raise(Condition::value_range, 'P', w.get('P'));
  }
  if (program_mapped(in)) {
    map_arc(in, h, v, words.center, &ccw);
    commanded = moved_axes(in, commanded);
    figure_has_moved(in);
  }
  apply_length(in, commanded);
  const Transform transform = transform_in_force(in);
  const AxisVec start = transform.from_machine(in.state.machine);
  AxisVec end = target;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded >> i) & 1) == 0) end[i] = start[i];
  const double from[2] = {start[h], start[v]}, to[2] = {end[h], end[v]};
  Circle circle;
  bool no_motion = false;
  const Condition bad = make_circle(from, to, words, ccw, in.settings.arc_tolerance, &circle, &no_motion);
  if (bad != Condition::none) return in.raise(bad, words.has_radius ? 'R' : plane.center[0], words.has_radius ? words.radius : circle.radius_end);
  if (no_motion) {
    // Nothing goes round; axes outside the plane still go along a line.
    LinearStyle style;
    style.feed_mm_min = feed_mm_min(in);
    move_linear(in, end, commanded, style);
    return Did::done;
  }
  Move& move = begin_move(in, transform, start, end);
  bool helix = false;
  for (unsigned i = 0; i < in.axis_count; ++i) helix = helix || (i != h && i != v && std::fabs(end[i] - start[i]) > kNoMotion);
  move.kind = helix ? NC_MOVE_HELIX : NC_MOVE_ARC;
  move.circular = true;
  move.plane = plane.plane;
  move.plane_axis[0] = static_cast<uint8_t>(h);
  move.plane_axis[1] = static_cast<uint8_t>(v);
  move.circle = circle;
  move.work_center[0] = circle.center[0];
  move.work_center[1] = circle.center[1];
  move.feed_mm_min = feed_mm_min(in);
  move.exact_stop = w.exact_stop || in.state.modal.code[kGroupCutting] == 610;
  return Did::done;
}

Did move_by_words(Interpreter& in) {
  const BlockWords& w = in.words;
  const int16_t code = in.state.modal.code[kGroupMotion];
  const bool arc = code == 20 || code == 30;
  const bool arc_words = w.any(letters("RIJK"));
  if (w.axes == 0 && !(arc && arc_words)) return Did::done;
  for (unsigned i = 0; in.rotary != 0 && i < in.axis_count; ++i) {
    if (((w.axes >> i) & 1) == 0 || !off_increment(in, i, w.axis[i])) continue;
    in.raise(Condition::index_increment, in.system->axis[i].name, w.axis[i]);
    in.fault.axis = static_cast<int8_t>(i);
    return Did::fault;
  }
  // Where the block starts is asked only by words that count from there (an axis without a word stays), by the feed of rotary axes, and
  // by a turned figure, in which one word moves two axes.
  const bool mapped = program_mapped(in);
  const AxisVec position = w.incremental != 0 || in.rotary != 0 || mapped ? in.position() : AxisVec{};
  const AxisVec target = mapped ? target_of_words(in, position) : plain_target(in, position, w.axes, w.axis);
  if (code == 0) {
    LinearStyle style;
    style.kind = NC_MOVE_RAPID;
    move_linear(in, target, w.axes, style);
    return Did::done;
  }
  if (in.state.modal.feed <= 0) return in.raise(Condition::no_feed, 'F');
  if (arc) return move_arc(in, target, w.axes, code == 30);
  LinearStyle style;
  style.feed_mm_min = feed_for(in, position, target);
  style.exact_stop = w.exact_stop || in.state.modal.code[kGroupCutting] == 610;
  move_linear(in, target, w.axes, style);
  return Did::done;
}

}  // namespace nc
