// SPDX-License-Identifier: Apache-2.0
// Finds numbers that probably mean something else; see number_hints.hpp.
#include "tools/lib/number_hints.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

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

/// So many blocks, of which one has a length with a point, are read before a faster way is looked for.
constexpr uint32_t kReadAll = 100;

/// The word as it is written in the block at `begin`, without blanks; its address alone where the block is so long that its place is not known.
std::string spelled(std::string_view text, size_t begin, const nc_plain_word& word) {
  std::string spelling = word.comma ? "," : "";
  if (word.end == 0) return spelling + word.letter;
  for (size_t i = begin + word.begin; i < begin + word.end; ++i)
    if (text[i] != ' ' && text[i] != '\t') spelling += static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
  return spelling;
}

/// Finds the lines of a text that may have the time of a dwell, without reading the others, which are nearly all: a line with the code of a dwell, or one behind
/// which the lines are data. A number that is not written plainly may be any code.
class DwellSearch {
 public:
  DwellSearch(std::string_view text, nc_dialect dialect) : text_(text) {
    nc_function row = NC_INIT(nc_function);
    for (unsigned i = 0; nc_function_row(dialect, i, &row) == NC_OK; ++i) {
      const auto tenths = static_cast<uint32_t>(std::lround(std::strtod(row.code + 1, nullptr) * 10));
      const nc_code_role role = nc_code_role_get(dialect, row.code[0], tenths);
      if (role != NC_CODE_DWELL && role != NC_CODE_DATA_INPUT) continue;
      wanted_.push_back(tenths);
      letters_[0].spelling = row.code[0];
      letters_[1].spelling = static_cast<char>(std::tolower(row.code[0]));
    }
  }

  /// The first character from `from` on, where a block begins, of such a line; the size of the text where none follows.
  size_t next(size_t from) {
    for (size_t at = from; (at = next_letter(at)) != text_.size(); ++at) {
      if (!may_be_wanted(at + 1)) continue;
      const size_t line_end = text_.rfind('\n', at);
      return line_end == text_.npos ? from : std::max(from, line_end + 1);
    }
    return text_.size();
  }

 private:
  struct Letter {
    char spelling = 0;
    size_t place = 0;      ///< the first one at or behind the place that was asked for last
    bool searched = false;
  };

  size_t next_letter(size_t from) {
    size_t nearest = text_.size();
    for (Letter& letter : letters_) {
      if (!letter.searched || letter.place < from) letter.place = std::min(text_.find(letter.spelling, from), text_.size());
      letter.searched = true;
      nearest = std::min(nearest, letter.place);
    }
    return nearest;
  }

  bool may_be_wanted(size_t at) const {
    constexpr uint32_t kMost = 10000;
    const auto is = [&](char from, char to) { return at < text_.size() && text_[at] >= from && text_[at] <= to; };
    uint32_t number = 0;
    const size_t begin = at;
    for (; is('0', '9') && number < kMost; ++at) number = 10 * number + static_cast<uint32_t>(text_[at] - '0');
    const bool digits = at != begin && number < kMost;
    while (is(' ', ' ') || is('\r', '\r')) ++at;
    const bool plain = digits && (at == text_.size() || is('\n', '\n') || is('A', 'Z') || is('a', 'z'));
    return !plain || std::find(wanted_.begin(), wanted_.end(), number * 10) != wanted_.end();
  }

  const std::string_view text_;
  std::vector<uint32_t> wanted_;  // codes, times 10
  Letter letters_[2];  // of codes: the capital and the small one
};

/// Finds the lines of a text that may have a length without a decimal point, without reading the others: where programs come from a CAM system those are nearly
/// all. What no plain word begins with (a comment, a formula, a comma) makes its line one that must be read.
class UndottedSearch {
 public:
  UndottedSearch(std::string_view text, nc_dialect dialect, const std::string& axes) : text_(text) {
    std::array<Kind, 256> kinds;
    kinds.fill(Kind::other);
    const auto at = [&kinds](char c) -> Kind& { return kinds[static_cast<unsigned char>(c)]; };
    for (const char c : {' ', '\t', '\r', '+', '-'}) at(c) = Kind::between;
    for (char c = '0'; c <= '9'; ++c) at(c) = Kind::digit;
    at('.') = Kind::point;
    at('\n') = Kind::line_end;
    bool read[26] = {}, length[26] = {};
    nc_function row = NC_INIT(nc_function);
    for (unsigned i = 0; nc_function_row(dialect, i, &row) == NC_OK; ++i) look_at_letters(row.code, dialect, axes, read, length);
    for (unsigned i = 0; i < 26; ++i) {
      const Kind kind = read[i] && !length[i] ? Kind::no_length : Kind::length;
      at(static_cast<char>('A' + i)) = at(static_cast<char>('a' + i)) = kind;
    }
    for (unsigned c = 0; c < 256; ++c) steps_[c] = steps_of(kinds[c]);
  }

  /// The first character from `from` on, where a block begins, of such a line; the size of the text where none follows.
  size_t next(size_t from) const {
    uint64_t state = shift_of(State::before);
    const char *place = text_.data() + from, *const end = text_.data() + text_.size();
    while (end - place >= kAtOnce) {
      uint64_t behind = state;
      for (unsigned i = 0; i < kAtOnce; ++i) behind = step(behind, place[i]);
      if (behind == shift_of(State::found)) break;
      state = behind;
      place += kAtOnce;
    }
    while (place != end && (state = step(state, *place)) != shift_of(State::found)) ++place;
    if (place == end && state != shift_of(State::digits)) return text_.size();
    const auto found = static_cast<size_t>(place - text_.data());
    const size_t line_end = found == 0 ? text_.npos : text_.rfind('\n', found - 1);
    return line_end == text_.npos ? from : std::max(from, line_end + 1);
  }

 private:
  enum class Kind : uint8_t { other, length, no_length, between, line_end, digit, point };
  enum class State : uint8_t {
    beside,  ///< in a word that is no length
    before,  ///< where a number would be that of a length; one in front of any address is none of a plain word
    digits,  ///< in such a number, which has no point so far
    dotted,  ///< in such a number, which has one
    found    ///< and stays so
  };
  /// What follows in each state from a character of each kind.
  static constexpr State kNext[4][8] = {
      {State::found, State::before, State::beside, State::beside, State::before, State::beside, State::beside},
      {State::found, State::before, State::beside, State::before, State::before, State::digits, State::dotted},
      {State::found, State::found, State::found, State::found, State::found, State::digits, State::dotted},
      {State::found, State::before, State::beside, State::before, State::before, State::dotted, State::dotted}};

  // A state is held as the place of its bits in a word that has the next state for each one. A step is then one shift of a word that depends on the character
  // alone: a table of two indices would be waited for once for each character, and a branch would be guessed wrong.
  static constexpr unsigned kBits = 6;       // hold the place of any state
  static constexpr std::ptrdiff_t kAtOnce = 32;  // characters between two looks whether the state is `found`
  static constexpr uint64_t shift_of(State state) { return kBits * static_cast<uint64_t>(state); }
  static uint64_t steps_of(Kind kind) {
    uint64_t steps = shift_of(State::found) << shift_of(State::found);
    for (unsigned state = 0; state < 4; ++state) steps |= shift_of(kNext[state][static_cast<unsigned>(kind)]) << (kBits * state);
    return steps;
  }
  uint64_t step(uint64_t state, char c) const { return steps_[static_cast<unsigned char>(c)] >> state & ((1u << kBits) - 1); }

  /// Marks which letters the family reads as words of a block with this code, and which of them are lengths there. A word that the family takes at the begin of a
  /// block only is asked for there.
  static void look_at_letters(const std::string& code, nc_dialect dialect, const std::string& axes, bool* read, bool* length) {
    nc_block_text block = NC_INIT(nc_block_text);
    nc_plain_word words[NC_MAX_WORDS];
    std::string text = "N1" + code;
    for (char c = 'A'; c <= 'Z'; ++c)
      if (c != 'N' && c != 'O') text += std::string(1, c) + "1";
    block.data = false;
    if (nc_block_words(dialect, axes.c_str(), text.data(), text.size(), &block, words) != NC_OK) return;
    for (uint32_t i = 0; i < block.count; ++i) {
      if (words[i].letter < 'A' || words[i].letter > 'Z') continue;
      read[words[i].letter - 'A'] = true;
      if (words[i].kind == NC_NUMBER_LENGTH) length[words[i].letter - 'A'] = true;
    }
  }

  const std::string_view text_;
  std::array<uint64_t, 256> steps_;  ///< for each character
};

}  // namespace

bool NumberHints::count_without_point(const std::string& word, double value) {
  const bool first = without_point++ == 0;
  if (first) first_word = word;
  if (value > largest_without) {
    largest_without = value;
    largest_word = word;
  }
  return first;
}

NumberHints number_hints(std::string_view text, nc_dialect dialect, const std::string& axes, bool lengths) {
  NumberHints hints;
  const auto line_of = [&](size_t place) { return 1 + static_cast<uint32_t>(std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(place), '\n')); };
  DwellSearch dwells(text, dialect);
  std::optional<UndottedSearch> undotted;  // what it has to know is looked up where a program is long enough
  uint32_t blocks = 0;
  nc_block_text block = NC_INIT(nc_block_text);
  nc_plain_word words[NC_MAX_WORDS];
  for (size_t begin = 0; begin < text.size(); begin += block.used) {
    if (lengths && !undotted && hints.with_point && ++blocks > kReadAll) undotted.emplace(text, dialect, axes);
    if (!block.data && (!lengths || undotted)) begin = lengths ? std::min(dwells.next(begin), undotted->next(begin)) : dwells.next(begin);
    if (begin == text.size()) break;
    if (nc_block_words(dialect, axes.c_str(), text.data() + begin, text.size() - begin, &block, words) != NC_OK || block.used == 0) return {};
    for (uint32_t i = 0; i < block.count; ++i) {
      const nc_plain_word& word = words[i];
      if (word.value == 0) continue;  // the same in every unit
      if (word.kind == NC_NUMBER_LENGTH) {
        if (word.point) hints.with_point = true;
        else if (hints.count_without_point(spelled(text, begin, word), std::fabs(word.value))) hints.first_without = line_of(begin);
      }
      if (word.kind != NC_NUMBER_DWELL || !word.point || hints.dwells++ != 0) continue;
      hints.first_dwell = line_of(begin);
      hints.dwell_word = spelled(text, begin, word);
    }
  }
  return hints;
}

bool note_numbers(const Session& session, std::FILE* err) {
  // M700 5.3: in type II a number without a point is in mm. 8.1: P is in ms, with a point or without, unless a parameter makes the point count.
  const std::string type_2 = switched_off(session, NC_PARAMETER_DECIMAL_TYPE_2), dwell_point = switched_off(session, NC_PARAMETER_DWELL_POINT);
  bool whole = true;
  nc_undotted_get(session.control(), kPartSystem, &whole);
  if (whole && dwell_point.empty()) return false;
  const std::string_view text = session.main_text();
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
