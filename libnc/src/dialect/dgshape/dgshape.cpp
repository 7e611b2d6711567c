// SPDX-License-Identifier: Apache-2.0
// The dgshape family put together, and its state at power on.
#include "dialect/dgshape/dgshape.hpp"

#include "dialect/dgshape/addresses.hpp"
#include "dialect/dgshape/rules.hpp"
#include "dialect/dgshape/tables.hpp"

namespace nc::dgshape {
namespace {

// What G10 L sets.
constexpr DataInputRow kDataInput[] = {
    {DataInputRow::kWithoutL, DataInput::tool_radius},  // P R sets the tool-diameter offset; lengths are set on the machine alone (G43)
    {2, DataInput::work_offset},
};

// Fixed cycles and scaling are errors under diameter offset, and so are the codes that end them (G40-G42). M700 13.19 compensates the scaled shape. The codes
// that begin a fixed cycle are checked where a cycle begins (interpret/functions/cycle.cpp).
constexpr BarredRow kBarred[] = {
    {kInCompensation, Function::scaling_off, Condition::not_in_compensation, "G41"},
    {kInCompensation, Function::scaling_on, Condition::not_in_compensation, "G41"},
    {kInCompensation, Function::cycle_off, Condition::cycle_in_compensation, "G41"},
};

// The manual does not say which codes are active at power on. G00, G17, G90 and mm are the safe ones; of every other group it is the cancel
// code.
const Function kInitial[] = {
    Function::rapid, Function::plane_xy, Function::absolute, Function::metric, Function::comp_off,
    Function::length_off, Function::cycle_off, Function::return_initial, Function::scaling_off,
    Function::work_system,
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_DGSHAPE,
    .name = "dgshape",
    .title = "DGSHAPE NC code (JIS), modelling machines",
    .lex = &kLex,
    .addresses = kAddressTable,
    .axis_addresses = AddressTable::letters("XYZA"),
    .length_addresses = AddressTable::letters("IJKQR"),
    .functions = kFunctions,
    .misc = kMisc,
    .outputs = kOutputs,
    .conditions = kConditions,
    .alarms = kAlarms,
    .barred = kBarred,
    .data_input = kDataInput,
    .parameters = &kParameters,
    .variables = &kVariables,
    .rules = kRules,
    .initial = kInitial,
    .percent_required = true,   // 2-6 "%"
    .end_code_required = true,  // 1-1 "M02"
    .bare_letters = false,      // 1-1: a word is an address and a numerical value
    .call_depth = 0,
};

}  // namespace nc::dgshape
