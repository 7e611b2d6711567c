// SPDX-License-Identifier: Apache-2.0
// What can be wrong with a program. A condition has a name here, and no number of a family: the table of each dialect turns it into the code and the
// short text of its manual (dialect/alarms.hpp).
#pragma once

#include <cstdint>

namespace nc {

enum class Condition : uint16_t {
  none,
  // words and blocks
  illegal_address, exponent, format_error, behind_semicolon, value_range, illegal_character, block_too_long, number_zero, program_end, no_start_mark,
  illegal_axis, too_many_axes, index_increment, parity, parity_vertical,
  // G and M codes
  illegal_g, no_function, must_stand_alone, words_missing, center_missing,
  // motion
  no_feed, arc_deviation, arc_displaced, arc_by_hand, arc_center, helix_option, plane_mismatch, plane_in_compensation, plane_in_rotation, space_conversion, arc_in_compensation_start,
  no_offset_number, cycle_in_compensation, skip_in_compensation, skip_feed_zero, skip_feed_mode, no_reference, soft_limit, spindle_not_turning,
  cycle_wrong_plane, not_in_compensation, code_in_incremental, tool_pair,
  comp_no_intersection, comp_interference, comp_way, corner_option, corner_arc, corner_no_move, corner_short, corner_reversal, corner_next_short,
  corner_motion, pre_read, geometric_option, second_aux, space_compensation,
  thread_lead, mill_code, mill_axis, mill_modal, mill_state, space_arc_blocks, space_arc_mode, exponential_mode, exponential_axes,
  nurbs_knot, nurbs_start, displaced, space_conversion_code, inverse_time_code, arc_feed_zero, circle_radius,
  reference_compare, reference_check_m, start_return_m,
  measure_axis, measure_h, measure_no_length, measure_signal, stroke_check, stroke_area_unknown,
  not_accepted, in_high_accuracy, high_speed_3,
  // offsets
  data_input_kind, data_input_number, local_in_extended,
  // programs and macros
  program_missing, sequence_missing, nesting, macro_nesting, no_macro, macro_and_words, macro_argument, cancel_without_call,
  user_alarm, bracket_nesting, bracket_pair, calculation, division_by_zero, if_statement, while_statement, name_statement,
  loop_nesting, loop_pair, jump_on_tape, address_missing, variable_number, no_equals, variable_use, variable_name,
  variable_name_twice, call_in_cycle, print_port, parameter_input, no_such_data,
  program_edited, rotation_in_figure, offset_in_figure, offset_arc, machine_in_figure, surface_axis, surface_speed,
  geometric_arc_option, geometric_circle_option, geometric_parallel, geometric_incremental, geometric_no_line, geometric_address, geometric_plane,
  geometric_contact, tool_axis_pair, tool_axis_code, space_conversion_block, outside_compensation,
  read_failed, program_changed, vendor_function,
  control_structure, name_without_value, too_many_names, probe_no_contact, call_in_mdi,
  contour_too_long,
  tap_no_speed, tap_no_pitch, tap_pitch, tap_speed_word, no_holes, hole_angle_zero, drilling_axis_changed,
  life_full, life_group, tap_apart, encoder_jumps, restart_void,
  block_skip, sub_without_return,
  polar_code, polar_axis, polar_modal, polar_state,   // as those of mill_..., of the polar coordinate interpolation
  probe_contact, two_words, comment_open, level_below_bottom, cavity_size, cavity_corner, cavity_step,
  head_silent, length_beside_arc, tool_unknown, corner_uneven,
  comp_turn_open, comp_turn_inside, no_direction,
  internal,
  count_
};

}  // namespace nc
