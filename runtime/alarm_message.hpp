// SPDX-License-Identifier: Apache-2.0
// The sentence of an alarm of the control, as displays and answers show it behind its code.
#pragma once

#include <string>

#include "nc/nc.h"

namespace nc::rt {

inline std::string alarm_message(const nc_alarm& alarm) {
  const std::string message = alarm.message, detail = alarm.detail.s;
  return message.empty() || detail.empty() ? message + detail : message + ": " + detail;
}

}  // namespace nc::rt
