// SPDX-License-Identifier: Apache-2.0
// Coordinate systems, offsets by program, length compensation (M700 12.1, 12.2, 12.7, 14; DGSHAPE G10, G43, G54-G59, G92).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

// ---- work systems ----------------------------------------------------------------------------------------------------------

TEST(WorkSystems, SixOfThemAndTheExternalOffset) {  // M700 14.10
  Bench bench;
  for (unsigned k = 1; k <= 6; ++k) bench.work_offset(k, {10.0 * k, 0, 0});
  bench.work_offset(0, {0, 1, 0});
  EXPECT_EQ(bench.run("G0 X1. Y0\nG55 X1.\nG56 X1.\nG57 X1.\nG58 X1.\nG59 X1.\nG54 X1.\nM30").path(),
            (Path{"rapid 11 1 0", "rapid 21 1 0", "rapid 31 1 0", "rapid 41 1 0", "rapid 51 1 0", "rapid 61 1 0", "rapid 11 1 0"}));
}

TEST(WorkSystems, SelectingMovesNothing) {
  Bench bench;
  bench.work_offset(2, {10, 10, 10});
  const Outcome run = bench.run("G0 X5.\nG55\n#100=#5001\nG91 X1.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 5 0 0", "rapid 6 0 0"}));
  EXPECT_EQ(run.var(100), -5);
  EXPECT_EQ(run.last_modal().code[12], 550);
}

TEST(WorkSystems, Extended) {  // M700 14.10
  Bench bench;
  bench.work_offset(101, {1, 0, 0}).work_offset(196, {96, 0, 0});
  const Outcome run = bench.run("G54.1 P1\nG0 X0\nG54.1 P96 X0\nG54 X0\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 96 0 0", "rapid 0 0 0"}));
  EXPECT_EQ(bench.run("G54.1 P97\nM30").alarm, "P39");
  EXPECT_EQ(bench.run("G54.1 P0\nM30").alarm, "P35");
  EXPECT_EQ(bench.run("G54.1\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("G54.1 P2\nM30").last_modal().code[12], 541);
  EXPECT_EQ(bench.run("G54.1 P1\nP3\nG0 X0\nM30").path(), (Path{"rapid 1 0 0"}));  // (19) P alone changes nothing
}

TEST(WorkSystems, AsManyAsAreConfigured) {
  Bench few(NC_DIALECT_M700, [](nc_config& c) { c.work_offsets = 48; });
  EXPECT_EQ(few.run("G54.1 P49\nM30").alarm, "P39");
  Bench many(NC_DIALECT_M700, [](nc_config& c) { c.work_offsets = 300; });
  many.work_offset(400, {7, 0, 0});
  EXPECT_EQ(many.run("G54.1 P300 G0 X0\nM30").path(), (Path{"rapid 7 0 0"}));
}

// ---- G92, G52, G92.1 ---------------------------------------------------------------------------------------------------------

TEST(Setting, G92ShiftsEverySystem) {  // M700 14.5, the figure's numbers
  Bench bench;
  bench.work_offset(1, {-300, -200, 0}).work_offset(2, {-100, 0, 0}).work_offset(101, {50, 0, 0});
  bench.at(-200, -150, 0);
  const Outcome run = bench.run("#100=#5001 #101=#5002\nG92 X0 Y0\n#102=#5001 #103=#5002\nG0 X10.\nG55 X0 Y0\nG54.1 P1 X0\nM30");
  EXPECT_EQ(run.var(100), 100);
  EXPECT_EQ(run.var(101), 50);
  EXPECT_EQ(run.var(102), 0);
  EXPECT_EQ(run.var(103), 0);
  EXPECT_EQ(run.path(), (Path{"rapid -190 -150 0", "rapid 0 50 0", "rapid 150 50 0"}));
}

TEST(Setting, G92LeavesAxesThatAreNotNamed) {
  EXPECT_EQ(m700("G0 X10. Y10.\nG92 X0\nX5. Y5.\nM30").path(), (Path{"rapid 10 10 0", "rapid 15 5 0"}));
  EXPECT_EQ(m700("G0 X10.\nG92\nX5.\nM30").path(), (Path{"rapid 10 0 0", "rapid 5 0 0"}));
}

TEST(Setting, G92CountsTheLengthCompensationIn) {  // M700 14.10 (34927)
  Bench bench;
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G43 H1 G0 Z5.\nG92 Z0\nZ0\nM30").path(), (Path{"rapid 0 0 15", "rapid 0 0 25"}));
}

TEST(Local, AbsoluteReplacesIncrementalAdds) {  // M700 14.11, examples 2 and 4
  EXPECT_EQ(m700("G52 X10.\nG0 X0\nG52 X20.\nX0\nG52 X0\nX0\nM30").path(), (Path{"rapid 10 0 0", "rapid 20 0 0", "rapid 0 0 0"}));
  EXPECT_EQ(m700("G91 G52 X10.\nG52 X5.\nG90 G0 X0\nM30").path(), (Path{"rapid 15 0 0"}));
}

TEST(Local, BelongsToItsSystem) {  // M700 14.11 example 3
  Bench bench;
  bench.work_offset(1, {1, 0.5, 0}).work_offset(2, {1, 2, 0});
  EXPECT_EQ(bench.run("G54 G52 X500 Y500\nG0 X0 Y0\nG55 X0 Y0\nG54 X0 Y0\nM30").path(), (Path{"rapid 1.5 1 0", "rapid 1 2 0", "rapid 1.5 1 0"}));
}

TEST(Local, NotInAnExtendedSystem) {
  const Outcome run = m700("G54.1 P1\nG52 X1.\nM30");
  EXPECT_EQ(run.alarm, "P438");
  EXPECT_EQ(run.alarm_line, 2u);
}

TEST(Preset, TakesShiftAndLocalAway) {  // M700 14.12, the printed example
  const Outcome run = m700("G0 X1. Y1.\nG92 X0 Y0\nX500 Y500\n#100=#5001\nG92.1 X0 Y0\n#101=#5001\nM30");
  EXPECT_DOUBLE_EQ(run.var(100), 0.5);
  EXPECT_DOUBLE_EQ(run.var(101), 1.5);
  EXPECT_EQ(m700("G52 X5. Y5.\nG92.1 X0\nG0 X0 Y0\nM30").path(), (Path{"rapid 0 5 0"}));
  EXPECT_EQ(m700("G92.1 X1.\nM30").alarm, "P35");
}

TEST(Setting, OffsetsAndShiftsOutliveTheProgram) {  // M700 9.1: reset does not clear them
  Bench bench;
  bench.run("G0 X10.\nG92 X0\nM30");
  EXPECT_EQ(bench.run("G0 X1.\nM30").path(), (Path{"rapid 11 0 0"}));
}

// ---- G10 ---------------------------------------------------------------------------------------------------------------------

TEST(DataInput, WorkOffsets) {  // M700 12.7, 14.10 (6)
  Bench bench;
  bench.run("G10 L2 P0 X1.\nG10 L2 P1 X10. Y20.\nG10 L2 P6 Z5.\nG10 P2 X3.\nG10 L20 P96 X7.\nM30");
  EXPECT_EQ(bench.work_offset_now(0, 0), 1);
  EXPECT_EQ(bench.work_offset_now(1, 0), 10);
  EXPECT_EQ(bench.work_offset_now(1, 1), 20);
  EXPECT_EQ(bench.work_offset_now(6, 2), 5);
  EXPECT_EQ(bench.work_offset_now(2, 0), 3);  // without L it counts as L2
  EXPECT_EQ(bench.work_offset_now(196, 0), 7);
}

TEST(DataInput, IncrementalAdds) {
  Bench bench;
  bench.work_offset(1, {10, 10, 0}).tool(5, 1);
  bench.run("G91 G10 L2 P1 X1. G90 Y2.\nG91 G10 L10 P5 R-0.5\nM30");
  EXPECT_EQ(bench.work_offset_now(1, 0), 11);
  EXPECT_EQ(bench.work_offset_now(1, 1), 2);
  EXPECT_EQ(bench.tool_now(5), 0.5);
}

TEST(DataInput, WithoutPTheSelectedSystem) {
  Bench bench;
  bench.run("G56\nG10 L2 X1.\nG10 Y2.\nG54.1 P3\nG10 L20 X4.\nM30");
  EXPECT_EQ(bench.work_offset_now(3, 0), 1);
  EXPECT_EQ(bench.work_offset_now(3, 1), 2);
  EXPECT_EQ(bench.work_offset_now(103, 0), 4);
  EXPECT_EQ(m700("G54.1 P1\nG10 L2 X1.\nM30").alarm, "P33");
  EXPECT_EQ(m700("G10 L20 X1.\nM30").alarm, "P33");
}

TEST(DataInput, ActsAtOnceAndMovesNothing) {  // M700 12.7, printed display 0,0 -> 5,5
  Bench bench;
  bench.work_offset(1, {-10, -10, 0}).at(-10, -10, 0);
  const Outcome run = bench.run("#100=#5001\nG10 L2 P1 X-15. Y-15.\n#101=#5001\nG0 X0\nM30");
  EXPECT_EQ(run.var(100), 0);
  EXPECT_EQ(run.var(101), 5);
  EXPECT_EQ(run.path(), (Path{"rapid -15 -10 0"}));
}

TEST(DataInput, ToolOffsetsOfBothMemoryTypes) {  // M700 12.7
  Bench one;
  one.run("G10 L10 P10 R-12.345\nG10 L10 P5 R98.765\nM30");
  EXPECT_DOUBLE_EQ(one.tool_now(10), -12.345);
  EXPECT_DOUBLE_EQ(one.tool_now(5), 98.765);
  for (const char* l : {"11", "12", "13"}) EXPECT_EQ(one.run(std::string("G10 L") + l + " P1 R1.\nM30").alarm, "P172");
  Bench two;
  two.param("1037", "2");
  two.run("G10 L10 P1 R1.\nG10 L11 P1 R2.\nG10 L12 P1 R3.\nG10 L13 P1 R4.\nM30");
  EXPECT_EQ(two.tool_now(1, NC_TOOL_LENGTH), 1);
  EXPECT_EQ(two.tool_now(1, NC_TOOL_LENGTH_WEAR), 2);
  EXPECT_EQ(two.tool_now(1, NC_TOOL_RADIUS), 3);
  EXPECT_EQ(two.tool_now(1, NC_TOOL_RADIUS_WEAR), 4);
}

TEST(DataInput, Alarms) {
  EXPECT_EQ(m700("G10 L2 P7 X1.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L20 P0 X1.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L20 P97 X1.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L9 P1 X1.\nM30").alarm, "P172");
  EXPECT_EQ(m700("G10 L2 P1 X1.\nG11\nG0 X0\nM30").path(), (Path{"rapid 1 0 0"}));  // 12.7 (3)
  for (const char* two : {"L2 L10 P1 R1.", "L10 L20 P1 X1.", "L2 P1 X1. L2"})  // 12.7 (5); one of them would be lost
    EXPECT_EQ(m700(std::string("G10 ") + two + "\nM30").alarm, "P172") << two;
  EXPECT_EQ(m700("G10 L10 P201 R1.\nM30").alarm, "P173");
  EXPECT_EQ(m700("G10 L10 P0 R1.\nM30").alarm, "P173");
  EXPECT_EQ(m700("G10 L10 P1\nM30").alarm, "P33");
  EXPECT_EQ(m700("G10 L10 R1.\nM30").alarm, "P33");
  EXPECT_EQ(m700("G91 G10 L2 P1 X99999.\nG10 L2 P1 X99999.\nM30").alarm, "P35");
}

TEST(DataInput, Dgshape) {  // DGSHAPE G10
  Bench bench(NC_DIALECT_DGSHAPE);
  bench.work_offset(2, {0, 9, 0});
  bench.run("%\nG91G10L2P2X5000\nG10L2P0Z1000\nG10P3R4000\nM02");
  EXPECT_EQ(bench.work_offset_now(2, 0), 5);  // absolute, also in G91
  EXPECT_EQ(bench.work_offset_now(2, 1), 9);
  EXPECT_EQ(bench.work_offset_now(0, 2), 1);
  EXPECT_EQ(bench.tool_now(3, NC_TOOL_RADIUS), 4);
  EXPECT_EQ(dgshape("G10L3P1X1000\nM02").alarm, "NC-DATA");
  EXPECT_EQ(dgshape("G10L2P7X1000\nM02").alarm, "NC-RANGE");
  EXPECT_EQ(dgshape("G10P0R1000\nM02").alarm, "NC-DATA");
}

TEST(DgshapeSystems, G92AndG54) {  // DGSHAPE G54-G59, G92
  Bench bench(NC_DIALECT_DGSHAPE);
  bench.work_offset(1, {1, 0, 0}).work_offset(2, {2, 0, 0}).work_offset(0, {0, 0, 7});
  EXPECT_EQ(bench.run("%\nG0X0Z0\nG55X0\nG92X10000\nX11000\nG54X0\nM02").path(),
            (Path{"rapid 1 0 7", "rapid 2 0 7", "rapid 3 0 7", "rapid -9 0 7"}));
}

// ---- length ---------------------------------------------------------------------------------------------------------------------

TEST(Length, PlusMinusAndOff) {  // M700 12.2
  Bench bench;
  bench.tool(1, -100);
  EXPECT_EQ(bench.run("G90 G92 Z0\nG43 Z5000 H01 G0\nG01 Z-50000 F9\nM30").path(), (Path{"rapid 0 0 -95", "line 0 0 -150 F9"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G92 Z0\nG0 G44 Z5. H1\nG49 Z0\nM30").path(), (Path{"rapid 0 0 105", "rapid 0 0 0"}));
}

TEST(Length, IncrementalTakesTheDifferenceOfTheOffsets) {  // M700 12.2
  Bench bench;
  bench.tool(1, 10).tool(2, 4);
  EXPECT_EQ(bench.run("G0 G91 G43 Z1. H1\nZ1.\nG43 Z1. H2\nG49 Z1.\nM30").path(),
            (Path{"rapid 0 0 11", "rapid 0 0 12", "rapid 0 0 7", "rapid 0 0 4"}));
}

TEST(Length, ItsCodeCommandsTheAxis) {  // M700 12.2
  Bench bench;
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G0 G43 H1\nX5.\nZ0\nG49\nX6.\nZ0\nM30").path(), (Path{"rapid 0 0 10", "rapid 5 0 10", "rapid 5 0 0", "rapid 6 0 0"}));
}

TEST(Length, TheNumberStaysForLater) {  // M700 12.1 (2)
  Bench bench;
  bench.tool(1, 10).tool(6, 99);
  EXPECT_EQ(bench.run("G0 G43 Z0 H1\nG49 Z0\nG43 Z0\nG43 H0 Z0\nM30").path(), (Path{"rapid 0 0 10", "rapid 0 0 0", "rapid 0 0 10", "rapid 0 0 0"}));
}

TEST(Length, TheNumberMayStandInAnyBlock) {  // M700 12.1 (2), as D does
  Bench bench;
  bench.tool(1, 10).tool(2, 20);
  const auto path = [&](const char* text) { return bench.at(0, 0, 0).run(std::string(text) + "\nM30").path(); };
  EXPECT_EQ(path("G0 H2\nG43 Z1."), (Path{"rapid 0 0 21"}));
  EXPECT_EQ(path("G0 X1. H1 H2\nG44 Z1."), (Path{"rapid 1 0 0", "rapid 1 0 -19"}));  // (3): the last one counts
  EXPECT_EQ(path("G0 G43 Z1. H1\nG49 Z0\nH2\nG43 Z1."), (Path{"rapid 0 0 11", "rapid 0 0 0", "rapid 0 0 21"}));
  EXPECT_EQ(path("G0 G43 Z1. H1\nG49 H2 Z0\nG43 Z1."), (Path{"rapid 0 0 11", "rapid 0 0 0", "rapid 0 0 21"}));
  EXPECT_EQ(path("G0 G4 X1. H2\nG43 Z1."), (Path{"rapid 0 0 21"}));
  // In G43, G44 the amount changes with the next command of the axis.
  EXPECT_EQ(path("G0 G43 Z1. H1\nH2\nX1.\nZ1."), (Path{"rapid 0 0 11", "rapid 1 0 11", "rapid 1 0 21"}));
  EXPECT_EQ(path("G0 G44 Z1. H1\nZ1. H2"), (Path{"rapid 0 0 -9", "rapid 0 0 -19"}));
  EXPECT_EQ(path("G0 G43 Z1. H1\nH0\nZ1."), (Path{"rapid 0 0 11", "rapid 0 0 1"}));  // 12.2 (2) (d)
}

TEST(Length, HOfACallIsASequenceNumber) {  // M700 13.3.1, 13.12
  Bench bench;
  bench.add("O9", "O9\nN7 X5.\nM99\n");
  for (const char* call : {"M98 P9 H7", "M96 P9 H7"}) {
    const Outcome run = bench.run("G0 H3\n" + std::string(call) + "\n#100=#4111\nM30");
    EXPECT_EQ(run.alarm, "") << call;
    EXPECT_EQ(run.var(100), 3) << call;
  }
}

TEST(Length, ReadWithTheModalData) {  // M700 13.5.5, #4111: "up to the block immediately before"
  const Outcome run = m700("#100=#4111\nG0 H3\n#101=#4111\nG43 Z1. H4\n#102=#4111\nH5\n#103=#4111\nM30");
  EXPECT_EQ(run.var(100), 0);
  EXPECT_EQ(run.var(101), 3);
  EXPECT_EQ(run.var(102), 4);
  EXPECT_EQ(run.var(103), 5);
}

TEST(Length, NoNumberAtAll) {  // M700 App.1 P170
  EXPECT_EQ(m700("G0 G43 Z1.\nM30").alarm, "P170");
  EXPECT_EQ(m700("G0 G44 Z1.\nM30").alarm, "P170");
  EXPECT_EQ(m700("G0 G43 Z1. H0\nM30").alarm, "");  // 12.2 (2) (d)
  EXPECT_EQ(m700("G0 H0\nG43 Z1.\nM30").alarm, "");
  EXPECT_EQ(m700("G0 G49 Z1.\nM30").alarm, "");
}

TEST(Length, AxisOfTheBlock) {  // M700 12.2: Z before Y before X; #1080 Z always
  Bench bench;
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G0 G43 X0 H1\nM30").path(), (Path{"rapid 10 0 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 X0 Y0 H1\nM30").path(), (Path{"rapid 0 10 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 X1. Y1. Z0 H1\nM30").path(), (Path{"rapid 1 1 10"}));
  bench.param("1080", "1");
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 X1. H1\nZ0\nM30").path(), (Path{"rapid 1 0 10"}));
}

TEST(Length, AdditionalAxes) {  // M700 12.2 (3) (b): by #1029 to #1031, Zp before Yp before Xp
  Bench bench(NC_DIALECT_M700, axes("XYZWVa"));
  bench.tool(1, 10).tool(2, 20).param("1031", "W").param("1030", "V").param("1029", "A");
  const auto path = [&](const char* text) { return bench.at(0, 0, 0).run(std::string("G0 ") + text + "\nM30").path(); };
  EXPECT_EQ(path("G43 W1. H1\nW2.\nZ1.\nG49 W3."),
            (Path{"rapid 0 0 0 11 0 0", "rapid 0 0 0 12 0 0", "rapid 0 0 1 12 0 0", "rapid 0 0 1 3 0 0"}));
  EXPECT_EQ(path("G44 V1. H1"), (Path{"rapid 0 0 0 0 -9 0"}));
  EXPECT_EQ(path("G43 A90. H2"), (Path{"rapid 0 0 0 0 0 110"}));                      // a rotary axis: deg
  EXPECT_EQ(path("G43 X1. V1. H1"), (Path{"rapid 1 0 0 0 11 0"}));                    // Yp before Xp
  EXPECT_EQ(path("G43 W1. Y1. H1"), (Path{"rapid 0 1 0 11 0 0"}));                    // Zp before Yp
  EXPECT_EQ(path("G43 W1. Z1. H1"), (Path{"rapid 0 0 11 1 0 0"}));                    // both of a pair: the basic one, as for planes (6.3)
  EXPECT_EQ(path("G43 W1. H1\nG43 Z1. H2\nW1."), (Path{"rapid 0 0 0 11 0 0", "rapid 0 0 21 11 0 0", "rapid 0 0 21 1 0 0"}));
  EXPECT_EQ(path("G91 G43 W1. H1\nG43 W1. H2"), (Path{"rapid 0 0 0 11 0 0", "rapid 0 0 0 22 0 0"}));
  EXPECT_EQ(path("G43 W1. H1\nG28 W2.\nW1."), (Path{"rapid 0 0 0 11 0 0", "rapid 0 0 0 12 0 0", "rapid 0 0 0 0 0 0", "rapid 0 0 0 1 0 0"}));
  bench.param("1080", "1");
  EXPECT_EQ(path("G43 W1. H1\nZ0"), (Path{"rapid 0 0 10 1 0 0"}));
}

TEST(Length, AxesThatAreNoParallelOnesAreNotCompensated) {  // M700 12.2 (3) (b)
  Bench bench(NC_DIALECT_M700, axes("XYZW"));
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G0 G43 W1. H1\nZ0\nM30").path(), (Path{"rapid 0 0 10 1"}));
}

TEST(Length, TypeTwoAddsWear) {  // M700 12.1
  Bench bench;
  bench.param("1037", "2").tool(1, 10).tool(1, 0.5, NC_TOOL_LENGTH_WEAR).tool(1, 77, NC_TOOL_RADIUS);
  EXPECT_EQ(bench.run("G0 G43 Z0 H1\nM30").path(), (Path{"rapid 0 0 10.5"}));
}

TEST(Length, NumbersOutOfTheTable) {
  EXPECT_EQ(m700("G43 H201 G0 Z1.\nM30").alarm, "P170");
  EXPECT_EQ(m700("G43 H200 G0 Z1.\nM30").alarm, "");
  for (const char* block : {"H201", "G0 X1. H201", "G49 H201"}) EXPECT_EQ(m700(std::string(block) + "\nM30").alarm, "P170") << block;
}

TEST(Length, IgnoredBesideOneShotFunctions) {  // M700 App.2
  Bench bench;
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G0 G43 G4 X1. H1\nZ0\nZ1.\nM30").path(), (Path{"rapid 0 0 1"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 G53 Z5. H1\nZ1.\nM30").path(), (Path{"rapid 0 0 5", "rapid 0 0 1"}));
}

TEST(Length, AChangedAmountActsFromTheNextCommandOfItsAxis) {  // M700 12.1: "from the next block or blocks onwards"; 12.7: G10 moves nothing
  Bench bench;
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("G0 G43 H1 Z0\nG10 L10 P1 R20.\nX1.\nZ1.\nG43 H1 Z1.\nM30").path(),
            (Path{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 21"}));
  EXPECT_EQ(bench.tool(1, 10).at(0, 0, 0).run("G0 G43 H1 Z0\nG49\nG10 L10 P1 R20.\nZ1.\nM30").path(), (Path{"rapid 0 0 10", "rapid 0 0 0", "rapid 0 0 1"}));
}

TEST(Length, WhatTheHostChangesActsToo) {  // M700 12.1: "including during single block stop"
  Bench bench;
  bench.tool(1, 10);
  bench.on_sync = [&](const nc_item&) { bench.tool(1, 20); };
  EXPECT_EQ(bench.run("G0 G43 H1 Z0\n#100=#1000\nX1.\nZ1.\nM30").path(), (Path{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 21"}));
}

TEST(DgshapeLength, MovesByTheOffsetWithoutAWord) {  // DGSHAPE G43
  Bench bench(NC_DIALECT_DGSHAPE);
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("%\nG43H1\nG0Z5000\nG49\nM02").path(), (Path{"rapid 0 0 10", "rapid 0 0 15", "rapid 0 0 5"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nG43H1Z5000\nG43H0Z5000\nM02").path(), (Path{"rapid 0 0 15", "rapid 0 0 5"}));
  EXPECT_EQ(bench.run("%\nG43H201\nM02").alarm, "NC-OFFSET-DATA");
}

TEST(DgshapeLength, GoesTogetherWithTheAxesOfItsBlock) {  // "If an axis-movement instruction is present within the same block"
  Bench bench(NC_DIALECT_DGSHAPE);
  bench.tool(1, 10);
  EXPECT_EQ(bench.run("%\nG0Z2.\nG43H1X5.\nG1F100.G49Y3.\nM02").path(), (Path{"rapid 0 0 2", "rapid 5 0 12", "line 5 3 2 F100"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nG91G0G43H1X5.\nG49X1.Y1.\nM02").path(), (Path{"rapid 5 0 10", "rapid 6 1 0"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("%\nM03F100.\nG0Z10.\nG81Z-5.R2.\nG43H1X5.\nM02").path().back(), "rapid 5 0 20");
}

}  // namespace
}  // namespace nc::test
