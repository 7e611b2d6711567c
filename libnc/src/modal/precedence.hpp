// SPDX-License-Identifier: Apache-2.0
// Which functions may share a block, and what becomes of each (M700 appendix 2); and which ones a mode in force does not bear.
// Tables: a rule that is not here is not in the appendix.
#pragma once

#include "dialect/dialect.hpp"

namespace nc {

/// What a code leaves of another one in its block.
enum class Precedence : uint8_t {
  both,      ///< both act
  ignored,   ///< the other one is as if it were not there
  modal,     ///< the other one does nothing but becomes modal
  loses      ///< the other one acts, and this code is as if it were not there
};

/// A row of appendix 2: `function` and the modes beside it. Modes that are not here act beside every code; of one mode the last code
/// counts (3.7).
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

/// The row of a function; one where everything but mirror is `both` when the appendix has none.
const PrecedenceRow& precedence_of(Function function);

/// Modes in force that codes cannot be commanded in.
inline constexpr uint8_t kInPolarCommand = 1;  ///< G16
inline constexpr uint8_t kInFigure = 2;        ///< a program called by M98 I J K
inline constexpr uint8_t kInSpaceArc = 4;      ///< G02.4, G03.4
inline constexpr uint8_t kInDiameterOffset = 8;  ///< DGSHAPE G41, G42
inline constexpr uint8_t kInExponential = 16;  ///< G02.3, G03.3

struct BarredRow {
  uint8_t mode;          ///< of those above
  Function function;
  Condition condition;
  const char* section;
};

/// What a function meets in `modes`, Condition::none when it may stand there.
Condition barred(unsigned modes, Function function);

}  // namespace nc
