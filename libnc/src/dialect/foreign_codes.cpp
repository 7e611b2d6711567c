// SPDX-License-Identifier: Apache-2.0
#include "dialect/foreign_codes.hpp"

#include <cmath>

namespace nc {
namespace {

struct ForeignCode {
  double code;
  const char* hint;
};
constexpr ForeignCode kForeignCodes[] = {
    {90.1, "G90.1 (absolute arc centres) does not exist here: I J K always count from the start of the arc."},
    {91.1, "G91.1 is not known and not needed here: I J K always count from the start of the arc. Leave it out."},
};

}  // namespace

const char* foreign_code_hint(double code) {
  for (const ForeignCode& row : kForeignCodes)
    if (std::fabs(code - row.code) < 1e-6) return row.hint;
  return nullptr;
}

}  // namespace nc
