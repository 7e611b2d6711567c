// SPDX-License-Identifier: Apache-2.0
// Expressions: compiled once into a short stack code inside the block, evaluated as often as the program runs
// through it.
#pragma once

#include "program/block.hpp"

namespace nc {

/// A macro value. Vacant (M700 13.5.4) is kept as a NaN of its own: arithmetic treats it as 0, a bare copy
/// keeps it.
struct Value {
  double number = 0;
  bool vacant = true;
  static Value of(double n) { return {n, false}; }
  // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Branch): of the evaluator's stack, where each value has been pushed
  double or_zero() const { return vacant ? 0.0 : number; }
};

enum class Eval : uint8_t { ok, fault, need_sync };

/// How the evaluator reads a variable. `sync` receives nc_sync_what bits when the value exists only after
/// motion.
struct VariableReader {
  void* self = nullptr;
  Eval (*read)(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) = nullptr;
  /// Number of the variable with this name (capitals; SETVN, M700 13.5.5). Null: every name is
  /// Condition::variable_name.
  bool (*find_name)(void* self, const char* name, size_t length, uint32_t* number) = nullptr;
  /// #1..#33 of the level in force as they are stored (NaN = vacant): most reads are of these. Null: ask `read`.
  const double* locals = nullptr;
  uint32_t local_count = 0;
  /// What has to be known before a name is looked for (`sync`); 0 = nothing.
  uint32_t names_need = 0;
  /// Number of the parameter that a program has named itself; `make`: it is there from now on. Null: there are none.
  bool (*find_named)(void* self, const char* name, size_t length, bool make, uint32_t* number) = nullptr;
};

struct EvalOptions {
  bool asin_0_360 = false;  ///< M700 #1273 bit 0: ASIN of a negative gives 330 instead of -30
};

/// Compiles the expression at text[*at] into block.code; *at moves behind it. Stops at the first character
/// that cannot continue it. `condition` also accepts EQ NE GT LT GE LE at the top level. False: *fault says
/// what is wrong (brackets P280/P281, format).
bool compile_expression(Block& block, const char* text, size_t size, size_t* at, bool condition,
                        uint16_t* code, Fault* fault);

/// Evaluates the code at `code`. A comparison gives 1 or 0.
Eval evaluate(const Block& block, uint16_t code, const VariableReader& reader, const EvalOptions& options,
              Value* value, Fault* fault, uint32_t* sync);

/// True when the code is the value of one variable and nothing else: X#3.
bool lone_variable(const Block& block, uint16_t code, uint32_t* number);

/// True when the code is a small number and nothing else: #1, GOTO 10.
bool constant_number(const Block& block, uint16_t code, uint32_t* number);

/// M700 13.5.4: a variable number from an expression, fraction rounded, 2.5 up. False when negative or no
/// number.
bool variable_number(const Value& value, uint32_t* number);

}  // namespace nc
