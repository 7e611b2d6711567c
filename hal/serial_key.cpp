// SPDX-License-Identifier: Apache-2.0
// Which serial line a path means. See serial_key.hpp.
#include "hal/serial_key.hpp"

#include <sys/stat.h>

namespace nc::hal {

std::string serial_key(const std::string& path) {
  struct stat status {};
  if (path.empty() || ::stat(path.c_str(), &status) != 0) return "serial " + path;
  const bool device = S_ISCHR(status.st_mode);
  return "serial " + std::to_string(device ? status.st_rdev : status.st_dev) + " " + std::to_string(device ? 0 : status.st_ino);
}

}  // namespace nc::hal
