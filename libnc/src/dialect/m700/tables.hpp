// SPDX-License-Identifier: Apache-2.0
// The tables of the m700 family; m700.cpp puts them together. Their sizes are declared here so that a row that is lost or added by accident
// is an error of compilation: a definition with another number of rows conflicts with its declaration.
#pragma once

#include "dialect/dialect.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::m700 {

inline constexpr unsigned kFunctionRows = 286;
inline constexpr unsigned kMiscRows = 9;
inline constexpr unsigned kOutputRows = 5;
inline constexpr unsigned kAlarmRows = 191;
inline constexpr unsigned kConditionRows = static_cast<unsigned>(Condition::count_) - 1;

struct FunctionTable {
  FunctionRow row[kFunctionRows];
};
extern const FunctionTable kFunctionTable;
extern const MiscRow kMisc[kMiscRows];
extern const OutputRow kOutputs[kOutputRows];
extern const AlarmText kAlarms[kAlarmRows];
extern const AlarmRow kConditions[kConditionRows];
extern const IsoRules kLex;
extern const FamilyParameters kParameters;
extern const FamilyVariables kVariables;

}  // namespace nc::m700
