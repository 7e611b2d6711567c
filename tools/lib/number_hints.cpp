// SPDX-License-Identifier: Apache-2.0
// Finds numbers that probably mean something else; see number_hints.hpp.
#include "tools/lib/number_hints.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace nc::tools {
namespace {

struct PlainWord {
  char letter;
  bool comma;
  std::string number;  // sign, digits and point; "" = not a plain number
  bool point() const { return number.find('.') != std::string::npos; }
  std::string text() const { return (comma ? "," : "") + std::string(1, letter) + number; }
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
      if (!words.empty() && words.back().number.empty()) return {};  // two letters in a row are a keyword of a macro statement
      words.push_back({c, comma, ""});
    } else if (c != ',' && !words.empty()) {
      words.back().number += c;
    }
    comma = c == ',';
  }
  std::erase_if(words, [](const PlainWord& word) {
    return word.number.empty() || word.number.find_first_not_of("+-.0123456789") != std::string::npos;
  });
  return words;
}

/// A text such as "1 more number" or "2 more numbers".
std::string more(uint64_t count, const char* noun) { return std::to_string(count) + " more " + noun + (count == 1 ? "" : "s"); }

/// The key of the parameter with this role if it is 0 or not set; "" = it is set, or the dialect has no such parameter.
std::string switched_off(const Session& session, nc_parameter_role role) {
  char key[24];
  double value = 0;
  if (nc_parameter_key_get(session.control(), role, key) != NC_OK) return "";
  return nc_parameter_get(session.control(), kPartSystem, key, 0, &value) == NC_OK && value == 0 ? key : "";
}

}  // namespace

void NumberHints::count_length(const std::string& word, bool point, double value, uint32_t line) {
  if (point) {
    ++with_point;
    return;
  }
  if (without_point++ == 0) {
    first_without = line;
    first_word = word;
  }
  if (value > largest_without) {
    largest_without = value;
    largest_word = word;
  }
}

NumberHints number_hints(const std::string& text, nc_dialect dialect, const std::string& axes) {
  NumberHints hints;
  uint32_t line = 0;
  bool data = false;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::vector<PlainWord> words = words_of(text.substr(begin, end - begin));
    ++line;
    begin = end + 1;
    std::vector<nc_plain_word> plain;
    plain.reserve(words.size());
    for (const PlainWord& word : words) plain.push_back({word.letter, word.comma, word.value()});
    std::vector<uint8_t> kinds(words.size());
    if (nc_number_kinds(dialect, axes.c_str(), plain.data(), static_cast<unsigned>(plain.size()), &data, kinds.data()) != NC_OK) return {};
    for (size_t i = 0; i < words.size(); ++i) {
      const PlainWord& word = words[i];
      if (word.value() == 0) continue;  // 0 is the same in every unit
      if (kinds[i] == NC_NUMBER_LENGTH) hints.count_length(word.text(), word.point(), std::fabs(word.value()), line);
      if (kinds[i] != NC_NUMBER_DWELL || !word.point() || hints.dwells++ != 0) continue;
      hints.first_dwell = line;
      hints.dwell_word = word.text();
    }
  }
  return hints;
}

void note_numbers(const Session& session, std::FILE* err) {
  const std::string text = session.main_text();
  const nc_config& config = session.config();
  std::string letters;
  for (unsigned i = 0; i < config.system[kPartSystem].axis_count; ++i) letters += config.system[kPartSystem].axis[i].name;
  const NumberHints hints = number_hints(text, session.dialect(), letters);
  nc_source source = {};
  source.file = session.main_file();
  const std::string file = rt::valid_utf8(session.file_name(source));
  constexpr const char* kUnit = "read in the least command unit (0.001 mm, 0.0001 inch or 0.001 deg unless parameters say otherwise)";
  // M700 5.3: in type II a number without a point is in mm.
  const std::string type_2 = switched_off(session, NC_PARAMETER_DECIMAL_TYPE_2);
  const auto without = static_cast<unsigned long long>(hints.without_point);
  if (!type_2.empty() && hints.doubtful())
    std::fprintf(err, "note: %s:%u: %s%s without a decimal point %s %s; with #%s = 1 %s mm\n", file.c_str(), hints.first_without, hints.first_word.c_str(),
                 without == 1 ? "" : (" and " + more(without - 1, "number")).c_str(), without == 1 ? "is" : "are", kUnit, type_2.c_str(),
                 without == 1 ? "it is" : "they are");
  else if (!type_2.empty() && without != 0)
    std::fprintf(err, "note: %s: all numbers are without a decimal point, %llu from line %u on, and %s; the largest is %s\n", file.c_str(), without,
                 hints.first_without, kUnit, hints.largest_word.c_str());
  // M700 8.1: P is in ms, with a point or without, unless a parameter makes the point count.
  if (const std::string key = switched_off(session, NC_PARAMETER_DWELL_POINT); !key.empty() && hints.dwells != 0)
    std::fprintf(err, "note: %s:%u: %s of a dwell counts milliseconds, and the point does not count (#%s)%s\n", file.c_str(), hints.first_dwell,
                 hints.dwell_word.c_str(), key.c_str(), hints.dwells == 1 ? "" : ("; " + more(hints.dwells - 1, "dwell")).c_str());
}

}  // namespace nc::tools
