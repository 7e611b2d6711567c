// SPDX-License-Identifier: Apache-2.0
// Retained devices as bytes: rows of devices with their name and first number, so that a changed ladder program or
// another choice of the retained D takes over the devices that it still has.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nc::rt {

struct RetainedRow {
  std::string name;         // "L", "D": the name in ladder::RetainedRange
  std::uint32_t first = 0;  // number of the first device
  std::vector<std::int16_t> values;  // a bit is 0 or 1
  bool operator==(const RetainedRow&) const = default;
};

std::string encode_rows(const std::vector<RetainedRow>& rows);
// False when the bytes are not such rows; *rows is empty then.
bool decode_rows(const std::string& bytes, std::vector<RetainedRow>* rows);

}  // namespace nc::rt
