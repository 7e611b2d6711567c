// SPDX-License-Identifier: Apache-2.0
// The configuration: what it reads, and that every error names file, line and key.
#include "runtime/config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "test_config.hpp"

namespace {

using nc::rt::Config;
using nc::rt::ConfigError;

// The base, one line changed or added, and what must be said about it.
struct Case {
  const char* name;
  const char* from;  // text of the base that is replaced; nullptr = `to` is appended
  const char* to;
  const char* key;
  const char* message;  // a part of it
};

// gtest prints this, not the bytes of the pointers.
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

unsigned line_of(const std::string& text, std::size_t offset) {
  return 1 + static_cast<unsigned>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

// Where an error about the text at `place` may point: at the text itself, or, for what is missing there, at
// the head of its table; what is wrong with all axes together is said at the first.
unsigned first_line(const std::string& text, std::size_t place, const Case& c) {
  if (std::string(c.key) == "axis") return line_of(text, text.find("[[axis]]"));
  if (std::string(c.message) == "is missing") place = text.rfind("\n[", place) + 1;
  return line_of(text, place);
}

class ConfigErrors : public testing::TestWithParam<Case> {};

TEST_P(ConfigErrors, NameFileLineAndKey) {
  const Case& c = GetParam();
  std::string text = nc::test::base_toml();
  std::size_t place = text.size();
  if (c.from == nullptr) {
    text += c.to;
  } else {
    place = text.find(c.from);
    ASSERT_NE(place, std::string::npos);
    text.replace(place, std::string(c.from).size(), c.to);
  }
  Config config;
  const std::vector<ConfigError> errors = nc::rt::parse_config(text, "m.toml", &config);
  ASSERT_FALSE(errors.empty());
  bool found = false;
  std::string all;
  for (const ConfigError& error : errors) {
    all += error.text() + "\n";
    EXPECT_EQ(error.file, "m.toml");
    EXPECT_GE(error.line, 1u) << error.text();
    found |= error.key == c.key && error.message.find(c.message) != std::string::npos &&
             error.line >= first_line(text, place, c) &&
             error.line <= line_of(text, std::min(text.size(), place + std::string(c.to).size()));
  }
  EXPECT_TRUE(found) << "wanted " << c.key << ": " << c.message << "\n" << all;
}

const Case kCases[] = {
    {"unknown_top", nullptr, "\n[spindel]\nx = 1\n", "spindel", "unknown key"},
    {"unknown_key", "name = \"test\"", "nmae = \"test\"", "machine.nmae", "unknown key"},
    {"wrong_type_string", "name = \"test\"", "name = 5", "machine.name", "must be a string, not an integer"},
    {"wrong_type_number", "max_velocity = 200.0", "max_velocity = \"fast\"", "axis[1].max_velocity",
     "finite number"},
    {"infinite", "max_velocity = 200.0", "max_velocity = inf", "axis[1].max_velocity", "finite number"},
    {"out_of_range", "max_velocity = 150.0", "max_velocity = -1", "axis[2].max_velocity", "must be from"},
    {"cycle", "name = \"test\"", "cycle_us = 3", "machine.cycle_us", "must be from 100"},
    {"cycle_float", "name = \"test\"", "cycle_us = 1000.5", "machine.cycle_us", "an integer"},
    {"look_ahead", "name = \"test\"", "look_ahead = 1000", "machine.look_ahead", "power of two"},
    {"variable_sets", "name = \"test\"", "variable_sets = 250", "machine.variable_sets",
     "100, 200, 300 or 600"},
    {"dialect", "name = \"test\"", "dialect = \"hx\"", "machine.dialect", "\"m700\" or \"dgshape\""},
    {"hal", "name = \"test\"", "hal = \"ethercat\"", "machine.hal", "must be \"sim\""},
    {"duplicate_axis", "name = \"Y\"", "name = \"X\"", "axis[2].name", "already there"},
    {"axis_name", "name = \"Y\"", "name = \"Q\"", "axis[2].name", "one letter of"},
    {"axis_missing_limit", "max_velocity = 150.0", "", "axis[2].max_velocity", "is missing"},
    {"axis_as_table", nullptr, "\n[scheduling]\n[axes]\n", "axes", "unknown key"},
    {"rapid", "max_velocity = 200.0", "max_velocity = 200.0\nrapid = 300.0", "axis[1].rapid",
     "above max_velocity"},
    {"soft_order", "soft_limits = [-300.0, 300.0]", "soft_limits = [3, -3]", "axis[3].soft_limits",
     "below the second"},
    {"soft_count", "soft_limits = [-300.0, 300.0]", "soft_limits = [3]", "axis[3].soft_limits",
     "must have 2 numbers"},
    {"soft_type", "soft_limits = [-300.0, 300.0]", "soft_limits = [3, true]", "axis[3].soft_limits",
     "not a boolean"},
    {"start", "soft_limits = [-300.0, 300.0]", "soft_limits = [-3.0, 3.0]\nstart = 4", "axis[3].start",
     "inside"},
    {"system_gap", "name = \"Z\"", "name = \"Z\"\nsystem = 3", "axis", "part system 2 has no axis"},
    {"point_twice", "name = \"in1\"", "name = \"in0\"", "point[2].name", "already there"},
    {"point_name", "name = \"in1\"", "name = \"in 1\"", "point[2].name", "letters, digits"},
    {"point_direction", "name = \"in1\"\ndirection = \"input\"", "name = \"in1\"", "point[2].direction",
     "is missing"},
    {"point_initial", "name = \"in1\"", "name = \"in1\"\ninitial = 2", "point[2].initial", "from 0 to 1"},
    {"mapped_twice", "\"#1001\" = \"in1\"", "\"#1001\" = \"in0\"", "macro_interface.\"#1001\"",
     "mapped twice"},
    {"output_as_input", "\"#1001\" = \"in1\"", "\"#1101\" = \"in1\"", "macro_interface.\"#1101\"",
     "is an output of"},
    {"input_as_output", "\"#1100\" = \"out0\"", "\"#1200\" = \"out0\"", "macro_interface.\"#1200\"",
     "is an input of"},
    {"bit_as_word", "\"#1001\" = \"in1\"", "\"#1034\" = \"in1\"", "macro_interface.\"#1034\"", "32-bit word"},
    {"word_as_bit", "\"#1033\" = \"word_in\"", "\"#1264\" = \"word_in\"", "macro_interface.\"#1264\"",
     "one bit"},
    {"no_point", "\"#1001\" = \"in1\"", "\"#1001\" = \"in9\"", "macro_interface.\"#1001\"",
     "no point is named"},
    {"not_interface", "\"#1001\" = \"in1\"", "\"#1036\" = \"in1\"", "macro_interface.\"#1036\"",
     "is not a number of"},
    {"not_interface2", "\"#1001\" = \"in1\"", "\"1001\" = \"in1\"", "macro_interface.1001",
     "is not a number of"},
    {"parameter", nullptr, "\n[parameters]\n\"1078\" = []\n", "parameters.1078", "not an array"},
    {"parameter_axis", nullptr, "\n[parameters]\n\"8206\" = { Q = 1 }\n", "parameters.8206.Q", "no axis"},
    {"work_name", nullptr, "\n[work_offsets]\nG53 = { X = 1 }\n", "work_offsets.G53", "must be EXT"},
    {"work_p", nullptr, "\n[work_offsets]\n\"G54.1P97\" = { X = 1 }\n", "work_offsets.\"G54.1P97\"",
     "G54.1P96"},
    {"work_axis", nullptr, "\n[work_offsets]\nG54 = { C = 1 }\n", "work_offsets.G54.C", "no axis"},
    {"work_type", nullptr, "\n[work_offsets]\nG54 = 3\n", "work_offsets.G54", "table by axis"},
    {"tool_number", nullptr, "\n[tool_offsets]\n0 = 3.0\n", "tool_offsets.0", "from 1 to 200"},
    {"tool_column", nullptr, "\n[tool_offsets]\n1 = { lenght = 3.0 }\n", "tool_offsets.1.lenght",
     "unknown key"},
    {"tool_twice", nullptr, "\n[tool_offsets]\n1 = 2.0\n01 = 3.0\n", "tool_offsets.1", "already there"},
    {"overrun", nullptr, "\n[scheduling]\noverrun = \"panic\"\n", "scheduling.overrun",
     "\"count\", \"feed_hold\" or"},
    {"priority", nullptr, "\n[scheduling]\npriority = 99\n", "scheduling.priority", "from 1 to 98"},
    {"solid", nullptr, "\n[[sim.solid]]\nsignal = 9\nX = [1, 2]\n", "sim.solid[1].signal", "from 1 to 8"},
    {"solid_axis", nullptr, "\n[[sim.solid]]\nW = [1, 2]\n", "sim.solid[1].W", "unknown key"},
    {"solid_empty", nullptr, "\n[[sim.solid]]\n", "sim.solid[1]", "at least one axis"},
    {"script", "m_time_s = 0.004", "script = [\n\"when line 1: out0 = 1\"]", "sim.script", "is an output"},
    {"syntax", "name = \"test\"", "name = \"test", "", "syntax"},
    {"duplicate_key", "name = \"test\"", "name = \"test\"\nname = \"again\"", "", "syntax"},
};

INSTANTIATE_TEST_SUITE_P(All, ConfigErrors, testing::ValuesIn(kCases),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Config, AWordAndItsBitsAreOneImage) {
  std::string text = nc::test::base_toml();
  text.replace(text.find("\"#1001\""), 7, "\"#1200\"");  // bit 0 of #1033, which is mapped as a word
  Config config;
  const auto errors = nc::rt::parse_config(text, "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("word and a bit"), std::string::npos) << errors[0].text();
}

TEST(Config, ReportsEveryErrorInTheOrderOfLines) {
  std::string text = nc::test::base_toml();
  for (const auto& [from, to] : {std::pair{"max_velocity = 200.0", "max_velocity = 0"},
                                 {"name = \"Y\"", "nam = \"Y\""},
                                 {"name = \"in1\"", "name = \"\""}})
    text.replace(text.find(from), std::string(from).size(), to);
  Config config;
  config.name = "untouched";
  const auto errors = nc::rt::parse_config(text, "m.toml", &config);
  EXPECT_GE(errors.size(),
            5u);  // range, unknown key, missing name, empty point name, #1001 without its point
  EXPECT_TRUE(std::is_sorted(errors.begin(), errors.end(),
                             [](const ConfigError& a, const ConfigError& b) { return a.line < b.line; }));
  EXPECT_EQ(config.name, "untouched") << "a configuration with errors changes nothing";
}

TEST(Config, EmptyTextNamesWhatIsMissing) {
  Config config;
  std::string all;
  for (const ConfigError& error : nc::rt::parse_config("", "m.toml", &config)) all += error.text() + "\n";
  EXPECT_NE(all.find("machine: is missing"), std::string::npos) << all;
  EXPECT_NE(all.find("axis: is missing"), std::string::npos) << all;
}

TEST(Config, ReadsValues) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + R"(
[scheduling]
overrun = "feed_hold"
[parameters]
"1003" = "B"
"1267/bit0" = 1
"8206" = { X = 5.5 }
[work_offsets]
G54 = { X = -100.0, Z = 2 }
"G54.1P2" = { Y = 7.0 }
EXT = { Z = 1.0 }
[tool_offsets]
1 = 10.0
2 = { length = 1.0, radius_wear = 0.25 }
[[sim.solid]]
X = [1.0, 2.0]
)");
  EXPECT_EQ(config.nc.system[0].axis_count, 3);
  EXPECT_EQ(config.nc.system[0].axis[1].name, 'Y');
  EXPECT_DOUBLE_EQ(config.nc.system[0].axis[1].rapid, 150.0) << "rapid defaults to max_velocity";
  EXPECT_TRUE(config.nc.system[0].axis[2].soft_limited);
  EXPECT_DOUBLE_EQ(config.nc.cycle_s, 0.001);
  EXPECT_EQ(config.scheduling.overrun, nc::rt::OverrunReaction::kFeedHold);
  ASSERT_EQ(config.parameters.size(), 3u);
  ASSERT_EQ(config.work_offsets.size(), 4u);
  ASSERT_EQ(config.tool_offsets.size(), 2u);
  for (const auto& parameter : config.parameters) {
    if (parameter.key == "1003") {
      EXPECT_EQ(parameter.text, "B");
    }
    if (parameter.key == "8206") {
      EXPECT_EQ(parameter.axis, 'X');
    }
  }
  EXPECT_EQ(config.macro.input_bit[0][1], 1);
  EXPECT_EQ(config.macro.input_word[1], 2);
  EXPECT_EQ(config.macro.output_bit[0][0], 3);
  EXPECT_EQ(config.macro.output_bit[0][1], -1);
  ASSERT_EQ(config.sim.solids.size(), 1u);
  EXPECT_DOUBLE_EQ(config.sim.solids[0].max[0], 2.0);
}

TEST(Config, EveryInterfaceNumberHasItsPlace) {
  // M700 13.5.5: the bit of each number, laid out again from the manual's table.
  for (unsigned number = 1000; number < 1400; ++number) {
    int word = -1, bit = -1;
    bool output = false;
    if (number <= 1031) word = 0, bit = static_cast<int>(number - 1000);
    if (number >= 1200 && number <= 1295)
      word = 1 + static_cast<int>(number - 1200) / 32, bit = (static_cast<int>(number) - 1200) % 32;
    if (number >= 1100 && number <= 1131) word = 0, bit = static_cast<int>(number - 1100), output = true;
    if (number >= 1300 && number <= 1395)
      word = 1 + static_cast<int>(number - 1300) / 32, bit = (static_cast<int>(number) - 1300) % 32,
      output = true;
    const bool whole = (number >= 1032 && number <= 1035) || (number >= 1132 && number <= 1135);
    if (whole) {
      output = number >= 1132;
      word = static_cast<int>(number - (output ? 1132 : 1032));
    }
    const std::string text =
        "[machine]\n[[axis]]\nname=\"X\"\nmax_velocity=1\nmax_acceleration=1\n[[point]]\nname=\"p\"\ntype="
        "\"" +
        std::string(whole ? "word" : "bit") + "\"\ndirection=\"" + (output ? "output" : "input") +
        "\"\n[macro_interface]\n\"#" + std::to_string(number) + "\"=\"p\"\n";
    Config config;
    const auto errors = nc::rt::parse_config(text, "m.toml", &config);
    if (word < 0) {
      EXPECT_FALSE(errors.empty()) << number;
      continue;
    }
    ASSERT_TRUE(errors.empty()) << number << ": " << errors[0].text();
    const auto& map = config.macro;
    const int point = whole
                          ? (output ? map.output_word : map.input_word)[static_cast<unsigned>(word)]
                          : (output ? map.output_bit
                                    : map.input_bit)[static_cast<unsigned>(word)][static_cast<unsigned>(bit)];
    EXPECT_EQ(point, 0) << number;
  }
}

TEST(Config, MissingFileIsAnError) {
  Config config;
  const auto errors = nc::rt::load_config("/nonexistent/machine.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].text().find("/nonexistent/machine.toml: cannot be read"), std::string::npos);
  EXPECT_EQ(nc::rt::load_config("/", &config).size(), 1u) << "a folder is not a file";
}

TEST(Config, ProgramsFolderIsRelativeToTheFile) {
  Config config;
  config.file = "/opt/etc/machine.toml";
  config.programs = "../parts";
  EXPECT_EQ(config.programs_folder(), "/opt/parts");
  config.programs = "/srv/nc";
  EXPECT_EQ(config.programs_folder(), "/srv/nc");
}

TEST(Config, ShippedFilesAreValid) {
  unsigned files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(NC_SOURCE_DIR) + "/etc")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    Config config;
    for (const ConfigError& error : nc::rt::load_config(entry.path().string(), &config))
      ADD_FAILURE() << error.text();
  }
  EXPECT_GE(files, 2u);
}

}  // namespace
