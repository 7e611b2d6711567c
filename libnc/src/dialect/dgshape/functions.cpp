// SPDX-License-Identifier: Apache-2.0
// The G codes and M codes of DGSHAPE 2-7, the list of words. The manual names its groups and does not number them. Here a group has the number
// that the M700 gives to the same group, so that a reader of a modal snapshot need not know the family:
//   1 positioning/interpolation  2 plane  3 dimension (G90 G91)  6 unit  7 tool-diameter offset  8
//   tool-length offset  9 fixed cycle 10 return point  11 scaling  12 workpiece coordinate systems  0
//   one-shot
// The group column of the printed list is shifted by a row; the groups follow the sections of the codes.
#include "dialect/dgshape/tables.hpp"

namespace nc::dgshape {

using F = Function;
using M = MiscFunction;

const FunctionRow kFunctions[] = {
    // code, group, function, alarm when not built, name, section, what of it is not built, number
    {0, 1, F::rapid, nullptr, "positioning", "G00"},
    {10, 1, F::linear, nullptr, "linear interpolation", "G01"},
    {20, 1, F::arc_cw, nullptr, "circular interpolation clockwise", "G02"},
    {30, 1, F::arc_ccw, nullptr, "circular interpolation counter-clockwise", "G03"},
    {40, 0, F::dwell, nullptr, "dwell", "G04"},
    {100, 0, F::data_input, nullptr, "offset input by program", "G10"},
    {170, 2, F::plane_xy, nullptr, "plane XY", "G17"},
    {180, 2, F::plane_zx, nullptr, "plane ZX", "G18"},
    {190, 2, F::plane_yz, nullptr, "plane YZ", "G19"},
    {200, 6, F::inch, nullptr, "inch input", "G20"},
    {210, 6, F::metric, nullptr, "millimetre input", "G21"},
    {280, 0, F::reference_return, nullptr, "return to the reference point", "G28"},
    {390, 0, F::comp_corner_turn, nullptr, "corner arc of tool-diameter offset", "G39"},
    {400, 7, F::comp_off, nullptr, "tool-diameter offset off", "G40"},
    {410, 7, F::comp_left, nullptr, "tool-diameter offset left", "G41"},
    {420, 7, F::comp_right, nullptr, "tool-diameter offset right", "G42"},
    {430, 8, F::length_plus, nullptr, "tool-length offset", "G43"},
    {490, 8, F::length_off, nullptr, "tool-length offset off", "G49"},
    {500, 11, F::scaling_off, nullptr, "scaling off", "G50"},
    {510, 11, F::scaling_on, nullptr, "scaling", "G51"},
    {530, 0, F::machine_move, nullptr, "move in machine coordinates", "G53"},
    {540, 12, F::work_system, nullptr, "workpiece coordinate system 1", "G54"},
    {550, 12, F::work_system, nullptr, "workpiece coordinate system 2", "G55", nullptr, 1},
    {560, 12, F::work_system, nullptr, "workpiece coordinate system 3", "G56", nullptr, 2},
    {570, 12, F::work_system, nullptr, "workpiece coordinate system 4", "G57", nullptr, 3},
    {580, 12, F::work_system, nullptr, "workpiece coordinate system 5", "G58", nullptr, 4},
    {590, 12, F::work_system, nullptr, "workpiece coordinate system 6", "G59", nullptr, 5},
    {800, 9, F::cycle_off, nullptr, "cycle off", "G80"},
    {810, 9, F::cycle_drill, nullptr, "drilling cycle", "G81"},
    {820, 9, F::cycle_spot, nullptr, "drilling cycle with dwell", "G82"},
    {830, 9, F::cycle_peck, nullptr, "deep hole drilling cycle", "G83"},
    {850, 9, F::cycle_bore_feed, nullptr, "boring cycle, return at feed", "G85"},
    {860, 9, F::cycle_bore_stop, nullptr, "boring cycle, return with the spindle stopped", "G86"},
    {890, 9, F::cycle_bore_dwell, nullptr, "boring cycle with dwell, return at feed", "G89"},
    {900, 3, F::absolute, nullptr, "absolute values", "G90"},
    {910, 3, F::incremental, nullptr, "incremental values", "G91"},
    {920, 0, F::coordinate_set, nullptr, "coordinate system setting", "G92"},
    {980, 10, F::return_initial, nullptr, "return to the initial level", "G98"},
    {990, 10, F::return_r, nullptr, "return to the point R level", "G99"},
};

// DGSHAPE 2-3: the M codes that the control keeps for itself. M03, M05, M06 and M12 to M17 are put out like any other M code; M98 and M99 of
// other families are no codes here.
const MiscRow kMisc[] = {
    {0, M::program_stop, nullptr, "program stop", "M00"},
    {1, M::optional_stop, nullptr, "optional stop", "M01"},
    {2, M::program_end, nullptr, "program end", "M02"},
    {30, M::program_end, nullptr, "program end", "M30"},
    {98, M::call_sub, "NC-NO-SUCH-CODE", "no sub programs in this family", "2-3"},
    {99, M::return_sub, "NC-NO-SUCH-CODE", "no sub programs in this family", "2-3"},
};

// The list is complete (2-7): any other M code, M04 among them, does not exist.
const OutputRow kOutputs[] = {
    {3, M::spindle_forward},
    {5, M::spindle_stop},
    {6, M::tool_change},
    {12, M::output},  // air blower on, off
    {13, M::output},
    {14, M::output},  // chip cleaner on, off
    {15, M::output},
    {16, M::output},  // light on, off
    {17, M::output},
};

}  // namespace nc::dgshape
