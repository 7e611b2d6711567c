// SPDX-License-Identifier: Apache-2.0
// DGSHAPE 2-5: the feed of the rotary axis, which is commanded in mm/min and goes by the distance of the tool from the axis.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// The last move of a program on a machine with X Y Z and the rotary axis A, whose Z is up at 100.
nc_move last_move(const std::string& text) {
  Bench bench(NC_DIALECT_DGSHAPE, [](nc_config& config) {
    axes("XYZa")(config);
    config.system[0].axis[2].reference[0] = 100;
  });
  bench.tool(1, 4, NC_TOOL_LENGTH);
  const Outcome run = bench.run("%\n" + text + "\nM30");
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  return run.moves().empty() ? nc_move{} : run.moves().back();
}

TEST(DgshapeCycleBeside, AMotionDoesNotEndACycle) {  // 1-2, 2-7: other groups
  for (const char* codes : {"G00G99G81", "G99G81G00"})
    EXPECT_EQ(dgshape(std::string("M03S1000\n") + codes + "X1.Z-1.R1.F100.\nM30").path(), (Path{"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F100", "rapid 1 0 1"})) << codes;
}

TEST(Dgshape, TheUnitIsThatOfTheProgram) {  // 2-2, G20 G21
  const auto said = [](const std::string& text) {
    const Outcome run = Bench(NC_DIALECT_DGSHAPE).run("%\n" + text + "\nM02");
    return run.alarm.empty() ? run.alarm : run.alarm + " " + run.alarm_detail;
  };
  EXPECT_EQ(said("G20\nG01X1.F100.\nX2."), "");
  EXPECT_EQ(said("G21\nG90G21\nG01X1.F100.\nG21X2."), "");
  const std::string stays = "NC-MODE G20 is chosen at the head of the program, in front of movements and F: the unit stays.";
  EXPECT_EQ(said("G01X1.F100.\nG20\nX1."), stays);
  EXPECT_EQ(said("G21\nG20\nG00X1."), "");  // nothing has counted in it yet
  EXPECT_EQ(said("F100.\nG01X1.\nX2.\nG20X1."), stays);
  EXPECT_EQ(said("G00X1.\nG20"), stays);
  EXPECT_EQ(said("G10P1R2.5\nG20"), stays);
  EXPECT_EQ(said("G43H1\nG20"), stays);
  EXPECT_EQ(said("G40G49\nG20\nG00X1."), "");
  // Each program has its own.
  Bench bench(NC_DIALECT_DGSHAPE);
  EXPECT_EQ(bench.run("%\nG21G00X1.\nM02").alarm, "");
  EXPECT_EQ(bench.run("%\nG20G00X1.\nM02").alarm, "");
  // A plain line counts in the unit as well, with the F of a program before.
  EXPECT_EQ(bench.run("%\nG21F100.\nG01X1.\nM02").alarm, "");
  EXPECT_NE(bench.run("%\nG01X2.\nG20\nM02").alarm, "");
}

TEST(Dgshape, AnArcHasARadiusOrACentre) {  // 2-2, G02 G03: {[I][J] | R}
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nG02X10.Y0R7.I5.F100.\nM02").alarm, "NC-FORMAT");
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nG02X10.Y0R7.F100.\nM02").alarm, "");
}

TEST(Dgshape, ACycleEndsBesideEachFunction) {  // G80
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nG80G51X0Y0Z0P2.\nG00X10.\nM02").path().back(), "rapid 20 0 0");
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nM03S1000\nG51P2.G81X10.Z-1.R1.F100.\nM02").alarm, "NC-ADDRESS");
}

TEST(Dgshape, ACommentHasAnEnd) {  // 2-6: the text "between a ( and )"
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nG00X1. (open Y2.\nM02").alarm, "NC-FORMAT");
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("(title)\n%\n(first) G00X1. (second)\nM02").alarm, "");
}

TEST(Dgshape, TheSpindleTurnsOneWay) {
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nG81X1.Z-1.R1.F100.\nM02").alarm_detail, "The spindle has to turn. Program S and M03 before it.");
}

TEST(DgshapeRotary, FIsTheSpeedOfTheToolOnItsCircle) {
  // 10 mm from the axis: 100 mm/min are 10 rad/min.
  EXPECT_NEAR(last_move("G00Z10.\nG01A90.F100.").feed_mm_min, 10 / kDegree, 1e-9);
  EXPECT_NEAR(last_move("G00Y3.Z4.\nG01A-90.F100.").feed_mm_min, 20 / kDegree, 1e-9);  // from Y and Z
  EXPECT_NEAR(last_move("G00X50.Z10.\nG01A90.F100.").feed_mm_min, 10 / kDegree, 1e-9);  // whatever X is
  EXPECT_NEAR(last_move("G20\nG00Z1.\nG01A90.F1.").feed_mm_min, 1 / kDegree, 1e-9);     // inch per minute, an inch from the axis
  // The distance is that of the workpiece coordinates, and of the tip of the tool.
  EXPECT_NEAR(last_move("G10L2P1Z-10.\nG53Z0\nG01A90.F100.").feed_mm_min, 10 / kDegree, 1e-9);
  EXPECT_NEAR(last_move("G43H1Z10.\nG01A90.F100.").feed_mm_min, 10 / kDegree, 1e-9);
}

TEST(DgshapeRotary, TheSpeedIsThatAtTheStartOfTheBlock) {
  // Up by 20 while it turns: at the start F is what the tool goes at on the workpiece, straight and round together.
  const nc_move move = last_move("G00Z10.\nG01Z30.A180.F100.");
  const double round = 10 * std::numbers::pi, way = std::hypot(20, round);
  EXPECT_NEAR(move.feed_mm_min, 100 * 20 / way, 1e-9);  // along Z; the axis turns in the same time
  EXPECT_NEAR(last_move("G00Z10.\nG01A180.F100.").feed_mm_min, 10 / kDegree, 1e-9);
  EXPECT_NEAR(last_move("G00Z10.\nG01X5.Y3.F100.").feed_mm_min, 100, 1e-9);
}

TEST(DgshapeRotary, AtTheTopOfZItTurnsAsFastAsItCan) {
  EXPECT_EQ(last_move("G00Z100.\nG01A90.F100.").kind, NC_MOVE_RAPID);
  EXPECT_EQ(last_move("G28Z20.\nG01A90.F100.").kind, NC_MOVE_RAPID);
  EXPECT_EQ(last_move("G00Z99.\nG01A90.F100.").kind, NC_MOVE_LINE);
  EXPECT_EQ(last_move("G00Z100.\nG01X5.A90.F100.").feed_mm_min, 100);  // X goes at F
  EXPECT_EQ(last_move("G01A90.F100.").feed_mm_min, 100);               // on the axis no speed of the tool turns it: deg/min
}

TEST(Dgshape, TheCodeOfCompensationAloneWaitsForAMove) {  // G41: "actuated when a movement instruction is specified"
  const auto path = [](const std::string& text) {
    Bench bench(NC_DIALECT_DGSHAPE);
    bench.tool(1, 3, NC_TOOL_RADIUS);
    const Outcome run = bench.run("%\n" + text + "\nM02");
    EXPECT_EQ(run.alarm, "") << run.alarm_detail;
    return run.path();
  };
  EXPECT_EQ(path("G41D1\nG00X10.Y10.\nG01Y30.F50.\nX0\nG40X-20."), (Path{"rapid 7 10 0", "line 7 27 0 F50", "line 0 27 0 F50", "line -20 30 0 F50"}));
  EXPECT_EQ(path("G41D1\nG01Z-1.F50.\nX10.\nY20.").front(), "line 0 0 -1 F50");
}

TEST(Dgshape, AnInnerCornerOfADegreeOrLessHasTwoVectorsAtRightAngles) {  // G40 to G42, "Exceptions": the intersection lies 760 mm behind the start of the block
  Bench bench(NC_DIALECT_DGSHAPE);
  bench.tool(1, 2);
  const Outcome run = bench.run("%\nG90G21G17\nG01F100.G41D1X10.Y10.\nX40.Y10.\nX0.Y10.2\nG40X-10.Y0.\nM02");
  EXPECT_EQ(run.alarm, "");
  for (const nc_move& move : run.moves()) {
    EXPECT_GT(move.machine.v[0], -10.001);
    EXPECT_LT(move.machine.v[0], 40.001);
  }
}

TEST(Dgshape, TheCalculatorTypeOfTheDimensionsLeavesOutThePeck) {  // 1-5: IJKRXYZA
  const auto deepest = [](const char* words) {
    Bench bench(NC_DIALECT_DGSHAPE);
    bench.param("interpretation", "calculator").param("calculator_words", words);
    return bench.run("%\nM03S1000F100.\nG00Z10\nG99G83X1Z-7R1Q4000\nM02").path().at(3);
  };
  EXPECT_EQ(deepest("IJKRXYZA"), "line 1 0 -3 F100");
  EXPECT_EQ(deepest("all"), "line 1 0 -7 F100");
}

TEST(Dgshape, AReturnWithoutAnyPointMovesNothing) {  // G28
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).run("%\nG00X5.Y5.\nG28\nX6.\nM02").path(), (Path{"rapid 5 5 0", "rapid 6 5 0"}));
}

TEST(Dgshape, ACodeOfACycleHasTheDataOfItsBlock) {  // 2-2, G80 to G89
  const auto run = [](const std::string& text) { return dgshape("M03S6000F100.\nG00Z20.\nG99G82X1.Z-1.R1.P100\n" + text + "\nG80\nM30"); };
  EXPECT_EQ(run("X5.").dwells(), (std::vector<double>{0.1, 0.1}));  // behind the code they hold
  EXPECT_EQ(run("G86X5.Z-1.R1.").dwells(), (std::vector<double>{0.1}));
  EXPECT_EQ(run("G89X6.Z-1.R1.").dwells(), (std::vector<double>{0.1}));  // "when no P time is given, no dwell occurs"
  EXPECT_EQ(run("G86X5.Z-1.R1.P100").alarm, "NC-ADDRESS");
  const auto behind = [&](const std::string& text) {
    const Path path = run(text).path();
    return Path(path.begin() + 5, path.end());
  };
  EXPECT_EQ(behind("G81X2."), (Path{"rapid 2 0 1"}));  // without Z "no drilling is performed"
  EXPECT_EQ(behind("G81X2.Z-2."), (Path{"rapid 2 0 1", "rapid 2 0 20", "line 2 0 -2 F100", "rapid 2 0 20"}));  // without R "the same point as the initial level"
  EXPECT_EQ(run("G83X2.Z-2.R1.Q1.\nG83X3.Z-2.R1.").alarm, "NC-WORDS");
}

}  // namespace
}  // namespace nc::test
