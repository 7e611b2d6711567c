// SPDX-License-Identifier: Apache-2.0
// See state_hash.hpp. Structs of the state have padding, whose bytes mean nothing, so they are hashed member by member. A structured binding names all members
// of its struct, so that a forgotten member does not compile.
#include "interpret/state_hash.hpp"

#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

#include "interpret/interpreter.hpp"

namespace nc {
namespace {

class Hash {
 public:
  template <class... T>
  void add(const T&... member) {
    (add_one(member), ...);
  }
  uint64_t value() const { return value_; }

 private:
  void word(uint64_t bits) {
    // A step of a linear congruential generator (its multiplier: Knuth, TAOCP 3.3.4). The upper bits, on which most input bits have acted, are then
    // added to the lower ones.
    value_ = (value_ ^ bits) * 6364136223846793005u + 1442695040888963407u;
    value_ ^= value_ >> 32;
  }
  template <class T>
  requires(std::is_integral_v<T> || std::is_enum_v<T>) void add_one(T member) {
    word(static_cast<uint64_t>(member));
  }
  void add_one(double member) { word(std::bit_cast<uint64_t>(member)); }
  template <class T, size_t kCount>
  void add_one(const T (&members)[kCount]) {
    for (const T& member : members) add_one(member);
  }
  void add_one(const AxisVec& at) { add_one(at.v); }
  void add_one(const ModalState& modal) {
    const auto& [in_force, number, extended, feed_digit, feed, spindle, tool, d, h, m, n, o, b, h_given, d_given] = modal;
    add(in_force, number, extended, feed_digit, feed, spindle, tool, d, h, m, n, o, b, h_given, d_given);
  }
  void add_one(const Repeat& repeat) {
    const auto& [active, items] = repeat;
    add(active, items);
  }
  void add_one(const SplineState& spline) {
    const auto& [on, axes] = spline;
    add(on, axes);
  }
  void add_one(const AxisMap& map) {
    const auto& [kind, linear, rotary, side, frozen, scale, angle] = map;
    add(kind, linear, rotary, side, frozen, scale, angle);
  }
  void add_one(const MillReturn& mill) {
    const auto& [feed, plane, feed_mode, plane_axis, third_axis, word, moved] = mill;
    add(feed, plane, feed_mode, plane_axis, third_axis, word, moved);
  }
  void add_one(const SpindleControl& spindle) {
    const auto& [surface, axis, held] = spindle;
    add(surface, axis, held);
  }
  void add_one(const SpindleClamp& clamp) {
    const auto& [any, always, has_s, s, q] = clamp;
    add(any, always, has_s, s, q);
  }
  void add_one(const Compensation& compensation) {
    const auto& [side, transparent, has_vector, hold_vector, corner_arc, type_b, cancel_vector, check, walls, avoid, square_in_spike, axis, arc_cos, radius, vector, by_hand] = compensation;
    add(side, transparent, has_vector, hold_vector, corner_arc, type_b, cancel_vector, check, walls, avoid, square_in_spike, axis, static_cast<double>(arc_cos), radius, vector, by_hand);
  }
  void add_one(const CycleState& cycle) {
    const auto& [kind, drill_axis, has_z, has_r, has_p, z, r, z_incremental, r_incremental, q, tap_q, p, shift, third, has_third, third_incremental, in_position,
                 initial_level, tap, synchronous, returned, has_first, pitch, return_speed, first, in_hole, way_out] = cycle;
    add(kind, drill_axis, has_z, has_r, has_p, z, r, z_incremental, r_incremental, q, tap_q, p, shift, third, has_third, third_incremental, in_position,
        initial_level, tap, synchronous, returned, has_first, pitch, return_speed, first, in_hole, way_out);
  }
  void add_one(const NurbsState& nurbs) {
    const auto& [first, knots, points, order, axes] = nurbs;
    add(first, knots, points, order, axes);
  }
  void add_one(const LifeInput& input) {
    const auto& [kind, method, group, life, registered] = input;
    add(kind, method, group, life);
    if (kind != LifeInput::Kind::none) add(registered);
  }
  void add_one(const SplineWay& way) {
    const auto& [joined, moved, back] = way;
    add(joined, moved, back);
  }
  void add_one(const MeetingFirst& meeting) {
    const auto& [kind, ccw, by_radius, by_hand, choice, angle_deg, center, radius, start] = meeting;
    add(kind, ccw, by_radius, by_hand, choice, angle_deg, center, radius, start);
  }
  void add_one(const SpaceVector& space) {
    const auto& [on, turns, axis, v] = space;
    add(on, turns, axis, v);
  }
  void add_one(const LeftByEnd& left) {
    const auto& [feed, motion, feed_mode, any] = left;
    add(feed, motion, feed_mode, any);
  }
  void add_one(const StrokeBox& box) {
    const auto& [axis, turns, low, high, way, outside, unknown] = box;
    add(axis, turns, low, high, way, outside, unknown);
  }
  void add_one(const ProgramRef& program) {
    const auto& [file, number, offset, line] = program;
    add(file, number, offset, line);
  }
  void add_one(const CallFrame& frame) {
    const auto& [program, offset, begin, line, begin_line, call_line, repeats, kind, macro_level, loop_base, started, origin, modal_call, modal_slot,
                 figure, last_sequence, last_begun, puts_back, places_made] = frame;
    add(program, offset, begin, line, begin_line, call_line, repeats, kind, macro_level, loop_base, started, origin, modal_call, modal_slot, figure, last_sequence,
        last_begun, puts_back, places_made);
  }
  void add_one(const OptionalDouble& number) { add_one(number.value_or(std::numeric_limits<double>::quiet_NaN())); }
  void add_one(const ModalCall& call) {
    const auto& [program, repeats, every_block, by_code, below, depth, argument] = call;
    add(program, repeats, every_block, by_code, below, depth, argument);
  }
  void add_one(const HolePattern& pattern) {
    const auto& [kind, columns, rows, interval, interval_2, angle, step, closed] = pattern;
    add(kind, columns, rows, interval, interval_2, angle, step, closed);
  }
  void add_one(const PlacesOfCalls& places) {
    const auto& [pattern, at, axis] = places;
    add(pattern, at, axis);
  }
  void add_one(const Figure& figure) {
    const auto& [center, start, step, angle] = figure;
    add(center, start, step, angle);
  }
  void add_one(const InterruptProgram& interrupt) {
    const auto& [program, begin, begin_line] = interrupt;
    add(program, begin, begin_line);
  }
  void add_one(const ProgramMaps& maps) {
    const auto& [mirror_center, scaling_center, scaling_factor, rotation_center, rotation_deg, start] = maps;
    add(mirror_center, scaling_center, scaling_factor, rotation_center, rotation_deg, start);
  }
  void add_one(const Selection& selection) {
    const auto& [parameter, device, tool_group] = selection;
    add(parameter, device, tool_group);
  }
  void add_one(const RegisteredTool& used) {
    const auto& [slot, number] = used;
    add(slot, number);
  }
  void add_one(const ToolsInUse& tools) {
    const auto& [spindle, selected, cutting] = tools;
    add(spindle, selected, cutting);
  }
  void add_one(const LifeFlags& flags) {
    const auto& [method, others] = flags;
    add(method, others);
  }
  void add_one(const ToolLife& registered) {
    const auto& [group, tool, flags, status, life, used, length, radius, auxiliary] = registered;
    add(group, tool, flags, status, life, used, length, radius, auxiliary);
  }
  void add_one(const WorkTurn& turn) {
    const auto& [deg, center, axis] = turn;
    add(deg, center, axis);
  }
  void add_one(const WorkTurns& turns) {
    const auto& [commanded, reached] = turns;
    add(commanded, reached);
  }
  void add_one(const SwitchMirror& mirror) {
    const auto& [center] = mirror;
    add(center);
  }
  void add_one(const WayByHand& way) {
    const auto& [beside] = way;
    add(beside);
  }
  void add_one(const ReferenceMidpoints& midpoints) {
    const auto& [axis] = midpoints;
    add(axis);
  }
  void add_one(const SkipPosition& skip) {
    const auto& [work, touched] = skip;
    add(work, touched);
  }
  void add_one(const InterfaceOutput& output) {
    const auto& [bits] = output;
    add(bits);
  }
  void add_one(const WorkpieceCounts& workpieces) {
    const auto& [count] = workpieces;
    add(count);
  }
  void add_one(const InputAnswer& answer) {
    const auto& [value] = answer;
    add(value);
  }
  void add_one(const ShiftKept& kept) {
    const auto& [at] = kept;
    add(at);
  }
  void add_one(const StoredArea& area) {
    const auto& [box] = area;
    add(box);
  }
  void add_one(const Loop& loop) {
    const auto& [offset, body, end, line, end_line, number] = loop;
    add(offset, body, end, line, end_line, number);
  }

  uint64_t value_ = 0;
};

/// Adds all groups of the state. Left out is what only counts up: the number of blocks, and the ids of a held point or an area, whose contents are added
/// instead.
void add_values(Hash& hash, const Interpreter& in, const StateValues& values) {
  {
    const auto& [seq, repeat, owes_mark, stop_reading, modes_ahead] = static_cast<const BlockLife&>(values);
    static_cast<void>(seq);
    hash.add(repeat, owes_mark, stop_reading, modes_ahead);
  }
  {
    const auto& [machine] = static_cast<const MachinePosition&>(values);
    hash.add(machine);
  }
  {
    const auto& [applied] = static_cast<const AppliedLength&>(values);
    hash.add(applied);
  }
  {
    const auto& [modal, tool_length, length_value, length_axis, plane_axis, third_axis, polar_angle_known, work_system, high_speed, fine_mode, accuracy_command, scaled, mirror,
                 rotated, stitch, spline, held_point, stroke_box, polar_angle, polar_pole, thread_lead, last_feed, arc_radius, map_begins, map, mill, spindle] = static_cast<const ModalLife&>(values);
    hash.add(modal, tool_length, length_value, length_axis, plane_axis, third_axis, polar_angle_known, work_system, high_speed, fine_mode, accuracy_command, scaled, mirror, rotated, stitch,
             spline, polar_angle, polar_pole, thread_lead, last_feed, arc_radius, map_begins, map, mill, spindle);
    if (map.frozen != 0) hash.add(in.points[held_point].at);
    hash.add(stroke_box != 0);
    if (stroke_box != 0) {
      hash.add(in.stroke_boxes[stroke_box - 1]);
    }
  }
  {
    const auto& [comp, cycle, motion_off, moves_since_comp_off, moved_side, arc_points, nurbs, nurbs_order, arc_step, parameter_input, tap_code, switch_mirror, figure_scaled, figure_mirror,
                 vacant_feed_file, vacant_feed, vacant_feed_line, spline_way, meeting, space, space_mirror, space_number, life_input, moved_space, by_hand] = static_cast<const ModalInProgram&>(values);
    hash.add(comp, cycle, motion_off, moves_since_comp_off, moved_side, nurbs_order, arc_step, parameter_input, tap_code, switch_mirror, figure_scaled, figure_mirror, vacant_feed_file,
             vacant_feed, vacant_feed_line, spline_way, meeting, space, space_mirror, space_number, life_input, moved_space, by_hand);
    // Inside a curve that is given block by block its points have numbers of their own: two such states count as different.
    if (arc_step != ArcStep::none) hash.add(arc_points);
    if (nurbs.active()) hash.add(nurbs);
  }
  {
    const auto& [end_seen, percent_seen, unit_used, interrupt_on, interrupt_moved, interrupt_depth, suppressed, disabled] = static_cast<const ProgramLife&>(values);
    hash.add(end_seen, percent_seen, unit_used, interrupt_on, interrupt_moved, interrupt_depth, suppressed, disabled);
  }
  {
    const auto& [spindle_on, spindle_reverse, spindle_clamp, length_handle_number, length_by_handle, length_changed_by_handle, tool_angles_old, tool_angle] = static_cast<const UntilReset&>(values);
    hash.add(spindle_on, spindle_reverse, spindle_clamp, length_handle_number, length_by_handle, length_changed_by_handle, tool_angles_old, tool_angle);
  }
  {
    const auto& [left_by_end] = static_cast<const UntilOperatorReset&>(values);
    hash.add(left_by_end);
  }
  {
    const auto& [clock_base, clock_shift_s, port_open, selected_tool, spindle_tool, reads_beside_machine, machine_has] = static_cast<const UntilPowerOff&>(values);
    hash.add(clock_base, clock_shift_s, port_open, selected_tool, spindle_tool);
    // What the machine has beside it decides nothing of what the program does from here on.
    static_cast<void>(reads_beside_machine);
    static_cast<void>(machine_has);
  }
  // The group Derived follows from the other groups, the records and the parameters.
}

void add_calls(Hash& hash, const CallStack& stack) {
  const auto& [codes_left, depth, loop_count, frame, loop] = stack;
  hash.add(codes_left, depth, loop_count);
  for (unsigned level = 0; level <= depth; ++level) hash.add(frame[level]);
  for (unsigned open = 0; open < loop_count; ++open) hash.add(loop[open]);
}

void add_variables(Hash& hash, const Interpreter& in) {
  for (unsigned level = 0; level <= in.macro_level(); ++level)
    for (unsigned i = 0; i < in.variables.local_count(); ++i) hash.add(in.variables.locals(level)[i]);
  double value = 0;
  uint32_t number = 0;
  for (uint32_t from = 0; in.common->next(from, &number, &value); from = number + 1) hash.add(number, value);
  for (unsigned i = 0; i < kNames; ++i) hash.add(in.common->name(i).text);
  const NamedParameters& named = in.variables.named();
  for (uint32_t i = 0; named.exists(i) && i < NamedParameters::kMost; ++i) hash.add(named.get(i).vacant, named.get(i).number);
}

void add_parameters(Hash& hash, const Parameters& parameters) {
  ParameterId id;
  ParameterValue value;
  int axis = 0;
  for (unsigned i = 0; parameters.at(i, &id, &axis, &value); ++i) {
    hash.add(i, value.number);  // the id and axis of entry i never change, so its number is enough
    if (const char* text = parameters.text(value)) {
      for (; *text != 0; ++text) hash.add(*text);
    }
  }
}

void add_records(Hash& hash, const ProgramRecords& records) {
  {
    const auto& [modal_call, places, figure, interrupt, switch_mirror, selection, work_turn, way_by_hand] = static_cast<const ProgramRecordsLife&>(records);
    hash.add(modal_call, places, figure, interrupt, switch_mirror, selection, work_turn, way_by_hand);
  }
  {
    const auto& [maps] = static_cast<const MapRecordsLife&>(records);
    hash.add(maps);
  }
  {
    const auto& [midpoints, skip, output, workpieces, answer, shift_kept, area, tools] = static_cast<const MachineRecordsLife&>(records);
    hash.add(midpoints, skip, output, workpieces, answer, shift_kept, area, tools);
  }
}

}  // namespace

uint64_t tables_hash(const Interpreter& in) {
  Hash hash;
  for (unsigned key = 0; key < in.frames.size(); ++key) hash.add(in.frames.get(key));
  add_parameters(hash, in.parameters);
  return hash.value();
}

uint64_t state_hash(const Interpreter& in) {
  Hash hash;
  add_values(hash, in, in.state);
  add_calls(hash, in.state);
  add_values(hash, in, in.interrupted_state());
  const auto& [executed] = static_cast<const ModesInExecution&>(in.state);
  hash.add(executed);
  hash.add(in.jobs.input_wait.left);  // a wait comes to its end, though nothing else changes
  add_variables(hash, in);
  for (unsigned key = 0; key < in.frames.size(); ++key) hash.add(in.frames.get(key));
  hash.add(in.lives->tool);
  add_records(hash, *in.records);
  add_parameters(hash, in.parameters);
  return hash.value();
}

}  // namespace nc
