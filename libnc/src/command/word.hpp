// SPDX-License-Identifier: Apache-2.0
// Numbers of a command as they are written, and what reading a block has come to.
#pragma once

#include <cmath>

#include "alarm/fault.hpp"
#include "dialect/role.hpp"
#include "program/block.hpp"
#include "stream/stream.hpp"

namespace nc {

/// A number as the program gives it. What it comes to depends on the modes of the whole block, so the core applies the units.
struct Written {
  double value = 0;
  uint8_t form = 0;  ///< WordFlag bits

  /// It is written with a point, or is an expression, which counts as one with a point (M700 5.3).
  bool pointed() const { return (form & (kWordPoint | kWordExpression)) != 0; }
  /// A point is written in it.
  bool has_point() const { return (form & kWordPoint) != 0; }
  bool is_expression() const { return (form & kWordExpression) != 0; }
  /// A sign stands before it, or it stands behind a small e directly behind another number.
  bool has_sign_or_exponent() const { return (form & (kWordNegative | kWordPlus | kWordExponent)) != 0; }
};

/// What reading a block, or a part of it, has come to.
enum class Reading : uint8_t {
  done,
  refused,  ///< the block is wrong: a Refusal says how
  fault,    ///< an expression has no value: a Fault says why
  sync      ///< an expression needs a value that the machine does not have yet
};

/// Why the words of a block are no command.
struct Refusal {
  Condition condition{};
  WordSlot word = kNoWord;  ///< it is about this one
  bool has_value = false;
  double value = 0;
};

/// What an alarm is about if it is about no word: a variable, a name of a file, or a character of a text.
enum class Sign : char { none = 0, variable = '#', file_name = '<' };

/// Puts into an alarm what it is about.
inline void name_word(Fault& fault, WordSlot word) { fault.letter = letter_of(word); }
/// Puts into an action the word that commands it.
inline void name_word(Action& action, WordSlot word) { action.letter = index_of(word) < kLetters ? letter_of(word) : char{0}; }
inline void name_sign(Fault& fault, Sign sign) { fault.letter = static_cast<char>(sign); }
/// The word that an alarm is about, kNoWord = none.
inline WordSlot word_of(const Fault& fault) { return word_named(fault.letter); }

/// Turns a value into a whole number; a fraction is dropped (M700 5.3). False when it is negative or too large.
inline bool whole_number(double raw, uint32_t* number) {
  const double whole = std::floor(raw + 1e-9);
  if (!(whole >= 0) || whole > 4294967295.0) return false;
  *number = static_cast<uint32_t>(whole);
  return true;
}

/// Puts the nearest whole number in the place of a value that is not farther than `within` from it. False when it is farther.
inline bool make_whole(double within, double* value) {
  const double nearest = std::nearbyint(*value);
  if (!(std::fabs(*value - nearest) <= within)) return false;
  *value = nearest;
  return true;
}

}  // namespace nc
