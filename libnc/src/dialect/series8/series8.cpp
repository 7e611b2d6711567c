// SPDX-License-Identifier: Apache-2.0
// The Series 8 put together, and its state at power on.
#include "dialect/series8/series8.hpp"

#include "dialect/series8/addresses.hpp"
#include "dialect/series8/rules.hpp"
#include "dialect/series8/tables.hpp"

namespace nc::series8 {
namespace {

// The manual does not say what scaling and the end of a cycle are under compensation, whose moves they would change in the middle of a contour: a fault, as
// DGSHAPE G41 has it.
constexpr BarredRow kBarred[] = {
    {kInCompensation, Function::scaling_off, Condition::not_in_compensation, "G41, G58"},
    {kInCompensation, Function::scaling_on, Condition::not_in_compensation, "G41, G57"},
    {kInCompensation, Function::cycle_off, Condition::cycle_in_compensation, "G41, G80"},
};

// G17, G90, G94 and G97 are said to be the default. Of all else it is what cancels, and the motion that does not cut.
const Function kInitial[] = {
    Function::rapid, Function::plane_xy, Function::absolute, Function::feed_per_minute, Function::metric, Function::comp_off,
    Function::cycle_off, Function::rotation_off, Function::scaling_off, Function::surface_off,
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_SERIES8,
    .name = "series8",
    .title = "SERIES 8, PMI, machining centre",
    .lex = &kLex,
    .addresses = kAddressTable,
    .axis_addresses = AddressTable::letters("ABCUVWXYZ"),
    .length_addresses = AddressTable::letters("IJKQR"),
    .functions = kFunctions,
    .misc = kMisc,
    .outputs = kOutputs,
    .conditions = kConditions,
    .alarms = kAlarms,
    .barred = kBarred,
    .parameters = &kParameters,
    .variables = &kVariables,
    .rules = kRules,
    .initial = kInitial,
    .percent_required = false,
    .end_code_required = false,
    .bare_letters = false,  // rules.block.bare_word_is_zero
    .call_depth = 0,
};

}  // namespace nc::series8
