// SPDX-License-Identifier: Apache-2.0
// The settings of the iso family. The "parameters" of RS-274/NGC are variables of programs (variables.cpp). It has no numbers for what a machine
// sets in the control.
#include "dialect/iso/tables.hpp"

namespace nc::iso {
namespace {

using P = Parameter;

constexpr ParameterName kNames[] = {
    {"power_on_unit", P::start_inch, 0, 0, "mm|inch", nullptr, "unit of length at power on", "LinuxCNC G20, G21"},
};

// Values for which other families have a parameter and this one has none.
constexpr FixedParameter kFixed[] = {
    {P::decimal_type_2, 1},    // RS-274/NGC 3.3.2.1: a number without a point is in mm, inch, deg or s, as one with it
    {P::dwell_p_decimal, 1},   // RS-274/NGC 3.5.4: P is in seconds and may have a point
    {P::tool_memory_type, 2},  // RS-274/NGC 3.2.2: the tool table has a length and a diameter of each tool
};

}  // namespace

constinit const FamilyParameters kParameters = {
    .names = {kNames, sizeof kNames / sizeof kNames[0]},
    .fixed = {kFixed, sizeof kFixed / sizeof kFixed[0]},
    .arc_tolerance_mm = 0.005,         // LinuxCNC G2, G3: 0.005 mm, or a thousandth of the radius if that is more, never more than 0.5 mm
    .arc_tolerance_of_radius = 0.001,
    .arc_tolerance_most_mm = 0.5,
    .checks_interference = true,       // LinuxCNC "Tool Compensation": gouging is an error
};

}  // namespace nc::iso
