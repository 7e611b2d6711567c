// SPDX-License-Identifier: Apache-2.0
// The table of tool life, which part systems share (M700 13.5.5, 10.15): what one has executed is seen by the other, and each takes back only its own.
#include <gtest/gtest.h>

#include <random>

#include "part_system_pair.hpp"

namespace nc::test {
namespace {

class SharedLives : public testing::Test {
 protected:
  SharedLives() {
    for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(nc_parameter_set(pair.control(), system, "1103", 0, "1"), NC_OK);
  }
  double life(unsigned number, nc_life_column column) {
    double value = NAN;
    EXPECT_EQ(nc_tool_life_get(pair.control(), number, column, &value), NC_OK);
    return value;
  }
  /// "number: group tool status used" of the tools that are registered.
  std::string table() {
    std::string all;
    for (unsigned n = 1; n <= NC_TOOL_LIVES; ++n) {
      if (life(n, NC_LIFE_GROUP) == 0) continue;
      all += (all.empty() ? "" : ", ") + std::to_string(n) + ":";
      for (const nc_life_column column : {NC_LIFE_GROUP, NC_LIFE_TOOL, NC_LIFE_STATUS, NC_LIFE_USED}) all += " " + brief(life(n, column));
    }
    return all;
  }
  /// What a program of a part system reads of the first tool of a group: "tools, tool status used".
  std::string read_by(unsigned system, unsigned group) {
    pair.run(system, "#60000=" + std::to_string(group) + "\n#101=#60001\n#102=#61001\n#103=#62001\n#104=#63001\nM30");
    std::string all;
    for (uint32_t number = 101; number <= 104; ++number) all += (number == 101 ? "" : number == 102 ? ", " : " ") + brief(pair.var(system, number));
    return all;
  }
  /// Runs a program on the machine.
  void execute(unsigned system, const std::string& text) {
    pair.select(system, text);
    pair.start(1u << system);
    pair.to_the_end();
  }
  static std::string registers(unsigned group, unsigned tool, const char* more = "L9 Q1") {
    return "G10 L3 P1\nP" + std::to_string(group) + " " + more + "\nT" + std::to_string(tool) + "\nG11\n";
  }

  Pair pair;
};

TEST_F(SharedLives, OneRegistersAndTheOtherUses) {
  pair.run(1, registers(10, 101) + "M30");
  pair.run(0, "T10 M6\nM30");
  EXPECT_EQ(table(), "1: 10 101 1 1");
  EXPECT_EQ(read_by(0, 10), "1, 101 1 1");
  EXPECT_EQ(read_by(1, 10), "1, 101 1 1");
  EXPECT_EQ(nc_tool_life_set(pair.control(), 1, NC_LIFE_STATUS, 4), NC_OK);
  EXPECT_EQ(read_by(1, 10), "1, 101 4 1") << "the host writes for both";
}

TEST_F(SharedLives, BothGoBackInAnyOrder) {
  for (const unsigned first : {0U, 1U}) {
    SCOPED_TRACE(first);
    pair.run(0, registers(10, 101) + "M30");
    pair.run(1, registers(20, 201) + "M30");
    EXPECT_EQ(table(), "1: 10 101 0 0, 2: 20 201 0 0");
    ASSERT_EQ(nc_rewind(pair.control(), first, 0), NC_OK);
    EXPECT_EQ(table(), first == 0 ? "2: 20 201 0 0" : "1: 10 101 0 0");
    ASSERT_EQ(nc_rewind(pair.control(), 1 - first, 0), NC_OK);
    EXPECT_EQ(table(), "");
    for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(read_by(system, 10), "-1, -1 -1 -1");
  }
}

TEST_F(SharedLives, GoingBackKeepsWhatTheOtherHasCounted) {
  for (const unsigned first : {0U, 1U}) {
    SCOPED_TRACE(first);
    pair.run(0, "G10 L3\nP10 L9 Q1\nT101\nG11\nM30");
    pair.run(0, "T10 M6\nM30");
    pair.run(1, "T10 M6\nT10 M6\nM30");
    EXPECT_EQ(table(), "1: 10 101 1 3");
    ASSERT_EQ(nc_rewind(pair.control(), first, 0), NC_OK);
    EXPECT_EQ(table(), first == 0 ? "1: 10 101 1 3" : "1: 10 101 1 1") << "the other's value stays as it was written";
    ASSERT_EQ(nc_rewind(pair.control(), 1 - first, 0), NC_OK);
    EXPECT_EQ(table(), "1: 10 101 0 0");
    EXPECT_EQ(read_by(1, 10), "1, 101 0 0");
  }
}

/// Uses are counted as the blocks are read. Meanwhile the host and the other part system write to other members of that tool and to other tools.
TEST_F(SharedLives, AResetTakesBackOnlyWhatWasReadAhead) {
  for (const bool reset : {false, true}) {
    SCOPED_TRACE(reset);
    pair.run(0, "G10 L3\nP10 L9 Q3\nT101\nP20 L9 Q3\nT201\nG11\nM30");
    pair.select(0, "T10 M6\nG0 X1.\nG1 X20. F6000\nG0 X0\nG1 X40. F1000\nG0 X0\nG1 X1.\nM30");
    pair.select(1, "G4 X0.5\nT20 M6\nG0 X1.\nG1 X2. F6000\nM30");
    pair.start(3);
    pair.cycles(60);
    EXPECT_EQ(table(), "1: 10 101 1 3, 2: 20 201 0 0") << "read ahead";
    EXPECT_EQ(nc_tool_life_set(pair.control(), 1, NC_LIFE_LENGTH, 7), NC_OK);
    for (unsigned n = 0; n < 2000 && pair.out[1].state != NC_STATE_IDLE; ++n) pair.cycle();
    EXPECT_EQ(pair.out[0].state, NC_STATE_RUNNING) << "in the second cut";
    EXPECT_EQ(table(), "1: 10 101 1 3, 2: 20 201 1 1");
    if (reset) pair.reset(0);
    pair.to_the_end();
    EXPECT_EQ(table(), reset ? "1: 10 101 1 1, 2: 20 201 1 1" : "1: 10 101 1 3, 2: 20 201 1 1");
    EXPECT_EQ(life(1, NC_LIFE_LENGTH), 7);
    for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(read_by(system, 10), reset ? "1, 101 1 1" : "1, 101 1 3");
  }
}

/// The table belongs to both. While a tool is in the spindle of one part system the other one may remove it and register another tool in its place: that is
/// not the one in the spindle, whether uses or minutes are counted, and not the one whose offsets H99 means.
TEST_F(SharedLives, AnotherToolInThePlaceOfTheOneInTheSpindleIsNotThatOne) {
  ASSERT_EQ(nc_tool_offset_set(pair.control(), 7, NC_TOOL_LENGTH, 3), NC_OK);
  for (const char* counted : {"L9 Q3", "L9 Q2"}) {
    SCOPED_TRACE(counted);
    const std::string other = std::string("G10 L3 P1\nP30 ") + counted + "\nT301 H7\nG11\n";
    execute(0, std::string("G10 L3\nP10 ") + counted + "\nT101\nG11\nM30");
    execute(0, "T10 M6\nG0 X1.\nG1 X21. F600\nM30");
    EXPECT_EQ(pair.out[0].tool_group, 10U);
    EXPECT_GT(life(1, NC_LIFE_USED), 0);
    execute(1, "G10 L3 P2\nP10\nG11\n" + other + "M30");
    ASSERT_EQ(table(), "1: 30 301 0 0");
    execute(0, "G0 X0\nG1 X21. F600\nG0 X0\nM30");
    EXPECT_EQ(table(), "1: 30 301 0 0");
    EXPECT_EQ(pair.out[0].tool_group, 0U);
    pair.select(0, "G43 H99\nG0 Z10.\nM30");
    pair.start(1);
    pair.cycles(200);
    EXPECT_EQ(pair.out[0].state, NC_STATE_ALARM) << "nobody knows the length of that tool";
    EXPECT_EQ(pair.out[0].command.v[2], 0);
    pair.reset(0);
    execute(0, "#60000=30\n#101=#60005\nM30");
    EXPECT_EQ(pair.var(0, 101), 0) << "no tool of that group is in the spindle";
    pair.in[0].tool_broken = true;
    pair.cycles(5);
    pair.in[0].tool_broken = false;
    pair.cycles(5);
    EXPECT_EQ(life(1, NC_LIFE_STATUS), 0) << "what broke is not this one";
    execute(0, "G49\nT30 M6\nG0 X1.\nG1 X21. F600\nM30");
    EXPECT_GT(life(1, NC_LIFE_USED), 0) << "now it is";
    EXPECT_EQ(pair.out[0].tool_group, 30U);
  }
}

TEST_F(SharedLives, AnotherToolInThePlaceOfTheSelectedOneIsNotMounted) {
  execute(0, "G10 L3\nP10 L9 Q1\nT101\nG11\nM30");
  execute(0, "T10\nM30");
  execute(1, "G10 L3 P2\nP10\nG11\n" + registers(30, 301) + "M30");
  execute(0, "M6\nM30");
  EXPECT_EQ(table(), "1: 30 301 0 0");
  EXPECT_EQ(pair.out[0].tool_group, 0U);
}

TEST_F(SharedLives, TheSameToolRegisteredAnewGoesOn) {
  execute(0, "G10 L3\nP10 L9 Q3\nT101\nG11\nM30");
  execute(0, "T10 M6\nM30");
  execute(1, "G10 L3 P1\nP10 L5 Q3\nT101\nG11\nM30");
  execute(0, "G0 X1.\nG1 X2. F6000\nM30");
  EXPECT_EQ(table(), "1: 10 101 0 1");
  execute(1, "G10 L3\nP20 L5 Q3\nT201\nP30 L9 Q3\nT301\nT101\nG11\nM30");
  execute(0, "G0 X1.\nG1 X2. F6000\nM30");
  EXPECT_EQ(table(), "1: 20 201 0 0, 2: 30 301 0 0, 3: 30 101 0 1") << "in another place of the table and in another group";
  EXPECT_EQ(pair.out[0].tool_group, 30U);
}

/// To register a tool is to look for a free place and to write to it: one step for the other part system, whatever the rhythm of both and of the feeder.
TEST_F(SharedLives, BothRegisterAtTheSameTime) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 dice(seed);
    const auto any = [&](unsigned least, unsigned most) { return std::uniform_int_distribution<unsigned>(least, most)(dice); };
    pair.run(0, "G10 L3\nG11\nM30");
    ASSERT_EQ(table(), "");
    for (unsigned system = 0; system < 2; ++system) {
      std::string text;
      for (unsigned n = 1; n <= 10; ++n) text += (any(0, 2) == 0 ? "G4 X0.00" + std::to_string(any(1, 9)) + "\n" : "") + registers(100 * (system + 1) + n, n);
      pair.select(system, text + "M30");
    }
    pair.run_unevenly(any);
    if (testing::Test::HasFatalFailure()) return;
    for (unsigned system = 0; system < 2; ++system)
      for (unsigned n = 1; n <= 10; ++n) ASSERT_EQ(read_by(n % 2, 100 * (system + 1) + n), "1, " + std::to_string(n) + " 0 0") << "of part system " << system + 1;
  }
}

/// A single part system does not wait, and two of them wait only where they register.
TEST_F(SharedLives, RegisteringWaitsForTheMachineOnlyBesideAnotherPartSystem) {
  Bench one;
  const Outcome run = one.run(registers(10, 101) + "M30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.of(NC_ITEM_SYNC).size(), 0U);
  pair.run(0, registers(10, 101) + "M30");
  EXPECT_EQ(pair.syncs[0], 2U) << "the group and the tool";
  pair.run(0, "G10 L3\nG11\nM30");
  EXPECT_EQ(pair.syncs[0], 3U) << "what is registered goes";
}

}  // namespace
}  // namespace nc::test
