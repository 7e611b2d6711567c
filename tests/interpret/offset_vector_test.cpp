// SPDX-License-Identifier: Apache-2.0
// G38 and G39 in radius compensation (M700 12.4.2, DGSHAPE G39): words, blocks without movement, mirror image, alarms.
#include <gtest/gtest.h>

#include "support/going_back.hpp"

namespace nc::test {
namespace {

Path path_of(const std::string& text, nc_dialect dialect = NC_DIALECT_M700) {
  Bench bench(dialect);
  const nc_tool_column radius = dialect == NC_DIALECT_DGSHAPE ? NC_TOOL_RADIUS : NC_TOOL_LENGTH;
  bench.tool(1, 5, radius).tool(2, 3, radius);
  const Outcome run = bench.run(dialect == NC_DIALECT_DGSHAPE ? "%\n" + text : text);
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  Path all = run.path();
  for (std::string& move : all)
    if (const size_t feed = move.find(" F"); feed != std::string::npos) move.resize(feed);
  return all;
}

std::string alarm_of(const std::string& text) {
  Bench bench;
  bench.tool(1, 5).tool(2, 3);
  const Outcome run = bench.run(text);
  return run.alarm + " L" + std::to_string(run.alarm_line);
}

TEST(CornerArc, GoesRoundTheEndOfItsBlockAndOfNoOther) {
  EXPECT_EQ(path_of("G91 G1 G42 X20. Y20. D1 F100\nG39 X40.\nY40.\nX-40.\nG40 X-20.\nM30"),
            (Path{"line 20 15 0", "line 60 15 0", "ccw 65 20 0 c60,20", "line 65 65 0", "line 20 65 0", "line 0 60 0"}));
}

TEST(CornerArc, AloneItBelongsToTheEndOfTheBlockBefore) {
  EXPECT_EQ(path_of("G91 G1 G42 X20. Y20. D1 F100\nX40.\nG39\nY40.\nG40 X-20.\nM30"),
            (Path{"line 20 15 0", "line 60 15 0", "ccw 65 20 0 c60,20", "line 65 60 0", "line 40 60 0"}));
}

TEST(CornerArc, InsideItRunsTheSameWay) {  // 12.4.2: "for outer and inner corners"
  EXPECT_EQ(path_of("G91 G1 G41 X20. Y20. D1 F100\nG39 X40.\nY40.\nG40 X-20.\nM30"),
            (Path{"line 20 25 0", "line 60 25 0", "ccw 55 20 0 c60,20", "line 55 60 0", "line 40 60 0"}));
}

TEST(CornerArc, BehindARapidItGoesAtTheFeedOfItsOwnBlock) {
  Bench bench;
  bench.tool(1, 5);
  const Outcome run = bench.run("G91 G0 G42 D1 X20. Y20.\nX40.\nG1 G39 F100\nY40.\nG40 X-20.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 20 15 0", "rapid 60 15 0", "ccw 65 20 0 c60,20 F100", "line 65 60 0 F100", "line 40 60 0 F100"}));
  EXPECT_EQ(alarm_of("G91 G0 G42 D1 X20. Y20.\nX40.\nG1 G39\nG40 Y40. F100\nM30"), "P62 L3");
}

TEST(CornerArc, ThereIsNoneWhereRapidsAreInForce) {
  EXPECT_EQ(alarm_of("G91 G1 F100\nG0 G42 D1 X20. Y20.\nG39 X40.\nY40.\nM30"), "P385 L3");
  EXPECT_EQ(alarm_of("G91 G1 F100\nG0 G42 D1 X20. Y20.\nX40.\nG39\nY40.\nM30"), "P385 L4");
}

TEST(CornerArc, AnArcBeforeItKeepsItsCentre) {
  EXPECT_EQ(path_of("G91 G1 G42 X20. Y20. D1 F100\nX20.\nG39 G3 X10. Y10. J10.\nG1 X-30.\nG40 Y-20.\nM30"),
            (Path{"line 20 15 0", "line 40 15 0", "ccw 55 30 0 c40,30", "ccw 50 35 0 c50,30", "line 20 35 0", "line 20 10 0"}));
}

TEST(HeldVector, StaysThatOfTheEndBefore) {
  EXPECT_EQ(path_of("G1 G41 X10. D1 F100\nX50.\nG38 X50. Y30.\nG40 Y60.\nM30"),
            (Path{"line 10 5 0", "line 45 5 0", "line 45 35 0", "line 50 60 0"}));
}

TEST(HeldVector, LiesAlongTheWordsWithTheAmountOfItsBlock) {
  EXPECT_EQ(path_of("G1 G41 X10. D1 F100\nX50.\nG38 X90. I3. J4. D2\nG40 Y60.\nM30"),
            (Path{"line 10 5 0", "line 50 5 0", "line 91.8 2.4 0", "line 90 60 0"}));
}

TEST(HeldVector, WithoutMovementItIsGoneTo) {
  EXPECT_EQ(path_of("G1 G41 X10. D1 F100\nX50.\nG38 I-5. J0\nY30.\nG40 Y60.\nM30"),
            (Path{"line 10 5 0", "line 45 0 0", "line 45 30 0", "line 50 60 0"}));
}

TEST(HeldVector, IsMirroredWithItsPath) {
  EXPECT_EQ(path_of("G51.1 X0\nG1 G41 X10. D1 F100\nX50.\nG38 X90. I3. J4. D2\nG40 Y60.\nM30"),
            (Path{"line -10 5 0", "line -50 5 0", "line -91.8 2.4 0", "line -90 60 0"}));
}

TEST(HeldVector, TheWordsOfAnArcAreTheVectors) {  // 12.4.2: "and an error will occur"
  EXPECT_EQ(alarm_of("G1 G41 X10. D1 F100\nX50.\nG38 G2 X70. I10. J0\nM30"), "P33 L3");
  EXPECT_EQ(path_of("G1 G41 X10. D1 F100\nX50.\nG38 G3 X70. Y20. R20. I-3. J4.\nG1 G40 X0\nM30"),
            (Path{"line 10 5 0", "line 50 5 0", "ccw 67 24 0 c50,20", "line 0 20 0"}));
}

TEST(HeldVector, OnlyInTheMode) {
  EXPECT_EQ(alarm_of("G1 F100\nG38 X10. I1.\nM30"), "P150 L2");
  EXPECT_EQ(alarm_of("G1 F100\nG39 X10.\nM30"), "P150 L2");
  EXPECT_EQ(alarm_of("G1 G41 D1 X10. F100\nG38 X20. I0 J0\nM30"), "P35 L2");
}

TEST(CancelVector, LeadsToTheMeetingWithAHypotheticalPath) {  // 12.4.2, G40 with I J K
  EXPECT_EQ(path_of("G91 G1 G41 X10. D1 F100\nX40.\nG40 X20. Y-20. I10. J10.\nM30"), (Path{"line 10 5 0", "line 47.928932 5 0", "line 70 -20 0"}));
  // Nearly straight back: the vector would be extremely large.
  EXPECT_EQ(path_of("G91 G1 G41 X10. D1 F100\nX40.\nG40 X20. Y-20. I-10. J-0.1\nM30"), (Path{"line 10 5 0", "line 50 5 0", "line 70 -20 0"}));
}

TEST(VectorsTakenAway, ByReferenceReturnMachineMoveAndThread) {  // 12.4.2
  EXPECT_EQ(path_of("G1 G41 X10. D1 F100\nX50.\nG53 X50. Y50.\nG1 X90. Y50.\nX99.\nG40 Y0\nM30"),
            (Path{"line 10 5 0", "line 45 5 0", "rapid 50 50 0", "line 90 55 0", "line 99 55 0", "line 99 0 0"}));
  EXPECT_EQ(path_of("G1 G41 X10. D1 F100\nX50.\nG92 X0 Y0\nX40.\nX60.\nG40 Y9.\nM30"),
            (Path{"line 10 5 0", "line 50 5 0", "line 90 5 0", "line 110 5 0", "line 110 9 0"}));
}

TEST(HeldVector, EveryMarkIsAPlaceToGoOnFrom) {
  goes_on_from_every_mark("G1 G41 X10. D1 F100\nX50.\nG39\nY30.\nM8\nG38 X70. Y50.\nG38 I3. J4.\nX90.\nG39 Y90.\nX20.\nG40 Y120. I1. J1.\nM30",
                          [](Bench& bench) { bench.tool(1, 5).param("8103", "1"); });
}

TEST(CornerTurn, DgshapeNamesTheDirectionAndGoesNowhere) {
  const Path expected = {"line 20 15 0", "line 60 15 0", "ccw 65 20 0 c60,20", "line 65 60 0", "line 40 60 0"};
  EXPECT_EQ(path_of("G91 G17 G1 G42 D1 X20.0 Y20.0 F100\nX40.0\nG39 Y40.0\nY40.0\nG40 X-20.0\nM02", NC_DIALECT_DGSHAPE), expected);
  EXPECT_EQ(path_of("G90 G17 G1 G42 D1 X20.0 Y20.0 F100\nX60.0\nG39 X60.0 Y60.0\nX60.0 Y60.0\nG40 X40.0\nM02", NC_DIALECT_DGSHAPE), expected);
}

TEST(CornerTurn, DgshapeAlarms) {
  for (const char* text : {"G1 F100\nG39 X1.0\nM02", "G1 G42 D1 X20.0 F100\nG39\nM02", "G1 G42 D1 X20.0 F100\nG39 Z1.0\nM02"}) {
    Bench bench(NC_DIALECT_DGSHAPE);
    bench.tool(1, 5);
    const Outcome run = bench.run("%\n" + std::string(text));
    EXPECT_NE(run.alarm, "") << text;
    EXPECT_EQ(run.alarm_line, 3u) << text;
  }
}

// HX 13.2.1, DGSHAPE G39: behind the start there is no path yet that an arc could go round, but by type B. The words of G39 are the way of the block behind, so the start ends as it does in front of that.
TEST(CornerTurn, BehindAStartLeadsToItsVector) {
  for (const nc_dialect family : {NC_DIALECT_HX, NC_DIALECT_DGSHAPE}) {
    const std::string head = family == NC_DIALECT_DGSHAPE ? "%\n" : "(at the head)\n";
    const char* const type = family == NC_DIALECT_DGSHAPE ? "startup" : "3128";
    const auto path = [&](const char* start_type, const char* text) {
      Bench bench(family);
      bench.tool(1, 3).tool(1, 3, NC_TOOL_RADIUS).param(type, start_type);
      const Outcome run = bench.run(head + text + "\nM02");
      Path moves = run.path();
      for (std::string& move : moves) move = move.substr(0, move.find(" F"));
      if (!run.alarm.empty()) moves.push_back(run.alarm + " L" + std::to_string(run.alarm_line));
      return moves;
    };
    const char* const a = family == NC_DIALECT_DGSHAPE ? "A" : "0";
    const char* const b = family == NC_DIALECT_DGSHAPE ? "B" : "1";
    const char* const outer = "G01 G42 D1 X10.0 F100\nG39 X10.0 Y10.0\nX10.0 Y10.0\nX0";
    EXPECT_EQ(path(a, outer), (Path{"line 13 0 0", "line 13 13 0", "line 0 13 0"}));
    EXPECT_EQ(path(b, outer), (Path{"line 10 -3 0", "ccw 13 0 0 c10,0", "line 13 13 0", "line 0 13 0"}));
    EXPECT_EQ(path(a, "G42 D1\nG01 X10.0 F100\nG39 X10.0 Y10.0\nX10.0 Y10.0\nX0"), (Path{"line 13 0 0", "line 13 13 0", "line 0 13 0"})) << "the code alone waits for the move";
    EXPECT_EQ(path(b, "G00 G42 D1 X10.0\nG01 G39 X10.0 Y10.0 F100\nX10.0 Y10.0\nX0"), (Path{"rapid 10 -3 0", "ccw 13 0 0 c10,0", "line 13 13 0", "line 0 13 0"})) << "the arc is a cut";
    for (const char* either : {a, b}) {
      EXPECT_EQ(path(either, "G01 G41 D1 X10.0 F100\nG39 X10.0 Y10.0\nX10.0 Y10.0\nX20.0"), (Path{"line 7 0 0", "line 7 13 0", "line 20 13 0"})) << "inside";
      EXPECT_EQ(path(either, "G01 G42 D1 X10.0 F100\nG39 X11.0 Y10.0\nX10.0 Y10.0\nX0"), (Path{"NC-OFFSET-PATH L3"})) << "not the way of the block behind: the start is not driven either";
      EXPECT_EQ(path(either, "G01 G42 D1 X10.0 F100\nG39 X20.0 Y0\nX20.0\nY10.0\nX0"), (Path{"line 10 -3 0", "line 23 -3 0", "line 23 13 0", "line 0 13 0"})) << "straight on";
    }
  }
}

// HX 13.2.1, DGSHAPE G39: the arc ends where its words lead to. Where the block behind leads elsewhere it would be cut, so the tool stops in front of the arc.
TEST(CornerTurn, LeadsTheWayOfTheBlockBehind) {
  for (const nc_dialect family : {NC_DIALECT_HX, NC_DIALECT_DGSHAPE}) {
    Bench bench(family);
    bench.tool(1, 3).tool(1, 3, NC_TOOL_RADIUS);
    const std::string head = family == NC_DIALECT_DGSHAPE ? "%\n" : "(at the head)\n";
    const auto corner = [&](const std::string& behind) { return bench.at(0, 0, 0).run(head + "F100\nG41 D1\nG01 X10.0\nX20.0\n" + behind + "\nM02"); };
    for (const char* behind : {"G39 X0 Y-10.0\nY-10.0\nG40 X0", "G39 X20.0 Y-10.0\nX22.0 Y-10.0\nG40 X0", "G39 X0 Y-10.0\nZ1.0\nY-10.0\nG40 X0", "G39 X21.0 Y-10.0\nG02 X10.0 Y-10.0 R10.0\nG01 G40 X0"}) {
      const Outcome run = corner(behind);
      EXPECT_EQ(run.alarm, "NC-OFFSET-PATH") << behind;
      EXPECT_EQ(run.alarm_line, 6u) << behind;
      EXPECT_NE(run.alarm_detail.find("G39 goes round an outer corner with the words of the block behind it."), std::string::npos) << run.alarm_detail;
      ASSERT_FALSE(run.moves().empty());
      EXPECT_NEAR(run.moves().back().machine.v[0], 20, 1e-9) << "it stops in front of the arc";
    }
    for (const char* behind : {"G39 X20.0 Y-10.0\nX20.0 Y-10.0\nG40 X0", "G39 X20.0 Y-10.0\nZ1.0\nX20.0 Y-5.0\nG40 X0", "G39 X20.0 Y-10.0\nG02 X10.0 Y-10.0 R10.0\nG01 G40 X0", "G39 X20.0 Y-10.0\nG40 X0",
                               "G39 X20.0 Y-10.0", "G39 X20.0 Y-10.0\nZ1.0\nZ2.0\nZ3.0\nZ4.0\nZ5.0\nY-10.0\nG40 X0"})
      EXPECT_EQ(corner(behind).alarm, "") << behind;
  }
}

}  // namespace
}  // namespace nc::test
