// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as the payload of a file of retained devices. They are refused, or they become rows that are
// written as the same bytes again.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "runtime/retain/rows.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  std::vector<nc::rt::RetainedRow> rows;
  if (!nc::rt::decode_rows(bytes, &rows)) {
    if (!rows.empty()) std::abort();
    return 0;
  }
  if (nc::rt::encode_rows(rows) != bytes) std::abort();
  return 0;
}
