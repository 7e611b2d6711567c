// SPDX-License-Identifier: Apache-2.0
// G and M codes as text, for everything that prints them.
#pragma once

#include <cstddef>

namespace nc {

struct Dialect;

/// Writes a G code (times 10) as a manual prints it, with the family's letter (Role::code): 0 -> "G00", 541 -> "G54.1", 1070 -> "G107".
void g_code_text(char letter, int code, char* text, size_t size);

/// Writes an M code with the family's letter (Role::misc_code): 3 -> "M03", 198 -> "M198".
void m_code_text(char letter, unsigned code, char* text, size_t size);

/// Writes a code as the family does: with its letter, or where it has names for its codes (Dialect::codes_by_name) by the name in its row.
void g_code_text(const Dialect& dialect, int code, char* text, size_t size);
void m_code_text(const Dialect& dialect, unsigned code, char* text, size_t size);

}  // namespace nc
