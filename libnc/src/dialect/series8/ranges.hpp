// SPDX-License-Identifier: Apache-2.0
// The ranges of the Series 8, each with the code of its page. The manual is a reference of G codes and prints hardly a range: where it has none the practice
// of FANUC's controls counts, which is marked "silent" (docs/decisions.md, Series 8). 0: the family has no such word, parameter or variable.
#pragma once

#include "dialect/ranges.hpp"

namespace nc::series8 {

inline constexpr RangeRules kRanges = {
    .largest_program = 99999999,        // silent
    .largest_misc = 99999999,           // silent
    .largest_second_misc = 0,
    .largest_spindle_value = 99999999,  // silent (G92, G97)
    .largest_tool = 99999999,           // silent
    .end_of_positions_mm = 100000,      // silent
    .end_of_positions_inch = 10000,     // silent
    .end_of_offset_mm = 100000,         // silent
    .end_of_offset_inch = 10000,
    .end_of_radius_mm = 0,              // no program sets one
    .end_of_radius_inch = 0,
    .end_of_revolution_feed = 1000,     // silent (G95)
    .end_of_inverse_time = 1e6,         // silent (G93)
    .end_of_lead_mm = 1000,             // silent (G84, K)
    .end_of_lead_inch = 0,              // G33 is not there, and K is converted first
    .end_of_fine_lead_inch = 0,
    .end_of_ridges_mm = 0,
    .end_of_ridges_inch = 0,
    .most_arc_turns = 0,
    .most_call_repeats = 0,
    .most_hole_repeats = 0,             // G81 to G89 have no such word
    .most_holes = 9999,                 // silent (G49, G50, K and L)
    .most_pitches = 0,
    .least_curve_weight = 0,
    .most_curve_weight = 0,
    .steepest_exponential_deg = 0,
    .most_current_percent = 0,
    .least_scale = 1e-6,                // silent (G57: R is the factor, and is greater than 0)
    .most_scale = 99.999999,
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

}  // namespace nc::series8
