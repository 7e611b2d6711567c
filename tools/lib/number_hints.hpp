// SPDX-License-Identifier: Apache-2.0
// Numbers in a program that probably mean something else than what the control reads.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "tools/lib/session.hpp"

namespace nc::tools {

/** What the text of a program shows, whether its blocks are executed or not. */
struct NumberHints {
  bool with_point = false;     // some dimension word has a point; zeros do not count, because they are the same in every unit
  uint64_t without_point = 0;  // number of dimension words without a point, zeros not counted
  uint32_t first_without = 0;                  // line of the first word without a point
  std::string first_word;                      // that word: "X10"
  double largest_without = 0;
  std::string largest_word;
  uint64_t dwells = 0;  // number of dwells whose time has a point
  uint32_t first_dwell = 0;
  std::string dwell_word;  // "P1.00000"

  /** Counts a word without a point. @return true when it is the first one. */
  bool count_without_point(const std::string& word, double value);

  /**
   * True when the numbers without a point were probably not meant in thousandths: other numbers have a point, or all of them are less than a millimetre. A
   * program whose numbers are all in thousandths is probably meant so; for it there is only a note.
   */
  bool doubtful() const { return without_point != 0 && (with_point || largest_without < 1000); }

  /** They were probably meant in whole mm or inch: they are not only doubtful, but are places on a machine as such. One of them that would be metres away is not. */
  bool probably_whole() const { return doubtful() && largest_without < 1000; }

  /** They were probably meant in the least unit: one of them is farther away in whole mm than machines are long. */
  bool probably_least() const { return largest_without >= 5000; }
};

/**
 * @param axes letters of the axes
 * @param lengths true: all hints; false: only those of dwells, which is much faster
 */
NumberHints number_hints(std::string_view text, nc_dialect dialect, const std::string& axes, bool lengths);

/**
 * Prints on `err` the hints that apply with the parameters of this control. Returns true when numbers were probably meant in whole mm or inch, and the family
 * has no parameter to read them so: the program is then likely to be one of another family.
 */
bool note_numbers(const Session& session, std::FILE* err);

}  // namespace nc::tools
