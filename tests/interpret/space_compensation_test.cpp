// SPDX-License-Identifier: Apache-2.0
// Three-dimensional radius compensation (M700 12.5): vectors, blocks without them, arcs, cancel, the interaction table, going back.
#include <gtest/gtest.h>

#include "support/going_back.hpp"

namespace nc::test {
namespace {

Outcome run_of(const std::string& text, const std::function<void(Bench&)>& change = [](Bench&) {}, const char* names = "XYZ") {
  Bench bench(NC_DIALECT_M700, axes(names));
  bench.tool(1, 5).tool(2, 10).tool(3, -5);
  change(bench);
  return bench.run(text);
}

Path path_of(const std::string& text, const std::function<void(Bench&)>& change = [](Bench&) {}, const char* names = "XYZ") {
  const Outcome run = run_of(text, change, names);
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  Path all = run.path();
  for (std::string& move : all)
    if (const size_t feed = move.find(" F"); feed != std::string::npos) move.resize(feed);
  return all;
}

std::string alarm_of(const std::string& text) {
  const Outcome run = run_of(text);
  return run.alarm + " L" + std::to_string(run.alarm_line);
}

TEST(SpaceCompensation, SignsOfCodeAndAmount) {  // the sign table
  const std::string words = " X10. Y10. Z10. I0 J3. K4. D";
  EXPECT_EQ(path_of("G0 G41" + words + "1\nM30"), (Path{"rapid 10 13 14"}));
  EXPECT_EQ(path_of("G0 G42" + words + "1\nM30"), (Path{"rapid 10 7 6"}));
  EXPECT_EQ(path_of("G0 G41" + words + "3\nM30"), (Path{"rapid 10 7 6"}));
  EXPECT_EQ(path_of("G0 G42" + words + "3\nM30"), (Path{"rapid 10 13 14"}));
}

TEST(SpaceCompensation, OneOrTwoOfThreeWordsAreThePlanes) {
  EXPECT_EQ(path_of("G0 G41 X10. Y10. Z10. I1. J0 D1\nM30"), (Path{"rapid 10 15 10"}));  // 12.4.3: at right angles to I J
}

TEST(SpaceCompensation, AVectorAloneCutsOnlyWithAFeed) {  // 3.2, P62: a line without a feed would never end
  EXPECT_EQ(alarm_of("G1\nG41 I1. J1. K1. D1\nM30"), "P62 L2");
  EXPECT_EQ(alarm_of("G0 G41 I1. J1. K1. D1\nG1\nG40\nM30"), "P62 L3");
  EXPECT_EQ(alarm_of("G0 G41 I1. J1. K1. D1\nG1\nI1. J2. K1.\nM30"), "P62 L3");
  EXPECT_EQ(alarm_of("G0 G41 I1. J1. K1. D1\nG1 D0\nM30"), "P62 L2");
  for (const char* keeps : {"G41", "G41 D1", "G41 D2", "G42", "D2"}) {  // (4), (5): they count from the next I J K on
    EXPECT_EQ(path_of(std::string("G0 G41 I0 J3. K4. D1\nG1\n") + keeps + "\nX5. F100\nM30"), (Path{"rapid 0 3 4", "line 5 3 4"})) << keeps;
    // The vector that G28 has taken away comes back with the next movement, not at once without a feed.
    EXPECT_EQ(path_of(std::string("G0 G41 X5. I0 J3. K4. D1\nG28 Y0 Z0\nG1\n") + keeps + "\nX6. F100\nM30").back(), "line 6 3 4") << keeps;
  }
  EXPECT_EQ(alarm_of("G0 G41 I1. J1. K1. D1\nG1\nI1. J1. K1.\nM30"), "P62 L3");
  EXPECT_EQ(alarm_of("G1 F100\nG41 I1. J1. K1. D1\nG40\nM30"), " L0");
}

TEST(SpaceCompensation, TheArcOfARoundingHasRadiiThatAgree) {  // as an arc of the program: the centre does not shift
  EXPECT_EQ(alarm_of("G1 F500\nG41 D1 X10. Y0 I5. J0 K0\nX20. ,R5.\nY20.\nG40\nM30"), "P70 L3");
  const Outcome written = run_of("G1 F500\nG41 D1 X10. Y0 I5. J0 K0\nX15.\nG3 X20. Y5. I0 J5.\nG40\nM30");
  EXPECT_EQ(written.alarm, "P70");
  EXPECT_EQ(written.alarm_detail, run_of("G1 F500\nG41 D1 X10. Y0 I5. J0 K0\nX20. ,R5.\nY20.\nG40\nM30").alarm_detail);
  EXPECT_NE(written.alarm_detail.find("Vectors in space"), std::string::npos) << written.alarm_detail;
  EXPECT_EQ(path_of("G1 F500\nG41 D1 X10. Y0 I0 J0 K1.\nX20. ,R5.\nY20.\nG40\nM30"),
            (Path{"line 10 0 5", "line 15 0 5", "ccw 20 5 5 c15,5", "line 20 20 5", "line 20 20 0"}));
  EXPECT_EQ(path_of("G1 F500\nG41 D1 X10. Y0 I5. J0 K0\nX20. ,C5.\nY20.\nG40\nM30"),
            (Path{"line 15 0 0", "line 20 0 0", "line 25 5 0", "line 25 20 0", "line 20 20 0"}));
}

TEST(SpaceCompensation, ABlockWithoutVectorCarriesTheOldOne) {
  EXPECT_EQ(path_of("G0 G41 X10. I0 J3. K4. D1\nX20.\nX30. I3. K4.\nX40.\nG40\nX50.\nM30"),
            (Path{"rapid 10 3 4", "rapid 20 3 4", "rapid 33 0 4", "rapid 43 0 4", "rapid 40 0 0", "rapid 50 0 0"}));
}

TEST(SpaceCompensation, AmountAndDirectionChangeWithTheNextVector) {  // (4), (5)
  EXPECT_EQ(path_of("G0 G41 X10. I0 J3. K4. D1\nG41 X20. D2\nX30. I0 J3. K4.\nG42 X40.\nX50. I0 J3. K4.\nM30"),
            (Path{"rapid 10 3 4", "rapid 20 3 4", "rapid 30 6 8", "rapid 40 6 8", "rapid 50 -6 -8"}));
}

TEST(SpaceCompensation, AVectorAloneMoves) {
  EXPECT_EQ(path_of("G1 G41 I0 J3. K4. D1 F100\nI3. J0 K4.\nX10.\nD0\nM30"), (Path{"line 0 3 4", "line 3 0 4", "line 13 0 4", "line 10 0 0"}));
}

TEST(SpaceCompensation, AnArcKeepsItsCentreAndIsLifted) {  // (3)
  EXPECT_EQ(path_of("G1 G41 X20. I0 J0 K1. D1 F100\nG3 X0 Y20. I-20.\nX-20. Y0 R20.\nG1 G40 X0\nM30"),
            (Path{"line 20 0 5", "ccw 0 20 5 c0,0", "ccw -20 0 5 c0,0", "line 0 0 0"}));
  // A vector in the plane: both ends are as far from the centre, which stays, only where it happens to lie so.
  EXPECT_EQ(path_of("G1 G41 X0 Y20. I1. J0 K0 D1 F100\nG2 X0 Y-20. J-20.\nM30"), (Path{"line 5 20 0", "cw 5 -20 0 c0,0"}));
  EXPECT_EQ(alarm_of("G1 G41 X20. I1. J0 K0 D1 F100\nG3 X0 Y20. I-20.\nM30"), "P70 L2");
}

TEST(SpaceCompensation, OnTheParallelAxesThatTheStartNames) {
  const auto parallel = [](Bench& bench) { bench.param("1029", "U").param("1030", "V").param("1031", "W"); };
  EXPECT_EQ(path_of("G17\nG0 G41 Y1. I2. J2. K1. D1\nM30", parallel, "XYZUVW"), (Path{"rapid 3.333333 4.333333 1.666667 0 0 0"}));
  EXPECT_EQ(path_of("G0 G17 V0\nG41 X1. V1. Z1. I2. J2. K1. D1\nM30", parallel, "XYZUVW"), (Path{"rapid 4.333333 0 2.666667 0 4.333333 0"}));
  EXPECT_EQ(path_of("G17\nG0 G41 W1. I2. J2. K1. D1\nM30", parallel, "XYZUVW"), (Path{"rapid 3.333333 3.333333 0 0 0 2.666667"}));
  EXPECT_EQ(path_of("G0 G17 U0\nG41 I2. J2. K1. D1\nM30", parallel, "XYZUVW"), (Path{"rapid 0 3.333333 1.666667 3.333333 0 0"}));
}

// The table of "compensation space" row by row: which axes the vector moves. The words of a block move their own axes besides.
TEST(SpaceCompensation, TheTableOfCompensationSpaces) {
  const struct {
    const char *plane, *words, *space;
  } rows[] = {{"G17", "X1. Y1. Z1.", "XYZ"}, {"G17", "Y1.", "XYZ"}, {"G17 V0", "X1. V1. Z1.", "XZV"}, {"G17 W0", "W1.", "XYW"}, {"G17", "X1. Y1. Z1. W1.", "XYZ"},
              {"G17 W0", "X1. Y1. Z1. W1.", "XYW"}, {"G17", "", "XYZ"}, {"G17 U0", "", "YZU"},
              // not printed: as with U
              {"G17 W0", "", "XYW"}, {"G17 W0", "Y1.", "XYW"}, {"G17 W0", "Z1.", "XYZ"}, {"G17 U0 W0", "", "YUW"}, {"G17 Z0 W0", "", "XYZ"}, {"G18 V0", "Y1. V1.", "XZV"},
              {"G17 W0\nG17", "X1. Y1. Z1. W1.", "XYZ"}, {"G17 W0\nG17 W0\nM8", "Z1. W1.", "XYW"}};
  for (const auto& row : rows) {
    Bench bench(NC_DIALECT_M700, axes("XYZUVW"));
    bench.tool(1, 5).param("1029", "U").param("1030", "V").param("1031", "W");
    const std::string text = std::string("G0 ") + row.plane + "\nG41 " + row.words + " I2. J2. K1. D1\nM30";
    const Outcome run = bench.run(text);
    EXPECT_EQ(run.alarm, "") << text;
    ASSERT_FALSE(run.moves().empty()) << text;
    std::string space;
    for (unsigned i = 0; i < 6; ++i)
      if (run.moves().back().machine.v[i] - run.moves().back().work.v[i] > 1) space += "XYZUVW"[i];
    EXPECT_EQ(space, row.space) << text;
  }
}

TEST(SpaceCompensation, ResetForgetsTheThirdAxisOfThePlane) {
  Bench bench(NC_DIALECT_M700, axes("XYZUVW"));
  bench.tool(1, 5).param("1029", "U").param("1030", "V").param("1031", "W");
  EXPECT_EQ(bench.run("G0 G17 W0\nM30").alarm, "");
  EXPECT_EQ(bench.run("G0 G41 Z1. W1. I0 J0 K1. D1\nM30").path(), (Path{"rapid 0 0 6 0 0 1"}));
}

TEST(SpaceCompensation, TheSpaceOfThePlaneGoesOnFromEveryMark) {
  goes_on_from_every_mark("G0 G17 W0\nM8\nX1.\nM9\nG41 X5. Y1. Z2. W3. I1. J2. K2. D1\nX20.\nG40\nX30.\nM30",
      [](Bench& bench) { bench.tool(1, 5).param("1031", "W"); }, axes("XYZW"));
}

TEST(SpaceCompensation, ParameterDividesTheWords) {  // #8071
  EXPECT_EQ(path_of("G0 G41 X10. I0 J3. K4. D1\nM30", [](Bench& bench) { bench.param("8071", "10"); }), (Path{"rapid 10 1.5 2"}));
}

TEST(SpaceCompensation, IsTakenAwayByMachineMoveAndReferenceReturn) {
  EXPECT_EQ(path_of("G0 G41 X10. I0 J3. K4. D1\nG53 X50.\nX60.\nM30"), (Path{"rapid 10 3 4", "rapid 50 0 0", "rapid 60 3 4"}));
  EXPECT_EQ(path_of("G0 G41 X10. I0 J3. K4. D1\nG28 X50.\nX60.\nM30"), (Path{"rapid 10 3 4", "rapid 50 0 0", "rapid 0 0 0", "rapid 60 3 4"}));
}

TEST(SpaceCompensation, IsTakenAwayWithoutAWayOfTheProgram) {  // (12), (14): of all axes, also where their programmed ends are one place
  const std::string start = "G0 G41 X10. Y10. Z0 I0 J0 K1. D1\n";
  for (const char* code : {"G53 Z0", "G53 X10.", "G91 G53 X0"})
    EXPECT_EQ(path_of(start + code + "\nG90 X60.\nM30"), (Path{"rapid 10 10 5", "rapid 10 10 0", "rapid 60 10 5"})) << code;
  EXPECT_EQ(path_of("G0 G41 X0 Y0 Z0 I1. J0 K0 D1\nG28 X0 Y0 Z0\nX5.\nM30"), (Path{"rapid 5 0 0", "rapid 0 0 0", "rapid 10 0 0"}));
  // 12.3: the length along the tool is a vector in space, too.
  EXPECT_EQ(path_of("G0 G43.1 X0 Y0 Z0 B90. H1\nG53 X0\nM30", [](Bench&) {}, "XYZbc").back(), "rapid 0 0 0 90 0");
}

TEST(SpaceCompensation, MirrorImageActsOnTheVectorWithTheNextCommandOfTheAxis) {  // (8)
  EXPECT_EQ(path_of("G0 G41 X0 I1. J0 K0 D1\nG51.1 X0\nX20.\nG50.1 X0\nX30.\nG40\nM30"),
            (Path{"rapid 5 0 0", "rapid -25 0 0", "rapid 35 0 0", "rapid 30 0 0"}));
  EXPECT_EQ(path_of("G0 G41 X0 I1. J0 K0 D1\nG51.1 X0\nZ7.\nX20.\nM30"), (Path{"rapid 5 0 0", "rapid 5 0 7", "rapid -25 0 7"}));
  // Where the axis stands in its mirror the vector turns alone.
  EXPECT_EQ(path_of("G0 G41 X0 I1. J0 K0 D1\nG51.1 X0\nX0\nZ7.\nG50.1 X0\nX0\nM30"),
            (Path{"rapid 5 0 0", "rapid -5 0 0", "rapid -5 0 7", "rapid 5 0 7"}));
  // A vector of the mirrored mode, and one behind it.
  EXPECT_EQ(path_of("G0 G51.1 X0\nG41 X10. I1. J0 K0 D1\nX20. I3. J0 K4.\nG50.1 X0\nX30. I1. J0 K0\nM30"),
            (Path{"rapid -15 0 0", "rapid -23 0 4", "rapid 35 0 0"}));
  EXPECT_EQ(path_of("G0 G51.1 X0\nG41 X10. I1. J0 K0 D1\nG40 X20.\nG50.1 X0\nX30.\nM30"), (Path{"rapid -15 0 0", "rapid -20 0 0", "rapid 30 0 0"}));
}

TEST(SpaceCompensation, RotationByParameterTurnsTheVector) {  // (7)
  EXPECT_EQ(path_of("G0 G10 K90.\nG41 X10. Y0 Z0 I1. J0 K0 D1\nX20.\nM30"), (Path{"rapid 0 15 0", "rapid 0 25 0"}));
  EXPECT_EQ(path_of("G0 G10 K90.\nG41 X10. Y0 Z0 I0 J0 K1. D1\nX20.\nG40\nM30"), (Path{"rapid 0 10 5", "rapid 0 20 5", "rapid 0 20 0"}));
  // Switched on in the mode the vector turns with the command that brings the axes into the rotation (13.21, precaution (1)), not before.
  EXPECT_EQ(path_of("G0 G41 X0 Y0 Z0 I1. J0 K0 D1\nG10 K90.\nX20.\nX30. I1. J0 K0\nG10 K0\nX40.\nM30"),
            (Path{"rapid 5 0 0", "rapid 0 25 0", "rapid 0 35 0", "rapid 45 0 0"}));
  EXPECT_EQ(path_of("G0 G41 X0 Y0 Z0 I1. J0 K0 D1\nG10 K90.\nZ7.\nX20.\nM30"), (Path{"rapid 5 0 0", "rapid 5 0 7", "rapid 0 25 7"}));
  // Mirror image lies before the rotation, and so it does of the vector.
  EXPECT_EQ(path_of("G0 G51.1 X0\nG10 K90.\nG41 X10. Y0 I1. J0 K0 D1\nM30"), (Path{"rapid 0 -15 0"}));
  EXPECT_EQ(path_of("G0 G10 K30.\nG41 X10. Y0 I0 J1. K0 D1\nM30"), (Path{"rapid 6.160254 9.330127 0"}));
  // One axis of the rotation is none of the space.
  const auto parallel = [](Bench& bench) { bench.param("1029", "U"); };
  Bench bench(NC_DIALECT_M700, axes("XYZU"));
  bench.tool(1, 5);
  parallel(bench);
  EXPECT_EQ(bench.run("G0 G10 K90.\nG17 U0\nG41 U1. I1. J0 K0 D1\nM30").alarm, "P113");
}

TEST(SpaceCompensation, PositionOffsetHasANumberOfItsOwn) {  // (3); 12.1, 12.6
  EXPECT_EQ(path_of("G0 G91 G41 X10. I0 J0 K1. D1\nG45 X10. D2\nG45 X10.\nX10. I0 J1. K0\nM30"),
            (Path{"rapid 10 0 5", "rapid 30 0 5", "rapid 50 0 5", "rapid 60 5 0"}));
  EXPECT_EQ(path_of("G0 G91 G41 X10. I0 J0 K1. D1\nG45 X10.\nM30"), (Path{"rapid 10 0 5", "rapid 25 0 5"}));
  // A code of the mode without D takes the number that was commanded last.
  EXPECT_EQ(path_of("G0 G91 G41 X10. I0 J0 K1. D1\nG45 X10. D2\nG41 X10. I0 J0 K1.\nM30").back(), "rapid 40 0 10");
}

TEST(SpaceCompensation, ANumberBehindD00StartsNothing) {  // restriction (1)
  EXPECT_EQ(path_of("G0 G41 X0 I1. J0 K0 D1\nX10. D0\nX20. D1\nX30.\nM30"), (Path{"rapid 5 0 0", "rapid 10 0 0", "rapid 20 0 0", "rapid 30 0 0"}));
  EXPECT_EQ(path_of("G0 G41 X1. I1. J0 K0 D0\nX20. D1\nX30.\nM30"), (Path{"rapid 1 0 0", "rapid 20 0 0", "rapid 30 0 0"}));
  EXPECT_EQ(path_of("G0 G41 X0 I1. J0 K0 D1\nX10. D0\nG41 X20. I0 J0 K1. D1\nM30"), (Path{"rapid 5 0 0", "rapid 10 0 0", "rapid 20 0 5"}));
}

TEST(SpaceCompensation, TheCentreOfAFigureIsNoVector) {  // 13.3.3: I J K beside M98
  EXPECT_EQ(path_of("G0 G41 X0 I1. J0 K0 D1\nM98 P100 I0 J1.\nX10.\nM30\nO100\nM99"), (Path{"rapid 5 0 0", "rapid 15 0 0"}));
}

TEST(SpaceCompensation, Alarms) {
  EXPECT_EQ(alarm_of("G2 X10. I5.\nM30").substr(0, 3), "P62");
  EXPECT_EQ(alarm_of("G1 F100 X1.\nG2 X10. I4.5\nG41 I1. J1. K1. D1\nM30"), "P150 L3");  // (8): in arc mode
  EXPECT_EQ(alarm_of("G0 G41 I0 J0 K0 D1\nM30"), "P35 L1");
  EXPECT_EQ(alarm_of("G0 G41 X1. I1. J1. K1.\nM30"), "P170 L1");
  EXPECT_EQ(alarm_of("G0 G41 X1. I1. J1. K1. D1\nG81 X9. Z-5. R1. F100\nM30"), "P155 L2");
  EXPECT_EQ(alarm_of("G0 G41 X1. I1. J1. K1. D1\nG31 X9. F100\nM30"), "P608 L2");
  EXPECT_EQ(alarm_of("G0 G41 X1. I1. J1. K1. D1\nG27 X0\nM30"), "P434 L2");
  EXPECT_EQ(alarm_of("G0 G41 X1. I1. J1. K1. D1\nG7.1 X10.\nM30").substr(0, 1), "P");
  EXPECT_EQ(path_of("G0 G41 X1. I1. J1. K1. D0\nX2.\nM30"), (Path{"rapid 1 0 0", "rapid 2 0 0"}));  // D00 starts nothing
}

TEST(SpaceCompensation, EveryMarkIsAPlaceToGoOnFrom) {
  goes_on_from_every_mark("G1 F100 G41 X10. I0 J3. K4. D1\nX20.\nG42 D2\nM8\nX30. I3. K4.\nG53 X7.\nM9\nG1 X40. I0 J0 K4.\nG3 X50. Y10. J10.\nG1 G40 X50.\nM30",
                          [](Bench& bench) { bench.tool(1, 5).tool(2, 3); });
  goes_on_from_every_mark("G1 F100 G41 X10. I3. J0 K4. D1\nG51.1 X0\nZ7.\nM8\nX20.\nG53 X-20.\nM9\nX30.\nG10 K90.\nX40.\nG45 X50. D2\nG50.1 X0\nM8\nG10 K0\nX60.\nX60. D0\nX5.\nM30",
                          [](Bench& bench) { bench.tool(1, 5).tool(2, 3); });
}

}  // namespace
}  // namespace nc::test
