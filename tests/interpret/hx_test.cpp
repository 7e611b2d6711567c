// SPDX-License-Identifier: Apache-2.0
// The hx family: what its manual says otherwise than those of the other families do, one test for each rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>

#include "dialect/dialect.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome hx(const std::string& text) { return Bench(NC_DIALECT_HX).run(text); }
std::string alarm_of(const std::string& text) { return hx(text).alarm; }

/// X Y Z and a rotary C.
void with_c(nc_config& config) {
  config.system[0].axis_count = 4;
  config.system[0].axis[3] = config.system[0].axis[2];
  config.system[0].axis[3].name = 'C';
  config.system[0].axis[3].rotary = true;
}

// ---- words and numbers ---------------------------------------------------------------------------------------------------------

TEST(Hx, ValuesOfFormulasAreRoundedToTheLeastUnit) {  // 14.2.4, the printed numbers
  EXPECT_EQ(hx("#1=1.2345\n#2=2.3456\nG91 G01 X#1 F100.\nX#2\nX-[#1+#2]\nM30").path(),
            (Path{"line 1.235 0 0 F100", "line 3.581 0 0 F100", "line 0.001 0 0 F100"}));
  EXPECT_EQ(hx("G20\nG00 X[1/3]\nM30").path(), (Path{"rapid 8.46582 0 0"}));  // 0.3333 inch
  EXPECT_EQ(hx("G00 X0.12345\nM30").path(), (Path{"rapid 0.12345 0 0"}));     // as written it stays
}

TEST(Hx, ANumberWithoutAPointCountsInTheLeastUnit) {  // 8.4
  EXPECT_EQ(hx("G21 G00 X1000\nG20 X1000\nM30").path(), (Path{"rapid 1 0 0", "rapid 2.54 0 0"}));
}

TEST(Hx, ASemicolonBeginsAComment) {  // 14.5 prints them so
  EXPECT_EQ(hx("#100=15. ; X DRILL NUMBER\nG00 X1. ; (\nM30 ;").path(), (Path{"rapid 1 0 0"}));
}

TEST(Hx, AJumpMayNameItsBlockWithN) {  // 14.5.1
  EXPECT_EQ(hx("GOTO N10\nG00 X1.\nN10 G00 Y1.\nIF [1 EQ 1] GOTO N20\nX2.\nN20 M30").path(), (Path{"rapid 0 1 0"}));
}

TEST(Hx, LoopsHaveAnyNumberAndStandThreeDeep) {  // 14.5.3, 14.2.5
  EXPECT_EQ(hx("#1=0\nWHILE [#1 LT 2] DO 210\n#1=#1+1\nG91 G00 X1.\nEND 210\nM30").path(), (Path{"rapid 1 0 0", "rapid 2 0 0"}));
  const auto nest = [](unsigned loops) {
    std::string text;
    for (unsigned i = 1; i <= loops; ++i) text += "WHILE [#100 LT 1] DO " + std::to_string(i) + "\n";
    text += "#100=1\n";
    for (unsigned i = loops; i > 0; --i) text += "END " + std::to_string(i) + "\n";
    return "#100=0\n" + text + "M30";
  };
  EXPECT_EQ(alarm_of(nest(3)), "");
  EXPECT_EQ(alarm_of(nest(4)), "NC-LOOP");
}

TEST(Hx, AProgramEndsWithItsCode) {  // 2.3
  EXPECT_EQ(alarm_of("G00 X1."), "F_82016");
  EXPECT_EQ(alarm_of("G00 X1.\nM02"), "");
}

TEST(Hx, WhatIsNotListedIsAnAlarm) {  // 3.1
  for (const char* code : {"G05", "G12", "G38", "G70", "G93", "G100", "G255"}) EXPECT_EQ(alarm_of(std::string(code) + "\nM30"), "F_82030") << code;
}

// ---- motions -------------------------------------------------------------------------------------------------------------------

TEST(Hx, AnArcHasItsNumbers) {  // 4.4
  EXPECT_EQ(alarm_of("G02 X50. Y50.5 I50. F100\nM30"), "F_82112");
  EXPECT_EQ(alarm_of("G02 X50. R5. F100\nM30"), "F_82100");
  EXPECT_EQ(alarm_of("G02 X0. R5. F100\nM30"), "F_82100");  // no full circle by R
  EXPECT_EQ(alarm_of("G01 X50.\nM30"), "F_84020");
  EXPECT_EQ(Bench(NC_DIALECT_HX).param("3151", "1").run("G02 X50. Y50.5 I50. F100\nM30").alarm, "");  // PI 151
}

TEST(Hx, SingleDirectionPositioningOverrunsByTheParameterOfTheAxis) {  // 4.2, PI 61 to 69
  EXPECT_EQ(Bench(NC_DIALECT_HX).param("3061", "-1").param("3062", "2").run("G60 X50. Y20.\nM30").path(),
            (Path{"rapid 51 18 0", "rapid 50 20 0"}));
}

TEST(Hx, AHoleIsApproachedFromOneSideByG60) {  // 4.2: G60 [G00/G81 to G89]
  Bench bench(NC_DIALECT_HX);
  bench.param("3061", "2").param("3062", "-3").param("3063", "7");
  EXPECT_EQ(bench.run("G90 G00 X0 Y0 Z10.\nG60 G99 G81 X50. Y20. Z-5. R2. F100\nX60.\nG60 X70. K2\nG80\nM30").path(),
            (Path{"rapid 0 0 10", "rapid 48 23 10", "rapid 50 20 10", "rapid 50 20 2", "line 50 20 -5 F100", "rapid 50 20 2", "rapid 60 20 2", "line 60 20 -5 F100",
                  "rapid 60 20 2", "rapid 68 20 2", "rapid 70 20 2", "line 70 20 -5 F100", "rapid 70 20 2", "rapid 68 20 2", "rapid 70 20 2", "line 70 20 -5 F100",
                  "rapid 70 20 2"}));
}

TEST(Hx, TheReferencePositionsOfG30AreThreeByP) {  // 6.2
  for (const char* p : {"P0", "P1", "P5", "P2.6", "P-2"}) EXPECT_EQ(alarm_of(std::string("G30 ") + p + " X1.\nM30"), "F_82002") << p;
  EXPECT_EQ(alarm_of("G30 X1.\nM30"), "");  // the 2nd
}

TEST(Hx, ReturnsAndZeroPointsWantNoMap) {  // 15.2.2, 15.4.2: G50 and G69 go before
  for (const char* map : {"G51 X0 Y0 P2000", "G68 X0 Y0 R30."})
    for (const char* code : {"G27 X0", "G28 X10.", "G29 X10.", "G30 X10.", "G92 X0"})
      EXPECT_EQ(alarm_of(std::string(map) + "\n" + code + "\nM30"), "NC-MODE") << map << " " << code;
  EXPECT_EQ(alarm_of("G51 X0 Y0 P2000\nG50\nG28 X0\nG68 X0 Y0 R30.\nG69\nG92 X0\nM30"), "");
}

TEST(Hx, APoleThatAnIncrementHasSetStays) {  // 8.3, the printed program (G91), with points; the one in G90 drills the same holes
  const auto holes = [](const std::string& text) {
    Path found;
    for (const std::string& move : hx(text).path())
      if (move.substr(0, 4) == "line") found.push_back(move.substr(0, move.find(" F")));
    return found;
  };
  const Path printed = {"line 80 44 -22", "line 50 61.320508 -22", "line 50 26.679492 -22"};
  EXPECT_EQ(holes("N50 G90 G00 X60. Y44. Z10.\nN51 G16 G17\nN52 G81 G91 G99 X20. Y0 Z-25. R-7. F100\nN53 Y120.\nN54 Y120.\nN55 G15 G00 Z50.\nM30"), printed);
  EXPECT_EQ(holes("N50 G52 X60. Y44.\nN51 G16 G17\nN52 G81 G90 G99 X20. Y0 Z-22. R3. F100\nN53 Y120.\nN54 Y240.\nN55 G15 G00 Z50.\nM30"), printed);
  // Both radius and angle absolute, then only the angle an increment: about the zero point.
  EXPECT_EQ(hx("G16\nG90 G00 X100. Y30.\nG91 Y120.\nM30").path(), hx("G16\nG90 G00 X100. Y30.\nY150.\nM30").path());
  EXPECT_EQ(hx("G00 X5. Y5.\nG16\nG91 X10. Y90.\nG90 X20. Y0\nM30").path(), (Path{"rapid 5 5 0", "rapid 5 15 0", "rapid 20 0 0"}));
}

TEST(HxPolar, WordsOfAnArcAreNoRadiusAndAngle) {  // HX 8.3, the list of the codes
  EXPECT_EQ(hx("G16\nG00 X10. Y0\nG03 X0. Y10. R10. F100\nX-10. Y0 R10.\nG01 X5. Y0\nM30").path(),
            (Path{"rapid 10 0 0", "ccw 0 10 0 c0,0 F100", "ccw -10 0 0 c0,0 F100", "line 5 0 0 F100"}));
  EXPECT_EQ(hx("G16\nG81 X10. Y90. Z-1. R1. F100\nM30").path().front(), "rapid 0 10 0");
}

TEST(HxLength, AnotherNumberActsWithoutTheCode) {  // as m700, whose words these are (decisions.md)
  const auto run = [](const std::string& text) { return Bench(NC_DIALECT_HX).tool(1, 10).tool(2, 20).run(text + "\nM30").path(); };
  EXPECT_EQ(run("G00 G43 H1 Z5.\nH2\nZ6."), (Path{"rapid 0 0 15", "rapid 0 0 26"}));
  EXPECT_EQ(run("G00 G43 H1 Z5.\nZ6. H2"), (Path{"rapid 0 0 15", "rapid 0 0 26"}));
  EXPECT_EQ(run("H2\nG00 Z5."), (Path{"rapid 0 0 5"}));
}

TEST(Hx, RepetitionsGoOnByTheAngle) {  // 8.3, 12.1.2: K counts on by the words in G91, and the angle is one of them
  const auto holes = [](const std::string& text) {
    Path found;
    for (const nc_move& move : hx(text).moves())
      if (move.kind == NC_MOVE_LINE) found.push_back(brief(move.machine.v[0]) + " " + brief(move.machine.v[1]));
    return found;
  };
  const Path arc = {"8.660254 5", "5 8.660254", "0 10"};
  EXPECT_EQ(holes("G00 X0 Y0 Z10.\nG91 G16 G81 X10. Y30. Z-5. R-2. K3 F100\nM30"), arc);
  EXPECT_EQ(holes("G00 X0 Y0 Z10.\nG16 G81 X10. Y30. Z-5. R2. F100\nG91 Y30. K2\nM30"), arc);
  EXPECT_EQ(holes("G00 X0 Y0 Z10.\nG16 G81 X10. Y30. Z-5. R2. F100\nG91 Y30. K2\nY90.\nM30"), (Path{arc[0], arc[1], arc[2], "-10 0"}));  // and from there
  EXPECT_EQ(holes("G00 X1. Y0 Z10.\nG91 G16 G81 X10. Z-5. R-2. K3 F100\nM30"), (Path{"11 0", "21 0", "31 0"}));  // the radius alone: outwards
  EXPECT_EQ(holes("G16 G81 X10. Y30. Z-5. R2. K2 F100\nM30"), (Path{arc[0], arc[0]}));  // in G90 the same place
  EXPECT_EQ(Bench(NC_DIALECT_M700).run("G00 X0 Y0 Z10.\nG16 G81 X10. Y30. Z-5. R2. F100\nG91 Y30. L2\nM30").path().size(), 13u);
  EXPECT_EQ(Bench(NC_DIALECT_M700).run("G00 X0 Y0 Z10.\nG16 G81 X10. Y30. Z-5. R2. F100\nG91 Y30. L2\nM30").path().back(), "rapid 0 10 10");
}

TEST(Hx, OffsetsHave128Numbers) {  // 13.1.1, 14.2.3
  EXPECT_EQ(alarm_of("G43 H128 Z5.\nG41 D128 G01 X10. F100\nX20.\nG40 X0\nG10 L10 P128 R1.\nM30"), "");
  for (const char* block : {"G43 H129 Z5.", "G41 D129 G01 X10. F100"}) EXPECT_EQ(alarm_of(std::string(block) + "\nM30"), "NC-OFFSET-DATA") << block;
  for (const char* block : {"G10 L10 P129 R1.", "G10 L12 P129 R1."}) EXPECT_EQ(alarm_of(std::string(block) + "\nM30"), "NC-DATA") << block;
  const Outcome without = hx("G10 P1 R1.\nM30");
  EXPECT_EQ(without.alarm_detail.find("4294967295"), std::string::npos) << without.alarm_detail;
}

TEST(Hx, ABlockSkipStandsAtTheHeadOfItsBlock) {  // 2.3.3, 14.2.2
  for (const char* block : {"/0 X1.", "/10 X1.", "//X1.", "X1. /2 Y2.", "G00 X1. /"}) EXPECT_EQ(alarm_of(std::string(block) + "\nM30"), "F_82017") << block;
  EXPECT_EQ(hx("/1 X1.\nM30").path(), (Path{"rapid 1 0 0"}));
}

TEST(Hx, FormulasStandInBrackets) {  // 14.2.4
  for (const char* block : {"X4.-1.", "X1.+2.", "X2.*3.", "X#101+1", "X#1*2", "X-#1-5.", "X[1.]+2."}) EXPECT_EQ(alarm_of(std::string(block) + "\nM30"), "F_82004") << block;
  EXPECT_EQ(hx("#1=2\nX-[#1+#1]\nZ-#1\nX[4.-1.]\nM30").path(), (Path{"rapid -4 0 0", "rapid -4 0 -2", "rapid 3 0 -2"}));
  EXPECT_EQ(hx("#1=4.-1.\nX#1\nM30").path(), (Path{"rapid 3 0 0"}));
}

TEST(Hx, WholeNumbersHaveNoFraction) {  // 2.2.2
  for (const char* block : {"M3.5", "T1.5", "S100.7", "G43 H1.5 Z1.", "G41 D1.5 G01 X1. F10", "M98 P10.7", "G10 L10.9 P1 R1.", "G10 L10 P1.5 R1.", "G81 X1. Z-1. R1. F10 K2.7", "G04 P0.5", "G82 X1. Z-1. R1. F10 P0.5"})
    EXPECT_EQ(alarm_of(std::string("S100\n") + block + "\nM30"), "F_82004") << block;
  EXPECT_EQ(alarm_of("M3.\nT1. S100.\nM30"), "");
}

TEST(Hx, AParameterThatNothingAsksForIsNoVariable) {  // 14.2.3
  for (const char* block : {"#3000=1(ALARM)", "#3006=1", "#3200=1", "#29999=1", "#100=#3001", "#100=#20000"}) EXPECT_EQ(alarm_of(std::string(block) + "\nM30"), "NC-VARIABLE") << block;
  // One that the machine has set is kept for programs that read it (PM 3378: a stroke limit). To write it would move no limit.
  const auto limit = [](const std::string& text) { return Bench(NC_DIALECT_HX).param("23378", "-7.5").run(text + "\nM30"); };
  EXPECT_EQ(limit("X#23378").path(), (Path{"rapid -7.5 0 0"}));
  EXPECT_EQ(limit("#23378=-9").alarm, "NC-VARIABLE");
}

TEST(Hx, AWayThroughTheAreaOfTheStrokeCheckIsProhibited) {  // 15.5.3
  const std::string area = "G22 X100. Y50. Z50. I10. J10. K10.\n";
  EXPECT_EQ(alarm_of(area + "X-5. Y20. Z20.\nG01 X120. F100\nM30"), "NC-LIMIT");
  EXPECT_EQ(alarm_of(area + "X-5. Y20. Z20.\nG01 Y200. F100\nX120.\nM30"), "");
  EXPECT_EQ(alarm_of(area + "X0 Y0 Z20.\nG02 X0 Y60. J30. F100\nM30"), "");                  // on the other side
  EXPECT_EQ(alarm_of(area + "X0 Y0 Z20.\nG03 X0 Y60. J30. F100\nM30"), "NC-LIMIT");          // through it
  EXPECT_EQ(alarm_of(area + "X5. Y5. Z0\nG01 X120. Y60. Z5. F100\nM30"), "");                // below
  const auto outside = [](const std::string& text) {
    return Bench(NC_DIALECT_HX).param("23474", "1").run("G22 X100. Y50. Z50. I-10. J-10. K-10.\n" + text + "M30").alarm;
  };
  EXPECT_EQ(outside("X90.\nG03 X90. Y40. J20. F100\n"), "NC-LIMIT");  // it bulges over the border
  EXPECT_EQ(outside("X70.\nG03 X70. Y40. J20. F100\n"), "");
}

TEST(Hx, AnAreaOfTheStrokeCheckHasBothPointsOfEachAxis) {  // 15.5.3
  const auto detail = [](const std::string& text) {
    const Outcome run = hx(text + "\nM30");
    return run.alarm + " " + run.alarm_detail;
  };
  EXPECT_EQ(detail("G22 X40. Y10. I30."), "NC-WORDS The block needs the word J.");
  EXPECT_EQ(detail("G22 X40. I30. K5."), "NC-WORDS The block needs the word Z.");
  EXPECT_EQ(alarm_of("G22 X40. I30. Y5. J5.\nM30"), "F_82002");  // "I > X": the two are not the same
  // The printed G22 X-120 Y-100 I-190 J-150 names no Z: the area goes on along it without an end.
  const std::string printed = "G22 X-120. Y-100. I-190. J-150.\nG00 Z-500.\n";
  EXPECT_EQ(alarm_of(printed + "X-110. Y-90.\nX-130.\nM30"), "");
  EXPECT_EQ(alarm_of(printed + "X-110. Y-110.\nX-130.\nM30"), "NC-LIMIT");
  // While an area guards an axis, another one does not drop it unsaid.
  const std::string full = "G22 X20. Y20. Z20. I10. J10. K-10.\n";
  EXPECT_EQ(detail(full + "G22 X40. I30."), "NC-WORDS The block needs the word Y.");
  EXPECT_EQ(detail(full + "G22 X40. I30. Y5. J9."), "NC-WORDS The block needs the word Z.");
  EXPECT_EQ(alarm_of(full + "G22 X40. I30. Y5. J9. Z5. K0.\nM30"), "");
  EXPECT_EQ(alarm_of(full + "G23\nG22 X40. I30.\nM30"), "");
}

TEST(Hx, TheAreaOfTheStrokeCheckIsStored) {  // 15.5.3 "Stored Stroke Check", 3.2 PI 148
  const std::string full = "G22 X20. Y20. Z20. I10. J10. K-10.\n";
  Bench bench(NC_DIALECT_HX);
  Outcome run = bench.run("G22\nM30");
  EXPECT_EQ(run.alarm + " " + run.alarm_detail, "NC-WORDS G22 needs a word that is not there.");  // there is none yet
  EXPECT_EQ(bench.at(0, 0, 0).run(full + "G23\nG00 X5. Y15.\nG22\nX15.\nM30").alarm, "NC-LIMIT");
  EXPECT_EQ(bench.at(0, 0, 0).run("G00 X5. Y15.\nX15.\nX5.\nG22\nX15.\nM30").alarm_line, 5u);  // in the next program too, where it is off until G22
  Bench start(NC_DIALECT_HX);
  start.param("3148", "0");
  run = start.run("G00 X5.\nM30");
  EXPECT_EQ(run.alarm + " " + run.alarm_detail, "NC-LIMIT G22 is in force from the start of the program, and no area has been given yet. Program G22 with its area, or G23.");
  EXPECT_EQ(run.alarm_line, 1u);
  EXPECT_EQ(run.path(), Path{});
  EXPECT_EQ(start.at(0, 0, 0).run("M08\nG28 X0\nG23\nG00 X5.\nM30").alarm, "");
  EXPECT_EQ(start.at(0, 0, 0).run("G81 Z-5. R2. F100\nM30").alarm, "NC-LIMIT");
  EXPECT_EQ(start.at(0, 0, 0).run(full + "G00 X5.\nM30").alarm, "");
  EXPECT_EQ(start.at(0, 0, 0).run("G00 X5. Y15.\nX15.\nM30").alarm_line, 2u);  // in force with the area of the program before
  ASSERT_EQ(nc_reset(start.control(), 0), NC_OK);
  EXPECT_EQ(start.at(0, 0, 0).run("G00 X5. Y15.\nX15.\nM30").alarm_line, 2u);
  // What was read ahead and taken back has not been stored.
  Bench back(NC_DIALECT_HX);
  back.start("G00 X1.\n" + full + "G23\nM30");
  Step step;
  ASSERT_EQ(back.pull(&step), NC_OK);
  const nc_axes zero{};
  back.finish();
  ASSERT_EQ(back.rewind(0, zero), NC_OK);
  EXPECT_EQ(back.run("G22\nM30").alarm, "NC-WORDS");
}

TEST(Hx, ASkipIsFedPerMinute) {  // 4.9, 5.2: the speed of the spindle says nothing of a probe
  const Outcome run = hx("G95 S100 M03\nG31 X100. F0.1\nM30");
  EXPECT_EQ(run.alarm + " " + run.alarm_detail, "F_84020 A skip is fed per minute. Program G94 and F in front of it.");
  EXPECT_EQ(hx("G95 S100 M03\nG94 G31 X100. F100.\nM30").alarm, "");
  EXPECT_EQ(hx("G31 X100.\nM30").alarm_detail, "The feed rate of the skip is 0. Program F in this block or set the skip feed rate.");
}

TEST(Hx, TheSkipPositionIsOfAllAxes) {  // 14.2.3 (7)
  Bench bench(NC_DIALECT_HX);
  bench.skip_at = [](const nc_item&) { return std::optional<double>(0.5); };
  const Outcome run = bench.run("G00 X10. Y20.\nG31 Z-40. F100\n#100=#6319\n#101=#6320\n#102=#6321\nM30");
  EXPECT_EQ(run.var(100), 10);
  EXPECT_EQ(run.var(101), 20);
  EXPECT_EQ(run.var(102), -20);
  Bench measuring(NC_DIALECT_HX);
  measuring.param("3141", "5").param("3142", "2").param("3143", "30").tool(1, 10).skip_at = [](const nc_item&) { return std::optional<double>(0.5); };
  EXPECT_NEAR(measuring.run("G43 H1 G00 Z50.\nG37 Z20.\n#100=#6321\nM30").var(100), 31.5, 1e-9);  // half of the way from 25 to 18, without the length
}

TEST(Hx, ACentreOfRotationIsScaled) {  // 15.4.2 (2)
  EXPECT_EQ(hx("G51 X0 Y0 P2000\nG68 X5. Y0 R90.\nX10. Y0\nG69\nG50\nM30").path(), (Path{"rapid 10 10 0"}));
}

TEST(Hx, OfAMotionAndACycleTheLaterOneCounts) {  // 12.2.1
  EXPECT_EQ(hx("G90 G00 G99 G81 X1. Z-1. R1. F100\nM30").path(), (Path{"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F100", "rapid 1 0 1"}));
  EXPECT_EQ(hx("G90 G99 G81 G00 X1. Z-1. R1. F100\nM30").path(), (Path{"rapid 1 0 -1"}));
}

TEST(Hx, TheClampOfG92IsNoSpeed) {  // 9.3
  EXPECT_EQ(hx("G97 S1000 M03\nG92 S3000\nM30").aux(), "S1000 M3 M30");
}

TEST(Hx, OffsetsAreVariablesInTheUnitInForce) {  // 13.3, 14.2.3
  const Outcome run = hx("G20\n#2240=1.\n#2377=2.\n#100=#2240\n#101=#2377\nG43 H1 Z0\nX0\nG21\n#102=#2240\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 25.4", "rapid 50.8 0 25.4"}));
  EXPECT_NEAR(run.var(100), 1, 1e-12);
  EXPECT_NEAR(run.var(101), 2, 1e-12);
  EXPECT_NEAR(run.var(102), 25.4, 1e-12);
}

TEST(Hx, TheShiftOfABoreIsThatOfTheSpindle) {  // 15.2.2: not scaled, mirrored or turned
  const auto shift = [](const std::string& map) { return hx("M03 S500\nG00 Z10.\n" + map + "\nG76 X5. Y0 Z-5. R2. I1. J.5 F100\nG80\nM30").path(); };
  EXPECT_EQ(shift("G51 X0 Y0 Z0 P2000")[4], "line 11 0.5 -10 F100");
  EXPECT_EQ(shift("G51 X0 Y0 I-1000 J1000")[4], "line -4 0.5 -5 F100");
  EXPECT_EQ(shift("G68 X0 Y0 R90.")[4], "line 1 5.5 -5 F100");
}

TEST(Hx, LRepeatsACycleAsKDoes) {  // 12.2.2
  EXPECT_EQ(hx("G91 G99 G81 X1. Z-1. R0 F100 L2\nM30").path().size(), 6u);
  EXPECT_EQ(hx("G99 G81 X1. Z-1. R0 F100 L0\nM30").path().size(), 0u);
}

TEST(Hx, ASubProgramNeedsItsReturn) {  // 2.4.3
  const Outcome nothing = hx("M98\nM30");
  EXPECT_EQ(nothing.alarm, alarm_of("G65\nM30"));
  EXPECT_NE(nothing.alarm_detail.find('P'), std::string::npos) << nothing.alarm_detail;
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O10\nG00 X1.\n");
  EXPECT_EQ(bench.run("M98 P10\nM30").alarm, "F_82024");
}

TEST(Hx, AMoveInMachineCoordinatesIsAbsoluteOnly) {  // 7.1.1: in G91 the code does nothing
  EXPECT_EQ(Bench(NC_DIALECT_HX).work_offset(1, {10}).run("G90 G53 G00 X5.\nG91 G53 X7.\nG90 X1.\nM30").path(),
            (Path{"rapid 5 0 0", "rapid 11 0 0"}));
}

TEST(Hx, ReferencePositionsHaveANumberForEachAxis) {  // 6.2, PM 2097, 2129, 2161
  EXPECT_EQ(Bench(NC_DIALECT_HX).param("22097", "5").param("22098", "6").param("22129", "7").param("22163", "-8").run("G91 G30 P2 X0 Y0\nG30 P3 X0\nG30 P4 Z0\n#100=#8000\n#101=#8032\n#102=#8066\nM30").path(),
            (Path{"rapid 5 6 0", "rapid 7 6 0", "rapid 7 6 -8"}));
  const Outcome read = Bench(NC_DIALECT_HX).param("22098", "6").run("#100=#8001\nM30");
  EXPECT_EQ(read.var(100), 6);
}

TEST(Hx, ADwellCountsRevolutionsByParameter) {  // 5.4, with the program printed there
  const Outcome run = hx("G04 X3\nG04 P1500\nG95 S60 M03\n#100=#3120\n#3120=1\nG04 P1\n#3120=#100\nG04 P500\nM30");
  EXPECT_EQ(run.dwells(), (std::vector<double>{3, 1.5, 0.5}));  // X is seconds, with a point or without
  unsigned turns = 0;
  for (const nc_item& gate : run.of(NC_ITEM_GATE))
    if (gate.u.gate.kind == NC_GATE_DWELL_TURNS) {
      ++turns;
      EXPECT_EQ(gate.u.gate.value, 1);
    }
  EXPECT_EQ(turns, 1u);
}

TEST(Hx, SkipsGoByTheFeedInForce) {  // 4.9: like G01
  EXPECT_EQ(hx("G31 X10. F500.\nG31.2 Y10.\nG31.4 X0.\nM30").path(), (Path{"skip 10 0 0 F500", "skip 10 10 0 F500", "skip 0 10 0 F500"}));
  const std::vector<nc_move> moves = hx("G31 X1. F5.\nG31.1 X2.\nG31.2 X3.\nG31.3 X4.\nG31.4 X5.\nM30").moves();
  ASSERT_EQ(moves.size(), 5u);
  const unsigned mask[] = {1, 1, 2, 4, 8};
  for (unsigned i = 0; i < 5; ++i) EXPECT_EQ(moves[i].skip_mask, mask[i]) << i;
  EXPECT_EQ(alarm_of("G31 X10.\nM30"), "F_84020");
}

// ---- cylinder and polar coordinates --------------------------------------------------------------------------------------------

TEST(Hx, TheBlockOfACylinderNamesItsAxis) {  // 4.7
  const auto cylinder = [](const std::string& text) { return Bench(NC_DIALECT_HX, with_c).run(text); };
  // The plane may be selected behind it, as the section prints; C stands for X there and in G17.
  EXPECT_EQ(cylinder("G107 C57.2957795\nG18 G01 Z10. C20. F100.\nG02 Z30. C40. R20.\nG107 C0\nM30").alarm, "");
  EXPECT_EQ(cylinder("G18\nG107 C57.2957795\nG01 X10. F100.\nG107 C0\nM30").alarm, "F_82208");
  EXPECT_EQ(cylinder("G17\nG107 C57.2957795\nG01 Y10. C5. F100.\nG02 Y20. C15. R10.\nG107 C0\nM30").alarm, "");
  EXPECT_EQ(cylinder("G107 X10.\nM30").alarm, "F_82208");
  EXPECT_EQ(hx("G107 C10.\nM30").alarm, "NC-AXIS");  // no such axis
}

TEST(Hx, TheOtherAxisOfThePlaneIsReplacedByParameter) {  // 4.7, PI 155
  Bench bench(NC_DIALECT_HX, with_c);
  bench.param("3155", "1");
  EXPECT_EQ(bench.run("G17\nG107 C57.2957795\nG01 X10. C5. F100.\nG03 X20. C15. R10.\nG107 C0\nM30").alarm, "");
  EXPECT_EQ(Bench(NC_DIALECT_HX, with_c).param("3155", "1").run("G17\nG107 C57.2957795\nG01 Y10. F100.\nM30").alarm, "F_82208");
}

TEST(Hx, PolarCoordinateInterpolationTakesTheFirstAxisAndTheOneThatTurns) {  // 4.6, the printed program
  const std::string text =
      "G54 G90 G00 X60. C0. Z50.\nG112\nG42 D1 G01 X20. F100.\nC10.\nG03 X10. C20. R10.\nG01 X-20.\nC-10.\nG03 X-10. C-20. I10. J0.\n"
      "G01 X20.\nC0.\nG40 X60.\nG113\nM30";
  const Outcome run = Bench(NC_DIALECT_HX, with_c).run(text);
  EXPECT_EQ(run.alarm, "");
  ASSERT_FALSE(run.moves().empty());
  EXPECT_NEAR(run.moves().back().machine.v[0], 60, 1e-6);
  for (const char* block : {"G81 X1. Z-1. R1. F10.", "G28 X0", "G00 X1.", "X1.", "G17", "G51 X0", "G92 X0", "G68 X0 Y0 R1."})
    EXPECT_EQ(Bench(NC_DIALECT_HX, with_c).run(std::string("G00 X10.\nG112\n") + block + "\nM30").alarm, "F_82204") << block;
  EXPECT_EQ(Bench(NC_DIALECT_HX, with_c).param("24624", "2").run("G112\nM30").alarm, "F_82204");  // Y does not turn
  EXPECT_EQ(alarm_of("G112\nM30"), "F_82204");
}

// ---- scaling, mirror, rotation -------------------------------------------------------------------------------------------------

TEST(Hx, FaultsOfG112AndG107HaveTheirNumbers) {  // 4.6 F_82204, 4.7 F_82208
  const auto alarm = [](const std::string& text) { return Bench(NC_DIALECT_HX, with_c).run(text + "\nM30").alarm; };
  const std::string polar = "G00 X50. C0\nG112\n", cylinder = "G18\nG107 C30.\n";
  EXPECT_EQ(alarm_of("G112\nM30"), "F_82204");  // no axis turns
  EXPECT_EQ(alarm(polar + "G112"), "F_82204");
  EXPECT_EQ(alarm(polar + "G107 C30."), "F_82204");
  EXPECT_EQ(alarm(polar + "G28 X0"), "F_82204");
  EXPECT_EQ(alarm(polar + "G18"), "F_82204");
  EXPECT_EQ(alarm(polar + "G00 X10."), "F_82204");
  EXPECT_EQ(alarm(polar + "G01 X-50. F100"), "F_82204");  // through the centre
  EXPECT_EQ(alarm("G68 X0 Y0 R30.\nG112"), "F_82204");
  EXPECT_EQ(alarm_of("G107 C30.\nM30"), "NC-AXIS");      // there is no C
  EXPECT_EQ(alarm("G107 X30."), "F_82208");
  EXPECT_EQ(alarm(cylinder + "G28 Z0"), "F_82208");
  EXPECT_EQ(alarm(cylinder + "G107 C40."), "F_82208");
  EXPECT_EQ(alarm(cylinder + "G112"), "F_82208");
  EXPECT_EQ(alarm(cylinder + "T1"), "F_82208");
  EXPECT_EQ(alarm("G68 X0 Y0 R30.\nG107 C30."), "F_82208");
}

TEST(Hx, ScalingHasAFactorForEachAxis) {  // 15.2
  EXPECT_EQ(hx("G51 X0 Y0 Z0 P2000\nG01 X10. Y10. F100.\nG50\nX1.\nM30").path(), (Path{"line 20 20 0 F100", "line 1 20 0 F100"}));
  EXPECT_EQ(hx("G51 X0 Y0 Z0 P2000.\nG01 X10. F100.\nM30").path(), (Path{"line 20 0 0 F100"}));  // with or without a point
  EXPECT_EQ(hx("G51 X0 Y0 Z0 I500 J3000.\nG01 X10. Y10. Z5. F100.\nM30").path(), (Path{"line 5 30 5 F100"}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).param("3109", "1500").run("G51 X0 Y0 Z0 I500\nG01 X10. Y10. F100.\nM30").path(), (Path{"line 5 15 0 F100"}));
  EXPECT_EQ(alarm_of("G51 X0 Y0 I0\nM30"), "F_82002");
}

TEST(Hx, ANegativeFactorMirrors) {  // 15.3: the arc turns round, and so does the side of the tool
  EXPECT_EQ(hx("G51 X0 Y0 I-1000 J1000\nG01 X10. F100.\nG03 X0 Y10. R10.\nM30").path(), (Path{"line -10 0 0 F100", "cw 0 10 0 c0,0 F100"}));
  EXPECT_EQ(hx("G51 X0 Y0 P-2000\nG01 X10. F100.\nG03 X0 Y10. R10.\nM30").path(), (Path{"line -20 0 0 F100", "ccw 0 -20 0 c0,0 F100"}));
  const auto path = [](const std::string& scaling) {
    return Bench(NC_DIALECT_HX).tool(1, 2, NC_TOOL_RADIUS).run(scaling + "G00 X-10. Y-10.\nG41 D1 G01 X0 Y0 F100.\nY20.\nX30.\nY0\nX0\nG40 X-10. Y-10.\nM30").path();
  };
  const Path plain = path(""), mirrored = path("G51 X0 Y0 I-1000 J1000\n");
  ASSERT_EQ(plain.size(), mirrored.size());
  for (size_t i = 0; i < plain.size(); ++i) {
    double x = 0, y = 0, mx = 0, my = 0;
    ASSERT_EQ(std::sscanf(plain[i].c_str() + plain[i].find(' '), "%lf %lf", &x, &y), 2) << plain[i];
    ASSERT_EQ(std::sscanf(mirrored[i].c_str() + mirrored[i].find(' '), "%lf %lf", &mx, &my), 2) << mirrored[i];
    EXPECT_NEAR(x, -mx, 1e-6) << plain[i] << " and " << mirrored[i];
    EXPECT_NEAR(y, my, 1e-6) << plain[i] << " and " << mirrored[i];
  }
}

TEST(Hx, AnArcScaledByDifferentFactorsIsOneByItsScaledWords) {  // 15.2.2, the printed block: R200 to X200 Y0
  const std::vector<nc_move> moves = hx("G90 G00 X0. Y100.\nG51 X0. Y0. Z0. I2000. J1000.\nG02 X100. Y0. R100. F500.\nM30").moves();
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_NEAR(moves[1].machine.v[0], 200, 1e-9);
  EXPECT_NEAR(moves[1].machine.v[1], 0, 1e-9);
  EXPECT_NEAR(moves[1].radius, 200, 1e-9);
  // By I J the scaled centre has to be one of the scaled end.
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J1000\nG02 X10. Y10. I10. F100.\nM30"), "F_82112");
  EXPECT_EQ(hx("G51 X0 Y0 I2000 J-2000\nG02 X10. Y10. I10. F100.\nM30").path(), (Path{"ccw 20 -20 0 c20,0 F100"}));
}

TEST(Hx, RotationTakesItsPlaneAndItsAngleByParameter) {  // 15.4.1
  EXPECT_EQ(hx("G17 G68 X0 Y0 R90.\nG01 X10. F100.\nG69\nX1.\nM30").path(), (Path{"line 0 10 0 F100", "line 1 10 0 F100"}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).param("3117", "90").run("G68 X0 Y0\nG01 X10. F100.\nM30").path(), (Path{"line 0 10 0 F100"}));
  EXPECT_EQ(hx("G18 G68 Z0 X0 R90.\nG01 Z10. F100.\nM30").path(), (Path{"line 10 0 0 F100"}));
  // 15.4.2 (3): in G91 the angle adds to the one before.
  EXPECT_EQ(hx("G68 X0 Y0 R30.\nG69\nG68 X0 Y0 G91 R60.\nG90 G01 X10. F100.\nM30").path(), (Path{"line 0 10 0 F100"}));
}

// ---- tools ---------------------------------------------------------------------------------------------------------------------

TEST(Hx, TheSideChangesOnAnArc) {  // 13.2.2 (3), as printed
  const auto run = [](const std::string& text) { return Bench(NC_DIALECT_HX).tool(1, 5, NC_TOOL_RADIUS).run("G90 G17 G00 X0. Y0. F500\n" + text + "\nG40 G01 X50.\nM30"); };
  const Outcome printed = run("G42 D1 G01 G91 X20. Y50.\nN5 G01 G91 X50.0 Y-70.0\nN6 G41 G02 J-50.0\nN7 G42 G01 X50.0 Y70.0");
  EXPECT_EQ(printed.alarm, "");
  unsigned arcs = 0;
  for (const nc_move& move : printed.moves()) {
    if (move.plane == NC_PLANE_NONE) continue;
    ++arcs;
    EXPECT_EQ(move.turns, 0);  // longer than a full circle by the change: only what is beyond is cut
    EXPECT_NEAR(move.radius, 55, 1);
  }
  EXPECT_EQ(arcs, 1u);
  EXPECT_NE(run("G42 D1 G02 X20. Y0. I10. J0.").alarm, "");  // it does not start with an arc
  EXPECT_NE(run("G42 D1 G01 X20. Y0.\nX40.\nG40 G02 X60. Y0. I10. J0.").alarm, "");
}

TEST(Hx, LengthCompensationIsAlongTheAxisOnThePlane) {  // 13.1.1
  Bench bench(NC_DIALECT_HX);
  bench.tool(1, 5);
  EXPECT_EQ(bench.run("G18 G43 H1 G00 Y10.\nG49 Y10.\nM30").path(), (Path{"rapid 0 15 0", "rapid 0 10 0"}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).tool(1, 5).run("G44 H1 G00 Z10.\nG43 H00 Z10.\nM30").path(), (Path{"rapid 0 0 5", "rapid 0 0 10"}));
}

TEST(Hx, OffsetsAreSetByProgramAndReadAsVariables) {  // 13.1.3, 14.2.3
  const Outcome run = hx("G10 L10 P3 R100.\nG91 G10 L10 P3 R-0.5\nG90 G10 L12 P128 R4.\n#100=#2242\n#101=#2239\n#2240=7.5\n#102=#2240\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 99.5);
  EXPECT_EQ(run.var(101), 4);
  EXPECT_EQ(run.var(102), 7.5);
}

TEST(Hx, DIsADiameterByParameter) {  // 13.2.1, PI 72
  const char* const text = "G00 Y-10.\nG42 D1 G01 X10. Y0 F100.\nX50.\nG40 Y-10.\nM30";
  EXPECT_EQ(Bench(NC_DIALECT_HX).tool(1, 4, NC_TOOL_RADIUS).run(text).path()[1], "line 10 -4 0 F100");
  EXPECT_EQ(Bench(NC_DIALECT_HX).param("3072", "1").tool(1, 4, NC_TOOL_RADIUS).run(text).path()[1], "line 10 -2 0 F100");
}

TEST(Hx, MeasuringGoesByItsParametersAndSignal) {  // 4.10
  Bench bench(NC_DIALECT_HX);
  bench.param("3141", "5").param("3142", "2").param("3143", "30").tool(1, 10);
  const std::vector<nc_move> moves = bench.run("G43 H1 G00 Z50.\nG37.3 Z20.\nM30").moves();
  ASSERT_EQ(moves.size(), 3u);
  EXPECT_NEAR(moves[1].machine.v[2], 35, 1e-9);
  EXPECT_EQ(moves[2].skip_mask, 4u);
  EXPECT_EQ(moves[2].feed_mm_min, 30);
  EXPECT_EQ(bench.run("G43 H1 G00 Z50.\nG37 Z20.\nM30").alarm, "F_84022");  // no signal has come
}

// 13.1.3, 14.2.3: an offset is one value, which G10 L10 and #2240 set and show; there is no wear beside it, in which the measurement of the tool before would stay.
TEST(Hx, AMeasurementCorrectsTheOffsetItself) {
  Bench bench(NC_DIALECT_HX);
  bench.param("3141", "5").param("3142", "2").param("3143", "30").tool(1, 10);
  bench.skip_at = [](const nc_item&) { return 0.5; };  // 1.5 mm above the place
  const Outcome run = bench.run("G43 H1 G00 Z50.\nG37 Z20.\n#100=#2240\nG10 L10 P1 R10.\n#101=#2240\nG43 H1 Z50.\nM30");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_NEAR(run.var(100), 11.5, 1e-9);
  EXPECT_NEAR(run.var(101), 10, 1e-9);
  EXPECT_NEAR(run.moves().back().machine.v[2], 60, 1e-9) << "what was measured is gone";
}

// ---- programs and macros -------------------------------------------------------------------------------------------------------

TEST(Hx, ASubProgramIsRunFromQToR) {  // 2.4.3, the printed program
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O0010\nN1 G90 G00 Z5.\nG01 Z-10. F20.\nZ-25. F100\nN2 G00 Z50.\nX99.\nM99\n");
  EXPECT_EQ(bench.run("M98 P10 Q1 R2 L2\nX70. Y20.\nM30").path(),
            (Path{"rapid 0 0 5", "line 0 0 -10 F20", "line 0 0 -25 F100", "rapid 0 0 50", "rapid 0 0 5", "line 0 0 -10 F20", "line 0 0 -25 F100",
                  "rapid 0 0 50", "rapid 70 20 50"}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).run("M98 P11 R2\nM30\nO11\nN1 M99").alarm, "F_82019");
  EXPECT_EQ(Bench(NC_DIALECT_HX).run("M98 P12\nM30").alarm, "F_82109");
}

TEST(Hx, FourSubProgramsStandInOneAnother) {  // 2.4.1; 14.1.7 (5): eight levels with macros
  const auto nest = [](unsigned levels, const char* call) {
    std::string text = "#100=0\nM98 P101\nM30\n";
    for (unsigned i = 1; i <= levels; ++i) text += "O" + std::to_string(100 + i) + "\n" + (i < levels ? call + std::to_string(101 + i) : "#100=#100+1") + "\nM99\n";
    return hx(text);
  };
  EXPECT_EQ(nest(4, "M98 P").alarm, "");
  EXPECT_EQ(nest(5, "M98 P").alarm, "F_82021");
  EXPECT_EQ(nest(5, "G65 P").alarm, "");
  EXPECT_EQ(nest(6, "G65 P").alarm, "NC-NESTING");  // four levels of macros
}

TEST(Hx, TheLastBlockMayBeACallOrAJump) {  // 2.4.3
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O10\nG91 G00 X1.\nN5 M98 P11\nX100.\nM99\nO11\nY1.\nM99\n");
  const Outcome run = bench.run("M98 P10 R5 L2\nZ1.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 1 1 0", "rapid 2 1 0", "rapid 2 2 0", "rapid 2 2 1"}));
  Bench jumping(NC_DIALECT_HX);
  jumping.add("O10.nc", "O10\nG91 G00 X1.\nN5 GOTO 7\nX100.\nN7 Y1.\nM99\n");
  EXPECT_EQ(jumping.run("M98 P10 R5\nZ1.\nM30").path(), (Path{"rapid 1 0 0", "rapid 1 1 0", "rapid 1 1 1"}));
}

TEST(Hx, BlocksOfMdiCallNoSubProgram) {  // 2.4.3
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O10\nG00 X1.\nM99\n");
  const std::string text = "M98 P10";
  ASSERT_EQ(nc_mdi_load(bench.control(), 0, text.data(), text.size()), NC_OK);
  const Outcome run = bench.finish();
  EXPECT_EQ(run.alarm, "F_82113");
}

TEST(Hx, BlocksOfMdiEndTheirLoops) {  // 14.2.5
  const auto mdi = [](const std::string& text) {
    Bench bench(NC_DIALECT_HX);
    EXPECT_EQ(nc_mdi_load(bench.control(), 0, text.data(), text.size()), NC_OK);
    return bench.finish().alarm;
  };
  EXPECT_EQ(mdi("WHILE [1 EQ 1] DO1"), "NC-LOOP");
  EXPECT_EQ(mdi("#1=0 ; WHILE [#1 LT 2] DO1 ; #1=#1+1 ; END1"), "");
}

TEST(Hx, TheMainProgramIsRepeatedAsOftenAsLSays) {  // 2.4.4
  EXPECT_EQ(hx("N1 G91 G00 X1.\nM99 P1 L3\nY1.\nM30").path(), (Path{"rapid 1 0 0", "rapid 2 0 0", "rapid 3 0 0", "rapid 4 0 0", "rapid 4 1 0"}));
}

TEST(Hx, CodesCallMacrosByTheirPlace) {  // 14.1.3 to 14.1.5
  const auto bench = [](const std::string& text) {
    Bench b(NC_DIALECT_HX);
    b.param("3086", "101").param("3085", "6").param("3095", "33");
    b.add("O9010.nc", "O9010\n#110=#24\nM99\n");
    b.add("O9011.nc", "O9011\n#100=#1\nM99\n");
    b.add("O9020.nc", "O9020\n#101=#1\n#102=#13\nM99\n");
    return b.run(text);
  };
  EXPECT_EQ(bench("G101 A5.\nM30").var(100), 5);
  EXPECT_EQ(bench("G06 X7.\nM30").var(110), 7);
  const Outcome arguments = bench("M33 A8.\nM30");  // an M code that begins its block takes arguments,
  EXPECT_EQ(arguments.var(101), 8);
  EXPECT_EQ(arguments.var(102), 33);
  EXPECT_EQ(arguments.aux(), "M30");
  const Outcome behind = bench("#1=3\nG00 X4. M33\nM30");  // behind other words it is a sub program with the variables of the caller
  EXPECT_EQ(behind.path(), (Path{"rapid 4 0 0"}));
  EXPECT_EQ(behind.var(101), 3);
}

TEST(Hx, ToolNumbersCallAMacro) {  // 10.1.1, 14.1.6
  const auto calls = [](const char* pi_105, const char* pi_106) {
    Bench b(NC_DIALECT_HX);
    b.param("3105", pi_105).param("3106", pi_106);
    b.add("O9000.nc", "O9000\n#100=1\nM99\n");
    b.add("O9004.nc", "O9004\n#100=4\nM99\n");
    return b.run("G00 X1. T5\nM30");
  };
  EXPECT_EQ(calls("1", "0").var(100), 1);
  EXPECT_EQ(calls("4", "1").var(100), 4);
  EXPECT_EQ(calls("0", "0").aux(), "T5 M30");
}

TEST(Hx, TheProgramThatATCallsKnowsTheTool) {  // 10.1.1, 14.1.6, docs/decisions.md
  const auto calls = [](const std::string& text) {
    Bench b(NC_DIALECT_HX);
    b.param("3105", "1");
    b.add("O9000.nc", "O9000\n#100=#149\nT#149 M06\nM99\n");
    return b.run(text + "\nM30");
  };
  const Outcome one = calls("G00 X2. T5");
  EXPECT_EQ(one.alarm, "") << one.alarm_detail;
  EXPECT_EQ(one.var(100), 5);
  EXPECT_EQ(one.aux(), "T5 M6 M30");  // and not before: the macro changes it
  EXPECT_EQ(calls("T5\nT7").aux(), "T5 M6 T7 M6 M30");
  EXPECT_EQ(calls("T5.5").alarm, alarm_of("G00 T5.5\nM30"));
  EXPECT_NE(calls("T5.5").alarm, "");
}

TEST(Hx, TheManualBoringCycleWaitsForTheHand) {  // 12.3.11 "(handle, JOG)"
  const Outcome run = hx("S300 M03\nG00 Z20.\nG99 G88 X1. Z-5. R2. P200 F100\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  Path order;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_STOP) order.push_back("stop");
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_M) order.push_back("M" + brief(item.u.action.value));
    if (item.kind == NC_ITEM_MOVE) order.push_back(brief(item.u.move.work.v[2]));
  }
  EXPECT_EQ(order, (Path{"M3", "20", "20", "2", "-5", "M5", "stop", "2", "M3", "M30"}));
}

TEST(Hx, TheBackBoringCycleCutsUpwards) {  // 12.3.10: from R under the part up to Z
  const auto bore = [](const std::string& levels) { return alarm_of("S300 M03\nG00 Z20.\nG98 G87 X1. " + levels + " I.5 F100\nM30"); };
  EXPECT_EQ(bore("Z-25. R-30."), "");
  EXPECT_EQ(bore("Z-30. R-25."), "F_82002");
  EXPECT_EQ(bore("Z-30. R-30."), "F_82002");
  EXPECT_EQ(bore("G91 Z5. R-50."), "");
  EXPECT_EQ(bore("G91 Z-5. R-50."), "F_82002");
}

TEST(Hx, WhatIsNoCircleAnyMoreIsAnAlarm) {  // 15.2.2 with different factors, also where both ends happen to lie on one circle
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J500\nG02 I10. J0 F100\nM30"), "F_82112");
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J500\nG02 X20. I10. F100\nM30"), "F_82112");
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J-2000\nG02 I10. J0 F100\nM30"), "");
  // A corner: R is that of an arc; C would have a leg of its own for each axis.
  EXPECT_EQ(hx("G51 X0 Y0 I500 J1000\nG01 X20. ,R4. F100\nY20.\nM30").path(), (Path{"line 6 0 0 F100", "ccw 10 4 0 c6,4 F100", "line 10 20 0 F100"}));
  EXPECT_EQ(hx("G51 X0 Y0 I1000 J500\nG01 X20. ,R4. F100\nY20.\nM30").path(), (Path{"line 16 0 0 F100", "ccw 20 4 0 c16,4 F100", "line 20 10 0 F100"}));
  const Outcome cut = hx("G51 X0 Y0 I500 J1000\nG01 X20. ,C4. F100\nY20.\nM30");
  EXPECT_EQ(cut.alarm + " " + cut.alarm_detail, "F_82112 The two axes of the plane are scaled differently, so C4 would not be the corner that is written.");
  EXPECT_EQ(m700("G51 X0 P0.5\nG1 X20. ,R4. F100\nY20.\nM30").alarm, "P70");  // M700 13.19 (4): no arc there
}

TEST(Hx, FactorsAreOfOneFormat) {  // 15.2.1, 15.2.2: P, or I J K
  const Outcome run = hx("G51 X0 Y0 P2000 I1000\nG00 X10.\nM30");
  EXPECT_EQ(run.alarm + " " + run.alarm_detail, "F_82004 P2000 and another word of the block exclude each other.");
  EXPECT_EQ(hx("G51 X0 Y0 I1000 J2000 K1000\nG00 X10. Y10.\nM30").path(), (Path{"rapid 10 20 0"}));
}

TEST(Hx, WhatACycleTakesFromTheOneBefore) {
  // 12.3.8: G86 has no P; 12.3.10: Q of the block goes before I and J of an earlier one.
  EXPECT_EQ(hx("S500 M03\nG00 Z20.\nG99 G88 X1. Z-5. R2. P500 F100\nG86 X2.\nG89 X3.\nG80\nM30").dwells(), (std::vector<double>{0.5, 0.5}));
  const std::string program = "S500 M03\nG00 Z20.\nG98 G76 X1. Z-5. R2. I.5 J.25 F100\nG87 X3. Z-3. R-10. Q1.\nG80\nM30";
  Bench by_q(NC_DIALECT_HX);
  by_q.param("3070", "0").param("3071", "0");
  const Outcome run = by_q.run(program);
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  const Path path = run.path();
  EXPECT_NE(std::find(path.begin(), path.end(), "rapid 4 0 -10"), path.end());
  EXPECT_EQ(alarm_of(program), "NC-WORDS");  // PI 70 and PI 71 do not say where Q goes
}

TEST(Hx, CodesBehindACallAreNoArguments) {  // 14.1.1 (1)
  const std::string program = "\nM30\nO1\n#100=#1\nM99";
  for (const char* call : {"G65 P1 G999 A1.", "G65 P1 G31.2 A1.", "G66 P1 G83 A1."}) EXPECT_EQ(alarm_of(call + program), "F_82001") << call;
  EXPECT_EQ(hx("G90 G65 P1 A1." + program).var(100), 1);  // in front of it they act
}

TEST(Hx, ChamferAndRoundingExcludeEachOther) {  // 4.3.1, 4.3.2
  EXPECT_EQ(alarm_of("G01 X30. ,R5. ,C5. F300\nY30.\nM30"), "F_82004");
  EXPECT_EQ(alarm_of("G01 X30. ,C5. ,R5. F300\nY30.\nM30"), "F_82004");
}

TEST(Hx, ParametersAreVariablesOfTheirNumber) {  // 14.2.3
  const Outcome run = hx("#3129=2.5\n#100=#3129\nG99 G83 X1. Z-10. R0 Q5. F100.\n#101=#22097\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 2.5);
  EXPECT_EQ(run.var(101), 0);
  bool near = false;
  for (const std::string& move : run.path()) near = near || move == "rapid 1 0 -2.5";
  EXPECT_TRUE(near);
  EXPECT_EQ(alarm_of("#3151=-1\nM30"), "F_82002");
}

TEST(Hx, SystemVariablesAreThoseOfTheManual) {  // 14.2.3
  Bench bench(NC_DIALECT_HX);
  bench.work_offset(1, {1, 2, 3}).work_offset(6, {10, 20, 30}).work_offset(0, {0.5, 0, 0}).at(5, 6, 7);
  const Outcome run = bench.run("S800 D7 H9\n#100=#2377\n#101=#2379\n#102=#2423\n#103=#2368\n#104=#6205\n#105=#4083\n#106=#6718\n#107=#6733\n"
      "#108=#4792\n#109=#4882\n#110=#4883\nN55 #111=#6716\n#112=#6740\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 3);
  EXPECT_EQ(run.var(102), 20);
  EXPECT_EQ(run.var(103), 0.5);
  EXPECT_EQ(run.var(104), 5);
  EXPECT_EQ(run.var(105), 3.5);
  EXPECT_EQ(run.var(106), 0);   // G00
  EXPECT_EQ(run.var(107), 17);  // group 16
  EXPECT_EQ(run.var(108), 800);
  EXPECT_EQ(run.var(109), 7);
  EXPECT_EQ(run.var(111), 55);
  for (const char* text : {"#8000=1", "#4083=1", "#6718=1"}) EXPECT_EQ(alarm_of(std::string(text) + "\nM30"), "NC-VARIABLE") << text;
  for (const char* text : {"#100=#1600", "#100=#2431", "#100=#4018", "#100=#5001"}) EXPECT_EQ(alarm_of(std::string(text) + "\nM30"), "NC-VARIABLE") << text;
}

TEST(Hx, TheInterfaceHasItsNumbers) {  // 14.2.3 (1), (2)
  const Outcome run = hx("#7501=1\n#7533=5\n#100=#7501\n#101=#7533\nM30");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 5);
}

// ---- modes ---------------------------------------------------------------------------------------------------------------------

TEST(Hx, ParametersChooseTheModesAtPowerOn) {  // 3.2
  const auto starts_with = [](const char* key, const char* value) {
    Bench bench(NC_DIALECT_HX);
    bench.param(key, value);
    const nc_modal modal = bench.run("M30").last_modal();
    std::string codes;
    for (const unsigned group : {1u, 16u, 3u, 6u, 9u}) codes += std::to_string(modal.code[group] / 10) + " ";
    return codes;
  };
  EXPECT_EQ(starts_with("3144", "0"), "0 17 90 21 23 ");
  EXPECT_EQ(starts_with("3144", "1"), "1 17 90 21 23 ");
  EXPECT_EQ(starts_with("3145", "1"), "0 18 90 21 23 ");
  EXPECT_EQ(starts_with("3145", "2"), "0 19 90 21 23 ");
  EXPECT_EQ(starts_with("3146", "1"), "0 17 91 21 23 ");
  EXPECT_EQ(starts_with("3147", "1"), "0 17 90 20 23 ");
  EXPECT_EQ(starts_with("3148", "0"), "0 17 90 21 22 ");
  EXPECT_EQ(starts_with("3148", "1"), "0 17 90 21 23 ");
}

TEST(Hx, TheStrokeCheckKeepsOutOfItsAreaOrInIt) {  // 15.5.3, PM 3474
  const std::string area = "G22 X20. Y20. Z5. I5. J5. K-5.\n";  // A and B, in either order
  EXPECT_EQ(hx(area + "G00 X30.\nX0\nM30").alarm, "");
  EXPECT_EQ(hx(area + "G00 X10. Y10.\nM30").alarm, "NC-LIMIT");
  EXPECT_EQ(hx(area + "G23\nG00 X10. Y10.\nM30").alarm, "");
  const auto outside = [&](const std::string& text) { return Bench(NC_DIALECT_HX).param("23474", "1").at(10, 10, 0).run(area + text + "M30").alarm; };
  EXPECT_EQ(outside("G00 X15. Y7.\n"), "");
  EXPECT_EQ(outside("G00 X21.\n"), "NC-LIMIT");
  EXPECT_EQ(outside("G23\nG00 X21.\n"), "");
}

TEST(Hx, HighSpeedMachiningIsAMode) {  // 15.1
  const Outcome run = hx("G10.3\nG01 X1. F100.\nG11.3\nM30");
  EXPECT_EQ(run.path(), (Path{"line 1 0 0 F100"}));
  std::vector<int> codes;
  for (const Step& step : run.steps)
    if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) codes.push_back(step.modal.code[21]);
  EXPECT_EQ(codes, (std::vector<int>{103, 103, 113, 113}));
}

TEST(Hx, ARigidTapHasItsLeadFromFeedAndSpeed) {  // 12.3.5: 300 r/min x 1.5 mm = F450
  const std::vector<nc_move> moves = hx("S300 M03\nG00 Z20.\nG99 G84.2 X1. Z-5. R2. F450.\nX2.\nG80\nG01 X3.\nM30").moves();
  ASSERT_GE(moves.size(), 5u);
  unsigned taps = 0;
  for (const nc_move& move : moves) {
    if (move.kind != NC_MOVE_TAP) continue;
    ++taps;
    EXPECT_NEAR(move.feed_mm_rev, 1.5, 1e-12);
  }
  EXPECT_EQ(taps, 4u);  // in and out of two holes
  EXPECT_EQ(moves.back().feed_mm_min, 450);  // the F stays in force
  EXPECT_EQ(alarm_of("S300 M03\nG84.3 X1. Z-5. R2.\nM30"), "F_84020");
}

TEST(Hx, ACycleGoesOnWithItsDataUntilAMotionEndsIt) {  // 12.2.1
  EXPECT_EQ(hx("G00 Z20.\nG99 G81 X1. Z-5. R2. F100.\nG82 X2. P500\nG00 X0\nM30").path(),
            (Path{"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -5 F100", "rapid 1 0 2", "rapid 2 0 2", "line 2 0 -5 F100", "rapid 2 0 2",
                  "rapid 0 0 2"}));
  // 12.3.5, 12.3.8: the spindle turns back at the bottom of a tap and stands while a bore is left.
  EXPECT_EQ(hx("S300 M03\nG00 Z20.\nG99 G84 X1. Z-5. R2. F450.\nG80\nM30").aux(), "S300 M3 M4 M3 M30");
  EXPECT_EQ(hx("S300 M04\nG00 Z20.\nG99 G74 X1. Z-5. R2. F450.\nG80\nM30").aux(), "S300 M4 M3 M4 M30");
  EXPECT_EQ(hx("S300 M03\nG00 Z20.\nG99 G86 X1. Z-5. R2. F450.\nG80\nM30").aux(), "S300 M3 M5 M3 M30");
  // 12.3.9, 12.3.10: the shift has I J, or Q with both PI 70 and PI 71.
  for (const char* code : {"G76", "G87"}) EXPECT_EQ(alarm_of(std::string("M03\n") + code + " X1. Z-5. R2. Q1. F450.\nM30"), "NC-WORDS") << code;
  const Outcome fine = hx("M03 S500\nG00 Z20.\nG98 G76 X1. Z-5. R2. I.5 J0 F450.\nG80\nM30");
  EXPECT_EQ(fine.path(), (Path{"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -5 F450", "line 1.5 0 -5 F450", "rapid 1.5 0 20", "rapid 1 0 20"}));
  EXPECT_EQ(fine.aux(), "S500 M3 M19 M3 M30");
  // 12.1.3: in G91 R counts from the initial level, Z from R, each with its own sign.
  EXPECT_EQ(hx("G00 Z20.\nG91 G99 G81 X1. Z-5. R-18. F100. K2\nG80\nM30").path(),
            (Path{"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -3 F100", "rapid 1 0 2", "rapid 2 0 2", "line 2 0 -3 F100", "rapid 2 0 2"}));
}

TEST(Hx, CompensationBeginsByTheTypeOfItsParameter) {  // 13.2.2, PI 128
  const auto path = [](const char* type) {
    Bench bench(NC_DIALECT_HX);
    bench.tool(1, 3, NC_TOOL_RADIUS).param("3128", type);
    return bench.run("G42 D1 G01 X10. F100\nX20. Y10.\nY30.\nG40 X40.\nM30").path();
  };
  EXPECT_EQ(path("0").front(), "line 12.12132 -2.12132 0 F100");
  EXPECT_EQ(path("1").front(), "line 11.242641 -3 0 F100");
}

TEST(HxLength, DoesNotBeginBesideAnArc) {  // docs/decisions.md
  Bench bench(NC_DIALECT_HX);
  bench.tool(1, 10);
  const Outcome run = bench.run("G00 X0 Y0\nG43 H1 G02 X10. Y0 R6. F100\nM30");
  EXPECT_EQ(run.alarm, "F_82004");
  EXPECT_EQ(run.alarm_detail, "G43 cannot stand in the block of an arc. Give it a block in front.");
}

TEST(Hx, G39LeadsOnFromTheCornerOnAnArc) {  // 13.2.1, N3 to N5 of the printed program
  for (const char* words : {"X40. Y20.", "I40. J20."}) {
    Bench bench(NC_DIALECT_HX);
    bench.tool(8, 5, NC_TOOL_RADIUS);
    const Outcome run = bench.run(std::string("G91 G17 G00 G41 X20. Y20. D08\nG01 Z-25. F100\nY40. F250\nG39 ") + words + "\nX40. Y20.\nG40 X10. Y-20.\nM30");
    ASSERT_EQ(run.alarm, "") << run.alarm_detail;
    unsigned arcs = 0;
    for (const nc_move& move : run.moves()) {
      if (move.kind != NC_MOVE_ARC) continue;
      ++arcs;
      EXPECT_NEAR(move.machine_center[0], 20, 1e-9);
      EXPECT_NEAR(move.machine_center[1], 60, 1e-9);
      EXPECT_NEAR(move.machine.v[0], 20 - std::sqrt(5.0), 1e-9);
      EXPECT_NEAR(move.machine.v[1], 60 + 2 * std::sqrt(5.0), 1e-9);
    }
    EXPECT_EQ(arcs, 1u) << words;
  }
}

TEST(Hx, QShiftsByItsTwoParameters) {  // 12.3.9, 12.3.10, PI 70, PI 71
  const auto beside = [](const char* axis, const char* direction, const std::string& plane, const char* words) {
    Bench bench(NC_DIALECT_HX);
    bench.param("3070", axis).param("3071", direction);
    const Outcome run = bench.run("M03 S500\n" + plane + words + "\nG80\nM30");
    EXPECT_EQ(run.alarm, "") << run.alarm_detail;
    return run.path().size() < 4 ? std::string() : run.path()[2];
  };
  const char* const g76 = "G98 G76 X1. Y2. Z-5. R2. Q.5 F450.";
  EXPECT_EQ(beside("0", "0", "", g76), "line 1 2 -5 F450");
  const auto shifted = [](const char* axis, const char* direction) {
    Bench bench(NC_DIALECT_HX);
    bench.param("3070", axis).param("3071", direction);
    return bench.run("M03 S500\nG98 G76 X1. Y2. Z-5. R2. Q.5 F450.\nG80\nM30").path()[3];
  };
  EXPECT_EQ(shifted("0", "0"), "line 1.5 2 -5 F450");
  EXPECT_EQ(shifted("0", "1"), "line 0.5 2 -5 F450");
  EXPECT_EQ(shifted("1", "0"), "line 1 2.5 -5 F450");
  EXPECT_EQ(shifted("1", "1"), "line 1 1.5 -5 F450");
  Bench words(NC_DIALECT_HX);  // I J of the block go before
  words.param("3070", "0").param("3071", "0");
  EXPECT_EQ(words.run("M03 S500\nG98 G76 X1. Y2. Z-5. R2. Q.5 I0 J-.25 F450.\nG80\nM30").path()[3], "line 1 1.75 -5 F450");
  Bench one(NC_DIALECT_HX);
  one.param("3070", "0");
  EXPECT_EQ(one.run("M03\nG76 X1. Z-5. R2. Q1. F450.\nM30").alarm, "NC-WORDS") << "the direction is not said";
}

TEST(Hx, ScalingAndRotationMayBeginWithTheProgram) {  // 3.2, PI 149, PI 150
  Bench scaled(NC_DIALECT_HX);
  scaled.param("3149", "1").param("3108", "2000").param("3109", "-1000").work_offset(1, {10, 0, 0});
  const Outcome run = scaled.run("G00 X5. Y5. Z5.\nG50\nX5.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 20 -5 5", "rapid 15 -5 5"}));  // about the zero point of the coordinates
  EXPECT_EQ(run.steps[1].modal.code[11], 510);
  EXPECT_EQ(scaled.run("G00 X5.\nM30").path(), (Path{"rapid 20 -5 5"}));  // and with each program
  Bench turned(NC_DIALECT_HX);
  turned.param("3150", "1").param("3117", "90");
  EXPECT_EQ(turned.run("G00 X5. Y0\nG69\nX1.\nM30").path(), (Path{"rapid 0 5 0", "rapid 1 5 0"}));
}

TEST(Hx, AStitchHasTheFeedAndTheWaitOfItsLength) {  // 15.6
  Bench bench(NC_DIALECT_HX);
  bench.param("27321", "1").param("27322", "5").param("27323", "20");              // ends of the ranges
  for (const char* range : {"27324", "27325", "27326", "27327"}) bench.param(range, "20");
  bench.param("27328", "100").param("27329", "200").param("27330", "300").param("27335", "900");  // feed of X
  bench.param("27336", "10").param("27337", "20");                                  // wait of X
  bench.param("27344", "50").param("27353", "40");                                  // feed of Y, wait of Y
  const Outcome run = bench.run("G91 G00 X1.\nG63.1\nX1.\nX1.5\nG01 X20. F777\nX21.\nX.3 Y.4\nY3.\nZ1.\nG63.2\nG00 X1.\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  std::string feeds;
  for (const nc_move& move : run.moves()) feeds += move.kind == NC_MOVE_RAPID ? "rapid " : brief(move.feed_mm_min) + " ";
  // X.3 Y.4 is 0.5 long: X may go 100/0.6, Y 50/0.8. Z has no table.
  EXPECT_EQ(feeds, "rapid 100 200 300 900 62.5 777 777 rapid ");
  EXPECT_EQ(run.dwells(), (std::vector<double>{0.01, 0.02, 0.01, 0.04}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).run("G63.1\nG00 X1.\nG01 X2. F50.\nM30").path(), (Path{"rapid 1 0 0", "line 2 0 0 F50"}));  // nothing is set
  EXPECT_EQ(alarm_of("G63.1\nG01 X2.\nM30"), "F_84020");
  const std::vector<nc_move> slow = bench.run("G91 G00 X1.\nG63.1\nG01 X.3 Y3. F60\nG63.2\nM30").moves();  // of the way of Y the table says nothing
  EXPECT_NEAR(slow.back().feed_mm_min, 60, 1e-9);
}

/// What a run gives out, in its order: moves, dwells, questions for inputs, and the bit of PPF.
std::string order_of_stitches(const Outcome& run) {
  std::string order;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) order += "move ";
    if (item.kind == NC_ITEM_SYNC) order += "? ";
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) order += brief(item.u.gate.value) + " ";
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_OUTPUT) {
      EXPECT_EQ(item.u.action.index, 0u);
      EXPECT_EQ(item.u.action.mask, 1u << 31);
      order += item.u.action.bits != 0 ? "on " : "off ";
    }
  }
  return order;
}

TEST(Hx, AStitchIsAskedOfTheHeadAndWaitedFor) {  // 15.6, PM 7308, 7374 to 7408: PPF, PPE, NPFIN (docs/decisions.md)
  constexpr uint32_t kPpe = 1u << 30, kNpfin = 1u << 31;
  Bench bench(NC_DIALECT_HX);
  bench.param("27308", "1").param("27321", "100").param("27336", "1").param("27374", "5").param("27382", "7").param("27395", "2").param("27394", "3").param("27408", "50");
  unsigned asked = 0;
  const uint32_t answers[] = {0, kPpe, kPpe, kNpfin, kNpfin, kPpe | kNpfin, kPpe | kNpfin};
  bench.on_sync = [&](const nc_item&) { bench.input[0] = answers[std::min<size_t>(asked++, std::size(answers) - 1)]; };
  const Outcome run = bench.run("G63.1\nG01 X1. F100\nX2. Y1.\nZ1.\nG63.2\nG00 X3.\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  // X alone waits for its own times, X and Y for the longer one of theirs; Z is no stitch.
  EXPECT_EQ(order_of_stitches(run), "off move 0.001 0.005 on ? 0.01 ? 0.002 off ? 0.01 ? 0.003 move 0.001 0.007 on ? 0.01 ? 0.002 off ? 0.003 move off move ");

  Bench silent(NC_DIALECT_HX);
  silent.param("27308", "1");
  const Outcome none = silent.run("G63.1\nG01 X1. F100\nM30");
  EXPECT_EQ(none.alarm, "NC-STITCH");
  EXPECT_EQ(none.alarm_line, 2u);
  const std::string order = order_of_stitches(none);
  EXPECT_EQ(order.substr(order.size() - 6), "? off ") << "PPF does not stay on";
  silent.input[0] = kPpe;
  EXPECT_EQ(silent.run("G63.1\nG01 X2. F100\nM30").alarm, "NC-STITCH");
  silent.input[0] = kPpe | kNpfin;
  EXPECT_EQ(silent.run("G63.1\nG01 X3. F100\nM30").alarm, "");
  EXPECT_EQ(bench.run("G63.1\nG01 X100. F100\nM30").alarm, "F_82002") << "the longest stitch";
  EXPECT_EQ(silent.tool(1, 2, NC_TOOL_RADIUS).run("G41 D1 G01 X5. F100\nX9.\nG63.1\nX20.\nM30").alarm, "NC-OFFSET-CODE");
  const std::string exclude = "A stitch and tool radius compensation exclude each other. End one of them with G63.2 or G40 first.";
  EXPECT_EQ(silent.run("G63.1\nG41 D1 G01 X4. F100\nM30").alarm_detail, exclude) << "it would begin here";
  EXPECT_EQ(silent.run("G41 D1 G01 X5. F100\nX9.\nG63.1\nX20.\nM30").alarm_detail, exclude);
}

TEST(Hx, EveryAlarmOfTheManualIsRaisedByWhatItIsFor) {  // the numbers of the spec, section 13
  std::string long_sum;
  for (unsigned i = 0; i < 2000; ++i) long_sum += "+1.5";
  const std::map<std::string, std::string> programs = {
      {"F_82001", "G00 X1. ^\nM30"},
      {"F_82002", "T123456789012 G00 X1.\nS999999999999\nM30"},
      {"F_82004", "G00 X1.2.3\nM30"},
      {"F_82016", "G00 X1."},
      {"F_82018", "N0 G00 X1.\nM30"},
      {"F_82019", "GOTO 5\nM30"},
      {"F_82021", "O1\nM98 P1\nM30"},
      {"F_82030", "G05\nM30"},
      {"F_82100", "G02 X50. R5. F100\nM30"},
      {"F_82109", "M98 P777\nM30"},
      {"F_82111", "#100=1" + long_sum + "\nM30"},
      {"F_82112", "G02 X50. Y50.5 I50. F100\nM30"},
      {"F_82208", "G107 X10.\nM30"},
      {"F_82209", "G00 X10.\nG27 X5.\nM30"},
      {"F_84020", "G01 X50.\nM30"},
  };
  for (const auto& [code, text] : programs) EXPECT_EQ(alarm_of(text), code) << text.substr(0, 60);
}

TEST(Hx, WhatIsNotBuiltOfAParameterIsRefused) {
  ParameterKey key;
  for (const char* text : {"3133", "27391", "27393"}) {  // of PI 133 the value 1; 2 is tests/control/program_restart_test.cpp
    ASSERT_TRUE(parse_parameter_key(text, &key));
    EXPECT_TRUE(parameter_takes(dialect(NC_DIALECT_HX), key, 0)) << text;
    EXPECT_FALSE(parameter_takes(dialect(NC_DIALECT_HX), key, 1)) << text;
  }
}

}  // namespace
}  // namespace nc::test
