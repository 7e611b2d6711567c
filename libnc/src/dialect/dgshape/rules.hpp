// SPDX-License-Identifier: Apache-2.0
// How the dgshape family answers each rule of dialect/rules.hpp. The sections of its manual are cited there.
#pragma once

#include "dialect/dgshape/ranges.hpp"
#include "dialect/rules.hpp"

namespace nc::dgshape {

/// 2-1: the unit is 0.001 mm, or 0.0001 inch; no parameter changes it.
double units_per_micrometre(double parameter);

/// 2, S: S00 to S99 are code numbers of the R20 series; from 100 on S is in r/min.
double speed_of_word(uint32_t value);

/// G51: a value outside the range of the factor becomes the nearest value in it, without a fault.
bool factor_of_word(double value, bool pointed, const RangeRules& range, double* factor);

inline constexpr Rules kRules = {
    .number = {.undotted_feed_in_least_unit = true,
               .undotted_range_is_digits = true,
               .largest_feed_mm = 99999.999,
               .largest_feed_inch = 9999.9999,
               .largest_undotted_feed_mm = 99999999,
               .largest_undotted_feed_inch = 99999999,
               .units_per_micrometre = units_per_micrometre,
               .rounds_formulas = false},
    .block = {.distance_by_word = false,
              .whole_words_refuse_point = true,
              .stops_stand_alone = true,
              .dwell_stands_alone = true,
              .words_stand_once = false,
              .assigns_at_once = false,
              .unused_words_are_faults = true,
              .unit_is_of_program = true},
    .auxiliary = {.most_m_codes = ~0u, .tool_change_is_pair = true, .codes_are_listed = true, .skips_tool_held = true},
    .spindle = {.speed_of_word = speed_of_word,
                .limits_by_coordinate_setting = false,
                .skips_repeated_codes = true},
    .feed = {.inch_is_ten_degrees = false, .degree_counts_as_millimetre = false, .inverse_time_is_of_block = false, .rotary_by_radius = true},
    .skip = {.feed_is_modal = false},
    .arc = {.takes_rotary_axes = false,
            .degree_is_tenth_of_inch = false,
            .turns_exclude_radius = false,
            .closed_by_radius_is_fault = false,
            .turns_count_last = false,
            .radius_excludes_centre = true},
    .dwell = {.time_optional = false, .early_x_is_length = false, .longest_s = 3600, .x_is_seconds = false},
    .compensation = {.xy_plane_only = true,
                     .plane_is_fixed = false,
                     .bars_systems_and_data = true,
                     .bars_reference_return = true,
                     .may_change_side = false,
                     .vector_by_words = false,
                     .takes_changed_amounts = false,
                     .code_alone_waits = true,
                     .number_is_that_of_tool = false,
                     .number_in_any_block = false,
                     .square_in_spike = true},
    .length = {.axis_by_words = false,
               .number_in_any_block = false,
               .zero_is_number = false,
               .moves_at_once = true,
               .shifts_reading = false,
               .number_is_that_of_tool = false,
               .axis_on_plane = false},
    .cycle = {.beside = CycleBeside::cycle,
              .xy_plane_only = true,
              .takes_rotary_axes = false,
              .needs_turning_spindle = true,
              .without_bottom_positions = true,
              .r_takes_sign_of_z = false,
              .others_keep_motion_mode = false,
              .fixed_clearance_mm = 1,
              .dwell_in_seconds = false,
              .begins_with_both_levels = false,
              .rises_before_positioning = false,
              .longest_dwell_ms = 3600e3,
              .keeps_spindle_direction = false,
              .axis_follows_plane = false,
              .bore_stop_dwells = false,
              .data = HoleData::of_code},
    .reference = {.remembered_axes_go = true,
                  .forgets_with_program = true,
                  .takes_rotary_axes = false,
                  .cancels_length = false,
                  .all_axes_without_words = false,
                  .may_move_nothing = true},
    .coordinate = {.machine_move_may_be_incremental = false, .machine_code_ends_shift = false, .machine_move_by_motion = false,
               .incremental_machine_move_rests = false},
    .scaling = {.all_linear_axes = true, .factor_required = true, .factor_of_word = factor_of_word,
               .factor_by_axis = false, .arcs_may_be_uneven = false},
    .data_input = {.incremental_adds = false,
                   .system_required = true,
                   .axes_required = false,
                   .vector_turns_work = false,
                   .zero_is_selected_system = false,
                   .amount_turns_system = false},
    .program = {.macro_interrupt = false, .motion_outlives_end = false,
               .loops_in_one_another = 0,
               .main_program_counts = false, .no_call_in_mdi = false, .sub_programs_in_one_another = 0},
    .motion = {.accuracy_limits = nullptr, .accuracy_joint_speed = nullptr, .spline_speed_mm_min = nullptr, .filter_times = nullptr},
    .rotation = {.plane_in_block = false, .angle_by_parameter = false},
    .mill = {.rotary_in_block = false, .polar_cuts_only = false},
    .code_call = {.first_of_g = 0, .first_of_m = 0, .arguments_behind_m = false, .tool_program = nullptr},
    .range = kRanges,
};

}  // namespace nc::dgshape
