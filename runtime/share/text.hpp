// SPDX-License-Identifier: Apache-2.0
// Texts in fixed arrays: always ended by a NUL, cut at a whole UTF-8 character.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "runtime/share/layout.hpp"

namespace nc::rt::share {

template <std::size_t kSize>
void set_text(Text<kSize>* text, std::string_view value) {
  std::size_t length = value.size() < kSize ? value.size() : kSize - 1;
  if (length < value.size())
    while (length > 0 && (static_cast<unsigned char>(value[length]) & 0xC0) == 0x80) --length;
  text->fill(0);
  std::memcpy(text->data(), value.data(), length);
}

// Up to the NUL, or all of it when there is none.
template <std::size_t kSize>
std::string_view text_of(const Text<kSize>& text) {
  return {text.data(), strnlen(text.data(), kSize)};
}

template <std::size_t kSize>
bool is_ended(const Text<kSize>& text) {
  return strnlen(text.data(), kSize) < kSize;
}

// Name of a machine as a name of a segment and of a partition: lower case letters, digits and '-'.
std::string share_name(std::string_view machine);
// Time of day, ns since 1970.
std::int64_t wall_ns();

}  // namespace nc::rt::share
