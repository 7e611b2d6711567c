// SPDX-License-Identifier: Apache-2.0
// The modal state: the function in force of each mode, and the words that stay in force.
#pragma once

#include <cstring>

#include "dialect/dialect.hpp"
#include "modal/modes.hpp"
#include "nc/item.h"

namespace nc {

/// Trivially copyable and comparable: snapshots of it are interned. No padding: states are compared as bytes, once in every block.
struct ModalState {
  static constexpr unsigned kRoom = 22;   ///< at least kModes, and such that the struct has no padding
  static_assert(kModes <= kRoom);

  Function in_force[kRoom] = {};   ///< function in force, by Mode; elements from kModes on are not used
  uint8_t number[kRoom] = {};      ///< which of the family's codes for that function was commanded (FunctionRow::number)
  uint16_t extended = 0;           ///< n of G54.1 Pn while it is active
  uint16_t feed_digit = 0;         ///< n + 1: F is the one digit n (M700 7.3)
  double feed = 0;                 ///< F as programmed (its unit is that of the block that moves: M700 5.2 note 1); 0 = none yet
  double spindle = 0;              ///< S as programmed
  uint32_t tool = 0, d = 0, h = 0, m = 0, n = 0, o = 0, b = 0;  ///< the last of each; b: second auxiliary function
  uint16_t h_given = 0;            ///< 1: an H has been commanded, also H0
  uint16_t d_given = 0;            ///< 1: a D of radius compensation or position offset has been commanded, also D0

  Function of(Mode mode) const { return in_force[static_cast<unsigned>(mode)]; }
  /// The modal function is in force.
  bool is(Function function) const { return of(mode_of(function)) == function; }
  /// A modal function comes into force.
  void set(Function function, uint8_t which = 0) {
    const auto mode = static_cast<unsigned>(mode_of(function));
    in_force[mode] = function;
    number[mode] = which;
  }
  void set(const FunctionRow& row) { set(row.function, row.number); }
  /// This very code of a modal function is in force: set(row) would change nothing.
  bool holds(const FunctionRow& row) const { return is(row.function) && number[static_cast<unsigned>(mode_of(row.function))] == row.number; }

  bool operator==(const ModalState& other) const { return std::memcmp(this, &other, sizeof(*this)) == 0; }
};
static_assert(sizeof(ModalState) == 2 * ModalState::kRoom + 2 * sizeof(uint16_t) + 2 * sizeof(double) + 8 * sizeof(uint32_t));

/// The modal state at power on.
inline ModalState initial_modal(const Dialect& dialect) {
  ModalState state;
  for (unsigned i = 0; i < kModes; ++i) state.set(resting(static_cast<Mode>(i)));
  for (const Function function : dialect.initial) state.set(function);
  return state;
}

/// The row of the code that is in force for a mode, nullptr = the family has no codes for the mode.
inline const FunctionRow* row_in_force(const Dialect& dialect, const ModalState& state, Mode mode) {
  for (const FunctionRow& row : dialect.functions)
    if (mode_of(row.function) == mode && state.holds(row)) return &row;
  return nullptr;
}

/// The code in force of a group, which is numbered as the family does, times 10; -1 = the family has no such group.
inline int16_t code_in_force(const Dialect& dialect, const ModalState& state, unsigned group) {
  for (const FunctionRow& row : dialect.functions)
    if (row.group == group && state.holds(row)) return row.code;
  return -1;
}

inline nc_modal to_public(const Dialect& dialect, const ModalState& s) {
  nc_modal m{};
  for (int16_t& code : m.code) code = -1;
  for (const FunctionRow& row : dialect.functions)
    if (row.group != 0 && s.holds(row)) m.code[row.group] = row.code;
  m.feed = s.feed;
  m.spindle = s.spindle;
  m.tool = s.tool;
  m.d = s.d;
  m.h = s.h;
  m.m = s.m;
  m.n = s.n;
  m.o = s.o;
  m.b = s.b;
  return m;
}

}  // namespace nc
