// SPDX-License-Identifier: Apache-2.0
// Programs that are wrong: the alarm of the manual on the right line, everything before it executed, the
// machine at rest at the end of the last good block, and the next start works. And reset in the middle of
// anything.
#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <memory>

#include "program_generator.hpp"
#include "test_config.hpp"
#include "walls_machine.hpp"
#include "walls_offline.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::Listing;
using nc::test::Operator;
using nc::test::Recording;

struct BadProgram {
  const char* name;
  const char* text;
  const char* alarm;
  std::uint32_t line;
  double x;  // position at which X rests, mm
};
std::ostream& operator<<(std::ostream& out, const BadProgram& p) {
  return out << p.name;
}

class BadPrograms : public testing::TestWithParam<BadProgram> {};

TEST_P(BadPrograms, StopAtADefinedPointWithTheRightAlarm) {
  const BadProgram& bad = GetParam();
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  Operator op;
  op.max_scans = 20000;
  const Recording online = nc::test::run_online(config, bad.text, op);
  const Listing offline = nc::test::pull_offline(config, bad.text, op, online);
  EXPECT_EQ(online.alarm, bad.alarm);
  EXPECT_EQ(online.alarm_line, bad.line);
  nc::test::expect_same(online, offline, config);
  ASSERT_FALSE(online.items.empty());
  EXPECT_NEAR(online.items.back().machine.v[0], bad.x, 1e-9);
}

// M700: alarm numbers of the parameter, programming and macro chapters.
const BadProgram kBad[] = {
    {"missing_feed", "G90 G0 X10.\nY5.\nG1 X20.\nM30\n", "P62", 3, 10},
    {"arc_end_off_the_circle", "G90 G17 G0 X10.\nG2 X20. Y0. I3. J0. F500.\nM30\n", "P70", 2, 10},
    {"arc_radius_too_small", "G90 G17 G0 X10.\nG2 X30. Y0. R4. F500.\nM30\n", "P71", 2, 10},
    {"arc_without_centre", "G90 G17 G0 X10.\nG2 X30. Y0. F500.\nM30\n", "P70", 2, 10},
    {"missing_subprogram", "G90 G0 X7.\nM98 P7777\nM30\n", "P232", 2, 7},
    {"nesting_too_deep", "G90 G0 X7.\nM98 P300\nM30\nO300\nM98 P300\nM99\n", "P230", 5, 7},
    {"no_end", "G90 G0 X7.\nG0 X9.\n", "P36", 2, 9},
    {"file_cut_in_a_block", "G90 G0 X7.\nG0 X9.\nG1 X1", "P62", 3, 9},
    {"unlisted_g_code", "G90 G0 X7.\nG999\nM30\n", "P34", 2, 7},
    {"label_not_there", "G90 G0 X7.\nGOTO 55\nM30\n", "P231", 2, 7},
    {"division_by_zero", "G90 G0 X7.\n#1=1/0\nM30\n", "P283", 2, 7},
    {"write_to_an_input", "G90 G0 X7.\n#1000=1\nM30\n", "P243", 2, 7},
    {"user_alarm", "G90 G0 X7.\n#3000=5 (TOOL BROKEN)\nM30\n", "P277", 2, 7},
};
INSTANTIATE_TEST_SUITE_P(All, BadPrograms, testing::ValuesIn(kBad),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// A machine that is driven by hand.
class Drive {
 public:
  explicit Drive(const nc::rt::Config& config) : config_(config), machine_(config_.sim, config_.points) {
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config_, {&clock_, &machine_, nullptr, nullptr}, &errors);
    EXPECT_NE(runtime, nullptr);
    std::string error;
    EXPECT_TRUE(runtime->start_stepping(&error));
  }
  unsigned add(const char* name, const std::string& source) {
    unsigned file = 0;
    const std::string& text = texts_.emplace_back(source);  // the control reads the text here and copies nothing
    EXPECT_EQ(nc_program_add_text(runtime->control(), name, text.data(), text.size(), &file), NC_OK);
    return file;
  }
  void start(unsigned file) {
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  }
  void steps(unsigned n) {
    for (unsigned i = 0; i < n; ++i) runtime->step();
  }
  // Resets and returns the number of scans until the machine is idle and at rest; 0 = it never was.
  unsigned reset(unsigned limit = 3000) {
    EXPECT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    for (unsigned i = 1; i <= limit; ++i) {
      runtime->step();
      const nc::rt::Snapshot now = runtime->snapshot();
      if (!now.resetting && now.system[0].nc.state == NC_STATE_IDLE && now.system[0].nc.distance_zero)
        return i;
    }
    return 0;
  }
  bool to_end(unsigned limit = 200000) {
    const std::uint64_t runs = runtime->info().system[0].runs;
    for (unsigned i = 0; i < limit && runtime->info().system[0].runs == runs; ++i) {
      if (runtime->snapshot().alarmed()) return false;
      if (runtime->snapshot().system[0].nc.state == NC_STATE_STOPPED)
        runtime->execute(CommandKind::kCycleStart);
      runtime->step();
    }
    return runtime->info().system[0].runs == runs + 1;
  }
  nc_outputs out() { return runtime->snapshot().system[0].nc; }

  ~Drive() { runtime.reset(); }  // before the machine that it drives
  std::unique_ptr<nc::rt::Runtime> runtime;
  nc::hal::SimMachine& machine() { return machine_; }

 private:
  nc::rt::Config config_;
  nc::rt::VirtualClock clock_;
  nc::hal::SimMachine machine_;
  std::deque<std::string> texts_;
};

TEST(BadProgram, SoftLimitAheadStopsBeforeItMoves) {
  Drive drive(nc::test::parse_or_fail(nc::test::base_toml()));
  drive.start(drive.add("a.nc", "G90 G0 X100.\nG1 X501. F3000.\nM30\n"));
  drive.steps(5000);
  const nc::rt::Snapshot now = drive.runtime->snapshot();
  ASSERT_EQ(now.alarms.count, 1u);
  EXPECT_EQ(now.alarms.alarm[0].id, nc::rt::AlarmId::kProgram) << "the program's check comes first";
  EXPECT_EQ(drive.runtime->info().system[0].program_alarm.source.line, 2u);
  EXPECT_EQ(drive.runtime->info().system[0].program_alarm.axis, 0);
  EXPECT_TRUE(now.system[0].nc.distance_zero);
  EXPECT_NEAR(now.system[0].nc.command.v[0], 100, 1e-9);
  EXPECT_NEAR(drive.machine().actual(0).v[0], 100, 1e-6);
}

TEST(BadProgram, TheAlarmNamesTheSubProgramItsLineBelongsTo) {
  Drive drive(nc::test::parse_or_fail(nc::test::base_toml()));
  drive.add("O300", "O300\nG91\nG999\nM99\n");
  drive.start(drive.add("a.nc", "O7\nG90 G0 X1.\nM98 P300\nM30\n"));
  drive.steps(500);
  const nc::rt::Snapshot now = drive.runtime->snapshot();
  ASSERT_EQ(now.alarms.count, 1u);
  const std::string text = drive.runtime->alarm_text(now.alarms.alarm[0]);
  EXPECT_NE(text.find("P34"), std::string::npos) << text;
  EXPECT_NE(text.find(" (O300, line 3), called by line 3"), std::string::npos) << text;
}

TEST(BadProgram, AnEndlessGotoIsInterruptedByReset) {
  Drive drive(nc::test::parse_or_fail(nc::test::base_toml()));
  const unsigned endless = drive.add("a.nc", "G90 G0 X1.\nN1 GOTO 1\nM30\n");
  drive.start(endless);
  drive.steps(300);
  EXPECT_EQ(drive.out().state, NC_STATE_RUNNING);
  EXPECT_TRUE(drive.out().distance_zero);
  EXPECT_NEAR(drive.out().command.v[0], 1, 1e-9);
  const unsigned scans = drive.reset();
  EXPECT_GT(scans, 0u);
  EXPECT_LT(scans, 20u);
  drive.start(drive.add("b.nc", "G90 G0 X2.\nM30\n"));
  EXPECT_TRUE(drive.to_end());
  EXPECT_NEAR(drive.out().command.v[0], 2, 1e-9);
}

TEST(BadProgram, AfterTheAlarmResetAndTheNextStartWorks) {
  for (const BadProgram& bad : kBad) {
    SCOPED_TRACE(bad.name);
    Drive drive(nc::test::parse_or_fail(nc::test::base_toml()));
    drive.start(drive.add("bad.nc", bad.text));
    drive.steps(600);
    ASSERT_TRUE(drive.runtime->snapshot().alarmed());
    EXPECT_EQ(drive.runtime->execute(CommandKind::kCycleStart), Answer::kAlarmActive);
    ASSERT_GT(drive.reset(), 0u);
    EXPECT_FALSE(drive.runtime->snapshot().alarmed());
    drive.start(drive.add("good.nc", "G90 G0 X33.\nG1 X30. F600.\nM30\n"));
    EXPECT_TRUE(drive.to_end());
    EXPECT_NEAR(drive.out().command.v[0], 30, 1e-9);
  }
}

// Reset at any moment: on the path, in a dwell, while a function waits for FIN, at a block stop. The machine
// comes to rest, forgets the program, and the next start executes it from its head as from a control that
// stands there.
TEST(Reset, AnywhereThenStartAgain) {
  const char* const text =
      "G90 G0 X0. Y0. Z0.\nG1 X30. F3000.\nG3 X30. Y20. J10.\nG4 P300\nM50\nT3 "
      "M6\n#1100=1\n#500=#1000+1\nM0\n"
      "WHILE [#1 LT 5] DO1\nG91 G1 X-2. F900.\n#1=#1+1\nEND1\nG90 G0 X0. Y0.\nM30\n";
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  Drive drive(config);
  const unsigned file = drive.add("a.nc", text);
  for (unsigned at = 3; at < 2300; at += 61) {
    SCOPED_TRACE(at);
    drive.start(file);
    for (unsigned i = 0; i < at; ++i) {
      drive.runtime->step();
      if (i % 400 == 399 && drive.out().state == NC_STATE_STOPPED)
        drive.runtime->execute(CommandKind::kCycleStart);
    }
    ASSERT_GT(drive.reset(), 0u);
    const nc_outputs rest = drive.out();
    EXPECT_EQ(rest.strobe, 0) << "no function is left waiting";
    EXPECT_EQ(drive.runtime->snapshot().alarms.count, 0u);
    drive.steps(50);
    const nc_outputs later = drive.out();
    EXPECT_EQ(std::memcmp(&rest.command, &later.command, sizeof(nc_axes)), 0) << "at rest";
    EXPECT_EQ(later.state, NC_STATE_IDLE);
  }
  // From wherever the last one stopped: the whole program again.
  drive.start(file);
  ASSERT_TRUE(drive.to_end());
  EXPECT_NEAR(drive.out().command.v[0], 0, 1e-9);
  EXPECT_NEAR(drive.out().command.v[1], 0, 1e-9);
}

TEST(Reset, MacroOutputsSurviveIt) {
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  Drive drive(config);
  const unsigned file = drive.add("a.nc", "#1100=1\n#1133=4711\nG90 G1 X300. F1000.\nM30\n");
  drive.start(file);
  drive.steps(500);
  const int bit = config.points.find("out0"), word = config.points.find("word_out");
  ASSERT_EQ(drive.machine().outputs().value[bit], 1u);
  ASSERT_EQ(drive.machine().outputs().value[word], 4711u);
  drive.reset();
  drive.steps(50);
  EXPECT_EQ(drive.machine().outputs().value[bit], 1u);
  EXPECT_EQ(drive.machine().outputs().value[word], 4711u);
  drive.start(drive.add("b.nc", "#500=#1100*10000+#1133\nM30\n"));
  ASSERT_TRUE(drive.to_end());
  double value = 0;
  bool vacant = true;
  ASSERT_EQ(nc_variable_get(drive.runtime->control(), 0, 500, &value, &vacant), NC_OK);
  EXPECT_EQ(value, 14711) << "read back";
}

// An alarm of the machine whose cause is gone: one reset is enough with the real NC, too, and the next start
// works.
TEST(Reset, OneIsEnoughAfterAnAlarmOfTheMachine) {
  for (const bool drive_fault : {true, false}) {
    SCOPED_TRACE(drive_fault);
    nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
    config.sim.axis[0][0].following_error_limit = 2.0;
    Drive drive(config);
    const unsigned file = drive.add("a.nc", "G90 G1 X20. F3000.\nG0 X0.\nM30\n");
    drive.start(file);
    drive.steps(100);
    if (drive_fault)
      drive.machine().fail_drive(0, 1, true);  // Y stands, so that it has no distance to catch up
    else
      drive.machine().block_axis(0, 0, true);
    drive.steps(300);
    ASSERT_EQ(drive.runtime->snapshot().alarms.count, 1u);
    EXPECT_NE(drive.runtime->snapshot().alarms.alarm[0].id, nc::rt::AlarmId::kProgram);
    ASSERT_EQ(drive.runtime->execute(CommandKind::kReset), Answer::kDone);
    drive.steps(20);
    EXPECT_EQ(drive.runtime->snapshot().alarms.count, 1u) << "the cause is still there";
    drive.machine().fail_drive(0, 1, false);
    drive.machine().block_axis(0, 0, false);
    drive.steps(100);
    ASSERT_GT(drive.reset(), 0u);
    EXPECT_EQ(drive.runtime->snapshot().alarms.count, 0u);
    drive.start(file);
    EXPECT_TRUE(drive.to_end());
  }
}

// M700 13.5.5: an output changes when the machine reaches its block, not when the text is read.
TEST(MacroOutput, IsWrittenWhenTheMachineGetsThere) {
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  Drive drive(config);
  drive.start(drive.add("a.nc", "G90 G1 X50. F3000.\n#1100=1\nG1 X60.\nM30\n"));
  const int bit = config.points.find("out0");
  bool seen = false;
  for (unsigned i = 0; i < 5000 && drive.runtime->info().system[0].runs == 0; ++i) {
    drive.runtime->step();
    const bool on = drive.machine().outputs().value[bit] != 0;
    const double x = drive.out().command.v[0];
    if (on && !seen) {
      EXPECT_GE(x, 50 - 1e-6);
      EXPECT_LE(x, 50.1);
    }
    if (!on) {
      EXPECT_LE(x, 50.0 + 1e-6);
    }
    seen |= on;
  }
  EXPECT_TRUE(seen);
}

TEST(Manual, JogStaysInsideTheSoftLimitsAndMdiFollows) {
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  Drive drive(config);
  ASSERT_EQ(drive.runtime->execute(CommandKind::kSetMode, 0, 2), Answer::kDone);
  nc::rt::Command jog;
  jog.kind = CommandKind::kJog;
  jog.value = 150.0;
  for (unsigned i = 0; i < 6000; ++i) {
    if (i % 100 == 0) {
      const bool there = drive.out().command.v[0] >= 500;
      EXPECT_EQ(drive.runtime->execute(jog), there ? Answer::kSoftLimit : Answer::kDone);
    }
    drive.runtime->step();
  }
  EXPECT_NEAR(drive.out().command.v[0], 500.0, 1e-6) << "clipped, no alarm";
  EXPECT_EQ(drive.runtime->snapshot().alarms.count, 0u);
  drive.steps(300);
  ASSERT_EQ(drive.runtime->execute(CommandKind::kSetMode, 0, 1), Answer::kDone);
  ASSERT_EQ(drive.runtime->load_mdi("G90 G0 X480."), Answer::kDone);
  ASSERT_EQ(drive.runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  EXPECT_TRUE(drive.to_end());
  EXPECT_NEAR(drive.out().command.v[0], 480.0, 1e-9);
  ASSERT_EQ(drive.runtime->execute(CommandKind::kSetMode, 0, 2), Answer::kDone);
  nc::rt::Command step;
  step.kind = CommandKind::kStep;
  step.value = -0.125;
  ASSERT_EQ(drive.runtime->execute(step), Answer::kDone);
  drive.steps(200);
  EXPECT_NEAR(drive.out().command.v[0], 479.875, 1e-9);
  step.kind = CommandKind::kReference;
  ASSERT_EQ(drive.runtime->execute(step), Answer::kDone);
  drive.steps(6000);
  EXPECT_NEAR(drive.out().command.v[0], 0, 1e-9);
}

}  // namespace
