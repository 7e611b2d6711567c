// SPDX-License-Identifier: Apache-2.0
// What G and M codes mean, apart from their numbers. A family's table binds its codes to these names (dialect.hpp), and everything outside
// dialect/ knows only these names. A function that is not built yet has a name here too; its row says that it is not built.
#pragma once

#include <cstdint>

namespace nc {

/// What a G code means. Where a name alone does not say it, the code of the M700 stands beside it.
enum class Function : uint8_t {
  rapid, linear, arc_cw, arc_ccw,   ///< these four are the ones of plain_motion()
  spiral_cw, spiral_ccw,                ///< G02.1 G03.1
  exponential_positive, exponential_negative,   ///< G02.3 G03.3: named after the sense in which the rotary axis turns
  space_arc_first, space_arc_second,    ///< G02.4 G03.4: two codes for the same curve
  nurbs, thread,                        ///< G06.2 G33
  cylinder, polar_on, polar_off,        ///< G07.1 G12.1 G13.1
  polar_command_on, polar_command_off,  ///< G16 G15
  hypothetical_axis,                    ///< G07
  unidirectional,                       ///< G60
  high_speed,                           ///< G05
  high_speed_accuracy,                  ///< G05.1
  high_accuracy,                        ///< G08
  high_accuracy_mode,                   ///< G61.1
  dwell, data_input,                    ///< G04 G10
  data_input_end, parameter_input_end,  ///< G11 G11.1
  exact_stop_once,                      ///< G09
  circle_cut_cw, circle_cut_ccw,        ///< G12 G13
  plane_xy, plane_zx, plane_yz,
  inch, metric,
  reference_check, reference_return, start_return, second_reference, tool_change_return,  ///< G27 G28 G29 G30 G30.1-G30.6
  skip, multi_skip, measure_length,     ///< G31 G31.1-G31.3 G37
  machine_move,                         ///< G53
  holes_on_circle, holes_on_line, holes_on_arc, holes_on_grid,   ///< G34 G35 G36 G37.1
  stroke_check_on, stroke_check_off,    ///< G22 G23: modal; G22 takes the axis words of its block
  comp_off, comp_left, comp_right,      ///< G40 G41 G42
  comp_vector, comp_corner_arc,         ///< G38 G39
  comp_corner_turn,                     ///< G39 that stands alone in its block: its words lead on from the corner (DGSHAPE)
  normal_line_off, normal_line_left, normal_line_right,          ///< G40.1 G41.1 G42.1
  length_plus, length_minus, length_off,                         ///< G43 G44 G49
  length_along_tool, tool_tip_1, tool_tip_2,                     ///< G43.1 G43.4 G43.5
  offset_longer, offset_shorter, offset_twice_longer, offset_twice_shorter,   ///< G45 to G48
  work_system,                          ///< G54 to G59: number 0 to 5
  extended_system,                      ///< G54.1 P
  local_system,                         ///< G52
  coordinate_set,                       ///< G92
  coordinate_preset,                    ///< G92.1
  cycle_off, cycle_drill, cycle_spot, cycle_peck, cycle_step,    ///< G80 G81 G82 G83 G73
  cycle_bore_feed, cycle_bore_dwell,    ///< G85 G89
  cycle_tap, cycle_reverse_tap,         ///< G84 G74
  cycle_circle, cycle_fine_bore, cycle_bore_stop, cycle_back_bore, cycle_bore_stop_dwell,   ///< G75 G76 G86 G87 G88
  user_cycle,                           ///< G70 to G72: not counted among the fixed cycles (M700 7.5)
  user_fixed_cycle,                     ///< G77 to G79: counted among them
  absolute, incremental,
  feed_per_minute, feed_per_revolution, inverse_time_feed,       ///< G94 G95 G93
  return_initial, return_r,
  exact_stop_mode, corner_override, tapping_mode, cutting_mode,  ///< G61 G62 G63 G64
  synchronous_tapping, synchronous_tapping_reverse,              ///< G63.1 G63.2
  macro_call, macro_modal, macro_every_block,   ///< G65 G66 G66.1: the words behind the code are arguments
  macro_modal_off,                      ///< G67
  user_macro,                           ///< G100 to G255: calls the macro that a parameter registers for the code
  surface_on, surface_off,              ///< G96 G97
  mirror_on, mirror_off,                ///< G51.1 G50.1: modal; both take the axis words of their block
  scaling_on, scaling_off, rotation_on, rotation_off,   ///< G51 G50 G68 G69
  // Beside the names that follow stand the codes of RS-274/NGC and LinuxCNC.
  probe, probe_try, probe_away, probe_away_try,   ///< G38.2 to G38.5: as `skip`, but motions that stay in force; the first and third are alarms without a signal, the last two wait until it is off
  centre_incremental, centre_absolute,  ///< G91.1 G90.1: how the centres of arcs are given
  shift_off, shift_suspend, shift_restore,   ///< G92.1 G92.2 G92.3: act on the shift that coordinate_set has set
  reference_set,                        ///< G28.1 G30.1
  rigid_tap, thread_cycle,              ///< G33.1 G76
  comp_dynamic, length_of_block, length_added,   ///< G41.1 G42.1, G43.1, G43.2
  spline_cubic, spline_quadratic, nurbs_block, nurbs_block_end,   ///< G5 G5.1 G5.2 G5.3
  diameter_words, radius_words,         ///< G7 G8
  // Numbers of the codes of the HX stand beside those that follow.
  high_speed_on, high_speed_off,        ///< G10.3 G11.3
  stitch_on, stitch_off,                ///< G63.1 G63.2
  cycle_rigid_tap, cycle_rigid_reverse_tap,   ///< G84.2 G84.3
  // Numbers of the codes of the Series 8 stand beside those that follow.
  probe_once,                           ///< G51: as `skip`, but it is an alarm if there is no contact
  corner_behind,                        ///< G10: a chamfer or a rounding between the line of its block and the next one
  absolute_once, incremental_once,      ///< G67 G68: as absolute and incremental, for their block only
  comp_entry,                           ///< G43: the first move with compensation leads straight beside its end
  cavity_ccw, cavity_cw, cavity_circle, ///< G34 G35 G36
  holes_on_frame_ccw, holes_on_frame_cw,   ///< G49 G50
  sine_loop,                            ///< G06
  cycle_bore_restart, cycle_case_bore, cycle_bore_oriented, cycle_face_upwards,   ///< G86 G87 G88 G89
  count_
};
inline constexpr unsigned kFunctions = static_cast<unsigned>(Function::count_);

/// One of G27 to G30.
constexpr bool is_reference_move(Function f) {
  return f == Function::reference_check || f == Function::reference_return || f == Function::start_return || f == Function::second_reference;
}
/// A straight line at feed that a signal ends, as a mode: the axis words of the blocks behind go on with it.
constexpr bool is_probing(Function f) { return f == Function::probe || f == Function::probe_try || f == Function::probe_away || f == Function::probe_away_try; }
/// A straight line at feed that a signal ends.
constexpr bool is_skip(Function f) { return f == Function::skip || f == Function::multi_skip || f == Function::probe_once || is_probing(f); }
/// Tool position offset (M700 12.6): it makes the motion of its block longer or shorter by an offset.
constexpr bool offsets_position(Function f) {
  return f == Function::offset_longer || f == Function::offset_shorter || f == Function::offset_twice_longer || f == Function::offset_twice_shorter;
}
/// One-shot functions whose axis words are positions to go to. The axis words of all other one-shot functions are data.
constexpr bool goes_to_position(Function f) {
  return is_reference_move(f) || f == Function::sine_loop || f == Function::tool_change_return || is_skip(f) ||
         f == Function::measure_length || f == Function::machine_move || f == Function::unidirectional || offsets_position(f);
}
constexpr bool is_macro_call(Function f) { return f == Function::macro_call || f == Function::macro_modal || f == Function::macro_every_block; }
constexpr bool is_plane(Function f) { return f == Function::plane_xy || f == Function::plane_zx || f == Function::plane_yz; }
/// A circle or helix in the plane.
constexpr bool is_arc(Function f) { return f == Function::arc_cw || f == Function::arc_ccw; }
constexpr bool is_spiral(Function f) { return f == Function::spiral_cw || f == Function::spiral_ccw; }
constexpr bool is_space_arc(Function f) { return f == Function::space_arc_first || f == Function::space_arc_second; }
constexpr bool is_exponential(Function f) { return f == Function::exponential_positive || f == Function::exponential_negative; }
/// A full circle that begins and ends at its centre. Its block names no axis.
constexpr bool cuts_circle(Function f) { return f == Function::circle_cut_cw || f == Function::circle_cut_ccw; }
/// Holes, or places, in a pattern.
constexpr bool is_hole_pattern(Function f) {
  return (f >= Function::holes_on_circle && f <= Function::holes_on_grid) || f == Function::holes_on_frame_ccw || f == Function::holes_on_frame_cw;
}
/// A cavity is milled.
constexpr bool cuts_cavity(Function f) { return f == Function::cavity_ccw || f == Function::cavity_cw || f == Function::cavity_circle; }
/// A straight line that needs no other words than those of axes.
constexpr bool is_line(Function f) { return f == Function::rapid || f == Function::linear; }
/// Rapid traverse, line or arc: motions that have no words of their own, except those for the centre or the radius of an arc.
constexpr bool plain_motion(Function f) { return f <= Function::arc_ccw; }
static_assert(plain_motion(Function::rapid) && plain_motion(Function::linear) && plain_motion(Function::arc_cw) && plain_motion(Function::arc_ccw) &&
              !plain_motion(Function::spiral_cw));
/// The function ends the input of data or parameters.
constexpr bool ends_data_input(Function f) { return f == Function::data_input_end || f == Function::parameter_input_end; }

/// What an M code means to the control itself.
enum class MiscFunction : uint8_t {
  output,                                       ///< goes out and means nothing here
  spindle_forward, spindle_reverse, spindle_stop, tool_change, spindle_oriented,   ///< go out, too
  surface_hold, surface_resume,                 ///< constant surface speed keeps the speed that the spindle has; follows the axis again
  interrupt_on, interrupt_off,                  ///< as long as no parameter gives another code this meaning; then they are output
  program_stop, optional_stop, program_end,     ///< kept by the control, as the rest
  call_sub, return_sub, call_external,
  override_allowed, override_barred,            ///< allow or bar both overrides of the operator
  override_of_one,                              ///< number 0 feed, 1 spindle, 2 adaptive feed, 3 feed hold: its word allows or bars it
  tool_number,                                  ///< says which tool is in the spindle
  machine_output, machine_value,                ///< number 0 an output off, 1 on; a word of outputs gets a value
  machine_input,                                ///< waits for an input
  modal_state
};
/// The M code is put out to the machine.
constexpr bool goes_out(MiscFunction f) { return f <= MiscFunction::interrupt_off; }
/// Execution goes on in another program.
constexpr bool calls_program(MiscFunction f) { return f == MiscFunction::call_sub || f == MiscFunction::call_external; }
/// ... or in the program that has called this one, or it ends.
constexpr bool leads_elsewhere(MiscFunction f) { return calls_program(f) || f == MiscFunction::return_sub || f == MiscFunction::program_end; }

}  // namespace nc
