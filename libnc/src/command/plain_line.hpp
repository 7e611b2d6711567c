// SPDX-License-Identifier: Apache-2.0
// The short way for the words of blocks like "G1 X1.5 Y2.0 Z-0.25", as nearly every block of a program from a CAM system is.
#pragma once

#include "command/front_end.hpp"

namespace nc {

/// Where a straight line ends, in millimetres.
struct PlainLine {
  uint32_t axes = 0;    ///< bit i: axis i is commanded
  AxisVec value;
  bool named = false;   ///< the block has the code of the straight line
};

/// The value of a word like X#3, where the local variable is not vacant. `locals`: #1 and those behind it; NaN = vacant.
[[gnu::noinline]] inline bool local_number(const Block& block, uint16_t code, const double* locals, unsigned count, double* number) {
  uint32_t variable = 0;
  if (!lone_variable(block, code, &variable) || variable - 1 >= count) return false;
  *number = locals[variable - 1];
  return *number == *number;
}

/// False: the block has any other word, an axis twice, or a number that is not in millimetres whatever the units are, or beyond `last_mm`.
/// It is defined here because it is as hot as anything that the reading of a program does. `locals()` gives the local variables.
template <class Locals>
inline bool read_plain_line(const Block& block, const FrontEnd& front, double last_mm, Locals locals, unsigned local_count, PlainLine* line) {
  for (const Word& word : block.words) {
    const int axis = front.axis_words->axis(slot_of(word));
    if (axis < 0) {  // of the words that are no axis words only G1 is allowed
      if (!front.is(word, Role::code) || word.value != front.codes->linear_number() || (word.flags & ~kWordPoint) != 0) return false;
      line->named = true;
      continue;
    }
    // A word with a point is in millimetres, whatever the unit of words without a point is; so is a variable.
    double number = word.value;
    if ((word.flags & ~(kWordNegative | kWordPlus)) != kWordPoint && (word.flags != kWordExpression || !local_number(block, word.code, locals(), local_count, &number)))
      return false;
    if (!(std::fabs(number) <= last_mm)) return false;
    if ((line->axes >> axis & 1) != 0) return false;  // the axis is commanded twice
    line->axes |= 1u << axis;
    line->value[static_cast<unsigned>(axis)] = number;
  }
  return true;
}

}  // namespace nc
