// SPDX-License-Identifier: Apache-2.0
// Standard fixed cycles (M700 13.1, DGSHAPE G80-G89).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// Moves, dwells and places at which single block may stop: "line 0 0 -5 F100", "dwell 0.5", "stop", "end" (a stop at the end of a block).
Path steps(const Outcome& run) {
  Path all;
  size_t next_move = 0;
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    if (step.item.kind == NC_ITEM_MOVE) all.push_back(moves[next_move++]);
    if (step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + brief(step.item.u.gate.value));
    if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.stop) all.push_back(step.item.u.mark.report ? "end" : "stop");
  }
  return all;
}

Outcome at_ten(const std::string& text) { return Bench().at(0, 0, 10).run(text); }

TEST(Cycle, DrillG81) {  // M700 13.1.1
  EXPECT_EQ(at_ten("G81 X5. Y6. Z-8. R2. F100\nG80\nM30").path(),
            (Path{"rapid 5 6 10", "rapid 5 6 2", "line 5 6 -8 F100", "rapid 5 6 10"}));
  EXPECT_EQ(at_ten("G99 G81 X5. Z-8. R2. F100\nX7.\nG98 X9.\nG80\nM30").path(),
            (Path{"rapid 5 0 10", "rapid 5 0 2", "line 5 0 -8 F100", "rapid 5 0 2", "rapid 7 0 2", "line 7 0 -8 F100", "rapid 7 0 2", "rapid 9 0 2",
                  "line 9 0 -8 F100", "rapid 9 0 10"}));
}

TEST(Cycle, SpotG82Dwells) {
  EXPECT_EQ(steps(at_ten("G82 X5. Z-8. R2. P500 F100\nM30")),
            (Path{"rapid 5 0 10", "stop", "rapid 5 0 2", "stop", "line 5 0 -8 F100", "dwell 0.5", "rapid 5 0 10", "end"}));
  EXPECT_EQ(at_ten("G82 X5. Z-8. R2. P500.9 F100\nM30").dwells(), std::vector<double>{0.5});  // decimals of P are ignored
}

TEST(Cycle, PeckG83) {  // M700 13.1.1 with m = #8013
  Bench bench;
  bench.param("8013", "0.5").at(0, 0, 10);
  EXPECT_EQ(bench.run("G83 X5. Z-7. R2. Q4. F100\nM30").path(),
            (Path{"rapid 5 0 10", "rapid 5 0 2", "line 5 0 -2 F100", "rapid 5 0 2", "rapid 5 0 -1.5", "line 5 0 -6 F100", "rapid 5 0 2",
                  "rapid 5 0 -5.5", "line 5 0 -7 F100", "rapid 5 0 10"}));
  // A whole number of pecks ends at the bottom without a further one.
  EXPECT_EQ(bench.at(0, 0, 10).run("G99 G83 Z-6. R2. Q4. F100\nM30").path(),
            (Path{"rapid 0 0 2", "line 0 0 -2 F100", "rapid 0 0 2", "rapid 0 0 -1.5", "line 0 0 -6 F100", "rapid 0 0 2"}));
}

TEST(Cycle, StepG73) {  // M700 13.1.1 with m = #8012
  Bench bench;
  bench.param("8012", "1").at(0, 0, 10);
  EXPECT_EQ(steps(bench.run("G73 Z-7. R2. Q4. P100 F100\nM30")),
            (Path{"stop", "rapid 0 0 2", "stop", "line 0 0 -2 F100", "dwell 0.1", "rapid 0 0 -1", "line 0 0 -6 F100", "dwell 0.1", "rapid 0 0 -5",
                  "line 0 0 -7 F100", "dwell 0.1", "rapid 0 0 10", "end"}));
  EXPECT_EQ(bench.at(0, 0, 10).run("G99 G73 Z-1. R2. Q4. F100\nM30").path(), (Path{"rapid 0 0 2", "line 0 0 -1 F100", "rapid 0 0 2"}));
}

TEST(Cycle, WithoutClearanceG83GoesDownToTheLastBottomAndG73DoesNotGoBack) {  // #8013, #8012 at 0
  EXPECT_EQ(at_ten("G99 G83 Z-6. R2. Q4. F100\nM30").path(),
            (Path{"rapid 0 0 2", "line 0 0 -2 F100", "rapid 0 0 2", "rapid 0 0 -2", "line 0 0 -6 F100", "rapid 0 0 2"}));
  EXPECT_EQ(at_ten("G99 G73 Z-6. R2. Q4. F100\nM30").path(), (Path{"rapid 0 0 2", "line 0 0 -2 F100", "line 0 0 -6 F100", "rapid 0 0 2"}));
}

TEST(Cycle, ClearanceIsNeverMoreThanTheDepthReached) {
  Bench bench;
  bench.param("8013", "9").at(0, 0, 10);
  EXPECT_EQ(bench.run("G99 G83 Z-6. R2. Q4. F100\nM30").path(),
            (Path{"rapid 0 0 2", "line 0 0 -2 F100", "rapid 0 0 2", "line 0 0 -6 F100", "rapid 0 0 2"}));
}

TEST(Cycle, InchAndMetricInTheMode) {  // M700 5.2 note 1: F as it stands, in the unit after the change; the levels are places and stay
  const std::string holes = "G99 G81 Z-8. R2. F100\nG20 X1.\nG21 X5.\nM30";
  EXPECT_EQ(at_ten(holes).path(), (Path{"rapid 0 0 2", "line 0 0 -8 F100", "rapid 0 0 2", "rapid 25.4 0 2", "line 25.4 0 -8 F2540", "rapid 25.4 0 2",
                                        "rapid 5 0 2", "line 5 0 -8 F100", "rapid 5 0 2"}));
  EXPECT_EQ(at_ten("G99 G81 Z-8. R2. F100\nG20 X1. F4.\nM30").path().at(4), "line 25.4 0 -8 F101.6");
}

TEST(Cycle, BoreG85AndG89FeedBack) {
  EXPECT_EQ(at_ten("G85 Z-8. R2. F100\nM30").path(), (Path{"rapid 0 0 2", "line 0 0 -8 F100", "line 0 0 2 F100", "rapid 0 0 10"}));
  EXPECT_EQ(at_ten("G99 G85 Z-8. R2. F100\nM30").path(), (Path{"rapid 0 0 2", "line 0 0 -8 F100", "line 0 0 2 F100"}));
  EXPECT_EQ(steps(at_ten("G89 X1. Z-8. R2. P250 F100\nM30")),
            (Path{"rapid 1 0 10", "stop", "rapid 1 0 2", "stop", "line 1 0 -8 F100", "dwell 0.25", "line 1 0 2 F100", "rapid 1 0 10", "end"}));
}

// G98 returns to the programmed level, which a tool length shifts like every other end point, also a length that
// comes in the block of the cycle, or in its mode (M700 12.2, 13.1.1).
TEST(Cycle, ToolLengthThatComesIntoForceDisplacesTheInitialLevelToo) {
  Bench bench;
  bench.tool(11, 100).tool(2, 3).at(0, 0, 50);
  const Path drilled{"rapid 1 0 50", "rapid 1 0 102", "line 1 0 95 F100", "rapid 1 0 150"};
  EXPECT_EQ(bench.run("G0 G43 H11\nG98 G81 X1. Z-5. R2. F100\nM30").path(), (Path{"rapid 0 0 150", "rapid 1 0 150", "rapid 1 0 102", "line 1 0 95 F100", "rapid 1 0 150"}));
  EXPECT_EQ(bench.at(0, 0, 50).run("G43 H11 G98 G81 X1. Z-5. R2. F100\nM30").path(), drilled);
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H2 G0 Z50.\nG98 G81 X1. Z-5. R2. F100\nG43 H11\nX2.\nM30").path(),
            (Path{"rapid 0 0 53", "rapid 1 0 53", "rapid 1 0 5", "line 1 0 -2 F100", "rapid 1 0 53", "rapid 1 0 150", "rapid 2 0 150", "rapid 2 0 102",
                  "line 2 0 95 F100", "rapid 2 0 150"}));
}

TEST(Cycle, Incremental) {  // M700 13.1.1: R from the initial level, Z from R; the sign of R is ignored
  EXPECT_EQ(at_ten("G91 G81 X10. Z-8. R-6. F100\nM30").path(), (Path{"rapid 10 0 10", "rapid 10 0 4", "line 10 0 -4 F100", "rapid 10 0 10"}));
  EXPECT_EQ(at_ten("G91 G81 X10. Z-8. R6. F100\nM30").path(), (Path{"rapid 10 0 10", "rapid 10 0 4", "line 10 0 -4 F100", "rapid 10 0 10"}));
}

TEST(Cycle, RepetitionsInIncremental) {  // M700 13.1.1 precaution 11
  const Path path = at_ten("G91 G81 X10. Z-10. R-20. F100 L3\nM30").path();
  ASSERT_EQ(path.size(), 12u);
  EXPECT_EQ(path[0], "rapid 10 0 10");
  EXPECT_EQ(path[4], "rapid 20 0 10");
  EXPECT_EQ(path[8], "rapid 30 0 10");
}

TEST(Cycle, RepetitionsByK) {  // M700 5.3: K, "number of drilling cycle repetitions"
  EXPECT_EQ(at_ten("G91 G81 X10. Z-10. R-20. F100 K3\nM30").path(), at_ten("G91 G81 X10. Z-10. R-20. F100 L3\nM30").path());
  EXPECT_EQ(at_ten("G91 G81 X10. Z-10. R-20. F100 K3 L2\nM30").path(), at_ten("G91 G81 X10. Z-10. R-20. F100 L2\nM30").path());
  EXPECT_EQ(at_ten("G81 Z-8. R2. F100 K0\nX5.\nM30").path(), at_ten("G81 Z-8. R2. F100 L0\nX5.\nM30").path());
  EXPECT_EQ(at_ten("G81 Z-8. R2. F100 K-1\nM30").alarm, "P35");
}

TEST(Cycle, RepetitionsInAbsoluteDrillTheSameHole) {
  EXPECT_EQ(at_ten("G81 X5. Z-8. R2. F100 L2\nM30").path(),
            (Path{"rapid 5 0 10", "rapid 5 0 2", "line 5 0 -8 F100", "rapid 5 0 10", "rapid 5 0 2", "line 5 0 -8 F100", "rapid 5 0 10"}));
}

TEST(Cycle, LZeroOnlyRecords) {  // M700 13.1.2 example 1
  EXPECT_EQ(at_ten("G82 Z-8. R2. P100 F100 L0\nX5.\nM30").path(), (Path{"rapid 5 0 10", "rapid 5 0 2", "line 5 0 -8 F100", "rapid 5 0 10"}));
}

TEST(Cycle, Example2OfTheReturnLevels) {  // M700 13.1.2 (18630-18677), what each block does
  Bench bench;
  bench.at(0, 0, 10);
  const Outcome run = bench.run(
      "G0 X1.\nG81\nM22\nG04 X1.\nG92 X0 Y0\nG28 Z10.\n\nG99 Z-5. R2. F100 L0\nX5. L2\nG98 X7. Y1. Z-6. R3.\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 10", "rapid 1 0 0",  // the reference return
                              "rapid 6 0 0", "rapid 6 0 2", "line 6 0 -5 F100", "rapid 6 0 2", "line 6 0 -5 F100", "rapid 6 0 2", "rapid 8 1 2",
                              "rapid 8 1 3", "line 8 1 -6 F100", "rapid 8 1 10"}));
  EXPECT_EQ(run.aux(), "M22 M30");
  EXPECT_EQ(run.dwells(), std::vector<double>{1});
}

TEST(Cycle, DataWithoutAPositionAreIgnored) {  // M700 13.1.1 (2)
  EXPECT_EQ(at_ten("G81 Z-8. R2. F100 L0\nP500\nQ2.\nX5.\nM30").path(), (Path{"rapid 5 0 10", "rapid 5 0 2", "line 5 0 -8 F100", "rapid 5 0 10"}));
}

TEST(Cycle, GroupOneCancels) {  // M700 13.1.1 precaution 4
  EXPECT_EQ(at_ten("G81 X5. Z-8. R2. F100 L0\nG0 X1.\nX2.\nM30").path(), (Path{"rapid 1 0 10", "rapid 2 0 10"}));
  EXPECT_EQ(at_ten("G0\nG81 Z-8. R2. F100 L0\nG80 X5.\nX6.\nM30").path(), (Path{"rapid 5 0 10", "rapid 6 0 10"}));
  EXPECT_EQ(at_ten("G81 Z-8. R2. F100 L0\nG1 X5.\nM30").last_modal().code[9], 800);
  // Both in one block: the group one code is executed, the cycle is not; R is then the radius of an arc.
  EXPECT_EQ(at_ten("G1 G81 X5. Z-8. R2. F100\nX6.\nM30").path(), (Path{"line 5 0 -8 F100", "line 6 0 -8 F100"}));
  EXPECT_EQ(at_ten("G2 G81 X4. R2. F100\nM30").path(), (Path{"cw 4 0 10 c2,0 F100"}));
}

TEST(Cycle, CancellingForgetsTheData) {
  const Outcome run = at_ten("G81 X5. Z-8. R2. F100\nG80\nG81 X6.\nM30");
  EXPECT_EQ(run.path().size(), 5u);  // R and Z are forgotten, so that the second cycle does not drill
}

TEST(Cycle, PlaneChoosesTheDrillingAxis) {  // M700 13.1.1
  EXPECT_EQ(Bench().at(0, 10, 0).run("G18 G81 X5. Z6. Y-8. R2. F100\nM30").path(),
            (Path{"rapid 5 10 6", "rapid 5 2 6", "line 5 -8 6 F100", "rapid 5 10 6"}));
  EXPECT_EQ(Bench().at(10, 0, 0).run("G19 G81 Y5. Z6. X-8. R2. F100\nM30").path(),
            (Path{"rapid 10 5 6", "rapid 2 5 6", "line -8 5 6 F100", "rapid 10 5 6"}));
  EXPECT_EQ(Bench().param("1080", "1").at(0, 0, 10).run("G18 G81 X5. Y6. Z-8. R2. F100\nM30").path(),
            (Path{"rapid 5 6 10", "rapid 5 6 2", "line 5 6 -8 F100", "rapid 5 6 10"}));
}

TEST(Cycle, AParallelAxisDrillsWhereTheBlockNamesIt) {  // M700 13.1.1, example 1 of "positioning plane and hole drilling axis"
  Bench bench(NC_DIALECT_M700, axes("XYZWVU"));
  bench.param("1031", "W").param("1030", "V").param("1029", "U");
  const auto path = [&](const char* text) { return bench.at(0, 0, 0).run(std::string("G0 ") + text + "\nG80\nM30").path(); };
  EXPECT_EQ(path("W10.\nG81 X5. W-8. R2. F100"),
            (Path{"rapid 0 0 0 10 0 0", "rapid 5 0 0 10 0 0", "rapid 5 0 0 2 0 0", "line 5 0 0 -8 0 0 F100", "rapid 5 0 0 10 0 0"}));
  EXPECT_EQ(path("Z10.\nG81 X5. Z-8. R2. F100").back(), "rapid 5 0 10 0 0 0");
  EXPECT_EQ(path("Z10.\nG81 X5. R2. F100\nZ-8."), path("Z10.\nG81 X5. R2. Z10. F100 L0\nX5. Z2.\nZ-8."));  // neither Z nor W: Z drills
  EXPECT_EQ(path("W10.\nG81 X5. W-8. R2. F100 L0\nG82 X6."), path("W10.\nG82 X6. W-8. R2. F100"));  // note 2: it stays in the mode
  // Note 2: another axis is for the cancelled state. Z without a code is an axis like any other (13.1.2, N012).
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 W10.\nG81 X5. W-8. R2. F100\nG82 X6. Z-8.\nG80\nM30").alarm, "P33");
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 W10.\nG81 X5. W-8. R2. F100\nG18 G82 X6.\nG80\nM30").alarm, "P33");
  EXPECT_EQ(path("W10.\nG81 X5. W-8. R2. F100\nX6. Z-8.").at(5), "rapid 5 0 -8 10 0 0");
  EXPECT_EQ(path("W10.\nG81 X5. W-8. R2. F100\nG80\nG82 X6. Z-8.").back(), "rapid 6 0 0 10 0 0");
  EXPECT_EQ(path("Z10. W9.\nG81 X5. Z-8. W7. R2. F100").back(), "rapid 5 0 10 7 0 0");                    // both of the pair: the basic one
  EXPECT_EQ(path("G18 V10.\nG81 X5. V-8. R2. F100").back(), "rapid 5 0 0 0 10 0");
  EXPECT_EQ(path("G18 V10.\nG81 X5. V-8. R2. F100").size(), 5U);
  EXPECT_EQ(path("G19 U10.\nG81 Y5. U-8. R2. F100").back(), "rapid 0 5 0 0 0 10");
  EXPECT_EQ(path("W10.\nG91 G81 X5. W-8. R-2. F100 L2"),
            (Path{"rapid 0 0 0 10 0 0", "rapid 5 0 0 10 0 0", "rapid 5 0 0 8 0 0", "line 5 0 0 0 0 0 F100", "rapid 5 0 0 10 0 0",
                  "rapid 10 0 0 10 0 0", "rapid 10 0 0 8 0 0", "line 10 0 0 0 0 0 F100", "rapid 10 0 0 10 0 0"}));
  bench.param("1080", "1");  // note 1
  EXPECT_EQ(path("Z10.\nG81 X5. W-8. Z-9. R2. F100").back(), "rapid 5 0 10 -8 0 0");
}

TEST(Cycle, AnotherAxisMovesFirst) {  // M700 13.1.1 precaution 6, 13.1.2 example 2 (N012): by the code of group 1 from before the cycle
  const auto path = [](const char* text) {
    return Bench(NC_DIALECT_M700, axes("XYZc")).at(0, 0, 10).run(std::string(text) + "\nG80\nM30").path();
  };
  EXPECT_EQ(path("G0\nG81 X5. C90. Z-8. R2. F100"),
            (Path{"rapid 0 0 10 90", "rapid 5 0 10 90", "rapid 5 0 2 90", "line 5 0 -8 90 F100", "rapid 5 0 10 90"}));
  EXPECT_EQ(path("G1 F50\nG81 X5. Z-8. R2. F100 L0\nC90."),
            (Path{"line 0 0 10 90 F100", "rapid 0 0 2 90", "line 0 0 -8 90 F100", "rapid 0 0 10 90"}));
  EXPECT_EQ(path("G1 F50\nG81 X5. C90. Z-8. R2. F100"),
            (Path{"line 0 0 10 90 F100", "rapid 5 0 10 90", "rapid 5 0 2 90", "line 5 0 -8 90 F100", "rapid 5 0 10 90"}));
  EXPECT_EQ(path("G2 X0 F50\nG81 C90. Z-8. R2.").front(), "line 0 0 10 90 F50");  // beside an arc such an axis goes along a line
  EXPECT_EQ(path("G1 F50\nG91 G81 C30. Z-8. R-2. L2"),
            (Path{"line 0 0 10 30 F50", "rapid 0 0 8 30", "line 0 0 0 30 F50", "rapid 0 0 10 30", "line 0 0 10 60 F50", "rapid 0 0 8 60",
                  "line 0 0 0 60 F50", "rapid 0 0 10 60"}));
}

/// The moves, with the in-position widths that are checked after them, mm; -1 = by the parameters.
Path widths(const Outcome& run) {
  Path all;
  size_t next_move = 0;
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    if (step.item.kind == NC_ITEM_MOVE) all.push_back(moves[next_move++]);
    if (step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_IN_POSITION) all.back() += " ," + brief(step.item.u.gate.value);
  }
  return all;
}

TEST(Cycle, InPositionWidths) {  // M700 13.1.1, "programmable in-position width command in fixed cycle", figures 1 and 2
  EXPECT_EQ(widths(m700("G91 G0\nG81 X-50. Z-50. R-50. L2 F2000 ,I0.2 ,J0.3\nG80\nM30")),
            (Path{"rapid -50 0 0 ,0.2", "rapid -50 0 -50", "line -50 0 -100 F2000", "rapid -50 0 0 ,0.3", "rapid -100 0 0 ,0.2",
                  "rapid -100 0 -50", "line -100 0 -100 F2000", "rapid -100 0 0 ,0.3"}));
  EXPECT_EQ(widths(m700("G91 G0\nG81 X-50. Z-50. R-50. F2000 ,I0.2 ,J0.3\nX-10.\nX-10. ,I0.2\nG80\nM30")),
            (Path{"rapid -50 0 0 ,0.2", "rapid -50 0 -50", "line -50 0 -100 F2000", "rapid -50 0 0 ,0.3", "rapid -60 0 0", "rapid -60 0 -50",
                  "line -60 0 -100 F2000", "rapid -60 0 0 ,0.3", "rapid -70 0 0 ,0.2", "rapid -70 0 -50", "line -70 0 -100 F2000",
                  "rapid -70 0 0 ,0.3"}));
  // If the parameters ask for a check, too, the other moves have that check (0).
  Bench bench;
  bench.param("1193", "1");
  EXPECT_EQ(widths(bench.run("G0 G81 X5. Z-8. R-2. F100 ,I0.2 ,J0.3\nG80\nM30")), (Path{"rapid 5 0 -8 ,0.2"}));  // precaution (4)
  EXPECT_EQ(widths(bench.at(0, 0, 0).run("G0\nG81 X5. Z-8. R-2. F100 ,I0.2 ,J0.3\nG80\nM30")),
            (Path{"rapid 5 0 0 ,0.2", "rapid 5 0 -2 ,0", "line 5 0 -8 F100", "rapid 5 0 0 ,0.3"}));
  // The width counts after the return that ends the hole.
  EXPECT_EQ(widths(m700("G0\nG83 Z-8. R-2. Q4. F100 ,J0.3\nG80\nM30")),
            (Path{"rapid 0 0 -2", "line 0 0 -6 F100", "rapid 0 0 -2", "rapid 0 0 -6", "line 0 0 -8 F100", "rapid 0 0 0 ,0.3"}));
  EXPECT_EQ(widths(m700("G0\nG99 G85 Z-8. R-2. F100 ,J0.3\nG80\nM30")),
            (Path{"rapid 0 0 -2", "line 0 0 -8 F100", "line 0 0 -2 F100"}));  // (e): (4) invalid, (5) no movement
  EXPECT_EQ(widths(m700("G0\nG76 X1. Z-8. R-2. I1. F100 ,I0.2 ,J0.3\nG80\nM30")),  // "valid only in G81 ..."
            (Path{"rapid 1 0 0", "rapid 1 0 -2", "line 1 0 -8 F100", "line 2 0 -8 F100", "rapid 2 0 0", "rapid 1 0 0"}));
}

TEST(Cycle, RangeOfTheInPositionWidths) {  // M700 13.1.1: 0.001 to 999.999 mm, P35
  for (const char* word : {",I0", ",J0", ",I0.0005", ",J0.0005", ",I1000.", ",J1000.", ",I1000000", ",J-1."})
    EXPECT_EQ(at_ten(std::string("G81 X1. Z-5. R1. F100 ") + word + "\nM30").alarm, "P35") << word;
  for (const char* word : {",I1", ",J1", ",I999.999", ",J999.999"})
    EXPECT_EQ(at_ten(std::string("G81 X1. Z-5. R1. F100 ") + word + "\nM30").alarm, "") << word;
  for (const char* block : {"G0 X1. ,J0.1", "G1 X1. F100 ,J0.1", "G28 X0 ,I0.1", "G53 X0 ,J0.1"})  // of cycles (6.1, 6.2: ,I of G00, G01)
    EXPECT_EQ(m700(std::string(block) + "\nM30").alarm, "P32") << block;
}

TEST(Cycle, MGoesOutAtTheFirstPositioningOnly) {  // M700 13.1.1 precaution 5
  EXPECT_EQ(at_ten("G91 G81 X10. Z-8. R-6. F100 L3 M8\nM30").aux(), "M8 M30");
}

TEST(Cycle, SingleBlockStopsNowhereInAHoleWhereItIsSuppressed) {  // M700 13.5.9: #3003 bit 0, from the block behind it on
  const auto stops = [](const char* text) {
    unsigned count = 0;
    for (const std::string& step : steps(at_ten(text))) count += step == "stop" ? 1u : 0u;
    return count;
  };
  EXPECT_EQ(stops("G81 X5. Z-8. R2. F100 L2\nX6.\nM30"), 7U);  // (1) and (2) of each hole, and the end of the first
  EXPECT_EQ(stops("#3003=1\nG81 X5. Z-8. R2. F100 L2\nX6.\nM30"), 0U);
  EXPECT_EQ(stops("G81 X5. Z-8. R2. F100\n#3003=1\nX6.\n#3003=0\nX7.\nM30"), 4U);
  EXPECT_EQ(stops("#3003=2\nG81 X5. Z-8. R2. F100\nM30"), 2U);  // bit 1 is of FIN
}

TEST(Cycle, WithLengthCompensationAndWorkOffset) {
  Bench bench;
  bench.tool(1, 100).work_offset(1, {10, 0, -5}).at(0, 0, 200);
  EXPECT_EQ(bench.run("G43 H1 G0 Z20.\nG81 X5. Z-8. R2. F100\nM30").path(),
            (Path{"rapid 0 0 115", "rapid 15 0 115", "rapid 15 0 97", "line 15 0 87 F100", "rapid 15 0 115"}));
}

TEST(Cycle, UpwardsToo) {  // the bottom may be above R
  Bench bench;
  bench.param("8013", "1");
  EXPECT_EQ(bench.run("G83 Z8. R2. Q4. F100\nM30").path(),
            (Path{"rapid 0 0 2", "line 0 0 6 F100", "rapid 0 0 2", "rapid 0 0 5", "line 0 0 8 F100", "rapid 0 0 0"}));
}

TEST(Cycle, LiesAtTheLineOfItsBlock) {
  const Outcome run = at_ten("\n\nG81 X5. Z-8. R2. F100\nM30");
  for (const nc_item& item : run.of(NC_ITEM_MOVE)) EXPECT_EQ(item.source.line, 3u);
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{3, 4}));
}

TEST(Cycle, ManyPecksRunInConstantMemory) {
  Bench bench;
  bench.param("8013", "0.001").at(0, 0, 10);
  const Outcome run = bench.run("G83 Z-10. R0 Q0.01 F100\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.moves().size(), 1u + 1000 * 3 - 1);
}

TEST(Cycle, Alarms) {
  EXPECT_EQ(at_ten("G83 Z-8. R2. F100\nM30").alarm, "P33");         // no Q
  EXPECT_EQ(at_ten("#1=0.0000000001\nG83 Z-8. R2. Q#1 F100\nM30").alarm, "P33");
  EXPECT_EQ(at_ten("G81 Z-8. R2.\nM30").alarm, "P62");
  EXPECT_EQ(at_ten("G81 Z-8. R2. F1 L10000\nM30").alarm, "P35");
  EXPECT_EQ(at_ten("G41 D1 G1 X1. F9\nG81 Z-8. R2.\nM30").alarm, "P155");
  EXPECT_EQ(at_ten("G81 Z-8. R2. F1 L0\nG41 D1 X5.\nM30").alarm, "P155");
  for (const char* code : {"G81", "G82", "G85", "G86", "G87", "G88", "G89", "G76"})
    EXPECT_EQ(at_ten(std::string(code) + " Z-8. R2.\nM30").alarm, "P62") << code;
  for (const char* code : {"G83", "G73", "G75"}) {
    EXPECT_EQ(at_ten(std::string(code) + " Z-8. R2. F100\nM30").alarm, "P33") << code;
    EXPECT_EQ(at_ten(std::string(code) + " Z-8. R2. Q2. P1\nM30").alarm, "P62") << code;
  }
  // G75: the number of the offset, and a circle that is larger than the tool.
  EXPECT_EQ(at_ten("G75 Z-8. R2. Q2. F100\nM30").alarm, "P170");
  EXPECT_EQ(at_ten("G75 Z-8. R2. Q2. P999 F100\nM30").alarm, "P170");
  EXPECT_EQ(Bench().tool(1, 2).at(0, 0, 10).run("G75 Z-8. R2. Q2. P1 F100\nM30").alarm, "P223");
  EXPECT_EQ(at_ten("G82 Z-8. R2. P-1 F100\nM30").alarm, "P35");
}

TEST(Cycle, TooManyDigitsOfLAreRefused) { EXPECT_EQ(at_ten("G81 Z-8. R2. F1 L99999\nM30").alarm, "P35"); }

// ---- DGSHAPE ---------------------------------------------------------------------------------------------------------------------

Outcome dgshape_at_ten(const std::string& text) { return Bench(NC_DIALECT_DGSHAPE).at(0, 0, 10).run("%\n" + text); }

TEST(DgshapeCycle, DrillAndReturnLevels) {  // DGSHAPE G81, G98, G99
  EXPECT_EQ(dgshape_at_ten("M03\nG98G81X5000Z-8000R2000F60000\nG80\nM02").path(),
            (Path{"rapid 5 0 10", "rapid 5 0 2", "line 5 0 -8 F60", "rapid 5 0 10"}));
  EXPECT_EQ(dgshape_at_ten("M03\nG99G81X5000Z-8000R2000F60000\nG80\nM02").path().back(), "rapid 5 0 2");
  // Without R the R level is the initial level. Without Z there is no drilling.
  EXPECT_EQ(dgshape_at_ten("M03\nG81X5000Z-8000F60000\nM02").path(), (Path{"rapid 5 0 10", "line 5 0 -8 F60", "rapid 5 0 10"}));
  EXPECT_EQ(dgshape_at_ten("M03\nG81X5000R2000F60000\nM02").path(), (Path{"rapid 5 0 10"}));
}

TEST(DgshapeCycle, PeckHasAFixedClearance) {  // DGSHAPE G83: d = 1 mm
  EXPECT_EQ(dgshape_at_ten("M03\nG83Z-5000R2000Q4000F60000\nM02").path(),
            (Path{"rapid 0 0 2", "line 0 0 -2 F60", "rapid 0 0 2", "rapid 0 0 -1", "line 0 0 -5 F60", "rapid 0 0 10"}));
}

TEST(DgshapeCycle, BoreWithFeedAndDwell) {
  EXPECT_EQ(dgshape_at_ten("M03\nG99G85Z-5000R2000F60000\nM02").path(), (Path{"rapid 0 0 2", "line 0 0 -5 F60", "line 0 0 2 F60"}));
  EXPECT_EQ(dgshape_at_ten("M03\nG89Z-5000R2000P300F60000\nM02").dwells(), std::vector<double>{0.3});
}

TEST(DgshapeCycle, RepetitionsByK) {
  EXPECT_EQ(dgshape_at_ten("M03\nG91G81X5000Z-8000R-2000F60000K2\nM02").path(),
            (Path{"rapid 5 0 10", "rapid 5 0 8", "line 5 0 0 F60", "rapid 5 0 10", "rapid 10 0 10", "rapid 10 0 8", "line 10 0 0 F60",
                  "rapid 10 0 10"}));
  EXPECT_EQ(dgshape_at_ten("M03\nG81X5000Z-8000R2000F60000K0\nM02").path(), Path{});
  // Without Z there is no drilling, but the places are gone to, and the next hole counts from the last one.
  EXPECT_EQ(dgshape_at_ten("M03\nG91G81X5000R-2000F60000K3\nX5000Z-8000\nM02").path(),
            (Path{"rapid 5 0 10", "rapid 10 0 10", "rapid 15 0 10", "rapid 20 0 10", "rapid 20 0 8", "line 20 0 0 F60", "rapid 20 0 10"}));
}

TEST(DgshapeCycle, Alarms) {  // DGSHAPE 5
  EXPECT_EQ(dgshape_at_ten("G81Z-8000R2000F60000\nM02").alarm, "NC-SPINDLE");
  EXPECT_EQ(dgshape_at_ten("M03\nM05\nG81Z-8000R2000F60000\nM02").alarm, "NC-SPINDLE");
  EXPECT_EQ(dgshape_at_ten("M03\nG18G81Z-8000R2000F60000\nM02").alarm, "NC-PLANE");
  EXPECT_EQ(dgshape_at_ten("M03\nG81Z-8000R2000F60000K10000\nM02").alarm, "NC-RANGE");
  EXPECT_EQ(Bench(NC_DIALECT_DGSHAPE, axes("XYZa")).at(0, 0, 10).run("%\nM03\nG81A1000Z-8000R2000F60000\nM02").alarm, "NC-AXIS");
  const Outcome stopped = dgshape_at_ten("M03\nG99G86X1000Z-8000R2000F60000\nM02");  // docs/decisions.md
  EXPECT_EQ(stopped.alarm, "");
  EXPECT_EQ(stopped.aux(), "M3 M5 M3 M2");
  EXPECT_EQ(stopped.path().back(), "rapid 1 0 2");
  EXPECT_EQ(dgshape_at_ten("G73Z-8000\nM02").alarm, "NC-NO-SUCH-CODE");
}

Outcome iso_at_ten(const std::string& text) { return Bench(NC_DIALECT_ISO).at(0, 0, 10).run("G21 G17 G90 G94 G98 S500 M3 F300\n" + text); }

// M700 13.5.2 (3): "all the commands except M, P, H and L" are those of the hole, and these are those of the call, and of the return.
TEST(Cycle, WordsOfACallBesideAHoleAreNotItsOwn) {
  Bench bench;
  bench.add("O9000", "M99\n");
  const Outcome called = bench.at(0, 0, 50).run("G90 G0\nG82 X1. Z-5. R2. F100 P500\nX2. M98 P9000\nX3.\nG80\nM30");
  EXPECT_EQ(called.alarm, "");
  EXPECT_EQ(called.dwells(), (std::vector<double>{0.5, 0.5, 0.5}));
  const Outcome repeated = bench.at(0, 0, 50).run("G90 G0\nG81 X1. Z-5. R2. F100\nG91 X2. M98 P9000 L2\nG80\nM30");
  EXPECT_EQ(repeated.alarm, "");
  EXPECT_EQ(repeated.end_work.v[0], 3);
  bench.add("O9002", "X2. M99 P7\n");
  const Outcome back = bench.at(0, 0, 50).run("G90 G0\nG82 X1. Z-5. R2. F100 P500\nM98 P9002\nN7 X3.\nG80\nM30");
  EXPECT_EQ(back.alarm, "");
  EXPECT_EQ(back.dwells(), (std::vector<double>{0.5, 0.5, 0.5}));
}

// HX 2.4.3: M98 has Q and R, too, and no way in rapid goes by them. 12.3.9: K is the count in each plane, and the shift is that of Q.
TEST(HxCycle, WordsOfACallAndTheCountAreNoDataOfTheHole) {
  Bench bench(NC_DIALECT_HX);
  bench.param("3070", "0").param("3071", "0");
  bench.add("O100", "N5 M8\nN20 M9\nM99\n");
  const Path drilled{"rapid 1 0 50", "rapid 1 0 20", "line 1 0 -3 F100", "rapid 1 0 50", "rapid 2 0 50", "rapid 2 0 20", "line 2 0 -3 F100", "rapid 2 0 50"};
  const Outcome called = bench.at(0, 0, 50).run("G90 G21 G17 G0 M3 S500\nG81 X1. R20. Z-3. F100.\nX2. M98 P100 Q5 R20\nG80\nM30");
  EXPECT_EQ(called.alarm, "") << called.alarm_detail;
  EXPECT_EQ(called.path(), drilled);
  const auto bored = [&](const std::string& words) { return bench.at(0, 0, 50).run("G90 G21 G18 G0 M3 S500\nG76 X1. Z1. R-2. Y-5. Q1. " + words + "F100.\nG80\nM30"); };
  EXPECT_EQ(bored("").alarm, "");
  EXPECT_EQ(bored("K1 ").path(), bored("").path());
  EXPECT_EQ(bored("K0 ").path(), Path{});
  EXPECT_GT(bored("K2 ").path().size(), bored("").path().size());
}

TEST(IsoCycle, LevelsCountByTheDistanceModeOfTheHole) {  // LinuxCNC: R2 and Z-5 are increments behind G91
  EXPECT_EQ(iso_at_ten("G81 X1 Y1 Z-5 R2\nG91 X10\nG80\nM2").path(),
            (Path{"rapid 1 1 10", "rapid 1 1 2", "line 1 1 -5 F300", "rapid 1 1 10", "rapid 1 1 12", "rapid 11 1 12", "line 11 1 7 F300", "rapid 11 1 12"}));
  EXPECT_EQ(iso_at_ten("G91 G81 X1 Y1 R-8 Z-5\nG90 X5\nG80\nM2").alarm, iso_at_ten("G81 X1 Y1 R-8 Z-5\nM2").alarm) << "the bottom lies above R";
  EXPECT_NE(iso_at_ten("G91 G81 X1 Y1 R-8 Z-5\nG90 X5\nG80\nM2").alarm, "");
  EXPECT_EQ(iso_at_ten("G91 G81 X1 Y1 R-8 Z-5\nX5\nG80\nM2").alarm, "");
}

TEST(IsoCycle, TheCodeOfAnotherCycleBeginsItsDataAnew) {  // RS-274/NGC 3.5.16
  EXPECT_EQ(iso_at_ten("G81 X1 Y1 Z-5 R2\nG82 X2 P1\nG80\nM2").alarm, iso_at_ten("G82 X2 P1\nM2").alarm);
  EXPECT_NE(iso_at_ten("G82 X2 P1\nM2").alarm, "");
  EXPECT_EQ(iso_at_ten("G81 X1 Y1 Z-5 R2\nG81 X2\nX3\nG80\nM2").alarm, "") << "the same cycle again";
  EXPECT_EQ(iso_at_ten("G82 X1 Y1 Z-5 R2 P0.5\nG73 X2 Z-5 R2 Q3\nG80\nM2").dwells(), std::vector<double>{0.5}) << "G73 has no P";
  EXPECT_EQ(iso_at_ten("G82 X1 Y1 Z-5 R2 P0.5\nG89 X2 Z-5 R2\nG80\nM2").dwells(), std::vector<double>{0.5}) << "nor is the P of G82 that of G89";
}

}  // namespace
}  // namespace nc::test
