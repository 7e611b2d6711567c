// SPDX-License-Identifier: Apache-2.0
// Tool position offset G45 to G48 (M700 12.6): distances, zeros, arcs, alarms, and its combination with other functions.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

TEST(PositionOffset, TableOfEquivalentCommands) {  // x = 1000, l = +-10
  const struct {
    const char* code;
    double plus, minus;
  } rows[] = {{"G45", 1010, 990}, {"G46", 990, 1010}, {"G47", 1020, 980}, {"G48", 980, 1020}};
  for (const auto& row : rows) {
    for (const double sign : {1.0, -1.0}) {
      const std::string block = std::string(row.code) + " X" + (sign < 0 ? "-" : "") + "1000. D";
      Bench bench;
      bench.tool(1, 10).tool(2, -10);
      EXPECT_EQ(bench.run("G91 G0\n" + block + "1\nM30").end_work.v[0], sign * row.plus) << block;
      EXPECT_EQ(bench.at(0, 0, 0).run("G91 G0\n" + block + "2\nM30").end_work.v[0], sign * row.minus) << block;
    }
  }
}

TEST(PositionOffset, AWayShortenedBelowZeroTurnsRound) {  // precaution (2)
  Bench bench;
  bench.tool(1, 15);
  EXPECT_EQ(bench.run("G91 G0\nG48 X20. D1\nM30").path(), (Path{"rapid -10 0 0"}));
}

TEST(PositionOffset, OfAZeroTheSignCountsInIncrementsOnly) {  // precaution (3)
  Bench bench;
  bench.tool(1, 1.234);
  EXPECT_EQ(bench.run("G91 G0\nG45 X0 D1\nG45 X-0 D1\nG46 X0 D1\nG46 X-0 D1\nM30").path(),
            (Path{"rapid 1.234 0 0", "rapid 0 0 0", "rapid -1.234 0 0", "rapid 0 0 0"}));
  EXPECT_EQ(bench.at(5, 0, 0).run("G90 G0\nG45 X5. D1\nM30").path(), Path{});
}

// What 2.458 and twice 0.708 add up to is not 1.042 in its last binary digit: that digit has no sign to count.
TEST(PositionOffset, AnAbsoluteWordOfThePlaceThatAddingUpHasRoundedStaysThere) {
  Bench bench;
  bench.tool(1, -4.193).tool(2, 0.708);
  EXPECT_EQ(bench.run("G90 G0\nG48 Z2.458 D2\nG48 X10. Z1.042 D1\nM30").path(), (Path{"rapid 0 0 1.042", "rapid 18.386 0 1.042"}));
  bench.tool(1, 0.1).tool(2, 0.2);
  EXPECT_EQ(bench.at(0, 0, 0).run("G90 G0\nG45 X0.1 D2\nG47 G2 X0.3 Y-10. J-5. F100 D1\nM30").path(), (Path{"rapid 0.3 0 0", "cw 0.3 -10.2 0 c0.3,-5.1 F100"}));
}
TEST(PositionOffset, AnAbsoluteWordCountsFromTheEndOfTheBlockBefore) {
  Bench bench;
  bench.tool(1, 2).at(50, 0, 0);
  EXPECT_EQ(bench.run("G90 G0\nG45 X20. D1\nG1 G46 X60. Y10. F100\nX0\nM30").path(),
            (Path{"rapid 18 0 0", "line 58 8 0 F100", "line 0 8 0 F100"}));
}

TEST(PositionOffset, AllAxesOfTheBlockByTheSameAmountAndTheNumberBeforeHolds) {
  Bench bench;
  bench.tool(20, 50);
  EXPECT_EQ(bench.run("G91 G1 F1000\nG45 X220. Y60. D20\nG46 Z-60.\nM30").path(), (Path{"line 270 110 0 F1000", "line 270 110 -10 F1000"}));
}

TEST(PositionOffset, ActsInItsOwnBlockAndInInch) {
  Bench bench;
  bench.tool(1, 2.54);
  EXPECT_EQ(bench.run("G20 G91 G0\nG45 X1. D1\nX1.\nM30").path(), (Path{"rapid 27.94 0 0", "rapid 53.34 0 0"}));
}

TEST(PositionOffset, QuarterOfACircleOutsideAndInside) {  // example 1
  Bench bench;
  bench.tool(1, 200);
  EXPECT_EQ(bench.at(1200, 0, 0).run("G91 G45 G3 X-1000. Y1000. I-1000. F1000 D1\nM30").path(), (Path{"ccw 0 1200 0 c0,0 F1000"}));
  EXPECT_EQ(bench.at(800, 0, 0).run("G91 G46 G3 X-1000. Y1000. R1000. F1000 D1\nM30").path(), (Path{"ccw 0 800 0 c0,0 F1000"}));
}

TEST(PositionOffset, HalfAndThreeQuartersOfACircle) {
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.at(12, 0, 0).run("G91 G47 G3 X-20. Y0 I-10. F100 D1\nM30").path(), (Path{"ccw -12 0 0 c0,0 F100"}));
  EXPECT_EQ(bench.at(8, 0, 0).run("G90 G48 G2 X-10. I-10. F100 D1\nM30").path().size(), 0u);  // -10 is no end of a half circle about the centre: 18 - 4
  EXPECT_EQ(bench.at(8, 0, 0).run("G91 G48 G2 X-20. I-10. F100 D1\nM30").path(), (Path{"cw -8 0 0 c0,0 F100"}));
  EXPECT_EQ(bench.at(12, 0, 0).run("G91 G45 G3 X-10. Y-10. I-10. F100 D1\nM30").path(), (Path{"ccw 0 -12 0 c0,0 F100"}));
  EXPECT_EQ(bench.at(12, 0, 0).run("G91 G45 G2 X-10. Y-10. I-10. F100 D1\nM30").path(), (Path{"cw 0 -12 0 c0,0 F100"}));
}

// Precaution (2) turns a way round that becomes less than nothing; an arc whose radius does has no circle about its centre, nor has one that keeps none.
TEST(PositionOffset, AnArcThatIsSmallerThanTheAmountIsRefused) {
  Bench bench;
  bench.tool(1, 5);
  for (const char* block : {"G46 G3 X4. Y4. J4.", "G46 G3 X4. Y4. R4.", "G46 G3 X5. Y5. J5.", "G48 G2 X-8. I-4.", "G46 G2 X-4. Y4. J4."}) {
    const Outcome run = bench.at(0, 0, 0).run("G91 F100 D1\n" + std::string(block) + "\nM30");
    EXPECT_EQ(run.alarm, "P142") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
  EXPECT_EQ(bench.at(0, 0, 0).run("G91 G46 G3 X6. Y6. J6. F100 D1\nM30").alarm, "");
}

// It may well be a quarter from axis to axis: what is wrong is its radius, and the sentence says so.
TEST(PositionOffset, TheSentenceNamesARadiusThatIsNotLargerThanTheAmount) {
  Bench bench;
  bench.tool(1, 5).tool(2, -5);
  const struct {
    const char *block, *says;
  } rows[] = {{"G46 G3 X4. Y4. J4. D1", "J4:"}, {"G46 G3 X4. Y4. R4. D1", "R4:"}, {"G46 G2 X5. Y-5. J-5. D1", "J-5:"}, {"G48 G2 X-8. I-4. D1", "I-4:"}, {"G45 G3 X4. Y4. J4. D2", "J4:"}};
  for (const auto& row : rows) {
    const Outcome run = bench.at(0, 0, 0).run("G91 F100\n" + std::string(row.block) + "\nM30");
    EXPECT_EQ(run.alarm, "P142") << row.block;
    EXPECT_EQ(run.alarm_detail.rfind(row.says, 0), 0u) << row.block << ": " << run.alarm_detail;
    EXPECT_NE(run.alarm_detail.find("larger than the amount"), std::string::npos) << run.alarm_detail;
    EXPECT_EQ(run.alarm_detail.find("1/4"), std::string::npos) << run.alarm_detail;
  }
}

// Behind an offset way the tool stands beside the programmed start. Absolute words lead to the programmed end, which the longer way passes: no arc from there is one, in increments it is.
TEST(PositionOffset, TheSentenceOfAnAbsoluteArcSaysThatItGoesInIncrements) {
  Bench bench;
  bench.tool(1, 2);
  for (const char* block : {"G45 G3 X0 Y10. I-10.", "G45 G3 X0 Y10. R10.", "G45 G3 X0 I-10."}) {
    const Outcome run = bench.at(12, 0, 0).run("G90 F100 D1\n" + std::string(block) + "\nM30");
    EXPECT_EQ(run.alarm, "P142") << block;
    EXPECT_EQ(run.alarm_detail.rfind("G90: where the start of the arc is offset, program it in G91", 0), 0u) << run.alarm_detail;
    EXPECT_LT(run.alarm_detail.size(), 128u);
  }
  EXPECT_EQ(bench.at(12, 0, 0).run("G91 G45 G3 X-10. Y10. I-10. F100 D1\nM30").alarm, "");
  EXPECT_EQ(bench.at(12, 0, 0).run("G90 F100 D1\nG91 G45 G3 X-10. Y11. I-10.\nM30").alarm_detail.find("G91"), std::string::npos);
}

TEST(PositionOffset, OtherArcsAreRefused) {  // appendix 1, P142
  Bench bench;
  bench.tool(1, 2);
  for (const char* block : {"G45 G2 X-20. I-10.", "G47 G2 X-10. Y10. I-10.", "G47 G2 I-10.", "G46 G3 X-5. Y8.66 I-10.", "G45 G3 X-14. Y14. I-10. J10."}) {
    const Outcome run = bench.at(10, 0, 0).run("G91 F100 D1\n" + std::string(block) + "\nM30");
    EXPECT_EQ(run.alarm, "P142") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
  EXPECT_NE(bench.at(10, 0, 0).run("G91 F100 D1\nG46 G2 I-10.\nM30").alarm_detail.find("G46 takes"), std::string::npos);
}

TEST(PositionOffset, ItsHIsNoneOfTheLength) {  // 12.2 (2)(e), example 3
  Bench bench;
  bench.tool(1, 5).tool(2, 8).tool(6, 50);
  for (const char* code : {"G45", "G46", "G47", "G48"}) {
    const Path path = bench.at(0, 0, 0).run("G0 G43 Z1. H1\n" + std::string(code) + " X10. D2 H6\nG49 Z2.\nG43 Z2.\nM30").path();
    ASSERT_EQ(path.size(), 4u) << code;
    EXPECT_EQ(path[3].substr(path[3].rfind(' ')), " 7") << code;
  }
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 Z1. H1\nH6\nZ2.\nM30").path().back(), "rapid 0 0 52");  // 12.1 (2)
}

TEST(PositionOffset, IgnoredInFixedCycles) {  // precaution (1)
  Bench bench;
  bench.tool(1, 2);
  const char* holes = "X10.\nX20.\nG80\nM30";
  const std::string with = "G90 G99 G81 X5. Z-3. R1. F100\nG45 X10. D1\nX20.\nG80\nM30", without = "G90 G99 G81 X5. Z-3. R1. F100\n";
  const Path ignored = bench.at(0, 0, 0).run(with).path();
  EXPECT_EQ(ignored, bench.at(0, 0, 0).run(without + holes).path());
  EXPECT_EQ(ignored.size(), 10u);
}

TEST(PositionOffset, ScalingEnlargesTheWayAndNotTheTool) {  // 13.19
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G91\nG51 X0 Y0 Z0 P2.\nG0 G45 X10. D1\nM30").path(), (Path{"rapid 22 0 0"}));
}

TEST(PositionOffset, MirroredWithItsBlock) {
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G51.1 X0\nG91 G0 G45 X10. D1\nM30").path(), (Path{"rapid -12 0 0"}));
}

TEST(PositionOffset, NotWhileCoordinatesAreRotated) {  // appendix 1, P141
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G68 X0 Y0 R30.\nG45 X10. D1\nM30").alarm, "P141");
}

TEST(PositionOffset, NumberMissingOrIllegalAndNoFeed) {
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G91 G0 G45 X10.\nM30").alarm, "P170");
  EXPECT_EQ(bench.run("G91 G0 G45 X10. D999\nM30").alarm, "P170");
  EXPECT_EQ(bench.run("G91 G0 G45 X10. D0\nM30").path(), (Path{"rapid 10 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G91 G1 G45 X10. D1\nM30").alarm, "P62");
}

// 12.6: "D omitted: the number previously stored in the memory is used".
TEST(PositionOffset, ABlockWithoutNumberTakesTheLastOneAlsoWhereItIsZero) {
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G0 G46 X10. D1\nG46 X20. D0\nG45 X30.\nM30").path(), (Path{"rapid 8 0 0", "rapid 20 0 0", "rapid 30 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("D0\nG0 G45 X30.\nM30").path(), (Path{"rapid 30 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G45 X30.\nM30").alarm, "P170");  // the reset has taken the number away
}

TEST(PositionOffset, RadiusCompensationWithoutNumberBehindD0StartsNothing) {
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G41 D0 G1 X10. F100\nG40 X0\nG41 G1 X10.\nY10.\nM30").path(),
            (Path{"line 10 0 0 F100", "line 0 0 0 F100", "line 10 0 0 F100", "line 10 10 0 F100"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("D0\nG1 G41 X10. I1. J1. K1. F100\nM30").path(), (Path{"line 10 0 0 F100"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G1 G41 X10. F100\nM30").alarm, "P170");
}

TEST(PositionOffset, WithoutAWordToMoveByItDoesNothing) {
  Bench bench;
  bench.tool(1, 2);
  for (const char* motion : {"G0", "G1", "G2"}) {
    const Outcome run = bench.run(std::string(motion) + " F100\nG45 D1\nG46\nM30");
    EXPECT_EQ(run.alarm, "") << motion;
    EXPECT_TRUE(run.moves().empty()) << motion;
  }
}

TEST(PositionOffset, LinesAndArcsOnly) {  // "the motion is that of G00 to G03"
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G33 F1.\nG45 Z-5. D1\nM30").alarm, "P34");
}

TEST(PositionOffset, AModalMacroComesBehindIt) {  // 13.5.1
  Bench bench;
  bench.tool(1, 2).add("O1", "#100=#100+1\nM99\n");
  EXPECT_EQ(bench.run("#100=0\nG66 P1\nG91 G0 G45 X10. D1\nG67\nM30").var(100), 1);
}

}  // namespace
}  // namespace nc::test
