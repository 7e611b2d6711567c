// SPDX-License-Identifier: Apache-2.0
// Measurement: G31.1 to G31.3, speed change skip, dwells that a signal ends, G37, current limits (M700 15).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

// ---- multi-step skip (15.3) ------------------------------------------------------------------------------------------------

TEST(MultiSkip, FeedsAndSignalsByParameter) {
  Bench bench;
  bench.param("1174", "999").param("1176", "20").param("1178", "5").param("1180", "1");
  bench.param("1175", "7").param("1177", "3").param("1179", "1");
  const Outcome run = bench.run("G91\nG31.1 X200.\nG31.2 X40.\nG31.3 X1.\nG31.3 X1. F8\nM30");
  EXPECT_EQ(run.path(), (Path{"skip 200 0 0 F20", "skip 240 0 0 F5", "skip 241 0 0 F1", "skip 242 0 0 F8"}));
  EXPECT_EQ(run.moves()[0].skip_mask, 7);
  EXPECT_EQ(run.moves()[1].skip_mask, 3);
  EXPECT_EQ(run.moves()[2].skip_mask, 1);
}

TEST(MultiSkip, SignalsWithoutParameters) {
  const std::vector<nc_move> moves = m700("G31.1 X1. F1\nG31.2 X2. F1\nG31.3 X3. F1\nM30").moves();
  EXPECT_EQ(moves[0].skip_mask, 1);
  EXPECT_EQ(moves[1].skip_mask, 2);
  EXPECT_EQ(moves[2].skip_mask, 4);
}

TEST(MultiSkip, Alarms) {
  EXPECT_EQ(m700("G31.1 X1.\nM30").alarm, "P603");
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G1 G41 D1 X10. F100\nX20.\nG31.2 X30. F10\nM30").alarm, "P608");
}

TEST(MultiSkip, ADwellEndsWithItsSignal) {  // 15.4: #1173
  Bench bench;
  bench.param("1173", "5");
  bool seen = false;
  for (const Step& step : bench.run("G4 X2.\nM30").steps) {
    if (step.item.kind != NC_ITEM_GATE || step.item.u.gate.kind != NC_GATE_DWELL_SECONDS) continue;
    EXPECT_EQ(step.item.u.gate.skip_mask, 5);
    seen = true;
  }
  EXPECT_TRUE(seen);
}

// ---- speed change skip (15.5) ----------------------------------------------------------------------------------------------

TEST(SpeedChange, OnlySignalsWithZeroEndTheMove) {
  const std::vector<nc_move> moves = m700("G31 X100. F500 F1=0 F2=50 F3=100 F8=0\nG31 X200. F500 F4=50\nG31 X300. F500\nM30").moves();
  EXPECT_EQ(moves[0].skip_mask, 0x81);
  EXPECT_EQ(moves[0].feed_mm_min, 500);
  EXPECT_EQ(moves[1].skip_mask, 0);
  EXPECT_EQ(moves[2].skip_mask, 1);  // (6): the normal G31
}

TEST(SpeedChange, Words) {
  EXPECT_EQ(m700("G31 X1. F5 F9=1\nM30").alarm, "P33");
  EXPECT_EQ(m700("G31 X1. F5 F0=1\nM30").alarm, "P33");
  EXPECT_EQ(m700("G1 X1. F5 F1=1\nM30").alarm, "P33");
  EXPECT_EQ(m700("G31.1 X1. F5 F1=1\nM30").alarm, "P33");
  EXPECT_EQ(m700("G31 X1. F5 P1 F1=1\nM30").alarm, "P33");
  EXPECT_EQ(m700("G31 X1. F5 F1=-1\nM30").alarm, "P35");
  EXPECT_EQ(m700("G31 X1. F1=10\nM30").alarm, "P603");
  EXPECT_EQ(m700("#1=3\nG31 X1. F5 F2=[#1*10]\nM30").alarm, "");
}

// ---- tool length measurement (15.1) ----------------------------------------------------------------------------------------

/// The sensor answers when the axis (Z) is at this machine coordinate.
void sensor_at(Bench& bench, double place, unsigned axis = 2) {
  bench.skip_at = [place, axis](const nc_item& item) -> std::optional<double> {
    const nc_move& m = item.u.move;
    const double part = (place - m.machine_start.v[axis]) / (m.machine.v[axis] - m.machine_start.v[axis]);
    if (part > 1 + 1e-9) return std::nullopt;
    return part < 0 ? 0 : part;
  };
}

TEST(Measure, NewTool) {  // the printed example (1), in mm
  Bench bench;
  sensor_at(bench, -300);
  const Outcome run = bench.run("G28 Z0\nG90 G0 G43 Z0 H1\nG37 Z-400. R200. D150. F10\n#100=#2001\nG0 Z-10.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 100);
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 -200", "skip 0 0 -550 F10", "rapid 0 0 90"}));  // (4): in force with the next Z
}

TEST(Measure, CorrectsAnOffset) {  // example (2)
  Bench bench;
  bench.tool(1, 100);
  sensor_at(bench, -305);
  const Outcome run = bench.run("G0 G43 Z0 H1\nG37 Z-400. R200. D50. F10\n#100=#2001\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_NEAR(run.var(100), 95, 1e-9);
  EXPECT_EQ(run.path()[1], "rapid 0 0 -100");  // with the offset that is applied
}

TEST(Measure, WearOfMemoryTypeTwo) {
  Bench bench;
  bench.param("1037", "2");
  sensor_at(bench, -300);
  EXPECT_EQ(bench.run("G0 G43 Z0 H1\nG37 Z-400. R200. D150. F10\nM30").alarm, "");
  EXPECT_NEAR(bench.tool_now(1), 100, 1e-9);  // none before: the length
  EXPECT_EQ(bench.tool_now(1, NC_TOOL_LENGTH_WEAR), 0);
  sensor_at(bench, -305);
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 Z0 H1\nG37 Z-400. R200. D150. F10\nM30").alarm, "");
  EXPECT_NEAR(bench.tool_now(1), 100, 1e-9);
  EXPECT_NEAR(bench.tool_now(1, NC_TOOL_LENGTH_WEAR), -5, 1e-9);
}

TEST(Measure, WithALengthOfG44) {
  // (4): "P606 results when G43_H is not commanded prior to the G37 block".
  EXPECT_EQ(Bench().tool(1, -100).run("G0 G44 Z0 H1\nG37 Z-400. R200. D50. F10\nM30").alarm, "P606");
  // HX 4.10 asks for no G43: the length counts the other way.
  Bench bench(NC_DIALECT_HX);
  bench.tool(1, -100).param("3141", "200").param("3142", "50").param("3143", "10");
  sensor_at(bench, -305);
  const Outcome run = bench.run("G90 G0 G44 Z0 H1\nG37 Z-400.\nG0 Z0\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_NEAR(bench.tool_now(1), -95, 1e-9);
  EXPECT_EQ(run.path().back(), "rapid 0 0 95");
}

TEST(Measure, AnAdditionalAxis) {  // "X, Y, Z, a (where a is the additional axis)"; its offset by 12.2 (3)
  Bench bench(NC_DIALECT_M700, axes("XYZW"));
  bench.param("1031", "W");
  sensor_at(bench, 49, 3);
  EXPECT_EQ(bench.run("G0 G43 W0 H1\nG37 W50. R10. D5. F10\nM30").alarm, "");
  EXPECT_NEAR(bench.tool_now(1), -1, 1e-9);
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 W0 H1\nG37 Z50. R10. D5. F10\nM30").alarm, "P606");
}

TEST(Measure, Parameters) {  // #8004 to #8006, and 1 mm/min
  Bench bench;
  bench.param("8004", "60").param("8005", "20").param("8006", "5");
  sensor_at(bench, -101);
  EXPECT_EQ(bench.run("G0 G43 Z0 H1\nG37 Z-100.\nM30").path(), (Path{"rapid 0 0 -80", "skip 0 0 -105 F60"}));
  bench.param("8004", "0");
  EXPECT_EQ(bench.at(0, 0, 0).run("G43 H2\nG37 Z-100.\nM30").path(), (Path{"rapid 0 0 -80", "skip 0 0 -105 F1"}));
}

TEST(Measure, AnotherAxisAndIncrements) {
  Bench bench;
  bench.at(10, 0, 0);
  bench.skip_at = [](const nc_item&) { return 0.5; };
  const Outcome run = bench.run("G43 X10. H3 G0\nG91 G37 X50. R10. D10.1 F5\nM30");
  EXPECT_EQ(run.alarm, "P35");  // R > D
  EXPECT_EQ(bench.at(10, 0, 0).run("G43 X10. H3 G0\nG91 G37 X50. R10. D9. F5\nM30").path(), (Path{"rapid 50 0 0", "skip 69 0 0 F5"}));
  EXPECT_NEAR(bench.tool_now(3), -0.5, 1e-9);  // half way from 50 to 69
}

TEST(Measure, SignalOutsideTheRange) {
  Bench bench;
  const std::string text = "G0 G43 Z0 H1\nG37 Z-100. R20. D5. F10\nM30";
  const Outcome never = bench.run(text);
  EXPECT_EQ(never.alarm, "P607");
  EXPECT_EQ(never.alarm_line, 2u);
  EXPECT_EQ(never.path(), (Path{"rapid 0 0 -80", "skip 0 0 -105 F10"}));
  EXPECT_EQ(bench.tool_now(1), 0);
  sensor_at(bench, -90);
  EXPECT_EQ(bench.at(0, 0, 0).run(text).alarm, "P607");
  sensor_at(bench, -95);
  EXPECT_EQ(bench.at(0, 0, 0).run(text).alarm, "");
}

TEST(Measure, RangesOfZero) {  // (8), (9)
  Bench bench;
  sensor_at(bench, -100);
  EXPECT_EQ(bench.run("G0 G43 Z0 H1\nG37 Z-100. R20. F10\nM30").alarm, "");
  sensor_at(bench, -99.9);
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 G43 Z0 H1\nG37 Z-100. R20. F10\nM30").alarm, "P607");
  sensor_at(bench, -100);
  const Outcome run = bench.at(0, 0, 0).run("G0 G43 Z0 H1\nG37 Z-100. F10\nM30");
  EXPECT_EQ(run.alarm, "P607");
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 -100"}));
}

TEST(Measure, Alarms) {
  EXPECT_EQ(m700("G43 H1\nG37 R5. D1.\nM30").alarm, "P604");
  EXPECT_EQ(m700("G43 H1\nG37 Z-50. X1. R5. D1.\nM30").alarm, "P604");
  EXPECT_EQ(m700("G43 H1\nG37 Z-50. H1 R5. D1.\nM30").alarm, "P605");
  EXPECT_EQ(m700("G43 H1\nG37 Z-50. T1 R5. D1.\nM30").alarm, "P605");
  EXPECT_EQ(m700("G37 Z-50. R5. D1.\nM30").alarm, "P606");
  EXPECT_EQ(m700("G43 H1\nG49\nG37 Z-50. R5. D1.\nM30").alarm, "P606");
  EXPECT_EQ(m700("G43 H1\nG37 Z-5. R5. D1.\nM30").alarm, "P35");  // (7)
  Bench bench;
  bench.tool(1, 2);
  EXPECT_EQ(bench.run("G1 G41 D1 X10. F100\nX20.\nG43 H2\nG37 Z-50. R5. D1.\nM30").alarm, "P608");
}

TEST(Measure, ItsRangeIsNoOffsetNumber) {
  Bench bench;
  bench.tool(1, 2).tool(50, 9);
  sensor_at(bench, -100);
  const Outcome run = bench.run("G1 G41 D1 X5. F100\nX9.\nG40 X0\nG43 H5\nG37 Z-100. R60. D50. F10\nG1 G41 X5. F9\nX9.\nX20.\nG40 X30.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.last_modal().d, 1u);
  const Outcome wide = bench.run("G43 H5\nG37 Z-100. R90. D999. F10\nM30");
  EXPECT_EQ(wide.alarm, "P35");  // (7), and no P170
  EXPECT_EQ(wide.alarm_detail, "The way to the measuring position must be longer than R (measuring feed), and R longer than D (range).");
}

TEST(Measure, SharesItsBlock) {  // App. 2: groups 1, 7 and 8 are ignored, and the F is not modal
  Bench bench;
  bench.tool(1, 2);
  sensor_at(bench, -100);
  const Outcome run = bench.run("G1 F300 X1.\nG43 H5\nG37 G0 G40 G49 Z-100. R20. D5. F10\nX7.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path().back(), "line 7 0 -100 F300");
  EXPECT_EQ(run.last_modal().code[8], 430);
}

// ---- current limit (15.6) --------------------------------------------------------------------------------------------------

TEST(CurrentLimit, GoesToTheAxis) {
  std::vector<std::string> seen;
  const Outcome run = m700("G10 L14 X50 Y10.9\nM30");
  for (const nc_item& item : run.of(NC_ITEM_ACTION))
    if (item.u.action.kind == NC_ACTION_CURRENT_LIMIT) seen.push_back(brief(item.u.action.index) + ":" + brief(item.u.action.value));
  EXPECT_EQ(seen, (std::vector<std::string>{"0:50", "1:10"}));
  EXPECT_TRUE(run.path().empty());
}

TEST(CurrentLimit, Alarms) {
  EXPECT_EQ(m700("G10 L14 X300\nG10 L14 X1\nM30").alarm, "");
  EXPECT_EQ(m700("G10 L14 X301\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L14 Y0\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L14 Y0.9\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L14 Y-5\nM30").alarm, "P35");
  EXPECT_EQ(m700("G10 L14\nM30").alarm, "P33");
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.system[0].axis_count = 4;
    c.system[0].axis[3].name = 'C';
    c.system[0].axis[3].rotary = true;
  });
  EXPECT_EQ(bench.run("G10 L14 C50\nM30").alarm, "P32");  // (6)
}

}  // namespace
}  // namespace nc::test
