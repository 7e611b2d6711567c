// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/codes_of_line.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace nc::tools {
namespace {

/// The code that begins at `at`, behind its letter, times 10; -1 where no number does, or one with more digits than a code has.
int tenths_at(std::string_view line, size_t at) {
  std::string digits;
  for (; at < line.size(); ++at) {
    const char c = line[at];
    if ((c >= '0' && c <= '9') || c == '.') digits += c;
    else if (c != ' ' && c != '\t') break;
  }
  constexpr size_t kLongest = 5;  // "102.5"
  if (digits.size() > kLongest) return -1;
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return -1;
  return static_cast<int>(std::lround(number * 10));
}

}  // namespace

CodeSet codes_of_family(nc_dialect dialect) {
  CodeSet codes;
  nc_function row = NC_INIT(nc_function);
  for (unsigned i = 0; nc_function_row(dialect, i, &row) == NC_OK; ++i) {
    const std::string_view code = row.code;
    const int tenths = code.empty() || code.front() != 'G' ? -1 : tenths_at(code, 1);
    if (tenths >= 0) codes.insert(tenths);
  }
  return codes;
}

CodeSet codes_of_line(std::string_view line) {
  CodeSet codes;
  bool comment = false, letters = false;  // two letters in a row are a keyword (IF, GOTO), not a code
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '(') comment = true;
    if (c == ')') comment = false;
    if (comment) continue;
    if (c == ';') break;
    const bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if ((c == 'G' || c == 'g') && !letters) {
      const int tenths = tenths_at(line, i + 1);
      if (tenths >= 0) codes.insert(tenths);
    }
    letters = letter;
  }
  return codes;
}

}  // namespace nc::tools
