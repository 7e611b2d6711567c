// SPDX-License-Identifier: Apache-2.0
// The tables of the HX family; hx.cpp puts them together. The sizes stand here so that a row lost or added by accident does not compile.
#pragma once

#include "dialect/dialect.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::hx {

inline constexpr unsigned kFunctionRows = 93;
inline constexpr unsigned kMiscRows = 6;
inline constexpr unsigned kOutputRows = 5;
inline constexpr unsigned kAlarmRows = 22;
inline constexpr unsigned kConditionRows = 37;

extern const FunctionRow kFunctions[kFunctionRows];
extern const MiscRow kMisc[kMiscRows];
extern const OutputRow kOutputs[kOutputRows];
extern const AlarmText kAlarms[kAlarmRows];
extern const AlarmRow kConditions[kConditionRows];
extern const IsoRules kLex;
extern const FamilyParameters kParameters;
extern const FamilyVariables kVariables;

}  // namespace nc::hx
