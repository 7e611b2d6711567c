// SPDX-License-Identifier: Apache-2.0
// The ranges of the dgshape family, each with its section. 0: the family has no such word, parameter or variable.
#pragma once

#include "dialect/ranges.hpp"

namespace nc::dgshape {

inline constexpr RangeRules kRanges = {
    .largest_program = 99999999,        // 2-3, O: 00000001 to 99999999
    .largest_misc = 99999999,           // 2-1 "range 2"; 2-7 lists the codes that there are
    .largest_second_misc = 0,
    .largest_spindle_value = 99999999,  // 2-1 "range 2"
    .largest_tool = 99999999,           // 2-1 "range 2"
    .end_of_positions_mm = 100000,      // 2-1 "range 1": +-99999.999, the manual has its two labels exchanged
    .end_of_positions_inch = 10000,     // +-9999.9999
    .end_of_offset_mm = 100000,         // silent
    .end_of_offset_inch = 10000,
    .end_of_radius_mm = 100000,         // silent
    .end_of_radius_inch = 10000,
    .end_of_revolution_feed = 0,
    .end_of_inverse_time = 0,
    .end_of_lead_mm = 0,
    .end_of_lead_inch = 0,
    .end_of_fine_lead_inch = 0,
    .end_of_ridges_mm = 0,
    .end_of_ridges_inch = 0,
    .most_arc_turns = 0,
    .most_call_repeats = 0,
    .most_hole_repeats = 9999,          // G80 to G89, K: 0 to 9999
    .most_holes = 0,
    .most_pitches = 0,
    .least_curve_weight = 0,
    .most_curve_weight = 0,
    .steepest_exponential_deg = 0,
    .most_current_percent = 0,
    .least_scale = 0.001,               // G51: 0.001 to 999.999; a value beyond becomes the nearest one, without a fault
    .most_scale = 999.999,
    .least_in_position_mm = 0,
    .most_in_position_mm = 0,
    .most_return_speed = 0,
    .largest_turn_vector = 0,
    .largest_turn_deg = 0,
    .longest_input_wait_s = 0,
    .largest_calling_value = 0,
    .largest_alarm = 0,
    .most_workpieces = 0,
    .longest_counter_ms = 0,
    .first_year = 0,
    .last_year = 0,
    .largest_parameter = 0,
    .largest_device = 0,
    .largest_life_number = 0,
    .most_life_minutes = 0,
    .most_life_times = 0,
};

}  // namespace nc::dgshape
