// SPDX-License-Identifier: Apache-2.0
// Modal macro calls, codes that call programs, names of variables, external output (M700 13.5.1 - 13.5.3, 13.5.5, 13.5.8).
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/pull.hpp"

namespace nc::test {
namespace {

std::vector<std::string> printed(const Outcome& run) {
  std::vector<std::string> lines;
  for (const Step& step : run.steps)
    if (step.item.kind == NC_ITEM_ACTION && step.item.u.action.kind == NC_ACTION_MESSAGE && step.item.u.action.index == 1) lines.push_back(step.text);
  return lines;
}

// ---- G66, G66.1, G67 -----------------------------------------------------------------------------------------------------------

TEST(ModalMacro, CallsBehindEachMove) {  // 13.5.1: the G66 block stores, moves call, blocks without movement do not
  Bench bench;
  bench.add("O10", "#100=#100+#1\nM99\n");
  const Outcome run = bench.run("#100=0\nG66 P10 A1.\nG0 X1.\nM8\nF100\nG1 Y1.\nG67\nX5.\nM30");
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "line 1 1 0 F100", "line 5 1 0 F100"}));
}

TEST(ModalMacro, CallsBehindAnUnidirectionalMove) {  // G60 (6.8) is not modal, and a movement all the same
  Bench bench;
  bench.add("O10", "#100=#100+1\nM99\n");
  const Outcome run = bench.run("#100=0\nG66 P10\nG60 X10.\nG67\nG60 X20.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 1);
}

TEST(ModalMacro, MoveFirstThenLTimes) {
  Bench bench;
  bench.add("O10", "G0 G91 Z-#26\nZ#26 G90\nM99\n");
  EXPECT_EQ(bench.run("G66 P10 L2 Z3.\nG0 X1.\nG67\nM30").path(),
            (Path{"rapid 1 0 0", "rapid 1 0 -3", "rapid 1 0 0", "rapid 1 0 -3", "rapid 1 0 0"}));
}

TEST(ModalMacro, MarkOfTheMovingBlockComesBehindTheMacro) {
  Bench bench;
  bench.add("O10", "#100=1\nM99\n");
  const Outcome run = bench.run("G66 P10\nG0 X1.\nM30");
  std::vector<unsigned> depths;
  for (const nc_item& item : run.of(NC_ITEM_MARK))
    if (item.u.mark.report) depths.push_back(item.source.depth);
  EXPECT_EQ(depths, (std::vector<unsigned>{0, 1, 1, 0, 0}));
}

TEST(ModalMacro, StackedCallsRunInTheMacrosOfTheLastOne) {  // 13.5.1 (2), 13.5.2 (20205)
  Bench bench;
  bench.add("O1", "#101=#101+1\nM99\n");
  bench.add("O2", "#102=#102+1\nG0 Z#102\nZ0\nM99\n");
  const Outcome run = bench.run("#101=0\n#102=0\nG66 P1\nG66 P2\nG0 X1.\nG67\nX2.\nG67\nX3.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(102), 1);  // behind X1 only
  EXPECT_EQ(run.var(101), 3);  // behind the two moves of O2, and behind X2
}

TEST(ModalMacro, OwnLocalsAtEachCall) {
  Bench bench;
  bench.add("O10", "#100=#1\n#1=99\n#101=#2\nM99\n");
  const Outcome run = bench.run("#1=7\nG66 P10 A5.\nG0 X1.\nX2.\nG67\n#102=#1\nM30");
  EXPECT_EQ(run.var(100), 5);
  EXPECT_EQ(run.var(102), 7);
  EXPECT_TRUE(std::isnan(run.var(101)));
}

TEST(ModalMacro, ComesBeforeTheProgramThatTheBlockCalls) {  // 13.5.1: behind the movement; 13.3.1: M98 behind all else
  Bench bench;
  bench.add("O10", "#100=#100+1\n#[110+#100]=#5001\n#120=20\nM99\n");
  bench.add("O20", "G0 X5.\nG91 X1. M99\n");
  Outcome run = bench.run("G66 P10\nG0 X1. M98 P20\nG90 X9.\nG67\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 5 0 0", "rapid 6 0 0", "rapid 9 0 0"}));
  EXPECT_EQ(run.var(100), 4);
  EXPECT_EQ((std::array{run.var(111), run.var(112), run.var(113), run.var(114)}), (std::array{1., 5., 6., 9.}));
  // The block ends once, after the return; its other words are evaluated after the macro.
  run = bench.at(0, 0, 0).run("#100=0 #120=0\nG90 G66 P10\nG0 X1. M98 P#120 L2\nG67\nM30");
  EXPECT_EQ(run.var(100), 5);
  unsigned ends = 0;
  for (const Step& step : run.steps)
    ends += step.item.kind == NC_ITEM_MARK && step.item.u.mark.report && step.item.source.depth == 0 && step.item.source.line == 3 ? 1u : 0u;
  EXPECT_EQ(ends, 1u);
  // G66 L0 calls nothing.
  EXPECT_EQ(bench.at(0, 0, 0).run("#100=0\nG90 G66 P10 L0\nG0 X1. M98 P20\nG67\nM30").var(100), 0);
  // A jump out of the macro forgets the call.
  bench.add("O11", "#100=#100+1\nM99 P50\n");
  EXPECT_EQ(bench.at(0, 0, 0).run("#100=0\nG66 P11\nG0 X1. M98 P21\nN50 G67\nM30").var(100), 1);
}

TEST(ModalMacro, ABlockThatHasMovedIsNotSkippedAnyMore) {  // 3.4: decided when the block is read
  Bench bench;
  bench.add("O10", "#100=#1000\n#101=1\nM99\n");
  bench.add("O20", "#102=1\nM99\n");
  bench.on_sync = [&](const nc_item&) { nc_switches_set(bench.control(), 0, 1u << 1, 0); };
  const Outcome run = bench.run("G66 P10\nG0\n/X1. M98 P20\n/X2.\nG67\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(run.var(102), 1);
}

TEST(ModalMacro, ComesBeforeACodeThatCalls) {  // 13.5.2
  Bench bench;
  bench.param("1195", "1").param("7001", "50").param("7002", "0").param("7003", "20");
  bench.add("O10", "#100=#100+1\nM99\n");
  bench.add("O20", "#101=#100\nM99\n");
  const Outcome run = bench.run("G66 P10\nG0 X1. M50\nG67\nM30");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(run.aux(), "M30");
}

TEST(ModalMacro, CallsInSubProgramsToo) {
  Bench bench;
  bench.add("O10", "#100=#100+1\nM99\n");
  bench.add("O20", "G0 X1.\nX2.\nM99\n");
  EXPECT_EQ(bench.run("#100=0\nG66 P10\nM98 P20\nG67\nM30").var(100), 2);
}

TEST(ModalMacro, CancelInTheMacroItself) {  // 13.5.2 (1)
  Bench bench;
  bench.add("O10", "#100=#100+1\nG67\nM99\n");
  const Outcome run = bench.run("#100=0\nG66 P10\nG0 X1.\nX2.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 1);
  const Outcome twice = bench.at(0, 0, 0).run("#100=0\nG66 P10 L2\nG0 X1.\nX2.\nM30");
  EXPECT_EQ(twice.alarm, "");
  EXPECT_EQ(twice.var(100), 2);
}

TEST(ModalMacro, Alarms) {
  Bench bench;
  bench.add("O10", "M99\n");
  EXPECT_EQ(bench.run("G67\nM30").alarm, "P276");
  EXPECT_EQ(bench.run("G66 P10\nG67\nG67\nM30").alarm, "P276");
  EXPECT_EQ(bench.run("G66 P11\nM30").alarm, "P232");
  EXPECT_EQ(bench.run("G66 A1.\nM30").alarm, "P296");
  EXPECT_EQ(bench.run("G66.1 P11\nM30").alarm, "P232");
}

TEST(ModalMacro, FifthLevelIsTooDeep) {  // P273
  Bench bench;
  bench.add("O1", "G0 Z1.\nZ0\nM99\n");
  EXPECT_EQ(bench.run("G66 P1\nG66 P1\nG66 P1\nG66 P1\nG0 X1.\nG67\nG67\nG67\nG67\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("G66 P1\nG66 P1\nG66 P1\nG66 P1\nG66 P1\nG0 X1.\nM30").alarm, "P273");
}

TEST(ModalMacro, GroupFourteenShowsWhatIsInForce) {  // 13.5.5, #4014
  Bench bench;
  bench.add("O10", "#102=#4014\nM99\n");
  const Outcome run = bench.run("#100=#4014\nG66 P10\n#101=#4014\nG0 X1.\nG67\n#103=#4014\nG66.1 P10\n#104=#4014\nG67\nM30");
  EXPECT_EQ(run.var(100), 67);
  EXPECT_EQ(run.var(101), 66);
  EXPECT_EQ(run.var(102), 67);  // nothing is in force in the macro
  EXPECT_EQ(run.var(103), 67);
  EXPECT_EQ(run.var(104), 66.1);
}

TEST(ModalMacro, EveryBlockIsHandedOver) {  // G66.1
  Bench bench;
  bench.add("O10", "#100=#100+1\n#110=#10\n#113=#13\n#114=#14\n#112=#12\n#116=#16\n#124=#24\n#109=#9\nM99\n");
  const Outcome run = bench.run("#100=0\nG66.1 P10\nN5 G0 G91 X7. M8 L3 P4 F5 N77\n#150=1\nG67 X1.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(run.var(110), 91);
  EXPECT_EQ(run.var(113), 8);
  EXPECT_EQ(run.var(114), 77);
  EXPECT_EQ(run.var(112), 3);
  EXPECT_EQ(run.var(116), 4);
  EXPECT_EQ(run.var(124), 7);
  EXPECT_EQ(run.var(109), 5);
  EXPECT_EQ(run.aux(), "M30");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0"}));  // G0 and G91 are modal all the same
}

TEST(ModalMacro, RewindTakesTheCallBack) {
  Bench bench;
  bench.add("O10", "#100=#100+#1\nM99\n");
  bench.add("O11", "#100=#100+100\nM99\n");
  bench.start("#100=0\nG66 P10 A1.\nG0 X1.\nG67\nG66 P11\nX2.\nM30");
  std::vector<std::pair<uint64_t, nc_axes>> marks;
  const Outcome first = [&] {
    Outcome run;
    Step step;
    while (bench.pull(&step) == NC_OK) {
      run.steps.push_back(step);
      if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) marks.emplace_back(step.item.serial, step.machine);
    }
    return run;
  }();
  ASSERT_EQ(bench.var_now(100), 101);
  ASSERT_EQ(bench.rewind(marks[1].first, marks[1].second), NC_OK);  // behind G66 P10
  EXPECT_EQ(bench.finish().var(100), 101);
}

// ---- registered codes -----------------------------------------------------------------------------------------------------------

TEST(CodeCall, GCodeOfEachType) {  // 13.5.2: G100 to G255
  Bench bench;
  bench.add("O500", "#100=#24\n#101=#4003\nM99\n");
  bench.param("7201", "120").param("7202", "1").param("7203", "500");
  const Outcome run = bench.run("G91 G120 X3.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 3);
  EXPECT_EQ(run.var(101), 91);
  EXPECT_EQ(run.path(), Path{});
  bench.param("7202", "0");  // as M98: the rest of the block is executed first
  EXPECT_EQ(bench.at(0, 0, 0).run("#24=8\nG0 G120 X3.\nM30").path(), (Path{"rapid 3 0 0"}));
  bench.param("7202", "2");
  EXPECT_EQ(bench.at(0, 0, 0).run("#100=0\nG120 X3.\nG0 Y1.\nG67\nM30").var(100), 3);
  bench.param("7202", "3");
  EXPECT_EQ(bench.at(0, 0, 0).run("#100=0\nG120 X3.\nX4.\nG67\nM30").var(100), 4);
  EXPECT_EQ(bench.run("G121\nM30").alarm, "P34");
}

TEST(CodeCall, SystemGCodeNeedsItsParameter) {  // #1081 Gmac_P
  Bench bench;
  bench.add("O9016", "#100=#9\nM99\n");
  bench.param("7201", "16").param("7202", "1").param("7203", "9016");
  EXPECT_TRUE(std::isnan(bench.run("G16 X1. F500\nM30").var(100)));  // the polar command
  bench.param("1081", "1");
  EXPECT_EQ(bench.run("G16 X100. Y100. Z100. F500\nM30").var(100), 500);
}

TEST(CodeCall, ToolChangeMacro) {  // 13.5.2: the code is not output; T is output before with type M98, an argument with type G65
  Bench bench;
  bench.add("O9006", "#100=#20\n#101=#13\n#102=#4120\nM6\nM99\n");
  bench.param("7001", "6").param("7002", "0").param("7003", "9006");
  Outcome run = bench.run("T5 M6\nM30");
  EXPECT_EQ(run.aux(), "T5 M6 M30");  // M6 in the macro is the ordinary one
  EXPECT_EQ(run.var(102), 5);
  bench.param("7002", "1");
  run = bench.run("T5 M6\nM30");
  EXPECT_EQ(run.aux(), "M6 M30");
  EXPECT_EQ(run.var(100), 5);
  EXPECT_EQ(run.var(101), 6);
}

TEST(CodeCall, AsM98HasNoPlaceBesideAnotherWayOn) {  // 13.5.2 (1): M50 is M98 P9020, and two of M98 M99 M02 M30 are P33 (13.3.1)
  Bench bench;
  bench.add("O30", "#100=1\nM99\n");
  bench.add("O31", "#100=2\nM99 M50\n");
  bench.add("O9020", "#101=1\nM99\n");
  bench.param("7001", "50").param("7002", "0").param("7003", "9020").param("7312", "0").param("7313", "9020");
  bench.param("7201", "120").param("7202", "0").param("7203", "9020");
  bench.param("7401", "1").param("7402", "D").param("7403", "0").param("7404", "9020").param("7405", "146");
  for (const char* block : {"M98 P30 M50", "M50 M98 P30", "M98 P30 T5", "G120 M98 P30", "X5. M98 P30 L2 T5", "M198 P30 M50", "M98 P30 M198 P30", "M30 T5", "M50 M02", "M99 M50", "D2000 M98 P30"}) {
    const Outcome run = bench.at(0, 0, 0).run(std::string("#100=0 #101=0 #146=0\n") + block + "\nM30");
    EXPECT_EQ(run.alarm, "P33") << block;
    EXPECT_EQ(run.alarm_line, 2u) << block;
    EXPECT_EQ(run.var(100) + run.var(101) + run.var(146), 0) << block;
  }
  EXPECT_EQ(bench.run("M98 P31\nM30").alarm, "P33") << "M99 would return without the call";
  Outcome run = bench.run("#101=0\nT5 M50\nM30");  // two that would call, and none of them is M98: the second is an ordinary code (13.5.3 (5))
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.aux(), "M50 M30");
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(bench.run("#101=0\nM00 T5\nM30").var(101), 1);
}

TEST(SubProgram, TheOtherCodesOfItsBlockComeFirst) {  // 13.5.2, differences (3): "after all the commands except M, P, H and L"
  for (const nc_dialect family : {NC_DIALECT_M700, NC_DIALECT_HX}) {
    Bench bench(family);
    bench.add("O30", "#100=#100+1\nM99 M00\n");
    const Outcome run = bench.run("#100=0\nM98 P30 M00 L2\nM98 P30 M01 M08\nM30");
    EXPECT_EQ(run.alarm, "");
    EXPECT_EQ(run.aux(), "M0 M0 M0 M8 M0 M30") << family;
    EXPECT_EQ(run.var(100), 3);
    unsigned optional = 0;
    for (const nc_item& item : run.of(NC_ITEM_GATE)) optional += item.u.gate.kind == NC_GATE_OPTIONAL_STOP ? 1 : 0;
    EXPECT_EQ(optional, 1u);
  }
}

TEST(CodeCall, SAndTAndB) {
  Bench bench;
  bench.add("O8", "#100=#19\n#101=#20\n#102=#2\nM99\n");
  bench.param("7302", "1").param("7303", "8");
  EXPECT_EQ(bench.run("S1200\nM30").var(100), 1200);
  bench.param("7312", "1").param("7313", "8");
  EXPECT_EQ(bench.run("T12\nM30").var(101), 12);
  bench.param("7102", "1").param("7103", "8");
  EXPECT_EQ(bench.run("B45\nM30").var(102), 45);
}

TEST(CodeCall, KeptCodesAndSwitchedOff) {
  Bench bench;
  bench.add("O8", "#100=1\nM99\n");
  bench.param("7001", "30").param("7002", "0").param("7003", "8").param("7011", "20").param("7012", "0").param("7013", "8").param("1195", "0");
  const Outcome run = bench.run("M20\nM30");
  EXPECT_EQ(run.aux(), "M20 M30");
  EXPECT_TRUE(run.ended_ok);
}

TEST(CodeCall, NotDuringAFixedCycle) {  // P310
  Bench bench;
  bench.add("O8", "M99\n");
  bench.param("7001", "20").param("7002", "1").param("7003", "8");
  EXPECT_EQ(bench.run("G81 X1. Z-1. R1. F100\nM20\nM30").alarm, "P310");
}

/// The block that commands a cycle is in it, and one that ends it is not: a macro would drill where it moves, or the hole be lost.
TEST(CodeCall, TheBlockSaysWhetherItIsDuringAFixedCycle) {  // P310, 13.5.2
  const auto run = [](const char* as_m98_or_g65, const std::string& blocks) {
    Bench bench;
    bench.add("O8", "X33.\nM99\n");
    bench.param("7001", "20").param("7002", as_m98_or_g65).param("7003", "8");
    return bench.run("G90 G0 Z50.\n" + blocks + "\nG80\nM30");
  };
  for (const char* type : {"0", "1"})
    for (const char* block : {"G81 X1. Z-5. R2. F100 M20", "M20 G81 X1. Z-5. R2. F100", "G81 X1. Z-5. R2. F100\nX2. M20", "G81 M20"}) {
      const Outcome did = run(type, block);
      EXPECT_EQ(did.alarm, "P310") << type << ' ' << block;
      EXPECT_EQ(did.alarm_detail, "A macro cannot be called by M20 during a fixed cycle.");
      for (const std::string& move : did.path()) EXPECT_EQ(move.find("33"), std::string::npos) << move;
    }
  EXPECT_EQ(run("0", "G81 X1. Z-5. R2. F100\nG80 M20").path().back(), "rapid 33 0 50");
  EXPECT_EQ(run("0", "G81 X1. Z-5. R2. F100\nM20 G80").path().back(), "rapid 33 0 50");
  EXPECT_EQ(run("0", "G81 X1. Z-5. R2. F100\nG0 X9. M20").path().back(), "rapid 33 0 50");
  EXPECT_EQ(run("0", "G81 G1 X1. Z-5. F100 M20").path(), (Path{"rapid 0 0 50", "line 1 0 -5 F100", "line 33 0 -5 F100"})) << "the motion counts";
  for (const char* block : {"G80 M20", "G0 M20"})  // in front of a call as G65 the codes of the block do not move, and G80 is no code there (appendix 2)
    EXPECT_EQ(run("1", std::string("G81 X1. Z-5. R2. F100\n") + block).alarm, "P310") << block;
  EXPECT_EQ(run("1", "G81 X1. Z-5. R2. F100\nG80\nM20").path().back(), "rapid 33 0 50");
  EXPECT_EQ(run("1", "G81 X1. Z-5. R2. F100\nG0 G65 P8").path().back(), "rapid 33 0 50") << "a code of group 1 ends the cycle (13.1.1 (4))";
}

TEST(CodeCall, AsciiLetterIsOrdinaryInACycleBehindACallAndWithG10) {  // 13.5.3
  Bench bench;
  bench.add("O8", "#100=#100+1\n#101=#7\nM99\n");
  bench.param("7401", "1").param("7402", "D").param("7403", "1").param("7404", "8");
  bench.param("7001", "50").param("7002", "1").param("7003", "8");
  const Outcome run = bench.run("#100=0\nM50 D200\nM30");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 200);
  EXPECT_EQ(bench.run("D1000000\nM30").alarm, "P35");
}

TEST(CodeCall, AsciiLetterIsOrdinaryInTheBlockOfACyclesCode) {  // 13.5.3 (5) (e)
  for (const char* const letter : {"R", "Q"}) {
    Bench bench;
    bench.add("O200", "#101=1\nM99\n");
    bench.param("7401", "1").param("7402", letter).param("7403", "0").param("7404", "200").param("7405", "146");
    const Outcome run = bench.run("#101=0\nG90 G0 Z10.\nG83 X5. Z-6. R2. Q3. F100\nX7. R3.\nG80\nM30");
    EXPECT_EQ(run.alarm, "") << letter;
    EXPECT_EQ(run.var(101), 0) << letter;
    EXPECT_EQ(bench.run(std::string("G80 ") + letter + "5.\nM30").var(101), 1) << letter;  // no cycle
  }
}

// ---- names ----------------------------------------------------------------------------------------------------------------------

TEST(VariableNames, Rules) {  // 13.5.5: 7 characters, a letter first, no reserved word, no name twice
  EXPECT_EQ(m700("SETVN500[A234567,DIST]\n[#DIST]=25\n#100=[#DIST]+[#dist]*2\nM30").var(100), 75);
  EXPECT_EQ(m700("SETVN500[ABCDEFGH]\nM30").alarm, "P292");
  EXPECT_EQ(m700("SETVN500[]\nM30").alarm, "P292");
  EXPECT_EQ(m700("SETVN500[1A]\nM30").alarm, "P300");
  EXPECT_EQ(m700("SETVN500[SINUS]\nM30").alarm, "P300");
  EXPECT_EQ(m700("SETVN500[AB,AB]\nM30").alarm, "P301");
  EXPECT_EQ(m700("SETVN500[AB]\nSETVN500[AB]\nM30").alarm, "");
  EXPECT_EQ(m700("SETVN520[AB]\nM30").alarm, "P241");
  EXPECT_EQ(m700("SETVN519[AB,CD]\nM30").alarm, "P241");
  EXPECT_EQ(m700("#100=[#NOBODY]\nM30").alarm, "P300");
  EXPECT_EQ(m700("SETVN 500 AB\nM30").alarm, "P292");
}

TEST(VariableNames, InWordsAndRenamed) {
  const Outcome run = m700("SETVN500[OLD]\nSETVN500[NEW]\n[#NEW]=3\nG0 X[#NEW]\nX[#OLD]\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 3 0 0"}));
  EXPECT_EQ(run.alarm, "P300");
  EXPECT_EQ(run.alarm_line, 5u);
}

// ---- external output --------------------------------------------------------------------------------------------------------------

TEST(ExternalOutput, OpenPrintClose) {  // 13.5.8
  Bench bench;
  const Outcome run = bench.run("#100=12.3456\n#101=-0.5\nPOPEN\nDPRNT[X#100[53]Y#101[33]*T-1]\nDPRNT[N#[100+2][40]]\nPCLOS\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(printed(run), (std::vector<std::string>{"\x12%", "X12.346Y-0.500*T-1", "N0", "%\x14"}));
}

TEST(ExternalOutput, BlanksByParameter) {  // leading zeros "can also be replaced by blank"
  Bench bench;
  bench.param("DPRNT_BLANK", "1");
  EXPECT_EQ(printed(bench.run("#100=2.5\n#101=-2.5\nPOPEN\nDPRNT[#100[32]#101[32]]\nM30"))[1], "   2.50-  2.50");
}

TEST(ExternalOutput, ComesWhenTheMachineGetsThere) {
  const Outcome run = m700("POPEN\nG0 X1.\nDPRNT[A]\nX2.\nM30");
  std::vector<std::string> order;
  for (const Step& step : run.steps) {
    if (step.item.kind == NC_ITEM_MOVE) order.push_back("move");
    if (!step.text.empty()) order.push_back(step.text);
  }
  EXPECT_EQ(order, (std::vector<std::string>{"\x12%", "move", "A", "move"}));
}

TEST(ExternalOutput, Alarms) {
  EXPECT_EQ(m700("DPRNT[A]\nM30").alarm, "P460");
  EXPECT_EQ(m700("POPEN\nPCLOS\nDPRNT[A]\nM30").alarm, "P460");
  EXPECT_EQ(m700("POPEN\nDPRNT[#100]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\nDPRNT[#100[54]]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\nDPRNT[#5[5]]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\nDPRNT[A=B]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\nDPRNT[A\nM30").alarm, "P281");
}

TEST(ExternalOutput, Binary) {  // characters, then the value times 10^c as four bytes, highest first
  Bench bench;
  bench.start("POPEN\n#1=-1.5 #2=123.456\nBPRNT[C*X#1[3]Y#2[0]]\nBPRNT[#99[0]]\nM30");
  std::vector<std::string> lines;
  Step step;
  for (nc_status status; (status = bench.pull(&step)) == NC_OK || status == NC_BUDGET;) {
    if (status != NC_OK || step.item.kind != NC_ITEM_ACTION || step.item.u.action.kind != NC_ACTION_MESSAGE) continue;
    nc_text text;
    ASSERT_EQ(nc_text_get(bench.control(), 0, step.item.u.action.text, &text), NC_OK);
    if (text.size != 0) lines.push_back(std::string(text.s, text.size));
  }
  ASSERT_EQ(lines.size(), 1u);  // #99 does not exist
  EXPECT_EQ(lines[0], std::string("C*X\xff\xff\xfa\x24Y\0\0\0\x7b", 12));
  EXPECT_EQ(m700("BPRNT[A]\nM30").alarm, "P460");
  EXPECT_EQ(m700("POPEN\nBPRNT[#1]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\nBPRNT[#1[12]]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\nBPRNT[]\nM30").alarm, "P33");
  EXPECT_EQ(m700("POPEN\n#1=99999\nBPRNT[#1[5]]\nM30").alarm, "P35");
}

// ---- IF THEN ------------------------------------------------------------------------------------------------------------------

TEST(IfThen, IsAnOptionOfLaterModels) {
  EXPECT_EQ(m700("IF [1 EQ 1] THEN #100=1\nM30").alarm, "P290");
  Bench bench;
  bench.param("macro_extensions", "1");
  const Outcome run = bench.run("IF [1 EQ 1] THEN #100=1\nIF [1 EQ 2] THEN #101=1 #102=2\nIF [1 LT 2] THEN GOTO 9\n#103=1\nN9 M30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_TRUE(std::isnan(run.var(101)));
  EXPECT_TRUE(std::isnan(run.var(102)));
  EXPECT_TRUE(std::isnan(run.var(103)));
}

}  // namespace
}  // namespace nc::test
