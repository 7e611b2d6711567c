// SPDX-License-Identifier: Apache-2.0
// How the iso family answers each rule of dialect/rules.hpp, where most of the sections are cited.
#pragma once

#include "dialect/iso/ranges.hpp"
#include "dialect/rules.hpp"

namespace nc::iso {

/// RS-274/NGC 3.3.2.1: numbers do not count in a setting unit. Where the control needs a finest unit, it is a micrometre.
double units_per_micrometre(double parameter);

/// RS-274/NGC 3.7.2: S is in r/min.
double speed_of_word(uint32_t value);

/// Not used: the family has no scaling.
bool factor_of_word(double value, bool pointed, const RangeRules& range, double* factor);

inline constexpr Rules kRules = {
    .number = {.undotted_feed_in_least_unit = false,
               .undotted_range_is_digits = false,
               .largest_feed_mm = 1e7,
               .largest_feed_inch = 1e6,
               .largest_undotted_feed_mm = 1e7,
               .largest_undotted_feed_inch = 1e6,
               .units_per_micrometre = units_per_micrometre,
               .rounds_formulas = false,
               .positions_as_calculated = true,
               .variable_numbers_within = 1e-4},
    .block = {.distance_by_word = false,  // RS-274/NGC 3.8: the distance mode is set before anything moves
              .whole_words_refuse_point = false,
              .whole_words_within = 1e-4,
              .stops_stand_alone = false,
              .dwell_stands_alone = false,
              .words_stand_once = true,
              .assigns_at_once = true,
              .unused_words_are_faults = true,
              .unit_keeps_speed = true},
    .auxiliary = {.most_m_codes = ~0u, .tool_change_is_pair = false},  // RS-274/NGC 3.6.3: T selects the tool, M6 changes it
    .spindle = {.speed_of_word = speed_of_word,
                .limits_by_coordinate_setting = false,
                .skips_repeated_codes = false,
                .limit_beside_surface = true,
                .speed_is_real = true},
    .feed = {.inch_is_ten_degrees = false,
             .degree_counts_as_millimetre = false,  // RS-274/NGC 2.1.2.5: F is the speed of X Y Z if one of them moves
             .inverse_time_is_of_block = true},
    .skip = {.feed_is_modal = true, .change_required = true},
    .arc = {.takes_rotary_axes = true,
            .degree_is_tenth_of_inch = false,
            .turns_exclude_radius = false,
            .closed_by_radius_is_fault = true,
            .turns_count_last = true,
            .radius_excludes_centre = true},  // LinuxCNC G2: mixed formats are an error
    .dwell = {.time_optional = false, .early_x_is_length = false, .longest_s = 1e6, .x_is_seconds = false, .refuses_axes = true},
    .compensation = {.xy_plane_only = false,  // LinuxCNC G41: G17 and G18
                     .plane_is_fixed = true,  // RS-274/NGC 3.5.10: no change of the plane
                     .end_is_at_once = true,
                     .bars_systems_and_data = true,  // RS-274/NGC 3.5.13, 3.5.18
                     .bars_reference_return = true,  // RS-274/NGC 3.5.8
                     .may_change_side = false,       // RS-274/NGC 3.5.10: an error while compensation is on
                     .vector_by_words = false,
                     .takes_changed_amounts = false,
                     .code_alone_waits = true,
                     .number_is_that_of_tool = true,
                     .number_in_any_block = false,
                     .bars_reading_position = true,  // LinuxCNC #5420
                     .bars_tool_change = true},      // LinuxCNC M6
    .length = {.axis_by_words = false,  // RS-274/NGC 3.5.11: Z
               .number_in_any_block = false,
               .zero_is_number = true,  // the tool in the spindle may be 0, none
               .moves_at_once = false,
               .shifts_reading = true,
               .stands_beside_arc = true,
               .number_is_that_of_tool = true,
               .axis_on_plane = false},
    .cycle = {.beside = CycleBeside::fault,
              .xy_plane_only = false,
              .takes_rotary_axes = false,  // RS-274/NGC 3.5.16: an error
              .needs_turning_spindle = false,
              .without_bottom_positions = false,
              .r_takes_sign_of_z = false,
              .others_keep_motion_mode = false,
              .fixed_clearance_mm = 0.254,  // LinuxCNC G83, G73: a hundredth of an inch
              .dwell_in_seconds = true,
              .begins_with_both_levels = true,
              .rises_before_positioning = true,
              .longest_dwell_ms = 1e9,
              .keeps_spindle_direction = true,
              .axis_follows_plane = true,
              .data = HoleData::of_cycle,
              .levels_by_mode_of_hole = true,
              .step_dwells = false,
              .bottom_is_below_r = true,
              .peck_is_positive = true,
              .repeats_from_one = true,
              .end_is_motion = true},
    .reference = {.remembered_axes_go = false,
                  .forgets_with_program = true,
                  .takes_rotary_axes = true,
                  .cancels_length = false,
                  .all_axes_without_words = true},
    .coordinate = {.machine_move_may_be_incremental = false,  // LinuxCNC G53: an error in G91
                   .machine_code_ends_shift = false,
                   .machine_move_by_motion = true,
               .incremental_machine_move_rests = false,
               .setting_needs_axes = true},
    .scaling = {.all_linear_axes = false, .factor_required = true, .factor_of_word = factor_of_word,
               .factor_by_axis = false, .arcs_may_be_uneven = false},
    .data_input = {.incremental_adds = false,
                   .system_required = true,
                   .axes_required = false,
                   .vector_turns_work = false,
                   .zero_is_selected_system = true,
                   .amount_turns_system = true},
    .program = {.macro_interrupt = false, .motion_outlives_end = false,
               .loops_in_one_another = 0,
               .main_program_counts = false, .no_call_in_mdi = false, .sub_programs_in_one_another = 0},
    .motion = {.accuracy_limits = nullptr, .accuracy_joint_speed = nullptr, .spline_speed_mm_min = nullptr, .filter_times = nullptr, .lead_along_path = true},
    .rotation = {.plane_in_block = false, .angle_by_parameter = false},
    .mill = {.rotary_in_block = false, .polar_cuts_only = false},
    .code_call = {.first_of_g = 0, .first_of_m = 0, .arguments_behind_m = false, .tool_program = nullptr},
    .range = kRanges,
};

}  // namespace nc::iso
