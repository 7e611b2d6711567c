// SPDX-License-Identifier: Apache-2.0
// Tool length compensation moves its axis in the block of its code (M700 12.2 (1), (3)(c); HX 13.1.1), whatever else stands there or is in force.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome run(const std::string& text, nc_dialect dialect = NC_DIALECT_M700) {
  Bench bench(dialect);
  return bench.tool(1, 5).tool(2, 8).run("G90 G00 G17 G21 G94\n" + text + "\nM30");
}

struct Row {
  const char* program;
  Path path;
};

const Row kBoth[] = {
    {"G43 H1\nG49", {"rapid 0 0 5", "rapid 0 0 0"}},
    {"G43 H1\nG43 H2\nG43 H0", {"rapid 0 0 5", "rapid 0 0 8", "rapid 0 0 0"}},
    {"G44 H1\nG49", {"rapid 0 0 -5", "rapid 0 0 0"}},
    {"G49\nG43 H0", {}},                                             // nothing to go by
    {"G43 H1\nG43 H1", {"rapid 0 0 5"}},
    {"G91 G43 H1\nG49\nZ3.", {"rapid 0 0 5", "rapid 0 0 0", "rapid 0 0 3"}},
    {"G43 H1\nG90 Z0\nG49 Z2.", {"rapid 0 0 5", "rapid 0 0 2"}},
    {"G01 F100 G43 H1\nX5.\nG49", {"line 0 0 5 F100", "line 5 0 5 F100", "line 5 0 0 F100"}},
    {"G43 H1 M3\nX1.", {"rapid 0 0 5", "rapid 1 0 5"}},
};

TEST(Length, MovesItsAxisInTheBlockOfItsCode) {
  for (const Row& row : kBoth)
    for (const nc_dialect dialect : {NC_DIALECT_M700, NC_DIALECT_HX}) {
      const Outcome did = run(row.program, dialect);
      EXPECT_EQ(did.alarm, "") << row.program << ", " << nc_dialect_name(dialect);
      EXPECT_EQ(did.path(), row.path) << row.program << ", " << nc_dialect_name(dialect);
    }
}

const Row kM700[] = {
    {"G51.1 Z0\nZ10.\nG43 H1", {"rapid 0 0 -10", "rapid 0 0 -5"}},
    {"G51 X0 Y0 Z0 P2.\nZ10.\nG43 H1", {"rapid 0 0 20", "rapid 0 0 25"}},
    {"G18\nG68 X0 Z0 R90.\nX10.\nG43 H1\nG49", {"rapid 0 0 -10", "rapid 0 0 -5", "rapid 0 0 -10"}},
    // The mode of a fixed cycle: no hole is made.
    {"G81 X5. Z-5. R2. F100\nG43 H1\nG80", {"rapid 5 0 0", "rapid 5 0 2", "line 5 0 -5 F100", "rapid 5 0 0", "rapid 5 0 5"}},
    // App. 2: in the mode of an arc, also beside one, the way back is a line.
    {"G43 H1\nG02 X10. Y10. R10. F100\nG49\nX20. Y0 R10.", {"rapid 0 0 5", "cw 10 10 5 c10,0 F100", "line 10 10 0 F100", "cw 20 0 0 c10,0 F100"}},
    // App. 2: beside a dwell it is ignored, and beside a macro call it only becomes modal.
    {"G43 H1\nG49 G04 X0.1\nZ0", {"rapid 0 0 5"}},
    {"G43 H1 G65 P100\nZ1.", {"rapid 0 0 6"}},
    // 12.4: a block across the plane.
    {"G41 D1 X10. F100\nG01 X20.\nG43 H1\nX30.\nG40 X40.\nG49", {"rapid 10 5 0", "line 20 5 0 F100", "line 20 5 5 F100", "line 30 5 5 F100", "line 40 0 5 F100", "line 40 0 0 F100"}},
};

TEST(Length, MovesItsAxisUnderWhatElseIsInForce) {
  for (const Row& row : kM700) {
    Bench bench;
    bench.add("O100", "M99\n");
    const Outcome did = bench.tool(1, 5).tool(2, 8).run("G90 G00 G17 G21 G94\n" + std::string(row.program) + "\nM30");
    EXPECT_EQ(did.alarm, "") << row.program << ": " << did.alarm_detail;
    EXPECT_EQ(did.path(), row.path) << row.program;
  }
}

TEST(Length, ItsMoveTakesAFeedAndIsNoArc) {
  EXPECT_EQ(run("G01 G43 H1").alarm, "P62");
  EXPECT_EQ(run("G01 G43 H0").alarm, "");
  EXPECT_EQ(run("G02 X10. Y10. R10. F100\nG43 H1").alarm, "P70");
  EXPECT_EQ(run("G02 X10. Y10. R10. F100\nG43 H1 Z5.").alarm, "P70");
  EXPECT_EQ(run("G93\nG01 G43 H1").alarm, "P62");
}

TEST(Length, AtTheAxisThatItsBlockNames) {
  Bench bench;
  bench.tool(1, 5).tool(2, 8);
  EXPECT_EQ(bench.run("G90 G00 G43 X1. H1\nG49\nG44 Y1. H2\nG49 Y2.\nM30").path(), (Path{"rapid 6 0 0", "rapid 1 0 0", "rapid 1 -7 0", "rapid 1 2 0"}));
  bench.at(0, 0, 0).param("1080", "1");  // always Z, together with what the block names
  EXPECT_EQ(bench.run("G90 G00 G43 X1. H1\nG49 X2.\nM30").path(), (Path{"rapid 1 0 5", "rapid 2 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G90 G00 G68 X0 Y0 R90.\nG43 X10. H1\nG49\nM30").path(), (Path{"rapid 0 10 5", "rapid 0 10 0"}));
}

}  // namespace
}  // namespace nc::test
