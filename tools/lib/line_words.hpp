// SPDX-License-Identifier: Apache-2.0
// The words that a line of a program shows before it is run, in all families of ISO words: comments stand in ( ) or behind ';', formulas in [ ], names in < >.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nc::tools {

struct PlainWord {
  char letter;
  bool comma;
  std::size_t begin, end;  // of its number in LineWords::number(): sign, digits and point
};

/** The words of one line. It is used again for each line, so that a long program costs no memory for each. */
class LineWords {
 public:
  /** Takes the words of a line that have plain numbers; none when a keyword (IF, GOTO) makes it a statement. */
  void read(std::string_view line);
  const std::vector<PlainWord>& words() const { return words_; }
  /** A variable is written in the line. */
  bool assigns() const { return assigns_; }
  std::string_view number(const PlainWord& word) const { return std::string_view(digits_).substr(word.begin, word.end - word.begin); }
  bool point(const PlainWord& word) const { return number(word).find('.') != std::string_view::npos; }
  std::string text(const PlainWord& word) const { return (word.comma ? "," : "") + std::string(1, word.letter) + std::string(number(word)); }
  /** Not a number where the word has more than one point or sign. */
  double value(const PlainWord& word) const;

 private:
  bool gather(std::string_view line);

  std::vector<PlainWord> words_;
  std::string digits_;
  bool assigns_ = false;
};

}  // namespace nc::tools
