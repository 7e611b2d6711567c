// SPDX-License-Identifier: Apache-2.0
// Codes as text, for everything that prints them.
#pragma once

#include <cstddef>

namespace nc {

/// G code (times 10) as a manual prints it: 0 -> "G00", 541 -> "G54.1", 1070 -> "G107".
void g_code_text(int code, char* text, size_t size);

/// M code: 3 -> "M03", 198 -> "M198".
void m_code_text(unsigned code, char* text, size_t size);

}  // namespace nc
