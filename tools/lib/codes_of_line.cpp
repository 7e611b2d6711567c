// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/codes_of_line.hpp"

#include <cmath>

namespace nc::tools {

int code_of(const nc_plain_word& word) {
  constexpr double kMost = 1000;  // a larger number is no code
  return word.kind == NC_NUMBER_CODE && word.value >= 0 && word.value < kMost ? static_cast<int>(std::lround(word.value * 10)) : -1;
}

CodeSet codes_of_line(nc_dialect dialect, std::string_view line) {
  CodeSet codes;
  nc_plain_word words[NC_MAX_WORDS];
  while (!line.empty()) {
    nc_block_text block = NC_INIT(nc_block_text);
    if (nc_block_words(dialect, "", line.data(), line.size(), &block, words) != NC_OK) break;
    for (unsigned i = 0; i < block.count; ++i)
      if (const int code = code_of(words[i]); code >= 0) codes.insert(code);
    line.remove_prefix(block.used);
  }
  return codes;
}

CodeSet codes_of_family(nc_dialect dialect, bool supported) {
  CodeSet codes;
  nc_function row = NC_INIT(nc_function);
  for (unsigned i = 0; nc_function_row(dialect, i, &row) == NC_OK; ++i)
    if (row.supported || !supported) codes.merge(codes_of_line(dialect, row.code));
  return codes;
}

}  // namespace nc::tools
