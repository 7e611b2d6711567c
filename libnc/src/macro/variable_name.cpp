// SPDX-License-Identifier: Apache-2.0
#include "macro/variable_name.hpp"

#include <cstring>

namespace nc {
namespace {

/// Those of two letters, except LN, are left out here, so that ORIGIN, LENGTH or NEXT can be names; within [#NAME] they cannot be confused.
constexpr const char* kReserved[] = {"SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "ATN", "SQRT", "SQR", "ABS", "BIN", "BCD",
                                     "ROUND", "RND", "FIX", "FUP", "LN", "EXP", "MOD", "AND", "XOR"};

}  // namespace

bool is_reserved_name(const char* name, size_t length) {
  for (const char* word : kReserved) {
    const size_t n = std::strlen(word);
    if (n <= length && std::memcmp(word, name, n) == 0) return true;
  }
  return false;
}

}  // namespace nc
