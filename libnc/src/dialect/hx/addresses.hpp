// SPDX-License-Identifier: Apache-2.0
// Which address of the HX family carries which meaning: chapter 2.2.1 and the formats of the functions.
#pragma once

#include "dialect/role.hpp"

namespace nc::hx {

inline constexpr RoleRow kRoleRows[] = {
    {Role::code, 'G'},
    {Role::misc_code, 'M'},
    {Role::sequence_number, 'N'},
    {Role::program_number, 'O'},
    {Role::feed, 'F'},
    {Role::spindle_speed, 'S'},
    {Role::tool, 'T'},
    {Role::offset_number, 'D'},         // 13.2, 13.3
    {Role::length_number, 'H'},         // 13.1.1
    {Role::basic_x, 'X'},
    {Role::basic_y, 'Y'},
    {Role::basic_z, 'Z'},
    {Role::vector_x, 'I'},
    {Role::vector_y, 'J'},
    {Role::vector_z, 'K'},
    {Role::arc_radius, 'R'},            // 4.4
    {Role::thread_lead, 'F'},           // 4.8
    {Role::dwell_seconds, 'X'},         // 5.4
    {Role::dwell_time, 'P'},
    {Role::cycle_level, 'R'},           // 12.1.2
    {Role::cycle_depth_step, 'Q'},
    {Role::cycle_dwell, 'P'},
    {Role::cycle_count, 'K'},
    {Role::cycle_count_2, 'L'},         // 12.2.2 writes L(K)
    {Role::call_program, 'P'},          // 2.4.3, 14.1.1
    {Role::call_repeats, 'L'},
    {Role::call_sequence, 'Q'},
    {Role::call_end_sequence, 'R'},
    {Role::return_sequence, 'P'},
    {Role::return_passes, 'L'},
    {Role::loop_number, 'D'},           // 14.2.5: DO m
    {Role::loop_end, 'E'},              // END m
    {Role::input_kind, 'L'},            // 13.1.3
    {Role::input_number, 'P'},
    {Role::input_amount, 'R'},
    {Role::scaling_factor, 'P'},        // 15.2.1
    {Role::rotation_angle, 'R'},        // 15.4.1
    {Role::return_place, 'P'},          // 6.2
    {Role::option_chamfer, 'C'},        // 4.3.1
    {Role::option_corner_radius, 'R'},  // 4.3.2
    {Role::clamp_highest, 'S'},         // 9.3
};
inline constexpr AddressTable kAddressTable(kRoleRows);

/// 14.1.1 (1): G L N O P are no arguments.
inline constexpr uint8_t kArgumentOf[kAddresses] = {/*A*/ 1,  /*B*/ 2,  /*C*/ 3,  /*D*/ 7, /*E*/ 8, /*F*/ 9, /*G*/ 0,  /*H*/ 11, /*I*/ 4,
                                            /*J*/ 5,  /*K*/ 6,  /*L*/ 0,  /*M*/ 13, /*N*/ 0, /*O*/ 0, /*P*/ 0,  /*Q*/ 17, /*R*/ 18,
                                            /*S*/ 19, /*T*/ 20, /*U*/ 21, /*V*/ 22, /*W*/ 23, /*X*/ 24, /*Y*/ 25, /*Z*/ 26};

}  // namespace nc::hx
