// SPDX-License-Identifier: Apache-2.0
// The alarm numbers that stand in the HX manual, with texts of ours: what is left of its text is the number and the section. Where the sentence
// around a number is lost, the condition is the one of that section that fits (docs/decisions.md). All other conditions have the codes of
// dialect/default_alarms.cpp.
#include "dialect/hx/tables.hpp"

namespace nc::hx {

using C = Condition;

const AlarmText kAlarms[] = {
    {"F_82001", "Illegal character or address"},
    {"F_82002", "Data out of range"},
    {"F_82004", "Illegal format of data"},
    {"F_82016", "No M02 or M30 at the program end"},
    {"F_82017", "Optional block skip error"},
    {"F_82018", "Sequence number error"},
    {"F_82019", "Sequence number not found"},
    {"F_82021", "Too many sub program calls"},
    {"F_82023", "Sub program end block not found"},
    {"F_82024", "Sub program without M99"},
    {"F_82025", "M99 not possible here"},
    {"F_82030", "Illegal G code"},
    {"F_82100", "Illegal arc radius"},
    {"F_82109", "Sub program not found"},
    {"F_82111", "Block too long"},
    {"F_82112", "Arc end point not on the circle"},
    {"F_82113", "Sub program call in MDI"},
    {"F_82204", "Polar coordinate interpolation error"},
    {"F_82208", "Cylindrical interpolation error"},
    {"F_82209", "Not at the reference position"},
    {"F_84020", "No feed rate"},
    {"F_84022", "Tool length measurement error"},
};
static_assert(sizeof kAlarms / sizeof kAlarms[0] == kAlarmRows);

const AlarmRow kConditions[] = {
    {C::illegal_character, "F_82001", nullptr},  // 2.2.1
    {C::illegal_address, "F_82001", nullptr},
    {C::value_range, "F_82002", nullptr},        // 2.2.2
    {C::no_direction, "F_82002", nullptr},
    {C::format_error, "F_82004", nullptr},
    {C::program_end, "F_82016", nullptr},        // 2.3
    {C::block_skip, "F_82017", nullptr},         // 2.3.3
    {C::sub_without_return, "F_82024", nullptr},  // 2.4.3
    {C::number_zero, "F_82018", nullptr},        // 2.3.2
    {C::sequence_missing, "F_82019", nullptr},
    {C::nesting, "F_82021", nullptr},            // 2.4.3
    {C::call_in_mdi, "F_82113", nullptr},
    {C::program_missing, "F_82109", nullptr},
    {C::illegal_g, "F_82030", nullptr},          // 3
    {C::arc_center, "F_82100", nullptr},         // 4.4
    {C::center_missing, "F_82100", nullptr},
    {C::arc_deviation, "F_82112", nullptr},
    {C::arc_by_hand, "F_82112", nullptr},
    {C::block_too_long, "F_82111", nullptr},     // 2.2.4
    {C::polar_code, "F_82204", nullptr},         // 4.6
    {C::polar_modal, "F_82204", nullptr},
    {C::polar_state, "F_82204", nullptr},
    {C::polar_axis, "F_82204", nullptr},
    {C::mill_code, "F_82208", nullptr},          // 4.7
    {C::mill_modal, "F_82208", nullptr},
    {C::mill_state, "F_82208", nullptr},
    {C::mill_axis, "F_82208", nullptr},
    {C::two_words, "F_82004", nullptr},          // 2.2.2
    {C::length_beside_arc, "F_82004", nullptr},
    {C::comment_open, "F_82004", nullptr},
    {C::corner_uneven, "F_82112", nullptr},      // 4.4: no arc
    {C::reference_compare, "F_82209", nullptr},  // 6.4
    {C::no_feed, "F_84020", nullptr},            // 5.2
    {C::measure_signal, "F_84022", nullptr},     // 4.10
    {C::skip_feed_zero, "F_84020", nullptr},     // 4.9: the F of 5.2
    {C::skip_feed_mode, "F_84020", nullptr},
    {C::arc_feed_zero, "F_84020", nullptr},
};

}  // namespace nc::hx
