// SPDX-License-Identifier: Apache-2.0
// The contract of a scan, with an NC that only records: order, commands, modes, alarms, overruns.
#include "runtime/scan.hpp"

#include <gtest/gtest.h>

#include "fake_nc.hpp"
#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::AlarmId;
using nc::rt::Answer;
using nc::rt::Command;
using nc::rt::CommandKind;
using nc::rt::Mode;
using nc::rt::OverrunReaction;

// The simulated machine with a log in front of it.
class LoggedHal final : public nc::hal::Hal {
 public:
  LoggedHal(const nc::rt::Config& config, std::vector<std::string>* log)
      : sim(config.sim, config.points), log_(log) {}
  bool start(const nc::hal::PointImage& initial, std::string* error) override {
    if (fail_start) *error = "no machine";
    return !fail_start && sim.start(initial, error);
  }
  void read(nc::hal::Feedback* feedback, nc::hal::PointImage* image) noexcept override {
    log_->push_back("read");
    sim.read(feedback, image);
  }
  void write(const nc::hal::Command& command, const nc::hal::PointImage& image) noexcept override {
    log_->push_back("write");
    written = command;
    image_written = image;
    sim.write(command, image);
    if (on_write) on_write();
  }
  void stop() noexcept override {
    ++stops;
    sim.stop();
  }
  nc::hal::SimMachine sim;
  nc::hal::Command written{};
  nc::hal::PointImage image_written{};
  std::function<void()> on_write;
  bool fail_start = false;
  unsigned stops = 0;

 private:
  std::vector<std::string>* log_;
};

class LoggedLadder final : public nc::rt::LadderHook {
 public:
  explicit LoggedLadder(std::vector<std::string>* log) : log_(log) {}
  void scan(nc::rt::LadderImage* image) noexcept override {
    log_->push_back("ladder");
    if (on_scan) on_scan(image);
  }
  std::function<void(nc::rt::LadderImage*)> on_scan;

 private:
  std::vector<std::string>* log_;
};

class ScanTest : public testing::Test {
 protected:
  void build(const std::string& more = "") {
    config = nc::test::parse_or_fail(nc::test::base_toml() + more);
    hal = std::make_unique<LoggedHal>(config, &log);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, hal.get(), &ladder, &nc}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void start_program() {
    ASSERT_EQ(runtime->select_program(0), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    ASSERT_EQ(state(), NC_STATE_RUNNING);
  }
  Answer set_mode(Mode mode) {
    return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode));
  }
  Answer jog(CommandKind kind, unsigned axis, double value) {
    Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    return runtime->execute(command);
  }
  int state() { return runtime->snapshot().system[0].nc.state; }
  void steps(unsigned n) {
    for (unsigned i = 0; i < n; ++i) runtime->step();
  }

  std::vector<std::string> log;
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<LoggedHal> hal;
  LoggedLadder ladder{&log};
  nc::test::FakeNc nc;
  std::unique_ptr<nc::rt::Runtime> runtime;
};

TEST_F(ScanTest, OrderIsInputsLadderNcOutputsSnapshot) {
  nc.log = &log;
  build();
  std::uint64_t snapshot_in_write = 99;
  hal->on_write = [&] { snapshot_in_write = runtime->snapshot().scan; };
  runtime->step();
  EXPECT_EQ(log, (std::vector<std::string>{"read", "ladder", "nc", "write"}));
  EXPECT_EQ(snapshot_in_write, 0u) << "the snapshot comes after the outputs";
  EXPECT_EQ(runtime->snapshot().scan, 1u);
}

TEST_F(ScanTest, AnInputReachesLadderAndNcInTheSameScan) {
  build();
  std::uint32_t ladder_saw = 9;
  ladder.on_scan = [&](nc::rt::LadderImage* image) { ladder_saw = image->points->value[0]; };
  hal->sim.set_input(0, 1);
  runtime->step();
  EXPECT_EQ(ladder_saw, 1u);
  EXPECT_EQ(nc.last_in.input[0], 1u) << "#1000";
}

TEST_F(ScanTest, WhatTheLadderWritesTheNcGetsAndTheMachineSees) {
  build();
  ladder.on_scan = [](nc::rt::LadderImage* image) {
    image->points->value[1] = 1;  // in1 -> #1001
    image->points->value[3] = 1;  // out0
    image->nc_in[0].interlock = true;
    image->nc_in[0].feed_override = 0.25;
  };
  runtime->step();
  EXPECT_EQ(nc.last_in.input[0], 2u);
  EXPECT_TRUE(nc.last_in.interlock);
  EXPECT_DOUBLE_EQ(nc.last_in.feed_override, 0.25);
  EXPECT_EQ(hal->image_written.value[3], 1u) << "in the same scan";
}

TEST_F(ScanTest, TheLadderSeesTheNcOutputsOfTheScanBefore) {
  build();
  std::vector<std::uint32_t> seen;
  ladder.on_scan = [&](nc::rt::LadderImage* image) { seen.push_back(image->nc_out[0].m); };
  nc.out.m = 8;
  steps(2);
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{0, 8}));
}

TEST_F(ScanTest, CommandedPositionGoesOutInTheSameScan) {
  build();
  start_program();
  runtime->step();
  EXPECT_DOUBLE_EQ(hal->written.system[0].position.v[0], nc.out.command.v[0]);
  EXPECT_GT(nc.out.command.v[0], 0);
}

TEST_F(ScanTest, OutputsOfTheNcReachTheirPoints) {
  build();
  nc.out.output[0] = 1;
  nc.out.output[1] = 77;
  nc.out.output_written[0] = 1;
  nc.out.output_written[1] = ~0u;
  runtime->step();
  EXPECT_EQ(hal->image_written.value[3], 1u);
  EXPECT_EQ(hal->image_written.value[4], 77u);
  EXPECT_EQ(runtime->snapshot().interface_output[1], 77u);
}

TEST_F(ScanTest, CycleStartNeedsAProgram) {
  build();
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram);
  start_program();
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kAlreadyRunning);
}

TEST_F(ScanTest, HoldAndResume) {
  build();
  start_program();
  EXPECT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
  steps(2);
  EXPECT_EQ(state(), NC_STATE_HOLD);
  EXPECT_FALSE(nc.last_in.feed_hold) << "released once the path holds, or cycle start could not act";
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  EXPECT_EQ(state(), NC_STATE_RUNNING);
}

TEST_F(ScanTest, ResetGoesThroughTheFeederAndTheNextStartWorks) {
  build();
  start_program();
  nc.reset_status = NC_E_STATE;  // the interpreter is not ready yet
  EXPECT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(5);
  EXPECT_TRUE(runtime->snapshot().resetting);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kResetting);
  nc.reset_status = NC_OK;
  steps(3);
  EXPECT_FALSE(runtime->snapshot().resetting);
  EXPECT_FALSE(nc.last_in.reset);
  EXPECT_GE(nc.resets, 2u);
  EXPECT_EQ(state(), NC_STATE_IDLE);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  EXPECT_EQ(state(), NC_STATE_RUNNING);
}

TEST_F(ScanTest, AnEndedProgramIsRewoundAndMayStartAgain) {
  nc.cycles = 5;
  build();
  start_program();
  steps(10);
  EXPECT_EQ(state(), NC_STATE_IDLE);
  EXPECT_EQ(runtime->info().system[0].runs, 1u);
  EXPECT_EQ(nc.selects, 2u) << "selected again by M30";
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(10);
  EXPECT_EQ(runtime->info().system[0].runs, 2u);
}

TEST_F(ScanTest, MdiBlocksRunOnce) {
  nc.cycles = 5;
  build();
  EXPECT_EQ(runtime->load_mdi("G0X1\n"), Answer::kNotInThisMode);
  EXPECT_EQ(set_mode(Mode::kMdi), Answer::kDone);
  EXPECT_EQ(runtime->select_program(0), Answer::kNotInThisMode);
  EXPECT_EQ(runtime->load_mdi("G0X1\n"), Answer::kDone);
  EXPECT_EQ(nc.mdi, "G0X1\n");
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  EXPECT_EQ(runtime->load_mdi("G0X2\n"), Answer::kNotWhileRunning);
  steps(10);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram);
}

TEST_F(ScanTest, WhatIsLoadedStartsInItsOwnModeOnly) {
  build();
  EXPECT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(set_mode(Mode::kMdi), Answer::kDone);
  steps(3);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram) << "the part program in MDI mode";
  EXPECT_EQ(runtime->load_mdi("G0X9\n"), Answer::kDone);
  EXPECT_EQ(set_mode(Mode::kAuto), Answer::kDone);
  steps(3);
  EXPECT_TRUE(runtime->info().system[0].selected.any);
  EXPECT_FALSE(runtime->info().system[0].selected.mdi) << "forgotten MDI blocks are gone";
  EXPECT_EQ(nc.selects, 2u) << "the part program is selected again";
  EXPECT_EQ(set_mode(Mode::kMdi), Answer::kDone);
  steps(3);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram) << "and do not come back";
}

TEST_F(ScanTest, ThePartProgramIsThereAgainAfterMdi) {
  nc.cycles = 5;
  build();
  EXPECT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(set_mode(Mode::kMdi), Answer::kDone);
  EXPECT_EQ(runtime->load_mdi("G0X1\n"), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(10);
  EXPECT_EQ(set_mode(Mode::kAuto), Answer::kDone);
  steps(3);
  EXPECT_EQ(nc.selects, 2u);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
}

TEST_F(ScanTest, ModeChangesOnlyAtRestWithoutAProgram) {
  build();
  start_program();
  EXPECT_EQ(set_mode(Mode::kManual), Answer::kNotWhileRunning);
  EXPECT_EQ(jog(CommandKind::kJog, 0, 1), Answer::kNotInThisMode);
  runtime->execute(CommandKind::kReset);
  steps(5);
  EXPECT_EQ(set_mode(Mode::kManual), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNotInThisMode);
  EXPECT_EQ(runtime->snapshot().mode, Mode::kManual);
  EXPECT_EQ(runtime->execute(CommandKind::kSetMode, 0, 7), Answer::kOutOfRange);
}

TEST_F(ScanTest, AJogStopsByItselfWhenItIsNotRepeated) {
  build();
  set_mode(Mode::kManual);
  EXPECT_EQ(jog(CommandKind::kJog, 0, 10), Answer::kDone);
  EXPECT_EQ(nc.last_in.manual[0].kind, NC_MANUAL_JOG);
  steps(nc::rt::kJogDeadManScans + 2);
  EXPECT_EQ(nc.last_in.manual[0].kind, NC_MANUAL_NONE);
  EXPECT_EQ(jog(CommandKind::kJog, 0, 1000), Answer::kOutOfRange);
  EXPECT_EQ(jog(CommandKind::kJog, 3, 1), Answer::kAxisUnknown);
  jog(CommandKind::kJog, 0, 10);
  EXPECT_EQ(jog(CommandKind::kJog, 0, 0), Answer::kDone);
  runtime->step();
  EXPECT_EQ(nc.last_in.manual[0].kind, NC_MANUAL_NONE);
}

TEST_F(ScanTest, OverridesAndSwitchesReachTheNc) {
  build();
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 1.5), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 2.5), Answer::kOutOfRange);
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, std::nan("")), Answer::kOutOfRange);
  EXPECT_EQ(runtime->execute(CommandKind::kRapidOverride, 0.25), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kSingleBlock, 0, 1), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kOptionalStop, 0, 1), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kSwitches, 0, 6), Answer::kDone);
  EXPECT_DOUBLE_EQ(nc.last_in.feed_override, 1.5);
  EXPECT_DOUBLE_EQ(nc.last_in.rapid_override, 0.25);
  EXPECT_TRUE(nc.last_in.single_block);
  EXPECT_TRUE(nc.last_in.optional_stop);
  EXPECT_EQ(nc.switches_seen, 6u);
}

TEST_F(ScanTest, FollowingErrorStopsAndHoldsUntilResetAndCauseGone) {
  build();
  config.sim.axis[0][0].following_error_limit = 1.0;
  runtime.reset();
  hal = std::make_unique<LoggedHal>(config, &log);
  std::vector<nc::rt::ConfigError> errors;
  runtime = nc::rt::Runtime::create(config, {&clock, hal.get(), &ladder, &nc}, &errors);
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error));
  start_program();
  hal->sim.block_axis(0, 0, true);
  steps(200);
  auto snapshot = runtime->snapshot();
  ASSERT_GE(snapshot.alarms.count, 1u);
  EXPECT_EQ(snapshot.alarms.alarm[0].id, AlarmId::kFollowingError);
  EXPECT_EQ(snapshot.alarms.alarm[0].axis, 0);
  EXPECT_TRUE(nc.last_in.alarm);
  EXPECT_EQ(state(), NC_STATE_ALARM);
  EXPECT_NE(runtime->alarm_text(snapshot.alarms.alarm[0]).find("R11"), std::string::npos);
  EXPECT_NE(runtime->alarm_text(snapshot.alarms.alarm[0]).find("axis X"), std::string::npos);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kAlarmActive);
  runtime->execute(CommandKind::kReset);
  steps(10);
  EXPECT_EQ(runtime->snapshot().alarms.count, 1u) << "the cause is still there";
  hal->sim.block_axis(0, 0, false);
  steps(50);
  runtime->execute(CommandKind::kReset);
  steps(10);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
}

TEST_F(ScanTest, DriveFaultAndLostBusSwitchTheDrivesOff) {
  build();
  start_program();
  hal->sim.fail_drive(0, 2, true);
  steps(2);
  EXPECT_EQ(runtime->snapshot().alarms.alarm[0].id, AlarmId::kDriveFault);
  EXPECT_FALSE(hal->written.system[0].enable);
  hal->sim.fail_drive(0, 2, false);
  runtime->execute(CommandKind::kReset);
  steps(300);  // until the axes stand
  EXPECT_TRUE(hal->written.system[0].enable);
  hal->sim.fail_bus(true);
  steps(2);
  ASSERT_EQ(runtime->snapshot().alarms.count, 1u);
  EXPECT_EQ(runtime->snapshot().alarms.alarm[0].id, AlarmId::kHalLost);
  EXPECT_FALSE(hal->written.system[0].enable);
}

TEST_F(ScanTest, ACommandOutsideTheSoftLimitsIsAnAlarmComingBackIsNot) {
  build();
  nc.out.command.v[0] = 499.99;
  start_program();
  steps(5);
  ASSERT_EQ(runtime->snapshot().alarms.count, 1u);
  EXPECT_EQ(runtime->snapshot().alarms.alarm[0].id, AlarmId::kSoftLimit);
  EXPECT_EQ(state(), NC_STATE_ALARM);
  runtime->execute(CommandKind::kReset);
  steps(5);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
  nc.step = -0.001;
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(3);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u) << "still outside, on the way back";
}

TEST_F(ScanTest, OverrunsAreCountedAndMissedSlotsSkipped) {
  build("[scheduling]\noverrun = \"count\"\n");
  start_program();
  const double before = nc.out.command.v[0];
  const std::uint64_t scan = runtime->snapshot().scan;
  hal->on_write = [&] { clock.advance(5'300'000); };  // this scan takes 5.3 periods
  runtime->step();
  hal->on_write = nullptr;
  runtime->step();
  const auto& statistics = runtime->statistics();
  EXPECT_EQ(statistics.overruns.load(), 1u);
  EXPECT_EQ(statistics.missed_slots.load(), 4u);
  EXPECT_EQ(runtime->snapshot().scan, scan + 2);
  EXPECT_DOUBLE_EQ(nc.out.command.v[0], before + 2 * nc.step)
      << "the path's time stood still in the missed slots";
  steps(20);
  EXPECT_EQ(statistics.overruns.load(), 1u) << "back on the grid";
  EXPECT_EQ(clock.now_ns() % 1'000'000, 0);
}

TEST_F(ScanTest, LateByLessThanAPeriodMissesNoSlot) {
  build("[scheduling]\noverrun = \"count\"\n");
  hal->on_write = [&] { clock.advance(1'400'000); };
  runtime->step();
  hal->on_write = nullptr;
  runtime->step();
  EXPECT_EQ(runtime->statistics().overruns.load(), 1u);
  EXPECT_EQ(runtime->statistics().missed_slots.load(), 0u);
  EXPECT_GE(runtime->statistics().jitter.max_ns(), 400'000u * 9 / 10) << "the second scan woke up late";
}

TEST_F(ScanTest, OverrunReactionFeedHold) {
  build("[scheduling]\noverrun = \"feed_hold\"\noverrun_limit = 3\n");
  start_program();
  hal->on_write = [&] { clock.advance(3'100'000); };  // 2 slots missed
  runtime->step();
  hal->on_write = nullptr;
  steps(2);
  EXPECT_EQ(state(), NC_STATE_RUNNING);
  hal->on_write = [&] { clock.advance(2'100'000); };  // the third
  runtime->step();
  hal->on_write = nullptr;
  steps(2);
  EXPECT_EQ(state(), NC_STATE_HOLD);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
}

TEST_F(ScanTest, OverrunReactionAlarm) {
  build("[scheduling]\noverrun = \"alarm\"\noverrun_limit = 1\n");
  start_program();
  hal->on_write = [&] { clock.advance(2'100'000); };
  runtime->step();
  hal->on_write = nullptr;
  steps(2);
  ASSERT_GE(runtime->snapshot().alarms.count, 1u);
  EXPECT_EQ(runtime->snapshot().alarms.alarm[0].id, AlarmId::kScanOverrun);
  EXPECT_EQ(state(), NC_STATE_ALARM);
  runtime->execute(CommandKind::kReset);
  steps(5);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
}

TEST_F(ScanTest, AFailedStartLeavesTheOutputsSafe) {
  build();
  auto broken = std::make_unique<LoggedHal>(config, &log);
  broken->fail_start = true;
  std::vector<nc::rt::ConfigError> errors;
  auto other = nc::rt::Runtime::create(config, {&clock, broken.get(), &ladder, &nc}, &errors);
  std::string error;
  EXPECT_FALSE(other->start_stepping(&error));
  EXPECT_EQ(error, "no machine");
  EXPECT_EQ(broken->stops, 1u);
  EXPECT_EQ(other->execute(CommandKind::kCycleStart), Answer::kNoAnswer);
}

TEST_F(ScanTest, RunsInTwoThreads) {
  build("[scheduling]\noverrun = \"count\"\n");
  runtime.reset();
  nc.cycles = 20;
  nc::rt::RealClock real;
  std::vector<nc::rt::ConfigError> errors;
  runtime = nc::rt::Runtime::create(config, {&real, hal.get(), nullptr, &nc}, &errors);
  std::string error;
  ASSERT_TRUE(runtime->start(&error)) << error;
  EXPECT_GT(runtime->first_scan_ns(), 0);
  EXPECT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  for (int i = 0; i < 5000 && runtime->info().system[0].runs == 0; ++i) real.sleep_until(real.now_ns() + 1'000'000);
  EXPECT_EQ(runtime->info().system[0].runs, 1u);
  runtime->stop();
  EXPECT_TRUE(hal->sim.stopped());
  EXPECT_GE(runtime->statistics().execution.count(), 20u);
}

}  // namespace
