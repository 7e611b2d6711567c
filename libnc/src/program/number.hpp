// SPDX-License-Identifier: Apache-2.0
// Turns decimal text into a double, correctly rounded. It does not use strtod, so there is no locale and no OS, and the result has the same bits
// everywhere.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nc {

/// 10^0 .. 10^22: the powers of ten that a double holds exactly.
inline constexpr double kExactPowersOfTen[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// 10^0 .. 10^19 as integers.
inline constexpr uint64_t kPowersOfTen[20] = {1u,
                                              10u,
                                              100u,
                                              1000u,
                                              10000u,
                                              100000u,
                                              1000000u,
                                              10000000u,
                                              100000000u,
                                              1000000000u,
                                              10000000000u,
                                              100000000000u,
                                              1000000000000u,
                                              10000000000000u,
                                              100000000000000u,
                                              1000000000000000u,
                                              10000000000000000u,
                                              100000000000000000u,
                                              1000000000000000000u,
                                              10000000000000000000u};

/// mantissa / 10^fraction_digits, correctly rounded, for any mantissa and any number of digits, by exact comparison of big numbers.
double scale_decimal_exact(uint64_t mantissa, uint32_t fraction_digits);

/// mantissa / 10^fraction_digits, correctly rounded. Up to 2^53 and 10^22 both are exact in a double, so a single division rounds only once.
inline double scale_decimal(uint64_t mantissa, uint32_t fraction_digits) {
  if (mantissa <= (uint64_t{1} << 53) && fraction_digits <= 22) {
    if (fraction_digits == 0) return static_cast<double>(mantissa);
    return static_cast<double>(mantissa) / kExactPowersOfTen[fraction_digits];
  }
  return scale_decimal_exact(mantissa, fraction_digits);
}

/// An unsigned decimal number in a text.
struct Decimal {
  double value = 0;
  uint64_t integer = 0;          ///< value of the digits before the point, saturated at 10^19
  uint32_t integer_digits = 0;   ///< number of digits before the point, without leading zeros
  uint32_t fraction_digits = 0;  ///< number of digits behind the point, as written
  uint32_t digits = 0;           ///< number of all digits, as written; 0 = there is no number here
  bool point = false;
};

}  // namespace nc
