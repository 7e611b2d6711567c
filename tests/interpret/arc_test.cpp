// SPDX-License-Identifier: Apache-2.0
// Circles and helices (M700 6.3-6.6, DGSHAPE G02/G03).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pull.hpp"

namespace nc::test {
namespace {

TEST(Arc, CentreForm) {
  EXPECT_EQ(m700("G2 X10. Y10. J10. F100\nM30").path(), (Path{"cw 10 10 0 c0,10 F100"}));
  EXPECT_EQ(m700("G3 X10. Y10. J10. F100\nM30").path(), (Path{"ccw 10 10 0 c0,10 F100"}));
  EXPECT_DOUBLE_EQ(m700("G3 X10. Y10. J10. F100\nM30").moves()[0].sweep_deg, 90);
  EXPECT_DOUBLE_EQ(m700("G91 G2 X50000 Y50000 J50000 F500\nM30").moves()[0].sweep_deg, -270);  // M700 6.4 example 2
  EXPECT_EQ(m700("G0 X5. Y5.\nG91 G2 X10. Y10. I10. F100\nM30").path()[1], "cw 15 15 0 c15,5 F100");  // I J always from the start
}

TEST(Arc, FullCircle) {  // M700 6.4: end omitted or equal to the start
  const Outcome run = m700("G02 J50000 F500\nM30");
  EXPECT_EQ(run.path(), (Path{"cw 0 0 0 c0,50 F500"}));
  EXPECT_DOUBLE_EQ(run.moves()[0].sweep_deg, -360);
  EXPECT_NEAR(run.moves()[0].length, 2 * std::numbers::pi * 50, 1e-9);
  EXPECT_DOUBLE_EQ(m700("G0 X3. Y4.\nG3 X3. Y4. I-3. J-4. F9\nM30").moves()[1].sweep_deg, 360);
}

TEST(Arc, RadiusForm) {  // M700 6.5
  EXPECT_EQ(m700("G2 X20. R10. F100\nM30").path(), (Path{"cw 20 0 0 c10,0 F100"}));
  const nc_move small = m700("G3 X10. Y10. R10. F100\nM30").moves()[0];
  EXPECT_NEAR(small.sweep_deg, 90, 1e-9);
  EXPECT_NEAR(small.center[0], 0, 1e-9);
  EXPECT_NEAR(small.center[1], 10, 1e-9);
  const nc_move large = m700("G3 X10. Y10. R-10. F100\nM30").moves()[0];
  EXPECT_NEAR(large.sweep_deg, 270, 1e-9);
  EXPECT_NEAR(large.center[0], 10, 1e-9);
  EXPECT_NEAR(large.center[1], 0, 1e-9);
  EXPECT_NEAR(m700("G2 X10. Y10. R-10. F100\nM30").moves()[0].sweep_deg, -270, 1e-9);
}

TEST(Arc, RadiusWinsOverCentre) {  // M700 6.5
  EXPECT_EQ(m700("G2 X20. R10. I3. J7. F100\nM30").path(), (Path{"cw 20 0 0 c10,0 F100"}));
}

TEST(Arc, RadiusFormThatIsComplete) {  // M700 6.5: start = end, nothing moves
  const Outcome run = m700("G2 R10. F100\nG17 G02 I1. J1. R5.\nM30");
  EXPECT_EQ(run.path(), Path{});
  EXPECT_EQ(run.alarm, "");
}

TEST(Arc, RadiusTooSmall) {
  const Outcome run = m700("G1 X0 F100\nG2 X20. R9.\nM30");
  EXPECT_EQ(run.alarm, "P71");  // M700 6.5
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_TRUE(run.moves().empty());
  EXPECT_EQ(m700("G2 X20. R9.95 F1\nM30").alarm, "");   // within #1084: half the chord - r = 0.05
  EXPECT_EQ(m700("G2 X20. R9.89 F1\nM30").alarm, "P71");
  EXPECT_EQ(m700("G2 X20. R0 F1\nM30").alarm, "P71");
}

TEST(Arc, EndOffTheCircle) {  // M700 6.4, the printed pair
  EXPECT_EQ(m700("G2 X9.899 I5. F100\nM30").alarm, "P70");
  const Outcome run = m700("G2 X9.9 I5. F100\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"cw 9.9 0 0 c5,0 F100"}));
  EXPECT_EQ(Bench().param("1084", "0.2").run("G2 X9.85 I5. F100\nM30").alarm, "");
  EXPECT_EQ(Bench().param("1084", "0.01").run("G2 X9.9 I5. F100\nM30").alarm, "P70");
  EXPECT_EQ(m700("G2 X10. F100\nM30").alarm, "P70");  // no centre at all
}

TEST(Arc, PlanesAndTheirDirections) {  // M700 6.4: seen from the + side of the third axis
  // G18: Z is the first, X the second axis; from Z1 to X1 is counter-clockwise seen from +Y.
  EXPECT_EQ(m700("G0 Z10.\nG18 G3 X10. Z0 K-10. F100\nM30").path()[1], "ccw 10 0 0 c0,0 F100");
  EXPECT_NEAR(m700("G0 Z10.\nG18 G3 X10. Z0 K-10. F100\nM30").moves()[1].sweep_deg, 90, 1e-9);
  EXPECT_NEAR(m700("G0 Z10.\nG18 G2 X10. Z0 K-10. F100\nM30").moves()[1].sweep_deg, -270, 1e-9);
  EXPECT_NEAR(m700("G0 Y10.\nG19 G3 Y0 Z10. J-10. F100\nM30").moves()[1].sweep_deg, 90, 1e-9);
  EXPECT_EQ(m700("G0 Y10.\nG19 G3 Y0 Z10. J-10. F100\nM30").moves()[1].plane, NC_PLANE_YZ);
  const nc_move zx = m700("G18 G2 X20. R10. F100\nM30").moves()[0];
  EXPECT_EQ(zx.plane, NC_PLANE_ZX);
  EXPECT_EQ(zx.plane_axis[0], 2);  // Z first
  EXPECT_EQ(zx.plane_axis[1], 0);
}

TEST(Arc, WordsOfTheOtherPlaneDoNotCount) {  // M700 6.6 example 5: J ignored in G18
  EXPECT_EQ(m700("G18 G2 X10. Z10. I10. J99. F100\nM30").path(), (Path{"cw 10 0 10 c0,10 F100"}));
}

TEST(Arc, PlaneThatTheAxesDoNotHave) {
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XZ")).run("G2 X10. I5. F100\nM30").alarm, "P113");
  EXPECT_EQ(Bench().run("G17 G2 Z10. K5. F100\nM30").alarm, "P113");  // G18 or G19 has been forgotten
}

TEST(Helix, OtherAxesGoAlong) {  // M700 6.6
  const Outcome run = m700("G3 X-10. Y10. I-10. Z5. F100\nM30");
  ASSERT_EQ(run.moves().size(), 1u);
  EXPECT_EQ(run.moves()[0].kind, NC_MOVE_HELIX);
  EXPECT_EQ(run.path(), (Path{"ccw -10 10 5 c-10,0 F100"}));
  EXPECT_NEAR(run.moves()[0].length, std::hypot(10 * std::numbers::pi / 2, 5), 1e-9);
  EXPECT_EQ(m700("G2 I-10. Z-3. F100\nM30").moves()[0].sweep_deg, -360);  // a full turn with Z
  EXPECT_EQ(m700("G2 X20. Z5. R10. F100\nM30").path(), (Path{"cw 20 0 5 c10,0 F100"}));
}

TEST(Helix, TurnsAreExtra) {  // M700 6.6: total turn = 2 pi P + theta
  const nc_move move = m700("G3 X-10. Y10. I-10. Z5. P2 F100\nM30").moves()[0];
  EXPECT_EQ(move.turns, 2u);
  EXPECT_NEAR(move.sweep_deg, 90 + 720, 1e-9);
  EXPECT_EQ(m700("G3 X-10. Y10. I-10. P0 F100\nM30").moves()[0].turns, 0u);
  // theta of a closed arc is 0: the sine of 6.16 in the manual has two periods with P2
  EXPECT_EQ(m700("G2 X0 Y0 Z40. J-10. P2 F100\nM30").moves()[0].sweep_deg, -720);
  EXPECT_EQ(m700("G3 J-10. Z40. P1 F100\nM30").moves()[0].sweep_deg, 360);
  EXPECT_EQ(m700("G3 J-10. Z40. P0 F100\nM30").moves()[0].sweep_deg, 360);  // 6.4
  EXPECT_EQ(m700("G3 X10. Y10. R10. P1 F100\nM30").alarm, "P33");  // P is not allowed with R
  EXPECT_EQ(m700("G3 X-10. Y10. I-10. P10000 F100\nM30").alarm, "P35");
}

TEST(Helix, RotaryAxisGoesAlong) {
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZc")).run("G2 X20. I10. C90. F100\nM30").path(), (Path{"cw 20 0 0 90 c10,0 F100"}));
}

TEST(Arc, FeedIsNeeded) {
  const Outcome run = m700("G2 X10. I5.\nM30");
  EXPECT_EQ(run.alarm, "P62");
  EXPECT_EQ(run.alarm_line, 1u);
}

TEST(Arc, TheCentreMovesWithTheCoordinates) {
  Bench bench;
  bench.work_offset(1, {100, 50, 0});
  const Outcome run = bench.run("G0 X0 Y0\nG2 X10. Y10. J10. F100\nM30");
  EXPECT_EQ(run.path()[1], "cw 110 60 0 c100,60 F100");
  EXPECT_EQ(run.work()[1], "cw 10 10 0 c0,10 F100");
}

TEST(Arc, OfALinearAndARotaryAxis) {  // M700 6.3; 3.2 note 5: in inch a degree would count as a tenth of an inch
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1030", "C");
  const Outcome metric = bench.run("G17 G0 X0 C0\nG91 G2 X10. C10. R10. F10\nM30");
  EXPECT_EQ(metric.alarm, "");
  EXPECT_EQ(metric.moves()[0].plane_axis[1], 3);
  EXPECT_EQ(bench.tool(1, 2).at(0, 0, 0).run("G20 G17 G0 X0 C0\nG41 D1 G1 X0.5 F10\nG91 G2 X1. C10. R1.\nM30").alarm, "P39");
  EXPECT_EQ(bench.at(0, 0, 0).run("G20 G17 G0 X0 Y0\nG91 G2 X1. Y1. R1. F10\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("G20 G17 G0 X0 Y0\nG91 G2 X1. Y1. C90. R1. F10\nM30").alarm, "");
}

TEST(Arc, OfALinearAndARotaryAxisInInch) {  // M700 3.2 note 5
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1030", "C");
  const Outcome run = bench.run("G20 G17 G0 X0 C0\nG91 G3 X1. C10. J10. F10.\nG1 C5.\nG90 G3 X0 C15. R0.5\nM30");
  ASSERT_EQ(run.alarm, "");
  const auto moves = run.moves();
  ASSERT_EQ(moves.size(), 3u);
  // A quarter of a circle of an inch, whose centre lies ten degrees beside its start.
  EXPECT_NEAR(moves[0].radius, 25.4, 1e-9);
  EXPECT_NEAR(moves[0].length, 25.4 * std::numbers::pi / 2, 1e-6);
  EXPECT_NEAR(moves[0].center[0], 0, 1e-9);
  EXPECT_NEAR(moves[0].center[1], 10, 1e-9);
  EXPECT_NEAR(moves[0].machine.v[0], 25.4, 1e-9);
  EXPECT_NEAR(moves[0].machine.v[3], 10, 1e-9);
  EXPECT_NEAR(moves[0].feed_mm_min, 254, 1e-9);
  EXPECT_NEAR(moves[0].work.v[3], 10, 1e-9);
  // The block behind it is an ordinary one.
  EXPECT_EQ(moves[1].kind, NC_MOVE_LINE);
  EXPECT_NEAR(moves[1].machine.v[3], 15, 1e-9);
  EXPECT_NEAR(moves[1].feed_mm_min, 100, 1e-9);  // note 6
  EXPECT_NEAR(moves[2].radius, 12.7, 1e-9);  // half a turn back in X; C stays
  EXPECT_NEAR(moves[2].machine.v[3], 15, 1e-9);
  EXPECT_NEAR(moves[2].length, 12.7 * std::numbers::pi, 1e-6);
}

// M700 3.2, format: the centre word of a rotary axis has the digits of degrees in inch as well, that of the linear axis those of inches.
TEST(Arc, CentreWordsOfARotaryAxisAreDegrees) {
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1030", "C");
  const auto centre = [&bench](const char* words) {
    const Outcome run = bench.at(0, 0, 0).run("G20 G17 G0 X0 C0\nG90 G3 " + std::string(words) + " F10.\nM30");
    EXPECT_EQ(run.alarm, "") << words;
    return run.moves().empty() ? std::vector<double>{} : std::vector<double>{run.moves().back().center[0], run.moves().back().center[1]};
  };
  const auto near = [](const std::vector<double>& at, double x, double c) { return at.size() == 2 && std::fabs(at[0] - x) < 1e-9 && std::fabs(at[1] - c) < 1e-9; };
  EXPECT_TRUE(near(centre("X1. C10. J10."), 0, 10));
  EXPECT_TRUE(near(centre("X1. C10. J10000"), 0, 10));  // 0.001 deg
  EXPECT_TRUE(near(centre("X2. C0 I1."), 25.4, 0));
  Bench two(NC_DIALECT_M700, axes("XYZbc"));  // both axes turn: an arc of degrees
  two.param("1029", "B").param("1030", "C");
  const Outcome run = two.run("G20 G17 G0 B0 C0\nG17 B0 C0\nG90 G3 B10. C10. J10. F10.\nM30");
  EXPECT_EQ(run.alarm, "");
  ASSERT_EQ(run.moves().size(), 1u);
  EXPECT_NEAR(run.moves()[0].radius, 10, 1e-9);
}

TEST(Arc, TogetherWithLengthCompensation) {  // M700 App.2
  EXPECT_EQ(m700("G2 X10. I5. G43 H1 F100\nM30").alarm, "P70");
  EXPECT_EQ(m700("G2 X10. I5. F100\nX0 I-5. G44 H1\nM30").alarm, "P70");
}

TEST(DgshapeArc, BothForms) {  // DGSHAPE G02/G03
  EXPECT_EQ(dgshape("G2X10000Y10000J10000F60000\nM02").path(), (Path{"cw 10 10 0 c0,10 F60"}));
  EXPECT_EQ(dgshape("G91G3X10000Y10000J10000F60000\nM02").path(), (Path{"ccw 10 10 0 c0,10 F60"}));
  EXPECT_EQ(dgshape("G3I5000F60000\nM02").moves()[0].sweep_deg, 360);
  EXPECT_NEAR(dgshape("G3X10000Y10000R-10000F60000\nM02").moves()[0].sweep_deg, 270, 1e-9);
  EXPECT_EQ(dgshape("G3X-10000Y10000Z5000I-10000F60000\nM02").moves()[0].kind, NC_MOVE_HELIX);
  EXPECT_EQ(dgshape("G2X20000R9000F60000\nM02").alarm, "NC-ARC");
}

TEST(DgshapeArc, TheRotaryAxisCannotTakePart) {
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE, axes("XYZa")).run("%\nG2X20000I10000A5000F60000\nM02").alarm, "NC-AXIS");
}

}  // namespace
}  // namespace nc::test
