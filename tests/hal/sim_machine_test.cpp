// SPDX-License-Identifier: Apache-2.0
// The simulated machine compared with its model: servo lag, following error, spindle, FIN handshake, solids, points.
#include "hal/sim/sim_machine.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using nc::hal::Command;
using nc::hal::Feedback;
using nc::hal::PointDirection;
using nc::hal::PointImage;
using nc::hal::PointType;
using nc::hal::SimConfig;
using nc::hal::SimMachine;

constexpr double kCycle = 0.001;

// A machine with its image, driven scan by scan.
struct Bench {
  explicit Bench(const SimConfig& config) : machine(config, table()) {
    PointImage initial;
    initial.value[0] = 1;
    std::string error;
    EXPECT_TRUE(machine.start(initial, &error));
    command.system[0].enable = true;
  }
  static nc::hal::PointTable table() {
    nc::hal::PointTable points;
    points.add({"door", PointType::kBit, PointDirection::kInput, 1});
    points.add({"lamp", PointType::kBit, PointDirection::kOutput, 0});
    return points;
  }
  void scan() {
    machine.read(&feedback, &image);
    machine.write(command, image);
  }
  // Scans until FIN or the limit; returns the number of scans.
  unsigned until_fin(unsigned limit) {
    for (unsigned n = 1; n <= limit; ++n) {
      scan();
      machine.read(&feedback, &image);
      if (feedback.system[0].fin) return n;
    }
    return limit + 1;
  }
  SimMachine machine;
  Command command{};
  Feedback feedback{};
  PointImage image{};
};

// A coasting axis loses half of its speed in coast_s * ln 2; when the bus is lost the drives are off.
TEST(SimMachine, WithoutItsDriveAnAxisCoasts) {
  for (const bool bus : {false, true}) {
    SCOPED_TRACE(bus);
    SimConfig config;
    config.axis[0][0].coast_s = 0.03;
    Bench bench(config);
    const double v = 100.0;
    for (unsigned n = 1; n <= 50; ++n) {
      bench.command.system[0].position.v[0] = v * kCycle * n;
      bench.scan();
    }
    const double from = bench.machine.actual(0).v[0];
    bench.command.system[0].enable = bus;
    bench.machine.fail_bus(bus);
    bench.command.system[0].position.v[0] = 0;  // not followed
    bench.scan();
    const double first = bench.machine.actual(0).v[0] - from;
    EXPECT_NEAR(first, v * kCycle * std::exp(-kCycle / 0.03), 1e-9);
    for (unsigned n = 0; n < 1000; ++n) bench.scan();
    EXPECT_NEAR(bench.machine.actual(0).v[0] - from, first / (1 - std::exp(-kCycle / 0.03)), 1e-9);
  }
}

TEST(SimMachine, ServoFollowsARampWithVelocityTimesLag) {
  SimConfig config;
  config.axis[0][0].lag_s = 0.005;
  Bench bench(config);
  const double v = 100.0;
  for (int i = 0; i < 200; ++i) {
    bench.command.system[0].position.v[0] += v * kCycle;
    bench.scan();
  }
  // Discrete form of e = v * lag: the error left after each update is v*T*(1-k)/k with k = 1-exp(-T/lag).
  const double k = 1 - std::exp(-kCycle / 0.005);
  const double error = bench.command.system[0].position.v[0] - bench.machine.actual(0).v[0];
  EXPECT_NEAR(error, v * kCycle * (1 - k) / k, 1e-9);
  EXPECT_NEAR(error, v * 0.005, 0.06);
  for (int i = 0; i < 100; ++i) bench.scan();
  EXPECT_NEAR(bench.machine.actual(0).v[0], bench.command.system[0].position.v[0], 1e-6);
}

TEST(SimMachine, WithoutLagActualIsTheCommandOfTheCycleBefore) {
  Bench bench(SimConfig{});
  bench.command.system[0].position.v[1] = 3.25;
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_DOUBLE_EQ(bench.feedback.system[0].actual.v[1], 0);
  bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_DOUBLE_EQ(bench.feedback.system[0].actual.v[1], 3.25);
}

TEST(SimMachine, AxisThatIsBlockedFaultsAtItsLimit) {
  SimConfig config;
  config.axis[0][2].following_error_limit = 2.0;
  Bench bench(config);
  bench.machine.block_axis(0, 2, true);
  bench.command.system[0].position.v[2] = -1.9;
  bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_EQ(bench.feedback.system[0].following_fault, 0u);
  bench.command.system[0].position.v[2] = -2.1;
  bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_EQ(bench.feedback.system[0].following_fault, 4u);
}

TEST(SimMachine, DisabledDrivesStay) {
  Bench bench(SimConfig{});
  bench.command.system[0].enable = false;
  bench.command.system[0].position.v[0] = 5;
  bench.scan();
  EXPECT_DOUBLE_EQ(bench.machine.actual(0).v[0], 0);
}

TEST(SimMachine, FinComesAfterItsTimeAndDropsWithTheStrobe) {
  SimConfig config;
  config.m_time_s = 0.010;
  Bench bench(config);
  bench.command.system[0].m = 8;
  bench.command.system[0].strobe = 1;
  const unsigned scans = bench.until_fin(100);
  EXPECT_GE(scans, 10u);
  EXPECT_LE(scans, 12u);
  for (int i = 0; i < 5; ++i) bench.scan();
  EXPECT_TRUE(bench.feedback.system[0].fin) << "FIN stays while the strobe is on";
  bench.command.system[0].strobe = 0;
  bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_FALSE(bench.feedback.system[0].fin);
}

TEST(SimMachine, StrobeThatDropsEarlyLeavesNoFinBehind) {
  SimConfig config;
  config.m_time_s = 0.010;
  Bench bench(config);
  bench.command.system[0].m = 8;
  bench.command.system[0].strobe = 1;
  for (int i = 0; i < 4; ++i) bench.scan();
  bench.command.system[0].strobe = 0;  // reset
  for (int i = 0; i < 20; ++i) {
    bench.scan();
    EXPECT_FALSE(bench.feedback.system[0].fin);
  }
  bench.command.system[0].strobe = 1;
  EXPECT_GE(bench.until_fin(100), 10u) << "the next function takes its own whole time";
}

TEST(SimMachine, AStrobeThatFollowsAtOnceMakesFinDropAndTakesItsTime) {
  SimConfig config;
  config.m_time_s = 0.010;
  Bench bench(config);
  auto& command = bench.command.system[0];
  command.m = 8;
  command.strobe = 1;
  command.serial = 5;
  bench.until_fin(100);
  command.strobe = 2;  // S follows M without a scan in between
  command.serial = 7;
  bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_FALSE(bench.feedback.system[0].fin);
  EXPECT_GE(bench.until_fin(100), 9u);
  command.m = 9;  // the same strobe again for another block
  command.strobe = 2;
  command.serial = 9;
  bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_FALSE(bench.feedback.system[0].fin);
}

TEST(SimMachine, SpindleRampsAndFinWaitsForTheSpeed) {
  SimConfig config;
  config.spindle_ramp_rpm_per_s = 10000;
  config.m_time_s = 0.001;
  Bench bench(config);
  auto& command = bench.command.system[0];
  command.spindle_rev_min[0] = 3000;
  command.spindle_selected = 1;
  command.strobe = 2;
  EXPECT_LE(bench.until_fin(20), 4u) << "a standing spindle has nothing to wait for";
  command.strobe = 0;
  bench.scan();
  command.m = 3;
  command.strobe = 1;
  const unsigned scans = bench.until_fin(1000);
  EXPECT_NEAR(scans, 300u, 3);
  EXPECT_NEAR(bench.machine.spindle_rpm(0), 3000, 1e-6);
  const double turns = bench.feedback.system[0].spindle[0].turns;  // its encoder counts with the speed
  EXPECT_TRUE(bench.feedback.system[0].spindle[0].turns_valid);
  EXPECT_GT(turns, 0);
  for (unsigned n = 0; n < 100; ++n) bench.scan();
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_NEAR(bench.feedback.system[0].spindle[0].turns - turns, 50 * kCycle * 100, 1e-9);
  command.strobe = 0;
  bench.scan();
  command.m = 5;
  command.strobe = 1;
  bench.until_fin(1000);
  EXPECT_NEAR(bench.machine.spindle_rpm(0), 0, 1e-6);
}

// Each spindle ramps to its own speed; M03 and M05 act on the spindles that the NC has selected.
TEST(SimMachine, SpindlesTurnApart) {
  SimConfig config;
  config.spindle_count[0] = 2;
  config.spindle_ramp_rpm_per_s = 100000;
  config.m_time_s = 0.001;
  Bench bench(config);
  auto& command = bench.command.system[0];
  const auto code = [&](unsigned m, std::uint8_t selected) {
    command.spindle_selected = selected;
    command.m = m;
    command.strobe = 0;
    bench.scan();
    command.strobe = 1;
    bench.until_fin(1000);
  };
  command.spindle_rev_min[0] = 3000;
  code(3, 1);
  command.spindle_rev_min[1] = 500;
  code(4, 2);
  EXPECT_NEAR(bench.machine.spindle_rpm(0, 0), 3000, 1e-6);
  EXPECT_NEAR(bench.machine.spindle_rpm(0, 1), -500, 1e-6);
  code(5, 1);
  EXPECT_NEAR(bench.machine.spindle_rpm(0, 0), 0, 1e-6);
  EXPECT_NEAR(bench.machine.spindle_rpm(0, 1), -500, 1e-6);
  command.spindle_rev_min[1] = 800;  // constant surface speed
  for (unsigned n = 0; n < 10; ++n) bench.scan();
  EXPECT_NEAR(bench.machine.spindle_rpm(0, 1), -800, 1e-6);
  code(30, 1);
  EXPECT_NEAR(bench.machine.spindle_rpm(0, 1), 0, 1e-6) << "the end stops all of them";
}

// M700 10.5: servo ON stops the spindle at its zero mark, and it is an axis until servo OFF.
TEST(SimMachine, ASpindleIsAnAxisWithItsServo) {
  SimConfig config;
  config.axis_count[0] = 4;
  config.axis_spindle[0][3] = 1;
  config.spindle_ramp_rpm_per_s = 100000;
  config.m_time_s = 0.001;
  Bench bench(config);
  auto& command = bench.command.system[0];
  command.spindle_rev_min[0] = 1234;
  command.spindle_selected = 1;
  command.m = 3;
  command.strobe = 1;
  bench.until_fin(1000);
  command.strobe = 0;
  for (unsigned n = 0; n < 77; ++n) bench.scan();
  const auto& spindle = bench.feedback.system[0].spindle[0];
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_NEAR(bench.machine.actual(0).v[3], 360 * (spindle.turns - std::floor(spindle.turns)), 1e-9) << "the axis is where the spindle is";
  EXPECT_FALSE(spindle.servo_ready || spindle.zero_passed);
  command.servo_on = 1 << 3;
  for (unsigned n = 0; n < 1000 && !spindle.servo_ready; ++n) bench.scan();
  EXPECT_TRUE(spindle.zero_passed);
  EXPECT_EQ(spindle.turns, std::floor(spindle.turns));
  const double mark = spindle.turns;
  EXPECT_EQ(bench.machine.actual(0).v[3], 0);
  command.position.v[3] = 70;  // ignored until the NC says that the position is for the axis
  bench.scan();
  EXPECT_EQ(bench.machine.actual(0).v[3], 0);
  command.servo_ready = 1 << 3;
  for (unsigned n = 0; n < 3; ++n) bench.scan();
  EXPECT_NEAR(bench.machine.actual(0).v[3], 70, 1e-9);
  EXPECT_NEAR(spindle.turns - mark, 70.0 / 360, 1e-9);
  command.servo_on = command.servo_ready = 0;
  for (unsigned n = 0; n < 3; ++n) bench.scan();
  EXPECT_FALSE(spindle.servo_ready);
  EXPECT_NEAR(bench.machine.spindle_rpm(0), 0, 1e-6) << "it turns again with the next M03";
}

TEST(SimMachine, ToolChangeTakesItsTime) {
  SimConfig config;
  config.tool_change_s = 0.5;
  Bench bench(config);
  auto& command = bench.command.system[0];
  command.t = 7;
  command.strobe = 4;
  bench.until_fin(1000);
  EXPECT_EQ(bench.machine.tool(0), 0u) << "T selects, M06 changes";
  command.strobe = 0;
  bench.scan();
  command.m = 6;
  command.strobe = 1;
  EXPECT_NEAR(bench.until_fin(1000), 500u, 3);
  EXPECT_EQ(bench.machine.tool(0), 7u);
}

TEST(SimMachine, SkipIsOnInsideASolid) {
  SimConfig config;
  nc::hal::SimSolid solid;
  solid.signal = 3;
  solid.min[0] = 10;
  solid.max[0] = 20;
  config.solids.push_back(solid);
  Bench bench(config);
  for (const auto& [x, expected] : {std::pair{9.999, 0u}, {10.0, 4u}, {20.0, 4u}, {20.001, 0u}}) {
    bench.command.system[0].position.v[0] = x;
    bench.scan();
    bench.machine.read(&bench.feedback, &bench.image);
    EXPECT_EQ(bench.feedback.system[0].skip, expected) << x;
  }
}

TEST(SimMachine, PointsInputsAreTheMachinesOutputsAreRecorded) {
  Bench bench(SimConfig{});
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_EQ(bench.image.value[0], 1u);
  bench.machine.set_input(0, 0);
  bench.image.value[1] = 1;
  bench.scan();
  EXPECT_EQ(bench.image.value[0], 0u);
  ASSERT_EQ(bench.machine.change_count(), 1u);
  EXPECT_EQ(bench.machine.change(0).point, 1u);
  EXPECT_EQ(bench.machine.change(0).value, 1u);
  bench.machine.stop();
  EXPECT_EQ(bench.machine.outputs().value[1], 0u) << "safe value after the last scan";
}

TEST(SimMachine, LostBusKeepsOldValuesAndSaysSo) {
  Bench bench(SimConfig{});
  bench.machine.fail_bus(true);
  bench.machine.set_input(0, 0);
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_TRUE(bench.feedback.lost);
  EXPECT_EQ(bench.image.value[0], 0u) << "image as it was before: nobody wrote it";
  bench.machine.fail_bus(false);
  bench.machine.set_input(0, 1);
  bench.machine.read(&bench.feedback, &bench.image);
  EXPECT_FALSE(bench.feedback.lost);
  EXPECT_EQ(bench.image.value[0], 1u);
}

}  // namespace
