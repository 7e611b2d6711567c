// SPDX-License-Identifier: Apache-2.0
// Interruptions of a program: manual motion in a block stop, and drives that were off. The machine must continue from
// where it really is, with every axis within its limits in every scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "test_config.hpp"
#include "walls_machine.hpp"

namespace {

using nc::rt::AlarmId;
using nc::rt::Answer;
using nc::rt::Command;
using nc::rt::CommandKind;
using nc::rt::Mode;

// The watched machine; it also measures the distance that an axis has to catch up when its drive comes on.
class DriveWatch final : public nc::hal::Hal {
 public:
  DriveWatch(const nc::rt::Config& config, nc::test::Recording* recording)
      : machine(config, recording), axes_(config.nc.system[0].axis_count) {}
  bool start(const nc::hal::PointImage& initial, std::string* error) override {
    return machine.start(initial, error);
  }
  void read(nc::hal::Feedback* feedback, nc::hal::PointImage* image) noexcept override {
    machine.read(feedback, image);
  }
  void write(const nc::hal::Command& command, const nc::hal::PointImage& image) noexcept override {
    const nc::hal::SystemCommand& system = command.system[0];
    if (system.enable && !enabled) {
      ++enables;
      for (unsigned a = 0; a < axes_; ++a)
        catch_up = std::max(catch_up, std::abs(system.position.v[a] - machine.sim.actual(0).v[a]));
    }
    enabled = system.enable;
    if (enabled && !watch_limits) machine.take(system.position);
    watch_limits = enabled;
    if (enabled)
      machine.write(command, image);
    else
      machine.sim.write(command, image);
  }
  void stop() noexcept override { machine.stop(); }

  nc::test::WatchedMachine machine;
  bool enabled = true, watch_limits = true;
  unsigned enables = 0;
  double catch_up = 0;  // the largest such distance, mm

 private:
  unsigned axes_;
};

class InterventionTest : public testing::Test {
 protected:
  void build(const nc::rt::Config& wanted) {
    config = wanted;
    hal = std::make_unique<DriveWatch>(config, &recording);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  // These tests look at stops on the path to 1e-9 mm, so they use the law that rounds no corner.
  void build() { build(nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"trapezoid\"\n")); }
  void TearDown() override {
    runtime.reset();
    for (const std::string& violation : recording.violations) ADD_FAILURE() << violation;
  }
  void start(const std::string& source) {
    const std::string& text = texts.emplace_back(source);  // the control reads the text here and copies nothing
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "a.nc", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    press();
  }
  void press() { ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone); }
  void single_block(bool on) { runtime->execute(CommandKind::kSingleBlock, 0, on ? 1 : 0); }
  Answer set_mode(Mode mode) {
    return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode));
  }
  nc_outputs out() { return runtime->snapshot().system[0].nc; }
  void steps(unsigned n) {
    for (unsigned i = 0; i < n; ++i) runtime->step();
  }
  bool until_state(int state, unsigned limit = 20000) {
    for (unsigned i = 0; i < limit && out().state != state; ++i) runtime->step();
    return out().state == state;
  }
  // Presses cycle start and waits for the next stop, which must be in this line.
  bool next_stop_in(std::uint32_t line) {
    const std::uint64_t serial = out().serial;
    press();
    for (unsigned i = 0; i < 20000; ++i) {
      runtime->step();
      if (out().state == NC_STATE_STOPPED && out().serial != serial) return out().source.line == line;
    }
    return false;
  }
  bool to_end(unsigned limit = 100000) {
    const std::uint64_t runs = runtime->info().system[0].runs;
    for (unsigned i = 0; i < limit && runtime->info().system[0].runs == runs; ++i) {
      if (runtime->snapshot().alarmed()) break;
      runtime->step();
    }
    return runtime->info().system[0].runs == runs + 1;
  }
  // Jogs one axis, and waits until it stands again.
  void jog(unsigned axis, double velocity, unsigned scans) {
    Command command;
    command.kind = CommandKind::kJog;
    command.axis = static_cast<std::uint8_t>(axis);
    for (unsigned i = 0; i < scans; i += 50) {
      command.value = velocity;
      ASSERT_EQ(runtime->execute(command), Answer::kDone);
      steps(50);
    }
    command.value = 0;
    ASSERT_EQ(runtime->execute(command), Answer::kDone);
    steps(400);
    ASSERT_TRUE(out().distance_zero);
  }
  // All that an operator does to jog an axis in a block stop.
  void jog_in_stop(unsigned axis, double velocity, unsigned scans = 150) {
    steps(2);  // in the scan of the stop itself the axes have still moved
    ASSERT_EQ(set_mode(Mode::kManual), Answer::kDone);
    jog(axis, velocity, scans);
    ASSERT_EQ(set_mode(Mode::kAuto), Answer::kDone);
  }
  void expect_at(double x, double y, double z) {
    const nc_outputs now = out();
    EXPECT_NEAR(now.command.v[0], x, 1e-9);
    EXPECT_NEAR(now.command.v[1], y, 1e-9);
    EXPECT_NEAR(now.command.v[2], z, 1e-9);
  }
  std::string alarms() {
    std::string text;
    const nc::rt::Snapshot now = runtime->snapshot();
    for (unsigned i = 0; i < now.alarms.count; ++i) text += runtime->alarm_text(now.alarms.alarm[i]) + "; ";
    return text;
  }

  nc::rt::Config config;
  nc::test::Recording recording;
  nc::rt::VirtualClock clock;
  std::unique_ptr<DriveWatch> hal;
  std::unique_ptr<nc::rt::Runtime> runtime;
  std::deque<std::string> texts;
};

// ---- manual motion in a block stop ("manual absolute on") -----------------------------------------------

TEST_F(InterventionTest, TheNextBlockGoesToItsProgrammedEndPointFromWhereTheMachineIs) {
  build();
  single_block(true);
  start("G90 G0 X10. Y20.\nG1 X40. F3000.\nX60. Y30.\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  jog_in_stop(1, 40);
  const double y = out().command.v[1];
  ASSERT_GT(y, 24);
  press();
  ASSERT_TRUE(until_state(NC_STATE_RUNNING));
  ASSERT_TRUE(until_state(NC_STATE_STOPPED)) << alarms();
  expect_at(40, y, 0);  // an axis that is not named stays where it was put
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(60, 30, 0);
}

TEST_F(InterventionTest, AlsoWhenCycleStartComesInTheScanInWhichTheAxisStands) {
  for (const unsigned wait : {0u, 1u, 2u, 3u, 7u}) {
    SCOPED_TRACE(wait);
    build();
    single_block(true);
    start("G90 G0 X10.\nG1 X40. Y5. F3000.\nM30\n");
    ASSERT_TRUE(until_state(NC_STATE_STOPPED));
    jog_in_stop(0, -30);
    steps(wait);
    single_block(false);
    press();
    EXPECT_TRUE(to_end()) << alarms();
    expect_at(40, 5, 0);
    runtime.reset();
  }
}

TEST_F(InterventionTest, AtAProgramStopAndTwiceInOneStop) {
  build();
  start("G90 G0 X10.\nM0\nG1 X40. F3000.\nG2 X60. Y0. I10. J0.\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  jog_in_stop(2, 30);
  jog_in_stop(0, 30);
  const double z = out().command.v[2];
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(60, 0, z);
}

TEST_F(InterventionTest, IncrementalWordsCountFromWhereTheMachineIs) {
  build();
  single_block(true);
  start("G90 G0 X10.\nG91 G1 X5. F3000.\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  jog_in_stop(0, 30);
  const double x = out().command.v[0];
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(x + 5, 0, 0);
}

TEST_F(InterventionTest, WorkOffsetsStayAndVariablesSeeThePosition) {
  build();
  ASSERT_EQ(nc_work_offset_set(runtime->control(), 0, 1, 0, 100), NC_OK);
  single_block(true);
  start("G90 G54 G0 X10.\n#500=#5001\nG1 X40. F3000.\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  expect_at(110, 0, 0);
  jog_in_stop(0, 30);
  const double x = out().command.v[0];
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(140, 0, 0);
  double value = 0;
  bool vacant = true;
  ASSERT_EQ(nc_variable_get(runtime->control(), 0, 500, &value, &vacant), NC_OK);
  EXPECT_NEAR(value, x - 100, 1e-9);
}

TEST_F(InterventionTest, UnderRadiusCompensationTheContourIsReachedAgain) {
  build();
  for (const nc_tool_column column : {NC_TOOL_LENGTH, NC_TOOL_RADIUS})
    ASSERT_EQ(nc_tool_offset_set(runtime->control(), 1, column, 3), NC_OK);
  single_block(true);
  start("G90 G0 X0. Y0.\nG41 D1 G1 X10. F3000.\nY30.\nX50.\nY-10.\nG40 X0.\nM30\n");
  for (unsigned block = 0; block < 3; ++block) {  // behind Y30.
    ASSERT_TRUE(until_state(NC_STATE_STOPPED));
    if (block < 2) {
      press();
      ASSERT_TRUE(until_state(NC_STATE_RUNNING));
    }
  }
  const nc_axes before = out().command;
  jog_in_stop(0, -30);
  press();
  ASSERT_TRUE(until_state(NC_STATE_RUNNING));
  ASSERT_TRUE(until_state(NC_STATE_STOPPED)) << alarms();
  EXPECT_NEAR(out().command.v[1], before.v[1], 1e-6) << "3 mm above the programmed X50. line";
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(0, -10, 0);
}

TEST_F(InterventionTest, InsideALoopAndASubProgram) {
  build();
  single_block(true);
  start(
      "G90 G0 X10.\n#1=0\nWHILE [#1 LT 3] DO1\n#1=#1+1\nM98 P77\nEND1\nG90 G1 X0. F3000.\nM30\nO77\n"
      "G91 G1 Y2. F3000.\nY3.\nM99\n");
  double moved = 0;
  for (unsigned stop = 0; stop < 60 && runtime->info().system[0].runs == 0; ++stop) {
    ASSERT_TRUE(out().state == NC_STATE_IDLE || until_state(NC_STATE_STOPPED)) << alarms();
    if (out().state != NC_STATE_STOPPED) break;
    if (stop % 3 == 1) {
      const double y = out().command.v[1];
      jog_in_stop(1, 20, 50);
      moved += out().command.v[1] - y;
    }
    press();
    for (unsigned i = 0; i < 20 && out().state == NC_STATE_STOPPED; ++i) runtime->step();
    for (unsigned i = 0; i < 20000 && out().state == NC_STATE_RUNNING; ++i) runtime->step();
  }
  steps(20);
  EXPECT_EQ(runtime->info().system[0].runs, 1u) << alarms();
  EXPECT_GT(moved, 1);
  expect_at(0, 15 + moved, 0);
}

TEST_F(InterventionTest, ResetAfterTheJogAndResetWithCycleStart) {
  build();
  for (const bool at_once : {false, true}) {
    single_block(true);
    start("G90 G0 X10.\nG1 X40. F3000.\nM30\n");
    ASSERT_TRUE(until_state(NC_STATE_STOPPED));
    jog_in_stop(0, 30);
    const double x = out().command.v[0];
    if (at_once) press();
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    steps(300);
    EXPECT_EQ(out().state, NC_STATE_IDLE);
    EXPECT_EQ(runtime->snapshot().alarms.count, 0u) << alarms();
    if (!at_once) expect_at(x, 0, 0);
    single_block(false);
    start("G90 G0 Y1.\nG1 X40. F3000.\nG0 X0. Y0.\nM30\n");
    EXPECT_TRUE(to_end()) << alarms();
    expect_at(0, 0, 0);
  }
}

// A hold amid a block: by hand, and back to the path (tests/restart/hold_test.cpp), but not by MDI. To the end of the block, both.
TEST_F(InterventionTest, InTheMiddleOfABlockMdiIsRefusedByName) {
  build();
  start("G90 G0 X10.\nG1 X200. F3000.\nM30\n");
  steps(800);
  ASSERT_EQ(out().state, NC_STATE_RUNNING);
  EXPECT_EQ(set_mode(Mode::kManual), Answer::kNotWhileRunning);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
  steps(400);
  ASSERT_EQ(out().state, NC_STATE_HOLD);
  EXPECT_EQ(set_mode(Mode::kMdi), Answer::kMiddleOfBlock);
  EXPECT_EQ(set_mode(Mode::kManual), Answer::kDone);
  EXPECT_EQ(set_mode(Mode::kMdi), Answer::kMiddleOfBlock) << "from there no more than from AUTO";
  EXPECT_EQ(set_mode(Mode::kAuto), Answer::kDone);
  single_block(true);  // the way out that the answer names
  press();
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  jog_in_stop(1, 20);
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
}

TEST_F(InterventionTest, BetweenTheStepsOfACycleManualIsRefused) {
  build();
  single_block(true);
  start("G90 G0 X0. Z10.\nG81 X20. Z-5. R2. F3000.\nG80\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  press();
  ASSERT_TRUE(until_state(NC_STATE_RUNNING));
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  steps(2);
  ASSERT_NEAR(out().command.v[2], 10, 1e-9) << "over the hole, the rest of the cycle is still to come";
  EXPECT_EQ(set_mode(Mode::kManual), Answer::kMiddleOfBlock);
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
}

// M700 13.3.1: a block that calls and has other words stops once, whether it has a motion or not, and whether an axis is jogged there or not.
TEST_F(InterventionTest, ACallBlockStopsOnce) {
  for (const bool moves : {false, true}) {
    for (const bool jogged : {false, true}) {
      SCOPED_TRACE(std::string(moves ? "moves" : "rests") + (jogged ? ", jogged" : ""));
      build();
      single_block(true);
      start(std::string("G90 G0 X10.\nG90 ") + (moves ? "X20. " : "") + "M98 P77 L2\nM30\nO77\nG91 G1 Y2. F3000.\nG90\nM99\n");
      ASSERT_TRUE(until_state(NC_STATE_STOPPED));
      ASSERT_TRUE(next_stop_in(2)) << alarms();
      if (jogged) jog_in_stop(0, 30);
      const double x = out().command.v[0];
      ASSERT_TRUE(next_stop_in(5)) << alarms();
      expect_at(x, 2, 0);
      single_block(false);
      press();
      EXPECT_TRUE(to_end()) << alarms();
      expect_at(x, 4, 0);
      runtime.reset();
    }
  }
}

TEST_F(InterventionTest, OverAHoleThatNeedsNoPositioningManualIsRefusedToo) {
  build();
  single_block(true);
  start("G90 G0 X20. Z10.\nG81 Z-5. R2. F3000.\nG80\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  ASSERT_TRUE(next_stop_in(2));
  steps(2);
  EXPECT_EQ(set_mode(Mode::kManual), Answer::kMiddleOfBlock);
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
}

TEST_F(InterventionTest, AnInterruptedProgramGoesOnInItsOwnMode) {
  build();
  single_block(true);
  start("G90 G0 X10.\nG1 X40. F3000.\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  steps(2);
  for (const Mode other : {Mode::kManual, Mode::kMdi}) {
    ASSERT_EQ(set_mode(other), Answer::kDone);
    EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), other == Mode::kManual ? Answer::kNotInThisMode : Answer::kNoProgram);
    steps(20);
    EXPECT_EQ(out().state, NC_STATE_STOPPED);
  }
  EXPECT_EQ(set_mode(Mode::kAuto), Answer::kDone);
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(40, 0, 0);
}

// M700 12.4.4: blocks of MDI run in the block stop of a program, which goes on in its own mode behind them.
TEST_F(InterventionTest, BlocksOfMdiInABlockStop) {
  for (const bool single : {false, true}) {
    build();
    single_block(true);
    start("G90 G0 X10.\nG1 X40. F3000.\nM30\n");
    ASSERT_TRUE(until_state(NC_STATE_STOPPED));
    steps(2);
    EXPECT_EQ(runtime->load_mdi("Y1.\n"), Answer::kNotInThisMode);
    ASSERT_EQ(set_mode(Mode::kMdi), Answer::kDone);
    ASSERT_EQ(runtime->load_mdi("G1 Y5. F3000.\nY7.\n"), Answer::kDone);
    single_block(single);
    press();
    ASSERT_TRUE(until_state(NC_STATE_RUNNING));
    EXPECT_EQ(runtime->load_mdi("Y9.\n"), Answer::kNotWhileRunning);
    ASSERT_TRUE(until_state(NC_STATE_STOPPED));
    steps(3);
    if (single) {
      expect_at(10, 5, 0);
      EXPECT_EQ(set_mode(Mode::kAuto), Answer::kNotWhileRunning) << "the blocks of MDI have not come to their end";
      EXPECT_EQ(runtime->load_mdi("Y9.\n"), Answer::kRefusedByControl);
      EXPECT_NE(runtime->explain(Answer::kRefusedByControl).find("not come to their end"), std::string::npos);
      press();
      ASSERT_TRUE(until_state(NC_STATE_RUNNING));
      ASSERT_TRUE(until_state(NC_STATE_STOPPED));
      steps(3);
    }
    EXPECT_EQ(out().cause, NC_CAUSE_MDI_ENDED);
    expect_at(10, 7, 0);
    EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram) << "in MDI the program does not go on";
    steps(20);
    ASSERT_EQ(runtime->load_mdi("#1=1\n"), Answer::kDone) << "a text that takes no time";
    press();
    EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram) << "a second press does not reach the program";
    steps(60);
    EXPECT_EQ(out().state, NC_STATE_STOPPED);
    expect_at(10, 7, 0);
    ASSERT_EQ(set_mode(Mode::kAuto), Answer::kDone);
    single_block(false);
    press();
    EXPECT_TRUE(to_end()) << alarms();
    expect_at(40, 7, 0);
    runtime.reset();
  }
}

TEST_F(InterventionTest, BlocksOfMdiThatWereNotStartedAreDroppedInAuto) {
  build();
  single_block(true);
  start("G90 G0 X10.\nG1 X40. F3000.\nM30\n");
  ASSERT_TRUE(until_state(NC_STATE_STOPPED));
  steps(2);
  ASSERT_EQ(set_mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("G1 Y5. F3000.\n"), Answer::kDone);
  ASSERT_EQ(set_mode(Mode::kAuto), Answer::kDone);
  single_block(false);
  press();
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(40, 0, 0);
}

TEST_F(InterventionTest, AResetDropsBlocksOfMdi) {
  for (const bool started : {false, true}) {
    build();
    single_block(true);
    start("G90 G0 X10.\nG1 X40. F3000.\nM30\n");
    ASSERT_TRUE(until_state(NC_STATE_STOPPED));
    steps(2);
    ASSERT_EQ(set_mode(Mode::kMdi), Answer::kDone);
    ASSERT_EQ(runtime->load_mdi("G1 Y50. F3000.\n"), Answer::kDone);
    if (started) {
      press();
      ASSERT_TRUE(until_state(NC_STATE_RUNNING));
      steps(50);
    }
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    steps(600);
    ASSERT_EQ(out().state, NC_STATE_IDLE);
    EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNoProgram);
    ASSERT_EQ(set_mode(Mode::kAuto), Answer::kDone);
    single_block(false);
    press();
    EXPECT_TRUE(to_end()) << alarms();
    EXPECT_NEAR(out().command.v[0], 40, 1e-9);
    runtime.reset();
  }
}

// The same in real time, the scan and the feeder in their threads.
TEST(Intervention, InThreads) {
  const nc::rt::Config config = nc::test::parse_or_fail(
      nc::test::base_toml() + "[scheduling]\noverrun = \"count\"\npolicy = \"other\"\n");
  nc::test::Recording recording;
  DriveWatch hal(config, &recording);
  nc::rt::RealClock clock;
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &hal, nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  const std::string text =
      "G90 G0 X0. Y0.\n#1=0\nWHILE [#1 LT 4] DO1\nG1 X5. F6000.\nX0. Y3.\n#1=#1+1\nEND1\nM30\n";
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "a.nc", text.data(), text.size(), &file), NC_OK);
  std::string error;
  ASSERT_TRUE(runtime->start(&error)) << error;
  const auto mode = [&](Mode wanted) {
    return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(wanted));
  };
  const auto wait = [&](auto&& reached) {
    for (unsigned i = 0; i < 20000 && !reached(runtime->snapshot().system[0].nc); ++i)
      clock.sleep_until(clock.now_ns() + 1'000'000);
  };
  runtime->execute(CommandKind::kSingleBlock, 0, 1);
  ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  unsigned jogs = 0;
  for (unsigned press = 0; press < 40 && runtime->info().system[0].runs == 0; ++press) {
    const nc_outputs before = runtime->snapshot().system[0].nc;
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    // After motion by hand the start acts only when the feeder has read the rest again; then wait through RUNNING for the next stop.
    wait([&](const nc_outputs& out) { return out.state != before.state || out.serial != before.serial || out.blocks != before.blocks; });
    wait([](const nc_outputs& out) { return out.state != NC_STATE_RUNNING && out.distance_zero; });
    if (runtime->snapshot().system[0].nc.state != NC_STATE_STOPPED) break;
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    Command step;
    step.kind = CommandKind::kStep;
    step.axis = press % 3;
    step.value = press % 2 == 0 ? 0.5 : -0.5;
    jogs += runtime->execute(step) == Answer::kDone;
    clock.sleep_until(clock.now_ns() + 30'000'000);
    wait([](const nc_outputs& out) { return out.state == NC_STATE_STOPPED && out.distance_zero; });
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  }
  clock.sleep_until(clock.now_ns() + 20'000'000);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
  EXPECT_EQ(runtime->info().system[0].runs, 1u);
  EXPECT_GT(jogs, 6u);
  runtime->stop();
  for (const std::string& violation : recording.violations) ADD_FAILURE() << violation;
}

// ---- drives that were off --------------------------------------------------------------------------------

class DrivesOffTest : public InterventionTest, public testing::WithParamInterface<bool> {
 protected:
  bool bus() const { return GetParam(); }
  void fault(bool on) {
    if (bus())
      hal->machine.sim.fail_bus(on);
    else
      hal->machine.sim.fail_drive(0, 1, on);
  }
  AlarmId cause() const { return bus() ? AlarmId::kHalLost : AlarmId::kDriveFault; }
};

// The drives go off in the middle of a move: the command brakes on its path, but the axes coast to another place. After
// the reset nothing jumps, and the next program starts from where the axes are.
TEST_P(DrivesOffTest, TheCommandFollowsTheAxesBeforeTheDrivesComeOnAgain) {
  nc::rt::Config wanted = nc::test::parse_or_fail(nc::test::base_toml());
  for (unsigned a = 0; a < 3; ++a) wanted.sim.axis[0][a].following_error_limit = 2.0;
  build(wanted);
  start("G90 G1 X300. Y200. F9000.\nM30\n");
  steps(600);
  ASSERT_GT(out().velocity.v[0], 100);
  fault(true);
  steps(400);
  ASSERT_EQ(runtime->snapshot().alarms.count, 1u) << alarms();
  EXPECT_EQ(runtime->snapshot().alarms.alarm[0].id, cause());
  EXPECT_FALSE(hal->enabled);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  ASSERT_EQ(runtime->snapshot().alarms.count, 1u) << "the cause is still there";
  EXPECT_EQ(runtime->snapshot().alarms.alarm[0].id, cause());
  EXPECT_FALSE(hal->enabled);
  EXPECT_EQ(hal->enables, 0u);
  fault(false);
  steps(5);
  EXPECT_FALSE(hal->enabled) << "not before a reset";
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u) << alarms();
  EXPECT_FALSE(runtime->snapshot().resetting);
  EXPECT_TRUE(hal->enabled);
  EXPECT_EQ(hal->enables, 1u);
  EXPECT_LT(hal->catch_up, 0.01) << "mm, in-position width";
  const nc_axes rest = out().command;
  for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(rest.v[a], hal->machine.sim.actual(0).v[a], 0.01);
  start("G90 G1 X10. F9000.\nG91 Y1.\nM30\n");
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(10, rest.v[1] + 1, rest.v[2]);
}

// A reset while the axes still coast waits until they stand.
TEST_P(DrivesOffTest, ResetWaitsUntilTheAxesStand) {
  nc::rt::Config wanted = nc::test::parse_or_fail(nc::test::base_toml());
  for (unsigned a = 0; a < 3; ++a) wanted.sim.axis[0][a].coast_s = 0.3;
  build(wanted);
  start("G90 G1 X300. F9000.\nM30\n");
  steps(600);
  fault(true);
  steps(150);
  fault(false);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(50);
  EXPECT_TRUE(runtime->snapshot().resetting);
  EXPECT_FALSE(hal->enabled);
  steps(3000);
  EXPECT_FALSE(runtime->snapshot().resetting);
  EXPECT_EQ(hal->enables, 1u);
  EXPECT_LT(hal->catch_up, 0.01);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u) << alarms();
}

// An axis that is pushed beyond a soft limit while its drive is off is no alarm, and may come back.
TEST_P(DrivesOffTest, CoastingBeyondASoftLimitIsNoAlarm) {
  nc::rt::Config wanted = nc::test::parse_or_fail(nc::test::base_toml());
  wanted.sim.axis[0][0].coast_s = 0.5;
  build(wanted);
  start("G90 G1 X499. F12000.\nM30\n");
  ASSERT_TRUE([&] {
    for (unsigned i = 0; i < 10000 && out().command.v[0] < 470; ++i) runtime->step();
    return out().command.v[0] >= 470;
  }());
  fault(true);
  steps(5);
  fault(false);
  steps(6000);
  ASSERT_GT(hal->machine.sim.actual(0).v[0], 500);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(200);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u) << alarms();
  EXPECT_LT(hal->catch_up, 0.01);
  start("G90 G0 X490.\nM30\n");
  EXPECT_TRUE(to_end()) << alarms();
  expect_at(490, 0, 0);
  recording.violations.clear();  // this test starts outside the soft limits on purpose
}

INSTANTIATE_TEST_SUITE_P(Faults, DrivesOffTest, testing::Bool(),
                         [](const auto& p) { return p.param ? std::string("bus") : std::string("drive"); });

}  // namespace
