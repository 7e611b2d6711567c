// SPDX-License-Identifier: Apache-2.0
// The G and M codes of the iso family: RS-274/NGC 3.5 and 3.6, and the codes that LinuxCNC has in addition. The groups are those of RS-274/NGC
// 3.4, table 4, and of LinuxCNC (4 arc distance mode, 13 path control, 14 spindle speed mode), except for the cycles. Those are in group 1
// there and stay in force until G80 or a motion code ends them. Here they are a mode of their own, with the group number that other families
// give it.
#include "dialect/iso/tables.hpp"

namespace nc::iso {

using F = Function;
using M = MiscFunction;

const FunctionRow kFunctions[] = {
    // code, group, function, alarm when not built, name, section, what of it is not built, number
    {0, 1, F::rapid, nullptr, "rapid positioning", "RS-274/NGC 3.5.1"},
    {10, 1, F::linear, nullptr, "linear motion at feed", "RS-274/NGC 3.5.2"},
    {20, 1, F::arc_cw, nullptr, "arc clockwise", "RS-274/NGC 3.5.3"},
    {30, 1, F::arc_ccw, nullptr, "arc counter-clockwise", "RS-274/NGC 3.5.3"},
    {40, 0, F::dwell, nullptr, "dwell", "RS-274/NGC 3.5.4"},
    {50, 0, F::spline_cubic, "NC-NOT-BUILT", "cubic spline", "LinuxCNC G5"},
    {51, 0, F::spline_quadratic, "NC-NOT-BUILT", "quadratic spline", "LinuxCNC G5.1"},
    {52, 0, F::nurbs_block, "NC-NOT-BUILT", "NURBS block", "LinuxCNC G5.2"},
    {53, 0, F::nurbs_block_end, "NC-NOT-BUILT", "end of a NURBS block", "LinuxCNC G5.3"},
    {70, 0, F::diameter_words, "NC-LATHE", "X by its diameter (lathe)", "LinuxCNC G7", "is for lathes, whose X is a diameter"},
    {80, 0, F::radius_words, "NC-LATHE", "X by its radius (lathe)", "LinuxCNC G8", "is for lathes, whose X is a diameter: here X is X"},
    {100, 0, F::data_input, nullptr, "coordinate systems by program", "RS-274/NGC 3.5.5", "L1 L10 L11 (tool table), R (rotation)"},
    {170, 2, F::plane_xy, nullptr, "plane XY", "RS-274/NGC 3.5.6"},
    {180, 2, F::plane_zx, nullptr, "plane XZ", "RS-274/NGC 3.5.6"},
    {190, 2, F::plane_yz, nullptr, "plane YZ", "RS-274/NGC 3.5.6"},
    {200, 6, F::inch, nullptr, "inches", "RS-274/NGC 3.5.7"},
    {210, 6, F::metric, nullptr, "millimetres", "RS-274/NGC 3.5.7"},
    {280, 0, F::reference_return, nullptr, "return to the first stored position", "RS-274/NGC 3.5.8"},
    {281, 0, F::reference_set, "NC-NOT-BUILT", "store the first position", "LinuxCNC G28.1"},
    {300, 0, F::second_reference, nullptr, "return to the second stored position", "RS-274/NGC 3.5.8"},
    {301, 0, F::reference_set, "NC-NOT-BUILT", "store the second position", "LinuxCNC G30.1", nullptr, 1},
    {330, 1, F::thread, nullptr, "motion in step with the spindle", "LinuxCNC G33"},
    {331, 0, F::rigid_tap, "NC-NOT-BUILT", "rigid tapping", "LinuxCNC G33.1"},
    {382, 1, F::probe, nullptr, "probe towards the workpiece, no contact is an alarm", "LinuxCNC G38"},
    {383, 1, F::probe_try, nullptr, "probe towards the workpiece", "LinuxCNC G38"},
    {384, 1, F::probe_away, nullptr, "probe away from the workpiece, contact kept is an alarm", "LinuxCNC G38"},
    {385, 1, F::probe_away_try, nullptr, "probe away from the workpiece", "LinuxCNC G38"},
    {400, 7, F::comp_off, nullptr, "cutter radius compensation off", "RS-274/NGC 3.5.10"},
    {410, 7, F::comp_left, nullptr, "cutter radius compensation left", "RS-274/NGC 3.5.10"},
    {411, 0, F::comp_dynamic, "NC-NOT-BUILT", "cutter compensation left with the diameter in the block", "LinuxCNC G41.1"},
    {420, 7, F::comp_right, nullptr, "cutter radius compensation right", "RS-274/NGC 3.5.10"},
    {421, 0, F::comp_dynamic, "NC-NOT-BUILT", "cutter compensation right with the diameter in the block", "LinuxCNC G42.1", nullptr, 1},
    {430, 8, F::length_plus, nullptr, "tool length offset", "RS-274/NGC 3.5.11"},
    {431, 8, F::length_of_block, nullptr, "tool length offset by the words of the block", "LinuxCNC G43.1", "of Z alone"},
    {432, 0, F::length_added, "NC-NOT-BUILT", "a further tool length offset", "LinuxCNC G43.2"},
    {490, 8, F::length_off, nullptr, "tool length offset off", "RS-274/NGC 3.5.11"},
    {520, 0, F::local_system, "NC-NOT-BUILT", "local coordinate system", "LinuxCNC G52"},
    {530, 0, F::machine_move, nullptr, "move in machine coordinates", "RS-274/NGC 3.5.12"},
    {540, 12, F::work_system, nullptr, "coordinate system 1", "RS-274/NGC 3.5.13"},
    {550, 12, F::work_system, nullptr, "coordinate system 2", "RS-274/NGC 3.5.13", nullptr, 1},
    {560, 12, F::work_system, nullptr, "coordinate system 3", "RS-274/NGC 3.5.13", nullptr, 2},
    {570, 12, F::work_system, nullptr, "coordinate system 4", "RS-274/NGC 3.5.13", nullptr, 3},
    {580, 12, F::work_system, nullptr, "coordinate system 5", "RS-274/NGC 3.5.13", nullptr, 4},
    {590, 12, F::work_system, nullptr, "coordinate system 6", "RS-274/NGC 3.5.13", nullptr, 5},
    {591, 12, F::work_system, nullptr, "coordinate system 7", "RS-274/NGC 3.5.13", nullptr, 6},
    {592, 12, F::work_system, nullptr, "coordinate system 8", "RS-274/NGC 3.5.13", nullptr, 7},
    {593, 12, F::work_system, nullptr, "coordinate system 9", "RS-274/NGC 3.5.13", nullptr, 8},
    {610, 13, F::exact_stop_mode, nullptr, "exact path mode", "RS-274/NGC 3.5.14"},
    {611, 13, F::exact_stop_mode, nullptr, "exact stop mode", "RS-274/NGC 3.5.14", nullptr, 1},
    {640, 13, F::cutting_mode, nullptr, "continuous mode", "RS-274/NGC 3.5.14", "P Q: the tolerance is that of the machine's configuration"},
    {730, 9, F::cycle_step, nullptr, "drilling cycle with chip breaking", "LinuxCNC G73"},
    {740, 9, F::cycle_reverse_tap, nullptr, "left-hand tapping cycle", "LinuxCNC G74"},
    {760, 0, F::thread_cycle, "NC-LATHE", "threading cycle", "LinuxCNC G76", "cuts a thread into work that turns, on a lathe: here use G33, G84 or a helix; bore by G85, G86 or G89"},
    {800, 9, F::cycle_off, nullptr, "cycle off", "RS-274/NGC 3.5.15"},
    {810, 9, F::cycle_drill, nullptr, "drilling cycle", "RS-274/NGC 3.5.16.1"},
    {820, 9, F::cycle_spot, nullptr, "drilling cycle with dwell", "RS-274/NGC 3.5.16.2"},
    {830, 9, F::cycle_peck, nullptr, "peck drilling cycle", "RS-274/NGC 3.5.16.3"},
    {840, 9, F::cycle_tap, nullptr, "right-hand tapping cycle", "RS-274/NGC 3.5.16.4"},
    {850, 9, F::cycle_bore_feed, nullptr, "boring cycle, back at feed", "RS-274/NGC 3.5.16.5"},
    {860, 9, F::cycle_bore_stop, nullptr, "boring cycle, back with the spindle stopped", "RS-274/NGC 3.5.16.6"},
    {870, 9, F::cycle_back_bore, nullptr, "back boring cycle", "RS-274/NGC 3.5.16.7"},
    {880, 9, F::cycle_bore_stop_dwell, nullptr, "boring cycle, back by hand", "RS-274/NGC 3.5.16.8"},
    {890, 9, F::cycle_bore_dwell, nullptr, "boring cycle with dwell, back at feed", "RS-274/NGC 3.5.16.9"},
    {900, 3, F::absolute, nullptr, "absolute distances", "RS-274/NGC 3.5.17"},
    {901, 4, F::centre_absolute, nullptr, "absolute arc centres", "LinuxCNC G90.1"},
    {910, 3, F::incremental, nullptr, "incremental distances", "RS-274/NGC 3.5.17"},
    {911, 4, F::centre_incremental, nullptr, "incremental arc centres", "LinuxCNC G91.1"},
    {920, 0, F::coordinate_set, nullptr, "coordinate system offset", "RS-274/NGC 3.5.18"},
    {921, 0, F::shift_off, nullptr, "coordinate system offset to zero", "RS-274/NGC 3.5.18"},
    {922, 0, F::shift_suspend, nullptr, "coordinate system offset suspended", "RS-274/NGC 3.5.18"},
    {923, 0, F::shift_restore, nullptr, "coordinate system offset restored", "RS-274/NGC 3.5.18"},
    {930, 5, F::inverse_time_feed, nullptr, "inverse time feed", "RS-274/NGC 3.5.19"},
    {940, 5, F::feed_per_minute, nullptr, "feed per minute", "RS-274/NGC 3.5.19"},
    {950, 5, F::feed_per_revolution, nullptr, "feed per revolution", "LinuxCNC G95"},
    {960, 14, F::surface_on, nullptr, "constant surface speed", "LinuxCNC G96"},
    {970, 14, F::surface_off, nullptr, "spindle speed in r/min", "LinuxCNC G97"},
    {980, 10, F::return_initial, nullptr, "cycles return to the initial level", "RS-274/NGC 3.5.20"},
    {990, 10, F::return_r, nullptr, "cycles return to R", "RS-274/NGC 3.5.20"},
};

// The M codes of RS-274/NGC 3.6, and those of LinuxCNC that the control itself would have to carry out. All others are put out to the machine:
// M7, M8, M9, M100 to M199.
const MiscRow kMisc[] = {
    {0, M::program_stop, nullptr, "program stop", "RS-274/NGC 3.6.1"},
    {1, M::optional_stop, nullptr, "optional stop", "RS-274/NGC 3.6.1"},
    {2, M::program_end, nullptr, "program end", "RS-274/NGC 3.6.1"},
    {30, M::program_end, nullptr, "program end, pallets exchanged", "RS-274/NGC 3.6.1"},
    {48, M::override_allowed, nullptr, "overrides on", "RS-274/NGC 3.6.5"},
    {49, M::override_barred, nullptr, "overrides off", "RS-274/NGC 3.6.5"},
    {50, M::override_of_one, nullptr, "feed override on or off", "LinuxCNC M50", 0},
    {51, M::override_of_one, nullptr, "spindle override on or off", "LinuxCNC M51", 1, "P0: no program bars the override of the spindle"},
    {52, M::override_of_one, nullptr, "adaptive feed on or off", "LinuxCNC M52", 2, "P1: there is no signal of an adaptive feed"},
    {53, M::override_of_one, nullptr, "feed stop on or off", "LinuxCNC M53", 3},
    {60, M::program_stop, nullptr, "program stop, pallets exchanged", "RS-274/NGC 3.6.1"},
    {61, M::tool_number, nullptr, "number of the tool in the spindle", "LinuxCNC M61"},
    {62, M::machine_output, nullptr, "output on with the motion", "LinuxCNC M62", 1},
    {63, M::machine_output, nullptr, "output off with the motion", "LinuxCNC M63"},
    {64, M::machine_output, nullptr, "output on", "LinuxCNC M64", 1},
    {65, M::machine_output, nullptr, "output off", "LinuxCNC M65"},
    {66, M::machine_input, nullptr, "wait for an input", "LinuxCNC M66"},
    {67, M::machine_value, nullptr, "analog output with the motion", "LinuxCNC M67"},
    {68, M::machine_value, nullptr, "analog output", "LinuxCNC M68"},
    {70, M::modal_state, "NC-NOT-BUILT", "save modal state", "LinuxCNC M70"},
    {71, M::modal_state, "NC-NOT-BUILT", "forget saved modal state", "LinuxCNC M71"},
    {72, M::modal_state, "NC-NOT-BUILT", "restore modal state", "LinuxCNC M72"},
    {73, M::modal_state, "NC-NOT-BUILT", "save modal state until the return", "LinuxCNC M73"},
    {98, M::call_sub, "NC-NOT-BUILT", "sub program call", "LinuxCNC M98"},
    {99, M::return_sub, "NC-NOT-BUILT", "return from a sub program", "LinuxCNC M99"},
};

// RS-274/NGC 3.6.2, 3.6.3: M codes that are put out and also mean something to the control.
const OutputRow kOutputs[] = {
    {3, M::spindle_forward},
    {4, M::spindle_reverse},
    {5, M::spindle_stop},
    {6, M::tool_change},
    {19, M::spindle_oriented},  // LinuxCNC M19
};

// The sizes are those that iso/tables.hpp declares.
static_assert(sizeof kFunctions / sizeof kFunctions[0] == kFunctionRows && sizeof kMisc / sizeof kMisc[0] == kMiscRows);

}  // namespace nc::iso
