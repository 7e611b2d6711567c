// SPDX-License-Identifier: Apache-2.0
// The HX family put together, and its state at power on.
#include "dialect/hx/hx.hpp"

#include "dialect/hx/addresses.hpp"
#include "dialect/hx/rules.hpp"
#include "dialect/hx/tables.hpp"

namespace nc::hx {
namespace {

// G10: 13.1.3.
constexpr DataInputRow kDataInput[] = {{10, DataInput::tool_length}, {12, DataInput::tool_radius}};

// Returns to reference positions, their check and coordinate system setting are faults while coordinates are scaled or rotated (15.2.2, 15.4.2). In other
// families each has a rule of its own (M700 13.19, 13.20).
constexpr BarredRow kBarred[] = {
    {kInMap, Function::reference_check, Condition::not_accepted, "15.2.2"},
    {kInMap, Function::reference_return, Condition::not_accepted, "15.2.2"},
    {kInMap, Function::start_return, Condition::not_accepted, "15.2.2"},
    {kInMap, Function::second_reference, Condition::not_accepted, "15.2.2"},
    {kInMap, Function::coordinate_set, Condition::not_accepted, "15.2.2"},
    {kInMap, Function::measure_length, Condition::not_accepted, "4.10"},  // a place of the machine as well: the sensor's
};

// 3.2, by the parameters when they are not set; the cancel codes of the other groups.
const Function kInitial[] = {
    Function::rapid, Function::surface_off, Function::absolute, Function::feed_per_minute, Function::metric, Function::comp_off,
    Function::stroke_check_off, Function::cycle_off, Function::scaling_off, Function::macro_modal_off, Function::length_off,
    Function::work_system, Function::cutting_mode, Function::plane_xy, Function::polar_command_off, Function::rotation_off,
    Function::return_initial, Function::polar_off, Function::high_speed_off,
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_HX,
    .name = "hx",
    .title = "TurboTek HX, machining centre",
    .lex = &kLex,
    .addresses = kAddressTable,
    .axis_addresses = AddressTable::letters("ABCUVWXYZ"),
    .length_addresses = AddressTable::letters("IJKQR"),
    .argument_of = kArgumentOf,
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
    .macro_codes = {1, 255},  // 14.1.3 (2)
    .own_codes = {1, 255},
    .macro_misc = {1, 97},    // 11.2
    .percent_required = false,
    .end_code_required = true,  // F_82016
    .bare_letters = false,
    .most_offsets = 128,  // 13.1.1, 14.2.3
    .call_depth = 8,  // 14.1.7 (5): four levels of M98 and four of macros
};

}  // namespace nc::hx
