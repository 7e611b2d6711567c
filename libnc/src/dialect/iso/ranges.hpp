// SPDX-License-Identifier: Apache-2.0
// The ranges of the iso family. RS-274/NGC and LinuxCNC's pages give signs and wholeness of words and no largest values; the practice of FANUC's controls
// counts where one is needed, which is marked "silent" (docs/decisions.md, ISO). 0: the family has no such word, parameter or variable.
#pragma once

#include "dialect/ranges.hpp"

namespace nc::iso {

inline constexpr RangeRules kRanges = {
    .largest_program = 99999999,        // silent
    .largest_misc = 99999999,           // silent (RS-274/NGC 3.6)
    .largest_second_misc = 0,
    .largest_spindle_value = 99999999,  // silent (RS-274/NGC 3.7.2; LinuxCNC G96 D)
    .largest_tool = 99999999,           // silent (RS-274/NGC 3.7.3; LinuxCNC M61 Q)
    .end_of_positions_mm = 100000,      // silent
    .end_of_positions_inch = 10000,
    .end_of_offset_mm = 100000,         // silent
    .end_of_offset_inch = 10000,
    .end_of_radius_mm = 0,              // no program sets one
    .end_of_radius_inch = 0,
    .end_of_revolution_feed = 1000,     // silent (LinuxCNC G95)
    .end_of_inverse_time = 1e6,         // silent (RS-274/NGC 3.5.19)
    .end_of_lead_mm = 1000,             // silent (LinuxCNC G33, K)
    .end_of_lead_inch = 100,
    .end_of_fine_lead_inch = 0,
    .end_of_ridges_mm = 0,
    .end_of_ridges_inch = 0,
    .most_arc_turns = 9999,             // silent (LinuxCNC G2: P is a positive whole number)
    .most_call_repeats = 0,
    .most_hole_repeats = 9999,          // silent (RS-274/NGC 3.5.16: L is a positive whole number)
    .most_holes = 0,
    .most_pitches = 0,
    .least_curve_weight = 0,
    .most_curve_weight = 0,
    .steepest_exponential_deg = 0,
    .most_current_percent = 0,
    .least_scale = 0,
    .most_scale = 0,
    .least_in_position_mm = 0,
    .most_in_position_mm = 0,
    .most_return_speed = 0,
    .largest_turn_vector = 0,
    .largest_turn_deg = 0,
    .longest_input_wait_s = 1e6,        // silent (LinuxCNC M66 Q)
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

}  // namespace nc::iso
