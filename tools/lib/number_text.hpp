// SPDX-License-Identifier: Apache-2.0
// Numbers as the tools print them: the same bytes in every run and on every machine, independent of the locale.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nc::tools {

/** The number of bytes that any text of the functions below needs at most. */
inline constexpr size_t kNumberText = 40;

/**
 * A length, angle, feed or time: rounded to 1e-9 (half away from zero), no trailing zeros, no exponent, never
 * "-0". So 9.99999999999 is "10", -1e-12 is "0". Values of 9e6 and more have 15 significant digits, as from
 * value_text(). A value that is not finite is "null". @return the number of bytes written; there is no NUL.
 */
size_t number_text(double value, char* out);

/** A value of any size (variables): at most 15 significant digits, in the shortest form, with an exponent if that is shorter.
 */
size_t value_text(double value, char* out);

/** An unsigned integer. */
size_t integer_text(uint64_t value, char* out);

}  // namespace nc::tools
