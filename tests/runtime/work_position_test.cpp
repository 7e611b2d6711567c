// SPDX-License-Identifier: Apache-2.0
// The workpiece position while no program runs: the machine position less the work offset and the tool length in force, from the first
// scan on, whether a program is selected or not.
#include <gtest/gtest.h>

#include "hal/sim/sim_machine.hpp"
#include "runtime/console.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::Command;
using nc::rt::CommandKind;
using nc::rt::Mode;

class WorkPositionTest : public testing::Test {
 protected:
  void SetUp() override {
    config = nc::test::parse_or_fail(nc::test::base_toml() +
                                     "[work_offsets]\nG54 = { X = 10.0, Y = 20.0, Z = -30.0 }\nG55 = { X = 100.0 }\n[tool_offsets]\n1 = 5.0\n");
    hal = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void mode(Mode wanted) {
    ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(wanted)), Answer::kDone);
  }
  void mdi(const std::string& text) {
    mode(Mode::kMdi);
    ASSERT_EQ(runtime->load_mdi(text), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  }
  void to_end() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    for (unsigned i = 0; i < 100000 && runtime->info().system[0].runs == runs; ++i) runtime->step();
    ASSERT_GT(runtime->info().system[0].runs, runs);
    for (unsigned i = 0; i < 5; ++i) runtime->step();
  }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    for (unsigned i = 0; i < 1000 && runtime->snapshot().resetting; ++i) runtime->step();
    for (unsigned i = 0; i < 5; ++i) runtime->step();
  }
  void move_by_hand(CommandKind kind, unsigned axis, double value) {
    mode(Mode::kManual);
    Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    ASSERT_EQ(runtime->execute(command), Answer::kDone);
    runtime->step();
    for (unsigned i = 0; i < 100000 && !runtime->snapshot().system[0].nc.distance_zero; ++i) runtime->step();
    for (unsigned i = 0; i < 50; ++i) runtime->step();
  }
  void expect_zero_at(double x, double y, double z, const char* when) {
    const nc_outputs now = runtime->snapshot().system[0].nc;
    const double zero[] = {x, y, z};
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(now.command.v[a] - now.work.v[a], zero[a], 1e-9) << when << ", axis " << a;
  }

  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<nc::hal::SimMachine> hal;
  std::unique_ptr<nc::rt::Runtime> runtime;
};

TEST_F(WorkPositionTest, FromTheFirstScanOnWithoutAProgram) {
  runtime->step();
  expect_zero_at(10, 20, -30, "first scan");
  EXPECT_NE(nc::rt::progress_line(*runtime, 0).find("X  -10.000"), std::string::npos) << nc::rt::progress_line(*runtime, 0);
}

TEST_F(WorkPositionTest, BeforeTheFirstBlockThatMoves) {
  mdi("G4 X1.\nG0 X1.\n");
  for (unsigned i = 0; i < 100; ++i) runtime->step();
  ASSERT_EQ(runtime->snapshot().system[0].nc.cause, NC_CAUSE_DWELL);
  expect_zero_at(10, 20, -30, "dwell");
}

TEST_F(WorkPositionTest, MovedByHandAndReturnedToTheReference) {
  move_by_hand(CommandKind::kStep, 0, 7);
  EXPECT_NEAR(runtime->snapshot().system[0].nc.command.v[0], 7, 1e-9);
  expect_zero_at(10, 20, -30, "step");
  move_by_hand(CommandKind::kReference, 0, 0);
  EXPECT_NEAR(runtime->snapshot().system[0].nc.command.v[0], 0, 1e-9);
  expect_zero_at(10, 20, -30, "reference");
}

TEST_F(WorkPositionTest, BehindMdiAndItsReset) {
  mdi("G55 G43 H1 G0 X1. Z1.\n");
  to_end();
  expect_zero_at(100, 0, 5, "behind the blocks");
  reset();  // M700: the coordinate system of power on, the tool length is taken off
  expect_zero_at(10, 20, -30, "reset");
  move_by_hand(CommandKind::kStep, 2, -1);
  expect_zero_at(10, 20, -30, "step behind the reset");
}

TEST_F(WorkPositionTest, AnOffsetThatMdiHasChanged) {
  mdi("G10 L2 P1 X11.\n");
  to_end();
  expect_zero_at(11, 20, -30, "G10");
  mode(Mode::kAuto);  // blocks of MDI that ended are gone
  for (unsigned i = 0; i < 5; ++i) runtime->step();
  expect_zero_at(11, 20, -30, "nothing selected");
  reset();
  expect_zero_at(11, 20, -30, "reset");
}

}  // namespace
