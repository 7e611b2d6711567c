// SPDX-License-Identifier: Apache-2.0
// See changed_rows.hpp.
#include "runtime/retain/changed_rows.hpp"

#include <algorithm>
#include <sstream>

namespace nc::rt {
namespace {

constexpr std::string_view kEnd = "end";

}  // namespace

std::string encode_rows_of(std::string_view head, const std::vector<ChangedRow>& rows) {
  std::string text = std::string(head) + "\n";
  for (const ChangedRow& row : rows) text.append(row.key).append("\n").append(row.configured).append("\n").append(row.value).append("\n");
  return text.append(kEnd).append("\n");
}

bool decode_rows_of(std::string_view head, const std::string& bytes, std::vector<ChangedRow>* rows) {
  std::istringstream lines(bytes);
  std::string line;
  if (bytes.empty() || bytes.back() != '\n' || !std::getline(lines, line) || line != head) return false;
  while (std::getline(lines, line)) {
    if (line == kEnd) return !std::getline(lines, line);
    ChangedRow& row = rows->emplace_back();
    row.key = line;
    if (!std::getline(lines, row.configured) || !std::getline(lines, row.value)) return false;
  }
  return false;
}

bool is_of_other_version(std::string_view head, const std::string& bytes) {
  const std::string_view first = std::string_view(bytes).substr(0, bytes.find('\n'));
  const std::size_t kind = head.rfind(' ') + 1;
  if (first == head || first.size() <= kind || first.substr(0, kind) != head.substr(0, kind)) return false;
  return std::all_of(first.begin() + static_cast<std::ptrdiff_t>(kind), first.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace nc::rt
