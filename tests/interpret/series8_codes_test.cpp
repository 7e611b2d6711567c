// SPDX-License-Identifier: Apache-2.0
// The list of codes of the Series 8, one row for each: what a program with the code does by its page (or by docs/series8.md, where the page is only a title),
// and which words and neighbours it cannot have, with the alarm on the line of the block. In a table of its own so that it can be laid beside the list.
#include "support/code_rows.hpp"

namespace nc::test {
namespace {

Outcome run_of(const std::string& text) {
  Bench bench(NC_DIALECT_SERIES8);
  bench.tool(1, 3, NC_TOOL_RADIUS).tool(1, 10, NC_TOOL_LENGTH);
  return bench.run("G90G71\n" + text + "\nM30");
}

const CodeRow kRows[] = {
    {"G00", "G00X5Y.5Z-1.\nG00XY", {"rapid 5 0.5 -1", "rapid 0 0 -1"}, "M30", {{"G00B1", "NC-AXIS"}, {"G00H1", "NC-ADDRESS"}, {"G00X1.2.", "NC-FORMAT"}, {"G00X[1]", "NC-CHARACTER"}, {"G00X#1", "NC-CHARACTER"}}},
    {"G01", "F50\nG01X1\nY2F100", {"line 1 0 0 F50", "line 1 2 0 F100"}, "M30", {{"G01X1", "NC-FEED"}, {"F\nG01X1", "NC-FEED"}, {"G01X1F-1", "NC-RANGE"}}},
    {"G02", "F50\nG02X2R1\nX4\nG02X5Y-1I0J1", {"cw 2 0 0 c1,0 F50", "cw 4 0 0 c3,0 F50", "cw 5 -1 0 c4,-1 F50"}, "M30",
     {{"F50\nG02X1Y1I-1", "INVALIDARC"}, {"F50\nG02X5Y6I3", "INVALIDARC"}, {"G02X2R1", "NC-FEED"}}},
    {"G03", "F50\nG03X2R1\nG03X4R-1", {"ccw 2 0 0 c1,0 F50", "ccw 4 0 0 c3,0 F50"}, "M30", {{"F50\nX5\nG03X-5Y1I5", "INVALIDARC"}}},
    {"G04", "G04X1.5\nG04F.5", {}, "M30", {{"G04", "NC-WORDS"}, {"G04X-1", "NC-RANGE"}}},
    {"G06", "F50\nG06X2Y1", {"spline 0 0 0 F50"}, "M30", {{"F50\nG06", "NC-WORDS"}, {"G06X2Y1", "NC-FEED"}, {"F50\nG06X0", "NC-RANGE"}, {"G93F2\nG06X2Y1", "NC-FEED"}}},
    {"G10", "F50\nG10G01X10R2\nG10Y10L1\nX0", {"line 8 0 0 F50", "ccw 10 2 0 c8,2 F50", "line 10 9 0 F50", "line 9 10 0 F50", "line 0 10 0 F50"}, "M30",
     {{"F50\nG10G01X10R2L1", "NC-FORMAT"}, {"F50\nG10G01X10", "NC-WORDS"}}},
    {"G17", "F50\nG17\nG02X2R1", {"cw 2 0 0 c1,0 F50"}, "M30", {}},
    {"G18", "F50\nG18\nG02X2R1", {"cw 2 0 0 c0,1 F50"}, "M30", {{"G41D1\nX5\nG18", "NC-OFFSET-CODE"}}},
    {"G19", "F50\nG19\nG02Y2R1", {"cw 0 2 0 c1,0 F50"}, "M30", {{"G41D1\nX5\nG19", "NC-OFFSET-CODE"}}},
    {"G21", "F50\nG21X1\nX2", {"line 1 0 0 F50", "line 2 0 0 F50"}, "M30", {{"G21X1", "NC-FEED"}}},
    {"G22", "F50\nG22X2R1", {"cw 2 0 0 c1,0 F50"}, "M30", {{"F50\nG22X1Y1I-1", "INVALIDARC"}}},
    {"G23", "F50\nG23X2R1", {"ccw 2 0 0 c1,0 F50"}, "M30", {{"F50\nX5\nG23X-5Y1I5", "INVALIDARC"}}},
    {"G34", "F50\nG34Z-1R1I8J6Q9D1", {"rapid 0 0 1", "line 0 0 -1 F50", "line 1 0 -1 F50", kGoesOn}, "M30",
     {{"F50\nG34Z-1R1I8J6", "NC-WORDS"}, {"F50\nG34Z-1R1I8D1", "NC-WORDS"}, {"F50\nG34Z-1R1I5J6D1", "NC-RANGE"}, {"F50\nG34Z1R1I8J6D1", "NC-RANGE"}, {"F50\nG18\nG34Z-1R1I8J6D1", "NC-PLANE"},
      {"G34Z-1R1I8J6D1", "NC-FEED"}, {"G93F2\nG34Z-1R1I8J6D1", "NC-FEED"}}},
    {"G35", "F50\nG35Z-1R1I8J6Q9D1", {"rapid 0 0 1", "line 0 0 -1 F50", "line 1 0 -1 F50", kGoesOn}, "M30", {{"F50\nG35Z-1R1J6D1", "NC-WORDS"}, {"G93F2\nG35Z-1R1I8J6D1", "NC-FEED"}}},
    {"G36", "F50\nG36Z-1R1I4Q9D1", {"rapid 0 0 1", "line 0 0 -1 F50", "line 1 0 -1 F50", "ccw 1 0 -1 c0,0 F50", kGoesOn}, "M30", {{"F50\nG36Z-1R1D1", "NC-WORDS"}, {"F50\nG36Z-1R1I3D1", "NC-RANGE"}, {"G93F2\nG36Z-1R1I4D1", "NC-FEED"}}},
    {"G40", "G41D1\nX10\nX20\nG40X30", {"rapid 0 3 0", "rapid 10 3 0", "rapid 20 3 0", "rapid 30 0 0"}, "M30", {}},
    {"G41", "G41D1X10\nX20", {"rapid 0 3 0", "rapid 10 3 0", "rapid 20 3 0"}, "M30", {{"G41X1", "NC-OFFSET-DATA"}, {"F50\nG41D1G02X2R1", "NC-OFFSET-START"}, {"F50\nG41D1X5\nG81Z-1R1", "NC-OFFSET-CODE"}}},
    {"G42", "G42D1X10\nX20", {"rapid 0 -3 0", "rapid 10 -3 0", "rapid 20 -3 0"}, "M30", {{"G42D201X1", "NC-OFFSET-DATA"}}},
    // No line to the place beside the start.
    {"G43", "G43G41D1X10\nX20", {"rapid 10 3 0", "rapid 20 3 0"}, "M30", {{"G43X1", "NC-MODE"}}},
    {"G49", "G49X1Y2I30J10", {"rapid 1 2 0", "rapid 31 2 0", "rapid 31 12 0", "rapid 1 12 0", "rapid 1 2 0"}, "M30", {{"G49I30", "NC-WORDS"}, {"G49I30J-1", "NC-RANGE"}, {"G49I30J10K1", "NC-RANGE"}, {"G93F2\nG01G49I30J10", "NC-FEED"}}},
    {"G50", "G50X1Y2I30J10", {"rapid 1 2 0", "rapid 1 12 0", "rapid 31 12 0", "rapid 31 2 0", "rapid 1 2 0"}, "M30", {{"G50J30", "NC-WORDS"}, {"G50I30J10L1", "NC-RANGE"}, {"G93F2\nG01G50I30J10", "NC-FEED"}}},
    {"G51", "X1", {"rapid 1 0 0"}, "M30", {{"F50\nG51Z-5", "NC-PROBE"}, {"G51Z-5", "NC-FEED"}, {"F50\nG41D1X5\nG51Z-5", "NC-OFFSET-CODE"}}},
    {"G55", "G55R45\nX10Y0\nX0Y10", {"rapid 7.071068 7.071068 0", "rapid -7.071068 7.071068 0"}, "M30", {{"F50\nG55R45G02X1", "NC-MODE"}}},
    {"G56", "G55R90\nX10Y0\nG56X1", {"rapid 0 10 0", "rapid 1 10 0"}, "M30", {}},
    {"G57", "X5Y5\nG57R.5\nX6", {"rapid 5 5 0", "rapid 3 2.5 0"}, "M30", {{"G57", "NC-WORDS"}, {"G57R0", "NC-RANGE"}, {"G57R-1", "NC-RANGE"}}},
    {"G58", "G57R2\nX1Y1\nG58\nX3", {"rapid 2 2 0", "rapid 3 2 0"}, "M30", {}},
    {"G67", "G91\nX5\nG67X1\nX1", {"rapid 5 0 0", "rapid 1 0 0", "rapid 2 0 0"}, "M30", {}},
    {"G68", "X5\nG68X1\nX1", {"rapid 5 0 0", "rapid 6 0 0", "rapid 1 0 0"}, "M30", {}},
    {"G69", "X5\nG92X0\nG69X1\nX1\nF50\nG91G02G69X8R1\nG69X7Y1J1", {"rapid 5 0 0", "rapid 1 0 0", "rapid 6 0 0", "cw 8 0 0 c7,0 F50", "cw 7 1 0 c8,1 F50"}, "M30",
     {{"F50\nG55R90\nG02G69X2R1", "NC-MODE"}, {"F50\nG57R2\nG02G69X2R1", "NC-MODE"}}},
    {"G70", "G70\nX1", {"rapid 25.4 0 0"}, "M30", {{"G20X1", "NC-NO-SUCH-CODE"}}},
    {"G71", "G70\nG71\nX1", {"rapid 1 0 0"}, "M30", {}},
    {"G80", "F50\nG81X1Z-1R1\nG80\nX2", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "rapid 1 0 1", "rapid 2 0 1"}, "M30", {}},
    {"G81", "F50\nG81X1Z-1R1M03S500\nX2", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "rapid 1 0 1", "rapid 2 0 1", "line 2 0 -1 F50", "rapid 2 0 1"}, "S500 M3 M30",
     {{"F50\nG81X1Z-1", "NC-WORDS"}, {"F50\nG81X1R1", "NC-WORDS"}, {"G81X1Z-1R1", "NC-FEED"}, {"F50\nG41D1X5\nG81Z-1R1", "NC-OFFSET-CODE"}, {"F50\nG81X1Z1R-1", "NC-RANGE"}}},
    {"G82", "F50\nG82X1Z-1R1P1.5", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "rapid 1 0 1"}, "M30", {{"F50\nG82X1Z-1R1P-1", "NC-RANGE"}, {"F50\nG82X1Z1R-1P1", "NC-RANGE"}}},
    {"G83", "F50\nG83X1Z-5R1I-2J2", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -2 F50", "rapid 1 0 1", "rapid 1 0 -0.73", "line 1 0 -4 F50", "rapid 1 0 1", "rapid 1 0 -2.73", "line 1 0 -5 F50", "rapid 1 0 1"}, "M30",
     {{"F50\nG83X1Z-5R1I2J2", "NC-RANGE"}, {"F50\nG83X1Z-5R1I-2", "NC-WORDS"}, {"F50\nG83X1Z-5R1I-2J", "NC-WORDS"}, {"F50\nG83X1Z5R1I2J2", "NC-RANGE"}}},
    {"G84", "M03S600\nG84X1Z-1R1K1", {"rapid 1 0 0", "rapid 1 0 1", "tap 1 0 -1 F600", "tap 1 0 1 F600"}, "S600 M3 M30",
     {{"M03S600\nG84X1Z-1R1", "NC-FEED"}, {"G84X1Z-1R1K1", "NC-SPINDLE"}, {"M73", "NC-NOT-BUILT"}, {"M74", "NC-NOT-BUILT"}, {"M03S600\nG84X1Z1R-1K1", "NC-RANGE"}}},
    {"G85", "F50\nG85X1Z-1R1P.5", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "line 1 0 1 F50"}, "M30", {{"F50\nG85X1Z1R-1", "NC-RANGE"}}},
    {"G86", "M03S600F50\nG86X1Z-1R1", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "rapid 1 0 1"}, "S600 M3 M5 M3 M30", {{"F50\nG86X1Z-1R1", "NC-SPINDLE"}, {"M03S600F50\nG86X1Z1R-1", "NC-RANGE"}}},
    {"G87", "F50\nG87X1Z-1R1\nR0Z-3", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "rapid 1 0 0", "line 1 0 -3 F50"}, "M30", {{"F50\nG87X1Z1R-1", "NC-RANGE"}, {"F50\nG87X1Z-1R1\nR-3Z-2", "NC-RANGE"}}},
    {"G88", "M03S600F50\nG88X1Z-1R1I.5", {"rapid 1 0 0", "rapid 1 0 1", "line 1 0 -1 F50", "rapid 1.5 0 -1", "rapid 1.5 0 1", "rapid 1 0 1"}, "S600 M3 M5 M19 M3 M30", {{"F50\nG88X1Z-1R1I.5", "NC-SPINDLE"}, {"M03S600F50\nG88X1Z-1R1I.5K9", "NC-ADDRESS"}, {"M03S600F50\nG88X1Z1R-1I.5", "NC-RANGE"}}},
    {"G89", "M03S600F50\nG89X1R-9Z-5I.5", {"rapid 1 0 0", "rapid 1.5 0 0", "rapid 1.5 0 -9", "rapid 1 0 -9", "line 1 0 -5 F50", "line 1 0 -9 F50", "rapid 1.5 0 -9", "rapid 1.5 0 0", "rapid 1 0 0"},
     "S600 M3 M5 M19 M3 M5 M19 M3 M30", {{"F50\nG89X1R-9Z-5I.5", "NC-SPINDLE"}, {"M03S600F50\nG89X1R2Z-2I.5", "NC-RANGE"}, {"M03S600F50\nG89X1R-9Z-5I.5K9", "NC-ADDRESS"}}},
    {"G90", "G91\nX1\nG90X3", {"rapid 1 0 0", "rapid 3 0 0"}, "M30", {}},
    {"G91", "G91\nX1\nX1", {"rapid 1 0 0", "rapid 2 0 0"}, "M30", {}},
    {"G92", "X20Y30\nG92X0\nX5", {"rapid 20 30 0", "rapid 25 30 0"}, "M30", {{"G41D1X5\nG92X1", "NC-OFFSET-CODE"}}},
    {"G93", "G93F2\nG01X10", {"line 10 0 0 F20"}, "M30", {{"G93\nG01X10", "NC-FEED"}}},
    {"G94", "G93F2\nG01X0Y1\nG94\nF50\nG01X1", {"line 0 1 0 F2", "line 1 1 0 F50"}, "M30", {{"G93F2\nG01X0Y1\nG94\nX1", "NC-FEED"}}},
    {"G95", "M03S500\nG95F.5\nG01X1", {"line 1 0 0 F0"}, "S500 M3 M30", {}},
    {"G96", "G92X8\nG96S100\nX4", {"rapid -4 0 0"}, "S100 M30", {{"G96S-1", "NC-SPINDLE"}}},
    {"G97", "G97S500M03", {}, "S500 M3 M30", {}},
    {"G98", "X20Y30\nG98X0Y0\nX5", {"rapid 20 30 0", "rapid 25 30 0"}, "M30", {}},
    {"M00", "M00X1", {"rapid 1 0 0"}, "M0 M30", {}},
    {"M01", "M01", {}, "M30", {}},
    {"M02", "X1\nM02", {"rapid 1 0 0"}, "M2", {}},
    {"M30", "X1", {"rapid 1 0 0"}, "M30", {{"M98", "NC-NO-SUCH-CODE"}, {"M99", "NC-NO-SUCH-CODE"}}},
    {"M03", "M03S5", {}, "S5 M3 M30", {}},
    {"M04", "M04S5", {}, "S5 M4 M30", {}},
    {"M05", "M05", {}, "M5 M30", {}},
    {"M06", "M06T1D1", {}, "T1 M6 M30", {}},
    {"M19", "M19", {}, "M19 M30", {}},
    {"M58", "M58", {}, "M58 M30", {}},
    {"M59", "M59", {}, "M59 M30", {}},
};

TEST(Series8Codes, DoWhatTheirPageSays) {
  expect_done(kRows, run_of);
  EXPECT_EQ(run_of("G04X1.5\nG04F.5").dwells(), (std::vector<double>{1.5, 0.5}));
  EXPECT_EQ(run_of("F50\nG82X1Z-1R1P1.5\nG85P.25X2").dwells(), (std::vector<double>{1.5, 0.25}));
  EXPECT_EQ(run_of("M03S500\nG95F.5\nG01X1").moves().back().feed_mm_rev, 0.5);
  // G21 to G23: at rest at the end of each, which G01 to G03 are not.
  EXPECT_TRUE(run_of("F50\nG21X1\nX2").moves()[0].exact_stop);
  EXPECT_FALSE(run_of("F50\nG01X1\nX2").moves()[0].exact_stop);
  EXPECT_TRUE(run_of("F50\nG22X2R1\nG01X3").moves()[0].exact_stop && run_of("F50\nG23X2R1\nG01X3").moves()[0].exact_stop);
}

TEST(Series8Codes, RefuseWhatTheyCannotHave) { expect_refused(kRows, run_of, 1); }

TEST(Series8Codes, AreThoseOfTheTable) { expect_codes_of(NC_DIALECT_SERIES8, kRows); }

}  // namespace
}  // namespace nc::test
