// SPDX-License-Identifier: Apache-2.0
// Buffered output to a descriptor: it takes whole lines, makes few write() calls, and keeps an error until it is asked for.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace nc::tools {

/** Does not own the descriptor. The destructor does not write: call flush() and check its result. */
class OutputFile {
 public:
  explicit OutputFile(int descriptor);

  /** Returns room for `size` <= kLargest bytes; advance() must follow. */
  char* reserve(size_t size) {
    if (size > kCapacity - used_) spill();
    return buffer_.get() + used_;
  }
  void advance(size_t size) { used_ += size; }

  /** Writes everything. @return false when this or an earlier write failed. */
  bool flush();

  bool failed() const { return error_ != 0; }
  /** Why writing failed, in the words of the system ("Broken pipe", "No space left on device"). */
  std::string error_text() const;

  static constexpr size_t kLargest = 64 * 1024;

 private:
  static constexpr size_t kCapacity = 256 * 1024;
  void spill();

  int descriptor_;
  int error_ = 0;
  size_t used_ = 0;
  std::unique_ptr<char[]> buffer_;
};

}  // namespace nc::tools
