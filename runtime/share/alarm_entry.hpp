// SPDX-License-Identifier: Apache-2.0
// The texts of an active alarm as displays and the history show them.
#pragma once

#include "runtime/runtime.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

// Fills in code, text, axis, whether it is a warning, and the place when the feeder knows a better one. False: the details come from the feeder and are not there yet.
bool describe_alarm(const Runtime& runtime, const FeederInfo& info, const ActiveAlarm& alarm, Entry* entry);

}  // namespace nc::rt::share
