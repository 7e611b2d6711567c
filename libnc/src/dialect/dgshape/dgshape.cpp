// SPDX-License-Identifier: Apache-2.0
// The dgshape family put together, its state at power on and its machine settings.
#include "dialect/dgshape/dgshape.hpp"

#include "dialect/dgshape/tables.hpp"

namespace nc::dgshape {
namespace {

// 1-5 and G40-G42: settings made on the machine, here parameters by name.
const ParameterName kParameters[] = {
    {"calculator_words", 1, "none|all|F|IJKRXYZA", nullptr, "words that the calculator type applies to", "1-5"},
    {"interpretation", 0, "conventional|calculator", nullptr, "type of numbers without a point", "1-5"},
    {"startup", 0, "A|B", nullptr, "how tool-diameter offset starts and ends", "G40-G42"},
};

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_DGSHAPE,
    .name = "dgshape",
    .lex = &kLex,
    .functions = {kFunctions, kFunctionRows},
    .misc = {kMisc, kMiscRows},
    .conditions = {kConditions, kConditionRows},
    .alarms = {kAlarms, kAlarmRows},
    .parameters = {kParameters, sizeof kParameters / sizeof kParameters[0]},
    // The manual does not say what is active at power on. G00 G17 G90 and mm are the safe ones; of every
    // other group the cancel code.
    .initial = {-1,  0,   170, 900, -1, -1, 210, 400, 490, 800, 980,
                500, 540, -1,  -1,  -1, -1, -1,  -1,  -1,  -1,  -1},
    .percent_required = true,   // 2-6 "%"
    .end_code_required = true,  // 1-1 "M02"
    .bare_letters = false,      // 1-1: a word is an address and a numerical value
    .call_depth = 0,
};

}  // namespace nc::dgshape
