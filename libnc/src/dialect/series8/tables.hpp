// SPDX-License-Identifier: Apache-2.0
// The tables of the Series 8; series8.cpp puts them together. The sizes stand here so that a row lost or added by accident does not compile.
#pragma once

#include "dialect/dialect.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::series8 {

inline constexpr unsigned kFunctionRows = 51;
inline constexpr unsigned kMiscRows = 8;
inline constexpr unsigned kOutputRows = 7;
inline constexpr unsigned kAlarmRows = 1;
inline constexpr unsigned kConditionRows = 4;

extern const FunctionRow kFunctions[kFunctionRows];
extern const MiscRow kMisc[kMiscRows];
extern const OutputRow kOutputs[kOutputRows];
extern const AlarmText kAlarms[kAlarmRows];
extern const AlarmRow kConditions[kConditionRows];
extern const IsoRules kLex;
extern const FamilyParameters kParameters;
extern const FamilyVariables kVariables;

}  // namespace nc::series8
