// SPDX-License-Identifier: Apache-2.0
// See way_out.hpp.
#include "tools/lib/way_out.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace nc::tools {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The lines without blanks and comments, in capitals.
std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
      comment = false;
    } else if (c == '(' || comment) {
      comment = c != ')';
    } else if (c > ' ') {
      lines.back() += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
  }
  return lines;
}

// Calls found(position behind the word) for each place at which a line has the word.
template <class Found>
void each(const std::string& line, std::string_view word, Found found) {
  for (std::size_t at = line.find(word); at != std::string::npos; at = line.find(word, at + 1)) found(at + word.size());
}

unsigned count(const std::string& line, std::string_view word) {
  unsigned times = 0;
  each(line, word, [&](std::size_t at) { times += at < line.size() && is_digit(line[at]); });
  return times;
}

bool has(const std::string& line, std::string_view word) { return line.find(word) != std::string::npos; }

// A number that a formula gives stands behind this letter or word.
bool calculated(const std::string& line, std::string_view word) {
  bool any = false;
  each(line, word, [&](std::size_t at) { any |= at >= line.size() || !is_digit(line[at]); });
  return any;
}

uint32_t number_at(const std::string& line, std::size_t at) {
  constexpr int kDecimal = 10;
  return static_cast<uint32_t>(std::strtoul(line.c_str() + at, nullptr, kDecimal));
}

bool has_code_of(nc_dialect dialect, const std::string& line, nc_code_role role) {
  bool any = false;
  each(line, "M", [&](std::size_t at) {
    if (at < line.size() && is_digit(line[at])) any |= nc_code_role_get(dialect, 'M', number_at(line, at)) == role;
    else any |= at < line.size() && (line[at] == '#' || line[at] == '[');
  });
  return any;
}

// A sequence number as the first word of its line, which may be one that is left out.
bool has_number(const std::string& line, const std::string& number) {
  const std::size_t at = line.empty() || line[0] != '/' ? 0 : std::min(line.find('N'), line.size());
  if (at >= line.size() || line[at] != 'N') return false;
  std::size_t digits = at + 1;
  while (digits < line.size() && line[digits] == '0') ++digits;
  std::size_t end = digits;
  while (end < line.size() && is_digit(line[end])) ++end;
  return end > at + 1 && line.compare(digits, end - digits, number) == 0;
}

class Region {
 public:
  Region(std::vector<std::string> lines, uint32_t first, uint32_t last) : lines_(std::move(lines)), first_(first - 1), last_(last - 1) {}

  bool left(nc_dialect dialect) const {
    if (!jumps_back()) return true;
    unsigned begun = 0, ended = 0;
    for (std::size_t at = first_; at <= last_; ++at) {
      const std::string& line = lines_[at];
      if (has_code_of(dialect, line, NC_CODE_PROGRAM_END) || has_code_of(dialect, line, NC_CODE_RETURN) || calculated(line, "P") || jumps_out(line)) return true;
      begun += count(line, "DO");
      ended += count(line, "END");
    }
    return begun != ended;
  }

 private:
  // The last line does so whatever the values are.
  bool jumps_back() const {
    const std::string& last = lines_[last_];
    if (last.empty() || last[0] == '/' || has(last, "IF") || has(last, "WHILE")) return false;
    if (has(last, "GOTO")) return true;
    const std::string& first = lines_[first_];
    return count(last, "END") == 1 && count(first, "DO") == 1 && first[0] != '/' && !has(first, "WHILE") && !has(first, "IF");
  }
  bool jumps_out(const std::string& line) const {
    bool out = false;
    each(line, "GOTO", [&](std::size_t at) {
      if (at < line.size() && line[at] == 'N') ++at;  // families with a letter write GOTO N10
      out = out || at >= line.size() || !is_digit(line[at]) || leads_out(std::to_string(number_at(line, at)));
    });
    return out;
  }
  bool leads_out(const std::string& number) const {
    bool inside = false, outside = false;
    for (std::size_t at = 0; at < lines_.size(); ++at)
      if (has_number(lines_[at], number)) (at >= first_ && at <= last_ ? inside : outside) = true;
    return outside || !inside;
  }

  const std::vector<std::string> lines_;
  const std::size_t first_, last_;  // from 0
};

}  // namespace

bool has_way_out(nc_dialect dialect, std::string_view text, uint32_t first, uint32_t last) {
  std::vector<std::string> lines = lines_of(text);
  if (first < 1 || last < first || last > lines.size()) return true;
  return Region(std::move(lines), first, last).left(dialect);
}

bool may_not_return(nc_dialect dialect, std::string_view text) {
  for (const std::string& line : lines_of(text))
    if (has_code_of(dialect, line, NC_CODE_PROGRAM_END) || (has_code_of(dialect, line, NC_CODE_RETURN) && has(line, "P")) || calculated(line, "P")) return true;
  return false;
}

}  // namespace nc::tools
