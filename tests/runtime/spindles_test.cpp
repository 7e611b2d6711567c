// SPDX-License-Identifier: Apache-2.0
// Two spindles, of which the first is a C axis, too, on the simulated machine with a ladder program that selects them (M700 10.5, 10.6).
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ladder_machine.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/signals/signal_table.hpp"

namespace {

using nc::rt::AlarmId;

// M21 and M22 select the first and the second spindle, M20 none; M3 and M5 are for the selected ones; M80 makes the first one axis C, M81
// a spindle again. FIN comes when that is done.
constexpr const char* kLadder = R"(
LD nc.m_strobe
ANDD= nc.m_code K20
RST M101
RST M102
LD nc.m_strobe
ANDD= nc.m_code K21
SET M101
RST M102
LD nc.m_strobe
ANDD= nc.m_code K22
RST M101
SET M102
LD M101
OUT plc.spindle_select.1
LD M102
OUT plc.spindle_select.2

LD SM400
DMOV nc.spindle_command.1 rpm1
DMOV nc.spindle_command.2 rpm2
LD nc.m_strobe
ANDD= nc.m_code K3
AND nc.spindle_selected.1
SET fwd1
LD nc.m_strobe
ANDD= nc.m_code K3
AND nc.spindle_selected.2
SET fwd2
LD nc.m_strobe
ANDD= nc.m_code K5
AND nc.spindle_selected.1
RST fwd1
LD nc.m_strobe
ANDD= nc.m_code K5
AND nc.spindle_selected.2
RST fwd2

LD nc.m_strobe
ANDD= nc.m_code K80
SET M110
RST fwd1
LD nc.m_strobe
ANDD= nc.m_code K81
RST M110
LD M110
OUT plc.servo_on.C
LD nc.m_strobe
ANDD= nc.m_code K80
AND in0
OUT plc.recalculate

LD  nc.m_strobe
OR  nc.s_strobe
OUT M0
LD  M0
OUTH T0 K2
LD  T0
OUT M1
LD  nc.m_strobe
ANDD= nc.m_code K3
AND nc.spindle_selected.1
ANI nc.spindle_at_speed.1
OUT M31
LD  nc.m_strobe
ANDD= nc.m_code K3
AND nc.spindle_selected.2
ANI nc.spindle_at_speed.2
OUT M32
LD  nc.m_strobe
ANDD= nc.m_code K80
ANI nc.servo_ready.C
OUT M33
LD  M1
ANI M31
ANI M32
ANI M33
OUT plc.fin1
END
)";

std::string machine_toml() {
  std::string text = nc::test::base_toml();
  const std::string name = "name = \"test\"\n";
  text.insert(text.find(name) + name.size(), "spindles = [2]\n");
  text += R"([sim.spindle]
forward = "fwd1"
speed = "rpm1"
[sim.spindle2]
forward = "fwd2"
speed = "rpm2"
[[axis]]
name = "C"
rotary = true
spindle = 1
max_velocity = 720.0
max_acceleration = 7200.0
max_jerk = 100000.0
servo_lag_ms = 2.0
following_error_limit = 5.0
)";
  for (const char* point : {"fwd1", "fwd2"}) text += "[[point]]\nname = \"" + std::string(point) + "\"\ndirection = \"output\"\n";
  for (const char* point : {"rpm1", "rpm2"}) text += "[[point]]\nname = \"" + std::string(point) + "\"\ntype = \"word\"\ndirection = \"output\"\n";
  return text;
}

class LadderSpindles : public nc::test::OwnLadder {
 protected:
  void prepare(const std::string& parameters = "[parameters]\n\"PREREAD_STOP_M1\" = 80\n") {
    use(kLadder);
    const std::string ladder = config.ladder.program;
    config = nc::test::parse_or_fail(machine_toml() + parameters + "[ladder]\nprogram = \"own.il\"\n");
    config.ladder.program = ladder;
    build();
  }
  double rpm(unsigned number) const { return machine->spindle_rpm(0, number); }
  double turns(unsigned number) const { return runtime->snapshot().system[0].spindle[number].turns; }
  double c() const { return machine->actual(0).v[3]; }
};

TEST_F(LadderSpindles, EachTurnsAtItsOwnSpeed) {
  prepare();
  start("M21\nS1000 M3\nM22\nS2500 M3\nG4 X0.2\nM21\nS400\nG4 X0.2\nM20\nS700\nG4 X0.2\nM30\n");
  ASSERT_GT(until_line(2), 0);
  EXPECT_EQ(point("rpm2"), 0u) << "never selected";
  ASSERT_GT(until_line(5), 0);
  steps(150);
  EXPECT_NEAR(rpm(0), 1000, 1e-6) << "keeps the speed that it had";
  EXPECT_NEAR(rpm(1), 2500, 1e-6);
  ASSERT_GT(until_line(8), 0);
  steps(150);
  EXPECT_NEAR(rpm(0), 400, 1e-6);
  EXPECT_NEAR(rpm(1), 2500, 1e-6);
  ASSERT_GT(until_line(11), 0);
  steps(150);
  EXPECT_NEAR(rpm(0), 400, 1e-6) << "no spindle is selected";
  EXPECT_NEAR(rpm(1), 2500, 1e-6);
  EXPECT_EQ(out().s, 700) << "but the PLC has the code";
  ASSERT_GE(until_end(), 0) << alarm();
}

TEST_F(LadderSpindles, TheFeedPerRevolutionIsThatOfTheSelectedOne) {
  prepare();
  start("M21\nS1000 M3\nM22\nS3000 M3\nG95 G1 X10. F0.2\nM21\nS1000 M3\nX0\nM30\n");
  ASSERT_GT(until_line(5), 0);
  ASSERT_GT(until([&] { return machine->actual(0).v[0] > 5; }), 0);
  EXPECT_NEAR(out().feed_mm_min, 0.2 * 3000, 1);
  ASSERT_GT(until_line(8), 0);
  ASSERT_GT(until([&] { return machine->actual(0).v[0] < 5; }), 0);
  EXPECT_NEAR(out().feed_mm_min, 0.2 * 1000, 1);
  ASSERT_GE(until_end(), 0) << alarm();
}

TEST_F(LadderSpindles, TheFirstIsAxisCWhileItsServoIsOn) {
  prepare();
  start("M21\nS600 M3\nG1 X30. F6000\nM80\nG0 C90.\nG1 C100. X40. F3000\nM81\nM3\nG4 X0.3\nM80\nG91 G0 C-30.\nM81\nM30\n");
  ASSERT_GT(until_line(4), 0);
  EXPECT_GT(turns(0), 0.5);
  EXPECT_NEAR(rpm(0), 600, 1e-6);
  ASSERT_GT(until_line(5), 0) << alarm();
  EXPECT_EQ(out().servo_ready, 1u << 3);
  EXPECT_EQ(out().referenced, 1u << 3);
  EXPECT_NEAR(turns(0), std::floor(turns(0) + 0.5), 1e-9) << "oriented";
  ASSERT_GT(until_line(7), 0) << alarm();
  EXPECT_NEAR(c(), 100, 0.05);
  EXPECT_NEAR(turns(0) - std::floor(turns(0)), 100.0 / 360, 1e-4) << "the spindle is the axis";
  ASSERT_GT(until_line(9), 0) << alarm();
  steps(100);
  EXPECT_NEAR(rpm(0), 600, 1e-6) << "a spindle again";
  EXPECT_EQ(out().command.v[3], 100) << "its counter is held";
  ASSERT_GT(until_line(12), 0) << alarm();
  EXPECT_NEAR(out().command.v[3], -30, 1e-9) << "from the zero mark, where it was oriented";
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(alarm(), "");
}

TEST_F(LadderSpindles, WithoutTheRecalculationTheCommandIsP430) {  // M700 10.5 (2), *2
  prepare("");
  start("M80\nG0 C90.\nM30\n");
  ASSERT_GE(until([&] { return runtime->info().system[0].alarm; }), 0);
  EXPECT_STREQ(runtime->info().system[0].program_alarm.code, "P430");
  EXPECT_EQ(runtime->info().system[0].program_alarm.axis, 3);
}

TEST_F(LadderSpindles, WithItTheCommandIsReadAgain) {  // M700 10.5 (2), *1
  prepare("");
  in("in0", 1);
  steps(2);
  start("M80\nG0 C90.\nM81\nM30\n");
  ASSERT_GE(until_end(), 0) << alarm();
  EXPECT_EQ(alarm(), "");
  EXPECT_NEAR(out().command.v[3], 90, 1e-9);
}

TEST_F(LadderSpindles, SwitchingTheServoOffDropsTheRestOfTheCommand) {  // M700 10.5, precaution (3)
  prepare();
  start("M80\nG1 X100. C720. F6000\nX110. F6000\nM30\n");
  ASSERT_GT(until([&] { return machine->actual(0).v[0] > 20; }), 0);
  ASSERT_EQ(runtime->force("plc.servo_on.C", 0), nc::rt::Answer::kDone);
  ASSERT_GT(until([&] { return out().cause == NC_CAUSE_SERVO_OFF; }), 0);
  EXPECT_LT(machine->actual(0).v[0], 40);
  ASSERT_EQ(runtime->release("plc.servo_on.C"), nc::rt::Answer::kDone);
  ASSERT_GE(until_end(), 0) << alarm();
  EXPECT_EQ(alarm(), "");
  EXPECT_NEAR(out().command.v[0], 110, 1e-9);
  EXPECT_EQ(out().command.v[3], 0) << "oriented, and not moved any more";
}

// Without a ladder program no spindle is selected: M03 and S are for the first one.
// M700 10.6.1 (6), 13.1.1: a synchronous tap by the second spindle. With the power the selection has gone, and the one that has tapped draws the tap out all the same.
TEST_F(LadderSpindles, ATapKeepsItsSpindleOverAPowerCut) {
  const std::string parameters = "[parameters]\n\"PREREAD_STOP_M1\" = 80\n\"3005\" = 3000\n\"3013\" = 600\n\"3017\" = 250\n";
  constexpr double kLead = 1.5;
  prepare(parameters);
  const nc::rt::TableRows configured = nc::rt::read_tables(runtime->control(), config.nc);
  const auto z = [&] { return out().command.v[2]; };
  const auto angle = [&](unsigned number) { return machine->spindle_turns(0, number); };
  start("M22\nG90 G0 Z10.\nG84 X0 Y0 Z-8. R2. S600 F1.5 P100 ,R1\nG80\nM30\n");
  const double first = angle(0);
  double began = 0, worst = 0;
  ASSERT_GE(until([&] {
              if (out().spindle_synchronous == 0) began = angle(1);
              else if (out().tapping) worst = std::max(worst, std::fabs(2 - z() - kLead * (angle(1) - began)));
              return out().tapping && z() < -3;
            }),
            0)
      << alarm();
  EXPECT_EQ(out().spindle_synchronous, 2);
  EXPECT_LT(worst, 2e-3) << "mm";
  EXPECT_EQ(angle(0), first) << "the other one stands";
  const std::string kept = nc::rt::encode_changes(nc::rt::executed_tables(runtime->control(), config.nc), configured);

  runtime.reset();
  const std::string ladder = config.ladder.program;
  std::string text = machine_toml() + parameters + "[ladder]\nprogram = \"own.il\"\n";
  const std::string name = "name = \"Z\"\n";
  text.insert(text.find(name) + name.size(), "start = -4.0\n");
  config = nc::test::parse_or_fail(text);
  config.ladder.program = ladder;
  machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
  std::vector<nc::rt::ConfigError> errors;
  runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(nc::rt::restore_changes(runtime->control(), config.nc, configured, kept));
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  steps(100);
  ASSERT_TRUE(out().tap_retract_possible);
  const double turned[2] = {angle(0), angle(1)};
  worst = 0;
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), nc::rt::Answer::kDone);
  steps(100);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kTapRetract, 0, 1), nc::rt::Answer::kDone);
  ASSERT_GE(until([&] {
              worst = std::max(worst, std::fabs(z() + 4 + kLead * (angle(1) - turned[1])));
              return !out().tap_retract_possible && out().state == NC_STATE_IDLE;
            }),
            0);
  EXPECT_LT(worst, 2e-3) << "mm beside the thread";
  EXPECT_NEAR(angle(1) - turned[1], -6 / kLead, 0.01);
  EXPECT_EQ(angle(0), turned[0]);
}

TEST_F(LadderSpindles, WithoutALadderTheFirstIsSelected) {
  std::string text = machine_toml();
  for (const char* table : {"[sim.spindle]\nforward = \"fwd1\"\nspeed = \"rpm1\"\n", "[sim.spindle2]\nforward = \"fwd2\"\nspeed = \"rpm2\"\n"})
    text.erase(text.find(table), std::string(table).size());
  config = nc::test::parse_or_fail(text);
  start("M3 S500\nG4 X0.2\nM30\n");
  ASSERT_GT(until_line(2), 0);
  EXPECT_NEAR(rpm(0), 500, 1e-6);
  EXPECT_EQ(rpm(1), 0);
  ASSERT_GE(until_end(), 0);
}

TEST(SpindleSignals, AreThoseOfTheMachine) {
  std::set<std::string> names;
  for (const nc::rt::Signal& signal : nc::rt::machine_signals(nc::test::parse_or_fail(nc::test::base_toml()).nc)) names.insert(signal.name);
  for (const char* name : {"plc.spindle_select.1", "nc.spindle_command.2", "plc.servo_on.X", "plc.servo_on.C"}) EXPECT_EQ(names.count(name), 0u) << name;
  for (const char* name : {"nc.spindle_command.1", "nc.spindle_actual.1", "nc.spindle_at_speed.1"}) EXPECT_EQ(names.count(name), 1u) << name << ": a single spindle has them, too";
  nc_config nc = nc::test::parse_or_fail(nc::test::base_toml()).nc;
  nc.system[0].spindle_count = 2;
  nc.system[0].axis[2].spindle = 1;
  names.clear();
  for (const nc::rt::Signal& signal : nc::rt::machine_signals(nc)) names.insert(signal.name);
  for (const char* name : {"plc.spindle_select.1", "plc.spindle_select.2", "nc.spindle_command.2", "nc.spindle_at_speed.1", "plc.servo_on.Z", "nc.servo_ready.Z", "nc.referenced.Z"})
    EXPECT_EQ(names.count(name), 1u) << name;
  for (const char* name : {"plc.spindle_select.3", "plc.servo_on.X"}) EXPECT_EQ(names.count(name), 0u) << name;
}

}  // namespace
