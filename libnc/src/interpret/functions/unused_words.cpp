// SPDX-License-Identifier: Apache-2.0
// Words that no code of their block takes. LinuxCNC makes each of them an error; the formats of DGSHAPE, HX and Series 8 list the words of each code, and a word
// that stands in none of them is a slip that would be lost without one (rule unused_words_are_faults). What a code takes is said here by the meanings of words: a
// family that has no word for a meaning has nothing to take there.
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"

namespace nc {
namespace {

/// I J K of the plane in force.
WordSet vectors_of_plane(const InForce& in) {
  const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
  return in.set_of({vector_along(plane.first), vector_along(plane.second)});
}

/// What the fixed cycle of the block takes (RS-274/NGC 3.5.16, LinuxCNC G73, G74; DGSHAPE G81 to G89; Series 8 G81 to G89).
WordSet words_of_cycle(const BlockInHand& in, Function cycle) {
  if (!in.words.any(in.axis_words.all() | in.set_of({Role::cycle_level}))) return 0;  // a block without a hole keeps nothing (M700 13.1.1 (2))
  const WordSet vectors = in.set_of({Role::vector_x, Role::vector_y, Role::vector_z});
  WordSet words = in.set_of({Role::cycle_level, Role::cycle_count, Role::cycle_count_2});
  if (in.dialect->rules.cycle.takes_length_number) words |= in.set_of({Role::offset_number});
  if (in.dialect->rules.cycle.words_of_all) words |= in.set_of({Role::cycle_depth_step, Role::cycle_dwell});
  switch (cycle) {
    case Function::cycle_peck:
    case Function::cycle_step: return words | in.set_of({Role::cycle_depth_step, Role::cycle_first_depth});
    case Function::cycle_back_bore: return words | vectors;
    case Function::cycle_bore_oriented:
    case Function::cycle_face_upwards: return words | vectors_of_plane(in) | in.set_of({Role::cycle_dwell});
    case Function::cycle_fine_bore: return words | vectors | in.set_of({Role::cycle_depth_step, Role::cycle_dwell});
    case Function::cycle_tap:
    case Function::cycle_reverse_tap: return words | in.set_of({Role::tap_lead, Role::cycle_dwell});
    case Function::cycle_rigid_tap:
    case Function::cycle_rigid_reverse_tap:
    case Function::cycle_spot:
    case Function::cycle_bore_restart:
    case Function::cycle_bore_stop_dwell:
    case Function::cycle_bore_dwell: return words | in.set_of({Role::cycle_dwell});
    case Function::cycle_bore_stop: return in.dialect->rules.cycle.bore_stop_dwells ? words | in.set_of({Role::cycle_dwell}) : words;
    default: return words;
  }
}

/// What a one-shot function takes beside axes.
WordSet words_of_one_shot(const InForce& in, Function function) {
  const WordSet vectors = in.set_of({Role::vector_x, Role::vector_y, Role::vector_z});
  switch (function) {
    case Function::dwell: return in.set_of({Role::dwell_time});
    case Function::data_input: {  // its kinds that are not built have further words, and alarms that say so
      const bool turns = in.dialect->rules.data_input.amount_turns_system;
      return in.set_of({Role::input_kind, Role::input_number, Role::input_amount}) | (turns ? in.set_of({Role::vector_x, Role::vector_y, Role::cycle_depth_step}) : 0);
    }
    case Function::second_reference: return in.dialect->rules.reference.place_is_checked ? in.set_of({Role::return_place}) : 0;
    case Function::scaling_on: return in.set_of({Role::scaling_factor}) | (in.dialect->rules.scaling.factor_by_axis ? vectors : 0);
    case Function::rotation_on: return in.set_of({Role::rotation_angle});
    case Function::stroke_check_on: return vectors;
    case Function::coordinate_set: return in.set_of({Role::surface_radius});
    case Function::comp_corner_turn: return in.dialect->rules.compensation.vector_by_words ? vectors_of_plane(in) : 0;
    case Function::machine_move: {  // Series 8 G69 beside an arc; what LinuxCNC G53 does not take beside one is the arc itself
      const bool arc = in.dialect->rules.coordinate.machine_move_by_motion && is_arc(in.state.modal.of(Mode::motion));
      return arc ? vectors_of_plane(in) | in.set_of({Role::arc_radius, Role::arc_turns}) : 0;
    }
    case Function::offset_longer:
    case Function::offset_shorter:
    case Function::offset_twice_longer:
    case Function::offset_twice_shorter:  // HX 13.3 prints them beside arcs, too
      return in.set_of({Role::offset_number}) | (is_arc(in.state.modal.of(Mode::motion)) ? vectors_of_plane(in) | in.set_of({Role::arc_radius}) : 0);
    case Function::cavity_ccw:
    case Function::cavity_cw:
      return in.set_of({Role::cycle_level, Role::cavity_length, Role::cavity_width, Role::cavity_cut, Role::cavity_step, Role::cavity_corner, Role::offset_number});
    case Function::cavity_circle: return in.set_of({Role::cycle_level, Role::cavity_length, Role::cavity_cut, Role::cavity_step, Role::offset_number});
    case Function::holes_on_frame_ccw:
    case Function::holes_on_frame_cw: return in.set_of({Role::hole_interval, Role::hole_interval_2, Role::hole_columns, Role::hole_count});
    default: return 0;
  }
}

/// Axis words that the one-shot function of the block has no use for. Many functions check theirs themselves; here are those that would pass over them.
WordSet axes_lost(const InForce& in, Function function) {
  switch (function) {
    case Function::dwell:  // some families have an alarm of their own for it
      return in.dialect->rules.dwell.refuses_axes ? 0 : in.axis_words.all() & ~in.set_of({Role::dwell_seconds});
    case Function::stitch_on:
    case Function::stitch_off: return in.axis_words.all();
    case Function::rotation_on: {
      if (in.dialect->rules.rotation.about_zero) return 0;  // they are a move
      const PlaneAxes plane = plane_axes(in);
      WordSet used = 0;
      for (const int axis : {plane.h, plane.v})
        if (axis >= 0) used |= set_of(in.axis_words.word(static_cast<unsigned>(axis)));
      return in.axis_words.all() & ~used;
    }
    default: return 0;
  }
}

/// What the motion, the cycle or the one-shot function of the block takes beside the axes.
WordSet words_of_motion(const BlockInHand& in) {
  const Command& w = in.words;
  const bool of_hole = in.state.cycle.kind != CycleKind::none && w.one_shot != nullptr && w.one_shot->function == Function::unidirectional;  // HX 4.2
  WordSet words = 0;
  if (w.one_shot != nullptr && !of_hole) {
    words = words_of_one_shot(in, w.one_shot->function);
    if (w.cycle == nullptr || w.cycle->function == Function::cycle_off) return words;
  }
  const bool ends_cycle = w.motion != nullptr && in.dialect->rules.cycle.beside != CycleBeside::cycle;
  if (w.cycle != nullptr && w.cycle->function != Function::cycle_off) return words | words_of_cycle(in, w.cycle->function);
  if (w.cycle == nullptr && in.state.cycle.kind != CycleKind::none && !ends_cycle) return words_of_cycle(in, in.state.modal.of(Mode::cycle));
  const Function motion = in.state.modal.of(Mode::motion);
  if (motion == Function::thread) return words | in.set_of({Role::thread_lead});
  return is_arc(motion) ? words | vectors_of_plane(in) | in.set_of({Role::arc_radius, Role::arc_turns}) : words;
}

WordSet words_of_mode(const InForce& in, Function function) {
  const CompensationRules& rules = in.dialect->rules.compensation;
  const WordSet direction = rules.vector_by_words ? vectors_of_plane(in) : 0;
  switch (function) {
    case Function::comp_left:
    case Function::comp_right: return in.set_of({Role::offset_number}) | direction;
    case Function::comp_off: return direction;
    case Function::length_plus:
    case Function::length_minus: return in.set_of({Role::length_number});
    case Function::surface_on: return in.dialect->rules.spindle.limit_beside_surface ? in.set_of({Role::clamp_highest}) : 0;
    case Function::cutting_mode: return in.set_of({Role::path_tolerance, Role::line_tolerance});  // LinuxCNC G64
    default: return 0;
  }
}

WordSet words_of_misc(const InForce& in, MiscFunction function) {
  switch (function) {
    case MiscFunction::override_of_one: return in.set_of({Role::override_switch});
    case MiscFunction::machine_output: return in.set_of({Role::output_number});
    case MiscFunction::machine_input: return in.set_of({Role::output_number, Role::word_number, Role::input_wait, Role::input_limit});
    case MiscFunction::machine_value: return in.set_of({Role::word_number, Role::word_value});
    case MiscFunction::tool_number: return in.set_of({Role::named_tool});
    case MiscFunction::spindle_oriented:  // R P Q of LinuxCNC M19
      return in.dialect->addresses.has(Role::orient_angle) ? in.set_of({Role::orient_angle, Role::cycle_dwell, Role::cycle_depth_step}) : 0;
    case MiscFunction::call_sub: return in.set_of({Role::call_program, Role::call_repeats, Role::call_sequence, Role::call_end_sequence});
    case MiscFunction::return_sub: return in.set_of({Role::return_sequence, Role::return_passes});
    default: return 0;
  }
}

}  // namespace

Execution check_unused_words(BlockInHand& in) {
  const Command& w = in.words;
  const Rules& rules = in.dialect->rules;
  // Names of axes that the machine does not have are an alarm of their own.
  WordSet free = in.axis_words.all() | in.dialect->axis_addresses | in.set_of({Role::sequence_number, Role::program_number, Role::feed, Role::spindle_speed, Role::tool});
  if (rules.length.number_in_any_block) free |= in.set_of({Role::length_number});
  if (rules.compensation.number_in_any_block) free |= in.set_of({Role::offset_number});
  if (w.one_shot != nullptr) free &= ~axes_lost(in, w.one_shot->function);
  if (!w.any(~free)) return Execution::done;
  WordSet used = words_of_motion(in);
  for (const FunctionRow* row : w.functions) used |= words_of_mode(in, row->function);
  for (const Auxiliary& m : w.auxiliary) used |= words_of_misc(in, m.function);
  const WordSet unused = w.present & ~free & ~used;
  return unused == 0 ? Execution::done : in.raise_first(Condition::illegal_address, unused);
}

}  // namespace nc
