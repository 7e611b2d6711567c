// SPDX-License-Identifier: Apache-2.0
// [[joystick]]: analog inputs that jog axes, without a ladder program.
#include "runtime/axes/joystick.hpp"

#include "switch_machine.hpp"

namespace {

using nc::rt::Joystick;
using nc::rt::JoystickConfig;
using nc::rt::Mode;

JoystickConfig stick(std::int32_t low, std::int32_t middle, std::int32_t high) {
  JoystickConfig config;
  config.low = low, config.middle = middle, config.high = high;
  return config;
}

TEST(Joystick, GoesFromTheDeadBandToItsEnds) {
  const JoystickConfig config = stick(0, 500, 1000);
  Joystick joystick;
  EXPECT_EQ(joystick.step(config, 500, true), 0);
  EXPECT_EQ(joystick.step(config, 549, true), 0);
  EXPECT_NEAR(joystick.step(config, 775, true), 0.5, 1e-12);
  EXPECT_EQ(joystick.step(config, 1000, true), 1);
  EXPECT_EQ(joystick.step(config, 1040, true), 1);
  EXPECT_NEAR(joystick.step(config, 225, true), -0.5, 1e-12);
  EXPECT_EQ(joystick.step(config, 0, true), -1);
}

TEST(Joystick, MayHaveItsEndsTheOtherWayRoundAndAMiddleBesideTheMiddle) {
  const JoystickConfig config = stick(30000, 12000, -20000);
  Joystick joystick;
  EXPECT_EQ(joystick.step(config, 12000, true), 0);
  EXPECT_EQ(joystick.step(config, -20000, true), 1);
  EXPECT_EQ(joystick.step(config, 30000, true), -1);
  EXPECT_NEAR(joystick.step(config, 12000 + 9900, true), -0.5, 1e-12);
}

TEST(Joystick, CountsFromWhereItHasBeenAtRest) {
  const JoystickConfig config = stick(0, 500, 1000);
  Joystick joystick;
  EXPECT_EQ(joystick.step(config, 900, true), 0) << "it is out when the control starts";
  EXPECT_EQ(joystick.step(config, 510, true), 0);
  EXPECT_GT(joystick.step(config, 900, true), 0);
  EXPECT_EQ(joystick.step(config, 900, false), 0) << "the grip is let go";
  EXPECT_EQ(joystick.step(config, 900, true), 0) << "and taken again";
  EXPECT_EQ(joystick.step(config, 500, true), 0);
  EXPECT_GT(joystick.step(config, 900, true), 0);
  for (const std::int32_t broken : {1051, -51, 65535, INT32_MIN, INT32_MAX}) {
    EXPECT_EQ(joystick.step(config, broken, true), 0) << broken;
    EXPECT_EQ(joystick.step(config, 900, true), 0) << broken;
    EXPECT_EQ(joystick.step(config, 500, true), 0);
    EXPECT_GT(joystick.step(config, 900, true), 0);
  }
  EXPECT_EQ(joystick.step(stick(INT32_MIN, 0, INT32_MAX), INT32_MAX, true), 1);
}

std::string point(const std::string& name, const char* type) {
  return "[[point]]\nname = \"" + name + "\"\ntype = \"" + type + "\"\ndirection = \"input\"\n";
}
const std::string kPoints = point("stick_x", "word") + point("stick_y", "word") + point("grip", "bit") + point("take_y", "bit");
const std::string kStick = "[[joystick]]\naxis = \"X\"\ninput = \"stick_x\"\nlow = 0\nmiddle = 500\nhigh = 1000\ntop_speed = 40.0\ndead_man = \"grip\"\n";
const std::string kSecond = "[[joystick]]\naxis = \"Y\"\ninput = \"stick_y\"\nlow = -1000\nmiddle = 0\nhigh = 1000\ntop_speed = 20.0\ndead_man = \"grip\"\nchosen_by = \"take_y\"\n";

class JoystickMachine : public nc::test::SwitchMachine {
 protected:
  void by_hand() {
    build(kPoints + kStick + kSecond);
    turn("stick_x", 500);
    ASSERT_EQ(mode(Mode::kManual), nc::rt::Answer::kDone);
    steps(3);
  }
  double speed(unsigned axis = 0) const { return out().velocity.v[axis]; }
  bool stands_soon(unsigned axis = 0) {
    return until([&] { return speed(axis) == 0; }, 1000) >= 0;
  }
  std::string refused() const { return nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); }
};

TEST_F(JoystickMachine, JogsAsFastAsItIsOutWhileTheGripIsHeld) {
  by_hand();
  turn("stick_x", 1000);
  steps(50);
  EXPECT_EQ(counted(0), 0) << "the grip is not held";
  turn("grip", 1);
  steps(50);
  EXPECT_EQ(counted(0), 0) << "the stick was out when it was taken";
  turn("stick_x", 500);
  steps(5);
  hal->all.clear();
  turn("stick_x", 1000);
  ASSERT_GE(until([&] { return std::abs(speed() - 40) < 1e-6; }, 2000), 0) << speed();
  turn("stick_x", 775);
  ASSERT_GE(until([&] { return std::abs(speed() - 20) < 1e-6; }, 2000), 0) << speed();
  for (int n = 0; n < 400; ++n) {  // a hand that trembles
    turn("stick_x", static_cast<std::uint32_t>(700 + (n * 37) % 150));
    steps(1);
  }
  turn("stick_x", 0);
  ASSERT_GE(until([&] { return std::abs(speed() + 40) < 1e-6; }, 2000), 0) << speed();
  turn("grip", 0);
  EXPECT_TRUE(stands_soon());
  const double place = counted(0);
  turn("grip", 1);
  steps(100);
  EXPECT_EQ(counted(0), place);
  double before = 0, speed_before = 0;
  const double cycle = config.nc.cycle_s;
  for (std::size_t n = 0; n < hal->all.size(); ++n) {
    const double now = hal->all[n].position.v[0], velocity = n == 0 ? 0 : (now - before) / cycle;
    const double change = n < 2 ? 0 : std::abs(velocity - speed_before) / cycle;
    ASSERT_LE(change, config.nc.system[0].axis[0].max_acceleration * 1.01) << n;
    before = now, speed_before = velocity;
  }
  EXPECT_EQ(refused(), "");
}

TEST_F(JoystickMachine, ABrokenWireStopsIt) {
  by_hand();
  turn("grip", 1);
  steps(3);
  turn("stick_x", 1000);
  steps(200);
  ASSERT_GT(speed(), 30);
  turn("stick_x", 65535);
  EXPECT_TRUE(stands_soon());
  const double place = counted(0);
  turn("stick_x", 1000);
  steps(100);
  EXPECT_EQ(counted(0), place) << "to the middle first";
}

TEST_F(JoystickMachine, TheAxisIsChosen) {
  by_hand();
  turn("grip", 1);
  steps(3);
  turn("stick_y", 1000);
  steps(50);
  EXPECT_EQ(counted(1), 0);
  turn("take_y", 1);
  steps(50);
  EXPECT_EQ(counted(1), 0) << "it was out";
  turn("stick_y", 0);
  steps(5);
  turn("stick_y", static_cast<std::uint32_t>(-1000));
  ASSERT_GE(until([&] { return std::abs(speed(1) + 20) < 1e-6; }, 2000), 0) << speed(1);
  turn("take_y", 0);
  EXPECT_TRUE(stands_soon(1));
}

// As a button: the same things prevent it, and it has to be let go first.
TEST_F(JoystickMachine, IsRefusedAndStoppedAsAButtonIs) {
  build(kPoints + kStick + kSecond);
  turn("stick_x", 500);
  turn("grip", 1);
  steps(3);
  turn("stick_x", 1000);
  steps(20);
  EXPECT_EQ(counted(0), 0);
  EXPECT_EQ(refused(), "jog X refused: not in this mode");
  ASSERT_EQ(mode(Mode::kManual), nc::rt::Answer::kDone);
  steps(50);
  EXPECT_EQ(counted(0), 0) << "it was out in another mode";
  turn("stick_x", 500);
  steps(3);
  turn("stick_x", 1000);
  steps(200);
  ASSERT_GT(speed(), 30);
  turn("jog_m.Y", 1);  // another axis
  turn("jog_p.X", 1);
  steps(100);
  EXPECT_NEAR(speed(), 40, 1e-6);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kFeedHold), nc::rt::Answer::kDone);
  EXPECT_TRUE(stands_soon());
  const double place = counted(0);
  steps(100);
  EXPECT_EQ(counted(0), place) << "a new press";
}

TEST_F(JoystickMachine, StopsAtTheSoftLimit) {
  build(kPoints + kStick + kSecond, 495);
  turn("stick_x", 500);
  turn("grip", 1);
  ASSERT_EQ(mode(Mode::kManual), nc::rt::Answer::kDone);
  steps(3);
  turn("stick_x", 1000);
  ASSERT_GE(until([&] { return std::abs(counted(0) - 500) < 1e-6; }, 3000), 0) << counted(0);
  steps(100);
  EXPECT_NEAR(counted(0), 500, 1e-6);
}

TEST(JoystickConfigErrors, AreNamedWithTheirKeys) {
  const std::string base = nc::test::base_toml() + kPoints;
  const auto line = static_cast<unsigned>(std::count(base.begin(), base.end(), '\n'));
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kStick;
    return text.replace(text.find(from), from.size(), to);
  };
  const struct {
    std::string added;
    const char *key, *message;
    unsigned line;
  } mistakes[] = {
      {with("axis = \"X\"\n", ""), "joystick[1].axis", "is missing", 1},
      {with("\"X\"", "\"Q\""), "joystick[1].axis", "no axis is named \"Q\"", 2},
      {with("input = \"stick_x\"", "input = \"grip\""), "joystick[1].input", "an input that is a word", 3},
      {with("dead_man = \"grip\"", "dead_man = \"out0\""), "joystick[1].dead_man", "an input that is a bit", 8},
      {with("dead_man = \"grip\"\n", ""), "joystick[1].dead_man", "is missing", 1},
      {with("middle = 500", "middle = 0"), "joystick[1].middle", "between low and high", 5},
      {with("high = 1000\n", ""), "joystick[1].high", "is missing", 1},
      {with("40.0", "400.0"), "joystick[1].top_speed", "more than the axis can do", 7},
      {with("40.0", "0"), "joystick[1].top_speed", "from", 7},
      {kStick + "dead_band = 0\n", "joystick[1].dead_band", "from", 9},
      {kStick + "chosen_by = \"none\"\n", "joystick[1].chosen_by", "no point is named", 9},
      {kStick + kStick, "joystick[2].axis", "has a joystick already", 10},
      {kStick + "speed = 3\n", "joystick[1].speed", "", 9},
  };
  for (const auto& mistake : mistakes) {
    SCOPED_TRACE(mistake.added);
    nc::rt::Config config;
    const auto errors = nc::rt::parse_config(base + mistake.added, "m.toml", &config);
    ASSERT_EQ(errors.size(), 1u) << (errors.empty() ? "" : errors.back().text());
    EXPECT_EQ(errors[0].key, mistake.key);
    EXPECT_NE(errors[0].message.find(mistake.message), std::string::npos) << errors[0].text();
    EXPECT_EQ(errors[0].line, line + mistake.line);
  }
}

}  // namespace
