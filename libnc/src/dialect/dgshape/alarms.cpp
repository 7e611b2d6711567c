// SPDX-License-Identifier: Apache-2.0
// DGSHAPE prints no error numbers; it only says that something "results in an error". The codes and texts are
// ours: NC- and a word that says what is wrong. One code may stand for several conditions, the sentence for
// the operator tells them apart.
#include "dialect/dgshape/tables.hpp"

namespace nc::dgshape {

using C = Condition;

const AlarmText kAlarms[] = {
    {"NC-ADDRESS", "Unknown or misplaced word"},
    {"NC-FORMAT", "Block is not written correctly"},
    {"NC-RANGE", "Value out of range"},
    {"NC-CHARACTER", "Illegal character"},
    {"NC-LENGTH", "Block is too long"},
    {"NC-NUMBER", "O or N number is zero"},
    {"NC-END", "Program without M02 or M30"},
    {"NC-START", "No % before the program"},
    {"NC-AXIS", "Axis not possible here"},
    {"NC-NO-SUCH-CODE", "Code does not exist"},
    {"NC-NOT-BUILT", "Function is not available"},
    {"NC-ALONE", "Code must stand alone in its block"},
    {"NC-WORDS", "Words are missing"},
    {"NC-FEED", "No feed rate"},
    {"NC-ARC", "Arc cannot be made"},
    {"NC-PLANE", "Plane not possible here"},
    {"NC-OFFSET-DATA", "Offset number missing or too large"},
    {"NC-OFFSET-START", "Offset starts or ends with an arc"},
    {"NC-OFFSET-CODE", "Code not possible with tool-diameter offset"},
    {"NC-OFFSET-PATH", "No path with this tool-diameter offset"},
    {"NC-REFERENCE", "Axis has no reference"},
    {"NC-LIMIT", "Beyond the operating range"},
    {"NC-SPINDLE", "Spindle is not turning"},
    {"NC-INCREMENTAL", "Code not possible with G91"},
    {"NC-TOOL", "M06 and T must stand together"},
    {"NC-DATA", "G10 data number is not correct"},
    {"NC-MACRO", "No variables or sub programs"},
    {"NC-READ", "Program cannot be read"},
    {"NC-VENDOR", "Function of the machine failed"},
    {"NC-INTERNAL", "Internal error of the control"},
};

const AlarmRow kConditions[kConditionRows] = {
    // words and blocks
    {C::illegal_address, "NC-ADDRESS", nullptr},
    {C::exponent, "NC-ADDRESS", nullptr},         // does not occur: E is no address
    {C::format_error, "NC-FORMAT", nullptr},
    {C::behind_semicolon, "NC-FORMAT", nullptr},  // does not occur: ';' is no character
    {C::value_range, "NC-RANGE", nullptr},
    {C::illegal_character, "NC-CHARACTER", nullptr},
    {C::block_too_long, "NC-LENGTH", nullptr},
    {C::number_zero, "NC-NUMBER", nullptr},
    {C::program_end, "NC-END", nullptr},
    {C::no_start_mark, "NC-START", nullptr},
    {C::illegal_axis, "NC-AXIS", nullptr},
    {C::too_many_axes, "NC-AXIS", nullptr},
    {C::index_increment, "NC-RANGE", nullptr},  // does not occur: no indexing axes
    {C::parity, "NC-CHARACTER", nullptr},       // a tape that the host gives all the same
    {C::parity_vertical, "NC-CHARACTER", nullptr},
    // G and M codes
    {C::illegal_g, "NC-NO-SUCH-CODE", nullptr},
    {C::no_function, "NC-NOT-BUILT", nullptr},
    {C::must_stand_alone, "NC-ALONE", nullptr},
    {C::words_missing, "NC-WORDS", nullptr},
    {C::center_missing, "NC-WORDS", nullptr},
    // motion
    {C::no_feed, "NC-FEED", nullptr},
    {C::arc_deviation, "NC-ARC", nullptr},
    {C::arc_center, "NC-ARC", nullptr},
    {C::helix_option, "NC-ARC", nullptr},  // does not occur: helices are standard
    {C::plane_mismatch, "NC-PLANE", nullptr},
    {C::plane_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::plane_in_rotation, "NC-NOT-BUILT", nullptr},  // these two do not occur: there is no G68
    {C::space_conversion, "NC-NOT-BUILT", nullptr},
    {C::arc_in_compensation_start, "NC-OFFSET-START", nullptr},
    {C::no_offset_number, "NC-OFFSET-DATA", nullptr},
    {C::cycle_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::skip_in_compensation, "NC-OFFSET-CODE", nullptr},  // does not occur: no skip
    {C::skip_feed_zero, "NC-FEED", nullptr},               // does not occur: no skip
    {C::no_reference, "NC-REFERENCE", nullptr},
    {C::soft_limit, "NC-LIMIT", nullptr},
    {C::spindle_not_turning, "NC-SPINDLE", nullptr},
    {C::cycle_wrong_plane, "NC-PLANE", nullptr},
    {C::not_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::code_in_incremental, "NC-INCREMENTAL", nullptr},
    {C::tool_pair, "NC-TOOL", nullptr},
    {C::comp_no_intersection, "NC-OFFSET-PATH", nullptr},
    {C::comp_interference, "NC-OFFSET-PATH", nullptr},
    // ",C" ",R" are no words of the family
    {C::corner_option, "NC-ADDRESS", nullptr},
    {C::corner_arc, "NC-ADDRESS", nullptr},
    {C::corner_no_move, "NC-ADDRESS", nullptr},
    {C::corner_short, "NC-ADDRESS", nullptr},
    {C::corner_reversal, "NC-ADDRESS", nullptr},
    {C::corner_next_short, "NC-ADDRESS", nullptr},
    {C::corner_motion, "NC-ADDRESS", nullptr},
    {C::pre_read, "NC-ADDRESS", nullptr},
    {C::geometric_option, "NC-ADDRESS", nullptr},    // nor is ",A"
    {C::second_aux, "NC-ADDRESS", nullptr},          // nor B and C
    {C::space_compensation, "NC-ADDRESS", nullptr},  // G41/G42 take no I J K
    // do not occur: curves and modes that the family does not have
    {C::thread_lead, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_code, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_axis, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_modal, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_state, "NC-NO-SUCH-CODE", nullptr},
    {C::space_arc_blocks, "NC-NO-SUCH-CODE", nullptr},
    {C::space_arc_mode, "NC-NO-SUCH-CODE", nullptr},
    {C::exponential_mode, "NC-NO-SUCH-CODE", nullptr},
    {C::exponential_axes, "NC-NO-SUCH-CODE", nullptr},
    {C::nurbs_knot, "NC-NO-SUCH-CODE", nullptr},
    {C::nurbs_start, "NC-NO-SUCH-CODE", nullptr},
    {C::displaced, "NC-ARC", nullptr},  // does not occur: no curves over several blocks
    {C::space_conversion_code, "NC-NO-SUCH-CODE", nullptr},
    {C::inverse_time_code, "NC-NO-SUCH-CODE", nullptr},
    {C::circle_radius, "NC-NO-SUCH-CODE", nullptr},
    {C::arc_feed_zero, "NC-NO-SUCH-CODE", nullptr},
    {C::reference_compare, "NC-REFERENCE", nullptr},
    {C::reference_check_m, "NC-NO-SUCH-CODE", nullptr},
    {C::start_return_m, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_axis, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_h, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_no_length, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_signal, "NC-NO-SUCH-CODE", nullptr},
    {C::stroke_check, "NC-LIMIT", nullptr},
    {C::not_accepted, "NC-NO-SUCH-CODE", nullptr},
    {C::in_high_accuracy, "NC-NO-SUCH-CODE", nullptr},
    {C::high_speed_3, "NC-NOT-BUILT", nullptr},
    // offsets
    {C::g10_l, "NC-DATA", nullptr},
    {C::g10_p, "NC-DATA", nullptr},
    {C::local_in_extended, "NC-NOT-BUILT", nullptr},  // does not occur: neither G52 nor G54.1
    // programs and macros: the family has neither, so what looks like one is a macro that does not exist
    {C::program_missing, "NC-MACRO", nullptr},
    {C::sequence_missing, "NC-MACRO", nullptr},
    {C::nesting, "NC-MACRO", nullptr},
    {C::macro_nesting, "NC-MACRO", nullptr},
    {C::no_macro, "NC-MACRO", nullptr},
    {C::macro_and_words, "NC-MACRO", nullptr},
    {C::macro_argument, "NC-MACRO", nullptr},
    {C::cancel_without_call, "NC-MACRO", nullptr},
    {C::user_alarm, "NC-MACRO", nullptr},
    {C::bracket_nesting, "NC-MACRO", nullptr},
    {C::bracket_pair, "NC-MACRO", nullptr},
    {C::calculation, "NC-MACRO", nullptr},
    {C::division_by_zero, "NC-MACRO", nullptr},
    {C::if_statement, "NC-MACRO", nullptr},
    {C::while_statement, "NC-MACRO", nullptr},
    {C::name_statement, "NC-MACRO", nullptr},
    {C::loop_nesting, "NC-MACRO", nullptr},
    {C::loop_pair, "NC-MACRO", nullptr},
    {C::jump_on_tape, "NC-MACRO", nullptr},
    {C::address_missing, "NC-MACRO", nullptr},
    {C::variable_number, "NC-MACRO", nullptr},
    {C::no_equals, "NC-MACRO", nullptr},
    {C::variable_use, "NC-MACRO", nullptr},
    {C::variable_name, "NC-MACRO", nullptr},
    {C::variable_name_twice, "NC-MACRO", nullptr},
    {C::call_in_cycle, "NC-MACRO", nullptr},
    {C::print_port, "NC-MACRO", nullptr},
    {C::parameter_input, "NC-DATA", nullptr},
    {C::no_such_data, "NC-DATA", nullptr},
    {C::program_edited, "NC-READ", nullptr},
    {C::rotation_in_figure, "NC-NOT-BUILT", nullptr},  // these do not occur: there is no such function
    {C::offset_in_figure, "NC-NOT-BUILT", nullptr},
    {C::offset_arc, "NC-NOT-BUILT", nullptr},
    {C::machine_in_figure, "NC-NOT-BUILT", nullptr},
    {C::surface_axis, "NC-AXIS", nullptr},
    {C::surface_speed, "NC-SPINDLE", nullptr},
    {C::read_failed, "NC-READ", nullptr},
    {C::program_changed, "NC-READ", nullptr},
    {C::vendor_function, "NC-VENDOR", nullptr},
    // do not occur: the family has no such words
    {C::control_structure, "NC-ADDRESS", nullptr},
    {C::name_without_value, "NC-MACRO", nullptr},
    {C::too_many_names, "NC-MACRO", nullptr},
    {C::probe_no_contact, "NC-NO-SUCH-CODE", nullptr},
    {C::call_in_mdi, "NC-MACRO", nullptr},
    {C::tap_no_speed, "NC-SPINDLE", nullptr},
    {C::tap_no_pitch, "NC-FEED", nullptr},
    {C::tap_pitch, "NC-RANGE", nullptr},
    {C::tap_speed_word, "NC-SPINDLE", nullptr},
    {C::no_holes, "NC-RANGE", nullptr},
    {C::hole_angle_zero, "NC-RANGE", nullptr},
    {C::drilling_axis_changed, "NC-PLANE", nullptr},
    {C::internal, "NC-INTERNAL", nullptr},
};

}  // namespace nc::dgshape
