// SPDX-License-Identifier: Apache-2.0
// The tables of the iso family; iso.cpp puts them together. Their sizes are declared here so that a row that is lost or added by accident is
// an error of compilation.
#pragma once

#include "dialect/dialect.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::iso {

inline constexpr unsigned kFunctionRows = 78;
inline constexpr unsigned kMiscRows = 25;
inline constexpr unsigned kOutputRows = 5;
inline constexpr unsigned kAlarmRows = 9;
inline constexpr unsigned kConditionRows = 77;

extern const FunctionRow kFunctions[kFunctionRows];
extern const MiscRow kMisc[kMiscRows];
extern const OutputRow kOutputs[kOutputRows];
extern const AlarmText kAlarms[kAlarmRows];
extern const AlarmRow kConditions[kConditionRows];
extern const IsoRules kLex;
extern const FamilyParameters kParameters;
extern const FamilyVariables kVariables;

}  // namespace nc::iso
