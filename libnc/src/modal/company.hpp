// SPDX-License-Identifier: Apache-2.0
// Which G codes may share a block, and what becomes of each (M700 appendix 2); and which codes a mode in force does not bear.
// Tables: a rule that is not here is not in the appendix.
#pragma once

#include "dialect/dialect.hpp"

namespace nc {

/// What a code leaves of another one in its block.
enum class Beside : uint8_t {
  both,      ///< both act
  ignored,   ///< the other one is as if it were not there
  modal,     ///< the other one does nothing but becomes modal
  loses      ///< the other one acts, and this code is as if it were not there
};

/// A row of appendix 2: `function` and the groups beside it. Groups that are not here act beside every code; of one group the last code
/// counts (3.7).
struct CompanyRow {
  Function function;
  Beside motion;   ///< 01
  Beside radius;   ///< 07
  Beside length;   ///< 08
  Beside cycle;    ///< 09
  Beside work;     ///< 12
  Beside macro;    ///< 14: G66 G66.1 G67
  Beside mirror;   ///< 19
};

/// The row of a function; one where everything but mirror is `both` when the appendix has none.
const CompanyRow& company_of(Function function);

/// Modes in force that codes cannot be commanded in.
inline constexpr uint8_t kInPolarCommand = 1;  ///< G16
inline constexpr uint8_t kInFigure = 2;        ///< a program called by M98 I J K
inline constexpr uint8_t kInSpaceArc = 4;      ///< G02.4, G03.4
inline constexpr uint8_t kInDiameterOffset = 8;  ///< DGSHAPE G41, G42
inline constexpr uint8_t kInExponential = 16;  ///< G02.3, G03.3

struct BarredRow {
  uint8_t mode;          ///< of those above
  int16_t first, last;   ///< codes, times 10
  Condition condition;
  const char* section;
};

/// What a code meets in `modes`, Condition::none when it may stand there.
Condition barred(unsigned modes, int16_t code);

}  // namespace nc
