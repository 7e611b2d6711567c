// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside, on the simulated machine: the rest of it has the path of the whole run, and nothing moves before the operator has said so.
#include "restart_fixture.hpp"

namespace {

using namespace nc::rt;
using namespace nc::test::inside;

const char* const kPart =
    "N10 G90 G54 G17 G21 T5 M6\n"
    "S1200 M3\n"
    "G0 X10. Y10.\n"
    "N40 G1 Z-2. F600. M8\n"
    "N50 G91 G1 X20. F1200.\n"
    "Y15.\n"
    "N70 G2 X-10. Y10. I0. J10.\n"
    "N80 G90 G1 X5. Y5.\n"
    "N90 G0 Z20. M9\n"
    "M5\n"
    "M30\n";

TEST_F(Restart, TheRestOfAPartHasThePathOfTheWholeRun) {
  build();
  select(kPart);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  const std::vector<nc_axes> whole = machine->path;

  ASSERT_EQ(find(RestartBy::kSequence, 70), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(restart().found.source.line, 7u);
  machine->path.clear();
  steps(300);
  EXPECT_EQ(machine->path.size(), 1u) << "nothing moves before the operator has said so";
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_NO_FATAL_FAILURE(mdi("T5 M6\nS1200 M3\nM8\n"));
  EXPECT_EQ(restart().list.open(), 0u);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (const unsigned axis : {0u, 1u, 2u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  machine->path.clear();
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_LT(most_beside(whole, machine->path), kChord);
  EXPECT_NEAR(machine->path.back().v[2], 20, 1e-9);
  EXPECT_EQ(restart().phase, RestartPhase::kEnded);
}

// Comes to the place, is given nothing, and has its axes there.
TEST_F(Restart, AWrongToolOrAStandingSpindleIsRefused) {
  build("[signals]\n\"plc.cycle_start\" = \"in0\"\n");
  select(kPart);
  ASSERT_EQ(find(RestartBy::kLine, 6), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const auto open = [&] {
    std::string all;
    const RestartStatus now = restart();
    for (const RecoveryEntry& entry : now.list.entries())
      if (entry.state == RecoveryEntry::State::kOpen) all += now.list.text(entry) + " ";
    return all;
  };
  EXPECT_EQ(open(), "T5 M6 S1200 M3 M8 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T6 M6\nS1200 M3\nM8\n"));
  EXPECT_EQ(open(), "T5 M6 ") << "the wrong tool";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_NO_FATAL_FAILURE(mdi("T5\n"));
  EXPECT_EQ(open(), "M6 ") << "it is called, and tool 6 is in the spindle";
  ASSERT_NO_FATAL_FAILURE(mdi("M6\nM3\nM8\n"));
  EXPECT_EQ(open(), "");
  ASSERT_NO_FATAL_FAILURE(mdi("M5\n"));
  EXPECT_EQ(open(), "M3 ") << "the spindle has been stopped again";
  ASSERT_NO_FATAL_FAILURE(mdi("M3\n"));
  EXPECT_EQ(open(), "");
  ASSERT_NO_FATAL_FAILURE(mdi("M55\n"));
  EXPECT_EQ(open(), "M6 M3 M8 ") << "M55 is none of the list, so nothing is known of those any more";
  ASSERT_NO_FATAL_FAILURE(mdi("M6\nM3\n"));
  ASSERT_NO_FATAL_FAILURE(mdi("S900\n"));
  EXPECT_EQ(open(), "S1200 M8 ");
  ASSERT_NO_FATAL_FAILURE(mdi("S1200 M6\n"));
  EXPECT_EQ(open(), "M3 M8 ") << "a tool change behind M3 has stopped the spindle";
  ASSERT_NO_FATAL_FAILURE(mdi("M3\n"));
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 99), Answer::kOutOfRange);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 4), Answer::kDone);
  EXPECT_EQ(open(), "");
  ASSERT_NO_FATAL_FAILURE(mdi("M9\n"));
  EXPECT_EQ(open(), "M6 M3 M8 ") << "and what was confirmed is not any more";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  // By a button as by a command.
  const std::uint32_t refusals = runtime->snapshot().system[0].refusal.count;
  machine->hold(config.points.find("in0"), 1);
  steps(10);
  machine->hold(config.points.find("in0"), 0);
  steps(10);
  EXPECT_EQ(runtime->snapshot().system[0].refusal.count, refusals + 1);
  EXPECT_EQ(runtime->snapshot().system[0].refusal.why, Answer::kRestartOpen);
  EXPECT_EQ(out().state, NC_STATE_STOPPED);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
}

TEST(RecoveryNames, OutputsHaveTheNameOfTheFamily) {
  const struct {
    nc_dialect dialect;
    unsigned word;
    const char* text;
  } rows[] = {{NC_DIALECT_M700, 1, "#1133 bits 3 = 1"},
              {NC_DIALECT_HX, 1, "#7533 bits 3 = 1"},
              {NC_DIALECT_ISO, 1, "#6132 bits 3 = 1"},
              {NC_DIALECT_ISO, 0, "output word 0 bits 3 = 1"}};  // of that one it has the bits alone
  for (const auto& row : rows) {
    nc_restart_found found;
    nc_restart_found_init(&found);
    found.output_written[row.word] = 3;
    found.output[row.word] = 1;
    RecoveryList list;
    list.begin(found, row.dialect);
    ASSERT_EQ(list.entries().size(), 1u);
    EXPECT_EQ(list.text(list.entries().front()), row.text);
  }
}

TEST_F(Restart, TheListHasWhatCountsAndTheNewestOfTheSpindle) {
  build();
  select("T1\nS500 M3\nM5\nM0\nM6\nM1\nS800 M4\nM8\nM9\nM8\n#1100=1\nN9 G1 X1. F600.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const RestartStatus now = restart();
  std::string all;
  for (const RecoveryEntry& entry : now.list.entries()) all += now.list.text(entry) + "; ";
  EXPECT_EQ(all, "T1; M6; S800; M4; M9; M8; #1132 bits 1 = 1; ");
}

// The usual way: behind a tool change the next tool is called, so that the changer brings it meanwhile. The tool in the spindle is that of the T in front of the change.
TEST_F(Restart, AToolThatIsCalledAheadIsNotTheOneInTheSpindle) {
  build();
  select("N10 G90 G54 T1 M6\nS500 M3\nN20 T2\nN30 G0 X5. Y5.\nN50 G1 Y15. F1200.\nN60 M6\nX5.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const auto open = [&] {
    std::string all;
    const RestartStatus now = restart();
    for (const RecoveryEntry& entry : now.list.entries())
      if (entry.state == RecoveryEntry::State::kOpen) all += now.list.text(entry) + " ";
    return all;
  };
  EXPECT_EQ(open(), "T1 M6 S500 M3 T2 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(open(), "T1 M6 S500 M3 ") << "tool 2 is in the spindle";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_NO_FATAL_FAILURE(mdi("T1\n"));
  EXPECT_EQ(open(), "M6 S500 M3 T2 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(open(), "T1 M6 S500 M3 ") << "it was called before the change of tool 1";
  ASSERT_NO_FATAL_FAILURE(mdi("T1 M6\nS500 M3\n"));
  EXPECT_EQ(open(), "T2 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(open(), "") << "called ahead of the next change, it leaves tool 1 in the spindle";
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(open(), "T1 M6 M3 ") << "now it does not";
}

// Tool 1 is broken, a new one is put in its place by hand, and the next one stands ready.
TEST_F(Restart, AToolThatTheOperatorConfirmsIsInTheSpindleUntilAnotherOneIsChanged) {
  build();
  select("T1 M6\nT2\nG0 X5.\nN50 G1 X15. F1200.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(restart().list.open(), 0u);
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(restart().list.open(), 2u) << "T1 and M6";
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 0), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(restart().list.open(), 2u) << "what was confirmed is in the spindle; the change brings tool 2";
}

TEST_F(Restart, AMachineWhoseTChangesTheToolHasOneT) {
  build();
  select("T1\nG0 X5.\nT2\nN50 G1 X15. F1200.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  ASSERT_EQ(restart().list.entries().size(), 1u);
  EXPECT_EQ(restart().list.text(restart().list.entries().front()), "T2");
  ASSERT_NO_FATAL_FAILURE(mdi("T1\n"));
  EXPECT_EQ(restart().list.open(), 1u);
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(restart().list.open(), 0u);
}

TEST_F(Restart, OneAxisAtATimeAndOnlyWhileItIsAskedFor) {
  build();
  select(kPart);
  ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
  EXPECT_EQ(ask_approach(0), Answer::kNotInThisMode);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(ask_approach(0), Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  EXPECT_EQ(ask_approach(7), Answer::kAxisUnknown);
  EXPECT_EQ(ask_approach(0, 1e5), Answer::kOutOfRange);
  EXPECT_EQ(ask_approach(0, -1), Answer::kOutOfRange);
  EXPECT_EQ(ask_approach(0, 0), Answer::kNoJogFeed);
  EXPECT_EQ(ask_approach(0, 20), Answer::kLetGoFirst) << "it was asked for in another mode, and has been asked for since";
  let_go(0);
  ASSERT_EQ(ask_approach(0, 20), Answer::kDone);
  steps(30);
  EXPECT_GT(out().velocity.v[0], 0);
  EXPECT_EQ(ask_approach(1, 20), Answer::kAxesMove);
  let_go(1);
  // Nobody asks again: the axis stops, and it is away still.
  steps(400);
  EXPECT_EQ(out().velocity.v[0], 0);
  EXPECT_EQ(out().restart_axes & 1u, 1u);
  ASSERT_NO_FATAL_FAILURE(approach(1));
  ASSERT_NO_FATAL_FAILURE(approach(0));
  ASSERT_NO_FATAL_FAILURE(approach(2));
  EXPECT_EQ(out().restart_axes, 0u);
  EXPECT_NEAR(out().command.v[0], restart().found.machine.v[0], 1e-9);
}

TEST_F(Restart, AButtonLeadsItsAxisToThePlaceAsLongAsItIsHeld) {
  build("[signals]\n\"plc.restart_approach.X\" = \"in0\"\n\"plc.restart_approach.Y\" = \"in1\"\n\"plc.jog_feed\" = \"word_in\"\n");
  const int x = config.points.find("in0"), y = config.points.find("in1"), feed = config.points.find("word_in");
  select(kPart);
  ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  machine->hold(feed, 1200);
  machine->hold(x, 1);
  steps(30);
  EXPECT_EQ(out().velocity.v[0], 0) << "not in this mode";
  EXPECT_EQ(runtime->snapshot().system[0].refusal.why, Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  steps(30);
  EXPECT_EQ(out().velocity.v[0], 0) << "it was on before: it must be let go first";
  machine->hold(x, 0);
  steps(5);
  machine->hold(x, 1);
  steps(50);
  EXPECT_NEAR(out().velocity.v[0], 20, 1e-6);
  machine->hold(y, 1);
  steps(50);
  EXPECT_EQ(out().velocity.v[1], 0) << "one axis at a time";
  EXPECT_GT(out().velocity.v[0], 0) << "and the first one goes on";
  machine->hold(x, 0);
  steps(100);
  EXPECT_EQ(out().velocity.v[0], 0);
  EXPECT_EQ(out().velocity.v[1], 0) << "the other one does not begin by itself";
  EXPECT_EQ(out().restart_axes & 3u, 3u);
  machine->hold(y, 0);
  steps(5);
  for (const int button : {y, x}) {
    machine->hold(button, 1);
    steps(3000);
    machine->hold(button, 0);
    steps(50);
  }
  EXPECT_EQ(out().restart_axes & 3u, 0u);
  EXPECT_FALSE(runtime->snapshot().alarmed());
}

TEST_F(Restart, TheLastStopIsFoundAndTheRestHasThePathOfTheWholeRun) {
  build();
  select(kPart);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace) << "nothing has been stopped";
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace) << "it has come to its end";
  const std::vector<nc_axes> whole = machine->path;
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().source.line == 7 && out().velocity.v[0] != 0; }));
  steps(40);
  ASSERT_NO_FATAL_FAILURE(reset());
  ASSERT_EQ(find(RestartBy::kPowerOff), Answer::kNoPlace);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(restart().found.source.line, 7u);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (const unsigned axis : {2u, 0u, 1u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  machine->path.clear();
  ASSERT_EQ(start(), Answer::kDone);
  // It is stopped once more, and goes on once more.
  ASSERT_TRUE(until([&] { return out().source.line == 8 && out().velocity.v[0] != 0; }));
  steps(20);
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_LT(most_beside(whole, machine->path), kChord);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(restart().found.source.line, 8u);
}

// M700 13.2, 13.5.1: the macro of G66 runs at each place of a pattern. A place to begin inside lies in one of these runs, or between two of them.
TEST_F(Restart, InTheMacroOfAPatternTheRestHasAllItsPlaces) {
  const char* const part =
      "N10 G90 G54 G17 G21 G0 X5. Y5. Z10.\n"
      "G66 P200 Z-5. F1200.\n"
      "N20 G37.1 X10. Y10. I6. P2 J6. K2\n"
      "N30 G67\n"
      "G0 X0 Y0\n"
      "M30\n"
      "O200\n"
      "N50 G91 G1 Z#26 F#9\n"
      "N60 G0 Z-#26\n"
      "N70 G90\n"
      "M99\n";
  build();
  select(part);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  const std::vector<nc_axes> whole = machine->path;
  const auto rest_of_whole = [&] {
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    for (const unsigned axis : {2u, 0u, 1u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
    machine->path.clear();
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(to_end());
    EXPECT_LT(most_beside(whole, machine->path), kChord);
    EXPECT_LT(most_beside(machine->path, {whole.end() - 1, whole.end()}), kChord);
  };
  for (const std::uint32_t passing : {1u, 3u}) {
    SCOPED_TRACE(passing);
    ASSERT_EQ(find(RestartBy::kLine, 8, passing), Answer::kDone) << runtime->explain(Answer::kNoPlace);
    ASSERT_NO_FATAL_FAILURE(rest_of_whole());
    unsigned holes = 0;  // what comes down at 5 behind the place
    for (std::size_t i = 1; i < machine->path.size(); ++i) holes += machine->path[i].v[2] < 5.001 && machine->path[i - 1].v[2] >= 5.001 ? 1 : 0;
    EXPECT_EQ(holes, 5 - passing);
  }
  // Stopped by a reset in a macro, and on the way between two places: the pattern of that run goes on, not a new one.
  for (const bool in_macro : {true, false}) {
    SCOPED_TRACE(in_macro);
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().source.line == (in_macro ? 8u : 3u) && machine->path.back().v[0] > 12 && (in_macro ? out().velocity.v[2] : out().velocity.v[0]) != 0; }));
    steps(10);
    ASSERT_NO_FATAL_FAILURE(reset());
    ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
    ASSERT_NO_FATAL_FAILURE(rest_of_whole());
  }
}

// A loop that is long enough for the search to take many steps of the feeder.
const char* const kLoop = "#1=0\nN1 #1=#1+1\nG1 X[#1/100000] F6000.\nIF[#1LT300000]GOTO1\nN9 G1 X20.\nM30\n";

TEST_F(Restart, AResetOrAnotherModeEndsTheSearch) {
  build();
  select(kLoop);
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  steps(5);
  ASSERT_EQ(restart().phase, RestartPhase::kSearching) << restart().text;
  EXPECT_GT(restart().read, 0u);
  EXPECT_EQ(start(), Answer::kRestartSearch);
  EXPECT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(restart().phase, RestartPhase::kLost) << restart().text;
  EXPECT_EQ(start(), Answer::kRestartLost);
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  steps(5);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  steps(5);
  EXPECT_EQ(restart().phase, RestartPhase::kLost);
  EXPECT_EQ(restart().text, "another mode has been chosen");
  EXPECT_EQ(find(RestartBy::kSequence, 9), Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartLost);
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  steps(5);
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kNoPlace);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().source.line == 3; }));
  EXPECT_LT(out().command.v[0], 0.1);
}

// A reset gives the place up, wherever the operator is with it, and an alarm does. The whole program is not what the next press of the button means, so it begins neither inside
// nor at its head, by command or button, however often reset is pressed, before it is said what is meant.
TEST_F(Restart, BehindAResetOrAnAlarmNothingBeginsAtTheHeadWithoutAWord) {
  for (const bool stands : {false, true})
    for (const bool alarm : {false, true})
      for (const unsigned way : {0u, 1u, 2u}) {
        SCOPED_TRACE(std::string(stands ? "at the place, " : "place found, ") + (alarm ? "alarm, way " : "reset, way ") + std::to_string(way));
        build("[[point]]\nname = \"trouble\"\ndirection = \"input\"\n[signals]\n\"plc.alarm.1\" = \"trouble\"\n");
        select(kPart);
        ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
        ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
        if (stands) {
          ASSERT_EQ(start(), Answer::kDone);
          ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kStands; })) << restart().text;
        }
        if (alarm) {
          machine->hold(config.points.find("trouble"), 1);
          ASSERT_TRUE(until([&] { return runtime->snapshot().alarmed(); }));
          steps(5);
          machine->hold(config.points.find("trouble"), 0);
        }
        const double before = out().command.v[0];
        for (unsigned press = 0; press < 3; ++press) {
          ASSERT_NO_FATAL_FAILURE(reset());
          steps(5);
          EXPECT_EQ(restart().phase, RestartPhase::kLost) << restart().text;
          EXPECT_EQ(start(), Answer::kRestartLost);
          steps(50);
          EXPECT_EQ(out().state, NC_STATE_IDLE);
          EXPECT_EQ(out().command.v[0], before);
        }
        EXPECT_NE(restart().text.find(alarm ? "alarm" : stands ? "given up" : "reset"), std::string::npos) << restart().text;
        if (way == 0) {
          ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
        } else if (way == 1) {
          select(kPart);
        } else {
          ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
          ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
        }
        EXPECT_EQ(start(), Answer::kDone);
      }
}

TEST_F(Restart, WhatIsNotThereIsSaidAndNothingStartsBeforeItIsCancelled) {
  build();
  select(kPart);
  struct Row {
    RestartBy by;
    std::uint64_t number;
    const char* text;
  };
  for (const Row& row : {Row{RestartBy::kSequence, 4711, "no such sequence number"}, Row{RestartBy::kLine, 99, "ended before it came there"}, Row{RestartBy::kBlock, 1000000, "ended before it came there"}}) {
    ASSERT_EQ(find(row.by, row.number), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kLost; }));
    EXPECT_NE(restart().text.find(row.text), std::string::npos) << restart().text;
  }
  EXPECT_EQ(find(RestartBy::kSequence, 0), Answer::kRefusedByControl) << "0 is no sequence number";
  EXPECT_EQ(runtime->find_restart(0, {RestartBy::kLine, 3, 0, "other.nc"}), Answer::kNoPlace);
  EXPECT_EQ(runtime->find_restart(1, {RestartBy::kLine, 3, 0, ""}), Answer::kAxisUnknown);
  EXPECT_EQ(start(), Answer::kRestartLost);
  steps(50);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_NEAR(out().command.v[2], 20, 1e-9);
  select("G90 G1 X1. F600.\n#1=SQRT[-1]\nN3 X2.\nM30\n", "wrong.nc");
  ASSERT_EQ(find(RestartBy::kSequence, 3), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kLost; }));
  EXPECT_NE(restart().text.find("(line 2)"), std::string::npos) << restart().text;
  EXPECT_FALSE(runtime->snapshot().alarmed()) << "nothing has run";
}

TEST_F(Restart, AChangedProgramAndAnotherOneAreRefused) {
  build();
  runtime->set_program_hash([&](unsigned file) { return std::to_string(std::hash<std::string>()(texts.at(file))); });
  select(kPart);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().source.line == 6; }));
  ASSERT_NO_FATAL_FAILURE(reset());
  select("G0 X1.\nM30\n", "other.nc");
  EXPECT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace);
  EXPECT_EQ(runtime->explain(Answer::kNoPlace), "at the last stop the program was part.nc, and other.nc is selected");
  ASSERT_EQ(nc_program_remove(runtime->control(), 0), NC_OK);
  std::string changed = kPart;
  changed.replace(changed.find("X20."), 4, "X21.");
  texts.pop_front();
  texts.push_front(changed);
  unsigned file = 9;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "part.nc", texts[0].data(), texts[0].size(), &file), NC_OK);
  ASSERT_EQ(file, 0u);
  ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  EXPECT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace);
  EXPECT_NE(runtime->explain(Answer::kNoPlace).find("has been changed since"), std::string::npos) << runtime->explain(Answer::kNoPlace);
}

// A place that the operator means, and that somebody else's change has lost, is no reason to begin the whole program.
TEST_F(Restart, ChangedTablesLoseThePlaceAndNothingStartsBeforeTheOperatorSaysSo) {
  build();
  select(kPart);
  const auto lose = [&] {
    ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; }));
    ASSERT_EQ(runtime->change([](nc_control*) {}), Answer::kDone);
    EXPECT_EQ(start(), Answer::kRestartLost);
    steps(3);
    EXPECT_EQ(restart().phase, RestartPhase::kLost);
    EXPECT_EQ(start(), Answer::kRestartLost);
    steps(50);
    EXPECT_EQ(out().state, NC_STATE_IDLE);
  };
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_NO_FATAL_FAILURE(reset());  // says nothing of the place
  EXPECT_EQ(restart().phase, RestartPhase::kLost);
  EXPECT_EQ(start(), Answer::kRestartLost);
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(restart().phase, RestartPhase::kEnded);
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; }));
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(restart().phase, RestartPhase::kEnded);
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  EXPECT_TRUE(to_end());
  EXPECT_EQ(runtime->info().system[0].runs, 1u);
}

TEST_F(Restart, AStartOfAllPartSystemsBeginsNoOtherProgramAtItsHead) {
  build("[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\nsoft_limits = [-500.0, 500.0]\n");
  select(kPart);
  const std::string& text = texts.emplace_back("G90 G1 X5. F600.\nN2 X7.\nM30\n");
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "second.nc", text.data(), text.size(), &file), NC_OK);
  Command choose;
  choose.kind = CommandKind::kSelectProgram;
  choose.system = 1;
  choose.number = file;
  ASSERT_EQ(runtime->execute(choose), Answer::kDone);
  ASSERT_EQ(runtime->find_restart(1, {RestartBy::kSequence, 2, 0, ""}), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->info().system[1].restart.phase == RestartPhase::kFound; }));
  machine->path.clear();
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->info().system[1].restart.phase == RestartPhase::kStands; }));
  steps(200);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  EXPECT_EQ(machine->path.size(), 1u);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
}

// Behind motion by hand in any block stop.
TEST_F(Restart, AnAxisComesBackToThePathInABlockStop) {
  build();
  select("G90 G1 X10. F3000.\nM0\nY5.\nM30\n");
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().state == NC_STATE_STOPPED; }));
  steps(3);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  Command step;
  step.kind = CommandKind::kStep;
  step.value = 3;
  ASSERT_EQ(runtime->execute(step), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().command.v[0] > 12.9999 && out().distance_zero; }));
  steps(5);
  for (int i = 0; i < 500 && std::abs(out().command.v[0] - 10) > 1e-9; ++i) {
    ASSERT_EQ(ask_approach(0), Answer::kDone) << i << " " << refusal_text(config, 0, runtime->snapshot().system[0].refusal);
    steps(20);
  }
  EXPECT_NEAR(out().command.v[0], 10, 1e-9);
}

}  // namespace
