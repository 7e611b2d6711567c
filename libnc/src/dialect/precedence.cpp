// SPDX-License-Identifier: Apache-2.0
#include "dialect/precedence.hpp"

#include "dialect/default_precedence.hpp"
#include "dialect/dialect.hpp"

namespace nc {
namespace {

/// Any other code that uses the axis words of the block, so that mirror cannot use them, too.
constexpr PrecedenceRow kAnyOther{Function::count_, Precedence::both, Precedence::both, Precedence::both, Precedence::both,
                                  Precedence::both, Precedence::both, Precedence::ignored};

const PrecedenceRow* find(const Table<PrecedenceRow>& rows, Function function) {
  for (const PrecedenceRow& row : rows)
    if (row.function == function) return &row;
  return nullptr;
}

Condition find(const Table<BarredRow>& rows, unsigned modes, Function function) {
  for (const BarredRow& row : rows)
    if ((row.mode & modes) != 0 && row.function == function) return row.condition;
  return Condition::none;
}

}  // namespace

const PrecedenceRow& precedence_of(const Dialect& dialect, Function function) {
  const PrecedenceRow* row = find(dialect.precedence, function);
  if (row == nullptr) row = find(kDefaultPrecedence, function);
  return row != nullptr ? *row : kAnyOther;
}

Condition barred(const Dialect& dialect, unsigned modes, Function function) {
  const Condition own = find(dialect.barred, modes, function);
  return own != Condition::none || (modes & kDefaultBarringModes) == 0 ? own : find(kDefaultBarred, modes, function);
}

}  // namespace nc
