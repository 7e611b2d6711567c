// SPDX-License-Identifier: Apache-2.0
// Where in the machine file a warning belongs, and both lines of what stands there twice.
#include <algorithm>

#include "hal/sim/sim_machine.hpp"
#include "runtime/has_bus.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::ConfigError;

unsigned line_with(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return static_cast<unsigned>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())), '\n')) + 1;
}

// Each warning of this machine that speaks of `about` has the line in which `key` stands.
void expect_warning(const std::string& toml, const std::string& about, const std::string& key) {
  SCOPED_TRACE(about + ", " + key);
  nc::rt::Config config;
  const std::vector<ConfigError> mistakes = nc::rt::parse_config(toml, "m.toml", &config);
  ASSERT_TRUE(mistakes.empty()) << mistakes[0].text();
  nc::rt::VirtualClock clock;
  nc::hal::SimMachine machine(config.sim, config.points);
  std::vector<ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
  const std::string place = "m.toml:" + std::to_string(line_with(toml, key)) + ": ";
  unsigned found = 0;
  for (const std::string& warning : runtime->warnings()) {
    EXPECT_EQ(warning.rfind("m.toml:", 0), 0u) << warning << ": without a line nobody finds it";
    if (warning.find(about) == std::string::npos) continue;
    ++found;
    EXPECT_EQ(warning.rfind(place, 0), 0u) << warning << ", and not " << place;
  }
  EXPECT_GE(found, 1u);
}

const std::string kSupply = "[[point]]\nname = \"supply\"\ndirection = \"input\"\ninitial = 1\n[signals]\n\"plc.power_fail_n\" = \"supply\"\n";

std::string with_supply(const std::string& power = "") {
  std::string text = nc::test::base_toml();
  text.replace(text.find("max_acceleration = 2000.0"), 25, "max_acceleration = 50.0");  // X needs 4 s
  return text + kSupply + power;
}

TEST(ConfigWarnings, OfTheTimeToStopHaveTheLineOfTheTimeOrOfTheInput) {
  expect_warning(with_supply("[power]\ndelay_s = 0.01\nstop_s = 0.5\n"), "axis X needs up to", "stop_s = 0.5");
  expect_warning(with_supply("[power]\ndelay_s = 0.01\n"), "axis X needs up to", "[power]");
  expect_warning(with_supply(), "axis X needs up to", "\"plc.power_fail_n\" = ");
}

TEST(ConfigWarnings, OfParametersHaveTheLineOfTheirParameter) {
  const std::string text = nc::test::base_toml() + "[motion]\nmode = \"trapezoid\"\n[parameters]\n\"1001\" = 1\n\"2007\" = { Y = 400, X = 60 }\n";
  expect_warning(text, "X: #2007 #2008 let cuts go", "\"2007\" = ");
  const std::string by_line = nc::test::base_toml() + "[motion]\nmode = \"trapezoid\"\n[parameters]\n\"1001\" = 1\n[parameters.2007]\nY = 400\nX = 60\n";
  expect_warning(by_line, "X: #2007 #2008 let cuts go", "X = 60");
  expect_warning(by_line, "Z: #2007 #2008 not set", "X = 60");  // of another axis it is: that is what makes the difference
  expect_warning(nc::test::base_toml() + "[motion]\nmode = \"optimal\"\n[parameters]\n\"8011\" = 1\n\"1206\" = 5000\n", "#1206: no effect", "\"1206\" = ");
}

TEST(ConfigWarnings, OfSpindlesThatNothingMeasuresHaveTheLineThatSaysSo) {
  expect_warning(nc::test::base_toml() + "[[spindle]]\nnumber = 1\nfeedback = \"none\"\n", "nothing measures spindle 1", "feedback = \"none\"");
  if (!nc::test::has_bus("modbus")) GTEST_SKIP() << "built without Modbus";
  const std::string link = "[[modbus]]\nname = \"board\"\nhost = \"127.0.0.1\"\nport = 1502\n[[point]]\nname = \"lamp\"\ndirection = \"output\"\nmodbus = { link = \"board\", table = \"coil\", address = 0 }\n";
  expect_warning(nc::test::base_toml() + link, "nothing measures spindle 1", "name = \"board\"");
}

// Both lines: the one that stands lower, with the line of the one above it.
void expect_both(const std::string& toml, const std::string& first, const std::string& second, const std::string& says) {
  SCOPED_TRACE(second);
  nc::rt::Config config;
  const std::vector<ConfigError> errors = nc::rt::parse_config(toml, "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u) << (errors.empty() ? "none" : errors.back().text());
  EXPECT_EQ(errors[0].line, line_with(toml, second)) << errors[0].text();
  EXPECT_NE(errors[0].message.find("first in line " + std::to_string(line_with(toml, first))), std::string::npos) << errors[0].text();
  EXPECT_NE(errors[0].message.find(says), std::string::npos) << errors[0].text();
}

const std::string kWheelPoints =
    "[[point]]\nname = \"wheel\"\ntype = \"word\"\ndirection = \"input\"\n[[point]]\nname = \"wheel2\"\ntype = \"word\"\ndirection = \"input\"\n"
    "[[point]]\nname = \"sel_x\"\ndirection = \"input\"\n[[point]]\nname = \"sel_y\"\ndirection = \"input\"\n";

TEST(ConfigTwice, AHandwheelThatChoosesTwiceNamesBothLines) {
  const std::string base = nc::test::base_toml() + kWheelPoints;
  expect_both(base + "[[handwheel]]\ncounter = \"wheel\"\n[handwheel.axes]\nX = \"sel_x\"\nX1 = \"sel_y\"\n", "X = \"sel_x\"", "X1 = \"sel_y\"", "this axis");
  expect_both(base + "[[handwheel]]\ncounter = \"wheel\"\n[handwheel.axes]\nX = \"sel_x\"\nY = \"sel_x\"\n", "X = \"sel_x\"", "Y = \"sel_x\"", "chooses another axis of this wheel");
  expect_both(base + "[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel_x\" }\n[[handwheel]]\ncounter = \"wheel2\"\n[handwheel.axes]\nX = \"sel_x\"\n", "axes = { X = \"sel_x\" }",
              "X = \"sel_x\"\n", "for handwheel[1]");
}

TEST(ConfigTwice, MacroInputsNameBothLines) {
  const std::string base = nc::test::base_toml();
  const std::size_t end = base.find("[sim]\n");
  ASSERT_NE(end, std::string::npos);
  const auto with = [&](const std::string& more, const std::string& point = "") { return base.substr(0, end) + more + base.substr(end) + point; };
  expect_both(with("\"#1002\" = \"in0\"\n"), "\"#1000\" = \"in0\"", "\"#1002\" = \"in0\"", "mapped twice");
  expect_both(with("\"#01001\" = \"in0b\"\n", "[[point]]\nname = \"in0b\"\ndirection = \"input\"\n"), "\"#1001\" = \"in1\"", "\"#01001\" = \"in0b\"", "is mapped twice");
  expect_both(with("\"#1032\" = \"word_b\"\n", "[[point]]\nname = \"word_b\"\ntype = \"word\"\ndirection = \"input\"\n"), "\"#1000\" = \"in0\"", "\"#1032\" = \"word_b\"", "a word and a bit of the same word");
}

TEST(ConfigTwice, AnAxisUnderTwoNamesIsOneAxis) {
  const std::string base = nc::test::base_toml();
  expect_both(base + "[work_offsets.G54]\nX = 1.0\nX1 = 2.0\n", "X = 1.0", "X1 = 2.0", "G54");
  expect_both(base + "[parameters.2007]\nX = 1.0\nX1 = 2.0\n", "X = 1.0", "X1 = 2.0", "2007");
}

TEST(ConfigTwice, OtherNamesNameBothLines) {
  const std::string base = nc::test::base_toml();
  expect_both(base + "[[point]]\ndirection = \"input\"\nname = \"in0\"\nmeaning = \"again\"\n", "name = \"in0\"", "name = \"in0\"\nmeaning", "already there");
  expect_both(base + "[[spindle]]\nfeedback = \"none\"\n[[spindle]]\nnumber = 1\nfeedback = \"simulated\"\n", "feedback = \"none\"", "feedback = \"simulated\"", "there already");
}

}  // namespace
