// SPDX-License-Identifier: Apache-2.0
#include "dialect/variable_rows.hpp"

namespace nc {

const VariableRow* find_variable(const FamilyVariables& variables, uint32_t number) {
  for (const VariableRow& row : variables.rows)
    if (number >= row.first && number <= row.last) return &row;
  return nullptr;
}

}  // namespace nc
