// SPDX-License-Identifier: Apache-2.0
// The settings of the Series 8. The manual speaks of a parameter editor and names no parameter; it has no variables either.
#include "dialect/series8/tables.hpp"

namespace nc::series8 {
namespace {

using P = Parameter;

constexpr ParameterName kNames[] = {
    {"power_on_plane", P::start_plane, 0, 0, "mill|G17|G18|G19", nullptr, "plane at power on, of a lathe G19", "G17"},
    {"power_on_unit", P::start_inch, 0, 0, "mm|inch", nullptr, "unit of length at power on", "G70"},
    {"tool_table", P::diameter_offsets, 0, 0, "radius|diameter", nullptr, "what the tool table holds of a cutter", "G41"},
};

// Values for which other families have a parameter and this one has none.
constexpr FixedParameter kFixed[] = {
    {P::decimal_type_2, 1},          // G00: X5 is five millimetres or inches
    {P::dwell_p_decimal, 1},         // G04: F is in seconds
    {P::dwell_in_revolutions, 1},    // G04
    {P::tool_memory_type, 2},        // G41, G81: a diameter and a length for each D
    {P::clamp_command_always, 1},    // G92 S
    {P::clamp_in_surface_speed, 1},  // G92 S: while G96 is in force
};

// Programs have no variables. The rows give the first input of the macro interface, and what the machine is told of the spindle, the names that the manual has
// for them.
constexpr VariableRow kRows[] = {
    {1000, 1000, SystemVariable::input_bit, 0, 0, "0/1", "@RUNG6 keeps the loop of G06 going", "G06"},
    {1100, 1100, SystemVariable::speed_code, 0, 0, "r/min", "@SCODE the S code, for the machine", "G96"},
    {1101, 1101, SystemVariable::spindle_speed, 0, 0, "r/min", "@LCRPM the speed that the spindle is wanted at, in G96, too, for the machine", "G96"},
};

}  // namespace

constinit const FamilyParameters kParameters = {
    .names = kNames,
    .fixed = kFixed,
    .arc_tolerance_mm = 0.0254,   // docs/decisions.md
    .checks_interference = true,  // G41: the control looks ahead so as not to gouge the part
};

constinit const FamilyVariables kVariables = {.rows = kRows};

}  // namespace nc::series8
