// SPDX-License-Identifier: Apache-2.0
// The tables of precedence.hpp.
#include "modal/precedence.hpp"

namespace nc {
namespace {

using F = Function;

constexpr Precedence kBoth = Precedence::both, kIgnored = Precedence::ignored, kModal = Precedence::modal, kLoses = Precedence::loses;

// M700 appendix 2: one row for each commanded code, in the order of the appendix. The cells that are alarms are checked elsewhere, where the state
// decides: arc with G41 G42 P151 and with G43 G44 P70, G31 under compensation P608, cycles under compensation P155, planes P112.
constexpr PrecedenceRow kInOneBlock[] = {
    // function            motion  radius    length    cycle     work    macro   mirror
    {F::dwell,             kModal, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::data_input,        kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::data_input_end,    kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::parameter_input_end, kModal, kIgnored, kIgnored, kIgnored, kBoth, kLoses, kIgnored},
    {F::reference_check,   kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::reference_return,  kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::start_return,      kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::second_reference,  kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::tool_change_return, kModal, kBoth,   kBoth,    kIgnored, kBoth,  kLoses, kIgnored},
    {F::skip,              kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::multi_skip,        kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_once,        kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe,             kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_try,         kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_away,        kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::probe_away_try,    kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::measure_length,    kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::mirror_on,         kBoth,  kBoth,    kBoth,    kIgnored, kBoth,  kLoses, kBoth},
    {F::mirror_off,        kBoth,  kBoth,    kBoth,    kIgnored, kBoth,  kLoses, kBoth},
    {F::local_system,      kModal, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::machine_move,      kModal, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::holes_on_circle,   kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},  // 13.2, notes 4 and 5
    {F::holes_on_line,     kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::holes_on_arc,      kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::holes_on_grid,     kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::macro_call,        kModal, kBoth,    kModal,   kIgnored, kBoth,  kBoth,  kIgnored},
    {F::macro_modal,       kModal, kBoth,    kModal,   kIgnored, kModal, kBoth,  kIgnored},
    {F::macro_every_block, kModal, kBoth,    kModal,   kIgnored, kModal, kBoth,  kIgnored},
    {F::macro_modal_off,   kModal, kBoth,    kModal,   kIgnored, kModal, kBoth,  kIgnored},
    {F::coordinate_set,    kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
};
/// Any other code that uses the axis words of the block, so that mirror cannot use them, too.
constexpr PrecedenceRow kAnyOther{F::count_, kBoth, kBoth, kBoth, kBoth, kBoth, kBoth, kIgnored};

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
    // DGSHAPE: fixed cycles and scaling are errors under diameter offset, and so are the codes that end them. The codes that begin a fixed cycle are
    // checked elsewhere.
    {kInDiameterOffset, F::scaling_off, Condition::not_in_compensation, "DGSHAPE G41"},
    {kInDiameterOffset, F::scaling_on, Condition::not_in_compensation, "DGSHAPE G41"},
    {kInDiameterOffset, F::cycle_off, Condition::cycle_in_compensation, "DGSHAPE G41"},
    {kInMap, F::reference_check, Condition::not_accepted, "HX 15.2.2"},
    {kInMap, F::reference_return, Condition::not_accepted, "HX 15.2.2"},
    {kInMap, F::start_return, Condition::not_accepted, "HX 15.2.2"},
    {kInMap, F::second_reference, Condition::not_accepted, "HX 15.2.2"},
    {kInMap, F::coordinate_set, Condition::not_accepted, "HX 15.2.2"},
};

}  // namespace

const PrecedenceRow& precedence_of(Function function) {
  for (const PrecedenceRow& row : kInOneBlock)
    if (row.function == function) return row;
  return kAnyOther;
}

Condition barred(unsigned modes, Function function) {
  for (const BarredRow& row : kBarred)
    if ((row.mode & modes) != 0 && function == row.function) return row.condition;
  return Condition::none;
}

}  // namespace nc
