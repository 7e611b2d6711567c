// SPDX-License-Identifier: Apache-2.0
// What a condition is to a family that has no row for it: most manuals number some of their alarms only, and a family cannot meet each condition.
// The codes are ours: NC- and a word that says what is wrong. One may stand for several conditions, the sentence for the operator tells them apart.
#pragma once

#include "dialect/dialect.hpp"

namespace nc {

/// Codes with their texts.
extern const Table<AlarmText> kDefaultAlarms;
/// One row for each condition.
extern const Table<AlarmRow> kDefaultConditions;

}  // namespace nc
