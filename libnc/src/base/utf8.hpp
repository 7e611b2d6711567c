// SPDX-License-Identifier: Apache-2.0
// Cutting texts. Those of programs are UTF-8 (nc/control.h); one that is not is cut where it must.
#pragma once

#include <cstddef>

namespace nc {

/// The largest number of bytes, at most `length`, behind which text[] may be cut without leaving part of a character. text[length] is read.
inline size_t whole_characters(const char* text, size_t length) {
  constexpr size_t kLongest = 4;  // bytes of a character
  size_t at = length;
  while (at > 0 && length - at < kLongest && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) --at;
  return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80 ? length : at;
}

}  // namespace nc
