// SPDX-License-Identifier: Apache-2.0
// Homing: every kind finds its mark within what a scan at creep speed is, no drive is given a jump, and what may be done before it is refused by name.
#include <random>

#include "axes_machine.hpp"
#include "runtime/has_bus.hpp"
#include "support/seeds.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

class Homing : public nc::test::AxesMachine {
 protected:
  // The machine's coordinates are its places, but for what an axis goes in a scan at creep speed, twice: the scan that sees the edge, and the lag.
  void expect_homed(unsigned axis, double creep) {
    EXPECT_TRUE((flags().homed >> axis & 1u) != 0);
    EXPECT_NEAR(out().command.v[axis], 0, 1e-9);
    EXPECT_NEAR(place(axis), 0, 2 * creep * config.nc.cycle_s + 1e-6);
    EXPECT_NEAR(runtime->snapshot().system[0].actual.v[axis], 0, 1e-6);
  }
};

TEST_F(Homing, AllAxesInTheirOrderFindTheirMarks) {
  build();
  EXPECT_EQ(flags().homed, 0u);
  manual_mode();
  ASSERT_EQ(home_all(), Answer::kDone);
  steps(2);
  EXPECT_EQ(flags().homing, 1u << kZ) << "Z goes first";
  EXPECT_GE(until([&] { return (flags().homing & 3) == 3; }), 0) << "then X and Y together";
  EXPECT_EQ(flags().homing, 3u);
  EXPECT_TRUE((flags().homed >> kZ & 1u) != 0);
  ASSERT_GE(until([&] { return flags().homing == 0; }), 0);
  steps(20);
  EXPECT_EQ(alarm(), "");
  expect_homed(kX, 2);
  expect_homed(kY, 3);
  expect_homed(kZ, 2);
  expect_limits_kept();
  EXPECT_GT(measured->moved, 1000u);
}

TEST_F(Homing, TheSameMarkIsFoundFromAnywhere) {
  for (const double from : {-289.0, -295.0, -309.9, 0.0, 200.0, -290.0}) {  // beside the dog, on it, far away, on its edge
    SCOPED_TRACE(from);
    build(changed({{"stands_at = -37.5", ("stands_at = " + std::to_string(from)).c_str()}}));
    manual_mode();
    ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
    ASSERT_GE(until([&] { return (flags().homing & 1) == 0 && (flags().homed & 1) != 0; }), 0) << alarm();
    steps(20);
    expect_homed(kX, 2);
    expect_limits_kept();
  }
}

// The offset has the wrong sign: the reference position is behind the switch. The search may stand on it, the way to the reference position may not.
TEST_F(Homing, BehindItsSearchALimitSwitchActsAgain) {
  build(changed({{"offset = -320.0", "offset = 40.0"}, {"name = \"Y\"\nstands_at = 12.25\nminus = -320.0\nplus = 320.0", "name = \"Y\"\nstands_at = 12.25\nminus = -400.0\nplus = 320.0"}}));
  manual_mode();
  ASSERT_EQ(ask(CommandKind::kHome, kY), Answer::kDone);
  ASSERT_GE(until([&] { return stopped_by_alarm() || (flags().homed >> kY & 1u) != 0; }), 0);
  EXPECT_EQ(alarm(), "");
  double furthest = 0;
  for (int n = 0; n < 3000; ++n) {
    furthest = std::max(furthest, place(kY));
    steps(1);
  }
  EXPECT_NE(alarm().find("Limit switch in +, axis Y"), std::string::npos) << alarm();
  EXPECT_LE(furthest, 320 + 150.0 * 150 / (2 * 1500) + 150 * 0.01);
}

TEST_F(Homing, ADogThatIsShorterThanTheBrakingWayIsFoundOnTheWayBack) {
  build(changed({{"dog = [-310.0, -290.0]", "dog = [-290.2, -290.0]"}}));  // 40 mm/s stop within 0.4 mm
  manual_mode();
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  ASSERT_GE(until([&] { return (flags().homed & 1) != 0 && flags().homing == 0; }), 0) << alarm();
  steps(20);
  expect_homed(kX, 2);
  expect_limits_kept();
}

TEST_F(Homing, AReferenceReturnHomesAnAxisThatIsNotHomedAndOnlyGoesThereLater) {
  build();
  manual_mode();
  ASSERT_EQ(ask(CommandKind::kReference, kX), Answer::kDone);
  steps(3);
  EXPECT_EQ(flags().homing, 1u);
  ASSERT_GE(until([&] { return flags().homing == 0; }), 0);
  steps(20);
  jog(kX, 50, 400);
  ASSERT_TRUE(let_go(kX));
  ASSERT_GT(place(kX), 10);
  ASSERT_EQ(ask(CommandKind::kReference, kX), Answer::kDone);
  steps(3);
  EXPECT_EQ(flags().homing, 0u) << "it knows where it stands";
  EXPECT_TRUE((flags().homed & 1) != 0);
  ASSERT_GE(until([&] { return (out().at_reference & 1) != 0 && out().distance_zero; }, 5000), 0);
}

TEST_F(Homing, HereSetsThePlaceWithoutMovingTheAxis) {
  build(changed({{"kind = \"switch\", direction = \"-\", fast = 40.0, creep = 2.0, dog = \"x_dog\", offset = 290.0", "kind = \"here\", offset = 25.0"},
                 {"dog = [-310.0, -290.0]\n", ""},
                 {"soft_limits = [-300.0, 300.0]\n", "soft_limits = [-300.0, 300.0]\nreference = [25.0]\n"}}));
  manual_mode();
  const double before = place(kX), told = measured->last.position.v[kX];
  jog(kX, 0, 1);
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  ASSERT_GE(until([&] { return (flags().homed & 1) != 0; }, 100), 0);
  EXPECT_NEAR(out().command.v[kX], 0, 1e-9) << "25 less the offset";
  EXPECT_NEAR(measured->last.position.v[kX], told, 1e-9) << "the drive is told nothing new";
  EXPECT_NEAR(place(kX), before, 1e-9);
  ASSERT_GE(until([&] { return flags().homing == 0; }, 3000), 0);
  steps(30);
  EXPECT_NEAR(place(kX), before + 25, 1e-6) << "then it goes to its reference position";
  expect_limits_kept();
}

TEST_F(Homing, AnAbsoluteEncoderIsHomedAtOnceAndAgainBehindAFault) {
  build(changed({{"kind = \"switch\", direction = \"-\", fast = 40.0, creep = 2.0, dog = \"x_dog\", offset = 290.0", "kind = \"absolute\""},
                 {"dog = [-310.0, -290.0]\n", ""}}));
  EXPECT_EQ(flags().homed, 1u);
  machine->fail_drive(0, kX, true);
  steps(3);
  EXPECT_EQ(flags().homed, 0u);
  machine->fail_drive(0, kX, false);
  steps(3);
  EXPECT_EQ(flags().homed, 1u);
}

TEST_F(Homing, ADriveThatHomesByItselfIsAskedAndSaysSo) {
  std::string text = changed({{"kind = \"switch\", direction = \"-\", fast = 40.0, creep = 2.0, dog = \"x_dog\", offset = 290.0",
                               "kind = \"drive\", request = \"x_ask\", done = \"x_dog\""},
                              {"dog = [-310.0, -290.0]\n", ""},
                              {"[signals]", "[[point]]\nname = \"x_ask\"\ndirection = \"output\"\n[signals]"}});
  build(text);
  manual_mode();
  const auto asked = [&] { return machine->outputs().value[point_of("x_ask")]; };
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  steps(50);
  EXPECT_EQ(asked(), 1u);
  EXPECT_EQ(flags().homed, 0u);
  in("x_dog", 1);
  steps(3);
  EXPECT_EQ(asked(), 0u);
  EXPECT_EQ(flags().homed, 1u);
  EXPECT_EQ(flags().homing, 0u);
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);  // again: what it has said before does not count
  steps(50);
  EXPECT_EQ(flags().homing, 1u);
  in("x_dog", 0);
  steps(5);
  EXPECT_EQ(flags().homing, 1u);
  in("x_dog", 1);
  steps(3);
  EXPECT_EQ(flags().homing, 0u);
}

TEST_F(Homing, TheSignalHomesAllAxes) {
  build();
  manual_mode();
  in("home", 1);
  steps(5);
  EXPECT_EQ(flags().homing, 1u << kZ);
  in("home", 0);
  ASSERT_GE(until([&] { return flags().homed == 7 && flags().homing == 0; }), 0) << alarm();
}

TEST_F(Homing, BeforeItNoProgramStartsAndTheReasonIsNamed) {
  build();
  EXPECT_EQ(start_program("G0 X10.\nM30\n"), Answer::kNotHomed);
  EXPECT_EQ(nc::rt::refusal_cause(Answer::kNotHomed), nc::rt::RefusalCause::kNotHomed);
  in("start", 1);
  steps(5);
  in("start", 0);
  steps(5);
  EXPECT_EQ(refusal(), "cycle start refused: an axis is not homed: home it first");
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  home_machine();
  EXPECT_EQ(start_program("G90 G53 G0 X10. Y-20.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return out().state == NC_STATE_RUNNING; }, 100), 0);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }), 0);
  steps(50);
  EXPECT_NEAR(place(kX), 10, 0.01) << "a program goes to places of the machine";
  EXPECT_NEAR(place(kY), -20, 0.01);
}

TEST_F(Homing, WhereItIsNotRequiredAProgramStarts) {
  std::string text = toml();
  for (std::size_t at = text.find("order ="); at != std::string::npos; at = text.find("order =", at + 20)) text.insert(at, "required = false, ");
  build(text);
  EXPECT_EQ(start_program("G0 X10.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return out().command.v[kX] == 10 && out().state == NC_STATE_IDLE; }), 0);
}

TEST_F(Homing, BeforeItJogsAreSlowAndSoftLimitsDoNotHold) {
  build(changed({{"stands_at = -37.5", "stands_at = 150.0"}, {"soft_limits = [-300.0, 300.0]", "soft_limits = [-5.0, 5.0]"},
                 {"offset = 290.0, order = 2", "offset = 0.0, order = 2, travel = 600.0"}}));
  manual_mode();
  jog(kX, 200, 1000);
  EXPECT_NEAR(out().velocity.v[kX], 40, 1e-6) << "as fast as it is homed";
  EXPECT_GT(out().command.v[kX], 30) << "beyond the soft limit, which means nothing yet";
  EXPECT_EQ(alarm(), "");
  ASSERT_TRUE(let_go(kX));
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  ASSERT_GE(until([&] { return flags().homing == 0; }), 0);
  jog(kX, 200, 2000);
  EXPECT_EQ(out().command.v[kX], 5) << "now it does";
}

TEST_F(Homing, AFaultOfItsDriveLosesItAndAStopDoesNot) {
  build();
  home_machine();
  reset();
  EXPECT_EQ(flags().homed, 7u) << "a reset";
  machine->fail_drive(0, kX, true);
  steps(20);
  EXPECT_EQ(flags().homed, 6u) << "X alone";
  machine->fail_drive(0, kX, false);
  steps(200);
  reset();
  steps(150);  // the brake of Z
  EXPECT_EQ(flags().homed, 6u);
  EXPECT_EQ(start_program("G0 X1.\nM30\n"), Answer::kNotHomed);
  manual_mode();
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  ASSERT_GE(until([&] { return flags().homed == 7 && flags().homing == 0; }), 0) << alarm();
  machine->fail_bus(true);
  steps(20);
  EXPECT_EQ(flags().homed, 0u) << "nobody knows what the encoders count meanwhile";
}

// ---- what ends it ----

TEST_F(Homing, WhatStopsMotionByHandEndsItAndItDoesNotGoOnByItself) {
  for (int which = 0; which < 3; ++which) {
    SCOPED_TRACE(which);
    build();
    manual_mode();
    ASSERT_EQ(home_all(), Answer::kDone);
    steps(500);
    ASSERT_EQ(flags().homing, 1u << kZ);
    if (which == 0) {
      ASSERT_EQ(ask(CommandKind::kReset), Answer::kDone);
    }
    if (which == 1) machine->fail_drive(0, kX, true);
    if (which == 2) in("x_go", 0);
    ASSERT_GE(until([&] { return out().distance_zero; }, 200), 0);
    steps(50);
    machine->fail_drive(0, kX, false);
    in("x_go", 1);
    steps(50);
    if (which != 2) reset();
    const double stands = place(kZ);
    steps(1000);
    EXPECT_EQ(flags().homing, 0u) << "nor does the next axis begin";
    EXPECT_NEAR(place(kZ), stands, 1e-3);
    EXPECT_EQ(flags().homed & 1u << kZ, 0u);
    expect_limits_kept();
  }
}

// In each of its phases, by whatever ends it: nothing goes on by itself, and the next homing finds the same marks. NC_SEEDS for more.
TEST_F(Homing, EndedAnywhereItIsFoundTheNextTime) {
  const unsigned seeds = static_cast<unsigned>(nc::test::seeds(12, 3));
  for (unsigned seed = 1; seed <= seeds && !HasFailure(); ++seed) {
    std::mt19937 random(seed);
    const auto below = [&random](unsigned n) { return static_cast<int>(random() % n); };
    build(changed({{"stands_at = -37.5", ("stands_at = " + std::to_string(below(560) - 280)).c_str()}, {"stands_at = 12.25", ("stands_at = " + std::to_string(below(560) - 280)).c_str()}}));
    manual_mode();
    for (int ends = 1 + below(3); ends > 0 && !HasFailure(); --ends) {
      ASSERT_EQ(home_all(), Answer::kDone) << refusal();
      const int scans = 1 + below(30'000), what = below(8);
      const unsigned axis = static_cast<unsigned>(below(3));
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(what) + " behind " + std::to_string(scans) + " scans");
      for (int n = 0; n < scans && (n < 3 || flags().homing != 0); ++n) steps(1);
      switch (what) {
        case 0: ASSERT_EQ(ask(CommandKind::kReset), Answer::kDone); break;
        case 1: machine->fail_drive(0, axis, true); break;
        case 2: machine->fail_bus(true); break;
        case 3: in("x_go", 0); break;
        case 4: (void)ask(CommandKind::kSetMode, 0, static_cast<double>(Mode::kAuto)); break;
        case 5: in(below(2) == 0 ? "x_free_p" : "x_free_m", 0); break;
        case 6: machine->block_axis(0, axis, true); break;
        case 7: in("z_servo_off", 1); break;
      }
      steps(1 + below(100));
      machine->fail_drive(0, axis, false);
      machine->block_axis(0, axis, false);
      machine->fail_bus(false);
      for (const char* name : {"x_go", "x_free_p", "x_free_m"}) in(name, 1);
      in("z_servo_off", 0);
      steps(400);
      if (what == 5 || what == 6 || what == 7) (void)until([&] { return flags().homing == 0; });  // what was asked of another axis goes on
      reset();
      steps(400);
      manual_mode();
      const std::uint64_t moved = measured->moved;
      steps(500);
      EXPECT_EQ(measured->moved, moved) << "by itself";
      for (unsigned a = 0; a < 3; ++a) {  // from the limit switches, and from behind the dogs
        const double at = place(a);
        if (std::abs(at) < (a == kZ ? 100 : 285)) continue;
        jog(a, at > 0 ? -20 : 20, (a == kZ ? 2500 : 2000));
        ASSERT_TRUE(let_go(a));
        reset();
        steps(300);
      }
    }
    home_machine();
    for (unsigned a = 0; a < 3; ++a) expect_homed(a, a == kY ? 3 : 2);
    expect_limits_kept();
    EXPECT_EQ(alarm(), "");
  }
}

TEST_F(Homing, AnInterlockInItsDirectionEndsIt) {
  build();
  manual_mode();
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  steps(500);
  in("x_free_m", 0);
  steps(100);
  EXPECT_EQ(flags().homing, 0u);
  EXPECT_TRUE(out().distance_zero);
  EXPECT_EQ(refusal(), "reference return X stopped: the interlock of the machine is on");
  in("x_free_m", 1);
  steps(500);
  EXPECT_TRUE(out().distance_zero);
  expect_limits_kept();
}

TEST_F(Homing, EachFailureIsAnAlarmThatNamesAxisAndReason) {
  struct Row {
    const char* from;
    const char* to;
    unsigned axis;
    const char* says;
  };
  for (const Row& row : {Row{"dog = [-310.0, -290.0]", "dog = [-900.0, -890.0]", kX, "R22 Limit switch in -, axis X"},
                         {"offset = 290.0, order = 2", "offset = 290.0, order = 2, travel = 30.0", kX, "R23 Homing has failed: its switch was not found, axis X"},
                         {"offset = 290.0, order = 2", "offset = 290.0, order = 2, timeout_s = 2.0", kX, "R23 Homing has failed: it takes too long, axis X"},
                         {"dog = [-310.0, -290.0]", "dog = [-900.0, 330.0]", kX, "R22 Limit switch in +, axis X"},
                         {"index = [10.0, 5.0]", "index = [100.0, 45.0]", kZ, "R23 Homing has failed: no index pulse was found, axis Z"},
                         {"dog = [125.0, 130.0]", "dog = [125.0, 125.1]", kZ, "R23 Homing has failed: the dog was left before the axis had come down to the creep speed, axis Z"}}) {
    SCOPED_TRACE(row.says);
    build(changed({{row.from, row.to}}));
    manual_mode();
    ASSERT_EQ(ask(CommandKind::kHome, row.axis), Answer::kDone);
    ASSERT_GE(until([&] { return stopped_by_alarm(); }), 0);
    EXPECT_EQ(alarm(), row.says);
    ASSERT_GE(until([&] { return out().distance_zero; }, 300), 0);
    steps(10);
    EXPECT_EQ(flags().homing, 0u);
    EXPECT_EQ(flags().homed, 0u);
    EXPECT_TRUE(measured->last.enable && measured->last.off == 0 && brake_open()) << "the drives hold";
    expect_limits_kept();
  }
}

TEST_F(Homing, ADogOnABusThatDoesNotAnswerIsNotLookedFor) {
  if (!nc::test::has_bus("modbus")) GTEST_SKIP() << "built without Modbus";
  build(changed({{"name = \"x_dog\"\ndirection = \"input\"\n", "name = \"x_dog\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"discrete\", address = 0 }\n"},
                 {"dog = [-310.0, -290.0]\n", ""},
                 {"[signals]", "[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\n[signals]"}}));
  manual_mode();
  const double stands = place(kX);
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  steps(10);
  EXPECT_EQ(alarm(), "R23 Homing has failed: its switch cannot be read, axis X");
  EXPECT_NEAR(place(kX), stands, 1e-9);
}

TEST_F(Homing, WhatCannotBeHomedIsSaid) {
  build(changed({{"homing = { kind = \"limit\"", "#"}}));
  EXPECT_EQ(ask(CommandKind::kHome, kX), Answer::kNotInThisMode);
  EXPECT_EQ(flags().homed, 1u << kY) << "an axis without homing knows where it stands";
  manual_mode();
  EXPECT_EQ(ask(CommandKind::kHome, kY), Answer::kNoHoming);
  EXPECT_EQ(ask(CommandKind::kHome, 7), Answer::kAxisUnknown);
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  steps(100);
  EXPECT_EQ(ask(CommandKind::kHome, kX), Answer::kHoming);
  EXPECT_EQ(ask(CommandKind::kJog, kX, 10), Answer::kHoming);
  EXPECT_EQ(ask(CommandKind::kStep, kX, 1), Answer::kHoming);
  EXPECT_EQ(flags().homing, 1u);
}

}  // namespace
