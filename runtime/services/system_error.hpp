// SPDX-License-Identifier: Apache-2.0
// What the operating system says of a failed call.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

namespace nc::rt::services {

/** `what` (a path, a call) and the reason of the call that has just failed, from errno. For the threads outside the scan only. */
inline std::string system_error(const std::string& what) { return what + ": " + std::strerror(errno); }

}  // namespace nc::rt::services
