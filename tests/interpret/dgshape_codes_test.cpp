// SPDX-License-Identifier: Apache-2.0
// DGSHAPE 2-7: every code of the list, one row for each. What a row says stands in the section of the code: what a program with it does, and which words and
// neighbours it cannot have, with the alarm on the line of the block.
#include "support/code_rows.hpp"

namespace nc::test {
namespace {

Outcome run_of(const std::string& text) {
  Bench bench(NC_DIALECT_DGSHAPE, axes("XYZa"));
  bench.tool(1, 3, NC_TOOL_RADIUS).tool(1, 10, NC_TOOL_LENGTH);
  return bench.run("%\nG21G90\n" + text + "\nM30");
}

const CodeRow kRows[] = {
    // F does not act, and the axes go straight together.
    {"G00", "G00X1.Y2.Z3.A4.F5.\nX-1.", {"rapid 1 2 3 4", "rapid -1 2 3 4"}, "M30", {{"G00B1.", "NC-ADDRESS"}, {"G00X", "NC-FORMAT"}, {"G00X1.2.", "NC-FORMAT"}, {"G00X100000.", "NC-RANGE"}}},
    {"G01", "G01X1.F100.\nY2.\nF50.\nX3.", {"line 1 0 0 0 F100", "line 1 2 0 0 F100", "line 3 2 0 0 F50"}, "M30", {{"G01X1.", "NC-FEED"}, {"G01X1.F0", "NC-FEED"}, {"G01X1.F-5.", "NC-RANGE"}}},
    {"G02", "G02X10.Y10.I10.F100.\nG02X20.Y0R10.\nG02I-5.", {"cw 10 10 0 0 c10,0 F100", "cw 20 0 0 0 c10,0 F100", "cw 20 0 0 0 c15,0 F100"}, "M30",
     {{"F100.\nG02X10.A5.I5.", "NC-AXIS"}, {"F100.\nG02X10.", "NC-ARC"}, {"F100.\nG02X10.Y1.I5.", "NC-ARC"}, {"F100.\nG02X10.R4.", "NC-ARC"},
      {"G02X10.I5.", "NC-FEED"}}},
    {"G03", "G03X10.Y10.J10.F100.\nG03X0Y0R-10.\nG03X0Y0Z4.I5.", {"ccw 10 10 0 0 c0,10 F100", "ccw 0 0 0 0 c0,10 F100", "ccw 0 0 4 0 c5,0 F100"}, "M30", {{"F100.\nG03X10.A5.I5.", "NC-AXIS"}, {"F100.\nG03X10.", "NC-ARC"}}},
    {"G04", "G04P1500\nG04X2.5\nG04X500", {}, "M30",
     {{"G04", "NC-WORDS"}, {"G04P500X1.", "NC-ALONE"}, {"G04P500G00X1.", "NC-ALONE"}, {"G04P500M03", "NC-ALONE"}, {"G04P0.5", "NC-FORMAT"}, {"G04P3600001", "NC-RANGE"}, {"G04X3601.", "NC-RANGE"}, {"G04X-1.", "NC-RANGE"}}},
    {"G10", "G10L2P1X5.\nG10L2P0Y1.\nG91\nG10L2P1X6.\nG90\nG00X0Y0\nG10P2R4.\nG41D2X0Y10.\nX0Y20.", {"rapid 6 1 0 0", "rapid 2 11 0 0", "rapid 2 21 0 0"}, "M30",
     {{"G10L3P1X1.", "NC-DATA"}, {"G10L2P7X1.", "NC-RANGE"}, {"G10L2X1.", "NC-WORDS"}, {"G10P1", "NC-WORDS"}, {"G10P0R1.", "NC-DATA"}, {"G41D1\nX5.\nG10P1R1.", "NC-OFFSET-CODE"}, {"G10L2P1.X1.", "NC-FORMAT"}}},
    {"G17", "G17G02X10.I5.F100.", {"cw 10 0 0 0 c5,0 F100"}, "M30", {{"G17.5", "NC-NO-SUCH-CODE"}}},
    {"G18", "G18G02X10.I5.F100.", {"cw 10 0 0 0 c0,5 F100"}, "M30", {{"G41D1\nX5.\nG18", "NC-OFFSET-CODE"}, {"M03S1000\nG18\nG81Z-1.R1.F100.", "NC-PLANE"}, {"G18\nG41D1", "NC-PLANE"}}},
    {"G19", "G19G03Y10.J5.F100.", {"ccw 0 10 0 0 c5,0 F100"}, "M30", {{"G41D1\nX5.\nG19", "NC-OFFSET-CODE"}, {"M03S1000\nG19\nG81Z-1.R1.F100.", "NC-PLANE"}}},
    {"G20", "G20\nG00X1.\nX5000\nG01Y1.F2.", {"rapid 25.4 0 0 0", "rapid 12.7 0 0 0", "line 12.7 25.4 0 0 F50.8"}, "M30", {{"G20\nX10000.", "NC-RANGE"}}},
    {"G21", "G20\nG21\nG00X1.\nX5000", {"rapid 1 0 0 0", "rapid 5 0 0 0"}, "M30", {}},
    // The point of an axis is kept for every later G28.
    {"G28", "G00X5.Y5.Z5.\nG28X10.\nG00X5.\nG28Y20.", {"rapid 5 5 5 0", "rapid 10 5 5 0", "rapid 0 5 5 0", "rapid 5 5 5 0", "rapid 10 20 5 0", "rapid 0 0 5 0"}, "M30",
     {{"G28A0", "NC-AXIS"}, {"G28X", "NC-FORMAT"}, {"G41D1\nX5.\nG28X0", "NC-OFFSET-CODE"}}},
    {"G39", "G42D1\nG01X5.F100.\nX10.\nG39X10.Y10.\nX10.Y10.", {"line 5 -3 0 0 F100", "line 10 -3 0 0 F100", "ccw 13 0 0 0 c10,0 F100", "line 13 10 0 0 F100"}, "M30",
     {{"G39X1.", "NC-OFFSET-CODE"}, {"G41D1\nG01X10.F100.\nX20.\nG39X20.Y10.", "NC-OFFSET-PATH"}, {"G42D1\nG39X10.", "NC-OFFSET-CODE"}, {"G42D1\nG01X10.F100.\nG39Z1.", "NC-AXIS"}, {"G42D1\nG01X10.F100.\nG39", "NC-WORDS"}}},
    {"G40", "G41D1X0Y10.\nX0Y20.\nG40X5.Y30.", {"rapid -3 10 0 0", "rapid -3 20 0 0", "rapid 5 30 0 0"}, "M30", {{"G41D1\nX5.F100.\nG40G02X10.I2.5", "NC-OFFSET-START"}}},
    {"G41", "G41D1X0Y10.\nX0Y20.\nZ5.", {"rapid -3 10 0 0", "rapid -3 20 0 0", "rapid -3 20 5 0"}, "M30",
     {{"F100.\nG41D1G02X10.I5.", "NC-OFFSET-START"}, {"G41D201X1.", "NC-OFFSET-DATA"}, {"G41X1.", "NC-OFFSET-DATA"}, {"G41D1\nX5.\nG54", "NC-OFFSET-CODE"}, {"G41D1\nX5.\nG92X0", "NC-OFFSET-CODE"},
      {"M03S1000F100.\nG41D1\nX5.\nG81Z-1.R1.", "NC-OFFSET-CODE"}, {"G41D1\nX5.\nG80", "NC-OFFSET-CODE"}, {"G41D1\nX5.\nG50", "NC-OFFSET-CODE"}, {"G41D1\nX5.\nG51P2.", "NC-OFFSET-CODE"},
      {"G41D1\nX5.\nG42", "NC-OFFSET-CODE"}, {"F100.\nG41D1\nX10.\nG03X12.Y2.J2.", "NC-OFFSET-PATH"}}},
    {"G42", "G42D1X0Y10.\nX0Y20.", {"rapid 3 10 0 0", "rapid 3 20 0 0"}, "M30", {{"F100.\nG42D1G03X10.I5.", "NC-OFFSET-START"}, {"G42D1\nX5.\nG41", "NC-OFFSET-CODE"}}},
    {"G43", "G43H1\nG91G00Z-1.", {"rapid 0 0 10 0", "rapid 0 0 9 0"}, "M30", {{"G43Z1.", "NC-OFFSET-DATA"}, {"G43H201Z1.", "NC-OFFSET-DATA"}, {"G43H1.Z1.", "NC-FORMAT"}, {"G44H1Z1.", "NC-NO-SUCH-CODE"}}},
    {"G49", "G43H1Z1.\nG49", {"rapid 0 0 11 0", "rapid 0 0 1 0"}, "M30", {}},
    {"G50", "G51X0Y0Z0P2.\nX1.\nG50\nX3.", {"rapid 2 0 0 0", "rapid 3 0 0 0"}, "M30", {}},
    // Out of range is clamped; without a point the place of the tool is it.
    {"G51", "X2.\nG51P3.\nX4.A5.\nG51X0Y0Z0P5000.\nX.01\nG51X0Y0Z0P0.0001\nX1000.", {"rapid 2 0 0 0", "rapid 8 0 0 5", "rapid 9.99999 0 0 5", "rapid 1 0 0 5"}, "M30",
     {{"G51X0Y0", "NC-WORDS"}, {"G51A1.P2.", "NC-AXIS"}}},
    {"G53", "G54\nG10L2P1X5.\nG53X1.A2.\nX1.", {"rapid 1 0 0 2", "rapid 6 0 0 2"}, "M30", {{"G91\nG53X1.", "NC-INCREMENTAL"}}},
    {"G54", "G10L2P1X1.\nG54G00X0", {"rapid 1 0 0 0"}, "M30", {{"G54.1P1", "NC-NO-SUCH-CODE"}}},
    {"G55", "G10L2P2X2.\nG55G00X0", {"rapid 2 0 0 0"}, "M30", {}},
    {"G56", "G10L2P3X3.\nG56G00X0", {"rapid 3 0 0 0"}, "M30", {}},
    {"G57", "G10L2P4X4.\nG57G00X0", {"rapid 4 0 0 0"}, "M30", {}},
    {"G58", "G10L2P5X5.\nG58G00X0", {"rapid 5 0 0 0"}, "M30", {}},
    {"G59", "G10L2P6X6.\nG59G00X0", {"rapid 6 0 0 0"}, "M30", {{"G59.1", "NC-NO-SUCH-CODE"}}},
    {"G80", "M03S1000F100.\nG99G81Z-1.R1.\nG80\nX5.", {"rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 1 0", "rapid 5 0 1 0"}, "S1000 M3 M30", {}},
    {"G81", "M03S1000F100.\nZ5.\nG98G81X1.Z-1.R1.\nG91X2.K2\nG80", {"rapid 0 0 5 0", "rapid 1 0 5 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 5 0", "rapid 3 0 5 0", "rapid 3 0 1 0",
      "line 3 0 -1 0 F100", "rapid 3 0 5 0", "rapid 5 0 5 0", "rapid 5 0 1 0", "line 5 0 -1 0 F100", "rapid 5 0 5 0"}, "S1000 M3 M30",
     {{"F100.\nG81X1.Z-1.R1.", "NC-SPINDLE"}, {"M03S1000\nF100.\nG81X1.A1.Z-1.R1.", "NC-AXIS"}, {"M03S1000\nF100.\nG81X1.Z-1.R1.K10000", "NC-RANGE"}, {"M03S1000\nF100.\nG81X1.Z-1.R1.K1.", "NC-FORMAT"},
      {"M03S1000\nG81X1.Z-1.R1.", "NC-FEED"}}},
    {"G82", "M03S1000F100.\nG99G82X1.Z-1.R1.P500", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "S1000 M3 M30",
     {{"F100.\nG82X1.Z-1.R1.", "NC-SPINDLE"}, {"M03S1000F100.\nG82X1.Z-1.R1.P0.5", "NC-FORMAT"}, {"M03S1000F100.\nG82X1.Z-1.R1.P3600001", "NC-RANGE"}}},
    // Up to R between two cuts of Q, and to 1 mm above the last one.
    {"G83", "M03S1000F100.\nG99G83X1.Z-5.R1.Q4.", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -3 0 F100", "rapid 1 0 1 0", "rapid 1 0 -2 0", "line 1 0 -5 0 F100", "rapid 1 0 1 0"}, "S1000 M3 M30",
     {{"F100.\nG83X1.Z-1.R1.Q1.", "NC-SPINDLE"}, {"M03S1000F100.\nG83X1.Z-1.R1.", "NC-WORDS"}, {"M03S1000F100.\nG83X1.Z-1.R1.Q0", "NC-WORDS"}}},
    {"G85", "M03S1000F100.\nG99G85X1.Z-1.R1.", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "S1000 M3 M30", {{"F100.\nG85X1.Z-1.R1.", "NC-SPINDLE"}}},
    {"G86", "M03S1000F100.\nG99G86X1.Z-1.R1.", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "S1000 M3 M5 M3 M30", {{"F100.\nG86X1.Z-1.R1.", "NC-SPINDLE"}}},
    {"G89", "M03S1000F100.\nG99G89X1.Z-1.R1.P500", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "S1000 M3 M30", {{"F100.\nG89X1.Z-1.R1.", "NC-SPINDLE"}}},
    {"G90", "G91X1.\nG90X3.\nG91G90X2.", {"rapid 1 0 0 0", "rapid 3 0 0 0", "rapid 2 0 0 0"}, "M30", {}},
    {"G91", "G91X1.\nX1.\nG90G91X1.", {"rapid 1 0 0 0", "rapid 2 0 0 0", "rapid 3 0 0 0"}, "M30", {}},
    // The shift is that of all six systems.
    {"G92", "X5.\nG92X0\nX1.\nG55X0", {"rapid 5 0 0 0", "rapid 6 0 0 0", "rapid 5 0 0 0"}, "M30", {{"G41D1\nX5.\nG92X1.", "NC-OFFSET-CODE"}}},
    {"G98", "M03S1000F100.\nZ5.\nG98G81Z-1.R1.", {"rapid 0 0 5 0", "rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 5 0"}, "S1000 M3 M30", {}},
    {"G99", "M03S1000F100.\nZ5.\nG99G81Z-1.R1.", {"rapid 0 0 5 0", "rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 1 0"}, "S1000 M3 M30", {}},
    // 2-3: M
    {"M00", "M00\nX1.", {"rapid 1 0 0 0"}, "M0 M30", {{"M00X1.", "NC-ALONE"}}},
    {"M01", "M01\nX1.", {"rapid 1 0 0 0"}, "M30", {{"G00M01", "NC-ALONE"}}},
    {"M02", "X1.\nM02", {"rapid 1 0 0 0"}, "M2", {{"X1.M02", "NC-ALONE"}}},
    {"M30", "X1.", {"rapid 1 0 0 0"}, "M30", {{"M30M03", "NC-ALONE"}, {"M30.", "NC-FORMAT"}}},
    {"M03", "S1000M03\nM03", {}, "S1000 M3 M30", {{"M04", "NC-NO-SUCH-CODE"}, {"M3.5", "NC-FORMAT"}}},
    {"M05", "M05\nM03S1000\nM05\nM05", {}, "S1000 M3 M5 M30", {}},
    {"M06", "M06T2\nM06T2\nM06T3\nM06T0\nM06T0\nM06T3", {}, "T2 M6 T3 M6 T0 M6 T3 M6 M30", {{"M06", "NC-TOOL"}, {"T2", "NC-TOOL"}, {"M06T1T2", "NC-TOOL"}, {"M06M06T1", "NC-TOOL"}}},
    {"M12", "M12", {}, "M12 M30", {{"M11", "NC-NO-SUCH-CODE"}, {"M08", "NC-NO-SUCH-CODE"}}},
    {"M13", "M13", {}, "M13 M30", {}},
    {"M14", "M14", {}, "M14 M30", {}},
    {"M15", "M15", {}, "M15 M30", {}},
    {"M16", "M16", {}, "M16 M30", {}},
    {"M17", "M17", {}, "M17 M30", {{"M18", "NC-NO-SUCH-CODE"}, {"M98P1", "NC-NO-SUCH-CODE"}, {"M99", "NC-NO-SUCH-CODE"}}},
};

TEST(DgshapeCodes, DoWhatTheirSectionSays) {
  expect_done(kRows, run_of);
  EXPECT_EQ(run_of("G04P1500\nG04X2.5\nG04X500").dwells(), (std::vector<double>{1.5, 2.5, 0.5}));
  EXPECT_EQ(run_of("M03S1000F100.\nG82X1.Z-1.R1.P500\nG89X1.Z-1.R1.P1500").dwells(), (std::vector<double>{0.5, 1.5}));
}

TEST(DgshapeCodes, RefuseWhatTheyCannotHave) { expect_refused(kRows, run_of, 2); }

TEST(DgshapeCodes, AreThoseOfTheTable) { expect_codes_of(NC_DIALECT_DGSHAPE, kRows); }

}  // namespace
}  // namespace nc::test
