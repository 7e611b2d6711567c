// SPDX-License-Identifier: Apache-2.0
// See work_offset_name.hpp.
#include "runtime/work_offset_name.hpp"

#include <charconv>

namespace nc::rt {
namespace {
constexpr std::string_view kExternal = "EXT", kPlain = "G5", kExtended = "G54.1P";
constexpr char kFirstPlain = '4';
}  // namespace

std::optional<unsigned> whole_number(std::string_view text, unsigned min, unsigned max) {
  unsigned value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || value < min || value > max)
    return {};
  return value;
}

std::optional<unsigned> work_offset_index(std::string_view name, unsigned sets) {
  if (name == kExternal) return 0;
  if (name.size() == 3 && name.substr(0, 2) == kPlain && name[2] >= kFirstPlain && name[2] <= '9')
    return static_cast<unsigned>(name[2] - kFirstPlain + 1);
  if (name.substr(0, kExtended.size()) != kExtended) return {};
  const auto number = whole_number(name.substr(kExtended.size()), 1, sets);
  return number ? std::optional<unsigned>(kExtendedWorkOffset + *number) : std::nullopt;
}

std::string work_offset_name(unsigned index) {
  if (index == 0) return std::string(kExternal);
  if (index <= kPlainWorkOffsets) return std::string(kPlain) + static_cast<char>(kFirstPlain + index - 1);
  return std::string(kExtended) + std::to_string(index - kExtendedWorkOffset);
}

}  // namespace nc::rt
