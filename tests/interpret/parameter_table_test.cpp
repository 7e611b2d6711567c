// SPDX-License-Identifier: Apache-2.0
// The table of parameters against the sources that ask for them.
#include "interpret/parameter_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "nc/control.h"

namespace {

std::string read(const std::string& path) {
  std::ifstream file(std::string(NC_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

/// Keys that these sources have as texts.
std::set<std::string> asked_for() {
  std::set<std::string> keys;
  for (const char* path : {"libnc/src/interpret/parameters.cpp", "libnc/src/control/api_tables.cpp", "runtime/retain/variables.cpp"}) {
    const std::string text = std::regex_replace(read(path), std::regex("//[^\n]*"), "");
    static const std::regex kKey("\"([0-9]{4}(/bit[0-9]+)?)\"");
    for (std::sregex_iterator at(text.begin(), text.end(), kKey), end; at != end; ++at) keys.insert((*at)[1]);
  }
  return keys;
}

TEST(ParameterTable, HasWhatIsAskedFor) {
  const auto keys = asked_for();
  EXPECT_GT(keys.size(), 80u);
  for (const std::string& key : keys) EXPECT_TRUE(nc_parameter_used(NC_DIALECT_M700, key.c_str())) << key;
  for (const char* key : {"1029", "1031", "1175", "1180", "7001", "7093", "7201", "7293", "7102", "7303", "7313", "7401", "7415", "1081", "1198", "UNIT*10",
                          "PREREAD_STOP_M8", "macro_extensions"})
    EXPECT_TRUE(nc_parameter_used(NC_DIALECT_M700, key)) << key;
  EXPECT_TRUE(nc_parameter_used(NC_DIALECT_DGSHAPE, "startup"));
}

TEST(ParameterTable, HasNothingElse) {
  const auto keys = asked_for();
  nc_parameter row;
  unsigned rows = 0;
  for (; nc_parameter_row(NC_DIALECT_M700, rows, &row) == NC_OK; ++rows) {
    if (row.key != nullptr) continue;
    EXPECT_LE(row.first, row.last);
    EXPECT_EQ((row.last - row.first) % row.step, 0u) << row.first;
    EXPECT_STRNE(row.name, "");
    EXPECT_STRNE(row.section, "");
    const bool made_up = (row.first >= 7000 && row.first < 8000) || (row.first >= 1026 && row.first <= 1031) || (row.first >= 1175 && row.first <= 1180) ||
                         (row.first >= 1195 && row.first <= 1198) || row.first == 1081;  // their keys are put together
    if (made_up) continue;
    for (uint32_t number = row.first; number <= row.last; number += row.step) {
      const std::string key = std::to_string(number) + (row.bit < 0 ? "" : "/bit" + std::to_string(row.bit));
      EXPECT_TRUE(keys.count(key) != 0) << key << " is in the table, but nothing asks for it";
    }
  }
  EXPECT_GT(rows, 90u);
}

TEST(ParameterTable, KnowsWhatDoesNothing) {
  for (const char* key : {"99999", "1229/bit7", "7011/bit99", "7004", "", "/bit1", "1229/", "1229/bit", "1229/bit2x", "nothing", "12290000000", "8011"})
    EXPECT_FALSE(nc_parameter_used(NC_DIALECT_M700, key)) << key;
  EXPECT_TRUE(nc_parameter_used(NC_DIALECT_M700, "1229"));        // some bit of it
  EXPECT_TRUE(nc_parameter_used(NC_DIALECT_M700, "1229/bit2"));
  EXPECT_TRUE(nc_parameter_used(NC_DIALECT_M700, "7011"));
  EXPECT_FALSE(nc_parameter_used(NC_DIALECT_DGSHAPE, "1084"));
  EXPECT_FALSE(nc_parameter_used(NC_DIALECT_M700, nullptr));
  EXPECT_FALSE(nc_parameter_used(static_cast<nc_dialect>(77), "1084"));
  EXPECT_EQ(nc_parameter_row(NC_DIALECT_M700, 0, nullptr), NC_E_ARGUMENT);
  nc_parameter row;
  EXPECT_EQ(nc_parameter_row(NC_DIALECT_M700, 100000, &row), NC_E_NOT_FOUND);
}

TEST(ParameterTable, SaysWhatAValueCanBe) {
  const auto takes = [](const char* text, double value) {
    nc::ParameterKey key;
    return nc::parse_parameter_key(text, &key) && nc::parameter_takes(key, value);
  };
  EXPECT_TRUE(takes("1003", 'C'));
  EXPECT_FALSE(takes("1003", 'A'));
  EXPECT_TRUE(takes("1015", 100));
  EXPECT_FALSE(takes("1015", 50));
  EXPECT_TRUE(takes("1109", 1));
  EXPECT_FALSE(takes("1109", 2));
  EXPECT_FALSE(takes("1109", 0.5));
  EXPECT_FALSE(takes("8213", 1.5));
  EXPECT_FALSE(takes("1206", -1));
  EXPECT_TRUE(takes("1229", 5));        // bits
  EXPECT_TRUE(takes("99999", -123.5));  // nothing asks for it
}

TEST(ParameterTable, IsSorted) {
  uint32_t last = 0;
  for (const nc::ParameterRow& row : nc::kParameterTable) {
    EXPECT_GE(row.first, last);
    last = row.first;
  }
}

}  // namespace
