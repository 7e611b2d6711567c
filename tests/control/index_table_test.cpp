// SPDX-License-Identifier: Apache-2.0
// Index tables (M700 9.3): before any motion of a table it is unclamped, and clamped after it, and nothing else is executed in between.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <random>

#include "support/drive.hpp"

namespace nc::test {
namespace {

/// B is the fourth axis.
constexpr unsigned kB = 3;
constexpr unsigned kClampCycles = 20;

/// A machine with an index table B that answers after 20 cycles, and a diary of what happens on it:
///   +B -B  unclamp command on, off      b  unclamped       b-  clamped       X B ...  the axis begins to move       M8  a strobe
class TableMachine {
 public:
  explicit TableMachine(Bench& bench, const std::string& text) : drive(bench, text) {}

  Drive drive;
  unsigned slow_feeder = 1;     ///< the feeder is called once in so many cycles, with the work of all of them
  unsigned clamp_cycles = kClampCycles;
  uint32_t broken = 0;          ///< axes that are never unclamped
  std::string diary;

  void step() {
    nc_inputs& in = drive.in;
    for (unsigned i = 0; i < NC_MAX_AXES; ++i) {
      const bool asked = (drive.out.unclamp >> i & 1) != 0, is = (unclamped_ >> i & 1) != 0;
      left_[i] = asked == is ? clamp_cycles : left_[i] - 1;
      if (left_[i] != 0) continue;
      unclamped_ ^= 1u << i;
      left_[i] = clamp_cycles;
    }
    const uint32_t unclamped_before = in.unclamped;
    in.unclamped = unclamped_ & ~broken;
    const nc_outputs before = drive.out;
    drive.step(drive.cycle % slow_feeder == 0 ? 100 * slow_feeder : 0);
    write(before, unclamped_before);
  }
  /// Steps until `done` returns true; false if it does not within `most` cycles.
  template <class Done>
  bool until(Done done, unsigned most = 60000) {
    for (unsigned n = 0; n < most; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  }
  bool press_start() {
    drive.in.cycle_start = false;
    step();
    drive.in.cycle_start = true;
    step();
    drive.in.cycle_start = false;
    return true;
  }
  std::string run() {
    press_start();
    if (!until([&] { return drive.ended; })) diary += " hangs";
    return diary;
  }
  double b() const { return drive.out.command.v[kB]; }
  bool unclamp() const { return (drive.out.unclamp >> kB & 1) != 0; }
  void steps(unsigned n) {
    while (n-- > 0) step();
  }

 private:
  void note(const std::string& word) { diary += (diary.empty() ? "" : " ") + word; }
  void write(const nc_outputs& before, uint32_t unclamped_before) {
    static constexpr char kName[] = "XYZBC";
    const nc_outputs& out = drive.out;
    for (unsigned i = 0; i < 5; ++i) {
      const uint32_t bit = 1u << i;
      const std::string name(1, kName[i]), small(1, static_cast<char>(kName[i] - 'A' + 'a'));
      if ((drive.in.unclamped & ~unclamped_before & bit) != 0) note(small);
      if ((unclamped_before & ~drive.in.unclamped & bit) != 0) note(small + "-");
      if ((out.unclamp & ~before.unclamp & bit) != 0) note("+" + name);
      if ((before.unclamp & ~out.unclamp & bit) != 0) note("-" + name);
    }
    std::string begins;
    for (unsigned i = 0; i < 5; ++i)
      if (out.velocity.v[i] != 0 && before.velocity.v[i] == 0) begins += kName[i];
    if (!begins.empty()) note(begins);
    if (out.strobe != 0 && before.strobe == 0) note("M" + std::to_string(out.m));
    for (unsigned i = 0; i < 5; ++i) {
      if ((tables >> i & 1) == 0 || out.command.v[i] == before.command.v[i] || drive.cycle < 3) continue;
      // When the answer "unclamped" goes off the axis begins to brake one cycle later, so the last two cycles count.
      if ((drive.in.unclamped >> i & 1) == 0 && (unclamped_before >> i & 1) == 0 && broken == 0) note("MOVES CLAMPED");
      if ((out.unclamp >> i & 1) == 0) note("MOVES WITHOUT A COMMAND");
    }
  }

 public:
  uint32_t tables = 1u << kB;

 private:
  uint32_t unclamped_ = 0;
  unsigned left_[NC_MAX_AXES] = {};
};

void five_axes(nc_config& c) {
  axes("XYZbc")(c);
  for (unsigned i = 0; i < 5; ++i) {
    nc_axis_config& axis = c.system[0].axis[i];
    axis.rapid = axis.max_velocity = 400;
    axis.max_acceleration = 4000;
    axis.max_jerk = 100000;
    axis.in_position = 0.01;
  }
}

void five_axes_optimal(nc_config& c) {
  five_axes(c);
  c.motion_mode = NC_MOTION_OPTIMAL;
}

std::string diary(const std::string& text, const std::function<void(Bench&)>& change = {}, bool optimal = false, uint32_t tables = 1u << kB) {
  Bench bench(NC_DIALECT_M700, optimal ? five_axes_optimal : five_axes);
  bench.param("2076", "1", 'B');
  if (change) change(bench);
  TableMachine m(bench, text);
  m.tables = tables;
  return m.run();
}

class IndexTableInMode : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Both, IndexTableInMode, testing::Bool(), [](const auto& mode) { return mode.param ? "Optimal" : "Trapezoid"; });

TEST_P(IndexTableInMode, IsUnclampedBeforeItMovesAndClampedBehindThat) {  // (3) to (6)
  EXPECT_EQ(diary("G0 B90.\nX10.\nM30", {}, GetParam()), "+B b B -B b- X M30");
  EXPECT_EQ(diary("G91 G1 B90. F3600\nX10.\nM30", {}, GetParam()), "+B b B -B b- X M30") << "(2): incremental, and at the feed";
}

TEST_P(IndexTableInMode, HoldsUpTheOtherAxesOfItsBlock) {  // precaution (3)
  EXPECT_EQ(diary("G0 X10. B90.\nM30", {}, GetParam()), "+B b XB -B b- M30");
  EXPECT_EQ(diary("G1 F6000 X10.\nX20. B90.\nX30.\nM30", {}, GetParam()), "X +B b XB -B b- X M30");
}

TEST_P(IndexTableInMode, StaysUnclampedBetweenItsMoves) {  // (7)
  EXPECT_EQ(diary("G0 B90.\nG1 B180. F3600\nB-90.\nX10.\nM30", {}, GetParam()), "+B b B -B b- X M30");
  EXPECT_EQ(diary("G0 B90.\n#1=180\nB#1\nM30", {}, GetParam()), "+B b B -B b- M30") << "a calculation is no command";
  EXPECT_EQ(diary("G28 B45.\nM30", {}, GetParam()), "+B b B -B b- M30") << "two moves of one block";
}

TEST_P(IndexTableInMode, IsClampedBeforeAnythingElse) {
  EXPECT_EQ(diary("G0 B90.\nM8\nB180.\nM30", {}, GetParam()), "+B b B -B b- M8 +B b B -B b- M30");
  EXPECT_EQ(diary("G0 B90.\nB180. M8\nM30", {}, GetParam()), "+B b B -B b- M8 +B b B -B b- M30");
  EXPECT_EQ(diary("G0 B90.\nG4 P10\nB180.\nM30", {}, GetParam()), "+B b B -B b- +B b B -B b- M30");
  EXPECT_EQ(diary("G0 B90.\n#1100=1\nB180.\nM30", {}, GetParam()), "+B b B -B b- +B b B -B b- M30");
  EXPECT_EQ(diary("G0 B90.\n#100=#5044\nB180.\nM30", {}, GetParam()), "+B b B -B b- +B b B -B b- M30") << "a position is read";
  EXPECT_EQ(diary("G0 B90.\nM30", {}, GetParam()), "+B b B -B b- M30") << "the end of the program";
}

TEST_P(IndexTableInMode, SeveralOfThem) {  // precaution (1)
  const auto both = [](Bench& bench) { bench.param("2076", "1", 'C'); };
  EXPECT_EQ(diary("G0 B90. C90.\nC180.\nM30", both, GetParam(), 0b11000), "+B +C b c BC -B b- C -C c- M30");
  EXPECT_EQ(diary("G0 B90.\nC90.\nM30", both, GetParam(), 0b11000), "+B b B -B b- +C c C -C c- M30");
}

TEST_P(IndexTableInMode, MayBeALinearAxis) {  // precaution (4)
  const auto linear = [](Bench& bench) { bench.param("2076", "0", 'B').param("2076", "1", 'Z'); };
  EXPECT_EQ(diary("G1 Z90. F6000\nG0 X10.\nB10.\nM30", linear, GetParam(), 0b100), "+Z z Z -Z z- X B M30");
}

TEST(IndexTable, WhateverMovesIt) {
  const auto with_macro = [](Bench& bench) {
    bench.param("2038", "30", 'B').add("O100", "O100\nG0 X1.\nM99");
  };
  for (const char* text : {"G53 G0 B90.\nM30", "G30 B10.\nM30", "G60 B90.\nM30", "G31 B90. F3600\nM30", "G81 B90. Z-5. R-1. F1000\nG80\nM30",
                           "G17 G2 X10. I5. B90. F1000\nM30", "G92 B10.\nG0 B90.\nM30", "G52 B10.\nG0 B10.\nM30", "G61.1\nG1 B90. F3600\nM30",
                           "G5 P10000\nG1 B90. F3600\nG5 P0\nM30", "G68 X0 Y0 R90.\nG0 X10. B20.\nG69\nM30", "G51.1 B0\nG0 B90.\nG50.1 B0\nM30",
                           "G41 D1 G1 X10. F1000\nX20. B20.\nY10.\nG40 X0\nM30", "G66 P100\nG0 B90.\nG67\nM30"}) {
    SCOPED_TRACE(text);
    const std::string all = diary(text, with_macro);
    EXPECT_NE(all.find("+B b"), std::string::npos) << all;
    EXPECT_NE(all.find("-B b-"), std::string::npos) << all;
    EXPECT_EQ(all.find("MOVES"), std::string::npos) << all;
    EXPECT_EQ(all.find("hangs"), std::string::npos) << all;
  }
  const auto table_c = [](Bench& bench) { bench.param("1516", "C").param("2076", "1", 'C').param("2076", "0", 'B'); };
  const std::string cylinder = diary("G0 X20.\nG19 Z0 C0\nG7.1 C20.\nG1 F1000 C20.\nC30. Z5.\nG7.1 C0\nM30", table_c, false, 0b10000);
  EXPECT_EQ(cylinder, "X +C c C Z -C c- M30");
}

TEST(IndexTable, SingleBlockClampsBehindEveryBlock) {  // (7)
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nB180.\nM30");
  m.drive.in.single_block = true;
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.diary, "+B b B -B b-") << "stopped when it is clamped";
  EXPECT_EQ(m.b(), 90);
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.diary, "+B b B -B b- +B b B -B b-");
}

TEST(IndexTable, AProgramStopWaitsForTheClamp) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nM0\nB180.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.diary, "+B b B -B b- M0");
}

/// While the next block is not known yet the table stays as it is, so a late feeder changes nothing.
TEST(IndexTable, ALateFeederChangesNothing) {
  for (const char* text : {"G0 B90.\nB180.\nX10.\nB0\nM8\nM30", "G0 X5. B90.\n#1=1\n#2=2\n#3=3\nB180.\nM30"}) {
    const std::string expected = diary(text);
    for (const unsigned slow : {7u, 60u, 300u}) {
      Bench bench(NC_DIALECT_M700, [](nc_config& c) {
        five_axes(c);
        c.look_ahead = 64;
      });
      bench.param("2076", "1", 'B');
      TableMachine m(bench, text);
      m.slow_feeder = slow;
      EXPECT_EQ(m.run(), expected) << slow;
    }
  }
}

TEST_P(IndexTableInMode, WaitsAreShown) {
  Bench bench(NC_DIALECT_M700, GetParam() ? five_axes_optimal : five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 X10.\nB90.\nX20.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.unclamp(); }));
  EXPECT_EQ(m.drive.out.cause, NC_CAUSE_FIN);
  EXPECT_EQ(m.drive.out.fin_wait, 0x800) << "T10 FIN WAIT 0800";
  EXPECT_EQ(m.drive.out.source.line, 2u);
  ASSERT_TRUE(m.until([&] { return m.b() > 1; }));
  EXPECT_EQ(m.drive.out.fin_wait, 0);
  ASSERT_TRUE(m.until([&] { return !m.unclamp(); }));
  EXPECT_EQ(m.b(), 90);
  EXPECT_EQ(m.drive.out.fin_wait, 0x800);
  EXPECT_EQ(m.drive.out.source.line, 2u) << "the block of the table, not the one that waits";
}

TEST_P(IndexTableInMode, StopsWhereTheAnswerIsLostAndGoesOnWithIt) {  // (5)
  Bench bench(NC_DIALECT_M700, GetParam() ? five_axes_optimal : five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G1 F6000 X90. B90.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() > 30; }));
  m.broken = 1u << kB;
  ASSERT_TRUE(m.until([&] { return m.drive.out.distance_zero; }));
  const double b = m.b();
  EXPECT_GT(b, 30);
  EXPECT_LT(b, 85);
  EXPECT_NEAR(m.drive.out.command.v[0], b, 0.05) << "the other axis has stopped with it";
  m.steps(300);
  EXPECT_EQ(m.b(), b);
  EXPECT_TRUE(m.unclamp()) << "the unclamp state remains";
  EXPECT_EQ(m.drive.out.fin_wait, 0x800);
  EXPECT_EQ(m.drive.out.state, NC_STATE_RUNNING);
  m.broken = 0;
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.b(), 90);
}

TEST_P(IndexTableInMode, AnInterruptedMoveStaysUnclamped) {  // (6)
  for (const bool hold : {false, true}) {
    Bench bench(NC_DIALECT_M700, GetParam() ? five_axes_optimal : five_axes);
    bench.param("2076", "1", 'B');
    TableMachine m(bench, "G1 F6000 B90.\nX10.\nM30");
    m.press_start();
    ASSERT_TRUE(m.until([&] { return m.b() > 30; }));
    (hold ? m.drive.in.feed_hold : m.drive.in.interlock) = true;
    ASSERT_TRUE(m.until([&] { return m.drive.out.distance_zero; }));
    m.steps(200);
    EXPECT_TRUE(m.unclamp());
    m.drive.in.feed_hold = m.drive.in.interlock = false;
    if (hold) m.press_start();
    ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
    EXPECT_EQ(m.diary, "+B b B B -B b- X M30");
  }
}

TEST(IndexTable, AHoldAtTheEndOfItsBlockClamps) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nX50.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() == 90; }));
  m.drive.in.feed_hold = true;
  m.steps(100);
  EXPECT_EQ(m.diary, "+B b B -B b-");
  EXPECT_EQ(m.drive.out.state, NC_STATE_HOLD);
  m.drive.in.feed_hold = false;
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.diary, "+B b B -B b- X M30");
}

TEST(IndexTable, AHoldBeforeItMovesWaitsUnclamped) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.unclamp(); }));
  m.drive.in.feed_hold = true;
  m.steps(100);
  EXPECT_EQ(m.diary, "+B b");
  m.drive.in.feed_hold = false;
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.diary, "+B b B -B b- M30");
}

TEST(IndexTable, AnInterlockBeforeItMovesLeavesItClamped) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nM30");
  m.drive.in.interlock = true;
  m.press_start();
  m.steps(100);
  EXPECT_EQ(m.diary, "");
  EXPECT_EQ(m.drive.out.cause, NC_CAUSE_INTERLOCK);
  m.drive.in.interlock = false;
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
}

/// Presses reset until the machine is idle.
void reset(TableMachine* m) {
  m->drive.in.reset = true;
  m->until([&] { return m->drive.out.state == NC_STATE_IDLE; });
  m->drive.in.reset = false;
  m->step();
}

TEST(IndexTable, AResetClampsWhatCanBeClamped) {
  {  // while it is being unclamped: it has not moved
    Bench bench(NC_DIALECT_M700, five_axes);
    bench.param("2076", "1", 'B').param("2106", "5", 'B');
    TableMachine m(bench, "G0 B90.\nM30");
    m.press_start();
    ASSERT_TRUE(m.until([&] { return m.unclamp(); }));
    reset(&m);
    m.steps(60);
    EXPECT_FALSE(m.unclamp());
    EXPECT_EQ(m.drive.in.unclamped, 0u);
  }
  {  // in a motion: a table without fixed places (#2106) can be clamped anywhere
    Bench bench(NC_DIALECT_M700, five_axes);
    bench.param("2076", "1", 'B');
    TableMachine m(bench, "G1 F3600 B90.\nM30");
    m.press_start();
    ASSERT_TRUE(m.until([&] { return m.b() > 31; }));
    reset(&m);
    m.steps(60);
    EXPECT_FALSE(m.unclamp());
    EXPECT_EQ(m.drive.in.unclamped, 0u);
  }
}

TEST(IndexTable, ATableWithPlacesStaysUnclampedBetweenThem) {  // (8)
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B').param("2106", "5", 'B');
  TableMachine m(bench, "G1 F3600 B90.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() > 31; }));
  reset(&m);
  m.steps(60);
  EXPECT_TRUE(m.unclamp());
  // A program that does not move it has to wait.
  bench.start("G0 X10.\nM30");
  m.press_start();
  m.steps(200);
  EXPECT_EQ(m.drive.out.command.v[0], 0);
  EXPECT_EQ(m.drive.out.fin_wait, 0x800);
  reset(&m);
  // Moved by hand to one of its places, it is clamped there.
  nc_manual& hand = m.drive.in.manual[kB];
  hand = {NC_MANUAL_STEP, 0, 2};
  m.steps(100);
  EXPECT_TRUE(m.unclamp());
  hand = {};
  m.step();
  hand = {NC_MANUAL_STEP, 0, 40 - m.b()};
  ASSERT_TRUE(m.until([&] { return m.b() == 40; }));
  m.steps(60);
  EXPECT_FALSE(m.unclamp());
  EXPECT_EQ(m.drive.in.unclamped, 0u);
}

TEST(IndexTable, ATableThatWasStoppedGoesOnWithItsNextCommand) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B').param("2106", "5", 'B');
  TableMachine m(bench, "G1 F3600 B90.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() > 31; }));
  reset(&m);
  bench.start("G0 B45.\nX10.\nM30");
  m.drive.ended = false;
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.b(), 45);
  EXPECT_EQ(m.diary, "+B b B B -B b- X M30");
}

/// (8), 2.3: from between two places, an incremental move by whole places does not end at a place.
TEST(IndexTable, FromBetweenItsPlacesItDoesNotGoOnInG91) {
  for (const char* block : {"G91 G0 B30.", "G91 G28 B30.", "G91 G31 B30. F100"}) {
    Bench bench(NC_DIALECT_M700, five_axes);
    bench.param("2076", "1", 'B').param("2106", "5", 'B');
    TableMachine m(bench, "G1 F3600 B90.\nM30");
    m.press_start();
    ASSERT_TRUE(m.until([&] { return m.b() > 31; }));
    reset(&m);
    const double stopped = m.b();
    bench.start(std::string(block) + "\nX10.\nM30");
    m.press_start();
    m.steps(300);
    EXPECT_EQ(m.b(), stopped) << block;
    EXPECT_EQ(m.drive.out.state, NC_STATE_ALARM) << block;
    EXPECT_TRUE(m.unclamp()) << block;
  }
}

/// 2.3: "is not checked with other axes".
TEST(IndexTable, ALinearOneHasNoPlaces) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'X').param("2106", "5", 'X');
  TableMachine m(bench, "G1 F3600 X90.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.out.command.v[0] > 31; }));
  reset(&m);
  m.steps(60);
  EXPECT_EQ(m.drive.out.unclamp, 0u) << "clamped where it stands";
}

TEST(IndexTable, AResetWhileItIsClampedIsOne) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nX10.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() == 90 && !m.unclamp(); }));
  reset(&m);
  EXPECT_EQ(m.drive.out.state, NC_STATE_IDLE);
  bench.start("G0 X10.\nM30");
  m.drive.ended = false;
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.diary, "+B b B -B b- X M30") << "the next program waits for the clamp";
}

TEST(IndexTable, AnAlarmOnTheWay) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G1 F3600 B90.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() > 31; }));
  m.drive.in.alarm = true;
  ASSERT_TRUE(m.until([&] { return m.drive.out.state == NC_STATE_ALARM && m.drive.out.distance_zero; }));
  m.steps(60);
  EXPECT_LT(m.b(), 90);
  EXPECT_FALSE(m.unclamp());
}

TEST(IndexTable, AnAlarmOfTheNextBlockComesBehindTheClamp) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nG2 X10. R1.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.out.state == NC_STATE_ALARM; }));
  EXPECT_EQ(m.diary, "+B b B -B b-");
}

TEST(IndexTable, ByHand) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "M30");
  m.steps(3);
  nc_manual& hand = m.drive.in.manual[kB];
  hand = {NC_MANUAL_JOG, 20, 0};
  m.steps(kClampCycles / 2);
  EXPECT_EQ(m.b(), 0) << "not before it is unclamped";
  EXPECT_EQ(m.drive.out.fin_wait, 0x800);
  EXPECT_EQ(m.drive.out.cause, NC_CAUSE_FIN);
  EXPECT_EQ(m.drive.out.state, NC_STATE_MANUAL);
  m.steps(500);
  EXPECT_GT(m.b(), 1);
  hand = {};
  m.steps(100);
  EXPECT_EQ(m.diary, "+B b B -B b-");
  const double at = m.b();
  hand = {NC_MANUAL_STEP, 0, 7};
  m.steps(1000);
  EXPECT_NEAR(m.b(), at + 7, 1e-9) << "a step is not forgotten while it waits";
  hand = {NC_MANUAL_REFERENCE, 0, 0};
  ASSERT_TRUE(m.until([&] { return m.b() == 0; }));
  hand = {};
  m.steps(100);
  EXPECT_EQ(m.diary, "+B b B -B b- +B b B -B b- +B b B -B b-");
  m.drive.in.manual[0] = {NC_MANUAL_STEP, 0, 7};
  m.steps(500);
  EXPECT_EQ(m.drive.out.command.v[0], 7);
  EXPECT_EQ(m.diary, "+B b B -B b- +B b B -B b- +B b B -B b- X") << "another axis does without";
}

TEST(IndexTable, ByHandItStopsWhereTheAnswerIsLost) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "M30");
  m.steps(3);
  nc_manual& hand = m.drive.in.manual[kB];
  hand = {NC_MANUAL_STEP, 30, 60};
  ASSERT_TRUE(m.until([&] { return m.b() > 20; }));
  m.broken = 1u << kB;
  m.steps(200);
  const double at = m.b();
  EXPECT_LT(at, 30);
  m.steps(100);
  EXPECT_EQ(m.b(), at);
  EXPECT_TRUE(m.unclamp());
  m.broken = 0;
  ASSERT_TRUE(m.until([&] { return m.b() == 60; }));
}

TEST(IndexTable, InABlockStopByHand) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 X10.\nM0\nX20.\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.out.state == NC_STATE_STOPPED; }));
  m.drive.in.manual[kB] = {NC_MANUAL_STEP, 0, 10};
  ASSERT_TRUE(m.until([&] { return m.b() == 10; }));
  m.drive.in.manual[kB] = {};
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.diary, "X M0 +B b B -B b- X M30");
}

TEST(IndexTable, WaitsForItsServoBeforeItIsClamped) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  TableMachine m(bench, "G0 B90.\nM30");
  m.drive.in.actual_valid = true;
  double actual = 0;
  m.drive.in.cycle_start = true;
  bool clamped_late = true;
  for (unsigned n = 0; n < 5000 && !m.drive.ended; ++n) {
    m.drive.in.cycle_start = n == 2;
    actual += (m.b() - actual) * 0.02;
    m.drive.in.actual.v[kB] = actual;
    const bool before = m.unclamp();
    m.step();
    if (before && !m.unclamp()) clamped_late = std::fabs(actual - 90) <= 0.01;
  }
  EXPECT_TRUE(m.drive.ended);
  EXPECT_TRUE(clamped_late);
}

TEST(IndexTable, WithoutInterpolationTheOthersDoNotWait) {  // precaution (3), #1086
  const auto by_axis = [](Bench& bench) { bench.param("1086", "1"); };
  EXPECT_EQ(diary("G0 X100. B90.\nY10.\nM30", by_axis), "+B X b B -B b- Y M30");
  EXPECT_EQ(diary("G0 X1. B90.\nY10.\nM30", by_axis), "+B X b B -B b- Y M30");
  EXPECT_EQ(diary("G0 B90.\nY10.\nM30", by_axis), "+B b B -B b- Y M30");
  EXPECT_EQ(diary("G1 F6000 X100. B90.\nY10.\nM30", by_axis), "+B b XB -B b- Y M30") << "cutting is interpolated";
}

TEST(IndexTable, TheStreamSaysWhatIsUnclamped) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B');
  const Outcome run = bench.run("G1 F1000 X1.\nB90.\nB90. X2.\nX3. B180.\nM30");
  ASSERT_EQ(run.moves().size(), 4u);
  const unsigned expected[] = {0, 1u << kB, 0, 1u << kB};
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_EQ(run.moves()[i].index_axes, expected[i]) << i;
    EXPECT_EQ(run.moves()[i].exact_stop, expected[i] != 0) << i;
  }
}

TEST(IndexTable, ASkipEndsWhereATableWithPlacesCannotBeClamped) {  // (8)
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B').param("2106", "5", 'B');
  EXPECT_EQ(bench.run("G31 B90. F100\nM30").alarm, "P39");
  EXPECT_EQ(bench.at(0, 0, 0).run("G31 X90. F100\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 B92.\nM30").alarm, "P20");
}

/// Type 1 of the macro interrupt: the table moves to its place before the interrupt program begins (M700 13.12).
TEST(IndexTable, AMacroInterruptWaitsForTheTable) {
  Bench bench(NC_DIALECT_M700, five_axes);
  bench.param("2076", "1", 'B').param("1109", "0").param("1113", "0");
  bench.add("O1000", "O1000\nG0 X5.\nM99");
  TableMachine m(bench, "M96 P1000\nG1 F3600 B90.\nG0 Y10.\nM97\nM30");
  m.press_start();
  ASSERT_TRUE(m.until([&] { return m.b() > 31; }));
  m.drive.in.macro_interrupt = true;
  m.steps(5);
  m.drive.in.macro_interrupt = false;
  ASSERT_TRUE(m.until([&] { return m.drive.ended; }));
  EXPECT_EQ(m.drive.out.command.v[0], 5) << "the interrupt has come";
  EXPECT_EQ(m.b(), 90);
  EXPECT_EQ(m.diary.substr(0, 17), "+B b B -B b- X Y ") << m.diary;
}

/// A random program with moves of the table and of other axes, codes, dwells, calculations and reads.
std::string random_text(std::mt19937& random) {
  static constexpr const char* kBlocks[] = {"G0 B%d.",          "G1 B%d. F9000",   "G0 X%d.", "G1 X%d. B%d. F9000", "M8", "G4 P10", "#1=%d", "#100=#5044",
                                            "G2 X%d. I%d. F9000", "G91 G0 B%d.\nG90", "G0 C%d.", "#1100=1",            "G53 G0 B%d.", "G0 B%d. C%d."};
  std::string text = "G17 G90\n";
  for (unsigned n = 0; n < 25; ++n) {
    std::string block = kBlocks[random() % std::size(kBlocks)];
    if (block[0] == 'G' && block[1] == '2') {
      text += "G1 X0 F9000\nG2 X20. I10. B" + std::to_string(random() % 90) + ". F9000\n";
      continue;
    }
    for (size_t at; (at = block.find("%d")) != std::string::npos;) block.replace(at, 2, std::to_string(random() % 90));
    text += block + "\n";
  }
  return text + "M30\n";
}

/// With holds, interlocks, single block, slow feeders and slow clamps the whole program is executed in its order, and no table is moved while it
/// is clamped.
TEST_P(IndexTableInMode, UnderDisturbance) {
  for (uint32_t seed = 1; seed <= 9; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::string text = random_text(random);
    Bench offline(NC_DIALECT_M700, five_axes), bench(NC_DIALECT_M700, GetParam() ? five_axes_optimal : five_axes);
    for (Bench* each : {&offline, &bench}) each->param("2076", "1", 'B').param("2076", "1", 'C');
    const Outcome expected = offline.run(text);
    ASSERT_EQ(expected.alarm, "") << text;
    TableMachine m(bench, text);
    m.tables = 0b11000;
    m.slow_feeder = 1 + random() % 9;
    m.clamp_cycles = 1 + random() % 30;
    m.press_start();
    for (unsigned n = 0; n < 200000 && !m.drive.ended; ++n) {
      nc_inputs& in = m.drive.in;
      const unsigned phase = n % 200;
      if (phase == 0) in.single_block = random() % 2 != 0;
      in.feed_hold = seed % 3 == 0 && phase > 50 && phase < 70;
      in.interlock = seed % 3 == 1 && phase > 100 && phase < 140;
      in.cycle_start = n % 11 == 0;
      m.step();
    }
    ASSERT_TRUE(m.drive.ended) << text << m.diary;
    EXPECT_EQ(m.diary.find("MOVES"), std::string::npos) << text << m.diary;
    EXPECT_FALSE((m.drive.out.unclamp & m.tables) != 0 || m.drive.in.unclamped != 0);
    ASSERT_EQ(m.drive.events.size(), expected.steps.size()) << text;
    for (size_t i = 0; i < expected.steps.size(); ++i) {
      ASSERT_EQ(m.drive.events[i].serial, expected.steps[i].item.serial);
      ASSERT_EQ(m.drive.events[i].kind, expected.steps[i].item.kind);
    }
    for (unsigned i = 0; i < 5; ++i) EXPECT_NEAR(m.drive.out.command.v[i], expected.steps.back().machine.v[i], 1e-9);
  }
}

}  // namespace
}  // namespace nc::test
