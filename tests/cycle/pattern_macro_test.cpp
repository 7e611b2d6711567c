// SPDX-License-Identifier: Apache-2.0
// Patterns of holes at whose places the macro of G66 runs (M700 13.2, 13.5.1): the same as one block for each place.
#include <gtest/gtest.h>

#include <array>

#include "support/going_back.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

/// A user's cycle: down by R and Z in increments, a dwell, and up again; it counts its calls.
constexpr const char* kCycle = "O200\nG91 G0 Z#18\nG1 Z#26 F#9\nG4 P100\nG0 Z-[#18+#26]\nG90\n#100=#100+1\nM99\n";
constexpr const char* kCall = "G66 P200 R-10. Z-5. F120\n";

Bench bench_with(const std::string& macro = kCycle) {
  Bench bench;
  bench.add("O200", macro);
  return bench;
}

Outcome run_on(Bench& bench, const std::string& text, const std::string& end = "\nG67\nM30") {
  return bench.at(0, 0, 50).run("G0 G90\n#100=0\n" + text + end, 1000, 2000000);
}

/// What the machine does, without the marks, of which a pattern has one and a block for each place one.
Path doings(const Outcome& run) {
  Path all;
  Path path = run.path();
  size_t move = 0;
  for (const Step& step : run.steps) {
    if (step.item.kind == NC_ITEM_MOVE) all.push_back(path[move++]);
    if (step.item.kind == NC_ITEM_GATE) all.push_back("gate " + std::to_string(step.item.u.gate.kind) + " " + brief(step.item.u.gate.value));
    if (step.item.kind == NC_ITEM_ACTION && step.item.u.action.kind <= NC_ACTION_B) all.push_back(step.item.u.action.letter + brief(step.item.u.action.value));
  }
  return all;
}

/// The pattern does what the blocks of its places do, `before` and the call standing in front.
void expect_as_blocks(const std::string& pattern, const std::string& blocks, const std::string& before = "", const std::string& macro = kCycle, const std::string& call = kCall, const std::string& end = "\nG67\nM30") {
  SCOPED_TRACE(before + call + pattern);
  Bench one = bench_with(macro), other = bench_with(macro);
  const Outcome wanted = run_on(one, before + call + blocks, end);
  const Outcome got = run_on(other, before + call + pattern, end);
  EXPECT_EQ(got.alarm, "") << got.alarm_detail;
  EXPECT_EQ(wanted.alarm, "") << wanted.alarm_detail;
  EXPECT_EQ(doings(got), doings(wanted));
  EXPECT_EQ(got.var(100), wanted.var(100));
  EXPECT_TRUE(got.ended_ok);
}

constexpr const char* kLine = "G35 X10. Y20. I5. J90. K3";
constexpr const char* kLineAsBlocks = "X10. Y20.\nX10. Y25.\nX10. Y30.";

TEST(PatternMacro, RunsAtEachPlaceOfEachPattern) {
  expect_as_blocks("G34 X0 Y0 I10. K4", "X10. Y0\nX0 Y10.\nX-10. Y0\nX0 Y-10.");
  expect_as_blocks(kLine, kLineAsBlocks);
  expect_as_blocks("G36 X0 Y0 I10. J90. P90. K3", "X0 Y10.\nX-10. Y0\nX0 Y-10.");
  expect_as_blocks("G37.1 X10. Y20. I5. P3 J-2. K2", "X10. Y20.\nX15. Y20.\nX20. Y20.\nX20. Y18.\nX15. Y18.\nX10. Y18.");
  expect_as_blocks("G34 I10. K2", "X10. Y0\nX-10. Y0");   // no word of an axis, and it moves all the same
  expect_as_blocks("G35 X10. Y20. I5. K1", "X10. Y20.");
}

TEST(PatternMacro, TheModesAtAPlaceAreThoseThatTheMacroHasLeft) {
  expect_as_blocks(kLine, kLineAsBlocks, "", "O200\nG1 Z40. F100\n#100=#100+1\nM99\n");                       // from the second place on a line
  expect_as_blocks("G91 " + std::string(kLine), "G91 X10. Y20.\nG90 X10. Y25.\nG90 X10. Y30.", "", "O200\nG91 Z-1.\nM99\n");   // X and Y are read once, G91 or not
  expect_as_blocks(kLine, kLineAsBlocks, "", "O200\nG18 G0 Z40.\nM99\n");                                     // it lies in the plane of its block
  expect_as_blocks(kLine, kLineAsBlocks, "", "O200\nG52 X[#100] Z0\n#100=#100+1\nM99\n");                    // a place is one of the program
  expect_as_blocks(kLine, kLineAsBlocks, "G68 X0 Y0 R30.\n");
  expect_as_blocks(kLine, kLineAsBlocks, "G51.1 X3.\n");
  expect_as_blocks(kLine, kLineAsBlocks, "", "O200\n#1=#5041\n#100=#100*100+#5042\nM99\n");
}

/// The rule of a fixed cycle together with G66: the hole of the place is made, then the macro runs; one that ends the cycle has ended it for the places behind.
TEST(PatternMacro, BehindTheHoleOfAFixedCycle) {
  const std::string cycle = "G98 G81 Z-8. R3. L0 F150\n";
  expect_as_blocks(kLine, kLineAsBlocks, cycle, "O200\nM50\n#100=#100+1\nM99\n");
  expect_as_blocks(kLine, kLineAsBlocks, cycle);
  expect_as_blocks(kLine, kLineAsBlocks, "G98 G83 Z-8. R3. Q2. L0 F150\n", "O200\nM50\n#100=#100+1\nM99\n");
  expect_as_blocks(kLine, kLineAsBlocks, cycle, "O200\nG80\nM99\n");
  expect_as_blocks(kLine, kLineAsBlocks, "", "O200\nG81 Z-8. R3. L0 F150\nM99\n");  // ... and one that begins it has begun it
}

TEST(PatternMacro, Repeats) {
  expect_as_blocks(kLine, kLineAsBlocks, "", kCycle, "G66 P200 L3 R-10. Z-5. F120\n");
  expect_as_blocks(kLine, kLineAsBlocks, "", kCycle, "G66 P200 L0 R-10. Z-5. F120\n");
  Bench bench = bench_with();
  EXPECT_EQ(run_on(bench, "G66 P200 L3 R-10. Z-5. F120\n" + std::string(kLine)).var(100), 9);
}

TEST(PatternMacro, AMacroInAMacro) {
  // G66 of the main program in which P201 is called at each place of a pattern of P200, itself at each place of one.
  Bench bench;
  bench.add("O200", "G35 X[#5041+1.] Y#5042 I1. K2\nM99\n");
  bench.add("O201", "#100=#100*2+#5041\nM99\n");
  const Outcome got = run_on(bench, "G66 P201\nG66 P200\nG35 X10. Y0 I5. K2");
  bench.add("O200", "#1=#5041 #2=#5042\nX[#1+1.] Y#2\nX[#1+2.] Y#2\nM99\n");
  const Outcome wanted = run_on(bench, "G66 P201\nG66 P200\nX10. Y0\nX15. Y0");
  EXPECT_EQ(got.alarm, "");
  EXPECT_EQ(doings(got), doings(wanted));
  EXPECT_EQ(got.var(100), wanted.var(100));
  EXPECT_EQ(wanted.path(), (Path{"rapid 10 0 50", "rapid 11 0 50", "rapid 12 0 50", "rapid 15 0 50", "rapid 16 0 50", "rapid 17 0 50"}));
}

TEST(PatternMacro, EndsWhereTheMacroTakesItsCallBack) {  // 13.5.2 (1)
  expect_as_blocks(kLine, kLineAsBlocks, "", "O200\n#100=#100+1\nIF [#100 LT 2] GOTO 5\nG67\nN5 M99\n", "G66 P200\n", "\nM30");
}

TEST(PatternMacro, EndsWhereTheMacroReturnsElsewhere) {  // M99 P
  Bench bench = bench_with("O200\n#100=#100+1\nIF [#100 LT 2] GOTO 5\nM99 P9\nN5 M99\n");
  const Outcome run = run_on(bench, "G66 P200\n" + std::string(kLine) + "\nX77.\nN9 G67\nG34 X0 Y0 I1. K1", "\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(run.path(), (Path{"rapid 10 20 50", "rapid 10 25 50", "rapid 1 0 50"}));
}

TEST(PatternMacro, TheRestOfTheBlock) {
  Bench bench = bench_with("O200\nM50\nM99\n");
  bench.add("O300", "M60\nM99\n");
  EXPECT_EQ(run_on(bench, "G66 P200\n" + std::string(kLine) + " M8").aux(), "M8 M50 M50 M50 M30");
  EXPECT_EQ(run_on(bench, "G66 P200\nG35 X0 Y0 I5. J90. K2 M98 P300").aux(), "M50 M50 M60 M30");   // behind the last macro
  EXPECT_EQ(run_on(bench, "G66 P200\nG35 X0 Y0 I5. J90. K1 M98 P300").aux(), "M50 M60 M30");
  bench.add("O301", std::string(kLine) + " M99\n");
  EXPECT_EQ(run_on(bench, "G66 P200\nM98 P301\nM70").aux(), "M50 M50 M50 M70 M30");
  EXPECT_EQ(run_on(bench, "G81 Z-8. R3. L0 F150\nG66 P200\n" + std::string(kLine) + " M0").aux(), "M0 M50 M50 M50 M30");  // over the first hole
  bench.param("MSTB_AFTER_MOTION", "1");
  EXPECT_EQ(run_on(bench, "G66 P200\nX1. M8").aux(), "M8 M50 M30");
  EXPECT_EQ(run_on(bench, "G66 P200\n" + std::string(kLine) + " M8").aux(), "M50 M50 M8 M50 M30");
}

TEST(PatternMacro, NotInTheBlockThatEndsTheCall) {
  Bench bench = bench_with();
  const Outcome run = run_on(bench, std::string(kCall) + "G67 " + kLine + "\nG66 P200");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 0);
  EXPECT_EQ(run.path().size(), 3u);
}

/// Single block stops behind the move to each place and behind each block of the macro.
TEST(PatternMacro, SingleBlock) {
  const auto stops = [](const std::string& text, const std::string& before) {
    Bench bench = bench_with("O200\nM50\nM99\n");
    Path all;
    for (const Step& step : run_on(bench, before + "G66 P200\n" + text).steps)
      if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.stop) all.push_back(brief(step.machine.v[0]) + " " + brief(step.machine.v[1]) + " " + brief(step.machine.v[2]) + " d" + brief(step.item.source.depth));
    return all;
  };
  EXPECT_EQ(stops(kLine, "").size(), stops(kLineAsBlocks, "").size());
  EXPECT_EQ(stops(kLine, ""), stops(kLineAsBlocks, ""));
  EXPECT_EQ(stops(kLine, "G81 Z-8. R3. L0 F150\n"), stops(kLineAsBlocks, "G81 Z-8. R3. L0 F150\n"));
}

TEST(PatternMacro, Alarms) {
  Bench bench = bench_with("O200\n#100=#100+1\nIF [#100 LT 2] GOTO 5\nG1 X1. F0\nZ[1/0]\nN5 M99\n");
  const Outcome run = run_on(bench, std::string("G66 P200\n") + kLine);
  EXPECT_NE(run.alarm, "");
  EXPECT_EQ(run.var(100), 2);
  bench.add("O200", "G66 P200\nX9.\nM99\n");
  EXPECT_EQ(run_on(bench, std::string("G66 P200\n") + kLine).alarm, "P273");   // in one another without an end
  bench.add("O200", kCycle);
  EXPECT_EQ(run_on(bench, std::string(kCall) + "G34 X0 Y0 I5. K0").alarm, "P221");
  EXPECT_EQ(run_on(bench, std::string(kCall) + "G34 X0 Y0 I5. K0").var(100), 0);
  EXPECT_EQ(run_on(bench, "G94 G1 F0\n" + std::string(kCall) + kLine).alarm, "P62");
  bench.add("O200", "G93\n#100=#100+1\nM99\n");
  EXPECT_NE(run_on(bench, "F100 G1\nG66 P200\n" + std::string(kLine)).alarm, "");  // the second place has no feed
  // What an alarm or the operator has left of a pattern is nothing to the next program.
  bench.add("O200", kCycle);
  EXPECT_EQ(run_on(bench, "G66 P200 R-10. Z-5. F120\n" + std::string(kLine)).var(100), 3);
}

TEST(PatternMacro, AProgramBegunAnewInAPatternBeginsAtItsHead) {
  Bench bench = bench_with();
  const std::string text = "G0 G90\n#100=0\n" + std::string(kCall) + kLine + " M98 P300\nG67\nM30";
  bench.add("O300", "M60\nM99\n");
  const Outcome whole = bench.at(0, 0, 50).run(text);
  ASSERT_EQ(whole.alarm, "");
  for (size_t items = 0; items < whole.steps.size(); items += 3) {
    bench.at(0, 0, 50).start(text);
    Step step;
    for (size_t i = 0; i < items; ++i) ASSERT_EQ(bench.pull(&step), NC_OK);
    EXPECT_EQ(doings(bench.at(0, 0, 50).run(text)), doings(whole)) << items;
  }
}

TEST(PatternMacro, GoesOnFromEveryMark) {
  const auto macros = [](Bench& bench) {
    bench.add("O200", kCycle);
    bench.add("O201", "G35 X[#5041+1.] Y#5042 I1. K2 M98 P300\n#100=#100+1\nM99\n");
    bench.add("O300", "M60\nM99\n");
    bench.at(0, 0, 50);
  };
  goes_on_from_every_mark("#100=0\nG0 G90\n" + std::string(kCall) + kLine + "\nG67\nM30", macros);
  goes_on_from_every_mark("#100=0\nG0 G90\nG66 P200 R-10. Z-5. F120\nG66 P201\n" + std::string(kLine) + " M8\nG67\nG67\nM30", macros);
  goes_on_from_every_mark("#100=0\nG0 G90\nG81 Z-8. R3. L0 F150\nG66 P201\n" + std::string(kLine) + " M0\nG67\nM30", macros);
}

TEST(PatternMacro, AMarkOfItsOwnOnlyWhereTheBlockHasEnded) {
  Bench bench = bench_with();
  const Outcome run = run_on(bench, std::string(kCall) + kLine);
  unsigned marks = 0;
  for (const Step& step : run.steps) marks += step.item.kind == NC_ITEM_MARK && step.item.u.mark.report && step.item.source.line == 4 && step.item.source.depth == 0 ? 1 : 0;
  EXPECT_EQ(marks, 1u);
}

TEST(PatternMacro, AsManyPlacesAsAPatternHas) {  // more than anything has room for
  Bench bench = bench_with("O200\n#100=#100+1\nM99\n");
  const Outcome grid = run_on(bench, "G66 P200\nG37.1 X0 Y0 I1. P250 J1. K200");
  EXPECT_EQ(grid.alarm, "");
  EXPECT_EQ(grid.var(100), 50000);
  EXPECT_EQ(grid.moves().size(), 49999u);  // it stands at the first one
  EXPECT_EQ(grid.moves().back().machine.v[1], 199);
}

/// The text is longer than the window through which it is read, and so is the macro.
TEST(PatternMacro, IsReadThroughASmallWindow) {
  std::string padding;
  for (int i = 0; i < 300; ++i) padding += "(nothing to do in this line)\n";
  expect_as_blocks(padding + kLine + "\n" + padding, padding + kLineAsBlocks + "\n" + padding, "", "O200\nM50\n" + padding + "G0 Z40.\nM99\n");
}

TEST(PatternMacro, ABlockThatIsSkippedIsSkippedWhole) {
  Bench bench = bench_with();
  nc_switches_set(bench.control(), 0, 1u << 1, 0);
  EXPECT_EQ(run_on(bench, std::string(kCall) + "/" + kLine).var(100), 0);
}

/// 13.12: the interrupt program at every item of the pattern and of its macros, of both types. It has a pattern of its own, with another macro.
TEST(PatternMacro, AnInterruptProgramLosesNoPlace) {
  for (const char* type_2 : {"0", "1"}) {
    const std::string text = "G0 G90\n#100=0\n#110=0\nM96 P1000\nG66 P200\n" + std::string(kLine) + "\nG67\nM97\nM30";
    for (unsigned at = 8;; ++at) {
      Bench bench = bench_with("O200\n#100=#100+1\nM50\nM99\n");
      bench.add("O201", "O201\n#110=#110+1\nM99\n");
      bench.param("1113", type_2);
      bench.add("O1000", "G66 P201\nG35 X1. Y1. I1. K2\nG67\nM99\n");
      bench.at(0, 0, 50).start(text);
      Step step;
      unsigned items = 0;
      bool cut = false;
      while (bench.pull(&step) == NC_OK) {
        bool take_back = false, ignored = false;
        if (items++ != at) continue;
        EXPECT_EQ(nc_interrupt_signal(bench.control(), 0, true, &take_back), NC_OK);
        nc_interrupt_signal(bench.control(), 0, false, &ignored);
        cut = take_back && step.item.kind == NC_ITEM_MOVE;
      }
      nc_alarm alarm{};
      EXPECT_NE(nc_alarm_get(bench.control(), 0, &alarm), NC_OK) << alarm.code << " " << at;
      if (items <= at) break;
      // Type 1 with moves loses the rest of the block that it has cut (macros.md): of a pattern, its places.
      if (!cut) {
        EXPECT_EQ(bench.var_now(100), 3) << at << " type " << type_2;
      }
      EXPECT_TRUE(bench.var_now(110) == 0 || bench.var_now(110) == 2) << at;
    }
  }
}

/// Two part systems in patterns of their own at the same time, item by item in turns, with one macro.
TEST(PatternMacro, OfEachPartSystemGoesItsOwnWay) {
  const auto text = [](const char* pattern) { return "G0 G90\nG66 P200\n" + std::string(pattern) + "\nG67\nM30"; };
  const std::string texts[2] = {text("G37.1 X10. Y10. I5. P3 J5. K2"), text("G35 X-10. Y0 I7. J90. K4")};
  const std::string macro = "O200\nG91 G0 Z-5.\nZ5.\nG90\nM99\n";
  const auto places = [&](bool both) {
    Bench bench(NC_DIALECT_M700, [](nc_config& c) {
      c.system_count = 2;
      c.system[1] = c.system[0];
    });
    bench.add("O200", macro);
    std::vector<std::array<double, 3>> ends[2];
    for (unsigned system = 0; system < 2; ++system) {
      unsigned file = 0;
      EXPECT_EQ(nc_program_add_text(bench.control(), system == 0 ? "one" : "two", texts[system].data(), texts[system].size(), &file), NC_OK);
      EXPECT_EQ(nc_program_select(bench.control(), system, file), NC_OK);
    }
    bool open[2] = {true, true};
    while (open[0] || open[1]) {
      for (unsigned system = 0; system < 2; ++system) {
        if (!open[system] || (!both && system == 1 && open[0])) continue;
        nc_item item;
        const nc_status status = nc_pull(bench.control(), system, 1000, &item);
        if (status == NC_OK && item.kind == NC_ITEM_MOVE) ends[system].push_back({item.u.move.machine.v[0], item.u.move.machine.v[1], item.u.move.machine.v[2]});
        EXPECT_TRUE(status == NC_OK || status == NC_ENDED || status == NC_BUDGET);
        open[system] = status == NC_OK || status == NC_BUDGET;
      }
    }
    ends[0].insert(ends[0].end(), ends[1].begin(), ends[1].end());
    return ends[0];
  };
  EXPECT_EQ(places(true), places(false));
  EXPECT_EQ(places(true).size(), 6u * 3 + 4 * 3);
}

}  // namespace
}  // namespace nc::test
