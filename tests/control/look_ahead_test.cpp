// SPDX-License-Identifier: Apache-2.0
// A block that would leave the stroke is not executed at all: neither its M S T B nor the part of its path before the fault.
#include <gtest/gtest.h>

#include "support/drive.hpp"
#include "support/random_program.hpp"

namespace nc::test {
namespace {

/// Every axis within -10 to 50.
void limit(nc_config& c) {
  for (unsigned i = 0; i < 3; ++i) {
    c.system[0].axis[i].soft_limited = true;
    c.system[0].axis[i].soft_min = -10;
    c.system[0].axis[i].soft_max = 50;
  }
}

Outcome limited(const std::string& text, uint32_t budget = 1000) {
  Bench bench(NC_DIALECT_M700, limit);
  bench.tool(1, 5).param("8013", "0.5");
  return bench.run(text, budget);
}

/// Expects that `before` is executed, and nothing of `block`.
void expect_nothing_of(const std::string& before, const std::string& block, const char* alarm = "M01-0007") {
  SCOPED_TRACE(block);
  const Outcome good = limited(before + "M30");
  for (const uint32_t budget : {1u, 1000u}) {
    const Outcome run = limited(before + block + "\nM30", budget);
    EXPECT_EQ(run.alarm, alarm);
    EXPECT_EQ(run.alarm_line, good.lines().back());
    Path path = good.path();
    EXPECT_EQ(run.path(), path);
    EXPECT_EQ(run.aux() + (run.aux().empty() ? "M30" : " M30"), good.aux());
    EXPECT_EQ(run.of(NC_ITEM_GATE).size() + 1, good.of(NC_ITEM_GATE).size());  // less the one of M30
  }
}

TEST(LookAhead, StoredStrokeLimit) {
  expect_nothing_of("", "S1000 M3 T5 G0 X51.");
  expect_nothing_of("G0 X10. M8\n", "M3 G1 Y-11. F100");
  expect_nothing_of("G0 X30. Y30.\n", "M3 G2 X30. Y10. R-20. F100");
  expect_nothing_of("G0 X40.\n", "M3 M8 G31 X60. F100");
  expect_nothing_of("G0 X40.\n", "M3 G53 X60.");
}

TEST(LookAhead, StrokeCheckBeforeTravel) {  // M700 15.7
  expect_nothing_of("G22 X40. Y40. Z40. I20. J20. K20.\nG0 X30. Y30.\n", "M3 Z30.", "P452");
}

TEST(LookAhead, EveryMoveOfTheBlock) {
  expect_nothing_of("G0 X10.\n", "M3 G28 X60.");        // the intermediate point
  expect_nothing_of("G0 X10.\n", "M3 G30 P2 X20. Z-20.");
}

TEST(LookAhead, FixedCycles) {
  expect_nothing_of("G0 Z20.\n", "M3 G81 X10. Y10. Z-11. R5. F100");
  expect_nothing_of("G0 Z20.\n", "M3 G81 X60. Y10. Z-5. R5. F100");
  expect_nothing_of("G0 Z20.\n", "M3 G91 G81 X9. Z-5. R-5. L6 F100");               // the last hole
  expect_nothing_of("G0 Z50.\n", "M3 G83 X10. Y10. Z-11. R49. Q0.2 F100");  // three hundred pecks
  expect_nothing_of("G0 Z20.\nG81 X10. Y10. Z-5. R5. F100 M3\n", "M8 X60.");
}

TEST(LookAhead, ACycleThatFitsIsAsItWas) {
  for (const char* cycle : {"G83 X10. Y10. Z-9. R40. Q0.7 F100", "G91 G81 X9. Z-5. R-5. L5 F100", "G91 G73 X2. Z-5. R-5. Q1. L9 F100"}) {
    const std::string text = std::string("G0 Z20.\nM3 ") + cycle + "\nM5 X5.\nG80 X-1.\nM30";
    const Outcome with = limited(text);
    Bench free;
    const Outcome without = free.tool(1, 5).param("8013", "0.5").run(text);
    EXPECT_TRUE(with.ended_ok) << with.alarm;
    ASSERT_EQ(with.steps.size(), without.steps.size());
    for (size_t i = 0; i < with.steps.size(); ++i) EXPECT_EQ(exactly(with.steps[i]), exactly(without.steps[i]));
  }
}

TEST(LookAhead, TheCompensatedPathCounts) {  // the programmed path stays inside, that of the tool does not
  expect_nothing_of("G0 X10. Y10.\n", "G41 D1 M3 G1 X20. Y48. F100\nX30.");
}

TEST(LookAhead, WhatTheOffsetStageFinds) {  // the second block is an arc that the tool does not fit in
  const Outcome run = limited("G0 X10. Y10.\nG41 D1 G1 X20. F100\nM8 Y20.\nM9 G3 X18. Y22. R2.\nG1 X10.\nG40 X0\nM30");
  EXPECT_EQ(run.alarm, "P153");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_EQ(run.aux(), "M8");
}

TEST(LookAhead, InTheMiddleOfAContour) {
  const std::string text = "G41 D1 G1 X20. Y20. F100\nM8 X30.\nM9 Y48.\nX20.\nG40 X10. Y10.\nM30";
  for (const uint32_t budget : {1u, 1000u}) {
    const Outcome run = limited("G0 X10. Y10.\n" + text, budget);
    EXPECT_EQ(run.alarm, "");
  }
  const std::string beyond = "G42 D1 G1 X20. Y20. F100\nM8 X46.\nM9 Y30.\nX20.\nG40 X10. Y10.\nM30";
  for (const uint32_t budget : {1u, 1000u}) {
    const Outcome run = limited("G0 X10. Y10.\n" + beyond, budget);
    EXPECT_EQ(run.alarm, "M01-0007");
    EXPECT_EQ(run.alarm_line, 3u);
    EXPECT_EQ(run.aux(), "");
    EXPECT_EQ(run.moves().size(), 2u);
  }
}

TEST(LookAhead, ModalStateIsThatOfTheBlockBefore) {
  const Outcome run = limited("S500 M3\nG1 X10. F100\nS900 M4 F300 G91 X50.\nM30");
  EXPECT_EQ(run.alarm, "M01-0007");
  EXPECT_EQ(run.aux(), "S500 M3");
  EXPECT_EQ(run.last_modal().spindle, 500);
  EXPECT_EQ(run.last_modal().feed, 100);
  EXPECT_EQ(run.last_modal().m, 3u);
}

TEST(LookAhead, AProgramAfterTheAlarm) {
  Bench bench(NC_DIALECT_M700, limit);
  EXPECT_EQ(bench.run("M3 G0 X51.\nM30").aux(), "");
  const Outcome again = bench.run("M3 G0 X50.\nM30");
  EXPECT_EQ(again.aux(), "M3 M30");
  EXPECT_EQ(again.path(), Path{"rapid 50 0 0"});
}

TEST(LookAhead, TheMachineDoesAsTheTrace) {
  for (const char* text : {"M8 G0 X10.\nS100 M3 X51.\nM30", "G0 X10. Y10.\nG42 D1 M8 G1 X20. F6000\nM9 Y48.\nX0\nM30",
                           "G0 Z20.\nM8 G81 X10. Z-5. R5. F6000\nM3 X20. Z-11.\nM30"}) {
    SCOPED_TRACE(text);
    const Outcome trace = limited(text);
    EXPECT_EQ(trace.alarm, "M01-0007");
    Bench bench(NC_DIALECT_M700, limit);
    bench.tool(1, 5).param("8013", "0.5");
    Drive drive(bench, text);
    bool m8 = false, other = false;
    while (drive.cycle < 20000 && drive.out.state != NC_STATE_ALARM) {
      drive.press_start();
      drive.step();
      const bool m = drive.out.strobe != 0;
      m8 = m8 || (m && drive.out.m == 8);
      other = other || (m && drive.out.m != 8);
    }
    EXPECT_EQ(drive.alarm(), "M01-0007");
    EXPECT_EQ(m8, trace.aux().find("M8") != std::string::npos);
    EXPECT_FALSE(other);
    // The machine stops at the alarm; the trace has one more item, the end.
    ASSERT_GE(trace.steps.size(), drive.events.size());
    for (size_t i = 0; i < drive.events.size(); ++i) {
      EXPECT_EQ(drive.events[i].serial, trace.steps[i].item.serial);
      EXPECT_EQ(drive.events[i].kind, trace.steps[i].item.kind);
    }
    EXPECT_GE(drive.events.size() + 2, trace.steps.size());
  }
}

/// Adds M8 to some of the blocks that move.
std::string with_codes(const std::string& text, uint32_t seed) {
  std::mt19937 random(seed);
  std::string all;
  for (size_t at = 0, end; at < text.size(); at = end + 1) {
    end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    const bool moves = line.find_first_of("XYZ") != std::string::npos && line.find_first_of("=MP[O") == std::string::npos;
    all += line + (moves && random() % 2 == 0 ? " M8\n" : "\n");
  }
  return all;
}

/// Random programs with random limits do the same as without limits until a block is stopped; no code of that block is given out.
TEST(LookAhead, RandomProgramsWithinLimits) {
  unsigned stopped = 0, ended = 0, held_back = 0;
  for (uint32_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomProgram program = ProgramMaker(seed + 4000, false).make();
    program.main = with_codes(program.main, seed);
    for (std::string& sub : program.subs) sub = with_codes(sub, seed);
    const auto run = [&](double most, uint32_t budget) {
      Bench bench(NC_DIALECT_M700, [most](nc_config& c) {
        for (unsigned i = 0; i < 3; ++i) {
          c.system[0].axis[i].soft_limited = true;
          c.system[0].axis[i].soft_min = -most;
          c.system[0].axis[i].soft_max = most;
        }
      });
      for (unsigned n = 1; n <= 9; ++n) bench.tool(n, 0.2 * n);
      bench.work_offset(1, {1, 2, 3}).param("8103", "1").param("8013", "0.5").param("8012", "0.3");
      for (size_t i = 0; i < program.subs.size(); ++i) bench.add("O" + std::to_string(i + 1), program.subs[i]);
      return bench.run(program.main, budget);
    };
    const Outcome free = run(1e6, 1000);
    for (const double most : {20.0, 60.0, 150.0}) {
      const Outcome limited = run(most, 1 + seed % 7);
      const bool by_limit = limited.alarm == "M01-0007";
      const size_t same = by_limit ? limited.steps.size() - 2 : limited.steps.size();  // the alarm and the end
      ASSERT_LE(same, free.steps.size());
      for (size_t i = 0; i < same; ++i) ASSERT_EQ(exactly(limited.steps[i]), exactly(free.steps[i])) << i;
      if (!by_limit) {
        EXPECT_EQ(limited.alarm, free.alarm);
        ++ended;
        continue;
      }
      ++stopped;
      for (size_t i = same; i-- > 0 && limited.steps[i].item.kind != NC_ITEM_MARK;) {
        const nc_item& item = limited.steps[i].item;
        EXPECT_FALSE(item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B) << limited.alarm_line;
      }
      held_back += free.steps[same].item.kind == NC_ITEM_ACTION;
    }
  }
  EXPECT_GT(stopped, 50u);
  EXPECT_GT(ended, 50u);
  EXPECT_GT(held_back, 5u);
}

}  // namespace
}  // namespace nc::test
