// SPDX-License-Identifier: Apache-2.0
// The slow path of decimal conversion, for a mantissa above 2^53 or more than 22 fraction digits.
//
// An approximation d of m / 10^k is off by a few units in the last place at most. Whether a neighbour of d is nearer is decided exactly: the midpoint
// between d and its neighbour is written as M * 2^e (M an integer), and  m  is compared with  M * 2^e * 10^k  in big integers.
#include "program/number.hpp"

#include <cmath>

namespace nc {
namespace {

/// Natural number of at most kLimbs * 32 bits, little endian, with just the operations that the comparison needs.
class BigNatural {
 public:
  explicit BigNatural(uint64_t value) {
    while (value != 0) {
      limb_[size_++] = static_cast<uint32_t>(value);
      value >>= 32;
    }
  }
  void multiply(uint32_t factor) {
    uint64_t carry = 0;
    for (unsigned i = 0; i < size_; ++i) {
      carry += uint64_t{limb_[i]} * factor;
      limb_[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) limb_[size_++] = static_cast<uint32_t>(carry);
  }
  void multiply_power_of_ten(uint32_t exponent) {
    for (; exponent >= 9; exponent -= 9) multiply(1000000000u);
    for (; exponent > 0; --exponent) multiply(10u);
  }
  void shift_left(uint32_t bits) {
    if (size_ == 0) return;
    const unsigned words = bits / 32;
    if (bits % 32 != 0) multiply(uint32_t{1} << (bits % 32));
    for (unsigned i = size_; i-- > 0;) limb_[i + words] = limb_[i];
    for (unsigned i = 0; i < words; ++i) limb_[i] = 0;
    size_ += words;
  }
  /// -1, 0, 1 as *this is less than, equal to, greater than other.
  int compare(const BigNatural& other) const {
    if (size_ != other.size_) return size_ < other.size_ ? -1 : 1;
    for (unsigned i = size_; i-- > 0;) {
      if (limb_[i] != other.limb_[i]) return limb_[i] < other.limb_[i] ? -1 : 1;
    }
    return 0;
  }

 private:
  // Largest value: a 65-bit midpoint times 10^kMostDigits (1140 bits), or a mantissa shifted by 1075 bits.
  static constexpr unsigned kLimbs = 40;
  uint32_t limb_[kLimbs] = {};
  unsigned size_ = 0;
};

/// With so many fraction digits, or more, the value of any 64-bit mantissa is less than half of the smallest denormal.
constexpr uint32_t kMostDigits = 343;

/// Sign of m - 10^k * 2^e * midpoint.
int compare_with_midpoint(uint64_t mantissa, uint32_t fraction_digits, uint64_t midpoint, int exponent) {
  BigNatural left(mantissa), right(midpoint);
  right.multiply_power_of_ten(fraction_digits);
  if (exponent >= 0) {
    right.shift_left(static_cast<uint32_t>(exponent));
  } else {
    left.shift_left(static_cast<uint32_t>(-exponent));
  }
  return left.compare(right);
}

/// d = significand * 2^exponent with an integer significand below 2^53.
void split(double d, uint64_t* significand, int* exponent) {
  constexpr int kMinExponent = -1074;
  int e = 0;
  const double fraction = std::frexp(d, &e);  // d = fraction * 2^e, fraction in [0.5, 1)
  *exponent = e - 53;
  *significand = static_cast<uint64_t>(std::ldexp(fraction, 53));
  if (*exponent < kMinExponent) {  // denormal, or 0: the lowest bits are 0
    *significand >>= d == 0 ? 0 : kMinExponent - *exponent;
    *exponent = kMinExponent;
  } else if (d == 0) {
    *exponent = kMinExponent;
  }
}

}  // namespace

double scale_decimal_exact(uint64_t mantissa, uint32_t fraction_digits) {
  if (mantissa == 0 || fraction_digits >= kMostDigits) return 0;
  double d = static_cast<double>(mantissa);
  for (uint32_t k = fraction_digits; k > 0;) {
    const uint32_t step = k < 22 ? k : 22;
    d /= kExactPowersOfTen[step];
    k -= step;
  }
  for (;;) {
    uint64_t significand = 0;
    int exponent = 0;
    split(d, &significand, &exponent);
    // Midpoint to the neighbour above: (2s + 1) * 2^(e-1). A tie goes to the even significand.
    const int above = compare_with_midpoint(mantissa, fraction_digits, 2 * significand + 1, exponent - 1);
    if (above > 0 || (above == 0 && (significand & 1) != 0)) {
      d = std::nextafter(d, HUGE_VAL);
      continue;
    }
    if (significand == 0) return d;
    // Midpoint to the neighbour below. Under a power of two the neighbours are half as far apart.
    const bool narrow = significand == (uint64_t{1} << 52) && exponent > -1074;
    const int below =
        narrow ? compare_with_midpoint(mantissa, fraction_digits, 4 * significand - 1, exponent - 2)
               : compare_with_midpoint(mantissa, fraction_digits, 2 * significand - 1, exponent - 1);
    if (below < 0 || (below == 0 && (significand & 1) != 0)) {
      d = std::nextafter(d, 0.0);
      continue;
    }
    return d;
  }
}

}  // namespace nc
