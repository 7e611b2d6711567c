// SPDX-License-Identifier: Apache-2.0
// Instructions and devices that other controllers of the family have and this language does not. An existing
// program may use them, so each has a sentence that tells what to do instead.
#pragma once

#include <string>
#include <string_view>

namespace nc::ladder {

// The sentence for an instruction; empty = other controllers do not have it either. `mnemonic` in upper case.
std::string instruction_elsewhere(std::string_view mnemonic);
// The sentence for a device, such as "LC0", "V5", "S20".
std::string device_elsewhere(std::string_view name);

}  // namespace nc::ladder
