// SPDX-License-Identifier: Apache-2.0
// Two part systems under one panel: each has its own program, override, stops and bad inputs, and none of them acts in the other.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <random>

#include "fake_nc.hpp"
#include "hal/sim/sim_machine.hpp"
#include "runtime/refusal.hpp"
#include "runtime/runtime.hpp"
#include "stepping.hpp"
#include "support/seeds.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;
using nc::rt::OverrideSource;

std::string two_systems() {
  std::string text = nc::test::base_toml();
  const std::string second = "[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\nsoft_limits = [-500.0, 500.0]\n";
  text.insert(text.find("[[point]]"), second);
  return text;
}

// A machine that reports for the second part system what the test tells it to.
class LyingMachine final : public nc::hal::Hal {
 public:
  LyingMachine(const nc::hal::SimConfig& config, const nc::hal::PointTable& points) : machine_(config, points) {}
  bool start(const nc::hal::PointImage& initial, std::string* error) override { return machine_.start(initial, error); }
  void read(nc::hal::Feedback* feedback, nc::hal::PointImage* image) noexcept override {
    machine_.read(feedback, image);
    if (lie != nullptr) lie(&feedback->system[1]);
    if (found >= 0) image->value[found] = 1;
    found = -1;
  }
  void write(const nc::hal::Command& command, const nc::hal::PointImage& image) noexcept override { machine_.write(command, image); }
  void stop() noexcept override { machine_.stop(); }
  void set_input(unsigned point, std::uint32_t value) { machine_.set_input(point, value); }
  void (*lie)(nc::hal::SystemFeedback*) = nullptr;
  int found = -1;  // output that is reported as on, once; -1: none

 private:
  nc::hal::SimMachine machine_;
};

class TwoSystems : public testing::Test {
 protected:
  void build(const std::string& more = "") {
    config = nc::test::parse_or_fail(two_systems() + more);
    ASSERT_EQ(config.nc.system_count, 2);
    machine = std::make_unique<LyingMachine>(config.sim, config.points);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  Answer select(unsigned system, const char* text) {
    const std::string& kept = texts.emplace_back(text);
    unsigned file = 0;
    EXPECT_EQ(nc_program_add_text(runtime->control(), ("p" + std::to_string(texts.size())).c_str(), kept.data(), kept.size(), &file), NC_OK);
    return give(CommandKind::kSelectProgram, system, 0, file);
  }
  Answer give(CommandKind kind, unsigned system, double value = 0, std::uint32_t number = 0) {
    nc::rt::Command command;
    command.kind = kind;
    command.system = static_cast<std::uint8_t>(system);
    command.value = value;
    command.number = number;
    return runtime->execute(command);
  }
  Answer start() { return runtime->execute(CommandKind::kCycleStart); }
  Answer mode(Mode to) { return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(to)); }
  void steps(unsigned count) {
    for (unsigned n = 0; n < count; ++n) runtime->step();
  }
  // Steps to the end of what runs.
  void finish() {
    for (unsigned n = 0; n < 20000 && (n < 5 || runtime->snapshot().program_active()); ++n) runtime->step();
    ASSERT_FALSE(runtime->snapshot().program_active());
    steps(5);
  }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    for (unsigned n = 0; n < 3000 && runtime->snapshot().resetting; ++n) runtime->step();
    ASSERT_FALSE(runtime->snapshot().resetting);
  }
  nc::rt::SystemSnapshot now(unsigned system) const { return runtime->snapshot().system[system]; }
  double x(unsigned system) const { return now(system).nc.command.v[0]; }
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<LyingMachine> machine;
  std::unique_ptr<nc::rt::Runtime> runtime;
  std::deque<std::string> texts;
};

TEST_F(TwoSystems, APartSystemWithoutAProgramStaysIdle) {
  build();
  ASSERT_EQ(select(1, "G1 X5. F6000\nM30\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  steps(3);
  EXPECT_EQ(now(0).nc.state, NC_STATE_IDLE);
  EXPECT_EQ(now(1).nc.state, NC_STATE_RUNNING);
  finish();
  EXPECT_NEAR(x(1), 5, 1e-9);
  EXPECT_EQ(x(0), 0);
}

// One part system has a part program ready while the other has MDI blocks: a start in MDI starts only these.
TEST_F(TwoSystems, AStartInMdiStartsNoPartProgram) {
  build();
  ASSERT_EQ(select(0, "G1 X50. F6000\nM30\n"), Answer::kDone);
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("G1 X3. F6000\n", 1), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(1), 3, 1e-9);
  EXPECT_EQ(x(0), 0) << "the part program has started in MDI";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  steps(5);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(0), 50, 1e-9);
  EXPECT_NEAR(x(1), 3, 1e-9);
}

// A start continues the program that is interrupted; one that has ended meanwhile does not begin again.
TEST_F(TwoSystems, AProgramThatHasEndedDoesNotBeginAgainBesideAnother) {
  build();
  ASSERT_EQ(select(0, "G91 G1 X1. F6000\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G91 G1 X1. F6000\nM0\nG1 X1.\nM30\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  for (unsigned n = 0; n < 2000 && (now(1).nc.state != NC_STATE_STOPPED || now(0).nc.state != NC_STATE_IDLE); ++n) steps(1);
  ASSERT_EQ(now(1).nc.state, NC_STATE_STOPPED);
  ASSERT_EQ(now(0).nc.state, NC_STATE_IDLE);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(1), 2, 1e-9);
  EXPECT_NEAR(x(0), 1, 1e-9);
}

TEST_F(TwoSystems, AStartAndAResetBeforeTheFeederHasSeenEither) {
  build();
  for (unsigned scans = 0; scans < 12; ++scans) {
    SCOPED_TRACE(scans);
    ASSERT_EQ(select(0, "G90 G0 X1.\nG1 X2. F6000\nM30\n"), Answer::kDone);
    ASSERT_EQ(select(1, "G90 G0 X-1.\nG1 X-2. F6000\nM30\n"), Answer::kDone);
    ASSERT_EQ(start(), Answer::kDone);
    steps(scans);
    reset();
    ASSERT_EQ(now(0).nc.state, NC_STATE_IDLE);
    ASSERT_EQ(now(1).nc.state, NC_STATE_IDLE);
    ASSERT_EQ(start(), Answer::kDone);
    finish();
    EXPECT_NEAR(x(0), 2, 1e-9);
    EXPECT_NEAR(x(1), -2, 1e-9);
  }
}

// Manual absolute: the axis that was moved still goes to its programmed place, and the other part system is not affected.
TEST_F(TwoSystems, MotionByHandInABlockStopIsOfOnePartSystem) {
  build();
  ASSERT_EQ(select(0, "G1 X10. F6000\nM0\nG91 X5.\nG90 X20.\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X10. F6000\nM0\nG91 X5.\nG90 X20.\nM30\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  steps(600);
  ASSERT_EQ(now(0).nc.state, NC_STATE_STOPPED);
  ASSERT_EQ(now(1).nc.state, NC_STATE_STOPPED);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kStep, 1, -3), Answer::kDone);
  steps(600);
  EXPECT_NEAR(x(0), 10, 1e-9);
  EXPECT_NEAR(x(1), 7, 1e-9);
  EXPECT_EQ(now(0).nc.moved_by_hand, 0u);
  EXPECT_EQ(now(1).nc.moved_by_hand, 1u);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(0), 20, 1e-9);
  EXPECT_NEAR(x(1), 20, 1e-9);
}

// R21 names the part system, and no NaN reaches a set-point of either part system.
TEST_F(TwoSystems, AnInputThatIsNoNumberIsAnAlarmOfItsPartSystem) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  void (*const lies[])(nc::hal::SystemFeedback*) = {[](nc::hal::SystemFeedback* f) { f->actual.v[0] = kNan; },
                                                    [](nc::hal::SystemFeedback* f) { f->spindle[0].rev_per_s = kNan; },
                                                    [](nc::hal::SystemFeedback* f) { f->actual.v[0] = std::numeric_limits<double>::infinity(); }};
  for (const auto lie : lies) {
    runtime.reset();
    build();
    ASSERT_EQ(select(0, "G1 X10. F600\nM30\n"), Answer::kDone);
    ASSERT_EQ(select(1, "S600 M3\nG95 G1 X10. F1.\nM30\n"), Answer::kDone);
    ASSERT_EQ(start(), Answer::kDone);
    steps(300);
    machine->lie = lie;
    for (unsigned n = 0; n < 300; ++n) {
      steps(1);
      for (unsigned s = 0; s < 2; ++s) ASSERT_TRUE(std::isfinite(x(s)) && std::isfinite(now(s).nc.velocity.v[0])) << s;
    }
    const nc::rt::AlarmList alarms = runtime->snapshot().alarms;
    ASSERT_EQ(alarms.count, 1u);
    EXPECT_EQ(alarms.alarm[0].id, nc::rt::AlarmId::kBadInput);
    EXPECT_EQ(alarms.alarm[0].system, 1);
    EXPECT_EQ(start(), Answer::kAlarmActive);
    machine->lie = nullptr;
    reset();
    EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
  }
}

// The machine has an override switch for one of them: each shows the override that is in force in it, with its source, and the operator's
// override acts in the other.
TEST_F(TwoSystems, EachShowsItsOwnOverride) {
  build("[signals]\n\"plc2.feed_override\" = \"word_in\"\n");
  machine->set_input(static_cast<unsigned>(config.points.find("word_in")), 2500);
  ASSERT_EQ(select(0, "G1 X400. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X400. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedOverride, 0.5), Answer::kDone);
  steps(600);
  EXPECT_NEAR(now(0).nc.feed_mm_min, 600, 1);
  EXPECT_DOUBLE_EQ(now(0).feed_override, 0.5);
  EXPECT_EQ(now(0).feed_override_source, OverrideSource::kOperator);
  EXPECT_NEAR(now(1).nc.feed_mm_min, 300, 1);
  EXPECT_DOUBLE_EQ(now(1).feed_override, 0.25);
  EXPECT_EQ(now(1).feed_override_source, OverrideSource::kMachine);
  EXPECT_EQ(now(1).rapid_override_source, OverrideSource::kOperator);
}

// A command acts only on the part system that it names, and its answer is about that one.
TEST_F(TwoSystems, ACycleStartIsOfThePartSystemThatItNames) {
  build();
  ASSERT_EQ(select(0, "G1 X5. F6000\nM30\n"), Answer::kDone);
  EXPECT_EQ(give(CommandKind::kCycleStart, 1), Answer::kNoProgram) << "the other one has a program";
  ASSERT_EQ(select(1, "G1 X-5. F6000\nM30\n"), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kCycleStart, 1), Answer::kDone);
  steps(5);
  EXPECT_EQ(now(0).nc.state, NC_STATE_IDLE);
  EXPECT_EQ(now(1).nc.state, NC_STATE_RUNNING);
  EXPECT_EQ(give(CommandKind::kCycleStart, 1), Answer::kAlreadyRunning);
  EXPECT_EQ(give(CommandKind::kCycleStart, 0), Answer::kDone) << "begins beside it";
  steps(5);
  EXPECT_EQ(now(0).nc.state, NC_STATE_RUNNING);
  finish();
  EXPECT_NEAR(x(0), 5, 1e-9);
  EXPECT_NEAR(x(1), -5, 1e-9);
  EXPECT_EQ(give(CommandKind::kCycleStart, 2), Answer::kAxisUnknown);
}

// Two starts in one scan are two starts.
TEST_F(TwoSystems, StartsOfBothInOneScan) {
  build();
  ASSERT_EQ(select(0, "G1 X5. F6000\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X-5. F6000\nM30\n"), Answer::kDone);
  nc::rt::VirtualClock other_clock;
  struct Seen final : nc::test::FakeNc {
    bool start[2] = {};
    void cycle(const nc_inputs* in, nc_outputs* result) noexcept override {
      for (unsigned s = 0; s < 2; ++s) {
        start[s] |= in[s].cycle_start;
        result[s] = out;
      }
    }
  } seen;
  nc::hal::SimMachine quiet(config.sim, config.points);
  nc::rt::LadderHook none;
  nc::rt::Scan scan(config, &other_clock, &quiet, &none, &seen);
  scan.set_loaded(nc::rt::Scan::kPartLoaded | nc::rt::Scan::kPartLoaded << nc::rt::Scan::kLoadedBits);
  nc::rt::Command command;
  command.kind = CommandKind::kCycleStart;
  ASSERT_TRUE(scan.post(command));
  command.system = 1;
  ASSERT_TRUE(scan.post(command));
  scan.run_once();
  EXPECT_TRUE(seen.start[0]);
  EXPECT_TRUE(seen.start[1]);
}

// A feed hold that comes in the same scan as the start wins: its part system does not begin, but the other one does.
TEST_F(TwoSystems, AFeedHoldInTheScanOfAStartWins) {
  build();
  struct Seen final : nc::test::FakeNc {
    unsigned starts[2] = {}, holds[2] = {};
    void cycle(const nc_inputs* in, nc_outputs* result) noexcept override {
      for (unsigned s = 0; s < 2; ++s) {
        starts[s] += in[s].cycle_start;
        holds[s] += in[s].feed_hold;
        result[s] = out;
      }
    }
  } seen;
  nc::hal::SimMachine quiet(config.sim, config.points);
  nc::rt::LadderHook none;
  nc::rt::VirtualClock other_clock;
  nc::rt::Scan scan(config, &other_clock, &quiet, &none, &seen);
  scan.set_loaded(nc::rt::Scan::kPartLoaded | nc::rt::Scan::kPartLoaded << nc::rt::Scan::kLoadedBits);
  nc::rt::Command command;
  command.kind = CommandKind::kCycleStart;
  command.system = nc::rt::kAllSystems;
  command.by = nc::rt::Asker::kClient;
  ASSERT_TRUE(scan.post(command));
  command.kind = CommandKind::kFeedHold;
  command.system = 1;
  command.by = nc::rt::Asker::kConsole;
  ASSERT_TRUE(scan.post(command));
  for (unsigned n = 0; n < 5; ++n) scan.run_once();
  EXPECT_EQ(seen.starts[0], 1u);
  EXPECT_EQ(seen.starts[1], 0u);
  EXPECT_EQ(seen.holds[0], 0u);
  EXPECT_EQ(seen.holds[1], 1u) << "a start that waits in the NC is taken back, and the next one is free";
  EXPECT_EQ(scan.snapshot().system[0].refusal.asked, nc::rt::Asked::kNothing);
  EXPECT_EQ(scan.snapshot().system[1].refusal.asked, nc::rt::Asked::kCycleStart);
  EXPECT_EQ(scan.snapshot().system[1].refusal.why, Answer::kTakenBack) << "no feed hold of the machine is on";
  EXPECT_EQ(scan.snapshot().system[1].refusal.by, nc::rt::Asker::kClient) << "who has asked for the start, not the panel";
  command.kind = CommandKind::kCycleStart;
  ASSERT_TRUE(scan.post(command));
  for (unsigned n = 0; n < 5; ++n) scan.run_once();
  EXPECT_EQ(seen.starts[1], 1u);
}

// The start button of the panel and an operator's feed hold come in one scan: the feed hold wins.
TEST_F(TwoSystems, AFeedHoldInTheScanOfThePanelsStartWins) {
  build("[signals]\n\"plc.cycle_start\" = \"in0\"\n");
  ASSERT_EQ(select(0, "G1 X50. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X50. F1200\nM30\n"), Answer::kDone);
  const unsigned button = static_cast<unsigned>(config.points.find("in0"));
  for (unsigned scans = 0; scans < 4; ++scans) {  // in one of these scans the start of the button is taken
    machine->set_input(button, 1);
    steps(5);
    machine->set_input(button, 0);
    steps(scans);
    ASSERT_EQ(give(CommandKind::kFeedHold, 1), Answer::kDone);
    steps(10);
    EXPECT_EQ(now(0).nc.state, NC_STATE_RUNNING) << scans;
    EXPECT_NE(now(1).nc.state, NC_STATE_RUNNING) << scans;
    if (now(1).nc.state == NC_STATE_IDLE) {
      EXPECT_EQ(nc::rt::refusal_text(config, 1, now(1).refusal), "cycle start refused: a feed hold has taken it back") << scans;
      EXPECT_EQ(now(1).refusal.by, nc::rt::Asker::kPanel);
    }
    EXPECT_EQ(now(0).refusal.asked, nc::rt::Asked::kNothing) << scans;
    reset();
  }
}

TEST_F(TwoSystems, TheStatusOfTheOneThatIsHeldSaysWhyThePanelsStartDidNothing) {
  build("[signals]\n\"plc.cycle_start\" = \"in0\"\n\"plc2.feed_hold_n\" = \"in1\"\n");
  ASSERT_EQ(select(0, "G1 X50. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X50. F1200\nM30\n"), Answer::kDone);
  const unsigned button = static_cast<unsigned>(config.points.find("in0"));
  machine->set_input(button, 1);
  steps(5);
  machine->set_input(button, 0);
  steps(10);
  EXPECT_EQ(now(0).nc.state, NC_STATE_RUNNING);
  EXPECT_EQ(now(0).refusal.asked, nc::rt::Asked::kNothing);
  EXPECT_EQ(now(1).nc.state, NC_STATE_IDLE);
  EXPECT_EQ(nc::rt::refusal_text(config, 1, now(1).refusal), "cycle start refused: the feed hold of the machine is on");
  EXPECT_EQ(now(1).refusal.by, nc::rt::Asker::kPanel);
}

TEST_F(TwoSystems, AFeedHoldStopsThePartSystemThatItNames) {
  build();
  ASSERT_EQ(select(0, "G1 X50. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X-50. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  steps(300);
  ASSERT_EQ(give(CommandKind::kFeedHold, 1), Answer::kDone);
  steps(300);
  EXPECT_EQ(now(0).nc.state, NC_STATE_RUNNING);
  EXPECT_EQ(now(1).nc.state, NC_STATE_HOLD);
  EXPECT_EQ(give(CommandKind::kCycleStart, 0), Answer::kAlreadyRunning);
  ASSERT_EQ(give(CommandKind::kCycleStart, 1), Answer::kDone);
  steps(300);
  EXPECT_EQ(now(1).nc.state, NC_STATE_RUNNING);
  ASSERT_EQ(give(CommandKind::kFeedHold, 0), Answer::kDone);
  steps(300);
  EXPECT_EQ(now(0).nc.state, NC_STATE_HOLD);
  ASSERT_EQ(now(1).nc.state, NC_STATE_RUNNING);
  ASSERT_EQ(start(), Answer::kDone) << "the panel's one button: what is interrupted goes on beside what runs";
  EXPECT_EQ(start(), Answer::kAlreadyRunning);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone) << "and its hold stops both";
  steps(300);
  EXPECT_EQ(now(0).nc.state, NC_STATE_HOLD);
  EXPECT_EQ(now(1).nc.state, NC_STATE_HOLD);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(0), 50, 1e-9);
  EXPECT_NEAR(x(1), -50, 1e-9);
}

// One part system goes on, the other stays where its own single block has stopped it.
TEST_F(TwoSystems, ASingleBlockIsOfThePartSystemThatItNames) {
  build();
  const char* const kTwoBlocks = "G1 X1. F6000\nG1 X2.\nM1\nG1 X3.\nM30\n";
  ASSERT_EQ(select(0, kTwoBlocks), Answer::kDone);
  ASSERT_EQ(select(1, kTwoBlocks), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kSingleBlock, 1, 0, 1), Answer::kDone);
  EXPECT_EQ(runtime->snapshot().single_block, 2u);
  ASSERT_EQ(start(), Answer::kDone);
  steps(600);
  EXPECT_EQ(now(0).nc.state, NC_STATE_IDLE);
  EXPECT_EQ(now(1).nc.state, NC_STATE_STOPPED);
  EXPECT_NEAR(x(0), 3, 1e-9);
  EXPECT_NEAR(x(1), 1, 1e-9);
  ASSERT_EQ(give(CommandKind::kSingleBlock, 1, 0, 0), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kOptionalStop, 1, 0, 1), Answer::kDone);
  EXPECT_EQ(runtime->snapshot().single_block, 0u);
  EXPECT_EQ(runtime->snapshot().optional_stop, 2u);
  ASSERT_EQ(give(CommandKind::kCycleStart, 1), Answer::kDone);
  steps(600);
  EXPECT_NEAR(x(1), 2, 1e-9) << "its optional stop";
  ASSERT_EQ(give(CommandKind::kCycleStart, 0), Answer::kDone);
  steps(600);
  EXPECT_EQ(now(0).nc.state, NC_STATE_IDLE) << "which is not the other's";
}

TEST_F(TwoSystems, AnOverrideIsOfThePartSystemThatItNames) {
  build("[signals]\n\"plc2.feed_override\" = \"word_in\"\n");
  machine->set_input(static_cast<unsigned>(config.points.find("word_in")), 2500);
  steps(3);
  EXPECT_EQ(give(CommandKind::kFeedOverride, 1, 0.5), Answer::kMachineSwitch);
  ASSERT_EQ(give(CommandKind::kFeedOverride, 0, 0.75), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kRapidOverride, 1, 0.5), Answer::kDone);
  steps(3);
  EXPECT_DOUBLE_EQ(now(0).feed_override, 0.75);
  EXPECT_DOUBLE_EQ(now(1).feed_override, 0.25);
  EXPECT_DOUBLE_EQ(now(0).rapid_override, 1);
  EXPECT_DOUBLE_EQ(now(1).rapid_override, 0.5);
  ASSERT_EQ(runtime->execute(CommandKind::kRapidOverride, 0.25), Answer::kDone);
  steps(3);
  EXPECT_DOUBLE_EQ(now(0).rapid_override, 0.25);
  EXPECT_DOUBLE_EQ(now(1).rapid_override, 0.25);
}

// There is only one mode and one reset (plc.mode_*, plc.reset), whichever part system a command names.
TEST_F(TwoSystems, ModeAndResetAreOfTheWholeControl) {
  build();
  ASSERT_EQ(select(0, "G1 X50. F1200\nM30\n"), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kCycleStart, 0), Answer::kDone);
  steps(100);
  EXPECT_EQ(give(CommandKind::kSetMode, 1, 0, static_cast<std::uint32_t>(Mode::kMdi)), Answer::kNotWhileRunning);
  ASSERT_EQ(give(CommandKind::kReset, 1), Answer::kDone);
  steps(600);
  EXPECT_EQ(now(0).nc.state, NC_STATE_IDLE);
  ASSERT_EQ(give(CommandKind::kSetMode, 1, 0, static_cast<std::uint32_t>(Mode::kMdi)), Answer::kDone);
  EXPECT_EQ(runtime->snapshot().mode, Mode::kMdi);
}

// M700 12.4.4: blocks of MDI interrupt the program of one part system; that of the other stays where it is, also when it stands in a block stop.
TEST_F(TwoSystems, BlocksOfMdiInTheBlockStopOfOne) {
  build();
  for (const unsigned s : {0u, 1u}) ASSERT_EQ(select(s, "G1 X1. F6000\nG1 X2.\nG1 X50.\nM30\n"), Answer::kDone);
  for (const unsigned s : {0u, 1u}) {
    ASSERT_EQ(give(CommandKind::kSingleBlock, s, 0, 1), Answer::kDone);
    ASSERT_EQ(give(CommandKind::kCycleStart, s), Answer::kDone);
    steps(600);
    ASSERT_EQ(now(s).nc.state, NC_STATE_STOPPED);
  }
  // While the other one runs there is no other mode.
  ASSERT_EQ(give(CommandKind::kSingleBlock, 0, 0, 0), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kCycleStart, 0), Answer::kDone);
  steps(20);
  EXPECT_EQ(mode(Mode::kMdi), Answer::kNotWhileRunning);
  const Answer answer = runtime->load_mdi("S1000 M3\n", 1);
  EXPECT_EQ(answer, Answer::kNotInThisMode);
  for (unsigned n = 0; n < 20000 && now(0).nc.state != NC_STATE_IDLE; ++n) runtime->step();
  steps(5);
  // The other one has ended: nothing of it begins again, and it takes no blocks of MDI of its own.
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  EXPECT_EQ(runtime->load_mdi("G1 X7. F6000\n", 0), Answer::kNotWhileRunning);
  ASSERT_EQ(runtime->load_mdi("G1 X5. F6000\n", 1), Answer::kDone);
  const double other = x(0);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(600);
  EXPECT_EQ(now(1).nc.cause, NC_CAUSE_MDI_ENDED);
  EXPECT_NEAR(x(1), 5, 1e-9);
  EXPECT_NEAR(x(0), other, 1e-9);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kSingleBlock, 1, 0, 0), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kCycleStart, 1), Answer::kDone);
  steps(2000);
  EXPECT_EQ(now(1).nc.state, NC_STATE_IDLE);
  EXPECT_NEAR(x(1), 50, 1e-9);
}

// Each has its own count of runs, which counts also a block that ends before anybody looks.
TEST_F(TwoSystems, RunsAreCountedForEach) {
  build();
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("G1 X0.01 F6000\n", 1), Answer::kDone);
  ASSERT_EQ(give(CommandKind::kCycleStart, 0), Answer::kNoProgram);
  ASSERT_EQ(give(CommandKind::kCycleStart, 1), Answer::kDone);
  finish();
  EXPECT_EQ(runtime->info().system[0].runs, 0u);
  EXPECT_EQ(runtime->info().system[1].runs, 1u);
}

// When outputs are found on in the machine, everything that is ready is read again: each part system must read its own blocks.
TEST_F(TwoSystems, EachHasItsOwnBlocksOfMdi) {
  build();
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("#101=#1100\nG1 X3. F6000\n", 0), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("#102=#1100\nG1 X-4. F6000\n", 1), Answer::kDone);
  EXPECT_EQ(runtime->load_mdi(std::string(2000, ' ') + "\nG1 X70. F6000\n", 0), Answer::kRefusedByControl);
  machine->found = config.points.find("out0");
  steps(20);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(0), 3, 1e-9);
  EXPECT_NEAR(x(1), -4, 1e-9);
  EXPECT_EQ(nc::test::variable_of(*runtime, 101, -1), 1) << "the output that was found";
  EXPECT_EQ(nc::test::variable_of(*runtime, 102, -1, 1), 1);
}

// The same while one has a part program, which MDI does not change, and after the MDI blocks of the other have been executed.
TEST_F(TwoSystems, BlocksOfMdiThatHaveRunDoNotComeBack) {
  build();
  ASSERT_EQ(select(0, "G1 X9. F6000\nM30\n"), Answer::kDone);
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("G91 G1 X-4. F6000\n", 1), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  machine->found = config.points.find("out0");
  steps(20);
  EXPECT_EQ(start(), Answer::kNoProgram);
  ASSERT_EQ(runtime->load_mdi("G91 G1 X1. F6000\n", 0), Answer::kDone);
  machine->found = config.points.find("out0");
  steps(20);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(0), 1, 1e-9);
  EXPECT_NEAR(x(1), -4, 1e-9);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  machine->found = config.points.find("out0");
  steps(20);
  ASSERT_EQ(start(), Answer::kDone);
  finish();
  EXPECT_NEAR(x(0), 9, 1e-9) << "the part program";
  EXPECT_NEAR(x(1), -4, 1e-9);
}

// Reports about a run or an alarm name the part system in which it is.
TEST_F(TwoSystems, LinesEndsAndAlarmsAreThoseOfEach) {
  build();
  ASSERT_EQ(select(0, "G1 X1. F6000\nG1 X2.\nG1 X3.\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X-1. F6000\nM0\nG1 X-2.\nM99\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  for (unsigned n = 0; n < 3000 && (now(1).nc.state != NC_STATE_STOPPED || now(0).nc.state != NC_STATE_IDLE); ++n) steps(1);
  steps(5);
  nc::rt::FeederInfo info = runtime->info();
  EXPECT_TRUE(info.system[0].ended && info.system[0].ended_ok);
  EXPECT_FALSE(info.system[1].ended);
  EXPECT_EQ(info.system[0].main_line, 4u);
  EXPECT_EQ(info.system[1].main_line, 1u);
  ASSERT_EQ(start(), Answer::kDone);
  for (unsigned n = 0; n < 3000 && runtime->info().system[1].begun_again == 0; ++n) steps(1);
  info = runtime->info();
  EXPECT_EQ(info.system[0].begun_again, 0u);
  EXPECT_EQ(info.system[1].begun_again, 1u);
  EXPECT_EQ(info.system[1].again_line, 4u);
  reset();
  // Both end in an alarm of their own.
  ASSERT_EQ(select(0, "G1 X4. F6000\nG2 X9. R0.1\nM30\n"), Answer::kDone);
  ASSERT_EQ(select(1, "G1 X-3. F6000\n\n\nG1 X[1/0]\nM30\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  for (unsigned n = 0; n < 3000 && (now(1).nc.state != NC_STATE_ALARM || now(0).nc.state != NC_STATE_ALARM); ++n) steps(1);
  steps(5);
  info = runtime->info();
  EXPECT_STREQ(info.system[0].program_alarm.code, "P71");
  EXPECT_EQ(info.system[0].program_alarm.source.line, 2u);
  EXPECT_STREQ(info.system[1].program_alarm.code, "P283");
  EXPECT_EQ(info.system[1].program_alarm.source.line, 4u);
  const nc::rt::AlarmList alarms = runtime->snapshot().alarms;
  ASSERT_EQ(alarms.count, 2u);
  for (unsigned n = 0; n < 2; ++n)
    EXPECT_EQ(runtime->alarm_text(alarms.alarm[n]).substr(0, 3), alarms.alarm[n].system == 0 ? "P71" : "P28") << runtime->alarm_text(alarms.alarm[n]);
}

// Random commands to one part system or both, at random moments. A command to one never starts, holds or stops the other. The programs of the
// first move only in +, those of the second only in -, so that a block of the other would show; and the last command is executed exactly.
TEST_F(TwoSystems, CommandsInAnyOrderActWhereTheyAreMeant) {
  unsigned began = 0;
  for (unsigned seed = 1; seed <= nc::test::seeds(30, 4); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 dice(seed);
    const auto pick = [&](unsigned below) { return static_cast<unsigned>(dice() % below); };
    runtime.reset();
    build();
    const unsigned found = static_cast<unsigned>(config.points.find("out0"));
    const char* const kPrograms[2] = {"G90 G1 X30. F3000\nX5.\nM0\nX60. F9000\nM1\nG0 X10.\nM30\n", "G90 G1 X-30. F3000\nX-5.\nM0\nX-60. F9000\nM1\nG0 X-10.\nM30\n"};
    const char* const kBlocks[2] = {"#101=#1100\nG90 G1 X20. F6000\nG1 X40.\n", "#101=#1100\nG90 G1 X-20. F6000\nG1 X-40.\n"};
    for (unsigned step = 0; step < 60; ++step) {
      const unsigned one = pick(2), other = 1 - one;
      const auto before = now(other).nc.state;
      Answer answer = Answer::kDone;
      switch (pick(9)) {
        case 0: answer = select(one, kPrograms[one]); break;
        case 1: answer = runtime->load_mdi(kBlocks[one], one); break;
        case 2:
        case 3: answer = give(CommandKind::kCycleStart, one); break;
        case 4: answer = give(CommandKind::kFeedHold, one); break;
        case 5: answer = give(CommandKind::kSingleBlock, one, 0, pick(2)); break;
        case 6:
          if (pick(4) == 0) reset();
          break;
        case 7: answer = mode(pick(2) != 0 ? Mode::kMdi : Mode::kAuto); break;
        default: machine->found = static_cast<int>(found); break;
      }
      (void)answer;
      const auto after = now(other).nc.state;
      if (before == NC_STATE_IDLE && after != NC_STATE_IDLE) ADD_FAILURE() << "the other one began, step " << step;
      if (before == NC_STATE_RUNNING && after == NC_STATE_HOLD) ADD_FAILURE() << "the other one was held, step " << step;
      if (before == NC_STATE_HOLD && after == NC_STATE_RUNNING) ADD_FAILURE() << "the other one went on, step " << step;
      for (unsigned n = 1 + pick(120); n > 0; --n) {
        steps(1);
        ASSERT_GE(x(0), -1e-9) << "blocks of the second, step " << step;
        ASSERT_LE(x(1), 1e-9) << "blocks of the first, step " << step;
      }
      began += now(one).nc.state == NC_STATE_RUNNING ? 1 : 0;
    }
    reset();
    for (unsigned s = 0; s < 2; ++s) ASSERT_EQ(give(CommandKind::kSingleBlock, s, 0, 0), Answer::kDone);
    ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
    for (unsigned s = 0; s < 2; ++s) ASSERT_EQ(runtime->load_mdi(kBlocks[s], s), Answer::kDone);
    ASSERT_EQ(start(), Answer::kDone);
    finish();
    EXPECT_NEAR(x(0), 40, 1e-9);
    EXPECT_NEAR(x(1), -40, 1e-9);
  }
  EXPECT_GT(began, nc::test::seeds(30, 4)) << "that there is something to look at";
}

}  // namespace
