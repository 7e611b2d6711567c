// SPDX-License-Identifier: Apache-2.0
// HX 2.3.4, PI 133: where a start behind a reset begins. 0: at the head of the program; 2: with the block that the reset has stopped, in the modes of before.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "online_helpers.hpp"

namespace nc::test {
namespace {

class ProgramRestart : public testing::Test {
 protected:
  /// Runs `text` until the axis X is beyond `x`, and presses reset.
  void stop_beyond(double x, const char* pi_133, const std::string& text) {
    bench.emplace(NC_DIALECT_HX, machine(64));
    bench->tool(1, 3, NC_TOOL_RADIUS).param("3133", pi_133);
    drive.emplace(*bench, text);
    for (unsigned n = 0; n < kMost && drive->out.command.v[0] < x; ++n) drive->press_start(), drive->step();
    EXPECT_GE(drive->out.command.v[0], x);
    reset();
  }
  void reset() {
    drive->in.cycle_start = false;
    drive->in.reset = true;
    drive->step();
    drive->in.reset = false;
    for (unsigned n = 0; n < kMost && drive->out.state != NC_STATE_IDLE; ++n) drive->step();
    drive->step();
    ASSERT_EQ(drive->out.state, NC_STATE_IDLE);
  }
  /// Presses start, and runs to the end. @return the lines of the blocks that have ended
  std::vector<unsigned> go_on() {
    const size_t before = drive->events.size();
    drive->ended = false;
    for (unsigned n = 0; n < kMost && !drive->ended; ++n) drive->in.cycle_start = n == 2, drive->step();
    EXPECT_TRUE(drive->ended);
    std::vector<unsigned> lines;
    for (size_t i = before; i < drive->events.size(); ++i)
      if (drive->events[i].kind == NC_ITEM_MARK) lines.push_back(drive->events[i].source.line);
    return lines;
  }
  /// Presses start: the block of this line does not begin where the axes stand, and the alarm has these words in its sentence.
  void expect_no_start_inside(unsigned line, const char* words, const std::string& what) {
    drive->in.cycle_start = true;
    for (unsigned n = 0; n < 100; ++n) drive->step(), drive->in.cycle_start = false;
    EXPECT_EQ(drive->alarm(), "NC-MODE") << what;
    nc_alarm alarm{};
    ASSERT_EQ(nc_alarm_get(bench->control(), 0, &alarm), NC_OK) << what;
    EXPECT_EQ(alarm.source.line, line) << what;
    EXPECT_NE(std::string(alarm.detail.s).find(words), std::string::npos) << alarm.detail.s;
  }
  double x() const { return drive->out.command.v[0]; }
  double y() const { return drive->out.command.v[1]; }

  static constexpr unsigned kMost = 20000;
  std::optional<Bench> bench;
  std::optional<Drive> drive;
};

const char kPart[] = "G90 G00 X10.\n#100=#100+1\nG01 X20. F1200\nX40.\nY5.\nM30\n";

TEST_F(ProgramRestart, BeginsAtTheHeadWhereNothingElseIsSaid) {
  stop_beyond(25, "0", kPart);
  EXPECT_EQ(go_on(), (std::vector<unsigned>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(bench->var_now(100), 2);
}

TEST_F(ProgramRestart, GoesOnWithTheBlockThatWasStopped) {
  stop_beyond(25, "2", kPart);
  const double stopped = x();
  EXPECT_LT(stopped, 39);
  EXPECT_EQ(go_on(), (std::vector<unsigned>{4, 5, 6})) << "G01 and F are in force";
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_EQ(x(), 40);
  EXPECT_EQ(y(), 5);
  EXPECT_EQ(bench->var_now(100), 1);
  // A program that has ended begins at its head again.
  EXPECT_EQ(go_on(), (std::vector<unsigned>{1, 2, 3, 4, 5, 6}));
}

TEST_F(ProgramRestart, FurtherResetsLeaveThePlaceAndASelectionDoesNot) {
  stop_beyond(25, "2", kPart);
  reset();
  EXPECT_EQ(go_on(), (std::vector<unsigned>{4, 5, 6}));
  stop_beyond(25, "2", kPart);
  bench->start(kPart);
  EXPECT_EQ(go_on(), (std::vector<unsigned>{1, 2, 3, 4, 5, 6}));
}

TEST_F(ProgramRestart, AnIncrementThatWasStoppedInItsMiddleIsAnAlarm) {
  stop_beyond(5, "2", "G91 G01 X20. F1200\nG90 Y5.\nM30\n");
  const double stopped = x();
  drive->in.cycle_start = false;
  drive->step();
  drive->in.cycle_start = true;
  for (unsigned n = 0; n < 2000 && drive->alarm().empty(); ++n) drive->step();
  EXPECT_EQ(drive->alarm(), "NC-MODE");
  EXPECT_EQ(x(), stopped) << "the whole increment from here would end beside the part";
}

TEST_F(ProgramRestart, GoesOnInSubProgramsLoopsAndMacros) {
  stop_beyond(25, "2", "G90 G01 F1200\n#1=7\nG65 P2 A20.\nX[#1]\nM30\nO2\n#2=0\nWHILE [#2 LT 3] DO 1\nX[#1+#2*10]\n#2=#2+1\nEND 1\nM99\n");
  EXPECT_EQ(drive->alarm(), "");
  const std::vector<unsigned> lines = go_on();
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.front(), 9u);
  EXPECT_EQ(lines.back(), 5u);
  EXPECT_EQ(x(), 7) << "each level has its variables";
}

// Going on in the middle of these would cut beside the path.
TEST_F(ProgramRestart, BeginsAtTheHeadWhereTheModesNeedTheBlocksInFront) {
  stop_beyond(25, "2", "G90 G01 F1200 X1.\nG41 D1 X10. Y5.\nX40.\nG40 X50. Y9.\nM30\n");
  EXPECT_EQ(go_on().front(), 1u) << "radius compensation";
  stop_beyond(25, "2", "G90 G00 X1.\nG99 G81 X10. Z-1. R1. F1200\nX40.\nG80\nM30\n");
  EXPECT_EQ(go_on().front(), 1u) << "a cycle";
  stop_beyond(25, "2", "G90 G01 F1200 X1.\nG66 P2\nX40.\nG67\nM30\nO2\nY1.\nM99\n");
  EXPECT_EQ(go_on().front(), 1u) << "a modal call";
}

// From the middle of an arc its centre would be another one, and a cycle would take the height in the hole for its initial level.
TEST_F(ProgramRestart, WhatIsNoLineDoesNotBeginInItsMiddle) {
  for (const char* text : {"G90 G01 F1200 X1.\nG02 X21. I10.\nM30\n", "G90 G01 F1200 X1.\nG02 X21. R10.\nM30\n", "G90 G00 X1. F1200\nG99 G81 X20. Z-1. R1.\nM30\n",
                           "G90 G00 X1. F1200\nG28 X30.\nM30\n", "G90 G00 X1. F1200\nG31 X20.\nM30\n"}) {
    stop_beyond(5, "2", text);
    expect_no_start_inside(2, "in its middle", text);
    reset();
    EXPECT_EQ(go_on().front(), 1u) << "behind the alarm it begins at its head";
  }
}

// A line to a corner goes on from where the axes stand on it, and its corner is made as it is programmed. On the corner itself there is no such line.
TEST_F(ProgramRestart, ALineGoesOnToItsCornerAndNoneBeginsOnIt) {
  for (const char* corner : {",R5.", ",C5."}) {
    const std::string text = std::string("G90 G01 F1200 X1.\nX20. ") + corner + "\nY20.\nM30\n";
    stop_beyond(8, "2", text);
    ASSERT_LT(x(), 14);
    EXPECT_EQ(go_on(), (std::vector<unsigned>{2, 3, 4})) << corner;
    EXPECT_EQ(drive->alarm(), "");
    EXPECT_EQ(x(), 20);
    EXPECT_EQ(y(), 20);
    stop_beyond(16, "2", text);
    EXPECT_GT(y(), 0.01);
    EXPECT_LT(y(), 4.9);
    expect_no_start_inside(2, "in its middle, at its corner", corner);
    reset();
    EXPECT_EQ(go_on().front(), 1u) << "behind the alarm it begins at its head";
  }
}

// Braked near the end of a chamfer the axes stand where the words of the block lead, and the block has not ended yet.
TEST_F(ProgramRestart, AtTheEndOfAChamferNoLineBegins) {
  unsigned at_end = 0;
  for (double beyond = 15.5; beyond < 20; beyond += 0.125) {
    stop_beyond(beyond, "2", "G90 G01 X20. ,C5. F6000\nY20.\nM30\n");
    at_end += x() == 20 && std::abs(y() - 5) < 1e-6 ? 1 : 0;
    expect_no_start_inside(1, "in its middle, at its corner", std::to_string(beyond));
  }
  EXPECT_GT(at_end, 0u);
}

// What is stopped in the first block of a program is stopped in its middle as well.
TEST_F(ProgramRestart, TheFirstBlockIsNoOther) {
  for (const char* text : {"G90 G01 X20. ,R5. F1200\nY20.\nM30\n", "G90 G02 X20. R20. F1200\nG01 Y20.\nM30\n"}) {
    stop_beyond(16, "2", text);
    drive->in.cycle_start = true;
    for (unsigned n = 0; n < 100; ++n) drive->step(), drive->in.cycle_start = false;
    EXPECT_EQ(drive->alarm(), "NC-MODE") << text;
  }
  for (const char* text : {"G90 G01 X20. F1200\nY20.\nM30\n", "%\nG90 G01 X20. F1200\nY20.\nM30\n%\n"}) {
    stop_beyond(8, "2", text);
    const std::vector<unsigned> lines = go_on();
    ASSERT_GE(lines.size(), 3u) << text;
    EXPECT_EQ(drive->alarm(), "");
    EXPECT_EQ(x(), 20);
    EXPECT_EQ(y(), 20);
  }
}

TEST_F(ProgramRestart, NothingIsKeptBehindBlocksOfMdi) {
  stop_beyond(25, "2", kPart);
  static constexpr char kText[] = "G00 Y1.\n";
  ASSERT_EQ(nc_mdi_load(bench->control(), 0, kText, sizeof kText - 1), NC_OK);
  go_on();
  EXPECT_EQ(y(), 1);
}

TEST(ProgramRestartOffline, IsTheSameWhereBlocksArePulled) {
  for (const char* pi_133 : {"0", "2"}) {
    Bench bench(NC_DIALECT_HX);
    bench.param("3133", pi_133);
    bench.start("G90 G01 X10. F100\nX20.\nX30.\nX40.\nM30\n");
    for (unsigned marks = 0; marks < 2;) {
      Step step;
      ASSERT_EQ(bench.pull(&step), NC_OK);
      marks += step.item.kind == NC_ITEM_MARK ? 1 : 0;
    }
    ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
    ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
    const Outcome rest = bench.finish(1000, 1000);
    EXPECT_EQ(rest.path().front(), *pi_133 == '2' ? "line 30 0 0 F100" : "line 10 0 0 F100");
  }
}

}  // namespace
}  // namespace nc::test
