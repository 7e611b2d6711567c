// SPDX-License-Identifier: Apache-2.0
// M700: which alarm of appendix 1 belongs to a condition. The message comes from the alarm list (alarms.cpp). A condition that cannot occur in
// this family has the nearest code all the same, so that nothing can end without an alarm; a comment says why it cannot occur or why the code
// is the nearest.
#include "dialect/m700/tables.hpp"

namespace nc::m700 {

using C = Condition;

const AlarmRow kConditions[kConditionRows] = {
    // words and blocks
    {C::illegal_address, "P32", nullptr},
    {C::exponent, "P32", nullptr},  // appendix 1: an address that the block does not take
    {C::format_error, "P33", nullptr},
    {C::behind_semicolon, "P33", nullptr},  // appendix 1: "the command format of the block"
    {C::value_range, "P35", nullptr},
    {C::no_direction, "P35", nullptr},  // 12.4.2, 12.5
    {C::illegal_character, "P32", nullptr},  // 3.1: a code outside the tape code table
    {C::block_too_long, "P33", nullptr},     // 3.2 gives no largest length of a block, so it is a fault of format
    {C::number_zero, "P37", nullptr},
    {C::program_end, "P36", nullptr},
    {C::sub_without_return, "P36", nullptr},
    {C::no_start_mark, "P33", nullptr},  // does not occur: no start mark is required
    {C::illegal_axis, "P11", nullptr},
    {C::too_many_axes, "P10", nullptr},
    {C::index_increment, "P20", nullptr},  // 2.3
    {C::parity, "P30", nullptr},           // 3.6
    {C::parity_vertical, "P31", nullptr},
    // G and M codes
    {C::illegal_g, "P34", nullptr},
    {C::no_function, "P39", nullptr},       // unless the row of the G or M code names an alarm of its own
    {C::must_stand_alone, "P33", nullptr},  // 13.18: "not independent"
    {C::words_missing, "P33", nullptr},
    {C::center_missing, "P33", nullptr},
    // motion
    {C::no_feed, "P62", nullptr},
    {C::arc_deviation, "P70", nullptr},  // 6.4
    {C::arc_displaced, "P70", nullptr},  // 12.5
    {C::arc_by_hand, "P70", nullptr},    // 12.4.4
    {C::length_beside_arc, "P70", nullptr},  // App. 2
    {C::corner_uneven, "P70", nullptr},      // 13.19 (4)
    {C::arc_center, "P71", nullptr},     // 6.5
    {C::helix_option, "P72", nullptr},   // 6.6
    {C::plane_mismatch, "P113", nullptr},
    {C::plane_in_compensation, "P112", nullptr},
    {C::plane_in_rotation, "P111", nullptr},  // 13.20
    {C::space_conversion, "P920", nullptr},   // 13.22
    {C::arc_in_compensation_start, "P151", nullptr},  // 12.4.1
    {C::no_offset_number, "P170", nullptr},
    {C::tool_unknown, "P170", nullptr},  // H99, D99: the tool in the spindle is not known (10.15)
    {C::cycle_in_compensation, "P155", nullptr},
    {C::skip_in_compensation, "P608", nullptr},
    {C::skip_feed_zero, "P603", nullptr},
    {C::skip_feed_mode, "P603", nullptr},  // does not occur: the feed of a skip is its own (15.2)
    {C::no_reference, "P430", nullptr},
    {C::soft_limit, "M01-0007", nullptr},
    {C::spindle_not_turning, "P132",
     nullptr},  // does not occur: cycles run without a spindle; "spindle speed S=0"
    {C::cycle_wrong_plane, "P113", nullptr},  // does not occur: cycles work in every plane (13.1.1)
    {C::not_in_compensation, "P155",
     nullptr},  // does not occur: everything that is forbidden in compensation has an alarm of its own
    {C::code_in_incremental, "P33", nullptr},  // does not occur: G53 takes G91 (14.4)
    {C::tool_pair, "P33", nullptr},            // does not occur: M06 is put out like any other M code
    {C::comp_no_intersection, "P152", nullptr},
    {C::comp_interference, "P153", nullptr},
    {C::comp_way, "P153", nullptr},
    {C::comp_turn_open, "P152", nullptr},    // 12.4.2, G39
    {C::comp_turn_inside, "P153", nullptr},  // does not occur: G39 takes its corner from the block behind it
    {C::contour_too_long, "P990", nullptr},    // CONTOUR_CHECK; appendix 1: more than can be read ahead
    {C::corner_option, "P380", nullptr},       // 13.7; in a fixed cycle, and while programmed coordinates are not those of the axes
    {C::corner_arc, "P381", nullptr},          // 13.7
    {C::corner_no_move, "P382", nullptr},
    {C::corner_short, "P383", nullptr},
    {C::corner_reversal, "P383", nullptr},  // 13.7.2 has no other code: the arc would be longer than any line
    {C::corner_next_short, "P384", nullptr},
    {C::corner_motion, "P385", nullptr},
    {C::pre_read, "P990", nullptr},            // appendix 1
    {C::geometric_option, "P390", nullptr},    // 13.8, 13.9
    {C::second_aux, "P130", nullptr},          // 9.2
    {C::space_compensation, "P150", nullptr},  // 12.5: I, J and K together need an option
    {C::thread_lead, "P93", nullptr},          // 6.7.1
    {C::mill_code, "P481", nullptr},           // 6.9, 6.10
    {C::mill_axis, "P482", nullptr},
    {C::mill_modal, "P485", nullptr},
    {C::mill_state, "P486", nullptr},
    {C::polar_code, "P481", nullptr},
    {C::polar_axis, "P482", nullptr},
    {C::polar_modal, "P485", nullptr},
    {C::polar_state, "P486", nullptr},
    {C::space_arc_blocks, "P74", nullptr},     // 6.14
    {C::space_arc_mode, "P75", nullptr},
    {C::exponential_mode, "P612", nullptr},    // 6.11
    {C::exponential_axes, "P610", nullptr},
    {C::nurbs_knot, "P551", nullptr},          // 6.15
    {C::nurbs_start, "P552", nullptr},
    {C::displaced, "P554", nullptr},           // 6.15 note 3; other curves over several blocks have no number of their own
    {C::space_conversion_code, "P921", nullptr},
    {C::inverse_time_code, "P125", nullptr},   // 7.5
    {C::circle_radius, "P223", nullptr},       // appendix 1; 13.10 prints P233, which the appendix does not have
    {C::arc_feed_zero, "P121", nullptr},       // 7.3
    {C::reference_compare, "P434", nullptr},   // 14.9
    {C::reference_check_m, "P435", nullptr},
    {C::start_return_m, "P436", nullptr},      // 14.7
    {C::measure_axis, "P604", nullptr},        // 15.1
    {C::measure_h, "P605", nullptr},
    {C::measure_no_length, "P606", nullptr},
    {C::measure_signal, "P607", nullptr},
    {C::stroke_check, "P452", nullptr},        // 15.7 prints no number; this one is from later manuals of the family
    {C::stroke_area_unknown, "P452", nullptr},  // does not occur: words that are missing are 0 (15.7 (2))
    {C::not_accepted, "P29", nullptr},         // 13.15
    {C::in_high_accuracy, "P126", nullptr},    // 13.15, appendix 1
    {C::high_speed_3, "P65", nullptr},         // appendix 1
    // offsets
    {C::data_input_kind, "P172", nullptr},
    {C::data_input_number, "P173", nullptr},  // appendix 1; 12.7 prints P170 for the same thing
    {C::local_in_extended, "P438", nullptr},
    // programs and macros
    {C::program_missing, "P232", nullptr},
    {C::sequence_missing, "P231", nullptr},
    {C::nesting, "P230", nullptr},
    {C::macro_nesting, "P273", nullptr},
    {C::no_macro, "P270", nullptr},
    {C::macro_and_words, "P272", nullptr},
    {C::macro_argument, "P275", nullptr},
    {C::cancel_without_call, "P276", nullptr},
    {C::user_alarm, "P277", nullptr},
    {C::bracket_nesting, "P280", nullptr},
    {C::bracket_pair, "P281", nullptr},
    {C::calculation, "P282", nullptr},
    {C::division_by_zero, "P283", nullptr},
    {C::if_statement, "P290", nullptr},
    {C::while_statement, "P291", nullptr},
    {C::name_statement, "P292", nullptr},
    {C::loop_nesting, "P293", nullptr},
    {C::loop_pair, "P294", nullptr},
    {C::jump_on_tape, "P295", nullptr},
    {C::address_missing, "P296", nullptr},
    {C::variable_number, "P241", nullptr},
    {C::no_equals, "P242", nullptr},
    {C::variable_use, "P243", nullptr},
    {C::variable_name, "P300", nullptr},
    {C::variable_name_twice, "P301", nullptr},
    {C::call_in_cycle, "P310", nullptr},
    {C::print_port, "P460", nullptr},  // appendix 1: "... or in the printer during macro printing"
    {C::parameter_input, "P421", nullptr},
    {C::no_such_data, "P39", nullptr},  // 13.5.5, parameter and PLC data read
    {C::program_edited, "P235", nullptr},
    {C::rotation_in_figure, "P252", nullptr},
    {C::offset_in_figure, "P141", nullptr},
    {C::offset_arc, "P142", nullptr},
    {C::machine_in_figure, "P34", nullptr},  // 13.3.3 (9): "cannot be used", without a code
    {C::surface_axis, "P133", nullptr},      // 10.3
    {C::surface_speed, "P132", nullptr},     // 10.3
    {C::geometric_arc_option, "P391", nullptr},     // 13.9: "no spec", where programmed coordinates are not those of the axes
    {C::geometric_circle_option, "P398", nullptr},  // the same of circles that meet or touch
    {C::geometric_parallel, "P392", nullptr},       // 13.9
    {C::geometric_incremental, "P393", nullptr},
    {C::geometric_no_line, "P394", nullptr},
    {C::geometric_address, "P395", nullptr},
    {C::geometric_plane, "P396", nullptr},
    {C::geometric_contact, "P397", nullptr},
    {C::tool_axis_pair, "P930", nullptr},           // 12.3: a machine without the rotary axes does not have the function
    {C::tool_axis_code, "P931", nullptr},
    {C::space_conversion_block, "P923", nullptr},   // 12.3
    {C::outside_compensation, "P150", nullptr},     // 12.4: G38, G39; no other number speaks of radius compensation that is not there
    {C::read_failed, "P461", nullptr},
    {C::program_changed, "P461", nullptr},
    {C::vendor_function, "NC-VENDOR", nullptr},
    // do not occur: the family has no such words
    {C::control_structure, "P32", nullptr},
    {C::name_without_value, "P241", nullptr},
    {C::too_many_names, "P241", nullptr},
    {C::probe_no_contact, "P607", nullptr},
    {C::probe_contact, "P607", nullptr},
    {C::two_words, "P33", nullptr},
    {C::comment_open, "P33", nullptr},  // these do not occur
    {C::level_below_bottom, "P35", nullptr},
    {C::cavity_size, "P35", nullptr},
    {C::cavity_corner, "P35", nullptr},
    {C::cavity_step, "P35", nullptr},
    {C::head_silent, "P33", nullptr},  // does not occur
    {C::call_in_mdi, "P29", nullptr},  // does not occur
    {C::tap_no_speed, "P181", nullptr},    // 13.1.1, appendix 1
    {C::tap_no_pitch, "P183", nullptr},
    {C::tap_pitch, "P184", nullptr},
    {C::tap_speed_word, "P186", nullptr},
    {C::life_full, "P178", nullptr},       // appendix 1
    {C::life_group, "P179", nullptr},
    {C::block_skip, "P33", nullptr},         // does not occur
    {C::no_holes, "P221", nullptr},        // 13.2
    {C::hole_angle_zero, "P222", nullptr}, // appendix 1
    {C::drilling_axis_changed, "P33", nullptr},  // 13.1.1 note 2 has no code: a block that may not be written so
    {C::tap_apart, "NC-TAP", nullptr},       // the manual prints no number
    {C::encoder_jumps, "NC-TAP", nullptr},
    {C::restart_void, "NC-RESTART", nullptr},  // the manual is silent about restarts
    {C::internal, "NC-INTERNAL", nullptr},
};

}  // namespace nc::m700
