// SPDX-License-Identifier: Apache-2.0
// What the functions do: one handler for each one-shot Function of dialect/function.hpp. To add a function: a Function, a row in the dialect's
// table, a handler here and its line in one_shot.cpp.
#pragma once

#include "interpret/interpreter.hpp"

namespace nc {

/// The one-shot function of the block (in.words.one_shot). done, fault, or later.
Execution execute_one_shot(Interpreter& in);

Execution do_dwell(Interpreter& in);              // dwell.cpp
Execution do_data_input(Interpreter& in);         // data_input.cpp
Execution do_mirror(Interpreter& in);             // mirror.cpp
Execution do_scaling(Interpreter& in);            // scaling.cpp: G51
Execution do_rotation(Interpreter& in);           // scaling.cpp: G68
void end_scaling(Interpreter& in);          ///< G50
void end_rotation(Interpreter& in);         ///< G69
/// The zero has moved, or another one is in force: the centre of rotation stays on the machine (M700 13.20 (5), (6)).
void keep_rotation_center(Interpreter& in, const AxisVec& zero_before);
Execution do_work_rotation(Interpreter& in);      // work_rotation.cpp: G10 I J K
Execution begin_parameter_input(Interpreter& in); // parameter_input.cpp: G10 L70
Execution do_reference_return(Interpreter& in);   // reference.cpp
Execution do_second_reference(Interpreter& in);   // reference.cpp: G30
Execution do_start_return(Interpreter& in);       // reference.cpp: G29
Execution do_reference_check(Interpreter& in);    // reference.cpp: G27
Execution compare_reference(Interpreter& in);     // reference.cpp: behind the move of G27
Execution do_tool_change_return(Interpreter& in); // tool_change.cpp: G30.1 to G30.6
Execution do_machine_move(Interpreter& in);       // reference.cpp
/// Rapid to a fixed place in machine coordinates; rotary axes turn by less than 360 deg (M700 14.13). reference.cpp
void move_to_place(Interpreter& in, const AxisVec& place, uint32_t axes);
void cancel_length_of(Interpreter& in, uint32_t axes);
/// Positions as the counters show them (M700 14.13): interpret/position_shown.cpp.
AxisVec work_shown(const Interpreter& in, const AxisVec& work);
AxisVec machine_shown(const Interpreter& in, const AxisVec& machine);
Execution do_skip(Interpreter& in);               // skip.cpp
Execution skip_answered(Interpreter& in);         // skip.cpp
Execution do_measure_length(Interpreter& in);     // measure.cpp: G37
Execution measured(Interpreter& in);              // measure.cpp: behind its moves
Execution do_stroke_check(Interpreter& in);       // stroke_check.cpp: G22
Execution set_current_limit(Interpreter& in);     // data_input.cpp: G10 L14
Execution do_local_system(Interpreter& in);       // coordinates.cpp
Execution do_coordinate_set(Interpreter& in);     // coordinates.cpp
Execution do_coordinate_preset(Interpreter& in);  // coordinates.cpp

Execution do_cylinder(Interpreter& in);           // milling.cpp
Execution do_polar_on(Interpreter& in);           // milling.cpp
Execution do_polar_off(Interpreter& in);          // milling.cpp
Execution do_hypothetical_axis(Interpreter& in);  // hypothetical.cpp
Execution do_unidirectional(Interpreter& in);     // unidirectional.cpp
Execution do_circle_cut(Interpreter& in);         // circle_cut.cpp: G12 G13

/// Motions with rules of their own.
Execution move_thread(Interpreter& in, const AxisVec& target, uint32_t commanded);             // thread.cpp
Execution move_spiral(Interpreter& in, const AxisVec& target, uint32_t commanded, bool ccw);   // spiral.cpp
Execution move_exponential(Interpreter& in, const AxisVec& target, uint32_t commanded, bool negative);   // exponential.cpp
Execution move_space_arc(Interpreter& in, const AxisVec& target);                              // space_arc.cpp
Execution move_nurbs(Interpreter& in, const AxisVec& target);                                  // nurbs.cpp
/// What may stand beside an arc in space: a code while it is modal; a whole block.
Execution check_in_space_arc(Interpreter& in, const FunctionRow& row);
Execution check_space_arc_block(Interpreter& in);
Execution check_nurbs_block(Interpreter& in);
Execution do_high_speed(Interpreter& in);         // high_speed.cpp
Execution do_high_speed_accuracy(Interpreter& in);   // high_speed.cpp
Execution do_high_accuracy(Interpreter& in);      // high_accuracy.cpp
/// A code of the cutting mode while high-accuracy control is on, and G61.1 (high_accuracy.cpp).
Execution check_cutting_code(Interpreter& in, const FunctionRow& row);
/// G01 between G05.1 Q2 and G05.1 Q0 (spline.cpp).
Execution move_spline(Interpreter& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style);
/// What a block may hold in the modes of M700 13.17 (fine_mode.cpp).
Execution check_fine_block(Interpreter& in);
bool allowed_in_fine_mode(FineMode mode, Function function);
bool means_spiral(const Interpreter& in);                                                // spiral.cpp: a G02/G03 of type 2

/// Rules of a block, and of a move, while cylindrical or polar coordinate interpolation is on (milling.cpp).
Execution check_mill_block(Interpreter& in);
Execution check_mill_move(Interpreter& in, uint32_t commanded);

/// G15, G16 (polar_command.cpp): the code; the axis words of a block as radius and angle.
Execution select_polar_command(Interpreter& in, const FunctionRow& row);
void resolve_polar_words(Interpreter& in);

/// Modal functions with more to them than their code.
Execution select_work_system(Interpreter& in, const FunctionRow& row);   // coordinates.cpp
Execution set_compensation(Interpreter& in, Function function);          // compensation.cpp
Execution change_radius(Interpreter& in);                                // compensation.cpp: a D word in the mode
Execution set_length(Interpreter& in, Function function);                // compensation.cpp
/// The number of an offset that a word gives, no_offset_number where there is none of this number; the amount of a radius by it, 0 for number 0.
Execution offset_number(Interpreter& in, Role word, uint32_t* number);   // compensation.cpp
double radius_amount(const Interpreter& in, uint32_t number);      // compensation.cpp
Execution change_length(Interpreter& in);                                // compensation.cpp: an H without G43, G44, G49

/// Fixed cycles (cycle.cpp): the block's cycle code and words; the holes go on in continue_cycle.
Execution do_cycle(Interpreter& in);
Execution continue_cycle(Interpreter& in);
void cancel_cycle(Interpreter& in);

/// M S T B (auxiliary.cpp). before: everything that goes out before the motion; after: stops, ends, calls.
Execution auxiliary_before(Interpreter& in);
Execution auxiliary_after(Interpreter& in);
/// The program goes on when what has been given out is complete.
void await_fin(Interpreter& in);
/// Constant surface speed and clamp speeds (spindle.cpp).
void announce_surface(Interpreter& in);                ///< to the scan: what of G96, G97 is in force
Execution set_surface_speed(Interpreter& in);               ///< G96 G97 of the block
Execution surface_word(Interpreter& in);                    ///< S while G96 is in force
bool is_clamp_command(const Interpreter& in);         ///< the S of this block is one of G92
Execution set_spindle_clamp(Interpreter& in);               ///< G92 S Q
void end_spindle_control(Interpreter& in);            ///< M02, M30
/// M S T B of this block go out behind its motion.
bool codes_behind_motion(const Interpreter& in);

/// Rules about what may share a block (DGSHAPE 2, M700 App.2).
Execution check_precedence(Interpreter& in);

}  // namespace nc
