// SPDX-License-Identifier: Apache-2.0
// Lines by their angle (M700 13.8), and pairs of blocks of which the first has no end, because the second says where they meet (13.9). The
// geometry is contour/meeting.hpp; the first block waits in contour/contour.hpp, from which no program sees that it has been read before its end
// was known. Here, in between, the position is still that of its start.
#include "contour/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "interpret/by_hand.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

using Kind = MeetingFirst::Kind;

/// Lets what a block says of the plane be asked for in programmed coordinates.
struct InPlane {
  PlaneAxes axes;
  unsigned h = 0, v = 0;
  PlanePoint at;       ///< where the block starts by the program, also where the axes have been moved by hand (12.4.4)
  bool exists() const { return axes.h >= 0 && axes.v >= 0; }
  uint32_t bits() const { return exists() ? 1u << h | 1u << v : 0; }
};

AxisVec programmed_position(const BlockInHand& in) { return program_mapped(in) ? to_program(in, in.position()) : in.position(); }

InPlane in_plane(const BlockInHand& in) {
  InPlane plane{plane_axes(in), 0, 0, {}};
  if (!plane.exists()) return plane;
  plane.h = static_cast<unsigned>(plane.axes.h);
  plane.v = static_cast<unsigned>(plane.axes.v);
  const AxisVec at = programmed_position(in), beside = way_by_hand(in);
  plane.at = {at[plane.h] - beside[plane.h], at[plane.v] - beside[plane.v]};
  return plane;
}

double angle_of_block(const BlockInHand& in) {
  const Command& w = in.words;
  const double angle = length_value(in, w.has_angle ? w.angle : w.written(Role::line_angle), true, true, false);
  return std::fmod(angle, 360);  // 13.8 (7)
}

/// The second auxiliary function keeps its word to itself but for lines with an end coordinate by ,A (9.2, note).
bool word_is_taken(const InForce& in) {
  const WordSlot word = in.word(Role::line_angle);
  return word == kNoWord || in.axis_words.axis(word) >= 0 || second_function(in) == word;
}

bool free_for_lines(const BlockInHand& in) { return in.words.one_shot == nullptr && (in.state.cycle.kind == CycleKind::none || in.words.motion != nullptr) && in.words.cycle == nullptr; }

/// The circle that the words of the block say, about `from` or by its radius; false: they say none.
bool circle_of_block(const BlockInHand& in, const InPlane& plane, PlanePoint from, KnownCircle* circle) {
  const Command& w = in.words;
  circle->on = from;
  circle->ccw = in.state.modal.is(Function::arc_ccw);
  circle->by_radius = w.has(Role::arc_radius);
  if (circle->by_radius) {
    circle->radius = length_of(in, Role::arc_radius);
    return circle->radius != 0;
  }
  double center[2] = {0, 0};
  bool any = false;
  for (unsigned i = 0; i < 2; ++i) {
    if (!w.has(plane.axes.center[i])) continue;
    any = true;
    center[i] = length_of(in, plane.axes.center[i]);
  }
  circle->center = {from.h + center[0], from.v + center[1]};
  return any;
}

/// "P and Q can be commanded instead of I and K": both of them, and no other word of a circle. P beside such a word is the number of turns (6.6).
bool says_center(const BlockInHand& in) {
  const Command& w = in.words;
  if (!in.dialect->addresses.has(Role::meeting_center) || !is_arc(in.state.modal.of(Mode::motion)) || !free_for_lines(in)) return false;
  return w.has(Role::meeting_center) && w.has(Role::meeting_center_2) && !w.any({Role::arc_radius, Role::vector_x, Role::vector_y, Role::vector_z});
}

/// As if the centre had been said by I J K: from the start in the first block of a pair, from the end in the second one. False: it has no end, from which these could count.
bool take_center(BlockInHand& in) {
  Command& w = in.words;
  const InPlane plane = in_plane(in);
  if (!plane.exists()) return false;
  const bool first = w.target.axes() == 0;
  if (!first && ((w.target.axes() & plane.bits()) != plane.bits() || (w.target.incremental() & plane.bits()) != 0)) return false;
  const double unit = in.state.modal.is(Function::inch) ? kMillimetresPerInch : 1;
  const double from[2] = {first ? plane.at.h : w.target[plane.h], first ? plane.at.v : w.target[plane.v]};
  const bool in_order = plane.axes.center[0] < plane.axes.center[1];  // G18: the first axis is Z
  for (unsigned i = 0; i < 2; ++i) {
    const Role word = (i == 0) == in_order ? Role::meeting_center : Role::meeting_center_2;
    w.give(in.word(plane.axes.center[i]), (length_of(in, word) - from[i]) / unit);
  }
  w.leave_out(in.word(Role::meeting_center));
  w.leave_out(in.word(Role::meeting_center_2));
  return true;
}

/// H0 or H1; other values are no choice (P395).
bool choice_of_block(const BlockInHand& in, int8_t* choice) {
  *choice = -1;
  if (!in.words.has(Role::meeting_choice)) return true;
  const double value = in.words.get(Role::meeting_choice);
  if (value != 0 && value != 1) return false;
  *choice = static_cast<int8_t>(value);
  return true;
}

Move* newest_move(BlockContext& in, unsigned from) {
  for (unsigned i = in.items_made(); i > from; --i)
    if (in.item_made(i - 1).kind == ItemKind::move) return &in.item_made(i - 1).move;
  return nullptr;
}

LinearStyle cutting_style(const BlockInHand& in) {
  LinearStyle style;
  style.feed_mm_min = feed_mm_min(in);
  style.special_feed = special_feed(in);
  style.exact_stop = asks_exact_stop(in);
  return style;
}

/// Modes in which programmed coordinates are not those of the axes, or a length is not that of the block.
Execution check_modes_of_pair(BlockInHand& in, Condition option) {
  if ((in.state.special & (kSpecialMap | kSpecialSpline)) != 0) return in.raise(option);
  if (in.state.modal.is(Function::inverse_time_feed)) return in.raise_mode(Condition::geometric_address, Mode::feed);
  if (in.words.corner != Corner::none) return in.raise(Condition::corner_option, corner_word(in.words), in.words.corner_size.value);
  return check_feed(in, in.state.modal.of(Mode::motion));
}

/// H chooses a point on an arc, and is said in the block of the arc. Beside a line it would choose nothing.
Execution check_choice_beside_line(BlockInHand& in) {
  const auto is_length = [](const FunctionRow* row) { return mode_of(row->function) == Mode::length; };
  const bool of_length = std::any_of(in.words.functions.begin(), in.words.functions.end(), is_length);
  if (!in.words.has(Role::meeting_choice) || of_length) return Execution::done;
  return in.raise(Condition::geometric_address, Role::meeting_choice, in.words.get(Role::meeting_choice));
}

/// (a), (c), (e): G01 A.
Execution begin_with_line(BlockContext& in) {
  if (word_is_taken(in) && in.words.target.axes() == 0) return in.raise(Condition::geometric_option, Role::option_angle, in.words.has_angle ? in.words.angle.value : 0);
  if (in.words.target.axes() != 0) return in.raise_axis(Condition::geometric_address, first_of(in.words.target.axes()));
  Execution did = check_choice_beside_line(in);
  if (did == Execution::done) did = check_modes_of_pair(in, Condition::geometric_option);
  if (did != Execution::done) return did;
  const InPlane plane = in_plane(in);
  if (!plane.exists()) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  MeetingFirst first;
  first.kind = Kind::line;
  first.angle_deg = angle_of_block(in);
  first.start[0] = plane.at.h;
  first.start[1] = plane.at.v;
  // Any end on the line will do until the true one is known.
  AxisVec end = programmed_position(in);
  PlanePoint u;
  direction_of(first.angle_deg, &u.h, &u.v);
  end[plane.h] = plane.at.h + u.h;
  end[plane.v] = plane.at.v + u.v;
  if (in.state.by_hand) {  // the point is a place, to which the axes are led back
    in.words.target.set(plane.h, TargetKind::absolute, end[plane.h]);
    in.words.target.set(plane.v, TargetKind::absolute, end[plane.v]);
  }
  const AxisVec before = in.state.machine;
  LinearStyle style = cutting_style(in);
  style.corner = Corner::meet;
  style.corner_mm = 1;
  move_linear(in, program_mapped(in) ? from_program(in, end) : end, plane.bits(), style);
  in.state.machine = before;
  in.state.meeting = first;
  return Execution::done;
}

/// An arc by its radius, which has neither end nor centre yet.
void emit_by_radius(BlockContext& in, const InPlane& plane, const KnownCircle& circle) {
  double direction[2] = {0, 0};
  bool ccw = circle.ccw;
  const bool mapped = program_mapped(in);
  if (mapped) map_arc(in, plane.h, plane.v, direction, &ccw);
  const MoveFrame frame = frame_of_move(in, in.position(), plane.bits());
  Circle placeholder;
  placeholder.radius_start = placeholder.radius_end = mapped ? circle.radius * scale_of(in, plane.h) : circle.radius;
  placeholder.sweep = ccw ? 1 : -1;
  emit_circular(in, frame, plane.axes, placeholder, NC_MOVE_ARC);
}

/// (b), (d), (f): G02, G03 without an end. Unless the next block meets it, it is what it is elsewhere: a whole circle (6.4), or nothing (6.5); `by_center`: by P and Q, which mean nothing elsewhere.
Execution begin_with_arc(BlockContext& in, bool by_center) {
  const InPlane plane = in_plane(in);
  KnownCircle circle;
  if (!plane.exists() || !circle_of_block(in, plane, plane.at, &circle)) return move_by_words(in);
  MeetingFirst first;
  if (!choice_of_block(in, &first.choice)) return in.raise(Condition::geometric_address, Role::meeting_choice, in.words.get(Role::meeting_choice));
  if (by_center && first.choice < 0) first.choice = 0;
  const Condition option = circle.by_radius ? Condition::geometric_arc_option : Condition::geometric_circle_option;
  if (first.choice >= 0) {
    const Execution did = check_modes_of_pair(in, option);
    if (did != Execution::done) return did;
  }
  const bool possible = (in.state.special & (kSpecialMap | kSpecialSpline | kSpecialWords)) == 0 && in.state.modal_call == 0 && !in.state.modal.is(Function::inverse_time_feed) &&
                        !(program_mapped(in) && (scaled_unevenly(in, plane.h, plane.v) || tilts_plane(in, plane.h, plane.v)));
  if (!possible) return first.choice >= 0 ? in.raise(option, Role::meeting_choice, first.choice) : move_by_words(in);
  const unsigned before = in.items_made();
  if (circle.by_radius) {
    if (starts_or_ends_compensation(in)) return move_by_words(in);
    const Execution did = check_feed(in, in.state.modal.of(Mode::motion));
    if (did != Execution::done) return did;
    emit_by_radius(in, plane, circle);
  } else {
    const Execution did = move_by_words(in);
    if (did != Execution::done) return did;
  }
  Move* const move = newest_move(in, before);
  if (move == nullptr || !move->circular) return Execution::done;  // an arc of no radius
  move->corner = circle.by_radius ? Corner::meet_by_radius : Corner::meet;
  move->corner_mm = first.choice >= 0 ? 1 : 0;
  first.kind = Kind::arc;
  first.ccw = circle.ccw;
  first.by_radius = circle.by_radius;
  first.radius = circle.radius;
  first.center[0] = circle.center.h;
  first.center[1] = circle.center.v;
  first.start[0] = plane.at.h;
  first.start[1] = plane.at.v;
  const AxisVec beside = way_by_hand(in);
  first.by_hand = beside[plane.h] != 0 || beside[plane.v] != 0;
  in.state.meeting = first;
  return Execution::done;
}

/// What the second block says: where it ends, and the line or the circle that it ends on.
struct Second {
  bool line = false, arc = false;
  PlanePoint end;
  bool has_end = false, incremental = false;
  SlopedLine slope;
  KnownCircle circle;
  int8_t choice = -1;
};

Second second_block(const BlockInHand& in, const InPlane& plane) {
  Second second;
  const Command& w = in.words;
  const Function motion = in.state.modal.of(Mode::motion);
  second.has_end = (w.target.axes() & plane.bits()) == plane.bits() && plane.bits() != 0;
  second.incremental = (w.target.incremental() & plane.bits()) != 0;
  const auto place = [&](unsigned axis, double from) { return w.target.counts_on(axis) ? from + w.target[axis] : w.target[axis]; };
  second.end = {place(plane.h, plane.at.h), place(plane.v, plane.at.v)};
  if (!second.has_end || !free_for_lines(in)) return second;
  second.line = motion == Function::linear && has_line_angle(in) && (w.has_angle || !word_is_taken(in));
  if (second.line) second.slope = {second.end, angle_of_block(in)};
  second.arc = is_arc(motion) && !w.has(Role::arc_turns) && circle_of_block(in, plane, second.end, &second.circle);
  return second;
}

KnownCircle circle_of(const MeetingFirst& first) { return {{first.start[0], first.start[1]}, first.ccw, first.by_radius, first.radius, {first.center[0], first.center[1]}}; }

/// Do an arc about `center` and the first one have one tangent where the first one begins, as far as their words tell?
bool leaves_along_tangent(const MeetingFirst& first, PlanePoint center) {
  const double a[2] = {first.center[0] - first.start[0], first.center[1] - first.start[1]}, b[2] = {center.h - first.start[0], center.v - first.start[1]};
  const double one = std::hypot(a[0], a[1]), other = std::hypot(b[0], b[1]);
  return std::fabs(a[0] * b[1] - a[1] * b[0]) <= 1e-4 * one * other + 1e-3 * (one + other);
}

/// What the last digits of three make, of two starts, two centres and an end together.
constexpr double kAllDigits_mm = 0.005;

/// Whether the second block is an arc by itself, from where the first one began: by 6.4 and 6.5 an arc without an end and the arc behind it mean
/// something without 13.9. `meet` false: the two blocks do not meet, so there is no other reading. Where both are possible by #1084, the tolerance of radii, one that is so but for
/// the last digits counts before one that is not. Where both are, it is the older one, but for a pair as 13.9 prints it, with the other sense, that does not begin along the circle
/// before: a contour that goes on from a whole circle leaves it along its tangent, and circles of which the second leaves the first so do not touch anywhere else.
bool stands_by_itself(const InForce& in, const MeetingFirst& first, const Second& second, bool meet) {
  const PlanePoint start{first.start[0], first.start[1]};
  const double tolerance = in.settings.arc_tolerance + 1e-9;
  if (second.circle.by_radius) {
    const double chord = std::hypot(second.end.h - start.h, second.end.v - start.v);
    if (chord / 2 - std::fabs(second.circle.radius) > in.settings.arc_tolerance || chord == 0) return false;  // 6.5: no circle of that radius goes through both
    return !meet || first.ccw == second.circle.ccw || leaves_along_tangent(first, center_of_radius(start, second.end, second.circle.radius, second.circle.ccw));
  }
  const double h = second.circle.center.h - second.end.h, v = second.circle.center.v - second.end.v;  // its centre counts from the start there
  const double off = std::fabs(std::hypot(h, v) - std::hypot(start.h + h - second.end.h, start.v + v - second.end.v));
  if (off > tolerance || !meet) return off <= tolerance;
  const double exact = in.state.modal.is(Function::inch) ? 2.54 * kAllDigits_mm : kAllDigits_mm;
  const double gap = first.by_radius ? 0 : gap_of_circles(circle_of(first), second.circle);
  if (gap > tolerance) return true;
  if (off > exact || gap > exact) return off <= gap;
  return first.ccw == second.circle.ccw || (!first.by_radius && leaves_along_tangent(first, {start.h + h, start.v + v}));
}

Meeting solve(const InForce& in, const MeetingFirst& first, const Second& second) {
  const PlanePoint start{first.start[0], first.start[1]};
  if (first.kind == Kind::line) {
    const SlopedLine line{start, first.angle_deg};
    if (second.line) return meet_lines(line, second.slope);
    return second.circle.by_radius ? touch_line_and_circle(line, second.circle, false) : meet_line_and_circle(line, second.circle, second.choice == 1);
  }
  const KnownCircle circle = circle_of(first);
  if (second.arc) return touch_circles(circle, second.circle, in.settings.arc_tolerance);
  return first.by_radius ? touch_line_and_circle(second.slope, circle, true) : meet_line_and_circle(second.slope, circle, first.choice == 1);
}

/// The axes of the plane stand where the blocks meet, or beside it where they were moved by hand there.
void go_to_meeting(BlockInHand& in, const InPlane& plane, PlanePoint at) {
  AxisVec point = programmed_position(in);
  const AxisVec beside = way_by_hand(in);
  point[plane.h] = at.h + beside[plane.h];
  point[plane.v] = at.v + beside[plane.v];
  if (program_mapped(in)) point = from_program(in, point);
  const AxisVec& zero = in.zero();
  for (const unsigned i : {plane.h, plane.v}) in.state.machine[i] = point[i] + zero[i] + in.state.applied[i];
}

Execution make_second(BlockContext& in, const InPlane& plane, const Second& second, const Meeting& meeting) {
  const AxisVec before_machine = in.state.machine;
  go_to_meeting(in, plane, meeting.at);
  const unsigned before = in.items_made();
  const AxisVec target = target_of_words(in);
  Execution did = Execution::done;
  if (second.line) {
    move_linear(in, target, in.words.target.axes(), cutting_style(in));
  } else {
    const PlanePoint center = second.circle.by_radius ? meeting.center : second.circle.center;
    ArcWords words;
    words.center[0] = center.h - meeting.at.h;
    words.center[1] = center.v - meeting.at.v;
    did = move_arc_by(in, plane.axes, target, in.words.target.axes(), words, second.circle.ccw);
    if (did != Execution::done) did = in.raise(Condition::geometric_contact, second.circle.by_radius ? Role::arc_radius : plane.axes.center[0]);
  }
  Move* const move = newest_move(in, before);
  if (did == Execution::done && move != nullptr) {
    move->meets = true;
    return Execution::done;
  }
  if (did == Execution::done) did = in.raise(Condition::geometric_contact);  // nothing is left of the second block
  in.state.machine = before_machine;
  return did;
}

/// A line without an end and a choice of the point are nothing by themselves; an arc without an end is.
bool needs_second(const MeetingFirst& first) { return first.kind == Kind::line || first.choice >= 0; }

Condition option_of(const MeetingFirst& first, const Second& second) {
  if (first.kind == Kind::line && second.line) return Condition::geometric_option;
  const bool by_radius = (second.arc && second.circle.by_radius) || (first.kind == Kind::arc && first.by_radius);
  return by_radius ? Condition::geometric_arc_option : Condition::geometric_circle_option;
}

Execution check_second_words(BlockInHand& in) {
  for (const FunctionRow* row : in.words.functions) {
    if (is_plane(row->function)) return in.raise_code(Condition::geometric_plane, *row);
    const bool fits = plain_motion(row->function) || row->function == Function::absolute || row->function == Function::incremental;
    if (!fits) return in.raise_code(row == in.words.one_shot ? Condition::geometric_no_line : Condition::geometric_address, *row);  // a dwell is no line
  }
  return Execution::done;
}

/// `by_center`: the block has said its centre by P and Q, which only the second of a pair does.
Execution end_meeting(BlockContext& in, const MeetingFirst& first, bool by_center) {
  in.state.meeting = {};
  const InPlane plane = in_plane(in);
  Second second = second_block(in, plane);
  const bool needed = needs_second(first) || by_center;
  if (needed) {
    const Execution did = check_second_words(in);
    if (did != Execution::done) return did;
    const Function motion = in.state.modal.of(Mode::motion);
    if (in.words.target.axes() == 0 || !free_for_lines(in) || !(motion == Function::linear || is_arc(motion))) return in.raise(Condition::geometric_no_line);
    if (in.words.has(Role::line_angle) && !has_line_angle(in)) return in.raise(Condition::geometric_address, Role::line_angle, in.words.get(Role::line_angle));
    if (second.incremental) return in.raise(Condition::geometric_incremental);
    if (!second.line && !second.arc) return in.raise(Condition::geometric_address);
  }
  const bool both_by_radius = first.kind == Kind::arc && first.by_radius && second.arc && second.circle.by_radius;
  const bool pair = (second.line || second.arc) && !both_by_radius && (by_center || !(first.kind == Kind::arc && second.arc && stands_by_itself(in, first, second, true)));
  if (!pair) return needed ? in.raise(Condition::geometric_address) : Execution::later;
  if (second.incremental) return in.raise(Condition::geometric_incremental);
  // An arc that begins beside its programmed start is not the one that meets the second block (12.4.4).
  if (first.kind == Kind::arc && first.by_hand) return in.raise_mode(Condition::arc_by_hand, Mode::motion);
  if (!choice_of_block(in, &second.choice)) return in.raise(Condition::geometric_address, Role::meeting_choice, in.words.get(Role::meeting_choice));
  Execution did = check_second_words(in);
  if (did == Execution::done && second.line) did = check_choice_beside_line(in);
  if (did == Execution::done) did = check_modes_of_pair(in, option_of(first, second));
  if (did != Execution::done) return did;
  const Meeting meeting = solve(in, first, second);
  if (meeting.bad != Condition::none) {
    // Two arcs that do not meet, and each of which means something by itself (6.4, 6.5), are no pair.
    if (!needed && second.arc && stands_by_itself(in, first, second, false)) return Execution::later;
    return in.raise(meeting.bad);
  }
  return make_second(in, plane, second, meeting);
}

bool begins_meeting(const BlockInHand& in) {
  const Command& w = in.words;
  if (!in.dialect->addresses.has(Role::line_angle) || !free_for_lines(in)) return false;
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return false;
  if (has_line_angle(in)) return (w.target.axes() & (1u << plane.h | 1u << plane.v)) == 0;
  if (says_center(in)) return w.target.axes() == 0;
  if (!is_arc(in.state.modal.of(Mode::motion)) || w.target.axes() != 0 || w.has(Role::arc_turns)) return false;
  return w.has(Role::arc_radius) || w.has(plane.center[0]) || w.has(plane.center[1]);
}

}  // namespace

bool has_line_angle(const BlockInHand& in) {
  const Command& w = in.words;
  if (!w.has_angle && !w.has(Role::line_angle)) return false;
  if (!in.state.modal.is(Function::linear) || !free_for_lines(in)) return false;
  return w.has_angle || !word_is_taken(in);
}

bool says_line_angle(const BlockInHand& in) { return has_line_angle(in) || needs_second(in.state.meeting); }

bool begins_or_ends_meeting(const BlockInHand& in) {
  const Command& w = in.words;
  const bool words = w.present != 0 || !w.functions.empty() || !w.auxiliary.empty() || w.has_angle;
  if (in.state.meeting.kind != Kind::none && words) return true;
  return begins_meeting(in);
}

Execution move_to_meet(BlockContext& in) {
  const MeetingFirst first = in.state.meeting;
  const bool by_center = says_center(in) && take_center(in);
  if (first.kind != Kind::none) {
    const Execution did = end_meeting(in, first, by_center);
    if (did != Execution::later) return did;
    in.words.meeting = false;
    if (!begins_meeting(in)) return execute_motion_of_words(in);
  }
  return has_line_angle(in) ? begin_with_line(in) : begin_with_arc(in, by_center);
}

/// 13.8: the end coordinate that is missing, from the one that is there.
Execution take_line_angle(BlockInHand& in) {
  Command& w = in.words;
  if (!has_line_angle(in)) return w.has_angle ? in.raise(Condition::geometric_option, Role::option_angle, w.angle.value) : Execution::done;
  const InPlane plane = in_plane(in);
  if (!plane.exists()) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  if ((in.state.special & kSpecialMap) != 0) return in.raise(Condition::geometric_option, Role::option_angle, angle_of_block(in));
  if (in.state.high_speed != SpeedMode::off) return in.raise(Condition::format_error, Role::line_angle, angle_of_block(in));  // note
  const bool has_h = w.target.commands(plane.h), has_v = w.target.commands(plane.v);
  if (has_h == has_v) return Execution::done;  // (3): with both the angle is ignored
  double cosine = 0, sine = 0;
  direction_of(angle_of_block(in), &cosine, &sine);
  const unsigned given = has_h ? plane.h : plane.v, other = has_h ? plane.v : plane.h;
  const double from = has_h ? plane.at.h : plane.at.v;
  const double way = w.target.counts_on(given) ? w.target[given] : w.target[given] - from;
  // The line never gets there: it runs across the direction of the coordinate that is given.
  const double along = has_h ? cosine : sine, across = has_h ? sine : cosine;
  const double end = way * across / along, last = in.state.modal.is(Function::inch) ? in.settings.last_inch : in.settings.last_mm;
  const bool arrives = along != 0 && std::fabs(end) <= last && std::fabs((has_h ? plane.at.v : plane.at.h) + end) <= last;  // within the range of coordinates (2.1)
  if (!arrives) return in.raise_axis(Condition::geometric_address, given, w.target[given]);
  // With an increment the way by hand stays. A line that is led to a place is led back to its programmed end (12.4.4).
  const bool leads_back = in.state.by_hand && !w.target.counts_on(given);
  w.target.set(other, leads_back ? TargetKind::absolute : TargetKind::incremental, leads_back ? (has_h ? plane.at.v : plane.at.h) + end : end);
  return Execution::done;
}

}  // namespace nc
