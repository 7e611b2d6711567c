// SPDX-License-Identifier: Apache-2.0
// The curves and modes of M700 chapter 6 beyond lines, arcs and helices: what their words mean, and which exclude each other.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// Runs the text with all axes at 0 before it.
Outcome from_zero(Bench& bench, const std::string& text) { return bench.at(0, 0, 0).run(text); }

Bench rotary_bench() {
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1516", "C").param("1030", "C").param("1514", "X").param("1515", "C");
  return bench;
}

TEST(Plane, AxesOfAPairAreThoseNamedWithTheCode) {  // M700 6.3
  Bench bench(NC_DIALECT_M700, axes("XYZUV"));
  bench.param("1029", "U").param("1031", "V");
  const std::string end = " R10. F100\nM30";
  EXPECT_EQ(from_zero(bench, "G18 G3 X10. V10." + end).moves()[0].plane_axis[0], 4);  // V horizontal
  EXPECT_EQ(from_zero(bench, "G17 G2 U10. Y10." + end).moves()[0].plane_axis[0], 3);
  EXPECT_EQ(from_zero(bench, "G17 G2 U10. X10. Y10." + end).moves()[0].plane_axis[0], 0);      // the basic axis wins
  EXPECT_EQ(from_zero(bench, "G0 G17 U0\nG1 X0 F9\nG2 X10. U10. Y10." + end).moves()[0].plane_axis[0], 3);  // a block without a code changes nothing
  EXPECT_EQ(from_zero(bench, "G0 G17 U0\nG17\nG2 X10. Y10." + end).moves()[0].plane_axis[0], 0);
  EXPECT_EQ(from_zero(bench, "G1 G41 X5. F9\nG17 U1.\nM30").alarm, "P170");
  bench.tool(1, 2);
  EXPECT_EQ(from_zero(bench, "G1 G41 D1 X5. F9\nX9.\nG17 U1.\nM30").alarm, "P112");
}

TEST(Helix, FeedInThePlaneOfTheArcIsAskedForByParameter) {  // M700 6.6: the trace shows the F commanded
  Bench bench;
  bench.param("1235/bit0", "1");
  const nc_move m = from_zero(bench, "G2 X20. Z10. I10. F100\nM30").moves()[0];
  EXPECT_EQ(m.feed_mm_min, 100);
  EXPECT_EQ(m.kind, NC_MOVE_HELIX);
}

TEST(InPosition, WidthOfTheBlock) {  // M700 6.1, 6.2
  const auto gates = [](const Outcome& run) {
    std::vector<double> widths;
    for (const Step& step : run.steps)
      if (step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_IN_POSITION) widths.push_back(step.item.u.gate.value);
    return widths;
  };
  EXPECT_EQ(gates(m700("G0 X1. ,I0.05\nX2.\nM30")), std::vector<double>{0.05});
  EXPECT_EQ(gates(m700("G1 X1. F9 ,I50\nM30")), std::vector<double>{});  // no deceleration check here
  EXPECT_EQ(gates(m700("G9 G1 X1. F9 ,I50\nM30")), std::vector<double>{0.05});
  EXPECT_EQ(m700("G2 X1. R1. F9 ,I50\nM30").alarm, "P32");
  EXPECT_EQ(m700("G0 X1. ,I0\nM30").alarm, "P35");
}

TEST(Thread, LeadAndItsModal) {  // M700 6.7
  Bench bench;
  Outcome run = from_zero(bench, "G1 X0 F300\nG33 Z-20. F1.5 Q90.\nG0 Z0\nG33 Z-20.\nG1 X5.\nM30");
  EXPECT_EQ(run.alarm, "");
  std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 4u);
  EXPECT_EQ(m[0].kind, NC_MOVE_THREAD);
  EXPECT_EQ(m[0].feed_mm_rev, 1.5);
  EXPECT_EQ(m[0].feed_mm_min, 0);
  EXPECT_EQ(m[2].feed_mm_rev, 1.5);
  EXPECT_EQ(m[3].feed_mm_min, 300);  // the lead is not the feed
  EXPECT_DOUBLE_EQ(from_zero(bench, "G33 Z-20. E3.\nM30").moves()[0].feed_mm_rev, 25.4 / 3);
  EXPECT_DOUBLE_EQ(from_zero(bench, "G20 G33 Z-1. F0.1\nM30").moves()[0].feed_mm_rev, 2.54);
  EXPECT_EQ(from_zero(bench, "G33 Z-20.\nM30").alarm, "P62");
  EXPECT_EQ(from_zero(bench, "G33 Z-20. F1000.\nM30").alarm, "P93");
  EXPECT_EQ(from_zero(bench, "G33 Z-20. E0\nM30").alarm, "P93");
  bench.param("1229/bit1", "1");
  EXPECT_EQ(from_zero(bench, "G33 Z-20. E1.25\nM30").moves()[0].feed_mm_rev, 1.25);
  EXPECT_EQ(from_zero(bench, "G33 Z-20. X10. E1.25\nX20. Z-40.\nM30").moves().size(), 2u);  // modal: the next block is a thread too
}

TEST(Thread, RidgesAreALeadInItsRange) {  // M700 6.7.1 table, 6.7.2 (3)
  Bench bench;
  EXPECT_EQ(from_zero(bench, "G33 Z-20. E0.03\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, "G33 Z-20. E0.02\nM30").alarm, "P93");  // 1270 mm
  EXPECT_EQ(from_zero(bench, "G33 Z-20. E999.99\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, "G33 Z-20. E1000.\nM30").alarm, "P93");
  EXPECT_EQ(from_zero(bench, "G20 G33 Z-1. E1000.\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, "G20 G33 Z-1. E0.0101\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, "G20 G33 Z-1. E0.0099\nM30").alarm, "P93");  // 101 inch
}

TEST(Thread, NoLeadIsMissingWhereNothingIsCut) {
  Bench bench;
  EXPECT_EQ(from_zero(bench, "G33 G28 X3.\nM8\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, "G33\nZ-3.\nM30").alarm, "P62");
}

TEST(PolarCommand, RadiusAndAngle) {  // M700 6.12
  EXPECT_EQ(m700("G16 G0 X100. Y30.\nG91 Y60.\nM30").path().back(), "rapid 0 100 0");
  const nc_move pole = m700("G0 X30. Y40.\nG16 G91 X25. Y90.\nM30").moves().back();  // from the present place, with an angle 90 degrees larger
  EXPECT_NEAR(pole.work.v[0], 30 - 20, 1e-9);
  EXPECT_NEAR(pole.work.v[1], 40 + 15, 1e-9);
  const nc_move arc = m700("G16 G0 X20. Y0\nG3 X20. Y90. R20. F100\nM30").moves().back();
  EXPECT_NEAR(arc.work.v[1], 20, 1e-9);
  EXPECT_NEAR(arc.sweep_deg, 90, 1e-9);
  EXPECT_EQ(m700("G16 G0 X0 Y0\nZ5.\nM30").path(), Path{"rapid 0 0 5"});
  EXPECT_EQ(m700("G5 P10000\nG16\nM30").alarm, "P34");
  EXPECT_EQ(m700("G16\nG5 P10000\nM30").alarm, "P34");
  EXPECT_EQ(m700("G16\nG5.1 Q1\nM30").alarm, "P34");
  EXPECT_EQ(m700("G5 P4\nM30").alarm, "P35");
  EXPECT_EQ(m700("G5\nM30").alarm, "P33");
}

TEST(PolarCommand, WordsBesideCodesThatTheListDoesNotName) {  // M700 6.12, "axis command not interpreted as polar coordinate command"
  for (const char* code : {"G69", "G50", "G60", "G61", "G40 G17"}) EXPECT_EQ(m700(std::string("G16\n") + code + " G0 X5. Y90.\nM30").path().back(), "rapid 0 5 0") << code;
  EXPECT_EQ(m700("G68 X0 Y0 R90.\nG16\nG69 G0 X5. Y90.\nM30").path(), Path{"rapid 0 5 0"});
  EXPECT_EQ(m700("G51 X0 Y0 P2.\nG16\nG50 G0 X5. Y90.\nM30").path(), Path{"rapid 0 5 0"});
  Bench bench;
  bench.tool(1, 1.0);
  EXPECT_EQ(bench.run("G16\nG45 G0 X5. Y45. D1\nM30").path(), Path{"rapid 4.535534 4.535534 0"});
  EXPECT_EQ(m700("G16\nG0\nG34 X20. Y90. I5. J0 K2\nM30").path(), (Path{"rapid 5 20 0", "rapid -5 20 0"}));
  EXPECT_EQ(m700("G16\nG0\nG35 X20. Y90. I5. J0 K2\nM30").path(), (Path{"rapid 0 20 0", "rapid 5 20 0"}));
  for (const char* plain : {"G53", "G28", "G52", "G92"}) EXPECT_EQ(m700(std::string("G16\nG0\n") + plain + " X5. Y9.\nM30").alarm, "") << plain;
  EXPECT_EQ(m700("G16\nG0\nG53 X5. Y9.\nM30").path(), Path{"rapid 5 9 0"});
}

TEST(PolarCommand, AResetKeepsItByParameter) {  // M700 6.12 (3) #1210 bit 11
  Bench bench;
  bench.at(0, 0, 0).run("G16 G0 X10. Y90.\nM30");
  EXPECT_EQ(bench.run("G0 X20. Y5.\nM30").path(), (Path{"rapid 20 5 0"}));
  bench.param("1210/bit11", "1").run("G16\nM30");
  EXPECT_EQ(bench.run("G0 X10. Y90.\nM30").path(), (Path{"rapid 0 10 0"}));
}

TEST(Spiral, OfARotaryAxisThereIsNoneInInch) {  // 3.2 note 5 says of arcs alone how long a degree is
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1030", "C");
  EXPECT_EQ(bench.run("G21 G90 G17 X0 C0 F100.\nG2.1 X20. C10. I0 J10. P1\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("G20 G90 G17 G1 X0 C0 F10.\nG2.1 X2. C10. I0 J10. P1\nM30").alarm, "P39");
  EXPECT_EQ(bench.at(0, 0, 0).run("G20 G90 G17 G1 X0 Y0 F10.\nG2.1 X2. Y1. I0 J1. P1\nM30").alarm, "");
}

TEST(Spiral, TurnsOfBothTypes) {  // M700 6.13
  Bench bench;
  nc_move m = from_zero(bench, "G2.1 X60. I100. P2 F300\nM30").moves()[0];
  EXPECT_EQ(m.kind, NC_MOVE_SPIRAL);
  EXPECT_NEAR(m.sweep_deg, -720, 1e-9);
  EXPECT_EQ(m.radius, 100);
  m = from_zero(bench, "G3.1 X100. Y-40. Z7. I100. F300\nM30").moves()[0];  // from 180 to 270 deg
  EXPECT_NEAR(m.sweep_deg, 90, 1e-9);
  EXPECT_EQ(from_zero(bench, "G2.1 X60. I100. P100 F300\nM30").alarm, "P35");
  EXPECT_EQ(from_zero(bench, "G2.1 X60. P1 F300\nM30").alarm, "P33");
  EXPECT_EQ(from_zero(bench, "G2 X60. I100. Q-30. F300\nM30").alarm, "P70");  // type 1: Q says nothing
  bench.param("1272/bit2", "1").param("8075", "0.1");
  EXPECT_NEAR(from_zero(bench, "G2 X60. I100. Q-30. F300\nM30").moves()[0].sweep_deg, -720, 1e-9);
  EXPECT_EQ(from_zero(bench, "G2 X60. I100. Q30. F300\nM30").alarm, "P33");
  for (const char* corner : {",R2.", ",C2."}) {  // "if issued during the corner chamfering/corner rounding command"
    EXPECT_EQ(from_zero(bench, std::string("G2 X60. I100. Q-30. F300 ") + corner + "\nG1 X90.\nM30").alarm, "P33") << corner;
    for (const char* option : {"1", "0"}) {
      bench.param("corner_ii", option);
      EXPECT_EQ(from_zero(bench, std::string("G2 X60. I100. L2 F300 ") + corner + "\nG1 X90.\nM30").alarm, "P33") << corner;
    }
    bench.param("corner_ii", "1");
    EXPECT_EQ(from_zero(bench, std::string("G2 X60. I100. F300 ") + corner + "\nG1 X90.\nM30").alarm, "P33") << corner;
    bench.param("corner_ii", "0");
  }
  EXPECT_EQ(from_zero(bench, "G2 X60. I100. Q-40. F300\nM30").alarm, "P70");  // a turn and a half would end elsewhere
  EXPECT_NEAR(from_zero(bench, "G2 X60. Z50. I100. K25. L9 F300\nM30").moves()[0].sweep_deg, -720, 1e-9);  // Q before K before L
  EXPECT_EQ(from_zero(bench, "G2 X60. Z50. I100. K-25. F300\nM30").alarm, "P33");
  EXPECT_NEAR(from_zero(bench, "G2 X60. I100. L4 F300\nM30").moves()[0].sweep_deg, -1080, 1e-9);
  EXPECT_EQ(from_zero(bench, "G2.1 X60. I100. P2 F300\nM30").alarm, "P34");
  EXPECT_EQ(from_zero(bench, "G2 X20. I10. F300\nM30").path(), Path{"cw 20 0 0 c10,0 F300"});
  EXPECT_NEAR(from_zero(bench, "G2 X160. I100. F300\nM30").moves()[0].sweep_deg, -180, 1e-9);  // L1: less than a turn
}

TEST(Cylinder, DegreesOnTheSurface) {  // M700 6.9
  Bench bench = rotary_bench();
  Outcome run = from_zero(bench, "G0 X30. Z0\nG19 Z0 C0\nG7.1 C30.\nG1 Z-10. C90. F100\nG2 Z-20. C120. R40.\nG7.1 C0\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 3u);
  EXPECT_NEAR(m[1].machine.v[3], 90, 1e-9);
  EXPECT_NEAR(m[1].length, std::hypot(10, 30 * std::numbers::pi / 2), 1e-9);
  EXPECT_NEAR(m[2].work.v[3], 120, 1e-9);
  EXPECT_EQ(m[2].kind, NC_MOVE_ARC);
  EXPECT_NEAR(m[2].radius, 40, 1e-9);
  EXPECT_EQ(run.last_modal().code[2], 190);
  EXPECT_EQ(from_zero(bench, "G7.1 C30.\nG1 Z-10. F100\nM30").alarm, "P485");  // no plane with the axis
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30.\nG2 Z-10. C20. J5. F100\nM30").alarm, "P33");
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30.\nG1 Y5. F100\nM30").alarm, "P482");
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30. G90\nM30").alarm, "P33");
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30.\nG54\nM30").alarm, "P481");
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30.\nT3\nM30").alarm, "P485");
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30.\nG7.1 C20.\nM30").alarm, "P481");
  EXPECT_EQ(from_zero(bench, "G0 G19 Z0 C0\nG7.1 C30. Z5.\nM30").alarm, "P33");  // an independent block
  EXPECT_EQ(from_zero(bench, "G12.1 X5.\nM30").alarm, "P33");
}

TEST(Cylinder, PlaneByTheNamesOfItsAxes) {  // M700 6.9 (4) prints G19 Z C
  Bench bench = rotary_bench();
  const Outcome run = from_zero(bench, "G0 G19 Z C\nG7.1 C20.\nG1 Z-5. C90. F100\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_NEAR(run.moves()[0].machine.v[3], 90, 1e-9);
}

TEST(Polar, AxesGoToRadiusAndAngle) {  // M700 6.10
  Bench bench = rotary_bench();
  bench.param("1517", "1");
  const auto from_start = [&bench](const std::string& text) { return bench.at(30, 0, 0, 50).run(text); };
  Outcome run = from_start("G12.1\nG1 X0 C20. F100\nX-20. C0\nG3 X20. C0 R20.\nG13.1\nG0 X50.\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 4u);
  EXPECT_NEAR(m[0].machine.v[0], 20, 1e-9);
  EXPECT_NEAR(m[0].machine.v[3], 140, 1e-9);
  EXPECT_NEAR(m[1].machine.v[3], 230, 1e-9);
  EXPECT_NEAR(m[2].machine.v[3], 410, 1e-9);  // on, never back
  EXPECT_NEAR(m[2].machine.v[0], 20, 1e-9);
  EXPECT_EQ(m[3].machine.v[0], 50);
  EXPECT_EQ(from_start("G12.1\nG1 X-30. F100\nM30").alarm, "P486");  // through the centre the angle would jump
  EXPECT_EQ(from_start("G12.1\nG1 X0 F100\nX5.\nM30").alarm, "");
  EXPECT_EQ(from_start("G12.1\nG1 X0 F100\nX5. C5.\nM30").alarm, "P486");
  EXPECT_EQ(from_start("G12.1\nG12.1\nM30").alarm, "P486");
  bench.param("1517", "0");
  run = from_start("G12.1\nG1 X20. Y20. F100\nG13.1\nY3.\nM30");  // Y commands the plane, then itself again
  EXPECT_EQ(run.alarm, "");
  EXPECT_NEAR(run.moves()[0].machine.v[3], 50 + 45, 1e-9);
  EXPECT_NEAR(run.moves()[0].machine.v[0], std::hypot(20, 20), 1e-9);
  EXPECT_EQ(run.moves()[1].machine.v[1], 3);
}

TEST(Polar, ItsHypotheticalAxisIsALength) {
  Bench bench = rotary_bench();
  bench.param("1517", "1").param("2106", "5", 'C').param("8213", "0", 'C');
  const auto from_start = [&bench](const std::string& text) { return bench.at(30, 0, 0, 0).run(text); };
  // F is inch/min in the plane even if only the hypothetical axis moves (6.10 (5)); outside the mode a rotary axis has a unit of 10 deg (3.2 note 6).
  Outcome run = from_start("G20\nG12.1\nG1 C0.25 F10\n#101=#5004\nC-0.25\n#102=#5004\nG13.1\nG1 C5.\nM30");
  EXPECT_EQ(run.alarm, "");  // nor is 0.25 a position that #2106 knows
  EXPECT_EQ(run.moves()[0].feed_mm_min, 254);
  EXPECT_EQ(run.moves()[2].feed_mm_min, 100);
  EXPECT_NEAR(run.var(102), -6.35, 1e-9);  // no angle within one turn (14.13)
  EXPECT_EQ(from_start("G12.1\nG16\nM30").alarm, "P485");  // (7) (b): "G16 to G19"
  Bench cylinder = rotary_bench();
  run = cylinder.at(0, 0, 0, 0).run("G0 G19 Z0 C0\nG20\nG7.1 C1.\nG1 C90. F10\nM30");
  EXPECT_EQ(run.moves()[0].feed_mm_min, 254);  // 6.9 (6)
}

TEST(Exponential, ExcludesOtherCodes) {  // M700 6.11, precaution (3)
  Bench bench = rotary_bench();
  bench.tool(1, 2);
  const std::string curve = "G91 G2.3 X10. I50. J80. R105. F500\n";
  for (const char* code : {"G41 D1", "G42 D1", "G51 X0 P2.", "G51.1 X0", "G68 X0 Y0 R10."})
    EXPECT_EQ(from_zero(bench, curve + code + "\nM30").alarm, "P612") << code;
  EXPECT_EQ(from_zero(bench, curve + "G41 D1 G0 X5.\nX9.\nG40 X1.\nM30").alarm, "");  // the block leaves the curve
  EXPECT_EQ(from_zero(bench, "M98 H5 I1. J1.\nM30\nN5 " + curve + "M99").alarm, "P612");  // figure rotation
}

TEST(Exponential, AngleOfTheRotaryAxis) {  // M700 6.11: i 50, j 80, r 105, x 100: 206.802 deg
  Bench bench = rotary_bench();
  const nc_move m = from_zero(bench, "G91 G2.3 X100. Z100. I50. J80. R105. F500 Q700\nM30").moves()[0];
  EXPECT_EQ(m.kind, NC_MOVE_EXPONENTIAL);
  EXPECT_NEAR(m.machine.v[3], 206.802, 1e-3);
  EXPECT_EQ(m.machine.v[2], 100);
  EXPECT_EQ(m.feed_mm_min, 500);
  EXPECT_NEAR(from_zero(bench, "G91 G3.3 X100. I50. J80. R105. F500\nM30").moves()[0].machine.v[3], -206.802, 1e-3);
  EXPECT_EQ(from_zero(bench, "G91 G2.3 Z10. I50. J80. R105. F500\nM30").moves()[0].kind, NC_MOVE_LINE);
  EXPECT_EQ(from_zero(bench, "G91 G2.3 X10. C5. I50. J80. R105. F500\nM30").moves()[0].kind, NC_MOVE_LINE);
  EXPECT_EQ(from_zero(bench, "G91 G2.3 X10. I50. J80. F500\nM30").alarm, "P33");
  EXPECT_EQ(from_zero(bench, "G91 G2.3 X10. I90. J80. R5. F500\nM30").alarm, "P35");
  EXPECT_EQ(from_zero(bench, "G91 G2.3 X10. I50. J80. R5. F500 Q0\nM30").alarm, "P35");
  EXPECT_EQ(from_zero(bench, "G91 G2.3 X-100. I50. J80. R105. F500\nM30").alarm, "P612");
  EXPECT_EQ(from_zero(bench, "G91 G2.3 X10. I50. J80. R5. F500\nG1 X5.\nM30").alarm, "P62");  // its F is not modal
}

TEST(SpaceArc, ThreePointsOverTwoBlocks) {  // M700 6.14
  Bench bench;
  const Outcome run = from_zero(bench, "G2.4 X10. Y10. F100\nX20. Y0\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 2u);
  EXPECT_EQ(m[0].center_axes, 3);
  EXPECT_NEAR(m[0].center[0], 10, 1e-9);
  EXPECT_NEAR(m[0].center[1], 0, 1e-9);
  EXPECT_NEAR(m[0].length, 5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(m[1].length, 5 * std::numbers::pi, 1e-9);
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{1, 2, 3}));  // each block ends where its point is
  // Tangents at the joint: the middle of a circle about (10, 0).
  EXPECT_EQ(from_zero(bench, "G2.4 X10. F100\nX20.\nM30").moves()[0].kind, NC_MOVE_LINE);
  EXPECT_EQ(from_zero(bench, "G2.4 X10. Y5. F100\nX0 Y0\nM30").moves()[1].kind, NC_MOVE_LINE);  // out and back
  EXPECT_EQ(from_zero(bench, "G2.4 X10. Y5. F100\nM30").alarm, "P74");
  EXPECT_EQ(from_zero(bench, "G91 G2.4 X10. Y10. F100\nX10. Y-10.\nM30").moves()[1].machine.v[0], 20);
  EXPECT_EQ(from_zero(bench, "G16\nG2.4 X10. Y5. F100\nM30").alarm, "P75");
}

TEST(SpaceArc, ABlockThatLeavesItMayHaveAnyCode) {
  Bench bench;
  bench.tool(1, 2);
  const std::string arc = "G2.4 X10. Y10. F100\nX20. Y0\n";
  EXPECT_EQ(from_zero(bench, arc + "G43 H1 G0 Z50.\nM30").alarm, "");  // whatever the order of its words
  EXPECT_EQ(from_zero(bench, arc + "G0 G43 H1 Z50.\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, arc + "G43 H1 Z50.\nM30").alarm, "P75");
  EXPECT_EQ(from_zero(bench, "G66.1 P5\n" + arc + "G67\nM30\nO5\nM99").alarm, "P75");  // 6.14 (b)
}

TEST(SpaceArc, NoLineStandsBetweenItsBlocks) {  // P74
  Bench bench;
  for (const char* line : {"G1 X5.", "G0 X5. Y2.", "G1 X5. F300", "G2 X9. R9.", "M8", "G54"}) {
    const Outcome run = from_zero(bench, std::string("G2.4 X10. Y10. F100\n") + line + "\nX20. Y0\nM30");
    EXPECT_EQ(run.alarm, "P74") << line;
    EXPECT_EQ(run.alarm_line, 2u) << line;
    EXPECT_EQ(run.moves().size(), 0u) << line;
  }
}

TEST(Nurbs, NoLineStandsInsideOfIt) {  // 6.15, relation with other functions (1)
  Bench bench;
  bench.param("1267/bit0", "1");
  const std::string head = "G5 P10000\nG1 X0 Y0 Z0 F300\nG6.2 P2 X0 Y0 R1. K0\n";
  for (const char* line : {"G1 X5.", "G0 X5. Y2.", "G1 X5. F300"}) {
    const Outcome run = from_zero(bench, head + line + "\nX10. R1. K0\nK1\nK1\nG5 P0\nM30");
    EXPECT_EQ(run.alarm, "P33") << line;
    EXPECT_EQ(run.alarm_line, 4u) << line;
  }
}

TEST(SpaceArc, EachBlockHasItsFeed) {
  Bench bench;
  const std::vector<nc_move> m = from_zero(bench, "G2.4 X10. Y10. F100\nX20. Y0 F200\nX30. Y10.\nX40. Y0\nM30").moves();
  ASSERT_EQ(m.size(), 4u);
  EXPECT_EQ(m[0].feed_mm_min, 100);
  EXPECT_EQ(m[1].feed_mm_min, 200);
  EXPECT_EQ(m[2].feed_mm_min, 200);
  bench.param("1079", "1").param("1185", "70");
  EXPECT_EQ(from_zero(bench, "G2.4 X10. Y10. F1\nX20. Y0 F200\nM30").moves()[0].feed_mm_min, 70);
}

TEST(SpaceArc, GoesOnFromItsMiddle) {
  Bench bench;
  const std::string text = "G2.4 X10. Y10. F100\nX20. Y0\nM30";
  const Outcome whole = from_zero(bench, text);
  bench.at(0, 0, 0).start(text);
  Step step;
  while (bench.pull(&step) == NC_OK && step.item.kind != NC_ITEM_MARK) continue;
  ASSERT_EQ(step.item.source.line, 1u);
  nc_axes machine = step.machine;
  ASSERT_EQ(bench.rewind(step.item.serial, machine), NC_OK);
  const Outcome rest = bench.finish();
  ASSERT_EQ(rest.moves().size(), 1u);
  EXPECT_EQ(rest.moves()[0].machine_start.v[0], whole.moves()[1].machine_start.v[0]);
  EXPECT_EQ(rest.moves()[0].length, whole.moves()[1].length);
  EXPECT_EQ(rest.moves()[0].machine.v[0], 20);
}

TEST(Nurbs, EndsOnTheLastPointAndOnItsCurve) {  // M700 6.15
  Bench bench;
  const std::string head = "G5 P10000\nG1 X0 F300\n";
  // A quarter of a circle: weights 1, 1/sqrt 2 (to four decimals), 1.
  Outcome run = from_zero(bench, head + "G6.2 P3 K0 X0 Y0 R1.\nK0 X10. Y0 R0.7071\nK0 X10. Y10. R1.\nK1\nK1\nK1\nM30");
  EXPECT_EQ(run.alarm, "");
  std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 1u);
  EXPECT_EQ(m[0].kind, NC_MOVE_NURBS);
  EXPECT_NEAR(m[0].length, 5 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(m[0].machine.v[0], 10, 1e-12);
  EXPECT_NEAR(m[0].machine.v[1], 10, 1e-12);
  // Order 2: the polygon of its points.
  run = from_zero(bench, head + "G6.2 P2 K0 X10. Y10. R1.\nM30");
  EXPECT_EQ(run.alarm, "P552");
  m = from_zero(bench, "G5 P10000\nG6.2 P2 K0 X0 Y0 F100\nK0 X3. Y4.\nK1 X6. Y8.\nK2\nK2\nM30").moves();
  ASSERT_EQ(m.size(), 2u);
  EXPECT_NEAR(m[0].length, 5, 1e-12);
  EXPECT_NEAR(m[1].length, 5, 1e-12);
  EXPECT_EQ(from_zero(bench, "G5 P10000\nG6.2 P2 K0 X0 F100\nX8.\nM30").alarm, "P33");     // no knot
  EXPECT_EQ(from_zero(bench, "G5 P10000\nG6.2 P2 K0 X0 F100\nX8. K0 R0\nM30").alarm, "P35");
  EXPECT_EQ(from_zero(bench, "G5 P10000\nG6.2 P2 K0 X0 F100\nX8. K0.00005\nM30").alarm, "P33");
  EXPECT_EQ(from_zero(bench, "G5 P10000\nG6.2 P2 K0 X0 F100\nX8. K0 M8\nM30").alarm, "P33");
}

TEST(Nurbs, ReadAgainFromItsMiddleIsTheSameCurve) {
  Bench bench;
  const std::string text =
      "G5 P10000\nG6.2 P4 K0 X0 Y0 F100\nK0 X2. Y3.\nK0 X5. Y4.\nK0 X7. Y1.\nK1 X9. Y0\nK2 X12. Y2.\nK3 X15. Y5.\nK4 X16. Y9.\nK5\nK5\nK5\nK5\nM30";
  const Outcome whole = from_zero(bench, text);
  ASSERT_EQ(whole.moves().size(), 5u);
  for (const unsigned back : {3u, 5u, 7u, 9u}) {
    bench.at(0, 0, 0).start(text);
    Step step, mark;
    while (bench.pull(&step) == NC_OK && step.item.source.line < 10)
      if (step.item.kind == NC_ITEM_MARK && step.item.source.line == back) mark = step;
    ASSERT_EQ(bench.rewind(mark.item.serial, mark.machine), NC_OK);
    const std::vector<nc_move> rest = bench.finish().moves(), all = whole.moves();
    ASSERT_LE(rest.size(), all.size());
    for (size_t i = 0; i < rest.size(); ++i) {
      const nc_move& same = all[all.size() - rest.size() + i];
      EXPECT_EQ(rest[i].length, same.length) << back;
      for (unsigned axis = 0; axis < 2; ++axis) EXPECT_EQ(rest[i].machine.v[axis], same.machine.v[axis]) << back;
    }
    EXPECT_EQ(rest.back().machine.v[1], 9);
  }
}

TEST(Hypothetical, TheAxisStaysAndComesBackToItself) {  // M700 6.16
  Bench bench;
  const Outcome run = from_zero(bench, "G7 Y0\nG2 X10. Y-10. Z20. J-10. F100\nG1 Y5.\nG7 Y1\nY3.\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 3u);
  EXPECT_EQ(m[0].machine.v[1], 0);
  EXPECT_EQ(m[0].machine.v[0], 10);
  EXPECT_EQ(m[1].machine.v[1], 0);
  EXPECT_NEAR(m[1].length, 15, 1e-12);  // the held axis counts as if it moved
  EXPECT_EQ(m[2].machine.v[1], 3);
}

TEST(Hypothetical, AResetLeavesTheAxisWhereItIs) {
  Bench bench;
  bench.at(0, 0, 0).run("G7 Y0\nG1 Y5. X2. F100\nM30");
  EXPECT_EQ(bench.run("G91 G0 Y1. X1.\nM30").path(), (Path{"rapid 3 1 0"}));
}

TEST(Hypothetical, TheNameOfAnAxisAloneIsOn) {  // M700 6.16 (4)
  Bench bench;
  EXPECT_EQ(from_zero(bench, "G7 Y\nG1 X5. Y5. F100\nM30").moves()[0].machine.v[1], 0);
  EXPECT_EQ(from_zero(bench, "G1 Y F100\nM30").alarm, "P33");
}

TEST(Unidirectional, TheLastStretchHasItsDirection) {  // M700 6.8
  Bench bench;
  bench.param("8209", "-2", 'X');
  EXPECT_EQ(bench.run("G60 X10. Y5.\nM30").path(), (Path{"rapid 12 5 0", "rapid 10 5 0"}));
  EXPECT_EQ(bench.run("G60 X10.\nM30").path(), (Path{"rapid 12 5 0", "rapid 10 5 0"}));  // also where nothing is left to go
  EXPECT_EQ(bench.run("G60 Y0\nM30").path(), (Path{"rapid 10 0 0"}));
}

TEST(Curves, ResetEndsEveryMode) {
  Bench bench = rotary_bench();
  bench.param("1517", "1").at(30, 0, 0, 0);
  EXPECT_EQ(bench.run("G12.1\nG1 X20. C5. F100\nG16").alarm, "P485");
  EXPECT_EQ(bench.run("G1 C90. F100\nM30").path().back().substr(0, 4), "line");
  EXPECT_NEAR(bench.run("G0 C45.\nM30").moves().back().machine.v[3], 45, 1e-12);
}

}  // namespace
}  // namespace nc::test
