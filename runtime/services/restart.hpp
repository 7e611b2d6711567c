// SPDX-License-Identifier: Apache-2.0
// What the services show of a program that is begun inside (runtime/restart/).
#pragma once

#include <string>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::services {

Outcome show_restart(Runtime* runtime, const Call& call);
// The place that a command looks for, in words: "line 12 of O9001, time 3".
std::string restart_words(const share::Request& request);

}  // namespace nc::rt::services
