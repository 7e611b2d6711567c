// SPDX-License-Identifier: Apache-2.0
// A number that may be absent, in the eight bytes of a double: absence is a NaN, which no number in an NC program or table is.
#pragma once

#include <limits>

namespace nc {

class OptionalDouble {
 public:
  constexpr OptionalDouble() = default;
  constexpr OptionalDouble(double number) : number_(number) {}
  constexpr bool has_value() const { return number_ == number_; }
  constexpr double operator*() const { return number_; }
  constexpr double value_or(double fallback) const { return has_value() ? number_ : fallback; }
  /// Two absent numbers are equal.
  friend constexpr bool operator==(OptionalDouble a, OptionalDouble b) { return a.has_value() ? a.number_ == b.number_ : !b.has_value(); }

 private:
  double number_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace nc
