// SPDX-License-Identifier: Apache-2.0
// Length compensation along the axis of the tool, G43.1 (M700 12.3): the vector, its beginning and end, arcs, what it excludes.
#include <gtest/gtest.h>

#include "support/going_back.hpp"

namespace nc::test {
namespace {

Outcome run_of(const std::string& text, const char* names = "XYZbc") {
  Bench bench(NC_DIALECT_M700, axes(names));
  bench.tool(1, 50).tool(2, 20);
  return bench.run(text);
}

Path path_of(const std::string& text, const char* names = "XYZbc") {
  const Outcome run = run_of(text, names);
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  return run.path();
}

std::string alarm_of(const std::string& text, const char* names = "XYZbc") {
  const Outcome run = run_of(text, names);
  return run.alarm + " L" + std::to_string(run.alarm_line);
}

TEST(LengthAlongTool, FollowsBAndC) {
  EXPECT_EQ(path_of("G0 B90. C0\nG43.1 X10. H1\nC90.\nB0\nM30"),
            (Path{"rapid 0 0 0 90 0", "rapid 60 0 0 90 0", "rapid 10 50 0 90 90", "rapid 10 0 50 0 90"}));
  EXPECT_EQ(path_of("G0 B30. C60.\nG43.1 X0 H2\nM30"), (Path{"rapid 0 0 0 30 60", "rapid 5 8.660254 17.320508 30 60"}));
}

TEST(LengthAlongTool, FollowsAAndC) {
  EXPECT_EQ(path_of("G0 A90. C0\nG43.1 X10. H1\nC90.\nA0\nM30", "XYZac"),
            (Path{"rapid 0 0 0 90 0", "rapid 10 -50 0 90 0", "rapid 60 0 0 90 90", "rapid 10 0 50 0 90"}));
}

TEST(LengthAlongTool, BelongsToThePlaceThatG92Names) {  // 14.10 (3): "the present position of the tool includes the compensation amounts"
  EXPECT_EQ(path_of("G0 B90.\nG43.1 X10. H1\nG92 X0\nX1.\nG49\nX0\nM30"),
            (Path{"rapid 0 0 0 90 0", "rapid 60 0 0 90 0", "rapid 111 0 0 90 0", "rapid 61 0 0 90 0", "rapid 60 0 0 90 0"}));
  EXPECT_EQ(path_of("G0 B90.\nG43.1 X10. H1\nG49\nG92 X0\nX1.\nM30"), (Path{"rapid 0 0 0 90 0", "rapid 60 0 0 90 0", "rapid 10 0 0 90 0", "rapid 11 0 0 90 0"}));
}

TEST(LengthAlongTool, AloneItMovesAtOnceAndSoDoesItsEnd) {
  EXPECT_EQ(path_of("G0 B90.\nG43.1 H1\nX1.\nG49\nX2.\nM30"),
            (Path{"rapid 0 0 0 90 0", "rapid 50 0 0 90 0", "rapid 51 0 0 90 0", "rapid 1 0 0 90 0", "rapid 2 0 0 90 0"}));
}

// In three-dimensional compensation as well: the vector of the radius stays, that of the length goes.
TEST(LengthAlongTool, AloneInSpaceCompensationItMovesAtOnceAndSoDoesItsEnd) {
  for (const char* end : {"G49", "G43.1 H0", "G43 H0"})
    EXPECT_EQ(path_of(std::string("G0 B90.\nG41 D2 I0 J3. K4.\nG43.1 H1\nX1.\n") + end + "\nX2.\nM30"),
              (Path{"rapid 0 0 0 90 0", "rapid 0 12 16 90 0", "rapid 50 12 16 90 0", "rapid 51 12 16 90 0", "rapid 1 12 16 90 0", "rapid 2 12 16 90 0"}))
        << end;
}

// In the contour of a tool radius as well, and not on the way of the next cut.
TEST(LengthAlongTool, AloneInRadiusCompensationItMovesAtOnceAndSoDoesItsEnd) {
  const char* const begin = "G90 G17 G1 F100\nG43.1 H1\nG41 D2 X30.\nX60.\n";
  EXPECT_EQ(path_of(std::string(begin) + "G49\nY30.\nG40 X90.\nM30"),
            (Path{"line 0 0 50 0 0 F100", "line 30 20 50 0 0 F100", "line 40 20 50 0 0 F100", "line 40 20 0 0 0 F100", "line 40 30 0 0 0 F100", "line 90 30 0 0 0 F100"}));
}

// A thread has no radius compensation (6.7.1), and keeps the length as it keeps that of G43.
TEST(LengthAlongTool, AThreadKeepsIt) {
  const auto last = [](const Path& path) { return path.back(); };
  EXPECT_EQ(path_of("G90 S100 F100\nG1 G43.1 H1\nG33 Z-5. F1.\nM30"), (Path{"line 0 0 50 0 0 F100", "thread 0 0 45 0 0 F0"}));
  EXPECT_EQ(path_of("G90 S100 F100\nG1 G43 Z0 H1\nG33 Z-5. F1.\nM30"), (Path{"line 0 0 50 0 0 F100", "thread 0 0 45 0 0 F0"}));
  EXPECT_EQ(last(path_of("G90 S100 F100\nG1 G41 X0 Y0 Z0 I0 J0 K1. D2\nG33 Z-5. F1.\nM30")), "thread 0 0 15 0 0 F0");
}

TEST(LengthAlongTool, AnArcIsNoWayForIt) {  // App. 2
  EXPECT_EQ(alarm_of("G90 G17 F100\nG43.1 H1 G2 X10. Y10. R10.\nM30"), "P70 L2");
  EXPECT_EQ(path_of("G90 G17 F100\nG1 G43.1 H1\nG2 X10. Y10. R10.\nG49 X20. Y0 R10.\nM30"),
            (Path{"line 0 0 50 0 0 F100", "cw 10 10 50 0 0 c10,0 F100", "line 10 10 0 0 0 F100", "cw 20 0 0 0 0 c10,0 F100"}));
}

// A piece of a corner would end on the way of the axes that turn the tool, with the vector of another place.
TEST(LengthAlongTool, NoCornerIsCutWhereTheToolTurns) {
  EXPECT_EQ(alarm_of("F500\nG0 A30. C20.\nG43.1 Z0 H1\nG1 X20. ,R5.\nY20. A40.\nG49\nM30", "XYZac"), "P931 L4");
  EXPECT_EQ(alarm_of("F500\nG0 A30. C20.\nG43.1 Z0 H1\nG1 X20. C30. ,C5.\nY20.\nG49\nM30", "XYZac"), "P931 L4");
  EXPECT_EQ(alarm_of("F500\nG0 A90. C90.\nG43.1 X0 Z0 H1\nG1 X20. ,R5.\nY20.\nG49\nM30", "XYZac"), "P70 L4");
  EXPECT_EQ(alarm_of("F500\nG0 A90. C90.\nG43.1 X0 Z0 H1\nG1 X20. ,C5.\nY20.\nG49\nM30", "XYZac"), " L0");
  EXPECT_EQ(path_of("F500\nG0 G43.1 Z0 H1\nG1 X20. ,R5.\nY20.\nM30", "XYZac"),
            (Path{"rapid 0 0 50 0 0", "line 15 0 50 0 0 F500", "ccw 20 5 50 0 0 c15,5 F500", "line 20 20 50 0 0 F500"}));
}

TEST(LengthAlongTool, AloneItCutsOnlyWithAFeed) {  // 3.2, P62: a line without a feed would never end
  EXPECT_EQ(alarm_of("G1\nG43.1 H1\nM30"), "P62 L2");
  EXPECT_EQ(alarm_of("G0 G43.1 H1\nG1\nG49\nM30"), "P62 L3");
  EXPECT_EQ(alarm_of("G0 G43.1 H1\nG1\nG43 H1\nM30"), "P62 L3");
  EXPECT_EQ(alarm_of("G1 F100\nG43.1 H1\nG49\nM30"), " L0");
  EXPECT_EQ(alarm_of("G1\nG0 G43.1 H1\nG49\nM30"), " L0");
}

TEST(LengthAlongTool, ReplacesALengthAndIsReplacedByOne) {
  EXPECT_EQ(path_of("G0 B90.\nG43 Z0 H2\nG43.1 X0 H1\nG43 Z5. H2\nM30"),
            (Path{"rapid 0 0 0 90 0", "rapid 0 0 20 90 0", "rapid 50 0 0 90 0", "rapid 0 0 25 90 0"}));
}

TEST(LengthAlongTool, AnotherNumberCountsFromTheNextMoveAndZeroIsNone) {
  EXPECT_EQ(path_of("G0 B90.\nG43.1 X0 H1\nH2\nX1.\nH0 X2.\nM30"), (Path{"rapid 0 0 0 90 0", "rapid 50 0 0 90 0", "rapid 21 0 0 90 0", "rapid 2 0 0 90 0"}));
}

TEST(LengthAlongTool, IsTakenAwayByAMachineMove) {
  EXPECT_EQ(path_of("G0 B90.\nG43.1 X0 H1\nG53 X7.\nX1.\nM30"), (Path{"rapid 0 0 0 90 0", "rapid 50 0 0 90 0", "rapid 7 0 0 90 0", "rapid 51 0 0 90 0"}));
}

TEST(LengthAlongTool, EveryMarkIsAPlaceToGoOnFrom) {
  goes_on_from_every_mark("G0 B30. C10.\nG43.1 H1\nX5.\nM8\nB90.\nH2\nC20. X9.\nG53 X1.\nY3.\nG49\nX2.\nM30", [](Bench& bench) { bench.tool(1, 50).tool(2, 20); },
      axes("XYZbc"));
}

// A corner is possible with a length along the tool, but not where the tool turns; a code that is not possible at all is another sentence.
TEST(LengthAlongTool, TheSentenceOfACornerNamesTheTurn) {
  for (const char* corner : {",R5.", ",C5."}) {
    const Outcome run = run_of("F500\nG0 A30. C20.\nG43.1 Z0 H1\nG1 X20. " + std::string(corner) + "\nY20. A40.\nG49\nM30", "XYZac");
    EXPECT_EQ(run.alarm, "P931");
    EXPECT_NE(run.alarm_detail.find("a rotary axis moves in one of the two blocks"), std::string::npos) << run.alarm_detail;
    EXPECT_EQ(run.alarm_detail.find("Cancel it first"), std::string::npos) << run.alarm_detail;
  }
  const Outcome code = run_of("G0 G43.1 X10. H1\nG28 X0\nM30");
  EXPECT_EQ(code.alarm_detail, "G28 is not possible while the length is compensated along the tool axis. Cancel it first (G49).");
}

TEST(LengthAlongTool, Alarms) {
  EXPECT_EQ(alarm_of("G0 X1.\nG43.1 X10. H1\nM30", "XYZ"), "P930 L2");
  EXPECT_EQ(alarm_of("G0 X1.\nG43.1 X10. H1\nM30", "XYZb"), "P930 L2");
  EXPECT_EQ(alarm_of("G43.1 X10. H999\nM30"), "P170 L1");
  EXPECT_EQ(alarm_of("G43.1 X10.\nM30"), "P170 L1");
  EXPECT_EQ(alarm_of("G0 G43.1 X10. H1\nG68 X0 Y0 Z0 I1 J0 K0 R30.\nM30"), "P931 L2");
  EXPECT_EQ(alarm_of("G43.1 H1 G68 X0 Y0 Z0 I1 J0 K0 R30.\nM30"), "P923 L1");
  for (const char* code : {"G27", "G28", "G29", "G30", "G30.1"}) EXPECT_EQ(alarm_of("G0 G43.1 X10. H1\n" + std::string(code) + " X0\nM30"), "P931 L2") << code;
  // The ends of an arc are displaced, its centre is not.
  EXPECT_EQ(alarm_of("G0 B90.\nG43.1 X20. H1\nG3 X0 Y20. I-20. F100\nM30"), "P70 L3");
}

// With G43.1 in force a cycle is barred by the radius alone, and its sentence tells the code that ends that one.
TEST(ToolAxis, TheSentenceOfACycleInRadiusCompensationTellsG40) {
  Bench bench(NC_DIALECT_M700, axes("XYZbc"));
  bench.tool(1, 0).tool(2, 3);
  const Outcome run = bench.run("G90 G17 G1 F100\nG43.1 H1\nG41 D2 X30.\nX60.\nG81 X70. Z-5. R1.\nM30");
  EXPECT_EQ(run.alarm, "P155");
  EXPECT_EQ(run.alarm_line, 5u);
  EXPECT_NE(run.alarm_detail.find("G40 first"), std::string::npos) << run.alarm_detail;
}

}  // namespace
}  // namespace nc::test
