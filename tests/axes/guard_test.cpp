// SPDX-License-Identifier: Apache-2.0
// Limit switches with a way out, interlocks of an axis and a direction, drives and brakes one by one. The rows of docs/safety.md.
#include <utility>
#include <vector>

#include "axes_machine.hpp"
#include "runtime/has_bus.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

class Guard : public nc::test::AxesMachine {
 protected:
  // Behind the switch by no more than its stopping distance, what it goes until the NC sees the switch, and what its servo lags behind.
  double slack(unsigned axis, double velocity) const {
    const nc_axis_config& limits = config.nc.system[0].axis[axis];
    return velocity * velocity / (2 * limits.max_acceleration) + velocity * (3 * config.nc.cycle_s + config.sim.axis[0][axis].lag_s) + 1e-6;
  }
  // X stands on its switch in +, stopped by its alarm.
  void run_into_the_switch() {
    manual_mode();
    jog(kX, 40, 12000);
    ASSERT_TRUE(stopped_by_alarm());
    ASSERT_GE(until([&] { return out().distance_zero; }, 300), 0);
    ASSERT_TRUE(let_go(kX));
  }
};

// ---- limit switches ----

TEST_F(Guard, ALimitSwitchStopsItsAxisWithinItsLimitsAndNamesIt) {
  build();
  run_into_the_switch();
  EXPECT_EQ(alarm(), "R22 Limit switch in +, axis X");
  EXPECT_EQ(flags().limit[1], 1u);
  EXPECT_EQ(flags().limit[0], 0u);
  EXPECT_GE(place(kX), 320);
  EXPECT_LE(place(kX), 320 + slack(kX, 40));
  expect_limits_kept();
}

TEST_F(Guard, OnlyTheWayOutIsFreeAndTheAlarmGoesWithTheSwitch) {
  build();
  run_into_the_switch();
  EXPECT_EQ(ask(CommandKind::kJog, kX, -10), Answer::kAlarmActive) << "first someone has to look";
  reset();
  EXPECT_FALSE(stopped_by_alarm());
  EXPECT_EQ(alarm(), "R22 Limit switch in +, axis X") << "it is on yet";
  const double stands = place(kX);
  EXPECT_EQ(ask(CommandKind::kJog, kX, 10), Answer::kLimitSwitch);
  steps(100);
  EXPECT_EQ(ask(CommandKind::kStep, kX, 1), Answer::kLimitSwitch);
  steps(100);
  EXPECT_NEAR(place(kX), stands, 1e-6);
  EXPECT_EQ(ask(CommandKind::kJog, kX, 0), Answer::kDone);
  EXPECT_EQ(ask(CommandKind::kStep, kY, 1), Answer::kDone) << "another axis goes";
  steps(500);
  jog(kX, -20, 500);
  ASSERT_TRUE(let_go(kX));
  EXPECT_LT(place(kX), 320);
  EXPECT_EQ(flags().limit[1], 0u);
  EXPECT_EQ(alarm(), "");
  expect_limits_kept();
}

TEST_F(Guard, AProgramThatMeetsASwitchStopsOnItsPathAndIsGivenUp) {
  build(changed({{"plus = 320.0", "plus = 50.0"}}));
  home_machine();
  ASSERT_EQ(start_program("G90 G53 G0 X200. Y100.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return stopped_by_alarm(); }, 5000), 0);
  ASSERT_GE(until([&] { return out().distance_zero; }, 300), 0);
  steps(30);
  EXPECT_EQ(alarm().substr(0, 28), "R22 Limit switch in +, axis ");
  EXPECT_GE(place(kX), 50);
  // A program keeps the jerk limit too, and its law of motion begins to brake within 30 ms (docs/motion-optimal.md).
  const nc_axis_config& x = config.nc.system[0].axis[kX];
  EXPECT_LE(place(kX), 50 + slack(kX, 200) + 200 * (x.max_acceleration / (2 * x.max_jerk) + 0.03));
  EXPECT_EQ(flags().homed, 7u) << "the encoders count on";
  reset();
  EXPECT_EQ(start_program("G90 G53 G0 X0.\nM30\n"), Answer::kLimitSwitch) << "by hand first";
  expect_limits_kept();
}

TEST_F(Guard, BothSwitchesAtOnceAreAFaultOfTheWires) {
  build();
  manual_mode();
  in("y_min", 0);
  in("y_max", 0);
  steps(1);
  EXPECT_TRUE(stopped_by_alarm());
  EXPECT_EQ(alarm(), "R22 Limit switches of both ends are on at once: look at their wires, axis Y");
}

TEST_F(Guard, WhereItStandsOnTheSwitchAtPowerOnItIsSaidAndTheWayOutIsFree) {
  build(changed({{"stands_at = -37.5", "stands_at = -321.0"}}));
  EXPECT_EQ(alarm(), "R22 Limit switch in -, axis X");
  manual_mode();
  reset();
  jog(kX, -20, 200);
  EXPECT_NEAR(place(kX), -321, 1e-6);
  ASSERT_TRUE(let_go(kX));
  jog(kX, 20, 300);
  ASSERT_TRUE(let_go(kX));
  EXPECT_GT(place(kX), -320);
  EXPECT_EQ(alarm(), "");
}

TEST_F(Guard, ASwitchThatCannotBeReadLetsTheAxisGoTheOtherWayOnly) {
  if (!nc::test::has_bus("modbus")) GTEST_SKIP() << "built without Modbus";
  // Its link is never made here, so it does not answer.
  build(changed({{"name = \"x_min\"\ndirection = \"input\"\n", "name = \"x_min\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"discrete\", address = 0 }\n"},
                 {"minus = -320.0\n", ""},
                 {"[signals]", "[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\n[signals]"}}));
  EXPECT_EQ(alarm(), "") << "it says nothing";
  EXPECT_EQ(start_program("G0 X1.\nM30\n"), Answer::kLimitSwitch);
  manual_mode();
  EXPECT_EQ(ask(CommandKind::kJog, kX, -10), Answer::kLimitSwitch);
  (void)ask(CommandKind::kJog, kX, 0);
  ASSERT_EQ(ask(CommandKind::kHome, kX), Answer::kDone);
  steps(50);
  EXPECT_EQ(flags().homing, 0u) << "the search would go that way";
  EXPECT_EQ(refusal(), "reference return X stopped: an axis is on its limit switch, or the switch cannot be read: only the other way is free");
  const double stands = place(kX);
  jog(kX, 10, 300);
  EXPECT_GT(place(kX), stands + 1);
}

// ---- interlocks ----

TEST_F(Guard, AnInterlockOfADirectionStopsThatDirectionByHand) {
  build();
  home_machine();
  in("x_free_p", 0);
  steps(3);
  EXPECT_EQ(ask(CommandKind::kJog, kX, 20), Answer::kInterlock);
  (void)ask(CommandKind::kJog, kX, 0);
  jog(kX, -20, 300);
  EXPECT_LT(place(kX), -1) << "the other way is free";
  ASSERT_TRUE(let_go(kX));
  steps(50);
  EXPECT_EQ(ask(CommandKind::kReference, kX), Answer::kDone);
  steps(50);
  EXPECT_LT(place(kX), -1) << "so the way to the reference position is not";
  EXPECT_EQ(refusal(), "reference return X stopped: the interlock of the machine is on");
  in("x_free_p", 1);
  steps(500);
  EXPECT_TRUE(out().distance_zero) << "and it does not begin by itself";
  ASSERT_EQ(ask(CommandKind::kStep, kX, 100), Answer::kDone);
  steps(200);
  ASSERT_FALSE(out().distance_zero);
  in("x_free_p", 0);
  steps(150);
  EXPECT_TRUE(out().distance_zero) << "a step on its way comes to rest";
  const double stands = place(kX);
  in("x_free_p", 1);
  steps(500);
  EXPECT_NEAR(place(kX), stands, 1e-4);
  expect_limits_kept();
}

// The way back to the path has a direction before it begins, and is asked for as a jog is: by a client, by a button, and however often.
TEST_F(Guard, AnInterlockOfADirectionRefusesTheWayBackToThePathBeforeItBegins) {
  for (const bool button : {false, true}) {
    SCOPED_TRACE(button ? "a button" : "a client");
    std::string text = changed({{"[signals]\n", "[signals]\n\"plc.restart_approach.X\" = \"z_servo_off\"\n\"plc.jog_feed\" = \"jog_feed\"\n"}, {"\"plc.servo_off.Z\" = \"z_servo_off\"\n", ""}});
    build(text + "[[point]]\nname = \"jog_feed\"\ntype = \"word\"\ndirection = \"input\"\n");
    in("jog_feed", 600);
    home_machine();
    ASSERT_EQ(start_program("G90 G53 G1 X-50. F3000.\nM30\n"), Answer::kDone);
    ASSERT_GE(until([&] { return out().command.v[kX] < -10; }, 5000), 0);
    ASSERT_EQ(ask(CommandKind::kFeedHold), Answer::kDone);
    ASSERT_GE(until([&] { return out().state == NC_STATE_HOLD && out().distance_zero; }, 2000), 0);
    steps(20);
    manual_mode();
    jog(kX, 40, 300);
    ASSERT_TRUE(let_go(kX));
    in("x_free_m", 0);
    steps(5);
    const double stands = out().command.v[kX];
    for (int n = 0; n < 20; ++n) {
      if (button) {
        in("z_servo_off", 1);
      } else {
        EXPECT_EQ(ask(CommandKind::kApproach, kX, 10), Answer::kInterlock);
      }
      steps(20);
      if (button) in("z_servo_off", 0);
      else (void)ask(CommandKind::kJog, kX, 0);
      steps(50);
      ASSERT_EQ(out().command.v[kX], stands) << "press " << n;
    }
    if (button) {
      EXPECT_EQ(refusal(), "return to the path X refused: the interlock of the machine is on");
    }
    in("x_free_m", 1);
    in("x_free_p", 0);
    steps(5);
    for (int n = 0; n < 500 && out().restart_axes != 0; ++n) {
      if (button) {
        in("z_servo_off", 1);
      } else {
        ASSERT_EQ(ask(CommandKind::kApproach, kX, 10), Answer::kDone) << "the way back is free";
      }
      steps(20);
    }
    EXPECT_EQ(out().restart_axes, 0u);
    expect_limits_kept();
  }
}

TEST_F(Guard, AnInterlockOfADirectionHoldsAProgramThatGoesThatWay) {
  build();
  home_machine();
  in("x_free_p", 0);
  ASSERT_EQ(start_program("G90 G53 G0 X-50.\nG53 G0 X50. Y20.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return out().source.line == 2 && out().cause == NC_CAUSE_INTERLOCK; }, 5000), 0);
  steps(100);
  EXPECT_NEAR(place(kX), -50, 0.25) << "the way there was free; what it goes until the path stands";
  const double stands = place(kX);
  steps(1000);
  EXPECT_NEAR(place(kX), stands, 1e-6) << "it waits, and does not creep";
  EXPECT_EQ(out().state, NC_STATE_RUNNING);
  for (int n = 0; n < 10; ++n) {
    in("x_go", 0);
    steps(50);
    ASSERT_EQ(out().state, NC_STATE_HOLD);
    in("x_go", 1);
    steps(5);
    ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
    steps(50);
  }
  EXPECT_NEAR(place(kX), stands, 1e-6) << "nor with each start behind a feed hold";
  in("x_free_p", 1);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }, 5000), 0);
  steps(30);
  EXPECT_NEAR(place(kX), 50, 5e-3);
  expect_limits_kept();
}

// ---- drive and brake ----

TEST_F(Guard, TheBrakeOpensWhenTheDriveHoldsAndTheAxisWaitsForIt) {
  build(toml(), 0);
  steps(1);
  EXPECT_FALSE(brake_open());
  ASSERT_GE(until([&] { return brake_open(); }, 10), 2);
  manual_mode();
  EXPECT_EQ(ask(CommandKind::kStep, kZ, 1), Answer::kDrivesOff) << "the brake opens yet";
  EXPECT_EQ(ask(CommandKind::kStep, kX, 1), Answer::kDone) << "another axis has none";
  steps(150);
  EXPECT_NEAR(place(kZ), 3, 1e-6) << "it has not fallen";
  EXPECT_EQ(ask(CommandKind::kStep, kZ, 1), Answer::kDone);
}

TEST_F(Guard, WithItsServoOffAVerticalAxisIsHeldByItsBrake) {
  build();
  home_machine();
  const double stands = place(kZ);
  in("z_servo_off", 1);
  ASSERT_GE(until([&] { return !brake_open(); }, 10), 0);
  EXPECT_EQ(measured->last.off, 0u) << "the drive holds until the brake does";
  ASSERT_GE(until([&] { return measured->last.off == 1u << kZ; }, 400), 0);
  steps(500);
  EXPECT_NEAR(place(kZ), stands, 1e-6);
  EXPECT_EQ(ask(CommandKind::kStep, kZ, 1), Answer::kDrivesOff);
  EXPECT_EQ(start_program("G0 X1.\nM30\n"), Answer::kDrivesOff);
  manual_mode();
  EXPECT_EQ(ask(CommandKind::kStep, kX, 1), Answer::kDone) << "another axis goes";
  steps(500);
  in("z_servo_off", 0);
  ASSERT_GE(until([&] { return brake_open(); }, 400), 0);
  EXPECT_EQ(measured->last.off, 0u);
  EXPECT_EQ(ask(CommandKind::kStep, kZ, 1), Answer::kDrivesOff) << "the brake opens yet";
  steps(150);
  EXPECT_NEAR(place(kZ), stands, 1e-6);
  EXPECT_EQ(ask(CommandKind::kStep, kZ, 1), Answer::kDone);
  steps(500);
  EXPECT_NEAR(place(kZ), stands + 1, 1e-3);
  EXPECT_EQ(flags().homed, 7u);
  expect_limits_kept();
}

TEST_F(Guard, InAProgramTheServoGoesOffAtItsEnd) {
  build();
  home_machine();
  ASSERT_EQ(start_program("G90 G53 G0 X100.\nM30\n"), Answer::kDone);
  steps(100);
  ASSERT_EQ(out().state, NC_STATE_RUNNING);
  in("z_servo_off", 1);
  steps(100);
  EXPECT_TRUE(brake_open());
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }, 5000), 0);
  ASSERT_GE(until([&] { return measured->last.off == 1u << kZ; }, 500), 0);
}

TEST_F(Guard, AFaultOfAnotherDriveClosesTheBrakeFirst) {
  build();
  home_machine();
  const double stands = place(kZ);
  machine->fail_drive(0, kX, true);
  steps(5);
  EXPECT_FALSE(brake_open());
  EXPECT_TRUE(measured->last.enable);
  EXPECT_EQ(measured->last.off, 0b011u) << "Z holds";
  steps(300);
  EXPECT_FALSE(measured->last.enable);
  EXPECT_NEAR(place(kZ), stands, 1e-3) << "it has not fallen";
  machine->fail_drive(0, kX, false);
  reset();
  ASSERT_GE(until([&] { return brake_open(); }, 400), 0);
  steps(200);
  EXPECT_NEAR(place(kZ), stands, 1e-3);
}

TEST_F(Guard, ALostBusClosesTheBrakeAndLosesThePositions) {
  build();
  home_machine();
  machine->fail_bus(true);
  steps(3);
  EXPECT_EQ(alarm().substr(0, 3), "R14");
  EXPECT_FALSE(measured->last.enable);
  EXPECT_EQ(flags().brake_open, 0u);
  EXPECT_EQ(flags().homed, 0u);
  const double shown = runtime->snapshot().system[0].actual.v[kX];
  steps(100);
  EXPECT_EQ(runtime->snapshot().system[0].actual.v[kX], shown) << "the last that was known";
  machine->fail_bus(false);
  steps(200);
  reset();
  steps(200);
  EXPECT_EQ(start_program("G0 X1.\nM30\n"), Answer::kNotHomed);
}

TEST_F(Guard, AFollowingErrorStopsAndLosesNoPosition) {
  build(changed({{"servo_lag_ms = 2.0", "servo_lag_ms = 2.0\nfollowing_error_limit = 2.0"}}));
  home_machine();
  ASSERT_EQ(start_program("G90 G53 G0 X100.\nM30\n"), Answer::kDone);
  steps(100);
  machine->block_axis(0, kX, true);
  ASSERT_GE(until([&] { return stopped_by_alarm(); }, 1000), 0);
  EXPECT_EQ(alarm().substr(0, 42), "R11 Following error beyond its limit, axis");
  ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0);
  EXPECT_TRUE(measured->last.enable) << "drives hold";
  EXPECT_TRUE(brake_open());
  machine->block_axis(0, kX, false);
  steps(50);
  reset();
  EXPECT_EQ(flags().homed, 7u);
}

// The contact of an emergency stop chain or of a door that is an alarm of the machine, and scans that come too late: all on their paths, drives hold, nothing is lost, and a
// reset alone moves nothing.
TEST_F(Guard, AnAlarmOfTheMachineAndOneOfTheScanStopOnThePathWithTheDrivesOn) {
  for (const bool late : {false, true}) {
    SCOPED_TRACE(late ? "late scans" : "plc.alarm.1");
    build(changed({{"\"plc.cycle_start\" = \"start\"", "\"plc.alarm.1\" = \"start\""}}) + "[scheduling]\noverrun = \"alarm\"\noverrun_limit = 3\n");
    home_machine();
    ASSERT_EQ(start_program("G90 G53 G1 X200. Y100. F6000.\nM30\n"), Answer::kDone);
    ASSERT_GE(until([&] { return place(kX) > 50; }, 5000), 0);
    if (late) {
      clock.advance(5'000'000);
      steps(2);
    } else {
      in("start", 1);
    }
    ASSERT_GE(until([&] { return stopped_by_alarm(); }, 10), 0);
    ASSERT_GE(until([&] { return out().distance_zero && out().state == NC_STATE_ALARM; }, 500), 0);
    steps(50);
    EXPECT_EQ(alarm().substr(0, 3), late ? "R10" : "R16");
    EXPECT_NEAR(out().command.v[kX], 2 * out().command.v[kY], 1e-6) << "on the path";
    EXPECT_TRUE(measured->last.enable) << "drives hold";
    EXPECT_TRUE(brake_open());
    EXPECT_EQ(flags().homed, 7u);
    if (!late) {
      ASSERT_EQ(ask(CommandKind::kReset), Answer::kDone);
      steps(500);
      EXPECT_TRUE(stopped_by_alarm()) << "the contact is still open";
      in("start", 0);
      steps(500);
      EXPECT_TRUE(stopped_by_alarm()) << "and its closing alone does nothing";
    }
    const nc_axes stands = out().command;
    reset();
    steps(1000);
    EXPECT_FALSE(stopped_by_alarm());
    EXPECT_EQ(out().state, NC_STATE_IDLE);
    for (const unsigned axis : {kX, kY, kZ}) EXPECT_EQ(out().command.v[axis], stands.v[axis]);
    expect_limits_kept();
  }
}

// Each column of docs/safety.md for alarms that stop on the path: drives hold and brakes stay open, outputs are left alone, nothing is lost, nothing starts before the reset, which moves nothing.
TEST_F(Guard, AnAlarmThatStopsOnThePathLeavesDrivesBrakesAndOutputs) {
  struct Cause {
    const char* says;
    std::vector<std::pair<const char*, std::uint32_t>> inputs;  // contacts that say so; empty: the measured speed of the spindle is no number
  };
  const auto set = [this](const Cause& cause, bool comes) {
    measured->lies = comes && cause.inputs.empty();
    for (const auto& [name, value] : cause.inputs) in(name, comes ? value : 1 - value);
  };
  for (const Cause& cause : {Cause{"R22 Limit switch in +, axis X", {{"x_max", 0}}}, {"R22 Limit switches of both ends", {{"y_min", 0}, {"y_max", 0}}}, {"R21 ", {}}, {"R16 ", {{"start", 1}}}}) {
    SCOPED_TRACE(cause.says);
    build(changed({{"\"plc.cycle_start\" = \"start\"", "\"plc.alarm.1\" = \"start\""}, {"dog = [-310.0, -290.0]\nminus = -320.0\nplus = 320.0\n", "dog = [-310.0, -290.0]\n"}, {"stands_at = 12.25\nminus = -320.0\nplus = 320.0\n", "stands_at = 12.25\n"},
                   {"homing = { kind = \"limit\", direction = \"+\", fast = 60.0, creep = 3.0, offset = -320.0, order = 2 }\n", ""}}) +
          "[[point]]\nname = \"lamp\"\ndirection = \"output\"\n[macro_interface]\n\"#1100\" = \"lamp\"\n");
    for (const char* contact : {"x_min", "x_max", "y_min", "y_max"}) in(contact, 1);
    steps(5);
    reset();
    home_machine();
    ASSERT_EQ(start_program("#1100=1\nG90 G53 G0 X0 Y0\nG53 G1 X200. Y100. F6000.\nM30\n"), Answer::kDone);
    ASSERT_GE(until([&] { return place(kX) > 50; }, 8000), 0) << alarm();
    set(cause, true);
    ASSERT_GE(until([&] { return stopped_by_alarm(); }, 10), 0);
    ASSERT_GE(until([&] { return out().distance_zero && out().state == NC_STATE_ALARM; }, 500), 0);
    steps(300);
    EXPECT_EQ(alarm().rfind(cause.says, 0), 0u) << alarm();
    EXPECT_NEAR(out().command.v[kX], 2 * out().command.v[kY], 1e-6) << "on the path";
    EXPECT_TRUE(measured->last.enable && measured->last.off == 0) << "drives hold";
    EXPECT_TRUE(brake_open());
    EXPECT_EQ(machine->outputs().value[point_of("lamp")], 1u);
    EXPECT_EQ(flags().homed, 7u);
    EXPECT_EQ(ask(CommandKind::kCycleStart), Answer::kAlarmActive);
    const nc_axes stands = out().command;
    set(cause, false);
    steps(300);
    EXPECT_TRUE(stopped_by_alarm() || alarm().empty());
    reset();
    steps(300);
    EXPECT_EQ(alarm(), "");
    for (const unsigned axis : {kX, kY, kZ}) EXPECT_EQ(out().command.v[axis], stands.v[axis]);
    EXPECT_EQ(machine->outputs().value[point_of("lamp")], 1u);
    EXPECT_EQ(start_program("G90 G53 G0 X10.\nM30\n"), Answer::kDone);
    expect_limits_kept();
  }
}

TEST_F(Guard, BehindPowerOnNothingMoves) {
  build();
  const double x = place(kX), y = place(kY), z = place(kZ);
  steps(3000);
  EXPECT_NEAR(place(kX), x, 1e-9);
  EXPECT_NEAR(place(kY), y, 1e-9);
  EXPECT_NEAR(place(kZ), z, 1e-9);
  EXPECT_TRUE(brake_open()) << "and the drives hold";
}

TEST_F(Guard, WhenTheControlEndsTheAxesComeToRestAndTheBrakeCloses) {
  build();
  home_machine();
  ASSERT_EQ(start_program("G90 G53 G0 X200.\nM30\n"), Answer::kDone);
  steps(200);
  ASSERT_FALSE(out().distance_zero);
  ASSERT_EQ(ask(CommandKind::kEnd), Answer::kDone);
  ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0);
  EXPECT_LT(place(kX), 199);
  runtime->stop();
  EXPECT_FALSE(brake_open());
  expect_limits_kept();
}

TEST_F(Guard, AFaultOfItsOwnDriveClosesTheBrakeAtOnce) {
  build();
  home_machine();
  const double stands = place(kZ);
  machine->fail_drive(0, kZ, true);
  steps(3);
  EXPECT_FALSE(brake_open());
  EXPECT_FALSE(measured->last.enable);
  steps(500);
  // Until the brake of the simulated machine holds it falls: 50 ms of free fall.
  EXPECT_GT(place(kZ), stands - 9810 * 0.06 * 0.06 / 2 - 1);
}

}  // namespace
