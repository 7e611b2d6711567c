// SPDX-License-Identifier: Apache-2.0
// Blocks of MDI in a block stop (M700 12.4.4): they run when cycle start is pressed, the machine stops behind them, and the next start goes on with the
// program. In radius compensation they are compensated, and the vectors are calculated anew at the movement behind.
#include <gtest/gtest.h>

#include <random>

#include "mdi_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using Machine = MdiMachine;

class MdiInterrupt : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, MdiInterrupt, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(MdiInterrupt, RunsInABlockStopAndTheProgramGoesOnBehindIt) {
  for (const bool single : {true, false}) {
    Machine m(GetParam());
    m.start("G90 G1 X10. F6000\nX20.\nX30. Y5.\nM30");
    ASSERT_TRUE(m.until_stop());
    m.expect_at(10, 0);
    ASSERT_EQ(m.load("Y20.\nG91 Z3.\nG90"), NC_OK);
    m.drive->in.single_block = single;
    ASSERT_TRUE(m.to_end_of_mdi()) << m.state();
    m.expect_at(10, 20, 3);
    m.drive->in.single_block = true;
    m.stops(1);
    EXPECT_EQ(m.drive->out.cause, NC_CAUSE_SINGLE_BLOCK);
    m.expect_at(20, 20, 3, 0.0101);  // the optimal mode stops on the rounding of a corner, within the tolerance
    EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
    m.expect_at(30, 5, 3);
    EXPECT_LT(m.worst, 1.001);
  }
}

// What blocks of MDI have changed stays changed: the program goes on incremental.
TEST_P(MdiInterrupt, TheModesThatItChangesStay) {
  Machine m(GetParam());
  m.start("G90 G1 X10. F6000\nX20.\nM30");
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.load("G91"), NC_OK);
  ASSERT_TRUE(m.to_end_of_mdi()) << m.state();
  EXPECT_TRUE(m.to_end_of_program());
  m.expect_at(30, 0);
}

// M700 12.4.4 (1): without a movement the tool path does not change.
TEST_P(MdiInterrupt, WithoutAMovementTheCompensatedPathDoesNotChange) {
  const char* const program = "G90 G41 D1 G1 X20. Y50. F6000\nX40. Y50.\nG3 X40. Y-40. R70.\nG1 X0\nG40 Y-60.\nM30";
  std::vector<nc_axes> ways[2];
  for (const bool mdi : {false, true}) {
    Machine m(GetParam());
    m.bench.tool(1, 4);
    m.start(program);
    for (unsigned stop = 0; stop < 12 && !m.drive->ended; ++stop) {
      ASSERT_TRUE(m.until_stop());
      ways[mdi].push_back(m.drive->out.command);
      if (mdi && m.drive->out.state == NC_STATE_STOPPED) {
        ASSERT_EQ(m.load("S1000 M3"), NC_OK);
        ASSERT_TRUE(m.to_end_of_mdi()) << m.state();
      }
      if (!m.drive->ended) m.press();
    }
    EXPECT_TRUE(m.drive->ended);
    EXPECT_EQ(m.drive->alarm(), "");
  }
  ASSERT_EQ(ways[0].size(), ways[1].size());
  for (size_t n = 0; n < ways[0].size(); ++n)
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(ways[0][n].v[i], ways[1][n].v[i], GetParam() ? 0.0101 : 1e-6) << n << " axis " << i;
}

// M700 12.4.4 (2): with a movement the vectors are calculated anew at the movement behind the interrupt: those of the blocks of MDI, and then of the program.
TEST_P(MdiInterrupt, WithAMovementTheVectorsAreCalculatedAnew) {
  Machine m(GetParam());
  m.start("G90 G41 D1 G1 X0 Y20. F6000\nY50.\nX60.\nY0\nG40 X80.\nM30");
  ASSERT_TRUE(m.until_stop());
  m.stops(1);
  m.expect_at(-4, 54, 0, 0.011);  // the corner to X60
  ASSERT_EQ(m.load("Y70.\nX20.\nY50."), NC_OK);
  m.drive->in.single_block = false;
  ASSERT_TRUE(m.to_end_of_mdi()) << m.state() << m.drive->alarm();
  m.expect_at(24, 54, 0, 0.011);  // the corner from Y50 to X60 of the program
  m.drive->in.single_block = true;
  m.stops(1);
  m.expect_at(64, 54, 0, 0.011);
  EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
  m.expect_at(80, 0);
  EXPECT_LT(m.worst, 1.001);
}

/// What is in the way of blocks of MDI in a stop, or what becomes of the program.
TEST_P(MdiInterrupt, IsRefusedInTheMiddleOfABlockAndWhileTheProgramRuns) {
  Machine m(GetParam());
  m.start("G90 G1 X100. F6000\nG81 X110. Z-5. R-1. F3000\nX120.\nG80\nM30");
  EXPECT_EQ(m.load("Y1."), NC_E_STATE) << "it runs";
  m.drive->in.feed_hold = true;
  m.step(600);
  ASSERT_EQ(m.drive->out.state, NC_STATE_HOLD);
  EXPECT_EQ(m.load("Y1."), NC_E_STATE) << "a hold in the middle of a block";
  m.drive->in.feed_hold = false;
  m.stops(1);
  m.expect_at(100, 0);
  m.stops(1);
  m.expect_at(110, 0);
  ASSERT_FALSE(m.drive->out.manual_allowed);
  EXPECT_EQ(m.load("Y1."), NC_E_STATE) << "over the hole, the rest of the cycle is to come";
  EXPECT_TRUE(m.to_end_of_program()) << m.state();
  EXPECT_LT(m.worst, 1.001);
}

TEST_P(MdiInterrupt, OneTextAtATimeAndTheNextBehindIt) {
  Machine m(GetParam());
  m.start("G90 G1 X10. F6000\nX20.\nM30");
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.load("Y5."), NC_OK);
  ASSERT_EQ(m.load("Y1.\nY2.\nY3."), NC_OK) << "it has not been started, so another one takes its place";
  m.stops(1);
  m.expect_at(10, 1);
  EXPECT_EQ(m.drive->out.cause, NC_CAUSE_SINGLE_BLOCK);
  EXPECT_EQ(m.load("Y9."), NC_E_STATE) << "the text before has not come to its end";
  ASSERT_TRUE(m.to_end_of_mdi());
  m.expect_at(10, 3);
  ASSERT_EQ(m.load("Z2."), NC_OK);
  ASSERT_TRUE(m.to_end_of_mdi());
  m.expect_at(10, 3, 2);
  ASSERT_EQ(m.load("Z7."), NC_OK);
  ASSERT_EQ(m.load(" \n"), NC_OK) << "an empty text takes back what waits";
  EXPECT_TRUE(m.to_end_of_program());
  m.expect_at(20, 3, 2);
}

TEST_P(MdiInterrupt, WhatEndsTheProgram) {
  struct {
    const char* text;
    const char* alarm;  ///< "" = the program has ended without one
  } const cases[] = {{"Y5.\nM30", ""}, {"M02", ""}, {"Y5.\nG999", "P34"}, {"WHILE [1 EQ 1] DO1\nY1.", "P294"}, {"G10 L70", "P36"}, {"M98 P4711", "P232"}};
  for (const auto& part : cases) {
    SCOPED_TRACE(part.text);
    Machine m(GetParam());
    m.start("G90 G1 X10. F6000\nX20.\nM30");
    ASSERT_TRUE(m.until_stop());
    ASSERT_EQ(m.load(part.text), NC_OK);
    EXPECT_FALSE(m.to_end_of_mdi());
    EXPECT_EQ(m.drive->alarm(), part.alarm);
    if (part.alarm[0] != 0) {
      m.drive->in.reset = true;
      m.step(5);
      m.drive->in.reset = false;
      m.step(20);
    }
    EXPECT_EQ(m.drive->out.state, NC_STATE_IDLE);
    EXPECT_NEAR(m.drive->out.command.v[0], 10, 1e-6);
    EXPECT_LT(m.worst, 1.001);
    m.drive->ended = false;
    m.bench.start("G90 G0 X1.\nM30");
    EXPECT_TRUE(m.to_end_of_program()) << "the machine is ready again";
  }
}

TEST_P(MdiInterrupt, CallsProgramsAndJumpsWithinItsText) {
  Machine m(GetParam());
  m.start("G90 G1 X10. F6000\nX20.\nM30\nO77\nG91 Y2.\nG90\nM99");
  ASSERT_TRUE(m.until_stop());
  m.drive->in.single_block = false;
  ASSERT_EQ(m.load("#100=0\nN1 M98 P77\n#100=#100+1\nIF [#100 LT 3] GOTO 1\nG65 P77"), NC_OK);
  ASSERT_TRUE(m.to_end_of_mdi()) << m.state() << m.drive->alarm();
  m.expect_at(10, 8);
  EXPECT_TRUE(m.to_end_of_program());
  m.expect_at(20, 8);
}

// M700 13.3.1 (3): M99 of MDI goes to the head of its text, not into the program.
TEST_P(MdiInterrupt, M99RepeatsTheTextUntilAReset) {
  Machine m(GetParam());
  m.start("G90 G1 X10. F6000\nX20.\nM30");
  ASSERT_TRUE(m.until_stop());
  m.drive->in.single_block = false;
  ASSERT_EQ(m.load("G91 Y1.\nM99"), NC_OK);
  m.press();
  m.step(3000);
  EXPECT_EQ(m.drive->out.state, NC_STATE_RUNNING);
  EXPECT_GT(m.drive->out.command.v[1], 4);
  EXPECT_NEAR(m.drive->out.command.v[0], 10, 1e-6);
  m.drive->in.reset = true;
  m.step(500);
  m.drive->in.reset = false;
  m.step(20);
  EXPECT_EQ(m.drive->out.state, NC_STATE_IDLE);
  EXPECT_LT(m.worst, 1.001);
}

TEST_P(MdiInterrupt, AResetDropsWhatWaits) {
  Machine m(GetParam());
  m.start("G90 G1 X10. F6000\nX20.\nM30");
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.load("Y5."), NC_OK);
  m.drive->in.reset = true;
  m.step(5);
  m.drive->in.reset = false;
  m.step(20);
  m.drive->ended = false;
  EXPECT_TRUE(m.to_end_of_program());
  m.expect_at(20, 0);
}

// A modal call of the program is not made behind the moves of MDI, and is in force again in the program.
TEST_P(MdiInterrupt, AModalCallIsOfTheProgramOnly) {
  Machine m(GetParam());
  m.start("G90 G1 F6000\nG66 P77\nX10.\nX20.\nG67\nM30\nO77\nG91 Y1.\nG90\nM99");
  ASSERT_TRUE(m.until_stop());
  for (unsigned n = 0; n < 12 && m.drive->out.command.v[1] < 0.999; ++n) m.stops(1);
  ASSERT_EQ(m.load("Z3."), NC_OK);
  ASSERT_TRUE(m.to_end_of_mdi()) << m.state() << m.drive->alarm();
  EXPECT_NEAR(m.drive->out.command.v[1], 1, 1e-6);
  EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
  m.expect_at(20, 2, 3);
}

TEST_P(MdiInterrupt, WithAxesMovedByHandBeforeAndBehind) {
  for (const bool off : {false, true}) {
    Machine m(GetParam());
    m.start("G90 G1 X10. F6000\nX20.\nX30. Y1.\nM30");
    ASSERT_TRUE(m.until_stop());
    const auto by_hand = [&m](unsigned axis, double by) {
      m.drive->in.manual[axis] = {NC_MANUAL_STEP, 0, by};
      m.step();
      m.drive->in.manual[axis] = {};
      m.step(800);
    };
    ASSERT_EQ(m.load("G91 Z1.\nG90"), NC_OK);
    m.drive->in.manual_absolute_off = off;
    by_hand(1, 7);
    ASSERT_TRUE(m.to_end_of_mdi()) << m.state();
    m.expect_at(10, 7, 1);
    by_hand(2, 2);
    EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
    m.expect_at(30, off ? 8 : 1, 3);
    EXPECT_LT(m.worst, 1.001);
  }
}

// A program in which the blocks of MDI stand where they came in gives the same path: in any stop of any program with radius compensation.
TEST_P(MdiInterrupt, AtAnyStopItIsAsIfTheBlocksStoodInTheProgram) {
  const uint64_t count = seeds(400, 60);
  unsigned compared = 0, compensated = 0, alarms = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    std::mt19937 random(seed);
    const auto draw = [&random](double low, double high) { return std::round(std::uniform_real_distribution<>(low, high)(random) * 1000) / 1000; };
    std::vector<std::string> blocks{"G90 G1 X0 Y0 F6000", random() % 2 == 0 ? "G41 D1 X20. Y20." : "G42 D1 X20. Y20."};
    double x = 20, y = 20, angle = draw(0, 6);
    const auto next = [&](double most) {
      angle += draw(-most, most);
      const double length = draw(12, 40);
      x += length * std::cos(angle), y += length * std::sin(angle);
      x = std::round(x * 1000) / 1000, y = std::round(y * 1000) / 1000;
      const bool arc = random() % 4 == 0;
      return (arc ? random() % 2 == 0 ? "G2 " : "G3 " : "G1 ") + ("X" + brief(x) + " Y" + brief(y)) + (arc ? " R" + brief(length + 20) : "");
    };
    for (unsigned n = 3 + random() % 4; n > 0; --n) blocks.push_back(next(1.2));
    const size_t stop = 1 + random() % (blocks.size() - 1);
    const double from_x = x, from_y = y;
    std::vector<std::string> mdi;
    switch (random() % 4) {
      case 0: mdi = {"S500"}; break;
      case 1: mdi = {"G91 Z" + brief(draw(-5, 5)), "G90"}; break;
      case 2: mdi = {"G91 G1 X" + brief(draw(-30, 30)) + " Y" + brief(draw(-30, 30)), "G90"}; break;
      default: mdi = {"G40", "G91 G1 X" + brief(draw(-30, 30)) + " Y" + brief(draw(-30, 30)), "G90"}; break;
    }
    blocks.push_back("G1 X" + brief(from_x + 30) + " Y" + brief(from_y));
    blocks.push_back("G40 X" + brief(from_x + 60) + " Y" + brief(from_y + 30));
    std::string text, inserted;
    for (size_t n = 0; n < blocks.size(); ++n) {
      text += blocks[n] + '\n', inserted += blocks[n] + '\n';
      if (n == stop)
        for (const std::string& block : mdi) inserted += block + '\n';
    }
    text += "M30", inserted += "M30";
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + inserted);

    Machine m(GetParam());
    m.start(text);
    ASSERT_TRUE(m.until_stop());
    m.stops(static_cast<unsigned>(stop));
    if (m.drive->out.state != NC_STATE_STOPPED) {
      ++alarms;  // the contour cannot be compensated
      continue;
    }
    ASSERT_EQ(m.load([&] {
      std::string all;
      for (const std::string& block : mdi) all += block + '\n';
      return all;
    }()),
              NC_OK);
    const bool done = m.to_end_of_mdi() && m.to_end_of_program();
    ASSERT_LT(m.worst, 1.001);
    Machine whole(GetParam());
    whole.start(inserted);
    ASSERT_TRUE(whole.until_stop());
    const bool sound = whole.to_end_of_program();
    if (!done) {  // a stop puts a corner that was already calculated behind it, so that an alarm of either may be missing in the other
      ++alarms;
      continue;
    }
    ASSERT_TRUE(m.drive->ended);
    if (sound) {
      for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(m.drive->out.command.v[i], whole.drive->out.command.v[i], 1e-6);
      // From the second move behind the blocks of MDI on it is the same path.
      const std::vector<nc_axes> ends = m.drive->ends(), all = whole.drive->ends();
      ASSERT_GE(ends.size(), 2u);
      for (size_t back = 1; back <= std::min<size_t>({2, ends.size(), all.size()}); ++back)
        for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(ends[ends.size() - back].v[i], all[all.size() - back].v[i], 1e-4) << back << " from the end";
      ++compared;
    }
    ++compensated;
  }
  EXPECT_GT(compared, count / 2);
  EXPECT_LT(alarms, count / 3);
}

}  // namespace
}  // namespace nc::test
