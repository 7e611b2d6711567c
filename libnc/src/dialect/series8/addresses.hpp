// SPDX-License-Identifier: Apache-2.0
// Which address of the Series 8 carries which meaning, from the formats of the functions. Those of G34 to G36, G49 and G50, of which the manual has the
// titles alone, are in docs/series8.md.
#pragma once

#include "dialect/role.hpp"

namespace nc::series8 {

inline constexpr RoleRow kRoleRows[] = {
    {Role::code, 'G'},
    {Role::misc_code, 'M'},
    {Role::sequence_number, 'N'},
    {Role::feed, 'F'},
    {Role::spindle_speed, 'S'},
    {Role::tool, 'T'},
    {Role::offset_number, 'D'},          // G41; of the length of the tool in G81 to G89
    {Role::basic_x, 'X'},
    {Role::basic_y, 'Y'},
    {Role::basic_z, 'Z'},
    {Role::vector_x, 'I'},               // G02, G88
    {Role::vector_y, 'J'},
    {Role::vector_z, 'K'},
    {Role::arc_radius, 'R'},             // G02
    {Role::dwell_seconds, 'X'},          // G04
    {Role::dwell_time, 'F'},
    {Role::option_corner_radius, 'R'},   // G10
    {Role::option_chamfer, 'L'},
    {Role::rotation_angle, 'R'},         // G55
    {Role::scaling_factor, 'R'},         // G57
    {Role::cycle_level, 'R'},            // G81
    {Role::cycle_dwell, 'P'},            // G82
    {Role::cycle_first_depth, 'I'},      // G83
    {Role::cycle_depth_step, 'J'},
    {Role::tap_lead, 'K'},               // G84
    {Role::clamp_highest, 'S'},          // G92
    {Role::surface_radius, 'R'},
    {Role::cavity_length, 'I'},          // G34, G35; G36: the radius
    {Role::cavity_width, 'J'},
    {Role::cavity_cut, 'K'},
    {Role::cavity_step, 'Q'},
    {Role::cavity_corner, 'P'},
    {Role::hole_interval, 'I'},          // G49, G50
    {Role::hole_interval_2, 'J'},
    {Role::hole_columns, 'K'},
    {Role::hole_count, 'L'},
};
inline constexpr AddressTable kAddressTable(kRoleRows);

}  // namespace nc::series8
