// SPDX-License-Identifier: Apache-2.0
// The tables of company.hpp.
#include "modal/company.hpp"

namespace nc {
namespace {

using F = Function;

constexpr Beside kBoth = Beside::both, kIgnored = Beside::ignored, kModal = Beside::modal, kLoses = Beside::loses;

// M700 appendix 2, one row for each commanded code in its order. The cells that are alarms have rules of their own where the state decides:
// arc with G41 G42 P151 and with G43 G44 P70, G31 under compensation P608, cycles under compensation P155, planes P112.
constexpr CompanyRow kCompany[] = {
    // function            01      07        08        09        12      14      19
    {F::dwell,             kModal, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::data_input,        kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::data_input_end,    kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::reference_check,   kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::reference_return,  kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::start_return,      kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::second_reference,  kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::tool_change_return, kModal, kBoth,   kBoth,    kIgnored, kBoth,  kLoses, kIgnored},
    {F::skip,              kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::multi_skip,        kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
    {F::measure_length,    kModal, kIgnored, kIgnored, kIgnored, kBoth,  kLoses, kIgnored},
    {F::mirror_on,         kBoth,  kBoth,    kBoth,    kIgnored, kBoth,  kLoses, kBoth},
    {F::mirror_off,        kBoth,  kBoth,    kBoth,    kIgnored, kBoth,  kLoses, kBoth},
    {F::local_system,      kModal, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::machine_move,      kModal, kIgnored, kIgnored, kIgnored, kBoth,  kBoth,  kIgnored},
    {F::macro_call,        kModal, kBoth,    kModal,   kIgnored, kBoth,  kBoth,  kIgnored},
    {F::macro_modal,       kModal, kBoth,    kModal,   kIgnored, kModal, kBoth,  kIgnored},
    {F::macro_every_block, kModal, kBoth,    kModal,   kIgnored, kModal, kBoth,  kIgnored},
    {F::macro_modal_off,   kModal, kBoth,    kModal,   kIgnored, kModal, kBoth,  kIgnored},
    {F::coordinate_set,    kModal, kBoth,    kBoth,    kIgnored, kBoth,  kBoth,  kIgnored},
};
/// Any other code that takes the axis words of the block: mirror cannot have them, too.
constexpr CompanyRow kAlone{F::missing, kBoth, kBoth, kBoth, kBoth, kBoth, kBoth, kIgnored};

constexpr BarredRow kBarred[] = {
    {kInPolarCommand, 51, 51, Condition::illegal_g, "6.12"},
    {kInFigure, 450, 450, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, 460, 460, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, 470, 470, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, 480, 480, Condition::offset_in_figure, "App.1 P141"},
    {kInFigure, 680, 690, Condition::rotation_in_figure, "App.1 P252"},
    {kInSpaceArc, 50, 51, Condition::illegal_g, "6.14"},
    {kInSpaceArc, 120, 120, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 130, 130, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 160, 160, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 410, 411, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 420, 421, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 430, 430, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 440, 440, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 510, 511, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 660, 661, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 670, 670, Condition::cancel_without_call, "6.14"},
    {kInSpaceArc, 680, 680, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 730, 740, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 760, 760, Condition::space_arc_mode, "6.14"},
    {kInSpaceArc, 810, 890, Condition::space_arc_mode, "6.14"},
    {kInExponential, 410, 410, Condition::exponential_mode, "6.11"},
    {kInExponential, 420, 420, Condition::exponential_mode, "6.11"},
    {kInExponential, 431, 431, Condition::exponential_mode, "6.11"},
    {kInExponential, 510, 511, Condition::exponential_mode, "6.11"},
    {kInExponential, 680, 680, Condition::exponential_mode, "6.11"},
    // Fixed cycles and scaling are errors there, and so are the codes that end them. Those that begin them have their own checks.
    {kInDiameterOffset, 500, 510, Condition::not_in_compensation, "DGSHAPE G41"},
    {kInDiameterOffset, 800, 800, Condition::cycle_in_compensation, "DGSHAPE G41"},
};

}  // namespace

const CompanyRow& company_of(Function function) {
  for (const CompanyRow& row : kCompany)
    if (row.function == function) return row;
  return kAlone;
}

Condition barred(unsigned modes, int16_t code) {
  for (const BarredRow& row : kBarred)
    if ((row.mode & modes) != 0 && code >= row.first && code <= row.last) return row.condition;
  return Condition::none;
}

}  // namespace nc
