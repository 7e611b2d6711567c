// SPDX-License-Identifier: Apache-2.0
#include "permutation.hpp"

#include <algorithm>
#include <numeric>

#include "dialect/m700/m700.hpp"

namespace nc::permuted {
namespace {

// n -> (factor n + shift) mod size. It is one to one, since factor and size have no common divisor. No number stays the same, since
// (factor - 1) n = -shift mod size has no solution: size and factor - 1 have a common divisor that shift does not have.
struct Affine {
  unsigned first, size, factor, shift;
  constexpr bool holds(unsigned n) const { return n >= first && n < first + size; }
  constexpr unsigned moved(unsigned n) const { return holds(n) ? first + (factor * (n - first) + shift) % size : n; }
  constexpr unsigned back(unsigned n) const {
    for (unsigned from = first; holds(n) && from < first + size; ++from)
      if (moved(from) == n) return from;
    return n;
  }
  constexpr bool moves_all() const {
    if (std::gcd(factor, size) != 1) return false;
    for (unsigned n = first; n < first + size; ++n)
      if (moved(n) == n) return false;
    return true;
  }
};
constexpr Affine kCodes{0, 100, 37, 41}, kMacroCodes{100, 156, 35, 41}, kGroups{1, 21, 4, 5};
static_assert(kCodes.moves_all() && kMacroCodes.moves_all() && kGroups.moves_all());

// Parameters have four digits; #1000 on are system variables, up to those of extended common variables.
constexpr uint32_t kFirstParameter = 1000, kLastParameter = 9999, kFirstVariable = 1000, kLastVariable = 199999;

std::vector<RangeOrder::Range> ranges_of(const FamilyParameters& parameters) {
  std::vector<RangeOrder::Range> ranges;
  for (const ParameterRow& row : parameters.numbers) ranges.push_back({row.first, row.last});
  for (const MachineParameter& row : parameters.machine) ranges.push_back({row.number, row.number});
  for (const NumberRange& range : parameters.of_axes) ranges.push_back({range.first, range.last});
  return ranges;
}

std::vector<RangeOrder::Range> ranges_of(const FamilyVariables& variables) {
  std::vector<RangeOrder::Range> ranges;
  for (const VariableRow& row : variables.rows) ranges.push_back({row.first, row.last});
  return ranges;
}

bool is_by_group(SystemVariable what) {
  return what == SystemVariable::code || what == SystemVariable::code_now || what == SystemVariable::code_at_interrupt;
}

template <class T>
Table<T> table(const std::vector<T>& rows) {
  return {rows.data(), static_cast<decltype(Table<T>::size)>(rows.size())};
}

const Dialect* chosen = &m700::kDialect;

}  // namespace

RangeOrder::RangeOrder(std::vector<Range> ranges, uint32_t first, uint32_t last) {
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.first < b.first; });
  std::vector<Range> all;
  uint32_t next = first;
  for (const Range& range : ranges) {
    if (range.first < next && !all.empty()) {
      all.back().last = std::max(all.back().last, range.last);
    } else {
      if (range.first > next) all.push_back({next, range.first - 1});
      all.push_back(range);
    }
    next = all.back().last + 1;
  }
  if (next <= last) all.push_back({next, last});
  // In steps of a size that meets each of them once.
  const size_t count = all.size();
  size_t step = count * 2 / 5 + 1;
  while (std::gcd(step, count) != 1) ++step;
  uint32_t to = first;
  for (size_t i = 0; i < count; ++i) {
    const Range& range = all[(i * step + count / 2) % count];
    const uint32_t size = range.last - range.first + 1;
    pieces_.push_back({range.first, to, size});
    to += size;
  }
}

uint32_t RangeOrder::find(uint32_t number, uint32_t Piece::*here, uint32_t Piece::*there) const {
  for (const Piece& piece : pieces_)
    if (number >= piece.*here && number - piece.*here < piece.size) return piece.*there + (number - piece.*here);
  return number;
}

Permutation::Permutation(const Dialect& family)
    : parameters_(ranges_of(*family.parameters), kFirstParameter, kLastParameter),
      variables_(ranges_of(*family.variables), kFirstVariable, kLastVariable) {
  for (const VariableRow& row : family.variables->rows)
    if (is_by_group(row.what)) by_group_.push_back({row.first, row.last});
}

int Permutation::code(int code) const {
  const auto whole = static_cast<unsigned>(code / 10);
  return static_cast<int>(kMacroCodes.moved(kCodes.moved(whole))) * 10 + code % 10;
}

int Permutation::code_back(int code) const {
  const auto whole = static_cast<unsigned>(code / 10);
  return static_cast<int>(kMacroCodes.back(kCodes.back(whole))) * 10 + code % 10;
}

unsigned Permutation::group(unsigned group) const { return kGroups.moved(group); }

char Permutation::letter(char letter) {
  static const std::string from = "PQRLDHIJK", to = "QRLPHDJKI";
  const size_t at = from.find(letter);
  return at == std::string::npos ? letter : to[at];
}

uint32_t Permutation::variable(uint32_t number) const {
  for (const RangeOrder::Range& range : by_group_)
    if (number >= range.first && number <= range.last) return variables_.moved(range.first) + group(number - range.first + 1) - 1;
  return variables_.moved(number);
}

PermutedDialect::PermutedDialect(const Dialect& family, const Permutation& permutation)
    : dialect_(family), parameters_(*family.parameters), variables_(*family.variables) {
  for (FunctionRow row : family.functions) {
    row.code = static_cast<int16_t>(permutation.code(row.code));
    row.group = static_cast<uint8_t>(permutation.group(row.group));
    functions_.push_back(row);
  }
  std::sort(functions_.begin(), functions_.end(), [](const FunctionRow& a, const FunctionRow& b) { return a.code < b.code; });

  for (ParameterRow row : family.parameters->numbers) {
    const uint32_t first = permutation.parameter(row.first);
    row.last = first + (row.last - row.first);
    row.first = first;
    parameter_rows_.push_back(row);
  }
  std::stable_sort(parameter_rows_.begin(), parameter_rows_.end(),
                   [](const ParameterRow& a, const ParameterRow& b) { return a.first < b.first; });
  for (size_t i = 0; i < parameter_rows_.size(); ++i)
    places_.row[static_cast<unsigned>(parameter_rows_[i].what)] = static_cast<uint8_t>(i + 1);
  for (MachineParameter row : family.parameters->machine) {
    row.number = permutation.parameter(row.number);
    machine_.push_back(row);
  }
  for (const NumberRange& range : family.parameters->of_axes) {
    const uint32_t first = permutation.parameter(range.first);
    of_axes_.push_back({first, first + (range.last - range.first)});
  }
  for (VariableRow row : family.variables->rows) {
    const uint32_t size = row.last - row.first;
    row.first = permutation.variable(row.first);
    if (is_by_group(row.what)) row.first -= permutation.group(1) - 1;  // its first number does not belong to the first group any more
    row.last = row.first + size;
    variable_rows_.push_back(row);
  }
  std::sort(variable_rows_.begin(), variable_rows_.end(), [](const VariableRow& a, const VariableRow& b) { return a.first < b.first; });

  parameters_.numbers = table(parameter_rows_);
  parameters_.places = &places_;
  parameters_.machine = table(machine_);
  parameters_.of_axes = table(of_axes_);
  variables_.rows = table(variable_rows_);
  lex_ = iso_rules_of(*family.lex);
  dialect_.length_addresses = 0;
  for (unsigned i = 0; i < 26; ++i) {
    const char letter = permutation.letter(static_cast<char>('A' + i));
    const auto to = static_cast<unsigned>(letter - 'A');
    lex_.word[to] = iso_rules_of(*family.lex).word[i];
    argument_of_[to] = family.argument_of[i];
    if ((family.length_addresses >> i & 1) != 0) dialect_.length_addresses |= 1u << to;
    if ((family.calling_words >> i & 1) != 0) dialect_.calling_words |= 1u << to;
  }
  for (unsigned role = 0; role < kRoles; ++role) {
    const char letter = family.addresses.letter(static_cast<Role>(role));
    if (letter != 0) dialect_.addresses.bind(static_cast<Role>(role), permutation.letter(letter));
  }
  dialect_.lex = &lex_;
  dialect_.argument_of = argument_of_;
  dialect_.functions = table(functions_);
  dialect_.parameters = &parameters_;
  dialect_.variables = &variables_;
}

void choose(const Dialect& family) { chosen = &family; }

}  // namespace nc::permuted

// It replaces the function of libnc (dialect/registry.cpp), so that the library of this program reads the tables that a test chooses.
const nc::Dialect& nc::dialect(nc_dialect) { return *nc::permuted::chosen; }
