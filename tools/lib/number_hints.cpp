// SPDX-License-Identifier: Apache-2.0
// Numbers that probably mean something else; see number_hints.hpp.
#include "tools/lib/number_hints.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace nc::tools {
namespace {

struct PlainWord {
  char letter;
  std::string number;  // sign, digits, point; "" = not a plain number
  bool point() const { return number.find('.') != std::string::npos; }
  double value() const { return std::strtod(number.c_str(), nullptr); }
};

/** The words of a line; none when it has a macro statement. */
std::vector<PlainWord> words_of(const std::string& line) {
  std::vector<PlainWord> words;
  bool comment = false, comma = false;
  int depth = 0;
  for (const char raw : line) {
    const char c = raw >= 'a' && raw <= 'z' ? static_cast<char>(raw - 32) : raw;
    if (comment || c == '(') {
      comment = c != ')';
      continue;
    }
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (depth > 0 || c == ' ' || c == '\t' || c == '\r') continue;
    if (c == '=') return {};
    if (c == ';') break;
    if (c >= 'A' && c <= 'Z') {
      if (!words.empty() && words.back().number.empty()) return {};  // a keyword
      words.push_back({comma ? ' ' : c, ""});
    } else if (!words.empty()) {
      words.back().number += c;
    }
    comma = c == ',';
  }
  std::erase_if(words, [](const PlainWord& word) {
    return word.number.empty() || word.number.find_first_not_of("+-.0123456789") != std::string::npos;
  });
  return words;
}

bool has(const std::vector<PlainWord>& words, char letter, std::initializer_list<double> numbers) {
  return std::any_of(words.begin(), words.end(), [&](const PlainWord& word) {
    return word.letter == letter && std::find(numbers.begin(), numbers.end(), word.value()) != numbers.end();
  });
}

/// The key of a parameter of this dialect that is 0 or not set; "" = it is set, or the dialect has none.
std::string switched_off(const Session& session, nc_parameter_role role) {
  char key[24];
  double value = 0;
  if (nc_parameter_key(session.control(), role, key) != NC_OK) return "";
  return nc_parameter_get(session.control(), kPartSystem, key, 0, &value) == NC_OK && value == 0 ? key : "";
}

}  // namespace

NumberHints number_hints(const std::string& text, const std::string& letters) {
  const std::string dimensions = letters + "IJKR";
  NumberHints hints;
  uint32_t line = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::vector<PlainWord> words = words_of(text.substr(begin, end - begin));
    ++line;
    begin = end + 1;
    const bool dwell = has(words, 'G', {4});
    // Their words are arguments, data and times, not dimensions.
    const bool other = dwell || has(words, 'G', {10, 65, 66, 66.1}) || has(words, 'M', {98, 198});
    for (const PlainWord& word : words) {
      if (dwell && word.letter == 'P' && word.point() && word.value() != 0 && hints.dwells++ == 0) {
        hints.first_dwell = line;
        hints.dwell_word = "P" + word.number;
      }
      if (other || dimensions.find(word.letter) == std::string::npos || word.value() == 0) continue;
      if (word.point()) {
        ++hints.with_point;
        continue;
      }
      if (hints.without_point++ == 0) {
        hints.first_without = line;
        hints.first_word = word.letter + word.number;
      }
      if (std::fabs(word.value()) > hints.largest_without) {
        hints.largest_without = std::fabs(word.value());
        hints.largest_word = word.letter + word.number;
      }
    }
  }
  return hints;
}

void note_numbers(const Session& session, std::FILE* err) {
  const std::string text = session.main_text();
  const nc_config& config = session.config();
  std::string letters;
  for (unsigned i = 0; i < config.system[kPartSystem].axis_count; ++i) letters += config.system[kPartSystem].axis[i].name;
  const NumberHints hints = number_hints(text, letters);
  nc_source source = {};
  source.file = session.main_file();
  const std::string file = rt::valid_utf8(session.file_name(source));
  constexpr const char* kUnit = "read in the least command unit (0.001 mm, 0.0001 inch or 0.001 deg unless parameters say otherwise)";
  // M700 5.3: in type II a number without a point is in mm.
  const std::string type_2 = switched_off(session, NC_PARAMETER_DECIMAL_TYPE_2);
  const auto without = static_cast<unsigned long long>(hints.without_point);
  if (!type_2.empty() && hints.doubtful())
    std::fprintf(err, "note: %s:%u: %s and %llu more numbers without a decimal point are %s; with #%s = 1 they are mm\n", file.c_str(), hints.first_without,
                 hints.first_word.c_str(), without - 1, kUnit, type_2.c_str());
  else if (!type_2.empty() && without != 0)
    std::fprintf(err, "note: %s: all numbers are without a decimal point, %llu from line %u on, and %s; the largest is %s\n", file.c_str(), without,
                 hints.first_without, kUnit, hints.largest_word.c_str());
  // M700 8.1: P is in ms, with a point or without, unless a parameter makes the point count.
  if (const std::string key = switched_off(session, NC_PARAMETER_DWELL_POINT); !key.empty() && hints.dwells != 0)
    std::fprintf(err, "note: %s:%u: G04 %s: P counts milliseconds, and the point does not count (#%s); %llu more of these\n", file.c_str(),
                 hints.first_dwell, hints.dwell_word.c_str(), key.c_str(), static_cast<unsigned long long>(hints.dwells - 1));
}

}  // namespace nc::tools
