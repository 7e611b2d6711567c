// SPDX-License-Identifier: Apache-2.0
// See trace_csv.hpp.
#include "tools/lib/trace_csv.hpp"

#include <cstdint>
#include <cstdio>

namespace nc::tools {
namespace {

using Json = nlohmann::json;

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string trace_csv_head(const Json& status) {
  std::string text = "scan,time_s";
  for (const Json& name : status.value("signals", Json::array()))
    if (name.is_string()) text += "," + cell(name.get<std::string>());
  return text + "\n";
}

std::string trace_csv_rows(const Json& page) {
  std::string text;
  for (const Json& row : page.value("rows", Json::array())) {
    char begin[64];
    std::snprintf(begin, sizeof begin, "%llu,%.9f", static_cast<unsigned long long>(row.value("scan", std::uint64_t{0})), row.value("time_s", 0.0));
    text += begin;
    for (const Json& value : row.value("values", Json::array())) text += "," + value.dump();
    text += "\n";
  }
  return text;
}

}  // namespace nc::tools
