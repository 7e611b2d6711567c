// SPDX-License-Identifier: Apache-2.0
// Cutting texts. They should be UTF-8; one that is not is cut at any byte.
#pragma once

#include <cstddef>

namespace nc {

/// The largest number of bytes, at most `length`, after which text[] can be cut without cutting a character. text[length] is read.
inline size_t whole_characters(const char* text, size_t length) {
  constexpr size_t kLongest = 4;  // bytes of a character
  size_t at = length;
  while (at > 0 && length - at < kLongest && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) --at;
  return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80 ? length : at;
}

}  // namespace nc
