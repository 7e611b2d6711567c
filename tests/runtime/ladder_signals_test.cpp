// SPDX-License-Identifier: Apache-2.0
// What the ladder can ask of the NC beside the handshake, and what it sees of the NC: each signal in a ladder program on
// the machine.
#include <algorithm>

#include "ladder_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr const char* kFin = "LD nc.m_strobe\nOUT plc.fin2\n";

class LadderSignals : public nc::test::OwnLadder {
 protected:
  void run(const std::string& rungs) {
    use(rungs + kFin + "END\n");
    build();
  }
  void manual() {
    ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
    steps(2);
  }
  void load(const std::string& text) {
    unsigned file = 0;
    const std::string& kept = texts.emplace_back(text);
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", kept.data(), kept.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  }
  double x() const { return out().command.v[0]; }
};

// M700 13.12: UIT.
TEST_F(LadderSignals, TheMacroInterrupt) {
  run("LD in0\nOUT plc.macro_interrupt\n");
  const std::string sub = "O1000\n#100=77\nM99\n";
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "O1000", sub.data(), sub.size(), &file), NC_OK);
  start("M96 P1000\nG91 G1 X20. F3000\nX1.\nM97\nM30\n");
  ASSERT_GT(until([&] { return out().source.line == 2 && out().feed_mm_min > 0; }), 0);
  in("in0", 1);
  steps(5);
  in("in0", 0);
  ASSERT_GE(until_end(), 0) << alarm();
  EXPECT_EQ(alarm(), "");
  EXPECT_EQ(variable(100), 77);
  EXPECT_NEAR(x(), 21, 1e-6);
}

// M700 4.2: '/' is switch 1, /2 to /9 the others.
TEST_F(LadderSignals, OptionalBlockSkips) {
  run("LD SM400\nOUT plc.block_skip.1\nLD in0\nOUT plc.block_skip.9\n");
  steps(3);
  start("#101=1 #102=1 #109=1\n/#101=2\n/2 #102=2\n/9 #109=2\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(variable(101), 1) << "left out";
  EXPECT_EQ(variable(102), 2);
  EXPECT_EQ(variable(109), 2);
  in("in0", 1);
  steps(3);
  start("#109=1\n/9 #109=2\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(variable(109), 1);
  // The operator's switches count as well.
  ASSERT_EQ(runtime->execute(CommandKind::kSwitches, 0, 1u << 3), Answer::kDone);
  start("#103=1 #101=1\n/3 #103=2\n/#101=2\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(variable(103), 1);
  EXPECT_EQ(variable(101), 1);
}

// M700 13.6: mirror image by signal, about the place at which the axis stands at the start.
TEST_F(LadderSignals, MirrorImage) {
  run("LD in0\nOUT plc.mirror.X\n");
  in("in0", 1);
  steps(3);
  start("G0 X10. Y10.\nM30\n");
  in("in0", 0);
  ASSERT_GE(until_end(), 0);
  EXPECT_NEAR(x(), -10, 1e-9);
  EXPECT_NEAR(out().command.v[1], 10, 1e-9);
  steps(3);
  start("G0 X10.\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_NEAR(x(), 10, 1e-9);
}

TEST_F(LadderSignals, RapidOverride) {
  run("LD SM400\nMOV K2500 plc.rapid_override\n");
  start("G91 G0 X100.\nM30\n");
  double top = 0;
  while (runtime->info().system[0].runs == 0) {
    runtime->step();
    top = std::max(top, out().feed_mm_min);
  }
  EXPECT_NEAR(top, 0.25 * 200 * 60, 1);
}

// A potentiometer whose zero is slightly negative must not mean full speed at that end.
TEST_F(LadderSignals, AnOverrideBelowZeroIsNoneAndMinusOneIsTheOperators) {
  run("LD SM400\nMOV D0 plc.feed_override\nMOV D0 plc.rapid_override\nLD in0\nMOV K-1 D0\nLDI in0\nMOV K-2 D0\n");
  steps(3);
  start("G91 G1 X100. F3000\nG0 X10.\nM30\n");
  steps(500);
  EXPECT_EQ(x(), 0);
  EXPECT_EQ(out().cause, NC_CAUSE_OVERRIDE_ZERO);
  in("in0", 1);
  ASSERT_GE(until_end(), 0);
  EXPECT_NEAR(x(), 110, 1e-6);
}

TEST_F(LadderSignals, InputsAndOutputsOfTheMacroInterface) {
  run("LD SM400\nMOV H8001 plc.macro_input.1\nMOV K5 plc.macro_input.3\nMOV nc.macro_output.1 D0\nMOV nc.macro_output.4 D1\n"
      "LD nc.macro_output.1.2\nOUT M7\n");
  start("#100=#1000 #101=#1015 #102=#1001 #103=#1200 #104=#1202 #105=#1201\n#1102=1\n#1316=1 #1331=1\nG4 X0.02\nM30\n");
  ASSERT_GE(until_end(), 0) << alarm();
  EXPECT_EQ(variable(100), 1);
  EXPECT_EQ(variable(101), 1);
  EXPECT_EQ(variable(102), 0);
  EXPECT_EQ(variable(103), 1);
  EXPECT_EQ(variable(104), 1);
  EXPECT_EQ(variable(105), 0);
  steps(3);
  EXPECT_EQ(device("D0"), 4) << "#1102";
  EXPECT_EQ(device("M7"), 1);
  EXPECT_EQ(static_cast<std::uint16_t>(device("D1")), 0x8001) << "#1316 and #1331";
}

/// Tool life management by minutes: the ladder hears that a life has ended in the second in which it does, takes the next tool, and says that one is broken.
TEST_F(LadderSignals, ToolLifeByMinutes) {
  use("LD nc.tool_life_ended\nOUT M0\nLD nc.tool_group_ended\nOUT M1\nLD SM400\nDMOV nc.tool_group D0\nLD in0\nOUT plc.tool_broken\n"
      "LD nc.m_strobe\nOR nc.t_strobe\nOUT plc.fin2\nEND\n");
  build();
  ASSERT_EQ(nc_parameter_set(runtime->control(), 0, "1103", 0, "1"), NC_OK);
  const auto run_program = [&](const char* text) {
    start(text);
    ASSERT_GE(until_end(), 0) << alarm();
    EXPECT_EQ(alarm(), "");
    steps(50);
  };
  const auto told = [&] { return std::to_string(device("M0")) + std::to_string(device("M1")) + " " + std::to_string(device("D0")) + " T" + std::to_string(out().t); };
  const auto breaks = [&] {
    in("in0", 1);
    steps(50);
    in("in0", 0);
    steps(50);
  };
  run_program("G10 L3\nP7 L1 Q2\nT11\nT12\nT13\nG11\nT7 M6\nG91 G1 X59. F60\nM30\n");
  EXPECT_EQ(told(), "00 7 T11") << "59 s";
  start("G91 G1 X-4. F60\nM30\n");
  const double from = x();
  ASSERT_GE(until([&] { return device("M0") != 0; }, 10000), 0);
  EXPECT_NEAR(from - x(), 1, 1.05) << "mm at 1 mm/s: in the second behind the end of its life, or before that what was not told in the first program";
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(told(), "10 7 T11") << "two more are left";
  run_program("T7 M6\nM30\n");
  EXPECT_EQ(told(), "00 7 T12");
  breaks();
  EXPECT_EQ(told(), "10 7 T12");
  in("in0", 1);  // it stays on while the next one comes into the spindle
  run_program("T7 M6\nM30\n");
  EXPECT_EQ(told(), "00 7 T13") << "acts when it rises";
  in("in0", 0);
  steps(50);
  breaks();
  EXPECT_EQ(told(), "11 7 T13") << "none is left";
  run_program("T0 M6\nM30\n");
  EXPECT_EQ(told(), "00 0 T0");
}

TEST_F(LadderSignals, JogButtons) {
  run("LD in0\nOUT plc.jog_p.X\nLD in1\nOUT plc.jog_m.X\nLD SM400\nDMOV word_in plc.jog_feed\n");
  in("word_in", 600);
  in("in0", 1);
  steps(200);
  EXPECT_EQ(x(), 0) << "not in automatic mode";
  in("in0", 0);
  manual();
  in("in0", 1);
  steps(600);
  EXPECT_NEAR(out().velocity.v[0], 10, 0.01);
  in("in1", 1);
  steps(300);
  EXPECT_EQ(out().velocity.v[0], 0) << "both are none";
  const double there = x();
  EXPECT_GT(there, 3);
  in("in0", 0);
  steps(300);
  EXPECT_NEAR(out().velocity.v[0], -10, 0.01);
  in("in1", 0);
  steps(300);
  EXPECT_EQ(out().velocity.v[0], 0);
  // A jog feed above the maximum is limited to it, and the soft limit stops the axis.
  in("word_in", 2000000000);
  in("in0", 1);
  double top = 0;
  for (int n = 0; n < 10000; ++n) {
    runtime->step();
    top = std::max(top, out().velocity.v[0]);
  }
  EXPECT_LE(top, 200 + 1e-6);
  EXPECT_NEAR(x(), 500, 1e-3);
  EXPECT_EQ(alarm(), "");
}

// A service manager ends the control while a button is stuck: the axis comes to rest at once and stays there, and neither a
// reset nor a start button moves it again.
TEST_F(LadderSignals, AControlThatEndsMovesNothingWhateverTheLadderAsksFor) {
  run("LD in0\nOUT plc.jog_p.X\nOUT plc.reference.Y\nLD SM400\nDMOV K6000 plc.jog_feed\nLD in1\nOUT plc.cycle_start\n");
  manual();
  in("in0", 1);
  ASSERT_GT(until([&] { return out().velocity.v[0] > 50; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kEnd), Answer::kDone);
  ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0) << "the button is still pressed";
  const double there = x();
  EXPECT_LT(there, 50);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 500), 0);
  steps(500);
  EXPECT_EQ(x(), there);
  nc::rt::Command jog;
  jog.kind = CommandKind::kJog;
  jog.value = 5;
  EXPECT_EQ(runtime->execute(jog), Answer::kEnding);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kEnding);
}

TEST_F(LadderSignals, AControlThatEndsDoesNotGoOnWithTheStartButton) {
  run("LD in1\nOUT plc.cycle_start\n");
  start("G91 G1 X100. F3000\nM30\n");
  ASSERT_GT(until([&] { return x() > 5; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kEnd), Answer::kDone);
  ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0);
  const double there = x();
  in("in1", 1);
  steps(5);
  in("in1", 0);
  steps(500);
  EXPECT_EQ(x(), there);
  EXPECT_EQ(out().state, NC_STATE_HOLD);
}

TEST_F(LadderSignals, AStartThatIsRefusedSaysWhy) {
  run("LD in1\nOUT plc.cycle_start\n");
  const auto press = [this] {
    in("in1", 1);
    steps(5);
    in("in1", 0);
    steps(5);
    return runtime->snapshot();
  };
  const auto refusal = [this] { return runtime->snapshot().system[0].refusal; };
  EXPECT_EQ(refusal().count, 0u);
  press();
  EXPECT_EQ(refusal().asked, nc::rt::Asked::kCycleStart);
  EXPECT_EQ(refusal().why, nc::rt::Answer::kNoProgram);
  EXPECT_EQ(nc::rt::asker_text(config, refusal().by), "by the ladder");
  manual();
  press();
  EXPECT_EQ(refusal().why, nc::rt::Answer::kNotInThisMode);
  EXPECT_EQ(refusal().count, 2u);
  EXPECT_EQ(nc::rt::refusal_text(config, 0, refusal()), "cycle start refused: not in this mode");
  // Now the reason to refuse is gone.
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kMdi)), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("G4 X0.5\n"), Answer::kDone);
  press();
  EXPECT_EQ(out().state, NC_STATE_RUNNING);
  EXPECT_EQ(refusal().asked, nc::rt::Asked::kNothing);
  EXPECT_EQ(refusal().count, 2u);
}

TEST_F(LadderSignals, WhileResetIsHeldNothingStarts) {
  run("LD in1\nOUT plc.cycle_start\nLD in0\nOUT plc.reset\n");
  const auto refusal = [this] { return runtime->snapshot().system[0].refusal; };
  load("G1 X100. F600\nM30\n");
  const auto press = [this] {
    in("in1", 1);
    steps(5);
    in("in1", 0);
    steps(5);
  };
  press();
  steps(100);
  ASSERT_EQ(out().state, NC_STATE_RUNNING);
  in("in0", 1);
  steps(200);
  ASSERT_EQ(out().state, NC_STATE_IDLE);
  EXPECT_TRUE(runtime->snapshot().resetting);
  const double stood = x();
  press();
  steps(50);
  EXPECT_EQ(x(), stood) << "the button of the panel";
  EXPECT_EQ(refusal().why, Answer::kResetHeld);
  EXPECT_EQ(nc::rt::refusal_cause(refusal()), nc::rt::RefusalCause::kResetHeld);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kResetHeld) << "an operator's program";
  EXPECT_EQ(runtime->execute(CommandKind::kSelectProgram, 0, 1), Answer::kResetHeld);
  EXPECT_EQ(runtime->load_mdi("G0 X1.\n"), Answer::kResetHeld);
  steps(50);
  EXPECT_EQ(x(), stood);
  in("in0", 0);
  steps(3);
  EXPECT_FALSE(runtime->snapshot().resetting);
  EXPECT_EQ(x(), stood) << "what was pressed meanwhile is not kept";
  press();
  steps(50);
  EXPECT_GT(x(), stood);
}

// A start and a reset come in one scan: the reset counts.
TEST_F(LadderSignals, AStartInTheScanOfAResetDoesNotMove) {
  run("LD in0\nOUT plc.reset\nLDI in0\nOUT plc.cycle_start\n");
  load("G0 X100.\nM30\n");
  steps(20);
  const double stood = x();
  in("in0", 1);
  for (int n = 0; n < 50; ++n) {
    steps(1);
    ASSERT_EQ(x(), stood) << n;
  }
}

TEST_F(LadderSignals, AResetEndsAJogUntilItsButtonWasLetGo) {
  run("LD in0\nOUT plc.jog_p.X\nLD SM400\nDMOV K600 plc.jog_feed\nLD in1\nOUT plc.reset\n");
  const auto text = [this] { return nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); };
  manual();
  in("in0", 1);
  steps(200);
  EXPECT_GT(x(), 0.5);
  for (const int held : {500, 2}) {
    in("in1", 1);
    steps(held);
    in("in1", 0);
    steps(100);
    const double stood = x();
    steps(200);
    EXPECT_EQ(x(), stood) << "held for " << held << " scans: the button alone does not begin it again";
    EXPECT_EQ(out().state, NC_STATE_IDLE);
    EXPECT_EQ(text().substr(0, 15), "jog X stopped: ");
    in("in0", 0);
    steps(3);
    in("in0", 1);
    steps(100);
    EXPECT_GT(x(), stood + 0.2);
    EXPECT_EQ(text(), "");
  }
  in("in0", 0);
  steps(100);
  in("in1", 1);
  steps(50);
  const double stood = x();
  in("in0", 1);
  steps(200);
  EXPECT_EQ(x(), stood) << "one that is pressed while reset is held";
}

TEST_F(LadderSignals, AStartInFeedHoldSaysWhy) {
  run("LD in1\nOUT plc.cycle_start\nLDI in0\nOUT plc.feed_hold_n\n");
  const auto text = [this] { return nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); };
  const auto press = [this] {
    in("in1", 1);
    steps(5);
    in("in1", 0);
    steps(5);
  };
  load("G1 X100. F600\nM30\n");
  in("in0", 1);
  steps(3);
  press();
  EXPECT_EQ(text(), "cycle start refused: the feed hold of the machine is on");
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kFeedHold);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  in("in0", 0);
  steps(50);
  EXPECT_EQ(out().state, NC_STATE_IDLE) << "it is not kept";
  press();
  EXPECT_EQ(out().state, NC_STATE_RUNNING);
  EXPECT_EQ(text(), "");
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone) << "the operator's is released by his start";
  steps(100);
  EXPECT_EQ(out().state, NC_STATE_HOLD);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(5);
  EXPECT_EQ(out().state, NC_STATE_RUNNING);
}

TEST_F(LadderSignals, AJogInInterlockOrHoldOrBesideAProgramSaysWhy) {
  run("LD in0\nOUT plc.jog_p.X\nLD SM400\nDMOV K600 plc.jog_feed\nLDD<> word_in K1\nOUT plc.interlock_n\nLDI in1\nOUT plc.feed_hold_n\n");
  const auto text = [this] { return nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); };
  manual();
  in("in0", 1);
  steps(100);
  EXPECT_EQ(text(), "");
  EXPECT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kAxesMove);
  in("word_in", 1);
  steps(100);
  EXPECT_EQ(text(), "jog X stopped: the interlock of the machine is on");
  in("word_in", 0);
  const double there = x();
  steps(100);
  EXPECT_EQ(text(), "jog X stopped: the button was on while something refused or stopped it: let it go first");
  EXPECT_EQ(x(), there) << "the button alone does not begin it again";
  in("in0", 0);
  steps(3);
  in("in0", 1);
  steps(100);
  EXPECT_EQ(text(), "");
  in("in1", 1);
  steps(100);
  EXPECT_EQ(text(), "jog X stopped: the feed hold of the machine is on");
  const double stood = x();
  in("in0", 0);
  steps(3);
  in("in0", 1);
  steps(100);
  EXPECT_EQ(text(), "jog X refused: the feed hold of the machine is on");
  EXPECT_EQ(x(), stood);
  in("in0", 0);
  in("in1", 0);
  steps(5);
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kDone);
  start("G1 X100. F600\nM30\n");
  steps(100);
  ASSERT_GT(x(), stood);
  in("in0", 1);
  steps(10);
  EXPECT_EQ(text(), "jog X refused: not in this mode") << "it was the program that moved";
}

// Nothing begins by itself when the interlock ends.
TEST_F(LadderSignals, AReferenceReturnInInterlockIsRefusedAndOneOnItsWaySaysThatItStands) {
  run("LD in0\nOUT plc.reference.X\nLDI in1\nOUT plc.interlock_n\n");
  const auto text = [this] { return nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal); };
  start("G0 X20.\nM30\n");
  ASSERT_GE(until_end(), 0);
  manual();
  const auto press = [this] {
    in("in0", 1);
    steps(3);
    in("in0", 0);
    steps(3);
  };
  in("in1", 1);
  steps(3);
  press();
  EXPECT_EQ(text(), "reference return X refused: the interlock of the machine is on");
  nc::rt::Command step;
  step.kind = CommandKind::kStep;
  step.value = 1;
  EXPECT_EQ(runtime->execute(step), Answer::kInterlock);
  in("in1", 0);
  steps(500);
  EXPECT_EQ(x(), 20);
  press();
  steps(20);
  ASSERT_LT(x(), 20);
  EXPECT_EQ(text(), "");
  in("in1", 1);
  steps(100);
  EXPECT_EQ(text(), "reference return X stopped: the interlock of the machine is on");
  EXPECT_GT(x(), 0);
  in("in1", 0);
  const double there = x();
  steps(500);
  EXPECT_EQ(x(), there) << "it is given up";
  press();
  ASSERT_GT(until([&] { return x() == 0; }, 20000), 0);
}

// Each reason is reported once, however long the button is held.
TEST_F(LadderSignals, AJogThatDoesNotBeginOrEndsByItselfSaysWhy) {
  run("LD in0\nOUT plc.jog_p.X\nLD SM400\nDMOV word_in plc.jog_feed\nLD in1\nOUT plc.alarm.2\n");
  const auto refusal = [this] { return runtime->snapshot().system[0].refusal; };
  const auto text = [&] { return nc::rt::refusal_text(config, 0, refusal()); };
  const auto hold = [&](std::int64_t button, unsigned scans) {
    in("in0", button);
    steps(scans);
  };
  hold(1, 50);
  EXPECT_EQ(text(), "jog X refused: not in this mode");
  EXPECT_EQ(refusal().count, 1u);
  hold(0, 5);
  manual();
  hold(1, 50);
  EXPECT_EQ(text(), "jog X waits: the jog feed is 0");
  EXPECT_EQ(nc::rt::refusal_cause(refusal()), nc::rt::RefusalCause::kNoFeed);
  in("word_in", 6000);
  steps(50);
  EXPECT_EQ(text(), "") << "it goes";
  ASSERT_GT(until([&] { return x() > 499.99; }, 20000), 0);
  steps(200);
  EXPECT_EQ(text(), "jog X stopped: the axis stands at its soft limit");
  EXPECT_EQ(refusal().count, 3u);
  hold(0, 5);
  hold(1, 50);
  EXPECT_EQ(text(), "jog X refused: the axis stands at its soft limit");
  EXPECT_EQ(refusal().count, 4u);
  hold(0, 5);
  // A client's jog in the other direction, with an alarm in its middle; then a jog that is not repeated.
  nc::rt::Command jog;
  jog.kind = CommandKind::kJog;
  jog.value = -20;
  ASSERT_EQ(runtime->execute(jog), Answer::kDone);
  steps(50);
  EXPECT_EQ(text(), "");
  in("in1", 1);
  steps(50);
  EXPECT_EQ(text(), "jog X stopped: an alarm is active: reset first");
  in("in1", 0);
  steps(2);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 500), 0);
  steps(nc::rt::kJogDeadManScans);  // the client has let go
  ASSERT_EQ(runtime->execute(jog), Answer::kDone);
  steps(nc::rt::kJogDeadManScans + 100);
  EXPECT_EQ(text(), "jog X stopped: it was not asked for again in time");
}

TEST_F(LadderSignals, RapidJog) {
  run("LD in0\nOUT plc.jog_m.Y\nOUT plc.jog_rapid\n");
  manual();
  in("in0", 1);
  double top = 0;
  for (int n = 0; n < 1000; ++n) {
    runtime->step();
    top = std::min(top, out().velocity.v[1]);
  }
  EXPECT_NEAR(top, -150, 1e-3);
}

TEST_F(LadderSignals, HandleAndReference) {
  run("LD in0\nMPS\nMOV K5 plc.handle.X\nMPP\nINV\nMOV K0 plc.handle.X\nLD in1\nOUT plc.reference.X\nLD nc.at_reference.X\nOUT M1\n");
  manual();
  EXPECT_EQ(device("M1"), 1);
  in("in0", 1);
  steps(100);
  in("in0", 0);
  steps(500);
  EXPECT_NEAR(x(), 0.5, 0.006) << "100 scans of 5 increments, and what a scan more or less makes";
  EXPECT_EQ(device("M1"), 0);
  in("in1", 1);
  steps(2000);
  EXPECT_NEAR(x(), 0, 1e-9);
  steps(2);
  EXPECT_EQ(device("M1"), 1);
}

// M700 4.2: blocks in the look-ahead were read with the old state of the switch.
TEST_F(LadderSignals, RecalculationReadsAgain) {
  run("LD in0\nOUT plc.block_skip.1\nLD in1\nOUT plc.recalculate\n");
  ASSERT_EQ(runtime->execute(CommandKind::kSingleBlock, 0, 1), Answer::kDone);
  start("G91 G1 X1. F3000\nX1.\n/X10.\nX1.\nM30\n");
  ASSERT_GT(until([&] { return out().state == NC_STATE_STOPPED; }), 0);
  in("in0", 1);
  steps(20);
  in("in1", 1);
  steps(50);
  ASSERT_EQ(runtime->execute(CommandKind::kSingleBlock, 0, 0), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until_end(), 0);
  EXPECT_NEAR(x(), 3, 1e-6) << "the block with / was left out although it had been read";
}

TEST_F(LadderSignals, DwellInPositionAndManualAllowed) {
  run("LD nc.dwell\nOUT M1\nLD nc.in_position.X\nOUT M2\nLD nc.manual_allowed\nOUT M3\n");
  steps(3);
  EXPECT_EQ(device("M3"), 1);
  start("G91 G1 X50. F6000\nG4 X0.2\nM30\n");
  ASSERT_GT(until([&] { return out().feed_mm_min > 5000; }), 0);
  steps(2);
  EXPECT_EQ(device("M2"), 0) << "the drive lags behind";
  EXPECT_EQ(device("M1"), 0);
  EXPECT_EQ(device("M3"), 0);
  ASSERT_GT(until([&] { return out().cause == NC_CAUSE_DWELL; }), 0);
  steps(100);
  EXPECT_EQ(device("M1"), 1);
  EXPECT_EQ(device("M2"), 1);
  ASSERT_GE(until_end(), 0);
}

// M700 13.5.5: #100100 to #100110.
TEST_F(LadderSignals, ProgramsReadDevices) {
  run("ALIAS X1F in0\nALIAS R300 D300\nLD SM400\nMOV K-2 D5\nMOV K77 D300\nSET M20\n");
  in("in0", 1);
  steps(3);
  start("#100100=1 #100101=5 #100102=102\n#100=#100110\n#100100=0 #100101=20 #100102=0\n#101=#100110\n"
      "#100100=4 #100101=31\n#102=#100110\n#100100=6 #100101=300 #100102=2\n#103=#100110\n"
      "#100100=5 #100101=3 #100102=0\n#104=#100110\nM30\n");
  ASSERT_GE(until_end(), 0) << alarm();
  EXPECT_EQ(variable(100), -2) << "D5";
  EXPECT_EQ(variable(101), 1) << "M20";
  EXPECT_EQ(variable(102), 1) << "X1F by its alias";
  EXPECT_EQ(variable(103), 77) << "R300 by its alias";
  EXPECT_EQ(variable(104), 0) << "Y3 is nothing here";
}

}  // namespace
