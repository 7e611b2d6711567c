// SPDX-License-Identifier: Apache-2.0
// Which serial line a path means: two names of one device are one line.
#pragma once

#include <string>

namespace nc::hal {

// "serial 1025 0": the device, and for a file that is none its place on its disk. Of a path where there is nothing now, the path, so that at
// least the same path is the same line.
std::string serial_key(const std::string& path);

}  // namespace nc::hal
