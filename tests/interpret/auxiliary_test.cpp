// SPDX-License-Identifier: Apache-2.0
// S, T, B and M (M700 9, 10.1, 10.2, 11.1; DGSHAPE 2), and the stops.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "support/drive.hpp"

namespace nc::test {
namespace {

/// The functions that go out, the waits and the moves, in order: "S1000 M3 fin line stop".
std::string order(const Outcome& run) {
  std::string all;
  for (const Step& step : run.steps) {
    std::string word;
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_ACTION) word = item.u.action.letter + brief(item.u.action.value);
    if (item.kind == NC_ITEM_MOVE) word = "move";
    if (item.kind == NC_ITEM_GATE) {
      static constexpr const char* kNames[] = {"fin", "dwell", "turns", "in-position", "stop", "optional-stop"};
      word = kNames[item.u.gate.kind];
    }
    if (!word.empty()) all += (all.empty() ? "" : " ") + word;
  }
  return all;
}

TEST(Auxiliary, OrderInABlock) {  // S, T, second auxiliary, then M, before the motion
  EXPECT_EQ(order(m700("G0 M3 X1. B5 T2 S1000\nM30")), "S1000 T2 B5 M3 fin move M30 fin");
  EXPECT_EQ(order(m700("G1 X1. M8 M9 F1\nM30")), "M8 fin M9 fin move M30 fin");
}

TEST(Auxiliary, OfFiveCodesTheLastFourCount) {  // M700 9.1
  EXPECT_EQ(m700("M11 M12 M13 M14 M15\nM30").aux(), "M12 M13 M14 M15 M30");
}

TEST(Auxiliary, Ranges) {
  EXPECT_EQ(m700("M99999999 S99999999 T99999999\nM30").aux(), "S99999999 T99999999 M99999999 M30");
  EXPECT_EQ(m700("S-1\nM30").alarm, "P35");
  EXPECT_NE(m700("M123456789\nM30").alarm, "");
}

TEST(Auxiliary, SecondAddress) {  // M700 9.2: not the name of an axis
  EXPECT_EQ(m700("B90\nM30").aux(), "B90 M30");
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZb")).run("A5\nG0 B90.\nM30").aux(), "A5 M30");
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZab")).run("C5\nM30").aux(), "C5 M30");
  EXPECT_EQ(m700("G0 A5\nM30").alarm, "P130");  // in G01 it is an angle (13.8)
}

TEST(Auxiliary, Stops) {  // M700 9.1
  EXPECT_EQ(order(m700("G0 X1. M0\nX2.\nM30")), "move M0 fin stop move M30 fin");
  EXPECT_EQ(order(m700("G0 X1.\nM1\nX2.\nM30")), "move optional-stop move M30 fin");
  EXPECT_EQ(m700("M0\nM30").lines(), (std::vector<unsigned>{1, 2}));
}

TEST(Auxiliary, OneSpindle) {  // M700 10.6.1: S1= and S2= are no form of S
  EXPECT_EQ(m700("S1=100\nM30").alarm, "P33");
  EXPECT_EQ(m700("S2=100\nM30").alarm, "P33");
}

TEST(Auxiliary, CodesThatProhibitReadingAhead) {  // M700 4.2
  Bench bench;
  bench.param("PREREAD_STOP_M1", "55").param("PREREAD_STOP_M8", "66");
  const auto order_of = [&](const char* text) {
    std::string all;
    for (const Step& step : bench.at(0, 0, 0).run(text).steps) {
      if (step.item.kind == NC_ITEM_MOVE) all += "move ";
      if (step.item.kind == NC_ITEM_ACTION) all += step.item.u.action.letter + brief(step.item.u.action.value) + " ";
      if (step.item.kind == NC_ITEM_SYNC) all += "sync ";
    }
    return all;
  };
  EXPECT_EQ(order_of("M55 G0 X1.\nX2.\nM56\nM66\nX3.\nM30"), "M55 move sync move M56 M66 sync move M30 ");
  EXPECT_EQ(order_of("M8\nX2. G0\nM30"), "M8 move M30 ");
}

TEST(Auxiliary, OrderByParameter) {  // M700 9.1: "after or simultaneously with motion" is the machine's
  Bench bench;
  bench.param("MSTB_AFTER_MOTION", "1");
  EXPECT_EQ(order(bench.run("G0 M3 X1. B5 T2 S1000\nM8\nM30")), "move S1000 T2 B5 M3 fin M8 fin M30 fin");
  EXPECT_EQ(order(bench.at(0, 0, 0).run("G0 X1. M0\nX2.\nM30")), "move M0 fin stop move M30 fin");
}

// ---- constant surface speed and clamp (M700 10.3, 10.4) -----------------------------------------------------------------------------

/// A clamp as text, as "G92 S1000 Q200!1": S and Q if they are commanded, and how they act; "free" = there is no clamp any more.
std::string clamp_text(const nc_action& a) {
  const auto how = static_cast<unsigned>(a.value);
  std::string text = (how & (NC_CLAMP_S | NC_CLAMP_Q)) == 0 ? "free" : "clamp";
  if ((how & NC_CLAMP_S) != 0) text += "S" + std::to_string(a.bits);
  if ((how & NC_CLAMP_Q) != 0) text += "Q" + std::to_string(a.mask);
  return (how & 3) == 0 ? text : text + "!" + std::to_string(how & 3);
}

/// The speed commands that the machine gets, as "G96 X 200, S500".
std::string speeds(const Outcome& run) {
  std::string all;
  for (const Step& step : run.steps) {
    if (step.item.kind != NC_ITEM_ACTION) continue;
    const nc_action& a = step.item.u.action;
    std::string word;
    if (a.kind == NC_ACTION_S) word = "S" + brief(a.value);
    if (a.kind == NC_ACTION_CONTROL && a.index == NC_CONTROL_SURFACE_SPEED) word = a.bits == 0 ? "off" : "axis" + std::to_string(std::countr_zero(a.bits) + 1) + ":" + brief(a.value);
    if (a.kind == NC_ACTION_CONTROL && a.index == NC_CONTROL_SPINDLE_CLAMP)
      word = clamp_text(a);
    if (!word.empty()) all += (all.empty() ? "" : " ") + word;
  }
  return all;
}

TEST(SurfaceSpeed, OnAndOff) {  // the manual's example
  EXPECT_EQ(speeds(m700("G90 G96 G01 X50. Z100. S200 F100\nG97 G01 X50. Z100. F300 S500\nM02")), "axis1:200 S200 off S500");
  EXPECT_EQ(speeds(m700("G96 S200\nS300\nG97\nG96\nM30")), "axis1:200 S200 axis1:300 S300 off axis1:300 off");
  EXPECT_EQ(speeds(m700("G20\nG96 S100\nG97\nM30")), "axis1:30.48 S100 off");
}

TEST(SurfaceSpeed, AxisByParameterAndP) {  // #1181 G96_ax
  Bench bench;
  EXPECT_EQ(speeds(bench.run("G96 S100 P3\nG97\nM30")), "axis1:100 S100 off");  // 0: P has no effect
  bench.param("1181", "1");
  EXPECT_EQ(speeds(bench.run("G96 S100\nG97\nM30")), "axis1:100 S100 off");
  EXPECT_EQ(speeds(bench.run("G96 S100 P3\nG97\nM30")), "axis3:100 S100 off");
  EXPECT_EQ(bench.run("G96 S100 P4\nM30").alarm, "P133");
  EXPECT_EQ(bench.run("G96 S100 P0\nM30").alarm, "P133");
}

TEST(SurfaceSpeed, NeedsASpeed) {  // P132
  EXPECT_EQ(m700("G96\nM30").alarm, "P132");
  EXPECT_EQ(m700("G96 S0\nM30").alarm, "P132");
  EXPECT_EQ(m700("S500\nG96\nM30").alarm, "P132");  // r/min are no surface speed
}

TEST(SpindleClamp, WhatG92SIs) {  // 10.4 (Note 1)
  EXPECT_EQ(speeds(m700("G92 S1000\nM30")), "S1000");  // Sclamp 0, G97: a speed
  EXPECT_EQ(speeds(m700("G96 S100\nG92 S1000 Q200\nM30")), "axis1:100 S100 clampS1000Q200 off free");
  EXPECT_EQ(speeds(m700("G92 Q200\nM30")), "clampQ200 free");  // Q is always one
  Bench bench;
  bench.param("1146", "1");
  EXPECT_EQ(speeds(bench.run("G92 S1000\nM30")), "clampS1000!1 free");
  bench.param("1227/bit5", "1");
  EXPECT_EQ(speeds(bench.run("G92 S1000\nM30")), "clampS1000 free");
  EXPECT_EQ(speeds(bench.run("G92 S1000 Q200\nG92 S0\nM30")), "clampS1000Q200 clampS0 free");
  Bench keeping;
  keeping.param("1146", "1").param("1210/bit19", "1");
  EXPECT_EQ(speeds(keeping.run("G92 S1000\nM30")), "clampS1000!3");
  EXPECT_EQ(speeds(keeping.run("G92 Q200\nM30")), "clampQ200!3");  // the S is the machine's
  EXPECT_EQ(m700("G92 Q-1\nM30").alarm, "P35");
}

TEST(SpindleClamp, BesideACoordinateSystem) {
  EXPECT_EQ(m700("G0 X10.\nG92 X0 Q100\nX1.\nM30").path(), (Path{"rapid 10 0 0", "rapid 11 0 0"}));
}

/// On the machine the spindle speed follows the position of the axis.
TEST(SurfaceSpeed, OnTheMachine) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.cycle_s = 0.004;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = 200;
      c.system[0].axis[i].max_velocity = 100;
      c.system[0].axis[i].max_acceleration = 500;
    }
  });
  bench.work_offset(1, {5, 0, 0});
  Drive drive(bench, "G0 X50.\nG96 S100 M3\nG92 S1000 Q300\nG1 X10. F6000\nX0\nG97 S700\nX5.\nM30");
  const nc_outputs& out = drive.out;
  unsigned seen = 0;
  double highest = 0, lowest = 1e9;
  while (drive.cycle < 20000 && !drive.ended) {
    drive.press_start();
    drive.step(50);
    if (out.source.line == 4 || out.source.line == 5) {
      const double free = 1000 * 100 / (2 * 3.14159265358979 * std::max(1e-3, std::fabs(out.command.v[0] - 5)));
      EXPECT_NEAR(out.spindle_rev_min[0], std::min(1000.0, std::max(300.0, free)), 1e-6);
      highest = std::max(highest, out.spindle_rev_min[0]);
      lowest = std::min(lowest, out.spindle_rev_min[0]);
      ++seen;
    }
    if (out.source.line == 7) {
      EXPECT_EQ(out.spindle_rev_min[0], 700);
    }
  }
  EXPECT_TRUE(drive.ended);
  EXPECT_GT(seen, 50u);
  EXPECT_EQ(highest, 1000);
  EXPECT_LT(lowest, 330);
}

TEST(DgshapeAuxiliary, SpindleCodes) {  // DGSHAPE 2-4: R20 series
  auto speed = [](const char* word) { return dgshape(std::string(word) + "\nM02").of(NC_ITEM_ACTION)[0].u.action.value; };
  EXPECT_DOUBLE_EQ(speed("S100"), 100);
  EXPECT_DOUBLE_EQ(speed("S12000"), 12000);
  EXPECT_DOUBLE_EQ(speed("S20"), 10);
  EXPECT_DOUBLE_EQ(speed("S40"), 100);
  EXPECT_DOUBLE_EQ(speed("S60"), 1000);
  EXPECT_DOUBLE_EQ(speed("S80"), 10000);
  EXPECT_DOUBLE_EQ(speed("S01"), 1.12);
  EXPECT_DOUBLE_EQ(speed("S19"), 9);
  EXPECT_DOUBLE_EQ(speed("S98"), 80000);
}

TEST(DgshapeAuxiliary, RepeatedSpindleCodesAreIgnored) {  // DGSHAPE 2-3
  EXPECT_EQ(dgshape("M05\nM03\nM03\nM05\nM05\nM03\nM30").aux(), "M3 M5 M3 M30");
}

TEST(DgshapeAuxiliary, ToolChangeComesAsAPair) {  // DGSHAPE 2-5
  EXPECT_EQ(dgshape("M06T2\nM02").aux(), "T2 M6 M2");
  EXPECT_EQ(dgshape("M06T0\nM02").alarm, "");
  EXPECT_EQ(dgshape("M06\nM02").alarm, "NC-TOOL");
  EXPECT_EQ(dgshape("T2\nM02").alarm, "NC-TOOL");
  EXPECT_EQ(dgshape("M06M06T2\nM02").alarm, "NC-TOOL");
}

TEST(DgshapeAuxiliary, TheToolThatIsThereIsNotFetchedAgain) {  // DGSHAPE M06
  EXPECT_EQ(dgshape("M06T2\nM06T2\nM06T3\nM06T2\nM06T0\nM02").aux(), "T2 M6 T3 M6 T2 M6 T0 M6 M2");
}

TEST(DgshapeAuxiliary, TheListOfCodesIsComplete) {  // DGSHAPE 2-7
  EXPECT_EQ(dgshape("M12\nM13\nM14\nM15\nM16\nM17\nM02").aux(), "M12 M13 M14 M15 M16 M17 M2");
  for (const char* code : {"M04", "M07", "M08", "M09", "M10", "M11", "M18", "M19", "M31", "M98", "M99", "M100"})
    EXPECT_EQ(dgshape(std::string("G0X1.\n") + code + "\nM02").alarm, "NC-NO-SUCH-CODE") << code;
}

TEST(DgshapeOffsets, LengthsAndDiametersAreApart) {  // DGSHAPE G10, G43: a program sets diameters alone
  Bench bench(NC_DIALECT_DGSHAPE);
  bench.tool(1, 10, NC_TOOL_LENGTH);
  EXPECT_EQ(bench.run("%\nG10P1R4.\nG43H1Z1.\nG49Z0\nG41D1G00X10.\nX20.\nM02").path(),
            (Path{"rapid 0 0 11", "rapid 0 0 0", "rapid 10 4 0", "rapid 20 4 0"}));
}

// DGSHAPE 1-4: a circle through the tool about the origin of Y and Z is passed at F, from where the block begins.
TEST(DgshapeFeed, OfTheRotaryAxisGoesByTheRadius) {
  const auto feeds = [](const std::string& text) {
    std::string all;
    const auto machine = [](nc_config& config) {
      axes("XYZa")(config);
      config.system[0].axis[2].reference[0] = 100;  // the highest position of Z, where F does not count
    };
    for (const std::string& move : Bench(NC_DIALECT_DGSHAPE, machine).run("%\nG21G90F100.\n" + text + "\nM02").path())
      if (const size_t at = move.find(" F"); at != std::string::npos) all += move.substr(at);
    return all;
  };
  const auto degrees = [](double radius) { return " F" + brief(100 / radius * 180 / 3.14159265358979323846); };
  EXPECT_EQ(feeds("G00Z40.\nG01A90."), degrees(40));
  EXPECT_EQ(feeds("G00Y30.Z40.\nG01A90."), degrees(50));
  const double way = 40 * 3.14159265358979323846 / 2;
  EXPECT_EQ(feeds("G00Z40.\nG01X30.A90."), " F" + brief(100 * 30 / std::hypot(30, way)));
}

TEST(DgshapeAuxiliary, StandAloneCodes) {  // DGSHAPE 2-3
  for (const char* code : {"M00", "M01", "M02", "M30"}) {
    EXPECT_EQ(dgshape(std::string(code) + "G0X1000\nM02").alarm, "NC-ALONE") << code;
    EXPECT_EQ(dgshape("N10" + std::string(code) + "\nM02").alarm, "") << code;
  }
  EXPECT_EQ(dgshape("M03M12\nM02").aux(), "M3 M12 M2");
}

TEST(DgshapeAuxiliary, NoSubPrograms) {
  EXPECT_EQ(dgshape("M98P1\nM02").alarm, "NC-NO-SUCH-CODE");
  EXPECT_EQ(dgshape("M99\nM02").alarm, "NC-NO-SUCH-CODE");
}

}  // namespace
}  // namespace nc::test
