// SPDX-License-Identifier: Apache-2.0
// The codes of RS-274/NGC and LinuxCNC that the iso family has, one row for each: what a program with the code does by its document, and which words and
// neighbours it cannot have, with the alarm on the line of the block. The codes that are not built are all alarms (Iso.WhatIsNotBuiltSaysSo).
#include "support/code_rows.hpp"

namespace nc::test {
namespace {

Outcome run_of(const std::string& text) {
  Bench bench(NC_DIALECT_ISO, axes("XYZa"));
  bench.tool(1, 3, NC_TOOL_RADIUS).tool(1, 10, NC_TOOL_LENGTH);
  return bench.run(text + "\nM2");
}

const CodeRow kRows[] = {
    {"G00", "G0 X1 Y.5 Z-1 A90\nx0", {"rapid 1 0.5 -1 90", "rapid 0 0.5 -1 90"}, "M2", {{"G0 X", "NC-FORMAT"}, {"G0 X1 X2", "NC-FORMAT"}, {"G0 G1 X1", "NC-FORMAT"}, {"G0 U1", "NC-AXIS"}, {"G0 X1 E5", "NC-ADDRESS"}}},
    {"G01", "G1 X1 F100\nY2\nF50 X3", {"line 1 0 0 0 F100", "line 1 2 0 0 F100", "line 3 2 0 0 F50"}, "M2", {{"G1 X1", "NC-FEED"}, {"G1 X1 F-1", "NC-RANGE"}}},
    {"G02", "F100\nG2 X10 Y10 I10\nG2 X20 Y0 R10\nG2 I-5 P2", {"cw 10 10 0 0 c10,0 F100", "cw 20 0 0 0 c10,0 F100", "cw 20 0 0 0 c15,0 P1 F100"}, "M2",
     {{"F100\nG2 X10 I4", "NC-ARC"}, {"F100\nG2 X10 R4", "NC-ARC"}, {"F100\nG2 X10", "NC-ARC"}, {"F100\nG2 X0 Y0 R5", "NC-ARC"}, {"F100\nG2 I5 P0", "NC-RANGE"}, {"F100\nG2 X10 R5 I400 J4", "NC-FORMAT"}, {"G2 X10 I5", "NC-FEED"}}},
    {"G03", "F100\nG3 X10 Y10 J10 Z4", {"ccw 10 10 4 0 c0,10 F100"}, "M2", {{"F100\nG3 X10 J4", "NC-ARC"}}},
    {"G04", "G4 P1.5", {}, "M2", {{"G4", "NC-WORDS"}, {"G4 P-1", "NC-RANGE"}, {"G4 P1 X1", "NC-ALONE"}}},
    {"G10", "G10 L2 P2 X5\nG55 G0 X0\nG10 L20 P0 X1\nX3", {"rapid 5 0 0 0", "rapid 7 0 0 0"}, "M2", {{"G10 L2 X1", "NC-WORDS"}, {"G10 L2 P10 X1", "NC-RANGE"}, {"G10 L1 P1 Z1", "NC-NOT-BUILT"}, {"G10 L2 P1 R5", "NC-NOT-BUILT"}, {"G10 L7 P1", "NC-DATA"}}},
    {"G17", "G18\nG17 G2 X10 I5 F100", {"cw 10 0 0 0 c5,0 F100"}, "M2", {{"G17.1", "NC-NO-SUCH-CODE"}}},
    {"G18", "G18 G2 X10 I5 F100", {"cw 10 0 0 0 c0,5 F100"}, "M2", {{"G41 D1\nG0 X5\nG18", "NC-OFFSET-CODE"}}},
    {"G19", "G19 G3 Y10 J5 F100", {"ccw 0 10 0 0 c5,0 F100"}, "M2", {{"G41 D1\nG0 X5\nG19", "NC-OFFSET-CODE"}}},
    {"G20", "G20 G0 X1\nG1 X2 F2", {"rapid 25.4 0 0 0", "line 50.8 0 0 0 F50.8"}, "M2", {{"G20 G21", "NC-FORMAT"}}},
    {"G21", "G20\nG21 G0 X1", {"rapid 1 0 0 0"}, "M2", {}},
    {"G28", "G0 X5 Y5\nG28 X10", {"rapid 5 5 0 0", "rapid 10 5 0 0", "rapid 0 5 0 0"}, "M2", {{"G41 D1\nG0 X5\nG28 X0", "NC-OFFSET-CODE"}}},
    {"G30", "G0 X5\nG30 X10", {"rapid 5 0 0 0", "rapid 10 0 0 0", "rapid 0 0 0 0"}, "M2", {{"G41 D1\nG0 X5\nG30 X0", "NC-OFFSET-CODE"}}},
    {"G33", "S100 M3\nG33 Z-5 K1.5", {"thread 0 0 -5 0 F0"}, "S100 M3 M2", {{"S100 M3\nG33 Z-5", "NC-WORDS"}, {"S100 M3\nG33 Z-5 K0", "NC-THREAD"}}},
    {"G38.2", "F1", {}, "M2", {{"F100\nG38.2 Z-5", "NC-PROBE"}, {"G38.2 Z-5", "NC-FEED"}, {"F100\nG38.2 Z0", "NC-PROBE"}, {"F100\nG41 D1\nG0 X5\nG38.2 X9", "NC-OFFSET-CODE"}, {"G93 G38.2 Z-5 F1", "NC-FEED-MODE"}}},
    {"G38.3", "G38.3 Z-5 F100", {"skip 0 0 -5 0 F100"}, "M2", {{"G38.3 Z-5", "NC-FEED"}, {"F100\nG38.3 Z0", "NC-PROBE"}}},
    {"G38.4", "F1", {}, "M2", {{"F100\nG38.4 Z5", "NC-PROBE"}, {"G38.4 Z5", "NC-FEED"}}},
    {"G38.5", "G38.5 Z5 F100", {"skip 0 0 5 0 F100"}, "M2", {{"G38.5 Z5", "NC-FEED"}, {"F100\nG38.5 Z0", "NC-PROBE"}, {"G38.6 Z5", "NC-NO-SUCH-CODE"}}},
    {"G40", "F100\nG41 D1 G1 X0 Y10\nX0 Y20\nG40 X5 Y30", {"line -3 10 0 0 F100", "line -3 20 0 0 F100", "line 5 30 0 0 F100"}, "M2", {{"F100\nG41 D1 G1 X5\nX9\nG40 G2 X10 I.5", "NC-OFFSET-START"}}},
    {"G41", "F100\nG41 D1\nG1 X0 Y10\nX0 Y20", {"line -3 10 0 0 F100", "line -3 20 0 0 F100"}, "M2",
     {{"G41 D201", "NC-OFFSET-DATA"}, {"F100\nG41 D1 G1 X5\nG42", "NC-OFFSET-CODE"}, {"F100\nG41 D1 G1 X5\nG55", "NC-OFFSET-CODE"}, {"F100\nG41 D1 G1 X5\nG92 X0", "NC-OFFSET-CODE"}, {"F100\nG41 D1 G1 X5\nX9\nG81 Z-1 R1", "NC-OFFSET-CODE"}}},
    {"G42", "F100\nG42 D1\nG1 X0 Y10\nX0 Y20", {"line 3 10 0 0 F100", "line 3 20 0 0 F100"}, "M2", {{"F100\nG42 D1 G1 X5\nG41", "NC-OFFSET-CODE"}}},
    {"G43", "G43 H1\nG0 Z1", {"rapid 0 0 11 0"}, "M2", {{"G43 H201", "NC-OFFSET-DATA"}}},
    {"G43.1", "G43.1 Z4\nG0 Z1", {"rapid 0 0 5 0"}, "M2", {{"G43.1", "NC-WORDS"}, {"G43.1 X1", "NC-AXIS"}}},
    {"G49", "G43 H1\nG49\nG0 Z1", {"rapid 0 0 1 0"}, "M2", {}},
    {"G53", "G92 X5\nG53 G0 X1\nX1", {"rapid 1 0 0 0", "rapid -4 0 0 0"}, "M2", {{"G91 G53 G0 X1", "NC-INCREMENTAL"}}},
    {"G54", "G10 L2 P1 X1\nG54 G0 X0", {"rapid 1 0 0 0"}, "M2", {{"G54.1 P1", "NC-NO-SUCH-CODE"}}},
    {"G55", "G10 L2 P2 X2\nG55 G0 X0", {"rapid 2 0 0 0"}, "M2", {}},
    {"G56", "G10 L2 P3 X3\nG56 G0 X0", {"rapid 3 0 0 0"}, "M2", {}},
    {"G57", "G10 L2 P4 X4\nG57 G0 X0", {"rapid 4 0 0 0"}, "M2", {}},
    {"G58", "G10 L2 P5 X5\nG58 G0 X0", {"rapid 5 0 0 0"}, "M2", {}},
    {"G59", "G10 L2 P6 X6\nG59 G0 X0", {"rapid 6 0 0 0"}, "M2", {}},
    {"G59.1", "G10 L2 P7 X7\nG59.1 G0 X0", {"rapid 7 0 0 0"}, "M2", {}},
    {"G59.2", "G10 L2 P8 X8\nG59.2 G0 X0", {"rapid 8 0 0 0"}, "M2", {}},
    {"G59.3", "G10 L2 P9 X9\nG59.3 G0 X0", {"rapid 9 0 0 0"}, "M2", {{"G59.4", "NC-NO-SUCH-CODE"}}},
    {"G61", "G61\nG1 X1 F100\nX2", {"line 1 0 0 0 F100", "line 2 0 0 0 F100"}, "M2", {}},
    {"G61.1", "G61.1\nG1 X1 F100\nX2", {"line 1 0 0 0 F100", "line 2 0 0 0 F100"}, "M2", {}},
    {"G64", "G64 P.01\nG1 X1 F100\nX2", {"line 1 0 0 0 F100", "line 2 0 0 0 F100"}, "M2", {}},
    {"G73", "F100\nG99 G73 X1 Z-3 R1 Q3", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -2 0 F100", "rapid 1 0 -1.746 0", "line 1 0 -3 0 F100", "rapid 1 0 1 0"}, "M2", {{"F100\nG73 X1 Z-3 R1", "NC-WORDS"}, {"F100\nG73 X1 Z-3 R1 Q0", "NC-WORDS"}}},
    {"G74", "S100 M4 F100\nG99 G74 X1 Z-1 R1", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "S100 M4 M3 M4 M2", {{"S100 M3 F100\nG74 X1 Z-1 R1", "NC-SPINDLE"}}},
    {"G80", "F100\nG99 G81 X1 Z-1 R1\nG80\nG0 X5", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0", "rapid 5 0 1 0"}, "M2", {}},
    {"G81", "F100\nG99 G81 X1 Z-1 R1\nG91 X2 Z-2 R0 L2", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0", "rapid 3 0 1 0", "rapid 3 0 0 0", "line 3 0 -2 0 F100", "rapid 3 0 0 0", "rapid 5 0 0 0",
      "line 5 0 -2 0 F100", "rapid 5 0 0 0"}, "M2",
     {{"F100\nG81 X1 Z-1", "NC-WORDS"}, {"F100\nG81 X1 R1", "NC-WORDS"}, {"F100\nG81 X1 Z2 R1", "NC-RANGE"}, {"F100\nG0 G81 X1 Z-1 R1", "NC-FORMAT"}, {"F100\nG81 X1 A1 Z-1 R1", "NC-AXIS"}, {"G81 X1 Z-1 R1", "NC-FEED"}}},
    {"G82", "F100\nG99 G82 X1 Z-1 R1 P.5", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "M2", {{"F100\nG82 X1 Z-1 R1 P-1", "NC-RANGE"}}},
    {"G83", "F100\nG99 G83 X1 Z-3 R1 Q3", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -2 0 F100", "rapid 1 0 1 0", "rapid 1 0 -1.746 0", "line 1 0 -3 0 F100", "rapid 1 0 1 0"}, "M2", {{"F100\nG83 X1 Z-3 R1", "NC-WORDS"}}},
    {"G84", "S100 M3 F100\nG99 G84 X1 Z-1 R1", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "S100 M3 M4 M3 M2", {{"F100\nG84 X1 Z-1 R1", "NC-SPINDLE"}}},
    {"G85", "F100\nG99 G85 X1 Z-1 R1", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "M2", {{"F100\nG85 X1 Z-1", "NC-WORDS"}}},
    {"G86", "S100 M3 F100\nG99 G86 X1 Z-1 R1 P.5", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "S100 M3 M5 M3 M2", {{"F100\nG86 X1 Z-1 R1", "NC-SPINDLE"}}},
    {"G87", "S100 M3", {}, "S100 M3 M2", {{"F100\nG87 X1 Z-1 R-5 I1 J0 K0", "NC-SPINDLE"}, {"S100 M3 F100\nG87 X1 Z-1 R-5 I1", "NC-WORDS"}}},
    {"G88", "S100 M3", {}, "S100 M3 M2", {{"F100\nG88 X1 Z-1 R1", "NC-SPINDLE"}}},
    {"G89", "F100\nG99 G89 X1 Z-1 R1 P.5", {"rapid 0 0 1 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "M2", {{"F100\nG89 X1 R1", "NC-WORDS"}}},
    {"G90", "G91 G0 X1\nG90 X3", {"rapid 1 0 0 0", "rapid 3 0 0 0"}, "M2", {{"G90 G91 G0 X1", "NC-FORMAT"}}},
    {"G90.1", "F100\nG90.1 G0 X10\nG2 X20 I15 J0", {"rapid 10 0 0 0", "cw 20 0 0 0 c15,0 F100"}, "M2", {}},
    {"G91", "G91 G0 X1\nX1", {"rapid 1 0 0 0", "rapid 2 0 0 0"}, "M2", {}},
    {"G91.1", "F100\nG90.1\nG91.1 G0 X10\nG2 X20 I5", {"rapid 10 0 0 0", "cw 20 0 0 0 c15,0 F100"}, "M2", {}},
    {"G92", "G0 X5\nG92 X0\nX1\nG55 X0", {"rapid 5 0 0 0", "rapid 6 0 0 0", "rapid 5 0 0 0"}, "M2", {}},
    {"G92.1", "G0 X5\nG92 X0\nG92.1\nX1", {"rapid 5 0 0 0", "rapid 1 0 0 0"}, "M2", {}},
    {"G92.2", "G0 X5\nG92 X0\nG92.2\nX1", {"rapid 5 0 0 0", "rapid 1 0 0 0"}, "M2", {}},
    {"G92.3", "G0 X5\nG92 X0\nG92.2\nG92.3\nX1", {"rapid 5 0 0 0", "rapid 6 0 0 0"}, "M2", {}},
    {"G93", "G93 G1 X10 F2", {"line 10 0 0 0 F20"}, "M2", {{"G93 F1\nG1 X10", "NC-FEED"}}},
    {"G94", "G93\nG94 G1 X10 F20", {"line 10 0 0 0 F20"}, "M2", {{"G93 G1 X10 F2\nG94\nX20", "NC-FEED"}}},
    {"G95", "S100 M3\nG95 G1 X10 F.5", {"line 10 0 0 0 F0"}, "S100 M3 M2", {}},
    {"G96", "G96 D2500 S100", {}, "S100 M2", {{"G96", "NC-SPINDLE"}, {"G96 D-1 S100", "NC-RANGE"}}},
    {"G97", "G97 S100", {}, "S100 M2", {}},
    {"G98", "F100\nG0 Z5\nG98 G81 Z-1 R1", {"rapid 0 0 5 0", "rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 5 0"}, "M2", {}},
    {"G99", "F100\nG0 Z5\nG99 G81 Z-1 R1", {"rapid 0 0 5 0", "rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 1 0"}, "M2", {}},
    {"M00", "M0", {}, "M0 M2", {}},
    {"M01", "M1", {}, "M2", {}},
    {"M02", "G0 X1", {"rapid 1 0 0 0"}, "M2", {}},
    {"M30", "M30", {}, "M30", {}},
    {"M48", "M48", {}, "M2", {}},
    {"M49", "M49", {}, "M2", {}},
    {"M50", "M50 P0", {}, "M2", {{"M50 P2", "NC-RANGE"}}},
    {"M51", "M51 P1", {}, "M2", {{"M51 P0", "NC-NOT-BUILT"}}},
    {"M52", "M52 P0", {}, "M2", {{"M52 P1", "NC-NOT-BUILT"}}},
    {"M53", "M53 P0", {}, "M2", {{"M53 P2", "NC-RANGE"}}},
    {"M60", "M60", {}, "M60 M2", {}},
    {"M61", "M61 Q3", {}, "M2", {{"M61", "NC-WORDS"}, {"M61 Q-1", "NC-RANGE"}, {"M61 Q1.5", "NC-RANGE"}}},
    {"M62", "M62 P1", {}, "M2", {{"M62", "NC-WORDS"}, {"M62 P32", "NC-RANGE"}}},
    {"M63", "M63 P1", {}, "M2", {{"M63", "NC-WORDS"}}},
    {"M64", "M64 P1", {}, "M2", {{"M64", "NC-WORDS"}}},
    {"M65", "M65 P1", {}, "M2", {{"M65 P-1", "NC-RANGE"}}},
    {"M66", "M66 P0", {}, "M2", {{"M66", "NC-WORDS"}, {"M66 P0 L3", "NC-RANGE"}, {"M66 E0 L3 Q1", "NC-RANGE"}, {"M66 P0 L5 Q1", "NC-RANGE"}, {"M66 P1 L0 D5", "NC-ADDRESS"}, {"F50\nM66 P1 L0 F100", "NC-ADDRESS"}}},
    {"M67", "M67 E0 Q5", {}, "M2", {{"M67 E0", "NC-WORDS"}, {"M67 E3 Q1", "NC-RANGE"}, {"M67 E0 Q1.5", "NC-RANGE"}}},
    {"M68", "M68 E0 Q5", {}, "M2", {{"M68 Q1", "NC-WORDS"}}},
    {"M03", "S5 M3", {}, "S5 M3 M2", {{"S-5 M3", "NC-RANGE"}}},
    {"M04", "S5 M4", {}, "S5 M4 M2", {}},
    {"M05", "M5", {}, "M5 M2", {}},
    {"M06", "T1 M6", {}, "T1 M6 M2", {{"T-1 M6", "NC-RANGE"}}},
    {"M19", "M19", {}, "M19 M2", {{"M19 R90", "NC-NOT-BUILT"}}},
};

TEST(IsoCodes, DoWhatTheirDocumentSays) {
  expect_done(kRows, run_of);
  EXPECT_EQ(run_of("G4 P1.5").dwells(), (std::vector<double>{1.5}));
  EXPECT_TRUE(run_of("G61\nG1 X1 F1\nX2").moves()[0].exact_stop && run_of("G61.1\nG1 X1 F1\nX2").moves()[0].exact_stop);
  EXPECT_FALSE(run_of("G61\nG64\nG1 X1 F1\nX2").moves()[0].exact_stop);
  EXPECT_EQ(run_of("S100 M3\nG95 G1 X10 F.5").moves()[0].feed_mm_rev, 0.5);
}

TEST(IsoCodes, RefuseWhatTheyCannotHave) { expect_refused(kRows, run_of, 0); }

// RS-274/NGC 3.5.19: the F of inverse time ends with it; the code that ends it may stand alone.
TEST(IsoCodes, OfFeedMayStandAloneBehindInverseTime) {
  EXPECT_EQ(run_of("G93 G1 X10 F2\nG94\nF100\nX20").path(), (Path{"line 10 0 0 0 F20", "line 20 0 0 0 F100"}));
  EXPECT_EQ(run_of("G93 G1 X10 F2\nG94\nG0 X20").alarm, "");
}

// RS-274/NGC 3.4: of each group a block has one code at most, also of group 0, whose codes are no modes. Codes of two groups are no such fault.
TEST(IsoCodes, OfOneGroupStandAlone) {
  for (const char* block : {"G4 P1 G53 G0 X1", "G28 G30 X1", "G53 G28 X1", "G92 X1 G53 G0 X2", "G92 X2 G92.1", "G10 L2 P1 X1 G4 P1", "G17 G18", "G54 G55", "G61 G64", "G43 H1 G49", "G93 G94 X1", "G98 G99"})
    EXPECT_EQ(run_of(std::string("F100\n") + block).alarm, "NC-FORMAT") << block;
  for (const FunctionRow& one : dialect(NC_DIALECT_ISO).functions)
    for (const FunctionRow& other : dialect(NC_DIALECT_ISO).functions) {
      if (one.missing != nullptr || other.missing != nullptr || one.group != other.group) continue;
      char first[12], second[12];
      g_code_text('G', one.code, first, sizeof first);
      g_code_text('G', other.code, second, sizeof second);
      const Outcome run = run_of(std::string("F100\n") + first + " " + second);
      EXPECT_EQ(run.alarm, "NC-FORMAT") << first << " " << second << ": " << run.alarm_detail;
    }
  for (const char* block : {"G17 G20 G90 G94 G54 G40 G49 G80 G98 G64 G97 G0", "G91 G28 X1", "G90 G53 G0 X1", "G21 G4 P0", "G18 G92 X0"}) EXPECT_EQ(run_of(block).alarm, "") << block;
}

TEST(IsoCodes, AreThoseOfTheTable) { expect_codes_of(NC_DIALECT_ISO, kRows); }

}  // namespace
}  // namespace nc::test
