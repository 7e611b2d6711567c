// SPDX-License-Identifier: Apache-2.0
// How the m700 family answers each rule of dialect/rules.hpp. The sections of its manual are cited there.
#pragma once

#include "dialect/m700/accuracy.hpp"
#include "dialect/m700/filters.hpp"
#include "dialect/m700/ranges.hpp"
#include "dialect/rules.hpp"

namespace nc::m700 {

/// 2.1: the units B, C, D and E are each ten times finer than the one before. `parameter` is the letter.
double units_per_micrometre(double parameter);

/// 10.1, 10.2: S is in r/min.
double speed_of_word(uint32_t value);

/// 13.19: the least unit of the factor is 0.000001, and a number without a point counts in this unit.
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
    .block = {.distance_by_word = true,
              .whole_words_refuse_point = false,
              .stops_stand_alone = false,
              .dwell_stands_alone = false,
              .words_stand_once = false,
              .assigns_at_once = false},
    .auxiliary = {.most_m_codes = 4, .tool_change_is_pair = false},
    .spindle = {.speed_of_word = speed_of_word,
                .limits_by_coordinate_setting = true,
                .skips_repeated_codes = false},
    .feed = {.inch_is_ten_degrees = true, .degree_counts_as_millimetre = true, .inverse_time_is_of_block = false, .end_of_inverse_time_needs_feed = true},
    .skip = {.feed_is_modal = false, .keeps_axes_not_moved = true, .measurement_of_added_length = true},
    .arc = {.takes_rotary_axes = true,
            .degree_is_tenth_of_inch = true,
            .turns_exclude_radius = true,
            .closed_by_radius_is_fault = false,
            .turns_count_last = false},
    .dwell = {.time_optional = true, .early_x_is_length = true, .longest_s = 99999.999, .x_is_seconds = false},
    .compensation = {.xy_plane_only = false,
                     .plane_is_fixed = true,
                     .bars_systems_and_data = false,
                     .bars_reference_return = false,
                     .may_change_side = true,
                     .vector_by_words = true,
                     .takes_changed_amounts = true,
                     .code_alone_waits = false,
                     .number_is_that_of_tool = false,
                     .number_of_managed_tool = 99},
    .length = {.axis_by_words = true,
               .number_in_any_block = true,
               .position_offset_has_number = true,
               .zero_is_number = true,
               .moves_at_once = true,
               .shifts_reading = false,
               .number_is_that_of_tool = false,
               .axis_on_plane = false},
    .cycle = {.xy_plane_only = false,
              .takes_rotary_axes = true,
              .needs_turning_spindle = false,
              .without_bottom_positions = false,
              .r_takes_sign_of_z = true,
              .others_keep_motion_mode = true,
              .fixed_clearance_mm = 0,
              .dwell_in_seconds = false,
              .begins_with_both_levels = false,
              .rises_before_positioning = false,
              .longest_dwell_ms = 99999999,
              .keeps_spindle_direction = false,
              .axis_follows_plane = false,
              .shift_of_any_hole = true,
              .stops_over_hole = true},  // 13.1.1 (2)
    .reference = {.remembered_axes_go = false,
                  .forgets_with_program = false,
                  .takes_rotary_axes = true,
                  .cancels_length = true,
                  .hand_cancels_length = true,
                  .all_axes_without_words = false},
    .coordinate = {.machine_move_may_be_incremental = true, .machine_code_ends_shift = true, .machine_move_by_motion = false,
               .incremental_machine_move_rests = false},
    .scaling = {.all_linear_axes = false,
                .factor_required = false,
                .factor_of_word = factor_of_word,
               .factor_by_axis = false, .arcs_may_be_uneven = false},
    .data_input = {.incremental_adds = true,
                   .system_required = false,
                   .axes_required = true,
                   .vector_turns_work = true,
                   .zero_is_selected_system = false,
                   .amount_turns_system = false},
    .program = {.own_without_number = true, .macro_interrupt = true, .motion_outlives_end = true,
               .loops_in_one_another = 27,
               .main_program_counts = false, .no_call_in_mdi = false, .sub_programs_in_one_another = 8},
    .motion = {.accuracy_limits = accuracy_limits,
               .accuracy_joint_speed = joint_speed,
               .spline_speed_mm_min = spline_speed_clamp,
               .filter_times = filter_times},
    .rotation = {.plane_in_block = false, .angle_by_parameter = false},
    .mill = {.rotary_in_block = false, .polar_cuts_only = false},
    .code_call = {.first_of_g = 0, .first_of_m = 0, .arguments_behind_m = false, .tool_program = nullptr},
    .range = kRanges,
};

}  // namespace nc::m700
