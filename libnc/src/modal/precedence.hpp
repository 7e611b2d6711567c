// SPDX-License-Identifier: Apache-2.0
// Which functions may stand in one block, and what becomes of each (M700 appendix 2); and which functions may not be commanded while a certain mode is
// in force. Both are tables: a rule that is not here is not in the appendix.
#pragma once

#include "dialect/dialect.hpp"

namespace nc {

/// What happens when another code stands in the block of a code.
enum class Precedence : uint8_t {
  both,      ///< both codes act
  ignored,   ///< the other code is treated as if it were not there
  modal,     ///< the other code only becomes modal and does nothing in this block
  loses      ///< the other code acts, and this one is treated as if it were not there
};

/// A row of appendix 2: `function`, and what happens to a code of each of these modes in the same block. Codes of modes without a column act beside every
/// code; when a block has several codes of one mode the last one counts (3.7).
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

/// The row of a function. When the appendix has none it is a row in which everything but mirror is `both`.
const PrecedenceRow& precedence_of(Function function);

/// Modes in which some codes cannot be commanded: bits.
inline constexpr uint8_t kInPolarCommand = 1;  ///< G16
inline constexpr uint8_t kInFigure = 2;        ///< a program called by M98 I J K
inline constexpr uint8_t kInSpaceArc = 4;      ///< G02.4, G03.4
inline constexpr uint8_t kInDiameterOffset = 8;  ///< DGSHAPE G41, G42
inline constexpr uint8_t kInExponential = 16;  ///< G02.3, G03.3
inline constexpr uint8_t kInMap = 32;          ///< HX G51, G68

struct BarredRow {
  uint8_t mode;          ///< one of the bits above
  Function function;
  Condition condition;
  const char* section;
};

/// The alarm of a function that is commanded in one of `modes`, Condition::none when it may be commanded.
Condition barred(unsigned modes, Function function);

}  // namespace nc
