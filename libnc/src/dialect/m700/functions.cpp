// SPDX-License-Identifier: Apache-2.0
// M700 3.7, the list of G codes: one row for each code, in the order of the codes. If a function is not built, its row names the alarm that
// the manual has for a control without the function: the code of its "No spec" alarm (appendix 1), or P39 if there is none.
#include "dialect/m700/tables.hpp"

namespace nc::m700 {

using F = Function;

namespace {

constexpr FunctionRow kListed[] = {
    // code, group, function, alarm when not built, name, section, what of it is not built, number
    {0, 1, F::rapid, nullptr, "positioning", "6.1"},
    {10, 1, F::linear, nullptr, "linear interpolation", "6.2"},
    {20, 1, F::arc_cw, nullptr, "circular interpolation clockwise", "6.4"},
    {21, 1, F::spiral_cw, nullptr, "spiral interpolation clockwise", "6.13"},
    {23, 1, F::exponential_positive, nullptr, "exponential interpolation, positive rotation", "6.11"},
    {24, 1, F::space_arc_first, nullptr, "three-point arc in space", "6.14"},
    {30, 1, F::arc_ccw, nullptr, "circular interpolation counter-clockwise", "6.4"},
    {31, 1, F::spiral_ccw, nullptr, "spiral interpolation counter-clockwise", "6.13"},
    {33, 1, F::exponential_negative, nullptr, "exponential interpolation, negative rotation", "6.11"},
    {34, 1, F::space_arc_second, nullptr, "three-point arc in space", "6.14"},
    {40, 0, F::dwell, nullptr, "dwell", "8.1"},
    {50, 0, F::high_speed, nullptr, "high-speed machining, high-speed high-accuracy control II", "13.16",
     "P3: P65; P1 and P2 are states and nothing else; the speed prediction of SSS (#8092) is not built"},
    {51, 0, F::high_speed_accuracy, nullptr, "high-speed high-accuracy control I, spline", "13.17.1"},
    {62, 1, F::nurbs, nullptr, "NURBS interpolation", "6.15"},
    {70, 0, F::hypothetical_axis, nullptr, "hypothetical axis interpolation", "6.16"},
    {71, 21, F::cylinder, nullptr, "cylindrical interpolation", "6.9"},
    {80, 0, F::high_accuracy, nullptr, "high-accuracy control on and off", "13.15",
     "feed forward is the drive's; #8107 without #8108 does nothing"},
    {90, 0, F::exact_stop_once, nullptr, "exact stop check in this block", "7.7"},
    {100, 0, F::data_input, nullptr, "data input by program, rotation of the workpiece coordinates", "12.7, 13.21"},
    {110, 0, F::data_input_end, nullptr, "data input end", "12.7, 13.11"},
    {111, 0, F::parameter_input_end, nullptr, "parameter input end", "13.11"},
    {120, 0, F::circle_cut_cw, nullptr, "circle cutting clockwise", "13.10"},
    {121, 21, F::polar_on, nullptr, "polar coordinate interpolation", "6.10"},
    {130, 0, F::circle_cut_ccw, nullptr, "circle cutting counter-clockwise", "13.10"},
    {131, 21, F::polar_off, nullptr, "polar coordinate interpolation off", "6.10"},
    {150, 18, F::polar_command_off, nullptr, "polar coordinate command off", "6.12"},
    {160, 18, F::polar_command_on, nullptr, "polar coordinate command", "6.12"},
    {170, 2, F::plane_xy, nullptr, "plane XY", "6.3"},
    {180, 2, F::plane_zx, nullptr, "plane ZX", "6.3"},
    {190, 2, F::plane_yz, nullptr, "plane YZ", "6.3"},
    {200, 6, F::inch, nullptr, "inch command", "5.2"},
    {210, 6, F::metric, nullptr, "metric command", "5.2"},
    {220, 4, F::stroke_check_on, nullptr, "stroke check before travel", "15.7"},
    {230, 4, F::stroke_check_off, nullptr, "stroke check before travel off", "15.7"},
    {270, 0, F::reference_check, nullptr, "reference position check", "14.9"},
    {280, 0, F::reference_return, nullptr, "reference position return", "14.7"},
    {290, 0, F::start_return, nullptr, "return to the start position", "14.7"},
    {300, 0, F::second_reference, nullptr, "return to the 2nd, 3rd or 4th reference position", "14.8"},
    {301, 0, F::tool_change_return, nullptr, "tool change position return 1", "13.13"},
    {302, 0, F::tool_change_return, nullptr, "tool change position return 2", "13.13", nullptr, 1},
    {303, 0, F::tool_change_return, nullptr, "tool change position return 3", "13.13", nullptr, 2},
    {304, 0, F::tool_change_return, nullptr, "tool change position return 4", "13.13", nullptr, 3},
    {305, 0, F::tool_change_return, nullptr, "tool change position return 5", "13.13", nullptr, 4},
    {306, 0, F::tool_change_return, nullptr, "tool change position return 6", "13.13", nullptr, 5},
    {310, 0, F::skip, nullptr, "skip", "15.2"},
    {311, 0, F::multi_skip, nullptr, "multi-step skip 1", "15.3"},
    {312, 0, F::multi_skip, nullptr, "multi-step skip 2", "15.3", nullptr, 1},
    {313, 0, F::multi_skip, nullptr, "multi-step skip 3", "15.3", nullptr, 2},
    {330, 1, F::thread, nullptr, "thread cutting", "6.7.1"},
    {340, 0, F::holes_on_circle, nullptr, "holes on a circle", "13.2"},
    {350, 0, F::holes_on_line, nullptr, "holes on a line", "13.2"},
    {360, 0, F::holes_on_arc, nullptr, "holes on an arc", "13.2"},
    {370, 0, F::measure_length, nullptr, "automatic tool length measurement", "15.1"},
    {371, 0, F::holes_on_grid, nullptr, "holes on a grid", "13.2"},
    {380, 0, F::comp_vector, nullptr, "vector of tool radius compensation", "12.4.3"},
    {390, 0, F::comp_corner_arc, nullptr, "corner arc of tool radius compensation", "12.4.2"},
    {400, 7, F::comp_off, nullptr, "tool radius compensation off", "12.4"},
    {401, 15, F::normal_line_off, nullptr, "normal line control off", "13.14"},
    {410, 7, F::comp_left, nullptr, "tool radius compensation left, with I J K in three dimensions", "12.4, 12.5"},
    {411, 15, F::normal_line_left, "P900", "normal line control left", "13.14"},
    {420, 7, F::comp_right, nullptr, "tool radius compensation right, with I J K in three dimensions", "12.4, 12.5"},
    {421, 15, F::normal_line_right, "P900", "normal line control right", "13.14"},
    {430, 8, F::length_plus, nullptr, "tool length compensation plus", "12.2"},
    {431, 8, F::length_along_tool, nullptr, "tool length compensation along the tool axis", "12.3"},
    {434, 8, F::tool_tip_1, "P940", "tool centre point control type 1", "13.23"},
    {435, 8, F::tool_tip_2, "P940", "tool centre point control type 2", "13.23"},
    {440, 8, F::length_minus, nullptr, "tool length compensation minus", "12.2"},
    {450, 0, F::offset_longer, nullptr, "tool position offset, longer", "12.6"},
    {460, 0, F::offset_shorter, nullptr, "tool position offset, shorter", "12.6"},
    {470, 0, F::offset_twice_longer, nullptr, "tool position offset, twice longer", "12.6"},
    {480, 0, F::offset_twice_shorter, nullptr, "tool position offset, twice shorter", "12.6"},
    {490, 8, F::length_off, nullptr, "tool length compensation off", "12.2"},
    {500, 11, F::scaling_off, nullptr, "scaling off", "13.19"},
    {501, 19, F::mirror_off, nullptr, "mirror image off", "13.6"},
    {510, 11, F::scaling_on, nullptr, "scaling", "13.19"},
    {511, 19, F::mirror_on, nullptr, "mirror image", "13.6"},
    {520, 0, F::local_system, nullptr, "local coordinate system", "14.11"},
    {530, 0, F::machine_move, nullptr, "move in machine coordinates", "14.4"},
    {540, 12, F::work_system, nullptr, "workpiece coordinate system 1", "14.10"},
    {541, 12, F::extended_system, nullptr, "extended workpiece coordinate system", "14.10"},
    {550, 12, F::work_system, nullptr, "workpiece coordinate system 2", "14.10", nullptr, 1},
    {560, 12, F::work_system, nullptr, "workpiece coordinate system 3", "14.10", nullptr, 2},
    {570, 12, F::work_system, nullptr, "workpiece coordinate system 4", "14.10", nullptr, 3},
    {580, 12, F::work_system, nullptr, "workpiece coordinate system 5", "14.10", nullptr, 4},
    {590, 12, F::work_system, nullptr, "workpiece coordinate system 6", "14.10", nullptr, 5},
    {600, 0, F::unidirectional, nullptr, "unidirectional positioning", "6.8"},
    {610, 13, F::exact_stop_mode, nullptr, "exact stop check mode", "7.8"},
    {611, 13, F::high_accuracy_mode, nullptr, "high-accuracy control", "13.15",
     "feed forward is the drive's; #8107 without #8108 does nothing"},
    {620, 13, F::corner_override, nullptr, "automatic corner override", "7.10"},
    {630, 13, F::tapping_mode, nullptr, "tapping mode", "7.11"},
    {631, 13, F::synchronous_tapping, "P39", "synchronous tapping mode", "3.7"},
    {632, 13, F::synchronous_tapping_reverse, "P39", "synchronous tapping mode, reverse", "3.7"},
    {640, 13, F::cutting_mode, nullptr, "cutting mode", "7.12"},
    {650, 0, F::macro_call, nullptr, "macro call", "13.5.1"},
    {660, 14, F::macro_modal, nullptr, "modal macro call after moves", "13.5.1"},
    {661, 14, F::macro_every_block, nullptr, "modal macro call for every block", "13.5.1"},
    {670, 14, F::macro_modal_off, nullptr, "modal macro call off", "13.5.1"},
    {680, 16, F::rotation_on, nullptr, "coordinate rotation", "13.20", "I J K together (conversion in space, 13.22): P920"},
    {690, 16, F::rotation_off, nullptr, "coordinate rotation off", "13.20"},
    // Appendix 1 says of P180 "G72 to G89". G70 and G71 are not in this range.
    {700, 9, F::user_cycle, "P39", "user cycle", "3.7"},
    {710, 9, F::user_cycle, "P39", "user cycle", "3.7", nullptr, 1},
    {720, 9, F::user_cycle, "P180", "user cycle", "3.7", nullptr, 2},
    {730, 9, F::cycle_step, nullptr, "step drilling cycle", "13.1.1"},
    {740, 9, F::cycle_reverse_tap, nullptr, "reverse tapping cycle", "13.1.1"},
    {750, 9, F::cycle_circle, nullptr, "circle cutting cycle", "13.1.1"},
    {760, 9, F::cycle_fine_bore, nullptr, "fine boring cycle", "13.1.1"},
    {770, 9, F::user_fixed_cycle, "P180", "user cycle", "3.7"},
    {780, 9, F::user_fixed_cycle, "P180", "user cycle", "3.7", nullptr, 1},
    {790, 9, F::user_fixed_cycle, "P180", "user cycle", "3.7", nullptr, 2},
    {800, 9, F::cycle_off, nullptr, "cycle off", "13.1.1"},
    {810, 9, F::cycle_drill, nullptr, "drilling cycle", "13.1.1"},
    {820, 9, F::cycle_spot, nullptr, "drilling cycle with dwell", "13.1.1"},
    {830, 9, F::cycle_peck, nullptr, "deep hole drilling cycle", "13.1.1"},
    {840, 9, F::cycle_tap, nullptr, "tapping cycle", "13.1.1"},
    {850, 9, F::cycle_bore_feed, nullptr, "boring cycle, return at feed", "13.1.1"},
    {860, 9, F::cycle_bore_stop, nullptr, "boring cycle, return with the spindle stopped", "13.1.1"},
    {870, 9, F::cycle_back_bore, nullptr, "back boring cycle", "13.1.1"},
    {880, 9, F::cycle_bore_stop_dwell, nullptr, "boring cycle with dwell, return with the spindle stopped", "13.1.1"},
    {890, 9, F::cycle_bore_dwell, nullptr, "boring cycle with dwell, return at feed", "13.1.1"},
    {900, 3, F::absolute, nullptr, "absolute values", "5.1"},
    {910, 3, F::incremental, nullptr, "incremental values", "5.1"},
    {920, 0, F::coordinate_set, nullptr, "coordinate system setting, spindle clamp", "14.5, 10.4"},
    {921, 0, F::coordinate_preset, nullptr, "workpiece coordinate system preset", "14.12"},
    {930, 5, F::inverse_time_feed, nullptr, "inverse time feed", "7.5"},
    {940, 5, F::feed_per_minute, nullptr, "feed per minute", "7.4"},
    {950, 5, F::feed_per_revolution, nullptr, "feed per revolution", "7.4"},
    {960, 17, F::surface_on, nullptr, "constant surface speed", "10.3"},
    {970, 17, F::surface_off, nullptr, "constant surface speed off", "10.3"},
    {980, 10, F::return_initial, nullptr, "return to the initial point", "13.1.2"},
    {990, 10, F::return_r, nullptr, "return to the R point", "13.1.2"},
    {1070, 21, F::cylinder, nullptr, "cylindrical interpolation", "6.9", nullptr, 1},
    {1120, 21, F::polar_on, nullptr, "polar coordinate interpolation", "6.10", nullptr, 1},
    {1130, 21, F::polar_off, nullptr, "polar coordinate interpolation off", "6.10", nullptr, 1},
};
constexpr unsigned kListedRows = sizeof kListed / sizeof kListed[0];
constexpr int kFirstUserCode = 100, kLastUserCode = 255;

// G100 to G255 call a user macro if the machine builder has registered the code in a parameter (13.5.1, at most ten codes). A code that is not
// registered does not exist: P34. G101 to G110 and G200 to G202 are "user macro I" codes, which need no registration (13.5.1, G code macro
// call, note 1): the user macro that they belong to is missing, which is P270.
constexpr FunctionRow user_macro(int code) {
  const bool macro_one = (code >= 101 && code <= 110) || (code >= 200 && code <= 202);
  return {static_cast<int16_t>(code * 10),
          0,
          F::user_macro,
          macro_one ? "P270" : "P34",
          macro_one ? "user macro I" : "user macro call, where registered",
          "13.5.1",
          nullptr,
          static_cast<uint8_t>(code - kFirstUserCode)};
}

constexpr FunctionTable with_user_macros() {
  FunctionTable table{};
  unsigned from = 0, to = 0;
  for (; from < kListedRows && kListed[from].code < kFirstUserCode * 10; ++from)
    table.row[to++] = kListed[from];
  for (int code = kFirstUserCode; code <= kLastUserCode; ++code) {
    const bool listed = from < kListedRows && kListed[from].code == code * 10;
    table.row[to++] = listed ? kListed[from++] : user_macro(code);
  }
  return table;
}

}  // namespace

static_assert(kListed[kListedRows - 1].code < kLastUserCode * 10);
static_assert(with_user_macros().row[kFunctionRows - 1].code == kLastUserCode * 10,
              "kFunctionRows is not the number of rows");

constexpr FunctionTable kFunctionTable = with_user_macros();

}  // namespace nc::m700
