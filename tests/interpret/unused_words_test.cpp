// SPDX-License-Identifier: Apache-2.0
// Words that no code of their block takes: an alarm that names the word, in the families whose manuals list the words of each code (DGSHAPE, HX, Series 8) and
// in iso (LinuxCNC). The other half of the table are words that are taken: none of them may be refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

struct Lost {
  nc_dialect family;
  const char* program;  ///< its last line has the word
  char word;
};

const Lost kLost[] = {
    // clang-format off
    // ---- Series 8
    {NC_DIALECT_SERIES8, "G00X1K5", 'K'},
    {NC_DIALECT_SERIES8, "G00X1R5", 'R'},
    {NC_DIALECT_SERIES8, "F50\nG01X1L1", 'L'},             // L of a corner without G10
    {NC_DIALECT_SERIES8, "F50\nG01X1I2", 'I'},
    {NC_DIALECT_SERIES8, "P5", 'P'},
    {NC_DIALECT_SERIES8, "M08P5", 'P'},
    {NC_DIALECT_SERIES8, "F50\nG02X2R1K1", 'K'},           // along the axis off the plane
    {NC_DIALECT_SERIES8, "F50\nG18\nG02X2R1J1", 'J'},
    {NC_DIALECT_SERIES8, "G04X1P5", 'P'},
    {NC_DIALECT_SERIES8, "G04F1Y5", 'Y'},
    {NC_DIALECT_SERIES8, "F50\nG81X1Z-1R1K2", 'K'},
    {NC_DIALECT_SERIES8, "F50\nG81X1Z-1R1P2", 'P'},
    {NC_DIALECT_SERIES8, "F50\nG81X1Z-1R1L2", 'L'},
    {NC_DIALECT_SERIES8, "F50\nG82X1Z-1R1I2", 'I'},
    {NC_DIALECT_SERIES8, "F50\nG83X1Z-5R1I-2J2P1", 'P'},
    {NC_DIALECT_SERIES8, "M03S600\nG84X1Z-1R1K1J2", 'J'},
    {NC_DIALECT_SERIES8, "F50\nG81X1Z-1R1\nX2Q1", 'Q'},
    {NC_DIALECT_SERIES8, "F50\nG81X1Z-1R1\nG80R2", 'R'},
    {NC_DIALECT_SERIES8, "F50\nG82X1Z-1R1P1\nP2", 'P'},    // a block without a hole
    {NC_DIALECT_SERIES8, "F50\nG36Z-1R1I4J4Q9D1", 'J'},
    {NC_DIALECT_SERIES8, "G49X1Y2I30J10P1", 'P'},
    {NC_DIALECT_SERIES8, "F50\nG06X2Y1R1", 'R'},
    {NC_DIALECT_SERIES8, "F50\nG51Z-5K1", 'K'},
    {NC_DIALECT_SERIES8, "G55R90P1", 'P'},
    {NC_DIALECT_SERIES8, "G56R90", 'R'},
    {NC_DIALECT_SERIES8, "G58R2", 'R'},
    {NC_DIALECT_SERIES8, "G69X1J1", 'J'},
    {NC_DIALECT_SERIES8, "G41D1X10I1", 'I'},
    {NC_DIALECT_SERIES8, "G92X1K1", 'K'},
    // ---- HX
    {NC_DIALECT_HX, "G00 X1. K5", 'K'},
    {NC_DIALECT_HX, "G00 X1. R5.", 'R'},
    {NC_DIALECT_HX, "G00 X1. L2", 'L'},
    {NC_DIALECT_HX, "P5", 'P'},
    {NC_DIALECT_HX, "M08 P5", 'P'},
    {NC_DIALECT_HX, "G02 X20. R10. P2 F100", 'P'},
    {NC_DIALECT_HX, "G02 X20. I10. K1. F100", 'K'},
    {NC_DIALECT_HX, "G18 G02 X20. I10. J1. F100", 'J'},
    {NC_DIALECT_HX, "G33 Z-5. F1. P2", 'P'},
    {NC_DIALECT_HX, "G04 P500 Y5.", 'Y'},
    {NC_DIALECT_HX, "G04 P500 R5.", 'R'},
    {NC_DIALECT_HX, "G10 L10 P1 R5. X1.", 'X'},
    {NC_DIALECT_HX, "G10 L12 P1 R5. Q1.", 'Q'},
    {NC_DIALECT_HX, "G28 X0 P2", 'P'},
    {NC_DIALECT_HX, "G28 X0 R2.", 'R'},
    {NC_DIALECT_HX, "G31 Z-5. F100 P1", 'P'},
    {NC_DIALECT_HX, "G40 X5. R1.", 'R'},
    {NC_DIALECT_HX, "G43 Z5. H1 P1", 'P'},
    {NC_DIALECT_HX, "G50 P2000", 'P'},
    {NC_DIALECT_HX, "G51 X0 Y0 P500 R2.", 'R'},
    {NC_DIALECT_HX, "G52 X1. P2", 'P'},
    {NC_DIALECT_HX, "G90 G53 X1. P2", 'P'},
    {NC_DIALECT_HX, "G54 P2", 'P'},
    {NC_DIALECT_HX, "G63.1 X5.", 'X'},
    {NC_DIALECT_HX, "G64 P1", 'P'},
    {NC_DIALECT_HX, "G68 X0 Y0 R90. P2", 'P'},
    {NC_DIALECT_HX, "G68 X0 Z0 R90.", 'Z'},
    {NC_DIALECT_HX, "G69 R90.", 'R'},
    {NC_DIALECT_HX, "G80 R2.", 'R'},
    {NC_DIALECT_HX, "F50\nG81 X1. Z-1. R1. I1.", 'I'},
    {NC_DIALECT_HX, "F50\nG83 X1. Z-1. R1. Q1.\nQ2.", 'Q'},  // a block without a hole
    {NC_DIALECT_HX, "F50\nG81 X1. Z-1. R1.\nG00 X5. R1.", 'R'},
    {NC_DIALECT_HX, "G92 X1. P1", 'P'},
    {NC_DIALECT_HX, "G96 S100 P1", 'P'},
    {NC_DIALECT_HX, "M03 S100 Q1.", 'Q'},
    // ---- DGSHAPE
    {NC_DIALECT_DGSHAPE, "%\nG00X1.K5.", 'K'},
    {NC_DIALECT_DGSHAPE, "%\nG00X1.D1", 'D'},
    {NC_DIALECT_DGSHAPE, "%\nG00X1.H1", 'H'},
    {NC_DIALECT_DGSHAPE, "%\nP5", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nF100.\nG02X20.R10.P2", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nF100.\nG02X20.I10.K1.", 'K'},
    {NC_DIALECT_DGSHAPE, "%\nF100.\nG18G02X20.I10.J1.", 'J'},
    {NC_DIALECT_DGSHAPE, "%\nG10P1R5.X1.", 'X'},
    {NC_DIALECT_DGSHAPE, "%\nG10L2P1X1.R5.", 'R'},
    {NC_DIALECT_DGSHAPE, "%\nG28Z0P2", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nG50P2", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nG51X0P.5R2.", 'R'},
    {NC_DIALECT_DGSHAPE, "%\nG53X1.P2", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nG54P2", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nG49H1", 'H'},
    {NC_DIALECT_DGSHAPE, "%\nG41D1X5.I1.", 'I'},
    {NC_DIALECT_DGSHAPE, "%\nG40X5.J1.", 'J'},
    {NC_DIALECT_DGSHAPE, "%\nM03S6000F100.\nG81X1.Z-1.R1.P100", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nM03S6000F100.\nG81X1.Z-1.R1.Q1.", 'Q'},
    {NC_DIALECT_DGSHAPE, "%\nM03S6000F100.\nG82X1.Z-1.R1.Q1.", 'Q'},
    {NC_DIALECT_DGSHAPE, "%\nM03S6000F100.\nG81X1.Z-1.R1.\nG80R1.", 'R'},
    {NC_DIALECT_DGSHAPE, "%\nG92X1.P1", 'P'},
    {NC_DIALECT_DGSHAPE, "%\nM12P1", 'P'},
    // ---- iso
    {NC_DIALECT_ISO, "G0 X1 K5", 'K'},
    {NC_DIALECT_ISO, "G2 X20 I10 K1 F100", 'K'},
    {NC_DIALECT_ISO, "F50\nG81 X1 Z-1 R1\nL2", 'L'},
    // clang-format on
};

struct Taken {
  nc_dialect family;
  const char* program;
};

const Taken kTaken[] = {
    // clang-format off
    {NC_DIALECT_SERIES8, "T01D01\nD1X1\nG00X1S500"},
    {NC_DIALECT_SERIES8, "F50\nG01G10X10R2\nG10Y10L1\nX0"},
    {NC_DIALECT_SERIES8, "F50\nG19\nG02Y1Z1J1K0"},
    {NC_DIALECT_SERIES8, "F50\nG81X1Z-1R1D1M03S500\nG67X2R2"},
    {NC_DIALECT_SERIES8, "F50M03S500\nG88X1Z-1R1I.5J0P1\nG89X1R-9Z-5I.5P1"},
    {NC_DIALECT_SERIES8, "G92R4S600\nG57R.5X1\nG58\nG55R45X1Y1"},
    {NC_DIALECT_HX, "G09 G01 X9. ,C1. F50\nY9."},
    {NC_DIALECT_HX, "F50\nG81 X1. Z-1. R1.\nG01 X9. ,C1.\nY9."},
    {NC_DIALECT_HX, "G00 X1. D1 H1 S100 T1 F50"},
    {NC_DIALECT_HX, "G09 G02 X20. I10. F100"},
    {NC_DIALECT_HX, "F50\nG81 X1. Z-1. R1. P100 Q1.\nG82 X2. K2\nG83 X3. L1"},
    {NC_DIALECT_HX, "F50 M03 S100\nG76 X1. Z-1. R1. I.5 J.1 P10"},
    {NC_DIALECT_HX, "F50\nG81 X1. Z-1. R1.\nG60 X5. R2."},
    {NC_DIALECT_HX, "G41 D1 X10. F100\nX20.\nG40 X30. I1. J1."},
    {NC_DIALECT_HX, "F50\nG45 D1 G03 X10. Y10. J10."},
    {NC_DIALECT_HX, "G80 G02 X20. I10. F100"},
    {NC_DIALECT_HX, "G51 X0 Y0 I-1000 J1000\nG50\nG30 P2 X0"},
    {NC_DIALECT_HX, "G22 X10. Y10. Z10. I-10. J-10. K-10.\nG23"},
    {NC_DIALECT_HX, "G10 L10 P1 R5.\nG10 L12 P1 R5.\nG92 S1000\nG96 S100"},
    {NC_DIALECT_HX, "M98 P10 Q1 R2 L2 X5.\nM30\nO10\nN1 X1.\nN2 X2.\nM99 P3"},
    {NC_DIALECT_HX, "G65 P10 A1. B2. D3. K4. R5. Q6.\nM30\nO10\nX1.\nM99"},
    {NC_DIALECT_DGSHAPE, "%\nG41D1X5.\nX9.\nG40X10.\nG43H1Z5.\nG49"},
    {NC_DIALECT_DGSHAPE, "%\nM03S6000F100.\nG83X1.Z-3.R1.Q1.K2\nG89X2.P100\nG98G82X3.P5"},
    {NC_DIALECT_DGSHAPE, "%\nG51X0Y0P.5\nG50\nG10L2P1X1.\nG10P1R5.\nG04X1."},
    {NC_DIALECT_ISO, "G64 P0.01 Q0.02\nG2 X20 I10 P2 F100"},
    // clang-format on
};

Outcome run_of(nc_dialect family, const std::string& program) {
  Bench bench(family);
  bench.tool(1, 2, NC_TOOL_RADIUS).tool(1, 3, NC_TOOL_LENGTH);
  const bool ends = program.find("M30") != std::string::npos;
  return bench.run(ends ? program : program + "\nM30");
}

TEST(UnusedWords, AreTheAlarmOfAnIllegalAddressThatNamesThem) {
  for (const Lost& row : kLost) {
    const std::string text = row.program;
    const Outcome run = run_of(row.family, text);
    EXPECT_EQ(run.alarm, row.family == NC_DIALECT_HX ? "F_82001" : "NC-ADDRESS") << text;
    EXPECT_EQ(run.alarm_line, 1 + std::count(text.begin(), text.end(), '\n')) << text;
    EXPECT_NE(run.alarm_detail.find("The word " + std::string(1, row.word)), std::string::npos) << text << ": " << run.alarm_detail;
  }
}

TEST(UnusedWords, WordsThatACodeTakesAreNone) {
  for (const Taken& row : kTaken) {
    const Outcome run = run_of(row.family, row.program);
    EXPECT_EQ(run.alarm, "") << row.program << ": " << run.alarm_detail;
  }
}

TEST(UnusedWords, ArePassedOverByTheM700) {  // 6.5, example 5: "J ignored"
  const Outcome run = Bench().run("G18 G02 X20. I10. J5. F100\nG00 X1. K5 Q2 R1.\nM30");
  EXPECT_EQ(run.alarm, "");
}

}  // namespace
}  // namespace nc::test
