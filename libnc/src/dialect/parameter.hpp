// SPDX-License-Identifier: Apache-2.0
// What parameters mean to the control. A family's table (dialect/parameter_rows.hpp) binds its numbers and names to these meanings; nothing
// outside dialect/ knows a number. Parameters that mean the same for several things, the first, the second and so on, are one meaning with an
// index. "[n]" stands beside such a meaning and says how many there are.
#pragma once

#include <cstdint>

namespace nc {

enum class Parameter : uint8_t {
  none,
  setting_unit,                ///< letter of the unit that positions are set and shown in
  command_unit,                ///< unit of a word without a point
  start_plane,                 ///< 1 xy, 2 zx, 3 yz
  plane_axis,                  ///< [3] axes that I, J and K belong to
  parallel_axis,               ///< [3] axes parallel to those of plane_axis
  tool_memory_type,
  start_absolute,
  start_synchronous,
  decimal_type_2,
  feed_by_digit,
  drilling_axis_z,
  system_codes_call,
  arc_tolerance,
  rapid_dry,
  rapid_by_axis,
  tool_change_axis,
  interrupt_own_m,
  interrupt_on_m,
  interrupt_off_m,
  interrupt_by_level,
  interrupt_type_2,
  edit_lock_c,                 ///< programs of FamilyParameters::locked_programs[1] cannot be edited,
  reset_clears_common,
  power_off_clears_common,
  clamp_command_always,
  start_high_accuracy,
  arc_joint_clamp,
  start_inch,
  initial_inch,                ///< unit that offsets and parameters are set in, and in which a program reads and writes them
  dwell_skip,
  skip_feed,
  multi_skip_signals,          ///< [3]
  multi_skip_feed,             ///< [3]
  surface_axis,
  digit_feed,                  ///< [5]
  checks_position,
  words_call,                  ///< [4] in order: M, S, T, second auxiliary function
  rapid_before,
  accuracy_speed,
  accuracy_time,
  arc_joint_speed,
  keeps_polar_command,
  keeps_clamp,
  checks_cutting,
  clamp_in_surface_speed,
  interrupt_as_sub,
  precision_lead,
  comp_type_b,
  helix_plane_feed,
  code_type,
  spiral_type_2,
  asin_0_360,
  run_time_hours,
  last_shared_of_first,        ///< last variable of the first range of common variables that part systems share
  last_shared_of_second,       ///< the same of the second range
  one_position_check,
  checks_reversal,
  digit_most,
  digit_divisions,
  exponential_axis,            ///< [2] linear, rotary
  mill_axis,
  hypothetical_by_name,
  polar_linear_axis,
  pattern_filter,              ///< [2] cuts, rapid traverse
  pattern_second,
  rapid_linear,
  rapid_exponential,
  cut_linear,
  cut_exponential,
  no_reference,
  reference_position,          ///< [4]
  arc_radius_shift,
  index_axis,
  corner_least_speed,
  skip_linear,
  skip_exponential,
  index_increment,
  accuracy_clamp,              ///< [2] rapid traverse, cuts
  m_call_code,                 ///< [10]
  m_call_type,                 ///< [10]
  m_call_program,              ///< [10]
  second_aux_call_type, second_aux_call_program,
  g_call_code,                 ///< [10]
  g_call_type,                 ///< [10]
  g_call_program,              ///< [10]
  s_call_type, s_call_program,
  t_call_type, t_call_program,
  ascii_call_on,               ///< [2]
  ascii_call_letter,           ///< [2]
  ascii_call_type,             ///< [2]
  ascii_call_program,          ///< [2]
  ascii_call_variable,         ///< [2]
  measure_feed,
  measure_deceleration,
  measure_range,
  corner_override,
  corner_override_angle,
  corner_override_zone,
  step_clearance,
  peck_clearance,
  radius_percent,
  corner_angle,
  separate_percents,
  corner_percent,              ///< [2] corners, curves
  spline_allowed,
  spline_cancel_angle,
  spline_tolerance,            ///< [2] with an inflection, without one
  fairing_length,
  spline_minute_length,
  fairing,
  acceleration_clamp,
  corner_judgement,
  judgement_length,
  scaling_factor,
  spiral_tolerance,
  smooth_control,
  macro_single,
  space_divisor,
  interference_avoided,
  interference_ignored,
  edit_lock_b,                 ///< and those of locked_programs[0]
  arc_compensation,
  arc_compensation_by_axis,
  dwell_p_decimal,
  diameter_offsets,
  tool_change_position,
  creep,
  mirrored,
  rotary_type,
  work_turn_axis,              ///< [2]
  work_turn_center,            ///< [2]
  work_turn_vector,            ///< [2]
  work_turn_angle,
  parity_unit,                 ///< [5]
  tap_check_approach,
  tap_checks,
  tap_check_bottom,
  tap_check_r,
  tap_synchronous,
  tap_by_code,
  tap_to_r,
  tap_dwell,
  tap_code,
  spindle_forward_code,
  tap_clearance,
  shift_ignored,
  shift_minus,
  spindle_most,                ///< [2] highest speed, time of the third stage of a tap up to it
  tap_speed,                   ///< [2] to which the first and the second stage go
  tap_time,                    ///< [2] of these
  tap_return_override,
  life_managed,
  life_by_tool,
  // of machines and later models, which the manuals only mention
  tenfold,
  print_blanks,
  macro_extensions,
  semicolon_comments,
  negative_count,
  codes_after_motion,
  corner_arcs,                 ///< chamfers and roundings beside arcs, too
  contour_checked,             ///< radius compensation: the path stays off the blocks around it, or it is an alarm
  reading_stop,               ///< [8] M codes behind which nothing is read ahead
  calculator,
  calculator_words,
  start_linear,
  start_stroke_check,
  axis_factor,                 ///< scaling factor of an axis without a word for it, in thousandths
  rotation_angle,              ///< of a rotation without a word for it
  dwell_in_revolutions,        ///< where the feed is per revolution
  tool_macro,                  ///< [2] what the rule of the family makes a program of that a tool number calls
  polar_axis,                  ///< [2] linear, rotary: number of the axis
  cylinder_second_axis,        ///< the rotary axis stands for the other axis of the plane
  box_outside,                 ///< the area of the stroke check is where the axes may be
  corner_behind,               ///< way behind an inner corner that has its override, too
  corner_always,               ///< the override of inner corners acts outside of its mode as well
  corner_feed,                 ///< feed of inner corners in place of an override; 0 = the override
  inner_arc_least,             ///< least factor, in percent, of the feed of an arc that the tool cuts from the inside; 0 = the feed of the tool's centre is F
  shift_axis, shift_direction, ///< of cycles beside the hole: 0 the first, 1 the second axis of the plane; 0 plus, 1 minus
  start_scaling, start_rotation,
  stays_behind_reset,          ///< a reset leaves the program where it was stopped, with its modes
  stitch_length,               ///< [7] ends of the ranges of lengths
  stitch_feed, stitch_feed_2,  ///< [8] feed of each range, of the first and of the second axis of the plane
  stitch_wait, stitch_wait_2,  ///< [8] time behind a move of each range, the same
  stitch_signals,              ///< each stitch is asked of the head and waited for
  stitch_call, stitch_call_2,  ///< [8] time from the end of a move of each range to the signal that asks for the stitch, the same
  stitch_release, stitch_next, ///< time from the end of the stitch to the end of that signal; from the signal for the next place to its move
  stitch_longest,              ///< longest stitch, 0 = any
  count_
};

/// The parameter has one value for all part systems. Such parameters divide the common variables among the part systems (M700 13.4), or
/// concern programs and variables that the part systems share (13.3, 13.4).
constexpr bool is_common(Parameter parameter) {
  return parameter == Parameter::last_shared_of_first || parameter == Parameter::last_shared_of_second || parameter == Parameter::edit_lock_b ||
         parameter == Parameter::edit_lock_c || parameter == Parameter::power_off_clears_common;
}

/// The parameter is a length or a speed of linear axes, which is set in mm or in inch (Parameter::initial_inch).
bool is_length(Parameter parameter);

inline constexpr unsigned kParameters = static_cast<unsigned>(Parameter::count_);

/// One parameter: its meaning and, if several have this meaning, which of them it is.
struct ParameterOf {
  // A meaning without an index stands for the first parameter of this meaning.
  constexpr ParameterOf(Parameter meaning, unsigned which = 0) : what(meaning), index(which) {}  // NOLINT(google-explicit-constructor)
  Parameter what;
  unsigned index;
};

}  // namespace nc
