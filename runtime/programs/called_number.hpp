// SPDX-License-Identifier: Apache-2.0
// The number by which a call finds a file. Who finds files, and who protects what would be found, ask the same function.
#pragma once

#include <optional>
#include <string>

namespace nc::rt {

// The number in a name `O<digits>` or `O<digits>.<anything>`, in upper or lower case; what stands behind the first point does not count. At most 9 digits are read, because O
// numbers have at most 8.
std::optional<unsigned long> called_number(const std::string& name);

}  // namespace nc::rt
