// SPDX-License-Identifier: Apache-2.0
// A run of ncrtd on virtual time: its exit status, and what it prints.
#include "tools/lib/program_run.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <memory>

#include "runtime/end_signal.hpp"
#include "runtime/hal_factory.hpp"

namespace nc::tools {
namespace {

constexpr const char* kMachine = R"([machine]
name = "test"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
soft_limits = [-500.0, 500.0]
[[axis]]
name = "Y"
max_velocity = 200.0
max_acceleration = 2000.0
[[axis]]
name = "Z"
max_velocity = 200.0
max_acceleration = 2000.0
)";

class Run : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rt::parse_config(kMachine, "machine.toml", &config).empty());
    machine = rt::make_machine(config, {});
    std::vector<rt::ConfigError> errors;
    runtime = rt::Runtime::create(config, {&clock, machine.hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    rt::catch_end_signals({SIGHUP});
    options.command = DaemonOptions::Command::kRun;
    options.fast = options.no_progress = true;
  }
  void TearDown() override {
    runtime->stop();
    std::signal(SIGHUP, SIG_DFL);
    std::signal(SIGPIPE, SIG_DFL);
  }
  // Runs a program to its end; its output is then in `out` and `err`.
  int run(const char* text) {
    unsigned file = 0;
    std::string error;
    EXPECT_EQ(nc_program_add_text(runtime->control(), "PART", text, std::strlen(text), &file), NC_OK);
    EXPECT_TRUE(runtime->start_stepping(&error)) << error;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    rt::Progress progress(stdout, false, 0);
    PrintLines printed;
    ProgramRun program(runtime.get(), options, &progress, &printed);
    const int status = program.to_end(runtime->select_program(file));
    alarm = program.alarm_code();
    std::fflush(stdout);
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return status;
  }
  static bool holds(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

  rt::Config config;
  rt::MadeMachine machine;
  rt::VirtualClock clock;
  std::unique_ptr<rt::Runtime> runtime;
  DaemonOptions options;
  std::string out, err, alarm;
};

TEST_F(Run, EndsWithTheProgram) {
  EXPECT_EQ(run("G91 G01 X10. F6000\nM30\n"), 0);
  EXPECT_TRUE(holds(out, "path")) << out;
  EXPECT_EQ(err, "");
  EXPECT_EQ(alarm, "");
}

TEST_F(Run, GoesOnBehindAStop) {
  EXPECT_EQ(run("G91 G01 X10. F6000\nM00\nX-10.\nM30\n"), 0);
  EXPECT_TRUE(holds(out, "stop in line 2")) << out;
  EXPECT_TRUE(holds(out, "continued")) << out;
}

TEST_F(Run, SaysNothingOfStopsWhenItIsToBeQuiet) {
  options.quiet = true;
  EXPECT_EQ(run("M00\nM30\n"), 0);
  EXPECT_FALSE(holds(out, "stop in line")) << out;
}

TEST_F(Run, StopsOnAnAlarmAndNamesIt) {
  EXPECT_EQ(run("G01 X10. F6000\nG01 X9999.\nM30\n"), kDaemonAlarm);
  EXPECT_EQ(err.rfind("alarm: " + alarm + " ", 0), 0u) << err;
  EXPECT_NE(alarm, "");
  EXPECT_TRUE(holds(err, "line 2")) << err;
}

TEST_F(Run, ASignalBringsItToRestAndIsTheStatus) {
  ASSERT_EQ(std::raise(SIGHUP), 0);
  EXPECT_EQ(run("G91 G01 X400. F600\nM30\n"), rt::exit_status_of_signal(SIGHUP));
  EXPECT_TRUE(holds(out, "interrupted  by SIGHUP in line")) << out;
  EXPECT_TRUE(runtime->snapshot().system[0].nc.distance_zero);
}

TEST_F(Run, WhatIsNotStartedSaysWhy) {
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  rt::Progress progress(stdout, false, 0);
  PrintLines printed;
  ProgramRun program(runtime.get(), options, &progress, &printed);
  testing::internal::CaptureStderr();
  EXPECT_EQ(program.to_end(runtime->select_program(99)), kDaemonUsage);
  err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(err.rfind("ncrtd: not started: ", 0), 0u) << err;
}

}  // namespace
}  // namespace nc::tools
