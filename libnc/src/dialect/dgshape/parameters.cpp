// SPDX-License-Identifier: Apache-2.0
// The machine settings of the dgshape family: its parameters have no numbers, and it has no variables.
#include "dialect/dgshape/tables.hpp"

namespace nc::dgshape {
namespace {

using P = Parameter;

// DGSHAPE 1-5 and G40-G42: settings that are made on the machine. Here they are parameters with names.
constexpr ParameterName kNames[] = {
    {"calculator_words", P::calculator_words, 0, 1, "none|all|F|IJKRXYZA", nullptr, "words that the calculator type applies to", "1-5"},
    {"interpretation", P::calculator, 0, 0, "conventional|calculator", nullptr, "type of numbers without a point", "1-5"},
    {"startup", P::comp_type_b, 0, 0, "A|B", nullptr, "how tool-diameter offset starts and ends", "G40-G42"},
};

// Values for which other families have a parameter and this one has none.
constexpr FixedParameter kFixed[] = {
    {P::tool_memory_type, 2},  // G43, G41: lengths are set on the machine, and are no tool-diameter offsets
};

}  // namespace

constinit const FamilyParameters kParameters = {
    .names = {kNames, sizeof kNames / sizeof kNames[0]},
    .fixed = kFixed,
    .arc_tolerance_mm = 0.01,      // the manual gives none: see docs/decisions.md
    .checks_interference = false,  // the manual knows no interference check
};

constinit const FamilyVariables kVariables = {};

}  // namespace nc::dgshape
