// SPDX-License-Identifier: Apache-2.0
// Reference positions, tool change positions, machine coordinates (M700 13.13, 14.4, 14.7 to 14.9).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Bench with_references() {
  return Bench(NC_DIALECT_M700, [](nc_config& c) {
    const double places[4][3] = {{0, 0, 0}, {100, 0, 50}, {0, 200, 60}, {-300, -300, 70}};
    for (unsigned which = 0; which < 4; ++which)
      for (unsigned i = 0; i < 3; ++i) c.system[0].axis[i].reference[which] = places[which][i];
  });
}

TEST(Reference, ByParameterToo) {  // M700 14.3, 14.7 (1)
  Bench bench;
  bench.param("2037", "500", 'X').param("2038", "-7", 'X').param("2039", "8", 'X').param("2040", "9", 'X');
  EXPECT_EQ(bench.run("G28 X0\nG30 P2 X0\nG30 P3 X0\nG30 P4 X0\nM30").path(),
            (Path{"rapid 500 0 0", "rapid 0 0 0", "rapid -7 0 0", "rapid 0 0 0", "rapid 8 0 0", "rapid 0 0 0", "rapid 9 0 0"}));
}

TEST(Reference, SecondToFourth) {  // M700 14.8 (1)
  Bench bench = with_references();
  bench.at(1, 1, 1);
  EXPECT_EQ(bench.run("G30 P2 X5. Z5.\nG30 P3 Y5.\nG30 P4 Z5.\nM30").path(),
            (Path{"rapid 5 1 5", "rapid 100 1 50", "rapid 100 5 50", "rapid 100 200 50", "rapid 100 200 5", "rapid 100 200 70"}));
  for (const char* p : {"", "P0 ", "P1 ", "P5 ", "P99 "})  // P ignored: the 2nd
    EXPECT_EQ(bench.at(5, 0, 0).run(std::string("G30 ") + p + "X5.\nM30").path(), (Path{"rapid 100 0 0"})) << p;
}

TEST(Reference, CancelsTheLengthOfItsAxis) {  // M700 14.8 (6)
  Bench bench = with_references();
  bench.tool(3, -3.5);
  const Outcome run = bench.run("G0 G43 Z50. H3\nG30 P3 Z60.\nG0 Z-12.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 46.5", "rapid 0 0 56.5", "rapid 0 0 60", "rapid 0 0 -12"}));
  EXPECT_EQ(run.last_modal().code[8], 490);
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 Z50. H3\nG30 P3 X60.\nG0 Z-12.\nM30").path().back(), "rapid 0 0 -15.5");  // another axis
}

TEST(StartReturn, GoesByTheNewestIntermediatePoint) {  // M700 14.7 (4), (8); 14.8 (4)
  Bench bench = with_references();
  bench.work_offset(1, {-5, 3, 0});
  EXPECT_EQ(bench.run("G28 X20. Y20.\nG30 P2 X-20.\nG29 X31. Y-2.\nM30").path(),
            (Path{"rapid 15 23 0", "rapid 0 0 0", "rapid -25 0 0", "rapid 100 0 0", "rapid -25 23 0", "rapid 26 1 0"}));
}

TEST(StartReturn, MovesTheAxesOfTheBlockOnly) {
  Bench bench = with_references();
  EXPECT_EQ(bench.run("G28 X20. Y20. Z20.\nG29 Z5.\nM30").path(),
            (Path{"rapid 20 20 20", "rapid 0 0 0", "rapid 0 0 20", "rapid 0 0 5"}));
}

TEST(StartReturn, IncrementsCountFromTheIntermediatePoint) {  // M700 14.7 (4): two G00
  EXPECT_EQ(m700("G28 X20.\nG91 G29 X5.\nM30").path(), (Path{"rapid 20 0 0", "rapid 0 0 0", "rapid 20 0 0", "rapid 25 0 0"}));
}

TEST(StartReturn, Alarms) {
  const Outcome first = m700("G29 X5.\nM30");  // 14.7 (5)
  EXPECT_EQ(first.alarm, "P430");
  EXPECT_TRUE(first.path().empty());
  EXPECT_NE(first.alarm_detail.find("xis X"), std::string::npos);
  // "If G28 is not performed after the power has been switched on": an axis without a point of its own goes with the second move only.
  EXPECT_EQ(m700("G28 X9.\nG29 Y5.\nM30").path(), (Path{"rapid 9 0 0", "rapid 0 0 0", "rapid 0 5 0"}));
  EXPECT_EQ(m700("G28 X9.\nG29 X2. Y5.\nM30").path(), (Path{"rapid 9 0 0", "rapid 0 0 0", "rapid 9 0 0", "rapid 2 5 0"}));
  EXPECT_EQ(m700("G28 X9.\nG29 X5. M8\nM30").alarm, "P436");
  Bench bench;  // since power-on: a program before will do
  bench.run("G28 X9.\nM30");
  EXPECT_EQ(bench.run("G29 X5.\nM30").path(), (Path{"rapid 9 0 0", "rapid 5 0 0"}));
}

TEST(StartReturn, MirrorTurnsTheIntermediatePointButNotTheReference) {  // M700 13.6 (5), (6)
  Bench bench = with_references();
  EXPECT_EQ(bench.run("G51.1 X0\nG30 P2 X10.\nG29 X4.\nM30").path(),
            (Path{"rapid -10 0 0", "rapid 100 0 0", "rapid -10 0 0", "rapid -4 0 0"}));
}

TEST(ReferenceCheck, GoesThereAndCompares) {  // M700 14.9
  Bench bench = with_references();
  EXPECT_EQ(bench.run("G0 X5. Y5.\nG27 X0 Y0\nM30").alarm, "");
  EXPECT_EQ(bench.run("G27 X100. Z50. P2\nM30").alarm, "");
  EXPECT_EQ(bench.run("G27 Y200. P3\nG27 X-300. Y-300. Z70. P4\nM30").alarm, "");
  bench.at(9, 9, 9);
  const Outcome run = bench.run("G0 X5.\nG27 X0 Y1.\nX7.\nM30");
  EXPECT_EQ(run.alarm, "P434");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_EQ(run.path(), (Path{"rapid 5 9 9", "rapid 0 1 9"}));  // the alarm comes behind the move
  EXPECT_NE(run.alarm_detail.find("xis Y"), std::string::npos);
  EXPECT_EQ(bench.run("G27 X0 P5\nM30").alarm, "P35");
  EXPECT_EQ(bench.run("G27 X0 P0\nM30").alarm, "P35");
  EXPECT_EQ(bench.run("G27 X0 M9\nM30").alarm, "P435");
  EXPECT_EQ(bench.run("G27\nM30").alarm, "P33");
}

TEST(ReferenceCheck, CompensationMakesItFail) {  // M700 14.9, 12.5
  Bench bench;
  bench.tool(1, 10).tool(2, 3);
  EXPECT_EQ(bench.run("G43 H1 G0 Z50.\nG27 Z0\nM30").alarm, "P434");
  EXPECT_EQ(bench.run("G43 H1 G0 Z50.\nG27 Z-10.\nM30").alarm, "");
  EXPECT_EQ(bench.at(40, 40, 0).run("G41 D2 G0 X20. Y30.\nX10.\nG27 X0 Y0\nM30").alarm, "P434");
}

TEST(ReferenceCheck, SharesItsBlock) {  // M700 App. 2: G40 to G49 are ignored, group 1 is updated
  Bench bench;
  bench.tool(1, 10);
  const Outcome run = bench.run("G27 G43 H1 G0 Z0\nX5.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 5 0 0"}));
  EXPECT_EQ(run.last_modal().code[8], 490);
}

TEST(MachineCoordinates, IncrementsIgnoreMirrorImage) {  // M700 14.4 (4), 13.6 (7)
  EXPECT_EQ(m700("G51.1 X0\nG91 G53 X10.\nG90 G53 X-3.\nM30").path(), (Path{"rapid 10 0 0", "rapid -3 0 0"}));
}

TEST(MachineCoordinates, TheLaterOfG53AndG28) {  // M700 14.4 (8)
  Bench bench = with_references();
  bench.at(10, 0, 0);
  EXPECT_EQ(bench.run("G28 G53 X5.\nM30").path(), (Path{"rapid 5 0 0"}));
  EXPECT_EQ(bench.run("G53 G28 X7.\nM30").path(), (Path{"rapid 7 0 0", "rapid 0 0 0"}));
}

TEST(Preset, LengthIsAwayUntilTheNextCommand) {  // M700 14.12 precaution (1)
  Bench bench;
  bench.tool(1, 10).work_offset(1, {0, 0, 2});
  const Outcome run = bench.run("G43 H1 G0 Z5.\n#100=#5003\nG92.1 Z0\n#101=#5003\nZ5.\nM30");
  EXPECT_EQ(run.var(100), 5);
  EXPECT_EQ(run.var(101), 15);  // 17 - 2
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 17"}));
}

TEST(Preset, NotDuringMirrorImage) {  // M700 14.12 precaution (3)
  EXPECT_EQ(m700("G51.1 X0\nG92.1 X0\nM30").alarm, "P34");
  EXPECT_EQ(m700("G51.1 X0\nG50.1 X0\nG92.1 X0\nM30").alarm, "");
}

TEST(DataInput, NoExtendedSystemsAtAll) {  // M700 14.10 (13), (14)
  Bench none(NC_DIALECT_M700, [](nc_config& c) { c.work_offsets = 0; });
  EXPECT_EQ(none.run("G10 L20 P1 X1.\nM30").alarm, "P172");
  EXPECT_EQ(none.run("G54.1 P1\nM30").alarm, "P39");
}

// ---- tool change position ---------------------------------------------------------------------------------------------------

Bench with_tool_change() {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.system[0].axis_count = 4;
    c.system[0].axis[3].name = 'C';
    c.system[0].axis[3].rotary = true;
  });
  bench.param("8206", "-10", 'X').param("8206", "25", 'Y').param("8206", "12", 'Z').param("8206", "90", 'C');
  bench.at(80, -40, -60, 30);
  return bench;
}

TEST(ToolChange, OrderOfTheAxes) {  // M700 13.13
  EXPECT_EQ(with_tool_change().run("G30.1\nM30").path(), (Path{"rapid 80 -40 12 30", "rapid -10 25 12 30"}));
  EXPECT_EQ(with_tool_change().run("G30.2\nM30").path(), (Path{"rapid 80 -40 12 30", "rapid -10 -40 12 30", "rapid -10 25 12 30"}));
  EXPECT_EQ(with_tool_change().run("G30.3\nM30").path(), (Path{"rapid 80 -40 12 30", "rapid 80 25 12 30", "rapid -10 25 12 30"}));
  EXPECT_EQ(with_tool_change().run("G30.4\nM30").path(), (Path{"rapid -10 -40 -60 30", "rapid -10 25 12 30"}));
  EXPECT_EQ(with_tool_change().run("G30.5\nM30").path(), (Path{"rapid 80 25 -60 30", "rapid -10 25 12 30"}));
  EXPECT_EQ(with_tool_change().run("G30.6\nM30").path(), (Path{"rapid -10 25 12 30"}));
}

TEST(ToolChange, AddedAxesComeLast) {
  Bench bench = with_tool_change();
  bench.param("1092", "1", 'C');
  EXPECT_EQ(bench.run("G30.5\nM30").path(), (Path{"rapid 80 25 -60 30", "rapid -10 25 12 30", "rapid -10 25 12 90"}));
}

TEST(ToolChange, EveryStepIsABlockForSingleBlock) {
  unsigned stops = 0;
  for (const Step& step : with_tool_change().run("G30.2\nM30").steps)
    stops += step.item.kind == NC_ITEM_MARK && !step.item.u.mark.report && step.item.u.mark.stop ? 1u : 0u;
  EXPECT_EQ(stops, 2u);
}

TEST(ToolChange, CancelsTheLengthAndTakesNoAxis) {
  Bench bench = with_tool_change();
  bench.tool(1, 10);
  const Outcome run = bench.run("G43 H1 G0 Z0\nG30.1\nG0 Z5.\nM30");
  EXPECT_EQ(run.path().back(), "rapid -10 25 5 30");
  EXPECT_EQ(bench.run("G30.1 X0\nM30").alarm, "P33");
}

}  // namespace
}  // namespace nc::test
