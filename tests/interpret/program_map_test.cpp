// SPDX-License-Identifier: Apache-2.0
// Figure rotation (M700 13.3.3), mirror image by program (13.6), parameters by program (13.11).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {
namespace {

// ---- figure rotation ------------------------------------------------------------------------------------------------------------

TEST(FigureRotation, QuarterTurnsInAbsoluteAndIncremental) {  // (2), (5)
  Bench bench;
  bench.add("O1", "G90 G1 X10. Y10. F100\nX0 Y10.\nM99\n");
  bench.add("O2", "G91 G1 Y10. F100\nX-10.\nM99\n");
  const Path expected{"rapid 10 0 0", "line 10 10 0 F100", "line 0 10 0 F100", "line -10 10 0 F100", "line -10 0 0 F100"};
  EXPECT_EQ(bench.run("G90 G0 X10.\nM98 P1 L2 I-10.\nM30").path(), expected);
  EXPECT_EQ(bench.at(0, 0, 0).run("G90 G0 X10.\nM98 P2 L2 I-10.\nM30").path(), expected);
}

TEST(FigureRotation, ACallBehindAnArcMakesNoArc) {  // P, I and J are words of the call, also where an arc would take them
  const Path expected{"rapid 10 0 0", "cw 12 0 0 c11,0 F100", "line 10 10 0 F100", "line 0 10 0 F100", "line -10 10 0 F100", "line -10 0 0 F100"};
  for (const char* call : {"M98 P1 L2 I-12.", "G90 M98 P1 L2 I-12. J0"}) {
    Bench bench;
    bench.add("O1", "G90 G1 X10. Y10. F100\nX0 Y10.\nM99\n");
    const Outcome run = bench.run(std::string("G90 G0 X10.\nG2 X12. I1. F100\n") + call + "\nM30");
    EXPECT_EQ(run.alarm, "");
    unsigned arcs = 0;
    for (const std::string& step : run.path()) arcs += step.find("cw") != std::string::npos;
    EXPECT_EQ(arcs, 1u) << call;
    EXPECT_EQ(run.path().size(), expected.size()) << call;
  }
  Bench bench;
  bench.add("O1", "M99\n");
  EXPECT_EQ(bench.run("G90 G3 X2. Y0 I1. F100\nM96 P1 I1.\nM97\nM98 P1 K1.\nM30").path(), Path{"ccw 2 0 0 c1,0 F100"});
}

TEST(FigureRotation, OneWordMovesBothAxes) {
  Bench bench;
  bench.add("O1", "G90 G1 Y10. F100\nX0\nM99\n");
  EXPECT_EQ(bench.run("G90 G0 X10.\nM98 P1 L2 I-10.\nM30").path(),
            (Path{"rapid 10 0 0", "line 10 10 0 F100", "line 0 10 0 F100", "line -10 10 0 F100", "line -10 0 0 F100"}));
}

TEST(FigureRotation, ArcsTurnToo) {  // (3)
  Bench bench;
  bench.add("O1", "G3 X0 Y10. I-10. F100\nM99\n");
  EXPECT_EQ(bench.run("G90 G0 X10.\nM98 P1 L4 I-10.\nM30").path(),
            (Path{"rapid 10 0 0", "ccw 0 10 0 c0,0 F100", "ccw -10 0 0 c0,0 F100", "ccw 0 -10 0 c0,0 F100", "ccw 10 0 0 c0,0 F100"}));
}

TEST(FigureRotation, TheAxisOutsideThePlaneIsNotTurned) {
  Bench bench;
  bench.add("O1", "G1 Z-1. F100\nX0 Y10.\nZ0\nM99\n");
  EXPECT_EQ(bench.run("G90 G0 X10.\nM98 P1 L2 I-10.\nM30").path(),
            (Path{"rapid 10 0 0", "line 10 0 -1 F100", "line 0 10 -1 F100", "line 0 10 0 F100", "line 0 10 -1 F100", "line -10 0 -1 F100",
                  "line -10 0 0 F100"}));
}

TEST(FigureRotation, NotOnOneCircle) {  // (4): the first move of a pass goes to the end point of its turned block
  Bench bench;
  bench.add("O1", "G90 G1 X20. Y0 F100\nX0 Y20.\nM99\n");
  EXPECT_EQ(bench.run("G90 G0 X10.\nM98 P1 L2 I-10.\nM30").path(),
            (Path{"rapid 10 0 0", "line 20 0 0 F100", "line 0 20 0 F100", "line -20 0 0 F100"}));
}

/// The moves of the sub program in all passes of a figure about X0 Y0 that begins at X20 Y0. Each pass must be the first one, turned by a quarter
/// turn for each pass since.
std::vector<nc_move> quarter_turns(Bench& bench, const char* sub, unsigned passes = 3) {
  bench.add("O1", std::string(sub) + "\nM99\n");
  const Outcome run = bench.at(20, 0, 0).run("G90 F100\nM98 P1 L" + std::to_string(passes) + " I-20.\nM30");
  EXPECT_EQ(run.alarm, "") << sub;
  const std::vector<nc_move> moves = run.moves();
  const size_t each = moves.size() / passes;
  EXPECT_EQ(moves.size(), each * passes) << sub;
  for (size_t i = each; i < each * passes; ++i) {
    const nc_move& before = moves[i - each];
    EXPECT_NEAR(moves[i].machine.v[0], -before.machine.v[1], 1e-9) << sub << " " << i;
    EXPECT_NEAR(moves[i].machine.v[1], before.machine.v[0], 1e-9) << sub << " " << i;
    EXPECT_NEAR(moves[i].machine.v[2], before.machine.v[2], 1e-9) << sub << " " << i;
    EXPECT_EQ(moves[i].plane, before.plane) << sub << " " << i;
    if (moves[i].plane == NC_PLANE_NONE) continue;
    EXPECT_EQ(moves[i].ccw, before.ccw) << sub << " " << i;
    EXPECT_NEAR(moves[i].machine_center[0], -before.machine_center[1], 1e-9) << sub << " " << i;
    EXPECT_NEAR(moves[i].machine_center[1], before.machine_center[0], 1e-9) << sub << " " << i;
  }
  return moves;
}

TEST(FigureRotation, WhatTheSubProgramScalesIsTheShape) {  // 13.19, relation (6)
  Bench bench;
  EXPECT_EQ(quarter_turns(bench, "G51 X20. Y0 P0.5\nG1 X24.\nX20.\nG50\nX0 Y20.")[0].machine.v[0], 22);
  EXPECT_EQ(quarter_turns(bench, "G91 G51 X0 Y0 P3.\nG1 X4.\nX-4.\nG50\nG90 X0 Y20.")[0].machine.v[0], 32);
  const nc_move arc = quarter_turns(bench, "G51 X20. Y0 P2.\nG1 X22.\nG3 X20. Y2. I-2.\nX18. Y0 R2.\nG1 X20.\nG50\nX0 Y20.")[1];
  EXPECT_NEAR(arc.machine.v[1], 4, 1e-9);
  EXPECT_NEAR(arc.radius, 4, 1e-9);
  quarter_turns(bench, "G51 X20. P2.\nG1 X22. Y3.\nG50\nX0 Y20.");         // one axis
  quarter_turns(bench, "G51 X20. Y0 Z1. P2.\nG1 X21. Z-2.\nZ0\nG50\nX0 Y20. Z0");
  bench.add("O1", "G51 X20. P2.\nG3 X20. Y4. J2. F100\nM99\n");
  EXPECT_EQ(bench.at(20, 0, 0).run("G90 F100\nM98 P1 L2 I-20.\nM30").alarm, "P70");  // 13.19 (4)
}

TEST(FigureRotation, WhatTheSubProgramMirrorsIsTheShape) {  // 13.3.3 (3): all blocks in the sub program are turned
  Bench bench;
  const std::vector<nc_move> moves = quarter_turns(bench, "G51.1 X20.\nG1 X24. Y3.\nX20. Y0\nG50.1 X0\nX0 Y20.");
  EXPECT_NEAR(moves[0].machine.v[0], 16, 1e-9);
  EXPECT_NEAR(moves[0].machine.v[1], 3, 1e-9);
  const nc_move arc = quarter_turns(bench, "G51.1 X20.\nG1 X24.\nG3 X22. Y2. I-2.\nG1 X20. Y0\nG50.1\nX0 Y20.")[1];
  EXPECT_EQ(arc.ccw, 0);
  EXPECT_NEAR(arc.machine_center[0], 18, 1e-9);
  quarter_turns(bench, "G91 G51.1 X1.\nG90 G1 X24. Y3.\nX22. Y0\nG50.1\nX0 Y20.");
  quarter_turns(bench, "G51.1 X20. Y0\nG1 X24. Y3.\nX20. Y0\nG50.1 X0\nY1.\nG50.1\nX0 Y20.");
  quarter_turns(bench, "G51 X20. Y0 P2.\nG51.1 Y0\nG1 X24. Y3.\nX20. Y0\nG50 G50.1\nX0 Y20.");
}

TEST(FigureRotation, TheSideOfCompensationInAMirroredShape) {
  const auto sub = [](const char* vector) {
    return std::string("G0 G41 D1 X21. Y1.") + vector + "\nG1 X24.\nY3.\nX21.\nG0 G40 X20. Y0\nG50.1\nX0 Y20.";
  };
  for (const char* mirror : {"G51.1 X20.\n", "G51.1 Y0\n", "G51.1 X20. Y0\n", ""})
    for (const char* vector : {"", " I5. J1."}) {
      Bench bench;
      bench.tool(1, 0.5);
      quarter_turns(bench, (mirror + sub(vector)).c_str());
    }
}

TEST(FigureRotation, WhatTheCallerScalesAndMirrorsIsCentreAndRadius) {  // 13.19, relation (5), and both at once
  Bench bench;
  bench.add("O1", "G1 X24. Y3.\nX0 Y20.\nM99\n");
  EXPECT_EQ(bench.at(40, 0, 0).run("G51 X0 Y0 P2.\nF100\nM98 P1 L2 I-20.\nM30").path(),
            (Path{"line 48 6 0 F100", "line 0 40 0 F100", "line -6 48 0 F100", "line -40 0 0 F100"}));
  EXPECT_EQ(bench.at(-20, 0, 0).run("G51.1 X0\nF100\nM98 P1 L2 I-20.\nM30").path(),
            (Path{"line -24 3 0 F100", "line 0 20 0 F100", "line 3 24 0 F100", "line 20 0 0 F100"}));
  // The caller's mirror acts after the turn, the scaling of the shape before it.
  bench.add("O1", "G51 X20. Y0 P0.5\nG1 X24. Y3.\nG50\nX0 Y20.\nM99\n");
  EXPECT_EQ(bench.at(-20, 0, 0).run("G51.1 X0\nF100\nM98 P1 L2 I-20.\nM30").path(),
            (Path{"line -22 1.5 0 F100", "line 0 20 0 F100", "line 1.5 22 0 F100", "line 20 0 0 F100"}));
}

TEST(FigureRotation, AHoleIsAsDeepAsALineGoes) {  // mirrored in the shape and then scaled, about different centres
  Bench bench;
  bench.add("O1", "G51.1 Z3.\nG1 Z-4. F100\nZ9.\nG99 G81 X5. Y5. Z-4. R-1.\nG80\nG50.1\nM99\n");
  EXPECT_EQ(bench.at(10, 0, 0).run("G90 G51 X0 Y0 Z0 P2.\nM98 P1 I-5.\nG50\nM30").path(),
            (Path{"line 10 0 20 F100", "line 10 0 -6 F100", "rapid 10 10 -6", "rapid 10 10 14", "line 10 10 20 F100", "rapid 10 10 14"}));
}

TEST(FigureRotation, WhatTheSubProgramLeavesInForceIsTheCallers) {
  Bench bench;
  bench.add("O1", "G51 X20. Y0 P2.\nG1 X10. Y10.\nM99\n");  // ends at X0 Y20
  EXPECT_EQ(bench.at(20, 0, 0).run("G90 F100\nM98 P1 L2 I-20.\nX21. Y0\nG50\nX21.\nM30").path(),
            (Path{"line 0 20 0 F100", "line -20 0 0 F100", "line 22 0 0 F100", "line 21 0 0 F100"}));
}

TEST(FigureRotation, WhatCannotBeUsedInside) {  // (9), appendix 1
  const auto alarm = [](const char* block) {
    Bench bench;
    bench.add("O1", std::string("G1 X5. F100\n") + block + "\nM99\n");
    return bench.run("G90 G0 X10.\nM98 P1 L2 I-10.\nM30").alarm;
  };
  EXPECT_EQ(alarm("G68 X0 Y0 R30."), "P252");
  EXPECT_EQ(alarm("G69"), "P252");
  EXPECT_EQ(alarm("G45 X1. D1"), "P141");
  EXPECT_EQ(alarm("G48 X1. D1"), "P141");
  EXPECT_EQ(alarm("G53 X0"), "P34");
  EXPECT_EQ(alarm("G28 Y0"), "P34");
  EXPECT_EQ(alarm("G60 X1."), "P34");
  EXPECT_EQ(alarm("G53 Z0"), "");  // not an axis of the plane
  EXPECT_EQ(alarm("G28 Z0"), "");
}

TEST(FigureRotation, NotWithinCoordinateRotation) {  // precaution (2)
  Bench bench;
  bench.add("O1", "G1 X5. F100\nM99\n");
  EXPECT_EQ(bench.run("G68 X0 Y0 R30.\nG0 X10. Y0\nM98 P1 L2 I-10.\nM30").alarm, "P252");
  EXPECT_EQ(bench.run("G68 X0 Y0 R30.\nG0 X10. Y0\nM98 P1 L2\nM30").alarm, "");
  EXPECT_EQ(bench.run("G68 X0 Y0 R30.\nG69\nG0 X10. Y0\nM98 P1 L2 I-10.\nM30").alarm, "");
}

TEST(FigureRotation, NoCallsInside) {  // (6)
  Bench bench;
  bench.add("O1", "M98 P2\nM99\n");
  bench.add("O2", "M99\n");
  EXPECT_EQ(bench.run("M98 P1 L2 I1.\nM30").alarm, "P230");
  bench.add("O1", "M98 P2 I1.\nM99\n");
  EXPECT_EQ(bench.run("M98 P1 L2 I1.\nM30").alarm, "P230");
  bench.add("O1", "G65 P2\nM99\n");
  EXPECT_EQ(bench.run("M98 P1 L2 I1.\nM30").alarm, "P230");
  EXPECT_EQ(bench.run("M98 P1 L0 I1.\nM30").alarm, "");
}

// ---- mirror ------------------------------------------------------------------------------------------------------------------------

TEST(Mirror, OneAxisTurnsArcsAndTheSideOfCompensation) {  // 13.6
  EXPECT_EQ(m700("G0\nG51.1 X0\nG2 X10. Y10. J10. F100\nG50.1 X0\nM30").path(), (Path{"ccw -10 10 0 c0,10 F100"}));
  EXPECT_EQ(m700("G0\nG51.1 X0 Y0\nG2 X10. Y10. J10. F100\nM30").path(), (Path{"cw -10 -10 0 c0,-10 F100"}));
  Bench bench;
  bench.tool(1, 1);
  const Path plain = bench.run("G0\nG41 D1 X5. Y5.\nG1 X20. F100\nY20.\nG40 G0 X30.\nM30").path();
  const Path mirrored = bench.at(0, 0, 0).run("G0\nG51.1 X0\nG41 D1 X5. Y5.\nG1 X20. F100\nY20.\nG40 G0 X30.\nM30").path();
  ASSERT_EQ(plain.size(), mirrored.size());
  for (size_t i = 0; i < plain.size(); ++i) {
    std::string flipped = mirrored[i];
    const size_t at = flipped.find(' ') + 1;
    flipped = flipped[at] == '-' ? flipped.erase(at, 1) : flipped.insert(at, "-");
    EXPECT_EQ(plain[i], flipped);
  }
}

TEST(Mirror, CentreByG90AndG91FollowsTheCoordinateSystem) {
  EXPECT_EQ(m700("G0 X10.\nG91 G51.1 X5.\nG90 X20. Y1.\nM30").path(), (Path{"rapid 10 0 0", "rapid 10 1 0"}));  // about X15
  Bench bench;
  bench.work_offset(2, {100, 0, 0});
  EXPECT_EQ(bench.run("G0\nG51.1 X10.\nX15.\nG55 X15.\nM30").path(), (Path{"rapid 5 0 0", "rapid 105 0 0"}));
}

TEST(Mirror, ShownInTheModalStateAndIn3007) {
  const Outcome run = m700("#100=#3007\nG51.1 X0 Z0\n#101=#3007\n#102=#4019\nG50.1 X0\n#103=#3007\nG50.1\n#104=#4019\nM30");
  EXPECT_EQ(run.var(100), 0);
  EXPECT_EQ(run.var(101), 5);
  EXPECT_EQ(run.var(102), 51.1);
  EXPECT_EQ(run.var(103), 4);
  EXPECT_EQ(run.var(104), 50.1);
  EXPECT_EQ(m700("G51.1\nM30").alarm, "P33");
}

TEST(Mirror, HolesOfACycle) {
  const Path path = m700("G0\nG51.1 X0\nG81 X10. Y3. Z-2. R1. F100\nG80\nM30").path();
  ASSERT_FALSE(path.empty());
  EXPECT_EQ(path.front(), "rapid -10 3 0");
}

TEST(Mirror, DrillingAxisOfACycle) {
  const std::string cycle = "G0 Z10.\nG51.1 Z0\nG98 G81 X1. Z-2. R3. F100\nG91 X1. Z-5. R-1.\nG80\nM30";
  EXPECT_EQ(m700(cycle).path(), (Path{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 -3", "line 1 0 2 F100", "rapid 1 0 10", "rapid 2 0 10",
                                      "rapid 2 0 11", "line 2 0 16 F100", "rapid 2 0 10"}));
}

// ---- parameter input ----------------------------------------------------------------------------------------------------------------

TEST(ParameterInput, BitNumberAndText) {  // 13.11
  Bench bench;
  const Outcome run = bench.run("#1=1037\nG10 L70\nP#1 D2\nP6401 H71\nP8204 S1 A2 D1.2345\nP8621 <X>\nG11\n#16001=3\nM30");
  EXPECT_EQ(run.alarm, "");
  double value = 0;
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "6401/bit7", 0, &value), NC_OK);
  EXPECT_EQ(value, 1);
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "8204", 'Y', &value), NC_OK);
  EXPECT_NEAR(value, 1.234, 1e-3);  // rounded to the setting unit
  EXPECT_EQ(std::nearbyint(value * 1000), value * 1000);
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "8621", 0, &value), NC_OK);
  EXPECT_EQ(value, 'X');
  EXPECT_EQ(bench.tool_now(1, NC_TOOL_RADIUS), 3);  // #1037 acts at once
}

TEST(ParameterInput, TextsOfSeveralCharacters) {  // "up to 63 characters"; #100010 reads them by their codes
  const auto read = [](const char* text, const char* number) {
    return m700(std::string("G10 L70\nP") + number + " <" + text + ">\nG11\n#100000=" + number + "\n#100001=0\n#101=#100010\nM30");
  };
  EXPECT_EQ(read("X", "8621").var(101), 'X');
  EXPECT_EQ(read("X1", "8880").var(101), 'X' * 256 + '1');
  EXPECT_EQ(read("PART-A", "8880").alarm, "");
  EXPECT_EQ(read("LONGER-THAN-6", "8880").alarm, "P39");  // kept, and no number
  EXPECT_EQ(read("AB", "1078").alarm, "P421");             // a number
  EXPECT_EQ(read("X1", "8621").alarm, "P421");             // an axis
  EXPECT_EQ(read("1A", "8880").alarm, "P421");
}

TEST(ParameterInput, WhatIsNotPossibleIsP421) {
  EXPECT_EQ(m700("G10 L70 P1\nM30").alarm, "P421");
  EXPECT_EQ(m700("G11\nM30").alarm, "");  // 12.7 (3): it ends the input of offsets too
  EXPECT_EQ(m700("G10 L70\nG1 X1.\nG11\nM30").alarm, "P421");
  EXPECT_EQ(m700("G10 L70\nP1078 D5\nG11\nM30").alarm, "P421");
  EXPECT_EQ(m700("G10 L70\nP1078\nG11\nM30").alarm, "P421");
  EXPECT_EQ(m700("G10 L70\nP1078 H82\nG11\nM30").alarm, "P421");
  EXPECT_EQ(m700("G10 L70\nP8204 A4 D1\nG11\nM30").alarm, "P421");
  for (const char* number : {"P0 D1", "P1.5 D1", "P100000 D1", "P99999 D1", "P1000 D1", "P-1 D1", "P8204 A1.5 D1", "P8204 S1.5 D1", "P6401 H71.5", "P6401 H-1"}) {
    const Outcome run = m700("G10 L70\n" + std::string(number) + "\nG11\nM30");
    EXPECT_EQ(run.alarm, "P421") << number;
    EXPECT_EQ(run.alarm_line, 2u) << number;
  }
  EXPECT_EQ(m700("G10 L70\nP8204 S2 D1\nG11\nM30").alarm, "P421");
  EXPECT_EQ(m700("G81 X1. Z-1. R1. F100\nG10 L70\nM30").alarm, "P421");
}

TEST(ParameterInput, EndsWithG11AndG11Point1) {  // 13.11 prints G11.1 in its format and its example, note 7 has G11
  for (const char* end : {"G11", "G11.1"}) {
    const Outcome run = m700(std::string("G10 L70\nP8204 A2 D1.5\n") + end + "\nG0 X7.\nM30");
    EXPECT_EQ(run.alarm, "") << end;
    EXPECT_EQ(run.path().size(), 1U) << end;
    EXPECT_EQ(m700(std::string("G10 L70\n") + end + " X1.\nM30").alarm, "P421") << end;  // note 7
    EXPECT_EQ(m700(std::string("G10 L70\n") + end + " M8\nM30").alarm, "P421") << end;
    EXPECT_EQ(m700(std::string(end) + "\nG0 X7.\nM30").alarm, "") << end;
  }
  EXPECT_EQ(m700("G10 L70\nG11.2\nM30").alarm, "P34");
}

TEST(ParameterInput, SequenceOfTheWords) {  // note 1
  const auto alarm_of = [](const std::string& data) { return m700("G10 L70\n" + data + "\nG11\nM30").alarm; };
  EXPECT_EQ(alarm_of("P8204 S1 A2 D1.5"), "");
  EXPECT_EQ(alarm_of("P8204 S1 A1 A2 D1.5 D2.5"), "");  // the last one counts
  EXPECT_EQ(alarm_of("D1.5 P8204"), "P421");
  EXPECT_EQ(alarm_of("P8204 A2 S1 D1.5"), "P421");
  EXPECT_EQ(alarm_of("P8204 D1.5 A2"), "P421");
  EXPECT_EQ(alarm_of("H71 P6401"), "P421");
}

TEST(ParameterInput, RewindTakesItBack) {
  Bench bench;
  bench.start("#100=1\nG10 L70\nP1078 D1\nG11\nG0 X7\nM30");
  Step step;
  uint64_t first = 0;
  nc_axes at{};
  while (bench.pull(&step) == NC_OK)
    if (first == 0 && step.item.kind == NC_ITEM_MARK) first = step.item.serial, at = step.machine;
  double value = 0;
  nc_parameter_get(bench.control(), 0, "1078", 0, &value);
  ASSERT_EQ(value, 1);
  ASSERT_EQ(bench.rewind(first, at), NC_OK);
  nc_parameter_get(bench.control(), 0, "1078", 0, &value);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(bench.finish().path(), (Path{"rapid 7 0 0"}));
}

// ---- mirror image by switch ---------------------------------------------------------------------------------------------------

TEST(SwitchMirror, AboutWhereTheAxisStandsAtTheHeadOfTheProgram) {
  Bench bench;
  bench.at(10, 0, 0).work_offset(1, {4, 0, 0});
  nc_switches_set(bench.control(), 0, 0, 1);
  const std::string text = "G0 X16. Y5.\nG91 X1.\nG90 G2 X22. Y10. R5. F100\n#100=#3007\nG51.1 X0\n#101=#3007\nG50.1\nG53 X3.\nM30";
  const Outcome run = bench.run(text);
  EXPECT_EQ(run.alarm, "");
  // X16 of G54 is 20 on the machine, 10 beyond where the axis stood: it goes to 0.
  EXPECT_EQ(run.path(), (Path{"rapid 0 5 0", "rapid -1 5 0", "ccw -6 10 0 c-6,5 F100", "rapid 3 10 0"}));
  EXPECT_EQ(run.var(100), 1);
  nc_switches_set(bench.control(), 0, 0, 0);  // the next program goes without
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 X16.\nM30").path(), (Path{"rapid 20 0 0"}));
}

// 14.5, 14.12: what is read behind G92 and G92.1 is where the axis stands: the centre is there from then on.
TEST(SwitchMirror, CoordinatesAreSetWithoutMovingTheMachine) {
  Bench bench;
  nc_switches_set(bench.control(), 0, 0, 1);
  EXPECT_EQ(bench.run("G90 G0 X20.\nG92 X0\nX0\nX5.\nG91 X5.\nM30").path(), (Path{"rapid -20 0 0", "rapid -25 0 0", "rapid -30 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G92.1 X0\nG90 G0 X20.\nG92 X20. Y3.\nX20.\nX21.\nM30").path(), (Path{"rapid -20 0 0", "rapid -21 0 0"}));
  Bench other;
  other.param("1267/bit0", "1");
  nc_switches_set(other.control(), 0, 0, 1);
  EXPECT_EQ(other.run("G90 G0 X20.\nG92.1 X0\nX-20.\nX-15.\nM30").path(), (Path{"rapid -20 0 0", "rapid -25 0 0"}));
}

TEST(SwitchMirror, ByParameter) {  // #8211
  Bench bench;
  bench.param("8211", "1", 'Y').at(0, 10, 0);
  const Outcome run = bench.run("G0 Y16.\n#100=#3007\nG10 L70\nN8211 P2 R0\nG11\nY17.\nM30");
  EXPECT_EQ(run.path().at(0), "rapid 0 4 0");
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(bench.param("8211", "0", 'Y').at(0, 10, 0).run("G0 Y16.\nM30").path(), (Path{"rapid 0 16 0"}));
  nc_switches_set(bench.control(), 0, 0, 2);
  EXPECT_EQ(bench.param("8211", "1", 'Y').at(0, 10, 0).run("G0 Y16.\nM30").path(), (Path{"rapid 0 4 0"})) << "either, not one against the other";
}

TEST(SwitchMirror, WithMirrorByProgramInTheSameAxisNothingTurnsRound) {
  Bench bench;
  nc_switches_set(bench.control(), 0, 0, 1);
  EXPECT_EQ(bench.run("G51.1 X5.\nG0 X3.\nG3 X13. R5. F100\nM30").path(), (Path{"rapid -7 0 0", "ccw 3 0 0 c-2,0 F100"}));
}

TEST(SwitchMirror, CompensatesOnTheOtherSide) {
  Bench bench;
  bench.tool(1, 2);
  nc_switches_set(bench.control(), 0, 0, 1);
  EXPECT_EQ(bench.run("G1 G41 D1 X20. Y0 F100\nX20. Y30.\nX40.\nG40 X50.\nM30").path().at(1), "line -18 32 0 F100");
  nc_switches_set(bench.control(), 0, 0, 0);
  EXPECT_EQ(bench.at(0, 0, 0).run("G1 G41 D1 X20. Y0 F100\nX20. Y30.\nX40.\nG40 X50.\nM30").path().at(1), "line 18 32 0 F100");
}

// ---- all of them ----------------------------------------------------------------------------------------------------------------

/// A program with any of scaling, rotation, mirror by program and by switch, and rotation by parameter; and its end points by the formulas of the
/// manual, applied one after the other.
class Maps {
 public:
  explicit Maps(uint32_t seed) : random_(seed) {
    for (double& value : zero) value = number(50);
    for (double& value : stood) value = number(50);
    for (double& value : mirror_) value = number(20);
    for (double& value : scale_) value = number(20);
    for (double& value : rotate_) value = number(20);
    for (double& value : turn_) value = number(100);
    factor = coin() ? 0.25 + 0.125 * static_cast<double>(random_() % 30) : 1;
    scales = factor != 1;
    angle_ = coin() ? number(180) : 0;
    turn_angle_ = coin() ? number(180) : 0;
    for (bool& on : mirrored_) on = coin();
    for (unsigned i = 0; i < 3; ++i) switched |= coin() ? 1u << i : 0u;
  }
  double number(double most) { return std::round(std::uniform_real_distribution<double>(-most, most)(random_) * 1000) / 1000; }

  std::string head() const {
    std::string text = "G90 G17\n";
    if (turn_angle_ != 0) text += "G10 K" + word(turn_angle_) + "\n";
    if (scales) text += "G51 X" + word(scale_[0]) + " Y" + word(scale_[1]) + " Z" + word(scale_[2]) + " P" + word(factor) + "\n";
    if (angle_ != 0) text += "G68 X" + word(rotate_[0]) + " Y" + word(rotate_[1]) + " R" + word(angle_) + "\n";
    for (unsigned i = 0; i < 3; ++i)
      if (mirrored_[i]) text += std::string("G51.1 ") + "XYZ"[i] + word(mirror_[i]) + "\n";
    return text;
  }
  void set_up(Bench& bench) const {
    bench.at(stood[0], stood[1], stood[2]).work_offset(1, {zero[0], zero[1], zero[2]});
    bench.param("8623", word(turn_[0]).c_str()).param("8624", word(turn_[1]).c_str());
    nc_switches_set(bench.control(), 0, 0, static_cast<uint8_t>(switched));
  }
  static std::string word(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
  }
  /// The machine coordinates of a programmed point.
  std::array<double, 3> machine(std::array<double, 3> p) const {
    for (unsigned i = 0; scales && i < 3; ++i) p[i] = scale_[i] + factor * (p[i] - scale_[i]);
    turn(p, angle_, rotate_[0], rotate_[1]);
    for (unsigned i = 0; i < 3; ++i) {
      if (mirrored_[i]) p[i] = 2 * mirror_[i] - p[i];
      if ((switched >> i & 1) != 0) p[i] = 2 * (stood[i] - zero[i]) - p[i];
    }
    turn(p, turn_angle_, turn_[0] - zero[0], turn_[1] - zero[1]);
    for (unsigned i = 0; i < 3; ++i) p[i] += zero[i];
    return p;
  }
  bool turned_over() const { return (mirrored_[0] != ((switched & 1) != 0)) != (mirrored_[1] != ((switched & 2) != 0)); }

  double zero[3], stood[3], factor = 1;
  bool scales = false;
  unsigned switched = 0;

 private:
  bool coin() { return random_() % 2 == 0; }
  static void turn(std::array<double, 3>& p, double deg, double h, double v) {
    const double c = std::cos(deg * std::numbers::pi / 180), s = std::sin(deg * std::numbers::pi / 180), x = p[0] - h, y = p[1] - v;
    p[0] = h + c * x - s * y;
    p[1] = v + s * x + c * y;
  }
  std::mt19937 random_;
  double mirror_[3], scale_[3], rotate_[2], turn_[2], angle_ = 0, turn_angle_ = 0;
  bool mirrored_[3];
};

TEST(EveryMap, OneBehindTheOtherAsTheManualHasThem) {  // 13.19, 13.20, 13.6, 13.21
  for (uint32_t seed = 0; seed < 400; ++seed) {
    Maps maps(seed);
    Bench bench;
    maps.set_up(bench);
    const double x = maps.number(100), y = maps.number(100), z = maps.number(30), dx = maps.number(50), i = maps.number(20), j = 3 + std::fabs(maps.number(20));
    const auto word = Maps::word;
    const std::string text = maps.head() + "G1 X" + word(x) + " Y" + word(y) + " Z" + word(z) + " F100\nG91 X" + word(dx) + "\nG3 I" + word(i) + " J" + word(j) +
                             "\nG90 G1 Y" + word(y + 1) + "\nM30";
    const Outcome run = bench.run(text);
    ASSERT_EQ(run.alarm, "") << text;
    const std::vector<nc_move> moves = run.moves();
    ASSERT_EQ(moves.size(), 4u) << text;
    const std::array<double, 3> ends[] = {{x, y, z}, {x + dx, y, z}, {x + dx, y, z}, {x + dx, y + 1, z}};
    for (unsigned n = 0; n < 4; ++n) {
      const std::array<double, 3> wanted = maps.machine(ends[n]);
      for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(moves[n].machine.v[a], wanted[a], 1e-9) << text << " move " << n << " axis " << a;
    }
    const std::array<double, 3> center = maps.machine({x + dx + i, y + j, z});
    EXPECT_NEAR(moves[2].machine_center[0], center[0], 1e-9) << text;
    EXPECT_NEAR(moves[2].machine_center[1], center[1], 1e-9) << text;
    EXPECT_NEAR(moves[2].radius, maps.factor * std::hypot(i, j), 1e-9) << text;
    EXPECT_EQ(moves[2].ccw, !maps.turned_over()) << text;
  }
}

TEST(EveryMap, CompensatesOnTheSideThatTheMirrorsLeave) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    Maps maps(seed);
    Bench bench;
    maps.set_up(bench);
    bench.tool(1, 1);
    const Outcome run = bench.run(maps.head() + "G0 X0 Y0 Z0\nG1 G41 D1 X10. F100\nX40.\nY30.\nG40 X0\nM30");
    ASSERT_EQ(run.alarm, "") << maps.head();
    // The left side of the programmed X40. is its Y+, wherever the maps lead that. The end is a tool radius away from the corner, an inner one.
    const std::vector<nc_move> moves = run.moves();
    ASSERT_GE(moves.size(), 4u) << maps.head();
    const double r = 1 / maps.factor;  // the radius is not scaled
    const std::array<double, 3> wanted = maps.machine({40 - r, r, 0});
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(moves[2].machine.v[a], wanted[a], 1e-9) << maps.head() << " axis " << a;
  }
}

TEST(EveryMap, QuartersAreExact) {
  const auto exact = [](const std::string& text, double x, double y) {
    const std::vector<nc_move> moves = m700(text + "\nM30").moves();
    ASSERT_FALSE(moves.empty()) << text;
    EXPECT_EQ(moves.back().machine.v[0], x) << text;
    EXPECT_EQ(moves.back().machine.v[1], y) << text;
  };
  exact("G68 X0 Y0 R90.\nG0 X12.345 Y6.789", -6.789, 12.345);
  exact("G68 X0 Y0 R180.\nG0 X12.345 Y6.789", -12.345, -6.789);
  exact("G68 X0 Y0 R-90.\nG0 X12.345 Y6.789", 6.789, -12.345);
  exact("G10 K270.\nG0 X12.345 Y6.789", 6.789, -12.345);
  exact("G10 K90.\nG68 X0 Y0 R-90.\nG0 X12.345 Y6.789", 12.345, 6.789);
}

}  // namespace
}  // namespace nc::test
