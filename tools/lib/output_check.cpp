// SPDX-License-Identifier: Apache-2.0
// See output_check.hpp.
#include "tools/lib/output_check.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

namespace nc::tools {

bool can_be_written(const std::string& path, std::string* error) {
  constexpr int kFlags = O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  int descriptor = open(path.c_str(), kFlags);
  if (descriptor < 0 && errno == ENOENT) {
    descriptor = open(path.c_str(), kFlags | O_CREAT | O_EXCL, 0666);
    if (descriptor >= 0) unlink(path.c_str());
  }
  if (descriptor < 0) {
    *error = path + ": cannot be written: " + std::generic_category().message(errno);
    return false;
  }
  close(descriptor);
  return true;
}

bool standard_output_written() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
}

int status_when_written(const char* program, int status, int unwritten) {
  if (standard_output_written() || status != 0) return status;
  std::fprintf(stderr, "%s: standard output cannot be written\n", program);
  return unwritten;
}

}  // namespace nc::tools
