// SPDX-License-Identifier: Apache-2.0
// RS-274 has no alarm numbers. The codes and texts are ours: "NC-" and a word that says what is wrong. One code may stand for several
// conditions, which the sentence for the operator tells apart. "Does not occur" stands beside a condition that the family cannot meet.
// A condition without a row has the code of dialect/default_alarms.cpp.
#include "dialect/iso/tables.hpp"

namespace nc::iso {

using C = Condition;

const AlarmText kAlarms[] = {
    {"NC-NUMBER", "Block number is not possible"},
    {"NC-END", "Program does not end"},
    {"NC-START", "Program does not begin"},
    {"NC-FEED-MODE", "Code not possible with this feed mode"},
    {"NC-OFFSET-CODE", "Code not possible with cutter compensation"},
    {"NC-OFFSET-PATH", "No path with this cutter compensation"},
    {"NC-PARAMETER", "Parameter not possible here"},
    {"NC-O-WORD", "O words are not available"},
    {"NC-LATHE", "Code of a lathe"},
};
static_assert(sizeof kAlarms / sizeof kAlarms[0] == kAlarmRows);

const AlarmRow kConditions[kConditionRows] = {
    // motion
    {C::plane_in_rotation, "NC-NOT-BUILT", nullptr},  // does not occur
    // options at the end of a line, vectors of three words: the family has no such words
    {C::corner_option, "NC-ADDRESS", nullptr},
    {C::corner_arc, "NC-ADDRESS", nullptr},
    {C::corner_no_move, "NC-ADDRESS", nullptr},
    {C::corner_short, "NC-ADDRESS", nullptr},
    {C::corner_reversal, "NC-ADDRESS", nullptr},
    {C::corner_next_short, "NC-ADDRESS", nullptr},
    {C::corner_motion, "NC-ADDRESS", nullptr},
    {C::pre_read, "NC-ADDRESS", nullptr},
    {C::geometric_option, "NC-ADDRESS", nullptr},
    // curves and modes; if the family does not have one, its code does not exist
    {C::mill_code, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_axis, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_modal, "NC-NO-SUCH-CODE", nullptr},
    {C::mill_state, "NC-NO-SUCH-CODE", nullptr},
    {C::polar_code, "NC-NO-SUCH-CODE", nullptr},
    {C::polar_axis, "NC-NO-SUCH-CODE", nullptr},
    {C::polar_modal, "NC-NO-SUCH-CODE", nullptr},
    {C::polar_state, "NC-NO-SUCH-CODE", nullptr},
    {C::space_arc_blocks, "NC-NO-SUCH-CODE", nullptr},
    {C::space_arc_mode, "NC-NO-SUCH-CODE", nullptr},
    {C::exponential_mode, "NC-NO-SUCH-CODE", nullptr},
    {C::exponential_axes, "NC-NO-SUCH-CODE", nullptr},
    {C::nurbs_knot, "NC-NO-SUCH-CODE", nullptr},
    {C::nurbs_start, "NC-NO-SUCH-CODE", nullptr},
    {C::space_conversion_code, "NC-NO-SUCH-CODE", nullptr},
    {C::inverse_time_code, "NC-FEED-MODE", nullptr},
    {C::circle_radius, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_arc_option, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_circle_option, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_parallel, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_incremental, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_no_line, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_address, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_plane, "NC-NO-SUCH-CODE", nullptr},
    {C::geometric_contact, "NC-NO-SUCH-CODE", nullptr},
    {C::tool_axis_pair, "NC-NO-SUCH-CODE", nullptr},
    {C::tool_axis_code, "NC-NO-SUCH-CODE", nullptr},
    {C::space_conversion_block, "NC-NO-SUCH-CODE", nullptr},
    {C::arc_feed_zero, "NC-NO-SUCH-CODE", nullptr},
    {C::reference_check_m, "NC-NO-SUCH-CODE", nullptr},
    {C::start_return_m, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_axis, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_h, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_no_length, "NC-NO-SUCH-CODE", nullptr},
    {C::measure_signal, "NC-NO-SUCH-CODE", nullptr},
    {C::in_high_accuracy, "NC-NO-SUCH-CODE", nullptr},
    // offsets
    {C::local_in_extended, "NC-NOT-BUILT", nullptr},  // does not occur
    // programs; sub programs and control structures are not built
    {C::program_missing, "NC-NOT-BUILT", nullptr},
    {C::sequence_missing, "NC-NOT-BUILT", nullptr},
    {C::nesting, "NC-NOT-BUILT", nullptr},
    {C::macro_nesting, "NC-NOT-BUILT", nullptr},
    {C::macro_and_words, "NC-PARAMETER", nullptr},
    {C::macro_argument, "NC-NOT-BUILT", nullptr},
    {C::cancel_without_call, "NC-NOT-BUILT", nullptr},
    {C::user_alarm, "NC-NOT-BUILT", nullptr},
    // statements of other families, which are no words here
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
    // functions of other families
    {C::rotation_in_figure, "NC-NOT-BUILT", nullptr},
    {C::offset_in_figure, "NC-NOT-BUILT", nullptr},
    {C::offset_arc, "NC-NOT-BUILT", nullptr},
    {C::machine_in_figure, "NC-NOT-BUILT", nullptr},
    // conditions that only RS-274 has
    {C::control_structure, "NC-O-WORD", nullptr},
    {C::name_without_value, "NC-PARAMETER", nullptr},
    {C::too_many_names, "NC-PARAMETER", nullptr},
    {C::call_in_mdi, "NC-NOT-BUILT", nullptr},  // does not occur
};

}  // namespace nc::iso
