// SPDX-License-Identifier: Apache-2.0
// Compares the tables of parameters with the sources that ask for parameters.
#include "dialect/parameter_rows.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "nc/control.h"
#include "places/places.hpp"

namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

/// The names of the parameters (in the enumeration) for which sources outside dialect/ ask.
std::set<std::string> asked_for() {
  std::set<std::string> meanings;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(nc::test::kSourceDir) / "libnc/src")) {
    if (entry.path().extension() != ".cpp" || entry.path().string().find("/dialect/") != std::string::npos) continue;
    const std::string text = std::regex_replace(read(entry.path()), std::regex("//[^\n]*"), "");
    if (text.find("Parameter::") == std::string::npos && text.find("using P = Parameter;") == std::string::npos) continue;
    static const std::regex kName("\\b(?:Parameter|P)::([a-z_0-9]+)");
    for (std::sregex_iterator at(text.begin(), text.end(), kName), end; at != end; ++at) meanings.insert((*at)[1]);
  }
  return meanings;
}

/// The names of the enumeration, in its order.
std::vector<std::string> meanings() {
  const std::string text = std::regex_replace(read(std::filesystem::path(nc::test::kSourceDir) / "libnc/src/dialect/parameter.hpp"), std::regex("//[^\n]*"), "");
  const size_t begin = text.find("enum class Parameter"), end = text.find("};", begin);
  std::vector<std::string> names;
  static const std::regex kName("\\b([a-z_0-9]+),");
  const std::string body = text.substr(begin, end - begin);
  for (std::sregex_iterator at(body.begin(), body.end(), kName), last; at != last; ++at) names.push_back((*at)[1]);
  return names;
}

// The control asks for parameters by their meaning; the tables of the families give the number or name.
TEST(ParameterTable, HasWhatIsAskedForAndNothingElse) {
  const std::set<std::string> asked = asked_for();
  const std::vector<std::string> names = meanings();
  ASSERT_EQ(names.size(), nc::kParameters);
  EXPECT_GT(asked.size(), 100u);
  for (unsigned i = 1; i < nc::kParameters; ++i) {
    bool bound = false;
    for (const nc_dialect family : {NC_DIALECT_M700, NC_DIALECT_DGSHAPE, NC_DIALECT_HX}) {
      char key[nc::kParameterKeySize];
      int bit = -1;
      nc::ParameterId id;
      if (!nc::parameter_place(nc::dialect(family), static_cast<nc::Parameter>(i), &id, &bit, 0)) continue;
      nc::put_parameter_key(nc::dialect(family), id, key);
      bound = true;
      const std::string whole = key + (bit < 0 ? "" : "/bit" + std::to_string(bit));
      EXPECT_TRUE(nc_parameter_used(family, whole.c_str())) << names[i] << ' ' << whole;
    }
    EXPECT_TRUE(bound) << names[i] << " is a parameter of no family";
    EXPECT_TRUE(asked.count(names[i]) != 0) << names[i] << " is in the tables, but nothing asks for it";
  }
}

TEST(ParameterTable, HasSoundRows) {
  nc_parameter row;
  unsigned rows = 0;
  for (const nc_dialect family : {NC_DIALECT_M700, NC_DIALECT_HX}) {
    for (unsigned i = 0; nc_parameter_row(family, i, &row) == NC_OK; ++i, ++rows) {
      if (row.key != nullptr) continue;
      EXPECT_LE(row.first, row.last);
      EXPECT_EQ((row.last - row.first) % row.step, 0u) << row.first;
      EXPECT_STRNE(row.name, "");
      EXPECT_STRNE(row.section, "");
    }
  }
  EXPECT_GT(rows, 120u);
}

// If several parameters have the same meaning, each has its own number.
TEST(ParameterTable, GivesEachOfSeveralItsNumber) {
  const auto key = [](nc::ParameterOf parameter) {
    char text[nc::kParameterKeySize] = "";
    int bit = -1;
    return nc::parameter_place(nc::dialect(NC_DIALECT_M700), parameter, text, &bit) ? text + (bit < 0 ? std::string() : "/bit" + std::to_string(bit)) : "none";
  };
  using P = nc::Parameter;
  EXPECT_EQ(key(P::plane_axis), "1026");
  EXPECT_EQ(key({P::parallel_axis, 2}), "1031");
  EXPECT_EQ(key({P::multi_skip_signals, 2}), "1179");
  EXPECT_EQ(key({P::multi_skip_feed, 1}), "1178");
  EXPECT_EQ(key({P::m_call_program, 9}), "7093");
  EXPECT_EQ(key({P::g_call_type, 3}), "7232");
  EXPECT_EQ(key({P::ascii_call_variable, 1}), "7415");
  EXPECT_EQ(key({P::words_call, 3}), "1198");
  EXPECT_EQ(key({P::parity_unit, 4}), "9515");
  EXPECT_EQ(key({P::reading_stop, 7}), "PREREAD_STOP_M8");
  EXPECT_EQ(key(P::precision_lead), "1229/bit1");
  EXPECT_EQ(key(P::calculator), "none");
}

// Each axis may have a number of its own; the first of several may be that of another one than the first.
TEST(ParameterTable, GivesEachAxisItsNumber) {
  const auto key = [](nc::ParameterOf parameter, int axis) {
    nc::ParameterId id;
    int bit = -1;
    return nc::parameter_place(nc::dialect(NC_DIALECT_HX), parameter, &id, &bit, axis) ? id.value : 0u;
  };
  using P = nc::Parameter;
  EXPECT_EQ(key(P::creep, 0), 3061u);
  EXPECT_EQ(key(P::creep, 8), 3069u);
  EXPECT_EQ(key(P::creep, 9), 0u);
  EXPECT_EQ(key(P::creep, -1), 0u);  // none of them is that of all axes
  EXPECT_EQ(key({P::reference_position, 0}, 0), 0u);
  EXPECT_EQ(key({P::reference_position, 1}, 0), 22097u);
  EXPECT_EQ(key({P::reference_position, 2}, 1), 22130u);
  EXPECT_EQ(key({P::reference_position, 3}, 2), 22163u);
  EXPECT_EQ(key({P::g_call_code, 9}, -1), 3094u);
  EXPECT_EQ(key({P::g_call_code, 10}, -1), 0u);
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
    return nc::parse_parameter_key(text, &key) && nc::parameter_takes(nc::dialect(NC_DIALECT_M700), key, value);
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
  for (const char* type : {"7102", "7302", "7312"}) {  // 13.5.2: what stands beside a program is the kind of the call
    EXPECT_TRUE(takes(type, 3)) << type;
    EXPECT_FALSE(takes(type, 4)) << type;
    EXPECT_FALSE(takes(type, 1.5)) << type;
  }
  for (const char* number : {"7103", "7303", "7313"}) EXPECT_TRUE(takes(number, 9000)) << number;
  for (const char* percent : {"8019", "8022", "8023"}) {  // 13.15: of 100 % nothing of the speed would be left
    EXPECT_TRUE(takes(percent, 99)) << percent;
    EXPECT_TRUE(takes(percent, -50)) << percent;
    EXPECT_FALSE(takes(percent, 100)) << percent;
    EXPECT_FALSE(takes(percent, -1001)) << percent;
  }
  EXPECT_TRUE(takes("1229", 5));        // bits
  EXPECT_TRUE(takes("99999", -123.5));  // nothing asks for it
}

// What #1041 sets in inch are the rows whose unit is one of length or speed.
TEST(ParameterTable, KnowsItsLengths) {
  for (const nc::ParameterRow& row : nc::dialect(NC_DIALECT_M700).parameters->numbers) {
    if (row.bit >= 0) continue;
    EXPECT_EQ(nc::is_length(row.what), std::strstr(row.values, "mm") != nullptr) << row.first;
  }
}

TEST(ParameterTable, IsSorted) {
  uint32_t last = 0;
  for (const nc::ParameterRow& row : nc::dialect(NC_DIALECT_M700).parameters->numbers) {
    EXPECT_GE(row.first, last);
    last = row.first;
  }
}

}  // namespace
