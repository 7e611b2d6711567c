// SPDX-License-Identifier: Apache-2.0
// Macro interrupt (M700 13.12), offline and at chosen items. tests/control/online_test.cpp tests it on the machine.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// Pulls a program; the interrupt signal comes with the first item of line `line` of the main program for which `wanted` is true.
Outcome interrupted(Bench& bench, const std::string& text, unsigned line, const std::function<bool(const nc_item&)>& wanted, bool release = true) {
  bench.start(text);
  Outcome run;
  bool done = false;
  Step step;
  while (run.steps.size() < 2000) {
    run.status = bench.pull(&step);
    if (run.status == NC_BUDGET) continue;
    if (run.status != NC_OK) break;
    if (!done && step.item.source.line == line && step.item.source.depth == 0 && wanted(step.item)) {
      done = true;
      bool take_back = false;
      EXPECT_EQ(nc_interrupt_signal(bench.control(), 0, true, &take_back), NC_OK);
      if (release) {
        bool ignored = false;
        nc_interrupt_signal(bench.control(), 0, false, &ignored);
      }
      if (take_back) continue;
    }
    if (step.item.kind == NC_ITEM_END) run.ended_ok = step.item.u.end.ok;
    run.steps.push_back(step);
  }
  nc_alarm alarm{};
  if (nc_alarm_get(bench.control(), 0, &alarm) == NC_OK) run.alarm = alarm.code, run.alarm_line = alarm.source.line;
  double value = 0;
  for (uint32_t n = 0; nc_variable_next(bench.control(), 0, n, &n, &value) == NC_OK; ++n) run.vars[n] = value;
  return run;
}

bool is_move(const nc_item& item) { return item.kind == NC_ITEM_MOVE; }
bool is_mark(const nc_item& item) { return item.kind == NC_ITEM_MARK; }

constexpr const char* kMain = "M96 P1000\nG0 X1.\nG91 X2. M8\nG90 Y5.\nN9 Z1.\nM97\nM30";

TEST(MacroInterrupt, TypeOneWithAMoveLosesTheBlock) {
  Bench bench;
  bench.add("O1000", "G0 Z7.\nM99\n");
  const Outcome run = interrupted(bench, kMain, 3, is_move);
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 1 0 7", "rapid 1 5 7", "rapid 1 5 1"}));
  EXPECT_EQ(run.aux(), "M8 M30");  // M8 had gone out before
}

TEST(MacroInterrupt, TypeOneWithoutAMoveGoesOnInTheBlock) {
  Bench bench;
  bench.add("O1000", "#100=#5001\nM99\n");
  const Outcome run = interrupted(bench, kMain, 3, is_move);
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 3 0 0", "rapid 3 5 0", "rapid 3 5 1"}));
  EXPECT_EQ(run.aux(), "M8 M30");  // once
  EXPECT_EQ(run.var(100), 1);
}

// Whoever executes the items says with nc_position_set() how far the axes have come in the one that he has pulled last.
TEST(MacroInterrupt, InTheMiddleOfAMoveTheProgramBeginsWhereTheAxesStand) {
  Bench bench;
  bench.add("O1000", "#100=#5001\n#101=#5002\nM99\n");
  bench.add("O1001", "G91 G0 Z7.\nG90 M99\n");
  const nc_axes middle = {{10, 10, 0}};
  const auto stands = [&](const nc_item& item) { return is_move(item) && nc_position_set(bench.control(), 0, &middle) == NC_OK; };
  const Outcome goes_on = interrupted(bench, "M96 P1000\nG2 X20. I10. F500\nG0 Y5.\nM30", 2, stands);
  EXPECT_EQ(goes_on.path(), (Path{"cw 20 0 0 c10,0 F500", "rapid 20 5 0"}));
  EXPECT_EQ(goes_on.var(100), 10);
  EXPECT_EQ(goes_on.var(101), 10);
  EXPECT_EQ(interrupted(bench.at(0, 0, 0), "M96 P1001\nG2 X20. I10. F500\nG0 Y5.\nM30", 2, stands).path(), (Path{"rapid 10 10 7", "rapid 10 5 7"}));
}

// As on the machine.
TEST(MacroInterrupt, AThreadIsCutToItsEnd) {
  Bench bench;
  bench.add("O1001", "G91 G0 Z7.\nG90 M99\n");
  const nc_axes middle = {{10, 0, 0}};
  const auto stands = [&](const nc_item& item) { return is_move(item) && nc_position_set(bench.control(), 0, &middle) == NC_OK; };
  EXPECT_EQ(interrupted(bench, "S100 M96 P1001\nG33 X20. F1.\nG0 Y5.\nM30", 2, stands).path(), (Path{"thread 20 0 0 F0", "rapid 20 0 7", "rapid 20 5 7"}));
}

// A position that is set in the middle of a move counts for a reset there, too, and not for the items behind it.
TEST(MacroInterrupt, APositionInTheMiddleOfAMoveIsThatOfAReset) {
  Bench bench;
  const nc_axes middle = {{10, 0, 0}};
  Step step;
  bench.start("G0 X20.\nX30.\nM30");
  while (bench.pull(&step) == NC_OK && !is_move(step.item)) continue;
  ASSERT_EQ(nc_position_set(bench.control(), 0, &middle), NC_OK);
  while (bench.pull(&step) == NC_OK && !is_move(step.item)) continue;
  EXPECT_EQ(step.item.u.move.machine_start.v[0], 20);
  ASSERT_EQ(nc_position_set(bench.control(), 0, &middle), NC_OK);
  ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
  while (bench.pull(&step) == NC_OK && !is_move(step.item)) continue;
  EXPECT_EQ(step.item.u.move.machine_start.v[0], 10);
}

TEST(MacroInterrupt, TypeTwoCompletesTheBlock) {  // #1113
  Bench bench;
  bench.add("O1000", "G0 Z7.\nM99\n");
  bench.param("1113", "1");
  EXPECT_EQ(interrupted(bench, kMain, 3, is_move).path(), (Path{"rapid 1 0 0", "rapid 3 0 0", "rapid 3 0 7", "rapid 3 5 7", "rapid 3 5 1"}));
}

TEST(MacroInterrupt, BetweenBlocksNothingIsLost) {
  Bench bench;
  bench.add("O1000", "G0 Z7.\nM99\n");
  EXPECT_EQ(interrupted(bench, kMain, 2, is_mark).path(), (Path{"rapid 1 0 0", "rapid 1 0 7", "rapid 3 0 7", "rapid 3 5 7", "rapid 3 5 1"}));
}

TEST(MacroInterrupt, BehindTheReturnOfASubProgramTheCallingBlockEndsFirst) {
  for (const char* type_2 : {"0", "1"}) {
    Bench bench;
    bench.add("O1", "G0 X1.\nM99\n");
    bench.add("O1000", "#100=#4012\nM99\n");
    bench.param("1113", type_2);
    bench.start("M96 P1000\nM98 P1\nG0 X2.\nM30");
    std::string marks;
    bool take_back = false, ignored = false;
    Step step;
    while (bench.pull(&step) == NC_OK) {
      if (!is_mark(step.item)) continue;
      const nc_source& at = step.item.source;
      marks += std::to_string(at.program) + ":" + std::to_string(at.line) + "/" + std::to_string(at.depth) + " ";
      if (at.program != 1 || at.line != 2) continue;  // M99 of the sub program
      nc_interrupt_signal(bench.control(), 0, true, &take_back);
      nc_interrupt_signal(bench.control(), 0, false, &ignored);
    }
    EXPECT_EQ(marks, "0:1/0 1:1/1 1:2/1 0:2/0 1000:1/1 1000:2/1 0:3/0 0:4/0 ");
    EXPECT_FALSE(take_back);
  }
}

/// The axes stand beside the programmed corner, where an interrupt program would lead them into it.
TEST(MacroInterrupt, ACutCornerIsLeftFirst) {
  for (const char* corner : {",C2.", ",R2."}) {
    for (const char* type_2 : {"0", "1"}) {
      Bench bench;
      bench.add("O1000", "G91 G0 Z5.\nZ-5.\nM99\n");
      bench.param("1113", type_2);
      const Outcome run = interrupted(bench, std::string("M96 P1000\nG1 X10. F500\nX20. ") + corner + "\nY10.\nX30.\nM97\nM30", 3, is_move);
      const Path path = run.path();
      EXPECT_EQ(run.alarm, "");
      ASSERT_EQ(path.size(), 7u) << corner << type_2;
      EXPECT_EQ(path[3], "line 20 10 0 F500");
      EXPECT_EQ(path[4], "rapid 20 10 5");
      EXPECT_EQ(path[5], "rapid 20 10 0");
    }
  }
}

TEST(MacroInterrupt, ReturnToASequenceNumber) {  // M99 P: from the block behind the interrupted one
  Bench bench;
  bench.add("O1000", "G91 G0\nM99 P9\n");
  EXPECT_EQ(interrupted(bench, kMain, 2, is_move).path(), (Path{"rapid 0 0 1"}));  // G91 stays
}

TEST(MacroInterrupt, ModalStateIsRestored) {
  Bench bench;
  bench.add("O1000", "G91 G55 F77 G1\n#100=#4012\nM99\n");
  bench.work_offset(2, {10, 0, 0});
  const Outcome run = interrupted(bench, "M96 P1000\nG0 X1.\nY5. X2.\n#101=#4012\n#102=#4003\n#103=#4109\nX3.\nM30", 2, is_mark);
  EXPECT_EQ(run.var(100), 55);
  EXPECT_EQ(run.var(101), 54);
  EXPECT_EQ(run.var(102), 90);
  EXPECT_EQ(run.var(103), 0);
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 2 5 0", "rapid 3 5 0"}));
}

TEST(MacroInterrupt, LocalLevelByParameter) {  // #1229 bit 0
  Bench bench;
  bench.add("O1000", "#100=#1\n#1=5\nM99\n");
  const std::string text = "#1=2\nM96 P1000\nG0 X1.\nX2.\n#101=#1\nM30";
  Outcome run = interrupted(bench, text, 3, is_mark);
  EXPECT_TRUE(std::isnan(run.var(100)));
  EXPECT_EQ(run.var(101), 2);
  bench.param("1229/bit0", "1");
  run = interrupted(bench.at(0, 0, 0), text, 3, is_mark);
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(run.var(101), 5);
}

TEST(MacroInterrupt, EdgeOnceLevelAgainAndAgain) {  // #1112
  Bench bench;
  bench.add("O1000", "#100=#100+1\nIF [#100 LT 3] GOTO 5\nM97\nN5 M99\n");
  const std::string text = "#100=0\nM96 P1000\nG0 X1.\nX2.\nX3.\nM30";
  EXPECT_EQ(interrupted(bench, text, 3, is_mark, false).var(100), 1);
  bool ignored = false;
  nc_interrupt_signal(bench.control(), 0, false, &ignored);
  bench.param("1112", "1");
  EXPECT_EQ(interrupted(bench.at(0, 0, 0), text, 3, is_mark, false).var(100), 3);  // M97 ends it
}

/// #1112 = 1 and a signal that stays on: "the interrupt program can be executed repeatedly", and the program comes to its end.
TEST(MacroInterrupt, ASignalThatStaysOnLetsABlockThroughEachTime) {
  const auto run = [](const char* interrupt, const char* type_2, unsigned line, const std::function<bool(const nc_item&)>& wanted) {
    Bench bench;
    bench.param("1112", "1").param("1113", type_2);
    bench.add("O1000", std::string("#100=#100+1\n") + interrupt + "M99\n");
    const Outcome outcome = interrupted(bench, "#100=0\nM96 P1000\nG0 X1.\nX2.\nX3.\nM97\nX4.\nM30", line, wanted, false);
    EXPECT_TRUE(outcome.ended_ok) << interrupt << type_2;
    return outcome;
  };
  for (const char* type_2 : {"0", "1"}) {
    const Outcome silent = run("", type_2, 3, is_mark);
    EXPECT_EQ(silent.var(100), 3) << type_2;  // behind X1, X2 and X3
    EXPECT_EQ(silent.path(), (Path{"rapid 1 0 0", "rapid 2 0 0", "rapid 3 0 0", "rapid 4 0 0"})) << type_2;
    const Outcome moves = run("G91 Z1.\n", type_2, 3, is_mark);
    EXPECT_EQ(moves.var(100), 3) << type_2;
    EXPECT_EQ(moves.path().back(), type_2[0] == '0' ? "rapid 10 0 3" : "rapid 4 0 3") << type_2;  // type 1 with moves keeps G91
  }
  EXPECT_EQ(run("", "0", 3, is_move).var(100), 4);  // in X1, and behind each of the three
}

TEST(MacroInterrupt, TheRotationByParameterIsWhatItHasMadeIt) {  // M700 13.21: data like offsets, no modal state
  Bench bench;
  bench.add("O1000", "G10 K90.\nM99\n");
  const char* const text = "M96 P1000\nG0 X1.\nX2.\nX3. Y0\nM30";
  EXPECT_EQ(interrupted(bench, text, 2, is_mark).path(), (Path{"rapid 1 0 0", "rapid 0 2 0", "rapid 0 3 0"}));
  bench.add("O1000", "G10 K0\nM99\n");  // the angle was still 90
  EXPECT_EQ(interrupted(bench.at(0, 0, 0), text, 2, is_mark).path(), (Path{"rapid 0 1 0", "rapid 2 0 0", "rapid 3 0 0"}));
}

TEST(MacroInterrupt, AnotherSignalCountsAtOnce) {  // the signal has been off in between
  Bench bench;
  bench.param("1112", "1");
  bench.add("O1000", "#100=#100+1\nM99\n");
  bench.start("#100=0\nM96 P1000\nG0 X1.\nX2.\nM30");
  Step step;
  unsigned returns = 0;
  for (nc_status status = NC_OK; (status = bench.pull(&step)) == NC_OK || status == NC_BUDGET;) {
    if (status == NC_BUDGET || step.item.kind != NC_ITEM_MARK) continue;
    const bool behind_x1 = step.item.source.line == 3 && step.item.source.depth == 0;
    const bool returned = step.item.source.depth == 1 && step.item.source.line == 2 && ++returns < 3;
    if (!behind_x1 && !returned) continue;
    bool ignored = false;
    nc_interrupt_signal(bench.control(), 0, false, &ignored);
    nc_interrupt_signal(bench.control(), 0, true, &ignored);
    nc_interrupt_signal(bench.control(), 0, false, &ignored);
  }
  EXPECT_EQ(bench.var_now(100), 3);
}

TEST(MacroInterrupt, IgnoredWhileOffAndInService) {
  Bench bench;
  bench.add("O1000", "#100=#100+1\nG0 Z1.\nM99\n");
  EXPECT_EQ(interrupted(bench, "#100=0\nG0 X1.\nM96 P1000\nX2.\nM30", 2, is_mark).var(100), 0);
  EXPECT_EQ(interrupted(bench.at(0, 0, 0), "#100=0\nM96 P1000\nM97\nG0 X1.\nX2.\nM30", 4, is_mark).var(100), 0);
}

TEST(MacroInterrupt, SequenceNumberOfTheInterruptProgram) {  // M96 P H
  Bench bench;
  bench.add("O1000", "#100=1\nN50 #101=1\nM99\n");
  const Outcome run = interrupted(bench, "M96 P1000 H50\nG0 X1.\nM30", 2, is_mark);
  EXPECT_TRUE(std::isnan(run.var(100)));
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(bench.run("M96 P1000 H51\nM30").alarm, "P231");
  EXPECT_EQ(bench.run("M96 P1001\nM30").alarm, "P232");
  EXPECT_EQ(bench.run("M96\nM30").alarm, "P296");
}

TEST(MacroInterrupt, ModalVariablesOfTheInterruptedProgram) {  // #4401...
  Bench bench;
  bench.add("O1000", "G91 F2\n#100=#4403\n#101=#4509\n#102=#4514\n#103=#4520\nM99\n");
  const Outcome run = interrupted(bench, "M96 P1000\nT4\nN33 G1 X1. F250\nM30", 3, is_mark);
  EXPECT_EQ(run.var(100), 90);
  EXPECT_EQ(run.var(101), 250);
  EXPECT_EQ(run.var(102), 33);
  EXPECT_EQ(run.var(103), 4);
  EXPECT_EQ(bench.run("#100=#4401\nM30").alarm, "P241");
  EXPECT_EQ(bench.run("#100=#4520\nM30").alarm, "P241");
}

TEST(MacroInterrupt, OtherCodesByParameter) {  // #1109 #1110 #1111
  Bench bench;
  bench.add("O1000", "#100=1\nM99\n");
  bench.param("1109", "1").param("1110", "80").param("1111", "81");
  const Outcome run = interrupted(bench, "M80 P1000\nG0 X1.\nM81 M96\nM30", 2, is_mark);
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.aux(), "M96 M30");
}

/// A second interrupt comes between the return and the rest of the interrupted block: what that block has done is not done again.
TEST(MacroInterrupt, AgainBeforeTheBlockGoesOn) {
  Bench bench;
  bench.add("O1000", "#100=#100+1\nM99\n");
  bench.start("#100=0\nM96 P1000\nG0 M8 X5.\nM30");
  Step step;
  Outcome run;
  unsigned signals = 0;
  bool ignored = false, take_back = false;
  for (nc_status status; (status = bench.pull(&step)) == NC_OK || status == NC_BUDGET;) {
    if (status == NC_BUDGET) continue;
    const bool in_block = step.item.kind == NC_ITEM_GATE && step.item.source.line == 3;
    const bool back = step.item.kind == NC_ITEM_MARK && step.item.source.depth == 1 && step.item.source.line == 2;
    take_back = false;
    if ((in_block && signals == 0) || (back && signals == 1)) {
      ++signals;
      nc_interrupt_signal(bench.control(), 0, true, &take_back);
      nc_interrupt_signal(bench.control(), 0, false, &ignored);
    }
    if (!take_back) run.steps.push_back(step);
  }
  EXPECT_EQ(signals, 2u);
  EXPECT_EQ(bench.var_now(100), 2);
  EXPECT_EQ(run.aux(), "M8 M30");
}

/// An interrupt program that neither moves nor gives out codes changes nothing, wherever it comes: no part of a block is executed twice, and none is
/// lost.
TEST(MacroInterrupt, WithoutMovesNothingChangesAtAnyItem) {
  const std::string text =
      "M96 P1000\nG0 X1. Y2.\nT3 M6\nG1 X5. F300 M8 S500\nG91 G2 X2. I1.\nG90 G4 P100\nG98 G83 X9. Y1. Z-3. Q1. R1. F100\nX11. L2\nG80 G0\n"
      "M98 P1 L2\n#1=2\nWHILE [#1 GT 0] DO1\nG91 X[#1]\n#1=#1-1\nEND1\nG65 P2 A4.\nG66 P2 A1.\nG0 X3. Z2.\nG67\nG90 G28 X0\nM30";
  const auto prepare = [](Bench& bench, bool type_2) {
    bench.add("O1", "G91 X1. M7\nG90\nM99\n");
    bench.add("O2", "G0 Z[5+#1]\nM9\nM99\n");
    bench.add("O1000", "#150=#150+1\nG91 G55 F5\nM99\n");
    bench.param("1113", type_2 ? "1" : "0").param("8013", "0.5").work_offset(2, {7, 7, 7});
  };
  Bench plain;
  prepare(plain, false);
  const Outcome expected = plain.run(text);
  ASSERT_EQ(expected.alarm, "");
  ASSERT_GT(expected.steps.size(), 90u);
  unsigned accepted = 0;
  for (const bool type_2 : {false, true}) {
    for (size_t at = 3; at + 2 < expected.steps.size(); ++at) {
      SCOPED_TRACE("item " + std::to_string(at) + (type_2 ? ", type 2" : ", type 1"));
      Bench bench;
      prepare(bench, type_2);
      size_t n = 0;
      bench.start(text);
      Outcome run;
      Step step;
      while (bench.pull(&step) == NC_OK && run.steps.size() < 2000) {
        bool take_back = false, ignored = false;
        if (n++ == at) {
          nc_interrupt_signal(bench.control(), 0, true, &take_back);
          nc_interrupt_signal(bench.control(), 0, false, &ignored);
        }
        if (!take_back) run.steps.push_back(step);
      }
      EXPECT_EQ(run.path(), expected.path());
      EXPECT_EQ(run.aux(), expected.aux());
      EXPECT_EQ(run.dwells(), expected.dwells());
      accepted += !std::isnan(bench.var_now(150));
    }
  }
  EXPECT_GT(accepted, 120u);
}

}  // namespace
}  // namespace nc::test
