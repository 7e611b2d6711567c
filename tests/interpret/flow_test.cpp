// SPDX-License-Identifier: Apache-2.0
// Sub programs, macro calls, loops, jumps, the ends of programs (M700 3.1, 3.5, 13.3.1, 13.5.1, 13.5.7).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

// ---- M98, M99 ----------------------------------------------------------------------------------------------------------------

TEST(SubProgram, CallAndReturn) {  // M700 13.3.1
  Bench bench;
  bench.add("O100", "G0 X5.\nM99\n");
  const Outcome run = bench.run("G0 Y1.\nM98 P100\nX0\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 0 1 0", "rapid 5 1 0", "rapid 0 1 0"}));
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{1, 1, 2, 2, 3, 4}));  // the calling block ends behind the return
  std::vector<unsigned> depths, programs;
  for (const nc_item& item : run.of(NC_ITEM_MARK)) depths.push_back(item.source.depth), programs.push_back(item.source.program);
  EXPECT_EQ(depths, (std::vector<unsigned>{0, 1, 1, 0, 0, 0}));
  EXPECT_EQ(programs, (std::vector<unsigned>{0, 100, 100, 0, 0, 0}));
}

TEST(SubProgram, RestOfTheBlockComesFirst) {  // M700 13.5.2 (20178)
  Bench bench;
  bench.add("O100", "G0 Y5.\nM99\n");
  EXPECT_EQ(bench.run("G0 X100. M98 P100\nM30").path(), (Path{"rapid 100 0 0", "rapid 100 5 0"}));
}

TEST(SubProgram, Repetitions) {
  Bench bench;
  bench.add("O1", "G91 G0 X1.\nM99\n");
  EXPECT_EQ(bench.run("M98 P1 L3\nM30").path(), (Path{"rapid 1 0 0", "rapid 2 0 0", "rapid 3 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("M98 P1 L0\nM30").path(), Path{});
  EXPECT_EQ(bench.run("M98 P5 L0\nM30").alarm, "");  // 13.3.1: "not executed when L0", so it may be missing
  EXPECT_EQ(bench.run("M98 P5 L1\nM30").alarm, "P232");
  EXPECT_EQ(bench.at(0, 0, 0).run("M98 P1\nM98 P1\nM30").path().size(), 2u);
}

TEST(SubProgram, OneWayOnInABlock) {  // only the first of them would act
  Bench bench;
  bench.add("O1", "G0 X1.\nM99\n");
  for (const char* block : {"M98 P1 M99", "M98 P1 M98 P1", "M98 P1 M30", "M99 M30", "M2 M99"}) {
    const Outcome run = bench.at(0, 0, 0).run(std::string("G0 X5. ") + block + "\nM30");
    EXPECT_EQ(run.alarm, "P33") << block;
    EXPECT_EQ(run.path(), Path{}) << block;
  }
  EXPECT_EQ(bench.at(0, 0, 0).run("M3 M8 M98 P1\nM30").path(), (Path{"rapid 1 0 0"}));
}

TEST(SubProgram, CodesBehindTheWayOnActInFrontOfIt) {  // 13.3.1: M98 and M99 come behind all else of their block, wherever they stand in it
  for (const nc_dialect family : {NC_DIALECT_M700, NC_DIALECT_HX}) {
    const auto order = [family](const char* main, const char* back) {
      Bench bench(family);
      bench.add("O30.nc", std::string("O30\nG0 X1.\n") + back + "\n");
      const Outcome run = bench.run(std::string(main) + "\nG0 X9.\nM30");
      EXPECT_EQ(run.alarm, "") << main << " " << back;
      std::string all;
      for (const Step& step : run.steps) {
        if (step.item.kind == NC_ITEM_MOVE) all += "move ";
        if (step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_STOP) all += "stop ";
        if (step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_OPTIONAL_STOP) all += "optional ";
        if (step.item.kind == NC_ITEM_END) all += "end";
      }
      return all;
    };
    for (const char* block : {"M98 P30 M00", "M00 M98 P30"}) EXPECT_EQ(order(block, "M99"), "stop move move end") << block;
    for (const char* block : {"M98 P30 M01", "M01 M98 P30"}) EXPECT_EQ(order(block, "M99"), "optional move move end") << block;
    for (const char* block : {"M99 M00", "M00 M99"}) EXPECT_EQ(order("M98 P30", block), "move stop move end") << block;
    EXPECT_EQ(order("M98 P30 L2", "M99 M01"), "move optional optional move end") << "the second pass is there already";
    for (const char* block : {"M02 M00", "M00 M02"}) EXPECT_EQ(order(block, "M99"), "stop end") << block;
  }
}

TEST(SubProgram, FromASequenceNumber) {  // H
  Bench bench;
  bench.add("O1", "G0 X1.\nN20 Y1.\nM99\n");
  EXPECT_EQ(bench.run("G0\nM98 P1 H20 L2\nM30").path(), (Path{"rapid 0 1 0"}));
  EXPECT_EQ(bench.run("M98 P1 H21\nM30").alarm, "P231");
}

TEST(SubProgram, ReturnToASequenceNumber) {  // M99 P
  Bench bench;
  bench.add("O1", "G0 X1.\nM99 P60\n");
  EXPECT_EQ(bench.run("M98 P1\nY9.\nN60 Z1.\nM30").path(), (Path{"rapid 1 0 0", "rapid 1 0 1"}));
  bench.add("O2", "M99 P61\n");
  const Outcome run = bench.run("M98 P2\nM30");
  EXPECT_EQ(run.alarm, "P231");
  EXPECT_EQ(run.alarm_line, 1u);
}

TEST(SubProgram, OwnProgramWithoutP) {  // M98 H_ inside one program
  EXPECT_EQ(m700("G91 G0\nM98 H100 L2\nM30\nN100 X1.\nM99").path(), (Path{"rapid 1 0 0", "rapid 2 0 0"}));
}

TEST(SubProgram, ModalStateIsCommon) {
  Bench bench;
  bench.add("O1", "G91 G1 F7\nM99\n");
  EXPECT_EQ(bench.run("G0 X1.\nM98 P1\nX1.\nM30").path(), (Path{"rapid 1 0 0", "line 2 0 0 F7"}));
}

TEST(SubProgram, InTheSameText) {
  EXPECT_EQ(m700("O1\nM98 P200\nM98 P300\nM30\nO200\nG0 X1.\nM99\nO300\nG0 X2.\nM99\n").path(), (Path{"rapid 1 0 0", "rapid 2 0 0"}));
}

TEST(SubProgram, ByFileName) {  // M700 13.3.1
  Bench bench;
  bench.add("PARTS-12.RAF", "G0 X1.\nM99\n");
  EXPECT_EQ(bench.run("M98 <parts-12.RAF>\nM30").path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(bench.run("M98 <NOT-HERE>\nM30").alarm, "P232");
  EXPECT_EQ(bench.run("M98 <ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456>\nM30").alarm, "P232");
}

TEST(SubProgram, TheHostIsAskedForWhatIsMissing) {
  Bench bench;
  struct Host {
    std::vector<std::string> asked;
    std::string text = "G0 X7.\nM99\n";
  } host;
  nc_program_on_missing(
      bench.control(),
      [](void* user, nc_control* control, const char* name) {
        Host& h = *static_cast<Host*>(user);
        h.asked.push_back(name);
        if (h.asked.size() > 1) return false;
        return nc_program_add_text(control, name, h.text.data(), h.text.size(), nullptr) == NC_OK;
      },
      &host);
  const Outcome run = bench.run("M98 P0100\nM98 P100\nM98 P101\nM30");
  EXPECT_EQ(host.asked, (std::vector<std::string>{"O100", "O101"}));
  EXPECT_EQ(run.path(), (Path{"rapid 7 0 0"}));
  EXPECT_EQ(run.alarm, "P232");
  EXPECT_EQ(run.alarm_line, 3u);
}

TEST(SubProgram, EightLevels) {  // M700 13.3.1
  Bench bench;
  for (int i = 1; i <= 9; ++i) bench.add("O" + std::to_string(i), "#100=" + std::to_string(i) + "\nM98 P" + std::to_string(i + 1) + "\nM99\n");
  bench.add("O8", "#100=8\nM99\n");
  EXPECT_EQ(bench.run("M98 P1\nM30").alarm, "");
  bench.add("O8", "#100=8\nM98 P9\nM99\n");
  const Outcome run = bench.run("M98 P1\nM30");
  EXPECT_EQ(run.alarm, "P230");
  EXPECT_EQ(run.var(100), 8);
  EXPECT_EQ(run.alarm_line, 2u);
}

TEST(SubProgram, Missing) {
  const Outcome run = m700("G0 X1.\nG0 X2. M98 P77\nM30");
  EXPECT_EQ(run.alarm, "P232");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0"}));  // the block with the alarm has not moved
  EXPECT_EQ(run.end_work.v[0], 1);
}

TEST(SubProgram, AnAlarmInsideDoesNotUndoTheCall) {
  Bench bench;
  bench.add("O1", "G99999.\nM99\n");
  const Outcome moved = bench.run("G0 X5. M98 P1\nM30");
  EXPECT_EQ(moved.path(), (Path{"rapid 5 0 0"}));
  EXPECT_EQ(moved.alarm_line, 1u);
  EXPECT_EQ(moved.end_work.v[0], 5);
  EXPECT_EQ(bench.run("G92 X100. M98 P1\nM30").end_work.v[0], 100);
}

TEST(SubProgram, MainM99GoesToItsHead) {  // M700 13.3.1
  Bench bench;
  const Outcome run = bench.run("#100=#100+1\nIF[#100 GE 3]GOTO9\nM99\nN9 M30");
  EXPECT_EQ(run.var(100), 3);
  EXPECT_TRUE(run.ended_ok);
  EXPECT_EQ(m700("GOTO 2\nN1 M30\nN2 M99 P1").ended_ok, true);
}

TEST(SubProgram, SingleBlockDoesNotStopAtAPureCall) {  // M700 13.3.1
  Bench bench;
  bench.add("O1", "G0 X1.\nM99\n");
  auto stops = [&](const char* text) {
    std::vector<unsigned> lines;
    for (const nc_item& item : bench.at(0, 0, 0).run(text).of(NC_ITEM_MARK))
      if (item.u.mark.stop) lines.push_back(item.source.depth * 10 + item.source.line);
    return lines;
  };
  EXPECT_EQ(stops("M98 P1\nM30"), (std::vector<unsigned>{11}));
  EXPECT_EQ(stops("G0 Y1. M98 P1\nM30"), (std::vector<unsigned>{1, 11}));  // stops behind the motion, before the call
  EXPECT_EQ(stops("G65 P1 A1.\nM30"), (std::vector<unsigned>{11}));
}

// ---- ends -----------------------------------------------------------------------------------------------------------------------

TEST(End, NeedsItsCode) {  // M700 P36
  EXPECT_EQ(m700("G0 X1.\nX2.").alarm, "P36");
  EXPECT_EQ(m700("G0 X1.\nX2.").alarm_line, 2u);
  EXPECT_EQ(m700("G0 X1.\n%\nM30").alarm, "P36");
  EXPECT_EQ(m700("G0 X1.\n%\nM30").alarm_line, 2u);
  EXPECT_EQ(m700("O1\nG0 X1.\nO2\nM30").alarm, "P36");
  EXPECT_EQ(m700("").alarm, "P36");
  Bench bench;
  bench.add("O1", "G0 X1.\n");
  EXPECT_EQ(bench.run("M98 P1\nM30").alarm, "P36");
  EXPECT_EQ(dgshape("G0X1000\n").alarm, "NC-END");
}

TEST(End, M02AndM30) {
  for (const char* text : {"M02", "M30", "M2\nG0 X1.", "%\nO1234 (PART)\nM30\n%"}) {
    const Outcome run = m700(text);
    EXPECT_TRUE(run.ended_ok) << text;
    EXPECT_EQ(run.status, NC_ENDED);
    EXPECT_EQ(run.path(), Path{});
    EXPECT_EQ(run.steps.back().item.kind, NC_ITEM_END);
  }
  EXPECT_EQ(m700("G0 X5. M30").path(), (Path{"rapid 5 0 0"}));  // with other words in its block
}

TEST(End, ResetsTheModalStateForTheNextRun) {  // M700 3.7
  Bench bench;
  bench.run("G91 G0 G55 G43 H1 X1.\n#1=5\nM30");
  const Outcome run = bench.run("#100=#4003 #101=#4001 #102=#4012 #103=#4008 #104=#1\nM30");
  EXPECT_EQ(run.var(100), 90);
  EXPECT_EQ(run.var(101), 0);  // 9.1: but for group 01
  EXPECT_EQ(run.var(102), 54);
  EXPECT_EQ(run.var(103), 49);
  EXPECT_TRUE(std::isnan(run.var(104)));  // locals are vacant at the start
}

TEST(Start, PercentAndNumbers) {
  const Outcome run = m700("%\nO77\nN10 G0 X1.\nN20 M30\n%");
  EXPECT_EQ(run.of(NC_ITEM_MOVE)[0].source.program, 77u);
  EXPECT_EQ(run.of(NC_ITEM_MOVE)[0].source.line, 3u);
  EXPECT_EQ(run.last_modal().n, 20u);
  EXPECT_EQ(m700("O0\nM30").alarm, "P37");
  EXPECT_EQ(m700("N0 G0 X1.\nM30").alarm, "P37");
}

TEST(Start, DgshapeNeedsThePercent) {  // DGSHAPE 2-6
  Bench bench(NC_DIALECT_DGSHAPE);
  const Outcome run = bench.run("G0X1000\nM02");
  EXPECT_EQ(run.alarm, "NC-START");
  EXPECT_EQ(run.alarm_line, 1u);
  EXPECT_TRUE(run.moves().empty());
  EXPECT_TRUE(bench.run("%\nO5\nN1G0X1000\nM30\n").ended_ok);
}

// DGSHAPE 2-6: the first "%" is the start of the data, the second their end.
TEST(Start, DgshapeEndsAtTheSecondPercent) {
  for (const char* text : {"%\n%\nG0X1000\nM30\n", "%\n(A)\n%\nG0X1000\nM30\n", "%\n\n%\nO7\nM30\n"}) {
    const Outcome run = Bench(NC_DIALECT_DGSHAPE).run(text);
    EXPECT_EQ(run.alarm, "NC-END") << text;
    EXPECT_TRUE(run.moves().empty()) << text;
  }
  const Outcome run = Bench(NC_DIALECT_DGSHAPE).run("%\nG0X1000\n%\nG0X2000\nM30\n");
  EXPECT_EQ(run.alarm, "NC-END");
  EXPECT_EQ(run.alarm_line, 3u);
  EXPECT_EQ(run.path(), Path{"rapid 1 0 0"});
  EXPECT_TRUE(Bench(NC_DIALECT_DGSHAPE).run("%\nG0X1000\nM30\n%\n%\nG0X5000\nM30\n").ended_ok);
}

// ---- GOTO -------------------------------------------------------------------------------------------------------------------------

TEST(Goto, LooksBehindFirstThenFromTheHead) {  // M700 13.5.7: of equal numbers the next one below wins
  EXPECT_EQ(m700("N5 #100=#100+1\nIF[#100 GT 1]GOTO9\nGOTO5\n#101=1\nN5 #102=1\nGOTO9\nN9 M30").var(102), 1);
  const Outcome back = m700("N5 #100=#100+1\nIF[#100 GT 2]GOTO9\nGOTO5\nN9 M30");
  EXPECT_EQ(back.var(100), 3);
}

TEST(Goto, BySkippedBlocksAndExpressions) {
  EXPECT_TRUE(m700("#1=7\nGOTO[#1+3]\n#100=1\n/N10 M30").ended_ok);
  EXPECT_EQ(m700("GOTO 8\nM30").alarm, "P231");
  const Outcome run = m700("#100=1 GOTO2 #101=5\n#102=1\nN2 M30");  // blocks behind a jump are not reached
  EXPECT_EQ(run.vars, (std::map<uint32_t, double>{{100, 1}}));
}

TEST(Goto, StaysInItsProgram) {
  EXPECT_EQ(m700("O1\nGOTO5\nM30\nO2\nN5 M30").alarm, "P231");
}

TEST(Goto, AnEndlessOneIsInterruptible) {
  Bench bench;
  const Outcome run = bench.run("N1 GOTO1", 50, 5000);
  EXPECT_EQ(run.status, NC_BUDGET);
  EXPECT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_TRUE(bench.run("M30").ended_ok);
}

// ---- loops -------------------------------------------------------------------------------------------------------------------------

TEST(Loop, WhileTestsFirst) {  // M700 13.5.7
  EXPECT_EQ(m700("#100=0\nWHILE[#100 LT 5]DO1\n#100=#100+1\nEND1\nM30").var(100), 5);
  EXPECT_TRUE(std::isnan(m700("WHILE[1 EQ 2]DO1\n#100=1\nEND1\nM30").var(100)));
}

TEST(Loop, DoWithoutWhileIsEndless) {
  EXPECT_EQ(m700("DO1\n#100=#100+1\nIF[#100 EQ 4]GOTO9\nEND1\nN9 M30").var(100), 4);
}

TEST(Loop, Nested) {
  EXPECT_EQ(m700("#1=0\nWHILE[#1 LT 3]DO1\n#2=0\nWHILE[#2 LT 4]DO2\n#100=#100+1\n#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30").var(100), 12);
}

TEST(Loop, NumbersMayBeUsedAgain) {
  EXPECT_EQ(m700("#1=0\nWHILE[#1 LT 2]DO1\n#1=#1+1\nEND1\n#1=0\nWHILE[#1 LT 3]DO1\n#1=#1+1 #100=#100+1\nEND1\nM30").var(100), 3);
}

TEST(Loop, TwentySevenDeep) {  // M700 13.5.7, P293
  auto nest = [](int n) {
    std::string text, ends;
    for (int i = 1; i <= n; ++i) {
      text += "#" + std::to_string(500 + i) + "=0\nWHILE[#" + std::to_string(500 + i) + " LT 1]DO" + std::to_string(i) + "\n";
      ends = "#" + std::to_string(500 + i) + "=1\nEND" + std::to_string(i) + "\n" + ends;
    }
    return text + "#100=#100+1\n" + ends + "M30";
  };
  EXPECT_EQ(m700(nest(27)).var(100), 1);
  EXPECT_EQ(m700(nest(27)).alarm, "");
  EXPECT_EQ(m700(nest(28)).alarm, "P293");
}

TEST(Loop, PairsThatDoNotMatch) {
  EXPECT_EQ(m700("WHILE[1 EQ 1]DO1\nWHILE[1 EQ 1]DO1\nEND1\nEND1\nM30").alarm, "P294");  // in use already
  EXPECT_EQ(m700("END1\nM30").alarm, "P294");
  EXPECT_EQ(m700("DO1\nEND2\nM30").alarm, "P294");
  EXPECT_EQ(m700("WHILE[1 EQ 0]DO1\nM30").alarm, "P294");
  EXPECT_EQ(m700("WHILE[1 EQ 1]DO1\nWHILE[1 EQ 0]DO2\nEND1\nEND2\nM30").alarm, "P294");  // overlapping
  EXPECT_EQ(m700("WHILE[1 EQ 1]DO128\nEND128\nM30").alarm, "P291");
  EXPECT_EQ(m700("WHILE 1 DO1\nEND1\nM30").alarm, "P291");
  EXPECT_EQ(m700("IF 1 GOTO2\nM30").alarm, "P290");
}

TEST(Loop, JumpOutAndInAgain) {
  const Outcome run = m700(
      "#1=0\nN1 WHILE[#1 LT 10]DO1\n#1=#1+1\nWHILE[#2 LT 1]DO2\nIF[#1 EQ 3]GOTO5\n#2=1\nEND2\n#2=0\nEND1\nN5 #100=#1\n"
      "IF[#3 EQ 1]GOTO6\n#3=1\nGOTO1\nN6 M30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 10);
}

TEST(Loop, CallsInside) {  // numbers start from 1 again in the called program
  Bench bench;
  bench.add("O1", "#2=0\nWHILE[#2 LT 2]DO1\n#2=#2+1 #100=#100+1\nEND1\nM99\n");
  EXPECT_EQ(bench.run("#1=0\nWHILE[#1 LT 3]DO1\nM98 P1\n#1=#1+1\nEND1\nM30").var(100), 6);
}

TEST(Loop, AReturnLeavesTheLoopsOfItsProgram) {
  Bench bench;
  bench.add("O1", "WHILE[1 EQ 1]DO1\nM99\nEND1\n");
  EXPECT_EQ(bench.run("#1=0\nWHILE[#1 LT 30]DO2\nM98 P1\n#1=#1+1\nEND2\n#100=#1\nM30").var(100), 30);
}

// ---- G65 ----------------------------------------------------------------------------------------------------------------------------

/// Calls a macro with these words, which copies all its local variables to #101 to #133.
Outcome arguments(const std::string& words) {
  Bench bench;
  std::string copy;
  for (int i = 1; i <= 33; ++i) copy += "#" + std::to_string(100 + i) + "=#" + std::to_string(i) + "\n";
  bench.add("O9000", copy + "M99\n");
  return bench.run("G65 P9000 " + words + "\nM30");
}

TEST(Macro, DesignationOne) {  // M700 13.5.1
  const Outcome run = arguments("A1. B2. C3. D4. E5. F6. H7. I8. J9. K10. M11. Q12. R13. S14. T15. U16. V17. W18. X19. Y20. Z21.");
  const std::map<int, double> expected = {{1, 1},   {2, 2},   {3, 3},   {7, 4},   {8, 5},   {9, 6},   {11, 7},  {4, 8},   {5, 9},  {6, 10}, {13, 11},
                                          {17, 12}, {18, 13}, {19, 14}, {20, 15}, {21, 16}, {22, 17}, {23, 18}, {24, 19}, {25, 20}, {26, 21}};
  for (int i = 1; i <= 33; ++i) {
    const auto at = expected.find(i);
    if (at == expected.end()) {
      EXPECT_TRUE(std::isnan(run.var(100 + i))) << i;
    } else {
      EXPECT_EQ(run.var(100 + i), at->second) << i;
    }
  }
}

TEST(Macro, ArgumentsAreNumbersAsTheyStand) {  // no unit: A10 is 10.000
  const Outcome run = arguments("A10 F100 X-0.5 S1000 D2.5");
  EXPECT_EQ(run.var(101), 10);
  EXPECT_EQ(run.var(109), 100);
  EXPECT_EQ(run.var(124), -0.5);
  EXPECT_EQ(run.var(119), 1000);
  EXPECT_EQ(run.var(107), 2.5);
}

TEST(Macro, DesignationTwo) {  // up to ten groups of I J K
  const Outcome run = arguments("A1. I2. J3. K4. I5. J6. K7. I8. K9. J10.");
  EXPECT_EQ(run.var(104), 2);
  EXPECT_EQ(run.var(105), 3);
  EXPECT_EQ(run.var(106), 4);
  EXPECT_EQ(run.var(107), 5);
  EXPECT_EQ(run.var(108), 6);
  EXPECT_EQ(run.var(109), 7);
  EXPECT_EQ(run.var(110), 8);
  EXPECT_TRUE(std::isnan(run.var(111)));
  EXPECT_EQ(run.var(112), 9);
  EXPECT_EQ(run.var(114), 10);
  EXPECT_EQ(arguments("I1. I2. I3. I4. I5. I6. I7. I8. I9. I10.").var(131), 10);
  EXPECT_EQ(arguments("I1. I2. I3. I4. I5. I6. I7. I8. I9. I10. I11.").alarm, "P275");
}

TEST(Macro, MixedTheLaterOneWins) {  // M700 13.5.1, the printed example
  const Outcome run = arguments("A1.1 B-2.2 D3.3 I4.4 I7.7");
  EXPECT_EQ(run.var(101), 1.1);
  EXPECT_EQ(run.var(102), -2.2);
  EXPECT_EQ(run.var(104), 4.4);
  EXPECT_EQ(run.var(107), 7.7);
  EXPECT_TRUE(std::isnan(run.var(105)));
  EXPECT_EQ(arguments("I4.4 I7.7 D3.3").var(107), 3.3);
}

TEST(Macro, NothingMovesAndNothingGoesOut) {
  const Outcome run = arguments("X5. M8. S100. T3. F50.");
  EXPECT_EQ(run.path(), Path{});
  EXPECT_EQ(run.aux(), "M30");
}

TEST(Macro, CodesBeforeItAct) {  // M700 13.5.5 (10.9) example: G91 G65
  Bench bench;
  bench.add("O300", "#100=#4003\nG#1 X#24 Y#25\nM99\n");
  const Outcome run = bench.run("G90 G1 X100. F1000\nG91 G65 P300 A1. X100. Y100.\nM30");
  EXPECT_EQ(run.var(100), 91);
  EXPECT_EQ(run.path(), (Path{"line 100 0 0 F1000", "line 200 100 0 F1000"}));
}

TEST(Macro, LevelsHaveLocalsOfTheirOwn) {  // M700 13.5.5
  Bench bench;
  bench.add("O1", "#500=#1\n#1=22\nM98 P2\n#502=#1\nG65 P3 A7\n#504=#1\nM99\n");
  bench.add("O2", "#501=#1\n#1=33\nM99\n");  // M98 does not change the level
  bench.add("O3", "#503=#1\n#1=99\nM99\n");
  const Outcome run = bench.run("#1=5\nG65 P1 A11\n#505=#1\nM30");
  EXPECT_EQ(run.var(500), 11);
  EXPECT_EQ(run.var(501), 22);
  EXPECT_EQ(run.var(502), 33);
  EXPECT_EQ(run.var(503), 7);
  EXPECT_EQ(run.var(504), 33);
  EXPECT_EQ(run.var(505), 5);
}

TEST(Macro, FourLevels) {  // M700 13.5.2, P273
  Bench bench;
  for (int i = 1; i <= 5; ++i) bench.add("O" + std::to_string(i), "#100=" + std::to_string(i) + "\nG65 P" + std::to_string(i + 1) + "\nM99\n");
  bench.add("O4", "#100=4\nM99\n");
  EXPECT_EQ(bench.run("G65 P1\nM30").alarm, "");
  bench.add("O4", "#100=4\nG65 P5\nM99\n");
  EXPECT_EQ(bench.run("G65 P1\nM30").alarm, "P273");
  EXPECT_EQ(bench.var_now(100), 4);
}

TEST(Macro, Repetitions) {
  Bench bench;
  bench.add("O1", "G91 G0 X#24\nM99\n");
  EXPECT_EQ(bench.run("G65 P1 L3 X2.\nM30").path(), (Path{"rapid 2 0 0", "rapid 4 0 0", "rapid 6 0 0"}));
  EXPECT_EQ(bench.run("G65 P1 L0 X2.\nM30").path(), Path{});
  EXPECT_EQ(bench.run("G65 P5 L0 X2.\nM30").alarm, "");
}

TEST(Macro, FrontMillingOfTheManual) {  // M700 13.5.5 (20893-20955)
  Bench bench;
  bench.add("O1", "#30=FUP[#2/#5/2]\n#5=#2/#30/2\nM98 H100 L#30\nM99\nN100 G1 X#1 F#9\nY#5\nX-#1\nY#5\nM99\n");
  const Outcome run = bench.run("G91 G65 P1 A100. B50. J10. F500\nM30");
  ASSERT_EQ(run.moves().size(), 12u);
  EXPECT_NEAR(run.moves()[11].machine.v[1], 50, 1e-9);
  EXPECT_EQ(run.moves()[0].feed_mm_min, 500);
}

TEST(Macro, Alarms) {
  EXPECT_EQ(m700("G65 A1.\nM30").alarm, "P296");
  EXPECT_EQ(m700("G65 P5\nM30").alarm, "P232");
  EXPECT_EQ(arguments("N5").alarm, "P32");
  EXPECT_EQ(m700("G67\nM30").alarm, "P276");
  EXPECT_EQ(m700("G66 P1\nM30").alarm.empty(), false);
}

TEST(Macro, SeveralStatementsAreDoneFromLeftToRight) {  // M700 13.4
  EXPECT_EQ(m700("#1=200 #2=#1+200\n#100=#2\nM30").var(100), 400);
}

TEST(Macro, TheBlockThatAlarmsHasNoEffect) {
  const Outcome run = m700("#100=1\n#100=2 #101=1/0\nM30");
  EXPECT_EQ(run.alarm, "P283");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_EQ(run.var(100), 1);
}

TEST(Macro, VariablesByNumber) {  // M700 13.5.4, printed examples
  EXPECT_EQ(m700("#1=10 #10=20 #20=30\n#100=#[#[#1]]\n#101=##1\nM30").var(100), 30);
  EXPECT_EQ(m700("#10=5\n#[#10+1]=1000\n#[#10-1]=-1000\n#[#10*3]=100\n#[#10/2]=-100\n#100=#6 #101=#4 #102=#15 #103=#3\nM30").var(103), -100);
  EXPECT_EQ(m700("#99999=1\nM30").alarm, "P241");
  EXPECT_EQ(m700("#[-1]=1\nM30").alarm, "P241");
  EXPECT_EQ(m700("#0=1\nM30").alarm, "P243");
  EXPECT_EQ(m700("#100 5\nM30").alarm, "P242");
  EXPECT_EQ(m700("G0 X#1=5\nM30").alarm, "P272");
}

TEST(Macro, OptionOfCommonVariables) {  // M700 13.4
  auto alarm = [](uint32_t sets, const char* text) { return Bench(NC_DIALECT_M700, [sets](nc_config& c) { c.variable_sets = sets; }).run(text).alarm; };
  EXPECT_EQ(alarm(100, "#149=1 #549=1\nM30"), "");
  EXPECT_EQ(alarm(100, "#150=1\nM30"), "P241");
  EXPECT_EQ(alarm(200, "#199=1 #599=1\nM30"), "");
  EXPECT_EQ(alarm(200, "#600=1\nM30"), "P241");
  EXPECT_EQ(alarm(300, "#700=1\nM30"), "P241");
  EXPECT_EQ(alarm(600, "#999=1\nM30"), "");
}

// ---- M198, the program store ---------------------------------------------------------------------------------------------------

TEST(ExternalProgram, FirstLineIsNotRunUnlessItIsAnONumber) {  // M700 13.3.2
  Bench bench;
  bench.add("198:O7", "#100=1\n#101=1\nM99\n");
  bench.add("198:O8", "O8\n#102=1\nM99\n");
  bench.add("198:PART.NC", "#103=1;\n#104=1\nM99\n");
  const Outcome run = bench.run("M198 P7\nM198 P8\nM198 <PART.NC>\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_TRUE(std::isnan(run.var(100)));
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(run.var(102), 1);
  EXPECT_TRUE(std::isnan(run.var(103)));
  EXPECT_EQ(run.var(104), 1);
}

TEST(ExternalProgram, Rules) {
  Bench bench;
  bench.add("O5", "#100=#100+1\nM99\n");
  EXPECT_EQ(bench.run("#100=0\nM198 P5 L3\nM198 P5 L0\nM30").var(100), 3);  // a program that the server does not have is looked for in memory
  bench.add("198:O6", "O6\nM198 P5\nM99\n");
  EXPECT_EQ(bench.run("M198 P6\nM30").alarm, "P230");  // once per nest
  EXPECT_EQ(bench.run("M198 P5 H1\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("M198 P4\nM30").alarm, "P232");
  EXPECT_EQ(bench.run("M198\nM30").alarm, "P296");
}

TEST(ProgramStore, ProtectedNumbersAreNotReplaced) {
  Bench bench;
  bench.add("O8500", "M99\n");
  bench.add("O9100", "M99\n");
  bench.add("O8500", "M99\n");
  unsigned file = 0;
  bench.param("1121", "1");
  EXPECT_EQ(nc_program_add_text(bench.control(), "O9100", "M99", 3, &file), NC_E_STATE);
  EXPECT_EQ(nc_program_add_text(bench.control(), "O8500", "M99", 3, &file), NC_OK);
  bench.param("8105", "1");
  EXPECT_EQ(nc_program_add_text(bench.control(), "O8500", "M99", 3, &file), NC_E_STATE);
  EXPECT_EQ(nc_program_add_text(bench.control(), "O7999", "M99", 3, &file), NC_OK);
}

TEST(Reset, ClearsCommonVariablesByParameter) {  // M700 13.4, #1128
  Bench bench;
  bench.var(100, 1).var(199, 1).var(500, 1);
  EXPECT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_EQ(bench.var_now(100), 1);
  bench.param("1128", "1");
  EXPECT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_TRUE(std::isnan(bench.var_now(100)));
  EXPECT_TRUE(std::isnan(bench.var_now(199)));
  EXPECT_EQ(bench.var_now(500), 1);
}

TEST(SubPrograms, AReturnMayChangeThePasses) {  // M99 L: as FANUC
  Bench bench;
  bench.add("O1", "#100=#100+1\nIF [#100 NE 2] GOTO 9\nM99 L2\nN9 M99\n");
  EXPECT_EQ(bench.run("#100=0\nM98 P1 L7\nM30").var(100), 3);
  bench.add("O1", "#100=#100+1\nM99 L0\n");
  EXPECT_EQ(bench.run("#100=0\nM98 P1 L7\nM30").var(100), 1);
}

TEST(SubPrograms, OfADevice) {  // 13.3.1 ,D
  Bench bench;
  bench.add("O1", "#100=1\nM99\n");
  bench.add("D2:O1", "#100=2\nN5 #101=5\nM99\n");
  bench.add("D2:PART.NC", "#100=3\nM99\n");
  EXPECT_EQ(bench.run("M98 P1 ,D0\nM30").var(100), 1);
  EXPECT_EQ(bench.run("M98 P1 ,D2\nM30").var(100), 2);
  EXPECT_EQ(bench.run("#100=0\nM98 P1 H5 ,D2\nM30").var(100), 0);
  EXPECT_EQ(bench.run("M98 <PART.NC> ,D2\nM30").var(100), 3);
  EXPECT_EQ(bench.run("M98 P1 ,D3\nM30").alarm, "P232");
  EXPECT_EQ(bench.run("M98 P1 ,D5\nM30").alarm, "P35");
  EXPECT_EQ(bench.run("G0 X1. ,D2\nM30").alarm, "P39");
}

TEST(SubPrograms, OneThatIsBeingEdited) {  // appendix 1, P235
  Bench bench;
  const unsigned file = bench.add("O1", "G0 X5.\nM99\n");
  ASSERT_EQ(nc_program_edit(bench.control(), file, true), NC_OK);
  EXPECT_EQ(bench.run("M98 P1\nM30").alarm, "P235");
  EXPECT_EQ(bench.run("G65 P1\nM30").alarm, "P235");
  ASSERT_EQ(nc_program_edit(bench.control(), file, false), NC_OK);
  EXPECT_EQ(bench.run("M98 P1\nM30").alarm, "");
  EXPECT_EQ(nc_program_edit(bench.control(), 9999, true), NC_E_ARGUMENT);
}

TEST(CommonVariables, OfSeveralPartSystems) {  // 13.4, #1303 #1304
  const auto two = [](nc_config& c) { c.system_count = 2, c.system[1] = c.system[0]; };
  Bench bench(NC_DIALECT_M700, two);
  const auto value = [&](unsigned system, uint32_t number) {
    double v = 0;
    bool vacant = true;
    nc_variable_get(bench.control(), system, number, &v, &vacant);
    return vacant ? -1 : v;
  };
  bench.run("#100=1 #150=2 #500=3 #600=4\nM30");
  EXPECT_EQ(value(0, 100), 1);
  EXPECT_EQ(value(1, 100), -1);  // common 2 belongs to one part system
  EXPECT_EQ(value(1, 500), 3);   // common 1 to all
  EXPECT_EQ(value(1, 600), 4);
  for (unsigned system = 0; system < 2; ++system) {
    nc_parameter_set(bench.control(), system, "1303", 0, "120");
    nc_parameter_set(bench.control(), system, "1304", 0, "550");
  }
  bench.run("#100=5 #150=6 #500=7 #600=8\nM30");
  EXPECT_EQ(value(1, 100), 5);
  EXPECT_EQ(value(1, 150), -1);
  EXPECT_EQ(value(1, 500), 7);
  EXPECT_EQ(value(1, 600), -1);
  std::string all;
  uint32_t number = 0;
  double v = 0;
  for (; nc_variable_next(bench.control(), 0, number, &number, &v) == NC_OK; ++number) all += std::to_string(number) + "=" + brief(v) + " ";
  EXPECT_EQ(all, "100=5 150=6 500=7 600=8 ");
}

TEST(Calls, NumbersHaveNoSignAndEightDigits) {  // M700 3.5, App.1 P35
  for (const char* block : {"M98 P-1", "M98 P100000000", "M98 P1 H-1", "M98 P1 L-1", "M98 H-5", "M98 P-1 ,D1", "M198 P-1", "M198 P1 L-1", "G65 P-1",
                            "G65 P1 L-1", "G66 P-1", "M96 P-1", "M98 P2", "M98 P99999999 L0 H1"}) {
    Bench bench;
    bench.add("O1", "N1 M99\n");
    bench.add("O2", "M99 P-1\n");
    const bool good = std::string_view(block).find("L0") != std::string_view::npos;
    EXPECT_EQ(bench.run(std::string(block) + "\nM30").alarm, good ? "" : "P35") << block;
  }
  EXPECT_EQ(m700("M98 P99999999\nM30").alarm, "P232");
}

// M700 9.1: if the first movement after the next start has only coordinate words, the mode at the end of the program still counts.
TEST(AfterTheEnd, MovementGoesOnInTheModeOfTheEnd) {
  Bench bench;
  EXPECT_EQ(bench.run("G91 G0 X10.\nM30").path(), Path{"rapid 10 0 0"});
  EXPECT_EQ(bench.run("X20.\nG1 Y1. F300\nM2").path(), (Path{"rapid 20 0 0", "line 20 1 0 F300"}));  // absolute again
  EXPECT_EQ(bench.run("X30.\nM30").path(), Path{"line 30 1 0 F300"});  // 7.2 note 1: F is asked for once after power on
  EXPECT_EQ(bench.run("G4 X1.\nM30").alarm, "");
  EXPECT_EQ(bench.run("X40.\nM30").path(), Path{"line 40 1 0 F300"});
}

TEST(AfterTheEnd, AnotherFeedModeHasNoFeed) {
  Bench bench;
  EXPECT_EQ(bench.run("G95 G1 X10. F0.5\nM30").alarm, "");
  EXPECT_EQ(bench.run("X20.\nM30").alarm, "P62");
}

TEST(AfterTheEnd, AResetOrAnAlarmBeginsAnew) {
  Bench bench;
  EXPECT_EQ(bench.run("G0 X10.\nM30").alarm, "");
  ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_EQ(bench.run("X20.\nM30").alarm, "P62");
  EXPECT_EQ(bench.run("G0 X10.\nM30").alarm, "");
  EXPECT_EQ(bench.run("G0 X20.\nG999").alarm, "P34");
  EXPECT_EQ(bench.run("X30.\nM30").alarm, "P62");
  Bench other(NC_DIALECT_DGSHAPE);
  EXPECT_EQ(other.run("%\nG1X10000F60000\nM30").path(), Path{"line 10 0 0 F60"});
  EXPECT_EQ(other.run("%\nX20000\nM30").path(), Path{"rapid 20 0 0"});
}

}  // namespace
}  // namespace nc::test
