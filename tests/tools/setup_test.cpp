// SPDX-License-Identifier: Apache-2.0
// Setup files: what is accepted, and that every mistake is reported with its key and its line.
#include "tools/lib/setup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tools/lib/machine_limits.hpp"

namespace nc::tools {
namespace {

std::string error_of(const std::string& text) {
  tools::Setup setup;
  std::string error;
  return parse_setup(text, "s.json", &setup, &error) ? "" : error;
}

tools::Setup good(const std::string& text) {
  tools::Setup setup;
  std::string error;
  EXPECT_TRUE(parse_setup(text, "s.json", &setup, &error)) << error;
  return setup;
}

TEST(Setup, EmptyObjectIsTheDefault) {
  const tools::Setup s = good("{}");
  ASSERT_EQ(s.axes.size(), 3u);
  EXPECT_EQ(s.axes[2].name, 'Z');
  EXPECT_EQ(s.clock_ms, 1767225600000);  // 2026-01-01T00:00:00
  EXPECT_EQ(s.option_variable_sets, 600u);
  EXPECT_EQ(s.option_tool_offsets, 200u);
  EXPECT_EQ(s.option_work_offsets, 96u);
}

TEST(Setup, EveryPartIsRead) {
  const tools::Setup s = good(R"({
    "axes": ["X", "Y", "Z", {"name": "C", "rotary": true}],
    "params": {"1003": "B", "1267/bit0": 1, "8206": {"X": 5.0, "C": -2}, "UNIT*10": 10},
    "kinematics": {"type": "combined", "tool": ["C"], "table": ["C"], "center": {"X": 30, "Z": -50}, "sense": "iso",
                   "program_frame": "work", "interpolation": "single_axis"},
    "start": {"Z": 5},
    "work_offsets": {"EXT": {"X": 1}, "G54": {"X": -100.5}, "G59": {}, "G54.1P48": {"C": 2}},
    "offsets": {"1": 10.0, "2": {"length": 1, "radius_wear": 0.25}},
    "vars": {"100": 1.5, "500": null},
    "inputs": {"1001": 1, "1032": 4, "1203": 1, "1295": 1},
    "skip": [{"signal": 2, "box": {"X": [0, 100], "Z": [-30, 0]}}],
    "switches": {"optional_skip": [1, 9], "optional_stop": true, "mirror": ["X", "Z"]},
    "subprograms": {"1000": "O1000\nM99\n%", "PART.NC": "M99", "0100": "M99"},
    "events": [{"when": {"line": 5}, "inputs": {"1000": 1}, "signals": {"reset": 1}}, {"when": {"seconds": 1.5}}],
    "options": {"variable_sets": 100, "tool_offsets": 20, "work_offsets": 300, "macro_extensions": false},
    "clock": "2024-02-29T23:59:58"
  })");
  ASSERT_EQ(s.axes.size(), 4u);
  EXPECT_TRUE(s.axes[3].rotary);
  ASSERT_EQ(s.parameters.size(), 5u);
  EXPECT_EQ(s.parameters[0].text, "B");
  EXPECT_EQ(s.parameters[1].text, "1");
  EXPECT_EQ(s.parameters[2].axis, 'X');
  EXPECT_EQ(s.parameters[3].text, "-2");
  EXPECT_EQ(s.kinematics->center[2], -50.0);
  EXPECT_EQ(s.start.v[2], 5.0);
  ASSERT_EQ(s.work_offsets.size(), 4u);
  EXPECT_EQ(s.work_offsets[0].index, 0u);
  EXPECT_EQ(s.work_offsets[1].index, 1u);
  EXPECT_EQ(s.work_offsets[1].values[0].value, -100.5);
  EXPECT_EQ(s.work_offsets[2].index, 6u);
  EXPECT_EQ(s.work_offsets[3].index, 148u);
  EXPECT_TRUE(s.tool_offsets[0].plain);
  EXPECT_EQ(s.tool_offsets[1].column[NC_TOOL_RADIUS_WEAR], 0.25);
  EXPECT_TRUE(s.variables[1].vacant);
  EXPECT_EQ(s.inputs.bits[0], 6u);  // a bit that is named beside its word wins
  EXPECT_EQ(s.inputs.bits[1], 8u);
  EXPECT_EQ(s.inputs.bits[3], 0x80000000u);
  EXPECT_EQ(s.skip[0].signal, 2u);
  EXPECT_FALSE(s.skip[0].bounded[1]);
  EXPECT_EQ(s.optional_skip, (1u << 1) | (1u << 9));
  EXPECT_EQ(s.mirror_axes, 5u);
  EXPECT_EQ(s.subprograms[0].first, "O1000");
  EXPECT_EQ(s.subprograms[1].first, "PART.NC");
  EXPECT_EQ(s.subprograms[2].first, "0100");  // M700 13.3.1 (7): a file, which P100 does not find
  EXPECT_EQ(*s.events[0].line, 5u);
  EXPECT_EQ(*s.events[1].seconds, 1.5);
  EXPECT_EQ(s.clock_ms, 1709251198000);
}

TEST(Setup, AxesMayStandBehindWhatNamesThem) {
  const tools::Setup s = good(R"({"start": {"A": 3}, "axes": ["A"]})");
  EXPECT_EQ(s.start.v[0], 3.0);
}

struct Mistake {
  const char* text;
  const char* error;
};

TEST(Setup, MistakesAreNamedWithKeyAndLine) {
  const Mistake mistakes[] = {
      {"{\n \"axis\": []}", "s.json:2: axis: no such key"},
      {"[]", "s.json:1: a setup must be an object, is a list"},
      {"", "s.json:1: "},
      {"{\"vars\": {\"100\": 1,\n\n\"101\": }}", "s.json:3: "},
      {"{\"vars\":{\"1\":1,\n\"1\":2}}", "s.json:2: the key \"1\" stands here twice"},
      {"{\"axes\": []}", "axes: a part system has 1 to 8 axes"},
      {"{\"axes\": [\"X\", \"X\"]}", "axes[1]: the axis X stands here twice"},
      {"{\"axes\": [\"Q\"]}", "axes[0]: an axis is one of"},
      {"{\"axes\": [{\"name\": \"X\",\n\"rotary\": 1}]}",
       "s.json:2: axes[0].rotary: must be true or false, is a number"},
      {"{\"axes\": [{\"rotary\": true}]}", "axes[0]: the key name is missing"},
      {"{\"axes\": [{\"name\": \"X\", \"rotory\": true}]}", "axes[0].rotory: no such key"},
      {"{\"axes\": 3}", "axes: must be a list, is a number"},
      {"{\"params\": {\"1078\": true}}", "params.1078: must be a number, a string or an object by axis"},
      {"{\"params\": {\"8206\": {\"W\": 1}}}", "params.8206.W: the setup has no axis \"W\""},
      {"{\"start\": {\"X\": \"1\"}}", "start.X: must be a number, is a string"},
      {"{\"work_offsets\": {\"G53\": {}}}", "work_offsets.G53: no such key"},
      {"{\"work_offsets\": {\"G54.1P0\": {}}}", "work_offsets.G54.1P0: no such key"},
      {"{\"work_offsets\": {\"G54\": 1}}", "work_offsets.G54: must be an object, is a number"},
      {"{\"offsets\": {\"0\": 1}}", "offsets.0: no such key"},
      {"{\"offsets\": {\"1\": {\"diameter\": 1}}}", "offsets.1.diameter: no such key"},
      {"{\"offsets\": {\"1\": null}}", "offsets.1: must be a number or an object"},
      {"{\"vars\": {\"#100\": 1}}", "vars.#100: no such key"},
      {"{\"vars\": {\"100\": \"1\"}}", "vars.100: must be a number or null"},
      {"{\"inputs\": {\"1036\": 1}}", "inputs.1036: no such key"},
      {"{\"inputs\": {\"1000\": 2}}", "inputs.1000: must be a whole number from 0 to 1"},
      {"{\"skip\": [{\"signal\": 1}]}", "skip[0]: the key box is missing"},
      {"{\"skip\": [{\"box\": {}}]}", "skip[0].box: a box without a side"},
      {"{\"skip\": [{\"box\": {\"X\": [1]}}]}", "skip[0].box.X: must be [low, high]"},
      {"{\"skip\": [{\"box\": {\"X\": [2, 1]}}]}", "skip[0].box.X: low must be less than high"},
      {"{\"skip\": [{\"signal\": 9, \"box\": {\"X\": [1, 2]}}]}",
       "skip[0].signal: must be a whole number from 1 to 8"},
      {"{\"skip\": [{\"ball\": {\"radius\": 1}}]}", "skip[0]: the key box, cylinder, sphere or plane is missing"},
      {"{\"skip\": [{\"ball\": {\"radius\": 0}, \"sphere\": {\"center\": {}, \"radius\": 1}}]}", "skip[0].ball.radius: must be more than 0"},
      {"{\"skip\": [{\"sphere\": {\"center\": {}, \"radius\": 1}, \"box\": {\"X\": [0, 1]}}]}", "skip[0].sphere: stands beside box"},
      {"{\"skip\": [{\"sphere\": {\"radius\": 1}}]}", "skip[0].sphere: the key center is missing"},
      {"{\"skip\": [{\"sphere\": {\"center\": {\"C\": 1}, \"radius\": 1}}]}", "skip[0].sphere.center.C: no such key: a shape has X, Y and Z"},
      {"{\"skip\": [{\"cylinder\": {\"axis\": \"A\", \"center\": {}, \"radius\": 1}}]}", "skip[0].cylinder.axis: must be one of X, Y, Z"},
      {"{\"skip\": [{\"plane\": {\"point\": {}, \"normal\": {}}}]}", "skip[0].plane.normal: is the direction out of the solid"},
      {"{\"skip\": [{\"box\": {\"X\": [0, 1]}, \"turns_with\": [{\"axis\": \"X\", \"about\": \"Z\"}]}]}",
       "skip[0].turns_with[0].axis: must be a rotary axis"},
      {"{\"skip\": [{\"box\": {\"X\": [0, 1]}, \"coordinates\": \"part\"}]}", "skip[0].coordinates: must be one of machine, work"},
      {"{\"hits\": [{}]}", "hits[0]: the key at is missing"},
      {"{\"hits\": [{\"at\": {}}]}", "hits[0].at: names no axis"},
      {"{\"hits\": [{\"at\": {\"Q\": 1}}]}", "hits[0].at.Q: the setup has no axis"},
      {"{\"hits\": [{\"at\": {\"X\": 1}, \"when\": {\"program\": 9000}}]}", "hits[0].when: the key line is missing beside program"},
      {"{\"events\": [{\"when\": {\"m\": 1.5}}]}", "events[0].when.m: must be a whole number"},
      {"{\"events\": [{\"when\": {\"m\": 6, \"line\": 2}}]}", "events[0].when: must have one of"},
      {"{\"events\": [{\"when\": {\"program\": 6}}]}", "events[0].when: must have one of"},
      {"{\"events\": [{\"when\": {\"line\": 6}, \"signals\": {\"skip9\": 1}}]}", "events[0].signals.skip9: no such key"},
      {"{\"switches\": {\"optional_skip\": [0]}}",
       "switches.optional_skip[0]: must be a whole number from 1 to 9"},
      {"{\"switches\": {\"mirror\": [\"U\"]}}", "switches.mirror[0]: the setup has no axis"},
      {"{\"switches\": {\"optional_stop\": 1}}", "switches.optional_stop: must be true or false"},
      {"{\"switches\": {\"door\": true}}", "switches.door: no such key"},
      {"{\"subprograms\": {\"1000\": 5}}", "subprograms.1000: must be a string"},
      {"{\"events\": [{}]}", "events[0]: the key when is missing"},
      {"{\"events\": [{\"when\": {}}]}", "events[0].when: must have one of line and seconds"},
      {"{\"events\": [{\"when\": {\"line\": 1, \"seconds\": 1}}]}", "events[0].when: must have one of"},
      {"{\"events\": [{\"when\": {\"line\": 1.5}}]}", "events[0].when.line: must be a whole number"},
      {"{\"events\": [{\"when\": {\"seconds\": -1}}]}", "events[0].when.seconds: must not be negative"},
      {"{\"events\": [{\"when\": {\"line\": 1}, \"signals\": {\"start\": 1}}]}",
       "events[0].signals.start: no such key"},
      {"{\"options\": {\"variable_sets\": 150}}", "options.variable_sets: must be 100, 200, 300 or 600"},
      {"{\"options\": {\"tool_offsets\": 0}}", "options.tool_offsets: must be a whole number from 1 to 999"},
      {"{\"options\": {\"mcaro\": 0}}", "options.mcaro: no such key"},
      {"{\"options\": {\"negative_count\": 1}}", "options.negative_count: must be true or false"},
      {"{\"options\": {\"variable_ranges\": [[400, 499]]}}", "options.variable_ranges[0]: must be an object"},
      {"{\"options\": {\"variable_ranges\": [{\"first\": 400}]}}", "options.variable_ranges[0]: the key last is missing"},
      {"{\"options\": {\"variable_ranges\": [{\"first\": 400, \"last\": 500}]}}", "options.variable_ranges[0]: #500 is another variable already"},
      {"{\"options\": {\"variable_ranges\": [{\"first\": 400, \"last\": 399}]}}", "options.variable_ranges[0]: last must be from first on"},
      {"{\"options\": {\"variable_ranges\": [{\"first\": 20, \"last\": 40}]}}", "options.variable_ranges[0].first: must be a whole number from 34"},
      {"{\"options\": {\"variable_ranges\": [{\"first\": 400, \"last\": 449}, {\"first\": 449, \"last\": 460}]}}",
       "options.variable_ranges[1]: #449 is another variable already"},
      {"{\"clock\": \"2026-02-29T00:00:00\"}", "clock: must be a date and time"},
      {"{\"clock\": \"2026-01-01T00:00:00Z\"}", "clock: must be a date and time"},
      {"{\"kinematics\": {}}", "kinematics: the key type is missing"},
      {"{\"kinematics\": {\"type\": \"delta\"}}",
       "kinematics.type: must be one of tool_tilt, table_tilt, combined"},
      {"{\"kinematics\": {\"type\": \"tool_tilt\"}}", "kinematics: the key tool is missing"},
      {"{\"kinematics\": {\"type\": \"tool_tilt\", \"tool\": [\"C\"]}}",
       "kinematics.tool[0]: the setup has no axis \"C\""},
      {"{\"vars\": {\"100\": 1e999}}", "s.json:1: "},
      {"{\"clock\": \"\xff\"}", "s.json:1: "},
      {"{\"a\\nb\": 1}", "s.json:1: a key has a control character"},
      {"{\"params\": {\"1\": \"\\u0000\"}}", "params.1: has a control character"},
  };
  for (const Mistake& m : mistakes) {
    const std::string error = error_of(m.text);
    EXPECT_NE(error.find(m.error), std::string::npos) << m.text << "\n gave: " << error;
    EXPECT_EQ(error.rfind("s.json:", 0), 0u) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << "one line only: " << error;
  }
}

// The options for common variables: further ranges of them, the number of sets, and negative_count.
TEST(Setup, VariableRanges) {
  const tools::Setup s = good(R"({"options": {"variable_ranges": [{"first": 400, "last": 499}, {"first": 700, "last": 799, "kept": false}],
                                  "variable_sets": 300, "negative_count": true}})");
  EXPECT_EQ(s.option_variable_ranges[0].first, 400u);
  EXPECT_EQ(s.option_variable_ranges[1].last, 799u);
  EXPECT_EQ(s.option_variable_ranges[2].last, 0u);
  EXPECT_TRUE(s.option_negative_count);
  nc_config config;
  nc_config_init(&config);
  apply_setup(s, &config);
  EXPECT_EQ(config.variable_ranges[1].first, 700u);
  EXPECT_NE(nc_memory_required(&config), 0u);
}

TEST(Setup, DeepNestingIsAnErrorNotACrash) {
  EXPECT_NE(error_of("{\"axes\":" + std::string(100'000, '[')).find("nested too deep"), std::string::npos);
}

TEST(Setup, MissingFileAndFolder) {
  tools::Setup setup;
  std::string error;
  EXPECT_FALSE(load_setup("/nonexistent/setup.json", &setup, &error));
  EXPECT_EQ(error, "/nonexistent/setup.json: cannot be opened");
  EXPECT_FALSE(load_setup("/", &setup, &error));
}

TEST(Clock, LeapYearsAndEpoch) {
  EXPECT_EQ(parse_clock("1970-01-01T00:00:00"), 0);
  EXPECT_EQ(parse_clock("2000-03-01T00:00:00"), 951868800000);
  EXPECT_EQ(parse_clock("2100-02-29T00:00:00"), std::nullopt);
  EXPECT_EQ(parse_clock("2026-13-01T00:00:00"), std::nullopt);
  EXPECT_EQ(parse_clock("2026-12-31T24:00:00"), std::nullopt);
}

TEST(MachineLimits, ReplaceTheDefaultsOfTheAxesNamed) {
  nc_config config;
  nc_config_init(&config);
  default_machine_limits(&config);
  std::string error;
  ASSERT_TRUE(parse_machine_limits(
      R"({"cycle_s": 0.002, "axes": {"Y": {"velocity": 100, "jerk": 9000, "stroke": [-1, 2]}}})", "m.json",
      &config, &error))
      << error;
  EXPECT_EQ(config.cycle_s, 0.002);
  EXPECT_EQ(config.system[0].axis[0].max_velocity, 250.0);
  EXPECT_EQ(config.system[0].axis[1].max_velocity, 100.0);
  EXPECT_EQ(config.system[0].axis[1].rapid, 100.0);
  EXPECT_TRUE(config.system[0].axis[1].soft_limited);
  EXPECT_FALSE(parse_machine_limits(R"({"axes": {"Q": {}}})", "m.json", &config, &error));
  EXPECT_EQ(error, "m.json:1: axes.Q: the setup has no such axis");
  EXPECT_FALSE(parse_machine_limits(R"({"axes": {"X": {"jerk": 0}}})", "m.json", &config, &error));
  EXPECT_EQ(error, "m.json:1: axes.X.jerk: must be from 0.001 to 1e+09, is 0");
}

// A rate near 0 would make a run endless, and a cycle of 0 would make no progress.
TEST(MachineLimits, EveryValueHasARangeAndIsNamed) {
  nc_config config;
  nc_config_init(&config);
  for (const std::string key : {"velocity", "rapid", "acceleration", "jerk", "in_position"})
    for (const std::string value : {"0", "-1", "1e-300", "1e300", "null", "\"1\""}) {
      std::string error;
      EXPECT_FALSE(parse_machine_limits("{\"axes\": {\n\"X\": {\"" + key + "\": " + value + "}}}", "m.json",
                                        &config, &error));
      EXPECT_EQ(error.rfind("m.json:2: axes.X." + key + ": must be ", 0), 0u) << error;
      const bool number = value != "null" && value != "\"1\"";
      if (number) {
        EXPECT_NE(error.find(", is " + (value == "1e300" ? "1e+300" : value)), std::string::npos) << error;
      }
    }
  for (const std::string value : {"0", "-0.001", "1e-300", "0.2"}) {
    std::string error;
    EXPECT_FALSE(parse_machine_limits("{\"cycle_s\": " + value + "}", "m.json", &config, &error));
    EXPECT_EQ(error, "m.json:1: cycle_s: must be from 1e-05 to 0.1, is " + value);
  }
  std::string error;
  EXPECT_FALSE(parse_machine_limits("{\"cycle_s\": NaN}", "m.json", &config, &error));
  EXPECT_NE(error.find("m.json:1: "), std::string::npos);
  EXPECT_FALSE(
      parse_machine_limits("{\"axes\": {\"X\":\n{\"acceleration\": 1e400}}}", "m.json", &config, &error));
  EXPECT_EQ(error, "m.json:2: acceleration: the number '1e400' is too large");
}

TEST(SetupText, AWorkOffsetThatTheControlHasNotIsRefusedEvenWithoutAValue) {
  nc::tools::Setup setup;
  std::string error;
  for (const std::string value : {"{}", "{\"X\": 1}"}) {
    EXPECT_FALSE(
        parse_setup("{\"work_offsets\":\n{\"G54.1P999\": " + value + "}}", "s.json", &setup, &error));
    EXPECT_EQ(error,
              "s.json:2: work_offsets.G54.1P999: the control has G54.1P1 to G54.1P96 (options.work_offsets)");
  }
  EXPECT_FALSE(parse_setup(R"({"options": {"work_offsets": 0}, "work_offsets": {"G54.1P1": {}}})", "s.json",
                           &setup, &error));
  EXPECT_NE(error.find("no extended work offsets"), std::string::npos) << error;
  EXPECT_TRUE(parse_setup(R"({"work_offsets": {"G54.1P120": {"X": 1}, "G59": {}, "EXT": {}},
                              "options": {"work_offsets": 120}})",
                          "s.json", &setup, &error))
      << error;
  EXPECT_FALSE(parse_setup("{\"start\": {\"X\": 1e400}}", "s.json", &setup, &error));
  EXPECT_EQ(error, "s.json:1: X: the number '1e400' is too large");
}

}  // namespace
}  // namespace nc::tools
