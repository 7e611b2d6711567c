// SPDX-License-Identifier: Apache-2.0
// What other controllers of the family have and this language has not: instructions and devices that an existing
// program may name, each with the sentence that helps.
#pragma once

#include <string>
#include <string_view>

namespace nc::ladder {

// Empty = not known elsewhere either. `mnemonic` in upper case.
std::string instruction_elsewhere(std::string_view mnemonic);
// "LC0", "V5", "S20": as written.
std::string device_elsewhere(std::string_view name);

}  // namespace nc::ladder
