// SPDX-License-Identifier: Apache-2.0
// The ranges of the m700 family, each with its section.
#pragma once

#include "dialect/ranges.hpp"

namespace nc::m700 {

inline constexpr RangeRules kRanges = {
    .largest_program = 99999999,        // 3.5, 13.3.1: eight digits
    .largest_misc = 99999999,           // 9.1: eight digits
    .largest_second_misc = 99999999,    // 9.2: eight digits
    .largest_spindle_value = 99999999,  // 10.2: eight digits
    .largest_tool = 99999999,           // 11.1: eight digits
    .end_of_positions_mm = 100000,      // 2.1, 5.3: +-99999.999 with #1003 = B
    .end_of_positions_inch = 10000,     // 2.1, 5.3: +-9999.9999
    .end_of_offset_mm = 100000,         // 12.1, 14.10 (6): +-99999.999 with #1003 = B
    .end_of_offset_inch = 10000,        // +-9999.9999
    .end_of_radius_mm = 100000,         // 12.1
    .end_of_radius_inch = 10000,
    .end_of_revolution_feed = 1000,     // 7.4 (1): 0.001 to 999.999
    .end_of_inverse_time = 1e6,         // 7.5 (2), precaution (3): 0.001 to 999999.999
    .end_of_lead_mm = 1000,             // 6.7.1: 0.001 to 999.999 mm; a tap's pitch as well (13.1.4, P184)
    .end_of_lead_inch = 100,            // 6.7.1, F: to 99.9999 inch
    .end_of_fine_lead_inch = 39.370079, // 6.7.1, E: to 39.370078 inch
    .end_of_ridges_mm = 1000,           // 6.7.2 (3), E
    .end_of_ridges_inch = 10000,
    .most_arc_turns = 9999,             // 6.6
    .most_call_repeats = 9999,          // 13.3.1
    .most_hole_repeats = 9999,          // 13.1.1
    .most_holes = 9999,                 // 13.2: four digits, of more the last four count
    .most_pitches = 99,                 // 6.13
    .least_curve_weight = 0.0001,       // 6.15
    .most_curve_weight = 99.9999,
    .steepest_exponential_deg = 89,     // 6.11
    .most_current_percent = 300,        // 15.6
    .least_scale = 1e-6,                // 13.19
    .most_scale = 99.999999,
    .least_in_position_mm = 0.001,      // 13.1.1; 6.1 and 6.2 give no range for the same word
    .most_in_position_mm = 999.999,
    .most_return_speed = 99999,         // 13.1.1, ,S: 0 to 99999 r/min
    .largest_turn_vector = 999999.999999,    // 13.21
    .largest_turn_deg = 360,
    .longest_input_wait_s = 0,
    .largest_calling_value = 999999.9999,    // 13.5.3, ASCII codes
    .largest_alarm = 9999,              // 13.5.5, 10.3
    .most_workpieces = 999999,          // 13.5.5, 10.13
    .longest_counter_ms = 244335917226,      // 13.5.5, 10.5
    .first_year = 2000,                 // 13.5.5, 10.18
    .last_year = 2099,
    .largest_parameter = 99999,         // 13.5.5, 10.16: a parameter that does not exist is P39
    .largest_device = 99999,            // 13.5.5, 10.17: a device reads 0 behind its own last one
    .largest_life_number = 99999999,    // 13.5.5, 10.15
    .most_life_minutes = 4000,
    .most_life_times = 9999,
};

}  // namespace nc::m700
