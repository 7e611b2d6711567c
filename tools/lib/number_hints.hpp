// SPDX-License-Identifier: Apache-2.0
// Numbers of a program that probably mean something else than what the control reads.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "tools/lib/session.hpp"

namespace nc::tools {

/** From the text of a program, whether a block is executed or not. */
struct NumberHints {
  uint64_t with_point = 0, without_point = 0;  // dimension words; zeros are the same in every unit
  uint32_t first_without = 0;                  // line
  std::string first_word;                      // "X10"
  double largest_without = 0;
  std::string largest_word;
  uint64_t dwells = 0;  // times of a dwell with a point
  uint32_t first_dwell = 0;
  std::string dwell_word;  // "P1.00000"

  void count_length(const std::string& word, bool point, double value, uint32_t line);

  /**
   * What stands without a point was hardly meant in thousandths: others have a point, or all of it together is less than a millimetre. A
   * program that is written in thousandths throughout is what it says: of that the numbers are only told.
   */
  bool doubtful() const { return without_point != 0 && (with_point != 0 || largest_without < 1000); }
};

/** @param axes letters of the axes */
NumberHints number_hints(const std::string& text, nc_dialect dialect, const std::string& axes);

/** The hints that hold with the parameters of this control, on `err`. */
void note_numbers(const Session& session, std::FILE* err);

}  // namespace nc::tools
