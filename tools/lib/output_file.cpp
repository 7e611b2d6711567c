// SPDX-License-Identifier: Apache-2.0
// Buffered output; see output_file.hpp.
#include "tools/lib/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace nc::tools {

OutputFile::OutputFile(int descriptor) : descriptor_(descriptor), buffer_(new char[kCapacity]) {}

void OutputFile::spill() {
  size_t done = 0;
  while (done < used_ && error_ == 0) {
    const ssize_t n = write(descriptor_, buffer_.get() + done, used_ - done);
    if (n >= 0)
      done += static_cast<size_t>(n);
    else if (errno != EINTR)
      error_ = errno;
  }
  used_ = 0;  // after an error the contents are dropped; the caller stops when it looks at failed()
}

bool OutputFile::flush() {
  spill();
  return error_ == 0;
}

std::string OutputFile::error_text() const {
  return std::generic_category().message(error_);
}

}  // namespace nc::tools
