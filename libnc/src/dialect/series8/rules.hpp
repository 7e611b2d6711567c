// SPDX-License-Identifier: Apache-2.0
// How the Series 8 answers each rule of dialect/rules.hpp, where the pages of its manual are cited.
#pragma once

#include "dialect/rules.hpp"
#include "dialect/series8/ranges.hpp"

namespace nc::series8 {

/// The finest unit of the control is a micrometre; numbers do not count in it.
double units_per_micrometre(double parameter);

/// G97: S is in r/min.
double speed_of_word(uint32_t value);

/// G57: R is the factor, greater than 0.
bool factor_of_word(double value, bool pointed, const RangeRules& range, double* factor);

inline constexpr Rules kRules = {
    .number = {.undotted_feed_in_least_unit = false,
               .undotted_range_is_digits = false,
               .largest_feed_mm = 1e7,
               .largest_feed_inch = 1e6,
               .largest_undotted_feed_mm = 1e7,
               .largest_undotted_feed_inch = 1e6,
               .units_per_micrometre = units_per_micrometre,
               .rounds_formulas = false},
    .block = {.distance_by_word = false,
              .whole_words_refuse_point = false,
              .stops_stand_alone = false,
              .dwell_stands_alone = false,
              .words_stand_once = false,
              .assigns_at_once = false,
              .bare_word_is_zero = true,
              .unused_words_are_faults = true},
    .auxiliary = {.most_m_codes = ~0u, .tool_change_is_pair = false},
    .spindle = {.speed_of_word = speed_of_word,
                .limits_by_coordinate_setting = true,
                .skips_repeated_codes = false,
                .radius_by_coordinate_setting = true},
    .feed = {.inch_is_ten_degrees = false, .degree_counts_as_millimetre = false, .inverse_time_is_of_block = true, .inverse_time_is_modal = true},
    .skip = {.feed_is_modal = true, .change_required = true},
    .arc = {.takes_rotary_axes = true,
            .degree_is_tenth_of_inch = false,
            .turns_exclude_radius = false,
            .closed_by_radius_is_fault = false,
            .turns_count_last = false,
            .radius_is_modal = true,
            .short_radius_is_half_chord = true,
            .centre_by_quadrant = true,
            .radius_excludes_centre = true},
    .dwell = {.time_optional = false, .early_x_is_length = false, .longest_s = 1e6, .x_is_seconds = true},
    .compensation = {.xy_plane_only = false,  // G17: any plane
                     .plane_is_fixed = true,
                     .bars_systems_and_data = true,
                     .bars_reference_return = true,
                     .may_change_side = true,
                     .vector_by_words = false,
                     .takes_changed_amounts = true,
                     .code_alone_waits = true,
                     .number_is_that_of_tool = false,
                     .begins_beside_start = true,
                     .arc_below_deg = 70},
    .length = {.axis_by_words = false,
               .number_in_any_block = false,
               .zero_is_number = true,
               .moves_at_once = false,
               .shifts_reading = false,
               .number_is_that_of_tool = false,
               .axis_on_plane = false},
    .cycle = {.beside = CycleBeside::last,
              .xy_plane_only = true,
              .takes_rotary_axes = true,  // G80: "if the machine has rotary axes, they are positioned also"
              .needs_turning_spindle = false,
              .without_bottom_positions = false,
              .r_takes_sign_of_z = false,
              .others_keep_motion_mode = false,
              .fixed_clearance_mm = 1.27,  // G83: 0.050 inch
              .dwell_in_seconds = true,
              .begins_with_both_levels = true,
              .rises_before_positioning = false,
              .longest_dwell_ms = 1e9,
              .ends_at_r = true,
              .levels_outlive_mode = true,
              .tap_follows_spindle = true,
              .tap_has_lead_word = true,
              .takes_length_number = true,
              .q_is_shift = true,  // G88, G89
              .bottom_is_below_r = true},
    .reference = {.remembered_axes_go = false,
                  .forgets_with_program = true,
                  .takes_rotary_axes = true,
                  .cancels_length = false,
                  .all_axes_without_words = false},
    .coordinate = {.machine_move_may_be_incremental = false,
                   .machine_code_ends_shift = false,
                   .machine_move_by_motion = true,
                   .incremental_machine_move_rests = false,
                   .machine_move_is_absolute = true,
                   .shift_ends_with_program = true},
    .scaling = {.all_linear_axes = false, .factor_required = true, .factor_of_word = factor_of_word, .factor_by_axis = false, .arcs_may_be_uneven = false,
                .about_zero = true, .binds_plane = true},
    .data_input = {.incremental_adds = false,
                   .system_required = true,
                   .axes_required = false,
                   .vector_turns_work = false,
                   .zero_is_selected_system = false,
                   .amount_turns_system = false},
    .program = {.macro_interrupt = false, .motion_outlives_end = false, .loops_in_one_another = 0, .main_program_counts = false, .no_call_in_mdi = false,
                .sub_programs_in_one_another = 0},
    .motion = {.accuracy_limits = nullptr, .accuracy_joint_speed = nullptr, .spline_speed_mm_min = nullptr, .filter_times = nullptr, .second_code_rests = true},
    .rotation = {.plane_in_block = false, .angle_by_parameter = false, .about_zero = true},
    .mill = {.rotary_in_block = false, .polar_cuts_only = false},
    .code_call = {.first_of_g = 0, .first_of_m = 0, .arguments_behind_m = false, .tool_program = nullptr},
    .range = kRanges,
};

}  // namespace nc::series8
