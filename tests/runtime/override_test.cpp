// SPDX-License-Identifier: Apache-2.0
// One override is in force; it is shown together with its source, and a command that would have no effect is refused.
#include <gtest/gtest.h>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::OverrideSource;

class Overrides : public testing::Test {
 protected:
  void build(const std::string& more, const char* program) {
    config = nc::test::parse_or_fail(nc::test::base_toml() + more);
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    text = program;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "a.nc", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    steps(300);
  }
  void steps(unsigned count) {
    for (unsigned n = 0; n < count; ++n) runtime->step();
  }
  void expect(double feed, OverrideSource source, double feed_mm_min) {
    const nc::rt::SystemSnapshot now = runtime->snapshot().system[0];
    EXPECT_DOUBLE_EQ(now.feed_override, feed);
    EXPECT_EQ(now.feed_override_source, source);
    EXPECT_NEAR(now.nc.feed_mm_min, feed_mm_min, 1);
  }
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<nc::hal::SimMachine> machine;
  std::unique_ptr<nc::rt::Runtime> runtime;
  std::string text;
};

TEST_F(Overrides, TheOperatorsWithoutASwitch) {
  build("", "G1 X400. F1200\nM30\n");
  expect(1, OverrideSource::kOperator, 1200);
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 0.5), Answer::kDone);
  steps(300);
  expect(0.5, OverrideSource::kOperator, 600);
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 7), Answer::kOutOfRange);
}

TEST_F(Overrides, ASwitchOfTheMachineWinsAndIsShown) {
  build("[signals]\n\"plc.feed_override\" = \"word_in\"\n", "G1 X400. F1200\nM30\n");
  expect(0, OverrideSource::kMachine, 0);  // the switch begins with 0
  EXPECT_EQ(runtime->snapshot().system[0].nc.cause, NC_CAUSE_OVERRIDE_ZERO);
  const unsigned point = static_cast<unsigned>(config.points.find("word_in"));
  machine->set_input(point, 5000);
  steps(300);
  expect(0.5, OverrideSource::kMachine, 600);
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 1), Answer::kMachineSwitch);
  EXPECT_EQ(runtime->explain(Answer::kMachineSwitch), "the override switch of the machine is in force");
  steps(300);
  expect(0.5, OverrideSource::kMachine, 600);
  machine->set_input(point, 60000);  // more than the machine allows
  steps(300);
  expect(config.nc.max_feed_override, OverrideSource::kMachine, 1200 * config.nc.max_feed_override);
  machine->set_input(point, ~0u);  // -1: the machine gives no override
  steps(300);
  expect(1, OverrideSource::kOperator, 1200);
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 0.25), Answer::kDone);
  steps(300);
  expect(0.25, OverrideSource::kOperator, 300);
  // The rapid override is independent of it.
  EXPECT_EQ(runtime->execute(CommandKind::kRapidOverride, 0.25), Answer::kDone);
  steps(2);
  EXPECT_DOUBLE_EQ(runtime->snapshot().system[0].rapid_override, 0.25);
  EXPECT_EQ(runtime->snapshot().system[0].rapid_override_source, OverrideSource::kOperator);
}

TEST_F(Overrides, AProgramThatForbidsItSaysSo) {
  build("", "#3004=2\nG1 X400. F1200\nM30\n");
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 0.5), Answer::kDone);
  steps(300);
  expect(1, OverrideSource::kProgram, 1200);
}

}  // namespace
