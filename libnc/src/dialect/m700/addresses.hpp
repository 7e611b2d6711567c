// SPDX-License-Identifier: Apache-2.0
// Which address of the m700 family carries which meaning, from chapter 3.2 and the formats of the functions. Numbers in comments are sections
// of the manual.
#pragma once

#include "dialect/role.hpp"

namespace nc::m700 {

inline constexpr RoleRow kRoleRows[] = {
    {Role::code, 'G'},
    {Role::misc_code, 'M'},
    {Role::sequence_number, 'N'},
    {Role::program_number, 'O'},
    {Role::feed, 'F'},
    {Role::spindle_speed, 'S'},
    {Role::tool, 'T'},
    {Role::second_function, 'B'},    // 9.2: #1170, which would choose it, is not built, so B comes first
    {Role::second_function_2, 'A'},
    {Role::second_function_3, 'C'},
    {Role::offset_number, 'D'},      // 12.4
    {Role::length_number, 'H'},      // 12.2
    {Role::basic_x, 'X'},
    {Role::basic_y, 'Y'},
    {Role::basic_z, 'Z'},
    {Role::vector_x, 'I'},
    {Role::vector_y, 'J'},
    {Role::vector_z, 'K'},
    {Role::arc_radius, 'R'},         // 6.4
    {Role::arc_turns, 'P'},          // 6.6
    {Role::spiral_pitches, 'L'},     // 6.13
    {Role::spiral_step, 'Q'},
    {Role::helix_pitches, 'P'},
    {Role::thread_lead, 'F'},        // 6.7
    {Role::fine_thread_lead, 'E'},
    {Role::thread_start, 'Q'},
    {Role::taper_angle, 'I'},        // 6.11
    {Role::torsion_angle, 'J'},
    {Role::exponential_radius, 'R'},
    {Role::exponential_end_feed, 'Q'},
    {Role::curve_order, 'P'},        // 6.15
    {Role::curve_knot, 'K'},
    {Role::curve_weight, 'R'},
    {Role::circle_radius, 'I'},      // 13.10
    {Role::line_angle, 'A'},         // 13.8
    {Role::meeting_choice, 'H'},     // 13.9
    {Role::meeting_center, 'P'},
    {Role::meeting_center_2, 'Q'},
    {Role::turn_x, 'A'},             // 12.3
    {Role::turn_y, 'B'},
    {Role::turn_z, 'C'},
    {Role::dwell_seconds, 'X'},      // 8.1
    {Role::dwell_time, 'P'},
    {Role::cycle_level, 'R'},        // 13.1.1
    {Role::cycle_depth_step, 'Q'},
    {Role::cycle_dwell, 'P'},
    {Role::cycle_count, 'K'},        // 5.3
    {Role::cycle_count_2, 'L'},      // 13.1.1: counts if K is there, too
    {Role::call_program, 'P'},       // 13.3.1, 13.5.1
    {Role::call_repeats, 'L'},
    {Role::call_sequence, 'H'},
    {Role::call_option, 'Q'},
    {Role::return_sequence, 'P'},
    {Role::return_passes, 'L'},
    {Role::interrupt_program, 'P'},  // 13.12
    {Role::loop_number, 'D'},        // 13.5.7: DO m
    {Role::loop_end, 'E'},           // END m
    {Role::port, 'D'},               // 13.5.8: DPRNT
    {Role::binary_port, 'B'},        // BPRNT
    {Role::input_kind, 'L'},         // G10: 12.7, 14.10
    {Role::input_number, 'P'},
    {Role::input_amount, 'R'},
    {Role::turn_angle, 'K'},         // 13.21
    {Role::system_number, 'P'},      // 14.10
    {Role::parameter_number, 'P'},   // 13.11
    {Role::parameter_system, 'S'},
    {Role::parameter_axis, 'A'},
    {Role::parameter_bit, 'H'},
    {Role::parameter_data, 'D'},
    {Role::scaling_factor, 'P'},     // 13.19
    {Role::rotation_angle, 'R'},     // 13.20
    {Role::return_place, 'P'},       // 14.8, 14.9
    {Role::option_in_position, 'I'}, // 6.1, 6.2
    {Role::option_in_position_drill, 'J'},  // 13.1.1
    {Role::option_device, 'D'},      // 13.3.1
    {Role::option_chamfer, 'C'},     // 13.7
    {Role::option_corner_radius, 'R'},
    {Role::option_angle, 'A'},       // 13.8
    {Role::clamp_highest, 'S'},      // 10.4
    {Role::clamp_lowest, 'Q'},
    {Role::surface_axis, 'P'},       // 10.3
    {Role::skip_signals, 'P'},       // 15.3
    {Role::measure_deceleration, 'R'},  // 15.1
    {Role::measure_range, 'D'},
    {Role::speed_mode, 'P'},         // 13.14, 13.17
    {Role::speed_option, 'Q'},
    {Role::accuracy_switch, 'P'},    // 13.15
    {Role::option_tap_control, 'R'}, // 13.1.1
    {Role::option_return_speed, 'S'},
    {Role::tap_ridges, 'E'},         // appendix 1, P183
    {Role::hole_interval, 'I'},      // 13.2
    {Role::hole_angle, 'J'},
    {Role::hole_angle_step, 'P'},
    {Role::hole_columns, 'P'},
    {Role::hole_interval_2, 'J'},
    {Role::hole_count, 'K'},
    {Role::life_group, 'P'},         // field practice (docs/decisions.md)
    {Role::life_span, 'L'},
    {Role::life_method, 'Q'},
    {Role::life_tool, 'T'},
    {Role::life_length, 'H'},
    {Role::life_radius, 'D'},
};
inline constexpr AddressTable kAddressTable(kRoleRows);

/// Local variable of each address (13.5.1, designation I). G, L, N, O and P are arguments only in the mode of G66.1.
inline constexpr uint8_t kArgumentOf[kAddresses] = {/*A*/ 1,  /*B*/ 2,  /*C*/ 3,  /*D*/ 7,  /*E*/ 8,  /*F*/ 9,  /*G*/ 10, /*H*/ 11, /*I*/ 4,
                                            /*J*/ 5,  /*K*/ 6,  /*L*/ 12, /*M*/ 13, /*N*/ 14, /*O*/ 15, /*P*/ 16, /*Q*/ 17, /*R*/ 18,
                                            /*S*/ 19, /*T*/ 20, /*U*/ 21, /*V*/ 22, /*W*/ 23, /*X*/ 24, /*Y*/ 25, /*Z*/ 26};

}  // namespace nc::m700
