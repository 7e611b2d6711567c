// SPDX-License-Identifier: Apache-2.0
// Shared by the fuzz targets: a reader of the input, and requirements that name their line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace nc::fuzz {

/// Ends the run and says which line did not hold, so that the log alone tells what was found.
inline void require(bool holds, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (holds) return;
  std::fprintf(stderr, "ERROR: what %s requires in line %d does not hold\n", file, line);
  std::abort();
}

/// The bytes of the input; 0 after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  template <class T>
  T value() {
    T result{};
    const std::size_t count = std::min(sizeof(T), size_ - at_);
    std::memcpy(&result, data_ + at_, count);
    at_ += count;
    return result;
  }
  /// At most `length` bytes.
  std::string text(std::size_t length) {
    const std::size_t count = std::min(length, size_ - at_);
    std::string result(reinterpret_cast<const char*>(data_) + at_, count);
    at_ += count;
    return result;
  }
  std::string rest() { return text(size_ - at_); }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

}  // namespace nc::fuzz
