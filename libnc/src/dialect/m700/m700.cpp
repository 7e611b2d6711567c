// SPDX-License-Identifier: Apache-2.0
// The m700 family put together, and its state at power on.
#include "dialect/m700/m700.hpp"

#include "dialect/m700/addresses.hpp"
#include "dialect/m700/rules.hpp"
#include "dialect/m700/tables.hpp"

namespace nc::m700 {
namespace {

// What G10 L sets (12.7, 14.10 (6)).
constexpr DataInputRow kDataInput[] = {
    {DataInputRow::kWithoutL, DataInput::work_offset},  // the same as L2
    {2, DataInput::work_offset},
    {3, DataInput::tool_life},
    {10, DataInput::tool_length},
    {11, DataInput::tool_length_wear},
    {12, DataInput::tool_radius},
    {13, DataInput::tool_radius_wear},
    {14, DataInput::current_limit},  // 15.6
    {20, DataInput::extended_offset},
    {50, DataInput::parameters},  // 13.11
    {70, DataInput::parameters},
};

// The values of P beside G05 (13.16, 13.17), and of Q beside G05.1 (13.17, 13.18).
constexpr SpeedModeRow kSpeedModes[] = {
    {0, SpeedMode::off},          {1, SpeedMode::machining_1},    {2, SpeedMode::machining_2},
    {3, SpeedMode::machining_3},  {10000, SpeedMode::accuracy_2},
};
constexpr SpeedOptionRow kSpeedOptions[] = {{0, SpeedOption::off}, {1, SpeedOption::accuracy_1}, {2, SpeedOption::spline}};

// The codes that 3.7 marks as initial. If a parameter chooses the initial code of a group, it is G01, G17, G21, G90, G94 or G97 here.
const Function kInitial[] = {
    Function::linear, Function::plane_xy, Function::absolute, Function::stroke_check_off,
    Function::feed_per_minute, Function::metric, Function::comp_off, Function::length_off,
    Function::cycle_off, Function::return_initial, Function::scaling_off, Function::work_system,
    Function::cutting_mode, Function::macro_modal_off, Function::normal_line_off, Function::rotation_off,
    Function::surface_off, Function::polar_command_off, Function::mirror_off, Function::polar_off,
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_M700,
    .name = "m700",
    .title = "Mitsubishi CNC 700 series, machining centre",
    .lex = &kLex,
    .addresses = kAddressTable,
    .axis_addresses = AddressTable::letters("ABCUVWXYZ"),
    .length_addresses = AddressTable::letters("IJKQR"),
    .argument_of = kArgumentOf,
    .calling_words = AddressTable::letters("ABDFHIJKMQRST"),  // 13.5.3
    .device_letter = 'D',               // 13.3.1
    .functions = {kFunctionTable.row, kFunctionRows},
    .misc = kMisc,
    .outputs = kOutputs,
    .conditions = kConditions,
    .alarms = kAlarms,
    .data_input = kDataInput,
    .speed_modes = kSpeedModes,
    .speed_options = kSpeedOptions,
    .parameters = &kParameters,
    .variables = &kVariables,
    .rules = kRules,
    .initial = kInitial,
    .macro_codes = {100, 255},  // 13.5.2
    .own_codes = {0, 99},       // 13.5.2: by #1081
    .macro_misc = {0, 95},      // 13.5.2 (2)
    .interrupt_misc = {3, 97},  // 13.12
    .percent_required = false,
    .end_code_required = true,  // P36
    .bare_letters = true,       // 3.7, 14.10
    .call_depth = 8,            // 13.3.1
};

}  // namespace nc::m700
