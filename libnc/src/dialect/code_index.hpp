// SPDX-License-Identifier: Apache-2.0
// Looks up the G codes of a family by the number that is written and by their meaning. The index is built once, because every block asks.
#pragma once

#include <limits>

#include "dialect/dialect.hpp"

namespace nc {

class CodeIndex {
 public:
  void create(const Dialect& dialect);

  /// Row of a G code as it is written (54.1), nullptr = the family has no such code. A number that comes from an expression may be off by
  /// rounding errors and is found all the same.
  const FunctionRow* find(double number) const {
    const bool direct = number >= 0 && number < kDirect;
    const int whole = direct ? static_cast<int>(number) : 0;
    return direct && whole == number ? whole_code_[whole] : find_fraction(number);
  }
  /// First row of a function, nullptr = the family has no code for it.
  const FunctionRow* row(Function function) const { return first_[static_cast<unsigned>(function)]; }
  /// The row of the straight line at feed, and its number as most programs write it.
  const FunctionRow& linear() const { return *linear_; }
  double linear_number() const { return linear_number_; }
  /// To be called when the code linear_number() has been given another meaning. After it no number compares equal to linear_number().
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
