// SPDX-License-Identifier: Apache-2.0
// The list of G codes at the head of the manual, in its order, and the M codes that its pages name. The manual has no groups: their numbers are those
// that the M700 gives to the same groups. G92, which stands in the list twice, is one row: its words say which of the two it is.
#include "dialect/series8/tables.hpp"

namespace nc::series8 {

using F = Function;
using M = MiscFunction;

const FunctionRow kFunctions[] = {
    // code, group, function, alarm when not built, name, section, what of it is not built, number
    {0, 1, F::rapid, nullptr, "rapid traverse", "G00"},
    {10, 1, F::linear, nullptr, "linear interpolation", "G01"},
    {20, 1, F::arc_cw, nullptr, "circular interpolation clockwise", "G02"},
    {30, 1, F::arc_ccw, nullptr, "circular interpolation counter-clockwise", "G03"},
    {40, 0, F::dwell, nullptr, "dwell", "G04"},
    {60, 0, F::sine_loop, nullptr, "sinusoidal loop while @RUNG6 is on", "G06", "the axes rest at the start point for the time that asking for @RUNG6 takes"},
    {100, 0, F::corner_behind, nullptr, "chamfer or arc between two lines", "G10"},
    {170, 2, F::plane_xy, nullptr, "plane XY", "G17"},
    {180, 2, F::plane_zx, nullptr, "plane ZX", "G18"},
    {190, 2, F::plane_yz, nullptr, "plane YZ", "G19"},
    {210, 1, F::linear, nullptr, "linear interpolation with sharp corners", "G21", nullptr, 1},
    {220, 1, F::arc_cw, nullptr, "circular interpolation clockwise with sharp corners", "G22", nullptr, 1},
    {230, 1, F::arc_ccw, nullptr, "circular interpolation counter-clockwise with sharp corners", "G23", nullptr, 1},
    {340, 0, F::cavity_ccw, nullptr, "rectangular cavity, counter-clockwise", "G34"},
    {350, 0, F::cavity_cw, nullptr, "rectangular cavity, clockwise", "G35"},
    {360, 0, F::cavity_circle, nullptr, "circular cavity", "G36"},
    {400, 7, F::comp_off, nullptr, "cutter radius compensation off", "G40"},
    {410, 7, F::comp_left, nullptr, "cutter radius compensation left", "G41"},
    {420, 7, F::comp_right, nullptr, "cutter radius compensation right", "G42"},
    {430, 0, F::comp_entry, nullptr, "straight entry of cutter radius compensation", "G43"},
    {490, 0, F::holes_on_frame_ccw, nullptr, "rectangular pattern, counter-clockwise", "G49"},
    {500, 0, F::holes_on_frame_cw, nullptr, "rectangular pattern, clockwise", "G50"},
    {510, 0, F::probe_once, nullptr, "probe cycle", "G51"},
    {550, 16, F::rotation_on, nullptr, "part rotation", "G55"},
    {560, 16, F::rotation_off, nullptr, "part rotation off", "G56"},
    {570, 11, F::scaling_on, nullptr, "part scaling", "G57"},
    {580, 11, F::scaling_off, nullptr, "part scaling off", "G58"},
    {670, 0, F::absolute_once, nullptr, "absolute values in this block", "G67"},
    {680, 0, F::incremental_once, nullptr, "incremental values in this block", "G68"},
    {690, 0, F::machine_move, nullptr, "machine coordinates in this block", "G69"},
    {700, 6, F::inch, nullptr, "inch", "G70"},
    {710, 6, F::metric, nullptr, "millimetres", "G71"},
    {800, 9, F::cycle_off, nullptr, "cycle off", "G80"},
    {810, 9, F::cycle_drill, nullptr, "drilling cycle", "G81"},
    {820, 9, F::cycle_spot, nullptr, "drilling cycle with dwell", "G82"},
    {830, 9, F::cycle_peck, nullptr, "deep hole drilling cycle", "G83"},
    {840, 9, F::cycle_tap, nullptr, "tapping cycle", "G84"},
    {850, 9, F::cycle_bore_dwell, nullptr, "boring cycle with dwell, back at feed", "G85"},
    {860, 9, F::cycle_bore_restart, nullptr, "boring cycle, back in rapid with the spindle stopped", "G86"},
    {870, 9, F::cycle_case_bore, nullptr, "case boring cycle", "G87"},
    {880, 9, F::cycle_bore_oriented, nullptr, "boring cycle with dwell, back in rapid with the spindle oriented", "G88"},
    {890, 9, F::cycle_face_upwards, nullptr, "reversed facing cycle", "G89"},
    {900, 3, F::absolute, nullptr, "absolute values", "G90"},
    {910, 3, F::incremental, nullptr, "incremental values", "G91"},
    {920, 0, F::coordinate_set, nullptr, "program zero; radius and limit of constant surface speed", "G92"},
    {930, 5, F::inverse_time_feed, nullptr, "inverse time feed", "G93"},
    {940, 5, F::feed_per_minute, nullptr, "feed per minute", "G94"},
    {950, 5, F::feed_per_revolution, nullptr, "feed per revolution", "G95"},
    {960, 17, F::surface_on, nullptr, "constant surface speed", "G96"},
    {970, 17, F::surface_off, nullptr, "spindle speed in r/min", "G97"},
    {980, 0, F::coordinate_set, nullptr, "program zero", "G98", nullptr, 1},
};

const MiscRow kMisc[] = {
    {0, M::program_stop, nullptr, "program stop", "M00"},
    {1, M::optional_stop, nullptr, "optional stop", "M01"},
    {2, M::program_end, nullptr, "program end", "M02"},
    {30, M::program_end, nullptr, "program end", "M30"},
    {73, M::machine_output, "NC-NOT-BUILT", "tapping with air", "G84"},
    {74, M::machine_output, "NC-NOT-BUILT", "tapping with air", "G84"},
    {98, M::call_sub, "NC-NO-SUCH-CODE", "no sub programs in this family", ""},
    {99, M::return_sub, "NC-NO-SUCH-CODE", "no sub programs in this family", ""},
};

// M codes that are put out and also mean something to the control.
const OutputRow kOutputs[] = {
    {3, M::spindle_forward},
    {4, M::spindle_reverse},
    {5, M::spindle_stop},
    {6, M::tool_change},
    {19, M::spindle_oriented},  // G88, G89
    {58, M::surface_resume},
    {59, M::surface_hold},
};

}  // namespace nc::series8
