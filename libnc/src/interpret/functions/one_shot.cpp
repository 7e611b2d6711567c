// SPDX-License-Identifier: Apache-2.0
// The table of one-shot functions.
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"

namespace nc {
namespace {

struct Handler {
  Function function;
  Execution (*run)(BlockContext& in);
};

/// G11 outside of parameter input does nothing: 12.7 (3) lets it also end G10 L2 to L20, but these act only in their own block.
Execution end_without_input(BlockContext&) { return Execution::done; }

constexpr Handler kHandlers[] = {
    {Function::dwell, do_dwell},
    {Function::data_input, do_data_input},
    {Function::data_input_end, end_without_input},
    {Function::parameter_input_end, end_without_input},
    {Function::mirror_on, do_mirror},
    {Function::mirror_off, do_mirror},
    {Function::scaling_on, do_scaling},
    {Function::rotation_on, do_rotation},
    {Function::reference_return, do_reference_return},
    {Function::second_reference, do_second_reference},
    {Function::start_return, do_start_return},
    {Function::reference_check, do_reference_check},
    {Function::tool_change_return, do_tool_change_return},
    {Function::machine_move, do_machine_move},
    {Function::skip, do_skip},
    {Function::multi_skip, do_skip},
    {Function::probe_once, do_skip},
    {Function::probe, do_skip},
    {Function::probe_try, do_skip},
    {Function::probe_away, do_skip},
    {Function::probe_away_try, do_skip},
    {Function::measure_length, do_measure_length},
    {Function::stroke_check_on, do_stroke_check},
    {Function::local_system, do_local_system},
    {Function::coordinate_set, do_coordinate_set},
    {Function::coordinate_preset, do_coordinate_preset},
    {Function::shift_off, do_shift_off},
    {Function::shift_suspend, do_shift_suspend},
    {Function::shift_restore, do_shift_restore},
    {Function::cylinder, do_cylinder},
    {Function::polar_on, do_polar_on},
    {Function::polar_off, do_polar_off},
    {Function::hypothetical_axis, do_hypothetical_axis},
    {Function::unidirectional, do_unidirectional},
    {Function::circle_cut_cw, do_circle_cut},
    {Function::circle_cut_ccw, do_circle_cut},
    {Function::offset_longer, do_position_offset},
    {Function::offset_shorter, do_position_offset},
    {Function::offset_twice_longer, do_position_offset},
    {Function::offset_twice_shorter, do_position_offset},
    {Function::holes_on_circle, do_hole_pattern},
    {Function::holes_on_line, do_hole_pattern},
    {Function::holes_on_arc, do_hole_pattern},
    {Function::holes_on_grid, do_hole_pattern},
    {Function::holes_on_frame_ccw, do_hole_pattern},
    {Function::holes_on_frame_cw, do_hole_pattern},
    {Function::cavity_ccw, do_cavity},
    {Function::cavity_cw, do_cavity},
    {Function::cavity_circle, do_cavity},
    {Function::sine_loop, do_sine_loop},
    {Function::stitch_on, do_stitch},
    {Function::stitch_off, do_stitch},
    {Function::comp_vector, do_comp_vector},
    {Function::comp_corner_arc, do_corner_arc},
    {Function::comp_corner_turn, do_corner_turn},
    {Function::high_speed, do_high_speed},
    {Function::high_speed_accuracy, do_high_speed_accuracy},
    {Function::high_accuracy, do_high_accuracy},
};

}  // namespace

namespace {

/// M700 13.3.3 (9): the block commands machine coordinates on axes of the plane inside a rotated figure, which is not allowed.
bool machine_in_figure(const BlockInHand& in) {
  if (!in.state.mapped || in.state.frame[in.state.depth].figure == 0) return false;
  switch (in.words.one_shot->function) {
    case Function::reference_check:
    case Function::reference_return:
    case Function::start_return:
    case Function::second_reference:
    case Function::machine_move:
    case Function::unidirectional: break;
    default: return false;
  }
  const PlaneAxes plane = plane_axes(in);
  uint32_t axes = 0;
  if (plane.h >= 0) axes |= 1u << plane.h;
  if (plane.v >= 0) axes |= 1u << plane.v;
  return (in.words.target.axes() & axes) != 0;
}

}  // namespace

Execution execute_one_shot(BlockContext& in) {
  // M700 6.1, 6.2, 13.1.1: only G00, G01 and fixed cycles have an in-position width.
  if (in.words.in_position > 0) return in.raise(Condition::illegal_address, Role::vector_x, in.words.in_position);
  if (in.words.in_position_drill > 0) return in.raise(Condition::illegal_address, Role::vector_y, in.words.in_position_drill);
  if (in.state.modal.is(Function::length_along_tool) && (is_reference_move(in.words.one_shot->function) || in.words.one_shot->function == Function::tool_change_return))
    return in.raise_code(Condition::tool_axis_code, *in.words.one_shot);  // M700 12.3
  if (machine_in_figure(in)) return in.raise_code(Condition::machine_in_figure, *in.words.one_shot);
  for (const Handler& handler : kHandlers)
    if (handler.function == in.words.one_shot->function) return handler.run(in);
  return in.raise_code(Condition::internal, *in.words.one_shot);
}

}  // namespace nc
