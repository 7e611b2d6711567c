// SPDX-License-Identifier: Apache-2.0
// Expressions: compiled once into a short stack code inside the block, and evaluated each time that the program runs through the block.
#pragma once

#include "program/block.hpp"

namespace nc {

/// A macro value. It may be vacant (M700 13.5.4): arithmetic treats that as 0, a plain copy stays vacant.
struct Value {
  double number = 0;
  bool vacant = true;
  static Value of(double n) { return {n, false}; }
  // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Branch): of the evaluator's stack, where each value has been pushed
  double or_zero() const { return vacant ? 0.0 : number; }
};

enum class Eval : uint8_t { ok, fault, need_sync };

/// How the evaluator reads a variable. `sync` receives nc_sync_what bits when the value exists only after everything before has been executed.
struct VariableReader {
  void* self = nullptr;
  Eval (*read)(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) = nullptr;
  /// Finds the number of the variable with this name (capitals; SETVN, M700 13.5.5). nullptr: there are no names, each is Condition::variable_name.
  bool (*find_name)(void* self, const char* name, size_t length, uint32_t* number) = nullptr;
  /// #1..#33 of the level in force as they are stored (NaN = vacant), because most reads are of these. nullptr: they are read by `read`, too.
  const double* locals = nullptr;
  uint32_t local_count = 0;
  /// nc_sync_what bits that have to be answered before a name is looked for; 0 = none.
  uint32_t names_need = 0;
  /// Finds the number of a parameter that a program has named itself; `make`: if there is none, it is made. nullptr: there are no such parameters.
  bool (*find_named)(void* self, const char* name, size_t length, bool make, uint32_t* number) = nullptr;
};

struct EvalOptions {
  bool asin_0_360 = false;  ///< M700 #1273 bit 0: ASIN[-0.5] gives 330 instead of -30
  double variable_numbers_within = -1;  ///< NumberRules::variable_numbers_within
};

/// Compiles the expression at text[*at] into block.code, up to the first character that cannot belong to it; *at moves behind it. With `condition` also EQ NE
/// GT LT GE LE are accepted outside of inner brackets. False: *fault says what is wrong (brackets P280/P281, format).
bool compile_expression(Block& block, const char* text, size_t size, size_t* at, bool condition,
                        uint16_t* code, Fault* fault);

/// Evaluates the code that begins at block.code[code]. A comparison gives 1 or 0.
Eval evaluate(const Block& block, uint16_t code, const VariableReader& reader, const EvalOptions& options,
              Value* value, Fault* fault, uint32_t* sync);

/// True when the code is just the value of one variable, as in X#3.
bool lone_variable(const Block& block, uint16_t code, uint32_t* number);

/// True when the code is just a small number, as in #1= or GOTO 10.
bool constant_number(const Block& block, uint16_t code, uint32_t* number);

/// M700 13.5.4: the number of a variable that an expression gives: a fraction is rounded, 2.5 up. False when it is negative or too large.
bool variable_number(const Value& value, const EvalOptions& options, uint32_t* number);

}  // namespace nc
