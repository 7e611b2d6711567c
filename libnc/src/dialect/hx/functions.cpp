// SPDX-License-Identifier: Apache-2.0
// HX 3.1, the table of G codes: one row for each code, in its order; 11.1, the M codes that the control keeps for itself. The printed group 23 is one-shot
// like group 0, and both are 0 here. G107 stands alone in the printed group 22; it shares a mode with G112, and so its group.
#include "dialect/hx/tables.hpp"

namespace nc::hx {

using F = Function;
using M = MiscFunction;

namespace {

/// The manual has no number for a control without an option.
constexpr const char* kNotBuilt = "NC-NOT-BUILT";

}  // namespace

const FunctionRow kFunctions[] = {
    // code, group, function, alarm when not built, name, section, what of it is not built, number
    {0, 1, F::rapid, nullptr, "rapid traverse", "4.1"},
    {10, 1, F::linear, nullptr, "linear interpolation", "4.3"},
    {20, 1, F::arc_cw, nullptr, "circular and helical interpolation clockwise", "4.4, 4.5"},
    {30, 1, F::arc_ccw, nullptr, "circular and helical interpolation counter-clockwise", "4.4, 4.5"},
    {40, 0, F::dwell, nullptr, "dwell", "5.4"},
    {90, 0, F::exact_stop_once, nullptr, "exact stop", "5.3.1"},
    {100, 0, F::data_input, nullptr, "tool offsets by program", "13.1.3"},
    {103, 21, F::high_speed_on, nullptr, "high-speed machining", "15.1",
     "a state and nothing else: reading ahead and smooth speed are there without it; PM 680 to 740 do nothing"},
    {113, 21, F::high_speed_off, nullptr, "high-speed machining off", "15.1"},
    {150, 17, F::polar_command_off, nullptr, "polar coordinate command off", "8.3"},
    {160, 17, F::polar_command_on, nullptr, "polar coordinate command", "8.3"},
    {170, 16, F::plane_xy, nullptr, "plane XY", "7.4"},
    {180, 16, F::plane_zx, nullptr, "plane ZX", "7.4"},
    {190, 16, F::plane_yz, nullptr, "plane YZ", "7.4"},
    {200, 6, F::inch, nullptr, "inch", "8.4"},
    {210, 6, F::metric, nullptr, "metric", "8.4"},
    {220, 9, F::stroke_check_on, nullptr, "stored stroke check", "15.5.3"},
    {230, 9, F::stroke_check_off, nullptr, "stored stroke check off", "15.5.3"},
    {270, 0, F::reference_check, nullptr, "reference position check", "6.4"},
    {280, 0, F::reference_return, nullptr, "reference position return", "6.1"},
    {290, 0, F::start_return, nullptr, "return from the reference position", "6.3"},
    {300, 0, F::second_reference, nullptr, "return to the 2nd, 3rd or 4th reference position", "6.2"},
    {310, 0, F::skip, nullptr, "skip", "4.9"},
    {311, 0, F::multi_skip, nullptr, "skip 1", "4.9"},
    {312, 0, F::multi_skip, nullptr, "skip 2", "4.9", nullptr, 1},
    {313, 0, F::multi_skip, nullptr, "skip 3", "4.9", nullptr, 2},
    {314, 0, F::multi_skip, nullptr, "skip 4", "4.9", nullptr, 3},
    {330, 1, F::thread, nullptr, "thread cutting", "4.8"},
    {370, 0, F::measure_length, nullptr, "automatic tool length measurement", "4.10"},
    {371, 0, F::measure_length, nullptr, "automatic tool length measurement 1", "4.10", nullptr, 1},
    {372, 0, F::measure_length, nullptr, "automatic tool length measurement 2", "4.10", nullptr, 2},
    {373, 0, F::measure_length, nullptr, "automatic tool length measurement 3", "4.10", nullptr, 3},
    {374, 0, F::measure_length, nullptr, "automatic tool length measurement 4", "4.10", nullptr, 4},
    {390, 0, F::comp_corner_turn, nullptr, "corner arc of tool diameter compensation", "13.2.1"},
    {400, 7, F::comp_off, nullptr, "tool diameter compensation off", "13.2.1"},
    {410, 7, F::comp_left, nullptr, "tool diameter compensation left", "13.2.1, 13.2.2"},
    {420, 7, F::comp_right, nullptr, "tool diameter compensation right", "13.2.1, 13.2.2"},
    {430, 13, F::length_plus, nullptr, "tool length compensation plus", "13.1.1"},
    {440, 13, F::length_minus, nullptr, "tool length compensation minus", "13.1.1"},
    {450, 0, F::offset_longer, nullptr, "tool offset increase", "13.3"},
    {460, 0, F::offset_shorter, nullptr, "tool offset decrease", "13.3"},
    {470, 0, F::offset_twice_longer, nullptr, "tool offset double increase", "13.3"},
    {480, 0, F::offset_twice_shorter, nullptr, "tool offset double decrease", "13.3"},
    {490, 13, F::length_off, nullptr, "tool length compensation off", "13.1.1"},
    {500, 11, F::scaling_off, nullptr, "scaling and mirror image off", "15.2, 15.3"},
    {510, 11, F::scaling_on, nullptr, "scaling, mirror image", "15.2, 15.3"},
    {520, 0, F::local_system, nullptr, "local coordinate system", "7.3"},
    {530, 0, F::machine_move, nullptr, "move in machine coordinates", "7.1.1"},
    {540, 14, F::work_system, nullptr, "work coordinate system 1", "7.2.2"},
    {550, 14, F::work_system, nullptr, "work coordinate system 2", "7.2.2", nullptr, 1},
    {560, 14, F::work_system, nullptr, "work coordinate system 3", "7.2.2", nullptr, 2},
    {570, 14, F::work_system, nullptr, "work coordinate system 4", "7.2.2", nullptr, 3},
    {580, 14, F::work_system, nullptr, "work coordinate system 5", "7.2.2", nullptr, 4},
    {590, 14, F::work_system, nullptr, "work coordinate system 6", "7.2.2", nullptr, 5},
    {600, 0, F::unidirectional, nullptr, "single direction positioning", "4.2"},
    {610, 15, F::exact_stop_mode, nullptr, "exact stop mode", "5.3.2"},
    {620, 15, F::corner_override, nullptr, "automatic corner override mode", "5.3.5",
     "the way behind the corner (PI 126), PI 131, 132 and 153: they do nothing"},
    {630, 15, F::tapping_mode, nullptr, "tapping mode", "5.3.4"},
    {631, 0, F::stitch_on, kNotBuilt, "stitch", "15.6"},
    {632, 0, F::stitch_off, kNotBuilt, "stitch off", "15.6"},
    {640, 15, F::cutting_mode, nullptr, "cutting mode", "5.3.3"},
    {650, 0, F::macro_call, nullptr, "macro call", "14.1.1"},
    {660, 12, F::macro_modal, nullptr, "modal macro call", "14.1.2, 14.1.8"},
    {670, 12, F::macro_modal_off, nullptr, "modal macro call off", "14.1.2"},
    {680, 18, F::rotation_on, nullptr, "coordinate rotation", "15.4"},
    {690, 18, F::rotation_off, nullptr, "coordinate rotation off", "15.4"},
    {730, 10, F::cycle_step, nullptr, "high-speed peck drilling cycle", "12.3.4"},
    {740, 10, F::cycle_reverse_tap, nullptr, "counter tapping cycle", "12.3.6"},
    {760, 10, F::cycle_fine_bore, nullptr, "fine boring cycle", "12.3.9", "Q by PI 70 and PI 71: the shift has I J"},
    {800, 10, F::cycle_off, nullptr, "canned cycle off", "12.2.1"},
    {810, 10, F::cycle_drill, nullptr, "drilling cycle", "12.3.1"},
    {820, 10, F::cycle_spot, nullptr, "drilling cycle with dwell", "12.3.2"},
    {830, 10, F::cycle_peck, nullptr, "peck drilling cycle", "12.3.3"},
    {840, 10, F::cycle_tap, nullptr, "tapping cycle", "12.3.5"},
    {842, 10, F::cycle_rigid_tap, nullptr, "rigid tapping cycle", "12.3.5"},
    {843, 10, F::cycle_rigid_reverse_tap, nullptr, "counter rigid tapping cycle", "12.3.6"},
    {850, 10, F::cycle_bore_feed, nullptr, "boring cycle", "12.3.7"},
    {860, 10, F::cycle_bore_stop, nullptr, "boring cycle, back with the spindle stopped", "12.3.8"},
    {870, 10, F::cycle_back_bore, nullptr, "back boring cycle", "12.3.10", "Q by PI 70 and PI 71: the shift has I J"},
    {880, 10, F::cycle_bore_stop_dwell, nullptr, "boring cycle, back by hand", "12.3.11"},
    {890, 10, F::cycle_bore_dwell, nullptr, "boring cycle with dwell", "12.3.12"},
    {900, 3, F::absolute, nullptr, "absolute command", "8.1"},
    {910, 3, F::incremental, nullptr, "incremental command", "8.2"},
    {920, 0, F::coordinate_set, nullptr, "work coordinate system setting, highest spindle speed", "7.2.1, 9.3"},
    {940, 5, F::feed_per_minute, nullptr, "feed per minute", "5.2.1"},
    {950, 5, F::feed_per_revolution, nullptr, "feed per revolution", "5.2.2"},
    {960, 2, F::surface_on, nullptr, "constant surface speed", "9.1"},
    {970, 2, F::surface_off, nullptr, "constant surface speed off", "9.2"},
    {980, 19, F::return_initial, nullptr, "canned cycles return to the initial point", "12.1.4"},
    {990, 19, F::return_r, nullptr, "canned cycles return to the R point", "12.1.4"},
    {1070, 20, F::cylinder, nullptr, "cylindrical interpolation", "4.7"},
    {1120, 20, F::polar_on, nullptr, "polar coordinate interpolation", "4.6"},
    {1130, 20, F::polar_off, nullptr, "polar coordinate interpolation off", "4.6"},
};

const MiscRow kMisc[] = {
    {0, M::program_stop, nullptr, "program stop", "11.1"},
    {1, M::optional_stop, nullptr, "optional stop", "11.1"},
    {2, M::program_end, nullptr, "program end", "11.1"},
    {30, M::program_end, nullptr, "program end and rewind", "11.1"},
    {98, M::call_sub, nullptr, "sub program call", "2.4.3"},
    {99, M::return_sub, nullptr, "return from a sub program, repeat of the main program", "2.4.3, 2.4.4"},
};

const OutputRow kOutputs[] = {
    {3, M::spindle_forward},
    {4, M::spindle_reverse},
    {5, M::spindle_stop},
    {6, M::tool_change},
    {19, M::spindle_oriented},  // 12.3.9
};

}  // namespace nc::hx
