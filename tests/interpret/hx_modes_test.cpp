// SPDX-License-Identifier: Apache-2.0
// Modes, cycles and the stitching head of the hx family: what its manual says otherwise than those of the other families do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome hx(const std::string& text) { return Bench(NC_DIALECT_HX).run(text); }
std::string alarm_of(const std::string& text) { return hx(text).alarm; }

TEST(Hx, ParametersChooseTheModesAtPowerOn) {  // 3.2
  const auto starts_with = [](const char* key, const char* value) {
    Bench bench(NC_DIALECT_HX);
    bench.param(key, value);
    const nc_modal modal = bench.run("M30").last_modal();
    std::string codes;
    for (const unsigned group : {1u, 16u, 3u, 6u, 9u}) codes += std::to_string(modal.code[group] / 10) + " ";
    return codes;
  };
  EXPECT_EQ(starts_with("3144", "0"), "0 17 90 21 23 ");
  EXPECT_EQ(starts_with("3144", "1"), "1 17 90 21 23 ");
  EXPECT_EQ(starts_with("3145", "1"), "0 18 90 21 23 ");
  EXPECT_EQ(starts_with("3145", "2"), "0 19 90 21 23 ");
  EXPECT_EQ(starts_with("3146", "1"), "0 17 91 21 23 ");
  EXPECT_EQ(starts_with("3147", "1"), "0 17 90 20 23 ");
  EXPECT_EQ(starts_with("3148", "0"), "0 17 90 21 22 ");
  EXPECT_EQ(starts_with("3148", "1"), "0 17 90 21 23 ");
}

TEST(Hx, TheStrokeCheckKeepsOutOfItsAreaOrInIt) {  // 15.5.3, PM 3474
  const std::string area = "G22 X20. Y20. Z5. I5. J5. K-5.\n";  // A and B, in either order
  EXPECT_EQ(hx(area + "G00 X30.\nX0\nM30").alarm, "");
  EXPECT_EQ(hx(area + "G00 X10. Y10.\nM30").alarm, "NC-LIMIT");
  EXPECT_EQ(hx(area + "G23\nG00 X10. Y10.\nM30").alarm, "");
  const auto outside = [&](const std::string& text) { return Bench(NC_DIALECT_HX).param("23474", "1").at(10, 10, 0).run(area + text + "M30").alarm; };
  EXPECT_EQ(outside("G00 X15. Y7.\n"), "");
  EXPECT_EQ(outside("G00 X21.\n"), "NC-LIMIT");
  EXPECT_EQ(outside("G23\nG00 X21.\n"), "");
}

TEST(Hx, HighSpeedMachiningIsAMode) {  // 15.1
  const Outcome run = hx("G10.3\nG01 X1. F100.\nG11.3\nM30");
  EXPECT_EQ(run.path(), (Path{"line 1 0 0 F100"}));
  std::vector<int> codes;
  for (const Step& step : run.steps)
    if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) codes.push_back(step.modal.code[21]);
  EXPECT_EQ(codes, (std::vector<int>{103, 103, 113, 113}));
}

TEST(Hx, ARigidTapHasItsLeadFromFeedAndSpeed) {  // 12.3.5: 300 r/min x 1.5 mm = F450
  const std::vector<nc_move> moves = hx("S300 M03\nG00 Z20.\nG99 G84.2 X1. Z-5. R2. F450.\nX2.\nG80\nG01 X3.\nM30").moves();
  ASSERT_GE(moves.size(), 5u);
  unsigned taps = 0;
  for (const nc_move& move : moves) {
    if (move.kind != NC_MOVE_TAP) continue;
    ++taps;
    EXPECT_NEAR(move.feed_mm_rev, 1.5, 1e-12);
  }
  EXPECT_EQ(taps, 4u);  // in and out of two holes
  EXPECT_EQ(moves.back().feed_mm_min, 450);  // the F stays in force
  EXPECT_EQ(alarm_of("S300 M03\nG84.3 X1. Z-5. R2.\nM30"), "F_84020");
}

TEST(Hx, ACycleGoesOnWithItsDataUntilAMotionEndsIt) {  // 12.2.1
  EXPECT_EQ(hx("G00 Z20.\nG99 G81 X1. Z-5. R2. F100.\nG82 X2. P500\nG00 X0\nM30").path(),
            (Path{"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -5 F100", "rapid 1 0 2", "rapid 2 0 2", "line 2 0 -5 F100", "rapid 2 0 2",
                  "rapid 0 0 2"}));
  // 12.3.5, 12.3.8: the spindle turns back at the bottom of a tap and stands while a bore is left.
  EXPECT_EQ(hx("S300 M03\nG00 Z20.\nG99 G84 X1. Z-5. R2. F450.\nG80\nM30").aux(), "S300 M3 M4 M3 M30");
  EXPECT_EQ(hx("S300 M04\nG00 Z20.\nG99 G74 X1. Z-5. R2. F450.\nG80\nM30").aux(), "S300 M4 M3 M4 M30");
  EXPECT_EQ(hx("S300 M03\nG00 Z20.\nG99 G86 X1. Z-5. R2. F450.\nG80\nM30").aux(), "S300 M3 M5 M3 M30");
  // 12.3.9, 12.3.10: the shift has I J, or Q with both PI 70 and PI 71.
  for (const char* code : {"G76", "G87"}) EXPECT_EQ(alarm_of(std::string("M03\n") + code + " X1. Z-5. R2. Q1. F450.\nM30"), "NC-WORDS") << code;
  const Outcome fine = hx("M03 S500\nG00 Z20.\nG98 G76 X1. Z-5. R2. I.5 J0 F450.\nG80\nM30");
  EXPECT_EQ(fine.path(), (Path{"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -5 F450", "line 1.5 0 -5 F450", "rapid 1.5 0 20", "rapid 1 0 20"}));
  EXPECT_EQ(fine.aux(), "S500 M3 M19 M3 M30");
  // 12.1.3: in G91 R counts from the initial level, Z from R, each with its own sign.
  EXPECT_EQ(hx("G00 Z20.\nG91 G99 G81 X1. Z-5. R-18. F100. K2\nG80\nM30").path(),
            (Path{"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -3 F100", "rapid 1 0 2", "rapid 2 0 2", "line 2 0 -3 F100", "rapid 2 0 2"}));
}

TEST(Hx, CompensationBeginsByTheTypeOfItsParameter) {  // 13.2.2, PI 128
  const auto path = [](const char* type) {
    Bench bench(NC_DIALECT_HX);
    bench.tool(1, 3, NC_TOOL_RADIUS).param("3128", type);
    return bench.run("G42 D1 G01 X10. F100\nX20. Y10.\nY30.\nG40 X40.\nM30").path();
  };
  EXPECT_EQ(path("0").front(), "line 12.12132 -2.12132 0 F100");
  EXPECT_EQ(path("1").front(), "line 11.242641 -3 0 F100");
}

TEST(Hx, TheCodeOfCompensationAloneWaitsForAMove) {  // 13.2.2 (1), with N6 to N9 of the printed program
  const auto path = [](const std::string& text) {
    Bench bench(NC_DIALECT_HX);
    bench.tool(1, 4, NC_TOOL_RADIUS);
    const Outcome run = bench.run(text + "\nM30");
    EXPECT_EQ(run.alarm, "") << run.alarm_detail;
    return run.path();
  };
  const Path beside{"line 6 0 0 F50", "line 6 16 0 F50", "line -10 16 0 F50", "line -20 20 0 F50"};
  for (const char* start : {"G41 D1\nG01 X10. F50.", "G41 D1 X0\nG01 X10. F50.", "G01 F50. G41 D1 X0\nX10."})
    EXPECT_EQ(path(std::string(start) + "\nY20.\nX-10.\nG40 X-20."), beside) << start;
  EXPECT_EQ(path("N6 G91 G01 X100. Y100. F50.\nN7 G41 D1 X0\nN8 Y-100.\nN9 Y-100. X100.\nG40 X50.").at(1), "line 102.828427 2.828427 0 F50");
  EXPECT_EQ(path("G41 D1\nG01 Z-1. F50.\nX10.\nY20.").front(), "line 0 0 -1 F50");
  EXPECT_EQ(path("G01 F50. G41 D1 X10.\nY20.\nG40\nY30.\nX0.").back(), "line 0 30 0 F50");
}

TEST(Hx, CompensationWithoutAnyNumberHasNoAmount) {  // 4.6, 15.4.2 print such programs
  Bench bench(NC_DIALECT_HX);
  EXPECT_EQ(bench.run("G90 G01 G42 X0 Y-10.0 F200.\nX4.142\nX7.071 Y-7.071\nG40\nM30").path(),
            (Path{"line 0 -10 0 F200", "line 4.142 -10 0 F200", "line 7.071 -7.071 0 F200"}));
}

TEST(HxLength, DoesNotBeginBesideAnArc) {  // docs/decisions.md
  Bench bench(NC_DIALECT_HX);
  bench.tool(1, 10);
  const Outcome run = bench.run("G00 X0 Y0\nG43 H1 G02 X10. Y0 R6. F100\nM30");
  EXPECT_EQ(run.alarm, "F_82004");
  EXPECT_EQ(run.alarm_detail, "G43 cannot stand in the block of an arc. Give it a block in front.");
}

TEST(Hx, G39LeadsOnFromTheCornerOnAnArc) {  // 13.2.1, N3 to N5 of the printed program
  for (const char* words : {"X40. Y20.", "I40. J20."}) {
    Bench bench(NC_DIALECT_HX);
    bench.tool(8, 5, NC_TOOL_RADIUS);
    const Outcome run = bench.run(std::string("G91 G17 G00 G41 X20. Y20. D08\nG01 Z-25. F100\nY40. F250\nG39 ") + words + "\nX40. Y20.\nG40 X10. Y-20.\nM30");
    ASSERT_EQ(run.alarm, "") << run.alarm_detail;
    unsigned arcs = 0;
    for (const nc_move& move : run.moves()) {
      if (move.kind != NC_MOVE_ARC) continue;
      ++arcs;
      EXPECT_NEAR(move.machine_center[0], 20, 1e-9);
      EXPECT_NEAR(move.machine_center[1], 60, 1e-9);
      EXPECT_NEAR(move.machine.v[0], 20 - std::sqrt(5.0), 1e-9);
      EXPECT_NEAR(move.machine.v[1], 60 + 2 * std::sqrt(5.0), 1e-9);
    }
    EXPECT_EQ(arcs, 1u) << words;
  }
}

TEST(Hx, QShiftsByItsTwoParameters) {  // 12.3.9, 12.3.10, PI 70, PI 71
  const auto beside = [](const char* axis, const char* direction, const std::string& plane, const char* words) {
    Bench bench(NC_DIALECT_HX);
    bench.param("3070", axis).param("3071", direction);
    const Outcome run = bench.run("M03 S500\n" + plane + words + "\nG80\nM30");
    EXPECT_EQ(run.alarm, "") << run.alarm_detail;
    return run.path().size() < 4 ? std::string() : run.path()[2];
  };
  const char* const g76 = "G98 G76 X1. Y2. Z-5. R2. Q.5 F450.";
  EXPECT_EQ(beside("0", "0", "", g76), "line 1 2 -5 F450");
  const auto shifted = [](const char* axis, const char* direction) {
    Bench bench(NC_DIALECT_HX);
    bench.param("3070", axis).param("3071", direction);
    return bench.run("M03 S500\nG98 G76 X1. Y2. Z-5. R2. Q.5 F450.\nG80\nM30").path()[3];
  };
  EXPECT_EQ(shifted("0", "0"), "line 1.5 2 -5 F450");
  EXPECT_EQ(shifted("0", "1"), "line 0.5 2 -5 F450");
  EXPECT_EQ(shifted("1", "0"), "line 1 2.5 -5 F450");
  EXPECT_EQ(shifted("1", "1"), "line 1 1.5 -5 F450");
  Bench words(NC_DIALECT_HX);  // I J of the block go before
  words.param("3070", "0").param("3071", "0");
  EXPECT_EQ(words.run("M03 S500\nG98 G76 X1. Y2. Z-5. R2. Q.5 I0 J-.25 F450.\nG80\nM30").path()[3], "line 1 1.75 -5 F450");
  Bench one(NC_DIALECT_HX);
  one.param("3070", "0");
  EXPECT_EQ(one.run("M03\nG76 X1. Z-5. R2. Q1. F450.\nM30").alarm, "NC-WORDS") << "the direction is not said";
}

TEST(Hx, ScalingAndRotationMayBeginWithTheProgram) {  // 3.2, PI 149, PI 150
  Bench scaled(NC_DIALECT_HX);
  scaled.param("3149", "1").param("3108", "2000").param("3109", "-1000").work_offset(1, {10, 0, 0});
  const Outcome run = scaled.run("G00 X5. Y5. Z5.\nG50\nX5.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 20 -5 5", "rapid 15 -5 5"}));  // about the zero point of the coordinates
  EXPECT_EQ(run.steps[1].modal.code[11], 510);
  EXPECT_EQ(scaled.run("G00 X5.\nM30").path(), (Path{"rapid 20 -5 5"}));  // and with each program
  Bench turned(NC_DIALECT_HX);
  turned.param("3150", "1").param("3117", "90");
  EXPECT_EQ(turned.run("G00 X5. Y0\nG69\nX1.\nM30").path(), (Path{"rapid 0 5 0", "rapid 1 5 0"}));
}

TEST(Hx, AStitchHasTheFeedAndTheWaitOfItsLength) {  // 15.6
  Bench bench(NC_DIALECT_HX);
  bench.param("27321", "1").param("27322", "5").param("27323", "20");              // ends of the ranges
  for (const char* range : {"27324", "27325", "27326", "27327"}) bench.param(range, "20");
  bench.param("27328", "100").param("27329", "200").param("27330", "300").param("27335", "900");  // feed of X
  bench.param("27336", "10").param("27337", "20");                                  // wait of X
  bench.param("27344", "50").param("27353", "40");                                  // feed of Y, wait of Y
  const Outcome run = bench.run("G91 G00 X1.\nG63.1\nX1.\nX1.5\nG01 X20. F777\nX21.\nX.3 Y.4\nY3.\nZ1.\nG63.2\nG00 X1.\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  std::string feeds;
  for (const nc_move& move : run.moves()) feeds += move.kind == NC_MOVE_RAPID ? "rapid " : brief(move.feed_mm_min) + " ";
  // X.3 Y.4 is 0.5 long: X may go 100/0.6, Y 50/0.8. Z has no table.
  EXPECT_EQ(feeds, "rapid 100 200 300 900 62.5 777 777 rapid ");
  EXPECT_EQ(run.dwells(), (std::vector<double>{0.01, 0.02, 0.01, 0.04}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).run("G63.1\nG00 X1.\nG01 X2. F50.\nM30").path(), (Path{"rapid 1 0 0", "line 2 0 0 F50"}));  // nothing is set
  EXPECT_EQ(alarm_of("G63.1\nG01 X2.\nM30"), "F_84020");
  const std::vector<nc_move> slow = bench.run("G91 G00 X1.\nG63.1\nG01 X.3 Y3. F60\nG63.2\nM30").moves();  // of the way of Y the table says nothing
  EXPECT_NEAR(slow.back().feed_mm_min, 60, 1e-9);
}

/// What a run gives out, in its order: moves, dwells, questions for inputs, and the bit of PPF.
std::string order_of_stitches(const Outcome& run) {
  std::string order;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) order += "move ";
    if (item.kind == NC_ITEM_SYNC) order += "? ";
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) order += brief(item.u.gate.value) + " ";
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_OUTPUT) {
      EXPECT_EQ(item.u.action.index, 0u);
      EXPECT_EQ(item.u.action.mask, 1u << 31);
      order += item.u.action.bits != 0 ? "on " : "off ";
    }
  }
  return order;
}

TEST(Hx, AStitchIsAskedOfTheHeadAndWaitedFor) {  // 15.6, PM 7308, 7374 to 7408: PPF, PPE, NPFIN (docs/decisions.md)
  constexpr uint32_t kPpe = 1u << 30, kNpfin = 1u << 31;
  Bench bench(NC_DIALECT_HX);
  bench.param("27308", "1").param("27321", "100").param("27336", "1").param("27374", "5").param("27382", "7").param("27395", "2").param("27394", "3").param("27408", "50");
  unsigned asked = 0;
  const uint32_t answers[] = {0, kPpe, kPpe, kNpfin, kNpfin, kPpe | kNpfin, kPpe | kNpfin};
  bench.on_sync = [&](const nc_item&) { bench.input[0] = answers[std::min<size_t>(asked++, std::size(answers) - 1)]; };
  const Outcome run = bench.run("G63.1\nG01 X1. F100\nX2. Y1.\nZ1.\nG63.2\nG00 X3.\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  // X alone waits for its own times, X and Y for the longer one of theirs; Z is no stitch.
  EXPECT_EQ(order_of_stitches(run), "off move 0.001 0.005 on ? 0.01 ? 0.002 off ? 0.01 ? 0.003 move 0.001 0.007 on ? 0.01 ? 0.002 off ? 0.003 move off move ");

  Bench silent(NC_DIALECT_HX);
  silent.param("27308", "1");
  const Outcome none = silent.run("G63.1\nG01 X1. F100\nM30");
  EXPECT_EQ(none.alarm, "NC-STITCH");
  EXPECT_EQ(none.alarm_line, 2u);
  const std::string order = order_of_stitches(none);
  EXPECT_EQ(order.substr(order.size() - 6), "? off ") << "PPF does not stay on";
  silent.input[0] = kPpe;
  EXPECT_EQ(silent.run("G63.1\nG01 X2. F100\nM30").alarm, "NC-STITCH");
  silent.input[0] = kPpe | kNpfin;
  EXPECT_EQ(silent.run("G63.1\nG01 X3. F100\nM30").alarm, "");
  EXPECT_EQ(bench.run("G63.1\nG01 X100. F100\nM30").alarm, "F_82002") << "the longest stitch";
  EXPECT_EQ(silent.tool(1, 2, NC_TOOL_RADIUS).run("G41 D1 G01 X5. F100\nX9.\nG63.1\nX20.\nM30").alarm, "NC-OFFSET-CODE");
  const std::string exclude = "A stitch and tool radius compensation exclude each other. End one of them with G63.2 or G40 first.";
  EXPECT_EQ(silent.run("G63.1\nG41 D1 G01 X4. F100\nM30").alarm_detail, exclude) << "it would begin here";
  EXPECT_EQ(silent.run("G41 D1 G01 X5. F100\nX9.\nG63.1\nX20.\nM30").alarm_detail, exclude);
}

TEST(Hx, EveryAlarmOfTheManualIsRaisedByWhatItIsFor) {  // the numbers of the spec, section 13
  std::string long_sum;
  for (unsigned i = 0; i < 2000; ++i) long_sum += "+1.5";
  const std::map<std::string, std::string> programs = {
      {"F_82001", "G00 X1. ^\nM30"},
      {"F_82002", "T123456789012 G00 X1.\nS999999999999\nM30"},
      {"F_82004", "G00 X1.2.3\nM30"},
      {"F_82016", "G00 X1."},
      {"F_82018", "N0 G00 X1.\nM30"},
      {"F_82019", "GOTO 5\nM30"},
      {"F_82021", "O1\nM98 P1\nM30"},
      {"F_82030", "G05\nM30"},
      {"F_82100", "G02 X50. R5. F100\nM30"},
      {"F_82109", "M98 P777\nM30"},
      {"F_82111", "#100=1" + long_sum + "\nM30"},
      {"F_82112", "G02 X50. Y50.5 I50. F100\nM30"},
      {"F_82208", "G107 X10.\nM30"},
      {"F_82209", "G00 X10.\nG27 X5.\nM30"},
      {"F_84020", "G01 X50.\nM30"},
  };
  for (const auto& [code, text] : programs) EXPECT_EQ(alarm_of(text), code) << text.substr(0, 60);
}

TEST(Hx, WhatIsNotBuiltOfAParameterIsRefused) {
  ParameterKey key;
  for (const char* text : {"3133", "27391", "27393"}) {  // of PI 133 the value 1; 2 is tests/control/program_restart_test.cpp
    ASSERT_TRUE(parse_parameter_key(text, &key));
    EXPECT_TRUE(parameter_takes(dialect(NC_DIALECT_HX), key, 0)) << text;
    EXPECT_FALSE(parameter_takes(dialect(NC_DIALECT_HX), key, 1)) << text;
  }
}

}  // namespace
}  // namespace nc::test
