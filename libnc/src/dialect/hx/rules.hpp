// SPDX-License-Identifier: Apache-2.0
// How the HX family answers each rule of dialect/rules.hpp, where the sections of its manual stand.
#pragma once

#include "dialect/hx/ranges.hpp"
#include "dialect/rules.hpp"

namespace nc::hx {

/// 8.4: a micrometre.
double units_per_micrometre(double parameter);

/// 9.2: S is r/min.
double speed_of_word(uint32_t value);

/// 15.2.1: thousandths, with or without a point.
bool factor_of_word(double value, bool pointed, const RangeRules& range, double* factor);

/// 10.1.1, 14.1.6: with PI 106 a tool number calls program 9000 + PI 105, with PI 105 alone program 9000.
uint32_t tool_program(double pi_105, double pi_106);

inline constexpr Rules kRules = {
    .number = {.undotted_feed_in_least_unit = false,
               .undotted_range_is_digits = false,
               .largest_feed_mm = 1e7,
               .largest_feed_inch = 1e6,
               .largest_undotted_feed_mm = 1e7,
               .largest_undotted_feed_inch = 1e6,
               .units_per_micrometre = units_per_micrometre,
               .rounds_formulas = true},
    .block = {.distance_by_word = false,  // 8.1, 8.2
              .whole_words_refuse_point = false,
              .whole_words_within = 0,
              .stops_stand_alone = false,
              .dwell_stands_alone = false,
              .words_stand_once = false,  // 14.1.1 (3): the last one counts
              .assigns_at_once = false,
              .unused_words_are_faults = true,
              .corner_words_exclude = true},
    .auxiliary = {.most_m_codes = ~0u, .tool_change_is_pair = false},
    .spindle = {.speed_of_word = speed_of_word,
                .limits_by_coordinate_setting = true,  // 9.3
                .skips_repeated_codes = false},
    .feed = {.inch_is_ten_degrees = false, .degree_counts_as_millimetre = true, .inverse_time_is_of_block = false, .no_way_needs_none = true},
    .skip = {.feed_is_modal = true, .measurement_stores = true, .measurement_sets_length = true, .measurement_needs_values = true},  // 4.9: like G01
    .arc = {.takes_rotary_axes = true,
            .degree_is_tenth_of_inch = false,
            .turns_exclude_radius = false,
            .closed_by_radius_is_fault = true,  // 4.4: no 360 degrees by R
            .turns_count_last = false},
    .dwell = {.time_optional = true, .early_x_is_length = false, .longest_s = 99999.999, .x_is_seconds = true},  // 14.2.3 prints "G04;"
    .compensation = {.xy_plane_only = false,  // 7.4
                     .plane_is_fixed = true,
                     .bars_systems_and_data = false,  // 13.2.2 (3)
                     .bars_reference_return = false,
                     .may_change_side = true,  // 13.2.2 (3)
                     .vector_by_words = true,  // 13.2.2 (4)
                     .takes_changed_amounts = true,
                     .code_alone_waits = true,  // 13.2.2 (1): N7 G41 X0 of the printed program
                     .number_is_that_of_tool = false,
                     .number_may_be_missing = true,  // 4.6, 15.4.2
                     .side_changes_on_arc = true,  // 13.2.2 (3)
                     .bars_position_offset = true,
                     .position_offset_is_of_motion = true},
    .length = {.axis_by_words = false,
               .number_in_any_block = true,
               .zero_is_number = true,  // 13.1.1: H00 cancels
               .moves_at_once = true,
               .shifts_reading = false,
               .number_is_that_of_tool = false,
               .axis_on_plane = true},
    .cycle = {.beside = CycleBeside::last,
              .xy_plane_only = false,
              .takes_rotary_axes = true,
              .needs_turning_spindle = false,
              .without_bottom_positions = false,
              .r_takes_sign_of_z = false,  // 12.1.3
              .others_keep_motion_mode = false,
              .fixed_clearance_mm = 0,  // 12.3.3, 12.3.4: PI 129
              .dwell_in_seconds = false,
              .begins_with_both_levels = false,
              .rises_before_positioning = false,
              .longest_dwell_ms = 99999999,
              .q_is_shift = true,
              .words_of_all = true,  // 12.3.9, 12.3.10
              .bore_stop_dwells = false,       // 12.3.8
              .step_dwells = false,            // 12.3.4
              .bore_waits_for_hand = true,     // 12.3.11
              .back_bore_is_upwards = true,    // 12.3.10
              .count_is_no_shift = true},      // 12.3.9
    .reference = {.remembered_axes_go = false,  // 6.1
                  .forgets_with_program = false,
                  .takes_rotary_axes = true,
                  .cancels_length = false,
                  .place_is_checked = true,
                  .all_axes_without_words = false},
    .coordinate = {.machine_move_may_be_incremental = false,
                   .machine_code_ends_shift = false,
                   .machine_move_by_motion = false,
                   .incremental_machine_move_rests = true,
                   .pole_stays = true,
                   .stroke_check_sees_way = true,
                   .stroke_check_needs_area = true},
    .scaling = {.all_linear_axes = true,  // 15.2.1: about the point of G51 where no word names it
                .factor_required = false,
                .factor_of_word = factor_of_word,
                .factor_by_axis = true, .arcs_may_be_uneven = true},
    .data_input = {.variables_in_unit = true,
                   .incremental_adds = true,  // 13.1.3
                   .system_required = true,
                   .axes_required = true,
                   .vector_turns_work = false,
                   .zero_is_selected_system = false,
                   .amount_turns_system = false},
    .program = {.macro_interrupt = false, .motion_outlives_end = false, .loops_in_one_another = 3, .main_program_counts = true,
                .modal_end_may_stand_alone = true, .no_call_in_mdi = true, .sub_programs_in_one_another = 4},
    .motion = {.accuracy_limits = nullptr, .accuracy_joint_speed = nullptr, .spline_speed_mm_min = nullptr, .filter_times = nullptr},
    .rotation = {.plane_in_block = true, .angle_by_parameter = true, .centre_is_scaled = true},
    .mill = {.rotary_in_block = true, .polar_cuts_only = true, .bars_scaling = true},
    .code_call = {.first_of_g = 9010, .first_of_m = 9020, .arguments_behind_m = true, .tool_program = tool_program,
                  .tool_variable = 149, .one_in_block = true},
    .stitch = {.call = 1u << 31, .done = 1u << 30, .next_may = 1u << 31},  // PPF #7531, PPE #7030, NPFIN #7031: the manual gives them no numbers
    .range = kRanges,
};

}  // namespace nc::hx
