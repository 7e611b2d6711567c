// SPDX-License-Identifier: Apache-2.0
// Which functions may stand in one block, and what becomes of each; and which functions may not be commanded while a certain mode is in force. Both are
// tables: what all families have in common stands in default_precedence.cpp, and what one has of its own in Dialect::precedence and Dialect::barred.
#pragma once

#include <cstdint>

#include "alarm/condition.hpp"
#include "dialect/function.hpp"

namespace nc {

struct Dialect;

/// What happens when another code stands in the block of a code.
enum class Precedence : uint8_t {
  both,      ///< both codes act
  ignored,   ///< the other code is treated as if it were not there
  modal,     ///< the other code only becomes modal and does nothing in this block
  loses      ///< the other code acts, and this one is treated as if it were not there
};

/// A function, and what happens to a code of each of these modes in its block. Codes of modes without a column act beside every code; when a block has
/// several codes of one mode the last one counts (M700 3.7).
struct PrecedenceRow {
  Function function;
  Precedence motion;
  Precedence radius;
  Precedence length;
  Precedence cycle;
  Precedence work;
  Precedence macro;    ///< modal calls and their end
  Precedence mirror;
};

/// The row of a function: the family's own, or else that of all families. A function without either has a row in which everything but mirror is `both`.
const PrecedenceRow& precedence_of(const Dialect& dialect, Function function);

/// Modes in which some codes cannot be commanded: bits.
inline constexpr uint8_t kInPolarCommand = 1;   ///< end points are given by radius and angle
inline constexpr uint8_t kInFigure = 2;         ///< a program is executed as a rotated figure
inline constexpr uint8_t kInSpaceArc = 4;       ///< the motion is an arc in space
inline constexpr uint8_t kInCompensation = 8;   ///< the tool radius is compensated in the plane
inline constexpr uint8_t kInExponential = 16;   ///< the motion is an exponential curve
inline constexpr uint8_t kInMap = 32;           ///< coordinates are scaled or rotated

/// A function that is an alarm in a mode.
struct BarredRow {
  uint8_t mode;          ///< one of the bits above
  Function function;
  Condition condition;
  const char* section;
};

/// The alarm of a function that is commanded in one of `modes`: the family's own, or else that of all families. Condition::none when it may be commanded.
Condition barred(const Dialect& dialect, unsigned modes, Function function);

}  // namespace nc
