// SPDX-License-Identifier: Apache-2.0
#include "dialect/code_index.hpp"

#include <cmath>

namespace nc {

void CodeIndex::create(const Dialect& dialect) {
  dialect_ = &dialect;
  for (int code = 0; code < kDirect; ++code) whole_code_[code] = find_function(dialect, code * 10);
  for (unsigned i = 0; i < kFunctions; ++i) first_[i] = find_function(dialect, static_cast<Function>(i));
  linear_ = row(Function::linear);
  linear_number_ = linear_->code / 10.0;
}

const FunctionRow* CodeIndex::find_fraction(double number) const {
  const double code = std::nearbyint(number * 10);
  if (!(std::fabs(number * 10 - code) < 1e-6) || code < 0 || code > 9999) return nullptr;
  return find_function(*dialect_, static_cast<int>(code));
}

}  // namespace nc
