// SPDX-License-Identifier: Apache-2.0
// Feed functions (M700 7) and dwell (8.1): what F means, which words a block must have, which codes exclude each other.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome from_zero(Bench& bench, const std::string& text) { return bench.at(0, 0, 0).run(text); }

std::vector<double> feeds(const Outcome& run) {
  std::vector<double> all;
  for (const nc_move& m : run.moves()) all.push_back(m.feed_mm_rev > 0 ? -m.feed_mm_rev : m.feed_mm_min);
  return all;
}
std::vector<double> feeds(const std::string& text) {
  Bench bench;
  return feeds(from_zero(bench, text));
}
using Feeds = std::vector<double>;

Bench digit_bench() {
  Bench bench;
  bench.param("1079", "1").param("1506", "15000").param("1507", "1500");
  bench.param("1185", "800").param("1186", "1650").param("1187", "2400").param("1188", "3100").param("1189", "4200");
  return bench;
}

unsigned gates(const Outcome& run, nc_gate_kind kind) {
  unsigned count = 0;
  for (const nc_item& item : run.of(NC_ITEM_GATE)) count += item.u.gate.kind == kind ? 1u : 0u;
  return count;
}

TEST(InverseTime, SpeedIsFTimesLengthOrRadius) {  // M700 7.5 (2)
  EXPECT_EQ(feeds("G93 G1 X10. F5\nX30. Y0 F5.\nG2 X50. I10. F2.5\nM30"), (Feeds{50, 100, 25}));
  const Feeds helix = feeds("G93 G3 X20. Z5. I10. F3\nM30");
  ASSERT_EQ(helix.size(), 1u);
  EXPECT_EQ(helix[0], 30);
  EXPECT_NEAR(feeds("G20 G93 G1 X1. F5\nM30")[0], 127, 1e-9);  // 5 inch/min
  EXPECT_EQ(feeds("G93 G0 X10.\nY5.\nM30"), (Feeds{0, 0}));   // positioning takes no F
}

TEST(InverseTime, EveryCuttingBlockHasItsF) {  // M700 7.5, precautions (2) to (4)
  const auto alarm = [](const char* text) { return m700(text).alarm; };
  EXPECT_EQ(alarm("G94 G1 X10. F500\nG93 X20.\nM30"), "P62");
  EXPECT_EQ(alarm("G93 G1 X10. F5\nX20.\nM30"), "P62");
  EXPECT_EQ(alarm("G93 G1 X10. F0\nM30"), "P62");
  EXPECT_EQ(alarm("G93 G2 X10. R5.\nM30"), "P62");
  EXPECT_EQ(alarm("G93 G1 X10. F5\nG94 X20.\nM30"), "P62");
  EXPECT_EQ(alarm("G93 G1 X10. F5\nG95\nM30"), "P62");
  EXPECT_EQ(feeds("G93 G1 X10. F5\nG94 X20. F300\nX35.\nM30"), (Feeds{50, 300, 300}));
  EXPECT_EQ(feeds("G93 G1 X10. F5\nG95 X20. F.2\nM30"), (Feeds{50, -0.2}));
  EXPECT_EQ(alarm("G93 G1 X10. F1000000\nM30"), "P35");
  EXPECT_EQ(alarm("G93 G1 X10. F0.0005\nM30"), "P35");
  EXPECT_EQ(feeds("G93 G1 X10. F999999.999\nM30")[0], 9999999.99);
}

TEST(InverseTime, ExcludesOtherFunctions) {  // M700 7.5, relation with other functions (4), (5)
  for (const char* code : {"G2.3 X5. I10. J20. R5. F9", "G6.2 X1. Y1. R1. K0 F9", "G12 I8. D1 F5.", "G13 I8. D1 F5.", "G31 X5. F9", "G31.1 X5. F9",
                           "G33 Z5. F1.", "G34 X0 Y0 I5. J0 K4", "G37 Z5. F9", "G37.1 X0 Y0 I5. P2 J5. K2", "G73 Z-5. R-1. Q1. F9",
                           "G81 Z-5. R-1. F9", "G89 Z-5. R-1. P9 F9", "G96 S100"}) {
    const Outcome run = m700("G93\n" + std::string(code) + "\nM30");
    EXPECT_EQ(run.alarm, "P125") << code;
    EXPECT_EQ(run.alarm_line, 2u);
  }
  EXPECT_EQ(m700("G33 Z5. F1.\nG93\nM30").alarm, "P125");
  EXPECT_EQ(m700("G81 Z-5. R-1. F9\nG93\nM30").alarm, "P125");
  EXPECT_EQ(m700("G81 Z-5. R-1. F9\nG80 G93\nG1 X5. F9\nM30").alarm, "");
  EXPECT_EQ(m700("G33 Z5. F1.\nG93 G1 X5. F9\nM30").alarm, "");
}

TEST(InverseTime, EndsWithTheProgram) {  // M700 7.5 (1), (3)
  Bench bench;
  EXPECT_EQ(from_zero(bench, "G93 G1 X1. F5\nM30").last_modal().code[5], 930);
  EXPECT_EQ(from_zero(bench, "G1 X1. F5\nM30").last_modal().code[5], 940);
  bench.param("1074", "1");
  EXPECT_EQ(feeds(from_zero(bench, "G1 X1. F0.5\nM30")), (Feeds{-0.5}));
}

TEST(RotaryAxes, ADegreeIsAMillimetreAlongCurvesToo) {  // M700 7.6, 6.6, 6.13, 6.14
  const auto length = [](const std::string& text) {
    Bench bench(NC_DIALECT_M700, axes("XYZc"));
    double sum = 0;
    for (const nc_move& m : from_zero(bench, text + "\nM30").moves()) sum += m.length;
    return sum;
  };
  const double quarter = 5 * std::numbers::pi;
  EXPECT_NEAR(length("G1 X30. C40. F100"), 50, 1e-9);
  EXPECT_NEAR(length("G2 X10. Y10. C90. I10. F100"), std::hypot(quarter, 90), 1e-9);
  EXPECT_NEAR(length("G2 X10. Y10. Z20. C90. I10. F100"), std::hypot(quarter, 20, 90), 1e-9);
  EXPECT_NEAR(length("G3.1 X-10. Y0 C900. I-5. P0 F100"), std::hypot(quarter, 900), 1e-6);
  EXPECT_NEAR(length("G2.4 X10. Y10. C90. F100\nX20. Y0 C180."), 2 * std::hypot(quarter, 90), 1e-6);
}

TEST(RotaryAxes, InInchADegreeIsATenthOfAnInch) {  // M700 3.2 notes 5, 6: F1. is 10 deg/min
  const auto first = [](const std::string& text) {
    Bench bench(NC_DIALECT_M700, axes("XYZc"));
    bench.param("1514", "X").param("1515", "C");
    return feeds(from_zero(bench, "G20 " + text + "\nM30")).front();
  };
  const auto minutes = [](const std::string& text) {
    Bench bench(NC_DIALECT_M700, axes("XYZc"));
    const nc_move m = from_zero(bench, "G20 " + text + "\nM30").moves().front();
    return m.length / m.feed_mm_min;
  };
  EXPECT_NEAR(first("G1 C90. F10."), 100, 1e-9);
  EXPECT_NEAR(first("G1 X1. F10."), 254, 1e-9);
  EXPECT_NEAR(minutes("G1 X1. C10. F10."), std::sqrt(2) / 10, 1e-9);
  EXPECT_NEAR(minutes("G1 X.001 C30. F10."), minutes("G1 C30. F10."), 1e-6);
  EXPECT_NEAR(minutes("G2 X1. Y1. C10. I1. F10."), std::hypot(std::numbers::pi / 2, 1) / 10, 1e-9);
  EXPECT_NEAR(minutes("G93 G1 X1. C10. F2."), 0.5, 1e-9);
  EXPECT_NEAR(first("G31 C90. F10."), 100, 1e-9);
  EXPECT_NEAR(first("G31 X1. F10."), 254, 1e-9);
  EXPECT_NEAR(first("G2.3 G91 C10. I30. J40. R2. F10."), 100, 1e-9);
  EXPECT_NEAR(first("G33 C360. F1."), -10, 1e-9);  // deg/rev
  EXPECT_NEAR(first("G33 Z1. F1."), -25.4, 1e-9);
}

TEST(DigitFeed, SpeedsOfParameters) {  // M700 7.3
  Bench bench = digit_bench();
  EXPECT_EQ(feeds(from_zero(bench, "G1 X10. F1\nY10. F2\nX20. F5\nY20. F6\nX30. F3.\nG3 X40. Y30. J10. F4\nX50.\nM30")).size(), 6u);
  EXPECT_EQ(feeds(from_zero(bench, "G1 X10. F1\nY10. F2\nX20. F5\nY20. F6\nX30. F3.\nM30")), (Feeds{800, 1650, 4200, 6, 3}));
  EXPECT_EQ(feeds(from_zero(bench, "G3 X20. I10. F4\nM30")), (Feeds{3100}));
  EXPECT_NEAR(feeds(from_zero(bench, "G20 G1 X1. F1\nM30"))[0], 80 * 25.4, 1e-9);  // (f): a tenth, inch/min
  EXPECT_EQ(feeds(from_zero(bench, "#1=2\nG1 X10. F#1\nM30")), (Feeds{2}));          // a variable counts as written with a point
  EXPECT_EQ(feeds(from_zero(bench, "G95 G1 X10. F1\nM30")), (Feeds{-0.001}));        // (i)
  EXPECT_EQ(feeds(from_zero(bench, "G93 G1 X10. F1\nM30")), (Feeds{10}));
  EXPECT_EQ(feeds(from_zero(bench, "G81 X1. Z-5. R-1. F2\nM30")), (Feeds{0, 0, 1650, 0}));  // in a fixed cycle, too
  bench.param("1506", "1000");
  EXPECT_EQ(feeds(from_zero(bench, "G1 X10. F5\nM30")), (Feeds{1000}));  // FM is the clamp of F1 to F5
}

TEST(DigitFeed, ZeroIsRapidTraverse) {  // M700 7.3, table of (3) (a)
  Bench bench = digit_bench();
  Outcome run = from_zero(bench, "G1 X10. F0\nX20.\nX30. F1\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 10 0 0", "rapid 20 0 0", "line 30 0 0 F800"}));
  EXPECT_EQ(run.last_modal().code[1], 10);
  run = from_zero(bench, "G0 X10. F1\nG1 X20.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 10 0 0", "line 20 0 0 F800"}));
  EXPECT_EQ(run.last_modal().feed, 1);
  EXPECT_EQ(from_zero(bench, "F0 G0 X10.\nM30").path(), (Path{"rapid 10 0 0"}));
  EXPECT_EQ(from_zero(bench, "G2 X10. R5. F0\nM30").alarm, "P121");
  run = from_zero(bench, "G2 X10. R5. F1\nF0\nG1 X20.\nM30");  // (c) "used in the G02 mode", whether it moves or not
  EXPECT_EQ(run.alarm, "P121");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_EQ(from_zero(bench, "G3 F0\nM30").alarm, "P121");
  EXPECT_EQ(from_zero(bench, "G2 X10. R5. F1\nG1 F0 X20.\nM30").alarm, "");
  EXPECT_EQ(from_zero(bench, "G2 X10. R5. F1\nG81 Z-5. R-2. F0\nM30").alarm, "");  // the feed of a cycle is that of no arc
  EXPECT_EQ(from_zero(bench, "G1 X10. F0.\nM30").alarm, "P62");  // with a point it is a feed of 0
  EXPECT_EQ(feeds(from_zero(bench, "G4 P10 F2\nG1 X1.\nM30")), (Feeds{1650}));  // (b) beside an unmodal code
}

TEST(PerRevolution, UnitsAndRanges) {  // M700 7.4 (1)
  EXPECT_EQ(feeds("G95 G1 X10. F200\nX20. F0.25\nM30"), (Feeds{-0.2, -0.25}));
  EXPECT_EQ(feeds("G94 G1 X10. F200\nM30"), (Feeds{200}));
  EXPECT_NEAR(-feeds("G20 G95 G1 X1. F100\nM30")[0], 0.254, 1e-12);
  EXPECT_EQ(m700("G95 G1 X10. F1000.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G95 G1 X10. F999.999\nM30").alarm, "");
  EXPECT_EQ(m700("G95 G1 X10. F0.0001\nM30").alarm, "P35");
  Bench bench;
  bench.param("1003", "C");
  EXPECT_EQ(feeds(from_zero(bench, "G95 G1 X10. F200\nM30")), (Feeds{-0.02}));
}

TEST(PerRevolution, AnFBelongsToItsMode) {
  EXPECT_EQ(m700("G94 G1 X10. F200\nG95 X20.\nM30").alarm, "P62");
  EXPECT_EQ(m700("G95 G1 X10. F.2\nG94 X20.\nM30").alarm, "P62");
  EXPECT_EQ(feeds("G94 F200\nG94 G1 X10.\nM30"), (Feeds{200}));
  EXPECT_EQ(feeds("G95 G81 X1. Z-5. R-1. F.1\nM30"), (Feeds{0, 0, -0.1, 0}));
}

TEST(ExactStop, ModesOfGroup13) {  // M700 7.7, 7.8, 7.11, 7.12
  const auto stops = [](const char* text) {
    std::vector<bool> all;
    for (const nc_move& m : m700(text).moves()) all.push_back(m.exact_stop);
    return all;
  };
  EXPECT_EQ(stops("G9 G1 X1. F9\nX2.\nM30"), (std::vector<bool>{true, false}));
  EXPECT_EQ(stops("G61 G1 X1. F9\nG2 X3. R1.\nG64 G1 X4.\nM30"), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(stops("G61 G1 X1. F9\nG63 X2.\nG9 X3.\nG62 X4.\nM30"), (std::vector<bool>{true, false, false, false}));
  EXPECT_EQ(stops("#3004=4\nG9 G1 X1. F9\nM30"), (std::vector<bool>{false}));  // 13.5.10
}

TEST(Deceleration, InPositionByParameter) {  // M700 7.9
  const auto count = [](const char* inpos, const char* aux07, const char* type, const char* text) {
    Bench bench;
    bench.param("1193", inpos).param("1223/bit1", aux07).param("1306", type);
    return gates(from_zero(bench, text), NC_GATE_IN_POSITION);
  };
  const char* const both = "G0 X1.\nG1 X2. F9\nG9 X3.\nG61 X4.\nM30";
  EXPECT_EQ(count("0", "0", "0", both), 0u);
  EXPECT_EQ(count("1", "0", "0", both), 1u);  // G0
  EXPECT_EQ(count("0", "1", "0", both), 2u);  // G9 and G61
  EXPECT_EQ(count("1", "0", "1", both), 3u);
  EXPECT_EQ(count("0", "1", "1", both), 0u);
}

TEST(TappingMode, TellsTheMachineAndAllowsNoBlockStop) {  // M700 7.11
  const Outcome run = m700("G1 X1. F9\nG63\nX2.\nG64\nX3.\nM30");
  std::vector<double> control;
  for (const nc_item& item : run.of(NC_ITEM_ACTION))
    if (item.u.action.kind == NC_ACTION_CONTROL && item.u.action.index == NC_CONTROL_TAPPING) control.push_back(item.u.action.value);
  EXPECT_EQ(control, (std::vector<double>{1, 0}));
  std::vector<bool> stop;
  for (const nc_item& item : run.of(NC_ITEM_MARK)) stop.push_back(item.u.mark.stop);
  EXPECT_EQ(stop, (std::vector<bool>{true, false, false, true, true, false}));
}

TEST(Dwell, XBeforeTheCodeIsALength) {  // M700 8.1 note 3
  EXPECT_EQ(m700("G20 X5. G04\nM30").dwells(), (std::vector<double>{50}));
  EXPECT_EQ(m700("G20 G04 X5.\nM30").dwells(), (std::vector<double>{5}));
  EXPECT_EQ(m700("G20 X5000 G04\nM30").dwells(), (std::vector<double>{5}));
  Bench type_2;  // 5.3: X5 is X5.
  type_2.param("1078", "1");
  EXPECT_EQ(type_2.run("G20 X5 G04\nM30").dwells(), (std::vector<double>{50}));
  EXPECT_EQ(type_2.run("G20 G04 X5\nM30").dwells(), (std::vector<double>{5}));
  EXPECT_EQ(m700("G21 X5. G04\nM30").dwells(), (std::vector<double>{5}));
  EXPECT_EQ(m700("G04 X99999.999\nM30").alarm, "");
  EXPECT_EQ(m700("G04 X100000.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G04 X-1.\nM30").alarm, "P35");
  EXPECT_EQ(m700("G04 P99999999\nM30").alarm, "");
}

TEST(Dwell, AloneItWaitsForRest) {  // M700 15.2 prints G04 behind G31: "machine stop check"
  const Outcome run = m700("G1 X1. F100\nG04\nX2.\nM30");
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_item> gates = run.of(NC_ITEM_GATE);
  ASSERT_EQ(gates.size(), 2u);  // and the FIN of M30
  EXPECT_EQ(gates[0].u.gate.kind, NC_GATE_DWELL_SECONDS);
  EXPECT_EQ(gates[0].u.gate.value, 0);
  EXPECT_FALSE(gates[0].u.gate.announce);
}

TEST(Dwell, BeginsWithTheFunctionsOfItsBlock) {  // M700 8.1 (5)
  std::vector<int> kinds;
  for (const nc_item& item : m700("M8 G04 P100\nM30").of(NC_ITEM_GATE)) kinds.push_back(item.u.gate.kind);
  EXPECT_EQ(kinds, (std::vector<int>{NC_GATE_DWELL_SECONDS, NC_GATE_FIN, NC_GATE_FIN}));
}

}  // namespace
}  // namespace nc::test
