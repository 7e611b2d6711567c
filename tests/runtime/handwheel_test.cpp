// SPDX-License-Identifier: Apache-2.0
// [[handwheel]]: wheels that turn axes by their counters, without a ladder program.
#include "runtime/axes/handwheel.hpp"

#include "switch_machine.hpp"

namespace {

using nc::rt::Handwheel;
using nc::rt::Mode;

std::string point(const std::string& name, bool word = false) {
  return "[[point]]\nname = \"" + name + "\"\ntype = \"" + (word ? "word" : "bit") + "\"\ndirection = \"input\"\n";
}
const std::string kPoints = point("wheel", true) + point("wheel2", true) + point("sel_x") + point("sel_y") + point("sel2_x") + point("ten") + point("hundred");
const std::string kWheel = "[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel_x\", Y = \"sel_y\" }\ntimes_10 = \"ten\"\ntimes_100 = \"hundred\"\n";

TEST(Handwheel, TheFirstCountIsNoWayAndNeitherIsTheOneBehindALoss) {
  Handwheel wheel;
  EXPECT_EQ(wheel.step(500, true, 32, 1, 0), 0);
  EXPECT_EQ(wheel.step(503, true, 32, 1, 0), 3);
  EXPECT_EQ(wheel.step(510, false, 32, 1, 0), 0);
  EXPECT_EQ(wheel.step(600, true, 32, 1, 0), 0);
  EXPECT_EQ(wheel.step(599, true, 32, 1, 0), -1);
}

TEST(Handwheel, TheCounterWraps) {
  for (const unsigned bits : {16u, 32u}) {
    Handwheel wheel;
    const std::uint32_t most = bits == 32 ? 0xffffffffu : 0xffffu;
    (void)wheel.step(most - 1, true, bits, 1, 0);
    EXPECT_EQ(wheel.step(2, true, bits, 1, 0), 4) << bits;
    EXPECT_EQ(wheel.step(most, true, bits, 1, 0), -3) << bits;
  }
}

TEST(Handwheel, CountsOfADivisionThatIsNotCompleteAreKeptForTheAxis) {
  Handwheel wheel;
  (void)wheel.step(0, true, 32, 4, 0);
  EXPECT_EQ(wheel.step(3, true, 32, 4, 0), 0);
  EXPECT_EQ(wheel.step(4, true, 32, 4, 0), 1);
  EXPECT_EQ(wheel.step(7, true, 32, 4, 0), 0);
  EXPECT_EQ(wheel.step(8, true, 32, 4, 1), 0) << "of another axis only its own counts";
  EXPECT_EQ(wheel.step(11, true, 32, 4, 1), 1);
  EXPECT_EQ(wheel.step(50, true, 32, 4, -1), 0);
  EXPECT_EQ(wheel.step(51, true, 32, 4, 0), 0);
}

// The counter of an I/O module that has begun anew says nothing of a hand.
TEST(Handwheel, AJumpIsNoWay) {
  Handwheel wheel;
  (void)wheel.step(40'000, true, 16, 4, 0);
  EXPECT_EQ(wheel.step(0, true, 16, 4, 0), 0);
  EXPECT_TRUE(wheel.jumped());
  EXPECT_EQ(wheel.step(800, true, 16, 4, 0), 200) << "as far as a hand goes";
  EXPECT_FALSE(wheel.jumped());
  EXPECT_EQ(wheel.step(1604, true, 16, 4, 0), 0);
  EXPECT_EQ(wheel.step(1600, true, 16, 4, 0), -1);
  Handwheel whole;
  (void)whole.step(0, true, 32, 1, 0);
  EXPECT_EQ(whole.step(0x80000000u, true, 32, 1, 0), 0);
  EXPECT_TRUE(whole.jumped());
}

class HandwheelMachine : public nc::test::SwitchMachine {
 protected:
  void by_hand(const std::string& wheels) {
    build(kPoints + wheels);
    ASSERT_EQ(mode(Mode::kManual), nc::rt::Answer::kDone);
    steps(3);
  }
  std::string refused() const { return nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); }
  void at_rest(double x, double y) {
    ASSERT_GE(until([&] { return out().distance_zero && std::abs(counted(0) - x) < 1e-9 && std::abs(counted(1) - y) < 1e-9; }, 2000), 0) << counted(0) << " " << counted(1);
    steps(20);
    EXPECT_NEAR(counted(0), x, 1e-9);
    EXPECT_NEAR(counted(1), y, 1e-9);
  }
};

TEST_F(HandwheelMachine, TurnsTheAxisThatIsChosenByTheFactorThatIs) {
  by_hand(kWheel);
  turn("wheel", 7);  // no axis
  steps(5);
  turn("sel_x", 1);
  steps(5);
  turn("wheel", 12);
  at_rest(0.005, 0);
  turn("ten", 1);
  turn("wheel", 10);
  at_rest(-0.015, 0);
  turn("hundred", 1);
  turn("sel_x", 0);
  turn("sel_y", 1);
  steps(2);
  turn("wheel", 13);
  at_rest(-0.015, 0.3);
  turn("sel_x", 1);  // both: neither
  steps(2);
  EXPECT_EQ(refused(), "") << "nobody turns it";
  turn("wheel", 20);
  at_rest(-0.015, 0.3);
  EXPECT_NE(refused(), "");
}

TEST_F(HandwheelMachine, TwoWheelsOnOneAxisTurnItByNeither) {
  by_hand(kWheel + "[[handwheel]]\ncounter = \"wheel2\"\ncounts = 2\naxes = { X = \"sel2_x\" }\n");
  turn("sel_x", 1);
  turn("sel2_x", 1);
  steps(3);
  turn("wheel", 5);
  turn("wheel2", 8);
  steps(50);
  at_rest(0, 0);
  EXPECT_EQ(refused(), "handle X refused: two handwheels have chosen this axis, or the wheel has chosen two axes: choose one");
  const std::uint32_t told = runtime->snapshot().system[0].refusal.count;
  turn("wheel", 6);
  steps(20);
  EXPECT_EQ(runtime->snapshot().system[0].refusal.count, told) << "once";
  turn("sel_x", 0);
  steps(3);
  turn("wheel", 9);
  turn("wheel2", 12);
  at_rest(0.002, 0);
  EXPECT_EQ(refused(), "");
  turn("sel_x", 1);
  steps(3);
  turn("wheel", 12);
  steps(20);
  EXPECT_NE(refused(), "") << "again";
}

TEST_F(HandwheelMachine, ThreeWheelsWithFactorsOfTheirOwn) {
  by_hand(point("wheel3", true) + point("sel3_z") + kWheel + "[[handwheel]]\ncounter = \"wheel2\"\naxes = { Y = \"sel2_x\" }\ntimes_10 = \"hundred\"\n[[handwheel]]\ncounter = \"wheel3\"\naxes = { Z = \"sel3_z\" }\n");
  for (const char* chosen : {"sel_x", "sel2_x", "sel3_z", "hundred"}) turn(chosen, 1);
  steps(3);
  turn("wheel", 2);
  turn("wheel2", 3);
  turn("wheel3", 4);
  at_rest(0.2, 0.03);
  EXPECT_NEAR(counted(2), 0.004, 1e-9);
  EXPECT_EQ(refused(), "");
}

TEST_F(HandwheelMachine, ACounterThatJumpsTurnsNothingAndThatIsSaid) {
  by_hand(kWheel);
  turn("sel_x", 1);
  turn("hundred", 1);
  steps(3);
  turn("wheel", 7000);
  at_rest(0, 0);
  EXPECT_EQ(refused(), "handle X refused: more than the axis follows: it does not end where the wheel says");
  turn("wheel", 7002);
  at_rest(0.2, 0);
  EXPECT_EQ(refused(), "");
}

TEST_F(HandwheelMachine, DoesNothingInAutomatic) {
  build(kPoints + kWheel);
  turn("sel_x", 1);
  steps(3);
  turn("wheel", 100);
  steps(50);
  ASSERT_EQ(mode(Mode::kManual), nc::rt::Answer::kDone);
  at_rest(0, 0);
}

TEST(HandwheelConfigErrors, AreNamedWithTheirKeys) {
  const std::string base = nc::test::base_toml() + kPoints;
  const auto line = static_cast<unsigned>(std::count(base.begin(), base.end(), '\n'));
  const struct {
    std::string added;
    const char *key, *message;
    unsigned line;
  } mistakes[] = {
      {"[[handwheel]]\naxes = { X = \"sel_x\" }\n", "handwheel[1].counter", "is missing", 1},
      {"[[handwheel]]\ncounter = \"wheel\"\n", "handwheel[1].axes", "is missing", 1},
      {"[[handwheel]]\ncounter = \"sel_x\"\naxes = { X = \"sel_x\" }\n", "handwheel[1].counter", "an input that is a word", 2},
      {"[[handwheel]]\ncounter = \"nothing\"\naxes = { X = \"sel_x\" }\n", "handwheel[1].counter", "no point is named", 2},
      {"[[handwheel]]\ncounter = \"wheel\"\naxes = { W = \"sel_x\" }\n", "handwheel[1].axes.W", "no axis", 3},
      {"[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"out0\" }\n", "handwheel[1].axes.X", "an input that is a bit", 3},
      {"[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel_x\" }\ntimes_10 = \"wheel\"\n", "handwheel[1].times_10", "an input that is a bit", 4},
      {"[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel_x\" }\ncounts = 0\n", "handwheel[1].counts", "from 1", 4},
      {"[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel_x\", Y = \"sel_x\" }\n", "handwheel[1].axes.Y", "chooses another axis of this wheel", 3},
      {kWheel + "[[handwheel]]\ncounter = \"wheel2\"\naxes = { X = \"sel_x\" }\n", "handwheel[2].axes.X", "\"sel_x\" chooses this axis for handwheel[1], too", 8},
      {kWheel + "[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel2_x\" }\n", "handwheel[2].counter", "says two things that are not true together: the counter of handwheel 1, and the counter of handwheel 2", 7},
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

// A counter in one register has 16 bits. With 32 of them each wrap would be a jump, which turns nothing.
TEST(HandwheelConfig, TheCounterIsAsWideAsItsInput) {
  const auto wheel_at = [](const std::string& modbus, const std::string& more) {
    return nc::test::base_toml() + point("sel_x") + "[[modbus]]\nname = \"io\"\nhost = \"localhost\"\n[[point]]\nname = \"wheel\"\ntype = \"word\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"input\", address = 0" +
           modbus + " }\n[[handwheel]]\ncounter = \"wheel\"\naxes = { X = \"sel_x\" }\n" + more;
  };
  const struct {
    const char *modbus, *more;
    unsigned bits;
  } good[] = {{"", "", 16}, {"", "bits = 12\n", 12}, {", words = \"ABCD\"", "", 32}, {", words = \"ABCD\"", "bits = 24\n", 24}};
  for (const auto& one : good) {
    nc::rt::Config config;
    for (const nc::rt::ConfigError& error : nc::rt::parse_config(wheel_at(one.modbus, one.more), "m.toml", &config)) ADD_FAILURE() << error.text();
    ASSERT_EQ(config.handwheels.size(), 1u);
    EXPECT_EQ(config.handwheels[0].bits, one.bits) << one.modbus << one.more;
  }
  nc::rt::Config config;
  const auto errors = nc::rt::parse_config(wheel_at("", "bits = 17\n"), "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "handwheel[1].bits");
  EXPECT_NE(errors[0].message.find("an input of 16 bits"), std::string::npos) << errors[0].text();
}

}  // namespace
