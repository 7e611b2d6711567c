// SPDX-License-Identifier: Apache-2.0
// Instructions that can never be done, because a constant in them is wrong: better known at load than by SM0 in
// the scan.
#include <limits>

#include "ladder/compiler.hpp"

namespace nc::ladder {
namespace {

// The largest whole number of so many decimal digits.
std::int64_t largest_decimal(unsigned digits) {
  std::int64_t value = 1;
  for (unsigned i = 0; i < digits; ++i) value *= 10;
  return value - 1;
}

bool is_bcd(std::uint32_t value, unsigned digits) {
  for (unsigned i = 0; i < digits; ++i)
    if ((value >> 4 * i & 15u) > 9) return false;
  return true;
}

}  // namespace

void Compiler::check_constants(const Rule& rule, const Encoded* operands, std::size_t count) {
  const auto constant = [&](std::size_t i, std::int64_t* value) {
    if (i >= count || operands[i].mode != Mode::kConstant) return false;
    *value = static_cast<std::int32_t>(operands[i].value);
    return true;
  };
  const auto from_to = [&](std::size_t i, std::int64_t least, std::int64_t most) {
    std::int64_t value = 0;
    if (!constant(i, &value) || (value >= least && value <= most)) return true;
    error("K" + std::to_string(value) + " is not possible here: " + std::to_string(least) + " to " + std::to_string(most));
    return false;
  };
  // A row of n words from an operand on, where both are known now.
  const auto row = [&](std::size_t first, std::size_t n, std::int64_t width) {
    std::int64_t length = 0;
    if (!from_to(n, 0, std::numeric_limits<std::int16_t>::max())) return false;
    if (!constant(n, &length) || operands[first].mode != Mode::kIndirect) return true;
    const Indirect& where = code_.indirect[operands[first].value];
    const std::int64_t room = (std::int64_t{where.end} - where.base) / width;
    if (where.z != Indirect::kNoZ || where.digits != 0 || length <= room) return true;
    error("the row is longer than its devices: there are " + std::to_string(room) + " from there on");
    return false;
  };
  std::int64_t left = 0, right = 0;
  switch (rule.op) {
    case Op::kDiv:
    case Op::kDdiv:
      if (!constant(1, &right)) return;
      if (right == 0) return error("division by zero");
      if (right == -1 && constant(0, &left) &&
          left == (rule.op == Op::kDiv ? std::numeric_limits<std::int16_t>::min()
                                       : std::int64_t{std::numeric_limits<std::int32_t>::min()}))
        error("the quotient does not fit");
      return;
    case Op::kBmov:
      if (row(0, 2, 1)) (void)row(1, 2, 1);
      return;
    case Op::kFmov:
      (void)row(1, 2, 1);
      return;
    case Op::kSer:
    case Op::kDser:
      (void)row(1, 3, rule.op == Op::kDser ? 2 : 1);
      return;
    case Op::kRor:
    case Op::kRol:
    case Op::kSfr:
    case Op::kSfl:
    case Op::kBset:
    case Op::kBrst:
      (void)from_to(1, 0, 15);
      return;
    case Op::kDror:
    case Op::kDrol:
      (void)from_to(1, 0, 31);
      return;
    case Op::kBcd:
    case Op::kDbcd:
      (void)from_to(0, 0, largest_decimal(rule.op == Op::kBcd ? 4 : 8));
      return;
    case Op::kBin:
    case Op::kDbin:
      if (constant(0, &left) && !is_bcd(static_cast<std::uint32_t>(left), rule.op == Op::kBin ? 4 : 8))
        error("the constant is no BCD number");
      return;
    case Op::kRots: {
      constexpr std::int64_t kMost = std::numeric_limits<std::int16_t>::max();
      std::int64_t places = kMost;
      if (!from_to(0, 1, kMost)) return;
      (void)constant(0, &places);
      if (from_to(1, 1, places)) (void)from_to(2, 1, places);
      return;
    }
    default:
      return;
  }
}

}  // namespace nc::ladder
