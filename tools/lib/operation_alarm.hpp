// SPDX-License-Identifier: Apache-2.0
// Operation alarms: what holds the axes on a machine though the program is right, until the operator changes something (NC_CAUSE_FEED_ZERO,
// NC_CAUSE_SPINDLE_STOPPED). In an offline run nobody does, so the program stops there with the number that the manual prints.
#pragma once

#include <cstdio>

#include "nc/nc.h"

namespace nc::tools {

/** The operation alarm of M700 that a move raises while the spindle is commanded to turn with `rev_min`; false: none. `source` stays as it is. */
inline bool operation_alarm(const nc_move& move, double rev_min, nc_alarm* alarm) {
  if (move.kind == NC_MOVE_RAPID || move.kind == NC_MOVE_TAP) return false;
  const bool synchronous = move.feed_mm_rev > 0.0;
  if (synchronous ? rev_min > 0.0 : move.feed_mm_min > 0.0) return false;
  // M700 7.4 note 3; 7.3: F1 to F5 whose speed is 0.
  std::snprintf(alarm->code, sizeof alarm->code, "%s", synchronous ? "105" : "104");
  std::snprintf(alarm->message, sizeof alarm->message, "%s", synchronous ? "Spindle speed 0 in synchronous feed" : "Feed rate 0");
  std::snprintf(alarm->detail.s, sizeof alarm->detail.s, "%s",
                synchronous ? "A feed per revolution or a thread waits for the spindle: no S is in force." : "The speed of this feed of one digit is 0.");
  alarm->axis = -1;
  return true;
}

}  // namespace nc::tools
