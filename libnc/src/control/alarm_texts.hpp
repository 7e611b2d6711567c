// SPDX-License-Identifier: Apache-2.0
// Texts of the host's in the place of those of the library (nc_config::alarm_text).
#pragma once

#include "nc/control.h"

namespace nc {

/// Puts the host's text for a code into `text`; without one it stays as it is, and false is the answer.
bool own_text(const nc_config& config, const char* code, char* text, size_t size);

}  // namespace nc
