// SPDX-License-Identifier: Apache-2.0
// Scaling G51 (M700 13.19) and coordinate rotation G68 (13.20), alone and together with other functions.
#include <gtest/gtest.h>

#include <cmath>

#include "support/pull.hpp"

namespace nc::test {
namespace {

double x_of(const Outcome& run, size_t move) {
  return run.moves().at(move).machine.v[0];
}
double y_of(const Outcome& run, size_t move) {
  return run.moves().at(move).machine.v[1];
}

TEST(Scaling, AxesWithACentreAndTheirArcs) {
  Bench bench;
  const Outcome run = bench.run(
      "G51 X10. Y-20. P1.5\nG0 X30. Y0 Z5.\nG3 X10. Y20. R20. F100\nG2 X30. Y0 J-20.\nG50\nG0 X30. Y0\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(),
            (Path{"rapid 40 10 5", "ccw 10 40 5 c10,10 F100", "cw 40 10 5 c10,10 F100", "rapid 30 0 5"}));
}

TEST(Scaling, FactorByPointByUnitAndByParameter) {
  Bench bench;
  EXPECT_EQ(bench.run("G51 X0 P1500000\nG0 X10.\nM30").path(), (Path{"rapid 15 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("#1=3\nG51 X0 P#1\nG0 X10.\nM30").path(), (Path{"rapid 30 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G51 X0\nG0 X10.\nM30").path(), (Path{"rapid 10 0 0"}));
  bench.param("8072", "2.5");
  EXPECT_EQ(bench.at(0, 0, 0).run("G51 X0\nG0 X10.\nM30").path(), (Path{"rapid 25 0 0"}));
  bench.param("8072", "100");
  EXPECT_EQ(bench.at(0, 0, 0).run("G51 X0\nG0 X10.\nM30").path(), (Path{"rapid 10 0 0"}));
  EXPECT_EQ(bench.run("G51 X0 P100.\nM30").alarm, "P35");
  EXPECT_EQ(bench.run("G51 X0 P100000000\nM30").alarm, "P35");
  EXPECT_EQ(bench.run("G51 X0 P0\nM30").alarm, "P35");
}

TEST(Scaling, IncrementsAndAnIncrementalCentre) {
  Bench bench;
  EXPECT_EQ(bench.run("G0 X10.\nG91 G51 X5. P2.\nG90 G0 X20.\nG91 X1.\nM30").path(),
            (Path{"rapid 10 0 0", "rapid 25 0 0", "rapid 27 0 0"}));
}

TEST(Scaling, CyclesAreScaledAlongTheDrillToo) {
  Bench bench;
  bench.at(0, 0, 20);
  const Outcome run = bench.run("G51 X0 Z0 P2.\nG98 G81 X10. Z-5. R2. F100\nG80\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 20 0 20", "rapid 20 0 4", "line 20 0 -10 F100", "rapid 20 0 20"}));
}

TEST(Scaling, OneAxisOfAnArcIsAnAlarm) {
  Bench bench;
  EXPECT_EQ(bench.run("G51 X0 P2.\nG2 X10. Y-10. J-10. F100\nM30").alarm, "P70");
  EXPECT_EQ(bench.run("G51 X0 P2.\nG2 X10. Y-10. R10. F100\nM30").alarm, "P70");
  EXPECT_EQ(bench.run("G51 X0 P2.\nG2.1 X10. Y-10. J-10. P1 F100\nM30").alarm, "P70");
}

TEST(Scaling, ReferenceReturnEndsIt) {
  Bench bench;
  const Outcome run = bench.run("G51 X0 Y0 P2.\nG28 X15. Y10.\nG0 X3.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 30 20 0", "rapid 0 0 0", "rapid 3 0 0"}));
  EXPECT_EQ(bench.at(5, 0, 0).run("G51 X5. P2.\nG27 X2.5\nG0 X3.\nM30").path(),
            (Path{"rapid 0 0 0", "rapid 3 0 0"}));
}

TEST(Scaling, TheCentreFollowsTheZero) {  // (6), relation (4)
  Bench bench;
  bench.work_offset(2, {100, 0, 0});
  EXPECT_EQ(bench.run("G51 X10. P2.\nG55 G0 X20.\nM30").path(), (Path{"rapid 130 0 0"}));
}

TEST(Scaling, AFigureHasItsCentreAndRadiusScaled) {  // relation (5)
  Bench bench;
  bench.add("O1", "G1 X10. Y0 F100\nX0 Y10.\nM99\n");
  const Outcome plain = bench.at(10, 0, 0).run("M98 P1 I-10. L4\nM30");
  const Outcome scaled = bench.at(20, 0, 0).run("G51 X0 Y0 P2.\nM98 P1 I-10. L4\nM30");
  EXPECT_EQ(plain.alarm, "");
  ASSERT_EQ(plain.moves().size(), scaled.moves().size());
  for (size_t i = 0; i < plain.moves().size(); ++i) {
    EXPECT_NEAR(x_of(scaled, i), 2 * x_of(plain, i), 1e-9) << i;
    EXPECT_NEAR(y_of(scaled, i), 2 * y_of(plain, i), 1e-9) << i;
  }
}

TEST(Scaling, Dgshape) {
  Bench bench(NC_DIALECT_DGSHAPE);
  EXPECT_EQ(bench.run("%\nG90 G21\nG51 X10. Y10. Z0 P2.5\nG0 X20. Y30. Z-4.\nG50\nX20.\nM02\n%\n").path(),
            (Path{"rapid 35 60 -10", "rapid 20 60 -10"}));
  // A centre that is not given is where the tool stands; the factor is held within 0.001 and 999.999.
  EXPECT_EQ(bench.at(10, 0, 0).run("%\nG51 Y0 P2.\nG0 X15. Z1.\nM02\n%\n").path(), (Path{"rapid 20 0 2"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nG51 X0 P5000.\nG0 X0.5\nM02\n%\n").path(),
            (Path{"rapid 499.9995 0 0"}));
  EXPECT_EQ(bench.run("%\nG51 X0\nM02\n%\n").alarm, "NC-WORDS");
  bench.tool(1, 1, NC_TOOL_RADIUS);
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nG41 D1\nG1 X10. F100\nG51 X0 P2.\nM02\n%\n").alarm, "NC-OFFSET-CODE");
}

TEST(Rotation, AbsoluteIncrementalAndTheModalAngle) {
  Bench bench;
  Outcome run = bench.run(
      "G68 X10. Y0 R90.\nG0 X20. Y0\nG91 X5.\nG90 G69\nG0 X0 Y0\nG68 X0 Y0\nG0 X1.\nG91 G68 R90.\nG90 G0 X1. "
      "Y0\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(),
            (Path{"rapid 10 10 0", "rapid 10 15 0", "rapid 0 0 0", "rapid 0 1 0", "rapid -1 2 0"}));
}

TEST(Rotation, ArcsTurnWithTheirCentre) {
  Bench bench;
  const Outcome run = bench.run("G68 X0 Y0 R90.\nG0 X10. Y0\nG3 X0 Y10. I-10. F100\nG2 X10. Y0 R10.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 0 10 0", "ccw -10 0 0 c0,0 F100", "cw 0 10 0 c0,0 F100"}));
}

TEST(Rotation, PrintedExample) {  // 13.20: the holes of the sub program, in the local system
  Bench bench;
  const Outcome run = bench.run(
      "G28 X0 Y0\nG54 G52 X200. Y100.\nG68 X-100. Y0 R60.\nM98 H101\nG69\nG54 G52 X0 Y0\nM2\nN101 G0 X-100. "
      "Y-40.\nG0 Y40.\nM99\n");
  ASSERT_EQ(run.alarm, "");
  ASSERT_EQ(run.moves().size(), 2u);
  EXPECT_NEAR(x_of(run, 0), 200 - 65.359, 1e-3);
  EXPECT_NEAR(y_of(run, 0), 100 - 20, 1e-3);
  EXPECT_NEAR(x_of(run, 1), 200 - 134.641, 1e-3);
  EXPECT_NEAR(y_of(run, 1), 100 + 20, 1e-3);
}

TEST(Rotation, TheCentreFollowsAnOffsetAndNothingElse) {  // (4), (5), (6)
  Bench bench;
  bench.work_offset(2, {100, 0, 0});
  EXPECT_EQ(bench.run("G68 X10. Y0 R90.\nG55 G0 X0 Y0\nM30").path(),
            (Path{"rapid 10 90 0"}));  // the machine's 10 is -90 of G55
  EXPECT_EQ(bench.at(0, 0, 0).run("G68 X10. Y0 R90.\nG10 L2 P1 X5.\nG0 X20. Y0\nM30").path(),
            (Path{"rapid 15 10 0"}));
  bench.work_offset(1, {0, 0, 0});
  EXPECT_EQ(bench.at(0, 0, 0).run("G68 X10. Y0 R90.\nG92 X50.\nG0 X60. Y0\nM30").path(),
            (Path{"rapid 10 0 0"}));
}

TEST(Rotation, CompensationIsThatOfTheTurnedPath) {
  Bench bench;
  bench.tool(1, 2);
  const Outcome run = bench.run("G68 X0 Y0 R90.\nG1 G41 D1 X20. Y0 F100\nX20. Y30.\nG40 X0 Y30.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path().at(1), "line -30 18 0 F100");  // unturned: X18 Y30
}

TEST(Rotation, MirrorIsAppliedBehindIt) {  // (10)
  Bench bench;
  EXPECT_EQ(bench.run("G51.1 X0\nG68 X0 Y0 R90.\nG0 X10. Y5.\nM30").path(), (Path{"rapid 5 10 0"}));
}

TEST(Rotation, ScalingInItHasItsCentreTurned) {  // 13.19, relation (7)
  Bench bench;
  EXPECT_EQ(bench.run("G68 X0 Y0 R90.\nG51 X10. Y0 P2.\nG0 X15. Y0\nM30").path(), (Path{"rapid 0 20 0"}));
}

TEST(Rotation, WhatIsRefused) {
  Bench bench;
  EXPECT_EQ(bench.run("G68 X0 Y0 R30.\nG18\nM30").alarm, "P111");
  for (const char* block : {"G4 X1. G68 X0 Y0 R5.", "G68 X0 Y0 R5. G4 X1.", "G51 X0 P2. G28 X0", "G51 G68 X0 Y0"})
    EXPECT_EQ(bench.run(std::string(block) + "\nM30").alarm, "P33") << block;
  EXPECT_EQ(bench.run("G17 G68 X0 Y0 R30.\nM30").alarm, "P111");
  EXPECT_EQ(bench.run("G68 X0 Y0 Z0 I1 J0 K0 R30.\nM30").alarm, "P920");
  EXPECT_EQ(bench.run("G68 X0 Y0 R30.\nG92.1 X0\nM30").alarm, "P34");
  bench.add("O1", "G68 X0 Y0 R30.\nM99\n");
  EXPECT_EQ(bench.run("M98 P1 I-10. L2\nM30").alarm, "P252");
}

TEST(Rotation, AnInterruptProgramGivesItBack) {  // 13.12: modal state is restored
  Bench bench;
  bench.add("O1000", "G69\nG50\nM99\n");
  bench.start("M96 P1000\nG68 X0 Y0 R90.\nG51 X0 Y0 P2.\nG0 X1.\nG0 X10. Y0\nM30");
  Path moved;
  Step step;
  for (nc_status status = NC_OK; (status = bench.pull(&step)) == NC_OK || status == NC_BUDGET;) {
    if (step.item.kind == NC_ITEM_MARK && step.item.source.line == 4 && step.item.source.depth == 0) {
      bool take_back = false;
      nc_interrupt_signal(bench.control(), 0, true, &take_back);
    }
    if (step.item.kind == NC_ITEM_MOVE)
      moved.push_back(brief(step.machine.v[0]) + " " + brief(step.machine.v[1]));
  }
  EXPECT_EQ(moved, (Path{"0 2", "0 20"}));
}

}  // namespace
}  // namespace nc::test
