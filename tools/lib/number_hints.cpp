// SPDX-License-Identifier: Apache-2.0
// Finds numbers that probably mean something else; see number_hints.hpp.
#include "tools/lib/number_hints.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

namespace nc::tools {
namespace {

/// A text such as "1 more number" or "2 more numbers".
std::string more(uint64_t count, const char* noun) { return std::to_string(count) + " more " + noun + (count == 1 ? "" : "s"); }

/// The key of the parameter with this role if it is 0 or not set; "" = it is set, or the dialect has no such parameter.
std::string switched_off(const Session& session, nc_parameter_role role) {
  char key[24];
  double value = 0;
  if (nc_parameter_key_get(session.control(), role, key) != NC_OK) return "";
  return nc_parameter_get(session.control(), kPartSystem, key, 0, &value) == NC_OK && value == 0 ? key : "";
}

/// The word as it is written in the block at `begin`, without blanks; its address alone where the block is so long that its place is not known.
std::string spelled(const std::string& text, size_t begin, const nc_plain_word& word) {
  std::string spelling = word.comma ? "," : "";
  if (word.end == 0) return spelling + word.letter;
  for (size_t i = begin + word.begin; i < begin + word.end; ++i)
    if (text[i] != ' ' && text[i] != '\t') spelling += static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
  return spelling;
}

}  // namespace

void NumberHints::count_without_point(const std::string& word, double value, uint32_t line) {
  if (without_point++ == 0) {
    first_without = line;
    first_word = word;
  }
  if (value > largest_without) {
    largest_without = value;
    largest_word = word;
  }
}

NumberHints number_hints(const std::string& text, nc_dialect dialect, const std::string& axes, bool lengths) {
  NumberHints hints;
  bool plain_place[256] = {};  // a line of nothing but these characters commands places: no dwell
  for (const unsigned char c : axes + "0123456789+-. \t\r") plain_place[c] = true;
  uint32_t line = 1;
  nc_block_text block = NC_INIT(nc_block_text);
  nc_plain_word words[NC_MAX_WORDS];
  for (size_t begin = 0; begin < text.size(); begin += block.used) {
    const size_t line_end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    if (!lengths && std::all_of(text.begin() + static_cast<ptrdiff_t>(begin), text.begin() + static_cast<ptrdiff_t>(line_end) - 1, [&](unsigned char c) { return plain_place[c]; })) {
      block.used = line_end - begin;
      ++line;
      continue;
    }
    if (nc_block_words(dialect, axes.c_str(), text.data() + begin, text.size() - begin, &block, words) != NC_OK || block.used == 0) return {};
    for (uint32_t i = 0; i < block.count; ++i) {
      const nc_plain_word& word = words[i];
      if (word.value == 0) continue;  // the same in every unit
      if (word.kind == NC_NUMBER_LENGTH) {
        if (word.point) ++hints.with_point;
        else hints.count_without_point(spelled(text, begin, word), std::fabs(word.value), line);
      }
      if (word.kind != NC_NUMBER_DWELL || !word.point || hints.dwells++ != 0) continue;
      hints.first_dwell = line;
      hints.dwell_word = spelled(text, begin, word);
    }
    if (text[begin + block.used - 1] == '\n') ++line;
  }
  return hints;
}

bool note_numbers(const Session& session, std::FILE* err) {
  // M700 5.3: in type II a number without a point is in mm. 8.1: P is in ms, with a point or without, unless a parameter makes the point count.
  const std::string type_2 = switched_off(session, NC_PARAMETER_DECIMAL_TYPE_2), dwell_point = switched_off(session, NC_PARAMETER_DWELL_POINT);
  bool whole = true;
  nc_undotted_get(session.control(), kPartSystem, &whole);
  if (whole && dwell_point.empty()) return false;
  const std::string text = session.main_text();
  const nc_config& config = session.config();
  std::string letters;
  for (unsigned i = 0; i < config.system[kPartSystem].axis_count; ++i) letters += config.system[kPartSystem].axis[i].name;
  const NumberHints hints = number_hints(text, session.dialect(), letters, !whole);
  nc_source source = {};
  source.file = session.main_file();
  const std::string file = rt::valid_utf8(session.file_name(source));
  constexpr const char* kUnit = "read in the least command unit (0.001 mm, 0.0001 inch or 0.001 deg unless parameters say otherwise)";
  const auto without = static_cast<unsigned long long>(hints.without_point);
  const std::string by_parameter = type_2.empty() ? "" : "; with #" + type_2 + " = 1 " + (without == 1 ? "it is mm" : "they are mm");
  if (!whole && hints.doubtful())
    std::fprintf(err, "note: %s:%u: %s%s without a decimal point %s %s%s\n", file.c_str(), hints.first_without, hints.first_word.c_str(),
                 without == 1 ? "" : (" and " + more(without - 1, "number")).c_str(), without == 1 ? "is" : "are", kUnit, by_parameter.c_str());
  else if (!whole && without != 0)
    std::fprintf(err, "note: %s: all numbers are without a decimal point, %llu from line %u on, and %s; the largest is %s\n", file.c_str(), without,
                 hints.first_without, kUnit, hints.largest_word.c_str());
  if (!dwell_point.empty() && hints.dwells != 0)
    std::fprintf(err, "note: %s:%u: %s of a dwell counts milliseconds, and the point does not count (#%s)%s\n", file.c_str(), hints.first_dwell,
                 hints.dwell_word.c_str(), dwell_point.c_str(), hints.dwells == 1 ? "" : ("; " + more(hints.dwells - 1, "dwell")).c_str());
  return !whole && hints.probably_whole() && type_2.empty();
}

}  // namespace nc::tools
