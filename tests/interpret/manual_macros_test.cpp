// SPDX-License-Identifier: Apache-2.0
// The programs of M700 13.5.10 are run and compared with the geometry that they are meant to make. Misprints are corrected, which is noted there.
#include <gtest/gtest.h>

#include <numbers>

#include "support/pull.hpp"

namespace nc::test {
namespace {

double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

// Example 1. Printed: "Y#10", which is #101.
TEST(ManualMacros, SineCurve) {
  Bench bench;
  bench.add("O9910", "WHILE [#1LE#2] DO1;\n#101=#3*SIN [#1] ;\nG90G01X#1Y#101F#9;\n#1=#1+10.;\nEND1;\nM99;\n");
  const Outcome run = bench.run("G65P9910A0B360.C100.F100;\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_move> moves = run.moves();
  ASSERT_EQ(moves.size(), 36u);  // 0 degrees is where the tool stands
  for (unsigned i = 0; i < moves.size(); ++i) {
    const double angle = 10.0 * (i + 1);
    EXPECT_NEAR(moves[i].machine.v[0], angle, 1e-9);
    EXPECT_NEAR(moves[i].machine.v[1], 100 * sine(angle), 1e-9);
    EXPECT_EQ(moves[i].feed_mm_min, 100);
  }
  // (Note 1): in one block.
  Bench short_bench;
  short_bench.add("O9910", "WHILE [#1LE#2] DO1;\nG90G01X#1Y [#3*SIN [#1]] F#9 ;\n#1=#1+10.;\nEND1;\nM99;\n");
  EXPECT_EQ(short_bench.run("G65P9910A0B360.C100.F100;\nM30").path(), run.path());
}

constexpr const char* kBoltCircle =
    "#101=0 ;\n#102=#4003 ;\n#103=#5001 ;\n#104=#5002 ;\n#111=#1 ;\nWHILE [#101LT#2] DO1 ;\n#120=#24+#18*COS [#111] ;\n#121=#25+#18*SIN [#111] ;\n"
    "#122=#120 #123=#121 ;\nIF [#102EQ90] GOTO100 ;\n#122=#120 - #103 ;\n#123=#121 - #104 ;\n#103=#120\n#104=#121\nN100 X#122Y#123 ;\n"
    "#101=#101+1 ;\n#111=#1+360.*#101/#2 ;\nEND1 ;\nM99 ;\n";

std::vector<nc_axes> holes(const Outcome& run, double bottom) {
  std::vector<nc_axes> found;
  for (const nc_move& move : run.moves())
    if (move.kind == NC_MOVE_LINE && std::fabs(move.machine.v[2] - bottom) < 1e-9) found.push_back(move.machine);
  return found;
}

// Example 2, the printed main program: three circles around one centre.
TEST(ManualMacros, BoltHoleCircles) {
  Bench bench;
  bench.add("O9920", kBoltCircle);
  const Outcome run = bench.run(
      "G28 X0 Y0 Z0;\nT1 M06;\nG90 G43 Z100.H01 F100;\nG54 G00 X0 Y0;\nG81 Z-100.R3.F100 L0 M03;\nG65 P9920 X-500. Y-500. A0 B8 R100.;\n"
      "G65 P9920 X-500. Y-500. A0 B8 R200.;\nG65 P9920 X-500. Y-500. A0 B8 R300.;\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_axes> drilled = holes(run, -100);
  ASSERT_EQ(drilled.size(), 24u);
  for (unsigned i = 0; i < 24; ++i) {
    const double radius = 100.0 * (1 + i / 8), angle = 45.0 * (i % 8);
    EXPECT_NEAR(drilled[i].v[0], -500 + radius * cosine(angle), 1e-6) << i;
    EXPECT_NEAR(drilled[i].v[1], -500 + radius * sine(angle), 1e-6) << i;
  }
}

TEST(ManualMacros, BoltHoleCircleInIncrements) {  // #4003 says G91: differences to where the axes are
  Bench bench;
  bench.add("O9920", kBoltCircle);
  const Outcome run = bench.run("G90 G0 X10. Y20. Z100.\nG91 G81 Z-10. R-90. F100 L0\nG65 P9920 X50. Y60. A30. B6 R25.\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_axes> drilled = holes(run, 0);
  ASSERT_EQ(drilled.size(), 6u);
  for (unsigned i = 0; i < 6; ++i) {
    EXPECT_NEAR(drilled[i].v[0], 50 + 25 * cosine(30 + 60.0 * i), 1e-6) << i;
    EXPECT_NEAR(drilled[i].v[1], 60 + 25 * sine(30 + 60.0 * i), 1e-6) << i;
  }
}

// Example 3. In the manual its second call has no Y, so only the first one is run.
TEST(ManualMacros, Grid) {
  Bench bench;
  bench.add("O9930",
            "#101=#24 ;\n#102=#25 ;\n#103=#4 ;\n#104=#5 ;\n#106=#2 ;\nWHILE [#106GT0] DO1 ;\n#105=#1 ;\nWHILE [#105GT0] DO2 ;\nG90 X#101 Y#102 ;\n"
            "#101=#101+#103 ;\n#105=#105-1 ;\nEND2 ;\n#101=#101-#103;\n#102=#102+#104;\n#103=-#103 ;\n#106=#106-1 ;\nEND1 ;\nM99 ;\n");
  const Outcome run = bench.run(
      "G28 X0 Y0 Z0;\nT1 M06;\nG90 G43 Z100.H01 F100;\nG54 G00 X0 Y0;\nG81 Z-100. R3.F100 L0 M03;\nG65 P9930 X0 Y0 I-100. J-75. A5B3;\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_axes> drilled = holes(run, -100);
  ASSERT_EQ(drilled.size(), 15u);
  for (unsigned i = 0; i < 15; ++i) {
    const unsigned row = i / 5, column = row % 2 == 0 ? i % 5 : 4 - i % 5;  // each row the other way
    EXPECT_NEAR(drilled[i].v[0], -100.0 * column, 1e-9) << i;
    EXPECT_NEAR(drilled[i].v[1], -75.0 * row, 1e-9) << i;
  }
}

}  // namespace
}  // namespace nc::test
