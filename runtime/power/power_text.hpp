// SPDX-License-Identifier: Apache-2.0
// What the control has done when the power failed, as the sentence of alarm R24.
#pragma once

#include <cstdint>
#include <string>

namespace nc::rt {

// `detail`: PowerDetail, `times`: PowerWatch::times().
std::string power_text(std::uint32_t detail, std::uint32_t times);

}  // namespace nc::rt
