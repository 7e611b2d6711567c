// SPDX-License-Identifier: Apache-2.0
// Which address of the dgshape family carries which meaning, from DGSHAPE 1-1 and the formats of the functions.
#pragma once

#include "dialect/role.hpp"

namespace nc::dgshape {

inline constexpr RoleRow kRoleRows[] = {
    {Role::code, 'G'},
    {Role::misc_code, 'M'},
    {Role::sequence_number, 'N'},
    {Role::program_number, 'O'},
    {Role::feed, 'F'},
    {Role::spindle_speed, 'S'},
    {Role::tool, 'T'},
    {Role::offset_number, 'D'},   // G41, G42
    {Role::length_number, 'H'},   // G43
    {Role::basic_x, 'X'},
    {Role::basic_y, 'Y'},
    {Role::basic_z, 'Z'},
    {Role::vector_x, 'I'},
    {Role::vector_y, 'J'},
    {Role::vector_z, 'K'},
    {Role::turn_x, 'A'},          // 1-4: the axis that the rotary axis unit turns about
    {Role::arc_radius, 'R'},      // G02, G03
    {Role::dwell_seconds, 'X'},   // G04
    {Role::dwell_time, 'P'},
    {Role::cycle_level, 'R'},     // G80 to G89
    {Role::cycle_depth_step, 'Q'},
    {Role::cycle_dwell, 'P'},
    {Role::cycle_count, 'K'},
    {Role::input_kind, 'L'},      // G10
    {Role::input_number, 'P'},
    {Role::input_amount, 'R'},
    {Role::scaling_factor, 'P'},  // G51
};
inline constexpr AddressTable kAddressTable(kRoleRows);

}  // namespace nc::dgshape
