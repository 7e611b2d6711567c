// SPDX-License-Identifier: Apache-2.0
// Texts of the host that replace those of the library (nc_config::alarm_text).
#pragma once

#include "nc/control.h"

namespace nc {

/// Puts the host's text for a code into `text`. Returns false, and leaves `text` as it is, when the host has none.
bool own_text(const nc_config& config, const char* code, char* text, size_t size);

}  // namespace nc
