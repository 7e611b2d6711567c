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
