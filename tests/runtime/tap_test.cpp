// SPDX-License-Identifier: Apache-2.0
// Synchronous taps on the simulated machine, whose spindle accelerates as its motor can (M700 13.1.1): the pair of axis and spindle, the tap that is left in
// its hole, and what is kept of it over a power cut.
#include <gtest/gtest.h>

#include <functional>

#include "ladder_machine.hpp"
#include "runtime/retain/tables.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr double kLead = 1.5, kRamp_rpm_s = 3000;
constexpr const char* kTap = "G90 G0 Z10.\nG84 X0 Y0 Z-8. R2. S600 F1.5 P100 ,R1\nG80\nM30\n";

std::string tapping_toml(const std::string& start_of_z = "0.0") {
  std::string text = nc::test::base_toml();
  const std::string name = "name = \"Z\"\n";
  text.insert(text.find(name) + name.size(), "start = " + start_of_z + "\n");
  const std::string ramp = "spindle_ramp_rpm_per_s = 100000.0";
  text.replace(text.find(ramp), ramp.size(), "spindle_ramp_rpm_per_s = 3000.0");
  // 600 r/min in 0.25 s, 2400 r/min and s: the motor can 3000.
  return text + "[parameters]\n\"3005\" = 3000\n\"3013\" = 600\n\"3017\" = 250\n";
}

class SimTap : public nc::test::LadderMachine {
 protected:
  void SetUp() override { config = nc::test::parse_or_fail(tapping_toml()); }
  double z() const { return out().command.v[2]; }
  double turns() const { return machine->spindle_turns(0, 0); }
  void into_the_hole() {
    start(kTap);
    ASSERT_GE(until([&] { return out().tapping && z() < -3; }), 0);
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE && out().tap_retract_possible; }), 0);
    for (unsigned n = 0; n < 500; ++n) runtime->step();
  }
  /// The command draws the tap out up to R. `each`: what is looked at in every cycle.
  void draw_out(const std::function<void()>& each = [] {}) {
    ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
    for (unsigned n = 0; n < 100; ++n) runtime->step();
    ASSERT_EQ(runtime->execute(CommandKind::kTapRetract, 0, 1), Answer::kDone);
    ASSERT_GE(until([&] {
                each();
                return !out().tap_retract_possible && out().state == NC_STATE_IDLE;
              }),
              0);
    EXPECT_NEAR(z(), 2, 2e-3);
  }
};

TEST_F(SimTap, AxisAndSpindleStayTogether) {
  build();
  const std::uint64_t runs = runtime->info().system[0].runs;
  start(kTap);
  double began = 0, worst = 0, deepest = 0;
  ASSERT_GE(until([&] {
              if (out().spindle_synchronous == 0) began = turns();
              else if (out().tapping) {
                worst = std::max(worst, std::fabs(2 - z() - kLead * (turns() - began)));
                deepest = std::max(deepest, turns() - began);
              }
              return out().state == NC_STATE_IDLE && runtime->info().system[0].runs > runs;
            }),
            0);
  // In one cycle the lag changes by no more than the motor accelerates.
  const double cycle_s = config.nc.cycle_s;
  EXPECT_LT(worst, 1e-3 + kLead * kRamp_rpm_s / 60 * cycle_s * cycle_s) << "mm";
  EXPECT_NEAR(deepest, 10 / kLead, 0.25) << "turns, of the command at the bottom";
}

TEST_F(SimTap, ACommandDrawsTheTapOut) {
  into_the_hole();
  const double began = turns(), stood = z();
  EXPECT_LT(stood, -3);
  EXPECT_EQ(runtime->execute(CommandKind::kTapRetract, 0, 1), Answer::kNotInThisMode);
  double worst = 0;
  draw_out([&] { worst = std::max(worst, std::fabs(z() - stood + kLead * (turns() - began))); });
  EXPECT_LT(worst, 2e-3);
  EXPECT_EQ(runtime->execute(CommandKind::kTapRetract, 0, 1), Answer::kRefusedByControl) << "there is none in a hole any more";
}

TEST_F(SimTap, OtherAxesAreRefusedWithTheReasonWhileItStandsInItsHole) {
  into_the_hole();
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kTapInHole);
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
  const double x = out().command.v[0];
  const auto ask = [&](CommandKind kind, unsigned axis, double value) {
    nc::rt::Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    return runtime->execute(command);
  };
  EXPECT_EQ(ask(CommandKind::kJog, 0, 10), Answer::kTapInHole);
  EXPECT_EQ(ask(CommandKind::kStep, 1, 1), Answer::kTapInHole);
  EXPECT_EQ(ask(CommandKind::kReference, 0, 0), Answer::kTapInHole);
  for (unsigned n = 0; n < 100; ++n) runtime->step();
  EXPECT_EQ(out().command.v[0], x);
  EXPECT_EQ(ask(CommandKind::kStep, 2, 8), Answer::kDone);
  ASSERT_GE(until([&] { return out().tap_holds == 0; }), 0);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }), 0);
  EXPECT_EQ(ask(CommandKind::kStep, 0, 1), Answer::kDone);
}

// The supply fails in the hole: axis and spindle come to rest together, and behind the reset the tap is drawn out.
TEST_F(SimTap, WhenThePowerFailsInTheHoleItIsDrawnOutBehindTheReset) {
  config = nc::test::parse_or_fail(tapping_toml() + "[[point]]\nname = \"power_good\"\ndirection = \"input\"\ninitial = 1\n[signals]\n\"plc.power_fail_n\" = \"power_good\"\n"
                                   "[power]\nstop_s = 2.0\nsettle_s = 0.05\n");
  const auto power = [&](bool good) { machine->set_input(static_cast<unsigned>(config.points.find("power_good")), good ? 1 : 0); };
  build();
  start(kTap);
  ASSERT_GE(until([&] { return out().tapping && z() < -3; }), 0);
  const double began = turns(), stood = z();
  power(false);
  double worst = 0;
  ASSERT_GE(until([&] {
              if (out().spindle_synchronous != 0) worst = std::max(worst, std::fabs(stood - z() - kLead * (turns() - began)));
              return alarm().find("came to rest on their paths") != std::string::npos;
            }),
            0)
      << alarm();
  EXPECT_LT(worst, 2e-3) << "mm";
  power(true);
  for (unsigned n = 0; n < 100; ++n) runtime->step();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE && out().tap_retract_possible && !runtime->snapshot().resetting; }), 0) << alarm();
  draw_out();
}

TEST_F(SimTap, WhatIsKeptDrawsItOutBehindAPowerCut) {
  build();
  const nc::rt::TableRows configured = nc::rt::read_tables(runtime->control(), config.nc);
  start(kTap);
  ASSERT_GE(until([&] { return out().tapping && z() < -3; }), 0);
  const std::string kept = nc::rt::encode_changes(nc::rt::executed_tables(runtime->control(), config.nc), configured);
  EXPECT_NE(kept.find("tap 0 0"), std::string::npos) << kept;

  runtime.reset();
  config = nc::test::parse_or_fail(tapping_toml("-4.0"));
  machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
  std::vector<nc::rt::ConfigError> errors;
  runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(nc::rt::restore_changes(runtime->control(), config.nc, configured, kept));  // before the first scan, as the keeper does
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  for (unsigned n = 0; n < 10; ++n) runtime->step();
  EXPECT_NEAR(z(), -4, 1e-6);
  ASSERT_TRUE(out().tap_retract_possible);
  const double began = turns();
  draw_out();
  EXPECT_NEAR(turns() - began, -6 / kLead, 0.01);
}

TEST_F(SimTap, TheTableOfToolLifeIsKept) {
  build();
  nc_control* const control = runtime->control();
  const nc::rt::TableRows configured = nc::rt::read_tables(control, config.nc);
  ASSERT_EQ(nc_tool_life_set(control, 2, NC_LIFE_GROUP, 7), NC_OK);
  ASSERT_EQ(nc_tool_life_set(control, 2, NC_LIFE_USED, 1.5), NC_OK);
  const std::string kept = nc::rt::encode_changes(nc::rt::read_tables(control, config.nc), configured);
  ASSERT_EQ(nc_tool_life_set(control, 2, NC_LIFE_GROUP, 0), NC_OK);
  ASSERT_EQ(nc_tool_life_set(control, 2, NC_LIFE_USED, 0), NC_OK);
  ASSERT_TRUE(nc::rt::restore_changes(control, config.nc, configured, kept));
  double group = 0, used = 0;
  ASSERT_EQ(nc_tool_life_get(control, 2, NC_LIFE_GROUP, &group), NC_OK);
  ASSERT_EQ(nc_tool_life_get(control, 2, NC_LIFE_USED, &used), NC_OK);
  EXPECT_EQ(group, 7);
  EXPECT_EQ(used, 1.5);
  // A file of before there were records: its rows are those of the columns, and are read and written as they were.
  const std::string columns =
      "nc tables 1\nlife 3 0\n0\n9\nlife 3 1\n0\n101\nlife 3 2\n0\n19\nlife 3 3\n0\n2\nlife 3 4\n0\n60\nlife 3 5\n0\n60.25\nlife 3 6\n0\n4\nlife 3 7\n0\n5\nlife 3 8\n0\n-1.5\nend\n";
  runtime.reset();  // before its machine, which build() replaces
  build();
  nc_control* const next = runtime->control();
  ASSERT_TRUE(nc::rt::restore_changes(next, config.nc, configured, columns));
  EXPECT_EQ(nc::rt::encode_changes(nc::rt::read_tables(next, config.nc), configured), columns);
  EXPECT_FALSE(nc::rt::restore_changes(next, config.nc, configured, "nc tables 1\nlive 2 0\n0\n7\nend\n")) << "no such table";
}

}  // namespace
