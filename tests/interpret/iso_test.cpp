// SPDX-License-Identifier: Apache-2.0
// The iso family: where RS-274/NGC and LinuxCNC differ from the families with a manual, one test for each rule.
#include <gtest/gtest.h>

#include <cmath>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome iso(const std::string& text) { return Bench(NC_DIALECT_ISO).run(text); }
std::string alarm_of(const std::string& text) { return iso(text).alarm; }
/// The value of an expression, found from the place to which an axis goes.
double value_of(const std::string& expression) {
  const Outcome run = iso("G0 X" + expression);
  EXPECT_EQ(run.alarm, "") << expression;
  return run.moves().empty() ? 0 : run.moves().back().machine.v[0];
}

TEST(Iso, TextsAreWrittenInManyWays) {  // RS-274/NGC 3.3: case, blanks, comments, '%', N, '/'
  EXPECT_EQ(iso("%\ng0 x 1 0 . 5 y-2 ; to the left of ( it\n(a comment) N0 G1 (another) z3 f100\n%\nG0 X99\n").path(),
            (Path{"rapid 10.5 -2 0", "line 10.5 -2 3 F100"}));
  EXPECT_EQ(iso("G0 X1\n/G0 X2\nM2\nG0 X9").path(), (Path{"rapid 1 0 0", "rapid 2 0 0"}));
  EXPECT_EQ(iso("g0x1y2\nz3").path(), (Path{"rapid 1 2 0", "rapid 1 2 3"}));
}

TEST(Iso, ANumberWithoutAPointIsWhole) {  // RS-274/NGC 3.3.2.1
  EXPECT_EQ(iso("G20 G1 X1 F10").path(), (Path{"line 25.4 0 0 F254"}));
  EXPECT_EQ(iso("G4 P0.5\nG4 P2").dwells(), (std::vector<double>{0.5, 2}));
}

TEST(Iso, TheToolIsCalledAndChangedInEitherOrder) {  // RS-274/NGC 3.6.3
  EXPECT_EQ(iso("M6 T1\nT2 M6\nT3\nM6").aux(), "T1 M6 T2 M6 T3 M6");
}

TEST(Iso, AWordAndACodeOfAGroupStandOnce) {  // RS-274/NGC 3.3.1, 3.4
  for (const char* text : {"G0 X1 X2", "G1 X1. X2. F100", "G0 X1 Y[1] Y2", "F1 F2", "G0 G1 X1 F100", "G90 G91", "G54 G55", "G17 G18"})
    EXPECT_EQ(alarm_of(text), "NC-FORMAT") << text;
  EXPECT_EQ(alarm_of("F100 G1\nX1.\nX2. Y1. X3."), "NC-FORMAT");
  EXPECT_EQ(alarm_of("G17 G21 G90 G94 G54 G40 G49 G80 G0 X1"), "");
  EXPECT_EQ(alarm_of("G2 X0 Y0 R5 F100"), "NC-ARC");  // 3.5.3.1: which circle?
}

TEST(Iso, OWordsSayThatTheyAreNotThere) {
  for (const char* text : {"G0 X1\nO100 sub\nG0 X2\nO100 endsub", "G0 X1\no<hole> if [1]", "G0 X1\nN10 O5 call"}) {
    const Outcome run = iso(text);
    EXPECT_EQ(run.alarm, "NC-O-WORD") << text;
    EXPECT_EQ(run.alarm_line, 2u) << text;
    EXPECT_NE(run.alarm_detail.find("sub programs"), std::string::npos) << run.alarm_detail;
    EXPECT_EQ(run.path(), (Path{"rapid 1 0 0"})) << text;
  }
  // Statements of other families are not allowed in this one.
  for (const char* text : {"IF [1 EQ 1] GOTO 5", "WHILE [1] DO1", "GOTO 5", "POPEN"}) EXPECT_NE(alarm_of(text), "") << text;
}

// ---- expressions and parameters -------------------------------------------------------------------------------------------------

TEST(IsoExpression, BindsInFiveSteps) {  // LinuxCNC "Binary Operators"
  EXPECT_EQ(value_of("[2+3*4]"), 14);
  EXPECT_EQ(value_of("[2*3**2]"), 18);
  EXPECT_EQ(value_of("[2**3**2]"), 64);  // the left one first
  EXPECT_EQ(value_of("[-2**2]"), 4);     // the sign is that of the number
  EXPECT_EQ(value_of("[1+1 EQ 2]"), 1);
  EXPECT_EQ(value_of("[1 EQ 1 AND 2 GT 3]"), 0);
  EXPECT_EQ(value_of("[1 LT 2 OR 0]"), 1);
  EXPECT_EQ(value_of("[5 XOR 7]"), 0);  // both true
  EXPECT_EQ(value_of("[6 AND 1]"), 1);  // no bits
  EXPECT_EQ(value_of("[10-4-3]"), 3);
  EXPECT_EQ(value_of("[12/3/2]"), 2);
}

TEST(IsoExpression, Functions) {  // RS-274/NGC 3.3.2.4
  EXPECT_EQ(value_of("ATAN[1]/[-1]"), 135);
  EXPECT_EQ(value_of("ATAN[-1]/[-1]"), -135);
  EXPECT_EQ(value_of("FIX[-2.8]"), -3);
  EXPECT_EQ(value_of("FIX[2.8]"), 2);
  EXPECT_EQ(value_of("FUP[-2.8]"), -2);
  EXPECT_EQ(value_of("FUP[2.8]"), 3);
  EXPECT_EQ(value_of("ROUND[2.5]"), 3);
  EXPECT_EQ(value_of("[-7 MOD 3]"), 2);
  EXPECT_EQ(value_of("[7 MOD 3]"), 1);
  EXPECT_EQ(value_of("SQRT[16]"), 4);
  EXPECT_EQ(value_of("ABS[-3]"), 3);
  EXPECT_EQ(value_of("-ABS[-3]"), -3);
  EXPECT_EQ(value_of("SIN[30]"), 0.5);
  EXPECT_NEAR(value_of("EXP[LN[5]]"), 5, 1e-9);
  EXPECT_EQ(value_of("ACOS[0]"), 90);
  EXPECT_EQ(value_of("[[[[[[[[1]]]]]]]]"), 1);
}

TEST(IsoExpression, WhatIsNoneIsAnAlarm) {
  for (const char* text : {"G0 X[1/0]", "G0 X[-2**0.5]", "G0 XSQRT[-1]", "G0 XATAN[1]", "G0 X[1+]", "G0 X[1", "G0 XLN[0]", "G0 X[1 MOD 0]"})
    EXPECT_EQ(alarm_of(text), "NC-FORMULA") << text;
  for (const char* text : {"G0 X1+2", "#1=2+3", "G0 X1]"}) EXPECT_NE(alarm_of(text), "") << text;  // formulas stand in [ ]
}

TEST(IsoParameter, WithoutAValueItIsZero) {  // RS-274/NGC 3.2.1
  EXPECT_EQ(iso("G0 X5 Y5\nG0 X#100").path(), (Path{"rapid 5 5 0", "rapid 0 5 0"}));
  EXPECT_EQ(value_of("[#100 EQ 0]"), 1);
}

TEST(IsoParameter, AllOfABlockAreSetAtOnce) {  // RS-274/NGC 3.3.2.2
  const Outcome run = iso("#100=1 #101=2\n#100=#101 #101=#100\n#3 = [1+2] #[#3+99]=7\n#4=102\n##4=8");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(run.var(102), 8);
  EXPECT_EQ(run.var(99), 7);  // #3 had no value yet
  EXPECT_EQ(alarm_of("#0=1"), "NC-PARAMETER");
  EXPECT_EQ(alarm_of("#6000=1"), "NC-PARAMETER");
  EXPECT_EQ(alarm_of("#[134217728]=1"), "NC-PARAMETER");
  EXPECT_EQ(alarm_of("G0 X#[134217728]"), "NC-PARAMETER");
  EXPECT_EQ(alarm_of("#1=5 G0 X1"), "NC-PARAMETER");  // not built, and said
}

TEST(IsoParameter, Names) {  // LinuxCNC "Named Parameters"
  EXPECT_EQ(iso("#<feed height> = 2\n#<FeedHeight>=[#<feedheight> + 1]\nG0 Z#< FEED HEIGHT >").path(), (Path{"rapid 0 0 3"}));
  EXPECT_EQ(value_of("[EXISTS[#<a>]]"), 0);
  EXPECT_EQ(iso("#<a>=0\nG0 X[EXISTS[#<a>]]").path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(iso("#<a>=3 #<b>=4\nG0 XSQRT[#<a>**2+#<b>**2]").path(), (Path{"rapid 5 0 0"}));
  const Outcome none = iso("#<a>=1\nG0 X#<b>");
  EXPECT_EQ(none.alarm, "NC-PARAMETER");
  EXPECT_EQ(none.alarm_line, 2u);
  for (const char* text : {"#<>=1", "#<a=1", "G0 X#<a"}) EXPECT_EQ(alarm_of(text), "NC-PARAMETER") << text;
}

TEST(IsoParameter, NamesOfAProgramEndWithItAndGlobalOnesDoNot) {  // LinuxCNC: '_' begins a global name
  Bench bench(NC_DIALECT_ISO);
  EXPECT_EQ(bench.run("#<mine>=1\n#<_all>=2\nM2").alarm, "");
  EXPECT_EQ(bench.run("G0 X#<_all>\nM2").path(), (Path{"rapid 2 0 0"}));
  EXPECT_EQ(bench.run("G0 X#<mine>\nM2").alarm, "NC-PARAMETER");
}

TEST(IsoParameter, ValuesOfNamesAreOfTheStateThatAProgramGoesBy) {
  const auto hash_behind = [](const char* text) {
    Bench bench(NC_DIALECT_ISO);
    EXPECT_EQ(bench.run(text).alarm, "");
    uint64_t hash = 0;
    EXPECT_EQ(nc_program_state_hash(bench.control(), 0, &hash), NC_OK);
    return hash;
  };
  EXPECT_EQ(hash_behind("#<a>=1\nM2"), hash_behind("#<a>=1\nM2"));
  EXPECT_NE(hash_behind("#<a>=1\nM2"), hash_behind("#<a>=2\nM2"));
}

TEST(IsoParameter, ThereIsRoomForSoManyNames) {
  std::string text;
  for (unsigned i = 0; i < 128; ++i) text += "#<p" + std::to_string(i) + ">=" + std::to_string(i) + "\n";
  EXPECT_EQ(iso(text + "G0 X#<p127>").path(), (Path{"rapid 127 0 0"}));
  const Outcome more = iso(text + "#<one more>=1");
  EXPECT_EQ(more.alarm, "NC-PARAMETER");
  EXPECT_EQ(more.alarm_line, 129u);
}

TEST(IsoParameter, ARewindTakesNamedValuesBack) {
  Bench bench(NC_DIALECT_ISO);
  bench.start("#<a>=1\nG0 X#<a>\n#<a>=5\nG0 X#<a>\nM2");
  uint64_t behind_first = 0;
  nc_axes at{};
  Step step;
  unsigned moves = 0;
  while (bench.pull(&step) == NC_OK) {
    if (step.item.kind == NC_ITEM_MOVE) ++moves;
    if (step.item.kind == NC_ITEM_MARK && moves == 1 && behind_first == 0) behind_first = step.item.serial, at = step.machine;
  }
  ASSERT_EQ(moves, 2u);
  ASSERT_NE(behind_first, 0u);
  ASSERT_EQ(bench.rewind(behind_first, at), NC_OK);
  const Outcome again = bench.finish();
  EXPECT_EQ(again.alarm, "");
  EXPECT_EQ(again.path(), (Path{"rapid 5 0 0"}));
}

// ---- motion -----------------------------------------------------------------------------------------------------------------------

TEST(IsoArc, PCountsTheTurnInWhichTheEndLies) {  // LinuxCNC G2
  EXPECT_NEAR(iso("G2 X10 Y0 I5 P1 F100").moves().at(0).sweep_deg, -180, 1e-9);
  EXPECT_NEAR(iso("G2 X10 Y0 I5 P2 F100").moves().at(0).sweep_deg, -540, 1e-9);
  EXPECT_NEAR(iso("G3 X0 Y0 I5 P2 F100").moves().at(0).sweep_deg, 720, 1e-9);
  EXPECT_NEAR(iso("G2 X10 Y0 R5 P2 F100").moves().at(0).sweep_deg, -540, 1e-9);
  EXPECT_EQ(alarm_of("G2 X10 Y0 I5 P0 F100"), "NC-RANGE");
}

TEST(IsoArc, CentresCountFromTheStartOrFromTheZero) {  // LinuxCNC G90.1, G91.1
  const Path same = {"rapid 10 10 0", "ccw 20 20 0 c10,20 F100"};
  EXPECT_EQ(iso("G0 X10 Y10\nG3 X20 Y20 I0 J10 F100").path(), same);
  EXPECT_EQ(iso("G90.1\nG0 X10 Y10\nG3 X20 Y20 I10 J20 F100").path(), same);
  EXPECT_EQ(iso("G90.1\nG91.1 G0 X10 Y10\nG3 X20 Y20 J10 F100").path(), same);
  EXPECT_EQ(alarm_of("G90.1\nG0 X10 Y10\nG3 X20 Y20 I10 F100"), "NC-WORDS");  // both I and J must be given
}

TEST(IsoArc, ToleranceGrowsWithTheRadius) {  // LinuxCNC G2: 0.005 mm, a thousandth of the radius, never more than 0.5 mm
  EXPECT_EQ(alarm_of("G2 X2.004 Y0 I1 F100"), "");
  EXPECT_EQ(alarm_of("G2 X2.006 Y0 I1 F100"), "NC-ARC");
  EXPECT_EQ(alarm_of("G2 X200.09 Y0 I100 F100"), "");
  EXPECT_EQ(alarm_of("G2 X200.11 Y0 I100 F100"), "NC-ARC");
  EXPECT_EQ(alarm_of("G2 X4000.6 Y0 I2000 F100"), "NC-ARC");
}

TEST(IsoFeed, InverseTimeIsThatOfTheWholeBlock) {  // RS-274/NGC 3.5.19
  EXPECT_NEAR(iso("G93\nG1 X30 Y40 F2").moves().at(0).feed_mm_min, 100, 1e-9);
  EXPECT_NEAR(iso("G93\nG2 X20 Y0 I10 F2").moves().at(0).feed_mm_min, 2 * M_PI * 10, 1e-6);
  EXPECT_EQ(alarm_of("G93\nG1 X30 F2\nX40"), "NC-FEED");
  EXPECT_EQ(alarm_of("G93\nG81 X1 Z-1 R1 F2"), "NC-FEED-MODE");
  EXPECT_EQ(alarm_of("G1 X5"), "NC-FEED");
}

TEST(IsoThread, KIsTheLeadAndFStaysTheFeed) {  // LinuxCNC G33
  const Outcome run = iso("S100 M3\nG33 Z-10 K1.5 F200\nG1 X10");
  EXPECT_EQ(run.alarm, "");
  ASSERT_EQ(run.moves().size(), 2u);
  EXPECT_EQ(run.moves()[0].kind, NC_MOVE_THREAD);
  EXPECT_DOUBLE_EQ(run.moves()[0].feed_mm_rev, 1.5);
  EXPECT_DOUBLE_EQ(run.moves()[1].feed_mm_min, 200);
  EXPECT_EQ(iso("S100 M3 F200\nG33 Z-10").alarm_detail, "The block needs the word K.");
}

TEST(IsoThread, KIsTheWayAlongThePath) {     // LinuxCNC G33: "K - distance per revolution", along the line to X Y Z
  const auto lead = [](const char* block) {  // along the axis that goes furthest, as the items have it
    const Outcome run = iso(std::string("S600 M3\n") + block);
    EXPECT_EQ(run.alarm, "") << block;
    return run.moves().empty() ? 0 : run.moves().back().feed_mm_rev;
  };
  EXPECT_DOUBLE_EQ(lead("G33 X30 Z-30 K1.5"), 1.5 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(lead("G33 X3 Y4 Z-12 K2.6"), 2.4);
  EXPECT_DOUBLE_EQ(lead("G33 Z-30 K1.5"), 1.5);
}

TEST(IsoMachine, MovesByTheMotionInForce) {  // RS-274/NGC 3.5.12
  Bench bench(NC_DIALECT_ISO);
  bench.work_offset(1, {5, 6, 7});
  EXPECT_EQ(bench.run("G53 G0 X1\nF300 G53 G1 Z2\nG0 Z0").path(), (Path{"rapid 1 0 0", "line 1 0 2 F300", "rapid 1 0 7"}));
  EXPECT_EQ(alarm_of("G91\nG53 G0 X1"), "NC-INCREMENTAL");
  // It is not a word of the arc that is not possible beside it, but the arc.
  for (const char* arc : {"F100\nG2 X2 I1\nG53 X0", "G53 G2 X1 I1 F10", "G53 G3 X1 R1 F10", "G53 G2 X1 I1 P2 F10"}) {
    const Outcome run = Bench(NC_DIALECT_ISO).run(std::string(arc) + "\nM2");
    EXPECT_EQ(run.alarm, "NC-MODE") << arc;
    EXPECT_EQ(run.alarm_detail, "G53 goes to machine coordinates by G00 or G01, in no other motion. Program one of them beside it.") << arc;
  }
}

// Functions that use the axis words of the block leave none for a hole.
TEST(IsoCycle, StandsBesideNoOtherFunctionThatUsesAxes) {  // LinuxCNC: "cannot use two G codes that both use axis values"
  for (const char* block : {"G53 G81 X1 Z-1 R1 F100", "G81 G28 X1 Z-1 R1 F100", "G81 G92 X1 Z-1 R1 F100"}) {
    const Outcome run = iso(block);
    EXPECT_EQ(run.alarm, "NC-ADDRESS") << block;
    EXPECT_EQ(run.alarm_detail, "The word G81 is not possible in this block.") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
  EXPECT_EQ(alarm_of("G80 G53 G0 X1"), "");
}

TEST(IsoCycle, EndsBesideEachFunction) {
  EXPECT_EQ(iso("G92 X5\nG80 G92.1\nG0 X10").path(), (Path{"rapid 10 0 0"}));
  EXPECT_EQ(alarm_of("G92.1 G81 X1 Z-1 R1 F100"), "NC-ADDRESS");
}

TEST(IsoCycle, HasAtLeastOneHoleAndABottomBelowR) {  // RS-274/NGC 3.5.16
  EXPECT_EQ(alarm_of("G81 X1 Y1 Z-1 R2 F100 L0"), "NC-RANGE");
  EXPECT_EQ(alarm_of("G81 X1 Y1 Z-1 R2 F100 L1"), "");
  EXPECT_EQ(iso("G81 X1 Z2 R1 F100").alarm_detail, "R must be above the bottom.");
}

TEST(IsoText, ACommentHasAnEnd) {  // RS-274/NGC 3.3.4
  for (const char* text : {"G0 (unclosed X1", "(unclosed", "G0 X1 (a) (b", "#1=5 (unclosed", "N1 (unclosed\nG0 X1"}) {
    const Outcome run = iso(text);
    EXPECT_EQ(run.alarm, "NC-FORMAT") << text;
    EXPECT_EQ(run.alarm_detail, "A comment that begins with '(' has no ')' in its line.") << text;
  }
  for (const char* text : {"G0 X1 ; (", "G0 (a) X1 (b)", "(a; b)", "; ( ) ("}) EXPECT_EQ(alarm_of(text), "") << text;
  const std::string blanks(3000, ' ');  // longer than the window
  EXPECT_EQ(alarm_of("G0 X1 (" + blanks + ")"), "");
  EXPECT_EQ(alarm_of("G0 X1 (" + blanks), "NC-FORMAT");
  EXPECT_EQ(alarm_of("G0 X1 (" + blanks + "\nX2"), "NC-FORMAT");
}

TEST(IsoReference, WithoutWordsAllAxesGo) {  // RS-274/NGC 3.5.8
  EXPECT_EQ(iso("G0 X1 Y2 Z3\nG28").path().back(), "rapid 0 0 0");
  EXPECT_EQ(iso("G0 X1 Y2 Z3\nG91 G28 Z2").path(), (Path{"rapid 1 2 3", "rapid 1 2 5", "rapid 1 2 0"}));
}

TEST(IsoLength, ShiftsTheReadingAndMovesNothing) {  // RS-274/NGC 3.5.11
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 10).tool(2, 20);
  EXPECT_EQ(bench.run("G43 H1\nG0 X1\nG0 Z5\nG49\nG91 Z1\nG90 Z2").path(),
            (Path{"rapid 1 0 0", "rapid 1 0 15", "rapid 1 0 16", "rapid 1 0 2"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H2\nG91 G0 Z1").path(), (Path{"rapid 0 0 1"}));
  // Without H the number of the tool counts.
  EXPECT_EQ(bench.at(0, 0, 0).run("T2 M6\nG43\nG0 Z1\nG43 H1\nG0 Z1\nG43 H0\nG0 Z1").path(),
            (Path{"rapid 0 0 21", "rapid 0 0 11", "rapid 0 0 21"}))
      << "LinuxCNC: H0 is the tool in the spindle, too";
  EXPECT_EQ(bench.at(0, 0, 0).run("T2 M6\nT1\nG43 H0\nG0 Z1\nG43 H[1-1]\nZ2\nT0 M6\nG43 H0\nZ3").path(), (Path{"rapid 0 0 21", "rapid 0 0 22", "rapid 0 0 3"}));
  EXPECT_EQ(Bench(NC_DIALECT_ISO).run("G43 H0").alarm_detail, "Which tool is in the spindle is not known. Program M06 or M61, or the number of the offset.");
  // G53 moves without the length, which stays in force.
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H1\nG53 G0 Z3\nG91 G0 Z1\nG90 Z0").path(), (Path{"rapid 0 0 3", "rapid 0 0 4", "rapid 0 0 10"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H999").alarm, "NC-OFFSET-DATA");
}

TEST(IsoLength, ByTheWordsOfTheBlock) {  // LinuxCNC G43.1
  EXPECT_EQ(iso("G43.1 Z7\nG0 X1\nZ0\nG91 Z1\nG90 G49\nZ0").path(), (Path{"rapid 1 0 0", "rapid 1 0 7", "rapid 1 0 8", "rapid 1 0 0"}));
  EXPECT_EQ(alarm_of("G43.1 X7"), "NC-AXIS");
  EXPECT_EQ(alarm_of("G43.1"), "NC-WORDS");
  EXPECT_EQ(Bench(NC_DIALECT_ISO).tool(1, 10).run("G0 G43 Z5 H1").path(), (Path{"rapid 0 0 15"}));  // as most posts write it
}

// LinuxCNC #5061, #5420: in the coordinates that are read, in which the tool's end is.
TEST(IsoLength, CountsInTheVariablesOfPositions) {
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 10, NC_TOOL_LENGTH);
  bench.skip_at = [](const nc_item&) { return 0.5; };
  const Outcome run = bench.run("G43 H1\nG0 Z20\nG38.2 Z-60 F100\n#100=#5063 #101=#5422\nG10 L20 P1 Z0\n#102=#5422\nM2");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_NEAR(run.var(100), -20, 1e-9);
  EXPECT_NEAR(run.var(101), -20, 1e-9);
  EXPECT_NEAR(run.var(102), 0, 1e-9);
}

TEST(IsoPosition, IsReadAsCalculated) {  // RS-274/NGC 3.3: numbers are not counted in a unit
  EXPECT_EQ(iso("G0 X0.33334\nY[#5420*3]").path().back(), "rapid 0.33334 1.00002 0");
  EXPECT_NEAR(iso("G20 G0 X1.23456789\n#100=#5420\nM2").var(100), 1.23456789, 1e-12);
  Bench bench(NC_DIALECT_ISO);
  bench.skip_at = [](const nc_item&) { return 0.5; };
  EXPECT_NEAR(bench.run("G21 F100\nG38.2 X30\nG20\n#100=#5061\nM2").var(100), 15 / 25.4, 1e-12);
}

TEST(IsoPosition, SaysWhetherTheProbeTouched) {  // LinuxCNC #5070
  for (const char* code : {"G38.2", "G38.3", "G38.4", "G38.5"}) {
    Bench bench(NC_DIALECT_ISO);
    EXPECT_EQ(bench.run("#100=#5070\nM2").var(100), 0) << code;
    bench.skip_at = [](const nc_item&) { return 0.5; };
    EXPECT_EQ(bench.run(std::string("F100\n") + code + " X10\n#100=#5070\nM2").var(100), 1) << code;
    bench.skip_at = {};
    const bool may_miss = code[4] == '3' || code[4] == '5';
    if (may_miss) {
      EXPECT_EQ(bench.run(std::string("F100\n") + code + " X50\n#100=#5070\nM2").var(100), 0) << code;
    }
  }
}

TEST(IsoPosition, IsNotReadInRadiusCompensation) {  // LinuxCNC: "Cannot read current position with cutter radius compensation on"
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  const Outcome run = bench.run("F100\nG41 D1 G1 X10\nX20\n#100=#5420\nY10\nM2");
  EXPECT_EQ(run.alarm, "NC-OFFSET-CODE");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_EQ(run.alarm_detail, "Variable #5420 cannot be read while tool radius compensation is on. Cancel it with G40 first.");
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D1 G1 X10\nX20\nG40 X30\n#100=#5420\nM2").var(100), 30);
}

TEST(IsoExpression, AnIndexIsAWholeNumber) {  // RS-274/NGC 3.3.2.1: within 0.0001
  for (const char* text : {"#[1.5]=7", "#[1.0002]=7", "#1=#[34.5]", "#1=#[33.9998]", "#34=2.5\n#1=##34", "#34=2.5 #35=1\n##34=1"}) EXPECT_EQ(alarm_of(text), "NC-PARAMETER") << text;
  EXPECT_EQ(iso("#[34.00005]=7\n#100=#[33.99995]\nM2").var(100), 7);
}

// LinuxCNC: "Cannot use axis values with g80", "... without a g code that uses them". G80 is one of the motions.
TEST(IsoCycle, BehindItsEndAxisWordsNeedAMotion) {
  for (const char* text : {"G80 X1", "F100 G81 X1 Z-1 R2\nG80\nX5", "G1 F100 X1\nG80\nG91\nX4", "G1 F100 X1\nG80\nG53 X5", "G1 F100 X1\nG80\nG28\nX3", "G38.3 F100 X1\nG80\nX3"}) {
    const Outcome run = iso(text);
    EXPECT_EQ(run.alarm, "NC-ADDRESS") << text;
    EXPECT_NE(run.alarm_detail.find("X"), std::string::npos) << run.alarm_detail;
  }
  EXPECT_EQ(iso("F100 G0 X1\nG80 G1 X2\nX3").path(), (Path{"rapid 1 0 0", "line 2 0 0 F100", "line 3 0 0 F100"}));
  EXPECT_EQ(iso("G1 F100 X1\nG80\nG92 X2\nG10 L2 P2 X1\nG28 X2\nG0 X4\nX5").alarm, "");
  EXPECT_EQ(iso("G80\nG81 X1 Z-1 R2 F100\nX5").alarm, "");
  Bench bench(NC_DIALECT_ISO);
  EXPECT_EQ(bench.run("G80\nM2").alarm, "");
  EXPECT_EQ(bench.run("X1\nM2").path(), (Path{"rapid 1 0 0"})) << "a program begins with G0";
}

TEST(IsoLength, MayBeginBesideAnArc) {  // LinuxCNC, order of execution: the length acts before the motion
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 10, NC_TOOL_LENGTH);
  EXPECT_EQ(bench.run("G21 F100\nG0 X0 Y0\nG43 H1 G2 X10 Y0 R6\nM2").alarm, "");
}

TEST(IsoArc, ATolerancesPIsNoNumberOfTurns) {  // G64 P behind an arc
  EXPECT_EQ(alarm_of("G21 G17 F100\nG3 X10 Y0 I5\nG64 P0.02\nG1 X20"), "");
  EXPECT_EQ(alarm_of("G21 G17 F100\nG3 X10 Y0 I5\nX20 Y0 I5 P0.5"), "NC-FORMAT");
}

TEST(IsoRadius, WithoutDThatOfTheTool) {  // RS-274/NGC 3.5.10
  Bench bench(NC_DIALECT_ISO);
  bench.tool(3, 2, NC_TOOL_RADIUS);
  const Path offset = {"line 10 2 0 F100", "line 30 2 0 F100"};
  EXPECT_EQ(bench.run("F100\nT3 M6\nG41\nG1 X10\nX30\nM2").path(), offset);
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D3\nG1 X10\nX30\nM2").path(), offset);
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nT3 M6\nT1\nG41 D0\nG1 X10\nX30\nM2").path(), offset) << "LinuxCNC: D0 is the tool in the spindle, too";
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D3\nG1 X10\nG42 X20").alarm, "NC-OFFSET-CODE");
  // G40 alone waits for a move, too.
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D3 G1 X10\nX30\nG40\nG1 X40 Y5\nM2").path(), (Path{"line 10 2 0 F100", "line 30 2 0 F100", "line 40 5 0 F100"}));
}

// G40 is at once, whatever the vector waits for: LinuxCNC's comp.ngc has G18 right behind it. The vector goes with the next move in the plane of before.
TEST(IsoRadius, BehindItsEndThePlaneIsFree) {
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  EXPECT_EQ(bench.run("F100\nG41 D1 G1 X10\nX30\nG40\nG18\nG0 Z5\nX40 Y1\nM2").path(), (Path{"line 10 2 0 F100", "line 30 2 0 F100", "rapid 30 2 5", "rapid 40 1 5"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D1\nG40\nG18\nG2 X4 I2\nM2").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D1 G1 X10\nX30\nG40\nG18 G41 D1\nG1 X40\nX50\nM2").path().back(), "line 50 0 -2 F100");
  for (const char* safe : {"G40 G54", "G54 G40 G17 G49 G80 G90"})  // RS-274/NGC 3.8: compensation is set before the coordinate system
    EXPECT_EQ(bench.at(0, 0, 0).run(std::string("F100\nG41 D1 G1 X10\nX30\n") + safe + "\nG0 X40 Y0\nM2").path().back(), "rapid 40 0 0") << safe;
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D1 G1 X10\nG40 G18\nM2").alarm, "NC-OFFSET-CODE") << "the plane is set before both";
  const Outcome on = bench.at(0, 0, 0).run("F100\nG41 D1 G1 X10\nG18\nM2");
  EXPECT_EQ(on.alarm, "NC-OFFSET-CODE");
  EXPECT_EQ(on.alarm_detail, "The plane cannot be changed while tool radius compensation is on. Cancel it with G40 first.");
}

TEST(IsoRadius, AMoveAcrossThePlaneIsNoStart) {  // docs/families.md: the code waits, and the line leads beside its end
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  EXPECT_EQ(bench.run("F100\nG41 D1\nG0 Z-1\nG1 X10\nX30\nM2").path(), (Path{"rapid 0 0 -1", "line 10 2 -1 F100", "line 30 2 -1 F100"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG41 D1 G0 Z-1\nG1 X10\nX30\nM2").path(), (Path{"rapid 0 0 -1", "line 10 2 -1 F100", "line 30 2 -1 F100"}));
}

TEST(IsoRadius, TheToolDoesNotChange) {  // LinuxCNC: "Cannot change tools with cutter radius compensation on"
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 2, NC_TOOL_RADIUS).tool(2, 3, NC_TOOL_RADIUS);
  const Outcome run = bench.run("F100\nG41 D1 G1 X10\nX30\nT2 M6\nX40\nM2");
  EXPECT_EQ(run.alarm, "NC-OFFSET-CODE");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_EQ(run.alarm_detail, "M06 is not possible while tool radius compensation is on. Cancel it with G40 first.");
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nT2 M6 G41\nG1 X10\nX30\nT1\nX40\nG40\nM6\nX50 Y0\nM2").alarm, "");
}

// ---- coordinate systems -------------------------------------------------------------------------------------------------------------

TEST(IsoSystems, NineOfThem) {  // RS-274/NGC 3.5.13, LinuxCNC G10 L2
  EXPECT_EQ(iso("G10 L2 P9 X3\nG10 L2 P1 X1\nG59.3 G0 X0\nG54 X0\nG59.1 X0").path(), (Path{"rapid 3 0 0", "rapid 1 0 0", "rapid 0 0 0"}));
  EXPECT_EQ(iso("G55\nG10 L2 P0 X3\nG0 X0\nG54 X0").path(), (Path{"rapid 3 0 0", "rapid 0 0 0"}));  // P0: the one in force
  EXPECT_EQ(iso("G0 X10\nG10 L20 P1 X2\nG0 X3\nG10 L20 P2 X0\nG55 X1").path(), (Path{"rapid 10 0 0", "rapid 11 0 0", "rapid 12 0 0"}));
  EXPECT_EQ(iso("#5222=4\nG0 Y0").path(), (Path{"rapid 0 4 0"}));
  EXPECT_EQ(alarm_of("G10 L2 P10 X1"), "NC-RANGE");
  EXPECT_EQ(alarm_of("G10 L2 X1"), "NC-WORDS");
  EXPECT_EQ(alarm_of("G10 L2 P1 X1 R10"), "NC-NOT-BUILT");
  EXPECT_EQ(alarm_of("G10 L1 P1 Z1"), "NC-NOT-BUILT");
}

TEST(Iso, APeckIsLargerThanZero) {  // RS-274/NGC 3.5.16.3: a Q that is negative or zero is an error
  for (const char* code : {"G83", "G73"})
    for (const char* q : {"Q-1", "Q[1-3]"}) EXPECT_EQ(alarm_of(std::string("F100\n") + code + " X1 Z-3 R1 " + q), "NC-RANGE") << code << q;
}

TEST(Iso, AHoleGoesDown) {  // LinuxCNC G81: R below Z is an error
  EXPECT_EQ(alarm_of("G0 Z5\nG81 X1 Z2 R1 F100"), "NC-RANGE");
  EXPECT_EQ(alarm_of("G0 Z5\nG91 G81 X1 Z2 R1 F100"), "NC-RANGE");
  EXPECT_EQ(alarm_of("G0 Z5\nG81 X1 Z1 R1 F100"), "");
}

TEST(Iso, ADwellTakesNoAxisWords) {  // RS-274/NGC 3.5.4
  EXPECT_EQ(alarm_of("G0 X1 G4 P1"), "NC-ALONE");
}

TEST(Iso, AMotionAndACycleAreOfOneGroup) {  // RS-274/NGC 3.4, table 4
  EXPECT_EQ(alarm_of("G0 G81 X1 Z-1 R1 F100"), "NC-FORMAT");
  EXPECT_EQ(alarm_of("G81 G0 X1 Z-1 R1 F100"), "NC-FORMAT");
  EXPECT_EQ(alarm_of("G0 G80 X1"), "");
}

TEST(IsoSystems, TheShiftIsOfAllAndGoesWithG921) {  // RS-274/NGC 3.5.18
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G43 H1\nG92 Z2\nG0 Z5").path(), (Path{"rapid 0 0 3"}));  // the reading is that with the length
  EXPECT_EQ(iso("G0 X10\nG92 X0\nG0 X1\nG55 X2\nG92.1\nX2").path(), (Path{"rapid 10 0 0", "rapid 11 0 0", "rapid 12 0 0", "rapid 2 0 0"}));
}

// ---- cycles and probing -----------------------------------------------------------------------------------------------------------

TEST(IsoCycle, DwellsInSecondsAndPecksByAHundredthOfAnInch) {  // RS-274/NGC 3.5.16
  EXPECT_EQ(iso("G0 Z5\nF100\nG82 X1 Y1 Z-1 R1 P0.25\nG80").dwells(), (std::vector<double>{0.25}));
  EXPECT_EQ(iso("G0 Z5\nF100\nG83 X0 Y0 Z-3 R1 Q2\nG80").path(),
            (Path{"rapid 0 0 5", "rapid 0 0 1", "line 0 0 -1 F100", "rapid 0 0 1", "rapid 0 0 -0.746", "line 0 0 -3 F100", "rapid 0 0 5"}));
  EXPECT_EQ(iso("G0 Z5\nF100\nG73 X0 Y0 Z-3 R1 Q2 G99\nG80").path(),
            (Path{"rapid 0 0 5", "rapid 0 0 1", "line 0 0 -1 F100", "rapid 0 0 -0.746", "line 0 0 -3 F100", "rapid 0 0 1"}));
}

TEST(IsoCycle, BelowRItGoesUpFirst) {
  EXPECT_EQ(iso("F100\nG81 X3 Y4 Z-1 R2\nX5\nG80").path(),
            (Path{"rapid 0 0 2", "rapid 3 4 2", "line 3 4 -1 F100", "rapid 3 4 2", "rapid 5 4 2", "line 5 4 -1 F100", "rapid 5 4 2"}));
}

TEST(IsoCycle, AHoleWithoutDepthEndsAtR) {  // LinuxCNC: only a bottom above R is an error
  EXPECT_EQ(iso("F100\nG0 Z6\nG81 X4 Z6.5 R6.5\nG80").path(),
            (Path{"rapid 0 0 6", "rapid 0 0 6.5", "rapid 4 0 6.5"}));
  EXPECT_EQ(iso("F100\nG0 X1 Z6\nG90 G86 X2 Z0 R7 P0\nG91 X12\nG80").alarm, "NC-SPINDLE");
  EXPECT_EQ(iso("F100\nG0 Z6\nG91 G81 X5 Z0 R7\nX5\nG80").path(),
            (Path{"rapid 0 0 6", "rapid 0 0 13", "rapid 5 0 13", "rapid 10 0 13"}));
  EXPECT_EQ(iso("F100\nG0 Z6\nG18 G81 X4 Y6.5 R6.5\nG80").path(), (Path{"rapid 0 0 6", "rapid 0 6.5 6", "rapid 4 6.5 6"}));
}

TEST(IsoCycle, RepeatsInIncrementalMode) {  // RS-274/NGC 3.5.16.1, the second example: R from where Z is, Z from R
  EXPECT_EQ(iso("G0 X1 Y2 Z3\nF100\nG91 G81 G98 X4 Y5 Z-0.6 R1.8 L3\nG80").path(),
            (Path{"rapid 1 2 3", "rapid 1 2 4.8", "rapid 5 7 4.8", "line 5 7 4.2 F100", "rapid 5 7 4.8", "rapid 9 12 4.8", "line 9 12 4.2 F100",
                  "rapid 9 12 4.8", "rapid 13 17 4.8", "line 13 17 4.2 F100", "rapid 13 17 4.8"}));
}

TEST(IsoCycle, BeginsWithBottomAndR) {
  EXPECT_EQ(alarm_of("F100\nG81 X1 R1"), "NC-WORDS");
  EXPECT_EQ(alarm_of("F100\nG81 X1 Z-1"), "NC-WORDS");
  EXPECT_EQ(alarm_of("F100\nG83 X1 Z-1 R1"), "NC-WORDS");
}

TEST(IsoProbe, NoContactIsAnAlarmOrNot) {  // LinuxCNC G38
  Bench bench(NC_DIALECT_ISO);
  EXPECT_EQ(bench.run("F100\nG38.3 Z-10\nG0 Z0").path(), (Path{"skip 0 0 -10 F100", "rapid 0 0 0"}));
  const Outcome missed = bench.at(0, 0, 0).run("F100\nG38.2 Z-10\nG0 Z0");
  EXPECT_EQ(missed.alarm, "NC-PROBE");
  EXPECT_EQ(missed.alarm_line, 2u);
  bench.skip_at = [](const nc_item&) { return 0.5; };
  const Outcome touched = bench.at(0, 0, 0).run("G38.2 Z-10 F150\nG1 X#5063\nX1");
  EXPECT_EQ(touched.alarm, "");
  EXPECT_EQ(touched.path(), (Path{"skip 0 0 -10 F150", "line -5 0 -5 F150", "line 1 0 -5 F150"}));  // F stays in force
  EXPECT_EQ(bench.at(0, 0, 0).run("G38.2 Z-10").alarm, "NC-FEED");
}

TEST(IsoProbe, LeavesTheWorkUntilTheContactIsLost) {  // LinuxCNC G38.4, G38.5
  Bench bench(NC_DIALECT_ISO);
  const Outcome stays = bench.run("F100\nG38.4 Z10\nG0 Z0");
  EXPECT_EQ(stays.alarm, "NC-PROBE");
  EXPECT_EQ(stays.alarm_line, 2u);
  EXPECT_TRUE(stays.moves().at(0).skip_away);
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG38.5 Z10\nG0 Z0").path(), (Path{"skip 0 0 10 F100", "rapid 0 0 0"}));
  bench.skip_at = [](const nc_item&) { return 0.5; };
  EXPECT_EQ(bench.at(0, 0, 0).run("G38.4 Z10 F150\nG1 X#5063").path(), (Path{"skip 0 0 10 F150", "line 5 0 5 F150"}));
  EXPECT_FALSE(bench.at(0, 0, 0).run("G38.3 Z-10 F150").moves().at(0).skip_away);
}

TEST(IsoProbe, TheSignalHasToChange) {  // LinuxCNC G38: an error where it is as at the end already, and where there is no way
  Bench bench(NC_DIALECT_ISO);
  bench.skip_at = [](const nc_item&) { return 0.0; };
  for (const char* code : {"G38.2", "G38.3", "G38.4", "G38.5"}) {
    const Outcome run = bench.at(0, 0, 0).run(std::string("F100\n") + code + " Z-10\nG0 Z5");
    EXPECT_EQ(run.alarm, "NC-PROBE") << code;
    EXPECT_EQ(run.alarm_line, 2u) << code;
    EXPECT_EQ(bench.at(0, 0, -10).run(std::string("F100\n") + code + " Z-10").alarm, "NC-PROBE") << code;
  }
}

TEST(IsoProbe, StaysInForceAsAMotion) {  // LinuxCNC, modal groups: G38.n is one of group 1
  Bench bench(NC_DIALECT_ISO);
  EXPECT_EQ(bench.run("F100\nG0 Z5\nG38.3 Z-3\nX5\nM3 S100\nG4 P0\nG43.1 Z1\nG10 L2 P1 X0\nG1 X0").path(),
            (Path{"rapid 0 0 5", "skip 0 0 -3 F100", "skip 5 0 -3 F100", "line 0 0 -3 F100"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG38.5 Z3\nX5 F50").moves().at(1).skip_away, 1);
  EXPECT_EQ(bench.at(0, 0, 0).run("F100\nG38.3 Z-3\nG93\nG1 X1 F2").alarm, "");
  bench.skip_at = [](const nc_item&) { return 0.5; };
  EXPECT_EQ(bench.at(0, 0, 0).run("G38.2 Z-10 F150\nX6\nG91 Z-1").path(), (Path{"skip 0 0 -10 F150", "skip 6 0 -5 F150", "skip 3 0 -6 F150"}));
  bench.skip_at = [](const nc_item& item) { return item.u.move.machine.v[0] > 1 ? std::optional<double>() : 0.5; };
  struct Row {
    const char *program, *alarm;
    unsigned line;
  };
  for (const Row& row : {Row{"F100\nG38.2 Z-3\nX5", "NC-PROBE", 3}, Row{"F100\nG38.3 Z-3\nG93\nX1 F1", "NC-FEED-MODE", 4}, Row{"F100\nG4 P1 G38.3 Z-3", "NC-FORMAT", 2},
                         Row{"F100\nG38.3 Z-3\nG53 X1", "NC-MODE", 3}, Row{"F100\nG38.3 Z-3 G1 X5", "NC-FORMAT", 2}}) {
    const Outcome run = bench.at(0, 0, 0).run(row.program);
    EXPECT_EQ(run.alarm, row.alarm) << row.program;
    EXPECT_EQ(run.alarm_line, row.line) << row.program;
  }
}

// ---- words ----------------------------------------------------------------------------------------------------------------------------

TEST(IsoWords, NumbersOfThingsAreWhole) {  // RS-274/NGC 3.3.2.1
  for (const char* text : {"T1.5 M6", "M3.5 S100", "M6.5", "M[3.5]", "G41 D1.5", "G43 H1.5", "G10 L2.7 P1 X5", "G10 L2 P1.5 X5", "F100 G81 X1 Z-1 R1 L2.5", "F100 G2 I5 P2.5", "T1.001"}) {
    const Outcome run = iso(std::string("G0 X0\n") + text);
    EXPECT_EQ(run.alarm, "NC-FORMAT") << text;
    EXPECT_EQ(run.alarm_line, 2u) << text;
  }
  EXPECT_EQ(iso("T1.99995 M[3+3.00005]\nM2").aux(), "T2 M6 M2");  // within 0.0001
  EXPECT_EQ(iso("T[1/3*3] M6.0\nM2").aux(), "T1 M6 M2");
  EXPECT_EQ(iso("F100\nG99 G81 X1 Z-1 R1 L0.99995\nM2").alarm, "");
}

TEST(IsoWords, SpeedsAreReal) {  // RS-274/NGC 3.7.2
  std::vector<double> speeds, surface;
  for (const nc_item& item : iso("S100.5 M3\nG96 S150.25\nM2").of(NC_ITEM_ACTION)) {
    if (item.u.action.kind == NC_ACTION_S) speeds.push_back(item.u.action.value);
    if (item.u.action.kind == NC_ACTION_CONTROL && item.u.action.index == NC_CONTROL_SURFACE_SPEED && item.u.action.value > 0) surface.push_back(item.u.action.value);
  }
  EXPECT_EQ(speeds.at(0), 100.5);
  EXPECT_EQ(surface.at(0), 150.25);
}

TEST(IsoWords, AWordThatNoCodeTakesIsAnAlarm) {  // LinuxCNC: "D word with no G41", "L word with no canned cycle" and their like
  for (const char* text : {"G0 X1 L5", "R3", "G1 X1 I5 F100", "X1 P2", "G0 X1 D1", "G0 Z1 H1", "G1 X1 Q2 F100", "G81 X1 Z-1 R1 F100 Q2", "G81 X1 Z-1 R1 F100 P2", "G85 X1 Z-1 R1 F100 I2",
                           "G53 G0 X1 R2", "G33 Z-1 K1 R2", "G80 R2", "G4 P0 R5", "M3 S1 P5", "M101 P5", "G49 H1", "G40 D1", "G38.3 Z-1 F1 R2", "G92 X0 L1"}) {
    const Outcome run = iso(std::string("G0 X0\n") + text);
    EXPECT_EQ(run.alarm, "NC-ADDRESS") << text;
    EXPECT_EQ(run.alarm_line, 2u) << text;
  }
}

TEST(IsoCoordinates, SettingsHaveTheAxisWordsThatTheyNeed) {  // RS-274/NGC 3.5.18
  EXPECT_EQ(iso("G92").alarm, "NC-WORDS");
  for (const char* code : {"G92.1", "G92.2", "G92.3"}) EXPECT_EQ(iso(std::string(code) + " X1").alarm, "NC-ALONE") << code;
}

// ---- M codes and what is not there ----------------------------------------------------------------------------------------------------

TEST(IsoMisc, OverridesAreBarredAndAllowed) {  // RS-274/NGC 3.6.5
  std::vector<double> bits;
  for (const nc_item& item : iso("M49\nG0 X1\nM48\nM2").of(NC_ITEM_ACTION))
    if (item.u.action.kind == NC_ACTION_CONTROL && item.u.action.index == NC_CONTROL_DISABLE) bits.push_back(item.u.action.value);
  EXPECT_EQ(bits, (std::vector<double>{2, 0}));
}

TEST(IsoMisc, CoolantAndUserCodesGoOut) { EXPECT_EQ(iso("M7 M8\nM9\nM101\nM60\nM30").aux(), "M7 M8 M9 M101 M60 M30"); }

/// Moves, M codes and dwells of a cycle, in order.
Path strokes(const std::string& text) {
  Path all;
  size_t next_move = 0;
  const Outcome run = iso("G21 G90 F200 S500\nG0 Z10\n" + text + "\nG80\nM2");
  if (!run.alarm.empty()) return {run.alarm};
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) all.push_back(moves[next_move++]);
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + std::to_string(item.u.gate.value).substr(0, 3));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_STOP) all.push_back("stop");
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_M) all.push_back("M" + std::to_string(static_cast<int>(item.u.action.value)));
  }
  all.erase(all.begin());  // to Z10
  all.pop_back();          // M2
  return all;
}

TEST(IsoCycles, TapsAndBoresKeepTheDirectionOfTheSpindle) {  // RS-274/NGC 3.5.16.4 to 3.5.16.8, LinuxCNC G74
  EXPECT_EQ(strokes("M3\nG98 G84 X1 Z-5 R2 P0.5"),
            (Path{"M3", "rapid 1 0 10", "rapid 1 0 2", "line 1 0 -5 F200", "M4", "dwell 0.5", "line 1 0 10 F200", "M3"}));
  EXPECT_EQ(strokes("M4\nG99 G74 Z-5 R2"), (Path{"M4", "rapid 0 0 2", "line 0 0 -5 F200", "M3", "line 0 0 2 F200", "M4"}));
  EXPECT_EQ(strokes("M4\nG98 G86 Z-5 R2 P0.5"),
            (Path{"M4", "rapid 0 0 2", "line 0 0 -5 F200", "dwell 0.5", "M5", "rapid 0 0 10", "M4"}));
  EXPECT_EQ(strokes("M3\nG99 G87 Z-5 R2 I1 J2 K-3"),
            (Path{"M3", "rapid 0 0 2", "rapid 1 2 2", "M5", "M19", "rapid 1 2 -5", "rapid 0 0 -5", "M3", "line 0 0 -3 F200", "line 0 0 -5 F200", "M5", "M19",
                  "rapid 1 2 -5", "rapid 1 2 2", "rapid 0 0 2", "M3"}));
  EXPECT_EQ(strokes("M3\nG99 G88 Z-5 R2 P0.5\nX4"),
            (Path{"M3", "rapid 0 0 2", "line 0 0 -5 F200", "dwell 0.5", "M5", "stop", "M3", "rapid 0 0 2", "rapid 4 0 2", "line 4 0 -5 F200", "dwell 0.5", "M5",
                  "stop", "M3"}));
  for (const char* text : {"M4\nG84 Z-5 R2", "M3\nG74 Z-5 R2", "G84 Z-5 R2", "G86 Z-5 R2", "M3\nM5\nG88 Z-5 R2", "G87 Z-5 R2 I1 J1 K1"})
    EXPECT_EQ(strokes(text), Path{"NC-SPINDLE"}) << text;
  EXPECT_EQ(strokes("M3\nG87 Z-5 R2 I1 J1"), Path{"NC-WORDS"});
}

TEST(IsoCycles, TheAxisFollowsThePlane) {  // RS-274/NGC 3.5.16
  EXPECT_EQ(strokes("G99 G81 X7 Z-5 R2\nG18 X9"),
            (Path{"rapid 7 0 10", "rapid 7 0 2", "line 7 0 -5 F200", "rapid 7 0 2", "rapid 7 2 2", "rapid 9 2 2", "line 9 -5 2 F200", "rapid 9 2 2"}));
}

TEST(Iso, WhatIsNotBuiltSaysSo) {
  for (const char* text : {"G33.1 Z-1 K1", "G43.2 H1", "G41.1 D1", "G52 X1", "G5.2", "G28.1", "M51 P0", "M52 P1", "M70", "M98 P1",
                           "M99"}) {
    const Outcome run = iso(std::string("G21\n") + text);
    EXPECT_EQ(run.alarm, "NC-NOT-BUILT") << text;
    EXPECT_EQ(run.alarm_line, 2u) << text;
  }
  for (const char* text : {"G76 P0.05 Z-1 I-.075 J.008 K.045 Q29.5 L2 E.045", "G7", "G8"}) EXPECT_EQ(alarm_of(text), "NC-LATHE") << text;
  EXPECT_NE(iso("G76 P1").alarm_detail.find("on a lathe"), std::string::npos) << iso("G76 P1").alarm_detail;
  EXPECT_EQ(iso("M51 P0").alarm_detail, "M51 P0: no program bars the override of the spindle.");
  EXPECT_EQ(iso("M52 P1").alarm_detail, "M52 P1: there is no signal of an adaptive feed.");
  EXPECT_EQ(alarm_of("G12"), "NC-NO-SUCH-CODE");
  EXPECT_EQ(alarm_of("E5"), "NC-ADDRESS");  // a letter of M66 to M68 alone
}

TEST(Iso, AUnitLeavesTheFeedAsFast) {  // LinuxCNC: F has been given in the unit of its block
  const auto feeds = [](const std::string& text) {
    std::string all;
    const Outcome run = Bench(NC_DIALECT_ISO).run(text + "\nM2");
    for (const nc_move& move : run.moves()) all += brief(move.feed_mm_min) + " ";
    return all + run.alarm;
  };
  EXPECT_EQ(feeds("G21 G90 F100\nG20\nG1 X1\nG21\nG1 X0"), "100 100 ");
  EXPECT_EQ(feeds("G20 G90 F10\nG21 G1 X1"), "254 ");
  EXPECT_EQ(feeds("G20 F10\nG20 G1 X1\nF20 X2"), "254 508 ");
  EXPECT_EQ(feeds("G21\nG20 F10\nG1 X1"), "254 ");  // of the block of the code: as the program writes it
  EXPECT_EQ(feeds("G21 G93 G1 X10 F2\nG20 X1 F2"), "20 30.8 ");
}

}  // namespace
}  // namespace nc::test
