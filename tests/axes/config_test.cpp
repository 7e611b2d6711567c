// SPDX-License-Identifier: Apache-2.0
// What can be wrong with homing, limit_switches, brake and [[sim.axis]]: each error names file, line and key.
#include "axes_machine.hpp"

namespace {

class AxesConfig : public nc::test::AxesMachine {
 protected:
  // Line in which a text stands, from 1.
  static unsigned line_of(const std::string& text, const std::string& what) {
    return static_cast<unsigned>(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(what)), '\n'));
  }
};

TEST_F(AxesConfig, IsReadAsItStands) {
  build();
  const nc::rt::AxisEquipment& x = config.equipment[0][kX];
  EXPECT_EQ(x.homing.kind, nc::rt::HomingKind::kSwitch);
  EXPECT_EQ(x.homing.direction, -1);
  EXPECT_EQ(x.homing.dog.point, config.points.find("x_dog"));
  EXPECT_TRUE(x.homing.dog.closed) << "a broken wire is an event";
  EXPECT_TRUE(x.homing.required);
  EXPECT_EQ(x.homing.travel, 720) << "a fifth more than between the soft limits";
  EXPECT_EQ(x.homing.jog, 40);
  EXPECT_EQ(x.limit[0].point, config.points.find("x_min"));
  EXPECT_EQ(x.limit[1].point, config.points.find("x_max"));
  EXPECT_EQ(config.equipment[0][kY].homing.dog.point, config.points.find("y_max"));
  EXPECT_TRUE(config.equipment[0][kZ].homing.leaves);
  EXPECT_EQ(config.equipment[0][kZ].brake.point, config.points.find("z_brake"));
}

TEST_F(AxesConfig, EachErrorNamesItsPlace) {
  struct Row {
    const char* from;
    const char* to;
    const char* says;  // behind file and line, which is that of `to`
  };
  for (const Row& row : {
           Row{"kind = \"switch\", direction = \"-\"", "direction = \"-\"", "axis[1].homing.kind: is missing"},
           {"kind = \"switch\", direction = \"-\"", "kind = \"dog\", direction = \"-\"",
            "axis[1].homing.kind: must be \"switch\", \"limit\", \"here\", \"absolute\" or \"drive\", not \"dog\""},
           {"direction = \"-\", fast = 40.0", "fast = 40.0", "axis[1].homing.direction: is missing"},
           {"fast = 40.0", "fast = 400.0", "axis[1].homing.fast: must not be above max_velocity (200)"},
           {"creep = 2.0, dog = \"x_dog\"", "creep = 50.0, dog = \"x_dog\"", "axis[1].homing.creep: must not be above fast (40)"},
           {"dog = \"x_dog\"", "dog = \"x_hound\"", "axis[1].homing.dog: no point is named \"x_hound\""},
           {"dog = \"x_dog\"", "dog = \"z_brake\"", "axis[1].homing.dog: point \"z_brake\" must be an input"},
           {"dog = \"x_dog\", offset = 290.0", "offset = 290.0, hound = 1", "axis[1].homing.dog: is missing"},
           {"offset = 290.0, order = 2", "offset = 290.0, order = 2, done = \"x_dog\"", "axis[1].homing.done: is nothing that homing of kind \"switch\" has"},
           {"kind = \"limit\", direction = \"+\"", "kind = \"limit\", edge = \"leave\", direction = \"+\"", "axis[2].homing.edge: is nothing that homing of kind \"limit\" has"},
           {"index = \"z_index\", index_travel = 6.0", "index = \"z_index\"", "axis[3].homing.index_travel: is missing"},
           {"index = \"z_index\", index_travel = 6.0", "index_travel = 6.0", "axis[3].homing.index_travel: is for an index pulse: index"},
           {"offset = 290.0, order = 2", "offset = 290.0, order = 100", "axis[1].homing.order: "},
           {"offset = 290.0, order = 2", "offset = 290.0, jog = 900.0", "axis[1].homing.jog: must not be above max_velocity (200)"},
           {"soft_limits = [-300.0, 300.0]", "soft_limits = [100.0, 300.0]\nstart = 200.0",
            "axis[1].homing.kind: the axis goes to its reference position, and that (0) is not inside soft_limits: reference"},
           {"limit_switches = { minus = \"y_min\", plus = \"y_max\" }", "limit_switches = { minus = \"y_min\" }",
            "axis[2].homing: needs the limit switch in +: limit_switches.plus"},
           {"limit_switches = { minus = \"x_min\", plus = \"x_max\" }", "limit_switches = { contact = \"open\" }", "axis[1].limit_switches: needs minus, plus or both"},
           {"limit_switches = { minus = \"x_min\", plus = \"x_max\" }", "limit_switches = { minus = \"x_min\", plus = \"x_min\" }",
            "axis[1].limit_switches.plus: point \"x_min\" says two things that are not true together: a limit switch of axis X, and a limit switch of axis X"},
           {"brake = { point = \"z_brake\"", "brake = { point = \"z_index\"", "axis[3].brake.point: point \"z_index\" must be an output"},
           {"brake = { point = \"z_brake\", open_s = 0.1", "brake = { open_s = 0.1", "axis[3].brake.point: is missing"},
           {"name = \"z_brake\"\n", "name = \"z_brake\"\ninitial = 1\n", "axis[3].brake.point: point \"z_brake\" must be 0 in the beginning: that closes the brake"},
           {"close_s = 0.2", "close_s = -0.2", "axis[3].brake.close_s: "},
           {"dog = [-310.0, -290.0]", "dog = [-290.0, -310.0]", "sim.axis[1].dog: the first number must not be above the second"},
           {"stands_at = 12.25", "stands_at = 12.25\ndog = [1.0, 2.0]", "sim.axis[2].dog: the axis has no dog on a point of the simulated machine"},
           {"index = [10.0, 5.0]", "index = [0.0, 5.0]", "sim.axis[3].index: the first number, from mark to mark, must be above 0"},
           {"name = \"Z\"\nstands_at", "name = \"W\"\nstands_at", "sim.axis[3].name: there is no axis \"W\""},
       }) {
    SCOPED_TRACE(row.to);
    const std::string text = changed({{row.from, row.to}});
    nc::rt::Config read;
    const auto errors = nc::rt::parse_config(text, "axes.toml", &read);
    bool found = false;
    std::string all;
    for (const nc::rt::ConfigError& error : errors) {
      all += error.text() + "\n";
      found |= error.text().find(row.says) != std::string::npos && error.file == "axes.toml" && error.line > 0;
    }
    EXPECT_TRUE(found) << "wanted: " << row.says << "\n" << all;
  }
}

TEST_F(AxesConfig, TheLineIsThatOfTheKey) {
  const std::string text = changed({{"dog = \"x_dog\"", "dog = \"x_hound\""}});
  nc::rt::Config read;
  const auto errors = nc::rt::parse_config(text, "axes.toml", &read);
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors[0].line, line_of(text, "x_hound"));
  EXPECT_EQ(errors[0].text().substr(0, 10), "axes.toml:");
}

TEST_F(AxesConfig, OneOutputHasOneUse) {
  for (const auto& [to, says] : {std::pair{"[signals]\n\"nc.alarm\" = \"z_brake\"\n", "point \"z_brake\" is set by two: a signal of the control, and the brake of axis Z, first in line "},
                                 std::pair{"[macro_interface]\n\"#1100\" = \"z_brake\"\n[signals]\n", "point \"z_brake\" is set by two: an output of the macro interface, and the brake of axis Z, first in line "}}) {
    nc::rt::Config read;
    const auto errors = nc::rt::parse_config(changed({{"[signals]\n", to}}), "axes.toml", &read);
    ASSERT_EQ(errors.size(), 1u) << says;
    EXPECT_EQ(errors[0].message.find(says), 0u) << errors[0].text();
    EXPECT_NE(errors[0].message.find(" as axis[3].brake.point"), std::string::npos) << errors[0].text();
    EXPECT_NE(errors[0].key, "axis[3].brake.point") << "it stands higher";
  }
}

}  // namespace
