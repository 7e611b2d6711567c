// SPDX-License-Identifier: Apache-2.0
// Backlash and errors of the pitch: a screw with play and with a wrong pitch, written here once more, turned by what the drive of X is given. Its table stands where the
// control says that it stands, whatever the axis has done before.
#include <random>

#include "axes_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::ScrewCompensation;
using nc::rt::ScrewConfig;

constexpr double kPlay = 0.03;

// A wave of 20 um along the travel, and 5 um of a shorter one.
double pitch_error(double at) { return 0.02 * std::sin(at / 90) + 0.005 * std::sin(at / 17); }

class Screw {
 public:
  // Motor at `motor`; returns the place of the table.
  double turn(double motor) {
    if (!known_) nut_ = motor;
    known_ = true;
    nut_ = std::clamp(nut_, motor, motor + kPlay);  // on the way + the nut lies at the motor, on the way - behind it
    return nut_ + pitch_error(nut_);
  }

 private:
  bool known_ = false;
  double nut_ = 0;
};

class ScrewOfX : public nc::test::AxesMachine {
 protected:
  static std::string table() {
    std::string text = "screw = { from = -320.0, step = 4.0, backlash = 0.03, acceleration = 1500.0, error = [";
    for (int n = 0; n <= 160; ++n) text += (n > 0 ? ", " : "") + std::to_string(pitch_error(-320 + 4 * n));
    return text + "] }\nlimit_switches = { minus = \"x_min\"";
  }
  static std::string with_screw() { return changed({{"limit_switches = { minus = \"x_min\"", table().c_str()}}); }
  void home() {
    manual_mode();
    ASSERT_EQ(home_all(), Answer::kDone);
    steps(2);
    ASSERT_GE(until_turned([&] { return flags().homing == 0 && flags().homed == 7; }), 0) << alarm() << refusal();
    go(700);
  }
  void go(int n) {
    while (n-- > 0) {
      runtime->step();
      table_ = screw_.turn(measured->last.position.v[kX] - 37.5);
    }
  }
  template <class Done>
  int until_turned(Done done, int most = 60000) {
    for (int n = 0; n < most; ++n) {
      if (done()) return n;
      go(1);
    }
    return -1;
  }
  double off() const { return table_ - out().command.v[kX]; }

  Screw screw_;
  double table_ = 0;
};

TEST_F(ScrewOfX, TheTableStandsWhereItIsCommanded) {
  build(with_screw());
  home();
  // The dog sees the motor, which goes over the mark in -. Beside that a homing may be off by two scans at creep speed.
  EXPECT_NEAR(off(), kPlay + pitch_error(-290), 0.0041);
  const double zero = off();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-290, 290), near(-0.05, 0.05), feed(20, 9000);
  std::string program = "G21 G90 G94 G61\n";
  double at = 0;
  for (int n = 0; n < 120; ++n) {
    at = n % 3 == 0 ? anywhere(random) : std::clamp(at + near(random), -290.0, 290.0);
    program += "G1 X" + std::to_string(at) + " F" + std::to_string(n % 3 == 0 ? 9000 : feed(random)) + "\n";
  }
  load(program + "M30\n");
  ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
  // A reversal takes sqrt(5.77 * 0.03 / 1500) s; until the last one is through the table is off by the play at most.
  constexpr int kTurning = 12;
  double last = out().command.v[kX], worst = 0, worst_turning = 0;
  int direction = 0, since = 1000, compared = 0;
  ASSERT_GE(until_turned([&] {
              const double now = out().command.v[kX];
              const int way = now > last + 1e-7 ? 1 : now < last - 1e-7 ? -1 : direction;
              since = way != direction ? 0 : since + 1;
              direction = way;
              last = now;
              if (since > 2 * kTurning) {
                worst = std::max(worst, std::abs(off() - zero));
                ++compared;
              } else {
                worst_turning = std::max(worst_turning, std::abs(off() - zero));
              }
              return out().state == NC_STATE_IDLE && compared > 0;
            }, 400000), 0) << alarm();
  EXPECT_GT(compared, 5000);
  EXPECT_LE(worst, 3e-4) << "between the places of the table the wave is off its chord by 4^2 / 8 * 0.005 / 17^2 and 0.02 / 90^2, less than 0.05 um, and a moving reversal";
  EXPECT_LE(worst_turning, kPlay);
  EXPECT_EQ(alarm(), "");
}

// The drive may get what the axis may and the acceleration of the reversal, and the speed that belongs to it.
TEST_F(ScrewOfX, TheDriveIsGivenNoStep) {
  build(with_screw());
  home();
  load("G21 G90 G94\nG1 X20. F12000\nX-20.\nX20.\nG0 X-100.\nX-99.99\nX-100.\nX100.\nM30\n");
  ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until_turned([&] { return out().state == NC_STATE_RUNNING; }), 0);
  ASSERT_GE(until_turned([&] { return out().state == NC_STATE_IDLE; }), 0);
  EXPECT_LE(measured->hardest, 1.001 + 1500.0 / 2000 + 0.02);
  EXPECT_LE(measured->fastest, 1.001 + 0.01);
  EXPECT_EQ(alarm(), "");
}

// A table whose play is large and an acceleration that nobody has: the drive turns no faster than it can.
TEST_F(ScrewOfX, AReversalKeepsTheSpeedOfTheDrive) {
  build(changed({{"limit_switches = { minus = \"x_min\"", "screw = { backlash = 1.0, acceleration = 1000000.0 }\nlimit_switches = { minus = \"x_min\""}}));
  home();
  measured->forget();
  load("G21 G90 G94\nG0 X20.\nX-20.\nX20.\nG1 X19. F100\nX20.\nM30\n");
  ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until([&] { return out().state == NC_STATE_RUNNING; }), 0);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }), 0);
  EXPECT_LE(measured->fastest, 1.25 * 1.001);
  EXPECT_EQ(alarm(), "");
}

TEST_F(ScrewOfX, AnotherHomingFindsTheSamePlace) {
  build(with_screw());
  home();
  const double zero = off();
  for (const double to : {100.0, -250.0, 5.0}) {
    jog(kX, to > out().command.v[kX] ? 50 : -50, 900);
    ASSERT_TRUE(let_go(kX));
    home();
    EXPECT_NEAR(off(), zero, 0.0041) << to;
  }
}

// The axis believes that it stands elsewhere, with what its table says of that place in its drive. Where it is homed once more nothing is compensated, and its drive stands.
TEST_F(ScrewOfX, ASecondHomingElsewhereMovesNoDrive) {
  std::string text = with_screw();
  for (const auto& [from, to] : {std::pair{"homing = { kind = \"switch\", direction = \"-\", fast = 40.0, creep = 2.0, dog = \"x_dog\", offset = 290.0, order = 2 }", "homing = { kind = \"here\" }"},
                                 std::pair{"dog = [-310.0, -290.0]\n", ""}}) {
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), std::string(from).size(), to);
  }
  build(text);
  manual_mode();
  const auto home_x = [&] {
    ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
    ASSERT_GE(until([&] { return (flags().homed & 1) != 0 && out().state == NC_STATE_IDLE && out().distance_zero && (flags().homing & 1) == 0; }), 0) << alarm() << refusal();
    steps(700);
  };
  home_x();
  for (const double way : {60.0, -90.0, 50.0}) {
    jog(kX, way, 1000);
    ASSERT_TRUE(let_go(kX));
    steps(100);
    const double stood = measured->last.position.v[kX], value = flags().screw[kX];
    EXPECT_GT(std::abs(value), 1e-4) << way;
    measured->forget();
    ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
    ASSERT_GE(until([&] { EXPECT_NEAR(measured->last.position.v[kX], stood, 1e-7); return std::abs(out().command.v[kX]) < 0.1 || HasFailure(); }), 0) << alarm() << refusal();
    steps(5);
    EXPECT_LE(measured->hardest, 1.001) << way;
    home_x();
    EXPECT_NEAR(out().command.v[kX], 0, 1e-9);
  }
}

// What is shown is the place of the table, as far as the encoder of the motor tells it; nothing of it comes before the axis knows where it stands.
TEST_F(ScrewOfX, ComesWithTheKnowledgeOfThePlaceAndIsShown) {
  build(with_screw());
  manual_mode();
  jog(kX, -20, 200);
  ASSERT_TRUE(let_go(kX));
  EXPECT_EQ(flags().screw[kX], 0);
  home();
  load("G90 G0 X150.\nM30\n");
  ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until([&] { return out().state == NC_STATE_RUNNING; }), 0);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }), 0);
  steps(200);
  // X was homed in -, so on the way + the play is to be taken back; the mark is at -290.
  EXPECT_NEAR(flags().screw[kX], pitch_error(-290) + kPlay - pitch_error(150), 1e-4);
  EXPECT_NEAR(runtime->snapshot().system[0].actual.v[kX], 150, 1e-3);
}

TEST_F(ScrewOfX, AnAxisThatIsLockedKeepsItsDriveWhereItIs) {
  std::string text = with_screw();
  text += "\"plc.axis_lock.X\" = \"home\"\n";
  const std::string home_signal = "\"plc.home\" = \"home\"\n";
  const std::size_t at = text.find(home_signal);
  text.erase(at, home_signal.size());
  const std::string lock = "\"plc.axis_lock.X\" = \"home\"\n";
  text.erase(text.rfind(lock), lock.size());
  text.insert(at, lock);
  build(text);
  home();
  in("home", 1);
  steps(5);
  const double stands = measured->last.position.v[kX];
  load("G90 G0 X150.\nX-150.\nX0\nM30\n");
  ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until([&] { return out().state == NC_STATE_RUNNING; }), 0);
  ASSERT_GE(until([&] { EXPECT_EQ(measured->last.position.v[kX], stands); return out().state == NC_STATE_IDLE || HasFailure(); }), 0);
}

TEST(ScrewCompensationOf, ATurnGoesOnFromItsEndToItsBeginning) {
  ScrewConfig screw;
  screw.step = 90;
  screw.error[1] = {0, 0.01, 0.02, -0.01};
  screw.turns = true;
  screw.acceleration = 1000;
  ScrewCompensation compensation;
  compensation.create(screw, 0, 1);
  for (int n = 0; n < 1000; ++n) (void)compensation.step(0, true, false, 0.001);
  struct Row {
    double place, error;
  };
  for (const Row& row : {Row{0, 0}, {45, 0.005}, {90, 0.01}, {225, 0.005}, {270, -0.01}, {315, -0.005}, {359.999, -1e-7}, {360, 0}, {405, 0.005}, {36045, 0.005}}) {
    SCOPED_TRACE(row.place);
    EXPECT_NEAR(compensation.step(row.place, true, true, 0.001), -row.error, 1e-6);
    EXPECT_NEAR(compensation.step(row.place - 7200, true, true, 0.001), -row.error, 1e-6);
  }
}

TEST(ScrewCompensationOf, EachWayHasATableOfItsOwn) {
  ScrewConfig screw;
  screw.from = -10;
  screw.step = 10;
  screw.error[0] = {0.02, 0.03, 0.05};
  screw.error[1] = {0.00, 0.01, 0.01};
  screw.acceleration = 1000;
  ScrewCompensation compensation;
  compensation.create(screw, 0, -1);
  double at = 0;
  const auto go = [&](double to) {
    double value = 0;
    for (int n = 1; n <= 1000; ++n) value = compensation.step(at + (to - at) * n / 1000, true, false, 0.001);
    for (int n = 0; n < 100; ++n) value = compensation.step(to, true, false, 0.001);
    at = to;
    return value;
  };
  EXPECT_NEAR(go(0), 0, 1e-12) << "where the measuring system was set";
  EXPECT_NEAR(go(10), 0.03 - 0.01, 1e-12);
  EXPECT_NEAR(go(0), 0, 1e-12);
  EXPECT_NEAR(go(-10), 0.03 - 0.02, 1e-12);
  EXPECT_NEAR(go(-100), 0.03 - 0.02, 1e-12) << "outside of the table what stands at its end";
  EXPECT_NEAR(go(-5), 0.03 - 0.005, 1e-12);
}

TEST(ScrewCompensationOf, ACommandThatStandsIsNoReversal) {
  ScrewConfig screw;
  screw.backlash = 0.01;
  screw.acceleration = 1000;
  ScrewCompensation compensation;
  compensation.create(screw, 0, 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> rounding(-4e-6, 4e-6);
  for (int n = 0; n < 2000; ++n) EXPECT_EQ(compensation.step(5 + rounding(random), true, false, 0.001), 0);
  for (int n = 0; n < 100; ++n) (void)compensation.step(4.99, true, false, 0.001);
  EXPECT_NEAR(compensation.value(), -0.01, 1e-12);
  for (int n = 0; n < 100; ++n) (void)compensation.step(6, true, true, 0.001);
  EXPECT_NEAR(compensation.value(), -0.01, 1e-12) << "a measured place says nothing about the side";
}

class ScrewKeys : public nc::test::AxesMachine {};

TEST_F(ScrewKeys, EachErrorNamesItsPlace) {
  struct Row {
    const char* screw;
    const char* says;
  };
  for (const Row& row : {Row{"{ }", "axis[1].screw: needs backlash, error or both"},
                         {"{ backlash = -0.1 }", "axis[1].screw.backlash: "},
                         {"{ backlash = 1.5 }", "axis[1].screw.backlash: "},
                         {"{ backlash = 0.01, play = 2 }", "axis[1].screw.play: "},
                         {"{ backlash = 0.01, from = 3.0 }", "axis[1].screw.from: is for a table: error"},
                         {"{ error = [0.0, 0.01] }", "axis[1].screw.from: is missing"},
                         {"{ from = 0.0, error = [0.0, 0.01] }", "axis[1].screw.step: is missing"},
                         {"{ from = 0.0, step = 0.0, error = [0.0, 0.01] }", "axis[1].screw.step: "},
                         {"{ from = 0.0, step = 10.0, error = [0.0] }", "axis[1].screw.error: "},
                         {"{ from = 0.0, step = 10.0, error = [0.0, nan] }", "axis[1].screw.error: "},
                         {"{ from = 0.0, step = 10.0, error = [0.0, \"a\"] }", "axis[1].screw.error: "},
                         {"{ from = 0.0, step = 1000.0, error = [0.0, 2.0] }", "axis[1].screw.error: 2 is more than an error of a screw can be (1)"},
                         {"{ from = 0.0, step = 10.0, error = [0.0, 0.2] }", "axis[1].screw.error: must not change by more than a hundredth of step from place to place"},
                         {"{ from = 0.0, step = 10.0, error = [0.0, 0.01], error_minus = [0.0] }", "axis[1].screw.error_minus: "},
                         {"{ from = 0.0, step = 10.0, error = [0.0, 0.01], error_minus = [0.0, 0.01, 0.0] }", "axis[1].screw.error_minus: must have as many numbers as error (2)"},
                         {"{ from = 0.0, step = 10.0, error = [0.0, 0.01], error_minus = [0.0, 0.01], backlash = 0.1 }",
                          "axis[1].screw.backlash: is in the difference of error and error_minus already"},
                         {"{ from = 0.0, step = 4.0, error = [0.0, 0.04, 0.0, 0.04] }", "axis[1].screw.error: bends so sharply that the drive would need 4000 there at max_velocity, and acceleration is 2000"},
                         {"{ from = 0.0, step = 4.0, error = [0.0, 0.0, 0.0], error_minus = [0.0, 0.04, 0.0] }", "axis[1].screw.error_minus: bends so sharply"},
                         {"{ backlash = 0.01, acceleration = 0.0 }", "axis[1].screw.acceleration: "}}) {
    SCOPED_TRACE(row.screw);
    const std::string key = std::string("screw = ") + row.screw + "\nlimit_switches = { minus = \"x_min\"";
    nc::rt::Config read;
    const auto errors = nc::rt::parse_config(changed({{"limit_switches = { minus = \"x_min\"", key.c_str()}}), "axes.toml", &read);
    ASSERT_FALSE(errors.empty());
    EXPECT_NE(errors[0].text().find(row.says), std::string::npos) << errors[0].text();
    EXPECT_NE(errors[0].text().find("axes.toml:"), std::string::npos);
  }
}

TEST_F(ScrewKeys, ATableOfARotaryAxisIsATurn) {
  const auto errors_of = [](const char* error) {
    const std::string text = std::string("[machine]\nname = \"r\"\n[[axis]]\nname = \"A\"\nrotary = true\nmax_velocity = 90.0\nmax_acceleration = 500.0\nmax_jerk = 5000.0\n") +
                             "screw = { from = 0.0, step = 90.0, error = " + error + " }\n";
    nc::rt::Config read;
    return nc::rt::parse_config(text, "r.toml", &read);
  };
  EXPECT_TRUE(errors_of("[0.0, 0.01, 0.02, 0.01]").empty());
  const auto errors = errors_of("[0.0, 0.01, 0.02]");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].text().find("axis[1].screw.error: the table of a rotary axis is one turn"), std::string::npos) << errors[0].text();
}

}  // namespace
