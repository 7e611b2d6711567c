// SPDX-License-Identifier: Apache-2.0
// The hx family: what its manual says otherwise than those of the other families do, one test for each rule.
#include <gtest/gtest.h>

#include <string>
#include <vector>

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

TEST(Hx, RoundAloneInAnAddressRoundsToTheLeastUnit) {  // 14.2.4: X[ROUND[#1]], "X 0.001", beside X-[ROUND[#1]+ROUND[#2]], which is X3.
  const auto end = [](const char* words) {
    const Outcome run = hx("#1=1.4567\n#2=2.3456\nG01 F100. " + std::string(words) + "\nM30");
    EXPECT_EQ(run.alarm, "") << words;
    return run.path();
  };
  for (const char* words : {"X[ROUND[#1]]", "XROUND[#1]", "X[[ROUND[#1]]]", "X[RND[#1]]"}) EXPECT_EQ(end(words), (Path{"line 1.457 0 0 F100"})) << words;
  for (const char* words : {"X-[ROUND[#1]]", "X-ROUND[#1]"}) EXPECT_EQ(end(words), (Path{"line -1.457 0 0 F100"})) << words;
  EXPECT_EQ(end("X[ROUND[ROUND[#1]]]"), (Path{"line 1 0 0 F100"}));
  EXPECT_EQ(end("X-[ROUND[#1]+ROUND[#2]]"), (Path{"line -3 0 0 F100"}));
  EXPECT_EQ(end("X[0+ROUND[#1]]"), (Path{"line 1 0 0 F100"}));
  EXPECT_EQ(end("X[FIX[#1]] Y[FUP[#1]]"), (Path{"line 1 2 0 F100"}));
  EXPECT_EQ(end("X1. Y[ROUND[#9]]"), (Path{"line 1 0 0 F100"}));  // of a vacant variable it is 0
  EXPECT_EQ(hx("#1=1.5\n#3=ROUND[#1]\n#4=0\nIF[2 EQ ROUND[#1]]GOTO10\n#4=1\nN10 G01 F[ROUND[#1]] X1.\nM30").path(), (Path{"line 1 0 0 F2"}));
  EXPECT_EQ(hx("G20\n#1=1.45678\nG00 X[ROUND[#1]]\nM30").path(), (Path{"rapid 37.00272 0 0"}));  // 1.4568 inch
}

TEST(Hx, BracketsStandTenDeep) {  // 14.2.4, 14.4
  const auto sum = [](size_t levels) { return "#100=" + std::string(levels, '[') + "1" + std::string(levels, ']') + "\nM30"; };
  EXPECT_EQ(hx(sum(10)).var(100), 1);
  EXPECT_NE(alarm_of(sum(11)), "");
}

TEST(Hx, ABlockHasThreeHundredCharacters) {  // 2.2.4
  const auto block = [](size_t characters, const std::string& blanks) {
    std::string text = "G00";
    while (text.size() + 8 <= characters) text += "X1.00000";
    text += std::string(characters - text.size(), '0');
    return text + blanks + "\nM30";
  };
  EXPECT_EQ(alarm_of(block(300, "")), "");
  EXPECT_EQ(alarm_of(block(301, "")), "F_82111");
  EXPECT_EQ(alarm_of(block(300, std::string(50, ' ') + "(a comment that is no part of the block)")), "");
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

}  // namespace
}  // namespace nc::test
