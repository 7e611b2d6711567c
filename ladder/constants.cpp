// SPDX-License-Identifier: Apache-2.0
// Finds instructions that can never be executed because a constant in them is wrong, so that the error is reported when the program is loaded, and not
// only by SM0 in the scan.
#include <limits>

#include "ladder/compiler.hpp"

namespace nc::ladder {
namespace {

constexpr std::int64_t kMost16 = std::numeric_limits<std::int16_t>::max();

// Operands that may have only values of a certain range.
struct Range {
  Op op;
  std::size_t operand;
  std::int64_t least, most;
};
constexpr Range kRanges[] = {
    {Op::kBmov, 2, 0, kMost16},  {Op::kFmov, 2, 0, kMost16}, {Op::kSer, 3, 0, kMost16}, {Op::kDser, 3, 0, kMost16},
    {Op::kRor, 1, 0, 15},        {Op::kRol, 1, 0, 15},       {Op::kSfr, 1, 0, 15},      {Op::kSfl, 1, 0, 15},
    {Op::kBset, 1, 0, 15},       {Op::kBrst, 1, 0, 15},      {Op::kDror, 1, 0, 31},     {Op::kDrol, 1, 0, 31},
    {Op::kBcd, 0, 0, 9999},      {Op::kDbcd, 0, 0, 99999999}, {Op::kRots, 0, 1, kMost16},
};

// Operands that are rows of words: the operand with which a row begins, and the operand that is its length.
struct Row {
  Op op;
  std::size_t first, length;
  std::int64_t width;
};
constexpr Row kRows[] = {
    {Op::kBmov, 0, 2, 1}, {Op::kBmov, 1, 2, 1}, {Op::kFmov, 1, 2, 1}, {Op::kSer, 1, 3, 1}, {Op::kDser, 1, 3, 2},
};

bool is_bcd(std::uint32_t value, unsigned digits) {
  for (unsigned i = 0; i < digits; ++i)
    if ((value >> 4 * i & 15u) > 9) return false;
  return true;
}

}  // namespace

bool Compiler::is_constant(const Encoded& operand, std::int64_t* value) {
  *value = static_cast<std::int32_t>(operand.value);
  return operand.mode == Mode::kConstant;
}

bool Compiler::check_range(const Encoded& operand, std::int64_t least, std::int64_t most) {
  std::int64_t value = 0;
  if (!is_constant(operand, &value) || (value >= least && value <= most)) return true;
  error("K" + std::to_string(value) + " is not possible here: " + std::to_string(least) + " to " + std::to_string(most));
  return false;
}

// Checks a row whose place and length are constants.
bool Compiler::check_row(const Encoded& first, const Encoded& length, std::int64_t width) {
  std::int64_t count = 0;
  if (!is_constant(length, &count) || first.mode != Mode::kIndirect) return true;
  const Indirect& where = code_.indirect[first.value];
  const std::int64_t room = (std::int64_t{where.end} - where.base) / width;
  if (where.z != Indirect::kNoZ || where.digits != 0 || count <= room) return true;
  error("the row is longer than its devices: there are " + std::to_string(room) + " from there on");
  return false;
}

void Compiler::check_constants(const Rule& rule, const Encoded* operands) {
  for (const Range& range : kRanges)
    if (range.op == rule.op && !check_range(operands[range.operand], range.least, range.most)) return;
  for (const Row& row : kRows)
    if (row.op == rule.op && !check_row(operands[row.first], operands[row.length], row.width)) return;
  std::int64_t left = 0, right = 0;
  switch (rule.op) {
    case Op::kDiv:
    case Op::kDdiv: {
      if (!is_constant(operands[1], &right)) return;
      if (right == 0) return error("division by zero");
      const std::int64_t least =
          rule.op == Op::kDiv ? std::numeric_limits<std::int16_t>::min() : std::numeric_limits<std::int32_t>::min();
      if (right == -1 && is_constant(operands[0], &left) && left == least) error("the quotient does not fit");
      return;
    }
    case Op::kBin:
    case Op::kDbin:
      if (is_constant(operands[0], &left) && !is_bcd(static_cast<std::uint32_t>(left), rule.op == Op::kBin ? 4 : 8))
        error("the constant is no BCD number");
      return;
    case Op::kRots:
      if (!is_constant(operands[0], &left)) left = kMost16;
      if (check_range(operands[1], 1, left)) (void)check_range(operands[2], 1, left);
      return;
    default:
      return;
  }
}

}  // namespace nc::ladder
