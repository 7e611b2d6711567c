// SPDX-License-Identifier: Apache-2.0
// The iso family put together, and its state at power on.
#include "dialect/iso/iso.hpp"

#include "dialect/iso/addresses.hpp"
#include "dialect/iso/rules.hpp"
#include "dialect/iso/tables.hpp"

namespace nc::iso {
namespace {

// What G10 L sets (LinuxCNC G10).
constexpr DataInputRow kDataInput[] = {
    {1, DataInput::missing},  // tool table
    {2, DataInput::work_offset},
    {10, DataInput::missing},  // tool table, calculated from the position of the tool
    {11, DataInput::missing},  // the same in a fixture
    {20, DataInput::work_offset_here},
};

// RS-274/NGC 3.6.1 says which codes are in force after M2; the rest are the cancel codes. A motion is in force from the start on, namely the one
// that does not cut: see docs/decisions.md.
const Function kInitial[] = {
    Function::rapid, Function::plane_xy, Function::absolute, Function::centre_incremental, Function::feed_per_minute,
    Function::metric, Function::comp_off, Function::length_off, Function::cycle_off, Function::return_initial,
    Function::work_system, Function::cutting_mode, Function::surface_off,
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_ISO,
    .name = "iso",
    .title = "ISO 6983 and RS-274 as CAM systems and LinuxCNC users write it, machining centre",
    .lex = &kLex,
    .addresses = kAddressTable,
    .axis_addresses = AddressTable::letters("ABCUVWXYZ"),
    .length_addresses = AddressTable::letters("IJKQR"),
    .functions = kFunctions,
    .misc = kMisc,
    .outputs = kOutputs,
    .conditions = kConditions,
    .alarms = kAlarms,
    .data_input = kDataInput,
    .parameters = &kParameters,
    .variables = &kVariables,
    .rules = kRules,
    .initial = kInitial,
    .percent_required = false,   // RS-274/NGC 3.4: the % lines may be left out
    .end_code_required = false,  // docs/decisions.md: the program ends where its text ends
    .bare_letters = false,       // RS-274/NGC 3.3.2: a word is a letter and a value
    .call_depth = 0,
};

}  // namespace nc::iso
