// SPDX-License-Identifier: Apache-2.0
// The Series 8: where its manual differs from the other families, a test for each rule; and what docs/series8.md says of the codes of which the manual has
// the title alone.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome series8(const std::string& text) { return Bench(NC_DIALECT_SERIES8).run(text); }
std::string alarm_of(const std::string& text) { return series8(text).alarm; }
Path path_of(const std::string& text) {
  const Outcome run = series8(text);
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  return run.path();
}

TEST(Series8, WordsAreWholeUnitsAndMayHaveNoNumber) {  // G00, G01
  EXPECT_EQ(path_of("G00X5Y4.5Z-3;G01 X99\nG00XY ; X0 Y0"), (Path{"rapid 5 4.5 -3", "rapid 0 0 -3"}));
  EXPECT_EQ(path_of("G70\nF50\nG01X2.5"), (Path{"line 63.5 0 0 F1270"}));
  EXPECT_EQ(alarm_of("M\nX1"), "NC-FORMAT");
  EXPECT_EQ(alarm_of("G00 H1"), "NC-ADDRESS");
}

// ---- arcs

TEST(Series8Arc, TheLastRadiusHolds) {  // G02
  EXPECT_EQ(path_of("F10\nG02X2.Y0R1.\nG03X1.Y1.\nX0Y0\nX1.Y1.R-1.\nG01X1.Y1."),
            (Path{"cw 2 0 0 c1,0 F10", "ccw 1 1 0 c1,0 F10", "ccw 0 0 0 c1,0 F10", "ccw 1 1 0 c1,0 F10"}));
  EXPECT_EQ(path_of("F10\nG02X2Y0R1\nG00X0\nG02X2"), (Path{"cw 2 0 0 c1,0 F10", "rapid 0 0 0", "cw 2 0 0 c1,0 F10"}));
  // R of another function is not the radius of an arc.
  EXPECT_EQ(path_of("F10\nG02X2Y0R1\nG81X2Z-1R3\nG80\nG02X4"), (Path{"cw 2 0 0 c1,0 F10", "rapid 2 0 3", "line 2 0 -1 F10", "rapid 2 0 3", "cw 4 0 3 c3,0 F10"}));
}

TEST(Series8Arc, AShortRadiusIsHalfTheChord) {
  EXPECT_EQ(path_of("F10\nG02X10R3"), (Path{"cw 10 0 0 c5,0 F10"}));
  EXPECT_EQ(path_of("F10\nG03X10R-3"), (Path{"ccw 10 0 0 c5,0 F10"}));
  EXPECT_EQ(path_of("F10\nG03X10R"), (Path{"ccw 10 0 0 c5,0 F10"}));
}

TEST(Series8Arc, CentreWordsHaveNoSign) {
  const struct {
    const char *start, *block, *path;
  } arcs[] = {
      {"X20Y30", "G02X30Y20J10", "cw 30 20 0 c20,20 F10"},    {"X5Y12", "G03X-0Y13I5J12", "ccw 0 13 0 c0,0 F10"}, {"X5Y12", "G02X13Y0I5J12", "cw 13 0 0 c0,0 F10"},
      {"X-5Y12", "G03X-13Y0I5J12", "ccw -13 0 0 c0,0 F10"},   {"X-5Y12", "G02XY13I5J12", "cw 0 13 0 c0,0 F10"},   {"X-5Y-12", "G03XY-13I5J12", "ccw 0 -13 0 c0,0 F10"},
      {"X-5Y-12", "G02X-13YI5J12", "cw -13 0 0 c0,0 F10"},    {"X5Y-12", "G03X13YI5J12", "ccw 13 0 0 c0,0 F10"},  {"X5Y-12", "G02XY-13I5J12", "cw 0 -13 0 c0,0 F10"},
      {"X10Y0", "G03X0Y10I10", "ccw 0 10 0 c0,0 F10"},        {"X10Y0", "G02X0Y-10I10", "cw 0 -10 0 c0,0 F10"},
  };
  for (const auto& arc : arcs) EXPECT_EQ(path_of(std::string("F10\nG00") + arc.start + "\n" + arc.block).back(), arc.path) << arc.block;
  EXPECT_EQ(series8("F10\nG18\nG00X10Z0\nG02X0Z10I10").moves().back().plane, NC_PLANE_ZX);
}

TEST(Series8Arc, OneThatCannotBeMadeIsInvalid) {
  for (const char* block : {"G03X0Y13I10J0",     // not on the arc
                            "G02X0Y10I10",       // three quadrants in this direction
                            "G03X-8Y6I10",       // over a boundary
                            "G03X10Y0I10",       // a full circle
                            "G03X0Y10I0J0", "G03X0Y10", "G03X0Y10I-10"})
    EXPECT_EQ(alarm_of(std::string("F10\nG00X10Y0\n") + block), "INVALIDARC") << block;
  // There may be circles through both ends: the sentence says what is asked of the centre here.
  for (const char* block : {"G02X0Y10I10", "G03X0Y10I-10", "G03X10Y0I10"})
    EXPECT_EQ(series8(std::string("F10\nG00X10Y0\n") + block).alarm_detail,
              "I J K have no sign and give no centre from which both ends are as far and within one quadrant. Divide the arc, or program R.")
        << block;
}

TEST(Series8Arc, QuadrantsAreThoseOfTheProgram) {  // of a rotated arc, too
  const auto moves = series8("F10\nG55R45\nG00X10Y0\nG03X0Y10I10").moves();
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_NEAR(moves[1].machine_center[0], 0, 1e-9);
  EXPECT_NEAR(moves[1].machine.v[0], -std::sqrt(50), 1e-9);
}

// ---- G04, G06, G10

TEST(Series8, ADwellIsInSecondsOrRevolutions) {  // G04
  const Outcome run = series8("F100\nG04X5.\nG04F2.5\nG04X.75\nG01X1");
  EXPECT_EQ(run.dwells(), (std::vector<double>{5, 2.5, 0.75}));
  EXPECT_EQ(run.path(), (Path{"line 1 0 0 F100"}));  // F of the dwell is no feed
  EXPECT_EQ(alarm_of("G04"), "NC-WORDS");
}

TEST(Series8, ALoopGoesThereAndBackWhileTheInputIsOn) {  // G06
  const Outcome once = series8("F600\nG00X10\nG06X30Y10\nG00X0");
  ASSERT_EQ(once.alarm, "") << once.alarm_detail;
  const auto moves = once.moves();
  ASSERT_EQ(moves.size(), 3u);
  EXPECT_EQ(moves[1].kind, NC_MOVE_SPLINE);
  EXPECT_NEAR(moves[1].machine.v[0], 10, 1e-9);  // it ends where it has begun
  EXPECT_NEAR(moves[1].length, std::hypot(20, 10) * 3.14159265358979, 1e-6);
  for (const char* block : {"G06", "G06X10", "G41D1G06X5"}) EXPECT_NE(alarm_of(std::string("F600\nG00X10\n") + block), "") << block;
  EXPECT_EQ(alarm_of("G06X10"), "NC-FEED");
  const Outcome there = series8("F600\nG00X10\nG06X10");
  EXPECT_EQ(there.alarm + " " + there.alarm_detail, "NC-RANGE The axes stand where G06 is to turn: the loop has no length.");
}

TEST(Series8, ACornerIsPutBetweenTwoLines) {  // G10
  const Path printed = path_of("G70\nG00X0Y0\nG01F50G10Y5R.5\nG10X10Y0L.25\nG10Y5R.5\nX5");
  ASSERT_EQ(printed.size(), 7u);
  EXPECT_EQ(printed[0].substr(0, 6), "line 0");
  EXPECT_EQ(path_of("F10\nG01G10X10L2\nY10"), (Path{"line 8 0 0 F10", "line 10 2 0 F10", "line 10 10 0 F10"}));
  EXPECT_EQ(alarm_of("F10\nG01G10X10\nY10"), "NC-WORDS");
  EXPECT_EQ(alarm_of("F10\nG01G10X10L1R1\nY10"), "NC-FORMAT");
  EXPECT_EQ(alarm_of("F10\nG00G10X10L1\nY10"), "NC-CORNER");
  EXPECT_EQ(alarm_of("F10\nG01G10X10L1\nG02X20R5"), "NC-CORNER");
}

TEST(Series8, SharpCornersEndAtRest) {  // G21 to G23
  const auto stops = [](const std::string& text) {
    std::vector<bool> stop;
    for (const nc_move& move : series8(text).moves()) stop.push_back(move.exact_stop);
    return stop;
  };
  EXPECT_EQ(stops("F10\nG21X10\nY10\nG01X0\nG22X10Y0R10\nG23X0R10\nG03X10R10"), (std::vector<bool>{true, true, false, true, true, false}));
  EXPECT_EQ(path_of("G70\nF10\nG21X1"), (Path{"line 25.4 0 0 F254"}));  // not millimetres
}

// ---- compensation

TEST(Series8Compensation, BeginsBesideTheStart) {  // G41
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  EXPECT_EQ(bench.run("F10\nT01D01\nG41\nG01X10\nY10\nX0\nY0\nG40\nX-5").path(),
            (Path{"line 0 2 0 F10", "line 8 2 0 F10", "line 8 8 0 F10", "line 2 8 0 F10", "line 2 0 0 F10", "line -5 0 0 F10"}));
  // The same with decimal points, as the shortest way through the interpreter takes such lines.
  for (const char* line : {"G1 X10.", "G1 X10. Y0", "G1 X10. Z5.", "M08\nG1 X10.", "G1 X10. F10"}) {
    Bench pointed(NC_DIALECT_SERIES8);
    pointed.tool(1, 2, NC_TOOL_RADIUS);
    const std::vector<std::string> path = pointed.run(std::string("G17 G90\nF10\nG41 D1\n") + line + "\nY10.\nG40\nX0.\nM02").path();
    ASSERT_GE(path.size(), 2u) << line;
    EXPECT_EQ(path[0], "line 0 2 0 F10") << line;
    EXPECT_EQ(path[1].substr(0, 9), "line 8 2 ") << line;
  }
  Bench straight(NC_DIALECT_SERIES8);
  straight.tool(1, 2, NC_TOOL_RADIUS);
  EXPECT_EQ(straight.run("F10\nT01D01\nG41G43G01X10\nX20\nG40\nX30").path()[0], "line 10 2 0 F10");  // G43: docs/series8.md
  for (const char* across : {"G41\nG00Z-1\nG43G01X10", "G41G00Z-1\nG43G01X10"}) {  // Z is no first move
    Bench lowered(NC_DIALECT_SERIES8);
    lowered.tool(1, 2, NC_TOOL_RADIUS);
    EXPECT_EQ(lowered.run(std::string("F10\nT01D01\n") + across + "\nX20\nG40\nX30").path()[1], "line 10 2 -1 F10") << across;
  }
  for (const char* late : {"F10\nG43G01X10", "F10\nT01D01\nG41G01X10Y0\nG43X20"}) {
    const Outcome run = straight.run(late);
    EXPECT_EQ(run.alarm, "NC-MODE") << late;
    EXPECT_EQ(run.alarm_detail, "G43 stands in the block of the first move with G41 or G42, and in no other.") << late;
  }
}

TEST(Series8Compensation, GoesRoundSharpCornersOnAnArc) {
  const auto kinds = [](const std::string& corner) {
    Bench bench(NC_DIALECT_SERIES8);
    bench.tool(1, 2, NC_TOOL_RADIUS);
    std::string all;
    for (const nc_move& move : bench.run("F10\nD1\nG42\nG01X20\n" + corner + "\nG40\nX-50").moves()) all += move.kind == NC_MOVE_ARC ? 'a' : 'l';
    return all;
  };
  EXPECT_EQ(kinds("X10Y20").find('a'), 2u) << "63 degrees";  // 180 - 116.6
  EXPECT_EQ(kinds("X15Y20").find('a'), std::string::npos) << "76 degrees";
  EXPECT_EQ(kinds("Y20").find('a'), std::string::npos) << "90 degrees";
}

// ---- maps

TEST(Series8Map, TurnsAboutProgramZero) {  // G55
  const Outcome run = series8("G00X5Y5\nG55R45\nG01F50X10\nY10\nG56\nG00X0Y0");
  const auto moves = run.moves();
  ASSERT_EQ(moves.size(), 4u);
  const double r = std::sqrt(0.5);
  EXPECT_NEAR(moves[1].machine.v[0], 5 * r, 1e-9);  // X10, and Y5 from before
  EXPECT_NEAR(moves[1].machine.v[1], 15 * r, 1e-9);
  EXPECT_NEAR(moves[2].machine.v[0], 0, 1e-9);
  EXPECT_NEAR(moves[2].machine.v[1], 20 * r, 1e-9);
  EXPECT_EQ(path_of("G92X-10Y-20\nG55R-90\nG00X5Y3"), (Path{"rapid 13 15 0"}));
  EXPECT_EQ(path_of("G55R90\nG00X10Y0\nG91X5Y0\nX0Y7"), (Path{"rapid 0 10 0", "rapid 0 15 0", "rapid -7 15 0"}));
  EXPECT_EQ(path_of("G91\nG55R90\nG55R90\nG90G00X10Y0"), (Path{"rapid 0 10 0"}));  // angles are never added
  EXPECT_EQ(path_of("G55R90X10Y0"), (Path{"rapid 0 10 0"}));  // beside a move
  EXPECT_EQ(alarm_of("G55\nX1"), "NC-WORDS");
  EXPECT_EQ(alarm_of("F10\nG02X2Y0R1\nG55R90X5"), "NC-MODE");  // R of which of the two?
}

TEST(Series8Map, ScalesThePlane) {  // G57
  EXPECT_EQ(path_of("G00X5Y5\nG57R.5\nG01F50X6\nY10\nX8Y12Z4\nG58\nX1"),
            (Path{"rapid 5 5 0", "line 3 2.5 0 F50", "line 3 5 0 F50", "line 4 6 4 F50", "line 1 6 4 F50"}));
  EXPECT_EQ(path_of("F100\nG57R2.5\nG00X4Y0\nG03X0Y4R4"), (Path{"rapid 10 0 0", "ccw 0 10 0 c0,0 F100"}));
  for (const char* block : {"G57R0", "G57R-1", "G57R1000"}) EXPECT_EQ(alarm_of(std::string(block) + "\nX1"), "NC-RANGE") << block;
  EXPECT_EQ(alarm_of("G57\nX1"), "NC-WORDS");
}

TEST(Series8Map, ProgramZeroIsSetInProgramCoordinates) {  // G92 while G55 or G57 is in force
  EXPECT_EQ(path_of("G57R2\nG00X10Y20\nG92X0\nX5"), (Path{"rapid 20 40 0", "rapid 30 40 0"}));
  EXPECT_EQ(path_of("G55R90\nG00X10Y20\nG92X0Y0\nX5"), (Path{"rapid -20 10 0", "rapid -20 15 0"}));
}

TEST(Series8, ACodeOfOneBlockHoldsForIt) {  // G67 to G69
  EXPECT_EQ(path_of("F100\nG01X2\nG68X2\nG69Y3\nG67X1\nG91\nG67X5\nX1\nG69X2"),
            (Path{"line 2 0 0 F100", "line 4 0 0 F100", "line 4 3 0 F100", "line 1 3 0 F100", "line 5 3 0 F100", "line 6 3 0 F100", "line 2 3 0 F100"}));
  EXPECT_EQ(path_of("G92X-10\nG00X0\nG69X3\nX0"), (Path{"rapid 10 0 0", "rapid 3 0 0", "rapid 10 0 0"}));
  EXPECT_EQ(path_of("F10\nG00Z10\nG91\nG67G81X5Z-3R2"), (Path{"rapid 0 0 10", "rapid 5 0 10", "rapid 5 0 2", "line 5 0 -3 F10", "rapid 5 0 2"}));
}

TEST(Series8, ProgramZeroEndsWithTheProgram) {  // G92, G98
  EXPECT_EQ(path_of("G00X20Y30\nG92X0\nG98Y100\nG00X-3Y90"), (Path{"rapid 20 30 0", "rapid 17 20 0"}));
  Bench bench(NC_DIALECT_SERIES8);
  EXPECT_EQ(bench.run("G92X5\nG00X6\nM30").path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(bench.run("G00X6\nM30").path().back(), "rapid 6 0 0");
}

TEST(Series8, InverseTimeHoldsUntilTheNextF) {  // G93
  const auto moves = series8("G70\nG00X0\nG93F2\nG01X10.\nX15").moves();
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_NEAR(moves[0].feed_mm_min, 20 * 25.4, 1e-6);
  EXPECT_NEAR(moves[1].feed_mm_min, 10 * 25.4, 1e-6);
}

// ---- cycles

TEST(Series8Cycle, EndsAtRAndItsLevelsStay) {  // G80, G81
  EXPECT_EQ(path_of("F10\nG00Z10\nG81X1Y2Z-3R4\nX5\nG80\nG82Y9P.5\nG80\nG00X0"),
            (Path{"rapid 0 0 10", "rapid 1 2 10", "rapid 1 2 4", "line 1 2 -3 F10", "rapid 1 2 4", "rapid 5 2 4", "line 5 2 -3 F10", "rapid 5 2 4", "rapid 5 9 4",
                  "line 5 9 -3 F10", "rapid 5 9 4", "rapid 0 9 4"}));
  EXPECT_EQ(series8("F10\nG82X1Z-3R4P1.25").dwells(), (std::vector<double>{1.25}));
  EXPECT_EQ(alarm_of("F10\nG81X1Z-3"), "NC-WORDS");
}

TEST(Series8Cycle, OfAMotionAndACycleTheLaterOneCounts) {  // G80
  EXPECT_EQ(path_of("F10\nG00G81X1Z-1R1"), (Path{"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F10", "rapid 1 0 1"}));
  EXPECT_EQ(path_of("F10\nG81G00X1Z-1R1"), (Path{"rapid 1 0 -1"}));
}

TEST(Series8Cycle, PositionsARotaryAxisTogetherWithXY) {
  const auto with_a = [](nc_config& config) {
    config.system[0].axis_count = 4;
    config.system[0].axis[3] = config.system[0].axis[0];
    config.system[0].axis[3].name = 'A';
    config.system[0].axis[3].rotary = true;
  };
  EXPECT_EQ(Bench(NC_DIALECT_SERIES8, with_a).run("F10\nG00Z10\nG81X1Y2A90Z-3R4").path(),
            (Path{"rapid 0 0 10 0", "rapid 1 2 10 90", "rapid 1 2 4 90", "line 1 2 -3 90 F10", "rapid 1 2 4 90"}));
}

TEST(Series8Cycle, PecksFromAFirstDepth) {  // G83
  EXPECT_EQ(path_of("F10\nG83X2R1Z-10I-4J4"), (Path{"rapid 2 0 0", "rapid 2 0 1", "line 2 0 -4 F10", "rapid 2 0 1", "rapid 2 0 -2.73", "line 2 0 -8 F10", "rapid 2 0 1",
                                                    "rapid 2 0 -6.73", "line 2 0 -10 F10", "rapid 2 0 1"}));
  EXPECT_EQ(alarm_of("F10\nG83X2R1Z-10I4J4"), "NC-RANGE");
  EXPECT_EQ(alarm_of("F10\nG83X2R1Z-10I-4"), "NC-WORDS");
}

TEST(Series8Cycle, TapsWithTheSpindleByItsLead) {  // G84
  const Outcome run = series8("M03S600\nG00Z5\nG84X1Z-6R2K1.25");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  const auto moves = run.moves();
  ASSERT_EQ(moves.size(), 5u);
  EXPECT_EQ(moves[3].kind, NC_MOVE_TAP);
  EXPECT_NEAR(moves[3].feed_mm_rev, 1.25, 1e-9);
  EXPECT_NEAR(moves[3].feed_mm_min, 750, 1e-9);
  EXPECT_EQ(alarm_of("M03S600\nG84X1Z-6R2"), "NC-FEED");
  EXPECT_EQ(alarm_of("M73"), "NC-NOT-BUILT");
}

TEST(Series8Cycle, BoresInTheWayOfEachCode) {  // G85 to G89
  const std::string begin = "M04S600\nF10\nG00Z10\n";
  EXPECT_EQ(path_of(begin + "G85X1Z-3R4P.2").back(), "line 1 0 4 F10");
  const Outcome stopped = series8(begin + "G86X1Z-3R4P.2");
  EXPECT_EQ(stopped.path().back(), "rapid 1 0 4");
  EXPECT_EQ(stopped.aux(), "S600 M4 M5 M4");
  EXPECT_EQ(path_of(begin + "G87X5Y6R3.5Z3\nR2Z1\nG80"),
            (Path{"rapid 0 0 10", "rapid 5 6 10", "rapid 5 6 3.5", "line 5 6 3 F10", "rapid 5 6 2", "line 5 6 1 F10"}));
  const Outcome oriented = series8(begin + "G88X5Z-3R4I.5J-.25P1");
  EXPECT_EQ(oriented.path(), (Path{"rapid 0 0 10", "rapid 5 0 10", "rapid 5 0 4", "line 5 0 -3 F10", "rapid 5.5 -0.25 -3", "rapid 5.5 -0.25 4", "rapid 5 0 4"}));
  EXPECT_EQ(oriented.aux(), "S600 M4 M5 M19 M4");
  const Outcome upwards = series8(begin + "G89X5R-20Z-15I2P1");
  EXPECT_EQ(upwards.path(), (Path{"rapid 0 0 10", "rapid 5 0 10", "rapid 7 0 10", "rapid 7 0 -20", "rapid 5 0 -20", "line 5 0 -15 F10", "line 5 0 -20 F10", "rapid 7 0 -20",
                                  "rapid 7 0 10", "rapid 5 0 10"}));
  EXPECT_EQ(upwards.aux(), "S600 M4 M5 M19 M4 M5 M19 M4");
  EXPECT_EQ(alarm_of("F10\nG86X1Z-3R4"), "NC-SPINDLE");  // which way would it turn again?
}

TEST(Series8Cycle, CaseBoringLeavesItsHoleForTheNext) {  // G87: X Y A are of the "first block", and the tool stands at the bottom
  const std::string begin = "F50\nG00Z10\n";
  const Path hole = {"rapid 0 0 10", "rapid 1 1 10", "rapid 1 1 1", "line 1 1 -1 F50"};
  const auto behind = [&](const std::string& blocks) {
    Path path = path_of(begin + "G87X1Y1Z-1R1\n" + blocks);
    EXPECT_GT(path.size(), hole.size()) << blocks;
    EXPECT_EQ(Path(path.begin(), path.begin() + 4), hole) << blocks;
    return path.size() > 4 ? Path(path.begin() + 4, path.end()) : Path();
  };
  EXPECT_EQ(behind("X2"), (Path{"rapid 1 1 1", "rapid 2 1 1", "line 2 1 -1 F50"}));
  EXPECT_EQ(behind("X2R3"), (Path{"rapid 1 1 3", "rapid 2 1 3", "line 2 1 -1 F50"}));
  EXPECT_EQ(behind("R-2Z-3\nX2R1Z-1"), (Path{"rapid 1 1 -2", "line 1 1 -3 F50", "rapid 1 1 1", "rapid 2 1 1", "line 2 1 -1 F50"}));
  EXPECT_EQ(behind("X1Y1R-2Z-3"), (Path{"rapid 1 1 -2", "line 1 1 -3 F50"}));  // the same place
  EXPECT_EQ(behind("G81X2"), (Path{"rapid 1 1 1", "rapid 2 1 1", "line 2 1 -1 F50", "rapid 2 1 1"}));
  EXPECT_EQ(behind("G80\nX2"), (Path{"rapid 2 1 -1"}));  // behind G80 it goes as it is programmed
  EXPECT_EQ(behind("G49X1Y1I5J5"), (Path{"rapid 1 1 1", "line 1 1 -1 F50", "rapid 1 1 1", "rapid 6 1 1", "line 6 1 -1 F50", "rapid 6 1 1", "rapid 6 6 1", "line 6 6 -1 F50",
                                         "rapid 6 6 1", "rapid 1 6 1", "line 1 6 -1 F50"}));
  const Outcome lost = series8(begin + "G87X1Y1Z-1R1\nR-2Z-3\nX2");  // at R of the layer it would go into the part in rapid traverse
  EXPECT_EQ(lost.alarm, "NC-WORDS");
  EXPECT_EQ(lost.alarm_line, 5u);
}

TEST(Series8Cycle, LengthsOfCyclesHoldUntilACycleHasAnother) {  // docs/series8.md
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 5, NC_TOOL_LENGTH);
  const std::string begin = "F50\nG00Z20\nG81X1Z-1R1D1\nG80\nG00Z10\n";
  EXPECT_EQ(bench.run(begin + "D0Z12\nM30").path().back(), "rapid 1 0 17");  // that D is a cutter
  EXPECT_EQ(bench.run(begin + "G81D0\nG80\nG00Z12\nM30").path().back(), "rapid 1 0 12");
}

TEST(Series8Arc, DoesNotBeginBesideItsStartInANewMap) {  // G55, G57: the position that was programmed stays programmed
  for (const char* map : {"G55R90", "G57R2"}) {
    const std::string begin = std::string("F10\nG00X5Y5\n") + map + "\n";
    EXPECT_EQ(alarm_of(begin + "G02X6Y6R1"), "NC-MODE") << map;
    EXPECT_EQ(alarm_of(begin + "G01X5Y5\nG02X6Y6R1"), "") << map;
  }
  EXPECT_EQ(alarm_of("F10\nG55R90\nG02X1Y1R1"), "");  // at the zero point they stand there
}

TEST(Series8, AnArcHasRadiusOrCentre) {  // G02
  EXPECT_EQ(alarm_of("F50\nG02X2Y0I1J0R5"), "NC-FORMAT");
  EXPECT_EQ(alarm_of("F50\nG02X2Y0R5"), "");
}

TEST(Series8Cycle, CutsDownwardsFromRInAllButG89) {  // G80: "the R-plane is typically a clearance position", "the Z-plane the final depth"; both are saved
  const Outcome run = series8("M03S600F50\nG89X1R-9Z-5I.5J0\nG81X10");
  EXPECT_EQ(run.alarm + " " + run.alarm_detail, "NC-RANGE R must be above the bottom.");  // it would go down to R in rapid traverse, through the part
  EXPECT_EQ(run.path().back(), "rapid 1 0 0");
  EXPECT_EQ(series8("M03S600F50\nG89X1R-9Z-5I.5J0\nG81X10R2").alarm, "");
}

TEST(Series8Cycle, WhatWouldCutTheWallIsAnAlarm) {  // G88, G89: "shifted off-center to allow passing the boring tool through the hole"
  for (const char* block : {"G89X3R-3Z-1", "G88X3R1Z-1"}) EXPECT_EQ(alarm_of(std::string("F100M3S100\nG00Z10\n") + block + "\nM30"), "NC-WORDS") << block;
}

TEST(Series8Cycle, PlacesBesideItsCodeAreAnAlarm) {  // G49, G50 in a cycle: in a block of their own, where I and J are those of the pattern
  for (const char* code : {"G49X0Y0I10J10K3L3", "G50X0Y0I10J10K3L3", "G34X0Y0I6J4D1", "G06X1Y1"}) {
    const Outcome run = series8(std::string("F100\nG00Z10\nG81") + code + "Z-1R1\nG80\nM30");
    EXPECT_EQ(run.alarm, "NC-FORMAT") << code;
    EXPECT_EQ(run.alarm_line, 3u) << code;
  }
  EXPECT_EQ(alarm_of("F100\nG00Z10\nG81X0Y0Z-1R1\nG49X0Y0I10J10K3L3\nG80\nM30"), "");
}

TEST(Series8Cycle, TheShiftIsThatOfTheSpindle) {  // G88: no map turns or scales it
  const auto shifted = [](const std::string& map) {
    const Path path = path_of("M04S600\nF10\n" + map + "\nG88X5Y0Z-5R2I.5P0");
    return path.size() > 3 ? path[3] : std::string();
  };
  EXPECT_EQ(shifted("G55R180"), "rapid -4.5 0 -5");
  EXPECT_EQ(shifted("G57R2"), "rapid 10.5 0 -5");
}

TEST(Series8Cycle, TakesTheLengthOfItsTool) {  // G81 D
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(3, 50, NC_TOOL_LENGTH);
  EXPECT_EQ(bench.run("F10\nG00Z100\nG81X1Z-3R4D3M03S500").path(), (Path{"rapid 0 0 100", "rapid 1 0 100", "rapid 1 0 54", "line 1 0 47 F10", "rapid 1 0 54"}));
}

// ---- docs/series8.md

TEST(Series8Pattern, LiesOnTheSidesOfARectangle) {  // G49, G50
  EXPECT_EQ(path_of("F10\nG81Z-1R1\nG49X10Y20I30J10K3L2\nG80").size(), 3u + 3 * 6);
  const auto places = [](const std::string& block) {
    Path found;
    for (const std::string& move : path_of("F100\nG00X10Y20\nG01\n" + block))
      if (move.substr(0, 4) == "line") found.push_back(move);
    return found;
  };
  EXPECT_EQ(places("G49I30J10"), (Path{"line 40 20 0 F100", "line 40 30 0 F100", "line 10 30 0 F100", "line 10 20 0 F100"}));
  EXPECT_EQ(places("G50I30J10"), (Path{"line 10 30 0 F100", "line 40 30 0 F100", "line 40 20 0 F100", "line 10 20 0 F100"}));
  EXPECT_EQ(places("G49I30J10K4")[0], "line 20 20 0 F100");
  for (const char* block : {"G49I30", "G49J30"}) EXPECT_EQ(alarm_of(block), "NC-WORDS") << block;
  for (const char* block : {"G49I30J-1", "G49I30J10K1"}) EXPECT_EQ(alarm_of(block), "NC-RANGE") << block;
}

// The holes of a pattern need what every other hole needs: without R and Z its places were gone to, and nothing was drilled.
TEST(Series8Pattern, NeedsTheLevelsOfItsCycle) {
  EXPECT_EQ(alarm_of("F10\nG81\nG49I30J10\nG80\nM30"), "NC-WORDS");
  EXPECT_EQ(alarm_of("S600M03\nG84\nG50I30J10\nG80\nM30"), "NC-WORDS");
  EXPECT_EQ(alarm_of("F10\nG81X0Y0Z-1R1\nG82\nG49I30J10\nG80\nM30"), "");
}

TEST(Series8Cavity, ItsNumberOfTheOffsetHoldsBehindIt) {
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  const Outcome run = bench.run("F300\nG00Z20\nG34X100Y50Z-8R2I60J40D1\nG00X0Y0\nG41X40\nG01X50\nM30");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(run.path().back(), "line 50 2 2 F300");
}

TEST(Series8Cavity, IsMilledInRingsAndDepths) {  // G34 to G36
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 5, NC_TOOL_RADIUS);
  const Outcome run = bench.run("F300\nG00Z20\nG34X100Y50Z-8R2I60J40K5D1");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  const Path path = run.path();
  // Down in two cuts, each from the centre; the last ring leaves the radius of the cutter to the walls.
  EXPECT_EQ(path[1], "rapid 100 50 20");
  EXPECT_EQ(path[2], "rapid 100 50 2");
  EXPECT_EQ(path[3], "line 100 50 -3 F300");
  double least[2] = {1e9, 1e9}, most[2] = {-1e9, -1e9};
  for (const nc_move& move : run.moves())
    for (unsigned i = 0; i < 2; ++i) {
      if (move.machine.v[2] > 0) continue;
      least[i] = std::fmin(least[i], move.machine.v[i]);
      most[i] = std::fmax(most[i], move.machine.v[i]);
    }
  EXPECT_EQ(least[0], 75);
  EXPECT_EQ(most[0], 125);
  EXPECT_EQ(least[1], 35);
  EXPECT_EQ(most[1], 65);
  EXPECT_EQ(path.back(), "rapid 100 50 2");
  EXPECT_EQ(bench.run("F300\nG34X0Y0Z-1R1I12J20D1").path()[3], "line 0 4 -1 F300");  // the line between the long walls
  const auto first_turn = [&](const char* code) { return bench.run(std::string("F300\n") + code + "X0Y0Z-1R1I60J40Q8D1").moves(); };
  EXPECT_GT(first_turn("G34")[6].machine.v[1], 0);  // from the middle of the right side upwards ...
  EXPECT_LT(first_turn("G35")[6].machine.v[1], 0);  // ... and downwards
  const Outcome circle = bench.run("F300\nG36X0Y0Z-1R1I15D1Q5");
  unsigned rings = 0;
  for (const nc_move& move : circle.moves()) rings += move.kind == NC_MOVE_ARC ? 1u : 0u;
  EXPECT_EQ(rings, 2u);
}

TEST(Series8Cavity, RefusesWhatCannotBeMilled) {
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 5, NC_TOOL_RADIUS);
  const auto alarm = [&](const std::string& block) { return bench.run("F300\n" + block).alarm; };
  for (const char* block : {"G34X0Z-1R1I60D1", "G34X0Z-1I60J40D1", "G34X0R1I60J40D1", "G34X0Z-1R1I60J40D0"}) EXPECT_EQ(alarm(block), "NC-WORDS") << block;
  EXPECT_EQ(alarm("G34X10Y10Z-2R1I20J10K1Q2D2\nM30"), "");  // D2 has no radius yet: the path of the centre
  EXPECT_EQ(alarm("G34X10Y10Z-2R1I20J10K1D2"), "NC-WORDS");
  for (const char* block : {"G34X0Z-1R1I8J40D1", "G36X0Z-1R1I5D1", "G34X0Z2R1I60J40D1", "G34X0Z-1R1I60J40P30D1", "G34X0Z-1R1I60J40K-1D1", "G34X0Z-1R1I60J40Q0D1", "G34X0Z-1R1I60J40Q15D1",
                            "G36X0Z-1R1I30Q25D1", "G34X0Z-1R1I60J40P2D1"})
    EXPECT_EQ(alarm(block), "NC-RANGE") << block;
}

TEST(Series8Cavity, SaysWhyItCannotBeMilled) {
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 5, NC_TOOL_RADIUS);
  const auto said = [&](const std::string& block) { return bench.run("F300\n" + block).alarm_detail; };
  EXPECT_EQ(said("G34X0Z-1R1I8J40D1"), "The cavity is smaller than its cutter: I8.");
  EXPECT_EQ(said("G36X0Z-1R1I5D1"), "The cavity is smaller than its cutter: I5.");
  EXPECT_EQ(said("G34X0Z2R1I60J40D1"), "R must be above the bottom.");
  EXPECT_EQ(said("G34X0Z-1R1I60J40P2D1"), "Corners have a radius from that of the cutter to half of the shorter side: P2 is none.");
  EXPECT_EQ(said("G36X0Z-1R1I30Q25D1"), "The rings would be farther from each other than the cutter is wide: make Q smaller.");
}

// Round corners go through all rings as arcs, and a step that leaves posts in the corners is made smaller.
TEST(Series8Cavity, RingsHaveTheCornersOfTheWall) {
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  const Outcome run = bench.run("F50\nG34X0Y0Z-2R1I20J20P10D1");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  for (const nc_move& move : run.moves()) EXPECT_LE(std::hypot(move.machine.v[0], move.machine.v[1]), 8 + 1e-9) << "the cutter stays within the circle";
  double second = 0;
  for (const nc_move& move : bench.run("F50\nG34X0Y0Z-2R1I20J20Q4D1").moves())
    if (move.machine.v[0] < 7.9) second = std::fmax(second, move.machine.v[0]);
  EXPECT_NEAR(second, 8 - 8.0 / 3, 1e-9) << "three rings in place of two";
}

TEST(Series8, APatternHasWholeNumbersAndStraightSides) {  // G49
  EXPECT_EQ(alarm_of("G49I20J10K2.5"), "NC-RANGE");
  EXPECT_EQ(alarm_of("G49I20J10K3L2.001"), "NC-RANGE");
  EXPECT_EQ(alarm_of("G02F50R5\nG49X1I20J10"), "NC-MODE");
}

TEST(Series8, ThePlaneStaysWhileThePartIsScaled) {  // G57: "in the active plane"
  const Outcome run = series8("G57R2\nG01F50X1Y1Z3\nG18\nX1Z1");
  EXPECT_EQ(run.alarm, "NC-PLANE");
  EXPECT_EQ(run.alarm_detail, "The plane stays while the part is rotated or scaled. Select it in front of that, or behind G56 and G58.");
  EXPECT_EQ(alarm_of("G57R2\nG17X1"), "");
}

TEST(Series8, ACycleEndsBesideEachFunction) {  // G80
  EXPECT_EQ(series8("G80G57R2\nG00X10Y0").path().back(), "rapid 20 0 0");
  EXPECT_EQ(series8("G80G55R90\nG00X10Y0").path().back(), "rapid 0 10 0");
  EXPECT_EQ(alarm_of("F50\nG57G81X1Y1R1Z-1"), "NC-ADDRESS");
}

TEST(Series8, CornersAreWordsOfG10) {
  EXPECT_EQ(series8("G01F50G10X10R20\nY5\nX0").alarm_detail, "The block is shorter than its corner R20. Make the corner smaller.");
}

TEST(Series8, AProbeWithoutContactIsAnAlarm) {  // G51
  Bench touching(NC_DIALECT_SERIES8);
  touching.skip_at = [](const nc_item&) { return std::optional<double>(0.0); };
  EXPECT_EQ(touching.run("F100\nG51Z-5").alarm, "NC-PROBE");  // it touches before it has moved
  EXPECT_EQ(alarm_of("F100\nG51Z-5"), "NC-PROBE");
  EXPECT_EQ(alarm_of("G51Z-5"), "NC-FEED");
}

// ---- constant surface speed

TEST(Series8Spindle, HoldsAndResumesTheSurfaceSpeed) {  // M59, M58
  std::string controls;
  for (const nc_item& item : series8("G96S100\nM59\nS200\nM58\nG97").of(NC_ITEM_ACTION)) {
    const nc_action& a = item.u.action;
    if (a.kind == NC_ACTION_CONTROL && a.index == NC_CONTROL_SURFACE_SPEED) controls += (a.bits == 0 ? "off " : brief(a.value) + " ");
    if (a.kind == NC_ACTION_S) controls += "S" + brief(a.value) + " ";
  }
  EXPECT_EQ(controls, "100 S100 off 200 off ");
}

}  // namespace
}  // namespace nc::test
