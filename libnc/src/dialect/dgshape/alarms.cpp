// SPDX-License-Identifier: Apache-2.0
// DGSHAPE prints no error numbers; it only says that something "results in an error". The codes and texts are ours: "NC-" and a word that
// says what is wrong. One code may stand for several conditions, which the sentence for the operator tells apart. "Does not occur" stands
// beside a condition that the family cannot meet. A condition without a row has the code of dialect/default_alarms.cpp.
#include "dialect/dgshape/tables.hpp"

namespace nc::dgshape {

using C = Condition;

const AlarmText kAlarms[] = {
    {"NC-OFFSET-START", "Offset starts or ends with an arc"},
    {"NC-OFFSET-CODE", "Code not possible with tool-diameter offset"},
    {"NC-OFFSET-PATH", "No path with this tool-diameter offset"},
    {"NC-TOOL", "M06 and T must stand together"},
    {"NC-MACRO", "No variables or sub programs"},
};

const AlarmRow kConditions[kConditionRows] = {
    // motion
    {C::plane_in_rotation, "NC-NOT-BUILT", nullptr},  // does not occur: there is no G68
    // the next eight do not occur: ",C" and ",R" are no words of the family
    {C::corner_option, "NC-ADDRESS", nullptr},
    {C::corner_arc, "NC-ADDRESS", nullptr},
    {C::corner_no_move, "NC-ADDRESS", nullptr},
    {C::corner_short, "NC-ADDRESS", nullptr},
    {C::corner_reversal, "NC-ADDRESS", nullptr},
    {C::corner_next_short, "NC-ADDRESS", nullptr},
    {C::corner_motion, "NC-ADDRESS", nullptr},
    {C::pre_read, "NC-ADDRESS", nullptr},
    {C::geometric_option, "NC-ADDRESS", nullptr},    // does not occur: ",A" is no word of the family
    // the next conditions do not occur: the family does not have these curves and modes
    {C::thread_lead, "NC-NO-SUCH-CODE", nullptr},
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
    {C::inverse_time_code, "NC-NO-SUCH-CODE", nullptr},
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
    {C::local_in_extended, "NC-NOT-BUILT", nullptr},  // does not occur: there is neither G52 nor G54.1
    // sub programs and macros: the family has neither, so that anything which looks like one is a macro that does not exist
    {C::program_missing, "NC-MACRO", nullptr},
    {C::sequence_missing, "NC-MACRO", nullptr},
    {C::nesting, "NC-MACRO", nullptr},
    {C::macro_nesting, "NC-MACRO", nullptr},
    {C::no_macro, "NC-MACRO", nullptr},
    {C::user_alarm, "NC-MACRO", nullptr},
    {C::bracket_nesting, "NC-MACRO", nullptr},
    {C::bracket_pair, "NC-MACRO", nullptr},
    {C::calculation, "NC-MACRO", nullptr},
    {C::division_by_zero, "NC-MACRO", nullptr},
    {C::loop_nesting, "NC-MACRO", nullptr},
    {C::loop_pair, "NC-MACRO", nullptr},
    {C::address_missing, "NC-MACRO", nullptr},
    {C::variable_number, "NC-MACRO", nullptr},
    {C::variable_use, "NC-MACRO", nullptr},
    {C::variable_name, "NC-MACRO", nullptr},
    {C::variable_name_twice, "NC-MACRO", nullptr},
    {C::rotation_in_figure, "NC-NOT-BUILT", nullptr},  // this one and the next three do not occur: there are no such functions
    {C::offset_in_figure, "NC-NOT-BUILT", nullptr},
    {C::offset_arc, "NC-NOT-BUILT", nullptr},
    {C::machine_in_figure, "NC-NOT-BUILT", nullptr},
    // the next four do not occur: the family has no such words
    {C::name_without_value, "NC-MACRO", nullptr},
    {C::too_many_names, "NC-MACRO", nullptr},
    {C::probe_no_contact, "NC-NO-SUCH-CODE", nullptr},
    {C::probe_contact, "NC-NO-SUCH-CODE", nullptr},
    {C::call_in_mdi, "NC-MACRO", nullptr},
};

}  // namespace nc::dgshape
