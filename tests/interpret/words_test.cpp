// SPDX-License-Identifier: Apache-2.0
// The values of the words of a block: units, decimal points, distance modes, ranges (M700 2, 3, 5; DGSHAPE 1-5).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

TEST(DecimalPoint, TypeOneTakesTheLeastCommandUnit) {  // M700 5.3
  EXPECT_EQ(m700("G0 X12345 Y-5 Z12.5\nM30").path(), (Path{"rapid 12.345 -0.005 12.5"}));
  EXPECT_EQ(Bench().param("1003", "C").run("G0 X12345\nM30").path(), (Path{"rapid 1.2345 0 0"}));
  EXPECT_EQ(Bench().param("1003", "E").run("G0 X12345\nM30").path(), (Path{"rapid 0.012345 0 0"}));
  EXPECT_EQ(Bench().param("1015", "100").run("G0 X12345\nM30").path(), (Path{"rapid 123.45 0 0"}));
  EXPECT_EQ(Bench().param("1015", "10000").run("G0 X12\nM30").path(), (Path{"rapid 12 0 0"}));
}

TEST(DecimalPoint, EachAxisMayHaveACommandUnitOfItsOwn) {  // M700 2.1
  Bench bench;
  bench.param("1015", "100", 'X').param("1015", "0", 'Y').param("1015", "10000", 'Z');
  EXPECT_EQ(bench.run("G0 X10 Y10 Z2\nG91 X-5 Y.5\nM30").path(), (Path{"rapid 0.1 0.01 2", "rapid 0.05 0.51 2"}));
  EXPECT_EQ(bench.run("G20 G90 G0 X10 Y10\nM30").path(), (Path{"rapid 0.254 0.0254 2"}));
  EXPECT_EQ(bench.param("1015", "1000").run("G21 G90 G0 X10 Y10\nM30").path(), (Path{"rapid 0.1 0.01 2"}));
  EXPECT_EQ(bench.at(0, 0, 9).run("G21 G90 G81 X10 Z-2 R3 F60\nM30").path(),
            (Path{"rapid 0.1 0 9", "rapid 0.1 0 3", "line 0.1 0 -2 F60", "rapid 0.1 0 9"}));
  EXPECT_EQ(bench.at(0, 0, 2).param("1078", "1").run("G0 X10 Y10\nM30").path(), (Path{"rapid 10 10 2"}));
}

TEST(DecimalPoint, TypeTwoTakesWholeUnitsWhateverTheCommandUnitIs) {  // M700 5.3
  EXPECT_EQ(Bench().param("1078", "1").run("G0 X12345 Y1.5\nM30").path(), (Path{"rapid 12345 1.5 0"}));
  EXPECT_EQ(Bench().param("1078", "1").param("1015", "100").run("G0 X7\nM30").path(), (Path{"rapid 7 0 0"}));
}

TEST(DecimalPoint, AnExpressionCountsAsWrittenWithAPoint) {  // M700 5.3, 13.4
  EXPECT_EQ(m700("#111=123 #112=5.55\nG0 X#111\nX[#111+#112]\nX[#111-#112]\nX[123+0]\nX-#111\nM30").path(),
            (Path{"rapid 123 0 0", "rapid 128.55 0 0", "rapid 117.45 0 0", "rapid 123 0 0", "rapid -123 0 0"}));
}

TEST(DecimalPoint, ArcWordsTakeTheSettingUnit) {  // M700 2.1 note 3: I J K R by #1003, positions by #1015
  EXPECT_EQ(Bench().param("1015", "100").run("G91 G2 X100 Y100 J1000 F500\nM30").path(), (Path{"cw 1 1 0 c0,1 F500"}));
  EXPECT_EQ(Bench().param("1015", "100").run("G91 G3 X100 Y100 R1000 F500\nM30").path(), (Path{"ccw 1 1 0 c0,1 F500"}));
}

TEST(DecimalPoint, TenfoldActsOnWordsWithoutAPoint) {  // M700 2.2, the printed example without its damaged blocks
  const char* program = "N1 G90 G00 X0 Y0\nN2 G91 X-10000 Y-15000\nN3 G01 X-10000 Y-5000 F500\nN4 G03 X-10000 Y-10000 J-10000\nG01 X20.000\nM30";
  EXPECT_EQ(Bench().param("UNIT*10", "10").run(program).path(),
            (Path{"rapid -100 -150 0", "line -200 -200 0 F500", "ccw -300 -300 0 c-200,-300 F500", "line -280 -300 0 F500"}));
  EXPECT_EQ(m700(program).path(), (Path{"rapid -10 -15 0", "line -20 -20 0 F500", "ccw -30 -30 0 c-20,-30 F500", "line -10 -30 0 F500"}));
  // Decimal point type II ignores it.
  EXPECT_EQ(Bench().param("UNIT*10", "10").param("1078", "1").run("G0 X5\nM30").path(), (Path{"rapid 5 0 0"}));
}

TEST(DecimalPoint, TenfoldIsNotForDwellsAndToolAmounts) {  // M700 2.2 (3) (4)
  Bench bench;
  bench.param("UNIT*10", "10");
  const Outcome run = bench.run("G4 X1000\nG4 P1000\nG10 L10 P1 R100\nG10 L2 P1 X100\nG43 H1 G0 Z0\nX0\nM30");
  EXPECT_EQ(run.dwells(), (std::vector<double>{1, 1}));
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 0.1", "rapid 1 0 0.1"}));
}

TEST(DecimalPoint, FeedIsInWholeUnitsInBothTypes) {  // M700 7.2
  EXPECT_EQ(m700("G1 X1. F200\nM30").path(), (Path{"line 1 0 0 F200"}));
  EXPECT_EQ(Bench().param("1078", "1").run("G1 X1 F200.5\nM30").path(), (Path{"line 1 0 0 F200.5"}));
}

TEST(DecimalPoint, NumbersDropTheirDecimals) {  // M700 5.3: D H L M N O S T
  EXPECT_EQ(m700("S1000.9 T5.2 M3.7\nM30").aux(), "S1000 T5 M3 M30");
}

TEST(Dwell, HasOneTime) {  // M700 8.1, HX 5.4, DGSHAPE G04: X or P; Series 8 G04: X or F
  struct Row {
    nc_dialect family;
    const char *program, *alarm;
  };
  for (const Row& row : {Row{NC_DIALECT_M700, "G04 X1. P500\nM30", "P33"}, Row{NC_DIALECT_HX, "G04 X1. P500\nM30", "F_82004"}, Row{NC_DIALECT_DGSHAPE, "%\nG04X1.P500\nM30", "NC-ALONE"},
                         Row{NC_DIALECT_SERIES8, "G04X1F2\nM30", "NC-FORMAT"}})
    EXPECT_EQ(Bench(row.family).run(row.program).alarm, row.alarm) << row.program;
}

TEST(Inch, LinearAxesOnlyAndFeedToo) {  // M700 5.2
  EXPECT_EQ(m700("G20 G0 X1. Y2. Z3.\nM30").path(), (Path{"rapid 25.4 50.8 76.2"}));
  EXPECT_EQ(m700("G20 G0 X100\nM30").path(), (Path{"rapid 0.254 0 0"}));  // printed table: 100 -> 0.254 mm
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZc")).run("G20 G0 X1. C90.\nC45000\nM30").path(), (Path{"rapid 25.4 0 0 90", "rapid 25.4 0 0 45"}));
  EXPECT_EQ(m700("G20 G1 X1. F10\nM30").path(), (Path{"line 25.4 0 0 F254"}));
}

TEST(Inch, ModalFeedGoesByTheUnitOfTheBlockThatMoves) {  // M700 5.2 note 1
  EXPECT_EQ(m700("G1 X10. F100\nG20 X1.\nG21 X0\nM30").path(), (Path{"line 10 0 0 F100", "line 25.4 0 0 F2540", "line 0 0 0 F100"}));
}

TEST(Inch, ArcWords) { EXPECT_EQ(m700("G20 G2 X1. Y1. J1. F10\nM30").path(), (Path{"cw 25.4 25.4 0 c0,25.4 F254"})); }

TEST(Inch, OffsetsKeepTheSettingUnit) {  // M700 5.2: setting units do not change with G20
  Bench bench;
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G20 G43 H1 G0 Z1.\nM30").path(), (Path{"rapid 0 0 35.4"}));
}

TEST(Distance, PowerOnModeIsAParameter) {  // M700 5.1 (4) #1073
  Bench bench;
  EXPECT_EQ(bench.at(5, 0, 0).run("G0 X3.\nM30").path(), (Path{"rapid 3 0 0"}));
  bench.param("1073", "0");
  EXPECT_EQ(bench.at(5, 0, 0).run("G0 X3.\nG90 X1.\nM30").path(), (Path{"rapid 8 0 0", "rapid 1 0 0"}));
  EXPECT_EQ(bench.at(5, 0, 0).run("G0 X3.\nM30").path(), (Path{"rapid 8 0 0"}));  // and again behind the end
}

TEST(Inch, PowerOnUnitIsAParameter) {  // M700 5.2 #1152
  Bench bench;
  bench.param("1152", "1");
  EXPECT_EQ(bench.run("G0 X1.\nM30").path(), (Path{"rapid 25.4 0 0"}));
}

TEST(Distance, EachWordGoesByTheCodeBeforeIt) {  // M700 5.1, the printed examples N1-N4
  const Outcome run = m700("G0 X100. Y100.\nN4 G90 X300. G91 Y100.\nX10.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 100 100 0", "rapid 300 200 0", "rapid 310 200 0"}));
  EXPECT_EQ(m700("G0 X100. Y100.\nX10. G91 Y100.\nM30").path(), (Path{"rapid 100 100 0", "rapid 10 200 0"}));
}

TEST(Distance, TheCodeMayBeAnExpression) {
  EXPECT_EQ(m700("#1=91\nG0 X10.\nG#1 X5.\n#2=90\nG91 X1. G#2 Y7.\nM30").path(), (Path{"rapid 10 0 0", "rapid 15 0 0", "rapid 16 7 0"}));
}

TEST(Distance, AbsoluteAndIncrementalAreModal) {
  EXPECT_EQ(m700("G91 G0 X10.\nX10.\nG90 X5.\nM30").path(), (Path{"rapid 10 0 0", "rapid 20 0 0", "rapid 5 0 0"}));
}

TEST(Range, ValuesThatAreTooLarge) {  // M700 5.3
  for (const char* block : {"G0 X100000.", "G0 Y-100000.", "G1 X1. F10000001", "G1 X1. F-5", "G2 X1. I100000. F1", "G20 G0 X10000.",
                            "G0 X[10*999999]", "G0 Z[99999*99999]"}) {
    const Outcome run = m700(std::string(block) + "\nM30");
    EXPECT_EQ(run.alarm, "P35") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
  EXPECT_EQ(m700("G0 X99999.999\nM30").path(), (Path{"rapid 99999.999 0 0"}));
  EXPECT_EQ(m700("G20 G0 X9999.9999\nM30").path(), (Path{"rapid 253999.99746 0 0"}));
  EXPECT_EQ(m700("#100=100000\nG0 X#100\nM30").alarm, "P35");
  EXPECT_EQ(m700("#100=99999999\nG1 X1. F#100\nM30").alarm, "P35");
}

TEST(Range, EndsOneUnitBelowTheRoundNumber) {  // M700 2.1, 5.3: +-99999.999 by #1003, with more decimals in finer units
  EXPECT_EQ(m700("G0 X99999.9999\nM30").alarm, "P35");
  EXPECT_EQ(m700("G0 Y-99999.9991\nM30").alarm, "P35");
  EXPECT_EQ(Bench().param("1003", "C").run("G0 X99999.9999\nM30").path(), (Path{"rapid 99999.9999 0 0"}));
  EXPECT_EQ(Bench().param("1003", "C").run("G0 X99999.99999\nM30").alarm, "P35");
  EXPECT_EQ(m700("G20 G0 X9999.99999\nM30").alarm, "P35");
  EXPECT_EQ(Bench().param("1003", "E").run("G20 G0 X9999.9999999\nM30").alarm, "");
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZc")).run("G20 G0 C99999.999\nM30").path(), (Path{"rapid 0 0 0 99999.999"}));
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZc")).run("G0 C99999.9999\nM30").alarm, "P35");
  for (const char* block : {"G2 X1. J99999.9999 F1", "G2 X1. R-99999.9999 F1", "G83 Z-5. Q99999.9999 F1", "G10 L10 P1 R99999.9999", "G10 L2 P1 X99999.9999",
                            "G92 X99999.9999", "G52 X99999.9999"})
    EXPECT_EQ(m700(std::string(block) + "\nM30").alarm, "P35") << block;
}

TEST(Range, OfAnOffsetIsThatOfTheUnitInForce) {  // M700 12.1, 14.10 (6): +-99999.999 mm, +-9999.9999 inch with #1003 = B
  for (const char* block : {"G10 L10 P1 R9999.9999", "G10 L11 P1 R-9999.9999", "G10 L12 P1 R5000.", "G10 L13 P1 R-5000.", "G10 L2 P1 X5000.", "G10 L20 P1 Y-9999.9999",
                            "G10 P0 Z5000.", "#10001=200000", "#16001=-200000", "#5221=200000"})
    EXPECT_EQ(Bench().param("1037", "2").run("G20 " + std::string(block[0] == '#' ? "\n" : "") + block + "\nM30").alarm, "") << block;
  for (const char* block : {"G20 G10 L10 P1 R10000.", "G20 G10 L2 P1 X10000.", "G20 G10 L10 P1 R6000.\nG91 G10 L10 P1 R6000.", "G20\n#10001=254000", "G20\n#5221=-254000",
                            "G21 G10 L10 P1 R100000.", "G21\n#10001=100000", "G21\n#5221=100000", "G20 G10 L10 P1 R5000.\nG21 G91 G10 L10 P1 R1."})
    EXPECT_EQ(m700(std::string(block) + "\nM30").alarm, "P35") << block;
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZc")).run("G20 G10 L2 P1 C100000.\nM30").alarm, "P35");
}

TEST(Range, UndottedWordsInTypeTwo) {
  const Outcome run = Bench().param("1078", "1").run("G0 X123456\nM30");
  EXPECT_EQ(run.alarm, "P35");
  EXPECT_EQ(run.alarm_line, 1u);
}

TEST(Words, VacantVariablesLeaveTheirWordOut) {  // M700 13.5.4
  EXPECT_EQ(m700("G0 X5.\nX#1 Y1.\nM30").path(), (Path{"rapid 5 0 0", "rapid 5 1 0"}));
  EXPECT_EQ(m700("G0 X#1 Z#2\nM30").path(), Path{});
}

TEST(Words, LowerCaseBlanksAndComments) {
  EXPECT_EQ(m700("g0 x1 0. (to the right) y 2.\nm30").path(), (Path{"rapid 10 2 0"}));
  EXPECT_EQ(m700("G0 X1.;\nY2.;\nM30;").path(), (Path{"rapid 1 0 0", "rapid 1 2 0"}));  // ';' ends a block
}

TEST(Words, OfSeveralCodesOfAGroupTheLastCounts) {  // M700 3.7
  EXPECT_EQ(m700("G1 G0 X1.\nM30").path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(m700("G0 G1 X1. F5\nM30").path(), (Path{"line 1 0 0 F5"}));
  EXPECT_EQ(m700("G55 G54 G0 X1.\nM30").last_modal().code[12], 540);
}

TEST(Words, OptionalSkip) {  // M700 3.4
  const char* program = "/G0 X1.\n/2 G0 Y2.\nG0 Z3.\nM30";
  EXPECT_EQ(m700(program).path(), (Path{"rapid 1 0 0", "rapid 1 2 0", "rapid 1 2 3"}));
  Bench plain;
  nc_switches_set(plain.control(), 0, 1u << 1, 0);
  EXPECT_EQ(plain.run(program).path(), (Path{"rapid 0 2 0", "rapid 0 2 3"}));
  Bench second;
  nc_switches_set(second.control(), 0, 1u << 2, 0);
  EXPECT_EQ(second.run(program).path(), (Path{"rapid 1 0 0", "rapid 1 0 3"}));
}

TEST(Words, ADivisionIsNoSkip) { EXPECT_EQ(m700("N20 G1 X25./Y25.\nM30").alarm_line, 1u); }

TEST(Words, IndexingIncrement) {  // M700 2.3
  auto run = [](const char* block) { return Bench(NC_DIALECT_M700, axes("XYZc")).param("2106", "2", 'C').run(std::string(block) + "\nM30"); };
  EXPECT_EQ(run("G0 C102.").path(), (Path{"rapid 0 0 0 102"}));
  EXPECT_EQ(run("G0 C101.").alarm, "P20");
  EXPECT_EQ(run("G1 C102 F10").alarm, "P20");  // 0.102 deg in type I
  EXPECT_EQ(run("G0 X1.001").alarm, "");       // linear axes are not checked
  for (const char* block : {"G28 C5.", "G30 C5.", "G53 C5.", "G31 C5. F10", "G60 C5.", "G27 C5.", "G81 X1. C5. Z-1. R1. F10", "G33 C5. F1."})
    EXPECT_EQ(run(block).alarm, "P20") << block;
  for (const char* block : {"G92 C5.", "G52 C5.", "G10 L2 P1 C5.", "G28 C4."}) EXPECT_EQ(run(block).alarm, "") << block;
}

TEST(Words, UnknownOnesAreAlarms) {
  EXPECT_EQ(m700("G0 X1. $\nM30").alarm, "P32");
  EXPECT_EQ(m700("G0 A1.\nM30").alarm, "P130");   // another second auxiliary address than the one in use
  EXPECT_EQ(m700("G0 U1.\nM30").alarm, "P11");
  EXPECT_EQ(m700("G0 X1. ,C5.\nM30").alarm, "P385");
  EXPECT_EQ(m700("G0 X1. ,A5.\nM30").alarm, "P390");
}

TEST(Words, EveryWordHasANumber) {  // M700 3.2 (1)
  for (const char* block : {"G0 X", "G0 X Y1.", "G0 Z1. Y-", "G1 X1. F", "S", "T", "M", "G04 P", "G04 X", "G2 X10. I5. J F100", "G92 X", "G53 Z", "G10 L2 P1 X",
                            "G41 D", "G43 H", "G10 L10 P R1.", "G65 P1 X"}) {
    const Outcome run = m700(std::string(block) + "\nM30");
    EXPECT_EQ(run.alarm, "P33") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
  // Printed in 14.10 with zeros in mind; and 3.7: "G" alone is G00.
  EXPECT_EQ(m700("G0 X1. Y2. Z3.\nG28 XYZ\nM30").path(), (Path{"rapid 1 2 3", "rapid 0 0 0"}));
  EXPECT_EQ(m700("G0 X1. Z3.\nZ G28 X\nM30").path(), (Path{"rapid 1 0 3", "rapid 0 0 0"}));
  EXPECT_EQ(m700("G\nX1.\nM30").path(), (Path{"rapid 1 0 0"}));
}

TEST(Words, NumbersOfBlocksAndProgramsStandInFront) {  // M700 3.2 note 9, DGSHAPE 1-1
  for (const char* block : {"G0 X1. N5", "G0 N5 X1.", "G0 X1. O5", "N1 O5 G0 X1."}) {
    EXPECT_EQ(m700(std::string(block) + "\nM30").alarm, "P33") << block;
    EXPECT_EQ(dgshape(std::string(block) + "\nM02").alarm, "NC-FORMAT") << block;
  }
  EXPECT_EQ(m700("O5 N7 G0 X1.\nM30").path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(m700("/ N7 G0 X1.\nM30").path(), (Path{"rapid 1 0 0"}));
}

TEST(DgshapeWords, ConventionalIsTheLeastUnit) {  // DGSHAPE 1-5
  EXPECT_EQ(dgshape("G0X1000Y-2000Z1.5\nM02").path(), (Path{"rapid 1 -2 1.5"}));
  EXPECT_EQ(dgshape("G1X1000.F600.\nM02").path(), (Path{"line 1000 0 0 F600"}));
  EXPECT_EQ(dgshape("G1X1000F600\nM02").path(), (Path{"line 1 0 0 F0.6"}));
  EXPECT_EQ(dgshape("G20\nG0X10000\nG1X0F10000\nM02").path(), (Path{"rapid 25.4 0 0", "line 0 0 0 F25.4"}));
}

TEST(DgshapeWords, CalculatorTypeByClassOfWord) {  // DGSHAPE 1-5
  auto run = [](const char* words) {
    Bench bench(NC_DIALECT_DGSHAPE);
    bench.param("interpretation", "calculator");
    if (words != nullptr) bench.param("calculator_words", words);
    return bench.run("%\nG1X10F600\nG2X20R5\nM02").path();
  };
  EXPECT_EQ(run(nullptr), (Path{"line 10 0 0 F600", "cw 20 0 0 c15,0 F600"}));
  EXPECT_EQ(run("all"), (Path{"line 10 0 0 F600", "cw 20 0 0 c15,0 F600"}));
  EXPECT_EQ(run("F"), (Path{"line 0.01 0 0 F600", "cw 0.02 0 0 c0.015,0 F600"}));
  EXPECT_EQ(run("IJKRXYZA"), (Path{"line 10 0 0 F0.6", "cw 20 0 0 c15,0 F0.6"}));
  EXPECT_EQ(run("none"), (Path{"line 0.01 0 0 F0.6", "cw 0.02 0 0 c0.015,0 F0.6"}));
}

TEST(DgshapeWords, ThereAreNoMacrosAndNoFractionsOfNumbers) {
  EXPECT_EQ(dgshape("#1=5\nM02").alarm_line, 2u);
  EXPECT_NE(dgshape("#1=5\nM02").alarm, "");
  EXPECT_NE(dgshape("S1000.5\nM02").alarm, "");
  EXPECT_NE(dgshape("G0X[1+2]\nM02").alarm, "");
  EXPECT_EQ(dgshape("G0X100000.\nM02").alarm, "NC-RANGE");
}

TEST(DgshapeWords, EveryWordHasANumber) {  // DGSHAPE 1-1
  for (const char* block : {"G0X", "G28XYZ", "G0X1.Y-", "G1X1.F", "G", "M", "S", "M06T", "G04P", "G10P1R", "G41DX1."}) {
    const Outcome run = dgshape(std::string(block) + "\nM02");
    EXPECT_EQ(run.alarm, "NC-FORMAT") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
}

TEST(DgshapeWords, RangeOne) {  // DGSHAPE 2-1
  EXPECT_EQ(dgshape("G0X99999.999Y-99999.999\nM02").path(), (Path{"rapid 99999.999 -99999.999 0"}));
  EXPECT_EQ(dgshape("G0X99999999\nM02").path(), (Path{"rapid 99999.999 0 0"}));
  for (const char* block : {"G0X99999.9999", "G0Z-100000.", "G0X100000000", "G20\nG0X10000.", "G20\nG0X9999.99995", "G1X1.F100000.", "G2X1.R100000.F100."})
    EXPECT_EQ(dgshape(std::string(block) + "\nM02").alarm, "NC-RANGE") << block;
  // Eight digits in the unit of the word, whatever that is.
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).param("interpretation", "calculator").run("%\nG1X200000F200000\nM02").path(),
            (Path{"line 200000 0 0 F200000"}));
}

TEST(DgshapeWords, NumbersOfThingsHaveNoPoint) {  // DGSHAPE 2: "with no decimal point"
  for (const char* block : {"S1000.", "M03.", "M06T1.", "G10L2P1.X1.", "G10P1.R1.", "G04P500.", "G41D1.X5.", "G43H1.", "M03\nG82Z-1.P500.F100.",
                            "M03\nG81Z-1.K2.F100."})
    EXPECT_EQ(dgshape(std::string(block) + "\nM02").alarm, "NC-FORMAT") << block;
  EXPECT_EQ(dgshape("G18G2X10.Z0K0.I5.F100.\nM02").alarm, "");  // K of an arc is a length
  // A point with digits behind it is the same mistake.
  for (const char* block : {"S1.5", "M3.5", "M06T1.5", "G43H1.5", "N1.5G0X0", "O1.5", "N1.G0X0"})
    EXPECT_EQ(dgshape(std::string(block) + "\nM02").alarm, "NC-FORMAT") << block;
  EXPECT_EQ(dgshape("S123456789\nM02").alarm, "NC-RANGE");
}

TEST(DgshapeWords, OfTwoDimensionCodesTheLastOneCountsForTheBlock) {  // DGSHAPE 1 (296)
  EXPECT_EQ(dgshape("G90G0X1000\nG90X5000G91\nM02").path(), (Path{"rapid 1 0 0", "rapid 6 0 0"}));
}

}  // namespace
}  // namespace nc::test
