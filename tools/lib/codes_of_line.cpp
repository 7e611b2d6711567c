// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/codes_of_line.hpp"

#include <cmath>

#include "tools/lib/line_words.hpp"

namespace nc::tools {

CodeSet codes_of_line(std::string_view line) {
  constexpr size_t kLongest = 5;  // "102.5"; a longer number is no code
  CodeSet codes;
  LineWords words;
  words.read(line);
  for (const PlainWord& word : words.words()) {
    if (word.letter != 'G' || word.comma || words.number(word).size() > kLongest) continue;
    const double number = words.value(word);
    if (number >= 0) codes.insert(static_cast<int>(std::lround(number * 10)));
  }
  return codes;
}

CodeSet codes_of_family(nc_dialect dialect) {
  CodeSet codes;
  nc_function row = NC_INIT(nc_function);
  for (unsigned i = 0; nc_function_row(dialect, i, &row) == NC_OK; ++i) codes.merge(codes_of_line(row.code));
  return codes;
}

}  // namespace nc::tools
