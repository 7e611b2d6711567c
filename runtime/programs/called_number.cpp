// SPDX-License-Identifier: Apache-2.0
// See called_number.hpp.
#include "runtime/programs/called_number.hpp"

namespace nc::rt {

std::optional<unsigned long> called_number(const std::string& name) {
  if (name.size() < 2 || (name[0] != 'o' && name[0] != 'O')) return std::nullopt;
  size_t end = 1;
  unsigned long number = 0;
  while (end < name.size() && name[end] >= '0' && name[end] <= '9') {
    number = number * 10 + static_cast<unsigned long>(name[end] - '0');
    if (++end > 10) return std::nullopt;
  }
  if (end == 1 || (end < name.size() && name[end] != '.')) return std::nullopt;
  return number;
}

}  // namespace nc::rt
