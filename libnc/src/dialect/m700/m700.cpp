// SPDX-License-Identifier: Apache-2.0
// The m700 family put together, its state at power on and its parameters that are not plain numbers.
#include "dialect/m700/m700.hpp"

#include "dialect/m700/tables.hpp"

namespace nc::m700 {
namespace {

// Every parameter has a number; these have none in the manual: UNIT*10 is only named (2.2), the blanks of
// DPRNT are "a parameter" (13.5.8), M codes that prohibit pre-reading and the order of M S T B and motion are the
// machine's (4.2, 9.1), macro_extensions and negative_count are options (docs/macros.md), and ';' begins comments in other families only.
const ParameterName kParameters[] = {
    {"UNIT*10", 1, nullptr, "1, 10", "tenfold: numbers without a point, times this", "2.2"},
    {"DPRNT_BLANK", 0, nullptr, "0, 1", "DPRNT prints blanks for leading zeros", "13.5.8"},
    {"macro_extensions", 0, nullptr, "0, 1", "IF ... THEN of later models", "13.5.7"},
    {"semicolon_comments", 0, nullptr, "0, 1", "what stands behind ';' in a line is a comment, not P33", "3.2"},
    {"negative_count", 0, nullptr, "0, 1", "#3901 can be set below 0", "13.5.5"},
    {"MSTB_AFTER_MOTION", 0, nullptr, "0, 1", "M S T B of a block come after its movement", "9.1"},
    {"PREREAD_STOP_M1", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M2", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M3", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M4", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M5", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M6", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M7", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
    {"PREREAD_STOP_M8", 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2"},
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_M700,
    .name = "m700",
    .lex = &kLex,
    .functions = {kFunctionTable.row, kFunctionRows},
    .misc = {kMisc, kMiscRows},
    .conditions = {kConditions, kConditionRows},
    .alarms = {kAlarms, kAlarmRows},
    .parameters = {kParameters, sizeof kParameters / sizeof kParameters[0]},
    // 3.7: the codes marked as initial, and of those that a parameter chooses G01 G17 G21 G90 G94 G97. Groups
    // 0 and 20 hold no modal.
    .initial = {-1,  10,  170, 900, 230, 940, 210, 400, 490, 800, 980,
                500, 540, 640, 670, 401, 690, 970, 150, 501, -1,  131},
    .percent_required = false,
    .end_code_required = true,  // P36
    .bare_letters = true,       // 3.7, 14.10
    .call_depth = 8,            // 13.3.1
};

}  // namespace nc::m700
