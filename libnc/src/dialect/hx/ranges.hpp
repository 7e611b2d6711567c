// SPDX-License-Identifier: Apache-2.0
// The ranges of the HX family, each with its section. Where the manual gives none, or has lost it with its sentences, the practice of FANUC's controls
// counts, which is marked "silent" (docs/decisions.md, HX). 0: the family has no such word, parameter or variable.
#pragma once

#include "dialect/ranges.hpp"

namespace nc::hx {

inline constexpr RangeRules kRanges = {
    .largest_program = 99999999,        // silent: 2.4.3 has lost the digits of P
    .largest_misc = 999,                // 11: M00 to M999
    .largest_second_misc = 0,
    .largest_spindle_value = 99999999,  // silent (9)
    .largest_tool = 99999999,           // silent (10)
    .end_of_positions_mm = 100000,      // silent (8.4)
    .end_of_positions_inch = 10000,
    .end_of_offset_mm = 100000,         // silent (13.3 prints the amounts of the radius alone)
    .end_of_offset_inch = 10000,
    .end_of_radius_mm = 1000,           // 13.3: +-999.999 mm, +-99.999 inch
    .end_of_radius_inch = 100,
    .end_of_revolution_feed = 1000,     // silent (5.2)
    .end_of_inverse_time = 0,
    .end_of_lead_mm = 1000,             // silent (4.8, 12.3.5)
    .end_of_lead_inch = 100,            // silent
    .end_of_fine_lead_inch = 0,
    .end_of_ridges_mm = 0,
    .end_of_ridges_inch = 0,
    .most_arc_turns = 0,
    .most_call_repeats = 9999,          // silent (2.4.3, 14.1.1: "count of repeat")
    .most_hole_repeats = 9999,          // silent (12.1.2, K; 12.2.2, L or K)
    .most_holes = 0,
    .most_pitches = 0,
    .least_curve_weight = 0,
    .most_curve_weight = 0,
    .steepest_exponential_deg = 0,
    .most_current_percent = 0,
    .least_scale = 1e-6,                // silent (15.2.1, 15.2.2, PI 108 to PI 116)
    .most_scale = 99.999999,
    .least_in_position_mm = 0,
    .most_in_position_mm = 0,
    .most_return_speed = 0,
    .largest_turn_vector = 0,
    .largest_turn_deg = 0,
    .longest_input_wait_s = 0,
    .largest_calling_value = 0,
    .largest_alarm = 0,                 // 14.2.3 has no such variable
    .most_workpieces = 0,
    .longest_counter_ms = 0,
    .first_year = 0,
    .last_year = 0,
    .largest_parameter = 0,             // 14.2.3: each parameter is a variable of its own
    .largest_device = 0,
    .largest_life_number = 0,
    .most_life_minutes = 0,
    .most_life_times = 0,
};

}  // namespace nc::hx
