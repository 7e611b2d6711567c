// SPDX-License-Identifier: Apache-2.0
// Corner chamfering and rounding in programs (M700 13.7): words, alarms, other functions, rewinding, the machine.
#include <gtest/gtest.h>

#include "support/drive.hpp"
#include "support/going_back.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

/// Ends of the moves, without feeds.
Path ends_of(const Outcome& run) {
  Path all = run.work();
  for (std::string& text : all)
    if (const size_t feed = text.find(" F"); feed != std::string::npos) text.resize(feed);
  return all;
}

Path path_of(const std::string& text, const std::function<void(Bench&)>& change = [](Bench&) {}) {
  Bench bench;
  change(bench);
  const Outcome run = bench.run(text);
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  return ends_of(run);
}

std::string alarm_of(const std::string& text) {
  const Outcome run = m700(text);
  return run.alarm + " L" + std::to_string(run.alarm_line);
}

TEST(Corners, TheManualsExamples) {
  EXPECT_EQ(path_of("G91 G1 X100. ,C10. F200\nX100. Y100.\nM30"), (Path{"line 90 0 0", "line 107.071068 7.071068 0", "line 200 100 0"}));
  EXPECT_EQ(path_of("G91 G1 X100. ,R10. F200\nX100. Y100.\nM30"),
            (Path{"line 95.857864 0 0", "ccw 102.928932 2.928932 0 c95.857864,10", "line 200 100 0"}));
  EXPECT_EQ(path_of("G90 G1 Y-60. ,R5. ,C8. F150\nX45.\nM30"), (Path{"line 0 -52 0", "line 8 -60 0", "line 45 -60 0"}));  // the last one counts
  EXPECT_EQ(path_of("G90 G1 Y-60. ,C8. ,R5. F150\nX45.\nM30"), (Path{"line 0 -55 0", "ccw 5 -60 0 c5,-55", "line 45 -60 0"}));
}

TEST(Corners, TheSizeIsALength) {
  EXPECT_EQ(path_of("G91 G1 X50. ,C10000 F200\nY50.\nM30"), (Path{"line 40 0 0", "line 50 10 0", "line 50 50 0"}));
  EXPECT_EQ(path_of("G91 G20 G1 X2. ,C1. F200\nY2.\nM30"), (Path{"line 25.4 0 0", "line 50.8 25.4 0", "line 50.8 50.8 0"}));
  EXPECT_EQ(path_of("#1=5.\nG91 G1 X50. ,C[#1*2] F200\nY50.\nM30"), (Path{"line 40 0 0", "line 50 10 0", "line 50 50 0"}));
  EXPECT_EQ(path_of("G91 G1 X50. ,C0 F200\nY50.\nM30"), (Path{"line 50 0 0", "line 50 50 0"}));
  EXPECT_EQ(path_of("G91 G1 X50. F200 ,C#9\nY50.\nM30"), (Path{"line 50 0 0", "line 50 50 0"}));  // a vacant variable is no word
}

// The arc would be shorter than what has a direction, and in compensation smaller than the tool.
TEST(Corners, BlocksThatGoOnButForTheLastDigitHaveNone) {
  for (const std::string next : {"G1 X20. Y0.0001\n", "G1 X20. Y-0.0001\n", "G1 X20. Y0.001\n", "G3 X20. Y10. I0.0001 J10.\n"}) {
    const auto contour = [&next](const char* corner, bool compensated) {
      return std::string("G0 X-10. Y9.\n") + (compensated ? "G41 D1 " : "") + "G1 X0 Y0 F500\nX10. " + corner + "\n" + next + "G1 X30. Y40.\nG40 X50.\nM30";
    };
    const auto machine = [](Bench& bench) { bench.tool(1, 2).param("corner_ii", "1"); };
    EXPECT_EQ(path_of(contour(",R1.", false), machine), path_of(contour("", false), machine));
    EXPECT_EQ(path_of(contour(",R1.", true), machine), path_of(contour("", true), machine));
  }
  EXPECT_EQ(path_of("G1 X10. ,R1. F500\nX20. Y0.01\nM30").size(), 3u);  // a micrometre
}

TEST(Corners, Alarms) {
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nG2 X40. Y-10. J-10.\nM30"), "P381 L2");
  EXPECT_EQ(alarm_of("G1 X30. F100\nG2 X40. Y-10. J-10. ,R1.\nG1 X50.\nM30"), "P381 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nG4 X1.\nX20.\nM30"), "P382 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nM8\nX20.\nM30"), "P382 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nG0 X20.\nM30"), "P382 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nM30"), "P382 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nX#5041\nM30"), "P382 L2");  // a position that is known only after the corner
  EXPECT_EQ(alarm_of("G1 X30. ,C31. F100\nY40.\nM30"), "P383 L1");
  EXPECT_EQ(alarm_of("G1 X30. F100\nX30. ,C1.\nY40.\nM30"), "P383 L2");
  EXPECT_EQ(alarm_of("G1 X30. F100\n,C1.\nY40.\nM30"), "P383 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,R1. F100\nX5.\nM30"), "P383 L1");  // straight back: no arc fits
  EXPECT_EQ(alarm_of("G1 X30. ,R6. F100\nY5.5\nM30"), "P384 L2");
  EXPECT_EQ(alarm_of("G0 X30. ,R6.\nG1 Y5.5 F100\nM30"), "P385 L1");
  EXPECT_EQ(alarm_of("G33 Z30. F1. ,R6.\nG1 Y5.5 F100\nM30"), "P385 L1");
  EXPECT_EQ(alarm_of("G1 X30. ,C-4. F100\nY40.\nM30"), "P35 L1");
  EXPECT_EQ(alarm_of("G81 X30. Z-5. R1. F100 ,C1.\nM30"), "P380 L1");
  EXPECT_EQ(alarm_of("G4 X1. ,C1.\nM30"), "P380 L1");
  // A next block with an alarm of its own: that is what has to be mended, and nothing of the block before has happened.
  EXPECT_EQ(alarm_of("G1 X30. ,C4. F100\nG2 X40. Y-10. R1.\nM30"), "P71 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,R4. F100\n#1=1\nG1 Y4..5\nM30"), "P33 L3");
  EXPECT_EQ(alarm_of("G1 X30. ,R4. F100\nG1 Y20. F0\nM30"), "P62 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,R4. F100\nG101 Y20.\nM30"), "P270 L2");
  EXPECT_EQ(alarm_of("G1 X30. ,R4. F100\nY20. ,C1. ,Q\nM30"), "P39 L2");
  std::string statements = "G1 X30. ,C4. F100\n";
  for (unsigned i = 0; i < 40; ++i) statements += "#1=1\n";
  EXPECT_EQ(alarm_of(statements + "Y40.\nM30"), "P990 L1");
}

// Each alarm of radius compensation, of corners and of blocks that meet says in its sentence what to change, and the sentence is not cut off.
TEST(Corners, EachAlarmSaysWhatToChange) {
  struct {
    const char* program;
    const char* alarm;
    const char* tells;
  } const cases[] = {
      {"G38 I1.", "P150 L3", "Program G41 or G42 first."},
      {"G2 X9. I1.\nG41 D1 X20. I5.", "P151 L4", "on a straight move (G00 or G01)."},
      {"G41 D1 X17.\nG38 Y30. I0 J0", "P35 L4", "Give one of them a value."},
      {"G41 D1 X17. I0 J0 K0", "P35 L3", "Give one of them a value."},
      {"G41 D1 X17.\nX27.\nG3 X24. Y3. I-3.", "P152 L4", "Use a smaller tool or a larger inner radius."},
      {"G41 D1 X17.\nG39 Y30.\nM0\nX30.", "P152 L4", "move those, or leave it out."},
      {"G41 D1 X17.\nY30.\nG39\nM0\nX30.", "P152 L5", "Behind G39 a block has to move before a stop"},
      {"G41 D1 X17.\nY30.\nM8\nG39\nM9\nM8\nM9\nX30.", "P152 L6", "before four do not (its own counts)"},
      {"G41 D1 X17.\nY1.\nG3 X18. Y2. R1.\nG1 X30.", "P153 L5", "Use a smaller tool or change the contour."},
      {"G41 D1 X20.\nG81 Y20. Z-5. R1.", "P155 L4", "Cancel with G80 or G40 first."},
      {"G4 X1. ,C1.", "P380 L3", "Leave it out, or program it as a block of its own."},
      {"X20. ,R2.\nA30.\nX60. Y0 A-30.", "P380 L4", "Leave it out, or program it as a block of its own."},
      {"X20. ,C2.\nG2 X30. I5.", "P381 L4", "Program the corner as a block of its own."},
      {"X20. ,C2.\nM8", "P382 L4", "Move what stands between in front of the corner."},
      {"X8. ,C2.", "P383 L3", "Make the corner smaller."},
      {"X30. ,R1.\nX5.", "P383 L3", "Leave ,R out."},
      {"X20. ,C2.\nY1.", "P384 L4", "Make that corner smaller."},
      {"G0 X20. ,C2.", "P385 L3", "Program G01 first."},
      {"G0 X20. ,A45.", "P390 L3", "Program both ends."},
      {"G1 G60 X20. ,A45. F100", "P390 L3", "Program both ends."},
      {"G1 X20. ,C", "P33 L3", ""},
      {"G12 I5. D1 ,A30.", "P32 L3", ""},
      {"A10.\nX20. Y9. A10.5", "P392 L4", "Check the angles."},
      {"A10.\nG91 X20. Y9. A50.", "P393 L4", "Program G90."},
      {"A10.\nM8", "P394 L4", "must move: a line (G01) or an arc."},
      {"A10.\nX20. A50.", "P395 L4", "Give the second its whole end"},
      {"A10.\nX20. Y9.", "P395 L4", "a line its A"},
      {"A0\nG3 X20. Y50. R40. H2", "P395 L4", "0 or 1 chooses one of the two places"},
      {"X10. A90.", "P395 L3", "does not come to X10. Give the other coordinate of its end"},
      {"A10.\nG19 X20. Y9. A50.", "P396 L4", "Select it in front of both."},
      {"A0\nG3 X20. Y50. R1.", "P397 L4", "check the centre, the radius, the angle and the ends."},
      {"G0 X30. Z0\nG19 Z0 C0\nG7.1 C30.\nG1\nG3 R10. H1\nG1 Z60. C0 A80.", "P391 L7", "Program the end of each block."},
      {"G0 X30. Z0\nG19 Z0 C0\nG7.1 C30.\nG1\nG3 K10. H1\nG1 Z60. C0 A80.", "P398 L7", "Program the end of each block."},
  };
  for (const auto& part : cases) {
    Bench bench(NC_DIALECT_M700, axes("XYZc"));
    bench.tool(1, 2).param("1516", "C").param("1030", "C");
    const Outcome run = bench.run(std::string("G0 X7.\nG1 F100\n") + part.program + "\nX99.\nM30");
    EXPECT_EQ(run.alarm + " L" + std::to_string(run.alarm_line), part.alarm) << part.program;
    EXPECT_NE(run.alarm_detail.find(part.tells), std::string::npos) << part.program << ": " << run.alarm_detail;
    EXPECT_LT(run.alarm_detail.size(), size_t{NC_MAX_TEXT - 1}) << run.alarm_detail;
  }
}

TEST(Corners, NothingOfTheBlockHappensWhenItsCornerDoesNotFit) {  // as with a stroke limit, its M codes wait
  const Outcome run = m700("G1 X5. F100\nM3 X30. ,C4.\nM5 G4 X1.\nM30");
  EXPECT_EQ(run.alarm, "P382");
  EXPECT_EQ(run.aux(), "");
  EXPECT_EQ(ends_of(run), (Path{"line 5 0 0"}));
  EXPECT_EQ(run.end_work.v[0], 5);
}

TEST(Corners, WhatMayStandBetweenTheLines) {  // 13.7: "the block following the corner chamfering block does not have a linear command"
  const std::string tool = "G10 L10 P1 R2.\n";
  for (const char* size : {",C4.", ",R4."}) {
    for (const std::string start : {"G1 F100\n", "G41 D1 G1 Y0.001 F100\n"}) {
      const std::string line = start + "X30. " + size + "\n";
      const std::string behind = "Y40.\nG40 X60.\nM30";
      const Path path = path_of(tool + line + behind);
      for (const char* between : {"", "N7", "(TEXT)", "#100=1", "IF[1EQ0]GOTO9", "/", "N7\n\n#100=1\n(TEXT)"})
        EXPECT_EQ(path_of(tool + line + between + "\n" + behind), path) << start << between;
      for (const char* between : {"F200", "S1000", "M8", "T2", "G4 P10", "G90", "G17", "D2", "G10 L10 P2 R1.", "G1", "X30.", "M0", "M1"}) {
        const Outcome run = m700(tool + line + between + "\n" + behind);
        EXPECT_EQ(run.alarm + " L" + std::to_string(run.alarm_line), "P382 L4") << start << between;
      }
    }
  }
}

TEST(Corners, CodesAndStatementsBetweenTheLines) {
  const Outcome run = m700("G1 X30. ,C4. F100\n#100=1\n(TEXT)\nM8 Y40. ,R5.\nN7\nM9 X0\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(ends_of(run), (Path{"line 26 0 0", "line 30 4 0", "line 30 35 0", "ccw 25 40 0 c25,35", "line 0 40 0"}));
  EXPECT_EQ(run.aux(), "M8 M9 M30");
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{1, 2, 4, 5, 6, 7}));
  // The cut is a part of the first block, at its feed.
  EXPECT_EQ(run.moves()[1].feed_mm_min, 100);
  unsigned cuts = 0;
  for (const nc_item& item : run.of(NC_ITEM_MOVE)) cuts += item.source.line == 1;
  EXPECT_EQ(cuts, 2u);
}

TEST(Corners, Maps) {  // 13.7.1: the chamfer is scaled as well; a mirror turns the arc round
  EXPECT_EQ(path_of("G51 X0 Y0 P2.\nG1 X30. ,C4. F100\nY40.\nG50\nM30"), (Path{"line 52 0 0", "line 60 8 0", "line 60 80 0"}));
  EXPECT_EQ(path_of("G51 X0 Y0 P2.\nG1 X30. ,R4. F100\nY40.\nG50\nM30"), (Path{"line 52 0 0", "ccw 60 8 0 c52,8", "line 60 80 0"}));
  EXPECT_EQ(path_of("G51.1 X0\nG1 X30. ,R4. F100\nY40.\nG50.1 X0\nM30"), (Path{"line -26 0 0", "cw -30 4 0 c-26,4", "line -30 40 0"}));
}

TEST(Corners, RadiusCompensationActsOnTheShapeWithItsCorners) {
  const auto tool_path = [](const std::string& contour) {
    Bench bench;
    bench.tool(1, 3);
    const Outcome run = bench.run("G0 X-20. Y-20.\nG91 G1 G41 D1 X20. Y20. F100\n" + contour + "G40 X-20. Y-20.\nM30");
    EXPECT_EQ(run.alarm, "");
    return run.path();
  };
  const Path programmed = tool_path("X35.\nX5. Y5.\nY27.\nG3 X-8. Y8. R8.\nG1 X-32.\n");
  EXPECT_GT(programmed.size(), 7u);
  EXPECT_EQ(tool_path("X40. ,C5.\nY40. ,R8.\nX-40.\n"), programmed);
}

TEST(Corners, EveryMarkIsAPlaceToGoOnFrom) {
  goes_on_from_every_mark("G91 G1 X40. ,C4. F500\nY-30. ,C6.5\n#100=#100+1\nM8 X-50. ,R3.\nY30.\nG4 X1.\nX5.\nM30");
}

TEST(Corners, AlsoWhereOtherStagesHoldItemsBack) {
  const auto tool = [](Bench& bench) { bench.tool(1, 1).param("8103", "0"); };
  goes_on_from_every_mark("G0 X-20. Y-20.\nG91 G1 G41 D1 X20. Y20. F100\nX40. ,C5.\n#100=2\nM7 Y40. ,R8.\nX-20. ,C2.\nY5.\nX-20.\nG40 X-20. Y-20.\nM30", tool);
  const auto fine = [](Bench& bench) { bench.param("8033", "1").param("8029", "0.1").param("8036", "1").param("8037", "0.5"); };
  goes_on_from_every_mark("G5 P10000\nG1 X10. F1000\nY.08\nX20. ,R2.\nY20. ,C3.\nX30.\nY20.08\nX40.\nY30.\nG5 P0\nM30", fine);
}

TEST(BlocksThatMeet, EveryMarkIsAPlaceToGoOnFrom) {
  goes_on_from_every_mark("G1 F500\nA45.\n#100=#100+1\nX60. Y0 A135.\nA0 M8\nG3 X90. Y10. R10.\nG1 X-10. Y0\nG2 I10.\nG3 X25. Y15. R-15.\nG2 I10.\nM9\nG1 X0\nM30");
  const auto tool = [](Bench& bench) { bench.tool(1, 1).param("8103", "0"); };
  goes_on_from_every_mark("G1 G42 X-20. Y0 D1 F100\nA0\nG3 X10. Y10. R10.\nG1 Y40. ,R3.\nX50.\nA90.\nX30. Y70. A30.\nG40 X0\nM30", tool);
}

TEST(BlocksThatMeet, TheFirstOnesCodesWaitForTheSecond) {  // as with a stroke limit: what does not fit has not begun
  const Outcome run = m700("G1 X5. F100\nM3 A10.\nX50. Y9. A10.5\nM30");
  EXPECT_EQ(run.alarm, "P392");
  EXPECT_EQ(run.aux(), "");
  EXPECT_EQ(run.end_work.v[0], 5);
}

// An arc without an end is a whole circle (6.4) where the block behind is no second one of a pair. Where it is one, and the two do not meet, nothing of the first is cut.
TEST(BlocksThatMeet, ACircleInFrontOfAPairThatDoesNotFitIsNotCut) {
  for (const char* second : {"G3 X60. Y5. I3. J0", "G3 X60. Y5. R3.", "G2 X60. Y5. I3. J0", "G1 X60. Y50. A0"}) {
    const Outcome run = m700(std::string("G1 X10. F100\nM3 G2 I10. J0\n") + second + "\nM30");
    EXPECT_EQ(run.alarm, "P397") << second;
    EXPECT_EQ(run.alarm_line, 3u) << second;
    EXPECT_EQ(ends_of(run), (Path{"line 10 0 0"})) << second;
    EXPECT_EQ(run.aux(), "") << second;
  }
}

TEST(BlocksThatMeet, AResetForgetsThePendingBlock) {
  Bench bench;
  bench.start("G1 A45. F100\nX60. Y0 A135.\nM30");
  Step step;
  while (bench.pull(&step, 1) != NC_BUDGET) {
  }
  ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_EQ(ends_of(bench.run("G91 G1 X5. F100\nM30")), (Path{"line 5 0 0"}));
}

TEST(Corners, AResetForgetsThePendingMove) {
  Bench bench;
  bench.start("G1 X30. ,C4. F100\nY40.\nM30");
  Step step;
  while (bench.pull(&step, 1) != NC_BUDGET) {
  }
  ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
  const Outcome run = bench.run("G91 G1 X5. F100\nY5.\nM30");
  EXPECT_EQ(ends_of(run), (Path{"line 5 0 0", "line 5 5 0"}));
}

TEST(Corners, SingleBlockStopsBehindTheCut) {
  for (const std::string between : {"", "N7\n(TEXT)\n", "\n#100=1\n"}) {
    Bench bench;
    Drive drive(bench, "G91 G1 X5. ,C2. F6000\n" + between + "Y5. ,R2.\n" + between + "X-5.\nM30");
    drive.in.single_block = true;
    std::vector<nc_axes> stops;
    for (unsigned n = 0; n < 20000 && !drive.ended && stops.size() < 10; ++n) {
      drive.in.cycle_start = n % 400 == 2;
      const bool again = !stops.empty() && stops.back().v[0] == drive.out.command.v[0] && stops.back().v[1] == drive.out.command.v[1];  // behind a block that moves nothing
      if (n % 400 == 399 && !again) stops.push_back(drive.out.command);
      drive.step();
    }
    ASSERT_TRUE(drive.ended) << between;
    ASSERT_EQ(stops.size(), 3u) << between;
    EXPECT_NEAR(stops[0].v[0], 5, 1e-9) << between;
    EXPECT_NEAR(stops[0].v[1], 2, 1e-9) << between;
    EXPECT_NEAR(stops[1].v[0], 3, 1e-9) << between;
    EXPECT_NEAR(stops[1].v[1], 5, 1e-9) << between;
    EXPECT_NEAR(stops[2].v[0], 0, 1e-9) << between;
    EXPECT_NEAR(stops[2].v[1], 5, 1e-9) << between;
  }
}

}  // namespace
}  // namespace nc::test
