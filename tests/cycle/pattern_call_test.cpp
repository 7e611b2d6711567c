// SPDX-License-Identifier: Apache-2.0
// Patterns of holes (M700 13.2) under a modal macro call (13.5.1): the macro is called at each place, as behind blocks that go to the places one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cycle/pattern.hpp"
#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

std::string word(char letter, double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%c%.9f", letter, value);
  return text;
}

/// A pattern as its block says it, and as blocks that go to its places.
struct Written {
  std::string block, places;
};

Written random_pattern(std::mt19937_64& random) {
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  const auto length = [&] { return 0.5 * (1 + below(40)); };
  const double x = below(100), y = below(100);
  HolePattern p;
  p.kind = static_cast<PatternKind>(1 + below(4));
  p.columns = 1 + below(6);
  p.interval = length();
  p.angle = below(360);
  Written w;
  const std::string at = word('X', x) + word('Y', y) + word('I', p.interval);
  switch (p.kind) {
    case PatternKind::circle:
      p.step = below(2) == 0 ? 1 : -1;
      w.block = "G34" + at + word('J', p.angle) + "K" + std::to_string(static_cast<int>(p.step) * static_cast<int>(p.columns));
      break;
    case PatternKind::line: w.block = "G35" + at + word('J', p.angle) + "K" + std::to_string(p.columns); break;
    case PatternKind::arc:
      p.step = 1.0 + below(90);
      w.block = "G36" + at + word('J', p.angle) + word('P', p.step) + "K" + std::to_string(p.columns);
      break;
    default:
      p.kind = PatternKind::grid;
      p.rows = 1 + below(4);
      p.interval_2 = length();
      p.angle = 0;
      w.block = "G37.1" + at + "P" + std::to_string(p.columns) + word('J', p.interval_2) + "K" + std::to_string(p.rows);
  }
  for (uint32_t n = 0; n < p.count(); ++n) {
    double place[2];
    place_of_hole(p, n, place);
    w.places += word('X', x + place[0]) + word('Y', y + place[1]) + "\n";
  }
  return w;
}

/// The same program twice: with a pattern, and with its places one by one.
TEST(PatternCall, IsTheSameAsBlocksThatGoToThePlaces) {
  const char* const kMacros[] = {
      "G91 G1 Z-#1 F100\nG0 Z#1\nG90\nM99",            // a cycle of the user's own
      "#500=#500+1\nG91 X1. Y-2.\nX-1. Y2.\nG90\nM99",  // goes away and comes back by whatever is in force
      "G98 G81 Z-8. R3. L0 F150\nX#1\nG80\nM99",        // a cycle of the control in the macro, which leaves the place
      "M8\n#500=#500+#1\nM9\nM99",
      "IF [#500 GT 3] GOTO 5\n#500=#500+1\nG1 X#1 F50\nN5 M99",
  };
  const char* const kBefore[] = {"G0", "G1 F200", "G99 G81 Z-5. R2. L0 F100", "G98 G83 Z-9. R2. Q4. L0 F100", "G68 X5. Y3. R30.\nG0", "G51.1 X0\nG0"};
  std::mt19937_64 random(7);
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  const uint64_t seeds = nc::test::seeds(400, 60);
  unsigned called = 0;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const Written pattern = random_pattern(random);
    const std::string head = std::string("G90 G17 G21 G94 S1000 M3\n") + kBefore[below(std::size(kBefore))] + "\nG66 P200 A" + std::to_string(1 + below(5)) + ". L" + std::to_string(below(3)) + "\n";
    const std::string tail = "\nG67\nG80\nG0 X0 Y0\nM30";
    const std::string macro = kMacros[below(std::size(kMacros))];
    const auto run = [&](const std::string& middle) {
      Bench bench;
      bench.add("O200", macro);
      return bench.at(1, 2, 20).var(500, 0).run(head + middle + tail);
    };
    const Outcome by_pattern = run(pattern.block), by_places = run(pattern.places);
    SCOPED_TRACE(head + pattern.block + "\n" + macro);
    ASSERT_EQ(by_pattern.alarm, by_places.alarm);
    ASSERT_EQ(by_pattern.path(), by_places.path());
    ASSERT_EQ(by_pattern.aux(), by_places.aux());
    ASSERT_EQ(brief(by_pattern.var(500)), brief(by_places.var(500)));
    called += by_pattern.alarm.empty() && by_pattern.var(500) > 0;
  }
  EXPECT_GT(called, seeds / 10);
}

Outcome run_with(const std::string& program, const std::string& macro, const std::string& other = "M99") {
  Bench bench;
  bench.add("O200", macro);
  bench.add("O300", other);
  return bench.at(0, 0, 20).var(500, 0).var(501, 0).run("G90 G0\n" + program + "\nM30");
}

TEST(PatternCall, WhatTheBlockSaysElseCountsOnce) {
  const Outcome run = run_with("G66 P200\nG35 X0 Y0 I5. J0 K4 S500 M8\nG67", "#500=#500+1\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.aux(), "S500 M8 M30");
  EXPECT_EQ(run.var(500), 4);
}

TEST(PatternCall, TheProgramThatTheBlockCallsComesBehindTheLastPlace) {
  const Outcome run = run_with("G66 P200\nG35 X1. Y0 I5. J0 K3 M98 P300\nG67", "#500=#500+1\nM99", "#501=#500*10\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 11 0 20"}));
  EXPECT_EQ(run.var(501), 30);
}

TEST(PatternCall, L0GoesToThePlacesAndCallsNothing) {
  const Outcome run = run_with("G66 P200 L0\nG35 X1. Y0 I5. J0 K3\nG67", "#500=#500+1\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(500), 0);
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 11 0 20"}));
}

TEST(PatternCall, TheOtherPlacesAreGoneToWhereTheMacroHasEndedItsCall) {
  const Outcome run = run_with("G66 P200\nG35 X1. Y0 I5. J0 K4\nX0", "#500=#500+1\nIF [#500 LT 2] GOTO 5\nG67\nN5 M99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(500), 2);
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 11 0 20", "rapid 16 0 20", "rapid 0 0 20"}));
}

// Where the macro has ended its call amid the pattern, a block behind it that is read again for its M98 has nothing of that pattern.
TEST(PatternCall, APatternWhoseCallHasEndedLeavesNothingBehind) {
  const Outcome run = run_with("G66 P200\nG35 X1. Y0 I5. J0 K4\n#500=10\nG66 P200\nX50. M98 P300\nG67\nX0", "#500=#500+1\nIF [#500 NE 2] GOTO 5\nG67\nN5 M99", "#501=#501+1\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 11 0 20", "rapid 16 0 20", "rapid 50 0 20", "rapid 0 0 20"}));
  EXPECT_EQ(run.var(501), 1);
}

TEST(PatternCall, AReturnToASequenceNumberLeavesThePattern) {
  const Outcome run = run_with("G66 P200\nG35 X1. Y0 I5. J0 K4\nX50.\nN7 G67\nX2. M98 P300\nG66 P200\nX3.\nG67\nX4.", "#500=#500+1\nIF [#500 NE 2] GOTO 5\nM99 P7\nN5 M99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 2 0 20", "rapid 3 0 20", "rapid 4 0 20"}));
  EXPECT_EQ(run.var(500), 3);
}

TEST(PatternCall, ThePatternLiesWhereItsBlockHasFoundIt) {  // whatever the macro does to the plane, to the variables of its words, to G90
  const Outcome run = run_with("#510=5.\nG66 P200\nG91 G35 X1. Y1. I#510 J0 K3\nG90 G17 G67", "G18 G90\n#510=#510+100.\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 1 20", "rapid 6 1 20", "rapid 11 1 20"}));
}

TEST(PatternCall, PatternsNest) {  // in the macro of the last call that of the one before is in force
  const Outcome run = run_with("G66 P300\nG66 P200\nG35 X10. Y0 I20. J0 K2\nG67\nG67\nX0", "G35 X#5001 Y5. I1. J90. K2\nM99", "#500=#500+1\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 10 0 20", "rapid 10 5 20", "rapid 10 6 20", "rapid 30 0 20", "rapid 30 5 20", "rapid 30 6 20", "rapid 0 6 20"}));
  EXPECT_EQ(run.var(500), 4);
}

TEST(PatternCall, AnAlarmOfTheMacroEndsItAtItsPlace) {
  const Outcome run = run_with("G66 P200\nG35 X1. Y0 I5. J0 K4", "#500=#500+1\nIF [#500 LT 3] GOTO 5\nG1 G999\nN5 M99");
  EXPECT_EQ(run.alarm, "P34");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 11 0 20"}));
}

TEST(PatternCall, ACycleThatTheMacroLeavesInForceDrillsAtTheNextPlaces) {
  const Outcome run = run_with("G66 P200\nG35 X1. Y0 I5. J0 K3\nG67\nG80", "IF [#500 EQ 1] GOTO 5\n#500=1\nG98 G81 Z-3. R2. L0 F100\nN5 M99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"rapid 1 0 20", "rapid 6 0 20", "rapid 6 0 2", "line 6 0 -3 F100", "rapid 6 0 20", "rapid 11 0 20", "rapid 11 0 2", "line 11 0 -3 F100", "rapid 11 0 20"}));
}

TEST(PatternCall, ThousandsOfPlacesTakeNoMoreMemory) {
  const Outcome run = run_with("G66 P200\nG37.1 X0 Y0 I1. P90 J1. K100\nG67", "#500=#500+1\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(500), 9000);
  EXPECT_EQ(run.moves().size(), 8999u);  // it stands at the first one
}

/// Blocks that were read ahead may be taken back at any mark: what comes behind it is the same again.
TEST(PatternCall, IsReadAgainFromAnyMark) {
  const char* const kMacro = "#500=#500+1\nG91 G1 Z-#500 F100\nG0 Z#500\nG90\nM99";
  const char* const kProgram = "G90 G0\nG66 P200\nG37.1 X0 Y0 I5. P3 J5. K2\nG67\nX0\nM30";
  Bench bench;
  bench.add("O200", kMacro);
  const Outcome run = bench.at(0, 0, 20).var(500, 0).run(kProgram);
  ASSERT_EQ(run.alarm, "");
  const std::vector<std::string> path = run.path();
  nc_axes at{};
  unsigned tried = 0;
  for (size_t n = 0, moves = 0; n < run.steps.size(); ++n) {
    if (run.steps[n].item.kind == NC_ITEM_MOVE) ++moves, at = run.steps[n].machine;
    if (run.steps[n].item.kind != NC_ITEM_MARK || n + 9 > run.steps.size()) continue;
    Bench again;
    again.add("O200", kMacro);
    again.at(0, 0, 20).var(500, 0).start(kProgram);
    (void)again.finish(1000, static_cast<unsigned>(n) + 8);
    if (again.rewind(run.steps[n].item.serial, at) != NC_OK) continue;
    ++tried;
    const Outcome rest = again.finish();
    EXPECT_EQ(rest.path(), std::vector<std::string>(path.begin() + static_cast<std::ptrdiff_t>(moves), path.end())) << "line " << run.steps[n].item.source.line;
    EXPECT_EQ(rest.var(500), 6);
  }
  EXPECT_GT(tried, 10u);
}

}  // namespace
}  // namespace nc::test
