// SPDX-License-Identifier: Apache-2.0
// Which address of the iso family carries which meaning, from RS-274/NGC 3.3.2.1, table 2, and the formats of the functions.
#pragma once

#include "dialect/role.hpp"

namespace nc::iso {

inline constexpr RoleRow kRoleRows[] = {
    {Role::code, 'G'},
    {Role::misc_code, 'M'},
    {Role::sequence_number, 'N'},
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
    {Role::arc_radius, 'R'},      // G2, G3
    {Role::arc_turns, 'P'},
    {Role::thread_lead, 'K'},     // G33
    {Role::dwell_time, 'P'},      // G4
    {Role::cycle_level, 'R'},     // G73, G81 to G89
    {Role::cycle_depth_step, 'Q'},
    {Role::cycle_dwell, 'P'},
    {Role::cycle_count, 'L'},
    {Role::input_kind, 'L'},      // G10
    {Role::input_number, 'P'},
    {Role::input_amount, 'R'},
    {Role::clamp_highest, 'D'},   // G96
    {Role::output_number, 'P'},   // M62 to M66
    {Role::word_number, 'E'},     // M66 to M68
    {Role::word_value, 'Q'},
    {Role::input_wait, 'L'},      // M66
    {Role::input_limit, 'Q'},
    {Role::override_switch, 'P'}, // M50 to M53
    {Role::named_tool, 'Q'},      // M61
    {Role::orient_angle, 'R'},    // M19
    {Role::path_tolerance, 'P'},  // G64
    {Role::line_tolerance, 'Q'},
};
inline constexpr AddressTable kAddressTable(kRoleRows);

}  // namespace nc::iso
