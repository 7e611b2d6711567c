// SPDX-License-Identifier: Apache-2.0
// The shipped machine with its shipped ladder program: the handshake of M, S, T and B, the spindle and the tool
// changer with their times, and everything that can go wrong with them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "ladder_machine.hpp"
#include "places/places.hpp"

namespace {

using nc::rt::AlarmId;
using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::LadderMachine;
using nc::test::OwnLadder;

TEST_F(LadderMachine, ToolsSpindleAndCoolantTakeTheirTime) {
  start("T2 M6\nM3 S1200\nM8\nG4 X0.1\nM9\nM5\nM30\n");
  const int change = until_line(2);
  ASSERT_GT(change, 0);
  EXPECT_EQ(point("tool_in_spindle"), 2u);
  EXPECT_NEAR(change, 1000 * (config.sim.tool_select_s + config.sim.tool_change_s), 60);
  const int ramp = until_line(3);
  EXPECT_NEAR(ramp, 1000 * 0.97 * 1200 / config.sim.spindle_ramp_rpm_per_s, 40);
  EXPECT_EQ(point("spindle_forward"), 1u);
  EXPECT_GT(machine->spindle_rpm(0), 0.96 * 1200);
  ASSERT_GT(until_line(4), 0);
  EXPECT_EQ(point("coolant"), 1u);
  EXPECT_EQ(point("lamp_green"), 1u);
  ASSERT_GT(until_line(6), 0);
  EXPECT_EQ(point("coolant"), 0u);
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(point("spindle_forward"), 0u);
  EXPECT_NEAR(machine->spindle_rpm(0), 0, 1e-3) << "M05 is complete when the spindle stands";
  EXPECT_EQ(out().fin_wait, 0);
  for (int n = 0; n < 5; ++n) runtime->step();
  EXPECT_EQ(point("lamp_green"), 0u);
}

TEST_F(LadderMachine, ToolChangeStopsATurningSpindleFirst) {
  start("T1 M6\nM3 S3000\nT2 M6\nM30\n");
  ASSERT_GT(until_line(3), 0);
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(point("tool_in_spindle"), 2u);
  EXPECT_EQ(point("spindle_forward"), 0u);
}

TEST_F(LadderMachine, WhileItWaitsTheStopCauseNamesTheGroup) {
  start("T2\nM6\nM30\n");
  ASSERT_GT(until([&] { return out().cause == NC_CAUSE_FIN && out().m == 6; }), 0);
  EXPECT_EQ(out().fin_wait, 1);
  EXPECT_EQ(out().strobe, 1);
}

TEST_F(LadderMachine, ACompletionThatDoesNotComeIsAnAlarmThatNamesIt) {
  config.ladder.fin_timeout_s = 2;
  start("G90 G53 G0 Z-1.\nM6\nM30\n");  // no tool was called
  const int scans = until([&] { return !alarm().empty(); });
  EXPECT_NEAR(scans, 2000, 200);
  EXPECT_EQ(alarm(), "R15 FIN does not come: M6 (line 2)");
  for (int n = 0; n < 20; ++n) runtime->step();
  EXPECT_EQ(point("lamp_red"), 1u);
  EXPECT_EQ(out().strobe, 0);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GT(until([&] { return !runtime->snapshot().resetting && alarm().empty(); }, 2000), 0);
  start("T1 M6\nM30\n");
  ASSERT_GE(until_end(), 0) << "the handshake is clean again";
  EXPECT_EQ(point("tool_in_spindle"), 1u);
}

// The late answer of an interrupted tool change must not complete a function of the next program.
TEST_F(LadderMachine, ResetInTheMiddleOfAToolChangeLeavesTheHandshakeClean) {
  start("T2 M6\nG4 X1.\nM30\n");
  ASSERT_GT(until([&] { return point("atc_change") == 1; }), 0);
  for (int n = 0; n < 200; ++n) runtime->step();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  runtime->step();
  EXPECT_EQ(out().strobe, 0);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 2000), 0);
  EXPECT_EQ(point("atc_change"), 0u);
  start("M8\nT1 M6\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(point("tool_in_spindle"), 1u);
}

TEST_F(LadderMachine, ResetStopsSpindleAndCoolant) {
  start("S1000 M3\nM8\nG4 X5.\nM30\n");
  ASSERT_GT(until_line(3), 0);
  ASSERT_EQ(point("coolant"), 1u);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 2000), 0);
  EXPECT_EQ(point("coolant"), 0u);
  EXPECT_EQ(point("spindle_forward"), 0u);
  ASSERT_GT(until([&] { return point("spindle_stopped") == 1; }), 0);
}

TEST_F(LadderMachine, HoldDuringTheWaitDoesNotLoseTheCompletion) {
  start("T3 M6\nG91 G0 X1.\nM30\n");
  ASSERT_GT(until([&] { return point("atc_change") == 1; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
  ASSERT_GT(until([&] { return point("tool_in_spindle") == 3; }), 0);
  for (int n = 0; n < 100; ++n) runtime->step();
  EXPECT_EQ(out().state, NC_STATE_HOLD);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until_end(), 0);
}

// ---- a ladder program of the test's own ----

// The first example runs as docs/ladder.md says.
TEST_F(OwnLadder, TheFirstExampleOfTheDocumentRuns) {
  std::ifstream file(nc::test::kSourceDir + "/docs/ladder.md");
  std::ostringstream text;
  text << file.rdbuf();
  const std::size_t at = text.str().find("```il\n") + 6;
  use(text.str().substr(at, text.str().find("```", at) - at));
  ASSERT_TRUE(nc::rt::load_config(nc::test::kSourceDir + "/etc/machine.toml", &config).empty());
  config.ladder.program = path_;
  start("M8\nM50\nM9\nM30\n");
  EXPECT_NEAR(until_line(2), 2000, 60) << "the coolant comes";
  EXPECT_EQ(point("coolant"), 1u);
  EXPECT_LT(until_line(3), 60) << "M50 is not waited for";
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(point("coolant"), 0u);
}

TEST_F(OwnLadder, Fin2GoesOnWhenItRises) {
  use("LD nc.m_strobe\nOR nc.t_strobe\nOUT plc.fin2\nEND\n");
  start("M8\nT5\nM9\nG4 X0.01\nM30\n");
  EXPECT_GE(until_end(), 0);
}

TEST_F(OwnLadder, AFinThatIsStuckOnHoldsTheNextStrobeBack) {
  use("LD nc.m_strobe\nSET plc.fin1\nEND\n");
  start("M8\nM9\nM30\n");
  for (int n = 0; n < 500; ++n) runtime->step();
  EXPECT_EQ(out().m, 8u);
  EXPECT_EQ(out().strobe, 0);
  EXPECT_EQ(out().cause, NC_CAUSE_FIN);
  EXPECT_EQ(out().fin_wait, 1) << "FIN1 has not fallen";
}

TEST_F(OwnLadder, AFinThatIsStuckOnFromTheStartIsAnAlarmToo) {
  use("LD SM400\nOUT plc.fin1\nEND\n");
  config.ladder.fin_timeout_s = 1;
  start("M50\nM30\n");
  ASSERT_GT(until([&] { return !alarm().empty(); }, 3000), 0);
  EXPECT_EQ(alarm(), "R15 FIN1 was on before the strobe: M waits until it has been off (line 1)");
}

TEST_F(LadderMachine, SpeedZeroWithATurningSpindleIsCompleteWhenItStands) {
  start("S1000 M3\nS0\nM5\nM30\n");
  EXPECT_GE(until_end(), 0);
}

TEST_F(OwnLadder, AlarmsOfTheLadderStopAndComeBackWhileTheyAreOn) {
  use("LD in0\nOUT plc.alarm.2\nLD nc.m_strobe\nOUT plc.fin2\nEND\n");
  config.ladder.alarm[1] = "Door open";
  start("G91 G1 X400. F1000\nM30\n");
  for (int n = 0; n < 200; ++n) runtime->step();
  ASSERT_GT(out().feed_mm_min, 0);
  machine->set_input(static_cast<unsigned>(config.points.find("in0")), 1);
  for (int n = 0; n < 500; ++n) runtime->step();
  EXPECT_EQ(alarm(), "R16 Alarm of the ladder 2: Door open (line 1)");
  EXPECT_EQ(out().feed_mm_min, 0);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kAlarmActive);
  runtime->execute(CommandKind::kReset);
  for (int n = 0; n < 500; ++n) runtime->step();
  EXPECT_EQ(alarm().substr(0, 3), "R16") << "the cause is still there";
  machine->set_input(static_cast<unsigned>(config.points.find("in0")), 0);
  runtime->execute(CommandKind::kReset);
  for (int n = 0; n < 500; ++n) runtime->step();
  EXPECT_EQ(alarm(), "");
}

TEST_F(OwnLadder, StartHoldInterlockAndOverrideByTheLadder) {
  use("LD in0\nOUT plc.cycle_start\nLDI in1\nOUT plc.feed_hold_n\nLD SM400\nDMOV word_in D0\nMOV D0 plc.feed_override\n"
      "LD SM400\nOUT plc.interlock_n\nLD nc.m_strobe\nOUT plc.fin2\nEND\n");
  build();
  const auto in = [&](const char* name, std::uint32_t value) {
    machine->set_input(static_cast<unsigned>(config.points.find(name)), value);
  };
  in("word_in", 5000);  // 50 %
  unsigned file = 0;
  const std::string& text = texts.emplace_back("G91 G1 X400. F1200\nM30\n");
  ASSERT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
  ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  const auto steps = [&](int n) {
    while (n-- > 0) runtime->step();
  };
  in("in0", 1);
  steps(50);
  EXPECT_EQ(out().state, NC_STATE_IDLE) << "a start acts when the button is released";
  in("in0", 0);
  steps(500);
  EXPECT_EQ(out().state, NC_STATE_RUNNING);
  EXPECT_NEAR(out().feed_mm_min, 600, 1);
  in("in1", 1);
  steps(500);
  EXPECT_EQ(out().state, NC_STATE_HOLD);
  EXPECT_EQ(out().feed_mm_min, 0);
  in("in1", 0);
  steps(100);
  EXPECT_EQ(out().state, NC_STATE_HOLD) << "taking the hold away starts nothing";
  in("in0", 1);
  steps(10);
  in("in0", 0);
  steps(500);
  EXPECT_EQ(out().state, NC_STATE_RUNNING);
}

TEST_F(OwnLadder, AnEndlessProgramStopsTheMachineAndNamesItsLine) {
  use("LD nc.m_strobe\nOUT plc.fin2\nP1\nLD in0\nCJ P1\nEND\n");
  start("G91 G1 X400. F1000\nM30\n");
  for (int n = 0; n < 200; ++n) runtime->step();
  ASSERT_GT(out().feed_mm_min, 0);
  machine->set_input(static_cast<unsigned>(config.points.find("in0")), 1);
  for (int n = 0; n < 500; ++n) runtime->step();
  EXPECT_EQ(alarm().substr(0, 3), "R17") << alarm();
  EXPECT_NE(alarm().find(":5: CJ P1: watchdog: "), std::string::npos) << alarm();
  EXPECT_EQ(out().feed_mm_min, 0);
}

TEST_F(OwnLadder, ErrorsOfTheProgramNameFileLineAndInstruction) {
  use("LD nc.m_strobe\nOUT nowhere\nOUT nc.ready\nEND\n");
  machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
  std::vector<nc::rt::ConfigError> errors;
  EXPECT_EQ(nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors), nullptr);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NE(errors[0].text().find(path_ + ":2: OUT nowhere"), std::string::npos) << errors[0].text();
  EXPECT_NE(errors[1].text().find(path_ + ":3: OUT nc.ready"), std::string::npos) << errors[1].text();
  config.ladder.program = "/nonexistent/own.il";
  errors.clear();
  EXPECT_EQ(nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors), nullptr);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].text().find("/nonexistent/own.il"), std::string::npos);
}

}  // namespace
