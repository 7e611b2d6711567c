// SPDX-License-Identifier: Apache-2.0
#include "dialect/default_precedence.hpp"

#include <iterator>

namespace nc {
namespace {

using F = Function;

constexpr Precedence kBoth = Precedence::both, kIgnored = Precedence::ignored, kOfAMode = Precedence::modal, kLoses = Precedence::loses;

// M700 appendix 2: one row for each commanded code, in the order of the appendix. The cells that are alarms are checked elsewhere, where the state
// decides: arc with G41 G42 P151 and with G43 G44 P70, G31 under compensation P608, cycles under compensation P155, planes P112.
constexpr PrecedenceRow kInOneBlock[] = {
    // function            motion  radius    length    cycle     work    macro   mirror
    {F::dwell,             kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::data_input,        kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::data_input_end,    kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::parameter_input_end, kOfAMode, kIgnored, kIgnored, kIgnored, kBoth, kLoses, kIgnored},
    {F::reference_check,   kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::reference_return,  kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::start_return,      kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::second_reference,  kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::tool_change_return, kOfAMode, kBoth,   kBoth,    kIgnored, kBoth,  kLoses, kIgnored},
    {F::skip,              kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::multi_skip,        kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_once,        kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe,             kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_try,         kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_away,        kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_away_try,    kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::measure_length,    kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::mirror_on,         kBoth,  kBoth,    kBoth,    kIgnored, kBoth,  kLoses, kBoth},
    {F::mirror_off,        kBoth,  kBoth,    kBoth,    kIgnored, kBoth,  kLoses, kBoth},
    {F::local_system,      kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::machine_move,      kOfAMode, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::holes_on_circle,   kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},  // 13.2, notes 4 and 5
    {F::holes_on_line,     kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::holes_on_arc,      kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::holes_on_grid,     kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::macro_call,        kOfAMode, kBoth,    kOfAMode,   kIgnored, kBoth,  kBoth,  kIgnored},
    {F::macro_modal,       kOfAMode, kBoth,    kOfAMode,   kIgnored, kOfAMode, kBoth,  kIgnored},
    {F::macro_every_block, kOfAMode, kBoth,    kOfAMode,   kIgnored, kOfAMode, kBoth,  kIgnored},
    {F::macro_modal_off,   kOfAMode, kBoth,    kOfAMode,   kIgnored, kOfAMode, kBoth,  kIgnored},
    {F::coordinate_set,    kOfAMode, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
};

constexpr BarredRow kBarred[] = {
    {kInPolarCommand, F::high_speed_accuracy, Condition::illegal_g, "6.12"},
    {kInFigure, F::offset_longer, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, F::offset_shorter, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, F::offset_twice_longer, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, F::offset_twice_shorter, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, F::rotation_on, Condition::rotation_in_figure, "App.1 P252"},
    {kInFigure, F::rotation_off, Condition::rotation_in_figure, "App.1 P252"},
    {kInSpaceArc, F::high_speed, Condition::illegal_g, "6.14"},
    {kInSpaceArc, F::high_speed_accuracy, Condition::illegal_g, "6.14"},
    {kInSpaceArc, F::circle_cut_cw, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::circle_cut_ccw, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::polar_command_on, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::comp_left, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::normal_line_left, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::comp_right, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::normal_line_right, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::length_plus, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::length_minus, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::scaling_on, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::mirror_on, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::macro_modal, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::macro_every_block, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::macro_modal_off, Condition::cancel_without_call, "6.14"},
    {kInSpaceArc, F::rotation_on, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_step, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_reverse_tap, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_fine_bore, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_drill, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_spot, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_peck, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_tap, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_bore_feed, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_bore_stop, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_back_bore, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_bore_stop_dwell, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, F::cycle_bore_dwell, Condition::space_arc_mode, "6.14"},
    {kInExponential, F::comp_left, Condition::exponential_mode, "6.11"},
    {kInExponential, F::comp_right, Condition::exponential_mode, "6.11"},
    {kInExponential, F::length_along_tool, Condition::exponential_mode, "6.11"},
    {kInExponential, F::scaling_on, Condition::exponential_mode, "6.11"},
    {kInExponential, F::mirror_on, Condition::exponential_mode, "6.11"},
    {kInExponential, F::rotation_on, Condition::exponential_mode, "6.11"},
};

constexpr unsigned modes_of(const BarredRow* row, const BarredRow* end) { return row == end ? 0u : row->mode | modes_of(row + 1, end); }
static_assert(modes_of(std::begin(kBarred), std::end(kBarred)) == kDefaultBarringModes);

}  // namespace

const Table<PrecedenceRow> kDefaultPrecedence = kInOneBlock;
const Table<BarredRow> kDefaultBarred = kBarred;

}  // namespace nc
