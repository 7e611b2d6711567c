// SPDX-License-Identifier: Apache-2.0
// How the numbers of a family are permuted: G codes, modal groups, parameters and system variables, each kind separately.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "dialect/iso_lexer.hpp"

namespace nc::permuted {

/// Puts whole ranges of numbers into another order. A number keeps its place within its range, so that numbers which a program computes from the
/// first one of a range stay right.
class RangeOrder {
 public:
  struct Range {
    uint32_t first, last;
  };
  /// Ranges that overlap move together. The gaps between them within [first, last] are ranges, too.
  RangeOrder(std::vector<Range> ranges, uint32_t first, uint32_t last);
  uint32_t moved(uint32_t number) const { return find(number, &Piece::from, &Piece::to); }
  uint32_t back(uint32_t number) const { return find(number, &Piece::to, &Piece::from); }

 private:
  struct Piece {
    uint32_t from, to, size;
  };
  uint32_t find(uint32_t number, uint32_t Piece::*here, uint32_t Piece::*there) const;
  std::vector<Piece> pieces_;
};

class Permutation {
 public:
  explicit Permutation(const Dialect& family);

  /// Codes are times 10, as in FunctionRow. G54.1 moves with G54 and keeps its decimal. G00 to G99 and G100 to G255 are permuted separately: programs
  /// may always be bound to the latter, to the former only if a parameter allows it (Dialect::own_codes, macro_codes).
  int code(int code) const;
  int code_back(int code) const;
  unsigned group(unsigned group) const;
  uint32_t parameter(uint32_t number) const { return parameters_.moved(number); }
  uint32_t variable(uint32_t number) const;
  /// Letters of words. Those of axes stay (the machine names them), and so do those of codes and of block numbers, F, S and T.
  static char letter(char letter);

 private:
  RangeOrder parameters_, variables_;
  std::vector<RangeOrder::Range> by_group_;  ///< ranges with a place for each group
};

/// The tables of a family with every number permuted; everything else is that of the family.
class PermutedDialect {
 public:
  PermutedDialect(const Dialect& family, const Permutation& permutation);
  PermutedDialect(const PermutedDialect&) = delete;
  PermutedDialect& operator=(const PermutedDialect&) = delete;
  const Dialect& dialect() const { return dialect_; }

 private:
  Dialect dialect_;
  IsoRules lex_;
  uint8_t argument_of_[kAddresses] = {};
  FamilyParameters parameters_;
  FamilyVariables variables_;
  ParameterPlaces places_;
  std::vector<FunctionRow> functions_;
  std::vector<ParameterRow> parameter_rows_;
  std::vector<MachineParameter> machine_;
  std::vector<NumberRange> of_axes_;
  std::vector<VariableRow> variable_rows_;
};

/// Chooses the tables that dialect() of this program returns for any family, and that the library therefore reads; at first those of m700.
void choose(const Dialect& family);

}  // namespace nc::permuted
