// SPDX-License-Identifier: Apache-2.0
// The handlers of functions: one for each one-shot Function of dialect/function.hpp. To add a function, add a Function, a row in the dialect's table, a
// handler here and its line in one_shot.cpp.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// The one-shot function of the block (in.words.one_shot). done, fault, or later.
Execution execute_one_shot(BlockContext& in);

Execution do_dwell(BlockContext& in);              // dwell.cpp
Execution do_data_input(BlockContext& in);         // data_input.cpp
Execution do_mirror(BlockContext& in);             // mirror.cpp
Execution do_scaling(BlockContext& in);            // scaling.cpp: G51
Execution do_rotation(BlockContext& in);           // scaling.cpp: G68
/// A map about the zero point comes into force: what has been programmed before stays the programmed position. Then words that remain are a move.
Execution begin_map_about_zero(BlockContext& in, Role word, bool (*set)(BlockContext& in, ProgramMaps* maps));
void end_scaling(InForce& in);          ///< G50
void end_rotation(InForce& in);         ///< G69
/// The zero point has moved, or another one is in force: the centre of rotation keeps its machine coordinates (M700 13.20 (5), (6)).
void keep_rotation_center(InForce& in, const AxisVec& zero_before);
Execution do_work_rotation(BlockContext& in);      // work_rotation.cpp: G10 I J K
Execution begin_parameter_input(BlockInHand& in); // parameter_input.cpp: G10 L70
Execution parameter_block(BlockInHand& in);       // parameter_input.cpp: the words of a block between G10 L70 and G11
Execution begin_tool_life_input(BlockContext& in); // tool_life.cpp: G10 L3
Execution tool_life_block(BlockContext& in);       // tool_life.cpp: the words of a block between G10 L3 and G11
Execution select_managed_tool(BlockInHand& in, uint32_t* tool);  // tool_life.cpp: T; *tool receives the number that goes out
void take_managed_tool(BlockContext& in);          // tool_life.cpp: M06
void count_tool_use(InForce& in, bool cuts);  // tool_life.cpp: a move
Execution do_reference_return(BlockContext& in);   // reference.cpp
Execution do_second_reference(BlockContext& in);   // reference.cpp: G30
Execution do_start_return(BlockContext& in);       // reference.cpp: G29
Execution do_reference_check(BlockContext& in);    // reference.cpp: G27
Execution compare_reference(BlockInHand& in);     // reference.cpp: behind the move of G27
Execution do_tool_change_return(BlockContext& in); // tool_change.cpp: G30.1 to G30.6
Execution do_machine_move(BlockContext& in);       // reference.cpp
/// Makes a rapid to a fixed place in machine coordinates; rotary axes turn by less than 360 deg (M700 14.13). reference.cpp
void move_to_place(BlockContext& in, const AxisVec& place, uint32_t axes);
void cancel_length_of(InForce& in, uint32_t axes);
/// Positions as the counters show them (M700 14.13): interpret/position_shown.cpp.
AxisVec work_shown(const InForce& in, const AxisVec& work);
AxisVec machine_shown(const InForce& in, const AxisVec& machine);
Execution do_skip(BlockContext& in);               // skip.cpp
Execution skip_answered(BlockInHand& in);         // skip.cpp
/// Where the amounts end that a program may give an offset of a tool, in mm. `column`: nc_tool_column.
double end_of_offset(const InForce& in, unsigned column);       // data_input.cpp: mm, by the unit in force
double unit_of_parameter(const InForce& in, uint32_t number, int axis, double value);  // machine_data_variables.cpp
bool parameter_exists(const InForce& in, uint32_t number);     // machine_data_variables.cpp: whether it is the number of a parameter
double end_of_work_offset(const InForce& in, unsigned axis);    // the same, or deg
void store_skip_position(InForce& in, const AxisVec& machine, uint32_t axes, bool touched);   // skip.cpp
Execution do_measure_length(BlockContext& in);     // measure.cpp: G37
Execution measured(BlockInHand& in);              // measure.cpp: behind its moves
Execution do_stroke_check(BlockContext& in);       // stroke_check.cpp: G22
Execution set_current_limit(BlockContext& in);     // data_input.cpp: G10 L14
Execution do_local_system(BlockContext& in);       // coordinates.cpp
Execution do_coordinate_set(BlockContext& in);     // coordinates.cpp
Execution do_coordinate_preset(BlockContext& in);  // coordinates.cpp
Execution do_shift_off(BlockContext& in);          // coordinates.cpp

Execution do_shift_suspend(BlockContext& in);      // coordinates.cpp: G92.2
Execution do_shift_restore(BlockContext& in);      // coordinates.cpp: G92.3

Execution do_cylinder(BlockContext& in);           // milling.cpp
Execution do_polar_on(BlockContext& in);           // milling.cpp
Execution do_polar_off(BlockContext& in);          // milling.cpp
Execution do_hypothetical_axis(BlockContext& in);  // hypothetical.cpp
Execution do_unidirectional(BlockContext& in);     // unidirectional.cpp
/// The place from which these axes go to `target` in their last direction (unidirectional.cpp).
AxisVec before_creep(const InForce& in, const AxisVec& target, uint32_t axes);
Execution do_circle_cut(BlockContext& in);         // circle_cut.cpp: G12 G13
Execution do_position_offset(BlockContext& in);    // position_offset.cpp: G45 to G48
Execution do_hole_pattern(BlockContext& in);       // hole_pattern.cpp: G34 G35 G36 G37.1
bool makes_pattern(const BlockInHand& in);         ///< the block is one of these
bool calls_behind_place(BlockInHand& in);          ///< a modal call is to be made behind a place of the pattern that is not its last one
Execution go_on_in_pattern(BlockContext& in);      ///< behind that: the next place

Execution do_cavity(BlockContext& in);             // cavity.cpp: G34 G35 G36 of the Series 8
Execution continue_cavity(BlockContext& in);       // cavity.cpp
Execution do_sine_loop(BlockContext& in);          // sine_loop.cpp: G06 of the Series 8
Execution continue_sine_loop(BlockContext& in);    // sine_loop.cpp

Execution do_stitch(BlockContext& in);             // stitch.cpp: G63.1 G63.2 of the HX

Execution do_comp_vector(BlockContext& in);        // offset_vector.cpp: G38
Execution do_corner_arc(BlockContext& in);         // offset_vector.cpp: G39 beside a movement
Execution do_corner_turn(BlockContext& in);        // offset_vector.cpp: G39 that stands alone

/// Three-dimensional radius compensation (M700 12.5): space_compensation.cpp.
bool means_space(const BlockInHand& in);          ///< a code of radius compensation in the block in hand is one of it
Execution set_space_compensation(BlockInHand& in, Function function);
Execution change_space_number(BlockInHand& in);   ///< D without such a code
bool gives_space_vector(const BlockInHand& in);   ///< a block of the mode names another vector
Execution change_space_vector(BlockInHand& in);
void end_space_compensation(InForce& in);
/// The axes that a block commands come to the mirror image in force, with their components of the vector.
void mirror_space_vector(InForce& in, uint32_t commanded);
/// The vector in force as the axes have come to it: mirror image and the rotation by parameter lie behind the compensation and act on it, too (12.5 (7), (8));
/// scaling and rotation by program lie before it and do not ((5), (6)).
SpaceVector space_compensation_vector(const InForce& in);

/// Length along the axis of the tool (M700 12.3): tool_axis.cpp.
Execution set_length_along_tool(BlockInHand& in, double length);
/// 12.3 (3): the tool is turned by a head that is no axis of the part system.
bool turned_outside(const InForce& in);
/// There: asks for the angles of the tool, where the block needs them and they are not known.
Execution take_tool_angles(BlockInHand& in);
/// These axes have come to their reference positions by hand: that ends the compensation of a length that has to do with them (12.2 (4), 12.3).
void cancel_length_by_hand(InForce& in, uint32_t axes);
double amount_along_tool(InForce& in);        ///< of the number in force, with what the handle has added to it (compensation.cpp)

/// coordinates.cpp: the word is of a code that the block names, so it is not one of the motion or the cycle in force (M700 14.10 (12)).
void take_word_of_code(BlockInHand& in, Role word);
WordSlot second_function(const InForce& in);  ///< auxiliary.cpp: the second auxiliary function, kNoWord = the family has none

/// Lines by their angle and blocks without an end (M700 13.8, 13.9): meeting.cpp.
bool has_line_angle(const BlockInHand& in);       ///< the block is a line, and A or ,A in it is its angle
bool says_line_angle(const BlockInHand& in);      ///< ... or the block has to be the second of a pair, which says itself what does not fit
bool begins_or_ends_meeting(const BlockInHand& in);
Execution execute_motion_of_words(BlockContext& in);  ///< execute_block.cpp: the one-shot function, the cycle or the motion of the block
Execution move_to_meet(BlockContext& in);          ///< such a block
Execution take_line_angle(BlockInHand& in);       ///< of a line with one end coordinate: the other one

/// Motions with rules of their own.
Execution move_stitch(BlockContext& in, const AxisVec& target, uint32_t commanded);             // stitch.cpp
Execution continue_stitch(BlockContext& in);
Execution move_thread(BlockContext& in, const AxisVec& target, uint32_t commanded);             // thread.cpp
Execution move_spiral(BlockContext& in, const AxisVec& target, uint32_t commanded, bool ccw);   // spiral.cpp
Execution move_exponential(BlockContext& in, const AxisVec& target, uint32_t commanded, bool negative);   // exponential.cpp
Execution move_space_arc(BlockContext& in, const AxisVec& target);                              // space_arc.cpp
Execution move_nurbs(BlockContext& in, const AxisVec& target);                                  // nurbs.cpp
/// Check what may be commanded while an arc in space is modal: a code; a whole block.
Execution check_in_space_arc(BlockInHand& in, const FunctionRow& row);
Execution check_space_arc_block(BlockInHand& in);
Execution check_nurbs_block(BlockInHand& in);
Execution do_high_speed(BlockContext& in);         // high_speed.cpp
Execution do_high_speed_accuracy(BlockContext& in);   // high_speed.cpp
Execution do_high_accuracy(BlockContext& in);      // high_accuracy.cpp
/// A code of the cutting mode while high-accuracy control is on, and G61.1 (high_accuracy.cpp).
Execution check_cutting_code(BlockInHand& in, const FunctionRow& row);
/// G01 between G05.1 Q2 and G05.1 Q0 (spline.cpp).
Execution move_spline(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style);
/// Checks what a block may hold in the modes of M700 13.17 (fine_mode.cpp).
Execution check_fine_block(BlockInHand& in);
bool allowed_in_fine_mode(FineMode mode, Function function);
bool means_spiral(const BlockInHand& in);                                                // spiral.cpp: a G02/G03 of type 2

/// Check the rules for a block, and for a move, while cylindrical or polar coordinate interpolation is on (milling.cpp).
Execution check_mill_block(BlockInHand& in);
Execution check_mill_move(BlockInHand& in, uint32_t commanded);

/// G15, G16 (polar_command.cpp): execute the code; turn radius and angle in the axis words of a block into coordinates.
Execution select_polar_command(BlockInHand& in, const FunctionRow& row);
void resolve_polar_words(BlockInHand& in);
void step_polar_hole(BlockInHand& in);   ///< the place of the next hole of the block

/// Modal functions that need more than that their code comes into force.
Execution select_work_system(BlockInHand& in, const FunctionRow& row);   // coordinates.cpp
Execution set_compensation(BlockInHand& in, Function function);          // compensation.cpp
Execution change_radius(BlockInHand& in);                                // compensation.cpp: a D word in the mode
Execution set_length(BlockContext& in, Function function);                // compensation.cpp
/// Turns a word into the number of an offset; Condition::no_offset_number when there is no such offset. radius_amount(): the radius of an offset, mm, 0 for
/// number 0. take_radius_number(): the D of the block holds until the next one; D0 is one, too (M700 12.4.1, 12.6).
Execution offset_number(BlockInHand& in, Role word, uint32_t* number);   // compensation.cpp
Execution take_radius_number(BlockInHand& in);                           // compensation.cpp
double radius_amount(const InForce& in, uint32_t number);      // compensation.cpp
/// Series 8 G41, G81: compensation.cpp.
Execution go_beside_start(BlockContext& in);             ///< the line before the first move with compensation
bool gives_length_in_cycle(const BlockInHand& in);      ///< the D of the block is of the length of a tool that makes holes
Execution take_length_in_cycle(BlockInHand& in);
Execution change_length(BlockInHand& in);                                // compensation.cpp: an H without G43, G44, G49

/// Fixed cycles (cycle.cpp): do_cycle() takes the cycle code and the words of the block, continue_cycle() makes the holes.
Execution do_cycle(BlockContext& in);
Execution continue_cycle(BlockContext& in);
void cancel_cycle(BlockContext& in);
/// tap.cpp: the block in hand belongs to a tapping cycle; it goes with the angle of the spindle, whose speed and lead the cycle then has.
bool taps(const BlockInHand& in);
bool taps_with_spindle(const BlockInHand& in);
bool keeps_spindle_of_tap(const BlockInHand& in);  ///< the block makes no hole and leaves such a tap in force
Execution check_tap_speed(BlockInHand& in);  ///< the S of such a block

/// M S T B (auxiliary.cpp). before: everything that goes out before the motion.
Execution auxiliary_before(BlockContext& in);
/// An M code that acts behind the motion: stops, the end of the program, overrides. Any other does nothing here.
void auxiliary_behind(BlockContext& in, const Auxiliary& auxiliary);
/// The program goes on behind it when the operator says so.
constexpr bool stops_program(MiscFunction function) { return function == MiscFunction::program_stop || function == MiscFunction::optional_stop; }
/// Codes of the macro interface by number, of single overrides and of the tool in the spindle (machine_io.cpp); any other M code does nothing here.
Execution act_on_machine(BlockContext& in, const Auxiliary& code);
/// Bits of a word of the macro interface change where the machine gets there; `value` is for displays.
void give_out_bits(BlockContext& in, uint32_t word, uint32_t mask, uint32_t bits, double value);
bool takes_word_number(const BlockInHand& in);        ///< a code of the block has the word of an analog input or output
bool waits_for_input(const BlockInHand& in);          ///< the block waits for an input (LinuxCNC M66), and does nothing else
Execution wait_for_input(BlockInHand& in);
Execution continue_input_wait(BlockContext& in);
/// The program goes on when what has been given out is complete.
void await_fin(BlockContext& in);
/// An M code of the spindle that a cycle makes; the program goes on when it is complete. The modal M of the program stays.
void give_out_spindle(BlockContext& in, MiscFunction function, uint32_t code);
/// Constant surface speed and clamp speeds (spindle.cpp).
void announce_surface(BlockContext& in);                ///< tells the scan which of G96 and G97 is in force
Execution set_surface_speed(BlockContext& in);               ///< G96 G97 of the block
void hold_surface(BlockContext& in, bool held);              ///< M59, M58 of the Series 8
Execution set_surface_radius(BlockContext& in);              ///< G92 R of the Series 8
Execution surface_word(BlockContext& in);                    ///< S while G96 is in force
/// A word that no code of the block takes is an alarm (unused_words.cpp).
Execution check_unused_words(BlockInHand& in);
bool limits_surface_speed(const BlockInHand& in);     ///< a word of this block is the highest speed of G96 (LinuxCNC)
bool is_clamp_command(const BlockInHand& in);         ///< the S of this block belongs to a G92
Execution set_spindle_clamp(BlockContext& in);               ///< G92 S Q
void end_spindle_control(BlockContext& in);            ///< M02, M30
/// M S T B of this block go out behind its motion.
bool codes_behind_motion(const BlockInHand& in);

/// Checks which functions may stand in one block (DGSHAPE 2, M700 App.2).
Execution check_precedence(BlockInHand& in);

}  // namespace nc
