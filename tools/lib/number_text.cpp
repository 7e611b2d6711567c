// SPDX-License-Identifier: Apache-2.0
// Number formatting; see number_text.hpp for the rule.
#include "tools/lib/number_text.hpp"

#include <charconv>
#include <cmath>
#include <cstring>

namespace nc::tools {
namespace {

constexpr double kScale = 1e9;
constexpr double kFixedLimit =
    9e6;  // 9e6 * 1e9 = 9e15 < 2^53: the scaled value is an exact integer of a double

}  // namespace

size_t integer_text(uint64_t value, char* out) {
  char digits[20];
  size_t n = 0;
  do {
    digits[n++] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value);
  for (size_t i = 0; i < n; ++i) out[i] = digits[n - 1 - i];
  return n;
}

size_t number_text(double value, char* out) {
  if (!(std::fabs(value) < kFixedLimit)) return value_text(value, out);
  // With one multiplication and one rounding the result depends on the value alone. The rounding of the product
  // can only change how a tie in the tenth decimal is rounded; it never changes a digit of a value with nine decimals.
  const int64_t scaled = std::llround(value * kScale);
  char* p = out;
  if (scaled < 0) *p++ = '-';
  const uint64_t magnitude = static_cast<uint64_t>(scaled < 0 ? -scaled : scaled);
  p += integer_text(magnitude / 1'000'000'000u, p);
  uint32_t fraction = static_cast<uint32_t>(magnitude % 1'000'000'000u);
  if (fraction) {
    char digits[9];
    size_t count = 0;  // without the trailing zeros
    for (size_t i = sizeof digits; i-- > 0;) {
      digits[i] = static_cast<char>('0' + fraction % 10);
      if (count == 0 && digits[i] != '0') count = i + 1;
      fraction /= 10;
    }
    *p++ = '.';
    std::memcpy(p, digits, count);
    p += count;
  }
  return static_cast<size_t>(p - out);
}

size_t value_text(double value, char* out) {
  if (!std::isfinite(value)) {
    std::memcpy(out, "null", 4);  // NOLINT(bugprone-not-null-terminated-result): the length is returned, there is no NUL
    return 4;
  }
  if (value == 0.0) {
    *out = '0';
    return 1;
  }
  // The value is rounded to 15 digits first, and then the shortest text of the result is taken: to_chars with a precision alone would
  // keep rounding errors.
  char digits[kNumberText];
  const auto rounded =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 14);
  double clean = value;
  std::from_chars(digits, rounded.ptr, clean);
  const auto shortest = std::to_chars(out, out + kNumberText, clean);
  return static_cast<size_t>(shortest.ptr - out);
}

}  // namespace nc::tools
