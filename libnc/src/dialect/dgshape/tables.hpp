// SPDX-License-Identifier: Apache-2.0
// The tables of the dgshape family; dgshape.cpp puts them together. Their sizes are declared here so that a row that is lost or added by
// accident is an error of compilation.
#pragma once

#include "dialect/dialect.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::dgshape {

inline constexpr unsigned kFunctionRows = 39;
inline constexpr unsigned kMiscRows = 6;
inline constexpr unsigned kOutputRows = 9;
inline constexpr unsigned kAlarmRows = 5;
inline constexpr unsigned kConditionRows = 74;

extern const FunctionRow kFunctions[kFunctionRows];
extern const MiscRow kMisc[kMiscRows];
extern const OutputRow kOutputs[kOutputRows];
extern const AlarmText kAlarms[kAlarmRows];
extern const AlarmRow kConditions[kConditionRows];
extern const IsoRules kLex;
extern const FamilyParameters kParameters;
extern const FamilyVariables kVariables;

}  // namespace nc::dgshape
