// SPDX-License-Identifier: Apache-2.0
// Moves, feed, exact stop, dwell, skip, reference return (M700 6.1, 6.2, 7, 8.1, 12.2, 14.4, 14.7, 15.2).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

TEST(Motion, PowerOnIsLinear) {  // M700 appendix 1, P62
  EXPECT_EQ(m700("X10.\nM30").alarm, "P62");
  EXPECT_EQ(m700("X10. F50\nM30").path(), (Path{"line 10 0 0 F50"}));
  EXPECT_EQ(m700("F50\nX10.\nM30").path(), (Path{"line 10 0 0 F50"}));
  EXPECT_EQ(dgshape("X10000\nM02").path(), (Path{"rapid 10 0 0"}));
}

TEST(Motion, GroupOneIsModal) {
  EXPECT_EQ(m700("G0 X1.\nX2.\nG1 X3. F5\nX4.\nG X5.\nM30").path(),
            (Path{"rapid 1 0 0", "rapid 2 0 0", "line 3 0 0 F5", "line 4 0 0 F5", "rapid 5 0 0"}));
}

TEST(Motion, NothingIsCommittedForNoLength) {
  const Outcome run = m700("G0 X0\nG91 X0 Y0\nG1 X1. F1\nX0\nM30");
  EXPECT_EQ(run.path(), (Path{"line 1 0 0 F1"}));
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{1, 2, 3, 4, 5}));
}

TEST(Motion, FeedZeroIsNoFeed) { EXPECT_EQ(m700("G1 X1. F0\nM30").alarm, "P62"); }

TEST(Motion, VectorOfCompensationIsAMovementOfItsBlock) {  // M700 12.4.3: it takes the feed of G1, and none in G0
  const auto run = [](const char* program) { return Bench(NC_DIALECT_M700).tool(1, 2).run(program); };
  EXPECT_EQ(run("F100\nG41 D1 I-20.\nM30").path(), (Path{"line 0 -2 0 F100"}));
  EXPECT_EQ(run("G0\nG41 D1 I-20.\nM30").path(), (Path{"rapid 0 -2 0"}));
  const Outcome no_feed = run("G1 F0\nG41 D1 I-20.\nM30");
  EXPECT_EQ(no_feed.alarm, "P62");
  EXPECT_EQ(no_feed.alarm_line, 2u);
  EXPECT_TRUE(no_feed.path().empty());
  EXPECT_EQ(run("G1 F0\nG41 D1\nM30").alarm, "");  // without a vector nothing moves
}

TEST(Motion, ExactStop) {  // M700 7.7, 7.8
  std::vector<bool> stops;
  for (const nc_move& m : m700("G1 X1. F1\nG9 X2.\nX3.\nG61 X4.\nG2 X6. I1.\nG64 X8. I1.\nG0 X9.\nM30").moves()) stops.push_back(m.exact_stop);
  EXPECT_EQ(stops, (std::vector<bool>{false, true, false, true, true, false, true}));
}

TEST(Motion, FiveAxesAtOnce) {
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZac")).run("G1 X1. Y2. Z3. A4. C5. F9\nM30").path(), (Path{"line 1 2 3 4 5 F9"}));
}

TEST(Motion, LengthOfAMoveIsThatOfItsLinearAxes) {
  EXPECT_DOUBLE_EQ(m700("G1 X3. Y4. F9\nM30").moves()[0].length, 5);
  EXPECT_DOUBLE_EQ(Bench(NC_DIALECT_M700, axes("XYZc")).run("G1 C90. F9\nM30").moves()[0].length, 90);
}

// ---- dwell ---------------------------------------------------------------------------------------------------------------

struct DwellRow {
  const char* words;
  double seconds[4];  ///< #1078/#8112 = 0/0, 0/1, 1/0, 1/1
};

TEST(Dwell, TheTableOfTheManual) {  // M700 8.1
  const DwellRow rows[] = {{"X500", {0.5, 0.5, 500, 500}},      {"X5000", {5, 5, 5000, 5000}},      {"X5.", {5, 5, 5, 5}},
                           {"X#100", {1000, 1000, 1000, 1000}}, {"P5000", {5, 5, 5, 5000}},         {"P12.345", {0.012, 12.345, 0.012, 12.345}},
                           {"P#100", {1, 1000, 1, 1000}}};
  for (const DwellRow& row : rows) {
    for (unsigned i = 0; i < 4; ++i) {
      Bench bench;
      bench.param("1078", i >= 2 ? "1" : "0").param("8112", i % 2 != 0 ? "1" : "0");
      const Outcome run = bench.run(std::string("#100=1000\nG04 ") + row.words + "\nM30");
      ASSERT_EQ(run.dwells().size(), 1u) << row.words;
      EXPECT_DOUBLE_EQ(run.dwells()[0], row.seconds[i]) << row.words << " column " << i;
      EXPECT_EQ(run.path(), Path{});  // X does not move
    }
  }
}

TEST(Dwell, RangeAndWords) {
  EXPECT_EQ(m700("G4 X99999.999\nM30").dwells(), std::vector<double>{99999.999});
  EXPECT_EQ(m700("G4 X100000.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G4 X-1.\nM30").alarm, "P35");
  EXPECT_EQ(Bench().param("UNIT*10", "10").run("G4 X500\nM30").dwells(), std::vector<double>{0.5});  // M700 2.2
}

TEST(Dwell, UpdatesTheGroupOneModal) {  // M700 App.2
  EXPECT_EQ(m700("G0 G4 X1.\nX5.\nM30").path(), (Path{"rapid 5 0 0"}));
}

TEST(Dwell, Dgshape) {  // DGSHAPE G04
  EXPECT_EQ(dgshape("G4X1500\nG4X1.5\nG4P1500\nM02").dwells(), (std::vector<double>{1.5, 1.5, 1.5}));
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE).param("interpretation", "calculator").run("%\nG4X2\nG4P2\nM02").dwells(), (std::vector<double>{2, 0.002}));
  EXPECT_EQ(dgshape("G4X3600.\nM02").alarm, "");
  EXPECT_EQ(dgshape("G4X3601.\nM02").alarm, "NC-RANGE");
  EXPECT_EQ(dgshape("G4X1.G0\nM02").alarm, "NC-ALONE");
}

// ---- skip ----------------------------------------------------------------------------------------------------------------

TEST(Skip, WithoutASignalItEndsAtItsEnd) {  // M700 15.2
  const Outcome run = m700("G1 F500\nG31 X10. Z-5. F100\nX0\n#100=#5061 #101=#5062 #102=#5063\nM30");
  EXPECT_EQ(run.path(), (Path{"skip 10 0 -5 F100", "line 0 0 -5 F500"}));  // F of the block is not modal
  EXPECT_EQ(run.var(100), 10);
  EXPECT_EQ(run.var(101), 0);
  EXPECT_EQ(run.var(102), -5);
}

TEST(Skip, TheSignalEndsTheMove) {
  Bench bench;
  bench.work_offset(1, {1, 2, 0});
  bench.skip_at = [](const nc_item&) { return 0.25; };
  const Outcome run = bench.run("G31 X41. Z-20. F100\n#100=#5061 #101=#5063\nG91 G1 Z1. F50\nM30");
  EXPECT_EQ(run.path(), (Path{"skip 42 0 -20 F100", "line 10.5 0 -4 F50"}));  // the next block goes on from where it ended
  EXPECT_DOUBLE_EQ(run.var(100), 9.5);  // workpiece coordinates
  EXPECT_DOUBLE_EQ(run.var(101), -5);
}

TEST(Skip, AxesThatAreNotNamedKeepTheirValue) {  // M700 13.5.5 (10.11), the printed example 2
  const Outcome run = m700("G31 X-10. F100\nG31 Z-5. F100\n#100=#5061 #101=#5063\nM30");
  EXPECT_EQ(run.var(100), -10);
  EXPECT_EQ(run.var(101), -5);
  // Also when the axis has moved on since, and where the skip has no way.
  const Outcome later = m700("G90 G31 X5. Y6. F100\nG0 X0 Y0\nG31 X9. F100\n#100=#5061 #101=#5062\nG31 X9. F100\n#102=#5061 #103=#5062\nM30");
  EXPECT_EQ(later.var(100), 9);
  EXPECT_EQ(later.var(101), 6);
  EXPECT_EQ(later.var(102), 9);
  EXPECT_EQ(later.var(103), 6);
  // A rotation moves the axis that the block does not name, and so it has a new place.
  const Outcome turned = m700("G31 X5. Y6. F100\nG0 X0 Y0\nG68 X0 Y0 R30.\nG31 X10. F100\n#100=#5061 #101=#5062\nM30");
  EXPECT_EQ(turned.var(100), 8.66);
  EXPECT_EQ(turned.var(101), 5);
  // HX 14.2.3 (7): the place of all axes.
  Bench hx(NC_DIALECT_HX);
  EXPECT_EQ(hx.run("G90 G31 X5. Y6. F100\nG0 X0 Y0\nG31 X9. F100\n#100=#6319 #101=#6320\nM30").var(101), 0);
}

TEST(Skip, FeedSignalsAndAlarms) {
  EXPECT_EQ(m700("G31 X10.\nM30").alarm, "P603");
  EXPECT_EQ(m700("G1 F100\nG31 X10.\nM30").alarm, "P603");  // the modal feed is not used
  EXPECT_EQ(Bench().param("1174", "77").run("G31 X10.\nM30").path(), (Path{"skip 10 0 0 F77"}));
  EXPECT_EQ(m700("G31 X10. F1\nM30").moves()[0].skip_mask, 1);
  EXPECT_EQ(m700("G31 X10. P5 F1\nM30").moves()[0].skip_mask, 5);  // M700 15.4
  EXPECT_EQ(m700("G31 X10. P0 F1\nM30").alarm, "P35");
  EXPECT_EQ(m700("G31 X10. P256 F1\nM30").alarm, "P35");
  EXPECT_EQ(m700("G41 D1 G1 X1. F9\nG31 X10. F1\nM30").alarm, "P608");
}

TEST(Skip, NothingToGoAsksNobody) {
  const Outcome run = m700("G31 X0 F100\n#100=#5061\nM30");
  EXPECT_TRUE(run.of(NC_ITEM_SYNC).empty());
  EXPECT_EQ(run.var(100), 0);
}

TEST(Skip, MeasuresALength) {  // M700 10.1 example: #10001=#5063-#1
  Bench bench;
  bench.skip_at = [](const nc_item&) { return 0.5; };
  bench.run("G0 Z-500.\n#1=#5003\nG91 G31 Z-100. F100\n#10001=#5063-#1\nM30");
  EXPECT_DOUBLE_EQ(bench.tool_now(1), -50);
}

// ---- reference return, machine coordinates -----------------------------------------------------------------------------------

std::function<void(nc_config&)> with_reference(double x, double y, double z) {
  return [=](nc_config& config) {
    config.system[0].axis[0].reference[0] = x;
    config.system[0].axis[1].reference[0] = y;
    config.system[0].axis[2].reference[0] = z;
  };
}

TEST(ReferenceReturn, ThroughTheIntermediatePoint) {  // M700 14.7
  Bench bench(NC_DIALECT_M700, with_reference(100, 200, 300));
  bench.work_offset(1, {-10, 0, 0});
  EXPECT_EQ(bench.run("G28 X50. Z20.\nM30").path(), (Path{"rapid 40 0 20", "rapid 100 0 300"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G91 G28 Z5.\nM30").path(), (Path{"rapid 0 0 5", "rapid 0 0 300"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G91 G28 XYZ\nM30").path(), (Path{"rapid 100 200 300"}));  // words without a value are 0
  EXPECT_EQ(bench.at(0, 0, 0).run("G28\nM30").alarm, "P33");
}

TEST(ReferenceReturn, KeepsTheGroupOneModal) {
  EXPECT_EQ(m700("G1 F9\nG28 X5.\nX2.\nG0 G28 X5.\nX1.\nM30").path(),
            (Path{"rapid 5 0 0", "rapid 0 0 0", "line 2 0 0 F9", "rapid 5 0 0", "rapid 0 0 0", "rapid 1 0 0"}));
}

TEST(ReferenceReturn, CancelsTheLengthCompensationOfItsAxis) {  // M700 12.2, 14.7
  Bench bench(NC_DIALECT_M700, with_reference(0, 0, 100));
  bench.tool(1, 10);
  const Outcome run = bench.run("G43 H1 G0 Z5.\nG28 Z20.\nZ5.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 15", "rapid 0 0 30", "rapid 0 0 100", "rapid 0 0 5"}));
  EXPECT_EQ(run.last_modal().code[8], 490);
  // Not when another axis returns.
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H1 G0 Z5.\nG28 X20.\nZ7.\nM30").path().back(), "rapid 0 0 17");
  // G49 in the same block acts first.
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H1 G0 Z5.\nG49 G28 Z20.\nM30").path(), (Path{"rapid 0 0 15", "rapid 0 0 20", "rapid 0 0 100"}));
}

TEST(DgshapeReferenceReturn, RemembersMidpoints) {  // DGSHAPE G28, the printed example
  Bench bench(NC_DIALECT_DGSHAPE, with_reference(1, 2, 3));
  EXPECT_EQ(bench.run("%\nG28X15000\nG28Y30000\nM02").path(), (Path{"rapid 15 0 0", "rapid 1 0 0", "rapid 15 30 0", "rapid 1 2 0"}));
  // Only within a program.
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nG28Y30000\nM02").path(), (Path{"rapid 0 30 0", "rapid 0 2 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nG28G91Z0\nM02").path(), (Path{"rapid 0 0 3"}));
}

TEST(DgshapeReferenceReturn, WhatCannotTakePart) {
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE, axes("XYZa")).run("%\nG28A1000\nM02").alarm, "NC-AXIS");
  EXPECT_EQ(dgshape("G10P1R3000\nG41D1G1X5000F60000\nG28Z0\nM02").alarm, "NC-OFFSET-CODE");
}

TEST(MachineMove, AbsoluteInMachineCoordinates) {  // M700 14.4
  Bench bench;
  bench.work_offset(1, {10, 20, 30}).tool(1, 5);
  const Outcome run = bench.run("G43 H1 G0 Z0\nG1 F9\nG53 Z0 X1.\nX0\nZ0\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 35", "rapid 1 0 0", "line 10 0 0 F9", "line 10 0 35 F9"}));
}

TEST(MachineMove, IncrementalIsAPlainMove) {
  EXPECT_EQ(m700("G0 X5.\nG91 G53 X10.\nM30").path(), (Path{"rapid 5 0 0", "rapid 15 0 0"}));
}

TEST(MachineMove, WithReferenceReturnTheLaterOneCounts) {  // M700 14.4
  EXPECT_EQ(m700("G53 G28 X5.\nM30").path(), (Path{"rapid 5 0 0", "rapid 0 0 0"}));
  EXPECT_EQ(m700("G28 G53 X5.\nM30").path(), (Path{"rapid 5 0 0"}));
}

TEST(DgshapeMachineMove, NotInIncremental) {  // DGSHAPE G53
  EXPECT_EQ(dgshape("G53X5000\nM02").path(), (Path{"rapid 5 0 0"}));
  EXPECT_EQ(dgshape("G91G53X5000\nM02").alarm, "NC-INCREMENTAL");
  EXPECT_EQ(dgshape("G91\nG53X5000\nM02").alarm, "NC-INCREMENTAL");
}

// ---- stroke limits -------------------------------------------------------------------------------------------------------------

TEST(StrokeLimit, StopsBeforeTheMove) {
  auto limits = [](nc_config& config) {
    config.system[0].axis[0].soft_limited = true;
    config.system[0].axis[0].soft_min = -50;
    config.system[0].axis[0].soft_max = 50;
  };
  Bench bench(NC_DIALECT_M700, limits);
  Outcome run = bench.run("G0 X40.\n#100=1\nG1 X51. F9\n#100=2\nM30");
  EXPECT_EQ(run.alarm, "M01-0007");
  EXPECT_EQ(run.alarm_line, 3u);
  EXPECT_EQ(run.path(), (Path{"rapid 40 0 0"}));
  EXPECT_EQ(run.end_work.v[0], 40);  // the machine stands where the last block ended
  EXPECT_EQ(run.var(100), 1);
  // The whole arc counts, not only its end.
  run = bench.at(45, 0, 0).run("G3 X45. Y20. J10. F9\nM30");
  EXPECT_EQ(run.alarm, "M01-0007");
  EXPECT_EQ(bench.at(45, 0, 0).run("G2 X45. Y20. J10. F9\nM30").alarm, "");
  // A place on the limit is inside; from outside an axis may come back.
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 X50.\nM30").alarm, "");
  EXPECT_EQ(bench.at(60, 0, 0).run("G0 X55.\nM30").alarm, "");
  EXPECT_EQ(bench.at(60, 0, 0).run("G0 X61.\nM30").alarm, "M01-0007");
}

}  // namespace
}  // namespace nc::test
