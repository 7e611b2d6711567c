// SPDX-License-Identifier: Apache-2.0
// The G codes of a family by their number as it is written and by what they mean, found once: blocks ask for them all the time.
#pragma once

#include <limits>

#include "dialect/dialect.hpp"

namespace nc {

class CodeIndex {
 public:
  void create(const Dialect& dialect);

  /// Row of a G code as it is written (54.1), nullptr = the family has none. A number out of an expression may carry representation noise.
  const FunctionRow* find(double number) const {
    const bool direct = number >= 0 && number < kDirect;
    const int whole = direct ? static_cast<int>(number) : 0;
    return direct && whole == number ? whole_code_[whole] : find_fraction(number);
  }
  /// First row of a function, nullptr = the family has none.
  const FunctionRow* row(Function function) const { return first_[static_cast<unsigned>(function)]; }
  /// The row of a straight line at feed, and its number as most programs write it.
  const FunctionRow& linear() const { return *linear_; }
  double linear_number() const { return linear_number_; }
  /// Another one has taken the place of that code: no number is a straight line's any more.
  void forget_linear() { linear_number_ = std::numeric_limits<double>::quiet_NaN(); }

 private:
  const FunctionRow* find_fraction(double number) const;

  static constexpr int kDirect = 100;
  const Dialect* dialect_ = nullptr;
  const FunctionRow* linear_ = nullptr;
  double linear_number_ = 0;
  const FunctionRow* whole_code_[kDirect] = {};
  const FunctionRow* first_[kFunctions] = {};
};

}  // namespace nc
