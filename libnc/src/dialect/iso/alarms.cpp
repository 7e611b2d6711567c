// SPDX-License-Identifier: Apache-2.0
// RS-274 has no alarm numbers. The codes and texts are ours: NC- and a word that says what is wrong. One code may stand for several
// conditions, the sentence for the operator tells them apart.
#include "dialect/iso/tables.hpp"

namespace nc::iso {

using C = Condition;

const AlarmText kAlarms[] = {
    {"NC-ADDRESS", "Unknown or misplaced word"},
    {"NC-FORMAT", "Block is not written correctly"},
    {"NC-RANGE", "Value out of range"},
    {"NC-CHARACTER", "Illegal character"},
    {"NC-LENGTH", "Block is too long"},
    {"NC-NUMBER", "Block number is not possible"},
    {"NC-END", "Program does not end"},
    {"NC-START", "Program does not begin"},
    {"NC-AXIS", "Axis not possible here"},
    {"NC-NO-SUCH-CODE", "Code does not exist"},
    {"NC-NOT-BUILT", "Function is not available"},
    {"NC-ALONE", "Code must stand alone in its block"},
    {"NC-WORDS", "Words are missing"},
    {"NC-FEED", "No feed rate"},
    {"NC-FEED-MODE", "Code not possible with this feed mode"},
    {"NC-ARC", "Arc cannot be made"},
    {"NC-THREAD", "Thread cannot be cut"},
    {"NC-PLANE", "Plane not possible here"},
    {"NC-OFFSET-DATA", "Offset number missing or too large"},
    {"NC-OFFSET-START", "Compensation starts or ends with an arc"},
    {"NC-OFFSET-CODE", "Code not possible with cutter compensation"},
    {"NC-OFFSET-PATH", "No path with this cutter compensation"},
    {"NC-REFERENCE", "Axis has no reference"},
    {"NC-LIMIT", "Beyond the operating range"},
    {"NC-SPINDLE", "Spindle is not turning"},
    {"NC-INCREMENTAL", "Code not possible with G91"},
    {"NC-TOOL", "Tool word not possible here"},
    {"NC-DATA", "G10 data number is not correct"},
    {"NC-PROBE", "Probe did not touch"},
    {"NC-FORMULA", "Expression has no value"},
    {"NC-PARAMETER", "Parameter not possible here"},
    {"NC-O-WORD", "O words are not available"},
    {"NC-READ", "Program cannot be read"},
    {"NC-VENDOR", "Function of the machine failed"},
    {"NC-INTERNAL", "Internal error of the control"},
};
static_assert(sizeof kAlarms / sizeof kAlarms[0] == kAlarmRows);

const AlarmRow kConditions[kConditionRows] = {
    // words and blocks
    {C::illegal_address, "NC-ADDRESS", nullptr},
    {C::exponent, "NC-ADDRESS", nullptr},
    {C::format_error, "NC-FORMAT", nullptr},
    {C::behind_semicolon, "NC-FORMAT", nullptr},  // does not occur
    {C::value_range, "NC-RANGE", nullptr},
    {C::illegal_character, "NC-CHARACTER", nullptr},
    {C::block_too_long, "NC-LENGTH", nullptr},
    {C::number_zero, "NC-NUMBER", nullptr},
    {C::program_end, "NC-END", nullptr},  // does not occur
    {C::no_start_mark, "NC-START", nullptr},  // does not occur
    {C::illegal_axis, "NC-AXIS", nullptr},
    {C::too_many_axes, "NC-AXIS", nullptr},
    {C::index_increment, "NC-RANGE", nullptr},  // does not occur
    {C::parity, "NC-CHARACTER", nullptr},
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
    {C::helix_option, "NC-ARC", nullptr},  // does not occur
    {C::plane_mismatch, "NC-PLANE", nullptr},
    {C::plane_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::plane_in_rotation, "NC-NOT-BUILT", nullptr},  // does not occur
    {C::space_conversion, "NC-NOT-BUILT", nullptr},  // does not occur
    {C::arc_in_compensation_start, "NC-OFFSET-START", nullptr},
    {C::no_offset_number, "NC-OFFSET-DATA", nullptr},
    {C::cycle_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::skip_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::skip_feed_zero, "NC-FEED", nullptr},
    {C::no_reference, "NC-REFERENCE", nullptr},
    {C::soft_limit, "NC-LIMIT", nullptr},
    {C::spindle_not_turning, "NC-SPINDLE", nullptr},
    {C::cycle_wrong_plane, "NC-PLANE", nullptr},
    {C::not_in_compensation, "NC-OFFSET-CODE", nullptr},
    {C::code_in_incremental, "NC-INCREMENTAL", nullptr},
    {C::tool_pair, "NC-TOOL", nullptr},  // does not occur
    {C::comp_no_intersection, "NC-OFFSET-PATH", nullptr},
    {C::comp_interference, "NC-OFFSET-PATH", nullptr},
    // options of the end of a line, three words of a vector: the family has no such words
    {C::corner_option, "NC-ADDRESS", nullptr},
    {C::corner_arc, "NC-ADDRESS", nullptr},
    {C::corner_no_move, "NC-ADDRESS", nullptr},
    {C::corner_short, "NC-ADDRESS", nullptr},
    {C::corner_reversal, "NC-ADDRESS", nullptr},
    {C::corner_next_short, "NC-ADDRESS", nullptr},
    {C::corner_motion, "NC-ADDRESS", nullptr},
    {C::pre_read, "NC-ADDRESS", nullptr},
    {C::geometric_option, "NC-ADDRESS", nullptr},
    {C::second_aux, "NC-ADDRESS", nullptr},
    {C::space_compensation, "NC-ADDRESS", nullptr},
    // curves and modes; those that the family does not have are codes that do not exist
    {C::thread_lead, "NC-THREAD", nullptr},
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
    {C::displaced, "NC-ARC", nullptr},  // does not occur
    {C::space_conversion_code, "NC-NO-SUCH-CODE", nullptr},
    {C::inverse_time_code, "NC-FEED-MODE", nullptr},
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
    {C::local_in_extended, "NC-NOT-BUILT", nullptr},  // does not occur
    // programs; sub programs and control structures are not built
    {C::program_missing, "NC-NOT-BUILT", nullptr},
    {C::sequence_missing, "NC-NOT-BUILT", nullptr},
    {C::nesting, "NC-NOT-BUILT", nullptr},
    {C::macro_nesting, "NC-NOT-BUILT", nullptr},
    {C::no_macro, "NC-NOT-BUILT", nullptr},
    {C::macro_and_words, "NC-PARAMETER", nullptr},
    {C::macro_argument, "NC-NOT-BUILT", nullptr},
    {C::cancel_without_call, "NC-NOT-BUILT", nullptr},
    {C::user_alarm, "NC-NOT-BUILT", nullptr},
    // expressions and parameters
    {C::bracket_nesting, "NC-FORMULA", nullptr},
    {C::bracket_pair, "NC-FORMULA", nullptr},
    {C::calculation, "NC-FORMULA", nullptr},
    {C::division_by_zero, "NC-FORMULA", nullptr},
    // statements of other families: no words here
    {C::if_statement, "NC-NOT-BUILT", nullptr},
    {C::while_statement, "NC-NOT-BUILT", nullptr},
    {C::name_statement, "NC-NOT-BUILT", nullptr},
    {C::loop_nesting, "NC-NOT-BUILT", nullptr},
    {C::loop_pair, "NC-NOT-BUILT", nullptr},
    {C::jump_on_tape, "NC-NOT-BUILT", nullptr},
    {C::address_missing, "NC-NOT-BUILT", nullptr},
    {C::variable_number, "NC-PARAMETER", nullptr},
    {C::no_equals, "NC-PARAMETER", nullptr},
    {C::variable_use, "NC-PARAMETER", nullptr},
    {C::variable_name, "NC-PARAMETER", nullptr},
    {C::variable_name_twice, "NC-PARAMETER", nullptr},
    {C::call_in_cycle, "NC-NOT-BUILT", nullptr},
    {C::print_port, "NC-NOT-BUILT", nullptr},
    {C::parameter_input, "NC-DATA", nullptr},
    {C::no_such_data, "NC-DATA", nullptr},
    {C::program_edited, "NC-READ", nullptr},
    // functions of other families
    {C::rotation_in_figure, "NC-NOT-BUILT", nullptr},
    {C::offset_in_figure, "NC-NOT-BUILT", nullptr},
    {C::offset_arc, "NC-NOT-BUILT", nullptr},
    {C::machine_in_figure, "NC-NOT-BUILT", nullptr},
    {C::surface_axis, "NC-AXIS", nullptr},
    {C::surface_speed, "NC-SPINDLE", nullptr},
    {C::read_failed, "NC-READ", nullptr},
    {C::program_changed, "NC-READ", nullptr},
    {C::vendor_function, "NC-VENDOR", nullptr},
    // what RS-274 has and others have not
    {C::control_structure, "NC-O-WORD", nullptr},
    {C::name_without_value, "NC-PARAMETER", nullptr},
    {C::too_many_names, "NC-PARAMETER", nullptr},
    {C::probe_no_contact, "NC-PROBE", nullptr},
    {C::call_in_mdi, "NC-NOT-BUILT", nullptr},  // does not occur
    {C::tap_no_speed, "NC-SPINDLE", nullptr},
    {C::tap_no_pitch, "NC-FEED", nullptr},
    {C::tap_pitch, "NC-RANGE", nullptr},
    {C::tap_speed_word, "NC-SPINDLE", nullptr},
    {C::no_holes, "NC-RANGE", nullptr},
    {C::hole_angle_zero, "NC-RANGE", nullptr},
    {C::drilling_axis_changed, "NC-PLANE", nullptr},
    {C::internal, "NC-INTERNAL", nullptr},
};

}  // namespace nc::iso
