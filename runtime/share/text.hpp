// SPDX-License-Identifier: Apache-2.0
// Texts in fixed arrays: always ended by a NUL, valid UTF-8, cut at a whole character.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "runtime/programs/encoding.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

template <std::size_t kSize>
void set_text(Text<kSize>* text, std::string_view value) {
  const std::string valid = valid_utf8(value);
  const std::string_view kept = cut_utf8(valid, kSize - 1);
  text->fill(0);
  std::memcpy(text->data(), kept.data(), kept.size());
}

// The text up to the NUL, or the whole array when there is no NUL.
template <std::size_t kSize>
std::string_view text_of(const Text<kSize>& text) {
  return {text.data(), strnlen(text.data(), kSize)};
}

template <std::size_t kSize>
bool is_ended(const Text<kSize>& text) {
  return strnlen(text.data(), kSize) < kSize;
}

// The name of a machine in the form that names of segments and DDS partitions have: lower case letters, digits and '-'.
std::string share_name(std::string_view machine);
// Time of day, ns since 1970.
std::int64_t wall_ns();

}  // namespace nc::rt::share
