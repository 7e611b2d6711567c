// SPDX-License-Identifier: Apache-2.0
// Circle cutting G12 and G13 (M700 13.10): the figure, its offset, its alarms, and its combination with other functions.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/pull.hpp"

namespace nc::test {
namespace {

TEST(CircleCut, TheFigureBothWays) {  // "0 1 2 3 4 5 6 7 0": over the top of the first half to the right, round, back from below
  Bench bench;
  bench.tool(1, 10.0).at(5, 7, 0);
  const Outcome cw = bench.run("G12 I50. D1 F100\nM30");
  EXPECT_EQ(cw.alarm, "");
  EXPECT_EQ(cw.path(), (Path{"cw 45 7 0 c25,7 F100", "cw 45 7 0 c5,7 F100", "cw 5 7 0 c25,7 F100"}));
  const Outcome ccw = bench.at(5, 7, 0).run("G13 I50. D1 F100\nM30");
  EXPECT_EQ(ccw.path(), (Path{"ccw 45 7 0 c25,7 F100", "ccw 45 7 0 c5,7 F100", "ccw 5 7 0 c25,7 F100"}));
  const auto arcs = cw.moves();
  ASSERT_EQ(arcs.size(), 3u);
  EXPECT_DOUBLE_EQ(arcs[0].sweep_deg, -180);
  EXPECT_DOUBLE_EQ(arcs[1].sweep_deg, -360);
  EXPECT_DOUBLE_EQ(arcs[2].sweep_deg, -180);
}

TEST(CircleCut, TheSignOfTheOffsetCountsAndThatOfTheRadiusDoesNot) {  // (1), and I "the symbol is ignored"
  Bench bench;
  bench.tool(1, 10.0).tool(2, -10.0);
  EXPECT_EQ(bench.run("G12 I-50. D1 F100\nM30").path().at(1), "cw 40 0 0 c0,0 F100");
  EXPECT_EQ(bench.run("G12 I50. D2 F100\nM30").path().at(1), "cw 60 0 0 c0,0 F100");
  EXPECT_EQ(bench.run("G12 I50. D0 F100\nM30").path().at(1), "cw 50 0 0 c0,0 F100");
}

TEST(CircleCut, InThePlaneThatIsSelected) {  // (2)
  Bench bench;
  bench.tool(1, 2.0);
  EXPECT_EQ(bench.at(0, 0, 0).run("G18 G12 I12. D1 F100\nM30").path().at(1), "cw 0 0 10 c0,0 F100");
  EXPECT_EQ(bench.at(0, 0, 0).run("G19 G12 I12. D1 F100\nM30").path().at(1), "cw 0 10 0 c0,0 F100");
}

TEST(CircleCut, IncrementalModeAndInch) {
  Bench bench;
  bench.tool(1, 5.4);
  const Path inch = {"cw 20 0 0 c10,0 F254", "cw 20 0 0 c0,0 F254", "cw 0 0 0 c10,0 F254"};
  EXPECT_EQ(bench.run("G20 G91\nG12 I1. D1 F10.\nM30").path(), inch);
}

TEST(CircleCut, OneShotThatLeavesEverythingAsItWas) {
  Bench bench;
  bench.tool(1, 2.0).tool(2, 5.0);
  const Outcome run = bench.run("G0 G90 X10.\nG12 I12. D1 F100\nX20.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path().at(4), "rapid 20 0 0");
  EXPECT_EQ(run.last_modal().code[1], 0);
  // D is the number of this circle and not that of radius compensation.
  const Outcome behind = bench.at(0, 0, 0).run("D2\nG12 I12. D1 F100\nG41 G1 X10. Y0\nX20.\nM30");
  EXPECT_EQ(behind.alarm, "");
  EXPECT_EQ(behind.path().at(3), "line 10 5 0 F100");
}

TEST(CircleCut, RadiusCompensationActsOnItsPath) {  // precaution (3): 20 - 2 by D, 3 more to the left of it
  Bench bench;
  bench.tool(1, 3.0).tool(2, 2.0);
  const Outcome run = bench.run("G41 D1 G1 X10. F100\nG13 I20. D2\nG40 G1 X0\nM30");
  EXPECT_EQ(run.alarm, "");
  const Path path = run.path();
  const auto circle = std::find(path.begin(), path.end(), "ccw 25 0 0 c10,0 F100");
  EXPECT_NE(circle, path.end());
}

TEST(CircleCut, NeitherStartsNorEndsRadiusCompensation) {  // 12.4.1: a move that does is a line
  Bench bench;
  bench.tool(1, 3.0);
  EXPECT_EQ(bench.run("G41 D1 G13 I20. F100\nM30").alarm, "P151");
  EXPECT_EQ(bench.run("G41 D1 G1 X10. F100\nX20.\nG40 G13 I20. D1\nM30").alarm, "P151");
}

TEST(CircleCut, ScalingEnlargesTheCircleAndNotTheTool) {  // 13.19
  Bench bench;
  bench.tool(1, 4.0);
  EXPECT_EQ(bench.run("G51 X0 Y0 P2.\nG12 I10. D1 F100\nM30").path().at(1), "cw 16 0 0 c0,0 F100");
  EXPECT_EQ(bench.at(0, 0, 0).run("G51 X0 P2.\nG12 I10. D1 F100\nM30").alarm, "P70");  // an ellipse
}

TEST(CircleCut, MirroredAndRotated) {
  Bench bench;
  bench.tool(1, 4.0);
  EXPECT_EQ(bench.run("G51.1 X0\nG12 I10. D1 F100\nM30").path(),
            (Path{"ccw -6 0 0 c-3,0 F100", "ccw -6 0 0 c0,0 F100", "ccw 0 0 0 c-3,0 F100"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G68 X0 Y0 R90.\nG12 I10. D1 F100\nM30").path(),
            (Path{"cw 0 6 0 c0,3 F100", "cw 0 6 0 c0,0 F100", "cw 0 0 0 c0,3 F100"}));
}

TEST(CircleCut, AModalMacroComesBehindIt) {  // 13.5.1: after a block that moves
  Bench bench;
  bench.tool(1, 4.0).add("O1", "#100=#100+1\nM99\n");
  EXPECT_EQ(bench.run("#100=0\nG66 P1\nG12 I10. D1 F100\nG67\nM30").var(100), 1);
}

TEST(CircleCut, OffsetNumberMissingOrIllegal) {  // precaution (1)
  Bench bench;
  EXPECT_EQ(bench.run("G12 I30. F100\nM30").alarm, "P170");
  EXPECT_EQ(bench.run("G12 I30. D9999 F100\nM30").alarm, "P170");
  EXPECT_EQ(bench.run("G12 I30. D-1 F100\nM30").alarm, "P170");
}

TEST(CircleCut, ARadiusThatIsNotLargerThanTheOffset) {  // precaution (2), appendix 1
  Bench bench;
  bench.tool(1, 10.0);
  const Outcome equal = bench.run("G12 I10. D1 F100\nM30");
  EXPECT_EQ(equal.alarm, "P223");
  EXPECT_TRUE(equal.moves().empty());
  EXPECT_NE(equal.alarm_detail.find("I10"), std::string::npos) << equal.alarm_detail;
  EXPECT_EQ(bench.run("G13 I-9. D1 F100\nM30").alarm, "P223");
  EXPECT_EQ(bench.run("G13 D1 F100\nM30").alarm, "P33");  // a word is missing
}

TEST(CircleCut, AddressesOutsideTheFormat) {  // precaution (4)
  Bench bench;
  bench.tool(1, 2.0);
  for (const char* word : {"X1.", "Z1.", "J5.", "K5.", "R5.", "H1", "P1", "Q1.", "L2", "S100", "T1", "M8"}) {
    const Outcome run = bench.run(std::string("G12 I10. D1 F100 ") + word + "\nM30");
    EXPECT_EQ(run.alarm, "P32") << word;
    EXPECT_TRUE(run.moves().empty()) << word;
    EXPECT_EQ(run.aux(), "") << word;
  }
  EXPECT_EQ(bench.run("N10 G17 G12 I10. D1 F100\nM30").alarm, "");
}

TEST(CircleCut, NeedsAFeedAndNotInverseTime) {
  Bench bench;
  bench.tool(1, 2.0);
  EXPECT_EQ(bench.run("G12 I10. D1\nM30").alarm, "P62");
  EXPECT_EQ(bench.run("G93\nG12 I10. D1 F5.\nM30").alarm, "P125");  // 7.5
  EXPECT_EQ(bench.run("F100\nG13 I10. D1\nM30").alarm, "");
}

TEST(CircleCut, ARotaryAxisOfThePlaneNotInInch) {  // 3.2 note 5 says how long a degree is of arcs alone
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1030", "C").tool(1, 2.0);
  EXPECT_EQ(bench.run("G17 G0 X0 C0\nG12 I12. D1 F100\nM30").path().at(1), "cw 10 0 0 0 c0,0 F100");
  EXPECT_EQ(bench.run("G20 G17 G0 X0 C0\nG12 I1. D1 F10.\nM30").alarm, "P39");
}

TEST(CircleCut, ExactStopAndArcsInSpace) {  // 7.7; 6.14: P75
  Bench bench;
  bench.tool(1, 2.0);
  for (const nc_move& arc : bench.run("G9 G12 I10. D1 F100\nM30").moves()) EXPECT_TRUE(arc.exact_stop);
  EXPECT_EQ(bench.run("F100\nG2.4 X5. Y5. Z5.\nX10. Y0 Z0\nG12 I10. D1\nM30").alarm, "P75");
}

}  // namespace
}  // namespace nc::test
